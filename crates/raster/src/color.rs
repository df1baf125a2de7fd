//! Colour targets: how a pixel is stored. A new one is a type with two short methods.

mod blend;
mod dither;
#[cfg(feature = "embedded-graphics")]
mod embedded;
mod formats;
pub mod pack;
mod resolve;

pub use blend::{Additive, AnyBlend, Blend, Blended, Constant, InLight, Multiply, Over, Premultiplied};
pub use dither::{Bayer, BlueNoise, Dithered, Pattern};
#[cfg(feature = "embedded-graphics")]
pub use embedded::{EmbeddedBytes, EmbeddedColor};
pub use formats::{
    Grey1, Grey2, Grey4, Grey8, Indexed, Levels, ReadColor, Rgb332, Rgb444, Rgb666, Rgb888, Xrgb8888, rgb565,
};
pub use resolve::{Average, resolve};

use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Rgba565};
use core::fmt::Debug;

/// A pixel format of a target: [`Rgba8888`](crate::Rgba8888), [`Rgb565Le`](crate::Rgb565Le),
/// [`Rgb565Be`](crate::Rgb565Be), [others](crate::color), or one of yours.
///
/// A colour's way into a pixel is a format around a format: [`Blended`] mixes it with the colour that is there,
/// [`Dithered`] rounds it by a pattern. A pass that needs one draws to
/// [`target.with_color`](crate::Target::with_color). The others do not pay for it.
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

    /// Whether a depth is stored before its colour. The pixels are the same; where storing takes many registers, one
    /// fewer is in use meanwhile.
    const DEPTH_FIRST: bool = false;

    /// The pixel for this colour.
    fn pixel(self, color: Rgba8) -> Self::Pixel;

    /// The pixel for a word that is a pixel already, but for the order of its bytes: from stages and
    /// [`clear`](crate::Target::clear) by colours that are `u8`, `u16` or `u32`. Formats whose pixels have another size
    /// are never asked.
    fn native(self, word: u32) -> Self::Pixel;

    /// Stores pixels for the samples in `mask`, whose colours are the words of `Shade`s. `place` is the column and the
    /// row of the first.
    #[inline(always)]
    fn store<L: Lanes, Shade: FragmentColor>(
        self,
        lanes: L,
        colors: L::U32,
        mask: L::Mask,
        place: [i32; 2],
        pixels: &mut L::Each<Self::Pixel>,
    ) {
        let _ = place;
        store_each::<Self, L, Shade>(self, lanes, colors, mask, pixels);
    }
}

/// Stores a pixel after the other.
#[inline(always)]
fn store_each<F: ColorFormat, L: Lanes, Shade: FragmentColor>(
    format: F,
    lanes: L,
    colors: L::U32,
    mask: L::Mask,
    pixels: &mut L::Each<F::Pixel>,
) {
    let (words, bits) = (lanes.store_words(colors), lanes.bits(mask));
    for (k, (pixel, &word)) in pixels.as_mut().iter_mut().zip(words.as_ref()).enumerate() {
        let new = Shade::pixel(format, word);
        *pixel = if bits >> k & 1 != 0 { new } else { *pixel };
    }
}

/// A fragment's colour: [`Rgba8`] or its four bytes for any target; or a word for targets whose pixels have as many
/// bits, which get it as it is. A word is `u8`, `u16` or its two bytes, the low one first, or `u32`. Another size is an
/// error when the program is built. Colours travel as words of 32 bits, of which several fit a register.
pub trait FragmentColor: Sealed + Copy {
    /// The colour as a word.
    fn to_word(self) -> u32;
    /// The colour of the word that [`to_word`](Self::to_word) gave.
    fn from_word(word: u32) -> Self;
    /// The pixel for such a word.
    fn pixel<C: ColorFormat>(format: C, word: u32) -> C::Pixel;
    /// The bits of the [`Rgba8`] that is shown for such a word; opaque where the word has no alpha.
    fn color<C: ReadColor>(format: C, word: u32) -> u32;
    /// Whether words are those bits already.
    const IS_COLOR: bool;
    /// Whether words are those of [`Rgba565`].
    const IS_RGBA565: bool = false;
}

/// A bound that other crates cannot name, so that they cannot add to [`FragmentColor`].
pub trait Sealed {}

impl Sealed for Rgba8 {}
impl Sealed for Rgba565 {}
impl Sealed for [u8; 2] {}
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

    #[inline(always)]
    fn color<C: ReadColor>(_: C, word: u32) -> u32 {
        word
    }

    const IS_COLOR: bool = true;
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

    #[inline(always)]
    fn color<C: ReadColor>(_: C, word: u32) -> u32 {
        word
    }

    const IS_COLOR: bool = true;
}

/// For targets that are mixed [`Over`]; others show the colour.
impl FragmentColor for Rgba565 {
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
        format.pixel(Self::from_bits(word).to_rgba8())
    }

    #[inline(always)]
    fn color<C: ReadColor>(_: C, word: u32) -> u32 {
        Self::from_bits(word).to_rgba8().to_bits()
    }

    const IS_COLOR: bool = false;
    const IS_RGBA565: bool = true;
}

/// Words of the target's pixels: packed colours as a texture stores them, or indices into a palette.
macro_rules! words {
    ($($word:ty: $to:expr, $from:expr;)*) => {$(
        impl FragmentColor for $word {
            #[inline(always)]
            fn to_word(self) -> u32 {
                let word: fn(Self) -> u32 = $to;
                word(self)
            }

            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "as `to_word` gave it")]
            fn from_word(word: u32) -> Self {
                let of: fn(u32) -> Self = $from;
                of(word)
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

            #[inline(always)]
            fn color<C: ReadColor>(format: C, word: u32) -> u32 {
                format.color(Self::pixel(format, word)).to_bits()
            }

            const IS_COLOR: bool = false;
        }
    )*};
}
words! {
    u8: u32::from, |word| word as u8;
    u16: u32::from, |word| word as u16;
    u32: |word| word, |word| word;
    [u8; 2]: |bytes| u16::from_le_bytes(bytes).into(), |word| (word as u16).to_le_bytes();
}
