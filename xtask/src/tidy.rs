//! Tests of the repository itself: the rules that no compiler and no lint checks.
//!
//! Each rule is a function from text to [`Problem`]s; this file collects the files and decides which rule reads
//! which. All problems are reported at once, as `file:line: message`.

mod layout;
mod manifests;
mod sources;
mod style;

use std::fmt;
use std::fs;
use std::process::Command;

use crate::command::{Outcome, output};
use crate::{firmware, gallery, workspace};

/// A breach of a rule.
#[derive(Debug, PartialEq, Eq)]
struct Problem {
    file: String,
    /// Counted from 1; 1 as well where the whole file is meant.
    line: usize,
    message: String,
}

impl Problem {
    fn new(file: &str, line: usize, message: impl Into<String>) -> Problem {
        Problem { file: file.into(), line, message: message.into() }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}:{}: {}", self.file, self.line, self.message)
    }
}

/// Applies every rule to every file that is, or is about to be, in the repository.
pub(crate) fn run() -> Outcome {
    let files = tracked_files()?;
    let mut problems = layout::check(&files);
    let gallery = gallery::problems(&files)?;
    problems.extend(gallery.into_iter().map(|(file, message)| Problem::new(&file, 1, message)));
    problems.extend(manifests::packages(&manifests::metadata()?));
    let mut pages = Vec::new();
    for file in &files {
        let is_manifest = file.ends_with("Cargo.toml");
        if !(is_manifest || file.ends_with(".rs") || file.ends_with(".md")) {
            continue;
        }
        let text = fs::read_to_string(workspace::root().join(file))
            .map_err(|error| format!("cannot read {file}: {error}"))?;
        if is_manifest {
            problems.extend(manifests::lints(file, &text));
        } else {
            problems.extend(sources::check(file, &text));
            problems.extend(style::check(file, &text));
            if file.ends_with(".md") {
                pages.push((file.as_str(), text));
            }
        }
    }
    let misquoted = firmware::misquoted(&pages)?;
    problems.extend(misquoted.into_iter().map(|(file, line, message)| Problem::new(&file, line, message)));
    for problem in &problems {
        println!("{problem}");
    }
    match problems.len() {
        0 => {
            println!("tidy: {} files, no problems", files.len());
            Ok(())
        }
        count => Err(format!("{count} of the repository's own rules are broken, listed above")),
    }
}

/// The files that git tracks or would add, without those that are deleted in the working tree.
pub(crate) fn tracked_files() -> Result<Vec<String>, String> {
    let mut git = Command::new("git");
    git.current_dir(workspace::root()).args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]);
    let listing = output(&mut git)?;
    let mut files: Vec<String> = listing.split_terminator('\0').map(str::to_string).collect();
    files.retain(|file| workspace::root().join(file).exists());
    // A file in the middle of a merge is listed once per side.
    files.sort();
    files.dedup();
    Ok(files)
}
