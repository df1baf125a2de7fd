//! 16 bits a pixel: what most small displays take.

use super::{Levels, ReadColor, byte};
use crate::color::{ColorFormat, FragmentColor};
use alberti_math::lanes::Lanes;
use alberti_math::{Rgb565Be, Rgb565Le, Rgba8};

/// Replaces pixels by an expression of them, spread.
macro_rules! replace {
    ($in_order:ident, ($lanes:ident, $mask:ident, $pixels:ident), |$old:ident| $new:expr) => {
        let word = |k: usize| $pixels.as_ref().get(k).map_or(0, |pixel| u32::from(pixel.$in_order()));
        let $old = spread($lanes, $lanes.load_words(&$lanes.each(word)));
        let (new, bits) = ($lanes.store_words($new), $lanes.bits($mask));
        for (k, (pixel, &word)) in $pixels.as_mut().iter_mut().zip(new.as_ref()).enumerate() {
            *pixel = if bits >> k & 1 != 0 { (word as u16).$in_order() } else { *pixel };
        }
    };
}

macro_rules! rgb565 {
    ($($name:ident: $in_order:ident;)*) => {$(
        /// # Precision
        /// Of a [mean](ReadColor::mix): the share is rounded to 32nds, and the new colour to the format's levels
        /// before. So each channel is within 1.5 levels, green 2, of the mean in reals, and of the new colour or the
        /// old one alone nothing is lost.
        impl ReadColor for $name {
            #[inline]
            fn color(self, pixel: u16) -> Rgba8 {
                let [r, g, b] = levels565(pixel.$in_order());
                Rgba8::new(byte(r, 31), byte(g, 63), byte(b, 31), 255)
            }

            #[inline(always)]
            #[expect(clippy::cast_possible_truncation, reason = "words of 16 bits")]
            fn mix<L: Lanes, Shade: FragmentColor>(
                self,
                lanes: L,
                (colors, share): (L::U32, L::U32),
                mask: L::Mask,
                _: [i32; 2],
                pixels: &mut L::Each<u16>,
            ) {
                let new = if const { Shade::IS_COLOR } {
                    spread_of(lanes, colors)
                } else {
                    let words = lanes.store_words(colors);
                    let word = |k: usize| {
                        let word = words.as_ref().get(k).copied().unwrap_or_default();
                        u32::from(Shade::pixel(self, word).$in_order())
                    };
                    spread(lanes, lanes.load_words(&lanes.each(word)))
                };
                let share = lanes.shr(share + lanes.word(4), 3);
                replace!($in_order, (lanes, mask, pixels), |old| mean565(lanes, [new, old], share));
            }

            #[inline(always)]
            #[expect(clippy::cast_possible_truncation, reason = "words of 16 bits")]
            fn over<L: Lanes>(
                self,
                lanes: L,
                words: L::U32,
                mask: L::Mask,
                _: [i32; 2],
                pixels: &mut L::Each<u16>,
            ) {
                let share = lanes.shr(words, 10) & lanes.word(63);
                replace!($in_order, (lanes, mask, pixels), |old| joined(lanes, old * share + words));
            }
        }

        impl Levels for $name {
            const GREATEST: [u32; 3] = [31, 63, 31];
            const PLACES: [u32; 3] = [1 << 11, 1 << 5, 1];
        }

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

/// Red and blue of a colour of 8 bits a channel.
const RED_BLUE: u32 = 0x00ff_00ff;
/// Green, red and blue of a 16-bit colour, with room above each for a product with 32.
const SPREAD: u32 = 0x07e0_f81f;
/// A half of 32 in each.
const HALVES: u32 = 16 << 21 | 16 << 11 | 16;

/// A 16-bit colour in the low half of a word, spread.
#[inline(always)]
fn spread<L: Lanes>(lanes: L, color: L::U32) -> L::U32 {
    (color | lanes.shl(color, 16)) & lanes.word(SPREAD)
}

/// The same of a colour of 8 bits a channel: [`rgb565`], spread.
#[inline(always)]
fn spread_of<L: Lanes>(lanes: L, color: L::U32) -> L::U32 {
    let red_blue = (color & lanes.word(RED_BLUE)) * lanes.word(249) + lanes.word(1014 << 16 | 1014);
    let green = (lanes.shr(color, 8) & lanes.word(255)) * lanes.word(253) + lanes.word(505);
    (red_blue & lanes.word(0xf800))
        | lanes.shr(red_blue, 27)
        | (lanes.shl(green, 11) & lanes.word(0x07e0_0000))
}

/// The mean of spread colours, of which the first has `share` 32nds: a 16-bit colour in the low half of a word.
#[inline(always)]
fn mean565<L: Lanes>(lanes: L, [new, old]: [L::U32; 2], share: L::U32) -> L::U32 {
    // The fields of the sum are none below 0; differences that are borrow from the next, and pay it back.
    joined(lanes, lanes.shl(old, 5) + (new - old) * share + lanes.word(HALVES))
}

/// The 16-bit colour of 32 times one that is spread, in the low half of a word.
#[inline(always)]
fn joined<L: Lanes>(lanes: L, sum: L::U32) -> L::U32 {
    let mean = lanes.shr(sum, 5) & lanes.word(SPREAD);
    mean | lanes.shr(mean, 16)
}

/// Red, green and blue of a 16-bit colour.
#[inline(always)]
pub(super) fn levels565(color: u16) -> [u32; 3] {
    let color = u32::from(color);
    [color >> 11, color >> 5 & 63, color & 31]
}

/// The 16-bit colour nearest to `color`: each channel c becomes c·31/255 or c·63/255 to the nearest; alpha is dropped.
///
/// # Precision
/// Correctly rounded in each channel.
///
/// # Cost
/// Two multiplications, two additions, shifts.
#[must_use]
#[inline]
pub fn rgb565(color: Rgba8) -> u16 {
    let bits = color.to_bits();
    // Multiply and shift equal the rounded quotients for every byte. Red and blue are two halves of a word.
    let red_blue = (bits & RED_BLUE) * 249 + (1014 << 16 | 1014);
    let green = (bits >> 8 & 255) * 253 + 505;
    #[expect(clippy::cast_possible_truncation, reason = "5 + 6 + 5 bits")]
    let packed = (red_blue & 0xf800 | green >> 5 & 0x07e0 | red_blue >> 27) as u16;
    packed
}
