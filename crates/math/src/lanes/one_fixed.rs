//! One sample at a time, in integers.

use super::Lanes;
use super::one::one_lane;
use crate::Q16;
use core::num::Wrapping;

/// One sample at a time, in fixed point: for machines without floating point.
///
/// # Precision
/// That of [`Q16`]: steps of 2^-16. Depths are words.
#[derive(Clone, Copy, Debug, Default)]
pub struct OneFixed;

impl Lanes for OneFixed {
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
    #[expect(clippy::cast_possible_truncation, reason = "at most 2^24")]
    fn sqrt(self, x: Q16) -> Q16 {
        let square = u64::from(x.to_bits().max(0).unsigned_abs()) << 16;
        Q16::from_bits((square.isqrt() as u32).cast_signed())
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
    #[expect(clippy::cast_possible_truncation, reason = "clamped before")]
    fn long_to_number(self, x: i64) -> Q16 {
        self.int_to_number(x.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
    }
}
