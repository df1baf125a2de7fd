//! What texels stand for, and so what their mean is.

use alberti_math::Rgba8;

use crate::format::{Encode, L16};
use crate::{TexelFormat, srgb};

/// What the texels of a format stand for: [`Srgb`], [`Linear`] or [`Normals`]. Other crates cannot add to them.
pub trait Content<F: TexelFormat>: Mean<F> {}

/// The working part of [`Content`]; not nameable outside, so that it can still change.
pub trait Mean<F: TexelFormat> {
    /// A weighted sum of texels.
    type Sum: Default;

    /// Adds so many times the texel.
    fn add(sum: &mut Self::Sum, weight: u64, texel: F::Texel);

    /// The mean. Weights add up to `weights`, from 1 to 2^28.
    fn mean(sum: &Self::Sum, weights: u64) -> F::Texel;
}

/// Colours in sRGB, whose mean is that of their light; alpha is linear. Colours are not weighted by alpha.
///
/// # Precision
/// A channel of 8 bits is within 0.55 of the mean in real numbers: 0.5 of the last rounding, and 0.05 of light in 16
/// bits. The mean of the bytes themselves would be off by up to 70.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Srgb;

/// Numbers, heights or masks for example, whose mean is that of their values.
///
/// # Precision
/// Correctly rounded, halves up: to 8 bits, and [`L16`] to 16.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Linear;

/// Directions: red, green and blue are x, y and z from -1 to 1 as 2c/255 - 1. The mean of the vectors is made a unit
/// vector again; where they cancel out it is (0, 0, 1). Alpha is linear.
///
/// # Precision
/// A component is within 0.501 steps of the exact unit vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Normals;

impl<F: Encode> Content<F> for Srgb {}
impl<F: Encode> Content<F> for Linear {}
impl Content<L16> for Linear {}
impl<F: Encode> Content<F> for Normals {}

/// `sum / weights`, rounded to nearest, halves up; at most 65535.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "a mean of such numbers")]
fn rounded(sum: u64, weights: u64) -> u16 {
    ((2 * sum + weights) / (2 * weights).max(1)) as u16
}

/// The same for a mean of bytes.
#[inline]
fn byte(sum: u64, weights: u64) -> u8 {
    rounded(sum, weights).to_le_bytes()[0]
}

impl<F: Encode> Mean<F> for Srgb {
    type Sum = [u64; 4];

    #[inline]
    fn add(sum: &mut [u64; 4], weight: u64, texel: F::Texel) {
        let [r, g, b, a] = F::decode(texel).to_bytes();
        let light = [r, g, b].map(srgb::to_light);
        for (sum, value) in sum.iter_mut().zip([light[0], light[1], light[2], a.into()]) {
            *sum += weight * u64::from(value);
        }
    }

    #[inline]
    fn mean(&[r, g, b, a]: &[u64; 4], weights: u64) -> F::Texel {
        let [r, g, b] = [r, g, b].map(|sum| srgb::to_byte(rounded(sum, weights)));
        F::encode(Rgba8::new(r, g, b, byte(a, weights)))
    }
}

impl<F: Encode> Mean<F> for Linear {
    type Sum = [u64; 4];

    #[inline]
    fn add(sum: &mut [u64; 4], weight: u64, texel: F::Texel) {
        for (sum, value) in sum.iter_mut().zip(F::decode(texel).to_bytes()) {
            *sum += weight * u64::from(value);
        }
    }

    #[inline]
    fn mean(sum: &[u64; 4], weights: u64) -> F::Texel {
        let [r, g, b, a] = sum.map(|sum| byte(sum, weights));
        F::encode(Rgba8::new(r, g, b, a))
    }
}

impl Mean<L16> for Linear {
    type Sum = u64;

    #[inline]
    fn add(sum: &mut u64, weight: u64, texel: u16) {
        *sum += weight * u64::from(texel);
    }

    #[inline]
    fn mean(&sum: &u64, weights: u64) -> u16 {
        rounded(sum, weights)
    }
}

impl<F: Encode> Mean<F> for Normals {
    type Sum = [u64; 4];

    #[inline]
    fn add(sum: &mut [u64; 4], weight: u64, texel: F::Texel) {
        <Linear as Mean<F>>::add(sum, weight, texel);
    }

    #[inline]
    fn mean(&[x, y, z, alpha]: &[u64; 4], weights: u64) -> F::Texel {
        // In units of 1/255 of the weights: at most 2^36 either way.
        let vector = [x, y, z].map(|sum| (2 * sum).cast_signed() - (255 * weights).cast_signed());
        let [r, g, b] = unit(vector).unwrap_or([128, 128, 255]);
        F::encode(Rgba8::new(r, g, b, byte(alpha, weights)))
    }
}

/// A vector divided by its length, -1 to 1 as 0 to 255; `None` if it is 0. Components are below 2^40.
fn unit(vector: [i64; 3]) -> Option<[u8; 3]> {
    let greatest = vector.iter().fold(0, |greatest, x| x.unsigned_abs().max(greatest));
    if greatest == 0 {
        return None;
    }
    // The greatest gets 30 bits, so that the sum of squares fits.
    let bits = 64 - greatest.leading_zeros();
    let vector = vector.map(|x| if bits > 30 { x >> (bits - 30) } else { x << (30 - bits) });
    let squares: u64 = vector.iter().map(|x| x.unsigned_abs() * x.unsigned_abs()).sum();
    let length = squares.isqrt().cast_signed();
    // 255 (1 + x) / 2, where rounding may have left the length a little less than a component.
    Some(vector.map(|x| {
        let steps = (255 * (x + length) + length) / (2 * length).max(1);
        steps.clamp(0, 255).to_le_bytes()[0]
    }))
}
