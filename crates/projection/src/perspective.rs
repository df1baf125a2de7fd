//! Step 2 and step 4: the scale that makes the pyramid's sides the bisecting planes, and perspective with depth.

use crate::clip::{EyeVertex, ProjectedVertex};
use crate::{DepthMap, Projection, ViewError};
use alberti_math::{Eye, Point3, Varying};

/// A pyramid of view: opening angle, aspect ratio, near and far planes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "crate::form::Lens", into = "crate::form::Lens"))]
pub struct Perspective {
    /// cot(fov/2).
    pub(crate) scale: f64,
    pub(crate) scale_x: f32,
    scale_y: f32,
    pub(crate) near: f32,
    pub(crate) far: f32,
    forward: DepthMap,
    reversed: DepthMap,
}

impl Perspective {
    /// The pyramid with the full vertical opening angle `fov_y` (radians), `aspect` = width / height, and the clipping
    /// planes z = `near` = A and z = `far` = B.
    ///
    /// # Cost
    /// Some fifty operations in `f64`; in a constant, none on the machine that draws, nor their code.
    ///
    /// # Errors
    /// [`ViewError::Angle`], [`ViewError::Aspect`], [`ViewError::NearFar`].
    pub const fn new(fov_y: f32, aspect: f32, near: f32, far: f32) -> Result<Self, ViewError> {
        match pyramid_scale(fov_y, aspect) {
            Ok([_, scale]) => Self::of_scale(scale, aspect, [near, far]),
            Err(error) => Err(error),
        }
    }

    /// The same by the cotangent of half the opening angle.
    pub(crate) const fn of_scale(scale: f64, aspect: f32, [near, far]: [f32; 2]) -> Result<Self, ViewError> {
        if let Err(error) = checked_scale(scale, aspect) {
            return Err(error);
        }
        let (Ok(forward), Ok(reversed)) = (DepthMap::forward(near, far), DepthMap::reversed(near, far))
        else {
            return Err(ViewError::NearFar);
        };
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, here")]
        let scale_y = scale as f32;
        let square = Self { scale, scale_x: scale_y, scale_y, near, far, forward, reversed };
        Ok(square.with_aspect(aspect))
    }

    /// The same pyramid for pictures of this aspect ratio, width / height: as high, and as wide as that takes.
    #[must_use]
    pub const fn with_aspect(self, aspect: f32) -> Self {
        let scale_x = quotient(self.scale, aspect, self.scale_y);
        Self { scale_x, ..self }
    }

    /// The factors of x and y.
    #[inline(always)]
    pub(crate) const fn scales(&self) -> [f32; 2] {
        [self.scale_x, self.scale_y]
    }

    /// The near plane, z = A.
    #[must_use]
    pub const fn near(&self) -> f32 {
        self.near
    }

    /// The far plane, z = B.
    #[must_use]
    pub const fn far(&self) -> f32 {
        self.far
    }

    /// The depth map of these planes: 0 at the near plane and 1 at the far one, or the other way round.
    #[must_use]
    pub const fn depth_map(&self, reversed: bool) -> DepthMap {
        if reversed { self.reversed } else { self.forward }
    }

    /// Step 2, the pyramid scale S: x and y are multiplied by d/s = cot(fov/2), x also by 1/aspect. So the sides of the
    /// pyramid become the planes x = ±z, y = ±z.
    #[must_use]
    #[inline]
    pub fn scale(&self, p: Point3<Eye>) -> Point3<Eye> {
        Projection::scale(self, p)
    }

    /// Step 4, perspective with depth: xs = xe/ze, ys = ye/ze, zs = α + β/ze, and q = 1/ze for the steps that follow.
    ///
    /// # Shapes and spaces
    /// The vertex is in eye space, scaled by [`scale`](Self::scale) and within the near and far planes, so ze >= A > 0.
    ///
    /// # Precision
    /// xs, ys and q are correctly rounded quotients (within ε = 2^-24, relatively); for zs see [`DepthMap::zs`].
    #[must_use]
    #[inline]
    pub fn project<V: Varying>(&self, depth: &DepthMap, v: &EyeVertex<V>) -> ProjectedVertex<V> {
        Projection::project(self, depth, v)
    }
}

/// A quotient of positive normal numbers, rounded once if it is normal too; of others `rounded` by the divisor. It is
/// found in integers, so that chips without hardware for `f64` need no functions for it.
const fn quotient(dividend: f64, divisor: f32, rounded: f32) -> f32 {
    if !(divisor > 0.0 && divisor.is_normal()) {
        return rounded / divisor;
    }
    let (a, b) = (dividend.to_bits(), divisor.to_bits());
    let mantissas = [a & ((1 << 52) - 1) | 1 << 52, (b & ((1 << 23) - 1) | 1 << 23) as u64];
    // From 2^28 to 2^30: so many bits more than are kept that the last one may stand for the remainder.
    let (whole, rest) = (mantissas[0] / mantissas[1], mantissas[0] % mantissas[1]);
    #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "rounded once, here")]
    let mantissa = (whole as u32 | (rest != 0) as u32) as f32;
    let exponents = [(a >> 52) as i32 - 1023, (b >> 23).cast_signed() - 127];
    let exponent = exponents[0] - exponents[1] - 29;
    mantissa * power(exponent / 2) * power(exponent - exponent / 2)
}

/// 2^`exponent`, or the normal power next to it.
const fn power(exponent: i32) -> f32 {
    let exponent = if exponent < -126 {
        -126
    } else if exponent > 127 {
        127
    } else {
        exponent
    };
    f32::from_bits((exponent + 127).cast_unsigned() << 23)
}

/// The factors of x and y by which a pyramid's sides become x = ±z, y = ±z: cot(fov/2)/aspect and cot(fov/2).
pub(crate) const fn pyramid_scale(fov_y: f32, aspect: f32) -> Result<[f64; 2], ViewError> {
    if !(fov_y > 0.0 && fov_y < core::f32::consts::PI) {
        return Err(ViewError::Angle);
    }
    checked_scale(cot_half(fov_y as f64), aspect)
}

/// The same factors by cot(fov/2).
const fn checked_scale(scale: f64, aspect: f32) -> Result<[f64; 2], ViewError> {
    if !(aspect > 0.0 && aspect.is_finite()) {
        return Err(ViewError::Aspect);
    }
    let [x, y] = [scale / aspect as f64, scale];
    #[expect(clippy::cast_possible_truncation, reason = "to see whether they can be rounded")]
    let normal = (x as f32).is_normal() && (y as f32).is_normal();
    if normal { Ok([x, y]) } else { Err(ViewError::Angle) }
}

/// cot(x/2) for x in (0, π), from IEEE basic operations, so that it is the same on every target.
///
/// With y = x/4 in (0, π/4): cot 2y = (1 − t²) / 2t, t = tan y.
const fn cot_half(x: f64) -> f64 {
    let y = x / 4.0;
    let (sine, cosine) = (series(y, 1.0, y), series(1.0, 0.0, y));
    (cosine - sine) * (cosine + sine) / (2.0 * sine * cosine)
}

/// The Taylor series of sine (from y^1 on, every other power of `y`) or cosine (from y^0), cut where the next term is
/// below 1e-18 of the sum.
const fn series(first: f64, mut power: f64, y: f64) -> f64 {
    let (mut term, mut sum, mut terms) = (first, first, 0);
    while terms < 9 {
        term *= -y * y / ((power + 1.0) * (power + 2.0));
        sum += term;
        power += 2.0;
        terms += 1;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::glam::Vec3;

    #[test]
    fn the_cotangent_is_that_of_the_standard_library() {
        let mut x = 1e-6f64;
        while x < core::f64::consts::PI - 1e-4 {
            let expected = 1.0 / (x / 2.0).tan();
            // Near π the reference's own argument reduction loses what the cotangent's zero amplifies.
            assert!((cot_half(x) - expected).abs() <= 1e-15 * expected.abs().max(1.0), "{x}");
            x += 1.7e-4;
        }
    }

    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once, as the quotient is")]
    fn a_quotient_is_that_of_f64_rounded() {
        let mut dividend = 1.234_567e-30f64;
        let mut divisor = 1.7e-19f32;
        for _ in 0..100_000 {
            let expected = (dividend / f64::from(divisor)) as f32;
            if expected.is_normal() {
                assert_eq!(quotient(dividend, divisor, 0.0), expected, "{dividend:e} / {divisor:e}");
            }
            dividend *= 1.001_37;
            divisor *= 1.000_91;
            dividend = if dividend > 1e30 { dividend / 1e60 } else { dividend };
            divisor = if divisor > 1e19 { divisor / 1e38 } else { divisor };
        }
        assert_eq!(quotient(1.0, 0.0, 1.0), f32::INFINITY);
        assert!(quotient(1.0, f32::NAN, 1.0).is_nan());
    }

    #[test]
    fn the_pyramids_sides_become_the_bisecting_planes() {
        let right_angle = Perspective::new(core::f32::consts::FRAC_PI_2, 2.0, 1.0, 3.0).expect("valid");
        let corner = right_angle.scale(Point3::new(Vec3::new(6.0, 3.0, 3.0))).coords;
        assert!((corner - Vec3::splat(3.0)).abs().max_element() < 1e-6, "{corner}");
    }

    #[test]
    fn the_far_corner_goes_to_the_cubes_corner() {
        let view = Perspective::new(core::f32::consts::FRAC_PI_2, 1.0, 1.0, 4.0).expect("valid");
        let corner = EyeVertex { position: Point3::new(Vec3::new(4.0, -4.0, 4.0)), varying: () };
        let p = view.project(&view.depth_map(false), &corner);
        assert_eq!((p.x, p.y, p.zs, p.q), (1.0, -1.0, 1.0, 0.25));
        assert_eq!(view.project(&view.depth_map(true), &corner).zs, 0.0);
    }

    /// x = m z, y = n z: one place on the screen, and depths in order.
    #[test]
    fn all_of_a_ray_is_at_one_place() {
        let view = Perspective::new(core::f32::consts::FRAC_PI_2, 1.0, 1.0, 8.0).expect("valid");
        let [m, n] = [0.375, -0.625];
        let on_the_ray = [1.0, 2.0, 8.0].map(|z| {
            let vertex = EyeVertex { position: Point3::new(Vec3::new(m * z, n * z, z)), varying: () };
            view.project(&view.depth_map(false), &vertex)
        });
        assert!(on_the_ray.iter().all(|p| (p.x, p.y) == (m, n)));
        // α = 8/7, β = -8/7.
        let zs = on_the_ray.map(|p| p.zs);
        assert!(zs[0] == 0.0 && (zs[1] - 4.0 / 7.0).abs() < 1e-6 && zs[2] == 1.0, "{zs:?}");
    }

    #[test]
    fn impossible_pyramids_are_refused() {
        assert_eq!(Perspective::new(0.0, 1.0, 1.0, 2.0), Err(ViewError::Angle));
        assert_eq!(Perspective::new(3.2, 1.0, 1.0, 2.0), Err(ViewError::Angle));
        assert_eq!(Perspective::new(f32::NAN, 1.0, 1.0, 2.0), Err(ViewError::Angle));
        assert_eq!(Perspective::new(1e-40, 1.0, 1.0, 2.0), Err(ViewError::Angle));
        assert_eq!(Perspective::new(1.0, -1.0, 1.0, 2.0), Err(ViewError::Aspect));
        assert_eq!(Perspective::new(1.0, 1.0, 2.0, 2.0), Err(ViewError::NearFar));
    }
}
