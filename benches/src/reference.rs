//! The right picture of a scene, by rays in f64, and how far a renderer's picture is from it.

use crate::Size;
use crate::scene_data::Scene;
use alberti_app::options::{Filter, Shading};
use alberti_oracle::ideal::render_ideal;
use alberti_oracle::image::{Image as Picture, compare};
use alberti_oracle::scene as oracle;
use alberti_oracle::snapped::render_snapped;

/// A pixel is off when a channel differs by more than this.
pub const TOLERANCE: u8 = 8;

/// The subpixel bits of alberti's timed policies.
const SUBPIXEL_BITS: u32 = 8;

/// The picture that the scene's definition asks for.
#[must_use]
pub fn ideal(scene: &Scene, size: Size) -> Vec<[u8; 4]> {
    drawn(scene, size, render_ideal)
}

/// The picture after vertices have been snapped as alberti snaps them, everything else in `f64`. Close to a horizon a
/// snapped vertex moves the texture by whole texels; that is a property of the policy, not an error of its arithmetic.
#[must_use]
pub fn snapped(scene: &Scene, size: Size) -> Vec<[u8; 4]> {
    drawn(scene, size, |scene| render_snapped(scene, SUBPIXEL_BITS))
}

fn drawn(scene: &Scene, size: Size, render: impl Fn(&oracle::Scene<'_>) -> Picture) -> Vec<[u8; 4]> {
    let built_in = &scene.built_in;
    let model = &built_in.model;
    let vertices: Vec<_> = model
        .vertices
        .iter()
        .map(|v| oracle::Vertex {
            position: v.position.map(f64::from),
            normal: v.normal.map(f64::from),
            uv: v.uv.map(f64::from),
            color: v.color.map(f64::from),
        })
        .collect();
    let parts: Vec<_> = model
        .parts
        .iter()
        .map(|part| oracle::Part {
            triangles: &part.triangles,
            diffuse: part.diffuse.map(f64::from),
            texture: part.texture,
        })
        .collect();
    let textures: Vec<_> = model
        .textures
        .iter()
        .map(|image| oracle::Texture { width: image.width, height: image.height, texels: &image.texels })
        .collect();
    let camera = &built_in.camera;
    let drawn = oracle::Scene {
        vertices: &vertices,
        parts: &parts,
        textures: &textures,
        camera: oracle::Camera {
            eye: camera.eye.map(f64::from),
            target: camera.target.map(f64::from),
            up: camera.up.map(f64::from),
            fov: f64::from(camera.fov),
            near: f64::from(camera.near),
            far: f64::from(camera.far),
        },
        width: size.width,
        height: size.height,
        // What `Scene::load` insists on.
        cull: oracle::Cull::Back,
        wrap: oracle::Wrap::Repeat,
        shading: match built_in.shading {
            Shading::VertexColor => oracle::Shading::VertexColor,
            Shading::Unlit | Shading::Lambert => oracle::Shading::Unlit,
        },
        filter: match built_in.filter {
            Filter::Nearest => oracle::Filter::Nearest,
            Filter::Bilinear => oracle::Filter::Bilinear,
        },
        background: built_in.background,
    };
    render(&drawn).pixels
}

/// How many pixels are off by more than [`TOLERANCE`].
#[must_use]
pub fn pixels_off(pixels: &[[u8; 4]], reference: &[[u8; 4]]) -> usize {
    compare(pixels, reference, TOLERANCE).differing
}

/// [`pixels_off`] as a part of all pixels.
#[must_use]
pub fn part_off(pixels: &[[u8; 4]], reference: &[[u8; 4]]) -> f64 {
    pixels_off(pixels, reference) as f64 / reference.len() as f64
}
