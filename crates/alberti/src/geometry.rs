//! Meshes: vertices, the triangles between them, and the vertex stage, which says what a vertex means.

use crate::meshlets::{Ball, Meshlet};
use alberti_math::glam::Vec3;
use alberti_math::{Object, Point3, Q16, Varying};
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

    /// The edges of all triangles: those that two share twice.
    fn edges(&self) -> impl Iterator<Item = [usize; 2]> {
        let triangles = (0..self.triangles()).filter_map(|number| self.triangle(number));
        triangles.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
    }

    /// The edges of all triangles, each once, from the lower number to the higher and in the order of these. It is
    /// right for open meshes as well, and for edges of more than two triangles. `None` if there is no room for them.
    ///
    /// For a mesh that stays this is done once, when the program starts, or before it is compiled. As lines, a vertex
    /// at which all edges end has no pixel of its own, by the diamond-exit rule.
    ///
    /// ```
    /// use alberti::{Geometry, Mesh, glam::Vec3};
    ///
    /// // Two triangles with an edge in common.
    /// let mesh = Mesh::new(&[Vec3::ZERO; 4], &[[0u16, 1, 2], [2, 1, 3]], |&v| (v, ()));
    /// let mut room = [[0; 2]; 6];
    /// assert_eq!(mesh.unique_edges(&mut room), Some(&[[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]][..]));
    /// assert_eq!(mesh.unique_edges(&mut room[..4]), None);
    /// ```
    ///
    /// # Cost
    /// With room for three edges a triangle, one sort. With less it sorts whenever that is full, down to room for the
    /// edges alone.
    fn unique_edges<'e>(&self, room: &'e mut [[usize; 2]]) -> Option<&'e [[usize; 2]]> {
        let (mut count, mut full) = (0, false);
        for [a, b] in self.edges().filter(|[a, b]| a != b) {
            let edge = [a.min(b), a.max(b)];
            if count == room.len() && !full {
                count = sort_once(room);
                full = count == room.len();
            }
            if let Some(place) = room.get_mut(count) {
                *place = edge;
                count += 1;
            } else if room.binary_search(&edge).is_err() {
                return None;
            }
        }
        let (edges, _) = room.split_at_mut_checked(count)?;
        let count = sort_once(edges);
        edges.get(..count)
    }

    /// Whether vertices are integers. Then [`FixedPoint`](crate::FixedPoint) takes them from
    /// [`integers`](Self::integers), and everything else, the clipper too, the same numbers from
    /// [`vertex`](Self::vertex).
    const INTEGERS: bool = false;

    /// The unit of the integers' places.
    fn unit(&self) -> f32 {
        1.0
    }

    /// A vertex in integers; as [`vertex`](Self::vertex) otherwise.
    fn integers(&self, number: usize) -> Option<IntegerVertex<Self::Varying>> {
        let _ = number;
        None
    }

    /// Whether there are meshlets.
    const MESHLETS: bool = false;

    /// A meshlet, in the order of their triangles: see [`Meshlets`](crate::Meshlets). `None` from the last on.
    fn meshlet(&self, number: usize) -> Option<Meshlet> {
        let _ = number;
        None
    }

    /// The ball around the mesh with which the meshlets were made.
    fn ball(&self) -> Ball {
        Ball::EVERYTHING
    }
}

/// Sorts edges, leaves each once at the beginning, and returns how many these are.
fn sort_once(edges: &mut [[usize; 2]]) -> usize {
    edges.sort_unstable();
    let mut count = 0;
    let mut last = None;
    for k in 0..edges.len() {
        let edge = edges.get(k).copied();
        if edge != last
            && let (Some(edge), Some(place)) = (edge, edges.get_mut(count))
        {
            *place = edge;
            count += 1;
        }
        last = edge;
    }
    count
}

/// A vertex in integers.
#[derive(Clone, Copy)]
pub struct IntegerVertex<V: Varying> {
    /// The place, in the mesh's unit.
    pub place: [i16; 3],
    /// The components of the attributes: [`Q16::from_bits`] of 65536ths, say of a `u16` for a part of 1.
    pub components: V::Of<Q16>,
}

impl<V: Varying> IntegerVertex<V> {
    /// The place in object space, whose unit the mesh knows, and the attributes.
    #[inline]
    #[must_use]
    pub fn to_floats(&self, unit: f32) -> (Point3<Object>, V) {
        let place = Vec3::from_array(self.place.map(|c| f32::from(c) * unit));
        (place.into(), V::from_components(&V::map(&self.components, &Q16::to_f32)))
    }
}

impl<V: Varying> fmt::Debug for IntegerVertex<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("IntegerVertex").field("place", &self.place).finish_non_exhaustive()
    }
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

impl<T, I: Copy + Into<u32>, F> Mesh<'_, T, I, F> {
    /// The vertices of a triangle.
    #[inline]
    fn indices(&self, number: usize) -> Option<[usize; 3]> {
        let index = |i: I| usize::try_from(i.into()).unwrap_or(usize::MAX);
        let [a, b, c] = *self.triangles.get(number)?;
        Some([index(a), index(b), index(c)])
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
        self.indices(number)
    }

    #[inline]
    fn vertex(&self, number: usize) -> Option<(Point3<Object>, V)> {
        let (place, varying) = (self.vertex_stage)(self.vertices.get(number)?);
        Some((place.into(), varying))
    }
}

/// A [`Mesh`] whose vertex stage gives integers. With [`FixedPoint`](crate::FixedPoint) its vertices cost no operation
/// in floating point, which on a Cortex-M0 would be most of a frame's time; only triangles that are clipped do.
///
/// Vertices are in floats nevertheless where integers do not hold the view. The far plane has to be twice as far as the
/// near one, and the viewport narrower than the guard band. In parallel projection a mesh has to be within 2^20
/// subpixels.
///
/// # Precision
/// With `FixedPoint`, vertices in the view are within a quarter of a subpixel before they are snapped, and q within
/// 2^-22, while c h/w is up to 2^20. Depths are within 2^-22, and as much as moving z by 2^-22 c moves them. There c is
/// the greatest coordinate that half words could have before the eye, and h half the viewport in subpixels. w is z, or
/// 1 in parallel projection. With other policies, everything is as for a [`Mesh`].
///
/// # Cost
/// A vertex takes some 130 instructions on a Cortex-M4F, and some 310 on a Cortex-M0, where floats take 4,000.
///
/// ```
/// use alberti::{Geometry, IntegerMesh, IntegerVertex, Q16, glam::Vec2};
///
/// // Six bytes of place, four of texture coordinates; 1000 units are one of object space.
/// let vertices: [([i16; 3], [u16; 2]); 3] =
///     [([0, 0, 0], [0, 0]), ([1000, 0, 0], [65535, 0]), ([0, 1000, 0], [0, 65535])];
/// let mesh = IntegerMesh::new(&vertices, &[[0u16, 1, 2]], 0.001, |&(place, uv)| {
///     IntegerVertex::<Vec2> { place, components: uv.map(|c| Q16::from_bits(c.into())) }
/// });
/// assert_eq!(mesh.vertex(1).map(|(place, uv)| (place.coords.x, uv.x)), Some((1.0, 65535.0 / 65536.0)));
/// ```
#[derive(Clone, Copy)]
pub struct IntegerMesh<'a, T, I, F> {
    mesh: Mesh<'a, T, I, F>,
    unit: f32,
}

impl<'a, T, I, F> IntegerMesh<'a, T, I, F> {
    /// The mesh of these vertices, whose places are in this unit, with indices as in [`Mesh::new`].
    #[inline]
    pub const fn new<V>(vertices: &'a [T], triangles: &'a [[I; 3]], unit: f32, vertex_stage: F) -> Self
    where
        V: Varying,
        I: Copy + Into<u32>,
        F: Fn(&T) -> IntegerVertex<V>,
    {
        Self { mesh: Mesh { vertices, triangles, vertex_stage }, unit }
    }
}

impl<T, I, F, V> Geometry for IntegerMesh<'_, T, I, F>
where
    I: Copy + Into<u32>,
    F: Fn(&T) -> IntegerVertex<V>,
    V: Varying,
{
    type Varying = V;

    #[inline]
    fn triangles(&self) -> usize {
        self.mesh.triangles.len()
    }

    #[inline]
    fn vertices(&self) -> usize {
        self.mesh.vertices.len()
    }

    #[inline]
    fn triangle(&self, number: usize) -> Option<[usize; 3]> {
        self.mesh.indices(number)
    }

    #[inline]
    fn vertex(&self, number: usize) -> Option<(Point3<Object>, V)> {
        self.integers(number).map(|vertex| vertex.to_floats(self.unit))
    }

    const INTEGERS: bool = true;

    #[inline]
    fn unit(&self) -> f32 {
        self.unit
    }

    #[inline]
    fn integers(&self, number: usize) -> Option<IntegerVertex<V>> {
        Some((self.mesh.vertex_stage)(self.mesh.vertices.get(number)?))
    }
}

impl<T, I, F> fmt::Debug for IntegerMesh<'_, T, I, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("IntegerMesh").field("mesh", &self.mesh).field("unit", &self.unit).finish()
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
