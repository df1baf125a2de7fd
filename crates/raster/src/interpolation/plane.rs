//! Hyperbolic interpolation from plane equations, in each sample.
#![expect(missing_debug_implementations, reason = "states of drawing, which have no name outside")]

use super::exact::power_of_two_near;
use super::linear::{FloatComponent, FloatPlane, Ramp, Slant, along, count, middle, scaled_q};
use crate::differentiation::FloatQuotients;
use crate::edge::EdgeInt;
use crate::interpolation::{Interpolate, Interpolation, Oriented, Prepare, Row, Values};
use crate::spans::Span;
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Mode, Varying};

/// Hyperbolic interpolation from plane equations: q and every q·u are linear on the screen, and u = (q·u)/q. So each is
/// a value in the middle of a run of samples and an increment by column. Runs have at most 64 columns of the triangle,
/// and their middle is taken from the exact integer edges.
///
/// # Precision
/// With r the ratio of q in the middle of a run to q at a sample of it, and ε = 2^-24: (15 r + 5)ε·max|ui|. Depth is
/// within 12ε·max zs, and both are so barring underflow. That is for ratios in a triangle up to 2^70. Where q is
/// level the bound is 20ε, where it falls by half along 64 columns 28ε.
///
/// The reason: with M = max|ui| and T the sum Σ Ei qi at the sample, it is r T in the middle. A function f = Σ Ei fi
/// is within (8 Σ Ei|fi| + |f|)ε, with the Ei of the middle. So Σ Ei qi is within (8 r + 1)ε T. Σ Ei qi ui is within
/// (8 r + 1)ε M T, and ε M T for the products qi ui. Both have the rounding of the Ei in common, ε r in each, which
/// does no more to u than ε r M. The reciprocal and its product add 2ε.
///
/// The result never leaves the range of the three values, so a constant stays constant bit for bit. For |ui| above
/// 2^120, where q·u may overflow, that is all that holds.
///
/// # Cost
/// A fragment: one product, one sum, one division; a component adds two products, a sum, a minimum and a maximum.
/// A triangle: one division, and eight operations a component; a run: five a component. All of it is `f32`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Planes;

/// Columns of the longest run, a power of two.
const RUN: i32 = 64;

impl Interpolation for Planes {}

impl Prepare for Planes {
    type Lanes<L: Floating> = L;
    type Triangle<L: Floating, V: Varying> = PlaneTriangle<L, V>;

    #[inline(always)]
    fn run(self) -> i32 {
        RUN
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
    ) -> PlaneTriangle<L, V> {
        let slant = Slant::new(triangle);
        let plane = |factors: [f32; 3]| FloatPlane::new(factors, slant.steps);
        // By a power of two, and so exactly: products with edge functions then are below 4.
        let scale = power_of_two_near(triangle.area());
        let [qa, qb, qc] = scaled_q(triangle).map(|q| q * scale);
        PlaneTriangle {
            lanes,
            zs: slant.linear(triangle.depths()),
            q: plane([qa, qb, qc]),
            components: V::map_by_mode(&triangle.values(), &|mode, values: Values| {
                let [a, b, c] = values.corners;
                match mode {
                    Mode::Hyperbolic => FloatComponent::new(values, plane([a * qa, b * qb, c * qc])),
                    Mode::Linear => slant.linear(values),
                    Mode::Flat => FloatComponent::flat(values),
                }
            }),
        }
    }
}

/// A triangle prepared for [`Planes`].
#[derive(Clone, Copy)]
pub struct PlaneTriangle<L: Lanes, V: Varying> {
    lanes: L,
    zs: FloatComponent,
    q: FloatPlane,
    components: V::Of<FloatComponent>,
}

/// The place of samples in a run, and the numbers that are linear along it.
#[derive(Clone, Copy)]
pub struct PlaneCursor<L: Lanes, V: Varying> {
    along: L::Number,
    zs: Ramp<L>,
    q: Ramp<L>,
    components: V::Of<Ramp<L>>,
}

impl<L: Floating, V: Varying> Interpolate<L, V> for PlaneTriangle<L, V> {
    type Row = ();
    type Cursor = PlaneCursor<L, V>;
    type Quotients = FloatQuotients<V>;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, _: &Row<'_, I>) {}

    #[inline(always)]
    fn start<I: EdgeInt>(
        &self,
        row: &Row<'_, I>,
        (): &mut (),
        column: i32,
        aligned: i32,
    ) -> (PlaneCursor<L, V>, Span) {
        let lanes = self.lanes;
        let first = row.covered.start.max(column & !(RUN - 1));
        let end = row.covered.end.min((column | (RUN - 1)) + 1);
        let run = [first, end - 1];
        let edges = middle(row, run);
        let cursor = PlaneCursor {
            along: along(lanes, run, aligned),
            zs: Ramp::of(lanes, &self.zs.plane, edges),
            q: Ramp::of(lanes, &self.q, edges),
            components: V::map(&self.components, &|component: FloatComponent| {
                Ramp::of(lanes, &component.plane, edges)
            }),
        };
        (cursor, Span { start: first, end })
    }

    #[inline(always)]
    fn advance(&self, cursor: PlaneCursor<L, V>) -> PlaneCursor<L, V> {
        PlaneCursor { along: cursor.along + count(self.lanes), ..cursor }
    }

    #[inline(always)]
    fn depth(&self, cursor: &PlaneCursor<L, V>, _: &[L::Number; 3]) -> L::Number {
        self.zs.bounded(self.lanes, cursor.zs.at(cursor.along))
    }

    #[inline(always)]
    fn attributes(&self, cursor: &PlaneCursor<L, V>, _: &[L::Number; 3]) -> V::Of<L::Number> {
        let (lanes, along) = (self.lanes, cursor.along);
        let z = lanes.splat(1.0) / cursor.q.at(along);
        V::map_by_mode(&V::zip(&self.components, &cursor.components), &|mode, pair| {
            let (component, ramp): (FloatComponent, Ramp<L>) = pair;
            match mode {
                Mode::Hyperbolic => component.bounded(lanes, ramp.at(along) * z),
                Mode::Linear => component.bounded(lanes, ramp.at(along)),
                Mode::Flat => component.constant(lanes),
            }
        })
    }
}
