//! The boards' demo on emulated cores and on this machine: the same bits, and what a frame takes.

use std::process::Command;

use super::{MANIFEST, build_package};
use crate::command::{self, cargo, output};
use crate::workspace;

/// A core that QEMU has.
struct Core {
    name: &'static str,
    target: &'static str,
    machine: &'static str,
    /// The instructions that a frame takes on average, in fixed point, as they were when this was written down. More
    /// by a hundredth is a failure.
    mean: u64,
}

/// Code for Cortex-M0 runs on a Cortex-M3.
const CORES: [Core; 2] = [
    Core { name: "m0", target: "thumbv6m-none-eabi", machine: "mps2-an385", mean: MEANS[0] },
    Core { name: "m4f", target: "thumbv7em-none-eabihf", machine: "mps2-an386", mean: MEANS[1] },
];

const MEANS: [u64; 2] = [u64::MAX / 200; 2];

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
    host.args([
        "run",
        "--quiet",
        "--manifest-path",
        MANIFEST,
        "--package",
        PACKAGE,
        "--target-dir",
    ]);
    host.arg(workspace::target_directory());
    println!("$ {}", command::describe(&host));
    let expected = output(&mut host)?;
    let expected: Vec<Frame<'_>> = frames(&expected)?.0;

    let mut table = "\n    million instructions a frame of the demo\n\n".to_string();
    table += &format!(
        "    {:<10}{:<8}{:>8}{:>8}{:>16}{:>8}\n",
        "core", "numbers", "mean", "worst", "to the first", "stack"
    );
    for core in &CORES {
        let program = build_package(PACKAGE, core.target)?;
        let mut emulator = Command::new("qemu-system-arm");
        emulator.args(["-machine", core.machine, "-nographic", "-monitor", "none", "-serial", "none"]);
        emulator.args([
            "-semihosting-config",
            "enable=on,target=native",
            "-icount",
            "shift=5,sleep=off",
            "-kernel",
        ]);
        emulator.arg(program);
        println!("$ {}", command::describe(&emulator));
        let text = output(&mut emulator)?;
        let (found, stack) = frames(&text)?;
        for (found, expected) in found.iter().zip(&expected) {
            if (found.kind, found.hash) != (expected.kind, expected.hash) {
                return Err(format!(
                    "{}: a frame in {} numbers is not that of this machine",
                    core.name, found.kind
                ));
            }
        }
        if found.len() != expected.len() {
            return Err(format!("{}: {} frames, expected {}", core.name, found.len(), expected.len()));
        }
        for kind in ["fixed", "float"] {
            let of_kind = |of: fn(&Frame<'_>) -> u64| {
                found.iter().filter(|f| f.kind == kind).map(of).collect::<Vec<_>>()
            };
            let (all, first) = (of_kind(|frame| frame.all), of_kind(|frame| frame.first));
            let mean = |counts: &[u64]| counts.iter().sum::<u64>() / counts.len().max(1) as u64;
            let worst = all.iter().max().copied().unwrap_or_default();
            let millions = [mean(&all), worst, mean(&first)].map(|count| count as f64 / 1e6);
            let [average, worst, first] = millions.map(|count| format!("{count:.2}"));
            table += &format!("    {:<10}{kind:<8}{average:>8}{worst:>8}{first:>16}{stack:>8}\n", core.name);
            if kind == "fixed" && mean(&all) > core.mean + core.mean / 100 {
                return Err(format!(
                    "{}: a frame takes {} instructions, and took {}",
                    core.name,
                    mean(&all),
                    core.mean
                ));
            }
        }
    }
    Ok(table)
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
    fn frames_are_read() {
        let frame = Frame { kind: "fixed", hash: "0f", first: 3, all: 20 };
        assert_eq!(frames("fixed 0 0f 3 20\nstack 1200\n"), Ok((vec![frame], 1200)));
        assert!(frames("fixed 0 0f 3 20\n").unwrap_err().contains("end"));
        assert!(frames("fixed 0 0f 3 x\nstack 0\n").unwrap_err().contains("`fixed 0 0f 3 x`"));
    }
}
