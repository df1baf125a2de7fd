//! Built-in surfaces as meshes: right coordinates, normals and tangents at every vertex.

use alberti::glam::{Vec2, Vec3};
use alberti::math::{Object, Point3, Vector3};
use alberti::texture::surface::{Cylinder, Grid, Parametric, Plane, Sphere, Torus};

use crate::load::obj::DEFAULT_DIFFUSE;
use crate::scene::{Model, Part, Vertex};

/// A surface that a formula gives, about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Surface {
    /// In the plane y = 0, facing up, u along x and v along -z.
    Plane { size: [f32; 2] },
    /// u eastwards from the axis z, v from the south pole to the north pole.
    Sphere { radius: f32 },
    /// About the axis y, from y = 0 on, without its ends. u goes around, v up.
    Cylinder { radius: f32, height: f32 },
    /// About the axis y. u goes around the axis, v around the tube, from its outermost circle upwards.
    Torus { major: f32, minor: f32 },
}

impl Surface {
    /// The cells along u and v that make it pass for smooth.
    pub(crate) fn segments(self) -> [u32; 2] {
        match self {
            Self::Plane { .. } => [1, 1],
            Self::Sphere { .. } => [64, 32],
            Self::Cylinder { .. } => [64, 1],
            Self::Torus { .. } => [96, 48],
        }
    }

    /// The mesh of so many cells, with coordinates that go up to `uv_scale`.
    pub(crate) fn mesh(self, segments: [u32; 2], uv_scale: [f32; 2]) -> Model {
        match self {
            Self::Plane { size: [width, depth] } => {
                let origin = Point3::new(Vec3::new(-width / 2.0, 0.0, depth / 2.0));
                let (du, dv) = (Vec3::new(width, 0.0, 0.0), Vec3::new(0.0, 0.0, -depth));
                let plane = Plane { origin, du: Vector3::new(du), dv: Vector3::new(dv) };
                mesh(&plane, segments, uv_scale)
            }
            Self::Sphere { radius } => mesh(&Sphere { radius }, segments, uv_scale),
            Self::Cylinder { radius, height } => mesh(&Cylinder { radius, height }, segments, uv_scale),
            Self::Torus { major, minor } => mesh(&Torus { major, minor }, segments, uv_scale),
        }
    }
}

fn mesh(surface: &impl Parametric, [columns, rows]: [u32; 2], uv_scale: [f32; 2]) -> Model {
    let grid = Grid::new(columns, rows);
    let vertex = |k| {
        let uv: Vec2 = grid.uv(k);
        let frame = surface.orthonormal_frame(uv);
        let axes = frame.axes();
        let handedness = axes.z_axis.cross(axes.x_axis).dot(axes.y_axis);
        let [x, y, z] = axes.x_axis.to_array();
        let position: Point3<Object> = frame.origin();
        Vertex {
            position: position.coords.to_array(),
            normal: axes.z_axis.to_array(),
            uv: (uv * Vec2::from_array(uv_scale)).to_array(),
            tangent: [x, y, z, 1.0_f32.copysign(handedness)],
            ..Vertex::default()
        }
    };
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let triangles = (0..count(grid.triangles())).map(|t| grid.triangle(t)).collect();
    let part = Part { triangles, diffuse: DEFAULT_DIFFUSE, ..Part::default() };
    let vertices = (0..count(grid.vertices())).map(vertex).collect();
    Model { vertices, parts: vec![part], ..Model::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Surface; 4] = [
        Surface::Plane { size: [2.0, 3.0] },
        Surface::Sphere { radius: 1.5 },
        Surface::Cylinder { radius: 0.5, height: 2.0 },
        Surface::Torus { major: 2.0, minor: 0.5 },
    ];

    #[test]
    fn triangles_face_outwards_and_tangents_follow_the_texture() {
        for surface in ALL {
            let model = surface.mesh([96, 96], [3.0, 2.0]);
            for triangle in &model.parts[0].triangles {
                let v = triangle.map(|i| model.vertices[i as usize]);
                let [a, b, c] = v.map(|v| Vec3::from_array(v.position));
                let across = (b - a).cross(c - a);
                // At a pole, triangles have no area.
                if across.length() < 1e-6 {
                    continue;
                }
                let facing = across.normalize().dot(Vec3::from_array(v[0].normal));
                assert!(facing > 0.99, "{surface:?} {facing}");
                // Growing u, from the corners themselves.
                let [s, t, w] = v.map(|v| Vec2::from_array(v.uv));
                let (d1, d2) = (t - s, w - s);
                let du = ((b - a) * d2.y - (c - a) * d1.y) / d1.perp_dot(d2);
                let dv = ((c - a) * d1.x - (b - a) * d2.x) / d1.perp_dot(d2);
                let [x, y, z, handedness] = v[0].tangent;
                let (tangent, normal) = (Vec3::new(x, y, z), Vec3::from_array(v[0].normal));
                // Within a segment or two of 96 around.
                assert!(tangent.dot(du.normalize()) > 0.99, "{surface:?}");
                assert!((normal.cross(tangent) * handedness).dot(dv.normalize()) > 0.99, "{surface:?}");
                assert!((tangent.length() - 1.0).abs() < 1e-6 && tangent.dot(normal).abs() < 1e-6);
            }
            let last = model.vertices.last().map(|v| v.uv);
            assert_eq!(last, Some([3.0, 2.0]));
        }
    }

    #[test]
    fn surfaces_are_where_they_should_be() {
        let all = |surface: Surface, holds: &dyn Fn([f32; 3]) -> f32| {
            let model = surface.mesh(surface.segments(), [1.0; 2]);
            assert!(model.vertices.iter().all(|v| holds(v.position).abs() < 1e-5), "{surface:?}");
        };
        all(ALL[0], &|[x, y, z]| y + (x.abs() - 1.0).max(0.0) + (z.abs() - 1.5).max(0.0));
        all(ALL[1], &|[x, y, z]| x.hypot(y).hypot(z) - 1.5);
        all(ALL[2], &|[x, y, z]| x.hypot(z) - 0.5 + (y - 1.0).abs().max(1.0) - 1.0);
        all(ALL[3], &|[x, y, z]| (x.hypot(z) - 2.0).hypot(y) - 0.5);
    }
}
