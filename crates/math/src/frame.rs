//! Affine frames: an origin and three axes, described in a parent space.

use crate::exact::{cramer3, nearest};
use crate::lanes::Lanes;
use crate::orientation::doubled_area;
use crate::space::{Point3, Space, Vector3};
use core::marker::PhantomData;
use core::ops::Mul;
use glam::{Mat3, Vec3};

/// A frame whose own coordinates are in `Local` and whose origin and axes are described in `Parent`.
///
/// The point with local coordinates (a, b, c) is `origin + a x + b y + c z` in the parent, with the axes x, y, z.
/// Every change of reference in the pipeline is one of these: model to world, world to eye.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(bound = ""))]
#[cfg_attr(
    feature = "arbitrary",
    derive(arbitrary::Arbitrary),
    arbitrary(bound = "Local: Space, Parent: Space")
)]
pub struct Frame<Local, Parent> {
    axes: Mat3,
    origin: Vec3,
    #[cfg_attr(feature = "serde", serde(skip))]
    spaces: PhantomData<(Local, Parent)>,
}

logged! {
    [L: Space, P: Space] Frame<L, P>: "Frame {{ axes: {}, origin: {} }}",
        |frame| frame.axes.to_cols_array_2d(), frame.origin.to_array();
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

    /// The frame of a triangle: its first vertex is the origin, the edges to the other two are the axes x and y, and
    /// their cross product is z. So z is normal to the triangle, and as long as the parallelogram of the edges is
    /// large.
    ///
    /// In this frame x and y are the barycentric coordinates β and γ of a point's foot in the triangle's plane.
    ///
    /// # Precision
    /// Each component of x and y is within 1ε of itself (ε = 2^-24). Each of z is within
    /// 1.05ε·max(|exact|, `f32::MIN_POSITIVE`) of the cross product of the exact edges, infinite where that is beyond
    /// `f32::MAX`. The effect of this on coordinates in the frame of a sliver is not bounded; the error of
    /// [`triangle_weights`](crate::triangle_weights) is.
    ///
    /// # Cost
    /// Three times [`signed_area`](crate::signed_area).
    #[must_use]
    pub fn of_triangle(triangle: [Point3<P>; 3]) -> Self {
        let [a, b, c] = triangle;
        let corners = triangle.map(|v| v.coords.to_array());
        let shadow = |i: usize, j: usize| nearest(doubled_area(corners.map(|v| [v[i], v[j]])));
        let normal = Vec3::new(shadow(1, 2), shadow(2, 0), shadow(0, 1));
        Self::new(a, b - a, c - a, Vector3::new(normal))
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
    /// Each component is within 4ε·max(the sum of the magnitudes of its four terms, `f32::MIN_POSITIVE`).
    #[must_use]
    #[inline]
    pub fn to_parent(&self, p: Point3<L>) -> Point3<P> {
        Point3::new(self.turn(p.coords) + self.origin)
    }

    /// [`to_parent`](Self::to_parent) of several points, by their coordinates.
    #[must_use]
    #[inline(always)]
    pub fn to_parent_lanes<N: Lanes>(&self, lanes: N, [x, y, z]: [N::Number; 3]) -> [N::Number; 3] {
        let component = |[a, b, c]: [f32; 3], origin: f32| {
            lanes.splat(a) * x + lanes.splat(b) * y + lanes.splat(c) * z + lanes.splat(origin)
        };
        let [a, b, c] = [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis];
        let origin = self.origin;
        [
            component([a.x, b.x, c.x], origin.x),
            component([a.y, b.y, c.y], origin.y),
            component([a.z, b.z, c.z], origin.z),
        ]
    }

    /// The parent's components of a vector given in the frame's: the origin plays no part.
    ///
    /// # Precision
    /// Each component is within 3ε·max(the sum of the magnitudes of its three terms, `f32::MIN_POSITIVE`).
    #[must_use]
    #[inline]
    pub fn vector_to_parent(&self, v: Vector3<L>) -> Vector3<P> {
        Vector3::new(self.turn(v.coords))
    }

    /// The frame's coordinates of a point given in the parent's, by Cramer's rule; `None` where the axes are in one
    /// plane, or where the result is not finite.
    ///
    /// # Precision
    /// Each is within 1.05ε·max(|exact|, `f32::MIN_POSITIVE`), however nearly the axes are in one plane and however far
    /// away the origin.
    ///
    /// # Cost
    /// Four determinants of 35 operations and three divisions in `f64`, in software on a core without it. A determinant
    /// of which more than 20 bits cancel takes thousands of operations. For many points there is
    /// [`inverse`](Self::inverse).
    #[must_use]
    pub fn from_parent(&self, p: Point3<P>) -> Option<Point3<L>> {
        self.coordinates([self.origin, p.coords]).map(Point3::new)
    }

    /// The frame's components of a vector given in the parent's; otherwise as [`from_parent`](Self::from_parent).
    #[must_use]
    pub fn vector_from_parent(&self, v: Vector3<P>) -> Option<Vector3<L>> {
        self.coordinates([Vec3::ZERO, v.coords]).map(Vector3::new)
    }

    /// The parent described in this frame, for any axes that span space; `None` where they do not, or where the
    /// inverse is not finite.
    ///
    /// # Precision
    /// Each component of its origin and axes is within 1.05ε·max(|exact|, `f32::MIN_POSITIVE`).
    ///
    /// # Cost
    /// Four times [`from_parent`](Self::from_parent).
    #[must_use]
    pub fn inverse(&self) -> Option<Frame<P, L>> {
        let axis = |v| self.vector_from_parent(Vector3::new(v));
        let origin = self.from_parent(Point3::new(Vec3::ZERO))?;
        Some(Frame::new(origin, axis(Vec3::X)?, axis(Vec3::Y)?, axis(Vec3::Z)?))
    }

    /// The parent described in this frame, for axes that are unit and perpendicular to each other: the rotation is
    /// inverted by transposing, the translation by negating.
    ///
    /// # Precision
    /// The axes are exact. Each component of the origin is within 3ε·max(the sum of the magnitudes of its three terms,
    /// `f32::MIN_POSITIVE`) of the product of the transposed axes and the negated origin.
    #[must_use]
    pub fn inverse_orthonormal(&self) -> Frame<P, L> {
        let back = Frame::from_mat3(self.axes.transpose(), Point3::new(Vec3::ZERO));
        Frame { origin: -back.turn(self.origin), ..back }
    }

    fn coordinates(&self, column: [Vec3; 2]) -> Option<Vec3> {
        let axes = self.axes.to_cols_array_2d().map(|axis| [[0.0; 3], axis]);
        cramer3(axes, column.map(|end| end.to_array())).map(Vec3::from)
    }

    /// Written out, so that the order of the operations is the same on every target.
    #[inline]
    fn turn(&self, v: Vec3) -> Vec3 {
        self.axes.x_axis * v.x + self.axes.y_axis * v.y + self.axes.z_axis * v.z
    }
}

/// `outer * inner` goes from the inner frame's coordinates straight to the outer frame's parent.
///
/// # Precision
/// Each axis is within the bound of [`Frame::vector_to_parent`], the origin within that of [`Frame::to_parent`].
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
        assert_eq!((flat.inverse(), flat.from_parent(Point3::new(Vec3::ONE))), (None, None));
    }

    #[test]
    fn coordinates_come_back_from_the_parent() {
        let p = Vec3::new(1.0, 10.0, 100.0);
        let there = sheared().to_parent(Point3::new(p));
        assert_eq!(sheared().from_parent(there), Some(Point3::new(p)));
        let there = sheared().vector_to_parent(Vector3::new(p));
        assert_eq!(sheared().vector_from_parent(there), Some(Vector3::new(p)));
    }

    /// Edges (2, 0, 0) and (0, 0, 4) from (1, 1, 1): the normal is (0, -8, 0).
    #[test]
    fn the_frame_of_a_triangle_has_its_edges_and_normal() {
        let corners = [Vec3::ONE, Vec3::new(3.0, 1.0, 1.0), Vec3::new(1.0, 1.0, 5.0)];
        let frame = Frame::<Object, World>::of_triangle(corners.map(Point3::new));
        assert_eq!(frame.axes(), Mat3::from_cols(Vec3::X * 2.0, Vec3::Z * 4.0, Vec3::Y * -8.0));
        let above = frame.from_parent(Point3::new(Vec3::new(1.5, -7.0, 3.0)));
        assert_eq!(above, Some(Point3::new(Vec3::new(0.25, 0.5, 1.0))));
    }
}
