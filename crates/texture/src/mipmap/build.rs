//! Filling the smaller levels.

use alberti_math::map2;
use core::mem::take;
use core::ops::Range;

use super::{MAX_LEVELS, level_count, size_of_level, texel_count};
use crate::format::TexelFormat;
use crate::{Texture, TextureError};

/// Fills all levels from level 0, which is at the beginning of `texels`.
///
/// A texel is the mean of the part of level 0 that it covers. Texels of level 0 count by the share of them that is
/// covered, also where sides are not powers of two:
///
/// ```text
///  5 texels   |   |   |   |   |   |      the first of two counts 1, 1 and 1/2
///  2 texels   |         |         |
/// ```
///
/// ```
/// use alberti_texture::{Mipmap, format::L8, mipmap};
///
/// let mut texels = [0; mipmap::texel_count(2, 2)];
/// texels[..4].copy_from_slice(&[0, 255, 255, 0]);
/// mipmap::build(L8, &mut texels, 2, 2)?;
/// let board = Mipmap::new(L8, &texels, 2, 2)?;
/// // Half of the light is far above half of the byte.
/// assert_eq!(board.level(1).texels(), [188]);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Precision
/// That of the format's [`Content`](crate::format::Content), for every level, as none is made from a rounded one.
///
/// # Cost
/// Levels that halve the one before share its sums, in squares, and calls are as deep as these levels. So each texel is
/// read once where sides are powers of two, and otherwise again after each level with an odd side: for 1000 texels six
/// times. No memory beside the stack.
///
/// # Errors
/// If a side is 0 or greater than 16384, or if there are not [`texel_count`] texels.
pub fn build<F: TexelFormat>(
    format: F,
    texels: &mut [F::Texel],
    width: u32,
    height: u32,
) -> Result<(), TextureError> {
    pieces(format, texels, width, height)?.for_each(Piece::build);
    Ok(())
}

/// The work of [`build`] in pieces, which threads may share: each fills some levels, and reads level 0. There is one
/// where sides are powers of two, and otherwise one more after each level with an odd side. The first has most to do,
/// and pieces may be [split](Piece::split) whose last level has more than one row.
///
/// # Errors
/// Those of [`build`].
pub fn pieces<F: TexelFormat>(
    format: F,
    texels: &mut [F::Texel],
    width: u32,
    height: u32,
) -> Result<Pieces<'_, F>, TextureError> {
    let area = width.saturating_mul(height) as usize;
    // For its errors.
    Texture::new(format, texels.get(..area).unwrap_or(texels), width, height)?;
    let (found, expected) = (texels.len(), texel_count(width, height));
    #[expect(clippy::cast_possible_truncation, reason = "at most 4/3 of 2^28")]
    let wrong = TextureError::Length { found, expected: expected as u32 };
    if found != expected {
        return Err(wrong);
    }
    let (largest, rest) = texels.split_at_mut_checked(area).ok_or(wrong)?;
    Ok(Pieces { format, largest, rest, size: [width, height], first: 1 })
}

/// The pieces of [`pieces`].
#[derive(Debug)]
pub struct Pieces<'a, F: TexelFormat> {
    format: F,
    /// Level 0.
    largest: &'a [F::Texel],
    /// The levels that are in no piece yet, and the first of them.
    rest: &'a mut [F::Texel],
    size: [u32; 2],
    first: usize,
}

impl<'a, F: TexelFormat> Iterator for Pieces<'a, F> {
    type Item = Piece<'a, F>;

    fn next(&mut self) -> Option<Piece<'a, F>> {
        let Self { format, largest, size, first, .. } = *self;
        let levels = level_count(size[0], size[1]);
        if first >= levels {
            return None;
        }
        let mut piece = Piece::new(format, largest, size, first);
        while piece.last + 1 < levels && piece.can_go_on() {
            piece.last += 1;
        }
        for (own, level) in piece.levels.iter_mut().zip(0..=piece.last).skip(first) {
            let [columns, rows] = size_of_level(size, level);
            let rest;
            (*own, rest) = take(&mut self.rest).split_at_mut_checked((columns * rows) as usize)?;
            self.rest = rest;
        }
        self.first = piece.last + 1;
        Some(piece)
    }
}

/// Levels, each of half the sides of the one before. A texel covers whole texels of that, so that its sums are sums of
/// theirs, before these are rounded:
///
/// ```text
///  +---+---+-------+    in the order 1 2 3 4 (5), and so on: what waits for its
///  | 1 | 2 |       |    square to be full is a sum a level, not a row a level
///  +--(5)--+       |
///  | 3 | 4 |       |
///  +---+---+-------+
/// ```
#[derive(Debug)]
pub struct Piece<'a, F: TexelFormat> {
    format: F,
    /// Level 0, and its size.
    largest: &'a [F::Texel],
    size: [u32; 2],
    /// The levels from the first, which is made of level 0, to the last. Of each those rows that the last one's cover,
    /// and the number of the first of them.
    levels: [&'a mut [F::Texel]; MAX_LEVELS],
    tops: [u32; MAX_LEVELS],
    first: usize,
    last: usize,
    /// On each axis the parts of level 0 that a texel of the first covers, and those of a texel of level 0.
    parts: [[u32; 2]; 2],
    /// The parts that a texel of each level covers.
    weights: [u64; MAX_LEVELS],
}

impl<'a, F: TexelFormat> Piece<'a, F> {
    fn new(format: F, largest: &'a [F::Texel], size: [u32; 2], first: usize) -> Self {
        let [columns, rows] = size_of_level(size, first);
        let parts = [lowest([size[0], columns]), lowest([size[1], rows])];
        let [[wide, _], [high, _]] = parts.map(|of| of.map(u64::from));
        let mut weights = [0; MAX_LEVELS];
        for (weight, level) in weights.iter_mut().skip(first).zip(0..) {
            let [columns, rows] = map2([columns, rows], |side| u64::from(side).min(1 << level));
            *weight = wide * high * columns * rows;
        }
        let (levels, tops) = Default::default();
        Self { format, largest, size, levels, tops, first, last: first, parts, weights }
    }

    /// The rows of the last level, and the columns.
    fn rows(&self) -> (Range<u32>, u32) {
        let [columns, _] = size_of_level(self.size, self.last);
        let top = self.tops.get(self.last).copied().unwrap_or_default();
        let texels = self.levels.get(self.last).map_or(0, |level| level.len());
        #[expect(clippy::cast_possible_truncation, reason = "at most 2^14 rows")]
        (top..top + (texels / columns as usize) as u32, columns)
    }

    /// Takes off the lower half of the rows, if the last level has more than one.
    pub fn split(&mut self) -> Option<Self> {
        let (Range { start, end }, _) = self.rows();
        let upper = (end - start) / 2;
        if upper == 0 {
            return None;
        }
        let mut lower = Self::new(self.format, self.largest, self.size, self.first);
        lower.last = self.last;
        let [_, all] = size_of_level(self.size, self.last);
        let levels = self.levels.iter_mut().zip(&self.tops).zip(lower.levels.iter_mut().zip(&mut lower.tops));
        for (level, ((own, top), (below, middle))) in levels.enumerate() {
            let [columns, rows] = size_of_level(self.size, level);
            // Whole numbers of rows for each of the last level.
            let upper = upper * (rows / all);
            *middle = top + upper;
            (*own, *below) = take(own).split_at_mut_checked((upper * columns) as usize).unwrap_or_default();
        }
        Some(lower)
    }

    /// Fills the levels.
    pub fn build(mut self) {
        let (rows, columns) = self.rows();
        for place in rows.flat_map(|y| (0..columns).map(move |x| [x, y])) {
            self.sums(self.last, place);
        }
    }

    /// Whether the level after the last one halves it, and its sums have room.
    fn can_go_on(&self) -> bool {
        let halves = size_of_level(self.size, self.last).iter().all(|side| *side == 1 || side % 2 == 0);
        halves && self.weights.get(self.last + 1).is_some_and(|weight| *weight <= MOST)
    }

    /// The sums of the part of level 0 that a texel covers. It is filled, and so are those of the levels from the first
    /// on that it covers. Calls are as deep as there are levels.
    fn sums(&mut self, level: usize, [x, y]: [u32; 2]) -> [u64; 4] {
        if level <= self.first {
            return self.sums_of_first([x, y]);
        }
        // A side of one texel is not halved.
        let [across, down] = map2(size_of_level(self.size, level - 1), |side| side.min(2));
        let mut sums = [0; 4];
        for row in y * down..(y + 1) * down {
            for column in x * across..(x + 1) * across {
                let place = [column, row];
                let part = if level == self.first + 1 {
                    self.sums_of_first(place)
                } else {
                    self.sums(level - 1, place)
                };
                sums = sum(sums, part, 1);
            }
        }
        self.fill(level, [x, y], sums);
        sums
    }

    /// The same of the first level.
    #[inline]
    fn sums_of_first(&mut self, [x, y]: [u32; 2]) -> [u64; 4] {
        let (format, content) = (self.format, self.format.content());
        let mut sums = [0; 4];
        if self.parts == [[2, 1]; 2] {
            let mut few = [0_u32; 4];
            for row in [2 * y, 2 * y + 1] {
                let begin = (row * self.size[0] + 2 * x) as usize;
                for &texel in self.largest.get(begin..begin + 2).unwrap_or_default() {
                    let addends = format.addends(content, texel);
                    few = [0, 1, 2, 3].map(|k: usize| few[k] + u32::from(addends[k]));
                }
            }
            sums = few.map(u64::from);
        } else {
            let [across, down] = [Covered::new(x, self.parts[0]), Covered::new(y, self.parts[1])];
            let rows = self.largest.chunks_exact(self.size[0] as usize);
            for (texels, weight) in down.of(rows) {
                sums = sum(sums, across.sums(format, texels), weight);
            }
        }
        self.fill(self.first, [x, y], sums);
        sums
    }

    /// Stores the mean that is made of these sums.
    #[inline]
    fn fill(&mut self, level: usize, [x, y]: [u32; 2], sums: [u64; 4]) {
        let [columns, _] = size_of_level(self.size, level);
        let get = |of: [u32; MAX_LEVELS]| of.get(level).copied().unwrap_or_default();
        let place = (y - get(self.tops)) * columns + x;
        let weights = self.weights.get(level).copied().unwrap_or_default();
        if let Some(texel) = self.levels.get_mut(level).and_then(|level| level.get_mut(place as usize)) {
            *texel = self.format.mean(self.format.content(), sums, weights);
        }
    }
}

/// The most that weights are together.
const MOST: u64 = 1 << 28;

/// A fraction in lowest terms.
fn lowest([above, below]: [u32; 2]) -> [u32; 2] {
    let (mut greatest, mut rest) = (above, below);
    while rest > 0 {
        (greatest, rest) = (rest, greatest % rest);
    }
    [above, below].map(|side| side / greatest.max(1))
}

/// Sums and a number of times others.
#[inline]
fn sum(sums: [u64; 4], [a, b, c, d]: [u64; 4], times: u64) -> [u64; 4] {
    let [e, f, g, h] = sums;
    [e + times * a, f + times * b, g + times * c, h + times * d]
}

/// The things in a row that one of `places` covers, whose ends may lie in things.
#[derive(Clone, Copy)]
struct Covered {
    first: usize,
    count: usize,
    /// The parts of a thing: one counts so many times.
    parts: u64,
    /// Of the first and of the last thing, the parts that are not covered.
    beside: [u64; 2],
}

impl Covered {
    /// Those that place `i` covers, if all places together are as wide as all things. It has `all` parts.
    fn new(i: u32, [all, places]: [u32; 2]) -> Self {
        let [begin, end] = [i * all, (i + 1) * all];
        if places == 1 {
            return Self { first: begin as usize, count: all as usize, parts: 1, beside: [0; 2] };
        }
        let (first, last) = (begin / places, end.div_ceil(places));
        let beside = [begin - first * places, last * places - end].map(u64::from);
        Self { first: first as usize, count: (last - first) as usize, parts: places.into(), beside }
    }

    /// Them with how many parts of each are covered.
    fn of<I>(self, things: impl Iterator<Item = I>) -> impl Iterator<Item = (I, u64)> {
        let [before, after] = self.beside;
        things.skip(self.first).take(self.count).zip(1..).map(move |(thing, k)| {
            let before = if k == 1 { before } else { 0 };
            let after = if k == self.count { after } else { 0 };
            (thing, self.parts - before - after)
        })
    }

    /// The sums of a row of texels, each as often as parts of it are covered: of all parts, less those beside.
    ///
    /// No sum of 2^14 addends has more than 30 bits.
    #[inline]
    fn sums<F: TexelFormat>(self, format: F, row: &[F::Texel]) -> [u64; 4] {
        let content = format.content();
        let Some(texels) = row.get(self.first..self.first + self.count) else { return [0; 4] };
        let addends =
            |texel: Option<&F::Texel>| texel.map_or([0; 4], |&texel| format.addends(content, texel));
        let all = texels.iter().fold([0_u32; 4], |[a, b, c, d], &texel| {
            let [e, f, g, h] = format.addends(content, texel).map(u32::from);
            [a + e, b + f, c + g, d + h]
        });
        let all = all.map(|sum| u64::from(sum) * self.parts);
        if self.beside == [0; 2] {
            return all;
        }
        let ends = [addends(texels.first()), addends(texels.last())];
        ends.into_iter().zip(self.beside).fold(all, |[a, b, c, d], (end, parts)| {
            let [e, f, g, h] = end.map(|addend| u64::from(addend) * parts);
            [a - e, b - f, c - g, d - h]
        })
    }
}
