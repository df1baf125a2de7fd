//! The weighted mean of four colours, in integers with one rounding.

use alberti_math::lanes::Lanes;
use alberti_math::{each, each_pair, map2, map4};

/// Bytes 0 and 2: two channels in lanes of 16 bits.
const BYTES: u32 = 0x00ff_00ff;

/// Four neighbouring texels as words, named as in a diagram with u to the right and v up.
#[derive(Clone, Copy)]
pub(crate) struct Quad<L: Lanes> {
    pub(crate) low_left: L::U32,
    pub(crate) low_right: L::U32,
    pub(crate) high_left: L::U32,
    pub(crate) high_right: L::U32,
}

impl<L: Lanes> Quad<L> {
    /// The texels of a lower and an upper row, left and right.
    #[inline(always)]
    pub(crate) fn of([[low_left, low_right], [high_left, high_right]]: [[L::U32; 2]; 2]) -> Self {
        Self { low_left, low_right, high_left, high_right }
    }
}

/// The colour at `right` 256ths of the way from left to right and `up` 256ths of the way up, both 0 to 256.
///
/// For each channel, with `l = 256 - right` and `d = 256 - up`:
///
/// ```text
/// (l*d*low_left + right*d*low_right + l*up*high_left + right*up*high_right + 2^15) >> 16
/// ```
///
/// # Cost
/// Eight multiplications for the four channels.
#[inline(always)]
pub(crate) fn bilinear<L: Lanes>(lanes: L, quad: Quad<L>, right: L::U32, up: L::U32) -> L::U32 {
    let [red, green, blue, alpha] = sums(lanes, quad, right, up);
    let half = lanes.word(1 << 15);
    // The upper halves of these words are the channels.
    let [red_blue, green_alpha] = map2(
        [[red, blue], [green, alpha]],
        #[inline(always)]
        |[low, high]| lanes.shr(low + half, 16) | (high + half) & lanes.word(0x00ff_0000),
    );
    red_blue | lanes.shl(green_alpha, 8)
}

/// The sums of [`bilinear`] before they are rounded, of red, green, blue and alpha: at most 255 * 2^16.
#[inline(always)]
pub(crate) fn sums<L: Lanes>(lanes: L, quad: Quad<L>, right: L::U32, up: L::U32) -> [L::U32; 4] {
    let Quad { low_left, low_right, high_left, high_right } = quad;
    let bytes = lanes.word(BYTES);
    let [red, blue] = rise(
        lanes,
        lanes.mix_halves(low_left & bytes, low_right & bytes, right),
        lanes.mix_halves(high_left & bytes, high_right & bytes, right),
        up,
    );
    let [green, alpha] = rise(
        lanes,
        lanes.mix_halves(lanes.shr(low_left, 8) & bytes, lanes.shr(low_right, 8) & bytes, right),
        lanes.mix_halves(lanes.shr(high_left, 8) & bytes, lanes.shr(high_right, 8) & bytes, right),
        up,
    );
    [red, green, blue, alpha]
}

/// The formula of [`bilinear`] for numbers of 16 bits instead of channels.
///
/// # Cost
/// Three multiplications.
#[inline(always)]
pub(crate) fn bilinear_scalar<L: Lanes>(lanes: L, quad: Quad<L>, right: L::U32, up: L::U32) -> L::U32 {
    let Quad { low_left, low_right, high_left, high_right } = quad;
    // In the end at most 65535 * 2^16 + 2^15, below 2^32, and so modulo 2^32 before.
    let low = lanes.shl(low_left, 8) + (low_right - low_left) * right;
    let high = lanes.shl(high_left, 8) + (high_right - high_left) * right;
    lanes.shr(lanes.shl(low, 8) + (high - low) * up + lanes.word(1 << 15), 16)
}

/// A number from 0 to 1 of a count of 65535ths.
///
/// # Precision
/// In `f32` correctly rounded, in fixed point rounded down.
#[inline(always)]
pub(crate) fn scalar_number<L: Lanes>(lanes: L, count: L::U32) -> L::Number {
    in_256ths(lanes, count) / lanes.splat(SCALAR_ONE)
}

/// The number that stands for 1 in [`in_256ths`].
pub(crate) const SCALAR_ONE: f32 = 65535.0 / 256.0;

/// A word of 16 bits as a number of 256ths: exact.
#[inline(always)]
pub(crate) fn in_256ths<L: Lanes>(lanes: L, word: L::U32) -> L::Number {
    let (high, low) = (lanes.to_numbers(lanes.shr(word, 8)), lanes.to_numbers(word & lanes.word(255)));
    high + low * lanes.splat(1.0 / 256.0)
}

/// A colour's channels times 2^16: its [`sums`] as a mean of itself.
#[inline(always)]
pub(crate) fn spread<L: Lanes>(lanes: L, color: L::U32) -> [L::U32; 4] {
    let channel = lanes.word(0x00ff_0000);
    [
        lanes.shl(color, 16) & channel,
        lanes.shl(color, 8) & channel,
        color & channel,
        lanes.shr(color, 8) & channel,
    ]
}

/// The colour at `along` 256ths of the way, 0 to 256, from one colour to another that are given by [`sums`]:
///
/// ```text
/// ((256 - along)*near + along*far + 2^23) >> 24
/// ```
///
/// # Cost
/// Four multiplications.
#[inline(always)]
pub(crate) fn between<L: Lanes>(lanes: L, near: [L::U32; 4], far: [L::U32; 4], along: L::U32) -> L::U32 {
    // Below 2^32 in the end, and so modulo 2^32 before.
    let [red, green, blue, alpha] = map4(
        [0, 1, 2, 3],
        #[inline(always)]
        |k| lanes.shl(near[k], 8) + (far[k] - near[k]) * along + lanes.word(1 << 23),
    );
    lanes.shr(red, 24)
        | lanes.shr(green, 16) & lanes.word(0x0000_ff00)
        | lanes.shr(blue, 8) & lanes.word(0x00ff_0000)
        | alpha & lanes.word(0xff00_0000)
}

/// The means of 2^`count` colours of each plane, of halves the upper, with `count` up to 8.
#[inline(always)]
pub(crate) fn mean_of<L: Lanes, const N: usize>(
    lanes: L,
    count: u32,
    mut colors: impl FnMut(u32) -> [L::U32; N],
) -> [L::U32; N] {
    let bytes = lanes.word(BYTES);
    // Half of the count in both lanes of 16 bits; half of one is below no channel.
    let mut sums = [[lanes.word((0x0001_0001 << count) >> 1); 2]; N];
    for k in 0..1 << count {
        sums = each_pair(
            sums,
            colors(k),
            [lanes.word(0); 2],
            #[inline(always)]
            |[red_blue, green_alpha], color| {
                [red_blue + (color & bytes), green_alpha + (lanes.shr(color, 8) & bytes)]
            },
        );
    }
    each(
        sums,
        lanes.word(0),
        #[inline(always)]
        |sums| {
            let [red_blue, green_alpha] = map2(sums, |sum| lanes.shr(sum, count) & bytes);
            red_blue | lanes.shl(green_alpha, 8)
        },
    )
}

/// `(256 - t) * low + t * high` of two lanes of 16 bits: the lower, the upper.
#[inline(always)]
fn rise<L: Lanes>(lanes: L, low: L::U32, high: L::U32, t: L::U32) -> [L::U32; 2] {
    let words = lanes.word(0xffff);
    map2(
        [[low & words, high & words], [lanes.shr(low, 16), lanes.shr(high, 16)]],
        #[inline(always)]
        |[low, high]| lanes.shl(low, 8) + (high - low) * t,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::Rgba8;
    use alberti_math::lanes::One;
    use core::num::Wrapping;

    /// The documented formula as a fraction, a channel at a time, rounded by a division.
    fn mean(corners: [u8; 4], right: u32, up: u32) -> u8 {
        let (x, y) = (i128::from(right), i128::from(up));
        let weights = [(256 - x) * (256 - y), x * (256 - y), (256 - x) * y, x * y];
        assert_eq!(weights.iter().sum::<i128>(), 65536);
        let sum: i128 = weights.iter().zip(corners).map(|(w, c)| w * i128::from(c)).sum();
        u8::try_from((2 * sum + 65536).div_euclid(2 * 65536)).unwrap()
    }

    fn check(corners: [[u8; 4]; 4], right: u32, up: u32) {
        let [low_left, low_right, high_left, high_right] =
            corners.map(|[r, g, b, a]| Wrapping(Rgba8::new(r, g, b, a).to_bits()));
        let quad = Quad::<One> { low_left, low_right, high_left, high_right };
        let found = Rgba8::from_bits(bilinear(One, quad, Wrapping(right), Wrapping(up)).0).to_bytes();
        for channel in 0..4 {
            let values = corners.map(|corner| corner[channel]);
            assert_eq!(found[channel], mean(values, right, up), "{corners:?} at {right}, {up}");
            assert!(
                values.iter().min() <= Some(&found[channel]) && Some(&found[channel]) <= values.iter().max()
            );
        }
    }

    /// The filter is linear in each corner, so its extremes are at the corners' extremes. Each channel gets
    /// another of the 16 patterns, so that a carry from one into another would show.
    #[test]
    fn all_weights_at_all_extremes() {
        for right in 0..=256 {
            for up in 0..=256 {
                for pattern in 0..16u8 {
                    let channels = [pattern, !pattern, pattern.rotate_left(3), pattern ^ 5];
                    let corners: [[u8; 4]; 4] = core::array::from_fn(|corner| {
                        channels.map(|c| if c >> corner & 1 == 1 { 255 } else { 0 })
                    });
                    check(corners, right, up);
                }
            }
        }
    }

    /// Two means of four, and the mean of these: linear in each of the eight corners.
    #[test]
    fn between_two_levels() {
        let word = |bytes: [u8; 4]| Wrapping(u32::from_le_bytes(bytes));
        for (right, up) in [(0, 0), (255, 255), (128, 1), (77, 200), (1, 254)] {
            for along in 0..=256 {
                for pattern in 0..=255u8 {
                    // Other corners, of other colours, for each channel.
                    let corner = |corner: u32| {
                        [pattern, !pattern, pattern.rotate_left(3), pattern ^ 0xa5]
                            .map(|c| if c >> corner & 1 == 1 { 255 } else { 0 })
                    };
                    let colors: [[u8; 4]; 8] = core::array::from_fn(|k| corner(u32::try_from(k).unwrap()));
                    let level = |k: usize| {
                        let [low_left, low_right, high_left, high_right] =
                            [0, 1, 2, 3].map(|corner| word(colors[k + corner]));
                        let quad = Quad::<One> { low_left, low_right, high_left, high_right };
                        sums(One, quad, Wrapping(right), Wrapping(up))
                    };
                    let found = between(One, level(0), level(4), Wrapping(along)).0.to_le_bytes();
                    for channel in 0..4 {
                        let weights = |k: usize| {
                            let (right, up) = (u64::from(right), u64::from(up));
                            (if k & 1 == 0 { 256 - right } else { right })
                                * (if k & 2 == 0 { 256 - up } else { up })
                                * u64::from(if k & 4 == 0 { 256 - along } else { along })
                        };
                        let sum: u64 = (0..8).map(|k| weights(k) * u64::from(colors[k][channel])).sum();
                        assert_eq!(u64::from(found[channel]), (2 * sum + (1 << 24)) / (1 << 25));
                    }
                }
            }
        }
        for color in [0, 0x0123_4567, 0x89ab_cdef, u32::MAX] {
            for (right, up) in [(0, 0), (99, 201), (256, 256)] {
                let color = Wrapping(color);
                let quad =
                    Quad::<One> { low_left: color, low_right: color, high_left: color, high_right: color };
                assert_eq!(sums(One, quad, Wrapping(right), Wrapping(up)), spread(One, color));
            }
        }
    }

    #[test]
    fn means_of_many() {
        for count in 0..=8 {
            for bytes in [[255; 4], [0; 4], [255, 0, 255, 0], [0, 255, 0, 255], [1, 2, 3, 254]] {
                let colors = |k: u32| if k.is_multiple_of(3) { bytes } else { bytes.map(|byte| byte / 2) };
                let [found] = mean_of(One, count, |k| [Wrapping(u32::from_le_bytes(colors(k)))]);
                let found = found.0.to_le_bytes();
                for (channel, found) in found.into_iter().enumerate() {
                    let sum: u32 = (0..1 << count).map(|k| u32::from(colors(k)[channel])).sum();
                    assert_eq!(u32::from(found), (2 * sum + (1 << count)) / (2 << count));
                }
            }
        }
    }

    /// The formula as a fraction, for all weights at all extremes of 16 bits.
    #[test]
    fn numbers_of_16_bits() {
        for extremes in 0..16u32 {
            let corners = [0, 1, 2, 3].map(|corner| (extremes >> corner & 1) * 65535);
            let [low_left, low_right, high_left, high_right] = corners.map(Wrapping);
            let quad = Quad::<One> { low_left, low_right, high_left, high_right };
            for right in 0..=256 {
                for up in 0..=256 {
                    let found = bilinear_scalar(One, quad, Wrapping(right), Wrapping(up));
                    let (x, y) = (u64::from(right), u64::from(up));
                    let weights = [(256 - x) * (256 - y), x * (256 - y), (256 - x) * y, x * y];
                    let sum: u64 = weights.iter().zip(corners).map(|(w, c)| w * u64::from(c)).sum();
                    assert_eq!(u64::from(found.0), (2 * sum + 65536) / 131_072);
                }
            }
        }
        for word in 0..=u16::MAX {
            let found = scalar_number(One, Wrapping(word.into()));
            assert_eq!(found.to_bits(), (f32::from(word) / 65535.0).to_bits());
        }
    }

    #[test]
    fn random_colours() {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        for _ in 0..2_000_000 {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            let noise = u128::from(state).wrapping_mul(0xda94_2042_e4dd_58b5_0123_4567_89ab_cdef);
            let bytes = noise.to_le_bytes();
            let corners =
                core::array::from_fn(|corner| core::array::from_fn(|channel| bytes[corner * 4 + channel]));
            check(corners, (state >> 20 & 255) as u32, (state >> 40 & 255) as u32);
        }
    }
}
