//! The scenes of the trade: each loads what one kind of approximation gets wrong.

use alberti::glam::Vec3;
use alberti::texture::format::Rgba8888;
use alberti::texture::mipmap;
use alberti::{Rgba8, View};
use alberti_app::options::{Cull, Filter, LightOptions, Policies, Projection, RenderOptions, Shading, Wrap};
use alberti_app::scene::{Camera, Image, Model, Part, Vertex};
use alberti_app::scenes::by_name;
use alberti_tests::reference::view;
use std::num::NonZero;
use std::sync::LazyLock;

/// Texels along a side of the textures that are made here.
pub const SIDE: u32 = 256;
/// Behind all scenes.
const BACKGROUND: [u8; 3] = [24, 28, 36];

/// A scene, with its texture's mip map.
#[derive(Debug)]
pub struct Scene {
    /// The name in tables.
    pub name: &'static str,
    /// One sentence about it.
    pub about: &'static str,
    /// One part, and at most one texture.
    pub model: Model,
    /// From where.
    pub camera: Camera,
    /// All levels of the texture.
    pub levels: Vec<[u8; 4]>,
    /// The height of white of its texture's alpha as a relief, in the world.
    pub relief: f32,
}

/// All scenes.
pub static SCENES: LazyLock<Vec<Scene>> = LazyLock::new(|| {
    vec![near_flat(), floor(), close_up(), dense_mesh(), minified(), layers(), lit(), relief()]
});

/// The scene of that name.
///
/// # Panics
/// Without one.
#[must_use]
pub fn scene(name: &str) -> &'static Scene {
    SCENES.iter().find(|scene| scene.name == name).unwrap_or_else(|| panic!("no scene {name}"))
}

impl Scene {
    pub(crate) fn new(name: &'static str, about: &'static str, model: Model, camera: Camera) -> Self {
        let levels = model.textures.first().map_or_else(Vec::new, |image| {
            let mut texels = image.texels.clone();
            texels.resize(mipmap::texel_count(image.width, image.height), [0; 4]);
            mipmap::build(Rgba8888, &mut texels, image.width, image.height).expect("a texture");
            texels
        });
        Self { name, about, model, camera, levels, relief: 0.0 }
    }

    /// The triangles of its part.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.model.parts[0].triangles
    }

    /// The sides of its texture.
    #[must_use]
    pub fn sides(&self) -> [u32; 2] {
        self.model.textures.first().map_or([1; 2], |image| [image.width, image.height])
    }

    /// The view of its camera.
    ///
    /// # Panics
    /// Never: all cameras can see.
    #[must_use]
    pub fn view(&self) -> View {
        view(&self.camera).expect("a camera that can see")
    }

    /// Behind it.
    #[must_use]
    pub fn background(&self) -> Rgba8 {
        let [r, g, b] = BACKGROUND;
        Rgba8::new(r, g, b, 255)
    }

    /// The options under which the command draws it as it is.
    #[must_use]
    pub fn options(&self, [width, height]: [u32; 2], filter: Filter) -> RenderOptions {
        RenderOptions {
            width,
            height,
            background: BACKGROUND,
            shading: Shading::Unlit,
            filter,
            wrap: Wrap::Repeat,
            cull: Cull::Back,
            depth: alberti_app::options::DepthFormat::F32Reversed,
            projection: Projection::Perspective,
            haze: None,
            light: LightOptions::default(),
            threads: NonZero::<usize>::MIN,
            policies: Policies::default(),
        }
    }
}

/// A wall of 8 by 6 cells that leans back a little: q changes by a tenth across it.
fn near_flat() -> Scene {
    let at = |s: f32, t: f32| [2.6 * (s - 0.5), 2.0 * (t - 0.5), -2.6 - 0.26 * s];
    let model = tiled(sheet([8, 6], at, [2.0, 1.5]));
    Scene::new(
        "near-flat",
        "a wall that leans back: q changes by a tenth across it",
        model,
        camera(0.1, 10.0),
    )
}

/// One plane from behind the eye to the horizon.
fn floor() -> Scene {
    let at = |s: f32, t: f32| [400.0 * (s - 0.5), -1.0, 2.0 - 400.0 * t];
    let model = tiled(sheet([1, 1], at, [400.0, 402.0]));
    let camera = Camera { target: [0.0, -0.25, -1.0], ..camera(0.1, 500.0) };
    Scene::new(
        "floor",
        "two triangles from behind the eye to the horizon, through the near plane",
        model,
        camera,
    )
}

/// A wall along the line of sight, whose near end is fifty times as near as its far end.
fn close_up() -> Scene {
    let at = |s: f32, t: f32| [-0.02 + 0.5 * s, 1.2 * (t - 0.5) * (0.02 + s), -0.01 - 2.0 * s];
    let model = tiled(sheet([1, 1], at, [1.0, 1.0]));
    let camera = Camera { target: [0.12, 0.0, -1.0], ..camera(0.001, 10.0) };
    Scene::new("close-up", "a wall past the eye: q falls to a hundredth across two triangles", model, camera)
}

/// The knot of 5,900 triangles.
fn dense_mesh() -> Scene {
    let built_in = by_name("mesh").expect("a built-in scene");
    Scene::new("dense-mesh", "a knot of 5,900 textured triangles", built_in.model, built_in.camera)
}

/// A plane whose texture is squeezed, from one texel a pixel to some thirty.
fn minified() -> Scene {
    let at = |s: f32, t: f32| [12.0 * (s - 0.5), -1.0 + 0.4 * t, -1.2 - 14.0 * t];
    let model = tiled(sheet([6, 8], at, [18.0, 24.0]));
    let camera = Camera { target: [0.0, -0.35, -1.0], ..camera(0.1, 50.0) };
    Scene::new("minified", "a plane that falls away: one to thirty texels a pixel", model, camera)
}

/// 16 tilted screens that cross, far from a near plane that is too near for them.
fn layers() -> Scene {
    let built_in = by_name("fill").expect("a built-in scene");
    let camera = Camera { near: 0.02, far: 2000.0, ..built_in.camera };
    Scene::new("layers", "16 crossing screens between A = 0.02 and B = 2000", built_in.model, camera)
}

/// A torus under a lamp, coarse enough that light at vertices misses highlights.
fn lit() -> Scene {
    let turn = std::f32::consts::TAU;
    let place = |s: f32, t: f32| {
        let ((a, b), (c, d)) = ((s * turn).sin_cos(), (t * turn).sin_cos());
        let ring = 1.0 + 0.42 * d;
        ([ring * a, 0.42 * c, ring * b], [d * a, c, d * b])
    };
    let [columns, rows] = [32_u16, 16];
    let mut model = sheet([columns, rows], |s, t| place(s, t).0, [8.0, 3.0]);
    for (k, vertex) in model.vertices.iter_mut().enumerate() {
        let across = usize::from(columns) + 1;
        let [s, t] = [share(k % across, columns), share(k / across, rows)];
        vertex.normal = place(s, t).1;
        let (a, b) = (s * turn).sin_cos();
        vertex.tangent = [b, 0.0, -a, 1.0];
    }
    let camera = Camera { eye: [0.0, 1.7, 2.4], target: [0.0, -0.1, 0.0], fov: 45.0, ..camera(0.1, 10.0) };
    Scene::new("lit", "a torus of 1,024 triangles under a lamp, with a highlight", tiled(model), camera)
}

/// A wall with bumps a twelfth of a tile deep, seen from aside.
fn relief() -> Scene {
    let at = |s: f32, t: f32| [3.0 * (s - 0.5), 2.2 * (t - 0.5), 0.0];
    let model = textured(sheet([1, 1], at, [3.0, 2.2]), bumps());
    let camera = Camera { eye: [1.5, 0.6, 1.15], target: [0.05, -0.05, 0.0], fov: 50.0, ..camera(0.1, 10.0) };
    let scene = Scene::new(
        "deep-relief",
        "a wall with bumps a twelfth of a tile high, seen from aside",
        model,
        camera,
    );
    Scene { relief: 1.0 / 12.0, ..scene }
}

/// An eye at the origin that looks along -z.
pub(crate) fn camera(near: f32, far: f32) -> Camera {
    Camera { eye: [0.0; 3], target: [0.0, 0.0, -1.0], up: [0.0, 1.0, 0.0], roll: 0.0, fov: 50.0, near, far }
}

fn share(k: usize, of: u16) -> f32 {
    f32::from(u16::try_from(k).expect("few cells")) / f32::from(of)
}

/// A grid of cells, s to the right and t upwards as seen from the front, with so many repeats of a texture.
pub fn sheet([columns, rows]: [u16; 2], at: impl Fn(f32, f32) -> [f32; 3], repeats: [f32; 2]) -> Model {
    let across = u32::from(columns) + 1;
    let corners = (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i, j)));
    let vertex = |(i, j): (u16, u16)| {
        let [s, t] = [share(i.into(), columns), share(j.into(), rows)];
        let [left, right, low, high] =
            [at(s - 1e-3, t), at(s + 1e-3, t), at(s, t - 1e-3), at(s, t + 1e-3)].map(Vec3::from_array);
        let (along, up) = (right - left, high - low);
        let tangent = along.normalize();
        Vertex {
            position: at(s, t),
            normal: along.cross(up).normalize().to_array(),
            uv: [s * repeats[0], t * repeats[1]],
            tangent: [tangent.x, tangent.y, tangent.z, 1.0],
            ..Vertex::default()
        }
    };
    let cells = (0..u32::from(rows)).flat_map(|j| (0..u32::from(columns)).map(move |i| j * across + i));
    let halves = |a: u32| [[a, a + 1, a + across + 1], [a, a + across + 1, a + across]];
    let part = Part { triangles: cells.flat_map(halves).collect(), diffuse: [1.0; 3], ..Part::default() };
    Model { vertices: corners.map(vertex).collect(), parts: vec![part], ..Model::default() }
}

/// A model with tiles on it.
pub(crate) fn tiled(model: Model) -> Model {
    textured(model, tiles())
}

fn textured(model: Model, image: Image) -> Model {
    let parts = model.parts.into_iter().map(|part| Part { texture: Some(0), ..part }).collect();
    Model { parts, textures: vec![image.into()], ..model }
}

/// Tiles of two colours with fine lines and grain: detail of every size.
fn tiles() -> Image {
    image(|x, y| {
        let dark = (x / 32 + y / 32) % 2 == 0;
        let line = x % 32 == 0 || y % 32 == 0 || (x + y) % 64 == 0;
        let base = if dark { [44, 82, 120] } else { [226, 178, 92] };
        let grain = hash(x, y) % 24;
        let [r, g, b] = if line { [250, 246, 236] } else { base.map(|c| c + grain) };
        [r, g, b, 255].map(|c: u32| c.min(255))
    })
}

/// Rounded stones: their colour, and in alpha their height.
fn bumps() -> Image {
    image(|x, y| {
        let inside = |c: u32| (c % 64).min(63 - c % 64).min(16);
        let height = inside(x).min(inside(y)) * 255 / 16;
        let grain = hash(x, y) % 20;
        let [r, g, b] = if height < 128 { [96, 92, 88] } else { [176, 104, 76] };
        [r + grain, g + grain, b + grain, height]
    })
}

fn image(texel: impl Fn(u32, u32) -> [u32; 4]) -> Image {
    let bytes = |k| texel(k % SIDE, k / SIDE).map(|c| u8::try_from(c).expect("a byte"));
    Image { width: SIDE, height: SIDE, texels: (0..SIDE * SIDE).map(bytes).collect() }
}

/// Numbers without a pattern.
fn hash(x: u32, y: u32) -> u32 {
    let mixed = (x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77)).wrapping_mul(0xc2b2_ae3d);
    (mixed ^ mixed >> 15).wrapping_mul(0x27d4_eb2f) >> 16
}
