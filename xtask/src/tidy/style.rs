//! The style of the crates' comments: each begins with a noun that names the thing, and its sentences are short.

use super::Problem;

/// The most words of a sentence.
const MAX_WORDS: usize = 30;

/// A search that returns the lines of what it finds in a file's text.
type Find = fn(&str) -> Vec<usize>;

/// The rules, and the searches for what breaks them.
const RULES: [(&str, Find); 2] = [
    ("a comment begins with “What” instead of a noun", lines_with_what),
    ("a sentence of documentation has more than 30 words", long_sentences),
];

/// The faults of a file, if it is a source of a crate.
pub(super) fn check(file: &str, text: &str) -> Vec<Problem> {
    let rules = RULES.iter().filter(|_| is_of_crate(file));
    let found = rules.flat_map(|(rule, find)| find(text).into_iter().map(move |line| (rule, line)));
    found.map(|(rule, line)| Problem::new(file, line, (*rule).to_string())).collect()
}

/// Whether a file is a source of a crate.
fn is_of_crate(file: &str) -> bool {
    let path = file.strip_prefix("crates/").and_then(|path| path.split_once('/'));
    path.is_some_and(|(_, path)| path.starts_with("src/") && path.ends_with(".rs"))
}

/// The lines of comments that begin with a clause in the place of a name.
fn lines_with_what(text: &str) -> Vec<usize> {
    let comments = (1..).zip(text.lines().map(str::trim_start)).filter(|(_, line)| line.starts_with("//"));
    let found = comments.filter(|(_, line)| line.trim_start_matches(['/', '!', ' ']).starts_with("What "));
    found.map(|(number, _)| number).collect()
}

/// The lines in which sentences of documentation begin that are too long. Code, tables and headings are no sentences.
fn long_sentences(text: &str) -> Vec<usize> {
    let mut found = Vec::new();
    let mut sentence = Sentence::default();
    let mut in_code = false;
    for (number, line) in (1..).zip(text.lines().map(str::trim_start)) {
        let Some(line) = line.strip_prefix("///").or_else(|| line.strip_prefix("//!")) else {
            found.extend(sentence.end());
            in_code = false;
            continue;
        };
        let words = line.trim_start();
        let fence = words.starts_with("```");
        if in_code || fence || words.is_empty() || words.starts_with(['|', '#']) {
            found.extend(sentence.end());
            in_code ^= fence;
            continue;
        }
        // An item of a list begins a sentence, after its mark.
        let mark = words.split_whitespace().next().unwrap_or_default();
        let numbered = mark.strip_suffix('.').is_some_and(|n| n.bytes().all(|byte| byte.is_ascii_digit()));
        if matches!(mark, "*" | "-") || numbered {
            found.extend(sentence.end());
        }
        let skipped = usize::from(numbered);
        for word in words.split_whitespace().skip(skipped).filter(|word| word.contains(char::is_alphanumeric))
        {
            sentence.add(number);
            if word.trim_end_matches([')', '"', '”', '*', '_']).ends_with(['.', '?', '!']) {
                found.extend(sentence.end());
            }
        }
    }
    found.extend(sentence.end());
    found
}

/// The sentence that is being read.
#[derive(Default)]
struct Sentence {
    line: usize,
    words: usize,
}

impl Sentence {
    fn add(&mut self, line: usize) {
        if self.words == 0 {
            self.line = line;
        }
        self.words += 1;
    }

    /// Ends the sentence, and gives its first line if it was too long.
    fn end(&mut self) -> Option<usize> {
        let Sentence { line, words } = std::mem::take(self);
        (words > MAX_WORDS).then_some(line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: [usize; 0] = [];

    /// A sentence of so many words.
    fn words(count: usize) -> String {
        format!("{}word.", "word ".repeat(count - 1))
    }

    #[test]
    fn clauses_in_the_place_of_names_are_found() {
        let text = "//! What a is.\n/// A name.\n    // What b is.\nlet a = \"// What\";\n/// Whatever.\n";
        assert_eq!(lines_with_what(text), [1, 3]);
    }

    #[test]
    fn long_sentences_are_found_where_they_begin() {
        let (short, long) = (words(MAX_WORDS), words(MAX_WORDS + 1));
        assert_eq!(long_sentences(&format!("/// {short}\n/// {short} {short}\n")), NONE);
        assert_eq!(long_sentences(&format!("/// {short}\n/// {long}\n//! {long}")), [2, 3]);
        let broken = long.replacen(" word", "\n/// word", 1);
        assert_eq!(long_sentences(&format!("/// {broken}\nfn a() {{}}\n// {long}\n")), [1]);
    }

    #[test]
    fn code_tables_and_lists_are_no_long_sentences() {
        let many = "word ".repeat(MAX_WORDS);
        let fence = "```";
        assert_eq!(
            long_sentences(&format!("/// {fence}\n/// {many} word\n/// {fence}\n/// | {many} |\n")),
            NONE
        );
        assert_eq!(long_sentences(&format!("/// 1. {many}\n/// * {many}\n/// # {many}\n")), NONE);
    }

    #[test]
    fn only_sources_of_crates_count() {
        let text = "// A name.\n// What a is.\n";
        for file in ["crates/math/tests/a.rs", "xtask/src/a.rs", "crates/math/src/a.md"] {
            assert!(check(file, text).is_empty(), "{file}");
        }
        let problems = check("crates/new/src/a.rs", text);
        let message = problems[0].to_string();
        assert!(
            problems.len() == 1 && message.starts_with("crates/new/src/a.rs:2: a comment begins"),
            "{message}"
        );
    }
}
