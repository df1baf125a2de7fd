//! Hyperbolic (perspective-correct) interpolation from the exact integer edges.
#![expect(missing_debug_implementations, reason = "states of drawing, which have no name outside")]

use crate::differentiation::FloatQuotients;
use crate::edge::EdgeInt;
use crate::interpolation::{Interpolate, Interpolation, Oriented, Prepare, Row, Values};
use crate::spans::Span;
use crate::triangle::Corner;
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Mode, Varying, hull3, in_line, map3};

/// Hyperbolic interpolation from the exact integer edges: at a sample, ti = Ei qi and u = Σ ti ui / Σ ti. Ei is the
/// edge function opposite vertex i, and qi = 1/zi. Screen depth is Σ Ei zsi / Σ Ei.
///
/// # Precision
/// Within 9ε·max|ui| of the exact value at the sample (ε = 2^-24), barring over- and underflow: up to |ui| = 2^77 and
/// ratios of 2^126. 5.98ε is the most that was measured, over ratios of the qi up to 10^12. Counted from zi instead of
/// qi the bound is 10ε. The result never leaves the range of the three values, so a constant stays constant bit for
/// bit.
///
/// The reason: ti carries two roundings (Ei to f32, the product), the same in the numerator and the denominator. They
/// change a convex combination by at most ε·range <= 2ε·max|u|. The numerator's products and sums add 3ε, the
/// denominator's sums 2ε, the reciprocal and its product ε each.
///
/// # Cost
/// A fragment: three conversions, three products, two sums, one division; a component adds four products, two sums,
/// a minimum and a maximum.
#[derive(Clone, Copy, Debug, Default)]
pub struct Exact;

impl Interpolation for Exact {}

impl Prepare for Exact {
    type Lanes<L: Floating> = L;
    type Triangle<L: Floating, V: Varying> = ExactTriangle<L, V>;

    #[inline(always)]
    fn run(self) -> i32 {
        1 << 30
    }

    #[inline(always)]
    fn lanes<L: Floating>(self, lanes: L) -> L {
        lanes
    }

    #[inline(always)]
    fn prepare<L: Floating, V: Varying>(
        self,
        lanes: L,
        triangle: &Oriented<'_, V>,
        (): (),
    ) -> ExactTriangle<L, V> {
        #[expect(clippy::cast_precision_loss, reason = "rounding to nearest is within the bound")]
        let area = triangle.doubled_area as f32;
        let q = map3(triangle.vertices, Corner::q);
        ExactTriangle::with_depth(lanes, triangle.depths(), area, q, &triangle.values())
    }
}

/// A triangle prepared for [`Exact`].
#[derive(Clone, Copy)]
pub struct ExactTriangle<L: Lanes, V: Varying> {
    lanes: L,
    /// zs over the doubled area, so that weights need not be normalised.
    zs: [L::Number; 3],
    nearest_farthest: [L::Number; 2],
    /// The three q.
    q: [L::Number; 3],
    /// For each component: its values at the three vertices, the least, the greatest.
    values: V::Of<[L::Number; 5]>,
}

impl<L: Floating, V: Varying> ExactTriangle<L, V> {
    /// The attributes of a triangle with `q` > 0 and finite values, without its depth.
    #[must_use]
    #[inline(always)]
    pub fn of_attributes(lanes: L, q: [f32; 3], [a, b, c]: [V; 3]) -> Self {
        let values = V::map_by_mode(&V::gather([a, b, c]), &|mode, corners: [f32; 3]| {
            let corners = if mode == Mode::Flat { [corners[0]; 3] } else { corners };
            Values { corners, range: hull3(corners) }
        });
        let depths = Values { corners: [0.0; 3], range: [0.0; 2] };
        Self::with_depth(lanes, depths, 1.0, q, &values)
    }

    #[inline(always)]
    fn with_depth(lanes: L, depths: Values, area: f32, q: [f32; 3], values: &V::Of<Values>) -> Self {
        let splat = |x: f32| lanes.splat(x);
        let scale = power_of_two_near(q[0].max(q[1]).max(q[2]));
        let Values { corners: zs, range: [nearest, farthest] } = depths;
        Self {
            lanes,
            zs: [splat(zs[0] / area), splat(zs[1] / area), splat(zs[2] / area)],
            nearest_farthest: [splat(nearest), splat(farthest)],
            q: [splat(q[0] * scale), splat(q[1] * scale), splat(q[2] * scale)],
            values: V::map(values, &|Values { corners: [a, b, c], range: [lo, hi] }| {
                [splat(a), splat(b), splat(c), splat(lo), splat(hi)]
            }),
        }
    }

    /// The weights times the three q, and the reciprocal of their sum.
    #[inline(always)]
    fn shares(&self, [e0, e1, e2]: [L::Number; 3]) -> ([L::Number; 3], L::Number) {
        let [t0, t1, t2] = [e0 * self.q[0], e1 * self.q[1], e2 * self.q[2]];
        ([t0, t1, t2], self.lanes.splat(1.0) / (t0 + t1 + t2))
    }

    /// The attributes where the edge functions, rounded to `f32`, are `edges`.
    #[must_use]
    #[inline(always)]
    pub fn at(&self, edges: &[L::Number; 3]) -> V::Of<L::Number> {
        let lanes = self.lanes;
        let [e0, e1, e2] = *edges;
        let ([t0, t1, t2], scale) = self.shares(*edges);
        // Where there is nothing linear, compilers leave the second division out.
        let linear = lanes.splat(1.0) / (e0 + e1 + e2);
        let value = in_line(
            #[inline(always)]
            |mode, [a, b, c, lo, hi]: [L::Number; 5]| {
                let value = match mode {
                    Mode::Hyperbolic => (t0 * a + t1 * b + t2 * c) * scale,
                    Mode::Linear => (e0 * a + e1 * b + e2 * c) * linear,
                    Mode::Flat => return lo,
                };
                lanes.min(lanes.max(value, lo), hi)
            },
        );
        V::map_by_mode(&self.values, &value)
    }
}

impl<L: Floating, V: Varying> Interpolate<L, V> for ExactTriangle<L, V> {
    type Row = ();
    type Cursor = ();
    type Quotients = FloatQuotients<V>;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, _: &Row<'_, I>) {}

    #[inline(always)]
    fn start<I: EdgeInt>(&self, row: &Row<'_, I>, (): &mut (), _: i32, _: i32) -> ((), Span) {
        ((), row.covered)
    }

    #[inline(always)]
    fn advance(&self, (): ()) {}

    #[inline(always)]
    fn depth(&self, (): &(), weights: &[L::Number; 3]) -> L::Number {
        let [nearest, farthest] = self.nearest_farthest;
        let zs = weights[0] * self.zs[0] + weights[1] * self.zs[1] + weights[2] * self.zs[2];
        self.lanes.min(self.lanes.max(zs, nearest), farthest)
    }

    #[inline(always)]
    fn attributes(&self, (): &(), weights: &[L::Number; 3]) -> V::Of<L::Number> {
        self.at(weights)
    }

    #[inline(always)]
    fn reciprocal(&self, weights: &[L::Number; 3]) -> Option<L::Number> {
        Some(self.shares(*weights).1)
    }
}

/// The power of two s for which x s lies in [1, 2); multiplying by it is exact. So no weight can overflow or, for
/// ratios of q up to 2^126, lose bits.
#[inline]
pub(crate) fn power_of_two_near(x: f32) -> f32 {
    let exponent = (x.to_bits() >> 23) & 0xff;
    // Exponents of subnormal and of the largest numbers have no normal counterpart: they get their neighbours'.
    f32::from_bits(254u32.saturating_sub(exponent).clamp(1, 253) << 23)
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::lanes::One;

    #[test]
    fn scaling_brings_every_number_near_one() {
        for x in [1.0, 1.5, 3.9, 1e-30, 7e30, f32::MIN_POSITIVE, 0.1] {
            let scaled = x * power_of_two_near(x);
            assert!((1.0..2.0).contains(&scaled), "{x:e}: {scaled}");
        }
    }

    #[test]
    fn the_middle_of_an_edge_is_nearer_in_space() {
        let depth = ExactTriangle::of_attributes(One, [1.0, 1.0 / 3.0, 1.0], [1.0f32, 3.0, 1.0]);
        assert!((depth.at(&[100.0, 100.0, 0.0]) - 1.5).abs() < 1e-6);
        assert_eq!(depth.at(&[77.0, 0.0, 0.0]), 1.0);
        let constant = ExactTriangle::of_attributes(One, [1e-9, 3.3, 0.7], [0.1f32; 3]);
        assert_eq!(constant.at(&[3.0, 5.0, 9e9]), 0.1);
    }
}
