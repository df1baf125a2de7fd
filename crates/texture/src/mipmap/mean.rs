//! The mean of texels, for each content.

use alberti_math::{Rgba8, srgb};

use crate::format::{Content, TexelFormat};

/// The numbers of a colour whose sums make a mean: amounts of light, or bytes.
#[inline]
pub(crate) fn addends(content: Content, color: Rgba8) -> [u16; 4] {
    let [r, g, b, a] = color.to_bytes();
    match content {
        Content::Srgb => [srgb::to_light(r), srgb::to_light(g), srgb::to_light(b), a.into()],
        Content::Scalars | Content::Normals => [r.into(), g.into(), b.into(), a.into()],
    }
}

/// Sums of four addends, two in a word: of the first and the second, and of the others. What is below 2^32 in the end
/// may be the difference of sums that are not.
pub(super) type Packed = [u64; 2];

/// The first, or third, of such sums.
pub(super) const LOW: u64 = 0xffff_ffff;

/// The addends of a texel.
#[inline]
pub(super) fn packed<F: TexelFormat>(format: F, texel: F::Texel) -> Packed {
    let [a, b, c, d] = format.addends(format.content(), texel).map(u64::from);
    [a + (b << 32), c + (d << 32)]
}

#[inline]
pub(super) const fn unpacked([ab, cd]: Packed) -> [u64; 4] {
    [ab & LOW, ab >> 32, cd & LOW, cd >> 32]
}

#[inline]
pub(super) const fn sum([a, b]: Packed, [c, d]: Packed) -> Packed {
    [a + c, b + d]
}

/// The mean of colours by the sums of their addends, each times its weight.
#[inline]
pub(crate) fn of_colors(content: Content, [x, y, z, alpha]: [u64; 4], weights: Weights) -> Rgba8 {
    let alpha = weights.byte(alpha);
    let [r, g, b] = match content {
        Content::Srgb => [x, y, z].map(|sum| srgb::to_byte(weights.mean(sum))),
        Content::Scalars => [x, y, z].map(|sum| weights.byte(sum)),
        Content::Normals => {
            // In units of 1/255 of the weights: at most 2^36 either way.
            let middle = 255 * i64::from(weights.sum);
            let vector = [x, y, z].map(|sum| sum.wrapping_mul(2).cast_signed().wrapping_sub(middle));
            unit(vector).unwrap_or([128, 128, 255])
        }
    };
    Rgba8::new(r, g, b, alpha)
}

/// The greatest sum of weights.
const MOST: u32 = 1 << 28;

/// The weights of a mean: their sum, and what divides by it.
#[derive(Clone, Copy, Debug)]
pub struct Weights {
    sum: u32,
    /// Of twice the sum, which is at least 2^exponent and below twice that: 2^(exponent + 32), divided by it.
    reciprocal: u32,
    /// The lower bits of a dividend, without which it has 32, and those of its product with the reciprocal.
    dropped: u32,
    shift: u32,
}

impl Weights {
    /// Weights of this sum, from 1 to 2^28; another counts as the nearest of these.
    #[must_use]
    pub const fn new(sum: u32) -> Self {
        let sum = match sum {
            0 => 1,
            1..=MOST => sum,
            _ => MOST,
        };
        let divisor = 2 * sum as u64;
        let exponent = divisor.ilog2();
        #[expect(
            clippy::cast_possible_truncation,
            reason = "below 2^32, as the divisor is at least 2^exponent"
        )]
        let reciprocal = (((1 << (exponent + 32)) - 1) / divisor) as u32;
        let dropped = exponent.saturating_sub(15);
        Self { sum, reciprocal, dropped, shift: exponent + 32 - dropped }
    }

    /// A sum of numbers, each times its weight, divided by that of the weights and rounded to nearest, halves up. The
    /// numbers are at most 65535.
    ///
    /// The upper bits of the dividend times the reciprocal are less than 2^-14 too little, so that the quotient is
    /// right or 1 too little. Chips divide 64 bits by hundreds of instructions.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a mean of such numbers, and a rest below twice the divisor"
    )]
    pub(crate) const fn mean(self, sum: u64) -> u16 {
        let (dividend, divisor) = (sum.wrapping_mul(2).wrapping_add(self.sum as u64), 2 * self.sum);
        let upper = (dividend >> self.dropped) as u32 as u64;
        let quotient = ((upper * self.reciprocal as u64) >> self.shift) as u32;
        let rest = (dividend as u32).wrapping_sub(quotient.wrapping_mul(divisor));
        (quotient + (rest >= divisor) as u32) as u16
    }

    /// The same of bytes.
    #[inline]
    const fn byte(self, sum: u64) -> u8 {
        self.mean(sum).to_le_bytes()[0]
    }
}

/// A vector divided by its length, -1 to 1 as 0 to 255; `None` if it is 0. Components are below 2^40.
fn unit(vector: [i64; 3]) -> Option<[u8; 3]> {
    #[expect(clippy::cast_precision_loss, reason = "they are below 2^40")]
    let vector = vector.map(|x| x as f64);
    let squares: f64 = vector.iter().map(|x| x * x).sum();
    if squares == 0.0 {
        return None;
    }
    // By Newton's iteration, since `core` has no square root: within 4 %, 0.2 %, 5e-6 and 4e-11.
    let mut reciprocal = f64::from_bits(0x5fe6_eb50_c7b5_37a9 - (squares.to_bits() >> 1));
    for _ in 0..3 {
        reciprocal *= 1.5 - 0.5 * squares * reciprocal * reciprocal;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "they stop at 0 and 255")]
    Some(vector.map(|x| (127.5 + 127.5 * (x * reciprocal) + 0.5) as u8))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quotients against those of 64 bits, at both sides of each place where they change.
    #[test]
    fn means_are_quotients() {
        let sums = (1..300).chain((0..29).flat_map(|k| [(1 << k) - 1, 1 << k, (1 << k) + 1, 3 << k >> 1]));
        for weights in sums.filter(|weights| (1..=1 << 28).contains(weights)) {
            let divisor = 2 * u64::from(weights);
            for mean in (0..=65535).step_by(if weights < 300 { 97 } else { 1 }) {
                // The least sum whose mean this is, and what is on its sides.
                let least = (mean * divisor).saturating_sub(weights.into()).div_ceil(2);
                for sum in [least.saturating_sub(1), least, least + 1].map(|sum| sum.min(65535 * divisor / 2))
                {
                    let exact = (2 * sum + u64::from(weights)) / divisor;
                    assert_eq!(u64::from(Weights::new(weights).mean(sum)), exact, "{sum} / {weights}");
                }
            }
        }
    }
}
