//! Hyperbolic interpolation from plane equations, in each sample.

use super::linear::{FloatComponent, FloatPlane, Ramp, along, count, per_area, scaled_q, zs};
use crate::edge::EdgeInt;
use crate::interpolation::{Interpolate, Interpolation, Oriented, Prepare, Row};
use crate::spans::Span;
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Mode, Varying};
use core::fmt;

/// Hyperbolic interpolation from plane equations: q and every q·u are linear on the screen, and u = (q·u)/q. So each is
/// a value at the start of a run of samples and an increment by column. The planes are set up in `f64`, and evaluated
/// in it at the start of each run, of at most 64 columns, in the triangle. Only the increments along a run are `f32`.
///
/// # Precision
/// With r the ratio of q at the start of a run to q at a sample of it, and ε = 2^-24: (6 r + 8)ε·max|ui|, and 6ε·max zs
/// for depth. That is for ratios in a triangle up to 2^24, beyond which the error of `f64` counts. Where q falls by
/// half along 64 columns the bound is 20ε, where it grows at most 14ε.
///
/// The reason: q and q·u each carry the rounding of the start and of the step, of their product with the columns and of
/// the sum. That is (3 r + 3)ε relative to q; the reciprocal and the product add 2ε.
///
/// The result never leaves the range of the three values, so a constant stays constant bit for bit. For |ui| above
/// 2^120, where q·u may overflow, that is all that holds.
///
/// # Cost
/// A fragment: one product, one sum, one division; a component adds two products, a sum, a minimum and a maximum.
/// A triangle: one `f64` division, and about eight operations a component; a run: four a component. Without a hardware
/// `f64`, setup costs more than all fragments of a small triangle.
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
    fn prepare<L: Floating, V: Varying>(self, lanes: L, triangle: &Oriented<'_, V>) -> PlaneTriangle<L, V> {
        let per_area = per_area(triangle);
        // Increments by column of the edge functions of the two edges that end at the first corner, opposite the
        // others: integers below 2^53.
        let [a, b, c] = triangle.corners;
        let step = |y: i32| f64::from(y) * f64::from(triangle.one()) * per_area;
        let across = [step(c[1] - a[1]), step(a[1] - b[1])];
        let sloped = |component: FloatComponent| Sloped { across: component.plane.more(across), component };

        let q = scaled_q(triangle);
        let q_plane = FloatPlane::new(q);
        PlaneTriangle {
            lanes,
            per_area,
            zs: sloped(zs(triangle)),
            q: (q_plane, q_plane.more(across)),
            components: V::map_by_mode(&triangle.values(), &|mode, [a, b, c, first]: [f32; 4]| match mode {
                Mode::Hyperbolic => {
                    let component = FloatComponent::new([a, b, c]);
                    let times_q = [f64::from(a) * q[0], f64::from(b) * q[1], f64::from(c) * q[2]];
                    sloped(FloatComponent { plane: FloatPlane::new(times_q), ..component })
                }
                Mode::Linear => sloped(FloatComponent::new([a, b, c])),
                Mode::Flat => sloped(FloatComponent::flat(first)),
            }),
        }
    }
}

/// A component and its increment by column.
#[derive(Clone, Copy)]
struct Sloped {
    component: FloatComponent,
    across: f64,
}

/// A triangle prepared for [`Planes`].
#[derive(Clone, Copy)]
pub struct PlaneTriangle<L: Lanes, V: Varying> {
    lanes: L,
    per_area: f64,
    zs: Sloped,
    q: (FloatPlane, f64),
    components: V::Of<Sloped>,
}

/// The place of samples in a run, and the numbers that are linear along it.
#[derive(Clone, Copy)]
pub struct PlaneCursor<L: Lanes, V: Varying> {
    along: L::Number,
    zs: Ramp<L>,
    q: [L::Number; 2],
    components: V::Of<Ramp<L>>,
}

impl<L: Floating, V: Varying> Interpolate<L, V> for PlaneTriangle<L, V> {
    type Row = ();
    type Cursor = PlaneCursor<L, V>;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, _: &Row<'_, I>) {}

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
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
        let [_, b, c] = row.at(first);
        let weights = [b.to_f64() * self.per_area, c.to_f64() * self.per_area];
        let ramp = |s: Sloped| Ramp::new(lanes, s.component.plane.at(weights), s.across, &s.component);
        let (q, q_across) = self.q;
        let cursor = PlaneCursor {
            along: along(lanes, first, aligned),
            zs: ramp(self.zs),
            q: [lanes.splat(q.at(weights) as f32), lanes.splat(q_across as f32)],
            components: V::map(&self.components, &ramp),
        };
        (cursor, Span { start: first, end })
    }

    #[inline(always)]
    fn advance(&self, cursor: PlaneCursor<L, V>) -> PlaneCursor<L, V> {
        PlaneCursor { along: cursor.along + count(self.lanes), ..cursor }
    }

    #[inline(always)]
    fn depth(&self, cursor: &PlaneCursor<L, V>, _: &[L::Number; 3]) -> L::Number {
        cursor.zs.at(self.lanes, cursor.along)
    }

    #[inline(always)]
    fn attributes(&self, cursor: &PlaneCursor<L, V>, _: &[L::Number; 3]) -> V::Of<L::Number> {
        let (lanes, along) = (self.lanes, cursor.along);
        let z = lanes.splat(1.0) / (cursor.q[0] + cursor.q[1] * along);
        V::map_by_mode(&cursor.components, &|mode, ramp: Ramp<L>| match mode {
            Mode::Hyperbolic => ramp.times(lanes, along, z),
            Mode::Linear => ramp.at(lanes, along),
            Mode::Flat => ramp.start(),
        })
    }
}

impl<L: Lanes, V: Varying> fmt::Debug for PlaneTriangle<L, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PlaneTriangle").finish_non_exhaustive()
    }
}

impl<L: Lanes, V: Varying> fmt::Debug for PlaneCursor<L, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PlaneCursor").finish_non_exhaustive()
    }
}
