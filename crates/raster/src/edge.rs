//! Edge functions in integers: which side of an edge a sample lies on, exactly.
//!
//! ```text
//!          A
//!          |\          E_AB(P) = (Bx-Ax)(Py-Ay) - (By-Ay)(Px-Ax)
//!          | \  P
//!          |  \        twice the signed area of A B P, with y down:
//!          +---B       positive when A, B, P run clockwise on the screen
//! ```
//!
//! Everything is in subpixels. A sample on an edge belongs to the triangle if the edge is a top or a left one. It is
//! the same as moving all samples by an infinitesimal (e, e²): every sample of a mesh lies in exactly one triangle.

use alberti_math::lanes::Lanes;
use core::fmt::Debug;
use core::ops::{Add, Mul, Sub};

/// An integer that edge functions are computed in: `i32` or `i64`.
///
/// Overflow is excluded by the bounds, not by the type: see [`FITS_I32`] and the guard band's proof in `alberti_math`.
pub trait EdgeInt:
    Copy + Ord + Debug + From<i32> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// An edge function at several samples.
    type Of<L: Lanes>: Copy;

    /// `value` at the first sample, `step` more at each that follows.
    fn ramp<L: Lanes>(lanes: L, value: Self, step: Self) -> Self::Of<L>;

    /// Each moved on by `step`.
    fn advance<L: Lanes>(lanes: L, at: Self::Of<L>, step: Self) -> Self::Of<L>;

    /// The nearest number of each: for `f32` exact up to 2^24, within ε = 2^-24 relative above.
    fn weights<L: Lanes>(lanes: L, at: Self::Of<L>) -> L::Number;

    /// The same number, where it fits.
    fn to_i32(self) -> i32;

    /// The same number.
    fn to_i64(self) -> i64;

    /// The nearest number.
    fn to_f32(self) -> f32;

    /// Half of it, rounded down.
    fn half(self) -> Self;

    /// The quotient rounded down, and the remainder, which is in [0, `divisor`). The divisor is positive.
    fn divided(self, divisor: Self) -> (Self, Self);

    /// A number that is not negative without its last `bits`, where that fits; they are 0 for what fits `i32`.
    fn without_last(self, bits: u32) -> u32;
}

impl EdgeInt for i32 {
    type Of<L: Lanes> = L::Int;

    #[inline(always)]
    fn ramp<L: Lanes>(lanes: L, value: Self, step: Self) -> L::Int {
        lanes.int_ramp(value, step)
    }

    #[inline(always)]
    fn advance<L: Lanes>(lanes: L, at: L::Int, step: Self) -> L::Int {
        at + lanes.int(step)
    }

    #[inline(always)]
    fn weights<L: Lanes>(lanes: L, at: L::Int) -> L::Number {
        lanes.int_to_number(at)
    }

    #[inline(always)]
    fn to_i32(self) -> i32 {
        self
    }

    #[inline(always)]
    fn to_i64(self) -> i64 {
        self.into()
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
    fn to_f32(self) -> f32 {
        self as f32
    }

    #[inline(always)]
    fn half(self) -> Self {
        self >> 1
    }

    #[inline(always)]
    fn divided(self, divisor: Self) -> (Self, Self) {
        let quotient = self / divisor;
        let remainder = self - quotient * divisor;
        if remainder < 0 { (quotient - 1, remainder + divisor) } else { (quotient, remainder) }
    }

    #[inline(always)]
    fn without_last(self, _: u32) -> u32 {
        self.cast_unsigned()
    }
}

impl EdgeInt for i64 {
    type Of<L: Lanes> = L::Long;

    #[inline(always)]
    fn ramp<L: Lanes>(lanes: L, value: Self, step: Self) -> L::Long {
        lanes.long_ramp(value, step)
    }

    #[inline(always)]
    fn advance<L: Lanes>(lanes: L, at: L::Long, step: Self) -> L::Long {
        lanes.long_add(at, step)
    }

    #[inline(always)]
    fn weights<L: Lanes>(lanes: L, at: L::Long) -> L::Number {
        lanes.long_to_number(at)
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "where it fits")]
    fn to_i32(self) -> i32 {
        self as i32
    }

    #[inline(always)]
    fn to_i64(self) -> i64 {
        self
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
    fn to_f32(self) -> f32 {
        self as f32
    }

    #[inline(always)]
    fn half(self) -> Self {
        self >> 1
    }

    #[inline]
    fn divided(self, divisor: Self) -> (Self, Self) {
        if cfg!(target_pointer_width = "32") {
            return bit_by_bit(self, divisor);
        }
        (self.div_euclid(divisor.max(1)), self.rem_euclid(divisor.max(1)))
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "where it fits")]
    fn without_last(self, bits: u32) -> u32 {
        (self >> bits) as u32
    }
}

/// [`EdgeInt::divided`] on cores without such a division: what comes with compilers is ten times as long. Numbers
/// that fit `i32` are divided as such; only large triangles take all bits, from some 180 pixels on with `Sub8`.
#[inline(never)]
fn bit_by_bit(x: i64, divisor: i64) -> (i64, i64) {
    if let (Ok(x), Ok(divisor)) = (i32::try_from(x), i32::try_from(divisor)) {
        let (quotient, remainder) = x.divided(divisor.max(1));
        return (quotient.into(), remainder.into());
    }
    // The complement of a negative number divides like a positive one, and so do the results.
    let sign = x >> 63;
    let (mut quotient, mut remainder) = (x ^ sign, 0);
    for _ in 0..i64::BITS {
        remainder = remainder << 1 | i64::from(quotient < 0);
        quotient <<= 1;
        if remainder >= divisor {
            remainder -= divisor;
            quotient |= 1;
        }
    }
    (quotient ^ sign, if sign < 0 { divisor - 1 - remainder } else { remainder })
}

/// The largest size of a triangle's box for edges in `i32`: the product of its width plus two pixels and its height
/// plus one, in subpixels.
///
/// The box is the hull of the vertices. Up to this size, everything that is computed from the edges at its samples fits
/// `i32`.
///
/// An edge function is at most the area of a box that holds its three points, and so are its two products. The pixel
/// more on each axis is for the sample after the last. The second pixel of width is for the sum of two remainders below
/// `step_x` that a row makes, so twice `step_x` must fit as well.
pub const FITS_I32: i64 = i32::MAX as i64;

/// The edge function of one directed edge, in `i32` or `i64`, ready to be stepped over samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge<I> {
    /// Its value at the reference sample.
    pub value: I,
    /// The increment for a step of one pixel to the right.
    pub step_x: I,
    /// The increment for a step of one pixel down.
    pub step_y: I,
    /// 0 for a top or left edge, -1 for another: a sample is inside when value + bias >= 0.
    pub bias: I,
}

impl Edge<i32> {
    /// The same edge with its reference sample so many columns to the right and rows down.
    #[inline(always)]
    pub(crate) fn moved(&self, columns: i64, rows: i64) -> Edge<i64> {
        let (step_x, step_y) = (i64::from(self.step_x), i64::from(self.step_y));
        let value = i64::from(self.value) + step_x * columns + step_y * rows;
        Edge { value, step_x, step_y, bias: self.bias.into() }
    }
}

impl<I: EdgeInt> Edge<I> {
    /// The edge from `a` to `b` with its value at `sample`; positions in subpixels, of which a pixel has `one`.
    ///
    /// The three positions must be such that `I` holds what is computed: within the guard band for `i64`, and also
    /// within [`FITS_I32`] for `i32`. Beyond, arithmetic overflows, which panics where overflow is checked.
    #[must_use]
    #[inline]
    pub fn new(a: [i32; 2], b: [i32; 2], sample: [i32; 2], one: i32) -> Self {
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let [px, py] = [sample[0] - a[0], sample[1] - a[1]];
        // 0 or 1 without a branch, which would be a toss of a coin.
        let top_left = i32::from((dy < 0) | ((dy == 0) & (dx > 0)));
        Self {
            value: I::from(dx) * I::from(py) - I::from(dy) * I::from(px),
            step_x: I::from(-dy) * I::from(one),
            step_y: I::from(dx) * I::from(one),
            bias: I::from(top_left - 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn division_bit_by_bit_is_division() {
        let numbers =
            [0, 1, 2, 3, 7, 255, 1 << 20, (1 << 31) - 1, 1 << 31, (1 << 40) + 12_345, (1 << 53) - 1];
        for x in numbers.into_iter().flat_map(|x: i64| [x, -x]) {
            for divisor in numbers.into_iter().filter(|&d| d > 0) {
                let expected = (x.div_euclid(divisor), x.rem_euclid(divisor));
                assert_eq!(bit_by_bit(x, divisor), expected, "{x} / {divisor}");
                assert_eq!(x.divided(divisor), expected);
                if let (Ok(x), Ok(divisor)) = (i32::try_from(x), i32::try_from(divisor)) {
                    assert_eq!(x.divided(divisor), (x.div_euclid(divisor), x.rem_euclid(divisor)));
                }
            }
        }
    }

    #[test]
    fn steps_lead_to_the_values_elsewhere() {
        let (a, b) = ([-37, 1000], [512, -803]);
        let at = |sample| Edge::<i64>::new(a, b, sample, 16);
        let here = at([8, 24]);
        assert_eq!(at([8 + 16, 24]).value, here.value + here.step_x);
        assert_eq!(at([8, 24 + 16]).value, here.value + here.step_y);
        assert_eq!(Edge::<i32>::new(a, b, [8, 24], 16).value, i32::try_from(here.value).expect("small"));
    }

    #[test]
    fn an_edge_and_its_reverse_never_both_own_a_tie() {
        for dx in -3..=3 {
            for dy in -3..=3 {
                if (dx, dy) == (0, 0) {
                    continue;
                }
                let ab = Edge::<i32>::new([0, 0], [dx, dy], [0, 0], 16);
                let ba = Edge::<i32>::new([dx, dy], [0, 0], [0, 0], 16);
                assert_eq!(ab.value, 0);
                assert_eq!(ab.bias + ba.bias, -1);
            }
        }
    }
}
