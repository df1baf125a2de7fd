//! Bugs that are put into a copy of the libraries, one at a time, and the tests that must notice them.
//!
//! Each is a patch of `tests/seeded`, which begins with the test that fails with it, and with what is wrong:
//!
//! ```text
//! # test: alberti-math --lib round::tests::both_agree_with_f64
//! # bug: Halves are rounded down, `>` for `>=`.
//! diff --git a/crates/math/src/round.rs b/crates/math/src/round.rs
//! ```
//!
//! The copy lies below the target directory and stays there, as do its builds: so only what a bug changes is compiled
//! again. A bug is caught if its test ran and failed. It is the suite that is broken where no test ran, where a patch
//! does not apply or compile, or where a test fails without a bug.

mod bug;
mod tree;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::checks::with_mutants;
use crate::command::{Outcome, cargo, output, run as run_command};
use crate::{tidy, workspace};
use bug::{Bug, Results};
use tree::Tree;

/// The folder of the patches.
const FOLDER: &str = "tests/seeded";

/// Runs the tests of all bugs, or of those named: each must fail. With `--apply` it only looks at the patches.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    let (flags, names): (Vec<&String>, Vec<&String>) =
        arguments.iter().partition(|word| word.starts_with("--"));
    if let Some(unknown) = flags.iter().find(|flag| flag.as_str() != "--apply") {
        return Err(format!("expected `--apply` or names of bugs, found `{unknown}`"));
    }
    let bugs = named(all()?, &names)?;
    if flags.is_empty() { catch(&bugs) } else { apply(&bugs) }
}

/// Checks that every patch applies to the tree, and names a test that there is; and the program with all mutants.
pub(crate) fn check() -> Outcome {
    apply(&all()?)?;
    run_command(with_mutants("test").arg("--quiet"))
}

/// The bugs of the folder, those of a package and target together.
fn all() -> Result<Vec<Bug>, String> {
    let folder = workspace::root().join(FOLDER);
    let failed = |error| format!("cannot list {}: {error}", folder.display());
    let mut files = fs::read_dir(&folder).map_err(failed)?.collect::<Result<Vec<_>, _>>().map_err(failed)?;
    files.sort_by_key(fs::DirEntry::file_name);
    let mut bugs = Vec::new();
    for file in files {
        let name = file.file_name().to_string_lossy().into_owned();
        let text = fs::read_to_string(file.path()).map_err(|error| format!("cannot read {name}: {error}"))?;
        bugs.push(Bug::read(&name, &text).map_err(|message| format!("{FOLDER}/{name}: {message}"))?);
    }
    bugs.sort_by_key(|bug| (bug.place(), bug.target.clone(), bug.name.clone()));
    Ok(bugs)
}

/// Those with these names, with their numbers or without; all if there are none.
fn named(mut bugs: Vec<Bug>, names: &[&String]) -> Result<Vec<Bug>, String> {
    if let Some(unknown) = names.iter().find(|name| !bugs.iter().any(|bug| bug.is_called(name))) {
        return Err(format!("there is no bug `{unknown}` in {FOLDER}"));
    }
    bugs.retain(|bug| names.is_empty() || names.iter().any(|name| bug.is_called(name)));
    Ok(bugs)
}

/// The quick mode.
fn apply(bugs: &[Bug]) -> Outcome {
    let mut sources = String::new();
    for file in tidy::tracked_files()?.iter().filter(|file| file.ends_with(".rs")) {
        let path = workspace::root().join(file);
        sources +=
            &fs::read_to_string(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    }
    let mut faults = Vec::new();
    for bug in bugs {
        let mut git = Command::new("git");
        git.current_dir(workspace::root()).args(["apply", "--check"]).arg(patch(bug));
        faults.extend(output(&mut git).err());
        if !sources.contains(&format!("fn {}(", bug.function())) {
            faults.push(format!("{}: there is no test `{}`", bug.name, bug.filter));
        }
    }
    if !faults.is_empty() {
        return Err(faults.join("\n"));
    }
    println!("{} patches apply, and there are their tests", bugs.len());
    Ok(())
}

/// Puts the bugs in, one at a time, and tells which were caught.
fn catch(bugs: &[Bug]) -> Outcome {
    let start = Instant::now();
    let room = workspace::target_directory().join("seeded");
    let tree = Tree::new(&room.join("tree"))?;
    let (mut caught, mut faults) = (0, Vec::new());
    for group in bugs.chunk_by(|a, b| (&a.package, &a.target) == (&b.package, &b.target)) {
        if let Err(message) = passes(&tree, &room, group) {
            faults.push(message);
            continue;
        }
        for bug in group {
            let start = Instant::now();
            let outcome = fails(&tree, &room, bug);
            let (word, end) = match &outcome {
                Ok(()) => ("caught", format!("by {} {}", bug.package, bug.filter)),
                Err(message) => ("NOT CAUGHT", message.clone()),
            };
            println!("{word:<10}  {:<30} {:>6.1} s  {end}", bug.name, start.elapsed().as_secs_f32());
            caught += usize::from(outcome.is_ok());
        }
    }
    println!("{caught} of {} bugs caught in {:.0} s", bugs.len(), start.elapsed().as_secs_f32());
    if !faults.is_empty() {
        return Err(faults.join("\n"));
    }
    if caught == bugs.len() { Ok(()) } else { Err(format!("{} were not caught", bugs.len() - caught)) }
}

/// Runs the tests of bugs of one package and target without them: all must pass.
fn passes(tree: &Tree, room: &Path, group: &[Bug]) -> Outcome {
    let Some(first) = group.first() else { return Ok(()) };
    let mut filters: Vec<&str> = group.iter().map(|bug| bug.filter.as_str()).collect();
    filters.sort_unstable();
    filters.dedup();
    let (results, printed) = test(tree, room, first, &filters)?;
    match results {
        Some(Results { passed, failed: 0 }) if passed >= filters.len() => Ok(()),
        _ => Err(format!(
            "tests of {} do not pass without a bug, or there are fewer:\n{printed}",
            first.package
        )),
    }
}

/// Puts a bug in and runs its test, which must fail; then takes it out.
fn fails(tree: &Tree, room: &Path, bug: &Bug) -> Outcome {
    tree.apply(&patch(bug))?;
    let found = test(tree, room, bug, &[&bug.filter]);
    tree.restore(&bug.files)?;
    let (results, printed) = found?;
    match results {
        None => Err(format!("the suite is broken, no test ended:\n{printed}")),
        Some(Results { failed: 0, passed: 0 }) => {
            Err(format!("the suite is broken, no test `{}`", bug.filter))
        }
        Some(Results { failed: 0, .. }) => Err(format!("{} passes: {}", bug.filter, bug.about)),
        Some(_) => Ok(()),
    }
}

/// Runs tests in the copy: their results, if there are any, and what was printed.
fn test(tree: &Tree, room: &Path, of: &Bug, filters: &[&str]) -> Result<(Option<Results>, String), String> {
    let mut cargo = cargo();
    cargo.current_dir(tree.root()).args(["test", "--package", &of.package]).args(&of.target);
    cargo.arg("--target-dir").arg(room.join("build")).arg("--").args(filters);
    let output = cargo.output().map_err(|error| format!("cannot start cargo: {error}"))?;
    let printed =
        [output.stderr, output.stdout].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    Ok((Results::read(&printed), printed))
}

/// The file of a bug.
fn patch(bug: &Bug) -> PathBuf {
    workspace::root().join(FOLDER).join(format!("{}.patch", bug.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bugs_have_numbers_of_their_own() {
        let mut numbers: Vec<String> = all().unwrap().iter().map(|bug| bug.name[..2].to_owned()).collect();
        numbers.sort_unstable();
        let count = numbers.len();
        numbers.dedup();
        assert!(count >= 25 && numbers.len() == count, "{numbers:?}");
    }

    #[test]
    fn a_bug_is_named_with_its_number_or_without() {
        let first = || all().unwrap().into_iter().take(1).collect::<Vec<_>>();
        let name = first()[0].name.clone();
        for (name, found) in [(name.clone(), 1), (name[3..].to_owned(), 1)] {
            assert_eq!(named(first(), &[&name]).unwrap().len(), found, "{name}");
        }
        assert!(named(first(), &[&"no-such-bug".to_owned()]).is_err());
        assert_eq!(named(first(), &[]).unwrap().len(), 1);
    }

    #[test]
    fn an_unknown_flag_is_refused() {
        assert!(run(&["--fast".to_owned()]).unwrap_err().contains("`--fast`"));
    }
}
