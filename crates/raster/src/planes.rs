//! Plane equations: what is linear on the screen, as a value at a sample and steps to its neighbours.

use crate::exact::power_of_two_near;
use crate::triangle::{Corners, Vertex};
use alberti_math::lanes::Lanes;
use alberti_math::{Subpixel, Varying, hull3};

/// A function that is linear on the screen, in `f64`.
#[derive(Clone, Copy)]
pub(crate) struct Linear {
    /// At the first vertex, and what the second and the third have more.
    first: f64,
    more: [f64; 2],
    /// What a column adds.
    pub(crate) across: f64,
}

impl Linear {
    /// Where the second and the third vertex have these weights. In the triangle nothing cancels, so the error is a few
    /// units of 2^-53 of the greatest value.
    #[inline(always)]
    pub(crate) fn at(&self, [b, c]: [f64; 2]) -> f64 {
        self.first + self.more[0] * b + self.more[1] * c
    }
}

/// The weight of a vertex: its edge function over the doubled area.
#[derive(Clone, Copy)]
struct Weight {
    /// Integers, at the reference sample and what a column and a row add.
    value: f64,
    across: f64,
    down: f64,
}

/// One number of a vertex over a triangle, and what its values at the vertices do not exceed.
#[derive(Clone, Copy)]
pub(crate) struct Component {
    pub(crate) plane: Linear,
    pub(crate) least: f32,
    pub(crate) greatest: f32,
}

/// A triangle as planes: of screen depth, of q, and of each component times q.
#[derive(Clone, Copy)]
pub(crate) struct Planes<V: Varying> {
    /// Column and row of the reference sample.
    reference: [i32; 2],
    weights: [Weight; 2],
    per_area: f64,
    pub(crate) zs: Component,
    pub(crate) q: Linear,
    pub(crate) components: V::Of<Component>,
}

impl<V: Varying> Planes<V> {
    /// The planes of a triangle of positive area, its corners clockwise. Without `HYPERBOLIC`, q counts as 1.
    #[inline(always)]
    pub(crate) fn new<S: Subpixel, const HYPERBOLIC: bool>(
        vertices: [&Vertex<S, V>; 3],
        corners: &Corners,
        doubled_area: i64,
    ) -> Self {
        // The edge functions of the two edges that end at the first corner, opposite the others: integers below 2^53, so
        // that their arithmetic is exact.
        let [from, to_b, to_c] = *corners;
        let reference = [from[0] >> S::BITS, from[1] >> S::BITS];
        let delta = |i: [i32; 2], j: [i32; 2]| [f64::from(i[0] - j[0]), f64::from(i[1] - j[1])];
        let [bx, by] = delta(to_b, from);
        let [cx, cy] = delta(to_c, from);
        let [px, py] = delta([reference[0] * S::ONE + S::HALF, reference[1] * S::ONE + S::HALF], from);
        let one = f64::from(S::ONE);
        let b = Weight { value: px * cy - py * cx, across: cy * one, down: -cx * one };
        let c = Weight { value: bx * py - by * px, across: -by * one, down: bx * one };
        #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
        let per_area = 1.0 / doubled_area as f64;
        let weights = [b, c];
        let linear = |first: f64, second: f64, third: f64| {
            let more = [second - first, third - first];
            Linear { first, more, across: (more[0] * b.across + more[1] * c.across) * per_area }
        };

        let [a, b, c] = vertices;
        let [nearest, farthest] = hull3([a.zs, b.zs, c.zs]);
        let zs = linear(f64::from(a.zs), f64::from(b.zs), f64::from(c.zs));
        let [qa, qb, qc] = if HYPERBOLIC {
            let scale = power_of_two_near(a.q.max(b.q).max(c.q));
            [f64::from(a.q * scale), f64::from(b.q * scale), f64::from(c.q * scale)]
        } else {
            [1.0; 3]
        };
        let [lo, hi] = hull3([a.varying, b.varying, c.varying]);
        let values = V::gather([a.varying, b.varying, c.varying, lo, hi]);
        Self {
            reference,
            weights,
            per_area,
            zs: Component { plane: zs, least: nearest, greatest: farthest },
            q: linear(qa, qb, qc),
            components: V::map(&values, &|[a, b, c, least, greatest]: [f32; 5]| {
                let plane = linear(f64::from(a) * qa, f64::from(b) * qb, f64::from(c) * qc);
                Component { plane, least, greatest }
            }),
        }
    }

    /// The weights of the second and the third vertex at a sample.
    #[inline(always)]
    pub(crate) fn place(&self, column: i32, row: i32) -> [f64; 2] {
        let [columns, rows] = [f64::from(column - self.reference[0]), f64::from(row - self.reference[1])];
        let [b, c] = self.weights;
        let weight = |w: Weight| (w.value + w.across * columns + w.down * rows) * self.per_area;
        [weight(b), weight(c)]
    }
}

/// A number along a run: where it starts, what a column adds, and its bounds, the same in every lane.
#[derive(Clone, Copy)]
pub(crate) struct Ramp<L: Lanes> {
    start: L::F32,
    step: L::F32,
    least: L::F32,
    greatest: L::F32,
}

impl<L: Lanes> Ramp<L> {
    #[inline(always)]
    pub(crate) fn new(lanes: L, start: f32, step: f32, component: &Component) -> Self {
        Self {
            start: lanes.splat(start),
            step: lanes.splat(step),
            least: lanes.splat(component.least),
            greatest: lanes.splat(component.greatest),
        }
    }

    /// From the sample where the weights are `place`, along the plane.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
    pub(crate) fn of_plane(lanes: L, component: &Component, place: [f64; 2]) -> Self {
        let plane = component.plane;
        Self::new(lanes, plane.at(place) as f32, plane.across as f32, component)
    }

    /// So many columns along, times `factor`, within the bounds.
    #[inline(always)]
    pub(crate) fn times(&self, lanes: L, along: L::F32, factor: L::F32) -> L::F32 {
        let value = (self.start + self.step * along) * factor;
        lanes.min(lanes.max(value, self.least), self.greatest)
    }

    /// So many columns along, within the bounds.
    #[inline(always)]
    pub(crate) fn at(&self, lanes: L, along: L::F32) -> L::F32 {
        lanes.min(lanes.max(self.start + self.step * along, self.least), self.greatest)
    }
}

/// The columns from `first` to the samples from `column` on.
#[inline(always)]
pub(crate) fn along<L: Lanes>(lanes: L, first: i32, column: i32) -> L::F32 {
    #[expect(clippy::cast_precision_loss, reason = "less than a run")]
    let columns = (column - first) as f32;
    lanes.splat(columns) + lanes.ramp()
}

/// The lanes' number as a number.
#[inline(always)]
pub(crate) fn count<L: Lanes>(lanes: L) -> L::F32 {
    #[expect(clippy::cast_precision_loss, reason = "at most 8")]
    let count = L::COUNT as f32;
    lanes.splat(count)
}
