//! One sample at a time, in the plain numbers of the machine.

use super::Lanes;
use core::num::Wrapping;

/// One sample at a time: the plain code of a microcontroller, and what all others must equal.
#[derive(Clone, Copy, Debug, Default)]
pub struct One;

impl Lanes for One {
    const COUNT: usize = 1;
    type F32 = f32;
    type U32 = Wrapping<u32>;
    type Int = i32;
    type Long = i64;
    type Mask = bool;
    type Each<T: Copy> = [T; 1];

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        f()
    }

    #[inline(always)]
    fn split<T: Copy>(slice: &mut [T]) -> Option<(&mut [T; 1], &mut [T])> {
        slice.split_first_chunk_mut()
    }

    #[inline(always)]
    fn each<T: Copy>(self, mut f: impl FnMut(usize) -> T) -> [T; 1] {
        [f(0)]
    }

    #[inline(always)]
    fn splat(self, x: f32) -> f32 {
        x
    }

    #[inline(always)]
    fn word(self, x: u32) -> Wrapping<u32> {
        Wrapping(x)
    }

    #[inline(always)]
    fn ramp(self) -> f32 {
        0.0
    }

    #[inline(always)]
    fn load(self, values: &[f32; 1]) -> f32 {
        values[0]
    }

    #[inline(always)]
    fn store(self, values: f32) -> [f32; 1] {
        [values]
    }

    #[inline(always)]
    fn store_where(self, mask: bool, values: f32, to: &mut [f32; 1]) {
        if mask {
            *to = [values];
        }
    }

    #[inline(always)]
    fn load_words(self, values: &[u32; 1]) -> Wrapping<u32> {
        Wrapping(values[0])
    }

    #[inline(always)]
    fn store_words(self, values: Wrapping<u32>) -> [u32; 1] {
        [values.0]
    }

    // For finite values these are single machine instructions, which f32::min and max, having to decide about NaN, are
    // not.
    #[inline(always)]
    fn min(self, a: f32, b: f32) -> f32 {
        if a < b { a } else { b }
    }

    #[inline(always)]
    fn max(self, a: f32, b: f32) -> f32 {
        if a > b { a } else { b }
    }

    #[inline(always)]
    fn sqrt(self, x: f32) -> f32 {
        #[cfg(feature = "std")]
        return x.sqrt();
        #[cfg(not(feature = "std"))]
        return libm::sqrtf(x);
    }

    #[inline(always)]
    fn trunc(self, x: f32) -> f32 {
        // From 2^23 on, and for what is no number, there is nothing to round.
        #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "below 2^23")]
        let below = x as i32 as f32;
        if x.abs() < 8_388_608.0 { below } else { x }
    }

    #[inline(always)]
    fn floor(self, x: f32) -> Wrapping<u32> {
        #[expect(clippy::cast_possible_truncation, reason = "within the documented range")]
        let towards_zero = x as i32;
        #[expect(clippy::cast_precision_loss, reason = "it came from an f32")]
        let above = towards_zero as f32 > x;
        Wrapping(towards_zero.cast_unsigned().wrapping_sub(u32::from(above)))
    }

    #[inline(always)]
    fn to_words(self, x: f32) -> Wrapping<u32> {
        #[expect(clippy::cast_possible_truncation, reason = "within the documented range")]
        let towards_zero = x as i32;
        Wrapping(towards_zero.cast_unsigned())
    }

    #[inline(always)]
    fn to_numbers(self, x: Wrapping<u32>) -> f32 {
        #[expect(clippy::cast_precision_loss, reason = "rounding to nearest is what is documented")]
        let number = x.0.cast_signed() as f32;
        number
    }

    #[inline(always)]
    fn shl(self, x: Wrapping<u32>, bits: u32) -> Wrapping<u32> {
        Wrapping(x.0.wrapping_shl(bits))
    }

    #[inline(always)]
    fn shr(self, x: Wrapping<u32>, bits: u32) -> Wrapping<u32> {
        Wrapping(x.0.wrapping_shr(bits))
    }

    #[inline(always)]
    fn shr_signed(self, x: Wrapping<u32>, bits: u32) -> Wrapping<u32> {
        Wrapping(x.0.cast_signed().wrapping_shr(bits).cast_unsigned())
    }

    #[inline(always)]
    fn min_words(self, a: Wrapping<u32>, b: Wrapping<u32>) -> Wrapping<u32> {
        a.min(b)
    }

    #[inline(always)]
    fn less(self, a: f32, b: f32) -> bool {
        a < b
    }

    #[inline(always)]
    fn select(self, mask: bool, a: f32, b: f32) -> f32 {
        if mask { a } else { b }
    }

    #[inline(always)]
    fn select_words(self, mask: bool, a: Wrapping<u32>, b: Wrapping<u32>) -> Wrapping<u32> {
        if mask { a } else { b }
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> bool {
        bits & 1 != 0
    }

    #[inline(always)]
    fn bits(self, mask: bool) -> u32 {
        u32::from(mask)
    }

    #[inline(always)]
    fn int_ramp(self, value: i32, _: i32) -> i32 {
        value
    }

    #[inline(always)]
    fn int(self, x: i32) -> i32 {
        x
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest is what is documented")]
    fn int_to_f32(self, x: i32) -> f32 {
        x as f32
    }

    #[inline(always)]
    fn not_negative(self, x: i32) -> bool {
        x >= 0
    }

    #[inline(always)]
    fn long_ramp(self, value: i64, _: i64) -> i64 {
        value
    }

    #[inline(always)]
    fn long_add(self, x: i64, step: i64) -> i64 {
        x + step
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest is what is documented")]
    fn long_to_f32(self, x: i64) -> f32 {
        x as f32
    }
}
