//! A scene file as text, and messages that name the line and the key of what is wrong in it.

use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Deserialize as _;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use super::syntax;
use super::tables::File;
use crate::error::{Error, MEANT, quote};
use crate::load::input;
use crate::load::statements::not_text;
use crate::options::{Origin, shared};

/// The name of a scene file in messages.
pub(crate) const KIND: &str = "a scene file in TOML";

/// The largest scene file that is read, in bytes.
const MAX_BYTES: u64 = 1 << 24;

/// The text, and where its keys are.
#[derive(Clone, Debug)]
pub(super) struct Source {
    path: PathBuf,
    text: String,
    keys: Vec<Key>,
    /// The first key of each path.
    index: HashMap<String, usize>,
}

/// A key and its value.
#[derive(Clone, Debug)]
struct Key {
    key: Range<usize>,
    value: Range<usize>,
    /// With the tables that it is in, and which of several: `object[0].size`.
    path: String,
}

impl Key {
    /// Its path without numbers, for messages: `object.size`.
    fn name(&self) -> String {
        let mut parts = self.path.split('[');
        let first = parts.next().unwrap_or_default().to_owned();
        parts.fold(first, |name, part| name + part.split_once(']').map_or(part, |(_, rest)| rest))
    }
}

impl Source {
    /// Reads a file.
    ///
    /// # Errors
    /// The file cannot be read, is no TOML, or has a key that there is none of, or a value of another kind.
    pub(super) fn read(path: &Path) -> Result<(Self, File), Error> {
        let bytes = input::read(path, KIND, MAX_BYTES)?;
        if let Some(found) = not_text(&bytes, 0).filter(|_| !bytes.is_empty()) {
            return Err(Error::new(found, KIND).file(path).hint("save it as UTF-8"));
        }
        let text = String::from_utf8(bytes).map_err(|error| {
            let valid = error.utf8_error().valid_up_to();
            let line = 1 + error.as_bytes()[..valid].iter().filter(|&&byte| byte == b'\n').count();
            Error::new("a byte that is not UTF-8", KIND).file(path).line(line)
        })?;
        // As far as it can be read: what is wrong is told below.
        let mut keys = Vec::new();
        let (table, faults) = DeTable::parse_recoverable(&text);
        collect(table.get_ref(), "", &mut keys);
        let array = if faults.is_empty() { array_for_table(table.get_ref()) } else { None };
        drop(table);
        let index = keys.iter().enumerate().rev().map(|(index, key)| (key.path.clone(), index)).collect();
        let source = Self { path: path.to_owned(), text, keys, index };
        if let Some(path) = array {
            return Err(source.error(&path, "an array", format!("a table, [{path}]")));
        }
        match toml::from_str(&source.text) {
            Ok(file) => Ok((source, file)),
            Err(error) => Err(source.refused(&error, error.span().unwrap_or(0..0))),
        }
    }

    /// The file as it would be after a change.
    ///
    /// # Errors
    /// A value cannot be.
    pub(super) fn changed(&self, change: impl FnOnce(&mut Table)) -> Result<File, toml::de::Error> {
        let mut table: Table = toml::from_str(&self.text)?;
        change(&mut table);
        File::deserialize(Value::Table(table))
    }

    /// Has a key stand where another does, from which it gets its values.
    pub(super) fn stand_for(&mut self, path: String, other: &str) {
        if let Some(&index) = self.index.get(other) {
            self.index.insert(path, index);
        }
    }

    /// The value of this key as it is written.
    pub(super) fn shown(&self, path: &str) -> String {
        let text = self.key(path).and_then(|key| self.text.get(key.value.clone()));
        text.filter(|text| !text.contains(char::is_control)).unwrap_or("several lines").to_owned()
    }

    /// A message of the reader's on a value that is that of this key.
    pub(super) fn refused_at(&self, error: &toml::de::Error, path: &str) -> Error {
        self.refused(error, self.key(path).map_or(0..0, |key| key.value.clone()))
    }

    /// A path in the file, which starts where the file is.
    pub(super) fn beside(&self, name: impl AsRef<Path>) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(name)
    }

    /// The file itself.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the file has this key, by its path.
    pub(super) fn has(&self, path: &str) -> bool {
        self.key(path).is_some()
    }

    /// Puts an error where this key has its value.
    pub(super) fn place(&self, error: Error, path: &str) -> Error {
        let error = error.file(&self.path);
        match self.key(path) {
            // It gets its values from there.
            Some(key) if key.path != path => {
                error.line(self.line(&key.value)).key(key.name()).reworded_subject(path)
            }
            Some(key) => error.line(self.line(&key.value)).key(key.name()),
            None => error,
        }
    }

    /// An error in the value of this key.
    pub(super) fn error(&self, path: &str, found: impl Into<String>, expected: impl Into<String>) -> Error {
        self.place(Error::new(found, expected), path)
    }

    /// A key that has no use there is a mistake.
    pub(super) fn only(&self, path: &str, useful: bool, expected: &str) -> Result<(), Error> {
        if !useful && self.has(path) {
            return Err(self.error(path, "a key that has no use here", expected));
        }
        Ok(())
    }

    /// The place of a file's name, which is the value of this key.
    pub(super) fn origin(&self, path: &str, text: String) -> Origin {
        let (line, key) = self.key(path).map(|key| (self.line(&key.value), key.name())).unzip();
        Origin { file: self.path.clone(), line: line.unwrap_or(1), key, text }
    }

    fn key(&self, path: &str) -> Option<&Key> {
        self.index.get(path).and_then(|&index| self.keys.get(index))
    }

    fn line(&self, at: &Range<usize>) -> usize {
        1 + self.text.bytes().take(at.start).filter(|&byte| byte == b'\n').count()
    }

    /// The innermost key that has this place in its name or its value.
    fn key_at(&self, at: &Range<usize>) -> Option<String> {
        let within = |range: &Range<usize>| range.start <= at.start && at.end <= range.end;
        let here = self.keys.iter().filter(|key| within(&key.key) || within(&key.value));
        let size = |key: &&Key| if within(&key.key) { key.key.len() } else { key.value.len() };
        here.min_by_key(size).map(Key::name)
    }

    /// The key of a line that cannot be read.
    fn key_on_line(&self, at: &Range<usize>) -> Option<&str> {
        let start = self.text.get(..at.start)?.rfind('\n').map_or(0, |end| end + 1);
        let line = self.text.get(start..)?.lines().next()?;
        let key = line.split_once('=').map(|(key, _)| key).or_else(|| line.strip_prefix('['))?.trim();
        let usual = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        (!key.is_empty() && key.chars().all(usual)).then_some(key)
    }

    /// A message of the reader's on this place, in the form that all messages have.
    fn refused(&self, error: &toml::de::Error, at: Range<usize>) -> Error {
        let message = error.message().replace('\n', ", ");
        let around = self.text.get(..at.start).zip(self.text.get(at.start..));
        let around = around.filter(|_| error.span().is_some()).unwrap_or_default();
        let (message, remedy) = syntax::mended(&message, around);
        let parted = message.split_once(", expected ");
        let parted = parted.or_else(|| message.strip_prefix("expected ").map(|expected| ("", expected)));
        let (found, expected) = parted.unwrap_or((&message, KIND));
        let kinds = ["invalid type: ", "invalid value: "];
        let found = kinds.iter().find_map(|kind| found.strip_prefix(kind)).unwrap_or(found);
        let unknown = found.strip_prefix("unknown field ").map(|key| key.trim_matches('`'));
        let missing = found.strip_prefix("missing field ");
        let (found, expected) = match (unknown, missing) {
            (Some(key), _) => (format!("the unknown key {}", quote(key.as_bytes())), plain(expected)),
            (None, Some(key)) => (format!("no {key}"), "one".to_owned()),
            (None, None) if found.is_empty() => (self.found(&at), plain(expected)),
            (None, None) => (found.to_owned(), plain(expected)),
        };
        // Tables that have no end reach into the next.
        let within = self.key_at(&at).filter(|_| !found.starts_with("unclosed"));
        let key = within.or_else(|| self.key_on_line(&at).map(str::to_owned));
        let is_date =
            || self.text.get(at.clone()).is_some_and(|text| text.starts_with(|c: char| c.is_ascii_digit()));
        let found = match in_words(&plain(&found)) {
            found if found == TABLE && is_date() => "a date or a time".to_owned(),
            found => found,
        };
        let expected = match (in_words(&expected), &key) {
            (expected, Some(key)) if expected == ARRAY => format!("tables under [[{key}]]"),
            (expected, _) => expected,
        };
        let meant = unknown.and_then(|key| {
            let near = || nearest(key, &expected).map(|near| format!("did you mean {near}?"));
            elsewhere(key).or_else(near).or_else(|| of_others(key, &expected))
        });
        // A long list would hide what is meant.
        let is_clear = meant.as_ref().is_some_and(|meant| meant.starts_with(MEANT));
        let is_long = expected.split(", ").count() > MANY;
        let told = if is_clear && is_long { "one that is known there" } else { &expected };
        let mut error = Error::new(found, told).file(&self.path).line(self.line(&at));
        if let Some(key) = key {
            error = error.key(key);
        }
        match meant.or(remedy) {
            Some(hint) => error.hint(hint),
            None => error,
        }
    }

    /// The text there.
    fn found(&self, at: &Range<usize>) -> String {
        match self.text.get(at.clone()).filter(|text| !text.trim().is_empty()) {
            Some(text) => quote(text.as_bytes()),
            None => "the end of the line".to_owned(),
        }
    }
}

/// So many names are told where one of them is meant.
const MANY: usize = 8;

/// A hint to the table of a key that stands in another one, or at the top.
fn elsewhere(key: &str) -> Option<String> {
    let shared = shared();
    let table = shared.iter().find_map(|option| option.key.strip_suffix(key)?.strip_suffix('.'))?;
    Some(format!("it belongs in [{table}]"))
}

/// A hint to the key for what others call so, if that is one of those expected.
fn of_others(key: &str, expected: &str) -> Option<String> {
    let ours = match key {
        "opacity" | "alpha" | "transparency" => "blend",
        "roughness" | "gloss" | "exponent" => "shininess",
        "texture" | "map" | "diffuse-map" | "albedo" => "color-map",
        "diffuse" | "colour" => "color",
        "emission" => "emissive",
        "type" => "kind",
        "position" | "from" => "eye",
        "look-at" | "lookat" | "to" => "target",
        "mesh" | "file" => "model",
        "rotate" => "rotation",
        "translate" | "translation" => "position",
        _ => return None,
    };
    let known = expected.split([',', ' ']).any(|known| known == ours);
    known.then(|| format!("did you mean {ours}?"))
}

const TABLE: &str = "a table";
const ARRAY: &str = "an array";

/// The words of TOML for those of the reader.
fn in_words(name: &str) -> String {
    match name {
        "map" | "a map" => TABLE,
        "sequence" | "a sequence" => ARRAY,
        "a boolean" => "true or false",
        name if name.starts_with("struct ") => TABLE,
        name => name,
    }
    .to_owned()
}

/// The first key of a table that has an array: the reader would take its values for those of the table's keys.
fn array_for_table(file: &DeTable<'_>) -> Option<String> {
    let is_array = |value: &Spanned<DeValue<'_>>| matches!(value.get_ref(), DeValue::Array(_));
    for (key, value) in file {
        let key = key.get_ref();
        if ["camera", "projector", "render", "ambient", "material"].contains(&&**key) && is_array(value) {
            return Some(key.to_string());
        }
        if let (DeValue::Table(materials), "material") = (value.get_ref(), &**key) {
            let name = materials.iter().find(|(_, material)| is_array(material));
            if let Some((name, _)) = name {
                return Some(format!("{key}.{}", name.get_ref()));
            }
        }
    }
    None
}

/// Without the marks around names.
fn plain(expected: &str) -> String {
    expected.replace('`', "")
}

/// The known key that is most like this one, if one is at all.
fn nearest<'a>(key: &str, expected: &'a str) -> Option<&'a str> {
    let known = expected.strip_prefix("one of ").unwrap_or(expected);
    let known = known.split([',', ' ']).filter(|known| !known.is_empty() && *known != "or");
    let (distance, found) = known.map(|known| (strsim::levenshtein(key, known), known)).min()?;
    (3 * distance <= key.chars().count().max(3)).then_some(found)
}

/// Notes all keys of the table with this path.
fn collect(table: &DeTable<'_>, outer: &str, keys: &mut Vec<Key>) {
    let dot = if outer.is_empty() { "" } else { "." };
    for (key, value) in table {
        let path = format!("{outer}{dot}{}", key.get_ref());
        collect_value(value, &path, keys);
        keys.push(Key { key: key.span(), value: value.span(), path });
    }
}

fn collect_value(value: &Spanned<DeValue<'_>>, path: &str, keys: &mut Vec<Key>) {
    match value.get_ref() {
        DeValue::Table(table) => collect(table, path, keys),
        DeValue::Array(array) => {
            for (index, value) in array.iter().enumerate() {
                let path = format!("{path}[{index}]");
                collect_value(value, &path, keys);
                keys.push(Key { key: value.span(), value: value.span(), path });
            }
        }
        _ => {}
    }
}
