//! Tangent frames: of two derivatives, of a triangle with texture coordinates, of a bare normal.
//!
//! Space in: points of the surface in object space, coordinates (u, v). Space out: `Frame<Tangent, Object>`.

use super::unit::{narrow, perpendicular, reject, unit};
use alberti_math::{Frame, Object, Point2, Point3, Space, Vector3, orientation};
use core::cmp::Ordering;
use glam::{DVec3, Mat3, Vec2};

/// The space on a surface: x in the direction of growing u, y in that of growing v, z along the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangent {}

impl Space for Tangent {}

/// The tangent frame at `point`, whose axes are the derivatives ∂f/∂u and ∂f/∂v and their cross product.
///
/// A vector (a, b, c) of the frame is a ∂f/∂u + b ∂f/∂v + c n in object space: its first two components are in units of
/// u and v. Axes of length 1 are those of [`orthonormal`].
///
/// # Precision
/// Each component of z is within 1ε·max(|exact|, `f32::MIN_POSITIVE`) + 2^-51·|∂f/∂u| |∂f/∂v| of the cross product of
/// the two (ε = 2^-24), infinite where that is beyond `f32::MAX`.
#[must_use]
pub fn frame_of_derivatives(
    point: Point3<Object>,
    du: Vector3<Object>,
    dv: Vector3<Object>,
) -> Frame<Tangent, Object> {
    let normal = du.coords.as_dvec3().cross(dv.coords.as_dvec3());
    Frame::new(point, du, dv, Vector3::new(narrow(normal)))
}

/// The unit vectors along ∂p/∂u and ∂p/∂v on a triangle with texture coordinates. `None` where its texture has no area,
/// where one of them is zero, as the triangle has none, or where a coordinate is not finite.
///
/// The triangle maps the texture to the surface; u grows along the vector whose barycentric coordinates in the texture
/// are those of (1, 0). With t10 = t1 − t0 and so on, and × for the determinant of two vectors of the plane:
///
/// ```text
/// ∂p/∂u = ( t20.v (p1 − p0) − t10.v (p2 − p0)) / (t10 × t20)
/// ∂p/∂v = (−t20.u (p1 − p0) + t10.u (p2 − p0)) / (t10 × t20)
/// ```
///
/// (The second coefficient of ∂p/∂u is often printed as −t10.u; it is t10 × (1, 0) = −t10.v.) Only directions matter,
/// so nothing is divided by the determinant, but its sign is kept.
///
/// # Precision
/// The sign is exact. For a texture and a triangle whose angles have sines of 2^-20 and more, both are within 1.1ε
/// radians of the exact directions (ε = 2^-24). There, their lengths are within 1.1ε of 1.
///
/// # Cost
/// Some 100 operations in `f64`, in software on a core without it, and two square roots.
#[must_use]
pub fn triangle_directions(corners: [Point3<Object>; 3], uv: [Vec2; 3]) -> Option<[Vector3<Object>; 2]> {
    let ([x, y], _) = derivatives(corners, uv)?;
    Some([x, y].map(|axis| Vector3::new(narrow(axis))))
}

/// The tangent frame of a triangle with texture coordinates, at its first vertex, with unit axes at right angles. x is
/// along ∂p/∂u, z along the normal, and y the side of z × x to which ∂p/∂v points. `None` where the triangle has no
/// area, on the surface or in the texture, or where a coordinate is not finite.
///
/// Where the texture is mirrored, that is where it runs clockwise along a counter-clockwise triangle, the frame is
/// left-handed: y = −z × x. [`triangle_directions`] has the formula; a texture may also be sheared, and then y is not
/// ∂p/∂v.
///
/// # Precision
/// Handedness is exact. For a texture and a triangle whose angles have sines of 2^-20 and more, x and z are within 2.1ε
/// radians of the exact directions (ε = 2^-24). There, lengths are within 1.1ε of 1, and cosines between axes within
/// 2.2ε of 0. Edges of the triangle must be between 10^-16 and 10^18 long: the normal of smaller ones is less precise,
/// or rounds to zero, and there is no frame.
///
/// # Cost
/// [`Frame::of_triangle`], some 150 operations in `f64`, in software on a core without it, and four square roots.
///
/// ```
/// use alberti_math::{Object, Point3};
/// use alberti_texture::surface::triangle_frame;
/// use glam::{Vec2, Vec3};
///
/// let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(Point3::<Object>::new);
/// // The texture lies on its side: u grows upwards, v to the left.
/// let uv = [Vec2::ZERO, Vec2::new(0.0, -1.0), Vec2::new(1.0, 0.0)];
/// let axes = triangle_frame(corners, uv).expect("it has an area").axes();
/// assert_eq!((axes.x_axis, axes.y_axis, axes.z_axis), (Vec3::Y, Vec3::NEG_X, Vec3::Z));
/// ```
#[must_use]
pub fn triangle_frame(corners: [Point3<Object>; 3], uv: [Vec2; 3]) -> Option<Frame<Tangent, Object>> {
    let ([x, _], sign) = derivatives(corners, uv)?;
    let z = unit(Frame::<Tangent, Object>::of_triangle(corners).axes().z_axis.as_dvec3())?;
    let x = reject(x, z)?;
    Some(frame(corners[0], [x, z.cross(x) * sign, z]))
}

/// The directions of ∂p/∂u and ∂p/∂v, and the sign of the texture's area.
fn derivatives(corners: [Point3<Object>; 3], uv: [Vec2; 3]) -> Option<([DVec3; 2], f64)> {
    let sign = match orientation::<Tangent>(Point2::new(uv[0]), Point2::new(uv[1]), Point2::new(uv[2]))? {
        Ordering::Equal => return None,
        Ordering::Greater => 1.0,
        Ordering::Less => -1.0,
    };
    let [p0, p1, p2] = corners.map(|p| p.coords.as_dvec3());
    let [t0, t1, t2] = uv.map(|t| t.as_dvec2());
    let (e10, e20, t10, t20) = (p1 - p0, p2 - p0, t1 - t0, t2 - t0);
    let x = unit((e10 * t20.y - e20 * t10.y) * sign)?;
    let y = unit((e20 * t10.x - e10 * t20.x) * sign)?;
    Some(([x, y], sign))
}

/// The frame with unit axes at right angles that a tangent frame becomes: z keeps its direction, and x loses its part
/// along z (Gram and Schmidt). y is z × x, or its opposite where x, y, z are left-handed, as on a mirrored
/// texture.
///
/// An axis that has no direction is chosen, so that there is a frame always, and never a NaN:
/// * Without a z, as at the pole of a sphere, where ∂f/∂u = 0, the normal is that of x and y. Where these have none, it
///   is at right angles to x, or else to y, and nearest to the coordinate axis that is least along it.
/// * Without an x, or where it is within 2^-20 radians of z, x is the direction that makes y right. Or else it is the
///   direction at right angles to z that is nearest to the coordinate axis that is least along it.
/// * Where none has a direction, the axes are those of object space.
///
/// # Precision
/// Lengths are within 1.1ε of 1, and the cosines between axes within 2.2ε of 0 (ε = 2^-24).
///
/// # Cost
/// About 150 operations in `f64`, in software on a core without it, and three square roots.
#[must_use]
pub fn orthonormal(of: Frame<Tangent, Object>) -> Frame<Tangent, Object> {
    let [x, y, z] = [of.axes().x_axis, of.axes().y_axis, of.axes().z_axis].map(|axis| unit(axis.as_dvec3()));
    let across = || x.zip(y).and_then(|(x, y)| reject(y, x).map(|y| x.cross(y)));
    let [x, y, z] = match (z.or_else(across), x, y) {
        (Some(z), _, _) => {
            let from_x = x.and_then(|x| reject(x, z));
            let from_y = || y.and_then(|y| reject(y, z)).map(|y| y.cross(z));
            let chosen = from_x.or_else(from_y).unwrap_or_else(|| perpendicular(z));
            let mirrored = x.zip(y).is_some_and(|(x, y)| x.cross(y).dot(z) < 0.0);
            let y = if mirrored { chosen.cross(z) } else { z.cross(chosen) };
            [chosen, y, z]
        }
        (None, Some(x), _) => {
            let z = perpendicular(x);
            [x, z.cross(x), z]
        }
        (None, None, Some(y)) => {
            let z = perpendicular(y);
            [y.cross(z), y, z]
        }
        (None, None, None) => [DVec3::X, DVec3::Y, DVec3::Z],
    };
    frame(of.origin(), [x, y, z])
}

/// A tangent frame where there are no texture coordinates to say more: z along `normal`, x as [`orthonormal`] chooses
/// it. Without a normal the axes are those of object space.
#[must_use]
pub fn frame_of_normal(point: Point3<Object>, normal: Vector3<Object>) -> Frame<Tangent, Object> {
    let none = Vector3::new(glam::Vec3::ZERO);
    orthonormal(Frame::new(point, none, none, normal))
}

/// Rounded to `f32`.
pub(super) fn frame(origin: Point3<Object>, [x, y, z]: [DVec3; 3]) -> Frame<Tangent, Object> {
    Frame::from_mat3(Mat3::from_cols(narrow(x), narrow(y), narrow(z)), origin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn axes(of: Frame<Tangent, Object>) -> [Vec3; 3] {
        [of.axes().x_axis, of.axes().y_axis, of.axes().z_axis]
    }

    fn chosen(x: Vec3, y: Vec3, z: Vec3) -> [Vec3; 3] {
        let v = Vector3::new;
        axes(orthonormal(Frame::new(Point3::new(Vec3::ONE), v(x), v(y), v(z))))
    }

    #[test]
    fn what_has_no_direction_is_chosen() {
        let (o, x, y, z) = (Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z);
        assert_eq!(chosen(o, o, o), [x, y, z]);
        assert_eq!(chosen(x * 3.0, y * 7.0, o), [x, y, z]);
        assert_eq!(chosen(o, y, z), [x, y, z]);
        assert_eq!(chosen(z, y, z), [x, y, z]);
        assert_eq!(chosen(o, o, z * 1e-30), [x, y, z]);
        assert_eq!(chosen(o, o, x), [y, z, x]);
        assert_eq!(chosen(y, o, o), [y, z, x]);
        assert_eq!(chosen(o, y, o), [-z, y, x]);
        assert_eq!(chosen(Vec3::NAN, Vec3::INFINITY, o), [x, y, z]);
        // Parallel derivatives, whose directions in `f64` may not be equal.
        assert_eq!(chosen(x + y, (x + y) * 3.0, o)[2], z);
    }

    #[test]
    fn a_mirrored_frame_stays_mirrored() {
        let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
        assert_eq!(chosen(x * 2.0 + z, y - x, z * 5.0), [x, y, z]);
        assert_eq!(chosen(x * 2.0 + z, x - y, z * 5.0), [x, -y, z]);
    }

    #[test]
    fn degenerate_triangles_have_no_frame() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(Point3::new);
        let line = [Vec3::ZERO, Vec3::ONE, Vec3::ONE * 3.0].map(Point3::new);
        let uv = [Vec2::ZERO, Vec2::X, Vec2::Y];
        assert!(triangle_frame(corners, uv).is_some());
        assert_eq!(triangle_frame(line, uv), None);
        assert_eq!(triangle_frame(corners, [Vec2::ONE; 3]), None);
        assert_eq!(triangle_frame(corners, [Vec2::ZERO, Vec2::ONE, Vec2::ONE * 3.0]), None);
        assert_eq!(triangle_frame(corners, [Vec2::NAN, Vec2::X, Vec2::Y]), None);
        assert_eq!(triangle_frame([Point3::new(Vec3::INFINITY), corners[1], corners[2]], uv), None);
    }
}
