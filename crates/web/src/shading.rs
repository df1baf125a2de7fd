//! The material that three stations share: colours and normals from mip maps, under one lamp.
//!
//! One type for all of them is one kernel in the program.

use crate::numbers::float;
use crate::textures::Levels;
use alberti::glam::{Vec2, Vec3};
use alberti::projection::EyeVertex;
use alberti::shaders::material::{
    BlinnPhong, Bump, Color, Framed, Lighting, Material, NormalMap, Parallax, PointLight, Specular, Viewer,
};
use alberti::texture::format::Rgba8888;
use alberti::texture::surface::{AnyParallax, NormalEncoding::Centred};
use alberti::texture::{Bilinear, MipSampler, Repeat, Sampler, TextureError, Trilinear};
use alberti::*;
use alloc::vec;

/// A map of colours or normals.
type Map<'a> = MipSampler<'a, Rgba8888, Trilinear, Repeat>;

/// A map of heights.
pub(crate) type Heights<'a> = Sampler<'a, Rgba8888, Bilinear, Repeat>;

/// The place to look at, colours, a highlight, and normals from a map or from heights.
pub(crate) type Detail<'a> = (
    Option<Parallax<Heights<'a>, AnyParallax>>,
    Color<Map<'a>>,
    Specular<Rgba8>,
    Option<NormalMap<Map<'a>>>,
    Option<Bump<Heights<'a>>>,
);

/// The layers of a surface with a normal map, whose slopes are `strength` times as steep as the map says. Without any
/// strength there is none.
pub(crate) fn detail<'a>(
    colors: &'a Levels,
    normals: &'a Levels,
    strength: f32,
) -> Result<Detail<'a>, TextureError> {
    let normals = normals.mipmap()?.sampler(Trilinear, Repeat);
    Ok((
        None,
        Color(colors.mipmap()?.sampler(Trilinear, Repeat)),
        Specular(Rgba8::from_rgb24(0x48_48_40)),
        (strength > 0.0).then_some(NormalMap { map: normals, encoding: Centred, strength }),
        None,
    ))
}

/// The stage of all three stations.
pub(crate) type Lit<'a> = Material<Detail<'a>, PointLight, BlinnPhong>;

/// A surface that is seen from `eye` by the light of a lamp, whose place has the amount of its light.
pub(crate) fn lit(layers: Detail<'_>, eye: Vec3, (lamp, light): (Vec3, f32)) -> Lit<'_> {
    let position = Point3::new(lamp);
    Material {
        layers,
        lighting: Lighting {
            viewer: Viewer::at(Point3::new(eye)),
            ambient: Vec3::splat(0.2),
            lights: PointLight { position, color: Vec3::splat(light), falloff: [0.45, 0.0, 0.28] },
            reflectance: BlinnPhong(28),
        },
    }
}

/// A mesh whose vertices stand in the world.
pub(crate) type FramedMesh<'a> = Mesh<'a, Framed, u32, fn(&Framed) -> (Vec3, Framed)>;

/// The mesh of these vertices.
pub(crate) fn mesh<'a>(vertices: &'a [Framed], triangles: &'a [[u32; 3]]) -> FramedMesh<'a> {
    Mesh::new(vertices, triangles, |vertex| (vertex.position, *vertex))
}

/// Draws a mesh from both sides, each vertex done once, and counts.
pub(crate) fn draw(
    target: &mut Target<'_, alberti::Rgba8888, F32>,
    view: &View,
    mesh: &FramedMesh<'_>,
    stage: Lit<'_>,
) -> Stats {
    let mut slots = vec![Slot::EMPTY; mesh.vertices()];
    Pass::new(view, mesh, stage).cull(Cull::None).slots(&mut slots).draw_counted(target)
}

/// A mesh whose vertices are places and what they carry: one type, so that there is one way to the screen for all that
/// carry the same.
pub(crate) type PlainMesh<'a, V> = Mesh<'a, (Vec3, V), u16, fn(&(Vec3, V)) -> (Vec3, V)>;

/// The mesh of these vertices.
pub(crate) fn plain<'a, V: Varying>(
    vertices: &'a [(Vec3, V)],
    triangles: &'a [[u16; 3]],
) -> PlainMesh<'a, V> {
    Mesh::new(vertices, triangles, |vertex| *vertex)
}

/// The triangles of four corners.
pub(crate) const QUAD: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// The place of a point of the world in a picture of this size, in pixels.
pub(crate) fn place(view: &View, [width, height]: [u32; 2], point: Vec3) -> Result<Vec2, ViewError> {
    let lens = view.projection(&Viewport::new(0, 0, width, height)?);
    let position = lens.scale(view.object_to_eye(None).to_parent(Point3::new(point)));
    let projected = lens.project(&lens.depth_map(false), &EyeVertex { position, varying: () });
    let size = Vec2::new(float(width as usize), float(height as usize));
    Ok((Vec2::new(projected.x, -projected.y) + 1.0) / 2.0 * size)
}
