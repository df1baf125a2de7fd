//! Alberti, one renderer per policy.

use crate::pavement::{AMBIENT, LIGHT, TO_LIGHT};
use crate::scene_data::Scene;
use crate::stones::{SIDE, Stones};
use crate::{Renderer, Size};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::material::{
    Color, Directional, Framed, Lambert, Lighting, Material, NormalMap, Shared, Together, Viewer,
};
use alberti::shaders::{Unlit, VertexColor};
use alberti::texture::surface::NormalEncoding::Unorm;
use alberti::texture::{Anisotropic, Bilinear, Mipmap, Nearest, Repeat, Trilinear, mipmap};
use alberti::{
    Affine, Bands, Exact, F32, FragmentStage, Interpolation, Mesh, Pass, Planes, PreparedTriangle, Rgba8,
    Rgba8888, Slot, Spans16, Target, Varying, Vector3, View, clear_by_threads,
};
use alberti_app::options::{
    self, DepthFormat, Filter, LightOptions, Policies, Projection, RenderOptions, Shading,
};
use alberti_app::render::{self, any_depth};
use alberti_app::scene::{Camera, Image, Model, Part, Vertex};
use alberti_app::scenes::BuiltIn;
use alberti_tests::reference::view;
use std::num::NonZero;

/// The policies that are timed, by the name that the benchmark gets. `App` is `Exact` by the kernels of the `alberti`
/// command, whose policies are chosen at run time. All but [`WITHOUT_SLOTS`] have slots for all vertices, all but
/// [`BY_BANDS`] depths for the whole frame.
pub const POLICIES: &[&str] =
    &["Exact", BY_TWO, WITHOUT_SLOTS, BY_BANDS, "Planes", "Spans16", "Affine", "App"];
/// `Exact` by two threads.
pub const BY_TWO: &str = "two threads";
/// `Exact` as it is without more said: vertices in a small cache.
pub const WITHOUT_SLOTS: &str = "Exact-without-slots";
/// `Exact` in bands that share their depths.
pub const BY_BANDS: &str = "Exact-by-bands";

const TWO: NonZero<usize> = NonZero::<usize>::MIN.saturating_add(1);

/// The most depths of a band: two megabytes, which stay in the caches where those of a large frame do not.
const BAND: usize = 1 << 19;

/// Whether the pictures of this policy must be right: see [`crate::reference`]. Those of straight lines are as wrong as
/// their bounds allow.
#[must_use]
pub fn is_right(name: &str) -> bool {
    matches!(name, "Exact" | BY_TWO | WITHOUT_SLOTS | BY_BANDS | "Planes" | "App")
}

/// The scene under a policy, or nothing when the policy does not draw such a scene.
///
/// Everything that a user would prepare once belongs here; transforms of vertices belong in
/// [`Renderer::render`].
///
/// # Panics
/// When a scene's camera or texture cannot be drawn.
#[must_use]
pub fn renderer(policy: &str, scene: &Scene, size: Size) -> Option<Box<dyn Renderer>> {
    let model = &scene.built_in.model;
    if policy == "App" && scene.stones.is_none() {
        return Some(Box::new(App::new(scene, size)));
    }
    let triangles = scene.triangles.len();
    let band = (BAND / size.width as usize).clamp(1, size.height as usize) * size.width as usize;
    let room = || Some(vec![PreparedTriangle::EMPTY; triangles]);
    let (room, depths) = match policy {
        BY_BANDS => (room(), band),
        BY_TWO => (room(), size.pixels()),
        _ => (None, size.pixels()),
    };
    let canvas = Canvas {
        view: view(&scene.built_in.camera).expect("a view"),
        vertices: model.vertices.clone(),
        triangles: scene.triangles.clone(),
        background: scene.background(),
        size,
        slots: if policy == WITHOUT_SLOTS { 0 } else { model.vertices.len() },
        room,
        by_two: policy == BY_TWO,
        color: vec![0; size.pixels()],
        depth: vec![0.0; depths],
    };
    if let Some(stones) = &scene.stones {
        return match policy {
            "Exact" | BY_TWO => Some(Box::new(Pavement::new(canvas, stones, Exact))),
            "Planes" => Some(Box::new(Pavement::new(canvas, stones, Planes))),
            _ => None,
        };
    }
    let image = model.textures.first().filter(|_| scene.texture.is_some()).map(|image| Image::clone(image));
    let filter = scene.built_in.filter;
    Some(match policy {
        "Exact" | BY_TWO | BY_BANDS => boxed(canvas, image, filter, Exact),
        // Few vertices need no slots.
        WITHOUT_SLOTS if triangles > 1000 => boxed(canvas, image, filter, Exact),
        "Planes" => boxed(canvas, image, filter, Planes),
        "Spans16" => boxed(canvas, image, filter, Spans16),
        // Large triangles in perspective are not for it.
        "Affine" if triangles > 1000 => boxed(canvas, image, filter, Affine),
        _ => return None,
    })
}

fn boxed<P: Interpolation>(
    canvas: Canvas,
    image: Option<Image>,
    filter: Filter,
    interpolation: P,
) -> Box<dyn Renderer> {
    let slots = canvas.slots;
    match image {
        Some(Image { width, height, mut texels }) => {
            texels.resize(mipmap::texel_count(width, height), [0; 4]);
            mipmap::build(Rgba8888, &mut texels, width, height).expect("a texture");
            let slots = vec![Slot::EMPTY; slots];
            Box::new(Textured { canvas, slots, size: [width, height], texels, filter, interpolation })
        }
        None => Box::new(Colored { canvas, slots: vec![Slot::EMPTY; slots], interpolation }),
    }
}

/// The common part of both kinds of surface.
#[derive(Clone, Debug)]
struct Canvas {
    view: View,
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
    background: [u8; 4],
    size: Size,
    /// The number of slots.
    slots: usize,
    /// Room for the triangles of a frame in bands.
    room: Option<Vec<PreparedTriangle>>,
    /// Whether these are drawn by two threads.
    by_two: bool,
    color: Vec<u32>,
    /// Those of all rows, or of a band's.
    depth: Vec<f32>,
}

impl Canvas {
    fn render<V: Varying>(
        &mut self,
        slots: &mut [Slot<V>],
        vertex_stage: impl Fn(&Vertex) -> (Vec3, V) + Sync,
        fragment_stage: impl FragmentStage<V, Color = Rgba8> + Sync,
        interpolation: impl Interpolation,
    ) where
        Slot<V>: Send + Sync,
    {
        let Self { view, vertices, triangles, background, room, by_two, color, depth, .. } = self;
        let Size { width, height } = self.size;
        let [r, g, b, a] = *background;
        let background = Rgba8::new(r, g, b, a);
        let mesh = Mesh::new(vertices, triangles, vertex_stage);
        let mut pass = Pass::new(view, &mesh, fragment_stage).interpolation(interpolation).slots(slots);
        if let (Some(room), false) = (&mut *room, *by_two) {
            let mut bands = Bands::new(Rgba8888, F32, width, height, color, depth).expect("buffers that fit");
            let (mut prepared, _) = pass.prepare(&bands, room);
            bands.draw(background, |band| prepared.draw(band));
        } else {
            let mut target =
                Target::new(Rgba8888, F32, width, height, color, depth).expect("buffers that fit");
            match room {
                Some(room) => {
                    clear_by_threads(TWO, &mut target, background);
                    pass.draw_by_threads(TWO, room, &mut target);
                }
                None => {
                    target.clear(background);
                    pass.draw(&mut target);
                }
            }
        }
    }
}

fn position(v: &Vertex) -> Vec3 {
    Vec3::from_array(v.position)
}

#[derive(Debug)]
struct Textured<P> {
    canvas: Canvas,
    slots: Vec<Slot<Vec2>>,
    size: [u32; 2],
    /// All levels.
    texels: Vec<[u8; 4]>,
    filter: Filter,
    interpolation: P,
}

impl<P: Interpolation> Renderer for Textured<P> {
    fn render(&mut self) {
        let Self { canvas, slots, size: [width, height], texels, filter, interpolation } = self;
        let levels = Mipmap::new(Rgba8888, texels, *width, *height).expect("a texture");
        let levels = levels.power_of_two().expect("sides that are powers of two");
        let texture = levels.level(0);
        let vertex = |v: &Vertex| (position(v), Vec2::from_array(v.uv));
        macro_rules! render {
            ($sampler:expr) => {
                canvas.render(slots, vertex, Unlit($sampler), *interpolation)
            };
        }
        match *filter {
            Filter::Nearest => render!(texture.sampler(Nearest, Repeat)),
            Filter::Bilinear => render!(texture.sampler(Bilinear, Repeat)),
            Filter::Trilinear => render!(levels.sampler(Trilinear, Repeat)),
            Filter::Anisotropic(probes) => {
                let filter = Anisotropic { probes: probes.count(), filter: Trilinear };
                render!(levels.sampler(filter, Repeat));
            }
        }
    }

    fn pixels(&self) -> &[[u8; 4]] {
        bytemuck::cast_slice(&self.canvas.color)
    }
}

#[derive(Debug)]
struct Colored<P> {
    canvas: Canvas,
    slots: Vec<Slot<Vec3>>,
    interpolation: P,
}

impl<P: Interpolation> Renderer for Colored<P> {
    fn render(&mut self) {
        let vertex = |v: &Vertex| (position(v), Vec3::from_array(v.color));
        self.canvas.render(&mut self.slots, vertex, VertexColor, self.interpolation);
    }

    fn pixels(&self) -> &[[u8; 4]] {
        bytemuck::cast_slice(&self.canvas.color)
    }
}

/// The pavement, as a material of two maps.
#[derive(Debug)]
struct Pavement<P> {
    canvas: Canvas,
    slots: Vec<Slot<Framed>>,
    stones: Stones,
    interpolation: P,
}

impl<P> Pavement<P> {
    fn new(canvas: Canvas, stones: &Stones, interpolation: P) -> Self {
        let slots = vec![Slot::EMPTY; canvas.vertices.len()];
        Self { canvas, slots, stones: stones.clone(), interpolation }
    }
}

impl<P: Interpolation> Renderer for Pavement<P> {
    fn render(&mut self) {
        let Self { canvas, slots, stones, interpolation } = self;
        let maps = [&stones.color, &stones.normal].map(|texels| {
            let levels = Mipmap::new(Rgba8888, texels, SIDE, SIDE).expect("levels");
            levels.power_of_two().expect("a power of two")
        });
        let material = Material {
            layers: Together {
                maps: Mipmap::together(maps).expect("one size").sampler(Trilinear, Repeat),
                layers: (Color(Shared), NormalMap { map: Shared, encoding: Unorm, strength: 1.0 }),
            },
            lighting: Lighting {
                // Lambert's law asks for no viewer.
                viewer: Viewer::towards(Vector3::new(Vec3::Z)),
                ambient: Vec3::splat(AMBIENT),
                lights: Directional::new(Vector3::new(TO_LIGHT), Vec3::splat(LIGHT)),
                reflectance: Lambert,
            },
        };
        let vertex = |v: &Vertex| {
            let ([x, y, z, sign], normal) = (v.tangent, Vec3::from_array(v.normal));
            let tangent = Vec3::new(x, y, z);
            let axes = [tangent, normal.cross(tangent) * sign, normal];
            (position(v), Framed { position: position(v), axes, uv: Vec2::from_array(v.uv) })
        };
        canvas.render(slots, vertex, material, *interpolation);
    }

    fn pixels(&self) -> &[[u8; 4]] {
        bytemuck::cast_slice(&self.canvas.color)
    }
}

/// The scene by the command's kernels.
#[derive(Debug)]
struct App {
    model: Model,
    camera: Camera,
    options: RenderOptions,
    color: Vec<u32>,
    depth: Vec<u32>,
}

impl App {
    fn new(scene: &Scene, size: Size) -> Self {
        let BuiltIn { model, camera, filter, wrap, .. } = &scene.built_in;
        let textured = scene.texture.is_some();
        let part = Part {
            triangles: scene.triangles.clone(),
            diffuse: [1.0; 3],
            texture: textured.then_some(0),
            ..Part::default()
        };
        let [r, g, b, _] = scene.background();
        let options = RenderOptions {
            width: size.width,
            height: size.height,
            background: [r, g, b],
            shading: if textured { Shading::Unlit } else { Shading::VertexColor },
            filter: *filter,
            wrap: *wrap,
            cull: options::Cull::Back,
            depth: DepthFormat::F32,
            projection: Projection::Perspective,
            haze: None,
            light: LightOptions::default(),
            threads: NonZero::<usize>::MIN,
            policies: Policies::default(),
        };
        let model = Model { parts: vec![part], ..model.clone() };
        Self { model, camera: *camera, options, color: vec![0; size.pixels()], depth: vec![0; size.pixels()] }
    }
}

impl Renderer for App {
    fn render(&mut self) {
        let Self { model, camera, options, color, depth } = self;
        let format = any_depth(options.depth);
        let mut target = Target::new(Rgba8888, format, options.width, options.height, color, depth)
            .expect("buffers that fit");
        render::draw(model, camera, options, &mut target, &mut |_, _| {}).expect("a picture");
    }

    fn pixels(&self) -> &[[u8; 4]] {
        bytemuck::cast_slice(&self.color)
    }
}
