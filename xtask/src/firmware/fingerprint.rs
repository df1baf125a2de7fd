//! The hashes of small scenes (`tests/firmware/fingerprint`) on every machine that can be had here: all must be equal.
//!
//! | machine | built by | run by |
//! |---|---|---|
//! | this one at each level of optimization, by all its lanes | the active toolchain | itself |
//! | i686, armv7, aarch64 with Neon | a compiler for targets without an operating system, and a C compiler | QEMU |
//! | the boards, WebAssembly without and with simd128 | the same | QEMU's machines, Node |

use std::process::Command;

use super::boards::{BOARDS, Board, each};
use super::emulator::Machine;
use crate::command::{Outcome, cargo, output, run as run_command};
use crate::embedded::{Target, Toolchain};
use crate::workspace::{self, FINGERPRINT, FIRMWARE};

/// The profile of programs for hosts.
const PROFILE: &str = "host";

/// A program in C with the hashes, which needs no standard library of Rust.
const MAIN: &str = "tests/firmware/fingerprint/main.c";

/// The levels of optimization, the first of which all others are compared with.
const LEVELS: [&str; 4] = ["2", "0", "3", "s"];

/// A machine whose programs QEMU runs one by one.
struct Foreign {
    name: &'static str,
    target: Target,
    /// The C compiler, and the emulator.
    compiler: &'static str,
    emulator: &'static str,
    packages: &'static str,
}

const FOREIGN: &[Foreign] = &[
    Foreign {
        name: "i686",
        target: Target::of("i686-unknown-linux-gnu"),
        compiler: "i686-linux-gnu-gcc",
        emulator: "qemu-i386",
        packages: "gcc-i686-linux-gnu libc6-dev-i386-cross qemu-user",
    },
    Foreign {
        name: "armv7",
        target: Target::of("armv7-unknown-linux-gnueabihf"),
        compiler: "arm-linux-gnueabihf-gcc",
        emulator: "qemu-arm",
        packages: "gcc-arm-linux-gnueabihf libc6-dev-armhf-cross qemu-user",
    },
    Foreign {
        name: "aarch64",
        target: Target::of("aarch64-unknown-linux-gnu"),
        compiler: "aarch64-linux-gnu-gcc",
        emulator: "qemu-aarch64",
        packages: "gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user",
    },
];

/// WebAssembly with simd128, beside the board without.
const SIMD128: Board = Board {
    name: "wasm32-simd128",
    also: &[],
    core: "WebAssembly with simd128 in Node",
    target: Target { feature: Some("simd128"), ..Target::of("wasm32-unknown-unknown") },
    machine: Machine::Node,
    is_weighed: false,
};

/// A machine that draws the scenes.
enum Place {
    Host(&'static str),
    Foreign(&'static Foreign),
    Board(&'static Board),
}

impl Place {
    /// All of them; that with which the others are compared comes first.
    fn all() -> impl Iterator<Item = Self> {
        let boards = BOARDS.iter().chain([&SIMD128]);
        let hosts = LEVELS.into_iter().map(Self::Host);
        hosts.chain(FOREIGN.iter().map(Self::Foreign)).chain(boards.map(Self::Board))
    }

    fn name(&self) -> String {
        match self {
            Self::Host(level) => format!("host-{level}"),
            Self::Foreign(foreign) => foreign.name.to_owned(),
            Self::Board(board) => board.name.to_owned(),
        }
    }

    /// The hashes in the order of the scenes.
    fn hashes(&self) -> Result<Vec<String>, String> {
        let printed = match self {
            Self::Host(level) => host(level)?,
            Self::Foreign(foreign) => foreign.print()?,
            Self::Board(board) => board.print()?,
        };
        read(&printed)
    }
}

/// Draws the scenes on the machines of these names, or on all, and compares them.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let names: Vec<_> = Place::all().map(|place| place.name()).collect();
    if let Some(unknown) = arguments.iter().find(|name| !names.contains(name)) {
        return Err(format!("expected some of {}, found `{unknown}`", names.join(", ")));
    }
    let mut places = Place::all();
    let first = places.next().ok_or("there is no machine")?;
    let expected = first.hashes()?;
    println!("{} scenes on {}", expected.len(), first.name());
    let chosen: Vec<_> =
        places.filter(|place| arguments.is_empty() || arguments.contains(&place.name())).collect();
    let failures = each(&chosen, |place| {
        let difference = match place.hashes() {
            Ok(found) => differences(&expected, &found),
            Err(message) => Some(message),
        };
        match difference {
            None => println!("{}: equal", place.name()),
            Some(_) => println!("{}: fails", place.name()),
        }
        difference.map(|difference| format!("{}: {difference}", place.name()))
    });
    let failures: Vec<_> = failures.into_iter().flatten().collect();
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

/// The scenes whose hashes differ, in words.
fn differences(expected: &[String], found: &[String]) -> Option<String> {
    if expected.len() != found.len() {
        return Some(format!("{} scenes instead of {}", found.len(), expected.len()));
    }
    let differ = expected.iter().zip(found).enumerate().filter(|(_, (a, b))| a != b);
    let numbers: Vec<_> = differ.map(|(number, _)| number.to_string()).collect();
    (!numbers.is_empty()).then(|| format!("other hashes of the scenes {}", numbers.join(", ")))
}

/// The last word of each line: the hash of the scene whose number the first is.
fn read(printed: &str) -> Result<Vec<String>, String> {
    let hash = |(line, number): (&str, usize)| {
        let words: Vec<_> = line.split_whitespace().collect();
        let hash = words.last().filter(|hash| hash.len() == 16 && words[0] == number.to_string());
        hash.map(ToString::to_string)
            .ok_or_else(|| format!("found `{line}`, expected scene {number} and a hash"))
    };
    printed.lines().zip(0..).map(hash).collect()
}

/// The host's program, which fails itself where lanes differ.
fn host(level: &str) -> Result<String, String> {
    let folder = workspace::target_directory().join("fingerprint").join(format!("host-{level}"));
    let (manifest, _) = FIRMWARE;
    let mut build = cargo();
    build.env("CARGO_PROFILE_HOST_OPT_LEVEL", level).args(["build", "--profile", PROFILE]);
    build.args(["--manifest-path", manifest, "--package", FINGERPRINT, "--features", "std"]);
    run_command(build.arg("--target-dir").arg(&folder))?;
    output(&mut Command::new(folder.join(PROFILE).join("fingerprint")))
}

impl Foreign {
    fn print(&self) -> Result<String, String> {
        for program in [self.compiler, self.emulator] {
            if Command::new(program).arg("--version").output().is_err() {
                return Err(format!(
                    "there is no `{program}`: on Debian `apt-get install {}`, then run this again",
                    self.packages
                ));
            }
        }
        let toolchain = Toolchain::find(self.target)?;
        let (manifest, _) = FIRMWARE;
        let mut build = toolchain.cargo("rustc", self.target);
        build.env("CARGO_PROFILE_HOST_OPT_LEVEL", "2").args([
            "--profile",
            PROFILE,
            "--manifest-path",
            manifest,
        ]);
        build.args(["--package", FINGERPRINT, "--lib", "--crate-type", "staticlib", "--features", "c"]);
        run_command(&mut build)?;
        let folder = toolchain.directory(self.target).join(self.target.triple).join(PROFILE);
        let program = folder.join("fingerprint-program");
        let mut link = Command::new(self.compiler);
        link.args(["-static", "-O1"]).arg(workspace::root().join(MAIN));
        run_command(link.arg(folder.join("libfingerprint.a")).arg("-o").arg(&program))?;
        output(Command::new(self.emulator).arg(&program))
    }
}

impl Board {
    /// The lines that the board's program prints.
    fn print(&self) -> Result<String, String> {
        let toolchain = self.find()?;
        // By its lanes, where it has any.
        let lanes = if self.target.feature.is_some() { &["simd"][..] } else { &[] };
        let folder = self.build_with(&toolchain, "release", &["fingerprint"], lanes, None)?;
        self.machine.run(&self.image(&folder, "fingerprint"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_scenes() {
        let read = |text: &str| read(text).ok();
        let [a, b] = ["0123456789abcdef", "fedcba9876543210"].map(str::to_owned);
        assert_eq!(read(&format!("0 nearest {a}\n1 {b}\n")), Some(vec![a.clone(), b.clone()]));
        assert_eq!(read(&format!("1 {b}\n")), None);
        assert_eq!(read("0 panicked at\n"), None);
        assert_eq!(differences(&[a.clone(), b.clone()], &[a.clone(), b.clone()]), None);
        assert!(differences(&[a.clone(), b.clone()], &[a.clone(), a.clone()]).unwrap().ends_with("scenes 1"));
        assert!(differences(&[a.clone(), b], &[a]).unwrap().starts_with("1 scenes"));
    }

    #[test]
    fn machines_have_names_of_their_own() {
        let mut names: Vec<_> = Place::all().map(|place| place.name()).collect();
        let count = names.len();
        assert!(names[0] == "host-2" && count == LEVELS.len() + FOREIGN.len() + BOARDS.len() + 1);
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
        assert!(run(&["m1".to_owned()]).unwrap_err().contains("found `m1`"));
        // The C program is there to be compiled.
        let source = workspace::root().join(MAIN);
        assert!(std::fs::read_to_string(source).is_ok_and(|text| text.contains("fingerprint_half")));
    }
}
