//! The application's scenes as the oracle's, and their cameras as the library's.

use alberti::glam::Vec3;
use alberti::{View, ViewError};
use alberti_app::draw::{AMBIENT, DIFFUSE, to_light};
use alberti_app::options::{Cull, Filter, LightOptions, Policies, Projection, RenderOptions, Shading, Wrap};
use alberti_app::scene::{Camera, Model};
use alberti_app::scenes::BuiltIn;
use alberti_oracle::scene as oracle;
use std::num::NonZero;

/// The view of a camera, in perspective; its aspect ratio is that of the frame.
///
/// # Errors
/// An impossible camera.
pub fn view(camera: &Camera) -> Result<View, ViewError> {
    let [eye, target, up] = [camera.eye, camera.target, camera.up].map(Vec3::from_array);
    let Camera { fov, near, far, .. } = *camera;
    alberti::Camera::look_at(eye, target, up)?.perspective(fov.to_radians(), near..far)
}

/// The options under which a built-in scene is drawn at this size.
#[must_use]
pub fn options(scene: &BuiltIn, width: u32, height: u32) -> RenderOptions {
    RenderOptions {
        width,
        height,
        background: scene.background,
        shading: scene.shading,
        filter: scene.filter,
        wrap: scene.wrap,
        cull: scene.cull,
        depth: scene.depth,
        projection: Projection::Perspective,
        haze: None,
        light: LightOptions::default(),
        threads: NonZero::<usize>::MIN,
        policies: Policies::default(),
    }
}

/// Hands the same model, camera and options to the oracle.
pub fn with_scene<R>(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    draw: impl FnOnce(&oracle::Scene<'_>) -> R,
) -> R {
    let wide = |v: [f32; 3]| v.map(f64::from);
    let vertices: Vec<_> = model
        .vertices
        .iter()
        .map(|v| oracle::Vertex {
            position: wide(v.position),
            normal: wide(v.normal),
            uv: v.uv.map(f64::from),
            color: wide(v.color),
        })
        .collect();
    let parts: Vec<_> = model
        .parts
        .iter()
        .map(|p| oracle::Part { triangles: &p.triangles, diffuse: wide(p.diffuse), texture: p.texture })
        .collect();
    let textures: Vec<_> = model
        .textures
        .iter()
        .map(|t| oracle::Texture { width: t.width, height: t.height, texels: &t.texels })
        .collect();
    draw(&oracle::Scene {
        vertices: &vertices,
        parts: &parts,
        textures: &textures,
        camera: oracle::Camera {
            eye: wide(camera.eye),
            target: wide(camera.target),
            up: wide(camera.up),
            fov: f64::from(camera.fov),
            near: f64::from(camera.near),
            far: f64::from(camera.far),
        },
        width: options.width,
        height: options.height,
        cull: match options.cull {
            Cull::Back => oracle::Cull::Back,
            Cull::Front => oracle::Cull::Front,
            Cull::None => oracle::Cull::None,
        },
        shading: match options.shading {
            Shading::Unlit => oracle::Shading::Unlit,
            Shading::VertexColor => oracle::Shading::VertexColor,
            _ => oracle::Shading::Lambert {
                light_dir: wide(to_light(camera).to_array()),
                ambient: f64::from(AMBIENT),
                diffuse: f64::from(DIFFUSE),
            },
        },
        filter: match options.filter {
            Filter::Nearest => oracle::Filter::Nearest,
            _ => oracle::Filter::Bilinear,
        },
        wrap: match options.wrap {
            Wrap::Repeat => oracle::Wrap::Repeat,
            Wrap::Clamp => oracle::Wrap::Clamp,
            Wrap::Mirror => oracle::Wrap::Mirror,
        },
        background: options.background,
    })
}
