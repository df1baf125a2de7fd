//! Interpolation that is exact every so many columns, and linear between.

use crate::interpolation::{Interpolate, Interpolation};
use crate::plane::LinearCursor;
use crate::planes::{Component, Planes, Ramp, along, count};
use crate::spans::Span;
use crate::triangle::{Corners, Vertex};
use alberti_math::lanes::Lanes;
use alberti_math::{Subpixel, Varying};
use core::fmt;

/// Exact at a row's first and last sample and at every column that is a multiple of `N`, a power of two up to 64; linear
/// between two of those.
///
/// # Precision
/// With r >= 1 the ratio of q at two such columns, and Δu the difference of u there: |Δu|·(√r − 1)/(√r + 1) + 6ε·max|ui|.
/// The first term is what the straight line misses, and is reached; the second is rounding.
///
/// # Cost
/// A fragment: a product, a sum, a minimum and a maximum for each component; no division. Every `N` columns: three `f64`
/// divisions, and about ten operations a component.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spans<const N: i32>;

impl<const N: i32> Interpolation for Spans<N> {
    type Triangle<L: Lanes, V: Varying> = SubdividedTriangle<L, V>;
}

/// A triangle prepared for [`Spans`].
#[derive(Clone, Copy)]
pub struct SubdividedTriangle<L: Lanes, V: Varying> {
    lanes: L,
    planes: Planes<V>,
}

impl<L: Lanes, V: Varying> SubdividedTriangle<L, V> {
    /// The line from the first to the last sample of a run.
    #[inline(always)]
    fn line(&self, row: i32, run: Span, column: i32) -> LinearCursor<L, V> {
        let Self { lanes, planes } = self;
        let [from, to] = [planes.place(run.start, row), planes.place(run.end, row)];
        let [z_from, z_to] = [1.0 / planes.q.at(from), 1.0 / planes.q.at(to)];
        // A run of a single sample has no step.
        let per_column = 1.0 / f64::from((run.end - run.start).max(1));
        LinearCursor {
            along: along(*lanes, run.start, column),
            zs: Ramp::of_plane(*lanes, &planes.zs, from),
            components: V::map(&planes.components, &|c: Component| {
                let [start, end] = [c.plane.at(from) * z_from, c.plane.at(to) * z_to];
                #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
                let (start, step) = (start as f32, ((end - start) * per_column) as f32);
                Ramp::new(*lanes, start, step, &c)
            }),
        }
    }
}

impl<const N: i32, L: Lanes, V: Varying> Interpolate<Spans<N>, L, V> for SubdividedTriangle<L, V> {
    const RUN: i32 = {
        assert!(N.count_ones() == 1 && 0 < N && N <= 64, "Spans<N>: N must be a power of two up to 64");
        N
    };
    type Cursor = LinearCursor<L, V>;

    #[inline(always)]
    fn new<S: Subpixel>(
        _: Spans<N>,
        lanes: L,
        vertices: [&Vertex<S, V>; 3],
        corners: &Corners,
        doubled_area: i64,
    ) -> Self {
        Self { lanes, planes: Planes::new::<S, true>(vertices, corners, doubled_area) }
    }

    #[inline(always)]
    fn start(&self, row: i32, run: Span, column: i32) -> LinearCursor<L, V> {
        self.line(row, run, column)
    }

    #[inline(always)]
    fn advance(&self, cursor: LinearCursor<L, V>) -> LinearCursor<L, V> {
        LinearCursor { along: cursor.along + count(self.lanes), ..cursor }
    }

    #[inline(always)]
    fn depth(&self, cursor: &LinearCursor<L, V>, _: &[L::F32; 3]) -> L::F32 {
        cursor.zs.at(self.lanes, cursor.along)
    }

    #[inline(always)]
    fn attributes(&self, cursor: &LinearCursor<L, V>, _: &[L::F32; 3]) -> V::Of<L::F32> {
        cursor.attributes(self.lanes)
    }
}

impl<L: Lanes, V: Varying> fmt::Debug for SubdividedTriangle<L, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SubdividedTriangle").finish_non_exhaustive()
    }
}
