//! The one error type of the command: where, what was found, what was expected, what to do. One line.

use std::fmt;
use std::path::Path;

/// Something that is not as it should be. Printed after `error: ` it ends the command; after `warning: ` it
/// reports a repair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    place: Option<Box<str>>,
    line: Option<usize>,
    key: Option<Box<str>>,
    found: String,
    expected: Box<str>,
    hint: Option<Box<str>>,
    /// An index into [`MAPS`].
    about: Option<u8>,
}

/// The keys of a material that warnings are about.
const MAPS: [&str; 3] = ["color-map", "normal-map", "environment"];

/// The beginning of a hint to another name.
pub(crate) const MEANT: &str = "did you mean ";

impl Error {
    /// `found …, expected …`: the parts that no message lacks.
    pub fn new(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            place: None,
            line: None,
            key: None,
            found: found.into(),
            expected: Into::<String>::into(expected).into(),
            hint: None,
            about: None,
        }
    }

    /// The file it was found in.
    #[must_use]
    pub fn file(self, path: &Path) -> Self {
        self.place(path.display().to_string())
    }

    /// The place, when that is not a file: the name of an option.
    #[must_use]
    pub fn place(mut self, place: impl Into<Box<str>>) -> Self {
        self.place = Some(place.into());
        self
    }

    /// The place or the file.
    pub(crate) fn place_name(&self) -> Option<&str> {
        self.place.as_deref()
    }

    /// The line in the file, from 1. A line made with continuations counts as its first.
    #[must_use]
    pub fn line(mut self, line: usize) -> Self {
        self.line = Some(line);
        self
    }

    /// Its key in the file, where lines are not enough.
    #[must_use]
    pub fn key(mut self, key: impl Into<Box<str>>) -> Self {
        self.key = Some(key.into());
        self
    }

    /// The same in other words.
    #[must_use]
    pub(crate) fn reworded(mut self, reword: impl Fn(&str) -> String) -> Self {
        (self.found, self.expected) = (reword(&self.found), reword(&self.expected).into());
        self.hint = self.hint.map(|hint| reword(&hint).into());
        self
    }

    /// The key of a material that it is about, if an option replaces that.
    #[must_use]
    pub(crate) fn about(mut self, key: &str) -> Self {
        self.about = (0..).zip(MAPS).find(|(_, map)| *map == key).map(|(index, _)| index);
        self
    }

    /// Whether it is about a line.
    pub(crate) fn has_line(&self) -> bool {
        self.line.is_some()
    }

    /// With this name for an `it` that is found.
    #[must_use]
    pub(crate) fn reworded_subject(mut self, name: &str) -> Self {
        if let Some(rest) = self.found.strip_prefix("it ") {
            self.found = format!("{name} {rest}");
        }
        self
    }

    /// The same of a file that another one names: it is told there.
    #[must_use]
    pub(crate) fn of(self, named: &str) -> Self {
        let found = format!("{} for {named}", self.found);
        // A name to try instead is one in the same folder, and starts where the other one does.
        let start = |path: &str| path.rfind('/').map_or(0, |at| at + 1);
        let folder = named.split('"').nth(1).map_or("", |name| &name[..start(name)]);
        let hint = self.hint.map(|hint| match hint.strip_prefix(MEANT) {
            Some(path) => format!("{MEANT}{folder}{}", &path[start(path)..]).into(),
            None => hint,
        });
        Self { place: None, line: None, key: None, found, hint, ..self }
    }

    /// The remedy, or the repair that was made.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<Box<str>>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

impl std::error::Error for Error {}

/// Repairs to report. Of each kind only the first few are kept: a file may have a million broken lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Warnings {
    kinds: Vec<Kind>,
}

/// Warnings of one file that expect the same.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Kind {
    first: Vec<Error>,
    more: usize,
}

impl Kind {
    fn is_of(&self, warning: &Error) -> bool {
        self.first.first().is_some_and(|of| (&of.place, &of.expected) == (&warning.place, &warning.expected))
    }
}

impl Warnings {
    /// The number that is kept of a kind.
    pub const KEPT: usize = 10;

    /// The number of kinds. Whatever else there is counts as of the last one.
    const KINDS: usize = 50;

    /// Adds a warning, or counts it.
    pub fn push(&mut self, warning: Error) {
        let known = self.kinds.iter().position(|kind| kind.is_of(&warning));
        let index = known.unwrap_or_else(|| {
            if self.kinds.len() < Self::KINDS {
                self.kinds.push(Kind::default());
            }
            self.kinds.len() - 1
        });
        let kind = &mut self.kinds[index];
        if kind.first.len() < Self::KEPT {
            kind.first.push(warning);
        } else {
            kind.more += 1;
        }
    }

    /// Hands each on that is kept.
    pub(crate) fn each(self, hear: impl FnMut(Error)) {
        self.kinds.into_iter().flat_map(|kind| kind.first).for_each(hear);
    }

    /// Those that are not about this key of a material.
    #[must_use]
    pub(crate) fn without(mut self, key: &str) -> Self {
        let about = |warning: &Error| warning.about.and_then(|index| MAPS.get(usize::from(index)).copied());
        self.kinds.retain_mut(|kind| {
            kind.first.retain(|warning| about(warning) != Some(key));
            !kind.first.is_empty()
        });
        self
    }

    /// One line each, and after a kind one for those that were only counted.
    pub fn lines(&self) -> impl Iterator<Item = String> {
        self.kinds.iter().flat_map(|kind| {
            let more = (kind.more > 0).then(|| format!("{} more of this kind", kind.more));
            kind.first.iter().map(ToString::to_string).chain(more)
        })
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut message = String::new();
        if let Some(place) = &self.place {
            message.push_str(place);
            if let Some(line) = self.line {
                message.push_str(&format!(":{line}"));
            }
            message.push_str(": ");
        }
        if let Some(key) = &self.key {
            message.push_str(&format!("{key}: "));
        }
        message.push_str(&format!("found {}, expected {}", self.found, self.expected));
        if let Some(hint) = &self.hint {
            message.push_str("; ");
            message.push_str(hint);
        }
        f.write_str(&one_line(&message))
    }
}

/// A piece of input for a message: quoted, without control characters, and not longer than a message bears.
pub fn quote(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    // The part at the end, where paths have the name of a file.
    const END: usize = 24;
    // Cut before the conversion: a megabyte without a space is one word.
    let (head, tail) = (bytes.len().min(4 * LONGEST + 4), bytes.len().saturating_sub(4 * END + 4));
    let text = String::from_utf8_lossy(&bytes[..head]);
    let short = if text.chars().count() > LONGEST {
        let end = String::from_utf8_lossy(&bytes[tail..]);
        let end: String = end.chars().skip(end.chars().count().saturating_sub(END)).collect();
        format!("{}…{end}", text.chars().take(LONGEST - 1 - END).collect::<String>())
    } else {
        text.into_owned()
    };
    format!("\"{}\"", one_line(&short))
}

/// A number for a message: not with dozens of zeros.
pub fn number(x: f32) -> String {
    if x == 0.0 || (1e-5..1e10).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}

/// A number for JSON: the shortest decimal that stands for it, as a reader of `f64` takes it.
pub(crate) fn decimal(x: f32) -> f64 {
    x.to_string().parse().unwrap_or_else(|_| x.into())
}

/// A number of things, in words.
pub(crate) fn counted(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

/// File names and file contents may hold line breaks and terminal escapes; messages may not.
fn one_line(text: &str) -> String {
    if !text.chars().any(char::is_control) {
        return text.to_owned();
    }
    text.chars()
        .flat_map(|c| {
            let escaped = c.is_control().then(|| c.escape_default());
            let plain = (!c.is_control()).then_some(c);
            escaped.into_iter().flatten().chain(plain)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_has_its_parts_in_order() {
        let error = Error::new("a", "b").file(Path::new("x.obj")).line(3).hint("do c");
        assert_eq!(error.to_string(), "x.obj:3: found a, expected b; do c");
        assert_eq!(Error::new("a", "b").to_string(), "found a, expected b");
        let error = error.key("c.d");
        assert_eq!(error.to_string(), "x.obj:3: c.d: found a, expected b; do c");
    }

    #[test]
    fn a_message_is_one_line_whatever_the_input_holds() {
        let error = Error::new(quote(b"a\nb\x1b[31m\xff"), "b").file(Path::new("x\n.obj"));
        assert_eq!(error.to_string(), "x\\n.obj: found \"a\\nb\\u{1b}[31m\u{fffd}\", expected b");
    }

    #[test]
    fn warnings_beyond_the_first_are_counted() {
        let mut warnings = Warnings::default();
        (0..13).for_each(|i| warnings.push(Error::new(i.to_string(), "b")));
        let lines: Vec<_> = warnings.lines().collect();
        assert_eq!(lines.len(), 11);
        assert_eq!(lines[9..], ["found 9, expected b", "3 more of this kind"]);
        warnings.push(Error::new("13", "c"));
        warnings.push(Error::new("14", "b"));
        let lines: Vec<_> = warnings.lines().collect();
        assert_eq!(lines[10..], ["4 more of this kind", "found 13, expected c"]);
        (0..1_000_000).for_each(|i| warnings.push(Error::new("e", i.to_string())));
        assert_eq!(warnings.lines().last().as_deref(), Some("999943 more of this kind"));
    }

    #[test]
    fn numbers_are_short() {
        let shown = [0.0, -0.25, 1e6, 1e-40, -3e38, f32::INFINITY].map(number);
        assert_eq!(shown, ["0", "-0.25", "1000000", "1e-40", "-3e38", "inf"]);
        assert_eq!([0.1, -1e-40, 16_777_216.0].map(decimal), [0.1, -1e-40, 16_777_216.0]);
    }

    #[test]
    fn long_input_is_cut() {
        assert_eq!(quote(&[b'x'; 1000]), format!("\"{}…{}\"", "x".repeat(15), "x".repeat(24)));
        let path = "D:\\models\\of\\a\\very\\long\\name\\visual\\colors.png";
        assert_eq!(quote(path.as_bytes()), "\"D:\\models\\of\\a\\…g\\name\\visual\\colors.png\"");
        // Cut within a letter of several bytes.
        for length in 35..60 {
            let quoted = quote("ä€".repeat(length).as_bytes());
            assert!(quoted.chars().count() == 42 && !quoted.contains('\u{fffd}'), "{quoted}");
        }
        assert_eq!(quote(&[b'x'; 40]), format!("\"{}\"", "x".repeat(40)));
    }
}
