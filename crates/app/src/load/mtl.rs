//! MTL files: the lines that are used, checked.
//!
//! Keywords count in any letters. What is broken or missing becomes a warning, and the material keeps its default: a
//! picture with a wrong colour is better than none.

use std::collections::HashMap;
use std::path::Path;

use crate::error::{Error, Warnings, number, quote};
use crate::load::statements::{Lines, Statement, keyword, not_text};
use crate::options::Origin;
use crate::options::values::{Color, MAX_SHININESS, Shininess};
use crate::scene::normals::narrow;

mod entry;
mod maps;

pub(crate) use entry::{Alpha, Entry, see_through};

/// The name of a material library in messages.
pub(crate) const KIND: &str = "an MTL material library";

/// All libraries of a model together.
#[derive(Clone, Debug, Default)]
pub(crate) struct CheckedMtl {
    /// In the order of their `newmtl` lines.
    pub(crate) materials: Vec<Entry>,
    /// Names and indices; of equal names, the last counts.
    pub(crate) names: HashMap<String, usize>,
}

impl CheckedMtl {
    /// Adds a library. `warnings` gets what had to be left out.
    pub(crate) fn add(&mut self, bytes: &[u8], path: &Path, warnings: &mut Warnings) {
        if let Some(found) = not_text(bytes, 0) {
            warnings.push(Error::new(found, KIND).file(path).hint("its materials are left out"));
            return;
        }
        let first = self.materials.len();
        let mut named = None;
        let mut ignored = Ignored::default();
        for (number, line) in Lines::new(bytes) {
            let place = |error: Error| error.file(path).line(number);
            let statement = Statement::new(number, &line);
            let found = self.statement(&statement, path, &mut named, &mut ignored);
            found.into_iter().for_each(|warning| warnings.push(place(warning)));
        }
        ignored.told(path, warnings);
        // Blender writes amounts of light, as its own colours are.
        if bytes.trim_ascii_start().starts_with(b"# Blender") {
            for Entry { material, .. } in &mut self.materials[first..] {
                let colors = [&mut material.color, &mut material.emissive];
                colors.into_iter().flatten().for_each(|Color(color)| *color = color.map(encoded));
            }
        }
    }

    /// Takes a line, and returns what there is to warn of. `named` is whether the last `newmtl` had a name.
    fn statement(
        &mut self,
        line: &Statement<'_>,
        path: &Path,
        named: &mut Option<bool>,
        ignored: &mut Ignored,
    ) -> Vec<Error> {
        if line.word.eq_ignore_ascii_case(b"newmtl") {
            let name = line.name();
            *named = Some(!name.is_empty());
            if name.is_empty() {
                let warning = Error::new("`newmtl` without a name", "`newmtl NAME`");
                return vec![warning.hint("the lines up to the next one are left out")];
            }
            let first = self.names.insert(name.clone(), self.materials.len());
            let again = || {
                let found = format!("a second material {}", quote(name.as_bytes()));
                Error::new(found, "a name for each").hint("the last of them counts")
            };
            let warning = first.map(|_| again());
            self.materials.push(Entry { name, ..Entry::default() });
            return Vec::from_iter(warning);
        }
        let lower = line.word.to_ascii_lowercase();
        let numbers = match lower.as_slice() {
            b"ka" | b"kd" | b"ks" | b"ke" => 3,
            b"ns" | b"ni" | b"d" | b"tr" | b"illum" | b"pr" | b"pm" => 1,
            b"map_kd" | b"map_ks" | b"map_ns" | b"map_ke" | b"map_d" | b"map_pr" | b"map_pm" => 0,
            b"map_bump" | b"bump" | b"disp" | b"norm" | b"map_norm" | b"refl" | b"map_refl" => 0,
            // Ambient light is the scene's.
            b"map_ka" => return Vec::new(),
            // The thickness of a coat, and the turn of an anisotropy: these are told.
            b"pcr" | b"anisor" => return Vec::new(),
            _ => {
                if !is_idle(&lower, line) {
                    ignored.add(&format!("`{}`", line.keyword()), line.line);
                }
                return Vec::new();
            }
        };
        if *named == Some(false) {
            return Vec::new();
        }
        let Some(entry) = self.materials.last_mut().filter(|_| named.is_some()) else {
            let warning = Error::new(format!("{} before `newmtl`", quote(line.word)), "`newmtl NAME` first");
            return vec![warning.hint("the line is left out")];
        };
        if numbers == 0 {
            let origin = Origin { file: path.to_owned(), line: line.line, ..Origin::default() };
            return maps::read(entry, &lower, line, origin, ignored);
        }
        let values = match values(line, numbers) {
            Ok(values) => values,
            Err(warning) => return vec![warning.hint("the line is left out")],
        };
        let Some([r, g, b]) = values else {
            let form = String::from_utf8_lossy(keyword(line.rest).0).into_owned();
            ignored.add(&format!("`{} {form}`", line.keyword()), line.line);
            return Vec::new();
        };
        let material = &mut entry.material;
        let color = Some(Color([r, g, b].map(|x| x.clamp(0.0, 1.0))));
        let (most, used): (f32, &[f32]) = match lower.as_slice() {
            b"kd" | b"ks" | b"ke" => (1.0, &[r, g, b]),
            b"ns" => (MAX_SHININESS, &[r]),
            b"d" | b"tr" | b"pr" | b"pm" => (1.0, &[r]),
            _ => (f32::INFINITY, &[]),
        };
        match lower.as_slice() {
            b"kd" => material.color = color,
            b"ks" => material.specular = color,
            b"ke" => material.emissive = color,
            // The exponent; where a map says 0 there is no highlight.
            b"ns" => material.shininess = Some(Shininess([0.0, r.clamp(0.0, MAX_SHININESS)])),
            b"d" if r <= 0.0 => {
                entry.opacity = Some(0.0);
                let found = format!("`{} {}`, nothing to be seen", line.keyword(), number(r));
                return vec![Error::new(found, "more").hint("a picture shows none of it")];
            }
            b"d" => entry.opacity = Some(r.min(1.0)),
            // Some exporters mean the opacity.
            b"tr" if r >= 1.0 && entry.opacity.is_none() => {
                let warning =
                    Error::new(format!("`{} {}`, nothing to be seen", line.keyword(), number(r)), "less");
                return vec![warning.hint("the line is left out")];
            }
            b"tr" => entry.transparency = Some(r.clamp(0.0, 1.0)),
            b"illum" => entry.illumination = Some(r),
            b"pr" => entry.roughness = Some(r.clamp(0.0, 1.0)),
            b"pm" => entry.metallic = Some(r.clamp(0.0, 1.0)),
            _ => {}
        }
        if lower == b"ns" && r < 0.0 {
            // A formula of one exporter has such, for surfaces that are quite rough.
            ignored.add(&format!("`{}` below 0", line.keyword()), line.line);
            return Vec::new();
        }
        let beyond = used.iter().find(|x| !(0.0..=most).contains(*x));
        Vec::from_iter(beyond.map(|x| {
            let found = format!("{} after `{}`", number(*x), line.keyword());
            Error::new(found, format!("a number from 0 to {most}")).hint("it is clamped")
        }))
    }
}

/// A share of light as sRGB has it.
fn encoded(light: f32) -> f32 {
    let light = f64::from(light);
    narrow(if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 })
}

/// Whether a statement that is not drawn says nothing either: a filter that lets all through, no sheen, no coat, no
/// anisotropy.
fn is_idle(lower: &[u8], line: &Statement<'_>) -> bool {
    let neutral = match lower {
        b"tf" => 1.0,
        b"ps" | b"pc" | b"aniso" => 0.0,
        _ => return false,
    };
    matches!(values(line, 1), Ok(Some(all)) if all.iter().all(|&x| x == neutral))
}

/// The kinds of statements and options of a library that have no effect.
#[derive(Debug, Default)]
struct Ignored(Vec<(String, usize, usize)>);

impl Ignored {
    /// One on that line.
    fn add(&mut self, kind: &str, line: usize) {
        match self.0.iter_mut().find(|(known, ..)| known.eq_ignore_ascii_case(kind)) {
            Some((.., count)) => *count += 1,
            None => self.0.push((kind.to_owned(), line, 1)),
        }
    }

    /// Warns of all of them at once, where the first stands.
    fn told(self, path: &Path, warnings: &mut Warnings) {
        let Some(&(_, line, _)) = self.0.first() else { return };
        let kind = |(kind, _, count): &(String, usize, usize)| match count {
            1 => kind.clone(),
            _ => format!("{kind}, {count} times"),
        };
        let kinds: Vec<_> = self.0.iter().map(kind).collect();
        let (expected, hint) = match kinds.len() {
            1 => ("a statement that is drawn", "it is left out"),
            _ => ("statements that are drawn", "they are left out"),
        };
        warnings.push(Error::new(kinds.join("; "), expected).file(path).line(line).hint(hint));
    }
}

/// The numbers of a line that should have `wanted` of them, when they are numbers at all. Colours may also be given as
/// `spectral FILE` or `xyz X Y Z`, which is legal and not supported. One number is a grey, as the format says.
fn values(line: &Statement<'_>, wanted: usize) -> Result<Option<[f32; 3]>, Error> {
    if matches!(line.words().next(), Some(b"spectral" | b"xyz")) {
        return Ok(None);
    }
    let name = line.keyword();
    let form = if wanted == 3 { " r g b` with finite numbers" } else { "` and a number" };
    let broken = |found: String| Error::new(found, format!("`{name}{form}"));
    if line.words().next() == Some(b"-halo") {
        // The share at the rim; the other is in the middle.
        let (_, rest) = keyword(line.rest);
        return values(&Statement { rest, ..*line }, wanted);
    }
    match line.numbers() {
        Err(word) => Err(broken(format!("{} after `{name}`", quote(word)))),
        Ok(([grey, _, _], 1)) => Ok(Some([grey; 3])),
        Ok((values, n)) if n >= wanted => Ok(Some(values)),
        Ok((_, n)) => Err(broken(format!("`{name}` with {n} numbers"))),
    }
}

#[cfg(test)]
mod tests;
