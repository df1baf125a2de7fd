//! How an interpolated value changes from pixel to pixel, in integers: derivatives of U/T, where
//! U = Σ Ei qi ui and T = Σ Ei qi are linear on the screen.
//!
//! Nothing is taken from formulas for slopes: a linear function is known by its values at three places.

use crate::coverage::{Triangle, weights};
use crate::linear::integer;
use num_bigint::BigInt;
use num_traits::{ToPrimitive, Zero};

/// What U/T does at a place, each number correctly rounded but for a few units of 2^-53.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes {
    /// The derivatives by column and by row.
    pub derivative: [f64; 2],
    /// T, in subpixels squared.
    pub t: f64,
}

/// The slopes of the perspective-correct value at `sample`, of a triangle with `bits` subpixel bits.
#[must_use]
pub fn hyperbolic(tri: Triangle, sample: [i64; 2], bits: u32, q: [f32; 3], u: [f32; 3]) -> Slopes {
    at(tri, sample, 1 << bits, q, u)
}

/// The same at the centroid.
#[must_use]
pub fn in_centroid(tri: Triangle, bits: u32, q: [f32; 3], u: [f32; 3]) -> Slopes {
    // Three times as large, so that it is a lattice point.
    let large = tri.map(|p| p.map(|c| 3 * c));
    let sample = [0, 1].map(|k| tri[0][k] + tri[1][k] + tri[2][k]);
    let slopes = at(large, sample, 3 << bits, q, u);
    Slopes { t: slopes.t / 9.0, ..slopes }
}

fn at(tri: Triangle, [x, y]: [i64; 2], one: i64, q: [f32; 3], u: [f32; 3]) -> Slopes {
    let ((q, q_unit), (u, unit)) = (integers(q), integers(u));
    let qu: [BigInt; 3] = std::array::from_fn(|i| &q[i] * &u[i]);
    let sum = |sample, numbers: &[BigInt; 3]| -> BigInt {
        weights(tri, sample).into_iter().zip(numbers).map(|(e, n)| BigInt::from(e) * n).sum()
    };
    let places = [[x, y], [x + one, y], [x, y + one]];
    let [t, t_right, t_below] = places.map(|p| sum(p, &q));
    let [v, v_right, v_below] = places.map(|p| sum(p, &qu));
    // (U' - U) T - U (T' - T) = U' T - U T'.
    let numerators = [&v_right * &t - &v * &t_right, &v_below * &t - &v * &t_below];
    let square = &t * &t;
    Slopes {
        derivative: numerators.each_ref().map(|n| over(n, &square) * unit),
        t: over(&t, &BigInt::from(1)) * q_unit,
    }
}

/// Numbers as integers in a unit, which is as large as it can be.
fn integers(numbers: [f32; 3]) -> ([BigInt; 3], f64) {
    let integers = numbers.map(integer);
    let zeros = integers.iter().filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
    (integers.map(|n| n >> zeros), 2f64.powi(zeros as i32 - 149))
}

/// n/d to 64 bits and more; NaN where d is 0.
fn over(n: &BigInt, d: &BigInt) -> f64 {
    if d.is_zero() {
        return f64::NAN;
    }
    let shift = (64 + d.bits()).saturating_sub(n.bits());
    let quotient = ((n << shift) / d).to_f64().unwrap_or(f64::NAN);
    // Two steps, as 2^-shift alone may be none of the numbers.
    let half = shift as i32 / 2;
    quotient * 2f64.powi(-half) * 2f64.powi(half - shift as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// u = x / (1 + x + 2 y) in pixels, on a triangle of which q is 1 + x + 2 y.
    #[test]
    fn slopes_are_those_of_a_closed_form() {
        let one = 16;
        let corners = [[0, 0], [8, 0], [0, 4]];
        let tri = corners.map(|p| p.map(|c| c * one));
        // Times q, which is 1, 9 and 9, they are what is linear: x.
        let (q, u) = ([1.0, 9.0, 9.0], [0.0, 8.0 / 9.0, 0.0]);
        let slopes = hyperbolic(tri, [2 * one, one], 4, q, u);
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{a} for {b}");
        // At x = 2, y = 1 q is 5.
        near(slopes.derivative[0], 3.0 / 25.0);
        near(slopes.derivative[1], -4.0 / 25.0);
        near(slopes.t, 5.0 * 32.0 * 256.0);
        let [x, y] = [8.0 / 3.0, 4.0 / 3.0];
        let middle = in_centroid(tri, 4, q, u);
        let square = (1.0 + x + 2.0 * y) * (1.0 + x + 2.0 * y);
        near(middle.derivative[0], (1.0 + 2.0 * y) / square);
        near(middle.derivative[1], -2.0 * x / square);
        near(middle.t, (1.0 + x + 2.0 * y) * 32.0 * 256.0);
    }
}
