//! The boards' demo on emulated cores and on this machine: the same bits, and what a frame takes.

use std::process::Command;

use super::{MANIFEST, build_package};
use crate::command::{self, cargo, output};
use crate::embedded::Target;
use crate::workspace;

/// A core that QEMU has.
struct Core {
    name: &'static str,
    target: Target,
    machine: &'static str,
    /// The instructions that a frame takes in fixed point, on average and at worst, as they were when this was written
    /// down. More by a hundredth is a failure.
    counts: [u64; 2],
}

/// Code for Cortex-M0 runs on a Cortex-M3.
const CORES: [Core; 2] = [
    Core {
        name: "m0",
        target: Target::of("thumbv6m-none-eabi"),
        machine: "mps2-an385",
        counts: [4_010_000, 4_250_000],
    },
    Core {
        name: "m4f",
        target: Target::of("thumbv7em-none-eabihf"),
        machine: "mps2-an386",
        counts: [2_510_000, 2_630_000],
    },
];

/// The program, for any of them and for this machine.
const PACKAGE: &str = "alberti-qemu";

/// A line of it.
#[derive(Debug, PartialEq, Eq)]
struct Frame<'a> {
    /// The kind of numbers.
    kind: &'a str,
    hash: &'a str,
    /// Instructions until the first rows are sent, and of all.
    first: u64,
    all: u64,
}

/// Draws the demo on all of them, and tells what frames take.
pub(super) fn run() -> Result<String, String> {
    let mut host = cargo();
    host.args(["run", "--quiet", "--manifest-path", MANIFEST, "--package", PACKAGE, "--target-dir"]);
    host.arg(workspace::target_directory());
    println!("$ {}", command::describe(&host));
    let text = output(&mut host)?;
    let (expected, _) = frames(&text)?;

    let mut table = "\n    million instructions a frame of the demo, bytes of stack\n\n".to_string();
    let heads = ["mean", "worst", "first rows", "stack"].map(|head| format!("{head:>12}"));
    table += &format!("    {:<6}{:<8}{}\n", "core", "numbers", heads.concat());
    for core in &CORES {
        table += &emulate(core, &expected)?;
    }
    Ok(table)
}

/// Draws on one core, compares with this machine's frames, and tells a row for each kind of numbers.
fn emulate(core: &Core, expected: &[Frame<'_>]) -> Result<String, String> {
    let program = build_package(PACKAGE, core.target)?;
    let mut emulator = Command::new("qemu-system-arm");
    emulator.args(["-machine", core.machine, "-nographic", "-monitor", "none", "-serial", "none"]);
    emulator.args(["-semihosting-config", "enable=on,target=native", "-icount", "shift=5,sleep=off"]);
    emulator.arg("-kernel").arg(program);
    println!("$ {}", command::describe(&emulator));
    let text = output(&mut emulator)?;
    let (found, stack) = frames(&text)?;
    let pictures = |frames: &[Frame<'_>]| -> Vec<String> {
        frames.iter().map(|frame| format!("{} {}", frame.kind, frame.hash)).collect()
    };
    if pictures(&found) != pictures(expected) {
        return Err(format!("{}: the frames are not those of this machine", core.name));
    }
    let mut rows = String::new();
    for kind in ["fixed", "float"] {
        let counts = |of: fn(&Frame<'_>) -> u64| -> Vec<u64> {
            found.iter().filter(|frame| frame.kind == kind).map(of).collect()
        };
        let (all, first) = (counts(|frame| frame.all), counts(|frame| frame.first));
        let mean = |counts: &[u64]| counts.iter().sum::<u64>() / counts.len().max(1) as u64;
        let worst = all.iter().max().copied().unwrap_or_default();
        let cells = [mean(&all), worst, mean(&first)].map(millions).map(|cell| format!("{cell:>12}"));
        rows += &format!("    {:<6}{kind:<8}{}{stack:>12}\n", core.name, cells.concat());
        let now = [("a frame on average", mean(&all)), ("the worst frame", worst)];
        for ((which, now), before) in now.into_iter().zip(core.counts) {
            if kind == "fixed" && now > before + before / 100 {
                return Err(format!("{}: {which} takes {now} instructions, and took {before}", core.name));
            }
        }
    }
    Ok(rows)
}

/// A count in millions, to the nearest hundredth.
fn millions(count: u64) -> String {
    let hundredths = (count + 5000) / 10_000;
    format!("{}.{:02}", hundredths / 100, hundredths % 100)
}

/// The frames that the program tells, and the bytes of stack.
fn frames(text: &str) -> Result<(Vec<Frame<'_>>, u64), String> {
    let wrong = |line: &str| {
        format!("expected kind, frame, hash and two counts, or `stack` and bytes, found `{line}`")
    };
    let (mut frames, mut stack) = (vec![], None);
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |word: &str| word.parse().map_err(|_| wrong(line));
        match words[..] {
            ["stack", bytes] => stack = Some(number(bytes)?),
            [kind, _, hash, first, all] => {
                frames.push(Frame { kind, hash, first: number(first)?, all: number(all)? });
            }
            _ => return Err(wrong(line)),
        }
    }
    Ok((frames, stack.ok_or("the program did not come to its end")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn millions_are_rounded() {
        assert_eq!([7_446_000, 994_999, 5_000].map(millions), ["7.45", "0.99", "0.01"]);
    }

    #[test]
    fn frames_are_read() {
        let frame = Frame { kind: "fixed", hash: "0f", first: 3, all: 20 };
        assert_eq!(frames("fixed 0 0f 3 20\nstack 1200\n"), Ok((vec![frame], 1200)));
        assert!(frames("fixed 0 0f 3 20\n").unwrap_err().contains("end"));
        assert!(frames("fixed 0 0f 3 x\nstack 0\n").unwrap_err().contains("`fixed 0 0f 3 x`"));
    }
}
