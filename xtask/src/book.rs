//! The book: docs/SUMMARY.md, and the pages that it names, as a folder of HTML that can be searched, by mdBook.
//!
//! ```text
//!   docs/SUMMARY.md          \  links to pages, formulas                    mdBook
//!   the pages that it names  /  --> target/book-source, with pictures  -->  target/book
//! ```
//!
//! GitHub shows the same pages where they lie. What it does by itself is done here: formulas, and links to folders. Of
//! links to files that are not in the book the words stay.

mod links;
mod page;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::command::{Outcome, describe};
use crate::{tool, workspace};
use page::Page;

/// The folder of the settings, of the summary and of most pages.
const DOCS: &str = "docs";

/// The settings, and the styles that they name.
const SETTINGS: [&str; 3] = ["docs/book.toml", "docs/book.css", "crates/web/page/formulas.css"];

/// mdBook, its version, and what it needs for a book that can be searched.
const MDBOOK: (&str, &str, &[&str]) = ("mdbook", "0.5.4", &["--no-default-features", "--features", "search"]);

/// Makes the book, and follows its links.
pub(crate) fn check() -> Outcome {
    let (package, version, more) = MDBOOK;
    let mdbook = tool::find(package, version, more)?;
    let (source, folder) =
        (workspace::target_directory().join("book-source"), workspace::target_directory().join("book"));
    let count = prepare(&workspace::root(), &source)?;
    _ = fs::remove_dir_all(&folder);
    let mut build = Command::new(mdbook);
    build.arg("build").arg(&source).arg("--dest-dir").arg(&folder);
    let line = describe(&build);
    let built = build.output().map_err(|error| format!("cannot start `{line}`: {error}"))?;
    let told = String::from_utf8_lossy(&built.stderr);
    let faults: Vec<_> =
        told.lines().filter(|line| line.contains("WARN") || line.contains("ERROR")).collect();
    if !built.status.success() || !faults.is_empty() {
        return Err(format!("`{line}` ({}):\n{}", built.status, faults.join("\n")));
    }
    let dead = links::dead(&folder)?;
    if !dead.is_empty() {
        return Err(format!("links that lead nowhere:\n  {}", dead.join("\n  ")));
    }
    println!("{count} chapters; open {}", folder.join("index.html").display());
    Ok(())
}

/// Writes what mdBook reads: the number of chapters.
fn prepare(root: &Path, source: &Path) -> Result<usize, String> {
    _ = fs::remove_dir_all(source);
    let read = |path: &str| {
        fs::read_to_string(root.join(path)).map_err(|error| format!("cannot read {path}: {error}"))
    };
    let summary = format!("{DOCS}/SUMMARY.md");
    let mut chapters: BTreeSet<String> = page::linked(&read(&summary)?, &summary).into_iter().collect();
    let count = chapters.len();
    chapters.insert(summary);
    let mut files = BTreeSet::from(SETTINGS.map(str::to_owned));
    for chapter in &chapters {
        let exists = |path: &str| root.join(path).is_file();
        let made = page::make(&read(chapter)?, chapter, &chapters, &exists);
        let Page { text, files: shown } = made.map_err(|message| format!("{chapter}: {message}"))?;
        write(&source.join(page::place(chapter)), text.as_bytes())?;
        files.extend(shown);
    }
    for file in files {
        let bytes = fs::read(root.join(&file)).map_err(|error| format!("cannot read {file}: {error}"))?;
        write(&source.join(page::place(&file)), &bytes)?;
    }
    Ok(count)
}

fn write(path: &Path, bytes: &[u8]) -> Outcome {
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    let written = folder.and_then(|()| fs::write(path, bytes));
    written.map_err(|error| format!("cannot write {}: {error}", path.display()))
}
