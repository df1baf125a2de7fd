//! Filling the smaller levels.

use alberti_math::map2;

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
/// Where sides are powers of two, each texel is read once, in squares, and calls are as deep as there are levels.
/// Otherwise each level reads all of level 0: for a side of 250 texels that is seven times. No memory beside the stack.
///
/// # Errors
/// If a side is 0 or greater than 16384, or if there are not [`texel_count`] texels.
pub fn build<F: TexelFormat>(
    format: F,
    texels: &mut [F::Texel],
    width: u32,
    height: u32,
) -> Result<(), TextureError> {
    let area = width.saturating_mul(height) as usize;
    // For its errors.
    Texture::new(format, texels.get(..area).unwrap_or(texels), width, height)?;
    let (found, expected) = (texels.len(), texel_count(width, height));
    if found != expected {
        #[expect(clippy::cast_possible_truncation, reason = "at most 4/3 of 2^28")]
        return Err(TextureError::Length { found, expected: expected as u32 });
    }
    if width.is_power_of_two() && height.is_power_of_two() {
        let last = level_count(width, height) - 1;
        if last > 0 {
            Halves::new(format, texels, [width, height]).sums(last, [0, 0]);
        }
        return Ok(());
    }
    let (base, mut rest) = texels.split_at_mut_checked(area).unwrap_or_default();
    for level in 1..level_count(width, height) {
        let [columns, rows] = size_of_level([width, height], level);
        let (own, below) = rest.split_at_mut_checked((columns * rows) as usize).unwrap_or_default();
        for (texels, row) in own.chunks_exact_mut(columns as usize).zip(0..) {
            for (texel, column) in texels.iter_mut().zip(0..) {
                let rows = covered(base.chunks_exact(width as usize), row, [height, rows]);
                let texels = rows.flat_map(|(texels, weight)| {
                    let parts = covered(texels.iter(), column, [width, columns]);
                    parts.map(move |(&texel, part)| (texel, weight * part))
                });
                *texel = mean(format, texels);
            }
        }
        rest = below;
    }
    Ok(())
}

/// The mean of texels that count so many times.
fn mean<F: TexelFormat>(format: F, texels: impl Iterator<Item = (F::Texel, u64)>) -> F::Texel {
    let content = format.content();
    let (sums, weights) = texels.fold(([0; 4], 0), |(sums, weights), (texel, weight)| {
        (sum(sums, format.addends(content, texel).map(u64::from), weight), weights + weight)
    });
    format.mean(content, sums, weights)
}

/// A chain whose sides are powers of two. A texel covers whole texels of the level above, so that its sums are sums of
/// theirs, before these are rounded:
///
/// ```text
///  +---+---+-------+    in the order 1 2 3 4 (5), and so on: what waits for its
///  | 1 | 2 |       |    square to be full is a sum a level, not a row a level
///  +--(5)--+       |
///  | 3 | 4 |       |
///  +---+---+-------+
/// ```
struct Halves<'a, F: TexelFormat> {
    format: F,
    texels: &'a mut [F::Texel],
    size: [u32; 2],
    /// The places where levels begin.
    begin: [u32; MAX_LEVELS],
}

impl<'a, F: TexelFormat> Halves<'a, F> {
    fn new(format: F, texels: &'a mut [F::Texel], size: [u32; 2]) -> Self {
        let mut begin = [0; MAX_LEVELS];
        let mut end = 0;
        for (level, begin) in begin.iter_mut().enumerate() {
            *begin = end;
            let [columns, rows] = size_of_level(size, level);
            end += columns * rows;
        }
        Self { format, texels, size, begin }
    }

    /// The sums of the part of level 0 that a texel of a smaller level covers. It is filled, and so are those of
    /// smaller levels that it covers. Calls are as deep as there are levels.
    fn sums(&mut self, level: usize, [x, y]: [u32; 2]) -> [u64; 4] {
        let (format, content) = (self.format, self.format.content());
        let [columns, _] = size_of_level(self.size, level);
        let above = size_of_level(self.size, level - 1);
        // A side of one texel is not halved.
        let [across, down] = map2(above, |side| side.min(2));
        let mut sums = [0; 4];
        for row in y * down..(y + 1) * down {
            for column in x * across..(x + 1) * across {
                let part = if level == 1 {
                    let texel = self.texels.get((row * above[0] + column) as usize);
                    texel.map_or([0; 4], |&texel| format.addends(content, texel).map(u64::from))
                } else {
                    self.sums(level - 1, [column, row])
                };
                sums = sum(sums, part, 1);
            }
        }
        // Of level 0 on each axis.
        let [wide, high] = map2(self.size, |side| u64::from(side).min(1 << level));
        let begin = self.begin.get(level).copied().unwrap_or_default();
        if let Some(texel) = self.texels.get_mut((begin + y * columns + x) as usize) {
            *texel = format.mean(content, sums, wide * high);
        }
        sums
    }
}

/// Sums and a number of times others.
#[inline]
fn sum(sums: [u64; 4], [a, b, c, d]: [u64; 4], times: u64) -> [u64; 4] {
    let [e, f, g, h] = sums;
    [e + times * a, f + times * b, g + times * c, h + times * d]
}

/// Of `all` things in a row, those that place `i` of `places` covers, and how much of them: in `places`ths, in all
/// `all` of these.
fn covered<I: ExactSizeIterator>(
    things: I,
    i: u32,
    [all, places]: [u32; 2],
) -> impl Iterator<Item = (I::Item, u64)> {
    let [begin, end] = [i * all, (i + 1) * all];
    let first = begin / places;
    let count = end.div_ceil(places) - first;
    things.skip(first as usize).take(count as usize).zip(first..).map(move |(thing, k)| {
        let part = end.min((k + 1) * places) - begin.max(k * places);
        (thing, part.into())
    })
}
