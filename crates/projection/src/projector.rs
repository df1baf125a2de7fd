//! Projective texture mapping: from a point of the scene to the place on an image that a projector throws there.
//!
//! ```text
//!   x |                          B          a projector at the origin, looking along z, shows u = k x/z
//!   2 |                   __..--'           on an edge from A, x/z = 1/1, to B, 2/10; its middle C is at 1.5/5.5
//!     |        C __..--''
//!   1 | A _..--'                            right: interpolate u = k x and q = z, then divide   1.5k/5.5 = 0.27k
//!     | ''                                  wrong: divide, then interpolate                    (k + 0.2k)/2 = 0.6k
//!     +-----------------------------> z
//! ```
//!
//! The division is no linear map, so it comes last, at each fragment.

use crate::ViewError;
use crate::perspective::pyramid_scale;
use alberti_math::glam::{Mat3, Vec2, Vec3};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Eye, Frame, Mode, Point3, Varying, World};

/// A slide projector: its place, its direction, and the opening of its pyramid of light.
///
/// ```
/// use alberti_math::{Point3, Vector3, World, glam::{Vec2, Vec3}};
/// use alberti_projection::{Projector, look_at};
///
/// let at = |x, y, z| Point3::<World>::new(Vec3::new(x, y, z));
/// let place = look_at(at(0.0, 2.0, 0.0), at(0.0, 2.0, -1.0), Vector3::new(Vec3::Y))?;
/// // A right angle from the bottom to the top: at the distance 5, the image is 10 high.
/// let projector = Projector::new(place, core::f32::consts::FRAC_PI_2, 1.0)?;
///
/// let shown = |x, y, z| projector.project(at(x, y, z)).divide();
/// assert_eq!(shown(0.0, 2.0, -5.0), Some(Vec2::ZERO));
/// assert!((shown(2.0, 6.0, -5.0).expect("on the image") - Vec2::new(0.4, 0.8)).length() < 1e-6);
/// // Above the image, and behind the projector.
/// assert_eq!((shown(0.0, 8.0, -5.0), shown(0.0, 2.0, 5.0)), (None, None));
/// # Ok::<(), alberti_projection::ViewError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "crate::form::Thrown", into = "crate::form::Thrown"))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Projector {
    pub(crate) eye: Point3<World>,
    /// The map of displacements from the eye to (u, v, q): the directions right, up and forward as rows, the first two
    /// scaled.
    pub(crate) rows: Frame<World, Eye>,
}

impl Projector {
    /// The projector at `place`, its image upright and centred there: x to the image's right, y up, z forward, as
    /// [`look_at`](crate::look_at) makes it for an observer. `fov_y` is the full vertical opening angle (radians),
    /// `aspect` the image's width / height.
    ///
    /// # Errors
    /// [`ViewError::Angle`], [`ViewError::Aspect`], and [`ViewError::NotFinite`] of a frame that is not finite, or too
    /// large to be scaled.
    pub fn new(place: Frame<Eye, World>, fov_y: f32, aspect: f32) -> Result<Self, ViewError> {
        let [scale_x, scale_y] = pyramid_scale(fov_y, aspect)?;
        let axes = place.axes();
        let scaled = |axis: Vec3, scale: f64| {
            #[expect(clippy::cast_possible_truncation, reason = "rounded once, here")]
            Vec3::from_array(axis.to_array().map(|c| (f64::from(c) * scale) as f32))
        };
        let rows = Mat3::from_cols(scaled(axes.x_axis, scale_x), scaled(axes.y_axis, scale_y), axes.z_axis);
        if !(rows.is_finite() && place.origin().coords.is_finite()) {
            return Err(ViewError::NotFinite);
        }
        let rows = Frame::from_mat3(rows.transpose(), Point3::new(Vec3::ZERO));
        Ok(Self { eye: place.origin(), rows })
    }

    /// The place of a point on the image, in homogeneous coordinates: (u, v) = (cot(fov/2)/aspect x, cot(fov/2) y) and
    /// q = z, with the point (x, y, z) in the projector's frame.
    ///
    /// Any point has such coordinates, also behind the projector and beside its image, and they are linear in space.
    /// So a triangle's vertices may lie anywhere: they carry them to the fragments like anything else.
    ///
    /// # Precision
    /// u, v and q are within 5ε (ε = 2^-24) of the sum of the magnitudes of their three terms, barring overflow. Each
    /// term is a product of a component of the displacement from the projector and one of the scaled axis, exact for
    /// the frame as given. In that sum, a component of an axis below `f32::MIN_POSITIVE` counts as that, and so does
    /// the sum itself. The origin of the world plays no part.
    ///
    /// # Cost
    /// Nine multiplications and nine additions.
    #[must_use]
    #[inline]
    pub fn project(&self, point: Point3<World>) -> Homogeneous {
        let Vec3 { x, y, z } = self.rows.vector_to_parent(point - self.eye).coords;
        Homogeneous { u: x, v: y, q: z }
    }
}

/// Homogeneous texture coordinates, which vertices carry where an image is projected.
///
/// As a varying it is like three numbers, linear in space. [`divide`](Self::divide) comes after interpolating, at each
/// fragment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Homogeneous {
    /// To the right on the image, times q.
    pub u: f32,
    /// Upwards on the image, times q.
    pub v: f32,
    /// The distance before the projector, negative behind it.
    pub q: f32,
}

impl Homogeneous {
    /// The place on the image, (u/q, v/q), in (-1, 1) x (-1, 1): (-1, -1) is the lower left corner, (1, 1) the upper
    /// right one. `None` where there is no image: beside it, and everywhere behind the projector.
    ///
    /// Texture coordinates, of which v points up as well, are half of it plus a half.
    ///
    /// # Precision
    /// Inside is told exactly, by |u| < q and |v| < q, which no q <= 0 and no NaN passes. The quotients are correctly
    /// rounded. Where u, v and q are off by up to e, as after interpolating, these are off by up to 2e/q more.
    ///
    /// # Cost
    /// Two divisions.
    #[must_use]
    #[inline]
    pub fn divide(self) -> Option<Vec2> {
        let (place, inside) = Self::divide_lanes(One, &[self.u, self.v, self.q]);
        inside.then_some(Vec2::from_array(place))
    }

    /// [`divide`](Self::divide) at several samples, and those of them at which there is an image; at others the place
    /// has no meaning.
    #[must_use]
    #[inline(always)]
    pub fn divide_lanes<L: Lanes>(lanes: L, &[u, v, q]: &[L::Number; 3]) -> ([L::Number; 2], L::Mask) {
        let opposite = lanes.splat(0.0) - q;
        let inside =
            (lanes.less(opposite, u) & lanes.less(u, q)) & (lanes.less(opposite, v) & lanes.less(v, q));
        ([u / q, v / q], inside)
    }
}

impl Varying for Homogeneous {
    type Of<T: Copy> = [T; 3];
    const ZEROS: [u32; 3] = [0; 3];

    #[inline(always)]
    fn gather<const N: usize>(values: [Self; N]) -> [[f32; N]; 3] {
        Vec3::gather(values.map(|Self { u, v, q }| Vec3::new(u, v, q)))
    }

    #[inline(always)]
    fn map_by_mode<T: Copy, U: Copy>(bundle: &[T; 3], f: &impl Fn(Mode, T) -> U) -> [U; 3] {
        Vec3::map_by_mode(bundle, f)
    }

    #[inline(always)]
    fn zip<T: Copy, U: Copy>(first: &[T; 3], second: &[U; 3]) -> [(T, U); 3] {
        Vec3::zip(first, second)
    }

    #[inline(always)]
    fn from_components(&[u, v, q]: &[f32; 3]) -> Self {
        Self { u, v, q }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::look_at;
    use alberti_math::{Vector3, blend2};

    fn at(x: f32, y: f32, z: f32) -> Point3<World> {
        Point3::new(Vec3::new(x, y, z))
    }

    /// The projector at the origin, along z, so that the world's x is to the left.
    fn along_z(fov_y: f32, aspect: f32) -> Projector {
        let place = look_at(at(0.0, 0.0, 0.0), at(0.0, 0.0, 1.0), Vector3::new(Vec3::Y)).expect("a place");
        Projector::new(place, fov_y, aspect).expect("a pyramid")
    }

    /// The lecture's example has A = (1, 1, 1) and B = (2, 2, 10), which are behind its projector, as that looks along
    /// -z. Here forward is +z, q = z, and x runs to the left. Magnitudes are the same.
    #[test]
    fn dividing_comes_after_interpolating() {
        let projector = along_z(0.6, 1.0);
        let k = projector.project(at(-1.0, 0.0, 0.0)).u;
        assert!((k - 1.0 / 0.3f32.tan()).abs() < 1e-6);
        let [a, b] = [at(-1.0, 1.0, 1.0), at(-2.0, 2.0, 10.0)].map(|p| projector.project(p));
        let c = projector.project(at(-1.5, 1.5, 5.5));
        assert_eq!(blend2([0.5; 2], [a, b]), c);
        let right = c.divide().expect("on the image");
        assert!((right - Vec2::splat(k * 1.5 / 5.5)).abs().max_element() < 1e-6, "{right}");
        // A itself is beside the image, but it has a quotient all the same.
        let wrong = (a.u / a.q + b.u / b.q) / 2.0;
        assert!((wrong - k * 0.6).abs() < 1e-6);
    }

    /// Divided first it is k ((1 − t) Ax Bz + t Bx Az)/(Az Bz): right of ends that are equally far, or in line with the
    /// projector.
    #[test]
    fn dividing_first_is_right_at_one_depth_or_in_one_direction() {
        let projector = along_z(1.0, 1.0);
        let k = 1.0 / 0.5f64.tan();
        for (a, b, same) in [
            ([0.5, 4.0], [3.0, 4.0], true),
            ([0.5, 2.0], [2.0, 8.0], true),
            ([0.5, 2.0], [3.0, 4.0], false),
            ([-1.0, 16.0], [0.25, 1.0], false),
        ] {
            for t in [0.25f32, 0.5, 0.75] {
                let c = [0, 1].map(|i| (1.0 - t) * a[i] + t * b[i]);
                let quotient = |[x, z]: [f32; 2]| {
                    let shown = projector.project(at(-x, 0.0, z));
                    f64::from(shown.u) / f64::from(shown.q)
                };
                let (last, share) = (quotient(c), f64::from(t));
                let first = (1.0 - share) * quotient(a) + share * quotient(b);
                let [a, b, c] = [a, b, c].map(|point| point.map(f64::from));
                let formula = k * ((1.0 - share) * a[0] * b[1] + share * b[0] * a[1]) / (a[1] * b[1]);
                assert!((last - k * c[0] / c[1]).abs() < 1e-6, "{a:?} {b:?} {t}");
                assert!((first - formula).abs() < 1e-6, "{a:?} {b:?} {t}");
                assert_eq!((first - last).abs() < 1e-6, same, "{a:?} {b:?} {t}");
            }
        }
    }

    #[test]
    fn the_image_is_as_wide_and_as_upright_as_its_aspect_says() {
        let projector = along_z(core::f32::consts::FRAC_PI_2, 2.0);
        let shown = |x, y, z| projector.project(at(x, y, z)).divide();
        for z in [1e-20, 1.0, 1e20] {
            let corner = shown(-1.9 * z, 0.9 * z, z).expect("on the image");
            assert!((corner - Vec2::new(0.95, 0.9)).length() < 1e-6, "{corner}");
            assert_eq!(shown(-2.1 * z, 0.0, z), None);
            assert_eq!(shown(0.0, -1.1 * z, z), None);
            assert_eq!(shown(0.0, 0.0, -z), None);
        }
    }

    #[test]
    fn nothing_is_shown_behind_and_of_what_is_no_number() {
        let [n, i] = [f32::NAN, f32::INFINITY];
        for [u, v, q] in [
            [0.0, 0.0, 0.0],
            [0.0, 0.0, -0.0],
            [0.0, 0.0, -1.0],
            [0.5, 0.5, -1.0],
            [1.0, 0.0, 1.0],
            [0.0, -1.0, 1.0],
            [n, 0.0, 1.0],
            [0.0, n, 1.0],
            [0.0, 0.0, n],
            [i, 0.0, i],
            [-i, 0.0, 1.0],
        ] {
            assert_eq!(Homogeneous { u, v, q }.divide(), None, "{u} {v} {q}");
        }
        let tiny = f32::from_bits(2);
        assert_eq!(Homogeneous { u: tiny / 2.0, v: 0.0, q: tiny }.divide(), Some(Vec2::new(0.5, 0.0)));
    }

    #[test]
    fn impossible_projectors_are_refused() {
        let new = |fov_y, aspect| Projector::new(Frame::IDENTITY, fov_y, aspect).map(|_| ());
        assert_eq!(new(0.0, 1.0), Err(ViewError::Angle));
        assert_eq!(new(3.2, 1.0), Err(ViewError::Angle));
        assert_eq!(new(1.0, 0.0), Err(ViewError::Aspect));
        assert_eq!(new(1.0, f32::NAN), Err(ViewError::Aspect));
        let at_frame = |axis: f32, origin: f32| {
            let place =
                Frame::from_mat3(Mat3::from_diagonal(Vec3::new(1.0, axis, 1.0)), at(origin, 0.0, 0.0));
            Projector::new(place, 1e-3, 1.0).map(|_| ())
        };
        assert_eq!(at_frame(1.0, 0.0), Ok(()));
        for (axis, origin) in [(f32::NAN, 0.0), (1.0, f32::NAN), (1.0, f32::INFINITY), (1e38, 0.0)] {
            assert_eq!(at_frame(axis, origin), Err(ViewError::NotFinite), "{axis} {origin}");
        }
    }
}
