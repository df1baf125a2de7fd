//! Eight samples at a time, in the vector registers that the machine has: one of 256 bits, or pairs of 128.

use super::one::power_of_two;
use super::{Floating, Lanes, half_log2, jacobi};
use core::fmt::{Debug, Formatter, Result};
use fearless_simd::{
    Bytes, Select, Simd, SimdBase, SimdFloat, SimdInt, SimdInto, SimdMask, f32x8, f64x4, i32x8, mask32x8,
    u32x8,
};

/// Eight samples at a time, on a machine with the instructions `S`.
#[derive(Clone, Copy)]
pub struct Eight<S: Simd>(
    /// The proof that the machine has them, from `fearless_simd`, see [`Machine`](super::Machine).
    pub S,
);

impl<S: Simd> Debug for Eight<S> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "Eight({:?})", self.0)
    }
}

impl<S: Simd> Eight<S> {
    /// 0, 1, 2, 3 in `f64`.
    #[inline(always)]
    fn four(self) -> f64x4<S> {
        [0.0, 1.0, 2.0, 3.0].simd_into(self.0)
    }

    /// The nearest integers from 0 to `greatest`.
    #[inline(always)]
    fn nearest(self, x: f32x8<S>, greatest: f32) -> u32x8<S> {
        let rounded = self.max(x + self.splat(0.5), self.splat(0.0));
        self.min(rounded, self.splat(greatest)).to_int::<i32x8<S>>().bitcast()
    }
}

impl<S: Simd> Lanes for Eight<S> {
    const COUNT: usize = 8;
    const FIXED: bool = false;
    type Number = f32x8<S>;
    type Depth = f32x8<S>;
    type U32 = u32x8<S>;
    type Int = i32x8<S>;
    /// In `f64`, which holds these integers exactly and rounds to `f32` as an integer does.
    type Long = [f64x4<S>; 2];
    type Mask = mask32x8<S>;
    type Each<T: Copy> = [T; 8];

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        self.0.vectorize(f)
    }

    #[inline(always)]
    fn groups<T: Copy>(slice: &mut [T]) -> (&mut [[T; 8]], &mut [T]) {
        slice.as_chunks_mut()
    }

    #[inline(always)]
    fn each<T: Copy>(self, mut f: impl FnMut(usize) -> T) -> [T; 8] {
        [f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)]
    }

    #[inline(always)]
    fn splat(self, x: f32) -> f32x8<S> {
        f32x8::splat(self.0, x)
    }

    #[inline(always)]
    fn word(self, x: u32) -> u32x8<S> {
        u32x8::splat(self.0, x)
    }

    #[inline(always)]
    fn ramp(self) -> f32x8<S> {
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0].simd_into(self.0)
    }

    #[inline(always)]
    fn load(self, values: &[f32; 8]) -> f32x8<S> {
        (*values).simd_into(self.0)
    }

    #[inline(always)]
    fn store(self, values: f32x8<S>) -> [f32; 8] {
        values.into()
    }

    // As words, because compilers make a masked store of a selection of numbers, which is slow on some machines, and
    // from which no later load is served before it has reached memory.
    #[inline(always)]
    fn copy_where(self, mask: mask32x8<S>, values: &[f32; 8], to: &mut [f32; 8]) {
        let (new, kept): (u32x8<S>, u32x8<S>) = (self.load(values).bitcast(), self.load(to).bitcast());
        *to = self.store(mask.select(new, kept).bitcast());
    }

    #[inline(always)]
    fn less_in_memory(self, a: &[f32; 8], b: &[f32; 8]) -> mask32x8<S> {
        self.load(a).simd_lt(self.load(b))
    }

    #[inline(always)]
    fn each_depth<T: Copy>(self, depth: f32x8<S>, number: impl Fn(f32) -> T, _: impl Fn(u32) -> T) -> [T; 8] {
        let d = self.store(depth);
        [
            number(d[0]),
            number(d[1]),
            number(d[2]),
            number(d[3]),
            number(d[4]),
            number(d[5]),
            number(d[6]),
            number(d[7]),
        ]
    }

    #[inline(always)]
    fn load_words(self, values: &[u32; 8]) -> u32x8<S> {
        (*values).simd_into(self.0)
    }

    #[inline(always)]
    fn store_words(self, values: u32x8<S>) -> [u32; 8] {
        values.into()
    }

    // Only x86's instructions choose the second of two equal ones; what others do with zeros of both signs is theirs.
    #[inline(always)]
    fn min(self, a: f32x8<S>, b: f32x8<S>) -> f32x8<S> {
        if cfg!(target_arch = "x86_64") { a.min(b) } else { a.simd_lt(b).select(a, b) }
    }

    #[inline(always)]
    fn max(self, a: f32x8<S>, b: f32x8<S>) -> f32x8<S> {
        if cfg!(target_arch = "x86_64") { a.max(b) } else { a.simd_gt(b).select(a, b) }
    }

    #[inline(always)]
    fn sqrt(self, x: f32x8<S>) -> f32x8<S> {
        x.sqrt()
    }

    #[inline(always)]
    fn log2_length(self, x: f32x8<S>, y: f32x8<S>, scale: [u32; 2]) -> f32x8<S> {
        #[expect(clippy::cast_precision_loss, reason = "up to 2^15")]
        let [a, b] = scale.map(|scale| self.splat(scale as f32));
        let (x, y) = (x * a, y * b);
        let bits = (x * x + y * y).bitcast::<u32x8<S>>();
        let mantissa = (bits & self.word(0x007f_ffff) | self.word(0x3f80_0000)).bitcast();
        half_log2(self, self.to_numbers(bits >> 23), mantissa)
    }

    #[inline(always)]
    fn jacobi_rotation(self, x: [f32x8<S>; 2], y: [f32x8<S>; 2], scale: [u32; 2]) -> [f32x8<S>; 2] {
        jacobi::floating(self, x, y, scale)
    }

    #[inline(always)]
    fn wrap(self, x: f32x8<S>, period: u32) -> f32x8<S> {
        let periods = x * self.splat(1.0 / power_of_two(period));
        (periods - periods.trunc()) * self.splat(power_of_two(period))
    }

    #[inline(always)]
    fn floor_scaled(self, x: f32x8<S>, bits: u32) -> u32x8<S> {
        (x * self.splat(power_of_two(bits))).floor().to_int::<i32x8<S>>().bitcast()
    }

    #[inline(always)]
    fn round_scaled(self, x: f32x8<S>, bits: u32) -> u32x8<S> {
        // floor(x + 1/2), without a sum that would have to be rounded.
        let x = x * self.splat(power_of_two(bits));
        let below = x.floor();
        // The greatest number below one half; NaN is not above it.
        let up = self.splat(0.5f32.next_down()).simd_lt(x - below);
        let below: u32x8<S> = below.to_int::<i32x8<S>>().bitcast();
        up.select(below + self.word(1), below)
    }

    #[inline(always)]
    fn nearest_byte(self, x: f32x8<S>) -> u32x8<S> {
        self.nearest(x, 255.0)
    }

    #[inline(always)]
    fn of_unit(self, x: f32x8<S>, greatest: u16) -> u32x8<S> {
        let greatest = f32::from(greatest);
        self.nearest(x * self.splat(greatest), greatest)
    }

    #[inline(always)]
    fn to_numbers(self, x: u32x8<S>) -> f32x8<S> {
        self.int_to_number(x.bitcast())
    }

    #[inline(always)]
    fn shl(self, x: u32x8<S>, bits: u32) -> u32x8<S> {
        x << bits
    }

    #[inline(always)]
    fn shr(self, x: u32x8<S>, bits: u32) -> u32x8<S> {
        x >> bits
    }

    #[inline(always)]
    fn shr_signed(self, x: u32x8<S>, bits: u32) -> u32x8<S> {
        (x.bitcast::<i32x8<S>>() >> bits).bitcast()
    }

    #[inline(always)]
    fn min_words(self, a: u32x8<S>, b: u32x8<S>) -> u32x8<S> {
        a.min(b)
    }

    #[inline(always)]
    fn less(self, a: f32x8<S>, b: f32x8<S>) -> mask32x8<S> {
        a.simd_lt(b)
    }

    #[inline(always)]
    fn less_words(self, a: u32x8<S>, b: u32x8<S>) -> mask32x8<S> {
        a.simd_lt(b)
    }

    #[inline(always)]
    fn select(self, mask: mask32x8<S>, a: f32x8<S>, b: f32x8<S>) -> f32x8<S> {
        mask.select(a, b)
    }

    #[inline(always)]
    fn select_words(self, mask: mask32x8<S>, a: u32x8<S>, b: u32x8<S>) -> u32x8<S> {
        mask.select(a, b)
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> mask32x8<S> {
        mask32x8::from_bitmask(self.0, u64::from(bits))
    }

    #[inline(always)]
    fn bits(self, mask: mask32x8<S>) -> u32 {
        #[expect(clippy::cast_possible_truncation, reason = "eight bits")]
        let bits = mask.to_bitmask() as u32;
        bits
    }

    #[inline(always)]
    fn int_ramp(self, value: i32, step: i32) -> i32x8<S> {
        let steps: i32x8<S> = [0, 1, 2, 3, 4, 5, 6, 7].simd_into(self.0);
        self.int(value) + steps * self.int(step)
    }

    #[inline(always)]
    fn int(self, x: i32) -> i32x8<S> {
        i32x8::splat(self.0, x)
    }

    #[inline(always)]
    fn int_to_number(self, x: i32x8<S>) -> f32x8<S> {
        x.to_float::<f32x8<S>>()
    }

    #[inline(always)]
    fn not_negative(self, x: i32x8<S>) -> mask32x8<S> {
        x.simd_gt(self.int(-1))
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    fn long_ramp(self, value: i64, step: i64) -> [f64x4<S>; 2] {
        let step = f64x4::splat(self.0, step as f64);
        let low = f64x4::splat(self.0, value as f64) + step * self.four();
        [low, low + step * f64x4::splat(self.0, 4.0)]
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    fn long_add(self, x: [f64x4<S>; 2], step: i64) -> [f64x4<S>; 2] {
        let step = f64x4::splat(self.0, step as f64);
        [x[0] + step, x[1] + step]
    }

    #[inline(always)]
    fn long_to_number(self, x: [f64x4<S>; 2]) -> f32x8<S> {
        self.0.narrow_f64x4(x[0], x[1])
    }
}

impl<S: Simd> Floating for Eight<S> {}
