//! The boards' demo on emulated cores and on this machine: the same bits, and what a frame takes.

use std::fs;
use std::process::Command;

use super::{GUIDE, MANIFEST, build_package};
use crate::command::{self, cargo, output};
use crate::embedded::Target;
use crate::workspace;

/// A core that QEMU has.
struct Core {
    name: &'static str,
    target: Target,
    machine: &'static str,
    /// Its name in the table of docs/firmware.md.
    in_table: &'static str,
}

/// Code for Cortex-M0 runs on a Cortex-M3.
const CORES: [Core; 2] = [
    Core {
        name: "m0",
        target: Target::of("thumbv6m-none-eabi"),
        machine: "mps2-an385",
        in_table: "Cortex-M0+",
    },
    Core {
        name: "m4f",
        target: Target::of("thumbv7em-none-eabihf"),
        machine: "mps2-an386",
        in_table: "Cortex-M4F",
    },
];

/// The kinds of numbers, and how the guide's table names them.
const KINDS: [(&str, &str); 2] = [("fixed", "`FixedPoint(Affine)`"), ("float", "`Affine` in `f32`")];

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
    let path = workspace::root().join(GUIDE);
    let page =
        fs::read_to_string(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let mut rows = String::new();
    for (kind, numbers) in KINDS {
        let counts = |of: fn(&Frame<'_>) -> u64| -> Vec<u64> {
            found.iter().filter(|frame| frame.kind == kind).map(of).collect()
        };
        let (all, first) = (counts(|frame| frame.all), counts(|frame| frame.first));
        let mean = |counts: &[u64]| counts.iter().sum::<u64>() / counts.len().max(1) as u64;
        let [mean, worst, first] = [mean(&all), all.iter().max().copied().unwrap_or_default(), mean(&first)];
        let cells = [mean, worst, first].map(millions).map(|cell| format!("{cell:>12}"));
        rows += &format!("    {:<6}{kind:<8}{}{stack:>12}\n", core.name, cells.concat());
        told(&page, [core.in_table, numbers], [mean, worst, first, stack])?;
    }
    Ok(rows)
}

/// Compares figures with the page's row of these names, from which they may be a hundredth off.
fn told(page: &str, names: [&str; 2], figures: [u64; 4]) -> Result<(), String> {
    let beginning = format!("| {} | {} | ", names[0], names[1]);
    let row = page.lines().find_map(|line| line.strip_prefix(&beginning));
    let row = row.ok_or_else(|| format!("{GUIDE}: no line begins with `{beginning}`"))?;
    let cells = row.trim_end_matches([' ', '|']).split(" | ");
    let units = [1e6, 1e6, 1e6, 1.0];
    let written: Vec<f64> = cells
        .zip(units)
        .filter_map(|(cell, unit)| Some(cell.replace(',', "").parse::<f64>().ok()? * unit))
        .collect();
    #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
    let is_near = |(written, found): (&f64, u64)| (found as f64 - written).abs() <= written / 100.0;
    if written.len() != figures.len() || !written.iter().zip(figures).all(is_near) {
        let expected = format!("{figures:?}, of which a hundredth may be missing or too much");
        return Err(format!("{GUIDE}: found `{row}` behind `{beginning}`, expected {expected}"));
    }
    Ok(())
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
    fn rows_are_compared() {
        let page = "| a | b | c |\n| M0 | `f` | 3.88 | 4.06 | 0.552 | 3,252 |\n";
        let of = |figures| told(page, ["M0", "`f`"], figures);
        assert_eq!(of([3_880_000, 4_099_000, 552_000, 3_252]), Ok(()));
        for wrong in [
            [3_930_000, 4_060_000, 552_000, 3_252],
            [3_880_000, 4_010_000, 552_000, 3_252],
            [3_880_000, 4_060_000, 552_000, 3_300],
        ] {
            assert!(of(wrong).unwrap_err().contains("3.88 | 4.06 | 0.552 | 3,252"));
        }
        assert!(told(page, ["M4", "`f`"], [0; 4]).unwrap_err().contains("no line"));
        assert!(told("| M0 | `f` | 1 |", ["M0", "`f`"], [1_000_000; 4]).is_err());
    }

    #[test]
    fn frames_are_read() {
        let frame = Frame { kind: "fixed", hash: "0f", first: 3, all: 20 };
        assert_eq!(frames("fixed 0 0f 3 20\nstack 1200\n"), Ok((vec![frame], 1200)));
        assert!(frames("fixed 0 0f 3 20\n").unwrap_err().contains("end"));
        assert!(frames("fixed 0 0f 3 x\nstack 0\n").unwrap_err().contains("`fixed 0 0f 3 x`"));
    }
}
