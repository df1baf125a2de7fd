//! The formats of displays and files.

mod rgb565;

pub use alberti_math::Rgb332;
pub use rgb565::rgb565;

use super::{ColorFormat, FragmentColor};
use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Rgba8888};
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
}

/// A format of a few levels a channel.
pub trait Levels: ReadColor {
    /// The greatest level of each channel, at most 255.
    const GREATEST: [u32; 3];

    /// The pixel of these levels.
    fn compose(self, levels: [u32; 3]) -> Self::Pixel;

    /// The bytes that levels are made of: red, green and blue, unless it is a grey.
    #[inline(always)]
    fn channels(self, color: Rgba8) -> [u32; 3] {
        let [r, g, b, _] = color.to_bytes().map(u32::from);
        [r, g, b]
    }
}

/// The level of a byte, whose 255ths are cut off after `more` of them were added.
#[inline(always)]
pub(super) fn level(byte: u32, greatest: u32, more: u32) -> u32 {
    (byte * greatest + more) / 255
}

/// The nearest levels of a colour.
#[inline(always)]
fn nearest<F: Levels>(format: F, color: Rgba8) -> F::Pixel {
    let [a, b, c] = format.channels(color);
    let [x, y, z] = F::GREATEST;
    format.compose([level(a, x, 127), level(b, y, 127), level(c, z, 127)])
}

/// The byte of a level.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "at most 255")]
fn byte(level: u32, greatest: u32) -> u8 {
    ((level * 255 + greatest / 2) / greatest) as u8
}

/// Luminance as a byte, by the weights of BT.601.
#[inline(always)]
fn luminance(color: Rgba8) -> u32 {
    let [r, g, b, _] = color.to_bytes().map(u32::from);
    (r * 77 + g * 150 + b * 29 + 128) >> 8
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

/// Three levels a pixel as a format stores them, and what it makes of a word. A format without a description is defined
/// elsewhere.
macro_rules! formats {
    ($($($(#[$doc:meta])+ pub)? $name:ident: $pixel:ty = $greatest:expr, $compose:expr, $read:expr, $native:expr;)*) => {$(
        $(
            $(#[$doc])+
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
            pub struct $name;
        )?

        impl ColorFormat for $name {
            type Pixel = $pixel;

            #[inline]
            fn pixel(self, color: Rgba8) -> $pixel {
                nearest(self, color)
            }

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

            #[inline(always)]
            fn compose(self, levels: [u32; 3]) -> $pixel {
                let [r, g, b] = levels.map(|level| level.to_le_bytes()[0]);
                $compose([r, g, b])
            }
        }
    )*};
}
formats! {
    /// 12 bits, in two bytes a pixel as long as it is drawn: 0000RRRR GGGGBBBB. [`pack::rgb444`](super::pack::rgb444)
    /// makes three bytes of two pixels, in place.
    pub Rgb444: [u8; 2] = [15; 3],
        |[r, g, b]: [u8; 3]| [r, g << 4 | b],
        |[high, low]: [u8; 2]| [high & 15, low >> 4, low & 15].map(u32::from),
        |[low, high, ..]: [u8; 4]| [high, low];
    /// 18 bits in three bytes, as ILI9341 and ILI9488 take them: RRRRRR00 GGGGGG00 BBBBBB00.
    pub Rgb666: [u8; 3] = [63; 3],
        |levels: [u8; 3]| levels.map(|level| level << 2),
        |bytes: [u8; 3]| bytes.map(|byte| u32::from(byte >> 2)),
        |[r, g, b, _]: [u8; 4]| [r, g, b];
    /// Three bytes: red, green, blue.
    pub Rgb888: [u8; 3] = [255; 3],
        |levels: [u8; 3]| levels,
        |bytes: [u8; 3]| bytes.map(u32::from),
        |[r, g, b, _]: [u8; 4]| [r, g, b];
    /// A word whose bytes are, from the highest, 0, red, green, blue: blue comes first in memory.
    pub Xrgb8888: u32 = [255; 3],
        |[r, g, b]: [u8; 3]| u32::from_be_bytes([0, r, g, b]).to_le(),
        |word: u32| { let [_, r, g, b] = word.to_le().to_be_bytes(); [r, g, b].map(u32::from) },
        |bytes: [u8; 4]| u32::from_le_bytes(bytes).to_le();
    Rgb332: u8 = [7, 7, 3],
        |[r, g, b]: [u8; 3]| r << 5 | g << 2 | b,
        |byte: u8| [byte >> 5, byte >> 2 & 7, byte & 3].map(u32::from),
        |[low, ..]: [u8; 4]| low;
}

/// Formats of luminance, by the weights of BT.601: a byte a pixel as long as it is drawn.
macro_rules! greys {
    ($($(#[$doc:meta])* $name:ident: $greatest:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct $name;

        impl ColorFormat for $name {
            type Pixel = u8;

            #[inline]
            fn pixel(self, color: Rgba8) -> u8 {
                nearest(self, color)
            }

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

            #[inline(always)]
            fn compose(self, [level, ..]: [u32; 3]) -> u8 {
                level.to_le_bytes()[0]
            }

            #[inline(always)]
            fn channels(self, color: Rgba8) -> [u32; 3] {
                [luminance(color), 0, 0]
            }
        }
    )*};
}
greys! {
    /// 256 levels.
    Grey8: 255;
    /// 16 levels; [`pack::grey4`](super::pack::grey4) puts two pixels in a byte.
    Grey4: 15;
    /// 4 levels; [`pack::grey2`](super::pack::grey2) puts four pixels in a byte.
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
