//! Meshes: vertices, the triangles between them, and the vertex stage, which says what a vertex means.

use alberti_math::{Object, Point3, Varying};
use core::fmt;

/// A source of triangles in object space: a [`Mesh`], or one of yours, which may compute its vertices.
pub trait Geometry {
    /// The attributes of a vertex.
    type Varying: Varying;

    /// The number of triangles.
    fn triangles(&self) -> usize;

    /// The number of vertices, if all of them may be transformed ahead of the triangles. Those of a pass with as many
    /// slots are, several at a time. Without it each is transformed where a triangle needs it.
    fn vertices(&self) -> usize {
        usize::MAX
    }

    /// The numbers of a triangle's vertices, counter-clockwise as seen from the front; `None` from
    /// [`triangles`](Self::triangles) on.
    fn triangle(&self, number: usize) -> Option<[usize; 3]>;

    /// The place of a vertex, and its attributes. A triangle with a vertex that is `None` is left out.
    fn vertex(&self, number: usize) -> Option<(Point3<Object>, Self::Varying)>;
}

/// Vertices of any type, indexed triangles, and a vertex stage: a function from a vertex to its place in object space
/// and its attributes.
///
/// ```
/// use alberti::{Geometry, Mesh, glam::Vec3};
///
/// let vertices = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)];
/// let mesh = Mesh::new(&vertices, &[[0u16, 1, 2]], |&(x, y)| (Vec3::new(x, y, 0.0), x));
/// assert_eq!(mesh.vertex(1).map(|(place, x)| (place.coords.x, x)), Some((1.0, 1.0)));
/// ```
#[derive(Clone, Copy)]
pub struct Mesh<'a, T, I, F> {
    vertices: &'a [T],
    triangles: &'a [[I; 3]],
    vertex_stage: F,
}

impl<'a, T, I, F> Mesh<'a, T, I, F> {
    /// The mesh of these vertices, with three indices (`u8`, `u16` or `u32`) a triangle, counter-clockwise as seen from
    /// the front. An index out of range drops its triangle.
    #[inline]
    pub const fn new<P, V>(vertices: &'a [T], triangles: &'a [[I; 3]], vertex_stage: F) -> Self
    where
        I: Copy + Into<u32>,
        F: Fn(&T) -> (P, V),
    {
        Self { vertices, triangles, vertex_stage }
    }
}

impl<T, I, F, P, V> Geometry for Mesh<'_, T, I, F>
where
    I: Copy + Into<u32>,
    F: Fn(&T) -> (P, V),
    P: Into<Point3<Object>>,
    V: Varying,
{
    type Varying = V;

    #[inline]
    fn triangles(&self) -> usize {
        self.triangles.len()
    }

    #[inline]
    fn vertices(&self) -> usize {
        self.vertices.len()
    }

    #[inline]
    fn triangle(&self, number: usize) -> Option<[usize; 3]> {
        let index = |i: I| usize::try_from(i.into()).unwrap_or(usize::MAX);
        let [a, b, c] = *self.triangles.get(number)?;
        Some([index(a), index(b), index(c)])
    }

    #[inline]
    fn vertex(&self, number: usize) -> Option<(Point3<Object>, V)> {
        let (place, varying) = (self.vertex_stage)(self.vertices.get(number)?);
        Some((place.into(), varying))
    }
}

impl<T, I, F> fmt::Debug for Mesh<'_, T, I, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mesh")
            .field("vertices", &self.vertices.len())
            .field("triangles", &self.triangles.len())
            .finish_non_exhaustive()
    }
}
