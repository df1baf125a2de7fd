//! Affine frames of the plane: an origin and two axes, described in a parent space.

use crate::exact::cramer2;
use crate::space::{Point2, Space, Vector2};
use core::marker::PhantomData;
use core::ops::Mul;
use glam::{Mat2, Vec2};

/// [`Frame`](crate::Frame) in the plane: the point with local coordinates (a, b) is `origin + a x + b y` in the parent,
/// with the axes x, y.
///
/// The frame of a triangle, [`of_triangle`](Self::of_triangle), makes the barycentric coordinates β and γ the
/// coordinates of the plane:
///
/// ```
/// use alberti_math::{Frame2, Object, Point2, World, glam::Vec2};
///
/// let triangle = [Vec2::new(1.0, 1.0), Vec2::new(5.0, 1.0), Vec2::new(1.0, 3.0)].map(Point2::<World>::new);
/// let frame = Frame2::<Object, World>::of_triangle(triangle);
/// let p = Point2::new(Vec2::new(2.0, 2.0));
/// assert_eq!(frame.from_parent(p), Some(Point2::new(Vec2::new(0.25, 0.5))));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(bound = ""))]
#[cfg_attr(
    feature = "arbitrary",
    derive(arbitrary::Arbitrary),
    arbitrary(bound = "Local: Space, Parent: Space")
)]
pub struct Frame2<Local, Parent> {
    axes: Mat2,
    origin: Vec2,
    #[cfg_attr(feature = "serde", serde(skip))]
    spaces: PhantomData<(Local, Parent)>,
}

logged! {
    [L: Space, P: Space] Frame2<L, P>: "Frame2 {{ axes: {}, origin: {} }}",
        |frame| frame.axes.to_cols_array_2d(), frame.origin.to_array();
}

impl<L: Space, P: Space> Frame2<L, P> {
    /// The frame whose coordinates are the parent's.
    pub const IDENTITY: Self = Self::from_mat2(Mat2::IDENTITY, Point2::new(Vec2::ZERO));

    /// The frame with this origin and these axes x, y. Axes need be neither unit nor perpendicular.
    #[must_use]
    pub const fn new(origin: Point2<P>, x: Vector2<P>, y: Vector2<P>) -> Self {
        Self::from_mat2(Mat2::from_cols(x.coords, y.coords), origin)
    }

    /// The frame whose axes are the columns of `axes`.
    #[must_use]
    pub const fn from_mat2(axes: Mat2, origin: Point2<P>) -> Self {
        Self { axes, origin: origin.coords, spaces: PhantomData }
    }

    /// The parent's axes, moved to another origin.
    #[must_use]
    pub const fn at(origin: Point2<P>) -> Self {
        Self::from_mat2(Mat2::IDENTITY, origin)
    }

    /// The frame of a triangle: its first vertex is the origin, the edges to the other two are the axes.
    ///
    /// # Precision
    /// Each component of an axis is within 1ε of itself (ε = 2^-24). The effect of this on coordinates in the frame of
    /// a sliver is not bounded; the error of [`triangle_weights`](crate::triangle_weights) is.
    #[must_use]
    pub fn of_triangle([a, b, c]: [Point2<P>; 3]) -> Self {
        Self::new(a, b - a, c - a)
    }

    /// The origin, in the parent.
    #[must_use]
    pub const fn origin(&self) -> Point2<P> {
        Point2::new(self.origin)
    }

    /// The axes as columns, in the parent.
    #[must_use]
    pub const fn axes(&self) -> Mat2 {
        self.axes
    }

    /// The parent's coordinates of a point given in the frame's.
    ///
    /// # Precision
    /// Each component is within 3ε·max(the sum of the magnitudes of its three terms, `f32::MIN_POSITIVE`).
    #[must_use]
    #[inline]
    pub fn to_parent(&self, p: Point2<L>) -> Point2<P> {
        Point2::new(self.turn(p.coords) + self.origin)
    }

    /// The parent's components of a vector given in the frame's: the origin plays no part.
    ///
    /// # Precision
    /// Each component is within 2ε·max(the sum of the magnitudes of its two terms, `f32::MIN_POSITIVE`).
    #[must_use]
    #[inline]
    pub fn vector_to_parent(&self, v: Vector2<L>) -> Vector2<P> {
        Vector2::new(self.turn(v.coords))
    }

    /// The frame's coordinates of a point given in the parent's, by Cramer's rule; `None` where the axes are parallel,
    /// or where the result is not finite.
    ///
    /// # Precision
    /// Each is within 1.05ε·max(|exact|, `f32::MIN_POSITIVE`), however nearly parallel the axes are and however far
    /// away the origin.
    ///
    /// # Cost
    /// Three determinants of ten operations and two divisions in `f64`, in software on a core without it. A determinant
    /// of which more than 20 bits cancel takes some hundreds of operations. For many points there is
    /// [`inverse`](Self::inverse).
    #[must_use]
    pub fn from_parent(&self, p: Point2<P>) -> Option<Point2<L>> {
        self.coordinates([self.origin, p.coords]).map(Point2::new)
    }

    /// The frame's components of a vector given in the parent's; otherwise as [`from_parent`](Self::from_parent).
    #[must_use]
    pub fn vector_from_parent(&self, v: Vector2<P>) -> Option<Vector2<L>> {
        self.coordinates([Vec2::ZERO, v.coords]).map(Vector2::new)
    }

    /// The parent described in this frame, for any axes that span the plane; `None` where they do not, or where the
    /// inverse is not finite.
    ///
    /// # Precision
    /// Each component of its origin and axes is within 1.05ε·max(|exact|, `f32::MIN_POSITIVE`).
    ///
    /// # Cost
    /// Three times [`from_parent`](Self::from_parent).
    #[must_use]
    pub fn inverse(&self) -> Option<Frame2<P, L>> {
        let axis = |v| self.vector_from_parent(Vector2::new(v));
        Some(Frame2::new(self.from_parent(Point2::new(Vec2::ZERO))?, axis(Vec2::X)?, axis(Vec2::Y)?))
    }

    /// The parent described in this frame, for axes that are unit and perpendicular to each other: the rotation is
    /// inverted by transposing, the translation by negating.
    ///
    /// # Precision
    /// The axes are exact. Each component of the origin is within 2ε·max(the sum of the magnitudes of its two terms,
    /// `f32::MIN_POSITIVE`) of the product of the transposed axes and the negated origin.
    #[must_use]
    pub fn inverse_orthonormal(&self) -> Frame2<P, L> {
        let back = Frame2::from_mat2(self.axes.transpose(), Point2::new(Vec2::ZERO));
        Frame2 { origin: -back.turn(self.origin), ..back }
    }

    fn coordinates(&self, column: [Vec2; 2]) -> Option<Vec2> {
        let axes = self.axes.to_cols_array_2d().map(|axis| [[0.0; 2], axis]);
        cramer2(axes, column.map(|end| end.to_array())).map(Vec2::from)
    }

    /// Written out, so that the order of the operations is the same on every target.
    #[inline]
    fn turn(&self, v: Vec2) -> Vec2 {
        self.axes.x_axis * v.x + self.axes.y_axis * v.y
    }
}

/// `outer * inner` goes from the inner frame's coordinates straight to the outer frame's parent.
///
/// # Precision
/// Each axis is within the bound of [`Frame2::vector_to_parent`], the origin within that of [`Frame2::to_parent`].
impl<L: Space, M: Space, P: Space> Mul<Frame2<L, M>> for Frame2<M, P> {
    type Output = Frame2<L, P>;

    fn mul(self, inner: Frame2<L, M>) -> Frame2<L, P> {
        let axes = Mat2::from_cols(self.turn(inner.axes.x_axis), self.turn(inner.axes.y_axis));
        Frame2::from_mat2(axes, self.to_parent(inner.origin()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Object, World};

    /// Small integers and axes with determinant 1: every operation below is exact.
    fn sheared() -> Frame2<Object, World> {
        Frame2::new(
            Point2::new(Vec2::new(3.0, -2.0)),
            Vector2::new(Vec2::new(2.0, 3.0)),
            Vector2::new(Vec2::new(3.0, 5.0)),
        )
    }

    #[test]
    fn coordinates_go_there_and_back() {
        let (p, v) = (Point2::new(Vec2::new(1.0, 10.0)), Vector2::new(Vec2::new(1.0, 10.0)));
        assert_eq!(sheared().to_parent(p).coords, Vec2::new(35.0, 51.0));
        assert_eq!(sheared().vector_to_parent(v).coords, Vec2::new(32.0, 53.0));
        assert_eq!(sheared().from_parent(sheared().to_parent(p)), Some(p));
        assert_eq!(sheared().vector_from_parent(sheared().vector_to_parent(v)), Some(v));
    }

    #[test]
    fn the_inverse_undoes_the_frame() {
        let inverse = sheared().inverse().expect("axes span the plane");
        assert_eq!(inverse * sheared(), Frame2::IDENTITY);
        assert_eq!(sheared() * inverse, Frame2::IDENTITY);
        let turned =
            Frame2::<Object, World>::from_mat2(Mat2::from_cols(Vec2::Y, -Vec2::X), sheared().origin());
        assert_eq!(Some(turned.inverse_orthonormal()), turned.inverse());
    }

    #[test]
    fn parallel_axes_have_no_inverse() {
        let flat = Frame2::<Object, World>::from_mat2(
            Mat2::from_cols(Vec2::new(3.0, 1.0), Vec2::new(6.0, 2.0)),
            Point2::new(Vec2::ZERO),
        );
        assert_eq!((flat.inverse(), flat.from_parent(Point2::new(Vec2::ONE))), (None, None));
    }

    /// The frames of two triangles give the affine map from one to the other.
    #[test]
    fn frames_of_triangles_compose_to_their_map() {
        let from = [Vec2::new(1.0, 1.0), Vec2::new(2.0, 1.0), Vec2::new(3.0, 2.0)].map(Point2::<Object>::new);
        let to = [Vec2::new(0.0, 7.0), Vec2::new(4.0, 5.0), Vec2::new(9.0, 1.0)].map(Point2::<World>::new);
        let back = Frame2::<Object, Object>::of_triangle(from).inverse().expect("it has an area");
        let map = Frame2::of_triangle(to) * back;
        assert_eq!(from.map(|p| map.to_parent(p)), to);
        let p = Point2::new(Vec2::new(4.0, 8.0));
        assert_eq!(crate::map_triangle(p, from, to), Some(map.to_parent(p)));
    }
}
