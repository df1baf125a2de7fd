//! The boards: cores, how code is made for them, and the machines on which it runs.

use std::path::{Path, PathBuf};

use super::emulator::{Machine, Qemu};
use crate::command;
use crate::embedded::{Target, Toolchain};
use crate::workspace::FIRMWARE;

/// A core with the machine that runs its code.
pub(super) struct Board {
    /// The name that `--board` takes, and the table.
    pub(super) name: &'static str,
    /// Other cores whose code is the same: they are run under this name.
    pub(super) also: &'static [&'static str],
    /// For people.
    pub(super) core: &'static str,
    pub(super) target: Target,
    pub(super) machine: Machine,
    /// Whether each check weighs its programs. Those of the others are like another board's: they are weighed where the
    /// table is written, or the board is asked for.
    pub(super) is_weighed: bool,
}

/// Every board, the slowest first.
///
/// The emulator's time advances by 2^shift ns with each instruction. The counter of the MPS2 ticks every 40 ns of it,
/// so 32 ns an instruction are 4/5 of a tick, and 32 bits last for 5 thousand million instructions. With the image
/// AN505 it ticks every 50 ns. RISC-V's counter of instructions counts nanoseconds in some versions of QEMU; with 1 ns
/// an instruction these are the same.
pub(super) const BOARDS: &[Board] = &[
    Board {
        name: "m0",
        also: &["m0plus"],
        core: "Cortex-M0 and M0+ code on a Cortex-M3, floats in software, no division",
        target: Target::of("thumbv6m-none-eabi"),
        machine: mps2(&["-machine", "mps2-an385"]),
        is_weighed: true,
    },
    Board {
        name: "m3",
        also: &[],
        core: "Cortex-M3, floats in software",
        target: Target::of("thumbv7m-none-eabi"),
        machine: mps2(&["-machine", "mps2-an385"]),
        is_weighed: false,
    },
    Board {
        name: "rv32",
        also: &[],
        core: "RV32IMC, floats in software",
        target: Target::of("riscv32imc-unknown-none-elf"),
        machine: Machine::Qemu(Qemu {
            program: "qemu-system-riscv32",
            arguments: &["-machine", "virt", "-bios", "none"],
            shift: 0,
            instructions_per_tick: (1, 1),
        }),
        is_weighed: true,
    },
    Board {
        name: "m4f",
        also: &[],
        core: "Cortex-M4F",
        target: Target::of("thumbv7em-none-eabihf"),
        machine: mps2(&["-machine", "mps2-an386"]),
        is_weighed: true,
    },
    Board {
        name: "m7",
        also: &[],
        core: "Cortex-M7, in the order of its instructions and with those of `f64`",
        target: Target { triple: "thumbv7em-none-eabihf", processor: Some("cortex-m7"), feature: None },
        machine: mps2(&["-machine", "mps2-an500"]),
        is_weighed: false,
    },
    Board {
        name: "m33",
        also: &[],
        core: "Cortex-M33",
        target: Target::of("thumbv8m.main-none-eabihf"),
        machine: Machine::Qemu(Qemu {
            program: "qemu-system-arm",
            arguments: &["-machine", "mps2-an505"],
            shift: 5,
            instructions_per_tick: (25, 16),
        }),
        is_weighed: false,
    },
    Board {
        name: "wasm32",
        also: &[],
        core: "WebAssembly in Node, whose instructions are not counted",
        target: Target::of("wasm32-unknown-unknown"),
        machine: Machine::Node,
        is_weighed: true,
    },
];

/// An MPS2 whose counter ticks every 40 ns.
const fn mps2(arguments: &'static [&'static str]) -> Machine {
    Machine::Qemu(Qemu { program: "qemu-system-arm", arguments, shift: 5, instructions_per_tick: (5, 4) })
}

impl Board {
    /// The board of a name, or without one all boards.
    pub(super) fn named(name: Option<&str>) -> Result<Vec<&'static Board>, String> {
        let Some(name) = name else { return Ok(BOARDS.iter().collect()) };
        let is = |board: &&Board| board.name == name || board.also.contains(&name);
        BOARDS.iter().find(is).map(|board| vec![board]).ok_or_else(|| {
            let names =
                BOARDS.iter().flat_map(|board| [board.name].into_iter().chain(board.also.iter().copied()));
            format!("there is no board `{name}`, only {}", names.collect::<Vec<_>>().join(", "))
        })
    }

    /// Says what is missing to build for the board and to run it.
    pub(super) fn find(&self) -> Result<Toolchain, String> {
        self.machine.find()?;
        Toolchain::find(self.target)
    }

    /// Builds some of the programs, and returns the folder in which they are.
    pub(super) fn build(
        &self,
        toolchain: &Toolchain,
        profile: &str,
        names: &[&str],
    ) -> Result<PathBuf, String> {
        self.build_with(toolchain, profile, names, &[], None)
    }

    /// The same with features, and a variable set.
    pub(super) fn build_with(
        &self,
        toolchain: &Toolchain,
        profile: &str,
        names: &[&str],
        features: &[&str],
        variable: Option<(&str, &str)>,
    ) -> Result<PathBuf, String> {
        let (manifest, [package, _]) = FIRMWARE;
        let mut build = toolchain.cargo("build", self.target);
        build.envs(variable).args(["--profile", profile, "--manifest-path", manifest, "--package", package]);
        build.args(names.iter().flat_map(|name| ["--bin", name]));
        build.args(features.iter().flat_map(|feature| ["--features", feature]));
        command::run(&mut build)?;
        Ok(toolchain.directory(self.target).join(self.target.triple).join(profile))
    }

    /// A program's file in the folder of programs.
    pub(super) fn image(&self, folder: &Path, name: &str) -> PathBuf {
        let image = folder.join(name);
        if self.machine == Machine::Node { image.with_extension("wasm") } else { image }
    }

    /// The message with the board's name before it.
    pub(super) fn says(&self, message: impl std::fmt::Display) -> String {
        format!("board {}: {message}", self.name)
    }
}

/// Does something for each board or other place, some at once, in their order: a program of one is compiled by one
/// thread, and takes up to 2 GB.
pub(super) fn each<P: Sync, T: Send>(places: &[P], work: impl Fn(&P) -> T + Sync) -> Vec<T> {
    const AT_ONCE: usize = 3;
    let waiting = std::sync::Mutex::new(places.iter().enumerate());
    let next = || waiting.lock().expect("no chore panics").next();
    let worker = || std::iter::from_fn(next).map(|(place, board)| (place, work(board))).collect::<Vec<_>>();
    let mut done = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..AT_ONCE).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("no chore panics")).collect::<Vec<_>>()
    });
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(name: Option<&str>) -> Result<Vec<&'static str>, String> {
        Ok(Board::named(name)?.iter().map(|board| board.name).collect())
    }

    #[test]
    fn one_board_or_all() {
        assert_eq!(names(None).unwrap().len(), BOARDS.len());
        assert_eq!(names(Some("m4f")), Ok(vec!["m4f"]));
        assert_eq!(names(Some("m0plus")), Ok(vec!["m0"]));
        assert_eq!(
            names(Some("m1")),
            Err("there is no board `m1`, only m0, m0plus, m3, rv32, m4f, m7, m33, wasm32".into())
        );
    }

    #[test]
    fn boards_are_done_once_each_and_come_back_in_order() {
        let boards: Vec<&Board> = BOARDS.iter().collect();
        let slow_first = each(&boards, |board| {
            if board.name == "m0" {
                std::thread::sleep(std::time::Duration::from_millis(20));
            }
            board.name
        });
        assert_eq!(slow_first, BOARDS.iter().map(|board| board.name).collect::<Vec<_>>());
    }

    #[test]
    fn programs_of_different_boards_do_not_overwrite_each_other() {
        for toolchain in [Toolchain::Installed, Toolchain::BuildStd { linker: "rust-lld".into() }] {
            let mut folders: Vec<_> =
                BOARDS.iter().map(|b| toolchain.directory(b.target).join(b.target.triple)).collect();
            folders.sort();
            folders.dedup();
            assert_eq!(folders.len(), BOARDS.len());
        }
    }
}
