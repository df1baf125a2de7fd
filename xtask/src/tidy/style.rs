//! A budget of comments in an older style, which can only shrink.
//!
//! A comment begins with a noun that names the thing, and its sentences are short. Comments from before that rule are
//! many, so the crates' sources have a budget of each kind instead of none: a change must not add to it.

use super::Problem;

/// The most words of a sentence.
const MAX_WORDS: usize = 30;

/// One crate's budget.
struct Budget {
    /// The folder below `crates/`.
    folder: &'static str,
    /// Lines of comments that begin with the word "What".
    whats: usize,
    /// Sentences of documentation with more than [`MAX_WORDS`] words.
    long: usize,
}

/// All budgets: numbers go down only. A crate that is not listed has none.
const BUDGETS: &[Budget] =
    &[Budget { folder: "math", whats: 8, long: 21 }, Budget { folder: "texture", whats: 16, long: 52 }];

/// A search that returns the lines of what it finds in a file's text.
type Find = fn(&str) -> Vec<usize>;

/// Compares the crates' sources, given as (file, text), with their budgets. The notes tell which budgets can shrink.
pub(super) fn check(sources: &[(String, String)]) -> (Vec<Problem>, Vec<String>) {
    compare(sources, BUDGETS)
}

fn compare(sources: &[(String, String)], budgets: &[Budget]) -> (Vec<Problem>, Vec<String>) {
    let mut folders: Vec<&str> = sources.iter().filter_map(|(file, _)| crate_of(file)).collect();
    folders.extend(budgets.iter().map(|budget| budget.folder));
    folders.sort_unstable();
    folders.dedup();
    let (mut problems, mut notes) = (Vec::new(), Vec::new());
    for folder in folders {
        let budget = budgets.iter().find(|budget| budget.folder == folder);
        let (whats, long) = budget.map_or((0, 0), |budget| (budget.whats, budget.long));
        let kinds: [(&str, Find, usize); 2] = [
            ("comments begin with “What” instead of a noun", lines_with_what, whats),
            ("sentences of documentation have more than 30 words", long_sentences, long),
        ];
        for (kind, find, most) in kinds {
            let of_crate = sources.iter().filter(|(file, _)| crate_of(file) == Some(folder));
            let places: Vec<String> = of_crate
                .flat_map(|(file, text)| {
                    find(text).into_iter().map(move |line| format!("\n    {file}:{line}"))
                })
                .collect();
            let count = places.len();
            if count > most {
                let message =
                    format!("{count} {kind}, {most} are the budget of this crate:{}", places.concat());
                problems.push(Problem::new(&format!("crates/{folder}/src"), 1, message));
            } else if count < most {
                notes.push(format!(
                    "crates/{folder}: {count} {kind}; lower the budget of {most} in tidy/style.rs"
                ));
            }
        }
    }
    (problems, notes)
}

/// The folder of a crate's source file.
fn crate_of(file: &str) -> Option<&str> {
    let (folder, path) = file.strip_prefix("crates/")?.split_once('/')?;
    (path.starts_with("src/") && path.ends_with(".rs")).then_some(folder)
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
    fn a_budget_is_kept_and_can_shrink() {
        let budgets = [Budget { folder: "math", whats: 2, long: 0 }];
        let source =
            |count: usize| vec![("crates/math/src/a.rs".to_string(), "// What a is.\n".repeat(count))];
        let (problems, notes) = compare(&source(2), &budgets);
        assert_eq!((problems.len(), notes.len()), (0, 0));
        let (problems, _) = compare(&source(3), &budgets);
        let message = problems[0].to_string();
        assert!(message.starts_with("crates/math/src:1: 3 comments begin"), "{message}");
        assert!(message.ends_with("\n    crates/math/src/a.rs:3"), "{message}");
        let (problems, notes) = compare(&source(1), &budgets);
        assert!(problems.is_empty() && notes[0].contains("lower the budget of 2"), "{notes:?}");
    }

    #[test]
    fn only_sources_of_crates_count() {
        for file in ["crates/math/tests/a.rs", "xtask/src/a.rs", "crates/math/src/a.md"] {
            let (problems, _) = compare(&[(file.into(), "// What a is.\n".into())], &[]);
            assert!(problems.is_empty(), "{file}");
        }
        assert_eq!(compare(&[("crates/new/src/a.rs".into(), "// What a is.\n".into())], &[]).0.len(), 1);
    }
}
