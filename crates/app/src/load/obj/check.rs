//! An OBJ file, checked line by line and rewritten in the plain form that the reader behind it expects.
//!
//! `tobj` reads the file, but says neither where an error is nor whether a number is finite, and panics on some
//! indices. In its one-index mode it loses track when only some corners of a mesh have a texture coordinate or a
//! normal, or only some vertices a colour. So every line is checked here first, and `tobj` gets text in which every `v`
//! has a colour and every corner three positive indices. Index 1 of the texture coordinates and of the normals stands
//! for "the file gives none".

use std::collections::HashSet;
use std::fmt::{Arguments, Write as _};
use std::num::IntErrorKind;
use std::ops::RangeInclusive;
use std::path::Path;

use crate::error::{Error, quote};
use crate::load::statements::{Lines, Statement, not_text};

/// Coordinates are limited so that squared lengths of sums stay finite in f32.
pub(crate) const MAX_COORDINATE: f32 = 1e15;

/// The name of an OBJ model in messages.
pub(crate) const KIND: &str = "a Wavefront OBJ model";

/// A name in the file, and the line where it comes first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Named {
    /// Trimmed.
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
        check.statement(&Statement::new(number, &line)).map_err(|e| e.file(path).line(number))?;
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
    fn statement(&mut self, line: &Statement<'_>) -> Result<(), Error> {
        match line.word {
            b"v" => self.vertex(line)?,
            b"vt" => {
                let ([u, v, _], _) = numbers(line, 1..=3, "`vt u v`", "1 to 3 (u v w)")?;
                self.attribute(1, format_args!("vt {u} {v}\n"));
            }
            b"vn" => {
                let ([x, y, z], _) = numbers(line, 3..=3, "`vn x y z`", "3 (x y z)")?;
                self.attribute(2, format_args!("vn {x} {y} {z}\n"));
            }
            b"f" => self.face(line)?,
            b"o" | b"g" => push(&mut self.out.body, format_args!("o {}\n", line.name())),
            b"usemtl" => {
                let name = line.name();
                // An empty name would stop the reader; a name that no library has means the default material to it.
                let known = if name.is_empty() { "\u{1}" } else { &name };
                push(&mut self.out.body, format_args!("usemtl {known}\n"));
                if self.materials.insert(name.clone()) {
                    self.out.materials.push(Named { name, line: line.line });
                }
            }
            b"mtllib" => self.out.libraries.push(Named { name: line.name(), line: line.line }),
            _ => {}
        }
        Ok(())
    }

    fn vertex(&mut self, line: &Statement<'_>) -> Result<(), Error> {
        let wanted = "3 (x y z), 4 (x y z w) or 6 (x y z r g b)";
        let ([x, y, z, r, g, b], n) = numbers(line, 3..=6, "`v x y z` with an optional w or r g b", wanted)?;
        let (position, color) = match n {
            3 => ([x, y, z], [1.0; 3]),
            4 => ([x, y, z].map(|x| x / r), [1.0; 3]),
            6 => ([x, y, z], [r, g, b]),
            n => return Err(miscounted(line, n, wanted)),
        };
        // Not (a <= b): a division by w = 0 may have made a NaN.
        if let Some(bad) = position.iter().find(|x| x.is_nan() || x.abs() > MAX_COORDINATE) {
            return Err(Error::new(
                format!("a coordinate of {bad:e}"),
                format!("coordinates within ±{MAX_COORDINATE:e}, after division by a w other than 0"),
            )
            .hint("scale the model"));
        }
        self.out.colors_out_of_range += usize::from(color.iter().any(|c| !(0.0..=1.0).contains(c)));
        let ([x, y, z], [r, g, b]) = (position, color);
        self.attribute(0, format_args!("v {x} {y} {z} {r} {g} {b}\n"));
        Ok(())
    }

    /// Passes a `v`, `vt` or `vn` on.
    fn attribute(&mut self, which: usize, text: Arguments<'_>) {
        push(&mut self.out.head, text);
        self.counts[which] += 1;
    }

    fn face(&mut self, line: &Statement<'_>) -> Result<(), Error> {
        self.out.body.push('f');
        let mut corners = 0;
        for word in line.words() {
            self.corner(line.line, word)?;
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
}

/// The numbers of a line, which has to have so many. `form` and `wanted` are for messages.
fn numbers<const N: usize>(
    line: &Statement<'_>,
    counts: RangeInclusive<usize>,
    form: &str,
    wanted: &str,
) -> Result<([f32; N], usize), Error> {
    let (numbers, n) = line.numbers().map_err(|word| {
        Error::new(quote(word), format!("a finite number in {form}")).hint("correct the line")
    })?;
    if counts.contains(&n) { Ok((numbers, n)) } else { Err(miscounted(line, n, wanted)) }
}

fn miscounted(line: &Statement<'_>, n: usize, wanted: &str) -> Error {
    Error::new(format!("`{}` with {n} numbers", line.keyword()), wanted).hint("correct the line")
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
fn push(text: &mut String, arguments: Arguments<'_>) {
    let _ = text.write_fmt(arguments);
}

#[cfg(test)]
mod tests;
