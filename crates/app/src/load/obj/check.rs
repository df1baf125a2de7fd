//! An OBJ file, checked line by line and rewritten in the plain form that the reader behind it expects.
//!
//! `tobj` reads the file, but says neither where an error is nor whether a number is finite, panics on some
//! indices, and in its one-index mode loses track when only some corners of a mesh have a texture coordinate or
//! a normal, or only some vertices a colour. So every line is checked here first, and `tobj` gets text in which
//! every `v` has a colour and every corner three positive indices. Index 1 of the texture coordinates and of
//! the normals stands for "the file gives none".

use std::collections::HashSet;
use std::fmt::Write as _;
use std::num::IntErrorKind;
use std::path::Path;

use crate::error::{Error, quote};
use crate::load::input::{self, Lines, keyword, not_text, words};

/// Coordinates are limited so that squared lengths of sums stay finite in f32.
pub(crate) const MAX_COORDINATE: f32 = 1e15;

/// What an OBJ model is called in messages.
pub(crate) const KIND: &str = "a Wavefront OBJ model";

/// A name in the file, and the line where it comes first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Named {
    /// As it stands in the file, trimmed.
    pub(crate) name: String,
    /// From 1.
    pub(crate) line: usize,
}

/// A file without errors, rewritten.
#[derive(Clone, Debug, Default)]
pub(crate) struct CheckedObj {
    /// All `v`, `vt` and `vn`.
    pub(crate) head: String,
    /// Objects, materials and faces, in the file's order.
    pub(crate) body: String,
    /// The arguments of `mtllib`, whole lines.
    pub(crate) libraries: Vec<Named>,
    /// The names that `usemtl` asks for, each once.
    pub(crate) materials: Vec<Named>,
    /// The number of face corners with a texture coordinate.
    pub(crate) corners_with_uv: usize,
    /// The number of colours that had to be clamped.
    pub(crate) colors_out_of_range: usize,
}

/// The number of `v`, `vt`, `vn` so far.
type Counts = [usize; 3];

const LINE_OF: [&str; 3] = ["v", "vt", "vn"];
const NAME_OF: [&str; 3] = ["vertex", "texture coordinate", "normal"];

/// Checks the whole file. `progress` hears the bytes done, now and then.
///
/// Ignored: lines (`l`), points (`p`), curves and surfaces, smoothing groups, and whatever else the word at the
/// start of a line may be. Kept: degenerate faces, which cover no sample when drawn. An index may point to a
/// later line, as some exporters write it, unless it is negative.
pub(crate) fn check(bytes: &[u8], path: &Path, progress: &mut dyn FnMut(usize)) -> Result<CheckedObj, Error> {
    if let Some(found) = not_text(bytes) {
        return Err(Error::new(found, KIND).file(path).hint("export the model as OBJ text"));
    }
    let mut check = Check::default();
    check.out.head.push_str("vt 0 0\nvn 0 0 0\n");
    let mut lines = Lines::new(bytes);
    let mut since_report = 0;
    while let Some((number, line)) = lines.next() {
        check.line(number, &line).map_err(|e| e.file(path).line(number))?;
        since_report += 1;
        if since_report == 20_000 {
            since_report = 0;
            progress(bytes.len() - lines.remaining());
        }
    }
    check.later_indices().map_err(|(line, e)| e.file(path).line(line))?;
    if check.faces == 0 {
        let found = format!("no faces in {} lines", lines.count_so_far());
        return Err(Error::new(found, "an OBJ model with faces (lines like `f 1 2 3`)")
            .file(path)
            .hint("check that this is the right file"));
    }
    Ok(check.out)
}

#[derive(Default)]
struct Check {
    out: CheckedObj,
    counts: Counts,
    faces: usize,
    /// The names in `out.materials`, which may be many.
    materials: HashSet<String>,
    /// Indices beyond what the file had given at that point: line, which of the three, index.
    later: Vec<(usize, usize, usize)>,
}

impl Check {
    fn line(&mut self, number: usize, line: &[u8]) -> Result<(), Error> {
        let (word, rest) = keyword(line);
        match word {
            b"v" => self.vertex(rest),
            b"vt" => self.texture_coordinate(rest),
            b"vn" => self.normal(rest),
            b"f" => self.face(number, rest),
            b"o" | b"g" => {
                self.out.body.push_str("o ");
                self.out.body.push_str(String::from_utf8_lossy(rest).trim());
                self.out.body.push('\n');
                Ok(())
            }
            b"usemtl" => {
                self.use_material(number, rest);
                Ok(())
            }
            b"mtllib" => {
                let name = String::from_utf8_lossy(rest).trim().to_owned();
                self.out.libraries.push(Named { name, line: number });
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn vertex(&mut self, rest: &[u8]) -> Result<(), Error> {
        let mut values = [0.0; 6];
        let n = numbers(rest, &mut values, "`v x y z` with an optional w or r g b")?;
        if !matches!(n, 3 | 4 | 6) {
            return Err(Error::new(
                format!("`v` with {n} numbers"),
                "3 (x y z), 4 (x y z w) or 6 (x y z r g b)",
            )
            .hint("correct the line"));
        }
        let mut position = [values[0], values[1], values[2]];
        if n == 4 {
            position = position.map(|x| x / values[3]);
        }
        // Not (a <= b): a division by w = 0 may have made a NaN.
        if let Some(bad) = position.iter().find(|x| x.is_nan() || x.abs() > MAX_COORDINATE) {
            return Err(Error::new(
                format!("a coordinate of {bad:e}"),
                format!("coordinates within ±{MAX_COORDINATE:e}, after division by a w other than 0"),
            )
            .hint("scale the model"));
        }
        let color = if n == 6 { [values[3], values[4], values[5]] } else { [1.0; 3] };
        self.out.colors_out_of_range += usize::from(color.iter().any(|c| !(0.0..=1.0).contains(c)));
        self.out.head.push('v');
        for x in position.iter().chain(&color) {
            push(&mut self.out.head, format_args!(" {x}"));
        }
        self.out.head.push('\n');
        self.counts[0] += 1;
        Ok(())
    }

    fn texture_coordinate(&mut self, rest: &[u8]) -> Result<(), Error> {
        let mut values = [0.0; 3];
        let n = numbers(rest, &mut values, "`vt u v`")?;
        if n == 0 || n > 3 {
            return Err(
                Error::new(format!("`vt` with {n} numbers"), "1 to 3 (u v w)").hint("correct the line")
            );
        }
        push(&mut self.out.head, format_args!("vt {} {}\n", values[0], values[1]));
        self.counts[1] += 1;
        Ok(())
    }

    fn normal(&mut self, rest: &[u8]) -> Result<(), Error> {
        let mut values = [0.0; 3];
        let n = numbers(rest, &mut values, "`vn x y z`")?;
        if n != 3 {
            return Err(Error::new(format!("`vn` with {n} numbers"), "3 (x y z)").hint("correct the line"));
        }
        push(&mut self.out.head, format_args!("vn {} {} {}\n", values[0], values[1], values[2]));
        self.counts[2] += 1;
        Ok(())
    }

    fn face(&mut self, number: usize, rest: &[u8]) -> Result<(), Error> {
        self.out.body.push('f');
        let mut corners = 0;
        for word in words(rest) {
            self.corner(number, word)?;
            corners += 1;
        }
        if corners < 3 {
            let plural = if corners == 1 { "corner" } else { "corners" };
            return Err(Error::new(format!("a face with {corners} {plural}"), "at least 3 corners")
                .hint("correct or delete the line"));
        }
        self.out.body.push('\n');
        self.faces += 1;
        Ok(())
    }

    /// One of `v`, `v/vt`, `v//vn`, `v/vt/vn`.
    fn corner(&mut self, number: usize, word: &[u8]) -> Result<(), Error> {
        let bad = || {
            Error::new(
                format!("{} in a face", quote(word)),
                "whole numbers as in `v`, `v/vt`, `v//vn` or `v/vt/vn`",
            )
            .hint("correct the line")
        };
        let mut indices = [0_usize; 3];
        for (which, field) in word.split(|&b| b == b'/').enumerate() {
            let slot = indices.get_mut(which).ok_or_else(bad)?;
            if field.is_empty() {
                if which == 0 {
                    return Err(bad());
                }
                continue;
            }
            let index = integer(field).ok_or_else(bad)?;
            let have = self.counts[which];
            *slot = resolve(index, have).ok_or_else(|| out_of_range(field, which, have))?;
            if *slot > have {
                self.later.push((number, which, *slot));
            }
        }
        let [v, vt, vn] = indices;
        self.out.corners_with_uv += usize::from(vt > 0);
        // `vt` and `vn` move up by one, behind the stand-ins at the start; 0, not given, becomes 1, the stand-in.
        // The additions cannot overflow: an index that is not in the file ends the check before it is used.
        push(&mut self.out.body, format_args!(" {v}/{}/{}", vt.wrapping_add(1), vn.wrapping_add(1)));
        Ok(())
    }

    fn later_indices(&self) -> Result<(), (usize, Error)> {
        let missing = self.later.iter().find(|&&(_, which, index)| index > self.counts[which]);
        missing.map_or(Ok(()), |&(line, which, index)| {
            Err((line, out_of_range(index.to_string().as_bytes(), which, self.counts[which])))
        })
    }

    fn use_material(&mut self, number: usize, rest: &[u8]) {
        let name = String::from_utf8_lossy(rest).trim().to_owned();
        // An empty name would stop the reader; a name that no library has means the default material to it.
        push(&mut self.out.body, format_args!("usemtl {}\n", if name.is_empty() { "\u{1}" } else { &name }));
        if self.materials.insert(name.clone()) {
            self.out.materials.push(Named { name, line: number });
        }
    }
}

/// Fills `values` from the words of a line and returns how many words there are (which may be more).
fn numbers(rest: &[u8], values: &mut [f32], expected: &str) -> Result<usize, Error> {
    let mut n = 0;
    for word in words(rest) {
        let value = input::number(word).ok_or_else(|| {
            Error::new(quote(word), format!("a finite number in {expected}")).hint("correct the line")
        })?;
        if let Some(slot) = values.get_mut(n) {
            *slot = value;
        }
        n += 1;
    }
    Ok(n)
}

/// A whole number; one that is too large for the type is as wrong as the largest, and is reported as out of range.
fn integer(field: &[u8]) -> Option<i64> {
    match std::str::from_utf8(field).ok()?.parse::<i64>() {
        Ok(value) => Some(value),
        Err(error) => match error.kind() {
            IntErrorKind::PosOverflow => Some(i64::MAX),
            IntErrorKind::NegOverflow => Some(i64::MIN),
            _ => None,
        },
    }
}

/// The index from 1, with negative ones counted back from the last line so far.
fn resolve(index: i64, have: usize) -> Option<usize> {
    if index < 0 {
        let back = usize::try_from(index.unsigned_abs()).ok()?;
        (have + 1).checked_sub(back).filter(|&i| i > 0)
    } else {
        usize::try_from(index).ok().filter(|&i| i > 0)
    }
}

fn out_of_range(field: &[u8], which: usize, have: usize) -> Error {
    let (line_of, name) = (LINE_OF[which], NAME_OF[which]);
    let found = format!("{name} index {}", String::from_utf8_lossy(&field[..field.len().min(24)]));
    let expected = match (have, field.first()) {
        (0, _) => format!("none, as the file gives no `{line_of}` lines before it"),
        (_, Some(b'-')) => format!("-1 to -{have} (`{line_of}` lines so far: {have})"),
        _ => format!("1 to {have} (`{line_of}` lines: {have})"),
    };
    Error::new(found, expected).hint("indices count from 1; export the model again")
}

/// Writing to a string cannot fail.
fn push(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    let _ = text.write_fmt(arguments);
}

#[cfg(test)]
mod tests;
