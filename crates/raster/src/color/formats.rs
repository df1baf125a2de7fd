//! The formats of displays and files.

mod rgb565;

pub use alberti_math::Rgb332;
pub use rgb565::rgb565;

use super::{ColorFormat, FragmentColor, store_each};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Rgba8, Rgba565, Rgba8888};
use core::fmt::Debug;

/// A format whose pixels say what colour they show.
pub trait ReadColor: ColorFormat {
    /// The colour that a pixel shows: of each channel the byte nearest to its level; alpha is 255 where there is none.
    fn color(self, pixel: Self::Pixel) -> Rgba8;

    /// The colours of pixels, as words.
    #[inline(always)]
    fn colors<L: Lanes>(self, lanes: L, pixels: &L::Each<Self::Pixel>) -> L::U32 {
        let word = |k: usize| pixels.as_ref().get(k).map_or(0, |&pixel| self.color(pixel).to_bits());
        lanes.load_words(&lanes.each(word))
    }

    /// The colours that are shown for the words of `Shade`s, as words.
    #[inline(always)]
    fn shown<L: Lanes, Shade: FragmentColor>(self, lanes: L, words: L::U32) -> L::U32 {
        if const { Shade::IS_COLOR } {
            return words;
        }
        let words = lanes.store_words(words);
        let color = |k: usize| words.as_ref().get(k).map_or(0, |&word| Shade::color(self, word));
        lanes.load_words(&lanes.each(color))
    }

    /// Stores the mean of what pixels show and of new colours, the words of `Shade`s, whose part is `share` 255ths.
    ///
    /// # Precision
    /// Correctly rounded in bytes, then stored as any colour.
    #[inline(always)]
    fn mix<L: Lanes, Shade: FragmentColor>(
        self,
        lanes: L,
        (colors, share): (L::U32, L::U32),
        mask: L::Mask,
        place: [i32; 2],
        pixels: &mut L::Each<Self::Pixel>,
    ) {
        let (new, old) = (self.shown::<L, Shade>(lanes, colors), self.colors(lanes, pixels));
        self.store::<L, Rgba8>(lanes, super::blend::mean(lanes, new, old, share), mask, place, pixels);
    }

    /// Stores new colours, the words of [`Rgba565`], as [`Over`](super::Over) has them above those of pixels.
    ///
    /// # Precision
    /// That of [`mix`](Self::mix); of RGB565 that of [`Rgba565`].
    #[inline(always)]
    fn over<L: Lanes>(
        self,
        lanes: L,
        words: L::U32,
        mask: L::Mask,
        place: [i32; 2],
        pixels: &mut L::Each<Self::Pixel>,
    ) {
        let colors = self.shown::<L, Rgba565>(lanes, words);
        self.mix::<L, Rgba8>(lanes, (colors, lanes.shr(colors, 24)), mask, place, pixels);
    }
}

/// A format of a few levels a channel.
pub trait Levels: ReadColor {
    /// The greatest level of each channel, at most 255; 0 of a channel that there is not.
    const GREATEST: [u32; 3];

    /// The difference that one level more of each channel makes to the word that is
    /// [`native`](ColorFormat::native).
    const PLACES: [u32; 3];

    /// The bytes that levels are made of, of colours as words: red, green and blue, unless it is a grey.
    #[inline(always)]
    fn channels<L: Lanes>(self, lanes: L, colors: L::U32) -> [L::U32; 3] {
        bytes(lanes, colors)
    }
}

/// Red, green and blue of colours.
#[inline(always)]
fn bytes<L: Lanes>(lanes: L, colors: L::U32) -> [L::U32; 3] {
    let byte = lanes.word(255);
    [colors & byte, lanes.shr(colors, 8) & byte, lanes.shr(colors, 16) & byte]
}

/// The 255th parts of numbers below 2^16, cut off.
#[inline(always)]
fn parts<L: Lanes>(lanes: L, number: L::U32) -> L::U32 {
    lanes.shr(number * lanes.word(0x8081), 23)
}

/// A half of a level in 255ths, so that what is cut off was rounded.
const HALF: u32 = 127;

/// The levels of colours in their places, whose 255ths are cut off after `more` of them, at most 254, were added.
#[inline(always)]
fn levels<F: Levels, L: Lanes>(format: F, lanes: L, colors: L::U32, more: L::U32) -> L::U32 {
    let ([a, b, c], [x, y, z], [i, j, k]) = (format.channels(lanes, colors), F::GREATEST, F::PLACES);
    let level = |byte: L::U32, greatest: u32| match greatest {
        0 | 255 => byte,
        _ => parts(lanes, byte * lanes.word(greatest) + more),
    };
    level(a, x) * lanes.word(i) + level(b, y) * lanes.word(j) + level(c, z) * lanes.word(k)
}

/// Stores pixels of a format of few levels as [`ColorFormat::store`] does, rounded by thresholds in 255ths.
#[inline(always)]
pub(super) fn store_levels<F: Levels, L: Lanes, Shade: FragmentColor>(
    format: F,
    lanes: L,
    (colors, thresholds): (L::U32, L::U32),
    mask: L::Mask,
    pixels: &mut L::Each<F::Pixel>,
) {
    if const { !Shade::IS_COLOR } {
        return store_each::<F, L, Shade>(format, lanes, colors, mask, pixels);
    }
    let (words, bits) = (lanes.store_words(levels(format, lanes, colors, thresholds)), lanes.bits(mask));
    for (k, (pixel, &word)) in pixels.as_mut().iter_mut().zip(words.as_ref()).enumerate() {
        let new = format.native(word);
        *pixel = if bits >> k & 1 != 0 { new } else { *pixel };
    }
}

/// Rounding to the nearest level, as formats of few levels do it.
macro_rules! nearest {
    () => {
        #[inline(always)]
        fn pixel(self, color: Rgba8) -> Self::Pixel {
            let word = levels(self, One, One.word(color.to_bits()), One.word(HALF));
            self.native(One.store_words(word)[0])
        }

        #[inline(always)]
        fn store<L: Lanes, Shade: FragmentColor>(
            self,
            lanes: L,
            colors: L::U32,
            mask: L::Mask,
            _: [i32; 2],
            pixels: &mut L::Each<Self::Pixel>,
        ) {
            store_levels::<Self, L, Shade>(self, lanes, (colors, lanes.word(HALF)), mask, pixels);
        }
    };
}

/// The byte of a level.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "at most 255")]
fn byte(level: u32, greatest: u32) -> u8 {
    ((level * 255 + greatest / 2) / greatest) as u8
}

impl ReadColor for Rgba8888 {
    #[inline(always)]
    fn color(self, pixel: u32) -> Rgba8 {
        Rgba8::from_bits(u32::from_le(pixel))
    }
}

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
        _: [i32; 2],
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

/// Three levels a pixel: the greatest, their places in a word, and the pixel's way from and to them. A format without a
/// description is defined elsewhere.
macro_rules! formats {
    ($($($(#[$doc:meta])+ pub)? $name:ident: $pixel:ty = $greatest:expr, $places:expr, $native:expr, $read:expr;)*) => {$(
        $(
            $(#[$doc])+
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
            pub struct $name;
        )?

        impl ColorFormat for $name {
            type Pixel = $pixel;

            nearest!();

            #[inline(always)]
            fn native(self, word: u32) -> $pixel {
                $native(word.to_le_bytes())
            }
        }

        impl ReadColor for $name {
            #[inline]
            fn color(self, pixel: $pixel) -> Rgba8 {
                let [x, y, z] = Self::GREATEST;
                let [r, g, b] = $read(pixel);
                Rgba8::new(byte(r, x), byte(g, y), byte(b, z), 255)
            }
        }

        impl Levels for $name {
            const GREATEST: [u32; 3] = $greatest;
            const PLACES: [u32; 3] = $places;
        }
    )*};
}
formats! {
    /// 12 bits, in two bytes a pixel as long as it is drawn: 0000RRRR GGGGBBBB. [`pack::rgb444`](super::pack::rgb444)
    /// makes three bytes of two pixels, in place.
    pub Rgb444: [u8; 2] = [15; 3], [1 << 8, 1 << 4, 1],
        |[low, high, ..]: [u8; 4]| [high, low],
        |[high, low]: [u8; 2]| [high & 15, low >> 4, low & 15].map(u32::from);
    /// 18 bits in three bytes, as ILI9341 and ILI9488 take them: RRRRRR00 GGGGGG00 BBBBBB00.
    pub Rgb666: [u8; 3] = [63; 3], [1 << 2, 1 << 10, 1 << 18],
        |[r, g, b, _]: [u8; 4]| [r, g, b],
        |bytes: [u8; 3]| bytes.map(|byte| u32::from(byte >> 2));
    /// Three bytes: red, green, blue.
    pub Rgb888: [u8; 3] = [255; 3], [1, 1 << 8, 1 << 16],
        |[r, g, b, _]: [u8; 4]| [r, g, b],
        |bytes: [u8; 3]| bytes.map(u32::from);
    /// A word whose bytes are, from the highest, 0, red, green, blue: blue comes first in memory.
    pub Xrgb8888: u32 = [255; 3], [1 << 16, 1 << 8, 1],
        |bytes: [u8; 4]| u32::from_le_bytes(bytes).to_le(),
        |word: u32| { let [_, r, g, b] = word.to_le().to_be_bytes(); [r, g, b].map(u32::from) };
    Rgb332: u8 = [7, 7, 3], [1 << 5, 1 << 2, 1],
        |[low, ..]: [u8; 4]| low,
        |byte: u8| [byte >> 5, byte >> 2 & 7, byte & 3].map(u32::from);
}

/// Formats of luminance, by the weights of BT.601: a byte a pixel as long as it is drawn.
macro_rules! greys {
    ($($(#[$doc:meta])* $name:ident: $greatest:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct $name;

        impl ColorFormat for $name {
            type Pixel = u8;

            nearest!();

            #[inline(always)]
            fn native(self, word: u32) -> u8 {
                word.to_le_bytes()[0]
            }
        }

        impl ReadColor for $name {
            #[inline]
            fn color(self, pixel: u8) -> Rgba8 {
                let grey = byte(pixel.into(), $greatest);
                Rgba8::new(grey, grey, grey, 255)
            }
        }

        impl Levels for $name {
            const GREATEST: [u32; 3] = [$greatest, 0, 0];
            const PLACES: [u32; 3] = [1, 0, 0];

            #[inline(always)]
            fn channels<L: Lanes>(self, lanes: L, colors: L::U32) -> [L::U32; 3] {
                let [r, g, b] = bytes(lanes, colors);
                let sum = r * lanes.word(77) + g * lanes.word(150) + b * lanes.word(29) + lanes.word(128);
                [lanes.shr(sum, 8), lanes.word(0), lanes.word(0)]
            }
        }
    )*};
}
greys! {
    /// 256 levels of luminance by the weights of BT.601 in 256ths, which are within one level.
    Grey8: 255;
    /// 16 levels of the same; [`pack::grey4`](super::pack::grey4) puts two pixels in a byte.
    Grey4: 15;
    /// Four levels of the same; [`pack::grey2`](super::pack::grey2) puts four pixels in a byte.
    Grey2: 3;
    /// Black and white; [`pack::grey1`](super::pack::grey1) puts eight pixels in a byte.
    Grey1: 1;
}

/// Indices into a palette of up to 256 colours.
///
/// # Cost
/// For an [`Rgba8`] a search of the whole palette: let stages have colours that are indices, `u8`.
#[derive(Clone, Copy, Debug)]
pub struct Indexed(
    /// The palette.
    pub &'static [Rgba8],
);

impl ColorFormat for Indexed {
    type Pixel = u8;

    /// The index of the nearest colour, by the sum of squares; of equal ones the first.
    fn pixel(self, color: Rgba8) -> u8 {
        let apart = |other: &Rgba8| {
            let [a, b] = [color, *other].map(Rgba8::to_bytes);
            a.iter().zip(b).take(3).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum::<u32>()
        };
        let nearest = (0..=u8::MAX).zip(self.0).min_by_key(|(_, other)| apart(other));
        nearest.map_or(0, |(index, _)| index)
    }

    #[inline(always)]
    fn native(self, word: u32) -> u8 {
        word.to_le_bytes()[0]
    }
}

impl ReadColor for Indexed {
    /// Black beyond the palette.
    #[inline]
    fn color(self, pixel: u8) -> Rgba8 {
        self.0.get(usize::from(pixel)).copied().unwrap_or(Rgba8::BLACK)
    }
}

#[cfg(test)]
mod tests;
