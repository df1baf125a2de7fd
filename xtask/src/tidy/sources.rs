//! Rules on the lines of source files and READMEs. Whatever a lint of rustc or clippy finds is left to it.

use super::Problem;
use crate::workspace::LIBRARIES;

/// The style asks for 150 to 400 lines; beyond this a file holds more than one idea.
const MAX_LINES: usize = 500;

/// The columns of a line.
const MAX_WIDTH: usize = 120;

/// Documents that `cargo xtask` writes.
const GENERATED: [&str; 2] = ["docs/accuracy.md", "docs/gallery.md"];

/// Words of unfinished work, also in comments; in two halves, because this file is checked too.
const UNFINISHED: [&str; 1] = [concat!("FIX", "ME")];

/// Checks one Rust file, or one Markdown file, whose examples are Rust.
pub(super) fn check(file: &str, text: &str) -> Vec<Problem> {
    let is_rust = file.ends_with(".rs");
    let is_library = is_rust && is_library_source(file);
    let mut problems = Vec::new();
    let mut previous = "";
    for (index, line) in text.lines().enumerate() {
        let mut rules = vec![skipped_example(line)];
        if is_rust {
            rules.extend([wide_comment(line), skipped_test(line), unfinished(line)]);
        } else if !GENERATED.contains(&file) {
            rules.push(wide_prose(line));
        }
        if is_library {
            rules.push(linked(previous, line));
        }
        problems.extend(rules.into_iter().flatten().map(|message| Problem::new(file, index + 1, message)));
        previous = line;
    }
    let lines = text.lines().count();
    if is_rust && lines > MAX_LINES {
        let message = format!("{lines} lines; {MAX_LINES} are the most: split the file");
        problems.push(Problem::new(file, lines, message));
    }
    if is_library && file.ends_with("src/lib.rs") && !text.lines().any(|line| line.trim() == "#![no_std]") {
        problems.push(Problem::new(file, 1, "`#![no_std]` is missing in a library crate"));
    }
    problems
}

/// Whether `file` is part of a `no_std` library rather than of its tests or of a program.
fn is_library_source(file: &str) -> bool {
    let Some((folder, path)) = file.strip_prefix("crates/").and_then(|rest| rest.split_once('/')) else {
        return false;
    };
    LIBRARIES.iter().any(|library| library.folder == folder) && path.starts_with("src/")
}

/// rustfmt does not wrap comments. Tables cannot be wrapped.
fn wide_comment(line: &str) -> Option<String> {
    let comment = line.trim_start();
    let table = comment.trim_start_matches(['/', '!']).trim_start().starts_with('|');
    let width = line.chars().count();
    let found = comment.starts_with("//") && !table && width > MAX_WIDTH;
    found.then(|| format!("a comment of {width} columns; {MAX_WIDTH} are the most"))
}

/// Prose beside tables, pictures and blocks of code, which cannot be wrapped, nor can what a program writes.
fn wide_prose(line: &str) -> Option<String> {
    let width = line.chars().count();
    let found = width > MAX_WIDTH && !line.starts_with(['|', '!']) && !line.starts_with("    ");
    found.then(|| format!("a line of {width} columns; {MAX_WIDTH} are the most"))
}

/// An example that is not compiled drifts from the code that it explains.
fn skipped_example(line: &str) -> Option<String> {
    let comment = line.trim_start().trim_start_matches(['/', '!']).trim_start();
    let words = comment.strip_prefix("```")?;
    words.split(',').any(|word| word.trim() == "ignore").then(|| "an example that is not compiled".into())
}

fn skipped_test(line: &str) -> Option<String> {
    let found = line.trim_start().starts_with("#[ignore");
    found.then(|| "a test that does not run: repair or delete it".into())
}

fn unfinished(line: &str) -> Option<String> {
    let mut words = line.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    let found = words.any(|word| UNFINISHED.contains(&word));
    found.then(|| "a note of unfinished work: do the work or file an issue".into())
}

/// The promise of a library to need neither std nor an allocator. Without this line no path into these crates compiles,
/// and `cargo xtask nostd` compiles every library with the features off that could bring it in.
fn linked(previous: &str, line: &str) -> Option<String> {
    let name = ["std", "alloc"].into_iter().find(|name| {
        let words = line.trim().trim_start_matches("pub ");
        words
            .strip_prefix("extern crate ")
            .and_then(|rest| rest.strip_prefix(*name))
            .is_some_and(|rest| rest.starts_with([';', ' ']))
    })?;
    let gate = previous.trim();
    let gated = gate.starts_with("#[cfg(") && (gate.contains("test") || gate.contains("\"std\""));
    (!gated || gate.contains("not(")).then(|| {
        format!(
            "`{name}` in a library crate: a line above, `#[cfg(…)]` must name `test` or the feature `std`"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(file: &str, text: &str) -> Vec<String> {
        check(file, text).iter().map(Problem::to_string).collect()
    }

    const NONE: [String; 0] = [];
    const RASTER: &str = "crates/raster/src/edge.rs";

    #[test]
    fn wide_comments_are_found_and_tables_are_not() {
        let wide = "x".repeat(118);
        assert_eq!(
            found("a.rs", &format!("// short\n    // {wide}\n/// | {wide} |\n")),
            ["a.rs:2: a comment of 125 columns; 120 are the most"]
        );
    }

    #[test]
    fn wide_prose_is_found_and_tables_are_not() {
        let wide = "x".repeat(118);
        assert_eq!(
            found("a.md", &format!("a b\nab {wide}\n| {wide} |\n    {wide}\n")),
            ["a.md:2: a line of 121 columns; 120 are the most"]
        );
    }

    #[test]
    fn unfinished_work_is_found_with_its_line() {
        let ignored = "#[test]\n    #[ignore = \"slow\"]\nfn a() {}\n";
        assert_eq!(found("a.rs", ignored), ["a.rs:2: a test that does not run: repair or delete it"]);
        let note = format!("\n// {}: later\n", UNFINISHED[0]);
        assert_eq!(found("a.rs", &note), ["a.rs:2: a note of unfinished work: do the work or file an issue"]);
        assert_eq!(found("a.rs", &format!("// {}S\n", UNFINISHED[0])), NONE);
    }

    #[test]
    fn a_long_file_is_found() {
        assert_eq!(found("a.rs", &"\n".repeat(MAX_LINES)), NONE);
        assert_eq!(found("a.rs", &"\n".repeat(MAX_LINES + 1)).len(), 1);
        assert_eq!(found("a.md", &"\n".repeat(MAX_LINES + 1)), NONE);
    }

    #[test]
    fn an_example_that_is_skipped_is_found() {
        let fence = "```";
        assert_eq!(
            found("a.md", &format!("a\n{fence}ignore\n{fence}\n")),
            ["a.md:2: an example that is not compiled"]
        );
        assert_eq!(found("a.rs", &format!("/// {fence}rust,ignore\n")).len(), 1);
        assert_eq!(found("a.md", &format!("{fence}text\nignore\n{fence}\n")), NONE);
    }

    #[test]
    fn a_library_is_no_std() {
        assert_eq!(
            found("crates/math/src/lib.rs", "mod a;"),
            ["crates/math/src/lib.rs:1: `#![no_std]` is missing in a library crate"]
        );
        assert_eq!(found("crates/math/src/lib.rs", "#![no_std]\n"), NONE);
    }

    #[test]
    fn a_library_links_std_for_tests_and_its_feature_only() {
        let message =
            "`alloc` in a library crate: a line above, `#[cfg(…)]` must name `test` or the feature `std`";
        assert_eq!(found(RASTER, "\nextern crate alloc;"), [format!("{RASTER}:2: {message}")]);
        assert_eq!(found(RASTER, "pub extern crate std as s;").len(), 1);
        assert_eq!(found(RASTER, "#[cfg(not(test))]\nextern crate std;\n").len(), 1);
        assert_eq!(found(RASTER, "#[cfg(test)]\nextern crate std;\n"), NONE);
        assert_eq!(found(RASTER, "#[cfg(any(test, feature = \"std\"))]\nextern crate std;\n"), NONE);
        assert_eq!(found("crates/app/src/main.rs", "extern crate std;"), NONE);
    }
}
