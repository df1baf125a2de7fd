//! Numbers in fixed point: integers that count 65536ths.

use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number from -32768 to 32768 in steps of 2^-16, for machines without floating point.
///
/// # Precision
/// Sums and differences are exact while they fit and wrap when they do not. Products are rounded to the nearest step,
/// halves up, and wrap like sums. Quotients are rounded towards zero, and are 0 for a divisor of 0. Quotients, and
/// floats that are converted, become the nearest in the range.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable, bytemuck::TransparentWrapper))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Q16(i32);

impl Q16 {
    /// 0.
    pub const ZERO: Self = Self(0);
    /// 1.
    pub const ONE: Self = Self(1 << 16);

    /// So many 65536ths.
    #[must_use]
    #[inline(always)]
    pub const fn from_bits(bits: i32) -> Self {
        Self(bits)
    }

    /// The number of 65536ths.
    #[must_use]
    #[inline(always)]
    pub const fn to_bits(self) -> i32 {
        self.0
    }

    /// The sum, or the nearest in the range.
    #[must_use]
    #[inline(always)]
    pub const fn saturating_add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }

    /// The difference, or the nearest in the range.
    #[must_use]
    #[inline(always)]
    pub const fn saturating_sub(self, other: Self) -> Self {
        Self(self.0.saturating_sub(other.0))
    }

    /// The product, rounded as it is by `*`, or the nearest in the range.
    #[must_use]
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "compared before")]
    pub const fn saturating_mul(self, other: Self) -> Self {
        let product = (self.0 as i64 * other.0 as i64 + (1 << 15)) >> 16;
        Self(if product > i32::MAX as i64 {
            i32::MAX
        } else if product < i32::MIN as i64 {
            i32::MIN
        } else {
            product as i32
        })
    }

    /// The nearest to `x`, halves away from 0; NaN is 0.
    ///
    /// # Cost
    /// About fifteen integer instructions, without floating point; nine with it where the core has it.
    #[must_use]
    #[inline]
    pub const fn from_f32(x: f32) -> Self {
        Self(scaled(x, 16))
    }

    /// The nearest `f32`: exact for numbers in (-256, 256).
    #[must_use]
    #[inline]
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest is what is documented")]
    pub const fn to_f32(self) -> f32 {
        self.0 as f32 * (1.0 / 65536.0)
    }
}

/// x·2^`bits` to the nearest integer, for `bits` from -97 on, halves away from 0; the nearest `i32` from outside, 0 for
/// NaN.
///
/// # Cost
/// About fifteen integer instructions, without floating point; nine with it where the core has it.
#[must_use]
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "compared before")]
pub const fn scaled(x: f32, bits: i32) -> i32 {
    if cfg!(target_abi = "eabihf") && -126 <= bits && bits <= 127 {
        return scaled_by_floats(x, bits);
    }
    let word = x.to_bits();
    let exponent = (word >> 23 & 0xff).cast_signed();
    // x·2^bits = mantissa·2^-shift, the mantissa's highest bit being 2^31 but in a subnormal.
    let [mantissa, exponent] = if exponent == 0 {
        [word << 8 & i32::MAX as u32, 1]
    } else {
        [word << 8 | 1 << 31, exponent.cast_unsigned()]
    };
    let shift = 158 - bits - exponent.cast_signed();
    let magnitude = if shift > 32 {
        0
    } else if shift > 0 {
        // Half a unit to the last bit that goes; with a shift of 32 that bit is the highest.
        let kept = if shift == 32 { 0 } else { mantissa >> shift };
        kept + (mantissa >> (shift - 1) & 1)
    } else if word << 1 > 0xff00_0000 {
        0
    } else {
        // Only subnormals may still fit.
        let wide = (mantissa as u64) << if shift < -32 { 32 } else { shift.unsigned_abs() };
        if wide > u32::MAX as u64 { u32::MAX } else { wide as u32 }
    };
    match (magnitude > i32::MAX as u32, word >> 31 != 0) {
        (true, false) => i32::MAX,
        (true, true) => i32::MIN,
        (false, negative) => {
            let magnitude = magnitude.cast_signed();
            if negative { -magnitude } else { magnitude }
        }
    }
}

/// The same in `f32`, where that is faster than integers. All is exact: a power of two, an integer, and what is left.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "saturation is what is wanted")]
#[expect(clippy::cast_precision_loss, reason = "it came from an f32")]
#[expect(clippy::cast_sign_loss, reason = "from 1 to 254")]
const fn scaled_by_floats(x: f32, bits: i32) -> i32 {
    let scaled = x * f32::from_bits(((127 + bits) as u32) << 23);
    let whole = scaled as i32;
    let left = scaled - whole as f32;
    whole.saturating_add((left + left) as i32)
}

impl Add for Q16 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl Sub for Q16 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

impl Neg for Q16 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

impl Mul for Q16 {
    type Output = Self;
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "wraps, as documented for what does not fit")]
    fn mul(self, other: Self) -> Self {
        Self(((i64::from(self.0) * i64::from(other.0) + (1 << 15)) >> 16) as i32)
    }
}

impl Div for Q16 {
    type Output = Self;
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "clamped before")]
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the scale of a quotient of scaled numbers")]
    fn div(self, other: Self) -> Self {
        let quotient = (i64::from(self.0) << 16).checked_div(i64::from(other.0)).unwrap_or(0);
        Self(quotient.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
    }
}

impl fmt::Debug for Q16 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/65536", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In `f64`, where scaling by a power of two is exact, and `round` goes away from 0.
    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "saturation is the documented result")]
    fn floats_become_the_nearest_integers() {
        for bits in (0..=u32::MAX).step_by(1009).chain([0x7f80_0000, 0xff80_0000, 0x7fc0_0000, 0xffc0_0000]) {
            let x = f32::from_bits(bits);
            for scale in [-97, -20, 0, 1, 16, 30, 31, 100, 179] {
                let expected = (f64::from(x) * 2f64.powi(scale)).round() as i32;
                assert_eq!(scaled(x, scale), expected, "{x:e} by 2^{scale}");
                if (-126..=127).contains(&scale) {
                    assert_eq!(scaled_by_floats(x, scale), expected, "{x:e} by 2^{scale}");
                }
            }
        }
        for halves in -2000..2000i16 {
            let x = f32::from(halves) / 131_072.0;
            assert_eq!(i64::from(Q16::from_f32(x).to_bits()), (f64::from(halves) / 2.0).round() as i64);
        }
    }

    #[test]
    fn arithmetic_is_that_of_rationals_rounded() {
        let numbers = [0, 1, -1, 5, 65536, -65536, 98_304, 1_000_003, -77_777_777, i32::MAX, i32::MIN];
        for a in numbers {
            for b in numbers {
                let (x, y) = (Q16::from_bits(a), Q16::from_bits(b));
                let (a, b) = (i128::from(a), i128::from(b));
                let product = (a * b * 2 + 65536).div_euclid(131_072);
                if let Ok(fits) = i32::try_from(product) {
                    assert_eq!((x * y).to_bits(), fits);
                }
                let saturated = [x.saturating_add(y), x.saturating_sub(y), x.saturating_mul(y)];
                let nearest =
                    [a + b, a - b, product].map(|exact| exact.clamp(i32::MIN.into(), i32::MAX.into()));
                assert_eq!(saturated.map(|found| i128::from(found.to_bits())), nearest);
                let quotient = if b == 0 { 0 } else { a * 65536 / b };
                assert_eq!(i128::from((x / y).to_bits()), quotient.clamp(i32::MIN.into(), i32::MAX.into()));
            }
        }
    }
}
