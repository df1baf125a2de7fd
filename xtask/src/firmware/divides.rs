//! Divisions, which a plugin of QEMU counts between marks that the program passes.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::boards::Board;
use super::read_program;
use crate::command::{self, output};
use crate::workspace;

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

/// The plugin, compiled.
pub(super) struct Plugin {
    path: String,
}

impl Plugin {
    /// Compiles the plugin, or says what is missing for it.
    pub(super) fn find() -> Result<Self, String> {
        // Its options are in the help of those that are built with plugins alone.
        let help = output(Command::new("qemu-system-arm").arg("--help"))?;
        if !help.contains("-plugin") {
            return Err("this QEMU is built without plugins".into());
        }
        let source = workspace::root().join("tests/firmware/plugin/divides.c");
        let plugin = workspace::target_directory().join("divides.so");
        let mut compiler = Command::new("cc");
        compiler.args(["-O2", "-shared", "-fPIC", "-o"]).arg(&plugin).arg(source);
        command::run(&mut compiler)
            .map_err(|error| format!("{error}. A compiler of C is needed (Debian: gcc)"))?;
        Ok(Self { path: plugin.display().to_string() })
    }

    /// Runs a program in a folder: the text that it prints, and the divisions of each frame. A frame is a line.
    pub(super) fn run(
        &self,
        board: &Board,
        folder: &Path,
        image: &Path,
    ) -> Result<(String, Vec<u64>), String> {
        let program = read_program(image)?;
        let mark =
            program.address(MARK).ok_or_else(|| format!("there is no `{MARK}` in {}", image.display()))?;
        let counts = folder.join(format!("divides-{}", board.name));
        let mut option = format!("file={},out={},mark={mark:x}", self.path, counts.display());
        for address in DIVISIONS.iter().filter_map(|name| program.address(name)) {
            let _ = write!(option, ",function={address:x}");
        }
        let printed = board.machine.run_in(folder, &["-plugin".to_string(), option], image)?;
        let text = fs::read_to_string(&counts)
            .map_err(|error| format!("cannot read {}: {error}", counts.display()))?;
        let divides = between_marks(&text, printed.lines().count())?;
        Ok((printed, divides))
    }
}

/// The divisions between the two marks of each of so many frames, of the counts at all marks.
fn between_marks(counts: &str, frames: usize) -> Result<Vec<u64>, String> {
    let marks: Vec<u64> = counts.lines().filter_map(|line| line.parse().ok()).collect();
    let (pairs, rest) = marks.as_chunks::<2>();
    if pairs.len() != frames || !rest.is_empty() {
        return Err(format!("{} marks, expected two for each of {frames} frames", marks.len()));
    }
    let divides = |[before, after]: &[u64; 2]| {
        after
            .checked_sub(*before)
            .ok_or_else(|| format!("{after} divisions after a frame, {before} before it"))
    };
    pairs.iter().map(divides).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn divisions_are_those_between_two_marks() {
        assert_eq!(between_marks("3\n10\n12\n12\n", 2), Ok(vec![7, 0]));
        assert_eq!(between_marks("3\n10\n12\n", 1), Err("3 marks, expected two for each of 1 frames".into()));
        assert_eq!(between_marks("3\n1\n", 1), Err("1 divisions after a frame, 3 before it".into()));
    }
}
