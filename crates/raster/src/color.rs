//! Colour targets: how a pixel is stored. A new one is a type with two short methods.

use alberti_math::lanes::Lanes;
use alberti_math::{Rgb565Be, Rgb565Le, Rgba8, Rgba8888};
use core::fmt::Debug;

/// A pixel format of a target: [`Rgba8888`], [`Rgb565Le`], [`Rgb565Be`], or one of yours.
///
/// ```
/// use alberti_math::Rgba8;
/// use alberti_raster::{ColorFormat, F32, Target};
///
/// /// A byte of luminance.
/// #[derive(Clone, Copy, Debug)]
/// struct Grey;
///
/// impl ColorFormat for Grey {
///     type Pixel = u8;
///
///     fn pixel(self, color: Rgba8) -> u8 {
///         let [r, g, b, _] = color.to_bytes().map(u32::from);
///         ((r * 77 + g * 150 + b * 29 + 128) >> 8) as u8
///     }
///
///     fn native(self, word: u32) -> u8 {
///         word as u8
///     }
/// }
/// let (mut color, mut depth) = ([0; 6], [0.0; 6]);
/// let mut target = Target::new(Grey, F32, 3, 2, &mut color, &mut depth)?;
/// target.clear(Rgba8::WHITE);
/// assert_eq!(color, [255; 6]);
/// # Ok::<(), alberti_raster::TargetError>(())
/// ```
pub trait ColorFormat: Copy + Debug + Send + Sync + 'static {
    /// The buffer's value for a pixel: a word whose bytes are, in memory, in the order of the display or the file.
    type Pixel: Copy + Debug + Send + Sync + 'static;

    /// The pixel for this colour.
    fn pixel(self, color: Rgba8) -> Self::Pixel;

    /// The pixel for a word that is a pixel already, but for the order of its bytes: from stages and
    /// [`clear`](crate::Target::clear) by colours that are `u8`, `u16` or `u32`. Formats whose pixels have another size
    /// are never asked.
    fn native(self, word: u32) -> Self::Pixel;

    /// Stores pixels for the samples in `mask`, whose colours are the words of `Shade`s.
    #[inline(always)]
    fn store<L: Lanes, Shade: FragmentColor>(
        self,
        lanes: L,
        colors: L::U32,
        mask: L::Mask,
        pixels: &mut L::Each<Self::Pixel>,
    ) {
        let (words, bits) = (lanes.store_words(colors), lanes.bits(mask));
        for (k, (pixel, &word)) in pixels.as_mut().iter_mut().zip(words.as_ref()).enumerate() {
            let new = Shade::pixel(self, word);
            *pixel = if bits >> k & 1 != 0 { new } else { *pixel };
        }
    }
}

/// A fragment's colour: [`Rgba8`] or its four bytes for any target, or `u8`, `u16` or `u32` for targets whose pixels
/// have as many bits, which get it as it is. Another size is an error when the program is built. It travels as a word
/// of 32 bits, of which several fit a register.
pub trait FragmentColor: Sealed + Copy {
    /// The colour as a word.
    fn to_word(self) -> u32;
    /// The colour of the word that [`to_word`](Self::to_word) gave.
    fn from_word(word: u32) -> Self;
    /// The pixel for such a word.
    fn pixel<C: ColorFormat>(format: C, word: u32) -> C::Pixel;
}

/// A bound that other crates cannot name, so that they cannot add to [`FragmentColor`].
pub trait Sealed {}

impl Sealed for Rgba8 {}
impl Sealed for [u8; 4] {}
impl Sealed for u8 {}
impl Sealed for u16 {}
impl Sealed for u32 {}

impl FragmentColor for Rgba8 {
    #[inline(always)]
    fn to_word(self) -> u32 {
        self.to_bits()
    }

    #[inline(always)]
    fn from_word(word: u32) -> Self {
        Self::from_bits(word)
    }

    #[inline(always)]
    fn pixel<C: ColorFormat>(format: C, word: u32) -> C::Pixel {
        format.pixel(Self::from_bits(word))
    }
}

/// Red, green, blue and alpha, as textures store them.
impl FragmentColor for [u8; 4] {
    #[inline(always)]
    fn to_word(self) -> u32 {
        let [red, green, blue, alpha] = self;
        Rgba8::new(red, green, blue, alpha).to_bits()
    }

    #[inline(always)]
    fn from_word(word: u32) -> Self {
        Rgba8::from_bits(word).to_bytes()
    }

    #[inline(always)]
    fn pixel<C: ColorFormat>(format: C, word: u32) -> C::Pixel {
        format.pixel(Rgba8::from_bits(word))
    }
}

/// Words of the target's pixels: packed colours as a texture stores them, or indices into a palette.
macro_rules! words {
    ($($word:ident)*) => {$(
        impl FragmentColor for $word {
            #[inline(always)]
            fn to_word(self) -> u32 {
                self.into()
            }

            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "as `to_word` gave it")]
            fn from_word(word: u32) -> Self {
                word as Self
            }

            #[inline(always)]
            fn pixel<C: ColorFormat>(format: C, word: u32) -> C::Pixel {
                const {
                    assert!(
                        size_of::<C::Pixel>() == size_of::<Self>(),
                        "the stage's colour is a word of another size than the target's pixels: let it be Rgba8"
                    );
                }
                format.native(word)
            }
        }
    )*};
}
words!(u8 u16 u32);

impl ColorFormat for Rgba8888 {
    type Pixel = u32;

    #[inline(always)]
    fn pixel(self, color: Rgba8) -> u32 {
        color.to_bits().to_le()
    }

    #[inline(always)]
    fn native(self, word: u32) -> u32 {
        word.to_le()
    }

    #[cfg(target_endian = "little")]
    #[inline(always)]
    fn store<L: Lanes, Shade: FragmentColor>(
        self,
        lanes: L,
        colors: L::U32,
        mask: L::Mask,
        pixels: &mut L::Each<u32>,
    ) {
        const {
            assert!(
                size_of::<Shade>() == 4,
                "the stage's colour is a word of another size than the target's pixels: let it be Rgba8"
            );
        };
        *pixels = lanes.store_words(lanes.select_words(mask, colors, lanes.load_words(pixels)));
    }
}

macro_rules! rgb565 {
    ($($name:ident: $in_order:ident;)*) => {$(
        impl ColorFormat for $name {
            type Pixel = u16;

            #[inline]
            fn pixel(self, color: Rgba8) -> u16 {
                rgb565(color).$in_order()
            }

            #[inline(always)]
            #[expect(clippy::cast_possible_truncation, reason = "a word of 16 bits")]
            fn native(self, word: u32) -> u16 {
                (word as u16).$in_order()
            }
        }
    )*};
}
rgb565! {
    Rgb565Le: to_le;
    Rgb565Be: to_be;
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
        assert_eq!(Rgba8888.pixel(color).to_ne_bytes(), [255, 128, 0, 7]);
        let [high, low] = [0b1111_1100, 0b0000_0000];
        assert_eq!(Rgb565Be.pixel(color).to_ne_bytes(), [high, low]);
        assert_eq!(Rgb565Le.pixel(color).to_ne_bytes(), [low, high]);
    }
}
