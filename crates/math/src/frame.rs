//! Affine frames: an origin and three axes, described in a parent space.

use crate::space::{Point3, Space, Vector3};
use core::marker::PhantomData;
use core::ops::Mul;
use glam::{Mat3, Vec3};

/// A frame whose own coordinates are in `Local` and whose origin and axes are described in `Parent`.
///
/// The point with local coordinates (a, b, c) is `origin + a x + b y + c z` in the parent, with the axes x, y, z.
/// Every change of reference in the pipeline is one of these: model to world, world to eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<Local, Parent> {
    axes: Mat3,
    origin: Vec3,
    spaces: PhantomData<(Local, Parent)>,
}

impl<L: Space, P: Space> Frame<L, P> {
    /// The frame whose coordinates are the parent's.
    pub const IDENTITY: Self = Self { axes: Mat3::IDENTITY, origin: Vec3::ZERO, spaces: PhantomData };

    /// The frame with this origin and these axes x, y, z. Axes need be neither unit nor perpendicular.
    #[must_use]
    pub const fn new(origin: Point3<P>, x: Vector3<P>, y: Vector3<P>, z: Vector3<P>) -> Self {
        Self {
            axes: Mat3::from_cols(x.coords, y.coords, z.coords),
            origin: origin.coords,
            spaces: PhantomData,
        }
    }

    /// The frame whose axes are the columns of `axes`.
    #[must_use]
    pub const fn from_mat3(axes: Mat3, origin: Point3<P>) -> Self {
        Self { axes, origin: origin.coords, spaces: PhantomData }
    }

    /// The parent's axes, moved to another origin.
    #[must_use]
    pub const fn at(origin: Point3<P>) -> Self {
        Self { axes: Mat3::IDENTITY, origin: origin.coords, spaces: PhantomData }
    }

    /// The origin, in the parent.
    #[must_use]
    pub const fn origin(&self) -> Point3<P> {
        Point3::new(self.origin)
    }

    /// The axes as columns, in the parent.
    #[must_use]
    pub const fn axes(&self) -> Mat3 {
        self.axes
    }

    /// The parent's coordinates of a point given in the frame's.
    ///
    /// # Precision
    /// Each component is within 4ε of the sum of the magnitudes of its four terms (ε = 2^-24).
    #[must_use]
    #[inline]
    pub fn to_parent(&self, p: Point3<L>) -> Point3<P> {
        Point3::new(self.turn(p.coords) + self.origin)
    }

    /// The parent's components of a vector given in the frame's: the origin plays no part.
    #[must_use]
    #[inline]
    pub fn vector_to_parent(&self, v: Vector3<L>) -> Vector3<P> {
        Vector3::new(self.turn(v.coords))
    }

    /// The parent described in this frame, for any axes that span space; `None` where they do not, or where the
    /// inverse is not finite.
    #[must_use]
    pub fn inverse(&self) -> Option<Frame<P, L>> {
        let determinant = self.axes.determinant();
        let inverse = self.axes.inverse();
        if determinant == 0.0 || !inverse.is_finite() {
            return None;
        }
        Some(Self::inverse_from(inverse, self.origin))
    }

    /// The parent described in this frame, for axes that are unit and perpendicular to each other: the rotation is
    /// inverted by transposing, the translation by negating.
    #[must_use]
    pub fn inverse_orthonormal(&self) -> Frame<P, L> {
        Self::inverse_from(self.axes.transpose(), self.origin)
    }

    fn inverse_from(inverse: Mat3, origin: Vec3) -> Frame<P, L> {
        let back = Frame { axes: inverse, origin: Vec3::ZERO, spaces: PhantomData };
        Frame { origin: -back.turn(origin), ..back }
    }

    /// Written out, so that the order of the operations is the same on every target.
    #[inline]
    fn turn(&self, v: Vec3) -> Vec3 {
        self.axes.x_axis * v.x + self.axes.y_axis * v.y + self.axes.z_axis * v.z
    }
}

/// `outer * inner` goes from the inner frame's coordinates straight to the outer frame's parent.
impl<L: Space, M: Space, P: Space> Mul<Frame<L, M>> for Frame<M, P> {
    type Output = Frame<L, P>;

    fn mul(self, inner: Frame<L, M>) -> Frame<L, P> {
        let axes = Mat3::from_cols(
            self.turn(inner.axes.x_axis),
            self.turn(inner.axes.y_axis),
            self.turn(inner.axes.z_axis),
        );
        Frame::from_mat3(axes, self.to_parent(inner.origin()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Eye, Object, World};

    /// Small integers and axes with determinant 1: every operation below is exact.
    fn sheared() -> Frame<Object, World> {
        Frame::new(
            Point3::new(Vec3::new(3.0, -2.0, 5.0)),
            Vector3::new(Vec3::new(1.0, 0.0, 0.0)),
            Vector3::new(Vec3::new(2.0, 1.0, 0.0)),
            Vector3::new(Vec3::new(-4.0, 3.0, 1.0)),
        )
    }

    #[test]
    fn coordinates_are_taken_along_the_axes_from_the_origin() {
        let p = sheared().to_parent(Point3::new(Vec3::new(1.0, 10.0, 100.0)));
        assert_eq!(p.coords, Vec3::new(3.0 + 1.0 + 20.0 - 400.0, -2.0 + 10.0 + 300.0, 105.0));
        let v = sheared().vector_to_parent(Vector3::new(Vec3::new(1.0, 10.0, 100.0)));
        assert_eq!(v.coords, Vec3::new(-379.0, 310.0, 100.0));
    }

    #[test]
    fn the_inverse_undoes_the_frame() {
        let frame = sheared();
        let there_and_back = frame.inverse().expect("axes span space") * frame;
        assert_eq!(there_and_back, Frame::IDENTITY);
    }

    #[test]
    fn the_orthonormal_inverse_is_the_general_one() {
        let turn = Mat3::from_cols(Vec3::Y, Vec3::Z, Vec3::X);
        let frame = Frame::<Eye, World>::from_mat3(turn, Point3::new(Vec3::new(1.0, 2.0, 4.0)));
        assert_eq!(Some(frame.inverse_orthonormal()), frame.inverse());
    }

    #[test]
    fn axes_in_one_plane_have_no_inverse() {
        let flat = Frame::<Object, World>::from_mat3(
            Mat3::from_cols(Vec3::X, Vec3::Y, Vec3::X + Vec3::Y),
            Point3::new(Vec3::ZERO),
        );
        assert_eq!(flat.inverse(), None);
    }
}
