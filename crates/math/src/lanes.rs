//! The number of samples at a time, and the kind of numbers: `f32` in [`One`], fixed point in [`OneFixed`]. Behind the
//! feature `simd` there are the vector registers of `Four`, `Eight` and `Sixteen`.
//!
//! A kernel is written once, over a value of a [`Lanes`] type. Every lane of `f32` does the same IEEE operations in the
//! same order as one lane alone, so the width never changes a bit.

mod jacobi;
mod machine;
mod one;
mod one_fixed;
#[cfg(feature = "simd")]
mod several;

pub use machine::Machine;
pub use one::One;
pub use one_fixed::OneFixed;
#[cfg(feature = "simd")]
pub use several::{Eight, Four, Sixteen};

use crate::map2;
use core::fmt::Debug;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// A number of samples side by side, and the arithmetic on them.
///
/// The value itself holds nothing; it is the proof that the machine has the instructions. Code over it is inlined into
/// the function that [`vectorize`](Self::vectorize) calls, which is compiled for those.
pub trait Lanes: Copy + Debug + Send + Sync {
    /// The number of samples: a power of two, at most 16.
    const COUNT: usize;
    /// The same as a number of columns.
    #[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "at most 16")]
    const STEP: i32 = Self::COUNT as i32;
    /// Whether numbers are in fixed point.
    const FIXED: bool;
    /// A number for each: `f32`, or [`Q16`](crate::Q16).
    type Number: Copy
        + Add<Output = Self::Number>
        + Sub<Output = Self::Number>
        + Mul<Output = Self::Number>
        + Div<Output = Self::Number>
        + Neg<Output = Self::Number>;
    /// A screen depth for each.
    type Depth: Copy;
    /// A word of 32 bits for each; arithmetic is modulo 2^32.
    type U32: Copy
        + Add<Output = Self::U32>
        + Sub<Output = Self::U32>
        + Mul<Output = Self::U32>
        + BitAnd<Output = Self::U32>
        + BitOr<Output = Self::U32>
        + BitXor<Output = Self::U32>;
    /// An integer from -2^31 to 2^31 - 1 for each.
    type Int: Copy + Add<Output = Self::Int> + BitOr<Output = Self::Int>;
    /// An integer from -2^53 to 2^53 for each.
    type Long: Copy;
    /// A truth value for each.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;
    /// Any value for each, in memory.
    type Each<T: Copy>: Copy + AsRef<[T]> + AsMut<[T]>;

    /// Runs `f`, into which the code over these lanes is inlined.
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R;
    /// Runs `f`, which is a function of its own where code over these lanes need not be inlined. That is in
    /// WebAssembly, where all of a program has vectors: it has a texture's samples once, not for each place that takes
    /// them.
    #[inline(always)]
    fn apart<R>(self, f: impl FnOnce() -> R) -> R {
        f()
    }

    /// A slice as whole groups of lanes, and the rest.
    fn groups<T: Copy>(slice: &mut [T]) -> (&mut [Self::Each<T>], &mut [T]);
    /// A value for each, by lane number.
    fn each<T: Copy>(self, f: impl FnMut(usize) -> T) -> Self::Each<T>;

    /// The same number for each.
    fn splat(self, x: f32) -> Self::Number;
    /// The same word for each.
    fn word(self, x: u32) -> Self::U32;
    /// 0, 1, 2 and so on.
    fn ramp(self) -> Self::Number;
    /// Numbers from memory.
    fn load(self, values: &Self::Each<f32>) -> Self::Number;
    /// Numbers to memory.
    fn store(self, values: Self::Number) -> Self::Each<f32>;
    /// Copies values in memory, where the mask is set.
    fn copy_where(self, mask: Self::Mask, values: &Self::Each<f32>, to: &mut Self::Each<f32>);
    /// Whether a < b in memory; not so where one is NaN.
    fn less_in_memory(self, a: &Self::Each<f32>, b: &Self::Each<f32>) -> Self::Mask;
    /// The result of `number` for each depth where depths are numbers in [0, 1], or of `raw` where they are words.
    fn each_depth<T: Copy>(
        self,
        depth: Self::Depth,
        number: impl Fn(f32) -> T,
        raw: impl Fn(u32) -> T,
    ) -> Self::Each<T>;
    /// The words that `word` finds for these.
    fn gather(self, indices: Self::U32, word: impl FnMut(u32) -> u32) -> Self::U32;
    /// The two words that `words` finds for each of these.
    fn gather_pairs(self, indices: Self::U32, words: impl FnMut(u32) -> [u32; 2]) -> [Self::U32; 2];
    /// Words from memory.
    fn load_words(self, values: &Self::Each<u32>) -> Self::U32;
    /// Words to memory.
    fn store_words(self, values: Self::U32) -> Self::Each<u32>;

    /// The lesser of two finite numbers; of equal ones the second.
    fn min(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// The greater of two finite numbers; of equal ones the second.
    fn max(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// a + b; in fixed point the nearest in the range, where `+` wraps.
    #[inline(always)]
    fn saturating_add(self, a: Self::Number, b: Self::Number) -> Self::Number {
        a + b
    }
    /// a - b; in fixed point the nearest in the range, where `-` wraps.
    #[inline(always)]
    fn saturating_sub(self, a: Self::Number, b: Self::Number) -> Self::Number {
        a - b
    }
    /// a b; in fixed point the nearest in the range, where `*` wraps.
    #[inline(always)]
    fn saturating_mul(self, a: Self::Number, b: Self::Number) -> Self::Number {
        a * b
    }
    /// The square root, correctly rounded.
    fn sqrt(self, x: Self::Number) -> Self::Number;
    /// log2 of the length of the vector (x·`scale`\[0\], y·`scale`\[1\]), for scales up to 2^15: of derivatives of
    /// texture coordinates and the sides of a texture, the level of detail.
    ///
    /// # Precision
    /// Within 2^-11 for lengths from 2^-63 to 2^63, in fixed point 1.1·2^-11 from 2^-16 to 2^15, and at powers of two
    /// along an axis exact. Shorter lengths give at most the least of these, but never less than -63.5 (-16). Longer
    /// ones and NaN give at least the greatest, in fixed point less 2^-11.
    ///
    /// # Cost
    /// Nine multiplications, six additions, a minimum, a conversion and three operations on bits; no root, no table. In
    /// fixed point six products of 32 bits.
    fn log2_length(self, x: Self::Number, y: Self::Number, scale: [u32; 2]) -> Self::Number;
    /// The greater of the [`log2_length`](Self::log2_length)s of two vectors, to the bit; of NaN at least the greatest.
    ///
    /// # Cost
    /// One logarithm, of the greater square, five multiplications and five additions; in fixed point two logarithms.
    #[inline(always)]
    fn log2_longer(self, [a, b]: [[Self::Number; 2]; 2], scale: [u32; 2]) -> Self::Number {
        self.max(self.log2_length(a[0], a[1], scale), self.log2_length(b[0], b[1], scale))
    }
    /// Cosine and sine of the Jacobi rotation of two plane vectors `x` and `y` whose components are multiplied by
    /// `scale`, up to 2^15, before: it makes them orthogonal.
    ///
    /// ```text
    /// cos x + sin y  is at right angles to  cos y - sin x:      tan 2θ = 2 x·y / (|x|² - |y|²),  -45° <= θ <= 45°
    /// ```
    ///
    /// So these are the semi-axes of the ellipse into which (x y) turns the unit circle (one-sided Jacobi, Hestenes
    /// 1958). The rotation is none, exactly, where the vectors are at right angles, or where one is not finite or
    /// longer than `f32` can tell.
    ///
    /// # Precision
    /// With the longest component of the scaled vectors from 2^-63 to 2^63, cos² + sin² is 1 within 6ε (ε = 2^-24).
    /// With A and B the semi-axes, θ is then off by so little, Δθ, that |sin 2Δθ|·(A² - B²) <= 8ε·2A². In fixed point
    /// 2^-15 takes the place of 6ε and 8ε both, over the whole range.
    ///
    /// # Cost
    /// Two roots, three divisions, 16 multiplications. In fixed point two roots and three divisions of 64 bits.
    fn jacobi_rotation(
        self,
        x: [Self::Number; 2],
        y: [Self::Number; 2],
        scale: [u32; 2],
    ) -> [Self::Number; 2];
    /// `x` less a multiple of 2^`period`: a number above -2^`period` and below 2^`period`. Exact; infinities and NaN
    /// give NaN, and where there is no NaN, any such number.
    fn wrap(self, x: Self::Number, period: u32) -> Self::Number;
    /// x·2^`bits` rounded down, in two's complement, for |x·2^`bits`| < 2^31 and `bits` up to 30. NaN gives a multiple
    /// of 2^31; numbers beyond give any word.
    fn floor_scaled(self, x: Self::Number, bits: u32) -> Self::U32;
    /// The same for `bits` and `more` together, where x is from -1 below 2 and `bits` are up to 14. On small cores it
    /// does without a case of its own for many bits.
    #[inline(always)]
    fn floor_scaled_finely(self, x: Self::Number, bits: u32, more: u32) -> Self::U32 {
        self.floor_scaled(x, bits + more)
    }
    /// The same to the nearest, halves up, for |x·2^`bits`| < 2^30; NaN gives a multiple of 2^30.
    fn round_scaled(self, x: Self::Number, bits: u32) -> Self::U32;
    /// A word whose lowest `bits`, up to 15, are those of x·2^`bits` rounded down, for every number. They are 0 for
    /// numbers that are not finite.
    #[inline(always)]
    fn floor_fraction_scaled(self, x: Self::Number, bits: u32) -> Self::U32 {
        self.floor_scaled(self.wrap(x, 0), bits)
    }
    /// The nearest word from 0 to 255, of halves the upper; 0 for NaN.
    fn nearest_byte(self, x: Self::Number) -> Self::U32;
    /// A word within 1/2 + `greatest`·2^-24 of `greatest` times x, from 0 to `greatest`, which is at most 2^15 - 1.
    /// The product is rounded first, so that next to a half it may be the other of the two. 0 for NaN.
    fn of_unit(self, x: Self::Number, greatest: u16) -> Self::U32;
    /// Words from 0 to 255 as numbers.
    fn to_numbers(self, x: Self::U32) -> Self::Number;
    /// Bits moved up.
    fn shl(self, x: Self::U32, bits: u32) -> Self::U32;
    /// Bits moved down.
    fn shr(self, x: Self::U32, bits: u32) -> Self::U32;
    /// Bits moved down, the highest staying as it is.
    fn shr_signed(self, x: Self::U32, bits: u32) -> Self::U32;
    /// `(256 - t)·low + t·high` in both halves of each word, which are 0 to 255 before, with t from 0 to 256.
    #[inline(always)]
    fn mix_halves(self, low: Self::U32, high: Self::U32, t: Self::U32) -> Self::U32 {
        // A half of the difference may be negative and borrow from the next. But those of the sum are 0 to 255 * 256,
        // so as a number modulo 2^32 the sum is the two side by side.
        self.shl(low, 8) + (high - low) * t
    }
    /// The lesser of two words.
    fn min_words(self, a: Self::U32, b: Self::U32) -> Self::U32;

    /// Whether a < b; not so where one is NaN.
    fn less(self, a: Self::Number, b: Self::Number) -> Self::Mask;
    /// Whether a = b.
    fn equal_words(self, a: Self::U32, b: Self::U32) -> Self::Mask;
    /// Whether a < b.
    fn less_words(self, a: Self::U32, b: Self::U32) -> Self::Mask;
    /// `a` where the mask is set, elsewhere `b`.
    fn select(self, mask: Self::Mask, a: Self::Number, b: Self::Number) -> Self::Number;
    /// `a` where the mask is set, elsewhere `b`.
    fn select_words(self, mask: Self::Mask, a: Self::U32, b: Self::U32) -> Self::U32;
    /// The mask with these bits, lane 0 the lowest.
    fn mask(self, bits: u32) -> Self::Mask;
    /// The bits of a mask.
    fn bits(self, mask: Self::Mask) -> u32;

    /// `value`, `value + step`, `value + 2 step` and so on.
    fn int_ramp(self, value: i32, step: i32) -> Self::Int;
    /// The same integer for each.
    fn int(self, x: i32) -> Self::Int;
    /// To the nearest number.
    fn int_to_number(self, x: Self::Int) -> Self::Number;
    /// Whether x >= 0.
    fn not_negative(self, x: Self::Int) -> Self::Mask;
    /// `value`, `value + step`, `value + 2 step` and so on.
    fn long_ramp(self, value: i64, step: i64) -> Self::Long;
    /// `x + step` for each.
    fn long_add(self, x: Self::Long, step: i64) -> Self::Long;
    /// To the nearest number.
    fn long_to_number(self, x: Self::Long) -> Self::Number;
    /// 0, `step`, `2 step` and so on, below 2^(24 + `bits`), each as a multiple of 2^`bits` and a rest of at most half
    /// of that: numbers without rounding.
    fn long_parts(self, step: i64, bits: u32) -> [Self::Number; 2];
}

/// log2(1 + m) is m + m(1 - m)(`LOG2`\[0\] + `LOG2`\[1\] m) within 8.8e-4, exactly so for 0 and 1: the least error that
/// two coefficients reach.
const LOG2: [f32; 2] = [0.422_865_4, -0.159_220_2];

/// The square of the length of a vector, after scaling.
#[inline(always)]
fn scaled_square<L: Lanes>(lanes: L, [x, y]: [L::Number; 2], scale: [u32; 2]) -> L::Number {
    #[expect(clippy::cast_precision_loss, reason = "up to 2^15")]
    let [a, b] = map2(scale, |scale| lanes.splat(scale as f32));
    let (x, y) = (x * a, y * b);
    x * x + y * y
}

/// The greater of two such squares. The difference, 0 otherwise, keeps NaN and infinity, of which a maximum might take
/// the other.
#[inline(always)]
fn longer_square<L: Lanes>(lanes: L, [a, b]: [[L::Number; 2]; 2], scale: [u32; 2]) -> L::Number {
    let [a, b] = [scaled_square(lanes, a, scale), scaled_square(lanes, b, scale)];
    #[expect(clippy::eq_op, reason = "of what is not finite, NaN")]
    let zero = a - a;
    lanes.max(a, b) + zero
}

/// Half of log2 of a square in `f32`, by its exponent as it is stored and its mantissa from 1 to 2. It is monotone, and
/// at most 64, also if the square is NaN of either sign.
#[inline(always)]
fn half_log2<L: Lanes>(lanes: L, exponent: L::Number, mantissa: L::Number) -> L::Number {
    let one = lanes.splat(1.0);
    let m = mantissa - one;
    let correction = m * (one - m) * (lanes.splat(LOG2[0]) + lanes.splat(LOG2[1]) * m);
    let log2 = exponent - lanes.splat(127.0) + (m + correction);
    lanes.min(lanes.splat(0.5) * log2, lanes.splat(64.0))
}

/// Lanes of `f32`, in which a depth is a number as well.
pub trait Floating: Lanes<Depth = <Self as Lanes>::Number> {
    /// As many lanes as are best for long rows of samples.
    type Wide: Floating;

    /// These lanes on the same machine.
    fn wide(self) -> Self::Wide;
}

#[cfg(test)]
mod tests;
