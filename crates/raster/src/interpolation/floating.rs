//! Lines in `f32`: of components that are linear on the screen by their slopes, of others between two ends.

use super::linear::{FloatComponent, FloatPlane, Ramp, Slant, along, count, middle, scaled_q};
use super::lines::{Affine, LineNumbers, LineTriangle, Lines, Run, Runs, Spans16};
use crate::edge::EdgeInt;
use crate::interpolation::{Interpolation, Oriented, Prepare, Row, Values};
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Mode, Varying};
use core::cell::Cell;
use core::fmt;

/// A triangle's depth, q and components.
#[derive(Clone, Copy)]
pub struct FloatingLines<L: Lanes, V: Varying> {
    lanes: L,
    q: [f32; 3],
    zs: FloatComponent,
    /// With perspective the factors of hyperbolic ones are their values.
    components: V::Of<FloatComponent>,
}

impl<L: Floating, V: Varying> FloatingLines<L, V> {
    #[inline(always)]
    pub(crate) fn new(lanes: L, perspective: bool, triangle: &Oriented<'_, V>) -> Self {
        let slant = Slant::new(triangle);
        Self {
            lanes,
            q: if perspective { scaled_q(triangle) } else { [1.0; 3] },
            zs: slant.linear(triangle.depths()),
            components: V::map_by_mode(&triangle.values(), &|mode, values: Values| match mode {
                Mode::Hyperbolic if perspective => {
                    FloatComponent::new(values, FloatPlane::new(values.corners, [0.0; 3]))
                }
                Mode::Hyperbolic | Mode::Linear => slant.linear(values),
                Mode::Flat => FloatComponent::flat(values),
            }),
        }
    }
}

/// The values at both ends of a run, of what is hyperbolic.
#[derive(Clone, Copy)]
pub struct FloatingEnds<V: Varying> {
    q: [f32; 2],
    components: V::Of<[f32; 2]>,
}

/// The place of samples in a run, and the numbers that are linear along it.
#[derive(Clone, Copy)]
pub struct FloatingCursor<L: Lanes, V: Varying> {
    along: L::Number,
    zs: Ramp<L>,
    components: V::Of<Ramp<L>>,
}

impl<L: Floating, V: Varying> LineNumbers<L, V> for FloatingLines<L, V> {
    type Row = ();
    type Ends = FloatingEnds<V>;
    type Cursor = FloatingCursor<L, V>;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, _: bool, _: &Row<'_, I>) {}

    #[inline(always)]
    fn begin<I: EdgeInt>(
        &self,
        perspective: bool,
        row: &Row<'_, I>,
        (): &(),
        column: i32,
    ) -> FloatingEnds<V> {
        let components = V::map(&self.components, &|_: FloatComponent| [0.0; 2]);
        let nothing = FloatingEnds { q: [0.0; 2], components };
        let FloatingEnds { q: [_, q], components } = self.extend(perspective, row, &(), &nothing, column);
        FloatingEnds { q: [q; 2], components: V::map(&components, &|[_, value]: [f32; 2]| [value; 2]) }
    }

    #[inline(always)]
    fn extend<I: EdgeInt>(
        &self,
        perspective: bool,
        row: &Row<'_, I>,
        (): &(),
        ends: &FloatingEnds<V>,
        column: i32,
    ) -> FloatingEnds<V> {
        if !perspective {
            return *ends;
        }
        let [ea, eb, ec] = row.at(column).map(I::to_f32);
        let [qa, qb, qc] = self.q;
        let [ta, tb, tc] = [ea * qa, eb * qb, ec * qc];
        let q = ta + tb + tc;
        let per_q = 1.0 / q;
        let weights = [ta * per_q, tb * per_q, tc * per_q];
        FloatingEnds {
            q: [ends.q[1], q],
            components: V::map_by_mode(&V::zip(&self.components, &ends.components), &|mode, pair| {
                let (component, [_, start]): (FloatComponent, [f32; 2]) = pair;
                if mode == Mode::Hyperbolic { [start, component.plane.at(weights)] } else { [0.0; 2] }
            }),
        }
    }

    #[inline(always)]
    fn within(&self, (): &(), ends: &FloatingEnds<V>, _: [i32; 2], budget: f32) -> bool {
        // Rounding may favour a line by a few ε.
        const ROUNDED: f32 = 1.0 - 8.0 * f32::EPSILON;
        let [q0, q1] = ends.q;
        let [low, high] = if q0 < q1 { [q0, q1] } else { [q1, q0] };
        let (apart, limit) = (high - low, budget * ROUNDED * (high + 3.0 * low));
        let within = Cell::new(true);
        let _ = V::map_by_mode(&ends.components, &|mode, [start, end]: [f32; 2]| {
            within.set(within.get() & (mode != Mode::Hyperbolic || (end - start).abs() * apart <= limit));
        });
        within.get()
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "at most 64 columns")]
    fn line<I: EdgeInt>(
        &self,
        perspective: bool,
        row: &Row<'_, I>,
        (): &(),
        run: &Run<FloatingEnds<V>>,
        [_, aligned]: [i32; 2],
    ) -> FloatingCursor<L, V> {
        let [first, last] = run.columns;
        let (lanes, edges) = (self.lanes, middle(row, run.columns));
        // A run of a single sample has no step.
        let per_column = 1.0 / (last - first).max(1) as f32;
        FloatingCursor {
            along: along(lanes, run.columns, aligned),
            zs: Ramp::of(lanes, &self.zs.plane, edges),
            components: V::map_by_mode(&V::zip(&self.components, &run.ends.components), &|mode, pair| {
                let (component, [start, end]): (FloatComponent, [f32; 2]) = pair;
                if perspective && mode == Mode::Hyperbolic {
                    Ramp::new(lanes, 0.5 * (start + end), (end - start) * per_column)
                } else {
                    Ramp::of(lanes, &component.plane, edges)
                }
            }),
        }
    }

    #[inline(always)]
    fn advance(&self, cursor: FloatingCursor<L, V>) -> FloatingCursor<L, V> {
        FloatingCursor { along: cursor.along + count(self.lanes), ..cursor }
    }

    #[inline(always)]
    fn depth(&self, cursor: &FloatingCursor<L, V>) -> L::Number {
        self.zs.bounded(self.lanes, cursor.zs.at(cursor.along))
    }

    #[inline(always)]
    fn attributes(&self, cursor: &FloatingCursor<L, V>) -> V::Of<L::Number> {
        V::map_by_mode(&V::zip(&self.components, &cursor.components), &|mode, pair| {
            let (component, ramp): (FloatComponent, Ramp<L>) = pair;
            match mode {
                Mode::Hyperbolic | Mode::Linear => component.bounded(self.lanes, ramp.at(cursor.along)),
                Mode::Flat => component.constant(self.lanes),
            }
        })
    }
}

macro_rules! interpolations {
    ($($runs:ty)*) => {$(
        impl Interpolation for $runs {}

        impl Prepare for $runs {
            type Lanes<L: Floating> = L;
            type Triangle<L: Floating, V: Varying> = LineTriangle<Self, FloatingLines<L, V>>;
            const WIDE: bool = false;

            #[inline(always)]
            fn run(self) -> i32 {
                one_run(self)
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
            ) -> LineTriangle<Self, FloatingLines<L, V>> {
                let perspective = self.perspective();
                LineTriangle { runs: self, numbers: FloatingLines::new(lanes, perspective, triangle) }
            }
        }
    )*};
}
interpolations!(Spans16 Affine Lines);

/// The length of all runs, or 1 if there is none such, see [`Interpolation::run`].
#[inline(always)]
pub(super) fn one_run(runs: impl Runs) -> i32 {
    if runs.budget().is_some() { 1 } else { runs.length() }
}

impl<L: Lanes, V: Varying> fmt::Debug for FloatingLines<L, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FloatingLines").finish_non_exhaustive()
    }
}

impl<L: Lanes, V: Varying> fmt::Debug for FloatingCursor<L, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FloatingCursor").finish_non_exhaustive()
    }
}

impl<V: Varying> fmt::Debug for FloatingEnds<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FloatingEnds").finish_non_exhaustive()
    }
}
