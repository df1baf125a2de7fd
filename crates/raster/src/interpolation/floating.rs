//! Lines in `f32`, between ends in `f64`.

use super::linear::{FloatComponent, Ramp, along, count, per_area, scaled_q, zs};
use super::lines::{Affine, LineNumbers, LineTriangle, Lines, Run, Runs, Spans16};
use crate::edge::EdgeInt;
use crate::interpolation::{Interpolation, Oriented, Prepare, Row};
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Mode, Varying};
use core::cell::Cell;
use core::fmt;

/// A triangle's depth, q and components, in `f64`.
#[derive(Clone, Copy)]
pub struct FloatingLines<L: Lanes, V: Varying> {
    lanes: L,
    per_area: f64,
    q: [f64; 3],
    zs: FloatComponent,
    components: V::Of<FloatComponent>,
}

impl<L: Floating, V: Varying> FloatingLines<L, V> {
    #[inline(always)]
    pub(crate) fn new(lanes: L, triangle: &Oriented<'_, V>) -> Self {
        Self {
            lanes,
            per_area: per_area(triangle),
            q: scaled_q(triangle),
            zs: zs(triangle),
            components: V::map_by_mode(&triangle.values(), &|mode, [a, b, c, first]: [f32; 4]| match mode {
                Mode::Hyperbolic | Mode::Linear => FloatComponent::new([a, b, c]),
                Mode::Flat => FloatComponent::flat(first),
            }),
        }
    }
}

/// The values at both ends of a run.
#[derive(Clone, Copy)]
pub struct FloatingEnds<V: Varying> {
    zs: [f64; 2],
    q: [f64; 2],
    components: V::Of<[f64; 2]>,
}

impl<L: Lanes, V: Varying> FloatingLines<L, V> {
    /// Two pairs of weights, and q, at a sample with these edge functions. The weights are those of the second and the
    /// third vertex: for functions that are linear on the screen, and for those that are so in space.
    #[inline(always)]
    fn at<I: EdgeInt>(&self, perspective: bool, edges: [I; 3]) -> ([f64; 2], [f64; 2], f64) {
        let [a, b, c] = [edges[0].to_f64(), edges[1].to_f64(), edges[2].to_f64()];
        let screen = [b * self.per_area, c * self.per_area];
        if !perspective {
            return (screen, screen, 1.0);
        }
        let [qa, qb, qc] = self.q;
        let [a, b, c] = [a * qa, b * qb, c * qc];
        let q = a + b + c;
        let per_q = 1.0 / q;
        (screen, [b * per_q, c * per_q], q)
    }
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
        let (screen, space, q) = self.at(perspective, row.at(column));
        FloatingEnds {
            zs: [self.zs.plane.at(screen); 2],
            q: [q; 2],
            components: V::map_by_mode(&self.components, &|mode, component: FloatComponent| {
                [component.plane.at(if mode == Mode::Hyperbolic { space } else { screen }); 2]
            }),
        }
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
        let (screen, space, q) = self.at(perspective, row.at(column));
        FloatingEnds {
            zs: [ends.zs[1], self.zs.plane.at(screen)],
            q: [ends.q[1], q],
            components: V::map_by_mode(&V::zip(&self.components, &ends.components), &|mode, pair| {
                let (component, [_, start]): (FloatComponent, [f64; 2]) = pair;
                [start, component.plane.at(if mode == Mode::Hyperbolic { space } else { screen })]
            }),
        }
    }

    #[inline(always)]
    fn within(&self, (): &(), ends: &FloatingEnds<V>, _: [i32; 2], budget: f32) -> bool {
        let [q0, q1] = ends.q;
        let (apart, limit) = ((q1 - q0).abs(), f64::from(budget) * (q0.max(q1) + 3.0 * q0.min(q1)));
        let within = Cell::new(true);
        let _ = V::map_by_mode(&ends.components, &|mode, [start, end]: [f64; 2]| {
            within.set(within.get() & (mode != Mode::Hyperbolic || (end - start).abs() * apart <= limit));
        });
        within.get()
    }

    #[inline(always)]
    fn line(&self, (): &(), run: &Run<FloatingEnds<V>>, _: i32, aligned: i32) -> FloatingCursor<L, V> {
        let [first, last] = run.columns;
        // A run of a single sample has no step.
        let per_column = 1.0 / f64::from((last - first).max(1));
        let ramp = |component: &FloatComponent, [start, end]: [f64; 2]| {
            Ramp::new(self.lanes, start, (end - start) * per_column, component)
        };
        FloatingCursor {
            along: along(self.lanes, first, aligned),
            zs: ramp(&self.zs, run.ends.zs),
            components: V::map(&V::zip(&self.components, &run.ends.components), &|pair| {
                let (component, ends): (FloatComponent, [f64; 2]) = pair;
                ramp(&component, ends)
            }),
        }
    }

    #[inline(always)]
    fn advance(&self, cursor: FloatingCursor<L, V>) -> FloatingCursor<L, V> {
        FloatingCursor { along: cursor.along + count(self.lanes), ..cursor }
    }

    #[inline(always)]
    fn depth(&self, cursor: &FloatingCursor<L, V>) -> L::Number {
        cursor.zs.at(self.lanes, cursor.along)
    }

    #[inline(always)]
    fn attributes(&self, cursor: &FloatingCursor<L, V>) -> V::Of<L::Number> {
        V::map_by_mode(&cursor.components, &|mode, ramp: Ramp<L>| match mode {
            Mode::Hyperbolic | Mode::Linear => ramp.at(self.lanes, cursor.along),
            Mode::Flat => ramp.start(),
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
                LineTriangle { runs: self, numbers: FloatingLines::new(lanes, triangle) }
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
