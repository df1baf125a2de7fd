//! From the weights of a triangle's vertices to a colour.

use crate::sampling;
use crate::scene::{Part, Scene, Shading, Vertex};
use crate::vec3::{Vec3, blend, dot, normalize};

/// The colour of `part` at the point with these world-space weights on its triangle number `triangle`.
pub(crate) fn shade(scene: &Scene<'_>, part: &Part<'_>, triangle: usize, weights: Vec3) -> [u8; 3] {
    let vertices = part.triangles[triangle].map(|i| scene.vertices[i as usize]);
    match scene.shading {
        Shading::VertexColor => to_bytes(blend(weights, vertices.map(|v| v.color)).map(|c| c * 255.0)),
        Shading::Unlit => to_bytes(material(scene, part, &vertices, weights)),
        Shading::Lambert { light_dir, ambient, diffuse } => {
            let normal = normalize(blend(weights, vertices.map(|v| v.normal)));
            let facing = dot(normal, normalize(light_dir)).max(0.0);
            let light = ambient + diffuse * facing;
            to_bytes(material(scene, part, &vertices, weights).map(|c| c * light))
        }
    }
}

/// The texel times the diffuse colour, or the latter alone, in units of a byte.
fn material(scene: &Scene<'_>, part: &Part<'_>, vertices: &[Vertex; 3], weights: Vec3) -> Vec3 {
    let texel = part.texture.map_or([255.0; 3], |texture| {
        let uv = blend(weights, vertices.map(|v| v.uv));
        sampling::sample(&scene.textures[texture], uv, scene.filter, scene.wrap)
    });
    std::array::from_fn(|i| texel[i] * part.diffuse[i])
}

/// Rounds once, to nearest, at the very end.
fn to_bytes(color: Vec3) -> [u8; 3] {
    color.map(|c| c.clamp(0.0, 255.0).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Cull, Filter, Texture, Wrap};

    fn colors(shading: Shading, texture: Option<usize>) -> [u8; 3] {
        let vertex = |color, normal| Vertex { position: [0.0; 3], normal, uv: [0.5, 0.5], color };
        let vertices = [
            vertex([1.0, 0.0, 0.0], [0.0, 0.0, 2.0]),
            vertex([0.0, 1.0, 0.0], [0.0, 0.0, 4.0]),
            vertex([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]),
        ];
        let parts = [Part { triangles: &[[0, 1, 2]], diffuse: [1.0, 0.5, 0.25], texture }];
        let scene = Scene {
            vertices: &vertices,
            parts: &parts,
            textures: &[Texture { width: 1, height: 1, texels: &[[200, 100, 40, 255]] }],
            camera: Camera {
                eye: [0.0; 3],
                target: [0.0, 0.0, -1.0],
                up: [0.0, 1.0, 0.0],
                fov: 60.0,
                near: 1.0,
                far: 2.0,
            },
            width: 1,
            height: 1,
            cull: Cull::None,
            shading,
            filter: Filter::Nearest,
            wrap: Wrap::Repeat,
            background: [0; 3],
        };
        shade(&scene, &parts[0], 0, [0.5, 0.25, 0.25])
    }

    #[test]
    fn unlit_multiplies_texel_and_diffuse() {
        assert_eq!(colors(Shading::Unlit, None), [255, 128, 64]);
        assert_eq!(colors(Shading::Unlit, Some(0)), [200, 50, 10]);
    }

    #[test]
    fn vertex_colours_are_interpolated() {
        assert_eq!(colors(Shading::VertexColor, None), [128, 64, 64]);
    }

    #[test]
    fn lambert_adds_ambient_and_saturates() {
        let lambert =
            |light_dir, ambient, diffuse| colors(Shading::Lambert { light_dir, ambient, diffuse }, Some(0));
        assert_eq!(lambert([0.0, 0.0, 3.0], 0.0, 1.0), [200, 50, 10]);
        assert_eq!(lambert([0.0, 0.0, -3.0], 0.5, 1.0), [100, 25, 5]);
        // cos 60 degrees, whatever the lengths of the normal and the light are.
        assert_eq!(lambert([3f64.sqrt(), 0.0, 1.0], 0.1, 0.8), [100, 25, 5]);
        assert_eq!(lambert([0.0, 0.0, 1.0], 1.0, 9.0), [255, 255, 100]);
    }
}
