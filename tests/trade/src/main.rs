//! The measurement, as `cargo xtask trade` calls it.
//!
//! ```text
//! alberti-trade frames                            draws every row once more in a function that callgrind counts
//! alberti-trade scenes FOLDER                     writes the scenes that boards draw, as files that they read
//! alberti-trade write ROOT [OPTION VALUE]...      measures, and writes docs/trade.md, its table and its pictures
//! alberti-trade boards ROOT [OPTION VALUE]...     writes the tables of the boards, and their chapter of docs/trade.md
//! alberti-trade check ROOT [OPTION VALUE]...      measures what repeats, and compares it with the table
//! alberti-trade advice ROOT                       compares advice with the best of all, and writes docs/advice.md
//! options: --counts FOLDER of callgrind's parts, --compiler TEXT, --boards FILE of the boards' prices
//! ```

mod families;
mod frame;

use alberti_trade::advice;
use alberti_trade::boards::price::{self, Price};
use alberti_trade::boards::{self, model, scene_file};
use alberti_trade::counts::{self, measured};
use alberti_trade::errors::{Court, Judged};
use alberti_trade::family::Family;
use alberti_trade::page::{self, Made, PICTURES, SEEN, page, picture};
use alberti_trade::row::Row;
use alberti_trade::summary::summaries;
use alberti_trade::table::{Line, csv, worse};
use alberti_trade::times::times;
use alberti_trade::{plot, worst};
use families::{FAMILIES, Rows};
use std::collections::HashMap;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Of errors and instructions: a small display.
const SMALL: [u32; 2] = [320, 240];
/// Of times.
const LARGE: [u32; 2] = [640, 480];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match words.as_slice() {
        ["frames"] => {
            frames();
            Ok(())
        }
        ["scenes", folder] => scene_file::write(Path::new(folder)).map_err(Into::into),
        ["write", root, options @ ..] => Options::parse(root, options).and_then(|options| write(&options)),
        ["boards", root, options @ ..] => {
            Options::parse(root, options).and_then(|options| rewrite_chapter(&options))
        }
        ["check", root, options @ ..] => Options::parse(root, options).and_then(|options| check(&options)),
        ["advice", root] => advice(Path::new(root)),
        _ => Err("expected frames, or write, check or advice with the repository's folder".into()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("alberti-trade: {error}");
            ExitCode::FAILURE
        }
    }
}

struct Options {
    docs: PathBuf,
    counts: Option<PathBuf>,
    compiler: String,
    boards: Option<Vec<Price>>,
    root: PathBuf,
}

impl Options {
    fn parse(root: &str, options: &[&str]) -> Result<Self, Box<dyn Error>> {
        let root = PathBuf::from(root);
        let docs = root.join("docs");
        let mut parsed = Self { docs, counts: None, compiler: String::new(), boards: None, root };
        for pair in options.chunks(2) {
            match *pair {
                ["--counts", folder] => parsed.counts = Some(folder.into()),
                ["--compiler", text] => text.clone_into(&mut parsed.compiler),
                ["--boards", file] => {
                    let text =
                        fs::read_to_string(file).map_err(|error| format!("cannot read {file}: {error}"))?;
                    parsed.boards = Some(price::parse(&text)?);
                }
                _ => return Err(format!("expected an option and its value, found {}", pair.join(" ")).into()),
            }
        }
        Ok(parsed)
    }

    fn counts(&self) -> Result<Option<Vec<u64>>, Box<dyn Error>> {
        Ok(self.counts.as_deref().map(counts::read).transpose()?)
    }
}

/// All rows in order, each once before it is counted: memory is touched, and statics are made.
fn frames() {
    for (family, rows) in FAMILIES {
        for mut row in rows(family.name, SMALL) {
            let mut words = vec![0; row.pixels()];
            (row.frame)(&mut words);
            measured(&mut row, &mut words);
        }
    }
}

/// The rows of a family, those of a scene together, each group with its reference.
fn by_scene((family, rows): &(Family, Rows), size: [u32; 2]) -> Vec<Vec<Row>> {
    let mut groups: Vec<Vec<Row>> = vec![];
    for row in rows(family.name, size) {
        match groups.last_mut() {
            Some(group) if group[0].scene.name == row.scene.name => group.push(row),
            _ => groups.push(vec![row]),
        }
    }
    groups
}

/// Hears of each picture that was judged.
type Hear<'a> = dyn FnMut(&Row, &Judged) -> Result<(), Box<dyn Error>> + 'a;

/// Measures what repeats, and the times if they are asked for.
fn measure(counts: Option<&[u64]>, timed: bool, hear: &mut Hear<'_>) -> Result<Vec<Line>, Box<dyn Error>> {
    let (mut court, mut lines) = (Court::default(), vec![]);
    for family in FAMILIES {
        for mut group in by_scene(family, SMALL) {
            eprintln!("{}, {}", group[0].family, group[0].scene.name);
            let judged = court.judge(&mut group);
            for (row, judged) in group.iter().zip(&judged) {
                hear(row, judged)?;
                lines.push(Line {
                    family: row.family,
                    scene: row.scene.name,
                    policy: row.policy.clone(),
                    reference: row.reference,
                    errors: judged.errors,
                    instructions: None,
                    time: None,
                });
            }
        }
    }
    if let Some(counts) = counts {
        if counts.len() != lines.len() {
            return Err(format!("expected {} counts, found {}", lines.len(), counts.len()).into());
        }
        for (line, &count) in lines.iter_mut().zip(counts) {
            line.instructions = Some(count);
        }
    }
    if timed {
        let mut rest = lines.iter_mut();
        for mut group in FAMILIES.iter().flat_map(|family| by_scene(family, LARGE)) {
            eprintln!("times of {}, {}", group[0].family, group[0].scene.name);
            // The times first: of two that are zipped, the first is asked once more than the second has.
            for (time, line) in times(&mut group).into_iter().zip(rest.by_ref()) {
                line.time = Some(time);
            }
        }
    }
    Ok(lines)
}

fn write(options: &Options) -> Result<(), Box<dyn Error>> {
    let pictures = options.docs.join(PICTURES);
    fs::create_dir_all(&pictures)?;
    let mut worst_flips: HashMap<(String, String), f64> = HashMap::new();
    let mut hear = |row: &Row, judged: &Judged| -> Result<(), Box<dyn Error>> {
        let flip = judged.errors.picture.flip;
        let known = worst_flips.entry((row.family.to_owned(), row.policy.clone())).or_insert(0.0);
        if flip > known.max(SEEN) {
            *known = flip;
            worst::write(judged, &pictures.join(picture(row.family, &row.policy)))?;
        }
        Ok(())
    };
    let counts = options.counts()?;
    let lines = measure(counts.as_deref(), true, &mut hear)?;
    for (family, _) in FAMILIES {
        let summaries = summaries(family, &lines);
        plot::draw(family, &summaries, &pictures.join(format!("{}.svg", family.name)))?;
    }
    let families: Vec<Family> = FAMILIES.iter().map(|(family, _)| *family).collect();
    let boards = options.boards.as_deref().map(|prices| boards(options, prices)).transpose()?;
    let made = Made { compiler: &options.compiler, boards: boards.as_deref() };
    fs::write(options.docs.join("trade.csv"), csv(&lines))?;
    fs::write(options.docs.join("trade.md"), page(&families, &lines, made))?;
    println!("Wrote docs/trade.md, docs/trade.csv and docs/{PICTURES}.");
    Ok(())
}

fn advice(root: &Path) -> Result<(), Box<dyn Error>> {
    let found = advice::measure(root)?;
    fs::write(root.join("docs/advice.md"), advice::page(&found))?;
    println!("Wrote docs/advice.md: {}", advice::summary(&found));
    advice::check(&found).map_err(Into::into)
}

/// Writes the tables of the boards, and returns their chapter.
fn boards(options: &Options, prices: &[Price]) -> Result<String, Box<dyn Error>> {
    let (entries, estimates) = model::model(prices);
    fs::write(options.docs.join(BOARDS), boards::table::csv(prices))?;
    fs::write(options.root.join("crates/app/src/advise/chips.csv"), model::csv(&entries, &estimates))?;
    Ok(boards::page::chapter(prices, &estimates))
}

/// Puts the chapter of the boards into the page as it is.
fn rewrite_chapter(options: &Options) -> Result<(), Box<dyn Error>> {
    let prices = options.boards.as_deref().ok_or("boards needs --boards FILE")?;
    let path = options.docs.join("trade.md");
    let page = page::with_boards(&fs::read_to_string(&path)?, &boards(options, prices)?);
    Ok(fs::write(path, page.ok_or("docs/trade.md has no last chapter")?)?)
}

/// The table of the boards.
const BOARDS: &str = "trade-boards.csv";

fn check(options: &Options) -> Result<(), Box<dyn Error>> {
    let read = |name: &str| {
        let path = options.docs.join(name);
        fs::read_to_string(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))
    };
    let (table, text) = (read("trade.csv")?, read("trade.md")?);
    let counts = options.counts()?;
    let same = page::compiler(&text) == Some(options.compiler.as_str());
    match &counts {
        None => println!("INSTRUCTIONS ARE NOT COMPARED: they were not counted."),
        Some(_) if !same => println!(
            "INSTRUCTIONS ARE NOT COMPARED: the table's are of {}, these of {}.",
            page::compiler(&text).unwrap_or("an unknown compiler"),
            options.compiler
        ),
        Some(_) => {}
    }
    let lines = measure(counts.as_deref(), false, &mut |_, _| Ok(()))?;
    let mut complaints = worse(&csv(&lines), &table, counts.is_some() && same);
    if let Some(prices) = &options.boards {
        complaints.extend(boards::table::worse(&boards::table::csv(prices), &read(BOARDS)?));
    }
    if complaints.is_empty() {
        println!("{} rows are as docs/trade.csv has them, or better.", lines.len());
        return Ok(());
    }
    let hint = "if that is meant, `cargo xtask trade` writes the table anew";
    Err(format!("worse than docs/trade.csv; {hint}:\n{}", complaints.join("\n")).into())
}
