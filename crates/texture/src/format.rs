//! How a stored texel becomes a colour.
//!
//! A format is a type without values of its own: [`Texture`](crate::Texture) carries it as a parameter, so that the
//! decoding is compiled into the sampling. [`Rgba8`], what every format decodes to, is itself one. Types of other
//! crates can be formats too, a palette for example.

pub use alberti_math::Rgba8;

/// A way of storing colours.
pub trait TexelFormat: 'static {
    /// One stored texel.
    type Texel: Copy + Send + Sync + 'static;

    /// The colour that the texel stands for.
    ///
    /// The formats of this module expand exactly: the least and the greatest value of a channel become 0 and 255,
    /// and encoding the colour again, by dropping the low bits, gives the texel back.
    fn decode(texel: Self::Texel) -> Rgba8;
}

/// Four bytes: red, green, blue, alpha. Decoding is one 32-bit load.
impl TexelFormat for Rgba8 {
    type Texel = [u8; 4];

    #[inline]
    fn decode([r, g, b, a]: [u8; 4]) -> Rgba8 {
        Rgba8::new(r, g, b, a)
    }
}

/// Three bytes: red, green, blue. Opaque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgb8;

impl TexelFormat for Rgb8 {
    type Texel = [u8; 3];

    #[inline]
    fn decode([r, g, b]: [u8; 3]) -> Rgba8 {
        Rgba8::new(r, g, b, 255)
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
    fn decode(texel: u16) -> Rgba8 {
        let t = u32::from(texel);
        // The fields, at the top of their bytes, in the byte order of `Rgba8`.
        let high = (t >> 8 & 0xf8) | (t << 5 & 0xfc00) | (t << 19 & 0x00f8_0000);
        let low = (high >> 5 & 0x0007_0007) | (high >> 6 & 0x0300);
        Rgba8::from_bits(high | low | 0xff00_0000)
    }
}

/// One byte of luminance: red, green and blue are equal. Opaque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct L8;

impl TexelFormat for L8 {
    type Texel = u8;

    #[inline]
    fn decode(texel: u8) -> Rgba8 {
        Rgba8::from_bits((u32::from(texel) * 0x0001_0101) | 0xff00_0000)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The documented formula, field by field, for every texel.
    #[test]
    fn rgb565_repeats_bits() {
        for texel in 0..=u16::MAX {
            let [r, g, b, a] = Rgb565::decode(texel).to_bytes();
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
            assert_eq!(L8::decode(byte), Rgba8::new(byte, byte, byte, 255));
            assert_eq!(Rgb8::decode([byte, 7, 255 - byte]), Rgba8::new(byte, 7, 255 - byte, 255));
            assert_eq!(Rgba8::decode([1, byte, 3, !byte]), Rgba8::new(1, byte, 3, !byte));
        }
    }
}
