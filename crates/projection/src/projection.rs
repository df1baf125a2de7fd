//! Projections: the steps that perspective and parallel projection share, so that a scene can be drawn through either.

use crate::clip::{EyeVertex, ProjectedVertex};
use crate::{DepthMap, Parallel, Perspective};
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
/// The steps are the same for both, in the same order: [`scale`](Self::scale), the clip against z = A and z = B,
/// [`project`](Self::project), the clip against the sides, the viewport.
pub trait Projection: Copy + Debug {
    /// The map from eye depth to screen depth.
    type Depth: Copy + Debug;

    /// The same projection for pictures of this aspect ratio, width / height, from 2^-14 to 2^14.
    #[must_use]
    fn with_aspect(self, aspect: f32) -> Self;

    /// The near plane, z = A.
    #[must_use]
    fn near(&self) -> f32;

    /// The far plane, z = B.
    #[must_use]
    fn far(&self) -> f32;

    /// The depth map of these planes: 0 at the near plane and 1 at the far one, or the other way round.
    #[must_use]
    fn depth_map(&self, reversed: bool) -> Self::Depth;

    /// Step 2: x and y are scaled so that the sides of the view are x = ±w, y = ±w, with w = z in perspective, and w =
    /// 1 in parallel projection.
    #[must_use]
    fn scale(&self, p: Point3<Eye>) -> Point3<Eye>;

    /// That w, where the sides of the view lie at depth `z`.
    #[must_use]
    fn side(&self, z: f32) -> f32;

    /// Step 4, for a scaled vertex within the near and far planes: xs = xe/w, ys = ye/w, zs in [0, 1], and q = 1/w.
    #[must_use]
    fn project<V: Varying>(&self, depth: &Self::Depth, v: &EyeVertex<V>) -> ProjectedVertex<V>;
}

impl Projection for Perspective {
    type Depth = DepthMap;

    #[inline]
    fn with_aspect(self, aspect: f32) -> Self {
        self.with_aspect(aspect)
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

    #[inline]
    fn scale(&self, p: Point3<Eye>) -> Point3<Eye> {
        self.scale(p)
    }

    #[inline]
    fn side(&self, z: f32) -> f32 {
        z
    }

    #[inline]
    fn project<V: Varying>(&self, depth: &DepthMap, v: &EyeVertex<V>) -> ProjectedVertex<V> {
        self.project(depth, v)
    }
}

/// [`Perspective`] or [`Parallel`], chosen at run time.
///
/// # Precision
/// That of the projection, whose bits it gives.
///
/// # Cost
/// A branch a vertex, for each step.
#[derive(Clone, Copy, Debug, PartialEq)]
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

    #[inline]
    fn scale(&self, p: Point3<Eye>) -> Point3<Eye> {
        either!(self, |projection| projection.scale(p))
    }

    #[inline]
    fn side(&self, z: f32) -> f32 {
        either!(self, |projection| projection.side(z))
    }

    #[inline]
    fn project<V: Varying>(&self, reversed: &bool, v: &EyeVertex<V>) -> ProjectedVertex<V> {
        either!(self, |projection| projection.project(&projection.depth_map(*reversed), v))
    }
}
