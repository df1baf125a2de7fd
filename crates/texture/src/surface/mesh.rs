//! Normals and tangents of the vertices of indexed meshes, in the caller's buffers.
//!
//! Space in: positions and normals in object space, coordinates (u, v). Space out: the same.

use super::tangent::{Tangent, frame, triangle_frame};
use super::unit::{narrow, perpendicular, reject, unit};
use alberti_math::{Frame, Object, Point3, Vector3};
use core::{error, fmt};
use glam::{DVec3, Vec2, Vec3};

/// The normal of each vertex: the mean of those of its triangles, weighted by their areas, as a unit vector. (0, 0, 1)
/// where there is none.
///
/// A triangle with an index out of range, without area, or that is not finite, counts for nothing. Vertices that stand
/// at the same place count as different ones, which keeps a crease.
///
/// # Precision
/// For a vertex of k triangles, within (k + 2)ε·r radians (ε = 2^-24), for edges of 10^-16 to 10^15 and angles whose
/// sines are 2^-20 and more. Here r is the sum of the areas over the length of the sum of the normals weighted by them.
/// The order of the triangles can show in the last bits. Lengths are within 1.1ε of 1.
///
/// # Cost
/// [`Frame::of_triangle`] for each triangle, a square root in `f64` for each vertex, in software on a core without it.
///
/// # Errors
/// When there are not as many normals as positions.
pub fn vertex_normals(
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    normals: &mut [Vec3],
) -> Result<(), LengthError> {
    LengthError::check(positions.len(), [normals.len()])?;
    normals.fill(Vec3::ZERO);
    add_normals(positions, triangles, normals);
    for normal in normals {
        *normal = unit(normal.as_dvec3()).map_or(Vec3::Z, narrow);
    }
    Ok(())
}

/// Adds to each vertex the normals of its triangles, as long as their doubled areas are large.
pub(super) fn add_normals(positions: &[Vec3], triangles: &[[u32; 3]], normals: &mut [Vec3]) {
    for &triangle in triangles {
        let Some(corners) = corners(positions, triangle) else { continue };
        let doubled = Frame::<Tangent, Object>::of_triangle(corners.map(Point3::new)).axes().z_axis;
        if doubled.is_finite() {
            for i in triangle {
                if let Some(normal) = normals.get_mut(i as usize) {
                    *normal += doubled;
                }
            }
        }
    }
}

/// The tangent of each vertex, as glTF has it: x, y and z are the unit vector in the direction of growing u, and w is
/// the handedness. So the direction of growing v is w (normal × tangent). [`frame_of_tangent`] makes a frame of it.
///
/// The tangent is the mean of those of its triangles ([`triangle_frame`]), weighted by their areas, made perpendicular
/// to the vertex's normal (Gram and Schmidt). w is that of the greater part of the area, 1 where both are equal:
/// vertices on the seam of a mirrored texture should be two. Weights by angle, as MikkTSpace has them, depend less on
/// how a mesh is cut into triangles, but take an arc cosine for each corner.
///
/// A triangle without a frame, as its texture has no area, counts for nothing, as does one with an index out of range.
/// A vertex without a tangent gets the one that [`frame_of_normal`](super::frame_of_normal) chooses. The result is
/// never NaN.
///
/// # Precision
/// For a vertex of k triangles, within (k + 5)ε·r radians (ε = 2^-24), for triangles as in [`triangle_frame`], and a
/// weighted sum that is not within 2^-5 radians of the normal. Here r is the sum of the areas over the length of the
/// weighted sum, as far as it is perpendicular to the normal. Lengths are within 1.1ε of 1, and the cosine between
/// tangent and normal is within 1.1ε of 0 for a normal of length 1.
///
/// # Cost
/// [`triangle_frame`] for each triangle, three square roots in `f64` for each vertex, in software on a core without it.
/// No other memory than that of the results.
///
/// # Errors
/// When there are not as many normals, coordinates or tangents as positions.
pub fn vertex_tangents(
    positions: &[Vec3],
    normals: &[Vec3],
    uvs: &[Vec2],
    triangles: &[[u32; 3]],
    tangents: &mut [[f32; 4]],
) -> Result<(), LengthError> {
    LengthError::check(positions.len(), [normals.len(), uvs.len(), tangents.len()])?;
    tangents.fill([0.0; 4]);
    for &triangle in triangles {
        let Some(weighted) = weighted_tangent(positions, uvs, triangle) else { continue };
        for i in triangle {
            for (sum, component) in tangents.get_mut(i as usize).into_iter().flatten().zip(weighted) {
                *sum += component;
            }
        }
    }
    for (tangent, normal) in tangents.iter_mut().zip(normals) {
        let [x, y, z, w] = *tangent;
        let z_axis = unit(normal.as_dvec3());
        let along = unit(Vec3::new(x, y, z).as_dvec3());
        let found = match z_axis {
            Some(n) => along.and_then(|x| reject(x, n)).unwrap_or_else(|| perpendicular(n)),
            None => along.unwrap_or(DVec3::X),
        };
        let [x, y, z] = narrow(found).to_array();
        *tangent = [x, y, z, if w < 0.0 { -1.0 } else { 1.0 }];
    }
    Ok(())
}

/// A triangle's tangent times its doubled area, and that area with the sign of its handedness; `None` where one is not
/// finite.
fn weighted_tangent(positions: &[Vec3], uvs: &[Vec2], triangle: [u32; 3]) -> Option<[f32; 4]> {
    let corners = corners(positions, triangle)?.map(Point3::new);
    let axes = triangle_frame(corners, self::corners(uvs, triangle)?)?.axes();
    let doubled = Frame::<Tangent, Object>::of_triangle(corners).axes().z_axis.as_dvec3();
    // Along the unit normal, which is as long as the area is large.
    let area = doubled.dot(axes.z_axis.as_dvec3());
    let mirrored = axes.x_axis.cross(axes.y_axis).dot(axes.z_axis) < 0.0;
    let [x, y, z] = narrow(axes.x_axis.as_dvec3() * area).to_array();
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
    let area = if mirrored { -area } else { area } as f32;
    area.is_finite().then_some([x, y, z, area])
}

/// The frame at a vertex with a unit normal and a tangent as glTF has it: unit axes at right angles, z along the
/// normal, y = w (z × x).
///
/// Where one of them has no direction, it is chosen as in [`orthonormal`](super::orthonormal).
///
/// # Precision
/// Lengths are within 1.1ε of 1, and the cosines between axes within 2.2ε of 0 (ε = 2^-24).
#[must_use]
pub fn frame_of_tangent(
    point: Point3<Object>,
    normal: Vector3<Object>,
    [x, y, z, w]: [f32; 4],
) -> Frame<Tangent, Object> {
    let normal = unit(normal.coords.as_dvec3());
    let along = unit(Vec3::new(x, y, z).as_dvec3());
    let (z, x) = match (normal, along) {
        (Some(z), along) => (z, along.and_then(|x| reject(x, z)).unwrap_or_else(|| perpendicular(z))),
        (None, Some(x)) => (perpendicular(x), x),
        (None, None) => (DVec3::Z, DVec3::X),
    };
    frame(point, [x, if w < 0.0 { x.cross(z) } else { z.cross(x) }, z])
}

/// The values at a triangle's indices; `None` where one is out of range.
fn corners<T: Copy>(values: &[T], triangle: [u32; 3]) -> Option<[T; 3]> {
    let [a, b, c] = triangle.map(|i| values.get(i as usize).copied());
    Some([a?, b?, c?])
}

/// A buffer of another length than the mesh has vertices, or triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LengthError {
    /// The length of the first such buffer.
    pub found: usize,
    /// The length that it must have.
    pub expected: usize,
}

impl LengthError {
    pub(super) fn check<const N: usize>(expected: usize, lengths: [usize; N]) -> Result<(), Self> {
        match lengths.into_iter().find(|&found| found != expected) {
            Some(found) => Err(Self { found, expected }),
            None => Ok(()),
        }
    }
}

impl fmt::Display for LengthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a buffer of {} values, which must hold {}", self.found, self.expected)
    }
}

impl error::Error for LengthError {}
