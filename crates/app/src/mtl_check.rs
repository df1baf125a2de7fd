//! An MTL file, reduced to the lines that are used and repaired where a line is broken.
//!
//! A `Kd` whose numbers are missing or are none is an error. What else is broken or missing becomes a warning, and
//! the material keeps its default: a picture with a wrong colour is better than none. `tobj` gets only lines that it
//! reads without a panic.

use std::path::Path;

use crate::error::{Error, Warnings, quote};
use crate::input::{self, Lines, keyword, not_text, words};

/// What a material library is called in messages.
pub(crate) const KIND: &str = "an MTL material library";

/// A texture that a material names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Map {
    /// As it stands in the file, without options.
    pub(crate) name: String,
    /// The library's index in the order of reading.
    pub(crate) library: usize,
    /// The line in the library.
    pub(crate) line: usize,
}

/// What all libraries of a model give together.
#[derive(Clone, Debug, Default)]
pub(crate) struct CheckedMtl {
    /// A library each: `newmtl`, `Kd` and `map_Kd`, the latter with an index into `maps` instead of a name.
    pub(crate) texts: Vec<String>,
    /// Textures in the order of their lines.
    pub(crate) maps: Vec<Map>,
    /// The names that may be used.
    pub(crate) names: Vec<String>,
}

impl CheckedMtl {
    /// Adds a library. `warnings` gets what had to be left out.
    ///
    /// # Errors
    /// A `Kd` whose numbers are missing or are none.
    pub(crate) fn add(&mut self, bytes: &[u8], path: &Path, warnings: &mut Warnings) -> Result<(), Error> {
        let mut text = String::new();
        if let Some(found) = not_text(bytes) {
            warnings.push(Error::new(found, KIND).file(path).hint("its materials are left out"));
        } else {
            let mut named = false;
            for (number, line) in Lines::new(bytes) {
                let place = |e: Error| e.file(path).line(number);
                if let Some(warning) = self.line(&line, number, &mut named, &mut text).map_err(place)? {
                    warnings.push(place(warning));
                }
            }
        }
        self.texts.push(text);
        Ok(())
    }

    /// What there is to warn of in a line.
    fn line(
        &mut self,
        line: &[u8],
        number: usize,
        named: &mut bool,
        text: &mut String,
    ) -> Result<Option<Error>, Error> {
        let (word, rest) = keyword(line);
        if word == b"newmtl" {
            let name = String::from_utf8_lossy(rest).trim().to_owned();
            *named = !name.is_empty();
            if name.is_empty() {
                return Ok(Some(
                    Error::new("`newmtl` without a name", "`newmtl NAME`")
                        .hint("the lines up to the next one are left out"),
                ));
            }
            text.push_str(&format!("newmtl {name}\n"));
            self.names.push(name);
            return Ok(None);
        }
        let lower = word.to_ascii_lowercase();
        let (numbers, map) = match lower.as_slice() {
            b"ka" | b"kd" | b"ks" | b"ke" => (3, false),
            b"ns" | b"ni" | b"d" | b"illum" => (1, false),
            b"map_kd" => (0, true),
            _ => return Ok(None),
        };
        if !*named {
            return Ok(Some(
                Error::new(format!("{} before `newmtl`", quote(word)), "`newmtl NAME` first")
                    .hint("the line is left out"),
            ));
        }
        if map {
            return Ok(self.map(rest, number, text));
        }
        let used = lower == b"kd";
        let values = match values(word, rest, numbers) {
            Ok(values) => values,
            Err(error) if used => return Err(error.hint("correct the line")),
            Err(warning) => return Ok(Some(warning.hint("the line is left out"))),
        };
        if let (true, Some([r, g, b])) = (used, values) {
            text.push_str(&format!("Kd {r} {g} {b}\n"));
        }
        Ok(None)
    }

    fn map(&mut self, rest: &[u8], line: usize, text: &mut String) -> Option<Error> {
        let (name, options) = without_options(rest);
        if name.is_empty() {
            return Some(Error::new("`map_Kd` without a file", "`map_Kd FILE`").hint("the line is left out"));
        }
        text.push_str(&format!("map_Kd {}\n", self.maps.len()));
        let library = self.texts.len();
        self.maps.push(Map { name: String::from_utf8_lossy(name).trim().to_owned(), library, line });
        if options {
            return Some(
                Error::new("`map_Kd` with options", "`map_Kd FILE`").hint("the options are left out"),
            );
        }
        None
    }
}

/// The numbers of a line that should have `wanted`, when they are numbers at all: colours may also be given as
/// `spectral FILE` or `xyz X Y Z`, which is legal and not supported. One number is a grey, as the format says.
fn values(word: &[u8], rest: &[u8], wanted: usize) -> Result<Option<[f32; 3]>, Error> {
    let name = String::from_utf8_lossy(word);
    let expected = if wanted == 3 {
        format!("`{name} r g b` with finite numbers")
    } else {
        format!("`{name}` and a number")
    };
    let broken = |found: String| Error::new(found, expected.as_str());
    let mut values = [0.0; 3];
    let mut n = 0;
    for word in words(rest) {
        if n == 0 && matches!(word, b"spectral" | b"xyz" | b"-halo") {
            return Ok(None);
        }
        let value = input::number(word).ok_or_else(|| broken(format!("{} after `{name}`", quote(word))))?;
        if let Some(slot) = values.get_mut(n) {
            *slot = value;
        }
        n += 1;
    }
    match n {
        1 => Ok(Some([values[0]; 3])),
        _ if n >= wanted && n > 0 => Ok(Some(values)),
        _ => Err(broken(format!("`{name}` with {n} numbers"))),
    }
}

/// The file's name after the options of a texture line, and whether there were options. Names may hold spaces.
fn without_options(rest: &[u8]) -> (&[u8], bool) {
    let mut rest = rest;
    let mut options = false;
    while rest.first() == Some(&b'-') {
        let (option, mut after) = keyword(rest);
        let (least, most) = match option {
            b"-blendu" | b"-blendv" | b"-cc" | b"-clamp" | b"-imfchan" | b"-type" => (1, 1),
            b"-texres" | b"-boost" | b"-bm" => (1, 1),
            b"-mm" => (2, 2),
            b"-o" | b"-s" | b"-t" => (1, 3),
            // A file whose name begins with a hyphen.
            _ => break,
        };
        for n in 0..most {
            let (argument, next) = keyword(after);
            if n >= least && input::number(argument).is_none() {
                break;
            }
            after = next;
        }
        options = true;
        rest = after;
    }
    (rest, options)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(text: &[u8]) -> (CheckedMtl, Vec<String>) {
        let (mut checked, mut warnings) = (CheckedMtl::default(), Warnings::default());
        checked.add(text, Path::new("m.mtl"), &mut warnings).expect("numbers");
        (checked, warnings.lines().collect())
    }

    #[test]
    fn only_what_is_used_is_passed_on() {
        let (checked, warnings) =
            run(b"newmtl a b\r\n\tKa 0 0 0\n Kd 1 0.5 0 # x\nKd 0.5\nillum 2\nmap_Kd wood 1.png\nbump\nTf\n");
        assert_eq!(checked.texts, ["newmtl a b\nKd 1 0.5 0\nKd 0.5 0.5 0.5\nmap_Kd 0\n"]);
        assert_eq!(checked.maps, [Map { name: "wood 1.png".to_owned(), library: 0, line: 6 }]);
        assert_eq!(checked.names, ["a b"]);
        assert!(warnings.is_empty(), "{warnings:?}");
    }

    #[test]
    fn numbers_that_are_none_or_too_few_are_errors() {
        for (line, found) in [
            ("Kd 1 2", "found `Kd` with 2 numbers, expected `Kd r g b`"),
            ("Kd", "found `Kd` with 0 numbers"),
            ("Kd 1 x 1", "found \"x\" after `Kd`"),
            ("Kd nan 0 0", "found \"nan\" after `Kd`"),
            ("Kd 1e400 0 0", "found \"1e400\" after `Kd`"),
        ] {
            let text = format!("newmtl a\n{line}\n");
            let (mut checked, mut warnings) = (CheckedMtl::default(), Warnings::default());
            let error = checked.add(text.as_bytes(), Path::new("m.mtl"), &mut warnings).expect_err(line);
            assert!(error.to_string().starts_with(&format!("m.mtl:2: {found}")), "{error}");
        }
    }

    #[test]
    fn broken_lines_are_left_out_and_named() {
        for (line, found) in [
            ("Ks 1 2", "found `Ks` with 2 numbers"),
            ("Ns", "found `Ns` with 0 numbers, expected `Ns` and a number"),
            ("illum x", "found \"x\" after `illum`"),
            ("map_Kd", "found `map_Kd` without a file"),
            ("map_Kd -s 1 1 1", "found `map_Kd` without a file"),
            ("newmtl", "found `newmtl` without a name"),
        ] {
            let (checked, warnings) = run(format!("newmtl a\n{line}\n").as_bytes());
            assert_eq!(checked.texts, ["newmtl a\n"]);
            assert_eq!(warnings.len(), 1);
            assert!(warnings[0].starts_with(&format!("m.mtl:2: {found}")), "{warnings:?}");
        }
    }

    #[test]
    fn lines_before_a_name_are_left_out() {
        let (checked, warnings) = run(b"Kd 1 1 1\nnewmtl\nKd 0 0 0\nnewmtl b\n");
        assert_eq!(checked.texts, ["newmtl b\n"]);
        assert_eq!(warnings.len(), 3);
    }

    #[test]
    fn options_of_textures_are_skipped() {
        for line in ["-s 1 2 3 a b.png", "-clamp on a b.png", "-mm 0 1 -o 0.5 a b.png", "-bm 1 a b.png"] {
            let (checked, warnings) = run(format!("newmtl x\nmap_Kd {line}").as_bytes());
            assert_eq!(checked.maps[0].name, "a b.png");
            assert_eq!(warnings.len(), 1);
        }
        let (checked, _) = run(b"newmtl x\nmap_Kd -a.png");
        assert_eq!(checked.maps[0].name, "-a.png");
    }

    #[test]
    fn binary_libraries_are_left_out_whole() {
        let (checked, warnings) = run(b"newmtl\0");
        assert_eq!(checked.texts, [""]);
        assert!(warnings[0].starts_with("m.mtl: found a binary file"));
    }
}
