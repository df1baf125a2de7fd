//! One bug: the lines before its patch, and the results of its test.

use crate::workspace::{self, LIBRARIES};

/// A patch, and the test that fails with it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Bug {
    /// The file's name without its end: a number, and words.
    pub(super) name: String,
    /// What is wrong.
    pub(super) about: String,
    pub(super) package: String,
    /// The flags of cargo that say which of the package's tests are compiled.
    pub(super) target: Vec<String>,
    /// The path of the test.
    pub(super) filter: String,
    /// The files that are changed.
    pub(super) files: Vec<String>,
}

impl Bug {
    /// Reads a file with this name and text.
    pub(super) fn read(file: &str, text: &str) -> Result<Self, String> {
        let name = file.strip_suffix(".patch").ok_or("the name does not end with `.patch`")?;
        let numbered = name.split_once('-').is_some_and(|(number, words)| {
            number.len() == 2 && number.bytes().all(|c| c.is_ascii_digit()) && !words.is_empty()
        });
        if !numbered {
            return Err("the name does not begin with a number of two digits and `-`".into());
        }
        let mut lines = text.lines();
        let test = lines.next().and_then(|line| line.strip_prefix("# test: "));
        let about = lines.next().and_then(|line| line.strip_prefix("# bug: "));
        let (Some(test), Some(about)) = (test, about) else {
            return Err("the first lines are not `# test: ` and `# bug: `".into());
        };
        let words: Vec<&str> = test.split_whitespace().collect();
        let [package, target @ .., filter] = &words[..] else {
            return Err("expected `PACKAGE --lib TEST`".into());
        };
        if !matches!(target, ["--lib"] | ["--test", _] | ["--features", _, "--lib"]) {
            return Err("expected `--lib`, `--features FEATURES --lib` or `--test NAME`".into());
        }
        if place(package).is_none() {
            return Err(format!("`{package}` is no library, nor the package of tests"));
        }
        if about.trim().is_empty() || !about.ends_with('.') {
            return Err("the bug is not told in a sentence".into());
        }
        let files: Vec<String> =
            text.lines().filter_map(|line| line.strip_prefix("+++ b/")).map(str::to_owned).collect();
        if files.is_empty() || !files.iter().all(|file| is_of_library(file)) {
            return Err("not a patch of sources of libraries alone".into());
        }
        Ok(Self {
            name: name.into(),
            about: about.into(),
            package: (*package).into(),
            target: target.iter().map(|&word| word.to_owned()).collect(),
            filter: (*filter).into(),
            files,
        })
    }

    /// Whether this is its name, with its number or without.
    pub(super) fn is_called(&self, name: &str) -> bool {
        self.name == name || self.name.split_once('-').is_some_and(|(_, words)| words == name)
    }

    /// The number of its package, in the order in which they are compiled.
    pub(super) fn place(&self) -> Option<usize> {
        place(&self.package)
    }

    /// The name of the test's function.
    pub(super) fn function(&self) -> &str {
        self.filter.rsplit("::").next().unwrap_or_default()
    }
}

/// The number of a package whose tests may catch bugs.
fn place(package: &str) -> Option<usize> {
    LIBRARIES
        .iter()
        .map(|library| library.package)
        .chain([workspace::TESTS])
        .position(|known| known == package)
}

fn is_of_library(file: &str) -> bool {
    LIBRARIES.iter().any(|library| file.starts_with(&format!("crates/{}/src/", library.folder)))
}

/// The results that a run of tests printed, together.
#[derive(Debug, PartialEq, Eq, Default)]
pub(super) struct Results {
    pub(super) passed: usize,
    pub(super) failed: usize,
}

impl Results {
    /// Reads the lines `test result: `; `None` if there is none, as when something did not compile.
    pub(super) fn read(printed: &str) -> Option<Self> {
        let mut sum = None;
        for line in printed.lines().filter_map(|line| line.strip_prefix("test result: ")) {
            let count = |what: &str| -> Option<usize> {
                let (number, _) = line.split_once(what)?;
                number.rsplit([' ', '.']).next()?.parse().ok()
            };
            let all: &mut Self = sum.get_or_insert_default();
            all.passed += count(" passed;")?;
            all.failed += count(" failed;")?;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIFF: &str =
        "--- a/crates/math/src/round.rs\n+++ b/crates/math/src/round.rs\n@@ -1 +1 @@\n-a\n+b\n";

    fn read(test: &str, diff: &str) -> Result<Bug, String> {
        Bug::read("07-half.patch", &format!("# test: {test}\n# bug: Halves go down.\n{diff}"))
    }

    #[test]
    fn headers_name_a_test_and_a_bug() {
        let bug = read("alberti-math --lib round::tests::all", DIFF).unwrap();
        assert_eq!((bug.name.as_str(), bug.about.as_str()), ("07-half", "Halves go down."));
        assert_eq!((bug.package.as_str(), bug.filter.as_str()), ("alberti-math", "round::tests::all"));
        assert_eq!(
            (bug.target.join(" "), bug.files.join(" ")),
            ("--lib".into(), "crates/math/src/round.rs".into())
        );
        assert_eq!((bug.function(), bug.place()), ("all", Some(0)));
        assert!(bug.is_called("half") && bug.is_called("07-half") && !bug.is_called("07"));
        let bug = read("alberti-raster --features alberti-math/simd --lib a", DIFF).unwrap();
        assert_eq!(bug.target.join(" "), "--features alberti-math/simd --lib");
        let bug = read("alberti-tests --test pipeline coverage::all", DIFF).unwrap();
        assert_eq!((bug.target.join(" "), bug.place()), ("--test pipeline".into(), Some(LIBRARIES.len())));
    }

    #[test]
    fn other_headers_are_refused() {
        for test in [
            "",
            "alberti-math",
            "alberti-math --lib",
            "alberti-app --lib a",
            "alberti-math --bin a b",
            "alberti-math --features a b",
        ] {
            assert!(read(test, DIFF).is_err(), "{test}");
        }
        assert!(read("alberti-math --lib a", "").is_err());
        assert!(read("alberti-math --lib a", &DIFF.replace("math", "app")).is_err());
        assert!(read("alberti-math --lib a", &DIFF.replace("/src/", "/tests/")).is_err());
        let good = format!("# test: alberti-math --lib a\n# bug: B.\n{DIFF}");
        assert!(Bug::read("07-a.patch", &good).is_ok());
        for name in ["07-a.diff", "7-a.patch", "07.patch", "a-b.patch", "07-.patch"] {
            assert!(Bug::read(name, &good).is_err(), "{name}");
        }
        for text in [
            DIFF.to_owned(),
            good.replace("# bug", "# about"),
            good.replace("B.", "B"),
            good.replace("B.", ""),
        ] {
            assert!(Bug::read("07-a.patch", &text).is_err(), "{text}");
        }
    }

    #[test]
    fn results_are_added() {
        let ok =
            "test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; 9 filtered out; finished in 0.01s\n";
        let bad = "\ntest result: FAILED. 10 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out\n";
        assert_eq!(Results::read(ok), Some(Results { passed: 3, failed: 0 }));
        assert_eq!(Results::read(&format!("{ok}{bad}")), Some(Results { passed: 13, failed: 2 }));
        let none = ok.replace('3', "0");
        assert_eq!(Results::read(&none), Some(Results::default()));
    }

    #[test]
    fn what_did_not_compile_has_no_results() {
        assert_eq!(Results::read("error: could not compile `a` (lib test) due to 1 previous error\n"), None);
        assert_eq!(Results::read("the test result: none\n"), None);
        assert_eq!(Results::read("test result: ok. many passed; no failed;\n"), None);
    }
}
