//! The mean of texels, for each content.

use alberti_math::{Rgba8, srgb};

use crate::format::Content;

/// The numbers of a colour whose sums make a mean: amounts of light, or bytes.
#[inline]
pub(crate) fn addends(content: Content, color: Rgba8) -> [u16; 4] {
    let [r, g, b, a] = color.to_bytes();
    match content {
        Content::Srgb => [srgb::to_light(r), srgb::to_light(g), srgb::to_light(b), a.into()],
        Content::Scalars | Content::Normals => [r.into(), g.into(), b.into(), a.into()],
    }
}

/// The mean of colours by the sums of their addends, each times a weight, and that of the weights: from 1 to 2^28.
#[inline]
pub(crate) fn of_colors(content: Content, [x, y, z, alpha]: [u64; 4], weights: u64) -> Rgba8 {
    let alpha = byte(alpha, weights);
    let [r, g, b] = match content {
        Content::Srgb => [x, y, z].map(|sum| srgb::to_byte(rounded(sum, weights))),
        Content::Scalars => [x, y, z].map(|sum| byte(sum, weights)),
        Content::Normals => {
            // In units of 1/255 of the weights: at most 2^36 either way.
            let vector = [x, y, z].map(|sum| (2 * sum).cast_signed() - (255 * weights).cast_signed());
            unit(vector).unwrap_or([128, 128, 255])
        }
    };
    Rgba8::new(r, g, b, alpha)
}

/// `sum / weights`, rounded to nearest, halves up; at most 65535.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "a mean of such numbers")]
pub(crate) fn rounded(sum: u64, weights: u64) -> u16 {
    let (dividend, divisor) = (2 * sum + weights, (2 * weights).max(1));
    // Chips divide 64 bits by hundreds of instructions.
    let quotient =
        if divisor.is_power_of_two() { dividend >> divisor.trailing_zeros() } else { dividend / divisor };
    quotient as u16
}

/// The same for a mean of bytes.
#[inline]
fn byte(sum: u64, weights: u64) -> u8 {
    rounded(sum, weights).to_le_bytes()[0]
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
