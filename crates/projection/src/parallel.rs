//! Parallel projection: steps 2 and 4 without a vanishing point.

use crate::{Projection, ViewError};
use alberti_math::lanes::{Lanes, One};

/// A box of view, seen from infinitely far: parallels stay parallel, and size does not tell distance.
///
/// ```
/// use alberti_math::{Point3, glam::Vec3};
/// use alberti_projection::{EyeVertex, Parallel, Projection};
///
/// // Two units high, three wide, from one unit behind the eye to three before it.
/// let view = Parallel::new(2.0, 1.5, -1.0, 3.0)?;
/// let depth = view.depth_map(false);
/// for z in [-1.0, 1.0, 3.0] {
///     let corner = EyeVertex { position: view.scale(Point3::new(Vec3::new(1.5, -1.0, z))), varying: () };
///     let p = view.project(&depth, &corner);
///     assert_eq!((p.x, p.y, p.zs, p.q), (1.0, -1.0, (z + 1.0) / 4.0, 1.0));
/// }
/// # Ok::<(), alberti_projection::ViewError>(())
/// ```
///
/// # Precision
/// xs within 2ε·max(|xs|, `f32::MIN_POSITIVE`) of 2x/(height·aspect), of a point in eye space, and ys so of 2y/height,
/// barring overflow (ε = 2^-24); q is 1; for zs see [`LinearDepth::zs`].
///
/// # Cost
/// Three multiplications and a subtraction a vertex, no division. With q = 1 at every vertex, functions that are linear
/// in space are linear on the screen. So the rasterizer's policy of straight lines is as right as that with a division
/// a fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "crate::form::Lens", into = "crate::form::Lens"))]
pub struct Parallel {
    /// 2/height.
    pub(crate) scale: f64,
    pub(crate) scale_x: f32,
    scale_y: f32,
    pub(crate) near: f32,
    pub(crate) far: f32,
    forward: LinearDepth,
    reversed: LinearDepth,
}

impl Parallel {
    /// The box of the full `height` in units of eye space, `aspect` = width / height, between the clipping planes
    /// z = `near` = A and z = `far` = B.
    ///
    /// Depths may have either sign: A < B is all that is asked, so that a plane may lie behind the eye.
    ///
    /// # Errors
    /// [`ViewError::Height`], [`ViewError::Aspect`], and [`ViewError::NearFar`] unless A < B, neither beyond
    /// `f32::MAX`/16, nor so close to each other that 1/(B−A) overflows.
    pub const fn new(height: f32, aspect: f32, near: f32, far: f32) -> Result<Self, ViewError> {
        if !(height > 0.0 && height.is_finite()) {
            return Err(ViewError::Height);
        }
        if !(aspect > 0.0 && aspect.is_finite()) {
            return Err(ViewError::Aspect);
        }
        let scale = 2.0 / height as f64;
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, here")]
        let (scale_x, scale_y) = ((scale / aspect as f64) as f32, scale as f32);
        if !(scale_x.is_normal() && scale_y.is_normal()) {
            return Err(ViewError::Height);
        }
        match LinearDepth::between(near, far) {
            Ok([forward, reversed]) => Ok(Self { scale, scale_x, scale_y, near, far, forward, reversed }),
            Err(error) => Err(error),
        }
    }
}

impl Projection for Parallel {
    type Depth = LinearDepth;

    #[inline]
    fn with_aspect(self, aspect: f32) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, here")]
        let scale_x = (self.scale / f64::from(aspect)) as f32;
        Self { scale_x, ..self }
    }

    #[inline]
    fn is_perspective(&self) -> bool {
        false
    }

    #[inline]
    fn near(&self) -> f32 {
        self.near
    }

    #[inline]
    fn far(&self) -> f32 {
        self.far
    }

    #[inline]
    fn depth_map(&self, reversed: bool) -> LinearDepth {
        if reversed { self.reversed } else { self.forward }
    }

    #[inline(always)]
    fn scale_lanes<L: Lanes>(&self, lanes: L, [x, y, z]: [L::Number; 3]) -> [L::Number; 3] {
        [x * lanes.splat(self.scale_x), y * lanes.splat(self.scale_y), z]
    }

    #[inline(always)]
    fn side_lanes<L: Lanes>(&self, lanes: L, _: L::Number) -> L::Number {
        lanes.splat(1.0)
    }

    #[inline(always)]
    fn project_lanes<L: Lanes>(
        &self,
        lanes: L,
        depth: &LinearDepth,
        [x, y, z]: [L::Number; 3],
    ) -> [L::Number; 4] {
        [x, y, depth.zs_lanes(lanes, z), lanes.splat(1.0)]
    }
}

/// The depth of parallel projection: zs = (z − A)/(B − A), or reversed, zs = (B − z)/(B − A).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearDepth {
    /// The depth at which zs is 0.
    zero: f32,
    /// ±1/(B − A).
    slope: f32,
}

/// The greatest depth of either sign, as of eye coordinates: beyond it, differences might overflow.
const LARGEST: f32 = f32::MAX / 16.0;

impl LinearDepth {
    /// The forward and the reversed map.
    const fn between(near: f32, far: f32) -> Result<[Self; 2], ViewError> {
        let slope = 1.0 / (far as f64 - near as f64);
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, here")]
        let slope = slope as f32;
        // Written so that NaN is none.
        if !(near >= -LARGEST && far <= LARGEST && near < far && slope.is_finite()) {
            return Err(ViewError::NearFar);
        }
        Ok([Self { zero: near, slope }, Self { zero: far, slope: -slope }])
    }

    /// The screen depth zs of a point at eye depth `z` in [A, B]; always in [0, 1].
    ///
    /// # Precision
    /// Within 3ε·max(zs, `f32::MIN_POSITIVE`) of the exact value (ε = 2^-24), and exactly 0 on the plane where zs is 0.
    /// The bound is relative, so a floating-point depth buffer tells depths close to that plane apart as finely as eye
    /// depths can be. Monotone.
    #[must_use]
    #[inline]
    pub fn zs(&self, z: f32) -> f32 {
        self.zs_lanes(One, z)
    }

    /// [`zs`](Self::zs) of several.
    #[must_use]
    #[inline(always)]
    pub fn zs_lanes<L: Lanes>(&self, lanes: L, z: L::Number) -> L::Number {
        let zs = (z - lanes.splat(self.zero)) * lanes.splat(self.slope);
        // The product is negative only as -0; rounding may step over 1 by an ulp.
        lanes.min(lanes.max(zs, lanes.splat(0.0)), lanes.splat(1.0))
    }

    /// The eye depth z of a screen depth.
    ///
    /// # Precision
    /// Within 2ε of the distance from the plane where zs is 0, or of `f32::MIN_POSITIVE` if that is larger, plus ε of
    /// z.
    #[must_use]
    #[inline]
    pub fn z(&self, zs: f32) -> f32 {
        self.zero + zs / self.slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planes_map_to_the_ends_wherever_they_are() {
        for (near, far) in [(2.0, 6.0), (-6.0, -2.0), (-2.0, 2.0), (0.0, 4.0)] {
            let view = Parallel::new(1.0, 1.0, near, far).expect("valid");
            let [forward, reversed] = [false, true].map(|reversed| view.depth_map(reversed));
            let quarter = near + 1.0;
            assert_eq!([near, quarter, far].map(|z| forward.zs(z)), [0.0, 0.25, 1.0]);
            assert_eq!([near, quarter, far].map(|z| reversed.zs(z)), [1.0, 0.75, 0.0]);
            assert_eq!(reversed.zs(far).to_bits(), 0);
            assert_eq!((forward.z(0.25), reversed.z(0.75)), (quarter, quarter));
        }
    }

    #[test]
    fn impossible_boxes_are_refused() {
        let (height, aspect, plane) = (ViewError::Height, ViewError::Aspect, ViewError::NearFar);
        for (h, a, near, far, error) in [
            (0.0, 1.0, 1.0, 2.0, height),
            (-1.0, 1.0, 1.0, 2.0, height),
            (f32::NAN, 1.0, 1.0, 2.0, height),
            (f32::INFINITY, 1.0, 1.0, 2.0, height),
            (1e-40, 1.0, 1.0, 2.0, height),
            (1e38, 1e10, 1.0, 2.0, height),
            (1.0, 0.0, 1.0, 2.0, aspect),
            (1.0, f32::NAN, 1.0, 2.0, aspect),
            (1.0, 1.0, 2.0, 2.0, plane),
            (1.0, 1.0, 2.0, 1.0, plane),
            (1.0, 1.0, f32::NAN, 1.0, plane),
            (1.0, 1.0, 0.0, f32::NAN, plane),
            (1.0, 1.0, 0.0, f32::INFINITY, plane),
            (1.0, 1.0, -3e38, 1.0, plane),
            (1.0, 1.0, 0.0, 1e-39, plane),
        ] {
            assert_eq!(Parallel::new(h, a, near, far), Err(error), "{h} {a} {near} {far}");
        }
    }
}
