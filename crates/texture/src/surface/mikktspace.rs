//! Tangents as MikkTSpace defines them, for maps that other programs made.
//!
//! Space in: positions and normals in object space, coordinates (u, v). Space out: tangents as glTF has them.

use super::mesh::LengthError;
use alberti_math::lanes::{Lanes, One};
use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};
use glam::{Vec2, Vec3};

/// The tangents of each triangle's corners by MikkTSpace, as glTF has them: a unit vector, and the handedness w.
///
/// A normal map is right only in the frames that it was made in, and most tools make it in these. They belong to
/// corners, not to vertices: where the corners at a vertex differ, as at the seam of a mirrored texture, the vertex has
/// to become several. Where no such map is at hand, [`vertex_tangents`](super::vertex_tangents) does without memory.
///
/// A triangle with an index out of range, or with a number that is not finite or is beyond ±2^30, is left out. Its
/// corners, and those to which the algorithm gives no tangent, have (1, 0, 0) and w = -1, as in the original. So do
/// those to which the algorithm gives zero, or, as happens to triangles smaller than 10^-18, a vector that is not of
/// length 1. The result is never NaN, and lengths are within 10^-5 of 1.
///
/// Source: Mikkelsen, "Simulation of wrinkled surfaces revisited", 2008, and its reference implementation, of which
/// `bevy_mikktspace` is a translation. Its known faults are kept, as they are part of the convention that tools agree
/// on.
///
/// # Precision
/// The reference implementation's bits, for the same arithmetic: `f32` throughout, and an arc cosine in `f64`. The same
/// on every target.
///
/// The exception are meshes that have triangles with two corners at one place: there one corner in 1000 or so has
/// another tangent. The reference leaves its last edges unsorted and so misses neighbours. Which edges are last depends
/// on the numbers of vertices, and the translation numbers them after it has put such triangles aside. Leave them out
/// before, and the bits are those of the reference without them.
///
/// # Cost
/// Sorts and groups corners in memory that it allocates: some 500 bytes a triangle.
///
/// # Errors
/// When there are not as many normals or coordinates as positions, or not as many results as triangles.
pub fn mikktspace(
    positions: &[Vec3],
    normals: &[Vec3],
    uvs: &[Vec2],
    triangles: &[[u32; 3]],
    corners: &mut [[[f32; 4]; 3]],
) -> Result<(), LengthError> {
    LengthError::check(positions.len(), [normals.len(), uvs.len()])?;
    LengthError::check(triangles.len(), [corners.len()])?;
    corners.fill([NO_TANGENT; 3]);
    let mut mesh = Mesh { positions, normals, uvs, triangles, corners };
    match generate_tangents::<_, Arithmetic>(&mut mesh) {
        // No error exists, and none would leave anything but what there is.
        Ok(()) | Err(_) => Ok(()),
    }
}

/// The original's tangent for a corner that no triangle with an area is near to.
const NO_TANGENT: [f32; 4] = [1.0, 0.0, 0.0, -1.0];

/// The greatest coordinate: squares of differences, times areas, stay finite.
const LARGEST: f32 = 1_073_741_824.0;

struct Mesh<'a> {
    positions: &'a [Vec3],
    normals: &'a [Vec3],
    uvs: &'a [Vec2],
    triangles: &'a [[u32; 3]],
    corners: &'a mut [[[f32; 4]; 3]],
}

impl Mesh<'_> {
    fn index(&self, face: usize, corner: usize) -> usize {
        self.triangles.get(face).and_then(|triangle| triangle.get(corner)).map_or(usize::MAX, |&i| i as usize)
    }

    fn is_usable(&self, face: usize) -> bool {
        let in_range = |numbers: &[f32]| numbers.iter().all(|x| x.abs() <= LARGEST);
        (0..3).map(|corner| self.index(face, corner)).all(|i| {
            match (self.positions.get(i), self.normals.get(i), self.uvs.get(i)) {
                (Some(p), Some(n), Some(t)) => {
                    in_range(&p.to_array()) && in_range(&n.to_array()) && in_range(&t.to_array())
                }
                _ => false,
            }
        })
    }
}

impl Geometry<Arithmetic> for Mesh<'_> {
    fn num_faces(&self) -> usize {
        self.triangles.len()
    }

    /// Faces without vertices are not looked at.
    fn num_vertices_of_face(&self, face: usize) -> usize {
        if self.is_usable(face) { 3 } else { 0 }
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.positions.get(self.index(face, corner)).map_or([0.0; 3], Vec3::to_array)
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.normals.get(self.index(face, corner)).map_or([0.0; 3], Vec3::to_array)
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.uvs.get(self.index(face, corner)).map_or([0.0; 2], Vec2::to_array)
    }

    fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, corner: usize) {
        let Some(tangent) = tangent.map(|tangent| tangent.tangent_encoded()) else { return };
        let [x, y, z, _] = tangent;
        // The original makes unit vectors, or zero, or what is left where squares are below the least numbers.
        let is_unit = (0.99999..1.00001).contains(&Vec3::new(x, y, z).length_squared());
        let result = self.corners.get_mut(face).and_then(|corners| corners.get_mut(corner));
        if let Some(result) = result.filter(|_| is_unit) {
            *result = tangent;
        }
    }
}

/// The functions that the algorithm needs; none of them depends on the target.
#[derive(Clone, Copy)]
struct Arithmetic;

impl Ops for Arithmetic {
    fn sqrt(x: f32) -> f32 {
        One.sqrt(x)
    }

    #[expect(clippy::cast_possible_truncation, reason = "rounding, as the original does")]
    fn acos(x: f32) -> f32 {
        libm::acos(x.into()) as f32
    }
}
