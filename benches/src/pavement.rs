//! A pavement of stones under a light at infinity, by a colour map and a normal map: the scene, and its picture
//! by rays in `f64`.
//!
//! ```text
//! colour = map(uv) (ambient + light max(n·l, 0))        n = unit(x t + y b + z m),  (x, y, z) from the normal map
//! ```

use crate::Size;
use crate::scene_data::Scene;
use crate::stones::{SIDE, Stones, trilinear};
use alberti::glam::{DVec2, DVec3, Vec3};
use alberti_app::options::{Cull, DepthFormat, Filter, Shading, Wrap};
use alberti_app::scene::{Camera, Image, Model, Part, Vertex};
use alberti_app::scenes::BuiltIn;

/// The direction of the light from the surface: 1 long but for rounding.
pub const TO_LIGHT: Vec3 = Vec3::new(0.421_637, 0.737_865, -0.527_046);
/// The light from there, in each channel.
pub const LIGHT: f32 = 0.8;
/// The light from everywhere.
pub const AMBIENT: f32 = 0.2;

/// Texture coordinates a unit of length: u along x, v against z.
const PER_UNIT: f32 = 2.0;
/// How far the pavement goes in x and in z.
const EXTENT: f32 = 20.0;

/// The scene: the pavement fills the view, its nearest texels 0.7 of a pixel of 1280x720, its farthest a hundredth.
#[must_use]
pub fn scene(stones: &Stones) -> BuiltIn {
    let vertex = |[x, z]: [f32; 2]| Vertex {
        position: [x, 0.0, z],
        normal: [0.0, 1.0, 0.0],
        uv: [x * PER_UNIT, -z * PER_UNIT],
        tangent: [1.0, 0.0, 0.0, 1.0],
        ..Vertex::default()
    };
    let corners = [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]].map(|c| c.map(|c| c * EXTENT));
    let part = Part { triangles: vec![[0, 1, 2], [0, 2, 3]], texture: Some(0), ..Part::default() };
    let texels = stones.color[..(SIDE * SIDE) as usize].to_vec();
    BuiltIn {
        model: Model {
            vertices: corners.map(vertex).to_vec(),
            parts: vec![part],
            textures: vec![Image { width: SIDE, height: SIDE, texels }.into()],
            ..Model::default()
        },
        camera: Camera {
            eye: [0.0, 1.0, 0.0],
            target: [0.366, 0.5, -0.785],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 50.0,
            near: 0.1,
            far: 100.0,
        },
        background: [0; 3],
        shading: Shading::Unlit,
        filter: Filter::Trilinear,
        wrap: Wrap::Repeat,
        cull: Cull::Back,
        depth: DepthFormat::F32,
    }
}

/// The right picture, rows from the top: λ as alberti defines it.
#[must_use]
pub fn picture(scene: &Scene, stones: &Stones, size: Size) -> Vec<[u8; 4]> {
    let camera = scene.built_in.camera;
    let [eye, target, up] = [camera.eye, camera.target, camera.up].map(|v| Vec3::from(v).as_dvec3());
    let forward = (target - eye).normalize();
    let right = forward.cross(up).normalize();
    let up = right.cross(forward);
    let half = (f64::from(camera.fov).to_radians() / 2.0).tan();
    let (width, height) = (f64::from(size.width), f64::from(size.height));
    let uv = |x: f64, y: f64| {
        let ray =
            forward + right * (half * (2.0 * x - width) / height) + up * (half * (height - 2.0 * y) / height);
        let hit = eye - ray * (eye.y / ray.y);
        DVec2::new(hit.x, -hit.z) * f64::from(PER_UNIT)
    };
    let pixel = |x: u32, y: u32| {
        const STEP: f64 = 1e-3;
        let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
        let across = uv(x + STEP, y) - uv(x - STEP, y);
        let down = uv(x, y + STEP) - uv(x, y - STEP);
        let texels = across.length().max(down.length()) * f64::from(SIDE) / (2.0 * STEP);
        let [r, g, b] = shaded(stones, uv(x, y), texels.log2()).map(|c| c.round() as u8);
        [r, g, b, 255]
    };
    (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect()
}

/// The lit colour at a place of the maps, in bytes.
fn shaded(stones: &Stones, uv: DVec2, lambda: f64) -> [f64; 3] {
    let [x, y, z] = trilinear(&stones.normal, uv, lambda).map(|c| 2.0 * c / 255.0 - 1.0);
    // t is along x, b against z, m along y.
    let normal = DVec3::new(x, z, -y).normalize();
    let light = f64::from(AMBIENT) + f64::from(LIGHT) * normal.dot(TO_LIGHT.as_dvec3()).max(0.0);
    trilinear(&stones.color, uv, lambda).map(|c| (c * light).min(255.0))
}
