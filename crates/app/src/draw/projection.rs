//! Both projections as one type whose value is chosen at run time, so that the kernels over it are compiled once for
//! both. Which one it is gets asked for each vertex; the bits are those of the library's own.

use alberti::projection::{EyeVertex, ProjectedVertex};
use alberti::{Eye, Parallel, Perspective, Point3, Projection, Varying};

/// A projection.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Either {
    Perspective(Perspective),
    Parallel(Parallel),
}

/// What both have, of the one that it is.
macro_rules! of_either {
    ($either:expr, |$projection:ident| $body:expr) => {
        match $either {
            Either::Perspective($projection) => $body,
            Either::Parallel($projection) => $body,
        }
    };
}

impl Projection for Either {
    /// Whether it is reversed.
    type Depth = bool;

    fn near(&self) -> f32 {
        of_either!(self, |projection| projection.near())
    }

    fn far(&self) -> f32 {
        of_either!(self, |projection| projection.far())
    }

    fn depth_map(&self, reversed: bool) -> bool {
        reversed
    }

    fn scale(&self, p: Point3<Eye>) -> Point3<Eye> {
        of_either!(self, |projection| projection.scale(p))
    }

    fn side(&self, z: f32) -> f32 {
        of_either!(self, |projection| projection.side(z))
    }

    fn project<V: Varying>(&self, reversed: &bool, v: &EyeVertex<V>) -> ProjectedVertex<V> {
        of_either!(self, |projection| projection.project(&projection.depth_map(*reversed), v))
    }
}
