//! Filling the smaller levels.

use super::{level_count, size_of_level, texel_count};
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
/// Each level reads all of level 0: for a side of 256 texels that is eight times. No memory.
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
                *texel = format.mean(format.content(), texels);
            }
        }
        rest = below;
    }
    Ok(())
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
