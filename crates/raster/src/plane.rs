//! Interpolation from plane equations, in each sample: hyperbolic, or without correction.

use crate::interpolation::{Interpolate, Interpolation};
use crate::planes::{Planes, Ramp, along, count};
use crate::spans::Span;
use crate::triangle::{Corners, Vertex};
use alberti_math::lanes::Lanes;
use alberti_math::{Subpixel, Varying};
use core::fmt;

/// From plane equations: q and every q·u are linear on the screen, so each is a value at the start of a run of samples
/// and a step a column, and u = (q·u)/q. The planes are set up in `f64` and evaluated in it at the start of each run, of
/// at most 64 columns, in the triangle; only what is added along a run is `f32`.
///
/// # Precision
/// With r the ratio of q at the start of a run to q at a sample of it: (6 r + 8)ε·max|ui|, and 6ε·max zs for depth; for
/// ratios in a triangle up to 2^24, beyond which the error of `f64` counts. Where q falls by half along 64 columns that
/// is 20ε, where it grows at most 14ε. The reason: q and q·u each carry the rounding of the start and of the step, of their product
/// with the columns and of the sum, which is (3 r + 3)ε relative to q; the reciprocal and the product add 2ε. The result
/// never leaves the range of the three values, so a constant stays constant bit for bit; for |ui| above 2^120, where
/// q·u may overflow, that is all that holds.
///
/// # Cost
/// A fragment: one product, one sum, one division; a component adds two products, a sum, a minimum and a maximum.
/// A triangle: one `f64` division, and about eight operations a component; a run: four a component. Without a hardware
/// `f64`, setup costs more than all fragments of a small triangle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plane;

impl Interpolation for Plane {
    type Triangle<L: Lanes, V: Varying> = PlaneTriangle<L, V>;
}

/// A triangle prepared for [`Plane`].
#[derive(Clone, Copy)]
pub struct PlaneTriangle<L: Lanes, V: Varying> {
    lanes: L,
    planes: Planes<V>,
}

/// Where samples lie in a run, and what is linear along it.
#[derive(Clone, Copy)]
pub struct PlaneCursor<L: Lanes, V: Varying> {
    along: L::F32,
    zs: Ramp<L>,
    q: [L::F32; 2],
    components: V::Of<Ramp<L>>,
}

impl<L: Lanes, V: Varying> Interpolate<Plane, L, V> for PlaneTriangle<L, V> {
    const RUN: i32 = 64;
    type Cursor = PlaneCursor<L, V>;

    #[inline(always)]
    fn new<S: Subpixel>(
        _: Plane,
        lanes: L,
        vertices: [&Vertex<S, V>; 3],
        corners: &Corners,
        doubled_area: i64,
    ) -> Self {
        Self { lanes, planes: Planes::new::<S, true>(vertices, corners, doubled_area) }
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
    fn start(&self, row: i32, run: Span, column: i32) -> PlaneCursor<L, V> {
        let Self { lanes, planes } = self;
        let place = planes.place(run.start, row);
        PlaneCursor {
            along: along(*lanes, run.start, column),
            zs: Ramp::of_plane(*lanes, &planes.zs, place),
            q: [lanes.splat(planes.q.at(place) as f32), lanes.splat(planes.q.across as f32)],
            components: V::map(&planes.components, &|c| Ramp::of_plane(*lanes, &c, place)),
        }
    }

    #[inline(always)]
    fn advance(&self, cursor: PlaneCursor<L, V>) -> PlaneCursor<L, V> {
        PlaneCursor { along: cursor.along + count(self.lanes), ..cursor }
    }

    #[inline(always)]
    fn depth(&self, cursor: &PlaneCursor<L, V>, _: &[L::F32; 3]) -> L::F32 {
        cursor.zs.at(self.lanes, cursor.along)
    }

    #[inline(always)]
    fn attributes(&self, cursor: &PlaneCursor<L, V>, _: &[L::F32; 3]) -> V::Of<L::F32> {
        let z = self.lanes.splat(1.0) / (cursor.q[0] + cursor.q[1] * cursor.along);
        V::map(&cursor.components, &|ramp: Ramp<L>| ramp.times(self.lanes, cursor.along, z))
    }
}

/// Without correction: what the vertices carry is linear on the screen.
///
/// # Precision
/// Right only where the three vertices are equally far; with r their greatest ratio of q, off by up to
/// |Δu|·(√r − 1)/(√r + 1), Δu being the difference between two vertices. Against the linear function itself: 6ε·max|ui|
/// for depth and components. The result never leaves the range of the three values, so a constant stays constant.
///
/// # Cost
/// A fragment: a product, a sum, a minimum and a maximum for each component; no division. Setup as for [`Plane`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Affine;

impl Interpolation for Affine {
    type Triangle<L: Lanes, V: Varying> = AffineTriangle<L, V>;
}

/// A triangle prepared for [`Affine`].
#[derive(Clone, Copy)]
pub struct AffineTriangle<L: Lanes, V: Varying> {
    lanes: L,
    planes: Planes<V>,
}

/// Where samples lie in a run in which all is linear.
#[derive(Clone, Copy)]
pub struct LinearCursor<L: Lanes, V: Varying> {
    pub(crate) along: L::F32,
    pub(crate) zs: Ramp<L>,
    pub(crate) components: V::Of<Ramp<L>>,
}

impl<L: Lanes, V: Varying> LinearCursor<L, V> {
    #[inline(always)]
    pub(crate) fn attributes(&self, lanes: L) -> V::Of<L::F32> {
        V::map(&self.components, &|ramp: Ramp<L>| ramp.at(lanes, self.along))
    }
}

impl<L: Lanes, V: Varying> Interpolate<Affine, L, V> for AffineTriangle<L, V> {
    const RUN: i32 = 64;
    type Cursor = LinearCursor<L, V>;

    #[inline(always)]
    fn new<S: Subpixel>(
        _: Affine,
        lanes: L,
        vertices: [&Vertex<S, V>; 3],
        corners: &Corners,
        doubled_area: i64,
    ) -> Self {
        Self { lanes, planes: Planes::new::<S, false>(vertices, corners, doubled_area) }
    }

    #[inline(always)]
    fn start(&self, row: i32, run: Span, column: i32) -> LinearCursor<L, V> {
        let Self { lanes, planes } = self;
        let place = planes.place(run.start, row);
        LinearCursor {
            along: along(*lanes, run.start, column),
            zs: Ramp::of_plane(*lanes, &planes.zs, place),
            components: V::map(&planes.components, &|c| Ramp::of_plane(*lanes, &c, place)),
        }
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

macro_rules! opaque {
    ($($name:ident)*) => {$(
        impl<L: Lanes, V: Varying> fmt::Debug for $name<L, V> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_struct(stringify!($name)).finish_non_exhaustive()
            }
        }
    )*};
}
opaque!(PlaneTriangle PlaneCursor AffineTriangle LinearCursor);
