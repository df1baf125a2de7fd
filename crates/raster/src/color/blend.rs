//! Fragments that are mixed with the pixels they fall on.

mod any;

pub use any::AnyBlend;

use super::{ColorFormat, FragmentColor, ReadColor};
use alberti_math::lanes::Lanes;
use alberti_math::{LOW_WORDS_ONLY, Rgba8, high, srgb};
use core::fmt::Debug;

/// A colour format that mixes each fragment with what its pixel shows: for
/// [`Target::with_color`](crate::Target::with_color).
///
/// ```
/// use alberti_math::{Rgb565Le, Rgba8};
/// use alberti_raster::{NoDepth, Target, color::{Blended, Over}};
///
/// let (mut color, mut depth) = ([0; 4], [(); 4]);
/// let mut target = Target::new(Rgb565Le, NoDepth, 2, 2, &mut color, &mut depth)?;
/// let mut glass = target.with_color(Blended { format: Rgb565Le, by: Over });
/// // Passes that draw to `glass` are seen through where their alpha is below 255.
/// # Ok::<(), alberti_raster::TargetError>(())
/// ```
///
/// # Cost
/// That of reading the pixel, and of the blend. Where a format has a way of its own, as RGB565 has, [`Over`] and
/// [`Constant`] take that. Others go by colours of 8 bits a channel.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Blended<C, B> {
    /// The format of the pixels.
    pub format: C,
    /// The blend.
    pub by: B,
}

impl<C: ReadColor, B: Blend> ColorFormat for Blended<C, B> {
    type Pixel = C::Pixel;

    const DEPTH_FIRST: bool = B::DEPTH_FIRST;

    #[inline(always)]
    fn pixel(self, color: Rgba8) -> C::Pixel {
        self.format.pixel(color)
    }

    #[inline(always)]
    fn native(self, word: u32) -> C::Pixel {
        self.format.native(word)
    }

    #[inline(always)]
    fn store<L: Lanes, Shade: FragmentColor>(
        self,
        lanes: L,
        colors: L::U32,
        mask: L::Mask,
        place: [i32; 2],
        pixels: &mut L::Each<C::Pixel>,
    ) {
        let Self { format, by } = self;
        if const { Shade::IS_RGBA565 } && by.is_over() {
            return format.over(lanes, colors, mask, place, pixels);
        }
        let new = format.shown::<L, Shade>(lanes, colors);
        if let Some(share) = by.share(lanes, lanes.shr(new, 24)) {
            return format.mix::<L, Shade>(lanes, (colors, share), mask, place, pixels);
        }
        let mixed = by.mix(lanes, new, format.colors(lanes, pixels));
        format.store::<L, Rgba8>(lanes, mixed, mask, place, pixels);
    }
}

/// A way of mixing a new colour, the source, with that of a pixel, the destination. Alpha is the source's; a format
/// with alpha keeps what is behind the pixel then.
pub trait Blend: Copy + Debug + Send + Sync + 'static {
    /// That of [`ColorFormat`], by measurement.
    const DEPTH_FIRST: bool = true;

    /// A channel of both, where `one` is the greatest value, at most 65535, and alpha counts 255ths.
    fn channel(self, new: u32, old: u32, alpha: u32, one: u32) -> u32;

    /// The alpha of the pixel then, of both in 255ths.
    fn alpha(self, new: u32, old: u32) -> u32;

    /// The colours of [`channel`](Self::channel) and [`alpha`](Self::alpha) for bytes, several at a time.
    fn mix<L: Lanes>(self, lanes: L, new: L::U32, old: L::U32) -> L::U32;

    /// Whether it is [`Over`], which formats have ways of their own for: [`ReadColor::over`].
    #[inline(always)]
    fn is_over(self) -> bool {
        false
    }

    /// The part of the new colour, in 255ths, where [`mix`](Self::mix) is a mean by it; `alpha` is the source's.
    /// Formats have ways of their own for means: [`ReadColor::mix`].
    #[inline(always)]
    fn share<L: Lanes>(self, lanes: L, alpha: L::U32) -> Option<L::U32> {
        let _ = (lanes, alpha);
        None
    }
}

/// A number of 255ths, to the nearest, up to 65535 of them: without a division, which a Cortex-M0+ has not.
#[inline(always)]
fn of_255(x: u32) -> u32 {
    // 2^32/255, rounded up.
    high(x + 127, 0x0101_0102)
}

/// Both bytes of each half of a word.
const BYTES: u32 = 0x00ff_00ff;

/// The nearest bytes to 255ths in the halves of a word, each up to 65025.
#[inline(always)]
fn bytes_of_255<L: Lanes>(lanes: L, x: L::U32) -> L::U32 {
    // Blinn's: (x + 128 + (x + 128)/256)/256 is x/255 to the nearest there.
    let x = x + lanes.word(0x0080_0080);
    lanes.shr(x + (lanes.shr(x, 8) & lanes.word(BYTES)), 8) & lanes.word(BYTES)
}

/// The two halves of colours with a byte each: red and blue, green and alpha.
#[inline(always)]
fn halves<L: Lanes>(lanes: L, color: L::U32) -> [L::U32; 2] {
    [color & lanes.word(BYTES), lanes.shr(color, 8) & lanes.word(BYTES)]
}

#[inline(always)]
fn joined<L: Lanes>(lanes: L, [red_blue, green_alpha]: [L::U32; 2]) -> L::U32 {
    red_blue | lanes.shl(green_alpha, 8)
}

/// Sums of two bytes in the halves of a word, at most 255.
#[inline(always)]
fn saturated<L: Lanes>(lanes: L, sums: L::U32) -> L::U32 {
    let beyond = lanes.shr(sums, 8) & lanes.word(0x0001_0001);
    (sums | (lanes.shl(beyond, 8) - beyond)) & lanes.word(BYTES)
}

/// The colour of which `new` has a share of so many 255ths, and `old` the rest. Alpha is that of `new` above `old`.
#[inline(always)]
pub(super) fn mean<L: Lanes>(lanes: L, new: L::U32, old: L::U32, share: L::U32) -> L::U32 {
    let rest = lanes.word(255) - share;
    let ([new_rb, new_ga], [old_rb, old_ga]) = (halves(lanes, new), halves(lanes, old));
    // The new colour is opaque as far as it has a share.
    let new_ga = new_ga | lanes.word(0x00ff_0000);
    joined(
        lanes,
        [mixed(lanes, [new_rb, old_rb], [share, rest]), mixed(lanes, [new_ga, old_ga], [share, rest])],
    )
}

/// The halves of a mean. A function, since compilers leave a closure that is called twice out of the loop, and so
/// without the registers that this is compiled for.
#[inline(always)]
fn mixed<L: Lanes>(lanes: L, [new, old]: [L::U32; 2], [share, rest]: [L::U32; 2]) -> L::U32 {
    bytes_of_255(lanes, new * share + old * rest)
}

/// The halves of a sum in which one has a share.
#[inline(always)]
fn summed<L: Lanes>(lanes: L, whole: L::U32, part: L::U32, share: L::U32) -> L::U32 {
    saturated(lanes, whole + bytes_of_255(lanes, part * share))
}

/// Source · alpha + destination · (1 − alpha): the usual one, for colours that are not multiplied by their alpha.
///
/// # Precision
/// Correctly rounded in bytes; in RGB565 as its [mean](ReadColor::mix).
///
/// # Cost
/// Four products of a word; in RGB565 one, which is 16 instructions more a pixel on a Cortex-M4F, 17 on a Cortex-M0+.
/// Of colours that are ready for that, [`Rgba565`](alberti_math::Rgba565), it is 11 and 21.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Over;

impl Blend for Over {
    #[inline(always)]
    fn channel(self, new: u32, old: u32, alpha: u32, _: u32) -> u32 {
        of_255(new * alpha + old * (255 - alpha))
    }

    #[inline(always)]
    fn alpha(self, new: u32, old: u32) -> u32 {
        of_255(new * 255 + old * (255 - new))
    }

    #[inline(always)]
    fn mix<L: Lanes>(self, lanes: L, new: L::U32, old: L::U32) -> L::U32 {
        mean(lanes, new, old, lanes.shr(new, 24))
    }

    #[inline(always)]
    fn is_over(self) -> bool {
        true
    }

    #[inline(always)]
    fn share<L: Lanes>(self, _: L, alpha: L::U32) -> Option<L::U32> {
        Some(alpha)
    }
}

/// [`Over`] by the same alpha for all, in 255ths, whatever that of the source is.
///
/// # Precision
/// That of [`Over`].
///
/// # Cost
/// That of [`Over`]; in RGB565 16 instructions more a pixel on a Cortex-M4F, 24 on a Cortex-M0+.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Constant(
    /// Alpha.
    pub u8,
);

impl Blend for Constant {
    // The small cores of which that is so take 8 % more otherwise.
    const DEPTH_FIRST: bool = !LOW_WORDS_ONLY;

    #[inline(always)]
    fn channel(self, new: u32, old: u32, _: u32, one: u32) -> u32 {
        Over.channel(new, old, self.0.into(), one)
    }

    #[inline(always)]
    fn alpha(self, _: u32, old: u32) -> u32 {
        Over.alpha(self.0.into(), old)
    }

    #[inline(always)]
    fn mix<L: Lanes>(self, lanes: L, new: L::U32, old: L::U32) -> L::U32 {
        mean(lanes, new, old, lanes.word(self.0.into()))
    }

    #[inline(always)]
    fn share<L: Lanes>(self, lanes: L, _: L::U32) -> Option<L::U32> {
        Some(lanes.word(self.0.into()))
    }
}

/// Source + destination · (1 − alpha), at most 1: for colours that are multiplied by their alpha already. With an alpha
/// of 0 they are light that is added.
///
/// # Precision
/// Correctly rounded in bytes.
///
/// # Cost
/// Two products of a word, and sums that stop at 255. By way of bytes in RGB565 it is 56 instructions more a pixel on a
/// Cortex-M4F, 76 on a Cortex-M0+.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Premultiplied;

impl Blend for Premultiplied {
    #[inline(always)]
    fn channel(self, new: u32, old: u32, alpha: u32, one: u32) -> u32 {
        (new + of_255(old * (255 - alpha))).min(one)
    }

    #[inline(always)]
    fn alpha(self, new: u32, old: u32) -> u32 {
        new + of_255(old * (255 - new))
    }

    #[inline(always)]
    fn mix<L: Lanes>(self, lanes: L, new: L::U32, old: L::U32) -> L::U32 {
        let rest = lanes.word(255) - lanes.shr(new, 24);
        let ([new_rb, new_ga], [old_rb, old_ga]) = (halves(lanes, new), halves(lanes, old));
        joined(lanes, [summed(lanes, new_rb, old_rb, rest), summed(lanes, new_ga, old_ga, rest)])
    }
}

/// Source · alpha + destination, at most 1: light. The pixel's alpha stays.
///
/// # Precision
/// Correctly rounded in bytes.
///
/// # Cost
/// Two products of a word, and sums that stop at 255. By way of bytes in RGB565 it is 42 instructions more a pixel on a
/// Cortex-M4F, 64 on a Cortex-M0+.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Additive;

impl Blend for Additive {
    #[inline(always)]
    fn channel(self, new: u32, old: u32, alpha: u32, one: u32) -> u32 {
        (of_255(new * alpha) + old).min(one)
    }

    #[inline(always)]
    fn alpha(self, _: u32, old: u32) -> u32 {
        old
    }

    #[inline(always)]
    fn mix<L: Lanes>(self, lanes: L, new: L::U32, old: L::U32) -> L::U32 {
        let alpha = lanes.shr(new, 24);
        let ([new_rb, new_ga], [old_rb, old_ga]) = (halves(lanes, new), halves(lanes, old));
        let new_g = new_ga & lanes.word(255);
        joined(lanes, [summed(lanes, old_rb, new_rb, alpha), summed(lanes, old_ga, new_g, alpha)])
    }
}

/// Source · destination: tinted glass, shadows, light maps. The pixel's alpha stays.
///
/// # Precision
/// Correctly rounded in bytes.
///
/// # Cost
/// Three products. By way of bytes in RGB565 it is 44 instructions more a pixel on a Cortex-M4F, 64 on a Cortex-M0+.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Multiply;

impl Blend for Multiply {
    const DEPTH_FIRST: bool = false;

    #[inline(always)]
    fn channel(self, new: u32, old: u32, _: u32, one: u32) -> u32 {
        (new * old + one / 2) / one
    }

    #[inline(always)]
    fn alpha(self, _: u32, old: u32) -> u32 {
        old
    }

    #[inline(always)]
    fn mix<L: Lanes>(self, lanes: L, new: L::U32, old: L::U32) -> L::U32 {
        let ([new_rb, new_ga], [old_rb, old_ga]) = (halves(lanes, new), halves(lanes, old));
        let low = lanes.word(255);
        let red = (new_rb & low) * (old_rb & low);
        let blue = lanes.shr(new_rb, 16) * lanes.shr(old_rb, 16);
        let green = (new_ga & low) * (old_ga & low);
        // Alpha as it is: times 255.
        let alpha = lanes.shr(old_ga, 16) * low;
        let [red_blue, green_alpha] = [red | lanes.shl(blue, 16), green | lanes.shl(alpha, 16)];
        joined(lanes, [bytes_of_255(lanes, red_blue), bytes_of_255(lanes, green_alpha)])
    }
}

/// Another blend, of light instead of bytes: two colours half and half are as bright as both side by side.
///
/// # Precision
/// A channel is the byte of the light that the blend makes of the lights of both, in 65535ths, correctly rounded; see
/// [`srgb`].
///
/// # Cost
/// A sample after the other: twelve loads, from tables of a kilobyte and a half together. Around
/// [`Over`] in RGB565 it is 134 instructions more a pixel on a Cortex-M4F, 244 on a Cortex-M0+.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct InLight<B>(
    /// The blend.
    pub B,
);

impl<B: Blend> Blend for InLight<B> {
    #[inline(always)]
    fn channel(self, new: u32, old: u32, alpha: u32, one: u32) -> u32 {
        self.0.channel(new, old, alpha, one)
    }

    #[inline(always)]
    fn alpha(self, new: u32, old: u32) -> u32 {
        self.0.alpha(new, old)
    }

    #[inline(always)]
    fn mix<L: Lanes>(self, lanes: L, new: L::U32, old: L::U32) -> L::U32 {
        let (new, old) = (lanes.store_words(new), lanes.store_words(old));
        let mixed = |k: usize| {
            let [new, old] =
                [&new, &old].map(|words| words.as_ref().get(k).copied().unwrap_or_default().to_le_bytes());
            in_light(self.0, new, old)
        };
        lanes.load_words(&lanes.each(mixed))
    }
}

/// Not inlined, as it is long.
#[inline(never)]
#[expect(clippy::cast_possible_truncation, reason = "at most 65535, and 255")]
fn in_light(blend: impl Blend, [r, g, b, a]: [u8; 4], [old_r, old_g, old_b, old_a]: [u8; 4]) -> u32 {
    let channel = |new: u8, old: u8| {
        let [new, old] = [new, old].map(|byte| srgb::to_light(byte).into());
        srgb::to_byte(blend.channel(new, old, a.into(), 65535) as u16)
    };
    let alpha = blend.alpha(a.into(), old_a.into()) as u8;
    u32::from_le_bytes([channel(r, old_r), channel(g, old_g), channel(b, old_b), alpha])
}

#[cfg(test)]
mod tests;
