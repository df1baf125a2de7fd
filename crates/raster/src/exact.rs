//! Hyperbolic (perspective-correct) interpolation from the exact integer edges.

use crate::lanes::Lanes;
use alberti_math::{Varying, hull3};

/// The `Exact` perspective: at a sample, ti = Ei qi and u = Σ ti ui / Σ ti, with the edge function Ei opposite vertex i
/// and qi = 1/zi.
///
/// # Precision
/// Within 9ε·max|ui| of the exact value at the sample (ε = 2^-24; 5.1ε is the most that was measured, over ratios of the
/// qi up to 10^12), barring over- and underflow: up to |ui| = 2^77 and ratios of 2^126. The reason: ti carries two roundings
/// (Ei to f32, the product), the same in the numerator and the denominator, which changes a convex combination by at
/// most ε·range <= 2ε·max|u|; the numerator's products and sums add 3ε, the denominator's sums 2ε, the reciprocal and
/// its product ε each. Counted from zi instead of qi the bound is 10ε. The result never leaves the range of the three
/// values, so a constant stays constant bit for bit.
///
/// # Cost
/// A fragment: three conversions, three products, two sums, one division; a component adds four products, two sums,
/// a minimum and a maximum.
#[derive(Clone, Copy)]
pub struct Exact<L: Lanes, V: Varying> {
    /// The three q, in every lane.
    q: [L; 3],
    /// For each component, in every lane: its values at the three vertices, the least, the greatest.
    values: V::Of<[L; 5]>,
}

impl<L: Lanes, V: Varying> Exact<L, V> {
    /// Prepares a triangle with `q` > 0 and finite values.
    #[must_use]
    #[inline(always)]
    pub fn new(q: [f32; 3], [a, b, c]: [V; 3]) -> Self {
        let scale = power_of_two_near(q[0].max(q[1]).max(q[2]));
        let [lo, hi] = hull3([a, b, c]);
        Self {
            q: [L::splat(q[0] * scale), L::splat(q[1] * scale), L::splat(q[2] * scale)],
            values: V::map(&V::gather([a, b, c, lo, hi]), &|[a, b, c, lo, hi]: [f32; 5]| {
                [L::splat(a), L::splat(b), L::splat(c), L::splat(lo), L::splat(hi)]
            }),
        }
    }

    /// The value at each sample where the edge functions, rounded to `f32`, are `edges`.
    #[must_use]
    #[inline(always)]
    pub fn at(&self, edges: [L; 3]) -> V::Of<L> {
        let t0 = edges[0] * self.q[0];
        let t1 = edges[1] * self.q[1];
        let t2 = edges[2] * self.q[2];
        let scale = L::splat(1.0) / (t0 + t1 + t2);
        V::map(&self.values, &|[a, b, c, lo, hi]: [L; 5]| {
            let sum = t0 * a + t1 * b + t2 * c;
            (sum * scale).max(lo).min(hi)
        })
    }
}

impl<L: Lanes, V: Varying> core::fmt::Debug for Exact<L, V> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Exact").finish_non_exhaustive()
    }
}

/// The power of two s for which x s lies in [1, 2), so that no weight can overflow or, for ratios of q up to 2^126, lose
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
        let depth = Exact::<f32, f32>::new([1.0, 1.0 / 3.0, 1.0], [1.0f32, 3.0, 1.0]);
        assert!((depth.at([100.0f32, 100.0, 0.0]) - 1.5).abs() < 1e-6);
        assert_eq!(depth.at([77.0f32, 0.0, 0.0]), 1.0);
        assert_eq!(Exact::<f32, f32>::new([1e-9, 3.3, 0.7], [0.1f32; 3]).at([3.0f32, 5.0, 9e9]), 0.1);
    }
}
