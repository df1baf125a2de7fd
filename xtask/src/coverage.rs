//! Lines of the library crates that their tests run, by the compiler's own counters.
//!
//! Each test program is looked at on its own, and a line counts if one of them runs it. Looked at together, LLVM keeps
//! one record of a function that several programs have, which may be that of a program that never calls it.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::command::{Outcome, cargo, output, run};
use crate::{embedded, workspace};

/// Packages whose tests are not asked.
const WITHOUT: [&str; 3] = ["alberti-app", "alberti-benches", "xtask"];

/// How often each line ran, by file.
type Lines = BTreeMap<PathBuf, BTreeMap<usize, u64>>;

/// Runs the tests with counters, and prints the share of each library; with `--list` also the lines that never ran.
pub(crate) fn coverage(words: &[String]) -> Outcome {
    let list = match words {
        [] => false,
        [word] if word == "--list" => true,
        _ => return Err(format!("expected `--list` or nothing, found `{}`", words.join(" "))),
    };
    let [profdata, cov] = ["llvm-profdata", "llvm-cov"].map(tool);
    let (profdata, cov) = (profdata?, cov?);
    let folder = workspace::target_directory().join("coverage");
    let profiles = folder.join("profiles");
    // Counts of an earlier run are those of other programs.
    _ = fs::remove_dir_all(&profiles);
    let with_counters = |words: &[&str]| {
        let mut tests = cargo();
        tests.env("RUSTFLAGS", "-Cinstrument-coverage");
        tests.env("LLVM_PROFILE_FILE", profiles.join("%m_%p.profraw"));
        tests.args(words).args(["--workspace", "--target-dir"]).arg(&folder);
        tests.args(WITHOUT.iter().flat_map(|package| ["--exclude", package]));
        tests
    };
    let built = output(&mut with_counters(&["test", "--tests", "--no-run", "--message-format=json"]))?;
    // One of the tests runs the examples.
    run(&mut with_counters(&["build", "--examples", "--profile", "test"]))?;
    let messages = built.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let programs: Vec<PathBuf> =
        messages.filter_map(|message| Some(message.get("executable")?.as_str()?.into())).collect();
    run(&mut with_counters(&["test", "--tests"]))?;
    let counted = folder.join("all.profdata");
    let entries = fs::read_dir(&profiles).map_err(|error| format!("{}: {error}", profiles.display()))?;
    let counts = entries.flatten().map(|entry| entry.path());
    output(Command::new(profdata).args(["merge", "--sparse", "-o"]).arg(&counted).args(counts))?;
    let mut lines = Lines::new();
    for program in &programs {
        let mut export = Command::new(&cov);
        export.args(["export", "--format=lcov", "--instr-profile"]).arg(&counted).arg(program);
        add(&mut lines, &output(&mut export)?);
    }
    print!("{}", report(&of_libraries(lines)?, list));
    Ok(())
}

/// A program of the compiler's component `llvm-tools`.
fn tool(name: &str) -> Result<PathBuf, String> {
    let sysroot = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let version = output(Command::new("rustc").arg("-vV"))?;
    let host = embedded::host(&version).ok_or("`rustc -vV` names no host")?;
    let tool = Path::new(sysroot.trim()).join("lib/rustlib").join(host).join("bin").join(name);
    match tool.exists() {
        true => Ok(tool),
        false => {
            Err(format!("there is no {}; `rustup component add llvm-tools` installs it", tool.display()))
        }
    }
}

/// Adds what a program ran, as LCOV has it. A line counts by the program that ran it most.
fn add(lines: &mut Lines, report: &str) {
    let mut file = PathBuf::new();
    for line in report.lines() {
        if let Some(name) = line.strip_prefix("SF:") {
            file = name.into();
        } else if let Some((line, count)) = line.strip_prefix("DA:").and_then(|rest| rest.split_once(','))
            && let (Ok(line), Ok(count)) = (line.parse(), count.parse::<u64>())
        {
            let before = lines.entry(file.clone()).or_default().entry(line).or_default();
            *before = count.max(*before);
        }
    }
}

/// The files of libraries by their names from the root, without tests.
fn of_libraries(lines: Lines) -> Result<Lines, String> {
    let root = workspace::root();
    let mut kept = Lines::new();
    for (file, mut counts) in lines {
        let Ok(name) = file.strip_prefix(&root) else { continue };
        let is_library =
            |library: &workspace::Library| name.starts_with(format!("crates/{}/src", library.folder));
        if !workspace::LIBRARIES.iter().any(is_library)
            || name.iter().any(|part| part.to_string_lossy().contains("tests"))
        {
            continue;
        }
        let text = fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        let tests = text.lines().position(|line| line == "#[cfg(test)]").unwrap_or(usize::MAX);
        counts.retain(|line, _| *line <= tests);
        kept.insert(name.to_owned(), counts);
    }
    Ok(kept)
}

/// The shares, and where they are wanted the lines that never ran.
fn report(lines: &Lines, list: bool) -> String {
    let mut text = String::new();
    let never = |counts: &BTreeMap<usize, u64>| -> Vec<usize> {
        counts.iter().filter(|(_, count)| **count == 0).map(|(line, _)| *line).collect()
    };
    for (file, counts) in lines.iter().filter(|_| list) {
        let never: Vec<_> = never(counts).iter().map(ToString::to_string).collect();
        if !never.is_empty() {
            _ = writeln!(text, "{}: {}", file.display(), never.join(" "));
        }
    }
    let (mut all, mut all_missed) = (0, 0);
    let mut share = |name: &str, lines: usize, missed: usize| {
        let [ran, all] = [lines - missed, lines.max(1)].map(|n| u32::try_from(n).map_or(f64::MAX, f64::from));
        let percent = 100.0 * ran / all;
        _ = writeln!(text, "{name:<12}{percent:>6.1} % of {lines} lines");
    };
    for library in workspace::LIBRARIES {
        let of_library =
            lines.iter().filter(|(file, _)| file.starts_with(format!("crates/{}", library.folder)));
        let (mut lines, mut missed) = (0, 0);
        for (_, counts) in of_library {
            lines += counts.len();
            missed += never(counts).len();
        }
        share(library.folder, lines, missed);
        all += lines;
        all_missed += missed;
    }
    share("all", all, all_missed);
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_counts_if_one_program_runs_it() {
        let mut lines = Lines::new();
        add(&mut lines, "SF:crates/math/src/a.rs\nFN:1,f\nDA:1,0\nDA:2,3\nDA:3,0\nend_of_record\n");
        add(&mut lines, "SF:crates/math/src/a.rs\nDA:1,7\nDA:2,0\nDA:3,0\nend_of_record\n");
        let text = report(&lines, true);
        assert!(text.starts_with("crates/math/src/a.rs: 3\n"), "{text}");
        assert!(text.contains("math          66.7 % of 3 lines\n"), "{text}");
        assert!(text.ends_with("all           66.7 % of 3 lines\n"), "{text}");
    }
}
