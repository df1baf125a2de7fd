//! Cameras and lenses given as matrices of 4x4, as other libraries make them. A view matrix goes from world to eye
//! coordinates, a projection matrix from these to clip coordinates. Vectors are columns.

use crate::{Perspective, ViewError};
use alberti_math::glam::{Mat3, Mat4, Vec3, Vec4Swizzles};
use alberti_math::{Eye, Frame, Point3, World};

/// The direction of view in the eye's coordinates of a matrix, x being to the right and y up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Handedness {
    /// -z, as in glam's `camera::rh`.
    Right,
    /// z, as in glam's `camera::lh`.
    Left,
}

/// The clip coordinates that a projection matrix gives, after the division by w.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ClipSpace {
    /// y up, depth from -1 to 1.
    OpenGl,
    /// y up, depth from 0 to 1; also Metal's and WebGPU's.
    DirectX,
    /// y down, depth from 0 to 1.
    Vulkan,
}

/// The greatest error of the scalar products of a view matrix's axes, which are 0 or 1.
const RIGID: f32 = 1e-4;

/// The observer of a view matrix: a rotation and a translation.
///
/// ```
/// use alberti_math::glam::{Vec3, camera::rh};
/// use alberti_projection::{Handedness, eye_of_matrix};
///
/// let matrix = rh::view::look_at_mat4(Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y);
/// let eye = eye_of_matrix(matrix, Handedness::Right)?;
/// assert!((eye.origin().coords - Vec3::new(1.0, 2.0, 3.0)).length() < 1e-6);
/// # Ok::<(), alberti_projection::ViewError>(())
/// ```
///
/// # Errors
/// [`ViewError::NotFinite`]; [`ViewError::Matrix`] if axes are not unit and at right angles within 10^-4, the matrix
/// mirrors, or its last row is not 0, 0, 0, 1.
///
/// # Precision
/// Axes are those of the matrix. The place is within 4ε of its distance from the world's origin (ε = 2^-24), times 1
/// and twice the error of the axes.
pub fn eye_of_matrix(view: Mat4, handedness: Handedness) -> Result<Frame<Eye, World>, ViewError> {
    if !view.is_finite() {
        return Err(ViewError::NotFinite);
    }
    let [right, up, back] = [view.row(0).xyz(), view.row(1).xyz(), view.row(2).xyz()];
    let unit = |v: Vec3| (v.dot(v) - 1.0).abs() <= RIGID;
    let normal = |a: Vec3, b: Vec3| a.dot(b).abs() <= RIGID;
    let rigid =
        unit(right) && unit(up) && unit(back) && normal(right, up) && normal(up, back) && normal(back, right);
    let affine = view.row(3) == alberti_math::glam::Vec4::W;
    if !rigid || !affine || right.cross(up).dot(back) < 0.0 {
        return Err(ViewError::Matrix);
    }
    let moved = view.w_axis;
    let place = -(right * moved.x + up * moved.y + back * moved.z);
    let forward = match handedness {
        Handedness::Right => -back,
        Handedness::Left => back,
    };
    Ok(Frame::from_mat3(Mat3::from_cols(right, up, forward), Point3::new(place)))
}

impl Perspective {
    /// The pyramid of a projection matrix, whose depths may also run from the far plane to the near one. Its middle is
    /// the direction of view, of either handedness, and its far plane is not at infinity.
    ///
    /// ```
    /// use alberti_math::glam::camera::rh::proj::directx;
    /// use alberti_projection::{ClipSpace, Perspective};
    ///
    /// let matrix = directx::perspective(0.7, 4.0 / 3.0, 0.1, 100.0);
    /// let lens = Perspective::from_matrix(matrix, ClipSpace::DirectX)?;
    /// assert!((lens.near() - 0.1).abs() < 1e-6 && (lens.far() - 100.0).abs() < 0.01);
    /// # Ok::<(), alberti_projection::ViewError>(())
    /// ```
    ///
    /// # Errors
    /// [`ViewError::NotFinite`]; [`ViewError::Matrix`] if the matrix has other numbers than such a pyramid's;
    /// [`ViewError::NearFar`], also for a far plane at infinity; [`ViewError::Angle`], [`ViewError::Aspect`].
    ///
    /// # Precision
    /// The matrix, rounded to `f32`, tells the near plane within 4ε of its distance and the far plane within
    /// 4ε·far/near of its.
    pub fn from_matrix(matrix: Mat4, space: ClipSpace) -> Result<Self, ViewError> {
        if !matrix.is_finite() {
            return Err(ViewError::NotFinite);
        }
        let [[x, x1, x2, x3], [y0, y, y2, y3], [z0, z1, a, side], [w0, w1, b, w3]] =
            matrix.to_cols_array_2d();
        let [least, y] = match space {
            ClipSpace::OpenGl => [-1.0, f64::from(y)],
            ClipSpace::DirectX => [0.0, f64::from(y)],
            ClipSpace::Vulkan => [0.0, -f64::from(y)],
        };
        let others = [x1, x2, x3, y0, y2, y3, z0, z1, w0, w1, w3];
        if others.iter().any(|&other| other != 0.0) || side.abs() != 1.0 || !(x > 0.0 && y > 0.0) {
            return Err(ViewError::Matrix);
        }
        // At the distance d before the eye, z/w is a + b/d.
        let [a, b] = [f64::from(a) * f64::from(side), f64::from(b)];
        let [first, second] = [b / (least - a), b / (1.0 - a)];
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, here")]
        let [near, far] = [first.min(second) as f32, first.max(second) as f32];
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, here")]
        let aspect = (y / f64::from(x)) as f32;
        Self::of_scale(y, aspect, [near, far])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::glam::camera::{lh, rh};

    /// The place of a point of the world by matrices: x and y over w, and the part of the way from near to far.
    fn by_matrices(view: Mat4, projection: Mat4, space: ClipSpace, p: Vec3) -> [f64; 3] {
        let columns = |m: Mat4| m.to_cols_array_2d().map(|column| column.map(f64::from));
        let apply = |m: [[f64; 4]; 4], v: [f64; 4]| {
            [0, 1, 2, 3].map(|row| (0..4).map(|column| m[column][row] * v[column]).sum::<f64>())
        };
        let p = [f64::from(p.x), f64::from(p.y), f64::from(p.z), 1.0];
        let [x, y, z, w] = apply(columns(projection), apply(columns(view), p));
        match space {
            ClipSpace::OpenGl => [x / w, y / w, (z / w + 1.0) / 2.0],
            ClipSpace::DirectX => [x / w, y / w, z / w],
            ClipSpace::Vulkan => [x / w, -y / w, z / w],
        }
    }

    /// The same by the frame and the pyramid that are made of them.
    fn by_parts(eye: Frame<Eye, World>, lens: &Perspective, p: Vec3) -> [f64; 3] {
        let p = eye.inverse_orthonormal().to_parent(Point3::new(p));
        let p = lens.scale(p).coords;
        let [x, y, z] = [p.x, p.y, p.z].map(f64::from);
        let (near, far) = (f64::from(lens.near()), f64::from(lens.far()));
        [x / z, y / z, (1.0 - near / z) / (1.0 - near / far)]
    }

    #[test]
    fn points_are_where_the_matrices_have_them() {
        let (eye, target) = (Vec3::new(3.0, -2.0, 5.0), Vec3::new(-1.0, 0.5, -2.0));
        let right = (rh::view::look_at_mat4(eye, target, Vec3::Y), Handedness::Right);
        let left = (lh::view::look_at_mat4(eye, target, Vec3::Y), Handedness::Left);
        let (fov, aspect, near, far) = (0.9, 1.6, 0.5, 60.0);
        let cases = [
            (right, rh::proj::opengl::perspective(fov, aspect, near, far), ClipSpace::OpenGl),
            (right, rh::proj::directx::perspective(fov, aspect, near, far), ClipSpace::DirectX),
            (right, rh::proj::vulkan::perspective(fov, aspect, near, far), ClipSpace::Vulkan),
            (left, lh::proj::opengl::perspective(fov, aspect, near, far), ClipSpace::OpenGl),
            (left, lh::proj::directx::perspective(fov, aspect, near, far), ClipSpace::DirectX),
            (left, lh::proj::vulkan::perspective(fov, aspect, near, far), ClipSpace::Vulkan),
            // Depth from 1 at the near plane to 0 at the far one.
            (left, lh::proj::directx::perspective(fov, aspect, far, near), ClipSpace::DirectX),
        ];
        for ((view, handedness), projection, space) in cases {
            let frame = eye_of_matrix(view, handedness).expect("a view");
            assert!((frame.origin().coords - eye).length() < 1e-5, "{frame:?}");
            let lens = Perspective::from_matrix(projection, space).expect("a pyramid");
            assert!((lens.near() - near).abs() < 1e-6 && (lens.far() - far).abs() < 0.01, "{lens:?}");
            let is_reversed = projection == lh::proj::directx::perspective(fov, aspect, far, near);
            for step in 0..200u8 {
                let [x, y, z] = [f32::from(step % 7) - 3.0, f32::from(step % 11) - 5.0, f32::from(step)];
                let ahead = (target - eye).normalize() * (1.0 + z * 0.25);
                let p = eye + ahead + Vec3::new(x, y, x - y) * 0.1;
                let [x, y, depth] = by_matrices(view, projection, space, p);
                let expected = [x, y, if is_reversed { 1.0 - depth } else { depth }];
                for (expected, found) in expected.iter().zip(by_parts(frame, &lens, p)) {
                    assert!((expected - found).abs() < 3e-5, "{space:?}, {p}: {found}, not {expected}");
                }
            }
        }
    }

    #[test]
    fn other_matrices_are_refused() {
        let view = |matrix| eye_of_matrix(matrix, Handedness::Right).err();
        let pyramid = rh::proj::directx::perspective(1.0, 1.0, 0.1, 10.0);
        assert_eq!(view(Mat4::from_scale(Vec3::splat(1.001))), Some(ViewError::Matrix));
        assert_eq!(view(Mat4::from_scale(Vec3::new(1.0, 1.0, -1.0))), Some(ViewError::Matrix));
        assert_eq!(view(pyramid), Some(ViewError::Matrix));
        assert_eq!(view(Mat4::IDENTITY * f32::NAN), Some(ViewError::NotFinite));
        let lens = |matrix| Perspective::from_matrix(matrix, ClipSpace::DirectX).err();
        assert_eq!(lens(pyramid), None);
        assert_eq!(lens(Mat4::IDENTITY), Some(ViewError::Matrix));
        assert_eq!(lens(pyramid * f32::NAN), Some(ViewError::NotFinite));
        let turned = rh::proj::vulkan::perspective(1.0, 1.0, 0.1, 10.0);
        assert_eq!(lens(turned), Some(ViewError::Matrix));
        let endless = rh::proj::directx::perspective_infinite(1.0, 1.0, 0.1);
        assert_eq!(lens(endless), Some(ViewError::NearFar));
        let askew = rh::proj::directx::frustum(-1.0, 2.0, -1.0, 1.0, 0.1, 10.0);
        assert_eq!(lens(askew), Some(ViewError::Matrix));
        let parallel = rh::proj::directx::orthographic(-1.0, 1.0, -1.0, 1.0, 0.1, 10.0);
        assert_eq!(lens(parallel), Some(ViewError::Matrix));
    }
}
