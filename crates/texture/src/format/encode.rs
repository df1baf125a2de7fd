//! From colours to stored texels.

use super::{L8, La8, Rgb8, Rgb565, Rgb565Be, Rgb565Le, Rgba8, Rgba4444, Rgba8888, TexelFormat};

/// A format that colours can be stored in: what a mip chain is built in.
pub trait Encode: TexelFormat {
    /// The texel whose colour is nearest in each channel that the format has; formats of luminance store red.
    ///
    /// # Precision
    /// A channel of n bits is 255/(2^n − 1) steps of a byte; the texel is the nearest of them, so that a decoded texel
    /// encodes to itself.
    fn encode(self, color: Rgba8) -> Self::Texel;
}

impl Encode for Rgba8888 {
    #[inline]
    fn encode(self, color: Rgba8) -> [u8; 4] {
        color.to_bytes()
    }
}

impl Encode for Rgb8 {
    #[inline]
    fn encode(self, color: Rgba8) -> [u8; 3] {
        let [r, g, b, _] = color.to_bytes();
        [r, g, b]
    }
}

/// A byte as the nearest multiple of 255/`greatest`.
#[inline]
const fn narrowed(byte: u8, greatest: u16) -> u16 {
    (byte as u16 * greatest + 127) / 255
}

impl Encode for Rgb565 {
    #[inline]
    fn encode(self, color: Rgba8) -> u16 {
        let [r, g, b, _] = color.to_bytes();
        narrowed(r, 31) << 11 | narrowed(g, 63) << 5 | narrowed(b, 31)
    }
}

impl Encode for Rgb565Be {
    #[inline]
    fn encode(self, color: Rgba8) -> u16 {
        Rgb565.encode(color).to_be()
    }
}

impl Encode for Rgb565Le {
    #[inline]
    fn encode(self, color: Rgba8) -> u16 {
        Rgb565.encode(color).to_le()
    }
}

impl Encode for Rgba4444 {
    #[inline]
    fn encode(self, color: Rgba8) -> u16 {
        color.to_bytes().iter().fold(0, |texel, &byte| texel << 4 | narrowed(byte, 15))
    }
}

impl Encode for L8 {
    #[inline]
    fn encode(self, color: Rgba8) -> u8 {
        color.to_bytes()[0]
    }
}

impl Encode for La8 {
    #[inline]
    fn encode(self, color: Rgba8) -> [u8; 2] {
        let [luminance, _, _, alpha] = color.to_bytes();
        [luminance, alpha]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every channel of every byte against all steps of its width, and every texel of 16 bits.
    #[test]
    fn nearest() {
        for byte in 0..=255u8 {
            for (greatest, step) in [(31u16, 255.0 / 31.0), (63, 255.0 / 63.0), (15, 17.0)] {
                let found = narrowed(byte, greatest);
                let distance = |n: u16| (f64::from(n) * step - f64::from(byte)).abs();
                assert!((0..=greatest).all(|n| distance(found) <= distance(n)), "{byte} of {greatest}");
            }
            let color = Rgba8::new(byte, 3, !byte, 77);
            assert_eq!(Rgba8888.decode(Rgba8888.encode(color)), color);
            assert_eq!(Rgb8.encode(color), [byte, 3, !byte]);
            assert_eq!((L8.encode(color), La8.encode(color)), (byte, [byte, 77]));
        }
        for texel in 0..=u16::MAX {
            assert_eq!(Rgb565.encode(Rgb565.decode(texel)), texel);
            assert_eq!(Rgb565Be.encode(Rgb565Be.decode(texel)), texel);
            assert_eq!(Rgb565Le.encode(Rgb565Le.decode(texel)), texel);
            assert_eq!(Rgba4444.encode(Rgba4444.decode(texel)), texel);
        }
    }
}
