//! A block of whole lines of an OBJ file, read by itself: its numbers, its faces, and what stands between them.
//!
//! Blocks are read side by side, so a block does not know how much came before it. Indices that count back, and errors
//! that tell how many lines there are, are completed when blocks are put together.

use std::num::IntErrorKind;
use std::ops::RangeInclusive;

use super::number::number;
use crate::error::{Error, quote};
use crate::load::statements::{Lines, Statement};

/// Coordinates are limited so that squared lengths of sums stay finite in f32.
pub(crate) const MAX_COORDINATE: f64 = 1e15;

/// The colour of vertices without one.
pub(crate) const WHITE: [f32; 3] = [1.0; 3];

/// The indices of a corner from 1: `v`, `vt` and `vn`; 0 where the file gives none.
pub(crate) type Corner = [u32; 3];

/// A polygon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    /// At least 3.
    pub(crate) corners: u32,
    /// From 1.
    pub(crate) line: u32,
}

/// A statement that faces after it obey.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Event {
    /// `o` or `g`.
    Object(String),
    /// `usemtl`, and its line.
    Material(String, usize),
    /// `s`: the number of the group; 0 for none.
    Smoothing(u32),
}

/// The things that are not drawn: one, and several.
pub(crate) const UNDRAWN: [[&str; 2]; 4] = [
    ["line (`l`)", "lines (`l`)"],
    ["point (`p`)", "points (`p`)"],
    ["curve or surface", "curves or surfaces"],
    ["face with fewer than 3 corners", "faces with fewer than 3 corners"],
];

/// The statements of the format that say nothing of faces, or more of a curve or surface that is counted.
const QUIET: [&[u8]; 30] = [
    b"vp",
    b"cstype",
    b"deg",
    b"bmat",
    b"step",
    b"parm",
    b"trim",
    b"hole",
    b"scrv",
    b"sp",
    b"end",
    b"con",
    b"mg",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"lod",
    b"maplib",
    b"usemap",
    b"shadow_obj",
    b"trace_obj",
    b"ctech",
    b"stech",
    b"call",
    b"csh",
    b"bsp",
    b"bzp",
    b"cdc",
    b"cdp",
    b"res",
];

/// Faces and the statements between them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Faces {
    /// Those of all faces, one after the other.
    pub(crate) corners: Vec<Corner>,
    pub(crate) faces: Vec<Face>,
    /// Each with the number of faces before it.
    pub(crate) events: Vec<(usize, Event)>,
}

/// An index that counts back.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relative {
    /// The corner in the block, and which of its indices.
    pub(crate) corner: usize,
    pub(crate) which: u8,
    pub(crate) back: u32,
    /// The lines of that kind so far, in the block.
    pub(crate) have: u32,
}

/// An error that ends the reading.
#[derive(Debug)]
pub(crate) enum Fault {
    Of(Error),
    /// An index that cannot exist: its text, of which kind, and the lines of that kind so far, in the block.
    Index(String, usize, usize),
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Self::Of(error)
    }
}

/// All that a block says.
#[derive(Debug, Default)]
pub(crate) struct Block {
    pub(crate) positions: Vec<[f64; 3]>,
    /// None, or one for each position.
    pub(crate) colors: Vec<[f32; 3]>,
    pub(crate) uvs: Vec<[f32; 2]>,
    pub(crate) normals: Vec<[f32; 3]>,
    pub(crate) faces: Faces,
    pub(crate) relative: Vec<Relative>,
    /// The greatest index of each kind.
    pub(crate) greatest: [u32; 3],
    /// The text of the first index that is too large for its type, there the greatest.
    pub(crate) huge: Option<String>,
    /// The arguments of `mtllib`, and their lines.
    pub(crate) libraries: Vec<(String, usize)>,
    pub(crate) corners_with_uv: usize,
    pub(crate) colors_out_of_range: usize,
    /// Statements of things that are no faces: [`UNDRAWN`].
    pub(crate) undrawn: [usize; 4],
    /// The word of the first statement that the format has not, its line, and how many there are.
    pub(crate) unknown: Option<(String, usize, usize)>,
    /// The first line of a normal or of texture coordinates that are no numbers, and how many there are.
    pub(crate) no_numbers: Option<(usize, usize)>,
    /// Whether there are lines as tables of a scene file have them.
    pub(crate) has_tables: bool,
    /// Physical lines.
    pub(crate) lines: usize,
    /// The first error, and its line.
    pub(crate) fault: Option<(usize, Fault)>,
}

impl Block {
    /// Reads a block, up to its first error. Lines count from 1 in it.
    ///
    /// Counted: lines, points, curves, surfaces, faces of one or two corners, and what the format has not. Ignored is
    /// what [`QUIET`] has. An index may point to a later line, as some exporters write it,
    /// unless it is negative.
    pub(crate) fn read(bytes: &[u8]) -> Self {
        let mut block = Self::default();
        let mut lines = Lines::new(bytes);
        for (number, line) in lines.by_ref() {
            if let Err(fault) = block.statement(&Statement::new(number, &line)) {
                block.fault = Some((number, fault));
                break;
            }
        }
        if !block.colors.is_empty() {
            block.colors.resize(block.positions.len(), WHITE);
        }
        block.lines = lines.count_so_far();
        block
    }

    fn statement(&mut self, line: &Statement<'_>) -> Result<(), Fault> {
        let mut event = |event| self.faces.events.push((self.faces.faces.len(), event));
        match line.word {
            b"v" => self.vertex(line)?,
            b"vt" => {
                let uvw = if self.has_no_number(line) {
                    [0.0; 3]
                } else {
                    numbers(line, 1..=3, "`vt u v`", "1 to 3 (u v w)")?.0
                };
                self.uvs.push([narrow(uvw[0]), narrow(uvw[1])]);
            }
            b"vn" => {
                let normal = if self.has_no_number(line) {
                    [0.0; 3]
                } else {
                    numbers(line, 3..=3, "`vn x y z`", "3 (x y z)")?.0
                };
                self.normals.push(normal.map(narrow));
            }
            // The second is of files older than the format's last edition.
            b"f" | b"fo" => self.face(line)?,
            b"o" | b"g" => event(Event::Object(line.name())),
            b"s" => event(Event::Smoothing(smoothing(line))),
            b"usemtl" => event(Event::Material(line.name(), line.line)),
            b"mtllib" => self.libraries.push((line.name(), line.line)),
            b"l" => self.undrawn[0] += 1,
            b"p" => self.undrawn[1] += 1,
            b"curv" | b"curv2" | b"surf" => self.undrawn[2] += 1,
            word if word.is_empty() || word[0] == b'#' || QUIET.contains(&word) => {}
            word => {
                self.has_tables |= word[0] == b'[';
                self.unknown.get_or_insert_with(|| (quote(word), line.line, 0)).2 += 1;
            }
        }
        Ok(())
    }

    /// Whether the line has one of the words that programs write for what is no number, or for one beyond all. Such
    /// lines are counted.
    fn has_no_number(&mut self, line: &Statement<'_>) -> bool {
        let is_none = |word: &[u8]| {
            let word = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
            [&b"nan"[..], b"inf", b"1.#"]
                .iter()
                .any(|of| word.get(..3).is_some_and(|w| w.eq_ignore_ascii_case(of)))
        };
        let found = line.words().any(is_none);
        if found {
            self.no_numbers.get_or_insert((line.line, 0)).1 += 1;
        }
        found
    }

    fn vertex(&mut self, line: &Statement<'_>) -> Result<(), Error> {
        let wanted = "3 (x y z), 4 (x y z w) or 6 (x y z r g b)";
        let ([x, y, z, r, g, b], n) = numbers(line, 3..=6, "`v x y z` with an optional w or r g b", wanted)?;
        let position = match n {
            3 | 6 => [x, y, z],
            4 => [x, y, z].map(|x| x / r),
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
        if n == 6 {
            let color = [r, g, b].map(narrow);
            self.colors_out_of_range += usize::from(color.iter().any(|c| !(0.0..=1.0).contains(c)));
            self.colors.resize(self.positions.len(), WHITE);
            self.colors.push(color.map(|c| c.clamp(0.0, 1.0)));
        }
        self.positions.push(position);
        Ok(())
    }

    fn face(&mut self, line: &Statement<'_>) -> Result<(), Fault> {
        let first = self.faces.corners.len();
        for word in line.words() {
            let corner = match absolute(word) {
                Some(corner) => corner,
                None => self.corner(word)?,
            };
            for (greatest, index) in self.greatest.iter_mut().zip(corner) {
                *greatest = index.max(*greatest);
            }
            self.corners_with_uv += usize::from(corner[1] > 0);
            self.faces.corners.push(corner);
        }
        let corners = self.faces.corners.len() - first;
        if corners < 3 {
            self.undrawn[3] += 1;
            let with_uv = self.faces.corners[first..].iter().filter(|corner| corner[1] > 0).count();
            self.corners_with_uv -= with_uv;
            self.relative.retain(|relative| relative.corner < first);
            self.faces.corners.truncate(first);
            return Ok(());
        }
        // A line has fewer corners than bytes, and a file fewer of both than 4 billion.
        let [corners, line] = [corners, line.line].map(|x| u32::try_from(x).unwrap_or(u32::MAX));
        self.faces.faces.push(Face { corners, line });
        Ok(())
    }

    /// One of `v`, `v/vt`, `v//vn`, `v/vt/vn`. An index that counts back is 1 for now.
    fn corner(&mut self, word: &[u8]) -> Result<Corner, Fault> {
        let bad = || {
            Error::new(
                format!("{} in a face", quote(word)),
                "whole numbers as in `v`, `v/vt`, `v//vn` or `v/vt/vn`",
            )
            .hint("correct the line")
        };
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let mut corner = [0; 3];
        for (which, field) in word.split(|&b| b == b'/').enumerate() {
            let slot = corner.get_mut(which).ok_or_else(bad)?;
            if field.is_empty() {
                if which == 0 {
                    return Err(bad().into());
                }
                continue;
            }
            let index = integer(field).ok_or_else(bad)?;
            let missing = || Fault::Index(shown(field), which, counts[which]);
            if index > 0 {
                *slot = u32::try_from(index).ok().filter(|&i| i < u32::MAX).unwrap_or_else(|| {
                    self.huge.get_or_insert_with(|| shown(field));
                    u32::MAX
                });
            } else {
                let back =
                    u32::try_from(index.unsigned_abs()).ok().filter(|&back| back > 0).ok_or_else(missing)?;
                let have = u32::try_from(counts[which]).map_err(|_| missing())?;
                let which = u8::try_from(which).unwrap_or_default();
                self.relative.push(Relative { corner: self.faces.corners.len(), which, back, have });
                *slot = 1;
            }
        }
        Ok(corner)
    }
}

/// A corner of indices above 0 that are surely small enough: what nearly all are.
fn absolute(word: &[u8]) -> Option<Corner> {
    let (mut corner, mut which, mut index, mut digits) = ([0; 3], 0, 0_u32, 0);
    for &byte in word {
        match byte {
            b'0'..=b'9' => {
                index = index * 10 + u32::from(byte - b'0');
                digits += 1;
                if digits > 8 {
                    return None;
                }
            }
            b'/' if which < 2 => {
                if index == 0 && (digits > 0 || which == 0) {
                    return None;
                }
                corner[which] = index;
                (which, index, digits) = (which + 1, 0, 0);
            }
            _ => return None,
        }
    }
    if index == 0 && (digits > 0 || which == 0) {
        return None;
    }
    corner[which] = index;
    Some(corner)
}

/// The number of a group. A name stands for group 1, and `off` for none; what is no name is none.
fn smoothing(line: &Statement<'_>) -> u32 {
    match line.words().next() {
        None => 0,
        Some(word) if word.eq_ignore_ascii_case(b"off") => 0,
        Some(word) => std::str::from_utf8(word).ok().and_then(|word| word.parse().ok()).unwrap_or(1),
    }
}

/// The numbers of a line, which has to have so many. `form` and `wanted` are for messages.
fn numbers<const N: usize>(
    line: &Statement<'_>,
    counts: RangeInclusive<usize>,
    form: &str,
    wanted: &str,
) -> Result<([f64; N], usize), Error> {
    let (mut numbers, mut n) = ([0.0; N], 0);
    for word in line.words() {
        let x = number(word).ok_or_else(|| {
            let too_large =
                std::str::from_utf8(word).is_ok_and(|word| word.parse().is_ok_and(f64::is_finite));
            let kind = if too_large { "a smaller number" } else { "a finite number" };
            Error::new(quote(word), format!("{kind} in {form}")).hint("correct the line")
        })?;
        if let Some(slot) = numbers.get_mut(n) {
            *slot = x;
        }
        n += 1;
    }
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

fn shown(field: &[u8]) -> String {
    String::from_utf8_lossy(&field[..field.len().min(24)]).into_owned()
}

fn narrow(x: f64) -> f32 {
    crate::scene::normals::narrow(x)
}
