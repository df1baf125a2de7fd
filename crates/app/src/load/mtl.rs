//! An MTL file, reduced to the lines that are used and repaired where a line is broken.
//!
//! A `Kd` whose numbers are missing or are none is an error. What else is broken or missing becomes a warning, and
//! the material keeps its default: a picture with a wrong colour is better than none. `tobj` gets only lines that it
//! reads without a panic.

use std::path::Path;

use crate::error::{Error, Warnings, number, quote};
use crate::load::input::{self, Lines, keyword, not_text, words};
use crate::options::values::{Color, MAX_SHININESS, Shininess};
use crate::options::{Material, Origin};

mod maps;

/// What a material library is called in messages.
pub(crate) const KIND: &str = "an MTL material library";

/// What all libraries of a model give together.
#[derive(Clone, Debug, Default)]
pub(crate) struct CheckedMtl {
    /// A library each: `newmtl`, `Kd`, and for each material [`INDEX`] with its index into `materials`.
    pub(crate) texts: Vec<String>,
    /// What each `newmtl` has beside its `Kd`, in the order of their lines.
    pub(crate) materials: Vec<Material>,
    /// The names that may be used.
    pub(crate) names: Vec<String>,
}

/// The word before a material's index.
pub(crate) const INDEX: &str = "alberti_index";

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
                let origin = Origin { file: path.to_owned(), line: number, key: None, text: String::new() };
                if let Some(warning) = self.line(&line, &origin, &mut named, &mut text).map_err(place)? {
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
        origin: &Origin,
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
            text.push_str(&format!("newmtl {name}\n{INDEX} {}\n", self.materials.len()));
            self.names.push(name);
            self.materials.push(Material::default());
            return Ok(None);
        }
        let lower = word.to_ascii_lowercase();
        let (numbers, map) = match lower.as_slice() {
            b"ka" | b"kd" | b"ks" | b"ke" => (3, false),
            b"ns" | b"ni" | b"d" | b"illum" => (1, false),
            b"map_kd" | b"map_ks" | b"map_ns" | b"map_ke" | b"map_bump" | b"bump" | b"norm" | b"refl" => {
                (0, true)
            }
            _ => return Ok(None),
        };
        let Some(material) = self.materials.last_mut().filter(|_| *named) else {
            return Ok(Some(
                Error::new(format!("{} before `newmtl`", quote(word)), "`newmtl NAME` first")
                    .hint("the line is left out"),
            ));
        };
        if map {
            return Ok(maps::read(material, &lower, word, rest, origin));
        }
        let values = match values(word, rest, numbers) {
            Ok(values) => values,
            Err(error) if lower == b"kd" => return Err(error.hint("correct the line")),
            Err(warning) => return Ok(Some(warning.hint("the line is left out"))),
        };
        let Some([r, g, b]) = values else { return Ok(None) };
        let color = [r, g, b].map(|x| x.clamp(0.0, 1.0));
        let (most, used): (f32, &[f32]) = match lower.as_slice() {
            b"ks" | b"ke" => (1.0, &[r, g, b]),
            b"ns" => (MAX_SHININESS, &[r]),
            _ => (f32::INFINITY, &[]),
        };
        let outside = used.iter().find(|x| !(0.0..=most).contains(*x)).map(|x| {
            let found = format!("{} after `{}`", number(*x), String::from_utf8_lossy(word));
            Error::new(found, format!("a number from 0 to {most}")).hint("it is clamped")
        });
        match lower.as_slice() {
            b"kd" => text.push_str(&format!("Kd {r} {g} {b}\n")),
            b"ks" => material.specular = Some(Color(color)),
            b"ke" => material.emissive = Some(Color(color)),
            // The exponent; where a map says 0 there is no more than a sheen.
            b"ns" => {
                material.shininess = Some(r.clamp(0.0, MAX_SHININESS)).map(|n| Shininess([n.min(1.0), n]))
            }
            _ => {}
        }
        Ok(outside)
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

#[cfg(test)]
mod tests;
