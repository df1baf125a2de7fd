//! Determinants of differences of `f32` points, right to the last bits whatever cancels.
//!
//! Areas, volumes and Cramer's rule are determinants whose columns lead from one point to another. Each is first
//! evaluated plainly in `f64`. Where more than 20 bits cancel, as they do in slivers, it is expanded into products of
//! coordinates, which `f64` holds exactly, and these are summed without error. So the sign is that of the exact
//! determinant for all finite points, and the value is within 2^-30 of it, relatively.
//!
//! The products of up to three `f32` lie between 2^-447 and 2^384, so that nothing overflows or underflows.
//!
//! Source: Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete &
//! Computational Geometry 18 (1997): grow-expansion with zero elimination.

use core::array::from_fn;

/// A column of a determinant: the points that it leads from and to.
pub(crate) type Column<const N: usize> = [[f32; N]; 2];

/// The share of the sum of the terms' magnitudes that a plain determinant must reach to be kept: 2^-20. The plain
/// evaluations below are within 8·2^-53 of that sum, hence relatively within 2^-30.
const KEPT: f64 = 1.0 / 1_048_576.0;

/// The determinant of two columns; NaN where a coordinate is not finite.
pub(crate) fn det2([u, v]: [Column<2>; 2]) -> f64 {
    let [[ux, uy], [vx, vy]] = [u, v].map(difference);
    let (positive, negative) = (ux * vy, uy * vx);
    kept(positive - negative, positive.abs() + negative.abs()).unwrap_or_else(|| {
        let mut sum = ExactSum::<8>::new();
        for ([i, j], sign) in [([0, 1], 1.0), ([1, 0], -1.0)] {
            for x in ends(u, i) {
                for y in ends(v, j) {
                    sum.add(sign * x * y);
                }
            }
        }
        sum.value()
    })
}

/// The determinant of three columns; NaN where a coordinate is not finite.
pub(crate) fn det3([u, v, w]: [Column<3>; 3]) -> f64 {
    let [a, b, c] = [u, v, w].map(difference);
    let mut plain = 0.0;
    let mut magnitude = 0.0;
    for [i, j, k] in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
        let (positive, negative) = (b[j] * c[k], b[k] * c[j]);
        plain += a[i] * (positive - negative);
        magnitude += a[i].abs() * (positive.abs() + negative.abs());
    }
    kept(plain, magnitude).unwrap_or_else(|| {
        let mut sum = ExactSum::<96>::new();
        for ([i, j, k], sign) in [
            ([0, 1, 2], 1.0),
            ([1, 2, 0], 1.0),
            ([2, 0, 1], 1.0),
            ([0, 2, 1], -1.0),
            ([2, 1, 0], -1.0),
            ([1, 0, 2], -1.0),
        ] {
            for x in ends(u, i) {
                for y in ends(v, j) {
                    for half in halves(sign * x * y) {
                        for z in ends(w, k) {
                            sum.add(half * z);
                        }
                    }
                }
            }
        }
        sum.value()
    })
}

/// The coordinates of `right` along two columns, by Cramer's rule; `None` where they do not span the plane, or where
/// a coordinate is not finite.
pub(crate) fn cramer2(columns: [Column<2>; 2], right: Column<2>) -> Option<[f32; 2]> {
    ratios(from_fn(|k| det2(replaced(columns, k, right))), det2(columns))
}

/// The coordinates of `right` along three columns, as [`cramer2`].
pub(crate) fn cramer3(columns: [Column<3>; 3], right: Column<3>) -> Option<[f32; 3]> {
    ratios(from_fn(|k| det3(replaced(columns, k, right))), det3(columns))
}

/// `all` with `new` in the place `k`.
pub(crate) fn replaced<T, const N: usize>(mut all: [T; N], k: usize, new: T) -> [T; N] {
    all[k] = new;
    all
}

/// The parts as fractions of the whole; `None` where one is not finite, as by a whole of zero.
pub(crate) fn ratios<const N: usize>(parts: [f64; N], whole: f64) -> Option<[f32; N]> {
    let ratios = parts.map(|part| nearest(part / whole));
    ratios.iter().all(|ratio| ratio.is_finite()).then_some(ratios)
}

/// The nearest `f32`.
pub(crate) fn nearest(x: f64) -> f32 {
    #[allow(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
    let nearest = x as f32;
    nearest
}

/// The difference of two `f32` in `f64`: within 2^-53, relatively.
pub(crate) fn minus(to: f32, from: f32) -> f64 {
    f64::from(to) - f64::from(from)
}

fn difference<const N: usize>([from, to]: Column<N>) -> [f64; N] {
    from_fn(|i| minus(to[i], from[i]))
}

/// The two terms of a component of a column.
fn ends<const N: usize>([from, to]: Column<N>, i: usize) -> [f64; 2] {
    [f64::from(to[i]), -f64::from(from[i])]
}

/// A plain result that is good enough. An infinite or NaN coordinate makes every plain result infinite or NaN, and
/// nothing else does: it becomes NaN, so that no quotient makes a number of it again.
fn kept(plain: f64, magnitude: f64) -> Option<f64> {
    match plain.is_finite() {
        true => (plain.abs() >= KEPT * magnitude).then_some(plain),
        false => Some(f64::NAN),
    }
}

/// `x` as two numbers of at most 26 bits (Veltkamp, Dekker), whose product with an `f32` is exact.
fn halves(x: f64) -> [f64; 2] {
    let scaled = x * 134_217_729.0;
    let high = scaled - (scaled - x);
    [high, x - high]
}

/// The rounded sum, and the part that rounding lost (Knuth).
fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let b_part = sum - a;
    [sum, (a - (sum - b_part)) + (b - b_part)]
}

/// The exact sum of up to `N` numbers, as numbers of increasing magnitude whose bits do not overlap.
struct ExactSum<const N: usize> {
    parts: [f64; N],
    len: usize,
}

impl<const N: usize> ExactSum<N> {
    fn new() -> Self {
        Self { parts: [0.0; N], len: 0 }
    }

    fn add(&mut self, term: f64) {
        let mut carry = term;
        let mut len = 0;
        for i in 0..self.len {
            let [sum, lost] = two_sum(carry, self.parts[i]);
            carry = sum;
            if lost != 0.0 {
                self.parts[len] = lost;
                len += 1;
            }
        }
        if carry != 0.0 {
            self.parts[len] = carry;
            len += 1;
        }
        self.len = len;
    }

    /// Within 2^-51, relatively, as it is at least two thirds of the largest part.
    fn value(&self) -> f64 {
        self.parts[..self.len].iter().fold(0.0, |sum, part| sum + part)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_lose_nothing() {
        let mut sum = ExactSum::<6>::new();
        for term in [1e300, 1.0, -1e300, 1e-300, -1.0] {
            sum.add(term);
        }
        assert_eq!(sum.value(), 1e-300);
        sum.add(-1e-300);
        assert_eq!((sum.value(), sum.len), (0.0, 0));
    }

    #[test]
    fn determinants_survive_total_cancellation() {
        let big = 16_777_216.0f32;
        let (large, tiny) = (1e30f32, f32::from_bits(1));
        let zero = [0.0; 2];
        // (2^24 - 1)² - 2^24 (2^24 - 2).
        assert_eq!(det2([[zero, [big - 1.0, big]], [zero, [big - 2.0, big - 1.0]]]), 1.0);
        // Moved by 1e30, the columns are zero, and the plain differences see it.
        assert_eq!(det2([[[large; 2], [large; 2]], [zero, [1.0, 2.0]]]), 0.0);
        // (1e30 + tiny) (1e30 - tiny) - 1e30², of which the last bit is 2^-298.
        let columns = [[[-tiny, 0.0], [large; 2]], [[0.0, tiny], [large; 2]]];
        let square = f64::from(tiny) * f64::from(tiny);
        assert_eq!(det2(columns), -square);
        let [u, v] = columns.map(|column| column.map(|[x, y]| [x, y, 0.0]));
        let up = [[0.0, 0.0, large], [0.0, 0.0, -tiny]];
        assert_eq!(det3([u, v, up]), square * f64::from(large));
    }

    #[test]
    fn what_is_not_finite_is_nan() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert!(det2([[[0.0, 0.0], [bad, 0.0]], [[0.0, 0.0], [0.0, 1.0]]]).is_nan());
            assert!(det3([[[0.0; 3], [1.0; 3]], [[0.0; 3], [0.0, bad, 0.0]], [[0.0; 3]; 2]]).is_nan());
        }
        assert_eq!(ratios([1.0, 2.0], 0.0), None);
        assert_eq!(ratios([1e30, 2.0], 1e-30), None);
    }
}
