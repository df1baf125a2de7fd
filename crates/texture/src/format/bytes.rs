//! Texels in files that are read in place, where words may begin at any byte.

use super::{Content, L16, Rgb565, Rgb565Alpha, Rgb565Be, Rgb565Le, Rgb565Pairs, Rgba4444, TexelFormat};
use crate::Packed;
use crate::mipmap::Weights;
use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Rgba565};

/// A format of words whose texels are bytes, at any address: the low one first, but for [`Rgb565Be`].
///
/// ```
/// use alberti_texture::{Texture, format::{InBytes, Rgb565}};
///
/// // Part of a file: red, and green.
/// let (texels, _) = [0x00, 0xf8, 0xe0, 0x07].as_chunks::<2>();
/// let texture = Texture::new(InBytes(Rgb565), texels, 2, 1)?;
/// assert_eq!(texture.texel(1, 0).to_bytes(), [0, 255, 0, 255]);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Cost
/// Where words may not be loaded from any address, a load, a shift and a sum more for each byte beyond the first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct InBytes<F>(
    /// The format.
    pub F,
);

/// Formats whose words are made of bytes by the first function, and made into bytes by the second.
macro_rules! in_bytes {
    ($($format:ty: $word:ty, $of:ident, $to:ident;)*) => {$(
        impl TexelFormat for InBytes<$format> {
            type Texel = [u8; size_of::<$word>()];

            #[inline]
            fn content(self) -> Content {
                self.0.content()
            }

            #[inline]
            fn decode(self, texel: [u8; size_of::<$word>()]) -> Rgba8 {
                self.0.decode(<$word>::$of(texel))
            }

            #[inline(always)]
            fn native(self, texel: [u8; size_of::<$word>()]) -> [u8; size_of::<$word>()] {
                self.0.native(<$word>::$of(texel)).to_le_bytes()
            }

            #[inline(always)]
            fn rgba565(self, texel: [u8; size_of::<$word>()]) -> Rgba565 {
                self.0.rgba565(<$word>::$of(texel))
            }

            #[inline]
            fn scalar(self, texel: [u8; size_of::<$word>()]) -> u16 {
                self.0.scalar(<$word>::$of(texel))
            }

            #[inline]
            fn encode(self, color: Rgba8) -> [u8; size_of::<$word>()] {
                self.0.encode(color).$to()
            }

            #[inline]
            fn addends(self, content: Content, texel: [u8; size_of::<$word>()]) -> [u16; 4] {
                self.0.addends(content, <$word>::$of(texel))
            }

            #[inline]
            fn mean(self, content: Content, sums: [u64; 4], weights: Weights) -> [u8; size_of::<$word>()] {
                self.0.mean(content, sums, weights).$to()
            }
        }
    )*};
}
in_bytes! {
    Rgb565: u16, from_le_bytes, to_le_bytes;
    Rgba4444: u16, from_le_bytes, to_le_bytes;
    L16: u16, from_le_bytes, to_le_bytes;
    Rgb565Pairs: u32, from_le_bytes, to_le_bytes;
    Rgb565Alpha: u32, from_le_bytes, to_le_bytes;
    // Their words have the order in memory already.
    Rgb565Le: u16, from_ne_bytes, to_ne_bytes;
    Rgb565Be: u16, from_ne_bytes, to_ne_bytes;
}

/// Mixing is that of the words.
macro_rules! packed {
    ($($format:ty: $of:ident;)*) => {$(
        impl Packed for InBytes<$format> {
            #[inline(always)]
            fn word(texel: [u8; 2]) -> u32 {
                u16::$of(texel).into()
            }
        }
    )*};
}
packed! {
    Rgb565: from_le_bytes;
    Rgb565Le: from_le_bytes;
    Rgb565Be: from_be_bytes;
}

impl Packed for InBytes<Rgb565Pairs> {
    const PAIRS: bool = true;

    #[inline(always)]
    fn word(texel: [u8; 4]) -> u32 {
        u32::from_le_bytes(texel)
    }

    #[inline(always)]
    fn texel<L: Lanes>(lanes: L, word: L::U32) -> L::U32 {
        Rgb565Pairs::texel(lanes, word)
    }

    #[inline(always)]
    fn next<L: Lanes>(lanes: L, word: L::U32) -> L::U32 {
        Rgb565Pairs::next(lanes, word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bilinear, Repeat, Texture};
    use alberti_math::lanes::One;

    /// Every texel, by its digits.
    #[test]
    fn texels_are_those_of_the_words() {
        for texel in 0..=u16::MAX {
            let [high, low] = texel.to_be_bytes();
            let bytes = [low, high];
            let color = InBytes(Rgba4444).decode(bytes);
            assert_eq!(color, Rgba4444.decode(texel));
            assert_eq!(InBytes(Rgba4444).encode(color), bytes);
            assert_eq!(InBytes(L16).scalar(bytes), texel);
            assert_eq!(InBytes::<Rgb565>::word(bytes), texel.into());
            // The same colour in either order, and the same word for a target.
            let color = Rgb565.decode(texel);
            assert_eq!([InBytes(Rgb565).decode(bytes), InBytes(Rgb565Le).decode(bytes)], [color; 2]);
            assert_eq!(InBytes(Rgb565Be).decode([high, low]), color);
            assert_eq!(InBytes(Rgb565Be).encode(color), [high, low]);
            assert_eq!(InBytes::<Rgb565Be>::word([high, low]), texel.into());
            assert_eq!(InBytes(Rgb565Be).native([high, low]), bytes);
            assert_eq!([InBytes(Rgb565).native(bytes), InBytes(Rgb565Le).native(bytes)], [bytes; 2]);
        }
    }

    #[test]
    fn means_are_those_of_the_words() {
        let words = [0x1234, 0xfedc, 0x0f0f, 0x8421_u16];
        let bytes = words.map(u16::to_le_bytes);
        let of_words = Texture::new(Rgb565, &words, 2, 2).expect("2 x 2").sampler(Bilinear, Repeat);
        let of_bytes = Texture::new(InBytes(Rgb565), &bytes, 2, 2).expect("2 x 2").sampler(Bilinear, Repeat);
        for k in 0..200_u8 {
            let [u, v] = [f32::from(k) * 0.031, f32::from(k) * -0.017];
            assert_eq!(of_words.packed_lanes(One, u, v), of_bytes.packed_lanes(One, u, v));
        }
        // Pairs at any address give the same.
        let pairs = Rgb565Pairs::of(&words, 2, 2).map(u32::to_le_bytes);
        let of_pairs =
            Texture::new(InBytes(Rgb565Pairs), &pairs, 2, 2).expect("2 x 2").sampler(Bilinear, Repeat);
        for k in 0..200_u8 {
            let [u, v] = [f32::from(k) * 0.031, f32::from(k) * -0.017];
            assert_eq!(of_words.packed_lanes(One, u, v), of_pairs.packed_lanes(One, u, v));
        }
        for (pair, word) in pairs.into_iter().zip(words) {
            assert_eq!(InBytes(Rgb565Pairs).decode(pair), Rgb565.decode(word));
        }
        let mut chain = [words.map(u16::to_le_bytes).to_vec(), [[0; 2]].to_vec()].concat();
        crate::mipmap::build(InBytes(Rgb565), &mut chain, 2, 2).expect("2 x 2");
        let mut of_words = [0x1234, 0xfedc, 0x0f0f, 0x8421_u16, 0];
        crate::mipmap::build(Rgb565, &mut of_words, 2, 2).expect("2 x 2");
        assert_eq!(chain[4], of_words[4].to_le_bytes());
    }
}
