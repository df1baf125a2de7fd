//! The tests, how long each takes, and which switches it passes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::tree::Tree;

/// A test that runs on its own.
pub(crate) struct Test {
    pub(crate) program: PathBuf,
    pub(crate) name: String,
    pub(crate) time: Duration,
    /// The mutants whose switches it passes.
    pub(crate) reached: Vec<usize>,
}

/// All tests, the quickest first.
pub(crate) struct Suite {
    pub(crate) tests: Vec<Test>,
}

/// How a test ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    Passed,
    Failed,
    /// It was stopped after many times its time.
    Late,
}

impl Suite {
    /// Runs each test once. One that fails without a mutant is left out.
    pub(crate) fn measured(tree: &Tree, programs: &[PathBuf], mutants: usize) -> Result<Self, String> {
        let mut tests = Vec::new();
        for program in programs {
            let listed = Command::new(program).args(["--list", "--format", "terse"]).output();
            let listed = listed.map_err(|error| format!("{}: {error}", program.display()))?;
            for line in String::from_utf8_lossy(&listed.stdout).lines() {
                if let Some(name) = line.strip_suffix(": test") {
                    let reached = tree.folder.join("reached");
                    tests.extend(measured(tree, program, name, &reached, mutants)?);
                }
            }
        }
        tests.retain(|test| !test.reached.is_empty());
        if tests.is_empty() {
            return Err("no test passes a switch".to_owned());
        }
        tests.sort_by_key(|test| test.time);
        Ok(Self { tests })
    }

    /// The time that all tests take.
    pub(crate) fn seconds(&self) -> f64 {
        self.tests.iter().map(|test| test.time.as_secs_f64()).sum()
    }
}

fn measured(
    tree: &Tree,
    program: &Path,
    name: &str,
    file: &Path,
    mutants: usize,
) -> Result<Option<Test>, String> {
    // A test that ends otherwise than usual leaves none.
    _ = fs::remove_file(file);
    let begin = Instant::now();
    let end = run(
        tree,
        program,
        name,
        &[("MUTANT_REACHED", file.to_string_lossy().as_ref())],
        Duration::from_secs(3600),
    )?;
    let time = begin.elapsed();
    if end != End::Passed {
        println!("left out: {name} of {} fails without a mutant", program.display());
        return Ok(None);
    }
    let bytes = fs::read(file).unwrap_or_default();
    let reached = (0..mutants).filter(|&k| bytes.get(k) == Some(&1)).collect();
    Ok(Some(Test { program: program.to_owned(), name: name.to_owned(), time, reached }))
}

/// Runs a test with these variables, for so long at most.
pub(crate) fn run(
    tree: &Tree,
    program: &Path,
    name: &str,
    variables: &[(&str, &str)],
    most: Duration,
) -> Result<End, String> {
    let failed = |error| format!("{}: {error}", program.display());
    // As cargo runs it: in the folder of its package.
    let folder = package(tree, program);
    let mut test = Command::new(program);
    test.current_dir(folder.clone()).env("CARGO_MANIFEST_DIR", folder).env("RUST_BACKTRACE", "0");
    test.args(["--exact", name, "--test-threads", "1"]).envs(variables.iter().copied());
    let mut child = test.stdout(Stdio::null()).stderr(Stdio::null()).spawn().map_err(failed)?;
    let begin = Instant::now();
    loop {
        if let Some(status) = child.try_wait().map_err(failed)? {
            return Ok(if status.success() { End::Passed } else { End::Failed });
        }
        if begin.elapsed() > most {
            child.kill().and_then(|()| child.wait()).map_err(failed)?;
            return Ok(End::Late);
        }
        sleep(if begin.elapsed() < Duration::from_millis(50) {
            Duration::from_micros(300)
        } else {
            Duration::from_millis(3)
        });
    }
}

/// The folder of the package of a program, by its name.
fn package(tree: &Tree, program: &Path) -> PathBuf {
    let name = program.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let name = name.split('-').next().unwrap_or_default();
    let folder = match name {
        "alberti" | "pictures" => "crates/alberti".to_owned(),
        "contract" | "surface" => "crates/texture".to_owned(),
        "alberti_accuracy" => "tests/accuracy".to_owned(),
        "alberti_hostile" => "tests/hostile".to_owned(),
        _ => match name.strip_prefix("alberti_") {
            Some(library) if library != "tests" => format!("crates/{library}"),
            _ => "tests".to_owned(),
        },
    };
    let folder = tree.root.join(folder);
    if folder.is_dir() { folder } else { tree.root.clone() }
}
