//! Wavefront OBJ: positions, texture coordinates, normals and faces. All other lines are passed over.

use super::{ModelError, Shape};
use crate::numbers::{index, narrow};
use alberti::glam::{Vec2, Vec3};
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// The most vertices of a model.
const MAX_VERTICES: usize = 1 << 22;

/// The numbers of a corner's position, coordinates and normal.
type Corner = [Option<usize>; 3];

/// Reads a file. Faces with more than three corners become fans.
pub(super) fn read(file: &[u8]) -> Result<Shape, ModelError> {
    let mut reader = Reader::default();
    for (number, line) in (1..).zip(file.split(|byte| *byte == b'\n')) {
        // Bytes that are no text may be in a name, which is passed over.
        let line = String::from_utf8_lossy(line);
        let line = line.split('#').next().unwrap_or_default();
        reader.line(line).map_err(|fault| ModelError::Line(number, fault))?;
    }
    if reader.shape.triangles.is_empty() { Err(ModelError::Empty) } else { Ok(reader.shape.complete()) }
}

#[derive(Default)]
struct Reader {
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    seen: BTreeMap<Corner, u32>,
    shape: Shape,
}

impl Reader {
    fn line(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => self.positions.push(Vec3::from(numbers(words, line)?)),
            Some("vn") => self.normals.push(Vec3::from(numbers(words, line)?)),
            Some("vt") => self.uvs.push(Vec2::from(numbers(words, line)?)),
            Some("f") => {
                let corners = words.map(|word| self.corner(word)).collect::<Result<Vec<u32>, String>>()?;
                let [first, rest @ ..] = &corners[..] else {
                    return Err(format!("`{line}`: a face without corners"));
                };
                if rest.len() < 2 {
                    return Err(format!("`{line}`: a face takes three corners or more"));
                }
                self.shape.triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
            }
            _ => {}
        }
        Ok(())
    }

    /// The vertex of a corner, as `7`, `7/2`, `7//3` or `7/2/3`.
    fn corner(&mut self, word: &str) -> Result<u32, String> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let names = ["position", "texture coordinate", "normal"];
        let mut corner = [None; 3];
        for (k, part) in word.split('/').enumerate() {
            let (Some(place), Some(&count)) = (corner.get_mut(k), counts.get(k)) else {
                return Err(format!("`{word}`: a corner has at most three numbers"));
            };
            if part.is_empty() && k > 0 {
                continue;
            }
            let number: i64 = part.parse().map_err(|_| format!("`{word}`: `{part}` is no whole number"))?;
            // Numbers below zero count backwards from the last one.
            let from_zero = if number < 0 { i64::try_from(count).unwrap_or(0) + number } else { number - 1 };
            let found = usize::try_from(from_zero).ok().filter(|found| *found < count);
            *place = Some(found.ok_or_else(|| {
                format!("`{word}`: there is no {} {number}; so far there are {count}", names[k])
            })?);
        }
        if let Some(&vertex) = self.seen.get(&corner) {
            return Ok(vertex);
        }
        let vertex = self.shape.positions.len();
        if vertex >= MAX_VERTICES {
            return Err(format!("more than {MAX_VERTICES} vertices"));
        }
        let [position, uv, normal] = corner;
        let at = position.and_then(|k| self.positions.get(k)).ok_or(format!("`{word}`: no position"))?;
        self.shape.positions.push(*at);
        self.shape.uvs.push(uv.and_then(|k| self.uvs.get(k)).copied().unwrap_or_default());
        self.shape.normals.push(normal.and_then(|k| self.normals.get(k)).copied().unwrap_or_default());
        self.shape.has_uvs |= uv.is_some();
        self.seen.insert(corner, index(vertex));
        Ok(index(vertex))
    }
}

/// The first numbers of a line, which may have more.
fn numbers<'a, const N: usize>(
    mut words: impl Iterator<Item = &'a str>,
    line: &str,
) -> Result<[f32; N], String> {
    let mut numbers = [0.0_f32; N];
    for number in &mut numbers {
        let word = words.next().ok_or_else(|| format!("`{line}`: {N} numbers expected"))?;
        *number = decimal(word).ok_or_else(|| format!("`{line}`: `{word}` is no number"))?;
    }
    Ok(numbers)
}

/// A decimal number, within 2^-52 of itself before it is rounded; `None` if it is none, or not finite in `f32`.
///
/// The standard library's is correctly rounded, by tables that are a thirtieth of the program.
fn decimal(word: &str) -> Option<f32> {
    let (mantissa, exponent) = match word.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (word, 0),
    };
    let digits = mantissa.trim_start_matches(['+', '-']);
    let (integer, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let all = || integer.bytes().chain(fraction.bytes());
    if mantissa.len() > digits.len() + 1 || all().next().is_none() || !all().all(|c| c.is_ascii_digit()) {
        return None;
    }
    let value = all().fold(0.0, |value, digit| value * 10.0 + f64::from(digit - b'0'));
    let power = exponent.checked_sub(i32::try_from(fraction.len()).ok()?)?;
    let value = if mantissa.starts_with('-') { -value } else { value };
    let number = narrow(value * libm::exp10(f64::from(power)));
    number.is_finite().then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        read(text.as_bytes()).err().map(|error| format!("{error}")).unwrap_or_default()
    }

    #[test]
    fn corners_are_shared_and_faces_become_fans() {
        let text = "# a pentagon\no x\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0\nv -1 1 0\nvt 0 0 0\n\
                    vn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1 5/1/1\nf -5/-1/-1 -4/-1/-1 -3/-1/-1\n";
        let shape = read(text.as_bytes()).unwrap();
        assert_eq!(shape.triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 1, 2]]);
        assert_eq!(shape.positions.len(), 5);
        assert!(shape.has_uvs);
    }

    #[test]
    fn decimals_are_those_of_the_standard_library() {
        for word in [
            "0",
            "-1",
            "+2.5",
            "1.",
            ".5",
            "-0.123456789",
            "6.02e23",
            "1E-7",
            "123456.789",
            "16777217",
            "00.10",
        ] {
            let (found, expected) = (decimal(word).unwrap(), word.parse::<f32>().unwrap());
            assert!((found - expected).abs() <= f32::EPSILON * expected.abs(), "{word}: {found} {expected}");
        }
        for word in ["", "-", ".", "e5", "1e", "--1", "1e99", "1,5", "nan", "inf", "1e99999999999", "0x1"] {
            assert_eq!(decimal(word), None, "{word}");
        }
    }

    #[test]
    fn faults_have_their_line() {
        assert_eq!(fault("v 0 0 0\nv 1 0\n"), "line 2 of the model: `v 1 0`: 3 numbers expected");
        assert_eq!(
            fault("v 0 0 0\nf 1 1 2\n"),
            "line 2 of the model: `2`: there is no position 2; so far there are 1"
        );
        assert_eq!(
            fault("v 0 0 0\nf 1 1\n"),
            "line 2 of the model: `f 1 1`: a face takes three corners or more"
        );
        assert_eq!(fault("v a 0 0\n"), "line 1 of the model: `v a 0 0`: `a` is no number");
        assert!(fault("v 0 0 0\nf 1///4 1 1\n").contains("at most three"));
        assert!(fault("v 0 0 0\nf 1 1 9999999999999999999\n").contains("no whole number"));
        assert!(fault("\u{1}\u{2}").contains("no faces"));
    }
}
