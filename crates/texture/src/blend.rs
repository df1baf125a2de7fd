//! The weighted mean of four colours, in integers with one rounding.

use alberti_math::Rgba8;

/// Bytes 0, 2, 4 and 6: four channels in lanes of 16 bits.
const BYTES: u64 = 0x00ff_00ff_00ff_00ff;

/// The low half of each 32-bit lane.
const WORDS: u64 = 0x0000_ffff_0000_ffff;

/// One half in each 32-bit lane of 16 bits of fraction.
const HALVES: u64 = 0x0000_8000_0000_8000;

/// Four neighbouring texels, named as in a diagram with u to the right and v up.
#[derive(Clone, Copy)]
pub(crate) struct Quad {
    pub(crate) low_left: Rgba8,
    pub(crate) low_right: Rgba8,
    pub(crate) high_left: Rgba8,
    pub(crate) high_right: Rgba8,
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
/// Four multiplications for the four channels.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the colour is in the low 32 bits")]
pub(crate) fn bilinear(quad: Quad, right: u64, up: u64) -> Rgba8 {
    let low = across(quad.low_left, quad.low_right, right);
    let high = across(quad.high_left, quad.high_right, right);
    let red_green = rise(low & WORDS, high & WORDS, up);
    let blue_alpha = rise(low >> 16 & WORDS, high >> 16 & WORDS, up);
    // The bytes in the lanes of `spread`, and the way back: G and A move down by 24 bits.
    let bytes = red_green >> 16 & 0x0000_00ff_0000_00ff | blue_alpha & 0x00ff_0000_00ff_0000;
    let bits = bytes | bytes >> 24;
    Rgba8::from_bits(bits as u32)
}

/// `(256 - t) * left + t * right` in lanes of 16 bits: red, blue, green, alpha from the lowest.
///
/// A lane of the difference may be negative and borrow from the next, but lanes of the sum are 0 to 255 * 256,
/// so as a number modulo 2^64 the sum is the four of them side by side.
#[inline]
fn across(left: Rgba8, right: Rgba8, t: u64) -> u64 {
    let (left, right) = (spread(left), spread(right));
    (left << 8).wrapping_add(right.wrapping_sub(left).wrapping_mul(t))
}

/// `(256 - t) * low + t * high + 2^15` in two lanes of 32 bits, at most 255 * 2^16 + 2^15.
#[inline]
fn rise(low: u64, high: u64, t: u64) -> u64 {
    ((low << 8) + HALVES).wrapping_add(high.wrapping_sub(low).wrapping_mul(t))
}

/// The bytes R, G, B, A in lanes of 16 bits in the order R, B, G, A.
#[inline]
fn spread(color: Rgba8) -> u64 {
    let bits = u64::from(color.to_bits());
    (bits | bits << 24) & BYTES
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The documented formula as a fraction, a channel at a time, rounded by a division.
    fn mean(corners: [u8; 4], right: u64, up: u64) -> u8 {
        let (x, y) = (i128::from(right), i128::from(up));
        let weights = [(256 - x) * (256 - y), x * (256 - y), (256 - x) * y, x * y];
        assert_eq!(weights.iter().sum::<i128>(), 65536);
        let sum: i128 = weights.iter().zip(corners).map(|(w, c)| w * i128::from(c)).sum();
        u8::try_from((2 * sum + 65536).div_euclid(2 * 65536)).unwrap()
    }

    fn check(corners: [[u8; 4]; 4], right: u64, up: u64) {
        let [low_left, low_right, high_left, high_right] = corners.map(|[r, g, b, a]| Rgba8::new(r, g, b, a));
        let found = bilinear(Quad { low_left, low_right, high_left, high_right }, right, up).to_bytes();
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
            check(corners, state >> 20 & 255, state >> 40 & 255);
        }
    }
}
