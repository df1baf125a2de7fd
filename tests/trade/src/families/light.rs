//! Light by fragment or by vertex, and relief.

use super::perspective::with;
use crate::frame::{position, uv, wide};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::material::{
    BlinnPhong, Bump, Color, Directional, Framed, Gouraud, Lambert, Layer, Lighting, Material, NormalMap,
    Parallax, Phong, Placed, Reflectance, Specular, Viewer,
};
use alberti::texture::surface::{
    LimitedParallax, NormalEncoding, OffsetParallax, ParallaxOcclusion, Relief, SteepParallax,
};
use alberti::texture::{Bilinear, PowerOfTwo, Repeat, Sampler, Texture, format::L8, format::Rgba8888};
use alberti::{Exact, FragmentStage, Point3, Rgba8, Varying, Vector3};
use alberti_app::scene::{Model, Part, Vertex};
use alberti_trade::family::{Axis, Family};
use alberti_trade::row::Frame;
use alberti_trade::row::{Judge, Row};
use alberti_trade::scenes::{SIDE, Scene, scene};
use std::sync::LazyLock;

/// Where light is found.
pub(super) const LIGHT: Family = Family {
    name: "light",
    title: "Light",
    advice: "\
Highlights need fragments: at vertices they are found only where a vertex happens to be, and flicker as it moves. For
light that is scattered alone, vertices suffice if triangles are small. `Phong` with a quarter of the exponent is like
`BlinnPhong`. The right picture is that of `BlinnPhong` by fragment.",
    axis: Axis::Flip,
};

/// How a surface gets its depth.
pub(super) const RELIEF: Family = Family {
    name: "relief",
    title: "Relief",
    advice: "\
The right picture is that of a mesh with a vertex every other texel, whose outline and depths no map has. `Bump` is
light alone, for relief that is shallow or seen from the front, and `NormalMap` the same from an image of its own, which
is drawn better but takes as much memory as the colours. `LimitedParallax` moves the texture for next to nothing.
`ParallaxOcclusion(8)` looks the nearest to the mesh, in a fifth of its instructions here, or half of the time where a
triangle has more pixels; more layers are for steeper views. `SteepParallax` shows its layers and costs more: take the
other.",
    axis: Axis::Flip,
};

const SHININESS: u32 = 40;
const HIGHLIGHT: Rgba8 = Rgba8::from_rgb24(0xa0_a0_98);

fn lighting<R>(scene: &Scene, reflectance: R) -> Lighting<Directional, R> {
    Lighting {
        viewer: Viewer::at(Point3::new(Vec3::from_array(scene.camera.eye))),
        ambient: Vec3::splat(0.25),
        lights: Directional::new(Vector3::new(Vec3::new(0.5, 0.9, 0.7)), Vec3::splat(0.75)),
        reflectance,
    }
}

type Colors = Sampler<'static, Rgba8888, Bilinear, Repeat, Repeat, PowerOfTwo>;

fn color(scene: &'static Scene) -> Color<Colors> {
    let image = &scene.model.textures[0];
    let texture = Texture::new(Rgba8888, &image.texels, image.width, image.height).expect("a texture");
    Color(texture.power_of_two().expect("sides that are powers of two").sampler(Bilinear, Repeat))
}

fn frame<V: Varying + 'static>(
    (scene, size): (&'static Scene, [u32; 2]),
    vertex_stage: impl Fn(&Vertex) -> (Vec3, V) + 'static,
    stage: impl FragmentStage<V, Color = Rgba8> + 'static,
) -> ([u32; 2], Frame) {
    (size, wide(scene, vertex_stage, stage, with(Exact, size)))
}

fn placed(v: &Vertex) -> (Vec3, Placed) {
    (position(v), Placed { position: position(v), normal: Vec3::from_array(v.normal), uv: uv(v) })
}

pub(super) fn light(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    fn by_fragment(
        (scene, size): (&'static Scene, [u32; 2]),
        reflectance: impl Reflectance + 'static,
    ) -> ([u32; 2], Frame) {
        let layers = (color(scene), Specular(HIGHLIGHT));
        frame((scene, size), placed, Material { layers, lighting: lighting(scene, reflectance) })
    }
    let rows = ["lit", "dense-mesh"].map(scene).map(|scene| {
        let of = |name: &str, frame| Row::new(family, name, scene, Judge::Reference, frame);
        let lamp = lighting(scene, BlinnPhong(SHININESS));
        let at_vertex = move |v: &Vertex| {
            let normal = Vector3::new(Vec3::from_array(v.normal));
            let [scattered, mirrored] = lamp.at_vertex(Point3::new(position(v)), normal);
            (position(v), (scattered, (mirrored, uv(v))))
        };
        let layers = (color(scene), Specular(HIGHLIGHT));
        [
            of("fragments, BlinnPhong", by_fragment((scene, size), BlinnPhong(SHININESS))).as_reference(),
            of("fragments, Phong", by_fragment((scene, size), Phong(SHININESS / 4))),
            of("fragments, Lambert", by_fragment((scene, size), Lambert)),
            of("vertices, BlinnPhong", frame((scene, size), at_vertex, Gouraud { layers })),
        ]
    });
    rows.into_iter().flatten().collect()
}

/// The heights of the stones: the alpha of their colours.
static HEIGHTS: LazyLock<Vec<u8>> = LazyLock::new(|| {
    scene("deep-relief").model.textures[0].texels.iter().map(|&[.., height]| height).collect()
});

type Heights = Sampler<'static, L8, Bilinear, Repeat, Repeat, PowerOfTwo>;

fn heights(scene: &Scene) -> Relief<Heights> {
    let texture = Texture::new(L8, &HEIGHTS, SIDE, SIDE).expect("a texture");
    let map = texture.power_of_two().expect("a power of two").sampler(Bilinear, Repeat);
    Relief { map, low: -scene.relief, high: 0.0, extent: Vec2::ONE }
}

/// Their normals, with red, green and blue from -1 to 1.
static NORMALS: LazyLock<Vec<[u8; 4]>> = LazyLock::new(|| {
    let relief = heights(scene("deep-relief"));
    let side = f32::from(u16::try_from(SIDE).expect("small"));
    let centre = |k: u32| (f32::from(u16::try_from(k).expect("small")) + 0.5) / side;
    let texel = |k: u32| {
        let uv = Vec2::new(centre(k % SIDE), 1.0 - centre(k / SIDE));
        let normal = relief.normal(uv, Vec2::splat(1.0 / side)).coords;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
        let [r, g, b] = normal.to_array().map(|x| ((x * 0.5 + 0.5) * 255.0).round() as u8);
        [r, g, b, 255]
    };
    (0..SIDE * SIDE).map(texel).collect()
});

fn normals() -> NormalMap<Colors> {
    let texture = Texture::new(Rgba8888, &NORMALS, SIDE, SIDE).expect("a texture");
    let map = texture.power_of_two().expect("a power of two").sampler(Bilinear, Repeat);
    NormalMap { map, encoding: NormalEncoding::Unorm, strength: 1.0 }
}

/// The stones as a mesh of a vertex every other texel.
static DISPLACED: LazyLock<Scene> = LazyLock::new(|| {
    let flat = scene("deep-relief");
    let relief = heights(flat);
    let at = |s: f32, t: f32| [3.0 * (s - 0.5), 2.2 * (t - 0.5), 0.0];
    let mut mesh = alberti_trade::scenes::sheet([384, 282], at, [3.0, 2.2]);
    let step = Vec2::splat(1.0 / 256.0);
    for vertex in &mut mesh.vertices {
        let uv = Vec2::from_array(vertex.uv);
        vertex.position[2] = relief.height(uv);
        vertex.normal = relief.normal(uv, step).coords.to_array();
    }
    let parts = mesh.parts.into_iter().map(|part| Part { texture: Some(0), ..part }).collect();
    Scene {
        name: flat.name,
        about: flat.about,
        model: Model { parts, textures: flat.model.textures.clone(), ..mesh },
        camera: flat.camera,
        levels: vec![],
        relief: flat.relief,
    }
});

pub(super) fn relief(family: &'static str, size: [u32; 2]) -> Vec<Row> {
    fn framed(v: &Vertex) -> (Vec3, Framed) {
        (position(v), Framed { position: position(v), axes: [Vec3::X, Vec3::Y, Vec3::Z], uv: uv(v) })
    }
    fn layered(
        (scene, size): (&'static Scene, [u32; 2]),
        layers: impl Layer<Framed> + 'static,
    ) -> ([u32; 2], Frame) {
        frame((scene, size), framed, Material { layers, lighting: lighting(scene, BlinnPhong(SHININESS)) })
    }
    let scene = scene("deep-relief");
    let of = |name: &str, frame| Row::new(family, name, scene, Judge::Reference, frame);
    let (color, mirrored, map) = (color(scene), Specular(HIGHLIGHT), heights(scene));
    let solid = {
        let scene: &'static Scene = &DISPLACED;
        let layers = (color, mirrored);
        frame((scene, size), placed, Material { layers, lighting: lighting(scene, BlinnPhong(SHININESS)) })
    };
    macro_rules! parallax {
        ($policy:expr) => {
            layered((scene, size), (Parallax { relief: map, policy: $policy }, color, mirrored, Bump(map)))
        };
    }
    vec![
        of("displaced mesh", solid).as_reference(),
        of("none", layered((scene, size), (color, mirrored))),
        of("Bump", layered((scene, size), (color, mirrored, Bump(map)))),
        of("NormalMap", layered((scene, size), (color, mirrored, normals()))),
        of("OffsetParallax", parallax!(OffsetParallax)),
        of("LimitedParallax", parallax!(LimitedParallax)),
        of("SteepParallax(16)", parallax!(SteepParallax { layers: 16 })),
        of("ParallaxOcclusion(8)", parallax!(ParallaxOcclusion { layers: 8 })),
        of("ParallaxOcclusion(32)", parallax!(ParallaxOcclusion { layers: 32 })),
    ]
}
