//! Long checks that have passed on the very files that they read, by which compilers: these need no second run.

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

use crate::command::{Outcome, output};
use crate::embedded::DEBIAN_RUSTC;
use crate::{tidy, workspace};

/// The file with a line for each long check: its name, and the digest of what it passed on.
pub(super) const PLACE: &str = ".ci/passed";

/// The manifest of the workspace.
const MANIFEST: &str = "Cargo.toml";

/// What is drawn with, but for its tests, see [`without_tests`].
const LIBRARIES: &[&str] =
    &[MANIFEST, "crates/alberti/", "crates/math/", "crates/projection/", "crates/raster/", "crates/texture/"];
/// What each program for chips depends on, beside these.
const CHIPS: &[&str] = &[
    "docs/firmware",
    "docs/pictures/demo.gif",
    "tests/firmware/",
    "xtask/src/boards",
    "xtask/src/command.rs",
    "xtask/src/elf.rs",
    "xtask/src/embedded.rs",
    "xtask/src/firmware",
    "xtask/src/wasm.rs",
    "xtask/src/workspace.rs",
];
/// The same with the app, and what measures it.
const TOOLS: &[&str] = &[
    "Cargo.lock",
    "crates/app/",
    "docs/trade",
    "tests/",
    "xtask/src/fuzz.rs",
    "xtask/src/guide",
    "xtask/src/trade.rs",
];

/// The checks that may stand, and the beginnings of the names of the files that they read.
const LONG: [(&str, &[&[&str]]); 10] = [
    ("firmware", &[LIBRARIES, CHIPS]),
    ("boards", &[LIBRARIES, CHIPS]),
    ("fingerprint", &[LIBRARIES, CHIPS]),
    ("web", &[LIBRARIES, &["crates/web/", "docs/theory.md", "xtask/src/formulas.rs", "xtask/src/web"]]),
    (
        "book",
        &[&[
            "ARCHITECTURE.md",
            "CHANGELOG.md",
            "CONTRIBUTING.md",
            "CONVENTIONS.md",
            "README.md",
            "SECURITY.md",
            "crates/",
            "docs/",
            "xtask/src/book",
            "xtask/src/formulas.rs",
            "xtask/src/tool.rs",
        ]],
    ),
    (
        "bench",
        &[
            LIBRARIES,
            CHIPS,
            &["Cargo.lock", "benches/", "crates/app/", "docs/benchmarks.md", "xtask/src/bench"],
        ],
    ),
    ("trade", &[LIBRARIES, CHIPS, TOOLS]),
    ("guide", &[LIBRARIES, CHIPS, TOOLS]),
    ("fuzz", &[LIBRARIES, CHIPS, TOOLS]),
    // It compiles the libraries' tests as well.
    (
        "supply",
        &[&[MANIFEST, "crates/", "deny.toml", "benches/Cargo.toml", "xtask/src/supply.rs"], CHIPS, TOOLS],
    ),
];

/// The digests of what the long checks read now, and those of when they passed last.
pub(super) struct Passed {
    now: BTreeMap<&'static str, u64>,
    then: BTreeMap<String, u64>,
}

impl Passed {
    /// Reads the files.
    pub(super) fn read() -> Result<Self, String> {
        let mut compilers = output(Command::new("rustc").current_dir(workspace::root()).arg("-vV"))?;
        // Where there is none, the active one builds for chips.
        compilers += &output(Command::new(DEBIAN_RUSTC).arg("-vV")).unwrap_or_default();
        let files = tidy::tracked_files()?;
        let mut now = BTreeMap::new();
        for (name, groups) in LONG {
            let mut digest = Digest::default();
            digest.add(compilers.as_bytes());
            for file in files.iter().filter(|file| groups.iter().any(|group| reads(group, file))) {
                let path = workspace::root().join(file);
                let read = fs::read(&path);
                let read = read.map_err(|error| format!("cannot read {}: {error}", path.display()))?;
                let is_of_library = !groups.iter().any(|group| *group != LIBRARIES && reads(group, file));
                let all = of_all(&read);
                let counts = match is_of_library {
                    _ if file == MANIFEST => Some(&all[..]),
                    true => without_tests(file, &read),
                    false => Some(&read[..]),
                };
                if let Some(counts) = counts {
                    digest.add(file.as_bytes());
                    digest.add(counts);
                }
            }
            now.insert(name, digest.0);
        }
        // Without the file, or with one of another form, none has passed.
        let text = fs::read_to_string(workspace::root().join(PLACE)).unwrap_or_default();
        Ok(Self { now, then: lines(&text) })
    }

    /// Whether a check has passed on what it reads.
    pub(super) fn stands(&self, name: &str) -> bool {
        self.now.get(name).is_some_and(|now| self.then.get(name) == Some(now))
    }

    /// Keeps that checks have passed now, of which short ones are not kept.
    pub(super) fn keep(&mut self, names: &[String]) -> Outcome {
        let now = names.iter().filter_map(|name| Some((name.clone(), *self.now.get(name.as_str())?)));
        let now: Vec<_> = now.collect();
        if now.is_empty() {
            return Ok(());
        }
        self.then.extend(now);
        let text: String = self.then.iter().map(|(name, digest)| format!("{name} {digest:016x}\n")).collect();
        let path = workspace::root().join(PLACE);
        fs::write(&path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
    }
}

/// Whether a check is long, and may stand.
pub(super) fn is_long(name: &str) -> bool {
    LONG.iter().any(|(long, _)| *long == name)
}

/// A library's file without its tests, which no program but theirs has: a file of tests, and a module at the end.
fn without_tests<'a>(file: &str, read: &'a [u8]) -> Option<&'a [u8]> {
    if file.ends_with("/tests.rs") || file.contains("/tests/") {
        return None;
    }
    // Attributes, and the module's name and what is in it.
    let is_module = |rest: &str| {
        let Some((before, inner)) = rest.split_once("\nmod tests") else { return false };
        let is_block = inner.starts_with(" {\n") && inner.find("\n}\n").map(|at| at + 3) == Some(inner.len());
        before.lines().all(|line| !line.starts_with(char::is_alphabetic)) && (inner == ";\n" || is_block)
    };
    let text = str::from_utf8(read).unwrap_or_default();
    let module = text.rfind("\n#[cfg(test)]\n").filter(|&at| is_module(&text[at..]));
    Some(module.map_or(read, |at| &read[..at]))
}

/// The workspace's manifest without its comments, and without how much single packages are optimised: those are of the
/// application, and no bit of a picture depends on it.
fn of_all(manifest: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(manifest);
    let is_of_one = |table: &str| table.starts_with("[profile.") && table.contains(".package.");
    let mut left_out = false;
    let mut kept = String::new();
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if line.starts_with('[') {
            left_out = is_of_one(line);
        }
        if !left_out {
            kept += line;
            kept.push('\n');
        }
    }
    kept.into_bytes()
}

fn reads(group: &[&str], file: &str) -> bool {
    group.iter().any(|beginning| file.starts_with(beginning))
}

/// The lines `NAME DIGEST`.
fn lines(text: &str) -> BTreeMap<String, u64> {
    let line = |line: &str| {
        let (name, digest) = line.split_once(' ')?;
        Some((name.to_owned(), u64::from_str_radix(digest, 16).ok()?))
    };
    text.lines().filter_map(line).collect()
}

/// A digest by Fowler, Noll and Vo (FNV-1a), of parts with their lengths.
struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Digest {
    fn add(&mut self, part: &[u8]) {
        let length = (part.len() as u64).to_le_bytes();
        for byte in length.iter().chain(part) {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_check_stands_until_what_it_reads_changes() {
        let mut passed =
            Passed { now: [("boards", 7), ("trade", 9)].into(), then: lines("boards 7\ntrade 8\n") };
        assert_eq!(["boards", "trade", "lint"].map(|name| passed.stands(name)), [true, false, false]);
        passed.then = lines("boards\nmore words than these\ntrade x\n");
        assert!(passed.then.is_empty() && !passed.stands("boards"));
    }

    #[test]
    fn every_byte_counts() {
        let of = |parts: &[&str]| {
            let mut digest = Digest::default();
            parts.iter().for_each(|part| digest.add(part.as_bytes()));
            digest.0
        };
        let all = [of(&["ab", "c"]), of(&["a", "bc"]), of(&["abc"]), of(&["ab", "d"]), of(&["ab", ""])];
        assert!(all.iter().enumerate().all(|(i, one)| !all[..i].contains(one)));
    }

    #[test]
    fn a_package_may_be_optimised_more() {
        let of = |text: &str| of_all(text.as_bytes());
        let manifest = "# Members.\n[workspace]\nmembers = []\n\n[profile.release]\nlto = true\n";
        let more = "[profile.release.package.image]\nopt-level = 1\n";
        assert_eq!(of(manifest), of(&format!("{more}{manifest}")));
        assert_eq!(of(manifest), of(&manifest.replace("[profile", &format!("{more}[profile"))));
        assert_eq!(of(manifest), b"[workspace]\nmembers = []\n[profile.release]\nlto = true\n");
    }

    #[test]
    fn tests_of_libraries_are_not_read() {
        let of = |file: &str, text: &'static str| {
            without_tests(file, text.as_bytes()).map(|kept| String::from_utf8_lossy(kept).into_owned())
        };
        let some = |text: &str| Some(text.to_owned());
        const CODE: &str = "mod a;\n#[cfg(test)]\nmod tests;\n\nfn a() {\n}\n";
        assert_eq!(of("crates/raster/src/a.rs", CODE), some(CODE));
        for (text, kept) in [
            ("fn a() {}\n\n#[cfg(test)]\nmod tests {\n    fn b() {}\n}\n", "fn a() {}\n"),
            ("fn a() {}\n\n#[cfg(test)]\n#[expect(x)]\nmod tests;\n", "fn a() {}\n"),
            ("\n#[cfg(test)]\nuse a;\nmod tests;\n", "\n#[cfg(test)]\nuse a;\nmod tests;\n"),
            ("#[cfg(test)]\nfn a() {}\n", "#[cfg(test)]\nfn a() {}\n"),
            (
                "\n#[cfg(test)]\nmod tests {\n}\nfn a() {\n}\n",
                "\n#[cfg(test)]\nmod tests {\n}\nfn a() {\n}\n",
            ),
        ] {
            assert_eq!(of("crates/raster/src/a.rs", text), some(kept), "{text}");
        }
        assert_eq!(of("crates/raster/src/a/tests.rs", CODE), None);
        assert_eq!(of("crates/texture/tests/contract.rs", CODE), None);
    }

    #[test]
    fn long_checks_read_files_that_are_there() {
        let files = tidy::tracked_files().unwrap();
        for beginning in LONG.iter().flat_map(|(_, groups)| groups.iter().copied().flatten()) {
            assert!(files.iter().any(|file| file.starts_with(beginning)), "{beginning}");
        }
    }
}
