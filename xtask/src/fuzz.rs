//! Coverage-guided fuzzing of the targets in tests/hostile, by the programs of tests/fuzz, with stable Rust.
//!
//! libFuzzer is compiled by `libfuzzer-sys`, which takes a C++ compiler. The flags below have code tell it what was
//! reached and compared; they are those of cargo-fuzz without a sanitizer.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{Outcome, cargo, describe, output, run};
use crate::{embedded, workspace};

/// The manifest of the programs, and the folders of kept cases and of words.
const MANIFEST: &str = "tests/fuzz/Cargo.toml";
const CORPUS: &str = "tests/hostile/corpus";
const DICTIONARIES: &str = "tests/fuzz/dictionaries";

/// The flags of cargo-fuzz 0.13 on stable, and one that leaves out the counters of code which is left out.
const FLAGS: &str = "--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=1 \
    -Cllvm-args=-simplifycfg-branch-fold-threshold=0 -Clink-arg=-Wl,-z,start-stop-gc";

/// The most cases of a target that are kept, and bytes of one.
const KEPT: usize = 40;
const LONGEST: usize = 400;

/// The wishes of the caller.
#[derive(Debug, PartialEq, Eq)]
struct Options<'a> {
    /// None for all.
    targets: Vec<&'a str>,
    /// Seconds for each.
    time: u32,
    /// Processes.
    jobs: u32,
    /// Whether few cases that reach as much as all are to be kept in the repository.
    keep: bool,
    /// Whether the compiler's checks of addresses are on, which a nightly one has.
    address: bool,
    /// One of so many machines, counted from 1: each takes other targets.
    shard: [usize; 2],
}

impl<'a> Options<'a> {
    fn read(arguments: &'a [String]) -> Result<Self, String> {
        let mut options =
            Self { targets: Vec::new(), time: 60, jobs: 1, keep: false, address: false, shard: [1, 1] };
        let mut words = arguments.iter().map(String::as_str);
        while let Some(word) = words.next() {
            let mut number = || {
                let value = words.next().and_then(|value| value.parse().ok()).filter(|value| *value > 0);
                value.ok_or_else(|| format!("expected a number above 0 after `{word}`"))
            };
            match word {
                "--time" => options.time = number()?,
                "--jobs" => options.jobs = number()?,
                "--keep" => options.keep = true,
                "--address" => options.address = true,
                "--shard" => options.shard = shard(words.next())?,
                option if option.starts_with('-') => {
                    return Err(format!(
                        "expected targets, `--time S`, `--jobs N`, `--shard K/N`, `--address` or `--keep`, found `{option}`"
                    ));
                }
                target => options.targets.push(target),
            }
        }
        Ok(options)
    }
}

/// K of N, from 1.
///
/// # Errors
/// It is something else.
pub(crate) fn shard(word: Option<&str>) -> Result<[usize; 2], String> {
    let numbers = word.and_then(|word| word.split_once('/'));
    let numbers = numbers.and_then(|(k, n)| Some([k.parse().ok()?, n.parse().ok()?]));
    let within = numbers.filter(|&[k, n]: &[usize; 2]| k >= 1 && k <= n);
    within.ok_or_else(|| {
        format!("expected K/N, such as 2/8, after `--shard`, found `{}`", word.unwrap_or("nothing"))
    })
}

/// What a target's run came to.
struct Ended {
    executions: u64,
    /// Edges of the program's control flow that were taken.
    edges: u64,
    /// Cases that reach as much as all.
    cases: u64,
}

impl Ended {
    /// By what libFuzzer told, the first number in its last line of a kind.
    fn read(told: &str) -> Option<Self> {
        let last = told.lines().rfind(|line| line.starts_with('#') && line.contains("cov:"))?;
        let words: Vec<&str> = last.split_whitespace().collect();
        let number = |word: &str| word.split('/').next()?.parse::<u64>().ok();
        let after = |key: &str| number(words.get(words.iter().position(|word| *word == key)? + 1)?);
        let executions = number(words.first()?.trim_start_matches('#').trim_end_matches(':'))?;
        Some(Self { executions, edges: after("cov:")?, cases: after("corp:")? })
    }
}

/// Builds the programs, and runs them one after the other.
pub(crate) fn fuzz(arguments: &[String]) -> Outcome {
    let options = Options::read(arguments)?;
    let all = targets()?;
    if let Some(unknown) = options.targets.iter().find(|name| !all.iter().any(|known| known == *name)) {
        return Err(format!("expected one of {}, found `{unknown}`", all.join(", ")));
    }
    // A target has flags of its own, which build scripts and macros do not get.
    let version = output(Command::new("rustc").arg("-vV"))?;
    let host = embedded::host(&version).ok_or("`rustc -vV` names no host")?;
    let built = workspace::target_directory().join(if options.address { "fuzz-address" } else { "fuzz" });
    let (mut build, mut flags) = (cargo(), FLAGS.to_owned());
    if options.address {
        build = Command::new("cargo");
        build.arg("+nightly");
        flags += " -Zsanitizer=address";
    }
    build.env("RUSTFLAGS", flags).args(["build", "--release", "--target", host, "--manifest-path", MANIFEST]);
    run(build.arg("--target-dir").arg(&built))?;
    let names: Vec<_> = all
        .iter()
        .filter(|name| options.targets.is_empty() || options.targets.contains(&name.as_str()))
        .enumerate()
        .filter(|(number, _)| number % options.shard[1] == options.shard[0] - 1)
        .map(|(_, name)| name)
        .collect();
    println!("{:<14}{:>14}{:>8}{:>8}", "target", "executions", "edges", "cases");
    let mut all = 0;
    for name in names {
        let program = built.join(host).join("release").join(name);
        let work = built.join("work").join(name);
        let outcome = one(&program, name, &work, &options);
        let Ended { executions, edges, cases } = outcome.map_err(|message| format!("{name}: {message}"))?;
        println!("{name:<14}{executions:>14}{edges:>8}{cases:>8}");
        all += executions;
    }
    println!("{:<14}{all:>14}", "all");
    Ok(())
}

/// Each target for a short time.
pub(crate) fn check() -> Outcome {
    fuzz(&["--time", "10"].map(str::to_owned))
}

/// The names of the targets: those of the kept cases.
fn targets() -> Result<Vec<String>, String> {
    let folder = workspace::root().join(CORPUS);
    let entries = fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let names = entries.filter_map(|entry| Some(entry.ok()?.path().file_stem()?.to_str()?.to_owned()));
    let mut names: Vec<_> = names.collect();
    names.sort();
    Ok(names)
}

fn one(program: &Path, name: &str, work: &Path, options: &Options<'_>) -> Result<Ended, String> {
    let io = |error: std::io::Error| error.to_string();
    let (corpus, found) = (work.join("corpus"), work.join("found"));
    [&corpus, &found].into_iter().try_for_each(fs::create_dir_all).map_err(io)?;
    let kept = workspace::root().join(CORPUS).join(format!("{name}.hex"));
    for (number, line) in fs::read_to_string(&kept).map_err(io)?.lines().enumerate() {
        fs::write(
            corpus.join(format!("kept-{number}")),
            bytes(line).ok_or("a kept case is no line of digits")?,
        )
        .map_err(io)?;
    }
    let mut command = Command::new(program);
    command.current_dir(work).arg(&corpus).arg(format!("-max_total_time={}", options.time));
    command.args([
        "-artifact_prefix=found/",
        "-timeout=10",
        // Memory that is given back is kept apart for a while by the checks of addresses.
        if options.address { "-rss_limit_mb=6000" } else { "-rss_limit_mb=2500" },
        "-max_len=2000",
        "-close_fd_mask=3",
    ]);
    // Words of the language that a target reads.
    let words = workspace::root().join(DICTIONARIES).join(format!("{name}.dict"));
    if words.exists() {
        command.arg(format!("-dict={}", words.display()));
    }
    if options.jobs > 1 {
        command.arg(format!("-fork={}", options.jobs));
    }
    let ended = command.output().map_err(io)?;
    let told = String::from_utf8_lossy(&ended.stderr);
    if !ended.status.success() {
        let cases: Vec<PathBuf> =
            fs::read_dir(&found).map_err(io)?.filter_map(|entry| Some(entry.ok()?.path())).collect();
        for case in &cases {
            println!("{}:\n{}", case.display(), digits(&fs::read(case).map_err(io)?));
        }
        return Err(format!(
            "{} cases fail ({}): mend it, and add them to {}",
            cases.len(),
            ended.status,
            kept.display()
        ));
    }
    if options.keep {
        keep(program, work, &corpus, &kept)?;
    }
    Ended::read(&told).ok_or_else(|| format!("no count at the end of `{}`", describe(&command)))
}

/// Keeps few cases that reach as much as all, the short ones first.
fn keep(program: &Path, work: &Path, corpus: &Path, kept: &Path) -> Outcome {
    let io = |error: std::io::Error| error.to_string();
    let few = work.join("few");
    let _ = fs::remove_dir_all(&few);
    fs::create_dir_all(&few).map_err(io)?;
    let mut command = Command::new(program);
    command.current_dir(work).args(["-set_cover_merge=1", "-close_fd_mask=3"]).arg(&few).arg(corpus);
    command.output().map_err(io)?;
    // Those that are there stay: some were found the hard way.
    let before = fs::read_to_string(kept).map_err(io)?;
    let mut lines: Vec<String> = before.lines().map(str::to_owned).collect();
    let mut new = Vec::new();
    for entry in fs::read_dir(&few).map_err(io)? {
        let case = fs::read(entry.map_err(io)?.path()).map_err(io)?;
        if case.len() <= LONGEST && !case.is_empty() {
            new.push(digits(&case));
        }
    }
    new.sort_by_key(|line| (line.len(), line.clone()));
    let step = new.len().div_ceil(KEPT).max(1);
    let new = new
        .into_iter()
        .step_by(step)
        .filter(|line| !before.lines().any(|known| known == line))
        .collect::<Vec<_>>();
    lines.extend(new.into_iter().take(KEPT.saturating_sub(lines.len())));
    fs::write(kept, lines.join("\n") + "\n").map_err(io)
}

fn digits(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The bytes of a line of digits.
fn bytes(line: &str) -> Option<Vec<u8>> {
    if !line.len().is_multiple_of(2) || !line.is_ascii() {
        return None;
    }
    (0..line.len()).step_by(2).map(|at| u8::from_str_radix(&line[at..at + 2], 16).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wishes_are_read() {
        let read = |words: &str| {
            let words: Vec<String> = words.split_whitespace().map(str::to_owned).collect();
            Options::read(&words)
                .map(|options| (options.targets.join(","), options.time, options.jobs, options.keep))
        };
        assert_eq!(read(""), Ok((String::new(), 60, 1, false)));
        assert_eq!(read("clip --time 5 view --jobs 2 --keep"), Ok(("clip,view".to_owned(), 5, 2, true)));
        for words in ["--time", "--time x", "--jobs 0", "--seed 1"] {
            assert!(read(words).is_err(), "{words}");
        }
    }

    #[test]
    fn ends_are_read() {
        let told =
            "#1\tINITED cov: 5 ft: 6\nx\n#2048\tDONE   cov: 731 ft: 2345 corp: 92/4012b lim: 80 exec/s: 9\n";
        let ended = Ended::read(told).unwrap();
        assert_eq!([ended.executions, ended.edges, ended.cases], [2048, 731, 92]);
        let forked =
            "#300: cov: 10 ft: 20 corp: 7 exec/s: 5 oom/timeout/crash: 0/0/0 time: 3s job: 1 dft_time: 0\n";
        let ended = Ended::read(forked).unwrap();
        assert_eq!([ended.executions, ended.edges, ended.cases], [300, 10, 7]);
        assert!(Ended::read("no word\n").is_none());
    }

    #[test]
    fn shards_are_read() {
        assert_eq!(shard(Some("2/8")), Ok([2, 8]));
        for word in [None, Some("0/3"), Some("4/3"), Some("1"), Some("a/b")] {
            assert!(shard(word).is_err(), "{word:?}");
        }
    }

    #[test]
    fn lines_are_bytes() {
        assert_eq!(bytes(&digits(&[0, 10, 255])), Some(vec![0, 10, 255]));
        assert_eq!((bytes("0"), bytes("0g"), bytes("é")), (None, None, None));
    }

    #[test]
    fn each_target_has_a_program() {
        let programs = workspace::root().join("tests/fuzz/fuzz_targets");
        let manifest = fs::read_to_string(workspace::root().join(MANIFEST)).unwrap();
        let targets = targets().unwrap();
        assert!(targets.len() >= 15);
        for name in targets {
            assert!(programs.join(format!("{name}.rs")).is_file(), "{name}");
            assert!(manifest.contains(&format!("name = \"{name}\"")), "{name}");
        }
    }
}
