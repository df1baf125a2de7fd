//! 16 bits a pixel: what most small displays take.

use super::{Levels, ReadColor, byte};
use crate::color::{ColorFormat, FragmentColor};
use alberti_math::lanes::Lanes;
use alberti_math::{Rgb565Be, Rgb565Le, Rgba8};

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
                let new = lanes.store_words(colors);
                let word = |k: usize| {
                    let word = new.as_ref().get(k).copied().unwrap_or_default();
                    u32::from(Shade::pixel(self, word).$in_order())
                };
                let new = lanes.load_words(&lanes.each(word));
                let word = |k: usize| pixels.as_ref().get(k).map_or(0, |pixel| u32::from(pixel.$in_order()));
                let old = lanes.load_words(&lanes.each(word));
                let share = lanes.shr(share + lanes.word(4), 3);
                let mixed = lanes.store_words(mean565(lanes, [new, old], share));
                let bits = lanes.bits(mask);
                for (k, (pixel, &word)) in pixels.as_mut().iter_mut().zip(mixed.as_ref()).enumerate() {
                    *pixel = if bits >> k & 1 != 0 { (word as u16).$in_order() } else { *pixel };
                }
            }
        }

        impl Levels for $name {
            const GREATEST: [u32; 3] = [31, 63, 31];

            #[inline(always)]
            #[expect(clippy::cast_possible_truncation, reason = "5 + 6 + 5 bits")]
            fn compose(self, [r, g, b]: [u32; 3]) -> u16 {
                ((r << 11 | g << 5 | b) as u16).$in_order()
            }
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

/// Green, red and blue of a 16-bit colour, with room above each for a product with 32.
const SPREAD: u32 = 0x07e0_f81f;
/// A half of 32 in each.
const HALVES: u32 = 16 << 21 | 16 << 11 | 16;

/// The mean of 16-bit colours in the low halves of words, of which the first has `share` 32nds.
#[inline(always)]
fn mean565<L: Lanes>(lanes: L, [new, old]: [L::U32; 2], share: L::U32) -> L::U32 {
    let spread = |color: L::U32| (color | lanes.shl(color, 16)) & lanes.word(SPREAD);
    let (new, old) = (spread(new), spread(old));
    // The fields of the sum are none below 0; differences that are borrow from the next, and pay it back.
    let sum = lanes.shl(old, 5) + (new - old) * share + lanes.word(HALVES);
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
