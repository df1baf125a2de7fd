//! From a stored texel to a colour.
//!
//! A format is a value, mostly without a size: [`Texture`](crate::Texture) carries it, and its decoding is compiled
//! into the sampling. All decode to the colour [`Rgba8`]. Types of other crates can be formats too. [`Indexed`] texels
//! are places in a palette, which the format refers to. [`Rgba8888`], [`Rgb565Le`], [`Rgb565Be`] and [`Rgb332`] are
//! also formats of the rasterizer's targets.
//!
//! The meaning of the colours is part of the format: they are sRGB, unless it is [`L16`] or wrapped in [`Scalars`] or
//! [`Normals`].

mod alpha;
mod bytes;
mod content;
mod indexed;
mod pairs;
mod storage;

pub use alberti_math::{Rgb332, Rgb565Be, Rgb565Le, Rgba8, Rgba565, Rgba8888};
pub use alpha::Rgb565Alpha;
pub use bytes::InBytes;
pub use content::{Content, Normals, Scalars};
pub use indexed::{Indexed, Indexed1, Indexed2, Indexed4, Indexed8, PaletteColor};
pub use pairs::Rgb565Pairs;
pub use storage::Storage;

use crate::mipmap::{Weights, mean};
use core::fmt::Debug;

/// A way of storing colours, each by itself.
pub trait TexelFormat: Copy + Debug + 'static {
    /// One stored texel.
    type Texel: Copy + Send + Sync + 'static;

    /// The meaning of the colours.
    #[inline]
    fn content(self) -> Content {
        Content::Srgb
    }

    /// The colour that the texel stands for.
    ///
    /// The formats of this module expand exactly: the least and the greatest value of a channel become 0 and 255.
    /// Encoding the colour again, by dropping the low bits, gives the texel back. [`L16`] has more bits than a colour,
    /// and gives the nearest.
    fn decode(self, texel: Self::Texel) -> Rgba8;

    /// The texel whose colour is nearest in each channel that the format has; formats of luminance store red.
    ///
    /// # Precision
    /// A step of a channel of n bits is 255/(2^n − 1) steps of a byte. The texel has the nearest of them, so that a
    /// decoded texel of up to 8 bits a channel encodes to itself.
    fn encode(self, color: Rgba8) -> Self::Texel;

    /// The texel as a colour for targets with such pixels, which put a word's bytes in their order: the same, unless
    /// texels have another order than the machine's.
    #[inline(always)]
    fn native(self, texel: Self::Texel) -> Self::Texel {
        texel
    }

    /// The texel's colour as it is drawn over pixels of RGB565: of [`Rgb565Alpha`] the texel itself.
    #[inline]
    fn rgba565(self, texel: Self::Texel) -> Rgba565 {
        Rgba565::new(self.decode(texel))
    }

    /// The number from 0 to 1 that the texel stands for in a map of numbers, such as heights, as a count of 65535ths:
    /// red, and of [`L16`] all bits.
    #[inline]
    fn scalar(self, texel: Self::Texel) -> u16 {
        let [red, ..] = self.decode(texel).to_bytes();
        u16::from(red) * 257
    }

    /// The numbers of a texel whose sums make a [`mean`](Self::mean), if it means this content: light or bytes.
    #[inline]
    fn addends(self, content: Content, texel: Self::Texel) -> [u16; 4] {
        mean::addends(content, self.decode(texel))
    }

    /// The mean of texels by the sums of their [`addends`](Self::addends), each times its texel's weight.
    #[inline]
    fn mean(self, content: Content, sums: [u64; 4], weights: Weights) -> Self::Texel {
        self.encode(mean::of_colors(content, sums, weights))
    }
}

/// Decoding is one 32-bit load.
impl TexelFormat for Rgba8888 {
    type Texel = [u8; 4];

    #[inline]
    fn decode(self, [r, g, b, a]: [u8; 4]) -> Rgba8 {
        Rgba8::new(r, g, b, a)
    }

    #[inline]
    fn encode(self, color: Rgba8) -> [u8; 4] {
        color.to_bytes()
    }
}

/// Three bytes: red, green, blue. Opaque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgb8;

impl TexelFormat for Rgb8 {
    type Texel = [u8; 3];

    #[inline]
    fn decode(self, [r, g, b]: [u8; 3]) -> Rgba8 {
        Rgba8::new(r, g, b, 255)
    }

    #[inline]
    fn encode(self, color: Rgba8) -> [u8; 3] {
        let [r, g, b, _] = color.to_bytes();
        [r, g, b]
    }
}

/// Five, six and five bits in a `u16` of the machine's byte order, red highest. Opaque.
///
/// ```text
/// bit 15       11 10            5 4         0
///      r r r r r   g g g g g g    b b b b b
/// ```
///
/// # Precision
/// Channels widen by repeating their highest bits below: `r8 = (r5 << 3) | (r5 >> 2)`,
/// `g8 = (g6 << 2) | (g6 >> 4)`, `b8` as `r8`. That is at most 1 away from the rounded `255 * r5 / 31`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgb565;

impl TexelFormat for Rgb565 {
    type Texel = u16;

    #[inline]
    fn decode(self, texel: u16) -> Rgba8 {
        let t = u32::from(texel);
        // The fields, at the top of their bytes, in the byte order of `Rgba8`.
        let high = (t >> 8 & 0xf8) | (t << 5 & 0xfc00) | (t << 19 & 0x00f8_0000);
        let low = (high >> 5 & 0x0007_0007) | (high >> 6 & 0x0300);
        Rgba8::from_bits(high | low | 0xff00_0000)
    }

    #[inline]
    fn encode(self, color: Rgba8) -> u16 {
        let [r, g, b, _] = color.to_bytes();
        narrowed(r, 31) << 11 | narrowed(g, 63) << 5 | narrowed(b, 31)
    }
}

/// [`Rgb565`] whose bytes in memory are little-endian. Opaque.
impl TexelFormat for Rgb565Le {
    type Texel = u16;

    #[inline]
    fn decode(self, texel: u16) -> Rgba8 {
        Rgb565.decode(u16::from_le(texel))
    }

    #[inline(always)]
    fn native(self, texel: u16) -> u16 {
        u16::from_le(texel)
    }

    #[inline]
    fn encode(self, color: Rgba8) -> u16 {
        Rgb565.encode(color).to_le()
    }
}

/// [`Rgb565`] whose bytes in memory are big-endian. Opaque.
impl TexelFormat for Rgb565Be {
    type Texel = u16;

    #[inline]
    fn decode(self, texel: u16) -> Rgba8 {
        Rgb565.decode(u16::from_be(texel))
    }

    #[inline(always)]
    fn native(self, texel: u16) -> u16 {
        u16::from_be(texel)
    }

    #[inline]
    fn encode(self, color: Rgba8) -> u16 {
        Rgb565.encode(color).to_be()
    }
}

/// Four bits each in a `u16` of the machine's byte order, red highest, alpha lowest.
///
/// # Precision
/// Exact: 255 is 17 times 15.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgba4444;

impl TexelFormat for Rgba4444 {
    type Texel = u16;

    #[inline]
    fn decode(self, texel: u16) -> Rgba8 {
        let t = u32::from(texel);
        // The fields, at the bottom of their bytes, in the byte order of `Rgba8`.
        let low = (t >> 12) | (t & 0x0f00) | (t << 12 & 0x000f_0000) | (t << 24 & 0x0f00_0000);
        Rgba8::from_bits(low * 17)
    }

    #[inline]
    fn encode(self, color: Rgba8) -> u16 {
        color.to_bytes().iter().fold(0, |texel, &byte| texel << 4 | narrowed(byte, 15))
    }
}

/// # Precision
/// Channels repeat their bits, which is the byte nearest to 255/7 or 85 times the level.
impl TexelFormat for Rgb332 {
    type Texel = u8;

    #[inline]
    fn decode(self, texel: u8) -> Rgba8 {
        let t = u32::from(texel);
        // 73/2 is 32 + 4 + 1/2, and 85 is 64 + 16 + 4 + 1.
        let [red, green] = [t >> 5, t >> 2 & 7].map(|level| (level * 73) >> 1);
        Rgba8::from_bits(red | green << 8 | ((t & 3) * 85) << 16 | 0xff00_0000)
    }

    #[inline]
    fn encode(self, color: Rgba8) -> u8 {
        let [r, g, b, _] = color.to_bytes();
        (narrowed(r, 7) << 5 | narrowed(g, 7) << 2 | narrowed(b, 3)).to_le_bytes()[0]
    }
}

/// A byte as the nearest multiple of 255/`greatest`.
#[inline]
const fn narrowed(byte: u8, greatest: u16) -> u16 {
    (byte as u16 * greatest + 127) / 255
}

/// One byte of luminance: red, green and blue are equal. Opaque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct L8;

impl TexelFormat for L8 {
    type Texel = u8;

    #[inline]
    fn decode(self, texel: u8) -> Rgba8 {
        Rgba8::from_bits((u32::from(texel) * 0x0001_0101) | 0xff00_0000)
    }

    #[inline]
    fn encode(self, color: Rgba8) -> u8 {
        color.to_bytes()[0]
    }
}

/// Two bytes: luminance and alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct La8;

impl TexelFormat for La8 {
    type Texel = [u8; 2];

    #[inline]
    fn decode(self, [luminance, alpha]: [u8; 2]) -> Rgba8 {
        Rgba8::new(luminance, luminance, luminance, alpha)
    }

    #[inline]
    fn encode(self, color: Rgba8) -> [u8; 2] {
        let [luminance, _, _, alpha] = color.to_bytes();
        [luminance, alpha]
    }
}

/// Sixteen bits of luminance in the machine's byte order, heights for example: [`Content::Scalars`]. Opaque.
///
/// # Precision
/// As a colour the nearest of 256 steps. As a number, which [`Sampler::scalar_lanes`](crate::Sampler::scalar_lanes)
/// reads, exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct L16;

impl TexelFormat for L16 {
    type Texel = u16;

    #[inline]
    fn content(self) -> Content {
        Content::Scalars
    }

    #[inline]
    fn decode(self, texel: u16) -> Rgba8 {
        // 255/65535, rounded: 2^16 is that much above 65535, and 128 of 65535 makes up for it.
        L8.decode(((u32::from(texel) * 255 + 32895) >> 16).to_le_bytes()[0])
    }

    #[inline]
    fn scalar(self, texel: u16) -> u16 {
        texel
    }

    #[inline]
    fn encode(self, color: Rgba8) -> u16 {
        u16::from(color.to_bytes()[0]) * 257
    }

    /// All 16 bits, whatever the content.
    #[inline]
    fn addends(self, _: Content, texel: u16) -> [u16; 4] {
        [texel, 0, 0, 0]
    }

    #[inline]
    fn mean(self, _: Content, [sum, ..]: [u64; 4], weights: Weights) -> u16 {
        weights.mean(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The documented formula, field by field, for every texel.
    #[test]
    fn rgb565_repeats_bits() {
        for texel in 0..=u16::MAX {
            let [r, g, b, a] = Rgb565.decode(texel).to_bytes();
            let r5 = texel / 2048;
            let g6 = texel / 32 % 64;
            let b5 = texel % 32;
            assert_eq!(u16::from(r), r5 * 8 + r5 / 4);
            assert_eq!(u16::from(g), g6 * 4 + g6 / 16);
            assert_eq!(u16::from(b), b5 * 8 + b5 / 4);
            assert_eq!(a, 255);
            let rounded = |value: u16, max: u16| (255 * value + max / 2) / max;
            assert!(u16::from(r).abs_diff(rounded(r5, 31)) <= 1);
            assert!(u16::from(g).abs_diff(rounded(g6, 63)) <= 1);
            // Dropping the low bits gives the texel back.
            assert_eq!(u16::from(r >> 3) << 11 | u16::from(g >> 2) << 5 | u16::from(b >> 3), texel);
        }
    }

    #[test]
    fn byte_formats() {
        for byte in 0..=255 {
            assert_eq!(L8.decode(byte), Rgba8::new(byte, byte, byte, 255));
            assert_eq!(Rgb8.decode([byte, 7, 255 - byte]), Rgba8::new(byte, 7, 255 - byte, 255));
            assert_eq!(Rgba8888.decode([1, byte, 3, !byte]), Rgba8::new(1, byte, 3, !byte));
            assert_eq!(La8.decode([byte, 7]), Rgba8::new(byte, byte, byte, 7));
            let near = |level: u8, greatest: f64| (f64::from(level) * 255.0 / greatest).round();
            let expected = [near(byte >> 5, 7.0), near(byte >> 2 & 7, 7.0), near(byte & 3, 3.0), 255.0];
            assert_eq!(Rgb332.decode(byte).to_bytes().map(f64::from), expected);
            assert_eq!(Rgb332.encode(Rgb332.decode(byte)), byte);
        }
    }

    #[test]
    fn words_of_16_bits() {
        for texel in 0..=u16::MAX {
            let [high, low] = texel.to_be_bytes();
            assert_eq!(Rgb565Be.decode(u16::from_ne_bytes([high, low])), Rgb565.decode(texel));
            assert_eq!(Rgb565Le.decode(u16::from_ne_bytes([low, high])), Rgb565.decode(texel));
            let wide = |digit: u8| digit * 16 + digit;
            let fields = [high / 16, high % 16, low / 16, low % 16].map(wide);
            assert_eq!(Rgba4444.decode(texel).to_bytes(), fields);
            let nearest = u8::try_from((2 * 255 * u32::from(texel) + 65535) / (2 * 65535)).unwrap();
            assert_eq!(L16.decode(texel), Rgba8::new(nearest, nearest, nearest, 255));
        }
    }

    /// Every channel of every byte against all steps of its width, and every texel of 16 bits.
    #[test]
    fn encoding_finds_the_nearest() {
        for byte in 0..=255u8 {
            for (greatest, step) in
                [(31u16, 255.0 / 31.0), (63, 255.0 / 63.0), (15, 17.0), (7, 255.0 / 7.0), (3, 85.0)]
            {
                let found = narrowed(byte, greatest);
                let distance = |n: u16| (f64::from(n) * step - f64::from(byte)).abs();
                assert!((0..=greatest).all(|n| distance(found) <= distance(n)), "{byte} of {greatest}");
            }
            let color = Rgba8::new(byte, 3, !byte, 77);
            assert_eq!(Rgba8888.decode(Rgba8888.encode(color)), color);
            assert_eq!(Rgb8.encode(color), [byte, 3, !byte]);
            assert_eq!((L8.encode(color), La8.encode(color)), (byte, [byte, 77]));
            assert_eq!(L16.scalar(L16.encode(color)), u16::from(byte) * 257);
        }
        for texel in 0..=u16::MAX {
            assert_eq!(Rgb565.encode(Rgb565.decode(texel)), texel);
            assert_eq!(Rgb565Be.encode(Rgb565Be.decode(texel)), texel);
            assert_eq!(Rgb565Le.encode(Rgb565Le.decode(texel)), texel);
            assert_eq!(Rgba4444.encode(Rgba4444.decode(texel)), texel);
        }
    }
}
