//! Functions that are linear on the screen, in `f32`, and their values along a run of samples.
//!
//! ```text
//!   E |*                     E, an edge function, is in [0, area] at both ends of a run, as these are covered:
//!     |     `*               so it differs from that in the middle by no more than that
//!     |      .    `*
//!     +------m----------> column
//! ```
//!
//! A function is f = Σ Ei fi. Runs are followed from their middle m, where the Ei are known as integers.
//!
//! # Precision
//! With S = Σ Ei(m)·|fi| and ε = 2^-24, f is within (8 S + |f|)ε.
//!
//! The reason: a term of f(m) carries the rounding of Ei, of a product and of two sums, together 4ε S. A term of the
//! step carries a product and two sums, as differences of rows are exact. Over the columns from m these are 3ε S. The
//! product with the columns adds ε·|f − f(m)| <= ε S, and the sum ε·|f|.

use crate::edge::EdgeInt;
use crate::interpolation::{Oriented, Row, Values};
use alberti_math::Varying;
use alberti_math::lanes::Lanes;

/// A function that is linear on the screen.
#[derive(Clone, Copy)]
pub(crate) struct FloatPlane {
    /// The factors of the edge functions.
    factors: [f32; 3],
    /// The increment by column.
    pub(crate) across: f32,
}

impl FloatPlane {
    /// The function with these factors, where the edge functions have these increments by column.
    #[inline(always)]
    pub(crate) fn new(factors: [f32; 3], steps: [f32; 3]) -> Self {
        Self { factors, across: sum(factors, steps) }
    }

    /// The value where the edge functions are these.
    #[inline(always)]
    pub(crate) fn at(&self, edges: [f32; 3]) -> f32 {
        sum(self.factors, edges)
    }
}

#[inline(always)]
fn sum([a, b, c]: [f32; 3], [ea, eb, ec]: [f32; 3]) -> f32 {
    ea * a + eb * b + ec * c
}

/// One number of a vertex over a triangle, and the bounds of its values at the vertices.
#[derive(Clone, Copy)]
pub(crate) struct FloatComponent {
    pub(crate) plane: FloatPlane,
    least: f32,
    greatest: f32,
}

impl FloatComponent {
    /// A component of these values, in a plane with other factors.
    #[inline(always)]
    pub(crate) fn new(values: Values, plane: FloatPlane) -> Self {
        let [least, greatest] = values.range;
        Self { plane, least, greatest }
    }

    /// The number within the bounds.
    #[inline(always)]
    pub(crate) fn bounded<L: Lanes>(&self, lanes: L, number: L::Number) -> L::Number {
        lanes.min(lanes.max(number, lanes.splat(self.least)), lanes.splat(self.greatest))
    }

    /// The number of a component that is the same everywhere.
    #[inline(always)]
    pub(crate) fn constant<L: Lanes>(&self, lanes: L) -> L::Number {
        lanes.splat(self.least)
    }

    /// A component that is the same everywhere.
    #[inline(always)]
    pub(crate) fn flat(values: Values) -> Self {
        Self::new(values, FloatPlane { factors: [0.0; 3], across: 0.0 })
    }
}

/// The triangle's part in functions that are linear on the screen.
#[derive(Clone, Copy)]
pub(crate) struct Slant {
    /// 1 over the doubled area.
    pub(crate) per_area: f32,
    /// The increments of the edge functions by column: differences of rows, exactly.
    pub(crate) steps: [f32; 3],
}

impl Slant {
    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "differences are at most 2^24")]
    pub(crate) fn new<V: Varying>(triangle: &Oriented<'_, V>) -> Self {
        let [[_, a], [_, b], [_, c]] = triangle.corners;
        let one = triangle.one() as f32;
        let step = |to: i32, from: i32| (to - from) as f32 * one;
        Self { per_area: 1.0 / triangle.area(), steps: [step(b, c), step(c, a), step(a, b)] }
    }

    /// The component with these values at the vertices, within 12ε of the greatest.
    #[inline(always)]
    pub(crate) fn linear(&self, values: Values) -> FloatComponent {
        let [a, b, c] = values.corners;
        // Three roundings more: of the area, its reciprocal, and this product.
        let factors = [a * self.per_area, b * self.per_area, c * self.per_area];
        FloatComponent::new(values, FloatPlane::new(factors, self.steps))
    }
}

/// The three q of a triangle, scaled so that the greatest is near 1.
#[inline(always)]
pub(crate) fn scaled_q<V: Varying>(triangle: &Oriented<'_, V>) -> [f32; 3] {
    let [a, b, c] = triangle.vertices;
    let scale = super::exact::power_of_two_near(a.q().max(b.q()).max(c.q()));
    [a.q() * scale, b.q() * scale, c.q() * scale]
}

/// The edge functions in the middle between two covered columns.
#[inline(always)]
pub(crate) fn middle<I: EdgeInt>(row: &Row<'_, I>, [first, last]: [i32; 2]) -> [f32; 3] {
    // Steps are multiples of a pixel's subpixels, and so even.
    let halves = I::from(first + last - 2 * row.origin);
    let [a, b, c] = row.edges;
    [a, b, c].map(|e| (e.value + e.step_x.half() * halves).to_f32())
}

/// A number along a run: its value in the middle and its increment by column, the same in every lane.
#[derive(Clone, Copy)]
pub(crate) struct Ramp<L: Lanes> {
    middle: L::Number,
    step: L::Number,
}

impl<L: Lanes> Ramp<L> {
    #[inline(always)]
    pub(crate) fn new(lanes: L, middle: f32, step: f32) -> Self {
        Self { middle: lanes.splat(middle), step: lanes.splat(step) }
    }

    /// The ramp of a function, where the edge functions in the middle of a run are these.
    #[inline(always)]
    pub(crate) fn of(lanes: L, plane: &FloatPlane, edges: [f32; 3]) -> Self {
        Self::new(lanes, plane.at(edges), plane.across)
    }

    /// The number so many columns along.
    #[inline(always)]
    pub(crate) fn at(&self, along: L::Number) -> L::Number {
        self.middle + self.step * along
    }

    /// The number so many columns along, with a part that grows with their square.
    #[inline(always)]
    pub(crate) fn bent(&self, bend: L::Number, along: L::Number) -> L::Number {
        self.middle + (self.step + bend * along) * along
    }
}

/// The columns from the middle of a run to the samples from `column` on.
#[inline(always)]
pub(crate) fn along<L: Lanes>(lanes: L, [first, last]: [i32; 2], column: i32) -> L::Number {
    #[expect(clippy::cast_precision_loss, reason = "less than two runs")]
    let halves = (2 * column - first - last) as f32;
    lanes.splat(0.5 * halves) + lanes.ramp()
}

/// The lanes' number as a number.
#[inline(always)]
pub(crate) fn count<L: Lanes>(lanes: L) -> L::Number {
    #[expect(clippy::cast_precision_loss, reason = "at most 16")]
    let count = L::COUNT as f32;
    lanes.splat(count)
}
