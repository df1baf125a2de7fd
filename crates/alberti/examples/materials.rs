//! A brick wall under a lamp, from four vertices: on the left the colours alone, on the right with a normal map, a
//! parallax map and a highlight. All textures are computed here.
//!
//!     cargo run --release -p alberti --example materials -- materials.png

mod common;

use alberti::glam::{Vec2, Vec3};
use alberti::shaders::material::{
    BlinnPhong, Color, Framed, Layer, Lighting, Material, NormalMap, Parallax, PointLight, Specular, Viewer,
};
use alberti::texture::surface::{NormalEncoding::Centred, ParallaxOcclusion, Relief};
use alberti::texture::{Bilinear, Repeat, Texture, format::Rgba8888};
use alberti::*;
use std::process::ExitCode;

/// Of each of the two.
const SIZE: [u16; 2] = [192, 144];
/// Of the textures.
const SIDE: i32 = 128;
/// How far mortar lies behind bricks, and the side of a texture, in the world.
const DEPTH: f32 = 0.06;
const TILE: f32 = 1.0;

fn main() -> ExitCode {
    common::write("materials.png", picture)
}

fn picture() -> common::File {
    let [colors, normals, heights] = textures();
    let side = SIDE.cast_unsigned();
    let [colors, normals, heights] =
        [&colors, &normals, &heights].map(|texels| Texture::new(Rgba8888, texels, side, side));
    let (colors, normals, heights) = (colors?, normals?, heights?);
    let color = Color(colors.sampler(Bilinear, Repeat));
    let relief =
        Relief { map: heights.sampler(Bilinear, Repeat), low: -DEPTH, high: 0.0, extent: Vec2::splat(TILE) };
    let flat = wall(color)?;
    let detailed = wall((
        // The place to look at comes first, then the looks of it.
        Parallax { relief, policy: ParallaxOcclusion { layers: 24 } },
        color,
        Specular(Rgba8::from_rgb24(0x50_50_48)),
        NormalMap { map: normals.sampler(Bilinear, Repeat), encoding: Centred, strength: 1.0 },
    ))?;
    let columns = usize::from(SIZE[0]);
    let both: Vec<u32> = flat
        .chunks(columns)
        .zip(detailed.chunks(columns))
        .flat_map(|rows| [rows.0, rows.1].concat())
        .collect();
    common::png(2 * u32::from(SIZE[0]), &both)
}

/// The wall of these layers.
fn wall(layers: impl Layer<Framed>) -> Result<Vec<u32>, Box<dyn std::error::Error>> {
    let [width, height] = SIZE.map(u32::from);
    let at = |x, y, z| Point3::<World>::new(Vec3::new(x, y, z));
    let eye = at(1.9, 0.5, 1.9);
    let lamp =
        PointLight { position: at(-0.9, 0.9, 0.55), color: Vec3::splat(0.9), falloff: [0.3, 0.0, 0.45] };
    let vertices = [(-2.0, -1.5), (2.0, -1.5), (2.0, 1.5), (-2.0, 1.5)];
    let mesh = Mesh::new(&vertices, &[[0u16, 1, 2], [0, 2, 3]], |&(x, y)| {
        let (position, uv) = (Vec3::new(x, y, 0.0), Vec2::new(x, y) / TILE);
        (position, Framed { position, axes: [Vec3::X, Vec3::Y, Vec3::Z], uv })
    });
    let stage = Material {
        layers,
        lighting: Lighting {
            viewer: Viewer::at(eye),
            ambient: Vec3::splat(0.15),
            lights: lamp,
            reflectance: BlinnPhong(30),
        },
    };
    let view = Camera::look_at(eye, at(0.15, -0.05, 0.0), Vec3::Y)?.perspective(0.75, 0.1..20.0)?;
    let pixels = (width * height) as usize;
    let (mut color, mut depth) = (vec![0; pixels], vec![1.0; pixels]);
    let mut target = Target::new(Rgba8888, F32, width, height, &mut color, &mut depth)?;
    target.clear(common::BACKGROUND);
    draw(&mut target, &view, &mesh, stage);
    Ok(color)
}

/// How high a texel is, from 0 in the mortar to 1 on a brick, and which brick it is.
fn brick(x: i32, y: i32) -> (f32, i32) {
    let (y, row) = (y.rem_euclid(SIDE) % 32, y.rem_euclid(SIDE) / 32);
    let x = (x + 32 * (row % 2)).rem_euclid(SIDE);
    let inside = (x % 64).min(63 - x % 64).min(y).min(31 - y);
    let rise = (inside - 1).clamp(0, 5);
    #[expect(clippy::cast_precision_loss, reason = "at most 5")]
    let height = rise as f32 / 5.0;
    (height * (2.0 - height), 2 * row + x / 64)
}

/// Colours, normals and heights, the first row the top one.
fn textures() -> [Vec<[u8; 4]>; 3] {
    let of = |texel: fn(i32, i32) -> [f32; 3]| {
        let texel = |k| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
            let [r, g, b] = texel(k % SIDE, k / SIDE).map(|c| (c + 0.5) as u8);
            [r, g, b, 255]
        };
        (0..SIDE * SIDE).map(texel).collect()
    };
    #[expect(clippy::cast_sign_loss, reason = "bricks are counted from 0")]
    let color = |x, y| match brick(x, y) {
        (height, _) if height < 0.5 => [150.0, 145.0, 135.0],
        (_, k) => [[170.0, 80.0, 60.0], [190.0, 100.0, 70.0], [150.0, 70.0, 62.0]][(k * 5 % 3) as usize],
    };
    // v is up, and rows go down.
    let normal = |x, y| {
        let rise = |[a, b]: [(f32, i32); 2]| (a.0 - b.0) * DEPTH / (2.0 * TILE / 128.0);
        let along = [[brick(x - 1, y), brick(x + 1, y)], [brick(x, y + 1), brick(x, y - 1)]].map(rise);
        (Vec3::new(along[0], along[1], 1.0).normalize() * 127.0 + 128.0).to_array()
    };
    [of(color), of(normal), of(|x, y| [brick(x, y).0 * 255.0; 3])]
}
