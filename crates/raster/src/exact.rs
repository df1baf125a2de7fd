//! Hyperbolic (perspective-correct) interpolation from the exact integer edges.

use crate::lanes::Lanes;
use alberti_math::{Varying, hull3};

/// The `Exact` perspective: at a sample, ti = Ei qi and u = Σ ti ui / Σ ti, with the edge function Ei opposite vertex i
/// and qi = 1/zi.
///
/// # Precision
/// Within 9ε·max|ui| of the exact value at the sample, for any ratio of the qi (ε = 2^-24): ti carries two roundings
/// (Ei to f32, the product), the same in the numerator and the denominator, which changes a convex combination by at
/// most ε·range <= 2ε·max|u|; the numerator's products and sums add 3ε, the denominator's sums 2ε, the reciprocal and
/// its product ε each. Counted from zi instead of qi the bound is 10ε. The result never leaves the range of the three
/// values, so a constant stays constant bit for bit.
///
/// # Cost
/// A fragment: three conversions, three products, two sums, one division; a component adds four products, two sums,
/// a minimum and a maximum.
#[derive(Clone, Copy)]
pub struct Exact<V: Varying> {
    q: [f32; 3],
    /// For each component: at the three vertices, the least, the greatest.
    values: V::Of<[f32; 5]>,
}

impl<V: Varying> Exact<V> {
    /// Prepares a triangle with `q` > 0 and finite values.
    #[must_use]
    #[inline]
    pub fn new(q: [f32; 3], [a, b, c]: [V; 3]) -> Self {
        let scale = power_of_two_near(q[0].max(q[1]).max(q[2]));
        let [lo, hi] = hull3([a, b, c]);
        Self { q: [q[0] * scale, q[1] * scale, q[2] * scale], values: V::gather([a, b, c, lo, hi]) }
    }

    /// The value at each sample where the edge functions, rounded to `f32`, are `edges`.
    #[must_use]
    #[inline(always)]
    pub fn at<L: Lanes>(&self, edges: [L; 3]) -> V::Of<L> {
        let t0 = edges[0] * L::splat(self.q[0]);
        let t1 = edges[1] * L::splat(self.q[1]);
        let t2 = edges[2] * L::splat(self.q[2]);
        let scale = L::splat(1.0) / (t0 + t1 + t2);
        V::map(&self.values, &|[a, b, c, lo, hi]: [f32; 5]| {
            let sum = t0 * L::splat(a) + t1 * L::splat(b) + t2 * L::splat(c);
            within(sum * scale, lo, hi)
        })
    }
}

impl<V: Varying> core::fmt::Debug for Exact<V> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Exact").field("q", &self.q).finish_non_exhaustive()
    }
}

/// `x`, or the end of the range that it lies beyond.
#[inline(always)]
pub(crate) fn within<L: Lanes>(x: L, lo: f32, hi: f32) -> L {
    x.max(L::splat(lo)).min(L::splat(hi))
}

/// The power of two s for which x s lies in [1, 2), so that no product with an edge function can overflow or lose
/// bits; multiplying by it is exact.
#[inline]
fn power_of_two_near(x: f32) -> f32 {
    let exponent = (x.to_bits() >> 23) & 0xff;
    // Exponents of subnormal and of the largest numbers have no normal counterpart: they keep what they have.
    f32::from_bits(254u32.saturating_sub(exponent).clamp(1, 253) << 23)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaling_brings_every_number_near_one() {
        for x in [1.0, 1.5, 3.9, 1e-30, 7e30, f32::MIN_POSITIVE, 0.1] {
            let scaled = x * power_of_two_near(x);
            assert!((1.0..2.0).contains(&scaled), "{x:e}: {scaled}");
        }
    }

    #[test]
    fn the_middle_of_an_edge_is_nearer_in_space() {
        let depth = Exact::new([1.0, 1.0 / 3.0, 1.0], [1.0f32, 3.0, 1.0]);
        assert!((depth.at([100.0f32, 100.0, 0.0]) - 1.5).abs() < 1e-6);
        assert_eq!(depth.at([77.0f32, 0.0, 0.0]), 1.0);
        assert_eq!(Exact::new([1e-9, 3.3, 0.7], [0.1f32; 3]).at([3.0f32, 5.0, 9e9]), 0.1);
    }
}
