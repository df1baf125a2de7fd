//! One sample at a time, in integers.

use super::one::one_lane;
use super::{Lanes, jacobi};
use crate::Q16;
use core::num::Wrapping;

/// One sample at a time, in fixed point: for machines without floating point.
///
/// # Precision
/// That of [`Q16`]: steps of 2^-16. Depths are words.
#[derive(Clone, Copy, Debug, Default)]
pub struct OneFixed;

impl Lanes for OneFixed {
    const FIXED: bool = true;
    type Number = Q16;
    type Depth = u32;
    one_lane!();

    #[inline(always)]
    fn splat(self, x: f32) -> Q16 {
        Q16::from_f32(x)
    }

    #[inline(always)]
    fn ramp(self) -> Q16 {
        Q16::ZERO
    }

    #[inline(always)]
    fn load(self, values: &[f32; 1]) -> Q16 {
        Q16::from_f32(values[0])
    }

    #[inline(always)]
    fn store(self, values: Q16) -> [f32; 1] {
        [values.to_f32()]
    }

    #[inline(always)]
    fn each_depth<T: Copy>(self, depth: u32, _: impl Fn(f32) -> T, raw: impl Fn(u32) -> T) -> [T; 1] {
        [raw(depth)]
    }

    #[inline(always)]
    fn min(self, a: Q16, b: Q16) -> Q16 {
        a.min(b)
    }

    #[inline(always)]
    fn max(self, a: Q16, b: Q16) -> Q16 {
        a.max(b)
    }

    #[inline(always)]
    fn saturating_add(self, a: Q16, b: Q16) -> Q16 {
        a.saturating_add(b)
    }

    #[inline(always)]
    fn saturating_sub(self, a: Q16, b: Q16) -> Q16 {
        a.saturating_sub(b)
    }

    #[inline(always)]
    fn saturating_mul(self, a: Q16, b: Q16) -> Q16 {
        a.saturating_mul(b)
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "at most 2^24")]
    fn sqrt(self, x: Q16) -> Q16 {
        let square = u64::from(x.to_bits().max(0).unsigned_abs()) << 16;
        Q16::from_bits((square.isqrt() as u32).cast_signed())
    }

    #[inline]
    fn log2_length(self, x: Q16, y: Q16, scale: [u32; 2]) -> Q16 {
        const LOG2: [i32; 2] =
            [Q16::from_f32(super::LOG2[0]).to_bits(), Q16::from_f32(super::LOG2[1]).to_bits()];

        let scaled = |x: Q16, scale: u32| {
            let x = x.to_bits().unsigned_abs();
            // Mostly of 32 bits, as one of 64 is a call on the smallest cores.
            if x <= 1 << 16 { x * scale } else { (u64::from(x) * u64::from(scale)).min(1 << 31) as u32 }
        };
        let (x, y) = (scaled(x, scale[0]), scaled(y, scale[1]));
        // To 15 bits, so that two squares have room; in units of 2^(spare - 16).
        let spare = 17_u32.saturating_sub((x | y).leading_zeros());
        let rounded = |x: u32| (x + (1 << spare >> 1)) >> spare;
        let (x, y) = (rounded(x), rounded(y));
        let square = (x * x + y * y).max(1);
        let zeros = square.leading_zeros();
        // The bits behind the first, as 65536ths.
        let m = ((square << zeros << 1) >> 16).cast_signed();
        let correction = ((m * ((1 << 16) - m)) >> 16) * (LOG2[0] + ((LOG2[1] * m) >> 16));
        let log2 = ((2 * spare.cast_signed() - 1 - zeros.cast_signed()) << 16) + m + (correction >> 16);
        Q16::from_bits((log2 + 1) >> 1)
    }

    #[inline]
    fn jacobi_rotation(self, x: [Q16; 2], y: [Q16; 2], scale: [u32; 2]) -> [Q16; 2] {
        jacobi::fixed(x, y, scale)
    }

    #[inline(always)]
    fn wrap(self, x: Q16, period: u32) -> Q16 {
        Q16::from_bits(x.to_bits() & ((1_u32 << (16 + period)) - 1).cast_signed())
    }

    #[inline(always)]
    fn floor_scaled(self, x: Q16, bits: u32) -> Wrapping<u32> {
        let x = x.to_bits();
        Wrapping(if bits <= 16 { x >> (16 - bits) } else { x << (bits - 16) }.cast_unsigned())
    }

    #[inline(always)]
    fn floor_fraction_scaled(self, x: Q16, bits: u32) -> Wrapping<u32> {
        Wrapping((x.to_bits().cast_unsigned() & 0xffff) >> (16 - (bits & 15)))
    }

    #[inline(always)]
    fn floor_scaled_finely(self, x: Q16, bits: u32, more: u32) -> Wrapping<u32> {
        Wrapping((x.to_bits() << (bits & 15) >> (16 - more)).cast_unsigned())
    }

    #[inline(always)]
    fn round_scaled(self, x: Q16, bits: u32) -> Wrapping<u32> {
        let x = x.to_bits();
        Wrapping(
            if bits < 16 { (x >> (15 - bits)).wrapping_add(1) >> 1 } else { x << (bits - 16) }
                .cast_unsigned(),
        )
    }

    #[inline(always)]
    fn nearest_byte(self, x: Q16) -> Wrapping<u32> {
        let x = x.to_bits().clamp(0, 255 << 16).cast_unsigned();
        Wrapping((x + (1 << 15)) >> 16)
    }

    #[inline(always)]
    fn of_unit(self, x: Q16, greatest: u16) -> Wrapping<u32> {
        // The last step below 1 still becomes the greatest.
        let x = x.to_bits().clamp(0, (1 << 16) - 1).cast_unsigned();
        Wrapping((x * u32::from(greatest) + (1 << 15)) >> 16)
    }

    #[inline(always)]
    fn to_numbers(self, x: Wrapping<u32>) -> Q16 {
        Q16::from_bits((x.0 << 16).cast_signed())
    }

    #[inline(always)]
    fn less(self, a: Q16, b: Q16) -> bool {
        a < b
    }

    #[inline(always)]
    fn int_to_number(self, x: i32) -> Q16 {
        Q16::from_bits(x.saturating_mul(1 << 16))
    }

    #[inline(always)]
    fn long_parts(self, _: i64, _: u32) -> [Q16; 2] {
        [self.splat(0.0); 2]
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "clamped before")]
    fn long_to_number(self, x: i64) -> Q16 {
        self.int_to_number(x.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
    }
}
