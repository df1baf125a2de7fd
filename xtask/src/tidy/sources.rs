//! What stands in the source files and the READMEs.

use super::Problem;
use super::lexer::{code_only, line_of, without_gated_items, words};
use crate::workspace::LIBRARIES;

/// The style asks for 150 to 400 lines; beyond this a file holds more than one idea.
const MAX_LINES: usize = 500;

/// The columns of a line.
const MAX_WIDTH: usize = 120;

/// Checks one Rust file, or one Markdown file, whose examples are Rust.
pub(super) fn check(file: &str, text: &str) -> Vec<Problem> {
    let mut problems = Vec::new();
    skipped_examples(file, text, &mut problems);
    if !file.ends_with(".rs") {
        return problems;
    }
    size(file, text, &mut problems);
    wide_comments(file, text, &mut problems);
    let code = code_only(text);
    unfinished(file, text, &code, &mut problems);
    if is_library_source(file) {
        library(file, text, &code, &mut problems);
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

fn size(file: &str, text: &str, problems: &mut Vec<Problem>) {
    let lines = text.lines().count();
    if lines > MAX_LINES {
        problems.push(Problem::new(
            file,
            lines,
            format!("{lines} lines; {MAX_LINES} are the most: split the file"),
        ));
    }
}

/// rustfmt does not wrap comments. Tables cannot be wrapped.
fn wide_comments(file: &str, text: &str, problems: &mut Vec<Problem>) {
    for (index, line) in text.lines().enumerate() {
        let comment = line.trim_start();
        let table = comment.trim_start_matches(['/', '!']).trim_start().starts_with('|');
        let width = line.chars().count();
        if comment.starts_with("//") && !table && width > MAX_WIDTH {
            let told = format!("a comment of {width} columns; {MAX_WIDTH} are the most");
            problems.push(Problem::new(file, index + 1, told));
        }
    }
}

/// An example that is not compiled drifts from the code that it explains.
fn skipped_examples(file: &str, text: &str, problems: &mut Vec<Problem>) {
    for (index, line) in text.lines().enumerate() {
        let comment = line.trim_start().trim_start_matches(['/', '!']).trim_start();
        let Some(info) = comment.strip_prefix("```") else { continue };
        if info.split(',').any(|word| word.trim() == "ignore") {
            problems.push(Problem::new(file, index + 1, "an example that is not compiled"));
        }
    }
}

/// Nothing that is unfinished, switched off or left over from debugging.
fn unfinished(file: &str, text: &str, code: &str, problems: &mut Vec<Problem>) {
    for name in ["todo", "unimplemented", "dbg"] {
        for at in words(code, name).filter(|&at| code[at + name.len()..].starts_with('!')) {
            problems.push(Problem::new(file, line_of(text, at), format!("`{name}!` is left in the source")));
        }
    }
    for at in words(code, "ignore").filter(|&at| code[..at].trim_end().ends_with("#[")) {
        problems.push(Problem::new(file, line_of(text, at), "a test that does not run: repair or delete it"));
    }
    // In comments as well, so in the text; spelt in two halves, because this file is checked too.
    for at in words(text, concat!("FIX", "ME")) {
        problems.push(Problem::new(
            file,
            line_of(text, at),
            "a note of unfinished work: do the work or file an issue",
        ));
    }
}

/// The promises of a library crate: no std, no allocation, no `unsafe`.
fn library(file: &str, text: &str, code: &str, problems: &mut Vec<Problem>) {
    if file.ends_with("src/lib.rs") && !code.lines().any(|line| line.trim() == "#![no_std]") {
        problems.push(Problem::new(file, 1, "`#![no_std]` is missing in a library crate"));
    }
    for at in words(code, "unsafe") {
        problems.push(Problem::new(file, line_of(text, at), "`unsafe` in a library crate"));
    }
    // A file of its own for a module's tests; the module is declared under `cfg(test)` elsewhere.
    let is_test = file.ends_with("tests.rs") || file.contains("/tests/");
    if is_test {
        return;
    }
    let shipped = without_gated_items(text, code);
    for name in ["std", "alloc"] {
        for at in words(&shipped, name) {
            let (before, after) = (shipped[..at].trim_end(), shipped[at + name.len()..].trim_start());
            let linked = before.ends_with("extern crate");
            // `core::alloc` and a module of that name are other things than the crate.
            let inner =
                before.strip_suffix("::").is_some_and(|path| path.ends_with(|c: char| c.is_alphanumeric()));
            if linked || (after.starts_with("::") && !inner) {
                problems.push(Problem::new(file, line_of(text, at), format!("`{name}` in a library crate")));
            }
        }
    }
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
    fn unfinished_work_is_found_with_its_line() {
        assert_eq!(found("a.rs", "fn a() {\n    todo!()\n}\n"), ["a.rs:2: `todo!` is left in the source"]);
        assert_eq!(found("a.rs", "dbg!(1);"), ["a.rs:1: `dbg!` is left in the source"]);
        let ignored = "#[test]\n#[ignore = \"slow\"]\nfn a() {}\n";
        assert_eq!(found("a.rs", ignored), ["a.rs:2: a test that does not run: repair or delete it"]);
        let note = format!("\n// {}: later\n", concat!("FIX", "ME"));
        assert_eq!(found("a.rs", &note).len(), 1);
    }

    #[test]
    fn words_in_comments_and_strings_are_no_code() {
        assert_eq!(found(RASTER, "// todo! unsafe std::vec\nconst A: &str = \"dbg!(std::x)\";\n"), NONE);
    }

    #[test]
    fn a_long_file_is_found() {
        assert_eq!(found("a.rs", &"\n".repeat(MAX_LINES)), NONE);
        assert_eq!(found("a.rs", &"\n".repeat(MAX_LINES + 1)).len(), 1);
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
    fn a_library_keeps_its_promises() {
        assert_eq!(
            found("crates/math/src/lib.rs", "mod a;"),
            ["crates/math/src/lib.rs:1: `#![no_std]` is missing in a library crate"]
        );
        assert_eq!(found("crates/math/src/lib.rs", "#![no_std]\n#![forbid(unsafe_code)]\n"), NONE);
        assert_eq!(
            found(RASTER, "\nunsafe {}"),
            ["crates/raster/src/edge.rs:2: `unsafe` in a library crate"]
        );
        assert_eq!(found(RASTER, "use std::vec;"), ["crates/raster/src/edge.rs:1: `std` in a library crate"]);
        assert_eq!(
            found(RASTER, "extern crate alloc;"),
            ["crates/raster/src/edge.rs:1: `alloc` in a library crate"]
        );
        assert_eq!(found(RASTER, "use core::alloc::Layout;"), NONE);
        assert_eq!(found(RASTER, "let a = ::std::f32::consts::PI;").len(), 1);
    }

    #[test]
    fn tests_and_the_std_feature_may_use_std() {
        assert_eq!(found(RASTER, "#[cfg(test)]\nmod tests {\n    use std::vec;\n}\n"), NONE);
        assert_eq!(found(RASTER, "#[cfg(any(test, feature = \"std\"))]\nextern crate std;\n"), NONE);
        assert_eq!(found(RASTER, "#[cfg(not(test))]\nextern crate std;\n").len(), 1);
        assert_eq!(found("crates/raster/src/edge_tests.rs", "use std::vec;"), NONE);
    }

    #[test]
    fn programs_may_use_std() {
        assert_eq!(found("crates/app/src/main.rs", "use std::fs;"), NONE);
        assert_eq!(found("xtask/src/main.rs", "use std::fs;"), NONE);
    }
}
