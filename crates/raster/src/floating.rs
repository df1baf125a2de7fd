//! Lines in `f32`, between ends in `f64`.

use crate::depth::DepthFormat;
use crate::edge::EdgeInt;
use crate::interpolation::{Interpolation, Oriented};
use crate::lines::{Affine, Bounded, LineTriangle, Lines, Numbers, Run, Spans, Subdivision};
use crate::planes::{Component, Plane3, Ramp, along, count, per_area, scaled_q, zs};
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Mode, Subpixel, Varying};
use core::cell::Cell;
use core::fmt;

/// What is interpolated over a triangle, in `f64`.
#[derive(Clone, Copy)]
pub struct FloatingLines<L: Lanes, V: Varying> {
    lanes: L,
    per_area: f64,
    q: [f64; 3],
    zs: Component,
    components: V::Of<Component>,
}

impl<L: Floating, V: Varying> FloatingLines<L, V> {
    #[inline(always)]
    pub(crate) fn new<S: Subpixel>(lanes: L, triangle: &Oriented<'_, S, V>) -> Self {
        Self {
            lanes,
            per_area: per_area(triangle),
            q: scaled_q(triangle),
            zs: zs(triangle),
            components: V::map_by_mode(&triangle.values(), &|mode, [a, b, c, first]: [f32; 4]| match mode {
                Mode::Hyperbolic | Mode::Linear => Component::new([a, b, c]),
                Mode::Flat => Component::flat(first),
            }),
        }
    }
}

/// A sample at which all is known.
#[derive(Clone, Copy, Debug)]
pub struct FloatingEnd {
    /// The weights of the second and the third vertex, for what is linear on the screen, and for what is so in space.
    screen: [f64; 2],
    space: [f64; 2],
    q: f64,
}

impl FloatingEnd {
    #[inline(always)]
    fn of(&self, mode: Mode, plane: &Plane3) -> f64 {
        plane.at(if mode == Mode::Hyperbolic { self.space } else { self.screen })
    }
}

impl<L: Lanes, V: Varying> Numbers for FloatingLines<L, V> {
    type End = FloatingEnd;

    #[inline(always)]
    fn end<I: EdgeInt, const HYPERBOLIC: bool>(&self, edges: [I; 3]) -> FloatingEnd {
        let [a, b, c] = [edges[0].to_f64(), edges[1].to_f64(), edges[2].to_f64()];
        let screen = [b * self.per_area, c * self.per_area];
        if !HYPERBOLIC {
            return FloatingEnd { screen, space: screen, q: 1.0 };
        }
        let [qa, qb, qc] = self.q;
        let [a, b, c] = [a * qa, b * qb, c * qc];
        let q = a + b + c;
        let per_q = 1.0 / q;
        FloatingEnd { screen, space: [b * per_q, c * per_q], q }
    }

    #[inline(always)]
    fn within(&self, [from, to]: &[FloatingEnd; 2], budget: f32) -> bool {
        let limit = f64::from(budget) * (from.q.max(to.q) + 3.0 * from.q.min(to.q));
        let apart = (to.q - from.q).abs();
        let within = Cell::new(true);
        let _ = V::map_by_mode(&self.components, &|mode, c: Component| {
            let more = to.of(mode, &c.plane) - from.of(mode, &c.plane);
            within.set(within.get() & (mode != Mode::Hyperbolic || more.abs() * apart <= limit));
        });
        within.get()
    }
}

/// Where samples lie in a run in which all is linear.
#[derive(Clone, Copy)]
pub struct FloatingCursor<L: Lanes, V: Varying> {
    along: L::Number,
    zs: Ramp<L>,
    components: V::Of<Ramp<L>>,
}

impl<L: Floating, V: Varying> Lines<L, V> for FloatingLines<L, V> {
    type Cursor = FloatingCursor<L, V>;

    #[inline(always)]
    fn line(&self, run: &Run<FloatingEnd>, _: i32, left: i32) -> FloatingCursor<L, V> {
        let ([first, last], [from, to]) = (run.columns, run.ends);
        // A run of a single sample has no step.
        let per_column = 1.0 / f64::from((last - first).max(1));
        let ramp = |mode, c: Component| {
            let [start, end] = [from.of(mode, &c.plane), to.of(mode, &c.plane)];
            Ramp::new(self.lanes, start, (end - start) * per_column, &c)
        };
        FloatingCursor {
            along: along(self.lanes, first, left),
            zs: ramp(Mode::Linear, self.zs),
            components: V::map_by_mode(&self.components, &ramp),
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
    ($(($($parameters:tt)*) $policy:ty;)*) => {$(
        impl<$($parameters)*> Interpolation for $policy {
            type Lanes<L: Floating> = L;
            type Triangle<L: Floating, V: Varying> = LineTriangle<Self, FloatingLines<L, V>>;
            const RUN: i32 = <Self as Subdivision>::RUN;

            #[inline(always)]
            fn lanes<L: Floating>(lanes: L) -> L {
                lanes
            }

            #[inline(always)]
            fn prepare<L: Floating, S: Subpixel, D: DepthFormat, V: Varying>(
                self,
                lanes: L,
                triangle: &Oriented<'_, S, V>,
            ) -> LineTriangle<Self, FloatingLines<L, V>> {
                LineTriangle { policy: self, numbers: FloatingLines::new(lanes, triangle) }
            }
        }
    )*};
}
interpolations! {
    (const N: i32) Spans<N>;
    () Bounded;
    () Affine;
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
