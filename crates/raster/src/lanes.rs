//! How many samples are worked on at a time: one, or the four that a vector register of most machines holds.
//!
//! Every lane does the same IEEE operations in the same order as one lane alone, so the width never changes a bit.

use crate::edge::EdgeInt;
use alberti_math::glam::Vec4;
use core::ops::{Add, Div, Mul};

/// As many as suit the machine that this is compiled for.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))]
pub(crate) type Native = Vec4;
/// As many as suit the machine that this is compiled for.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")))]
pub(crate) type Native = f32;

/// A number of samples side by side along a row: `f32` is one, `Vec4` four.
pub trait Lanes: Sealed + Copy + Add<Output = Self> + Mul<Output = Self> + Div<Output = Self> {
    /// How many.
    const COUNT: usize;
    /// An edge function at each sample.
    type Edge<I: EdgeInt>: Copy;

    /// The same number for each.
    fn splat(x: f32) -> Self;
    /// The number of sample `k` < `COUNT`.
    fn lane(self, k: usize) -> f32;
    /// The lesser of two, lane by lane; of equal ones the second.
    fn min(self, other: Self) -> Self;
    /// The greater of two, lane by lane; of equal ones the second.
    fn max(self, other: Self) -> Self;
    /// The edge function at the samples from the first, where it is `value`, in steps of `step`.
    fn edge<I: EdgeInt>(value: I, step: I) -> Self::Edge<I>;
    /// Goes on by `COUNT` samples in steps of `step`.
    fn advance<I: EdgeInt>(edge: Self::Edge<I>, step: I) -> Self::Edge<I>;
    /// Rounds to `f32`.
    fn weight<I: EdgeInt>(edge: Self::Edge<I>) -> Self;
}

/// Keeps other widths out, for which the kernel has no code.
pub trait Sealed {}

impl Sealed for f32 {}
impl Sealed for Vec4 {}

impl Lanes for f32 {
    const COUNT: usize = 1;
    type Edge<I: EdgeInt> = I;

    #[inline(always)]
    fn splat(x: f32) -> Self {
        x
    }

    #[inline(always)]
    fn lane(self, _: usize) -> f32 {
        self
    }

    // For finite values these are single machine instructions, which f32::min and max, having to decide about NaN, are
    // not.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn edge<I: EdgeInt>(value: I, _: I) -> I {
        value
    }

    #[inline(always)]
    fn advance<I: EdgeInt>(edge: I, step: I) -> I {
        edge + step
    }

    #[inline(always)]
    fn weight<I: EdgeInt>(edge: I) -> f32 {
        edge.to_f32()
    }
}

impl Lanes for Vec4 {
    const COUNT: usize = 4;
    /// In `f64`, which holds these integers exactly, adds them two at a time, and rounds to `f32` as an integer does.
    type Edge<I: EdgeInt> = [f64; 4];

    #[inline(always)]
    fn splat(x: f32) -> Self {
        Vec4::splat(x)
    }

    #[inline(always)]
    fn lane(self, k: usize) -> f32 {
        match k {
            0 => self.x,
            1 => self.y,
            2 => self.z,
            _ => self.w,
        }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if cfg!(target_arch = "x86_64") {
            Vec4::min(self, other)
        } else {
            Vec4::select(self.cmplt(other), self, other)
        }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if cfg!(target_arch = "x86_64") {
            Vec4::max(self, other)
        } else {
            Vec4::select(self.cmpgt(other), self, other)
        }
    }

    #[inline(always)]
    fn edge<I: EdgeInt>(value: I, step: I) -> [f64; 4] {
        let [value, step] = [value.to_f64(), step.to_f64()];
        let next = value + step;
        let twice = step + step;
        [value, next, value + twice, next + twice]
    }

    #[inline(always)]
    fn advance<I: EdgeInt>(edge: [f64; 4], step: I) -> [f64; 4] {
        let steps = step.to_f64() * 4.0;
        [edge[0] + steps, edge[1] + steps, edge[2] + steps, edge[3] + steps]
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounding to nearest is what is documented")]
    fn weight<I: EdgeInt>(edge: [f64; 4]) -> Self {
        Vec4::new(edge[0] as f32, edge[1] as f32, edge[2] as f32, edge[3] as f32)
    }
}
