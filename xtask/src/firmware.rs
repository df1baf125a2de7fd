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
            ("fixed-flat", 159),
            ("fixed-gouraud", 540),
            ("fixed-affine", 435),
            ("fixed-textured", 712),
            ("fixed-floor-mip-nearest", 2095),
            ("fixed-floor-trilinear", 5333),
            ("fixed-floor-trilinear-spans", 7318),
        ],
        meshes: &[
            ("mesh", 98_239_260),
            ("mesh-eighth", 13_495_422),
            ("mesh-affine", 82_284_233),
            ("mesh-spans", 109_637_520),
            ("mesh-planes", 99_964_237),
            ("mesh-base-nearest", 105_803_392),
            ("mesh-mip-nearest", 143_415_681),
            ("fixed-mesh-flat", 14_158_713),
            ("fixed-mesh-gouraud", 19_966_511),
            ("fixed-mesh-affine", 15_755_775),
            ("fixed-mesh", 20_198_687),
            ("fixed-mesh-bands", 21_609_691),
            ("fixed-mesh-sub8", 20_484_635),
            ("fixed-mesh-coarse", 2_893_210),
            ("fixed-mesh-eighth", 13_135_247),
            ("integer-mesh-flat", 4_007_531),
            ("integer-mesh-affine", 5_108_956),
            ("integer-mesh-bands", 11_128_735),
            ("meshlets-flat", 3_562_773),
            ("meshlets-affine", 4_633_953),
            ("meshlets-bands-cache", 11_612_853),
            ("meshlets-bands", 10_893_188),
        ],
    },
    Board {
        name: "m4f",
        core: "Cortex-M4F",
        target: "thumbv7em-none-eabihf",
        emulator: Emulator { program: "qemu-system-arm", machine: &["-machine", "mps2-an386"], shift: 5 },
        instructions_per_tick: (5, 4),
        limits: &[
            ("flat-no-depth", 43),
            ("fixed-flat", 119),
            ("fixed-gouraud", 252),
            ("fixed-affine", 222),
            ("fixed-textured", 332),
            ("fixed-floor-mip-nearest", 1068),
            ("fixed-floor-trilinear", 3067),
            ("fixed-floor-trilinear-spans", 3132),
        ],
        meshes: &[
            ("mesh", 6_936_022),
            ("mesh-eighth", 1_178_425),
            ("mesh-affine", 6_933_435),
            ("mesh-spans", 7_772_983),
            ("mesh-planes", 7_317_152),
            ("mesh-base-nearest", 8_674_825),
            ("mesh-mip-nearest", 9_811_238),
            ("fixed-mesh-flat", 2_268_318),
            ("fixed-mesh-gouraud", 3_426_408),
            ("fixed-mesh-affine", 2_926_847),
            ("fixed-mesh", 4_482_045),
            ("fixed-mesh-bands", 5_420_422),
            ("fixed-mesh-sub8", 3_252_006),
            ("fixed-mesh-coarse", 1_104_941),
            ("fixed-mesh-eighth", 1_352_710),
            ("integer-mesh-flat", 2_304_830),
            ("integer-mesh-affine", 2_828_758),
            ("integer-mesh-bands", 5_392_982),
            ("meshlets-flat", 2_164_451),
            ("meshlets-affine", 2_675_015),
            ("meshlets-bands-cache", 5_615_755),
            ("meshlets-bands", 5_236_051),
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
            ("flat-no-depth", 43),
            ("fixed-flat", 110),
            ("fixed-gouraud", 240),
            ("fixed-affine", 240),
            ("fixed-textured", 361),
            ("fixed-floor-mip-nearest", 1146),
            ("fixed-floor-trilinear", 3577),
            ("fixed-floor-trilinear-spans", 4689),
        ],
        meshes: &[
            ("mesh", 57_272_478),
            ("mesh-eighth", 7_695_391),
            ("mesh-affine", 50_005_579),
            ("mesh-spans", 65_315_038),
            ("mesh-planes", 58_672_130),
            ("mesh-base-nearest", 62_055_747),
            ("mesh-mip-nearest", 83_903_765),
            ("fixed-mesh-flat", 8_146_690),
            ("fixed-mesh-gouraud", 11_471_389),
            ("fixed-mesh-affine", 8_927_595),
            ("fixed-mesh", 10_801_931),
            ("fixed-mesh-bands", 11_828_135),
            ("fixed-mesh-sub8", 9_288_546),
            ("fixed-mesh-coarse", 1_529_116),
            ("fixed-mesh-eighth", 7_474_537),
            ("integer-mesh-flat", 2_423_950),
            ("integer-mesh-affine", 2_992_268),
            ("integer-mesh-bands", 5_912_079),
            ("meshlets-flat", 2_125_976),
            ("meshlets-affine", 2_681_414),
            ("meshlets-bands-cache", 6_268_972),
            ("meshlets-bands", 5_743_630),
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
