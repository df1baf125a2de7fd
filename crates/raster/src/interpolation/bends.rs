//! Parabolas along rows, in `f32`: what perspective adds to planes where q hardly differs.

use super::linear::{Slant, scaled_q};
use crate::interpolation::{Oriented, Values};
use alberti_math::{Mode, Varying};

/// The parabolas of a triangle's components. Counted from the first vertex, with q' over the mean of the least and the
/// greatest q, and with weights λ,
///
/// ```text
/// u − Σ λi ui = Σ λi qi' ui' − (Σ λi qi')(Σ λi ui')      if that mean is q, by which it is divided
/// ```
///
/// The first sum is a plane. The other is a product of two.
#[derive(Clone, Copy)]
pub(super) struct Bends<V: Varying> {
    q: Excess,
    components: V::Of<Bend>,
}

/// A component's parabola.
#[derive(Clone, Copy)]
struct Bend {
    excess: Excess,
    /// The factor of the square of the columns.
    square: f32,
}

/// A function that is linear on the screen and 0 at the first vertex.
#[derive(Clone, Copy)]
struct Excess {
    /// The factors of the edge functions of the others.
    factors: [f32; 2],
    across: f32,
}

impl Excess {
    const NONE: Self = Self { factors: [0.0; 2], across: 0.0 };

    #[inline(always)]
    fn new(slant: &Slant, [b, c]: [f32; 2]) -> Self {
        let ([b, c], [_, sb, sc]) = ([b * slant.per_area, c * slant.per_area], slant.steps);
        Self { factors: [b, c], across: sb * b + sc * c }
    }

    #[inline(always)]
    fn at(&self, [_, eb, ec]: [f32; 3]) -> f32 {
        eb * self.factors[0] + ec * self.factors[1]
    }
}

impl<V: Varying> Bends<V> {
    /// None.
    #[inline(always)]
    pub(super) fn none(triangle: &Oriented<'_, V>) -> Self {
        let none = Bend { excess: Excess::NONE, square: 0.0 };
        Self { q: Excess::NONE, components: V::map(&triangle.words(), &|_: [u32; 4]| none) }
    }

    /// The parabolas, and the values of the components with the first sum.
    #[inline(always)]
    pub(super) fn new(slant: &Slant, triangle: &Oriented<'_, V>) -> (Self, V::Of<Values>) {
        let [a, b, c] = scaled_q(triangle);
        let per_mean = 2.0 / (a.max(b).max(c) + a.min(b).min(c));
        let [qb, qc] = [(b - a) * per_mean, (c - a) * per_mean];
        let q = Excess::new(slant, [qb, qc]);
        let both = V::map_by_mode(&triangle.values(), &|mode, values: Values| {
            if mode != Mode::Hyperbolic {
                return (Bend { excess: Excess::NONE, square: 0.0 }, values);
            }
            let [a, b, c] = values.corners;
            let [ub, uc] = [b - a, c - a];
            let excess = Excess::new(slant, [ub, uc]);
            let bend = Bend { excess, square: -(q.across * excess.across) };
            (bend, Values { corners: [a, b + qb * ub, c + qc * uc], ..values })
        });
        let bends = Self { q, components: V::map(&both, &|(bend, _): (Bend, Values)| bend) };
        (bends, V::map(&both, &|(_, values): (Bend, Values)| values))
    }

    /// The second sum, its increment by column and the factor of the square of columns, where the edge functions are
    /// these.
    #[inline(always)]
    pub(super) fn at(&self, edges: [f32; 3]) -> V::Of<[f32; 3]> {
        let (q, across) = (self.q.at(edges), self.q.across);
        V::map(&self.components, &|Bend { excess, square }: Bend| {
            let u = excess.at(edges);
            [q * u, q * excess.across + across * u, square]
        })
    }
}
