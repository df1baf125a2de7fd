//! How many samples are worked on at a time: [`One`], or, behind the feature `simd`, [`Eight`] in vector registers.
//!
//! A kernel is written once, over a value of a [`Lanes`] type. Every lane does the same IEEE operations in the same
//! order as one lane alone, so the width never changes a bit.

#[cfg(feature = "simd")]
mod eight;
mod machine;
mod one;

#[cfg(feature = "simd")]
pub use eight::Eight;
pub use machine::Machine;
pub use one::One;

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
    /// A number for each.
    type F32: Copy
        + Add<Output = Self::F32>
        + Sub<Output = Self::F32>
        + Mul<Output = Self::F32>
        + Div<Output = Self::F32>;
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

    /// The first lanes of a slice, and what follows, if it has as many.
    fn split<T: Copy>(slice: &mut [T]) -> Option<(&mut Self::Each<T>, &mut [T])>;
    /// A value for each, by lane number.
    fn each<T: Copy>(self, f: impl FnMut(usize) -> T) -> Self::Each<T>;

    /// The same number for each.
    fn splat(self, x: f32) -> Self::F32;
    /// The same word for each.
    fn word(self, x: u32) -> Self::U32;
    /// 0, 1, 2 and so on.
    fn ramp(self) -> Self::F32;
    /// Numbers from memory.
    fn load(self, values: &Self::Each<f32>) -> Self::F32;
    /// Numbers to memory.
    fn store(self, values: Self::F32) -> Self::Each<f32>;
    /// Numbers to memory, where the mask is set.
    fn store_where(self, mask: Self::Mask, values: Self::F32, to: &mut Self::Each<f32>);
    /// Words from memory.
    fn load_words(self, values: &Self::Each<u32>) -> Self::U32;
    /// Words to memory.
    fn store_words(self, values: Self::U32) -> Self::Each<u32>;

    /// The lesser of two finite numbers; of equal ones the second.
    fn min(self, a: Self::F32, b: Self::F32) -> Self::F32;
    /// The greater of two finite numbers; of equal ones the second.
    fn max(self, a: Self::F32, b: Self::F32) -> Self::F32;
    /// The square root, correctly rounded.
    fn sqrt(self, x: Self::F32) -> Self::F32;
    /// Rounded towards zero, for every number.
    fn trunc(self, x: Self::F32) -> Self::F32;
    /// Rounded down to an integer in two's complement, for |x| < 2^31. NaN gives a multiple of 2^31; what is beyond gives
    /// any word.
    fn floor(self, x: Self::F32) -> Self::U32;
    /// Rounded towards zero, for 0 <= x < 2^31. Beyond, any word.
    fn to_words(self, x: Self::F32) -> Self::U32;
    /// Words in two's complement as numbers, to the nearest.
    fn to_numbers(self, x: Self::U32) -> Self::F32;
    /// Bits moved up.
    fn shl(self, x: Self::U32, bits: u32) -> Self::U32;
    /// Bits moved down.
    fn shr(self, x: Self::U32, bits: u32) -> Self::U32;
    /// Bits moved down, the highest staying what it is.
    fn shr_signed(self, x: Self::U32, bits: u32) -> Self::U32;
    /// The lesser of two words.
    fn min_words(self, a: Self::U32, b: Self::U32) -> Self::U32;

    /// Whether a < b; not so where one is NaN.
    fn less(self, a: Self::F32, b: Self::F32) -> Self::Mask;
    /// `a` where the mask is set, elsewhere `b`.
    fn select(self, mask: Self::Mask, a: Self::F32, b: Self::F32) -> Self::F32;
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
    /// To the nearest `f32`.
    fn int_to_f32(self, x: Self::Int) -> Self::F32;
    /// Whether x >= 0.
    fn not_negative(self, x: Self::Int) -> Self::Mask;
    /// `value`, `value + step`, `value + 2 step` and so on.
    fn long_ramp(self, value: i64, step: i64) -> Self::Long;
    /// `x + step` for each.
    fn long_add(self, x: Self::Long, step: i64) -> Self::Long;
    /// To the nearest `f32`.
    fn long_to_f32(self, x: Self::Long) -> Self::F32;
}
