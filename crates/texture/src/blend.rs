//! The weighted mean of four colours, in integers with one rounding.

use alberti_math::lanes::Lanes;

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
    let Quad { low_left, low_right, high_left, high_right } = quad;
    let bytes = lanes.word(BYTES);
    let red_blue = rise(
        lanes,
        across(lanes, low_left & bytes, low_right & bytes, right),
        across(lanes, high_left & bytes, high_right & bytes, right),
        up,
    );
    let green_alpha = rise(
        lanes,
        across(lanes, lanes.shr(low_left, 8) & bytes, lanes.shr(low_right, 8) & bytes, right),
        across(lanes, lanes.shr(high_left, 8) & bytes, lanes.shr(high_right, 8) & bytes, right),
        up,
    );
    red_blue | lanes.shl(green_alpha, 8)
}

/// `(256 - t) * left + t * right` in two lanes of 16 bits.
///
/// A lane of the difference may be negative and borrow from the next, but lanes of the sum are 0 to 255 * 256, so as a
/// number modulo 2^32 the sum is the two side by side.
#[inline(always)]
fn across<L: Lanes>(lanes: L, left: L::U32, right: L::U32, t: L::U32) -> L::U32 {
    lanes.shl(left, 8) + (right - left) * t
}

/// `((256 - t) * low + t * high + 2^15) >> 16` of two lanes of 16 bits: bytes 0 and 2 of the result.
#[inline(always)]
fn rise<L: Lanes>(lanes: L, low: L::U32, high: L::U32, t: L::U32) -> L::U32 {
    let words = lanes.word(0xffff);
    let below = mean(lanes, low & words, high & words, t);
    let above = mean(lanes, lanes.shr(low, 16), lanes.shr(high, 16), t);
    // The upper half of that word is the channel, in place.
    lanes.shr(below, 16) | above & lanes.word(0x00ff_0000)
}

/// `(256 - t) * low + t * high + 2^15`, at most 255 * 2^16 + 2^15.
#[inline(always)]
fn mean<L: Lanes>(lanes: L, low: L::U32, high: L::U32, t: L::U32) -> L::U32 {
    lanes.shl(low, 8) + (high - low) * t + lanes.word(1 << 15)
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
