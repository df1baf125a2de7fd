//! Displacement maps: vertices that go where the heights say, on meshes that are fine enough to show it.
//!
//! Space in: coordinates (u, v), points and normals in object space. Space out: vertices in object space.

use super::height::HeightMap;
use super::mesh::{LengthError, add_normals};
use super::parametric::Parametric;
use super::relief::Relief;
use super::unit::{narrow, unit};
use alberti_math::{Object, Point3, Vector3};
use glam::{Vec2, Vec3};

/// The point, moved by `height` along the unit `normal`.
///
/// # Precision
/// Each component is within 1ε·|result| + 1ε·|height| (ε = 2^-24).
#[must_use]
#[inline]
pub fn displaced(point: Point3<Object>, normal: Vector3<Object>, height: f32) -> Point3<Object> {
    point + normal * height
}

/// Moves each vertex of a mesh along its unit normal by the height at its coordinates. For the normals of the result
/// there is [`vertex_normals`](super::vertex_normals).
///
/// Vertices at the same place with different normals, as along a crease, are torn apart.
///
/// # Precision
/// [`Relief::height`], and [`displaced`].
///
/// # Errors
/// When there are not as many normals or coordinates as positions.
pub fn displace(
    relief: &Relief<impl HeightMap>,
    normals: &[Vec3],
    uvs: &[Vec2],
    positions: &mut [Vec3],
) -> Result<(), LengthError> {
    LengthError::check(positions.len(), [normals.len(), uvs.len()])?;
    for ((position, normal), uv) in positions.iter_mut().zip(normals).zip(uvs) {
        let (point, normal) = (Point3::new(*position), Vector3::new(*normal));
        *position = displaced(point, normal, relief.height(*uv)).coords;
    }
    Ok(())
}

/// The square from (0, 0) to (1, 1) of (u, v) as rows of vertices, with two triangles between any four of them.
///
/// ```text
///   6 --- 7 --- 8      vertex = row * (columns + 1) + column
///   | 4 / | 6 / |
///   |/ 5  |/ 7  |      triangles counter-clockwise, with v up
///   3 --- 4 --- 5
///   | 0 / | 2 / |
///   |/ 1  |/ 3  |
///   0 --- 1 --- 2
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "super::form::Cells", into = "super::form::Cells"))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Grid {
    pub(super) columns: u32,
    pub(super) rows: u32,
    /// The number of half cells between the border of the square and the outermost vertices.
    pub(super) margin: u32,
}

impl Grid {
    /// The greatest number of columns or rows of cells.
    pub const MAX_CELLS: u32 = 1 << 14;

    /// A grid of so many cells, at least one and at most [`MAX_CELLS`](Self::MAX_CELLS) a side, from border to border.
    #[must_use]
    pub const fn new(columns: u32, rows: u32) -> Self {
        Self { columns: in_range(columns), rows: in_range(rows), margin: 0 }
    }

    /// A vertex in the middle of each texel of a map of this size, at least two a side. The outermost are half a texel
    /// away from the border.
    #[must_use]
    pub const fn of_texels(width: u32, height: u32) -> Self {
        Self {
            columns: in_range(width.saturating_sub(1)),
            rows: in_range(height.saturating_sub(1)),
            margin: 1,
        }
    }

    /// As few cells as have edges no longer than `length` on a flat surface of this `extent`, as far as
    /// [`MAX_CELLS`](Self::MAX_CELLS) goes. Their diagonals are longer, by √2 at most.
    #[must_use]
    pub fn of_edges(extent: Vec2, length: f32) -> Self {
        Self::new(pieces(extent.x, length), pieces(extent.y, length))
    }

    /// The number of vertices.
    #[must_use]
    pub const fn vertices(self) -> usize {
        (self.columns as usize + 1) * (self.rows as usize + 1)
    }

    /// The number of triangles.
    #[must_use]
    pub const fn triangles(self) -> usize {
        2 * self.columns as usize * self.rows as usize
    }

    /// The coordinates of a vertex.
    ///
    /// # Precision
    /// Correctly rounded quotients.
    #[must_use]
    pub fn uv(self, vertex: u32) -> Vec2 {
        let across = self.columns + 1;
        let at = |k: u32, cells: u32| {
            #[expect(clippy::cast_precision_loss, reason = "at most 2^15")]
            let (halves, whole) = ((2 * k + self.margin) as f32, (2 * (cells + self.margin)) as f32);
            halves / whole
        };
        Vec2::new(at(vertex % across, self.columns), at((vertex / across).min(self.rows), self.rows))
    }

    /// The vertices of a triangle, which must be one of [`triangles`](Self::triangles).
    #[must_use]
    pub const fn triangle(self, triangle: u32) -> [u32; 3] {
        let (cell, across) = (triangle / 2, self.columns + 1);
        let low = (cell / self.columns).wrapping_mul(across).wrapping_add(cell % self.columns);
        let high = low.wrapping_add(across);
        if triangle.is_multiple_of(2) {
            [low, high.wrapping_add(1), high]
        } else {
            [low, low.wrapping_add(1), high.wrapping_add(1)]
        }
    }
}

/// A triangle as `n`² triangles, between rows of vertices that are parallel to one edge.
///
/// ```text
///          0                 the weights of vertex (row, place) are
///         / \                (n − row, row − place, place) / n
///        / 0 \
///       1 --- 2              vertex = row (row + 1) / 2 + place
///      / \ 2 / \
///     / 1 \ / 3 \            triangles turn the way the whole one does
///    3 --- 4 --- 5
/// ```
///
/// Two triangles that share an edge, and are divided into as many, have the same vertices along it, in whichever order
/// their corners are given. These are the same bit for bit but for the signs of zeros: no cracks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "super::form::Parts", into = "super::form::Parts"))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Subdivision {
    n: u32,
}

impl Subdivision {
    /// The greatest number of parts of an edge.
    pub const MAX_PARTS: u32 = 1 << 14;

    /// Edges in so many parts, at least one and at most [`MAX_PARTS`](Self::MAX_PARTS).
    #[must_use]
    pub const fn new(n: u32) -> Self {
        Self { n: in_range(n) }
    }

    /// As few parts as leave no edge of the triangle longer than `length`, as far as [`MAX_PARTS`](Self::MAX_PARTS)
    /// goes. Neighbours with other edges may take other parts: for a mesh without cracks use the greatest for all.
    #[must_use]
    pub fn of_edges([a, b, c]: [Point3<Object>; 3], length: f32) -> Self {
        let [a, b, c] = [b - a, c - b, a - c].map(|edge| edge.coords.length());
        Self::new(pieces(a.max(b).max(c), length))
    }

    /// The number of parts of an edge.
    #[must_use]
    pub const fn parts(self) -> u32 {
        self.n
    }

    /// The number of vertices, (n + 1)(n + 2)/2.
    #[must_use]
    pub const fn vertices(self) -> usize {
        let n = self.n as usize;
        (n + 1) * (n + 2) / 2
    }

    /// The number of triangles, n².
    #[must_use]
    pub const fn triangles(self) -> usize {
        self.n as usize * self.n as usize
    }

    /// The barycentric coordinates of a vertex, for [`interpolate`](alberti_math::interpolate).
    ///
    /// # Precision
    /// Correctly rounded quotients.
    #[must_use]
    pub fn weights(self, vertex: u32) -> [f32; 3] {
        // The greatest row whose first vertex, row (row + 1)/2, is not after this.
        let row = ((8 * u64::from(vertex) + 1).isqrt() - 1) / 2;
        let place = u64::from(vertex) - row * (row + 1) / 2;
        let row = row.min(self.n.into());
        #[expect(clippy::cast_precision_loss, reason = "at most 2^14")]
        [u64::from(self.n) - row, row.saturating_sub(place), place].map(|part| part as f32 / self.n as f32)
    }

    /// The vertices of a triangle, which must be one of [`triangles`](Self::triangles).
    #[must_use]
    pub const fn triangle(self, triangle: u32) -> [u32; 3] {
        let row = triangle.isqrt();
        let (place, odd) = ((triangle - row * row) / 2, (triangle - row * row) % 2 == 1);
        // row (row + 1)/2, without a product that is too large before it is halved.
        let upper = row.div_ceil(2) * ((row / 2) * 2 + 1) + place;
        let lower = upper + row + 1;
        if odd { [upper, lower + 1, upper + 1] } else { [upper, lower, lower + 1] }
    }
}

/// Between 1 and 2^14.
const fn in_range(cells: u32) -> u32 {
    match cells {
        0 => 1,
        1..=Grid::MAX_CELLS => cells,
        _ => Grid::MAX_CELLS,
    }
}

/// The least number of parts of `whole` that are no longer than `length`; saturates, and NaN gives 0.
fn pieces(whole: f32, length: f32) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturation is wanted")]
    let down = (whole / length) as u32;
    #[expect(clippy::cast_precision_loss, reason = "beyond 2^14 it does not count")]
    let short = down as f32 * length < whole;
    down.saturating_add(u32::from(short))
}

/// The buffers of a mesh, of the caller's.
#[derive(Debug)]
pub struct MeshBuffers<'a> {
    /// One for each vertex.
    pub positions: &'a mut [Vec3],
    /// One for each vertex.
    pub normals: &'a mut [Vec3],
    /// One for each vertex.
    pub uvs: &'a mut [Vec2],
    /// Indices of vertices.
    pub triangles: &'a mut [[u32; 3]],
}

/// The mesh of a surface with a height map on it: vertices on a grid, moved along the surface's normal, with the
/// normals of the mesh that results.
///
/// Borders of the grid can meet on the surface, as u = 0 and u = 1 do on a sphere. Such borders have vertices of their
/// own, whose normals count the triangles of one side only.
///
/// # Precision
/// Positions: the surface's, [`Relief::height`] and [`displaced`]. Normals: those of the triangles, as
/// [`vertex_normals`](super::vertex_normals) has them; they come near to those of the surface as the grid gets finer. A
/// vertex all of whose triangles have no area, as at a pole, has the normal of the surface without the heights.
///
/// # Cost
/// For each vertex an orthonormal frame, a height, and the normals of two triangles.
///
/// # Errors
/// When a buffer is not as long as [`Grid::vertices`] or [`Grid::triangles`] say.
///
/// ```
/// use alberti_math::Object;
/// use alberti_texture::surface::{Grid, MeshBuffers, Relief, Sphere, displaced_mesh};
/// use glam::{Vec2, Vec3};
///
/// const GRID: Grid = Grid::new(16, 8);
/// let (mut positions, mut normals) = ([Vec3::ZERO; GRID.vertices()], [Vec3::ZERO; GRID.vertices()]);
/// let (mut uvs, mut triangles) = ([Vec2::ZERO; GRID.vertices()], [[0; 3]; GRID.triangles()]);
/// let mesh = MeshBuffers {
///     positions: &mut positions,
///     normals: &mut normals,
///     uvs: &mut uvs,
///     triangles: &mut triangles,
/// };
/// let hill = Relief { map: |uv: Vec2| uv.y * (1.0 - uv.y), low: 0.0, high: 2.0, extent: Vec2::ONE };
/// displaced_mesh(&Sphere { radius: 1.0 }, &hill, GRID, mesh)?;
/// // The equator, a quarter of 2 above the sphere.
/// assert_eq!(positions[4 * 17], Vec3::new(0.0, 0.0, 1.5));
/// # Ok::<(), alberti_texture::surface::LengthError>(())
/// ```
pub fn displaced_mesh(
    surface: &impl Parametric,
    relief: &Relief<impl HeightMap>,
    grid: Grid,
    mesh: MeshBuffers<'_>,
) -> Result<(), LengthError> {
    let MeshBuffers { positions, normals, uvs, triangles } = mesh;
    LengthError::check(grid.vertices(), [positions.len(), normals.len(), uvs.len()])?;
    LengthError::check(grid.triangles(), [triangles.len()])?;
    for ((k, uv), position) in (0..).zip(&mut *uvs).zip(&mut *positions) {
        *uv = grid.uv(k);
        let frame = surface.orthonormal_frame(*uv);
        let normal = Vector3::new(frame.axes().z_axis);
        *position = displaced(frame.origin(), normal, relief.height(*uv)).coords;
    }
    for (k, triangle) in (0..).zip(&mut *triangles) {
        *triangle = grid.triangle(k);
    }
    normals.fill(Vec3::ZERO);
    add_normals(positions, triangles, normals);
    for (normal, uv) in normals.iter_mut().zip(uvs) {
        *normal =
            unit(normal.as_dvec3()).map_or_else(|| surface.orthonormal_frame(*uv).axes().z_axis, narrow);
    }
    Ok(())
}
