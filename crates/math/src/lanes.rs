//! How many samples are worked on at a time, and in what numbers: [`One`], or, behind the feature `simd`, [`Eight`] in
//! vector registers, in `f32`; [`OneFixed`] in fixed point.
//!
//! A kernel is written once, over a value of a [`Lanes`] type. Every lane of `f32` does the same IEEE operations in the
//! same order as one lane alone, so the width never changes a bit.

#[cfg(feature = "simd")]
mod eight;
mod machine;
mod one;
mod one_fixed;

#[cfg(feature = "simd")]
pub use eight::Eight;
pub use machine::Machine;
pub use one::One;
pub use one_fixed::OneFixed;

use core::fmt::Debug;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Sub};

/// A number of samples side by side, and the arithmetic on them.
///
/// The value itself holds nothing; it is the proof that the machine has the instructions. Code over it is inlined into
/// the function that [`vectorize`](Self::vectorize) calls, which is compiled for those.
pub trait Lanes: Copy + Debug {
    /// How many: a power of two, at most 8.
    const COUNT: usize;
    /// The same as a number of columns.
    #[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "at most 8")]
    const STEP: i32 = Self::COUNT as i32;
    /// A number for each: `f32`, or [`Q16`](crate::Q16).
    type Number: Copy
        + Add<Output = Self::Number>
        + Sub<Output = Self::Number>
        + Mul<Output = Self::Number>
        + Div<Output = Self::Number>;
    /// A screen depth for each.
    type Depth: Copy;
    /// A word of 32 bits for each; arithmetic is modulo 2^32.
    type U32: Copy
        + Add<Output = Self::U32>
        + Sub<Output = Self::U32>
        + Mul<Output = Self::U32>
        + BitAnd<Output = Self::U32>
        + BitOr<Output = Self::U32>;
    /// An integer from -2^31 to 2^31 - 1 for each.
    type Int: Copy + Add<Output = Self::Int> + BitOr<Output = Self::Int>;
    /// An integer from -2^53 to 2^53 for each.
    type Long: Copy;
    /// A truth value for each.
    type Mask: Copy + BitAnd<Output = Self::Mask>;
    /// Any value for each, in memory.
    type Each<T: Copy>: Copy + AsRef<[T]> + AsMut<[T]>;

    /// Runs `f`, into which the code over these lanes is inlined.
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R;

    /// A slice as whole groups of lanes, and what is left.
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
    /// Copies what is in memory, where the mask is set.
    fn copy_where(self, mask: Self::Mask, values: &Self::Each<f32>, to: &mut Self::Each<f32>);
    /// Whether a < b in memory; not so where one is NaN.
    fn less_in_memory(self, a: &Self::Each<f32>, b: &Self::Each<f32>) -> Self::Mask;
    /// What `number` makes of each depth where these are numbers in [0, 1], or `raw` where they are words.
    fn each_depth<T: Copy>(
        self,
        depth: Self::Depth,
        number: impl Fn(f32) -> T,
        raw: impl Fn(u32) -> T,
    ) -> Self::Each<T>;
    /// Words from memory.
    fn load_words(self, values: &Self::Each<u32>) -> Self::U32;
    /// Words to memory.
    fn store_words(self, values: Self::U32) -> Self::Each<u32>;

    /// The lesser of two finite numbers; of equal ones the second.
    fn min(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// The greater of two finite numbers; of equal ones the second.
    fn max(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// The square root, correctly rounded.
    fn sqrt(self, x: Self::Number) -> Self::Number;
    /// `x` less a multiple of 2^`period`: a number above -2^`period` and below 2^`period`. Exact; what is not finite
    /// gives NaN, and where there is no NaN, any such number.
    fn wrap(self, x: Self::Number, period: u32) -> Self::Number;
    /// x·2^`bits` rounded down, in two's complement, for |x·2^`bits`| < 2^31 and `bits` up to 30. NaN gives a multiple
    /// of 2^31; what is beyond gives any word.
    fn floor_scaled(self, x: Self::Number, bits: u32) -> Self::U32;
    /// The same to the nearest, halves up.
    fn round_scaled(self, x: Self::Number, bits: u32) -> Self::U32;
    /// The nearest word from 0 to 255, of halves the upper; 0 for NaN.
    fn nearest_byte(self, x: Self::Number) -> Self::U32;
    /// The nearest word to `greatest` times x, from 0 to `greatest`, which is at most 2^15 - 1; 0 for NaN.
    fn of_unit(self, x: Self::Number, greatest: u16) -> Self::U32;
    /// Words from 0 to 255 as numbers.
    fn to_numbers(self, x: Self::U32) -> Self::Number;
    /// Bits moved up.
    fn shl(self, x: Self::U32, bits: u32) -> Self::U32;
    /// Bits moved down.
    fn shr(self, x: Self::U32, bits: u32) -> Self::U32;
    /// Bits moved down, the highest staying what it is.
    fn shr_signed(self, x: Self::U32, bits: u32) -> Self::U32;
    /// The lesser of two words.
    fn min_words(self, a: Self::U32, b: Self::U32) -> Self::U32;

    /// Whether a < b; not so where one is NaN.
    fn less(self, a: Self::Number, b: Self::Number) -> Self::Mask;
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
}

/// Lanes of `f32`, in which a depth is a number as well.
pub trait Floating: Lanes<Depth = <Self as Lanes>::Number> {}
