//! Running the firmware of `tests/firmware` in an emulator.
//!
//! The same scenes are drawn by each board and by the host. Every frame must have equal bits; what a frame costs is
//! told in executed instructions, which are the same on every run, and the code in bytes of the programs that draw
//! one thing and do nothing else.

mod emulator;
mod frames;
mod prices;

use std::fs;

use crate::command::{self, Outcome, cargo, output};
use crate::elf::Program;
use crate::embedded::Toolchain;
use crate::workspace::{self, FIRMWARE};
use emulator::Emulator;
use frames::{Drawn, Expected};

pub(crate) use prices::prices;

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
    /// The bytes of the programs whose size is of interest, likewise.
    sizes: [u64; WEIGHED.len()],
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
            ("fixed-flat", 170),
            ("fixed-gouraud", 550),
            ("fixed-affine", 446),
            ("fixed-textured", 723),
            ("fixed-floor-mip-nearest", 2107),
            ("fixed-floor-trilinear", 5345),
            ("fixed-floor-trilinear-spans", 7573),
        ],
        meshes: &[
            ("mesh", 98_372_888),
            ("mesh-eighth", 13_538_578),
            ("mesh-affine", 82_397_456),
            ("mesh-spans", 110_115_812),
            ("mesh-planes", 100_260_620),
            ("mesh-base-nearest", 107_488_213),
            ("mesh-mip-nearest", 136_046_390),
            ("fixed-mesh-flat", 14_233_748),
            ("fixed-mesh-gouraud", 20_050_151),
            ("fixed-mesh-affine", 15_836_492),
            ("fixed-mesh", 16_917_858),
            ("fixed-mesh-bounded", 16_237_212),
            ("fixed-mesh-bands", 18_227_896),
            ("fixed-mesh-sub8", 20_571_517),
            ("fixed-mesh-coarse", 3_032_338),
            ("fixed-mesh-eighth", 13_234_740),
            ("integer-mesh-flat", 4_071_922),
            ("integer-mesh-affine", 5_190_632),
            ("integer-mesh-eighth", 2_593_548),
            ("integer-mesh-bands", 7_729_505),
            ("meshlets-flat", 3_633_085),
            ("meshlets-affine", 4_715_660),
            ("meshlets-bands-cache", 8_215_827),
            ("meshlets-bands", 7_499_018),
            ("meshlets-bands-bounded", 6_921_315),
            ("meshlets-distant-flat", 3_937_945),
            ("meshlets-distant-gouraud", 5_589_426),
            ("meshlets-distant-affine", 5_188_146),
            ("meshlets-distant-spans", 5_384_792),
            ("meshlets-distant-bands", 7_072_321),
        ],
        sizes: [17_260, 22_144, 91_776],
    },
    Board {
        name: "m4f",
        core: "Cortex-M4F",
        target: "thumbv7em-none-eabihf",
        emulator: Emulator { program: "qemu-system-arm", machine: &["-machine", "mps2-an386"], shift: 5 },
        instructions_per_tick: (5, 4),
        limits: &[
            ("flat-no-depth", 44),
            ("fixed-flat", 122),
            ("fixed-gouraud", 256),
            ("fixed-affine", 225),
            ("fixed-textured", 335),
            ("fixed-floor-mip-nearest", 1092),
            ("fixed-floor-trilinear", 3092),
            ("fixed-floor-trilinear-spans", 3253),
        ],
        meshes: &[
            ("mesh", 7_081_196),
            ("mesh-eighth", 1_235_917),
            ("mesh-affine", 7_085_972),
            ("mesh-spans", 7_999_790),
            ("mesh-planes", 7_560_700),
            ("mesh-base-nearest", 8_877_433),
            ("mesh-mip-nearest", 10_101_828),
            ("fixed-mesh-flat", 2_294_192),
            ("fixed-mesh-gouraud", 3_459_572),
            ("fixed-mesh-affine", 2_966_667),
            ("fixed-mesh", 3_319_267),
            ("fixed-mesh-bounded", 3_248_793),
            ("fixed-mesh-bands", 4_317_351),
            ("fixed-mesh-sub8", 3_277_350),
            ("fixed-mesh-coarse", 1_150_055),
            ("fixed-mesh-eighth", 1_395_151),
            ("integer-mesh-flat", 2_343_127),
            ("integer-mesh-affine", 2_871_727),
            ("integer-mesh-eighth", 1_315_740),
            ("integer-mesh-bands", 4_291_572),
            ("meshlets-flat", 2_191_068),
            ("meshlets-affine", 2_706_218),
            ("meshlets-bands-cache", 4_421_086),
            ("meshlets-bands", 4_041_880),
            ("meshlets-bands-bounded", 3_999_712),
            ("meshlets-distant-flat", 2_390_103),
            ("meshlets-distant-gouraud", 3_412_331),
            ("meshlets-distant-affine", 2_996_216),
            ("meshlets-distant-spans", 3_077_522),
            ("meshlets-distant-bands", 4_093_583),
        ],
        sizes: [13_516, 17_320, 82_956],
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
            ("fixed-flat", 114),
            ("fixed-gouraud", 245),
            ("fixed-affine", 245),
            ("fixed-textured", 365),
            ("fixed-floor-mip-nearest", 1186),
            ("fixed-floor-trilinear", 3590),
            ("fixed-floor-trilinear-spans", 4765),
        ],
        meshes: &[
            ("mesh", 57_363_160),
            ("mesh-eighth", 7_727_346),
            ("mesh-affine", 50_099_140),
            ("mesh-spans", 65_597_334),
            ("mesh-planes", 58_963_629),
            ("mesh-base-nearest", 63_123_612),
            ("mesh-mip-nearest", 79_665_265),
            ("fixed-mesh-flat", 8_176_136),
            ("fixed-mesh-gouraud", 11_506_437),
            ("fixed-mesh-affine", 8_961_621),
            ("fixed-mesh", 9_435_505),
            ("fixed-mesh-bounded", 9_326_850),
            ("fixed-mesh-bands", 10_409_119),
            ("fixed-mesh-sub8", 9_326_860),
            ("fixed-mesh-coarse", 1_578_186),
            ("fixed-mesh-eighth", 7_514_778),
            ("integer-mesh-flat", 2_454_186),
            ("integer-mesh-affine", 3_027_050),
            ("integer-mesh-eighth", 1_594_825),
            ("integer-mesh-bands", 4_484_981),
            ("meshlets-flat", 2_156_219),
            ("meshlets-affine", 2_716_203),
            ("meshlets-bands-cache", 4_837_037),
            ("meshlets-bands", 4_315_347),
            ("meshlets-bands-bounded", 4_195_067),
            ("meshlets-distant-flat", 2_339_727),
            ("meshlets-distant-gouraud", 3_373_679),
            ("meshlets-distant-affine", 2_998_955),
            ("meshlets-distant-spans", 3_147_897),
            ("meshlets-distant-bands", 4_295_034),
        ],
        sizes: [20_060, 25_804, 114_316],
    },
];

/// Scenes that must take the same instructions: what a material has not costs nothing.
const EQUAL: &[[&str; 2]] = &[["material", "material-absent"]];

/// The program that draws all scenes, and those that are weighed, which must do without functions of `f64`.
const FRAMES: &str = "alberti-firmware";
const WEIGHED: [&str; 3] = ["size-flat", "size-textured", "size-f32"];

/// The flag that has the scenes drawn by a program that is built for size.
const SMALL: &str = "--small";

/// Builds the firmware for the boards, runs it, compares and reports. Stops at the end only, so that a difference on
/// one board is seen beside the others.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let small = arguments.iter().any(|argument| argument == SMALL);
    let others: Vec<String> = arguments.iter().filter(|argument| *argument != SMALL).cloned().collect();
    let boards = chosen(&others)?;
    // What is missing is said before anything is built.
    for board in &boards {
        board.emulator.find()?;
        Toolchain::find(board.target)?;
    }
    let expected = expected()?;
    let mut failures = Vec::new();
    for outcome in each(&boards, |board| check(board, &expected, small)) {
        match outcome {
            Ok((report, found)) => {
                println!("{report}");
                failures.extend(found);
            }
            Err(message) => failures.push(message),
        }
    }
    if failures.is_empty() { Ok(()) } else { Err(format!("there are failures:\n{}", failures.join("\n"))) }
}

/// Does something for each board, all at once: a program of one is compiled by one thread.
fn each<T: Send>(boards: &[&Board], work: impl Fn(&Board) -> T + Sync) -> Vec<T> {
    let work = &work;
    std::thread::scope(|scope| {
        let threads: Vec<_> = boards.iter().map(|board| scope.spawn(move || work(board))).collect();
        threads.into_iter().map(|thread| thread.join().expect("no chore panics")).collect()
    })
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
        _ => Err(format!(
            "expected `--small`, `--board` and a name, or nothing, found `{}`",
            arguments.join(" ")
        )),
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

/// Builds for one board and runs there: the tables, and frames that differ or counts that rose. What is built for size
/// may take more instructions.
fn check(board: &Board, expected: &[Expected], small: bool) -> Result<(String, Vec<String>), String> {
    let toolchain = Toolchain::find(board.target)?;
    let folder = toolchain.directory(board.target).join(board.target);
    let profile = if small { "small" } else { "release" };
    build(&toolchain, board.target, profile, &[FRAMES])?;
    build(&toolchain, board.target, "small", &WEIGHED)?;

    let text = board
        .emulator
        .run(&folder.join(profile).join(FRAMES))
        .map_err(|message| format!("board {}: {message}", board.name))?;
    let mut drawn = frames::drawn(&text).map_err(|message| format!("board {}: {message}", board.name))?;
    let (numerator, denominator) = board.instructions_per_tick;
    for Drawn { cost, .. } in &mut drawn {
        *cost = *cost * numerator / denominator;
    }

    let mut report =
        format!("\n{}: {} ({}, {})\n\n", board.name, board.core, board.target, board.emulator.machine[1]);
    report += &frames::table(expected, &drawn);
    report += &format!("\n    {:<18}{:>10}{:>10}{:>10}\n", "program, bytes", ".text", ".rodata", "both");
    let mut failures = frames::differences(board.name, expected, &drawn);
    if !small {
        failures.extend(frames::excesses(board.name, expected, &drawn, board.limits));
        failures.extend(frames::slower(board.name, &drawn, board.meshes));
    }
    failures.extend(frames::unequal(board.name, &drawn, EQUAL));
    for (name, most) in WEIGHED.into_iter().zip(board.sizes) {
        let path = folder.join("small").join(name);
        let file = fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let program = Program::read(&file).map_err(|message| format!("{}: {message}", path.display()))?;
        let [text, rodata] = [program.text, program.rodata];
        report += &format!("    {name:<18}{text:>10}{rodata:>10}{:>10}\n", text + rodata);
        failures.extend(frames::dearer(board.name, name, "bytes of code", Some(text), most));
        let panics = program.panics();
        if !panics.is_empty() {
            failures.push(format!("board {}: {name} can panic: {}", board.name, panics.join(", ")));
        }
        let doubles = program.doubles();
        if !doubles.is_empty() {
            failures.push(format!("board {}: {name} computes in f64: {}", board.name, doubles.join(", ")));
        }
    }
    Ok((report, failures))
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
