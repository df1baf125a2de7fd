//! The observer: step 1, from the world's frame to the eye's.

use crate::ViewError;
use alberti_math::glam::{Mat3, Vec3};
use alberti_math::{Eye, Frame, Point3, Vector3, World};

/// The frame of an observer at `eye` who looks at `target`, with `up` upwards in the picture.
///
/// Its axes are x to the right, y up, z forward, unit and perpendicular, so that
/// [`inverse_orthonormal`](Frame::inverse_orthonormal) (rotation transposed, translation negated) gives the step from
/// world to eye coordinates. The world is right-handed and the eye's frame is left-handed: depth grows with z.
///
/// # Errors
/// [`ViewError::EyeAtTarget`], [`ViewError::UpAlongView`] and [`ViewError::NotFinite`], also where the difference
/// between `eye` and `target` overflows.
///
/// # Precision
/// Each component of forward is within 3ε of its exact value (ε = 2^-24), those of right and up are within 4ε/sin φ. φ
/// is the angle between `up` and the view: below a few degrees they get worse. Axes are unit within 3ε, and the cosines
/// between them within 4ε/sin φ of 0.
pub fn look_at(
    eye: Point3<World>,
    target: Point3<World>,
    up: Vector3<World>,
) -> Result<Frame<Eye, World>, ViewError> {
    let [e, t, u] = [eye.coords, target.coords, up.coords];
    if !(e.is_finite() && t.is_finite() && u.is_finite()) {
        return Err(ViewError::NotFinite);
    }
    let toward = t - e;
    if !toward.is_finite() {
        return Err(ViewError::NotFinite);
    }
    let forward = direction(toward).ok_or(ViewError::EyeAtTarget)?;
    let up = direction(u).ok_or(ViewError::UpAlongView)?;
    let across = forward.cross(up);
    // An angle under a thousandth of a degree leaves fewer than eight good bits in the cross product.
    if across.length() < 1e-5 {
        return Err(ViewError::UpAlongView);
    }
    let right = direction(across).ok_or(ViewError::UpAlongView)?;
    let up = direction(right.cross(forward)).ok_or(ViewError::UpAlongView)?;
    Ok(Frame::from_mat3(Mat3::from_cols(right, up, forward), eye))
}

/// The unit vector along a finite `v`, whatever its length; `None` for zero.
fn direction(v: Vec3) -> Option<Vec3> {
    let largest = v.abs().max_element();
    if largest == 0.0 {
        return None;
    }
    // Dividing by the largest component first keeps the squares from overflowing or vanishing.
    let scaled = v / largest;
    Some(scaled / scaled.length())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f32, y: f32, z: f32) -> Point3<World> {
        Point3::new(Vec3::new(x, y, z))
    }

    #[test]
    fn right_up_and_forward_as_the_conventions_say() {
        let camera = look_at(at(1.0, 2.0, 3.0), at(1.0, 2.0, -7.0), Vector3::new(Vec3::Y)).expect("valid");
        assert_eq!(camera.axes(), Mat3::from_cols(Vec3::X, Vec3::Y, Vec3::NEG_Z));
        let to_eye = camera.inverse_orthonormal();
        assert_eq!(to_eye.to_parent(at(3.0, 5.0, -1.0)).coords, Vec3::new(2.0, 3.0, 4.0));
    }

    #[test]
    fn axes_are_orthonormal_from_anywhere() {
        for i in 0..1000i16 {
            let i = f32::from(i);
            let eye = at((i * 0.37).sin() * 9.0, (i * 0.11).cos() * 3.0, i * 0.01 - 4.0);
            let camera = look_at(eye, at(0.1, 0.2, 0.3), Vector3::new(Vec3::Y)).expect("valid");
            let axes = camera.axes();
            let error = axes * axes.transpose() - Mat3::IDENTITY;
            assert!(error.to_cols_array().iter().all(|e| e.abs() < 4e-7), "{error}");
            assert!(axes.determinant() < 0.0, "right, up, forward is left-handed");
        }
    }

    #[test]
    fn lengths_do_not_matter() {
        for scale in [1e-30, 1.0, 1e30] {
            let camera = look_at(at(0.0, 0.0, 0.0), at(0.0, 0.0, scale), Vector3::new(Vec3::Y * scale));
            assert_eq!(camera.expect("valid").axes(), Mat3::from_cols(Vec3::NEG_X, Vec3::Y, Vec3::Z));
        }
    }

    #[test]
    fn impossible_views_are_refused() {
        let up = Vector3::new(Vec3::Y);
        assert_eq!(look_at(at(1.0, 1.0, 1.0), at(1.0, 1.0, 1.0), up), Err(ViewError::EyeAtTarget));
        assert_eq!(look_at(at(0.0, 9.0, 0.0), at(0.0, 1.0, 0.0), up), Err(ViewError::UpAlongView));
        assert_eq!(
            look_at(at(0.0, 9.0, 0.0), at(1.0, 1.0, 0.0), Vector3::new(Vec3::ZERO)),
            Err(ViewError::UpAlongView)
        );
        assert_eq!(look_at(at(f32::NAN, 9.0, 0.0), at(1.0, 1.0, 0.0), up), Err(ViewError::NotFinite));
        assert_eq!(look_at(at(-3e38, 0.0, 0.0), at(3e38, 0.0, 0.0), up), Err(ViewError::NotFinite));
    }
}
