//! Instructions of frames and of parts, by gungraun: as they are committed, and as they are.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use serde_json::Value;

use super::results::{number, real, rows};
use crate::command::{Outcome, cargo, output};
use crate::{tool, workspace};

/// The table.
pub(super) const PLACE: &str = "benches/results/counts.csv";
const HEADING: &str = "name,instructions";

/// The percents by which instructions may rise.
const GATE: u64 = 2;

/// The program that runs benchmarks of gungraun.
const RUNNER: &str = "gungraun-runner";

/// A name with its instructions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Count {
    pub(super) name: String,
    pub(super) instructions: u64,
}

/// Reads a table.
pub(super) fn read(text: &str) -> Result<Vec<Count>, String> {
    let row = |(place, [name, figure]): (String, [&str; 2])| {
        Ok(Count { name: name.to_owned(), instructions: number(&place, figure)? })
    };
    rows(PLACE, HEADING, text)?.into_iter().map(row).collect()
}

/// Counts all: the table.
pub(super) fn measure() -> Result<String, String> {
    let here = std::env::consts::ARCH;
    #[cfg(target_arch = "x86_64")]
    let is_known = std::arch::is_x86_feature_detected!("avx2");
    #[cfg(not(target_arch = "x86_64"))]
    let is_known = false;
    if !is_known {
        return Err(format!("found a machine ({here}) without AVX2, expected that of the counts"));
    }
    let runner = runner()?;
    let mut bench = cargo();
    bench.args(["bench", "--quiet", "--package", "alberti-benches", "--bench", "counts", "--"]);
    bench.args(["--output-format=json"]).env("GUNGRAUN_RUNNER", runner).stderr(Stdio::inherit());
    bench.env("GUNGRAUN_HOME", super::folder("gungraun")?);
    let mut table = format!("{HEADING}\n");
    for line in output(&mut bench)?.lines().filter(|line| line.starts_with('{')) {
        let Count { name, instructions } =
            counted(line).ok_or_else(|| format!("{RUNNER} wrote another form: {line}"))?;
        table += &format!("{name},{instructions}\n");
    }
    Ok(table)
}

/// A line of gungraun's: the function, and the words that its arguments have in quotes.
fn counted(line: &str) -> Option<Count> {
    let line: Value = serde_json::from_str(line).ok()?;
    let words = line["description"].as_str()?.split('"').skip(1).step_by(2);
    let name: Vec<_> = std::iter::once(line["function_name"].as_str()?).chain(words).collect();
    let total = &line["profiles"][0]["data"]["total"]["metrics"]["Ir"];
    Some(Count { name: name.join("/"), instructions: total["values"]["new"].as_u64()? })
}

/// The runner of the version that the library needs.
fn runner() -> Result<PathBuf, String> {
    if output(Command::new("valgrind").arg("--version")).is_err() {
        return Err("valgrind is not here; install it, on Debian with `apt-get install valgrind`".into());
    }
    let lock = std::fs::read_to_string(workspace::root().join("Cargo.lock"))
        .map_err(|error| format!("cannot read Cargo.lock: {error}"))?;
    let version = lock.split_once(&format!("name = \"{RUNNER}\"\nversion = \""));
    let version = version.and_then(|(_, rest)| rest.split('"').next()).ok_or("Cargo.lock has no gungraun")?;
    tool::find(RUNNER, version, &[])
}

/// Holds what was found against what is committed.
pub(super) fn compare(committed: &str, found: &str) -> Outcome {
    let (committed, found) = (read(committed)?, read(found)?);
    let mut wrong = Vec::new();
    for Count { name, instructions } in &found {
        let Some(before) = committed.iter().find(|other| other.name == *name) else {
            wrong.push(format!("{name}: counted, and not in {PLACE}"));
            continue;
        };
        let change = real(*instructions) / real(before.instructions) - 1.0;
        let told = format!("{name}: {instructions}, {:+.1} % of {}", 100.0 * change, before.instructions);
        if instructions * 100 > before.instructions * (100 + GATE) {
            wrong.push(told);
        } else if instructions * 100 < before.instructions * (100 - GATE) {
            println!("fewer instructions, `cargo xtask bench counts` keeps that: {told}");
        }
    }
    let lost = committed.iter().filter(|before| found.iter().all(|other| other.name != before.name));
    wrong.extend(lost.map(|before| format!("{}: in {PLACE}, and not counted", before.name)));
    if wrong.is_empty() {
        return Ok(());
    }
    let compiler = output(Command::new("rustc").current_dir(workspace::root()).arg("-V"))?;
    Err(format!(
        "expected at most {GATE} % more instructions than in {PLACE}, found\n  {}\nwith {}; `cargo xtask bench counts` writes them",
        wrong.join("\n  "),
        compiler.trim()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_arguments() {
        let line = r#"{"description":"(drawn(\"mesh\", \"Exact\"))","function_name":"frame","profiles":[{"data":{"total":{"metrics":{"Ir":{"values":{"new":12,"old":13}}}}}}]}"#;
        let right = Count { name: "frame/mesh/Exact".into(), instructions: 12 };
        assert_eq!(counted(line), Some(right.clone()));
        assert_eq!(
            counted(&line.replace("(drawn(\\\"mesh\\\", \\\"Exact\\\"))", "()")).unwrap().name,
            "frame"
        );
        assert_eq!(counted("{}"), None);
        assert_eq!(read("name,instructions\nframe/mesh/Exact,12\n"), Ok(vec![right]));
    }

    #[test]
    fn the_gate_is_two_percent() {
        let table = |figures: &[(&str, u64)]| {
            let rows = figures.iter().map(|(name, figure)| format!("{name},{figure}\n"));
            format!("{HEADING}\n{}", rows.collect::<String>())
        };
        let committed = table(&[("a", 1000), ("b", 100)]);
        assert_eq!(compare(&committed, &table(&[("a", 1020), ("b", 50)])), Ok(()));
        let told = compare(&committed, &table(&[("a", 1021), ("b", 100)])).unwrap_err();
        assert!(told.contains("a: 1021, +2.1 % of 1000") && !told.contains("b:"), "{told}");
        let told = compare(&committed, &table(&[("a", 1000), ("c", 1)])).unwrap_err();
        assert!(told.contains("c: counted, and not in") && told.contains("b: in benches"), "{told}");
    }
}
