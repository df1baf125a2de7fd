//! One sample at a time, in the plain numbers of the machine.

use super::{Floating, Lanes, half_log2, jacobi, longer_square, scaled_square};
use core::num::Wrapping;

/// One sample at a time, in `f32`: the reference that all others of `f32` must equal.
#[derive(Clone, Copy, Debug, Default)]
pub struct One;

/// The items of one lane that do not depend on its numbers.
macro_rules! one_lane {
    () => {
        const COUNT: usize = 1;
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
        fn groups<T: Copy>(slice: &mut [T]) -> (&mut [[T; 1]], &mut [T]) {
            slice.as_chunks_mut()
        }

        #[inline(always)]
        fn each<T: Copy>(self, mut f: impl FnMut(usize) -> T) -> [T; 1] {
            [f(0)]
        }

        #[inline(always)]
        fn word(self, x: u32) -> Wrapping<u32> {
            Wrapping(x)
        }

        #[inline(always)]
        fn copy_where(self, mask: bool, values: &[f32; 1], to: &mut [f32; 1]) {
            if mask {
                *to = *values;
            }
        }

        #[inline(always)]
        fn less_in_memory(self, a: &[f32; 1], b: &[f32; 1]) -> bool {
            a[0] < b[0]
        }

        #[inline(always)]
        fn gather(self, index: Wrapping<u32>, mut word: impl FnMut(u32) -> u32) -> Wrapping<u32> {
            Wrapping(word(index.0))
        }

        #[inline(always)]
        fn gather_pairs(
            self,
            index: Wrapping<u32>,
            mut words: impl FnMut(u32) -> [u32; 2],
        ) -> [Wrapping<u32>; 2] {
            let [low, high] = words(index.0);
            [Wrapping(low), Wrapping(high)]
        }

        #[inline(always)]
        fn load_words(self, values: &[u32; 1]) -> Wrapping<u32> {
            Wrapping(values[0])
        }

        #[inline(always)]
        fn store_words(self, values: Wrapping<u32>) -> [u32; 1] {
            [values.0]
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
        fn equal_words(self, a: Wrapping<u32>, b: Wrapping<u32>) -> bool {
            a == b
        }

        #[inline(always)]
        fn less_words(self, a: Wrapping<u32>, b: Wrapping<u32>) -> bool {
            a < b
        }

        #[inline(always)]
        fn select(self, mask: bool, a: Self::Number, b: Self::Number) -> Self::Number {
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
    };
}
pub(super) use one_lane;

impl Lanes for One {
    const FIXED: bool = false;
    type Number = f32;
    type Depth = f32;
    one_lane!();

    #[inline(always)]
    fn splat(self, x: f32) -> f32 {
        x
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
    fn each_depth<T: Copy>(self, depth: f32, number: impl Fn(f32) -> T, _: impl Fn(u32) -> T) -> [T; 1] {
        [number(depth)]
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
    fn log2_length(self, x: f32, y: f32, scale: [u32; 2]) -> f32 {
        half_log2_of(scaled_square(self, [x, y], scale))
    }

    #[inline(always)]
    fn log2_longer(self, vectors: [[f32; 2]; 2], scale: [u32; 2]) -> f32 {
        half_log2_of(longer_square(self, vectors, scale))
    }

    #[inline(always)]
    fn jacobi_rotation(self, x: [f32; 2], y: [f32; 2], scale: [u32; 2]) -> [f32; 2] {
        jacobi::floating(self, x, y, scale)
    }

    #[inline(always)]
    fn wrap(self, x: f32, period: u32) -> f32 {
        let periods = x / power_of_two(period);
        // From 2^23 on, and for what is no number, there is nothing to round.
        #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "below 2^23")]
        let below = periods as i32 as f32;
        (periods - if periods.abs() < 8_388_608.0 { below } else { periods }) * power_of_two(period)
    }

    #[inline(always)]
    fn floor_scaled(self, x: f32, bits: u32) -> Wrapping<u32> {
        Wrapping(floor(x * power_of_two(bits)))
    }

    #[inline(always)]
    fn round_scaled(self, x: f32, bits: u32) -> Wrapping<u32> {
        // The halves below it: an odd one rounds up.
        let halves = floor(x * power_of_two(bits + 1)).cast_signed();
        Wrapping((halves.wrapping_add(1) >> 1).cast_unsigned())
    }

    #[inline(always)]
    fn nearest_byte(self, x: f32) -> Wrapping<u32> {
        nearest(x, 255.0)
    }

    #[inline(always)]
    fn of_unit(self, x: f32, greatest: u16) -> Wrapping<u32> {
        nearest(x * f32::from(greatest), greatest.into())
    }

    #[inline(always)]
    fn to_numbers(self, x: Wrapping<u32>) -> f32 {
        #[expect(clippy::cast_precision_loss, reason = "from 0 to 255")]
        let number = x.0.cast_signed() as f32;
        number
    }

    #[inline(always)]
    fn less(self, a: f32, b: f32) -> bool {
        a < b
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest is what is documented")]
    fn int_to_number(self, x: i32) -> f32 {
        x as f32
    }

    #[inline(always)]
    fn long_parts(self, _: i64, _: u32) -> [f32; 2] {
        [0.0; 2]
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest is what is documented")]
    fn long_to_number(self, x: i64) -> f32 {
        x as f32
    }
}

impl Floating for One {
    type Wide = Self;

    #[inline(always)]
    fn wide(self) -> Self {
        self
    }
}

/// 2^`exponent`, for exponents below 128.
#[inline(always)]
pub(super) const fn power_of_two(exponent: u32) -> f32 {
    f32::from_bits(127_u32.wrapping_add(exponent) << 23)
}

/// Half of the logarithm of a square.
#[inline(always)]
fn half_log2_of(square: f32) -> f32 {
    let bits = square.to_bits();
    let mantissa = f32::from_bits(bits & 0x007f_ffff | 0x3f80_0000);
    half_log2(One, One.to_numbers(Wrapping(bits >> 23)), mantissa)
}

/// The nearest integer from 0 to `greatest`.
#[inline(always)]
fn nearest(x: f32, greatest: f32) -> Wrapping<u32> {
    let rounded = One.min(One.max(x + 0.5, 0.0), greatest);
    #[expect(clippy::cast_possible_truncation, reason = "from 0 to 65535")]
    let towards_zero = rounded as i32;
    Wrapping(towards_zero.cast_unsigned())
}

/// Rounded down, in two's complement.
#[inline(always)]
fn floor(x: f32) -> u32 {
    #[expect(clippy::cast_possible_truncation, reason = "within the documented range")]
    let towards_zero = x as i32;
    #[expect(clippy::cast_precision_loss, reason = "it came from an f32")]
    let above = towards_zero as f32 > x;
    towards_zero.cast_unsigned().wrapping_sub(u32::from(above))
}
