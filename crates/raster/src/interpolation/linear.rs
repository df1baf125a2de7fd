//! Functions that are linear in the weights of a triangle's vertices, in `f64`, and their values along a run of
//! samples.

use crate::interpolation::Oriented;
use alberti_math::lanes::Lanes;
use alberti_math::{Varying, hull3};

/// A function that is linear on the screen.
#[derive(Clone, Copy)]
pub(crate) struct FloatPlane {
    /// The value at the first vertex, and the excess of the second and the third.
    first: f64,
    more: [f64; 2],
}

impl FloatPlane {
    #[inline(always)]
    pub(crate) fn new([a, b, c]: [f64; 3]) -> Self {
        Self { first: a, more: [b - a, c - a] }
    }

    /// The value where the second and the third vertex have these weights. In the triangle nothing cancels, so the
    /// error is a few units of 2^-53 of the greatest value.
    #[inline(always)]
    pub(crate) fn at(&self, weights: [f64; 2]) -> f64 {
        self.first + self.more(weights)
    }

    /// The excess where the weights are greater by these.
    #[inline(always)]
    pub(crate) fn more(&self, [b, c]: [f64; 2]) -> f64 {
        self.more[0] * b + self.more[1] * c
    }
}

/// One number of a vertex over a triangle, and the bounds of its values at the vertices.
#[derive(Clone, Copy)]
pub(crate) struct FloatComponent {
    pub(crate) plane: FloatPlane,
    pub(crate) least: f32,
    pub(crate) greatest: f32,
}

impl FloatComponent {
    #[inline(always)]
    pub(crate) fn new(values: [f32; 3]) -> Self {
        let [least, greatest] = hull3(values);
        Self { plane: FloatPlane::new(values.map(f64::from)), least, greatest }
    }

    /// A component that is the same everywhere.
    #[inline(always)]
    pub(crate) fn flat(value: f32) -> Self {
        Self::new([value; 3])
    }
}

/// The three q of a triangle, scaled so that the greatest is near 1.
#[inline(always)]
pub(crate) fn scaled_q<V: Varying>(triangle: &Oriented<'_, V>) -> [f64; 3] {
    let [a, b, c] = triangle.vertices;
    let scale = super::exact::power_of_two_near(a.q().max(b.q()).max(c.q()));
    [f64::from(a.q() * scale), f64::from(b.q() * scale), f64::from(c.q() * scale)]
}

/// The three screen depths.
#[inline(always)]
pub(crate) fn zs<V: Varying>(triangle: &Oriented<'_, V>) -> FloatComponent {
    let [a, b, c] = triangle.vertices;
    FloatComponent::new([a.zs(), b.zs(), c.zs()])
}

/// 1 over the doubled area.
#[inline(always)]
pub(crate) fn per_area<V: Varying>(triangle: &Oriented<'_, V>) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    let area = triangle.doubled_area as f64;
    1.0 / area
}

/// A number along a run: its start, its increment by column, and its bounds, the same in every lane.
#[derive(Clone, Copy)]
pub(crate) struct Ramp<L: Lanes> {
    start: L::Number,
    step: L::Number,
    least: L::Number,
    greatest: L::Number,
}

impl<L: Lanes> Ramp<L> {
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
    pub(crate) fn new(lanes: L, start: f64, step: f64, component: &FloatComponent) -> Self {
        Self {
            start: lanes.splat(start as f32),
            step: lanes.splat(step as f32),
            least: lanes.splat(component.least),
            greatest: lanes.splat(component.greatest),
        }
    }

    /// The number so many columns along, times `factor`, within the bounds.
    #[inline(always)]
    pub(crate) fn times(&self, lanes: L, along: L::Number, factor: L::Number) -> L::Number {
        let value = (self.start + self.step * along) * factor;
        lanes.min(lanes.max(value, self.least), self.greatest)
    }

    /// The number so many columns along, within the bounds.
    #[inline(always)]
    pub(crate) fn at(&self, lanes: L, along: L::Number) -> L::Number {
        lanes.min(lanes.max(self.start + self.step * along, self.least), self.greatest)
    }

    /// The number at the start.
    #[inline(always)]
    pub(crate) fn start(&self) -> L::Number {
        self.start
    }
}

/// The columns from `first` to the samples from `column` on.
#[inline(always)]
pub(crate) fn along<L: Lanes>(lanes: L, first: i32, column: i32) -> L::Number {
    #[expect(clippy::cast_precision_loss, reason = "less than a run")]
    let columns = (column - first) as f32;
    lanes.splat(columns) + lanes.ramp()
}

/// The lanes' number as a number.
#[inline(always)]
pub(crate) fn count<L: Lanes>(lanes: L) -> L::Number {
    #[expect(clippy::cast_precision_loss, reason = "at most 8")]
    let count = L::COUNT as f32;
    lanes.splat(count)
}
