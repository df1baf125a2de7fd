//! Projections: the steps that perspective and parallel projection share, so that a scene can be drawn through either.

use crate::clip::{EyeVertex, ProjectedVertex};
use crate::{DepthMap, Parallel, Perspective};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Eye, Point3, Varying};
use core::fmt::Debug;

/// A map from eye space to the cube: [`Perspective`] or [`Parallel`], or [`AnyProjection`] for one that is chosen at
/// run time.
///
/// ```text
///   Perspective                     Parallel
///        A          __--B             A-----------B
///      __|------''''    |             |           |
///  eye  -|- - - - - - - | z   eye  - -|- - - - - -|- z     the eye may also lie between the planes, or beyond
///        '------...     |             |           |
///        |          ''--|             '-----------'
/// ```
///
/// The steps are the same for both, in the same order: [`scale_lanes`](Self::scale_lanes), the clip against z = A
/// and z = B, [`project_lanes`](Self::project_lanes), the clip against the sides, the viewport.
pub trait Projection: Copy + Debug + Send + Sync {
    /// The map from eye depth to screen depth.
    type Depth: Copy + Debug + Send + Sync;

    /// The same projection for pictures of this aspect ratio, width / height, from 2^-14 to 2^14.
    #[must_use]
    fn with_aspect(self, aspect: f32) -> Self;

    /// Whether it has a vanishing point: w is z and zs a function of 1/z. Otherwise w is 1, and zs a function of z.
    #[must_use]
    fn is_perspective(&self) -> bool;

    /// The near plane, z = A.
    #[must_use]
    fn near(&self) -> f32;

    /// The far plane, z = B.
    #[must_use]
    fn far(&self) -> f32;

    /// The depth map of these planes: 0 at the near plane and 1 at the far one, or the other way round.
    #[must_use]
    fn depth_map(&self, reversed: bool) -> Self::Depth;

    /// Step 2 for several points: x and y are scaled so that the sides of the view are x = ±w, y = ±w. In perspective w
    /// is z, in parallel projection 1.
    #[must_use]
    fn scale_lanes<L: Lanes>(&self, lanes: L, p: [L::Number; 3]) -> [L::Number; 3];

    /// That w, where the sides of the view lie at depth `z`.
    #[must_use]
    fn side_lanes<L: Lanes>(&self, lanes: L, z: L::Number) -> L::Number;

    /// Step 4 for several scaled points within the near and far planes: xs = xe/w, ys = ye/w, zs in [0, 1], and q =
    /// 1/w. Of other points the results have no meaning.
    #[must_use]
    fn project_lanes<L: Lanes>(&self, lanes: L, depth: &Self::Depth, p: [L::Number; 3]) -> [L::Number; 4];

    /// [`scale_lanes`](Self::scale_lanes) of one point.
    #[must_use]
    #[inline]
    fn scale(&self, p: Point3<Eye>) -> Point3<Eye> {
        Point3::new(self.scale_lanes(One, p.coords.to_array()).into())
    }

    /// [`project_lanes`](Self::project_lanes) of one vertex.
    #[must_use]
    #[inline]
    fn project<V: Varying>(&self, depth: &Self::Depth, v: &EyeVertex<V>) -> ProjectedVertex<V> {
        let [x, y, zs, q] = self.project_lanes(One, depth, v.position.coords.to_array());
        ProjectedVertex { x, y, zs, q, varying: v.varying }
    }
}

impl Projection for Perspective {
    type Depth = DepthMap;

    #[inline]
    fn with_aspect(self, aspect: f32) -> Self {
        self.with_aspect(aspect)
    }

    #[inline]
    fn is_perspective(&self) -> bool {
        true
    }

    #[inline]
    fn near(&self) -> f32 {
        self.near()
    }

    #[inline]
    fn far(&self) -> f32 {
        self.far()
    }

    #[inline]
    fn depth_map(&self, reversed: bool) -> DepthMap {
        self.depth_map(reversed)
    }

    #[inline(always)]
    fn scale_lanes<L: Lanes>(&self, lanes: L, [x, y, z]: [L::Number; 3]) -> [L::Number; 3] {
        let [scale_x, scale_y] = self.scales();
        [x * lanes.splat(scale_x), y * lanes.splat(scale_y), z]
    }

    #[inline(always)]
    fn side_lanes<L: Lanes>(&self, _: L, z: L::Number) -> L::Number {
        z
    }

    #[inline(always)]
    fn project_lanes<L: Lanes>(
        &self,
        lanes: L,
        depth: &DepthMap,
        [x, y, z]: [L::Number; 3],
    ) -> [L::Number; 4] {
        [x / z, y / z, depth.zs_lanes(lanes, z), lanes.splat(1.0) / z]
    }
}

/// [`Perspective`] or [`Parallel`], chosen at run time.
///
/// # Precision
/// That of the projection, whose bits it gives.
///
/// # Cost
/// A branch for each step, for the vertices that are worked on together.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyProjection {
    /// A projection with a vanishing point.
    Perspective(Perspective),
    /// One without.
    Parallel(Parallel),
}

impl From<Perspective> for AnyProjection {
    fn from(projection: Perspective) -> Self {
        Self::Perspective(projection)
    }
}

impl From<Parallel> for AnyProjection {
    fn from(projection: Parallel) -> Self {
        Self::Parallel(projection)
    }
}

/// An expression over either projection.
macro_rules! either {
    ($any:expr, |$projection:ident| $body:expr) => {
        match $any {
            AnyProjection::Perspective($projection) => $body,
            AnyProjection::Parallel($projection) => $body,
        }
    };
}

impl Projection for AnyProjection {
    /// Whether it is reversed.
    type Depth = bool;

    fn with_aspect(self, aspect: f32) -> Self {
        either!(self, |projection| projection.with_aspect(aspect).into())
    }

    #[inline]
    fn is_perspective(&self) -> bool {
        either!(self, |projection| projection.is_perspective())
    }

    #[inline]
    fn near(&self) -> f32 {
        either!(self, |projection| projection.near())
    }

    #[inline]
    fn far(&self) -> f32 {
        either!(self, |projection| projection.far())
    }

    #[inline]
    fn depth_map(&self, reversed: bool) -> bool {
        reversed
    }

    #[inline(always)]
    fn scale_lanes<L: Lanes>(&self, lanes: L, p: [L::Number; 3]) -> [L::Number; 3] {
        either!(self, |projection| projection.scale_lanes(lanes, p))
    }

    #[inline(always)]
    fn side_lanes<L: Lanes>(&self, lanes: L, z: L::Number) -> L::Number {
        either!(self, |projection| projection.side_lanes(lanes, z))
    }

    #[inline(always)]
    fn project_lanes<L: Lanes>(&self, lanes: L, reversed: &bool, p: [L::Number; 3]) -> [L::Number; 4] {
        either!(self, |projection| projection.project_lanes(lanes, &projection.depth_map(*reversed), p))
    }
}
