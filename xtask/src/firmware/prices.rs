//! Prices of policies on the boards: instructions and divisions of frames, bytes of stack and of code.

use std::fmt::Write as _;
use std::path::Path;

use super::boards::{BOARDS, Board, each};
use super::divides::Plugin;
use super::emulator::Machine;
use super::read_program;
use crate::command::{cargo, output};
use crate::embedded::Toolchain;
use crate::workspace::{self, FIRMWARE};

/// The program that draws scenes by every policy, and the one that draws by one of them alone.
const DRAWS: &str = "trade";
const WEIGHED: &str = "size-policy";
/// The variable that names the latter's policy.
const POLICY: &str = "ALBERTI_POLICY";
/// The boards that have prices.
const PRICED: [&str; 3] = ["m0", "m4f", "rv32"];

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
    let boards: Vec<&Board> = BOARDS
        .iter()
        .filter(|known| PRICED.contains(&known.name) && board.is_none_or(|name| name == known.name))
        .collect();
    boards.iter().try_for_each(|board| board.find().map(|_| ()))?;
    let plugin = Plugin::find()?;
    let texts = each(&boards, |board| {
        let mut text = String::new();
        let toolchain = board.find()?;
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

fn frames(
    board: &Board,
    toolchain: &Toolchain,
    folder: &Path,
    plugin: &Plugin,
    right: &[Right],
    text: &mut String,
) -> Result<(), String> {
    let image = board.image(&board.build(toolchain, "release", &[DRAWS])?, DRAWS);
    let Machine::Qemu(qemu) = &board.machine else {
        return Err(board.says("its instructions are not counted"));
    };
    let (printed, divides) = plugin.run(board, folder, &image).map_err(|message| board.says(message))?;
    if divides.len() != right.len() {
        return Err(board.says(format!("{} frames, expected {}", divides.len(), right.len())));
    }
    for ((line, right), divides) in printed.lines().zip(right).zip(divides) {
        let [scene, policy, hash, ticks, stack] = line.split(' ').collect::<Vec<_>>()[..] else {
            return Err(board.says(format!("found `{line}`, expected a frame")));
        };
        if [scene, policy, hash] != [&right.scene, &right.policy, &right.hash] {
            return Err(format!(
                "board {}, scene {scene}, policy {policy}: the frame's hash is {hash}, expected {} as on the host",
                board.name, right.hash
            ));
        }
        let ticks: u64 = ticks.parse().map_err(|_| format!("found `{ticks}`, expected ticks"))?;
        let instructions = qemu.instructions(ticks);
        let _ = writeln!(text, "{},{scene},{},{instructions},{divides},{stack}", board.name, field(right));
    }
    Ok(())
}

/// The bytes of code of programs that draw by one policy alone.
fn sizes(board: &Board, toolchain: &Toolchain, right: &[Right], text: &mut String) -> Result<(), String> {
    for right in right.iter().take_while(|right| right.scene == "0") {
        let folder = board.build_with(toolchain, "small", &[WEIGHED], &[], Some((POLICY, &right.policy)))?;
        let program = read_program(&board.image(&folder, WEIGHED))?;
        let _ = writeln!(text, "{},code,{},{},,", board.name, field(right), program.text);
    }
    Ok(())
}

/// A policy's name as a field of the table.
fn field(right: &Right) -> String {
    format!("\"{}\"", right.name)
}
