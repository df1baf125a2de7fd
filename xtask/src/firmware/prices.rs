//! Prices of policies on the boards: instructions and divisions of frames, bytes of stack and of code.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::{BOARDS, Board, build};
use crate::command::{self, cargo, output};
use crate::elf::Program;
use crate::embedded::Toolchain;
use crate::workspace::{self, FIRMWARE};

/// The program that draws scenes by every policy, and the one that draws by one of them alone.
const DRAWS: &str = "trade";
const WEIGHED: &str = "size-policy";
/// The variable that names the latter's policy.
const POLICY: &str = "ALBERTI_POLICY";
/// The function that is passed before and after a frame.
const MARK: &str = "passed";

/// The functions that divide on cores without an instruction for it: what Arm's ABI has for 32 bits and for floats, and
/// what other compilers call the same.
const DIVISIONS: [&str; 18] = [
    "__aeabi_idiv",
    "__aeabi_idivmod",
    "__aeabi_uidiv",
    "__aeabi_uidivmod",
    "__aeabi_ldivmod",
    "__aeabi_uldivmod",
    "__aeabi_fdiv",
    "__aeabi_ddiv",
    "__divsi3",
    "__modsi3",
    "__udivsi3",
    "__umodsi3",
    "__divdi3",
    "__udivdi3",
    "__moddi3",
    "__umoddi3",
    "__divsf3",
    "__divdf3",
];

/// What the host says of a frame: it is compared, and names the policy.
struct Right {
    scene: String,
    policy: String,
    hash: String,
    name: String,
}

/// The prices of all policies on the scenes of a folder, as lines of a table without a heading: board, scene's number,
/// policy, instructions, divisions, bytes of stack. With `weighed` there are lines with `code` for the scene and the
/// bytes for the instructions. Only the board of that name is asked, or all.
pub(crate) fn prices(folder: &Path, board: Option<&str>, weighed: bool) -> Result<String, String> {
    let right = host(folder)?;
    let plugin = plugin()?;
    let boards: Vec<&Board> =
        BOARDS.iter().filter(|known| board.is_none_or(|name| name == known.name)).collect();
    let texts = super::each(&boards, |board| {
        let mut text = String::new();
        board.emulator.find()?;
        let toolchain = Toolchain::find(board.target)?;
        frames(board, &toolchain, folder, &plugin, &right, &mut text)?;
        if weighed {
            sizes(board, &toolchain, &right, &mut text)?;
        }
        Ok(text)
    });
    Ok(texts.into_iter().collect::<Result<Vec<String>, String>>()?.concat())
}

/// The frames as the host draws them.
fn host(folder: &Path) -> Result<Vec<Right>, String> {
    let (manifest, [_, scenes]) = FIRMWARE;
    let mut run = cargo();
    run.args(["run", "--quiet", "--profile", "host", "--manifest-path", manifest, "--package", scenes]);
    run.args(["--features", "std", "--target-dir"]).arg(workspace::target_directory());
    let text = output(run.args(["--", "policies"]).arg(folder))?;
    let read = |line: &str| {
        let mut words = line.splitn(4, ' ').map(str::to_string);
        let mut next = || words.next().ok_or_else(|| format!("found `{line}`, expected a frame"));
        Ok(Right { scene: next()?, policy: next()?, hash: next()?, name: next()? })
    };
    text.lines().map(read).collect()
}

/// The plugin that counts divisions, compiled.
fn plugin() -> Result<String, String> {
    let source = workspace::root().join("tests/firmware/plugin/divides.c");
    let plugin = workspace::target_directory().join("divides.so");
    let mut compiler = Command::new("cc");
    compiler.args(["-O2", "-shared", "-fPIC", "-o"]).arg(&plugin).arg(source);
    command::run(&mut compiler)
        .map_err(|error| format!("{error}. A compiler of C is needed (Debian: gcc)"))?;
    Ok(plugin.display().to_string())
}

fn frames(
    board: &Board,
    toolchain: &Toolchain,
    folder: &Path,
    plugin: &str,
    right: &[Right],
    text: &mut String,
) -> Result<(), String> {
    build(toolchain, board.target, "release", &[DRAWS])?;
    let image = toolchain.directory(board.target).join(board.target).join("release").join(DRAWS);
    let program = read(&image)?;
    let mark = program.address(MARK).ok_or_else(|| format!("there is no `{MARK}` in {}", image.display()))?;
    let counts = folder.join(format!("divides-{}", board.name));
    let mut option = format!("file={plugin},out={},mark={mark:x}", counts.display());
    for address in DIVISIONS.iter().filter_map(|name| program.address(name)) {
        let _ = write!(option, ",function={address:x}");
    }
    let printed = board
        .emulator
        .run_in(folder, &["-plugin".to_string(), option], &image)
        .map_err(|message| format!("board {}: {message}", board.name))?;
    let marks =
        fs::read_to_string(&counts).map_err(|error| format!("cannot read {}: {error}", counts.display()))?;
    let marks: Vec<u64> = marks.lines().filter_map(|line| line.parse().ok()).collect();
    let lines: Vec<&str> = printed.lines().collect();
    if lines.len() != right.len() || marks.len() != 2 * lines.len() {
        return Err(format!(
            "board {}: {} frames and {} marks, expected {} and two each",
            board.name,
            lines.len(),
            marks.len(),
            right.len()
        ));
    }
    let (numerator, denominator) = board.instructions_per_tick;
    for ((line, right), marks) in lines.into_iter().zip(right).zip(marks.chunks(2)) {
        let [scene, policy, hash, ticks, stack] = line.split(' ').collect::<Vec<_>>()[..] else {
            return Err(format!("board {}: found `{line}`, expected a frame", board.name));
        };
        if [scene, policy, hash] != [&right.scene, &right.policy, &right.hash] {
            return Err(format!(
                "board {}, scene {scene}, policy {policy}: the frame's hash is {hash}, expected {} as on the host",
                board.name, right.hash
            ));
        }
        let ticks: u64 = ticks.parse().map_err(|_| format!("found `{ticks}`, expected ticks"))?;
        let instructions = ticks * numerator / denominator;
        let divides = marks[1] - marks[0];
        let _ = writeln!(text, "{},{scene},{},{instructions},{divides},{stack}", board.name, field(right));
    }
    Ok(())
}

/// The bytes of code of programs that draw by one policy alone.
fn sizes(board: &Board, toolchain: &Toolchain, right: &[Right], text: &mut String) -> Result<(), String> {
    let (manifest, [package, _]) = FIRMWARE;
    for right in right.iter().take_while(|right| right.scene == "0") {
        let mut build = toolchain.cargo("build", board.target);
        build.env(POLICY, &right.policy);
        build.args([
            "--profile",
            "small",
            "--manifest-path",
            manifest,
            "--package",
            package,
            "--bin",
            WEIGHED,
        ]);
        command::run(&mut build)?;
        let program =
            read(&toolchain.directory(board.target).join(board.target).join("small").join(WEIGHED))?;
        let _ = writeln!(text, "{},code,{},{},,", board.name, field(right), program.text);
    }
    Ok(())
}

/// A policy's name as a field of the table.
fn field(right: &Right) -> String {
    format!("\"{}\"", right.name)
}

fn read(path: &Path) -> Result<Program, String> {
    let file = fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    Program::read(&file).map_err(|message| format!("{}: {message}", path.display()))
}
