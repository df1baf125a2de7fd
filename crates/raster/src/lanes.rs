//! How many samples are worked on at a time: one, or the four that a vector register of most machines holds.
//!
//! Every lane does the same IEEE operations in the same order as one lane alone, so the width never changes a bit.

use crate::edge::EdgeInt;
use alberti_math::glam::Vec4;
use core::ops::{Add, Div, Mul};

/// A number of samples side by side along a row.
pub trait Lanes: Copy + Add<Output = Self> + Mul<Output = Self> + Div<Output = Self> {
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
    fn edge<I: EdgeInt>(value: I::Stepped, step: I::Stepped) -> Self::Edge<I>;
    /// Goes on by `steps`, which is `COUNT` samples' worth.
    fn advance<I: EdgeInt>(edge: Self::Edge<I>, steps: I::Stepped) -> Self::Edge<I>;
    /// Rounds to `f32`.
    fn weight<I: EdgeInt>(edge: Self::Edge<I>) -> Self;
}

impl Lanes for f32 {
    const COUNT: usize = 1;
    type Edge<I: EdgeInt> = I::Stepped;

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
    fn edge<I: EdgeInt>(value: I::Stepped, _: I::Stepped) -> I::Stepped {
        value
    }

    #[inline(always)]
    fn advance<I: EdgeInt>(edge: I::Stepped, steps: I::Stepped) -> I::Stepped {
        edge + steps
    }

    #[inline(always)]
    fn weight<I: EdgeInt>(edge: I::Stepped) -> f32 {
        I::to_f32(edge)
    }
}

impl Lanes for Vec4 {
    const COUNT: usize = 4;
    type Edge<I: EdgeInt> = [I::Stepped; 4];

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
    fn edge<I: EdgeInt>(value: I::Stepped, step: I::Stepped) -> Self::Edge<I> {
        let next = value + step;
        let twice = step + step;
        [value, next, value + twice, next + twice]
    }

    #[inline(always)]
    fn advance<I: EdgeInt>(edge: Self::Edge<I>, steps: I::Stepped) -> Self::Edge<I> {
        [edge[0] + steps, edge[1] + steps, edge[2] + steps, edge[3] + steps]
    }

    #[inline(always)]
    fn weight<I: EdgeInt>(edge: Self::Edge<I>) -> Self {
        Vec4::new(I::to_f32(edge[0]), I::to_f32(edge[1]), I::to_f32(edge[2]), I::to_f32(edge[3]))
    }
}
