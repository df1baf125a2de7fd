//! Building the programs for boards, `crates/alberti/examples/boards`, and testing what they share: here, and in an
//! emulator.
//!
//! Each board is a package of one workspace, and is built alone: two chips of one family would switch on each other's
//! features of the hardware layer.

mod emulated;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::command::{self, Outcome, cargo};
use crate::elf;
use crate::embedded::{Target, Toolchain};
use crate::workspace;

/// The manifest of the workspace.
const MANIFEST: &str = "crates/alberti/examples/boards/Cargo.toml";

/// A board: its folder, and its target.
struct Board {
    name: &'static str,
    target: Target,
}

const BOARDS: &[Board] = &[
    Board { name: "rp2040", target: Target::of("thumbv6m-none-eabi") },
    Board { name: "rp2350", target: Target::of("thumbv8m.main-none-eabihf") },
    Board { name: "stm32f4", target: Target::of("thumbv7em-none-eabihf") },
    Board { name: "stm32h7", target: Target::of("thumbv7em-none-eabihf") },
    Board { name: "nrf52840", target: Target::of("thumbv7em-none-eabihf") },
    Board { name: "esp32c3", target: Target::of("riscv32imc-unknown-none-elf") },
];

/// The guide, which tells the bytes that the demo sends.
const GUIDE: &str = "docs/firmware.md";
/// The picture of the demo in it.
const PICTURE: &str = "docs/pictures/demo.gif";

/// The members that any machine compiles.
const SHARED: [&str; 4] = ["alberti-demo", "panel", "desktop", "alberti-qemu"];

/// The words for the emulator and for all checks, beside the names of boards.
const QEMU: &str = "qemu";
const CHECK: &str = "check";

/// Sections, as they are told.
const SECTIONS: [&str; 4] = [".text", ".rodata", ".data", ".bss"];

/// Builds the programs, or one, and tells their sizes; or draws in an emulator, and tells what frames take; or checks
/// all.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    if matches!(arguments, [word] if word == CHECK) {
        return check();
    }
    if matches!(arguments, [name] if name == QEMU) {
        println!("{}", emulated::run()?);
        return Ok(());
    }
    let boards = chosen(arguments)?;
    let mut table = format!("\n    {:<10}", "board");
    SECTIONS.iter().for_each(|section| table += &format!("{section:>10}"));
    table += "   built in\n";
    for board in boards {
        let start = Instant::now();
        let sizes = build(board)?;
        table += &format!("    {:<10}", board.name);
        sizes.iter().for_each(|size| table += &format!("{size:>10}"));
        table += &format!("{:>9.1} s\n", start.elapsed().as_secs_f32());
    }
    println!("{table}");
    Ok(())
}

/// Checks the format and the lints of what boards share, tests it, and builds the programs of all boards.
fn check() -> Outcome {
    let mut format = cargo();
    format.args(["fmt", "--check", "--manifest-path", MANIFEST]);
    for member in SHARED.into_iter().map(String::from).chain(BOARDS.iter().map(package)) {
        format.args(["--package", &member]);
    }
    command::run(&mut format)?;
    let here = |subcommand: &str, packages: &[&str]| {
        let mut command = cargo();
        command.args([subcommand, "--manifest-path", MANIFEST, "--all-targets", "--target-dir"]);
        command.arg(workspace::target_directory());
        command.args(packages.iter().flat_map(|package| ["--package", package]));
        command
    };
    command::run(here("clippy", &SHARED).args(["--", "-D", "warnings"]))?;
    command::run(&mut here("test", &["panel"]))?;
    println!("{}", emulated::run()?);
    is_current()?;
    run(&[])
}

/// Draws the animated picture of the demo anew, and compares it with the one that the guide shows.
fn is_current() -> Outcome {
    let drawn = workspace::target_directory().join("demo.gif");
    command::run(desktop().arg(&drawn))?;
    let read =
        |path: &Path| fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()));
    if read(&drawn)? != read(&workspace::root().join(PICTURE))? {
        return Err(format!("{PICTURE} is not what the demo draws: copy {} there", drawn.display()));
    }
    sent_are_told()
}

/// The demo on this machine; its arguments follow.
fn desktop() -> Command {
    let mut run = cargo();
    run.args(["run", "--profile", "desktop", "--quiet", "--manifest-path", MANIFEST, "--package", "desktop"]);
    run.arg("--target-dir").arg(workspace::target_directory()).arg("--");
    run
}

/// Counts the bytes that the demo sends for a frame, and looks for them in the guide.
fn sent_are_told() -> Outcome {
    let text = command::output(desktop().arg("bytes"))?;
    let bytes: u64 = (text.split(' ').next().and_then(|word| word.parse().ok()))
        .ok_or_else(|| format!("expected the bytes of a frame, found `{}`", text.trim()))?;
    let told =
        format!("on average {} KB of the frame's {}", (bytes + 500) / 1000, (2 * 320 * 240 + 500) / 1000);
    let page =
        fs::read_to_string(workspace::root().join(GUIDE)).map_err(|error| format!("{GUIDE}: {error}"))?;
    if page.split_whitespace().collect::<Vec<_>>().join(" ").contains(&told) {
        return Ok(());
    }
    Err(format!("{GUIDE} does not say \"{told}\", which is what the demo sends"))
}

/// The boards that the arguments name: one, or all.
fn chosen(arguments: &[String]) -> Result<&'static [Board], String> {
    match arguments {
        [] => Ok(BOARDS),
        [name] => {
            let board = BOARDS.iter().find(|board| board.name == name);
            board.map(std::slice::from_ref).ok_or_else(|| {
                let names: Vec<&str> = BOARDS.iter().map(|board| board.name).collect();
                format!("there is no board `{name}`, only {}, {QEMU} and {CHECK}", names.join(", "))
            })
        }
        _ => Err(format!("expected the name of a board, or nothing, found `{}`", arguments.join(" "))),
    }
}

/// Builds a board's program, and weighs its sections.
fn build(board: &Board) -> Result<[u64; SECTIONS.len()], String> {
    let path = build_package(&package(board), board.target)?;
    let file = fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    elf::sizes(&file, SECTIONS).map_err(|message| format!("{}: {message}", path.display()))
}

/// Builds a package for a target, and tells where its program is.
fn build_package(package: &str, target: Target) -> Result<PathBuf, String> {
    // One directory for all targets: most of what is built is for this machine, macros and build scripts.
    let directory = workspace::target_directory().join("boards");
    let mut build = Toolchain::find(target)?.cargo_in(&directory, "build", target);
    command::run(build.args(["--release", "--manifest-path", MANIFEST, "--package", package]))?;
    Ok(directory.join(target.triple).join("release").join(package))
}

/// The package of a board, and its program. A chip's own name may be that of a crate with its registers.
fn package(board: &Board) -> String {
    format!("alberti-{}", board.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(arguments: &[&str]) -> Result<Vec<&'static str>, String> {
        let arguments: Vec<String> = arguments.iter().map(|argument| argument.to_string()).collect();
        Ok(chosen(&arguments)?.iter().map(|board| board.name).collect())
    }

    #[test]
    fn one_board_or_all() {
        assert_eq!(names(&[]).unwrap().len(), BOARDS.len());
        assert_eq!(names(&["nrf52840"]), Ok(vec!["nrf52840"]));
        assert!(names(&["z80"]).unwrap_err().contains("no board `z80`, only rp2040, rp2350"));
        assert!(names(&["rp2040", "rp2350"]).unwrap_err().contains("`rp2040 rp2350`"));
    }

    #[test]
    fn every_board_is_a_member() {
        let text = fs::read_to_string(workspace::root().join(MANIFEST)).unwrap();
        for name in BOARDS.iter().map(|board| board.name).chain(["demo", "panel", "desktop", QEMU]) {
            assert!(text.contains(&format!("\"{name}\"")), "{name}");
        }
    }
}
