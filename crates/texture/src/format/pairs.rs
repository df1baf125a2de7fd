//! Texels with their neighbours, for filters on small cores.

use super::{Rgb565, TexelFormat};
use crate::mipmap::{level_count, size_of_level};
use crate::packed::{Packed, SPREAD};
use alberti_math::Rgba8;
use alberti_math::lanes::Lanes;

/// [`Rgb565`] texels, each with the one to its right in the same word, and both with their channels apart.
///
/// A bilinear filter reads one load and two masks of a row, where it is [`Repeat`](crate::Repeat) from left to
/// right. With other wraps there is a load for each texel.
///
/// ```text
/// bit 31    27 26         21 20     16 15    11 10          5 4      0
///     next red |    green   | next blue |  red  | next green |  blue
/// ```
///
/// ```
/// use alberti_texture::{Repeat, Bilinear, Texture, format::Rgb565Pairs};
///
/// // Red and blue, as part of a program.
/// static TEXELS: [u32; 2] = Rgb565Pairs::of(&[0xf800, 0x001f], 2, 1);
/// let sampler = Texture::new(Rgb565Pairs, &TEXELS, 2, 1)?.sampler(Bilinear, Repeat);
/// assert_eq!(sampler.texture().texel(1, 0).to_bytes(), [0, 0, 255, 255]);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Precision
/// That of [`Rgb565`]; filters give the same.
///
/// # Cost
/// Four bytes a texel, for bilinear means of [`packed_lanes`](crate::Sampler::packed_lanes) at two thirds to three
/// quarters of the price.
/// Encoding makes texels that are their own neighbours; [`link`](Self::link) makes neighbours of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgb565Pairs;

impl Rgb565Pairs {
    /// The texels of a texture, or of all or some of its levels one after the other, with their neighbours.
    ///
    /// Neighbours are as in [`link`](Self::link).
    #[must_use]
    pub const fn of<const N: usize>(texels: &[u16; N], width: u32, height: u32) -> [u32; N] {
        let mut pairs = [0; N];
        let mut k = 0;
        while k < N {
            pairs[k] = pair(texels[k], texels[k]);
            k += 1;
        }
        Self::link(&mut pairs, width, height);
        pairs
    }

    /// Gives each texel of a texture, or of all or some of its levels one after the other, the one to its right.
    ///
    /// The last of a row has the first. Texels beyond the levels stay as they are, and so do those of a row that is not
    /// whole.
    pub const fn link(texels: &mut [u32], width: u32, height: u32) {
        let (mut begin, mut level) = (0, 0);
        while level < level_count(width, height) {
            let [width, height] = size_of_level([width, height], level);
            let mut row = 0;
            while row < height && begin + (width as usize) <= texels.len() {
                let (_, rest) = texels.split_at_mut(begin);
                let (row_of, _) = rest.split_at_mut(width as usize);
                link_row(row_of);
                begin += width as usize;
                row += 1;
            }
            level += 1;
        }
    }
}

/// Gives each texel the next.
const fn link_row(row: &mut [u32]) {
    let Some(&first) = row.first() else { return };
    let mut k = 0;
    while k < row.len() {
        let next = if k + 1 < row.len() { row[k + 1] } else { first };
        row[k] = (row[k] & SPREAD) | (next & SPREAD).rotate_left(16);
        k += 1;
    }
}

/// A texel and the next.
const fn pair(texel: u16, next: u16) -> u32 {
    let [texel, next] = [texel as u32 * 0x0001_0001, next as u32 * 0x0001_0001];
    (texel & SPREAD) | (next & !SPREAD)
}

/// The texel of a word.
#[expect(clippy::cast_possible_truncation, reason = "the lower half is meant")]
const fn first(word: u32) -> u16 {
    let apart = word & SPREAD;
    (apart | apart >> 16) as u16
}

impl TexelFormat for Rgb565Pairs {
    type Texel = u32;

    #[inline]
    fn decode(self, texel: u32) -> Rgba8 {
        Rgb565.decode(first(texel))
    }

    #[inline]
    fn encode(self, color: Rgba8) -> u32 {
        let texel = Rgb565.encode(color);
        pair(texel, texel)
    }
}

impl Packed for Rgb565Pairs {
    const PAIRS: bool = true;

    #[inline(always)]
    fn word(texel: u32) -> u32 {
        texel
    }

    #[inline(always)]
    fn texel<L: Lanes>(lanes: L, word: L::U32) -> L::U32 {
        word & lanes.word(SPREAD)
    }

    #[inline(always)]
    fn next<L: Lanes>(lanes: L, word: L::U32) -> L::U32 {
        Self::texel(lanes, lanes.shl(word, 16) | lanes.shr(word, 16))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every texel, by its fields.
    #[test]
    fn texels_are_those_of_words() {
        for texel in 0..=u16::MAX {
            let next = texel.wrapping_mul(40_503).wrapping_add(77);
            let word = pair(texel, next);
            let [red, green, blue] = [texel >> 11, texel >> 5 & 63, texel & 31].map(u32::from);
            let [next_red, next_green, next_blue] = [next >> 11, next >> 5 & 63, next & 31].map(u32::from);
            let right = next_red << 27 | green << 21 | next_blue << 16 | red << 11 | next_green << 5 | blue;
            assert_eq!(word, right, "{texel:x} and {next:x}");
            assert_eq!(Rgb565Pairs.decode(word), Rgb565.decode(texel));
            assert_eq!(Rgb565Pairs.encode(Rgb565.decode(texel)), pair(texel, texel));
        }
    }

    /// Rows are those of their levels, and what is beyond stays.
    #[test]
    fn the_last_texel_of_a_row_is_linked_to_the_first() {
        const TEXELS: [u16; 6] = [1, 2, 3, 4, 5, 6];
        // A level of 2 x 2, one of 1 x 1, and a texel too many.
        const LINKED: [u32; 6] = Rgb565Pairs::of(&TEXELS, 2, 2);
        let next = [2, 1, 4, 3, 5, 6];
        for (k, word) in LINKED.into_iter().enumerate() {
            assert_eq!(word, pair(TEXELS[k], next[k]), "{k}");
        }
        let mut none = [pair(1, 1); 3];
        Rgb565Pairs::link(&mut none, 5, 4);
        assert_eq!(none, [pair(1, 1); 3]);
        Rgb565Pairs::link(&mut none, 0, 0);
        Rgb565Pairs::link(&mut none, u32::MAX, u32::MAX);
        Rgb565Pairs::link(&mut [], 1, 1);
    }
}
