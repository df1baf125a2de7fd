//! Colour targets: what a pixel is stored as. A new one is one small type.

use alberti_math::Rgba8;
use alberti_math::lanes::Lanes;
use core::fmt::Debug;

/// A pixel format of a target.
pub trait ColorFormat: Copy + Debug + 'static {
    /// What the buffer holds for a pixel: a word whose bytes are, in memory, what a display or a file wants.
    type Pixel: Copy + Debug + 'static;
}

/// What a fragment stage makes: any colour that fits a word of 32 bits, in which several of them travel.
pub trait Color: Copy {
    /// As a word.
    fn to_word(self) -> u32;
    /// From the word that [`to_word`](Self::to_word) gave.
    fn from_word(word: u32) -> Self;
}

impl Color for Rgba8 {
    #[inline(always)]
    fn to_word(self) -> u32 {
        self.to_bits()
    }

    #[inline(always)]
    fn from_word(word: u32) -> Self {
        Self::from_bits(word)
    }
}

/// Any word: packed colours, or indices into a palette.
impl Color for u32 {
    #[inline(always)]
    fn to_word(self) -> u32 {
        self
    }

    #[inline(always)]
    fn from_word(word: u32) -> Self {
        word
    }
}

/// A word of 16 bits, such as a colour as a texture stores it.
impl Color for u16 {
    #[inline(always)]
    fn to_word(self) -> u32 {
        self.into()
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "what `to_word` gave")]
    fn from_word(word: u32) -> Self {
        word as u16
    }
}

/// A format that can take colours of type `Shade`, as fragment stages make them.
pub trait Store<Shade: Color>: ColorFormat {
    /// The pixel for this colour.
    fn pixel(color: Shade) -> Self::Pixel;

    /// Stores the pixels for the samples in `mask`, whose colours are words.
    #[inline(always)]
    fn store<L: Lanes>(lanes: L, colors: L::U32, mask: L::Mask, pixels: &mut L::Each<Self::Pixel>) {
        let (words, bits) = (lanes.store_words(colors), lanes.bits(mask));
        for (k, (pixel, &word)) in pixels.as_mut().iter_mut().zip(words.as_ref()).enumerate() {
            let new = Self::pixel(Shade::from_word(word));
            *pixel = if bits >> k & 1 != 0 { new } else { *pixel };
        }
    }
}

/// Four bytes a pixel, in memory R, G, B, A.
impl ColorFormat for Rgba8 {
    type Pixel = u32;
}

impl Store<Rgba8> for Rgba8 {
    #[inline(always)]
    fn pixel(color: Rgba8) -> u32 {
        color.to_bits().to_le()
    }

    #[cfg(target_endian = "little")]
    #[inline(always)]
    fn store<L: Lanes>(lanes: L, colors: L::U32, mask: L::Mask, pixels: &mut L::Each<u32>) {
        *pixels = lanes.store_words(lanes.select_words(mask, colors, lanes.load_words(pixels)));
    }
}

/// Two bytes a pixel, the low one first: RRRRRGGG GGGBBBBB as a little-endian word.
#[derive(Clone, Copy, Debug)]
pub enum Rgb565Le {}

/// Two bytes a pixel, the high one first, as most SPI displays want them.
#[derive(Clone, Copy, Debug)]
pub enum Rgb565Be {}

impl ColorFormat for Rgb565Le {
    type Pixel = u16;
}

/// 16 bits of the machine's byte order.
impl Store<u16> for Rgb565Le {
    #[inline(always)]
    fn pixel(color: u16) -> u16 {
        color.to_le()
    }
}

impl Store<Rgba8> for Rgb565Le {
    #[inline]
    fn pixel(color: Rgba8) -> u16 {
        rgb565(color).to_le()
    }
}

impl ColorFormat for Rgb565Be {
    type Pixel = u16;
}

/// 16 bits of the machine's byte order.
impl Store<u16> for Rgb565Be {
    #[inline(always)]
    fn pixel(color: u16) -> u16 {
        color.to_be()
    }
}

impl Store<Rgba8> for Rgb565Be {
    #[inline]
    fn pixel(color: Rgba8) -> u16 {
        rgb565(color).to_be()
    }
}

/// The 16-bit colour nearest to `color`: each channel c becomes c·31/255 or c·63/255 to the nearest; alpha is dropped.
///
/// # Precision
/// Correctly rounded in each channel.
///
/// # Cost
/// Three multiplications, three additions, shifts.
#[must_use]
#[inline]
pub fn rgb565(color: Rgba8) -> u16 {
    let [r, g, b, _] = color.to_bytes();
    // Multiply and shift equal the rounded quotients for every byte.
    let five = |c: u8| (u32::from(c) * 249 + 1014) >> 11;
    let six = |c: u8| (u32::from(c) * 253 + 505) >> 10;
    #[expect(clippy::cast_possible_truncation, reason = "5 + 6 + 5 bits")]
    let packed = (five(r) << 11 | six(g) << 5 | five(b)) as u16;
    packed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_goes_to_the_nearest_step() {
        for c in 0..=255u8 {
            let packed = rgb565(Rgba8::new(c, c, c, 0));
            let nearest = |steps: f64| (f64::from(c) * steps / 255.0).round();
            assert_eq!(f64::from(packed >> 11), nearest(31.0), "red of {c}");
            assert_eq!(f64::from(packed >> 5 & 63), nearest(63.0), "green of {c}");
            assert_eq!(f64::from(packed & 31), nearest(31.0), "blue of {c}");
        }
    }

    #[test]
    fn bytes_lie_in_memory_as_the_format_says() {
        let color = Rgba8::new(255, 128, 0, 7);
        assert_eq!(<Rgba8 as Store<Rgba8>>::pixel(color).to_ne_bytes(), [255, 128, 0, 7]);
        let [high, low] = [0b1111_1100, 0b0000_0000];
        assert_eq!(Rgb565Be::pixel(color).to_ne_bytes(), [high, low]);
        assert_eq!(Rgb565Le::pixel(color).to_ne_bytes(), [low, high]);
    }
}
