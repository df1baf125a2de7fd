//! Running the firmware of `tests/firmware` on emulated cores.
//!
//! The same scenes are drawn by each board and by the host. Every frame must have equal bits. Its cost is told in
//! executed instructions and divisions, which are the same on every run; that of programs which draw one thing and do
//! nothing else in bytes of flash and of RAM. All are in a committed table, above which they must not rise.

mod boards;
mod divides;
mod emulator;
mod fingerprint;
mod frames;
mod page;
mod prices;
mod programs;
mod quoted;
mod table;

use std::fs;
use std::path::Path;

use crate::command::{self, Outcome, cargo, output};
use crate::workspace::{self, FIRMWARE};
use boards::{Board, each};
use divides::Plugin;
use emulator::Machine;
use frames::{Drawn, Expected};
use page::PAGE;
use programs::read_program;
use table::{PLACE, Row, Unit};

pub(crate) use fingerprint::run as fingerprint;
pub(crate) use prices::prices;

/// Scenes that must take the same instructions: what a material has not costs nothing.
const EQUAL: &[[&str; 2]] = &[["material", "material-absent"]];

/// The program that draws all scenes.
const FRAMES: &str = "alberti-firmware";

/// The wishes of the caller.
#[derive(Debug, PartialEq, Eq, Default)]
struct Options<'a> {
    /// One board instead of all.
    board: Option<&'a str>,
    /// The scenes drawn by a program that is built for size, and nothing compared but bits.
    small: bool,
    /// The table written instead of compared.
    write: bool,
}

impl<'a> Options<'a> {
    fn read(arguments: &'a [String]) -> Result<Self, String> {
        let mut options = Self::default();
        let mut words = arguments.iter().map(String::as_str);
        while let Some(word) = words.next() {
            match word {
                "--small" => options.small = true,
                "--write" => options.write = true,
                "--board" => options.board = Some(words.next().ok_or("`--board` takes the name of a board")?),
                _ => {
                    return Err(format!(
                        "expected `--board` and a name, `--small` or `--write`, found `{word}`"
                    ));
                }
            }
        }
        if options.small && options.write {
            return Err("the table has programs that are built for speed: `--small` writes none".into());
        }
        Ok(options)
    }
}

/// Builds the firmware for the boards, runs it, compares and reports. Stops at the end only, so that a difference on
/// one board is seen beside the others.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let options = Options::read(arguments)?;
    let boards = Board::named(options.board)?;
    // What is missing is said before anything is built, and what is wrong in the table.
    boards.iter().try_for_each(|board| board.find().map(|_| ()))?;
    let committed = table::read(&text(PLACE)?)?;
    let plugin = Plugin::find();
    if let Err(reason) = &plugin {
        println!("DIVISIONS ARE NOT COUNTED, and not compared: {reason}");
    }
    let counted = |unit| unit != Unit::Divides || plugin.is_ok();
    let expected = expected()?;
    let folder = workspace::target_directory();

    let (mut rows, mut failures) = (Vec::new(), Vec::new());
    let checked = each(&boards, |board| {
        let weighs = board.is_weighed || options.write || options.board.is_some();
        let stand = committed.iter().filter(|row| row.board == board.name && row.unit.is_of_programs());
        let stand = (!weighs).then(|| stand.cloned().collect());
        let found = check(board, &expected, stand, options.small, plugin.as_ref().ok(), &folder)?;
        // Told at once: the slowest takes a while.
        println!("board {} drew {} frames", board.name, expected.len());
        Ok::<_, String>(found)
    });
    for (board, outcome) in boards.iter().zip(checked) {
        match outcome {
            Ok((found, faults)) => {
                failures.extend(faults);
                if !options.small && !options.write {
                    failures.extend(table::rises(board.name, &committed, &found, counted));
                }
                rows.extend(found);
            }
            Err(message) => failures.push(message),
        }
    }
    if !failures.is_empty() {
        return Err(format!("there are failures:\n{}", failures.join("\n")));
    }
    let merged = table::merged(&committed, &rows, counted);
    if options.small {
        println!("{}", page::page(&rows, &expected));
    } else if options.write {
        put(PLACE, &table::write(&merged))?;
        put(PAGE, &page::page(&merged, &expected))?;
    } else {
        println!("{}", page::page(&merged, &expected));
        if text(PAGE)? != page::page(&committed, &expected) {
            return Err(format!(
                "{PAGE} is not the page of {PLACE}: `cargo xtask firmware --write` writes both"
            ));
        }
        match table::falls(&committed, &rows) {
            0 => {}
            fallen => {
                println!(
                    "{fallen} figures are more than 1 % lower than in {PLACE}: `--write` writes it anew"
                );
            }
        }
    }
    Ok(())
}

/// The faults of pages, as file, line and message: their figures of the committed table.
pub(crate) fn misquoted(pages: &[(&str, String)]) -> Result<Vec<(String, usize, String)>, String> {
    let (rows, counts) = (table::read(&text(PLACE)?)?, text(PAGE)?);
    let of = |(file, page): &(&str, String)| {
        let faults = quoted::faults(page, &rows, &counts);
        faults.into_iter().map(|(line, message)| (file.to_string(), line, message)).collect::<Vec<_>>()
    };
    Ok(pages.iter().flat_map(of).collect())
}

/// A file of the repository.
fn text(place: &str) -> Result<String, String> {
    let path = workspace::root().join(place);
    fs::read_to_string(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

fn put(place: &str, text: &str) -> Outcome {
    let path = workspace::root().join(place);
    fs::write(&path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    println!("wrote {place}");
    Ok(())
}

/// The frames as the host draws them.
fn expected() -> Result<Vec<Expected>, String> {
    let (manifest, [_, scenes]) = FIRMWARE;
    let call = |subcommand: &str| {
        let mut command = cargo();
        command.args([subcommand, "--profile", "host", "--manifest-path", manifest, "--package", scenes]);
        command.args(["--features", "std", "--target-dir"]).arg(workspace::target_directory());
        command
    };
    // Built first and on its own, so that one sees what takes so long.
    command::run(&mut call("build"))?;
    frames::expected(&output(call("run").arg("--quiet"))?)
}

/// Builds for one board and runs there: the rows of the table, and what is wrong. Programs are weighed unless their
/// rows `stand`.
fn check(
    board: &Board,
    expected: &[Expected],
    stand: Option<Vec<Row>>,
    small: bool,
    plugin: Option<&Plugin>,
    folder: &Path,
) -> Result<(Vec<Row>, Vec<String>), String> {
    let toolchain = board.find()?;
    let image =
        board.image(&board.build(&toolchain, if small { "small" } else { "release" }, &[FRAMES])?, FRAMES);
    let (printed, divides) = match (&board.machine, plugin) {
        (Machine::Qemu(_), Some(plugin)) => plugin.run(board, folder, &image),
        _ => board.machine.run(&image).map(|printed| (printed, Vec::new())),
    }
    .map_err(|message| board.says(message))?;
    let mut drawn = frames::drawn(&printed).map_err(|message| board.says(message))?;
    let mut failures = frames::differences(board.name, expected, &drawn);
    let mut rows = Vec::new();
    if let Machine::Qemu(qemu) = &board.machine {
        for Drawn { cost, .. } in &mut drawn {
            *cost = qemu.instructions(*cost);
        }
        failures.extend(frames::unequal(board.name, &drawn, EQUAL));
        for (number, Drawn { name, cost, .. }) in drawn.iter().enumerate() {
            let row = |unit, figure| Row { board: board.name, name: name.clone(), unit, figure };
            rows.push(row(Unit::Instructions, *cost));
            rows.extend(divides.get(number).map(|divides| row(Unit::Divides, *divides)));
        }
    }
    if let Some(stand) = stand {
        rows.extend(stand);
        return Ok((rows, failures));
    }
    let (weighed, faults) = programs::weigh(board, &toolchain)?;
    rows.extend(weighed);
    failures.extend(faults);
    Ok((rows, failures))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<String> {
        text.split_whitespace().map(str::to_string).collect()
    }

    #[test]
    fn options_come_in_any_order() {
        assert_eq!(Options::read(&[]), Ok(Options::default()));
        let arguments = words("--write --board m7");
        assert_eq!(Options::read(&arguments), Ok(Options { board: Some("m7"), small: false, write: true }));
    }

    #[test]
    fn other_arguments_are_refused() {
        let refused = |text: &str| Options::read(&words(text)).map(|_| ()).unwrap_err();
        assert_eq!(refused("--board"), "`--board` takes the name of a board");
        assert!(refused("--all").contains("found `--all`"));
        assert!(refused("--small --write").contains("`--small` writes none"));
    }

    #[test]
    fn the_committed_table_is_of_known_boards() {
        let rows = table::read(&text(PLACE).unwrap()).unwrap();
        assert!(boards::BOARDS.iter().all(|board| rows.iter().any(|row| row.board == board.name)));
    }
}
