//! Running the firmware of `tests/firmware` in an emulator.
//!
//! The same scenes are drawn by each board and by the host. Every frame must have equal bits; what a frame costs is
//! told in executed instructions, which are the same on every run, and the code in bytes of the programs that draw
//! one thing and do nothing else.

mod emulator;
mod frames;

use std::fs;

use crate::command::{self, Outcome, cargo, output};
use crate::elf::Program;
use crate::embedded::Toolchain;
use crate::workspace::{self, FIRMWARE};
use emulator::Emulator;
use frames::{Drawn, Expected};

/// A machine that the firmware runs on.
struct Board {
    /// What `--board` takes.
    name: &'static str,
    /// For people.
    core: &'static str,
    target: &'static str,
    emulator: Emulator,
    /// A tick of `alberti_firmware::ticks` is so many instructions: a fraction.
    instructions_per_tick: (u64, u64),
    /// The most instructions a written pixel that some scenes may take, in tenths: what a scene does not use must not
    /// come back unnoticed. A division, a plane or a depth more a pixel would exceed them.
    limits: &'static [(&'static str, u64)],
    /// The instructions that meshes took when these were written down. More by a hundredth is a failure.
    meshes: &'static [(&'static str, u64)],
}

/// Every board, and the three kinds of core: without hardware for `f32`, with it, and another architecture.
///
/// The emulator's time advances by 2^shift ns with each instruction. The counter of the MPS2 ticks every 40 ns of it,
/// so 32 ns an instruction are 4/5 of a tick, and 32 bits last for 5 thousand million instructions. RISC-V's counter of
/// instructions counts nanoseconds in some versions of QEMU; with 1 ns an instruction these are the same.
const BOARDS: &[Board] = &[
    Board {
        name: "m0",
        core: "Cortex-M0 code on a Cortex-M3",
        target: "thumbv6m-none-eabi",
        emulator: Emulator { program: "qemu-system-arm", machine: &["-machine", "mps2-an385"], shift: 5 },
        instructions_per_tick: (5, 4),
        limits: &[
            ("flat-no-depth", 58),
            ("fixed-flat", 172),
            ("fixed-gouraud", 553),
            ("fixed-affine", 448),
            ("fixed-textured", 725),
            ("fixed-floor-mip-nearest", 2109),
            ("fixed-floor-trilinear", 5347),
            ("fixed-floor-trilinear-spans", 7575),
        ],
        meshes: &[
            ("mesh", 98_239_260),
            ("mesh-eighth", 13_495_422),
            ("mesh-affine", 82_284_233),
            ("mesh-spans", 109_637_520),
            ("mesh-planes", 99_964_237),
            ("mesh-base-nearest", 105_803_392),
            ("mesh-mip-nearest", 143_372_012),
            ("fixed-mesh-flat", 14_235_803),
            ("fixed-mesh-gouraud", 20_059_883),
            ("fixed-mesh-affine", 15_845_845),
            ("fixed-mesh", 16_945_698),
            ("fixed-mesh-bounded", 16_213_616),
            ("fixed-mesh-bands", 18_258_100),
            ("fixed-mesh-sub8", 20_582_801),
            ("fixed-mesh-coarse", 3_064_752),
            ("fixed-mesh-eighth", 13_239_602),
            ("integer-mesh-flat", 4_086_011),
            ("integer-mesh-affine", 5_200_403),
            ("integer-mesh-bands", 7_757_547),
            ("meshlets-flat", 3_641_253),
            ("meshlets-affine", 4_725_400),
            ("meshlets-bands-cache", 8_241_665),
            ("meshlets-bands", 7_522_000),
            ("meshlets-bands-bounded", 6_897_521),
        ],
    },
    Board {
        name: "m4f",
        core: "Cortex-M4F",
        target: "thumbv7em-none-eabihf",
        emulator: Emulator { program: "qemu-system-arm", machine: &["-machine", "mps2-an386"], shift: 5 },
        instructions_per_tick: (5, 4),
        limits: &[
            ("flat-no-depth", 44),
            ("fixed-flat", 124),
            ("fixed-gouraud", 257),
            ("fixed-affine", 226),
            ("fixed-textured", 336),
            ("fixed-floor-mip-nearest", 1094),
            ("fixed-floor-trilinear", 3093),
            ("fixed-floor-trilinear-spans", 3254),
        ],
        meshes: &[
            ("mesh", 6_936_022),
            ("mesh-eighth", 1_178_425),
            ("mesh-affine", 6_933_435),
            ("mesh-spans", 7_772_983),
            ("mesh-planes", 7_317_152),
            ("mesh-base-nearest", 8_674_825),
            ("mesh-mip-nearest", 9_811_238),
            ("fixed-mesh-flat", 2_299_577),
            ("fixed-mesh-gouraud", 3_465_238),
            ("fixed-mesh-affine", 2_963_992),
            ("fixed-mesh", 3_336_850),
            ("fixed-mesh-bounded", 3_163_632),
            ("fixed-mesh-bands", 4_239_222),
            ("fixed-mesh-sub8", 3_276_015),
            ("fixed-mesh-coarse", 1_166_445),
            ("fixed-mesh-eighth", 1_398_085),
            ("integer-mesh-flat", 2_336_891),
            ("integer-mesh-affine", 2_866_715),
            ("integer-mesh-bands", 4_205_701),
            ("meshlets-flat", 2_196_512),
            ("meshlets-affine", 2_712_970),
            ("meshlets-bands-cache", 4_428_473),
            ("meshlets-bands", 4_048_770),
            ("meshlets-bands-bounded", 3_901_553),
        ],
    },
    Board {
        name: "rv32",
        core: "RV32IMC",
        target: "riscv32imc-unknown-none-elf",
        emulator: Emulator {
            program: "qemu-system-riscv32",
            machine: &["-machine", "virt", "-bios", "none"],
            shift: 0,
        },
        instructions_per_tick: (1, 1),
        limits: &[
            ("flat-no-depth", 44),
            ("fixed-flat", 117),
            ("fixed-gouraud", 247),
            ("fixed-affine", 247),
            ("fixed-textured", 368),
            ("fixed-floor-mip-nearest", 1189),
            ("fixed-floor-trilinear", 3594),
            ("fixed-floor-trilinear-spans", 4769),
        ],
        meshes: &[
            ("mesh", 57_272_478),
            ("mesh-eighth", 7_695_391),
            ("mesh-affine", 50_005_579),
            ("mesh-spans", 65_315_038),
            ("mesh-planes", 58_672_130),
            ("mesh-base-nearest", 62_055_747),
            ("mesh-mip-nearest", 83_911_043),
            ("fixed-mesh-flat", 8_187_430),
            ("fixed-mesh-gouraud", 11_521_352),
            ("fixed-mesh-affine", 8_975_988),
            ("fixed-mesh", 9_477_668),
            ("fixed-mesh-bounded", 9_382_376),
            ("fixed-mesh-bands", 10_454_161),
            ("fixed-mesh-sub8", 9_344_155),
            ("fixed-mesh-coarse", 1_622_103),
            ("fixed-mesh-eighth", 7_521_792),
            ("integer-mesh-flat", 2_465_808),
            ("integer-mesh-affine", 3_041_792),
            ("integer-mesh-bands", 4_530_448),
            ("meshlets-flat", 2_167_834),
            ("meshlets-affine", 2_730_938),
            ("meshlets-bands-cache", 4_887_341),
            ("meshlets-bands", 4_361_999),
            ("meshlets-bands-bounded", 4_257_576),
        ],
    },
];

/// Scenes that must take the same instructions: what a material has not costs nothing.
const EQUAL: &[[&str; 2]] = &[["material", "material-absent"]];

/// The program that draws all scenes, and those that are weighed, which must do without functions of `f64`.
const FRAMES: &str = "alberti-firmware";
const WEIGHED: &[&str] = &["size-flat", "size-textured", "size-f32"];

/// Builds the firmware for the boards, runs it, compares and reports. Stops at the end only, so that a difference on
/// one board is seen beside the others.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let boards = chosen(arguments)?;
    // What is missing is said before anything is built.
    for board in &boards {
        board.emulator.find()?;
        Toolchain::find(board.target)?;
    }
    let expected = expected()?;
    let mut failures = Vec::new();
    for board in boards {
        failures.extend(check(board, &expected).err());
    }
    if failures.is_empty() { Ok(()) } else { Err(format!("there are failures:\n{}", failures.join("\n"))) }
}

/// The boards that the arguments name: one or all.
fn chosen(arguments: &[String]) -> Result<Vec<&'static Board>, String> {
    match arguments {
        [] => Ok(BOARDS.iter().collect()),
        [flag, name] if flag == "--board" => {
            let board = BOARDS.iter().find(|board| board.name == name).ok_or_else(|| {
                let names: Vec<&str> = BOARDS.iter().map(|board| board.name).collect();
                format!("there is no board `{name}`, only {}", names.join(", "))
            })?;
            Ok(vec![board])
        }
        _ => Err(format!("expected nothing or `--board` and a name, found `{}`", arguments.join(" "))),
    }
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

/// Builds for one board, runs there, prints the tables; frames that differ are the error.
fn check(board: &Board, expected: &[Expected]) -> Outcome {
    let toolchain = Toolchain::find(board.target)?;
    let folder = toolchain.directory().join(board.target);
    build(&toolchain, board.target, "release", &[FRAMES])?;
    build(&toolchain, board.target, "small", WEIGHED)?;

    let text = board
        .emulator
        .run(&folder.join("release").join(FRAMES))
        .map_err(|message| format!("board {}: {message}", board.name))?;
    let mut drawn = frames::drawn(&text).map_err(|message| format!("board {}: {message}", board.name))?;
    let (numerator, denominator) = board.instructions_per_tick;
    for Drawn { cost, .. } in &mut drawn {
        *cost = *cost * numerator / denominator;
    }

    println!("\n{}: {} ({}, {})", board.name, board.core, board.target, board.emulator.machine[1]);
    println!("\n{}", frames::table(expected, &drawn));
    println!("    {:<18}{:>10}{:>10}{:>10}", "program, bytes", ".text", ".rodata", "both");
    let mut failures = frames::differences(board.name, expected, &drawn);
    failures.extend(frames::excesses(board.name, expected, &drawn, board.limits));
    failures.extend(frames::slower(board.name, &drawn, board.meshes));
    failures.extend(frames::unequal(board.name, &drawn, EQUAL));
    for name in WEIGHED {
        let path = folder.join("small").join(name);
        let file = fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let program = Program::read(&file).map_err(|message| format!("{}: {message}", path.display()))?;
        let [text, rodata] = [program.text, program.rodata];
        println!("    {name:<18}{text:>10}{rodata:>10}{:>10}", text + rodata);
        let panics = program.panics();
        if !panics.is_empty() {
            failures.push(format!("board {}: {name} can panic: {}", board.name, panics.join(", ")));
        }
        let doubles = program.doubles();
        if !doubles.is_empty() {
            failures.push(format!("board {}: {name} computes in f64: {}", board.name, doubles.join(", ")));
        }
    }
    println!();
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

/// Builds some of the programs for a board.
fn build(toolchain: &Toolchain, target: &str, profile: &str, names: &[&str]) -> Outcome {
    let (manifest, [package, _]) = FIRMWARE;
    let mut build = toolchain.cargo("build", target);
    build.args(["--profile", profile, "--manifest-path", manifest, "--package", package]);
    build.args(names.iter().flat_map(|name| ["--bin", name]));
    command::run(&mut build)
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
        assert_eq!(names(&[]), Ok(vec!["m0", "m4f", "rv32"]));
        assert_eq!(names(&["--board", "m4f"]), Ok(vec!["m4f"]));
    }

    #[test]
    fn other_arguments_are_refused() {
        assert_eq!(names(&["--board", "m7"]), Err("there is no board `m7`, only m0, m4f, rv32".into()));
        assert!(names(&["m4f"]).unwrap_err().contains("`m4f`"));
        assert!(names(&["--board"]).unwrap_err().contains("`--board`"));
    }
}
