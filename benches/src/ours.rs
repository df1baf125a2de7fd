//! Alberti, one renderer per policy.

use crate::scene_data::Scene;
use crate::{Renderer, Size};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::{Unlit, VertexColor};
use alberti::texture::{Anisotropic, Bilinear, Mipmap, Nearest, Repeat, Trilinear, mipmap};
use alberti::{
    Affine, Exact, F32, FragmentStage, Interpolation, Mesh, Pass, Planes, Rgba8, Rgba8888, Slot, Spans16,
    Target, Varying, View,
};
use alberti_app::options::{self, DepthFormat, Filter, Policies, Projection, RenderOptions, Shading};
use alberti_app::render::{self, any_depth};
use alberti_app::scene::{Camera, Image, Model, Part, Vertex};
use alberti_app::scenes::BuiltIn;
use alberti_tests::reference::view;
use std::num::NonZero;

/// The policies that are timed, by the name that the benchmark gets. `App` is `Exact` by the kernels of the `alberti`
/// command, whose policies are chosen at run time.
pub const POLICIES: &[&str] = &["Exact", "Planes", "Spans16", "Affine", "App"];

/// Whether the pictures of this policy must be right: see [`crate::reference`]. Those of straight lines are as wrong as
/// their bounds allow.
#[must_use]
pub fn is_right(name: &str) -> bool {
    matches!(name, "Exact" | "Planes" | "App")
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
    if policy == "App" {
        return Some(Box::new(App::new(scene, size)));
    }
    let canvas = Canvas {
        view: view(&scene.built_in.camera).expect("a view"),
        vertices: model.vertices.clone(),
        triangles: scene.triangles.clone(),
        background: scene.background(),
        size,
        color: vec![0; size.pixels()],
        depth: vec![0.0; size.pixels()],
    };
    let image = model.textures.first().filter(|_| scene.texture.is_some()).cloned();
    let filter = scene.built_in.filter;
    Some(match policy {
        "Exact" => boxed(canvas, image, filter, Exact),
        "Planes" => boxed(canvas, image, filter, Planes),
        "Spans16" => boxed(canvas, image, filter, Spans16),
        // Large triangles in perspective are not for it.
        "Affine" if scene.triangles.len() > 1000 => boxed(canvas, image, filter, Affine),
        _ => return None,
    })
}

fn boxed<P: Interpolation>(
    canvas: Canvas,
    image: Option<Image>,
    filter: Filter,
    interpolation: P,
) -> Box<dyn Renderer> {
    let vertices = canvas.vertices.len();
    match image {
        Some(Image { width, height, mut texels }) => {
            texels.resize(mipmap::texel_count(width, height), [0; 4]);
            mipmap::build(Rgba8888, &mut texels, width, height).expect("a texture");
            let slots = vec![Slot::EMPTY; vertices];
            Box::new(Textured { canvas, slots, size: [width, height], texels, filter, interpolation })
        }
        None => Box::new(Colored { canvas, slots: vec![Slot::EMPTY; vertices], interpolation }),
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
    color: Vec<u32>,
    depth: Vec<f32>,
}

impl Canvas {
    fn render<V: Varying>(
        &mut self,
        slots: &mut [Slot<V>],
        vertex_stage: impl Fn(&Vertex) -> (Vec3, V),
        fragment_stage: impl FragmentStage<V, Color = Rgba8>,
        interpolation: impl Interpolation,
    ) {
        let Size { width, height } = self.size;
        let mut target = Target::new(Rgba8888, F32, width, height, &mut self.color, &mut self.depth)
            .expect("buffers that fit");
        let [r, g, b, a] = self.background;
        target.clear(Rgba8::new(r, g, b, a));
        let mesh = Mesh::new(&self.vertices, &self.triangles, vertex_stage);
        Pass::new(&self.view, &mesh, fragment_stage)
            .interpolation(interpolation)
            .slots(slots)
            .draw(&mut target);
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
