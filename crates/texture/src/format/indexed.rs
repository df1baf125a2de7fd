//! Texels that are places in a palette.

use alberti_math::Rgba8;
use alberti_math::lanes::Lanes;

use super::Storage;
use crate::sealed::Sealed;
use crate::{Size, Texture};
use core::fmt::Debug;

/// Indices of 1, 2, 4 or 8 bits, whose colours are in a palette that the texture refers to. The texture takes as
/// many bits a texel, instead of 32, and the palette can be another one for every view.
///
/// The leftmost texel is in the highest bits of a byte, and each row begins with a byte of its own, as in PNG and BMP
/// files. An index beyond the palette is transparent black. Filters work on the colours. [`Indexed1`], [`Indexed2`],
/// [`Indexed4`] and [`Indexed8`] are its names.
///
/// ```
/// use alberti_texture::{Texture, format::{Indexed1, Rgba8}};
///
/// // A checkerboard of 3 x 2, and its colours.
/// let bytes = [0b1010_0000, 0b0100_0000];
/// let board = Texture::new(Indexed1 { palette: &[Rgba8::BLACK, Rgba8::WHITE] }, &bytes, 3, 2)?;
/// assert_eq!(board.texel(0, 0), Rgba8::WHITE);
/// assert_eq!(board.texel(0, 1), Rgba8::BLACK);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Cost
/// A texel takes two loads and two comparisons instead of one of each, and a shift and a mask.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Indexed<'a, const BITS: u32, C = Rgba8> {
    /// The colours, the first of index 0; it may be shorter than the indices reach. They are [`Rgba8`], or, in a file
    /// that is read in place, four bytes each.
    pub palette: &'a [C],
}

/// [`Indexed`] texels of one bit.
pub type Indexed1<'a, C = Rgba8> = Indexed<'a, 1, C>;
/// [`Indexed`] texels of two bits.
pub type Indexed2<'a, C = Rgba8> = Indexed<'a, 2, C>;
/// [`Indexed`] texels of four bits.
pub type Indexed4<'a, C = Rgba8> = Indexed<'a, 4, C>;
/// [`Indexed`] texels of a byte.
pub type Indexed8<'a, C = Rgba8> = Indexed<'a, 8, C>;

/// A colour of a palette: [`Rgba8`], or its four bytes. Sealed.
pub trait PaletteColor: Sealed + Copy + Debug + Send + Sync + 'static {
    /// The bits of the [`Rgba8`].
    fn bits(self) -> u32;
}

impl Sealed for Rgba8 {}
impl PaletteColor for Rgba8 {
    #[inline(always)]
    fn bits(self) -> u32 {
        self.to_bits()
    }
}

impl Sealed for [u8; 4] {}
impl PaletteColor for [u8; 4] {
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from_le_bytes(self)
    }
}

impl<const BITS: u32, C: PaletteColor> Sealed for Indexed<'_, BITS, C> {}

impl<const BITS: u32, C: PaletteColor> Storage for Indexed<'_, BITS, C> {
    type Element = u8;

    const IN_ELEMENT: u32 = {
        assert!(BITS.is_power_of_two() && BITS <= 8, "Indexed: 1, 2, 4 or 8 bits");
        8 / BITS
    };

    #[inline(always)]
    fn fetch<L: Lanes, Z: Size>(
        self,
        lanes: L,
        texture: &Texture<'_, Self, Z>,
        row: L::U32,
        column: L::U32,
    ) -> L::U32 {
        let (bytes, palette) = (texture.texels(), self.palette);
        let from_right = lanes.word(Self::IN_ELEMENT - 1) - (column & lanes.word(Self::IN_ELEMENT - 1));
        let shifts = lanes.store_words(from_right * lanes.word(BITS));
        let first = row * lanes.word(texture.width().div_ceil(Self::IN_ELEMENT));
        let places = lanes.store_words(first + lanes.shr(column, Self::IN_ELEMENT.trailing_zeros()));
        let at = |words: &[u32], k: usize| words.get(k).copied().unwrap_or_default();
        lanes.load_words(&lanes.each(|k| {
            let byte = bytes.get(at(places.as_ref(), k) as usize).copied().unwrap_or_default();
            let index = u32::from(byte).wrapping_shr(at(shifts.as_ref(), k)) & ((1 << BITS) - 1);
            palette.get(index as usize).map_or(0, |color| color.bits())
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All texels of odd and even widths, by the digits of the rows as numbers.
    fn check<const BITS: u32>(palette: &[Rgba8]) {
        for width in 1..=20 {
            let row_bytes = (width * BITS).div_ceil(8);
            let bytes: std::vec::Vec<u8> =
                (0..row_bytes * 3).map(|i| (i * 151 + 77).to_le_bytes()[0]).collect();
            let texture = Texture::new(Indexed::<BITS> { palette }, &bytes, width, 3).unwrap();
            let colors: std::vec::Vec<_> = palette.iter().map(|color| color.to_bytes()).collect();
            let palette_of_bytes = Indexed::<BITS, _> { palette: &colors };
            let texture_of_bytes = Texture::new(palette_of_bytes, &bytes, width, 3).unwrap();
            for y in 0..3 {
                let row = &bytes[(y * row_bytes) as usize..][..row_bytes as usize];
                // A row as one number of up to 160 bits, in two halves that no texel straddles.
                let number = |bytes: &[u8]| bytes.iter().fold(0u128, |n, &b| n << 8 | u128::from(b));
                for x in 0..width {
                    let end = (x + 1) * BITS;
                    let upto = &row[..end.div_ceil(8) as usize];
                    let last = &upto[upto.len().saturating_sub(8)..];
                    let index = (number(last) >> (end.next_multiple_of(8) - end)) as usize % (1 << BITS);
                    let expected = palette.get(index).copied().unwrap_or_default();
                    assert_eq!(texture.texel(x, y), expected, "{BITS} bits, {x} of {width}");
                    assert_eq!(texture_of_bytes.texel(x, y), expected, "{BITS} bits, {x} of {width}");
                }
            }
            assert!(Texture::new(Indexed::<BITS> { palette }, &bytes[1..], width, 3).is_err());
        }
    }

    #[test]
    fn texels_are_digits_of_rows() {
        let mut noise = 1u32;
        let palette = [(); 256].map(|()| {
            noise = noise.wrapping_mul(0x9e37_79b9);
            Rgba8::from_bits(noise)
        });
        check::<1>(&palette[..2]);
        check::<2>(&palette[..4]);
        check::<4>(&palette[..16]);
        check::<8>(&palette);
        // Shorter than the indices reach.
        check::<4>(&palette[..10]);
        check::<1>(&[]);
    }
}
