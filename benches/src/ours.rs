//! Alberti, one renderer per policy.

use crate::scene_data::Scene;
use crate::{Renderer, Size};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::{Unlit, VertexColor};
use alberti::texture::{Bilinear, Nearest, Repeat, Texture};
use alberti::{
    Exact, F32, FragmentStage, Interpolation, Mesh, Pass, Planes, Rgba8, Rgba8888, Slot, Target, Varying,
    View,
};
use alberti_app::options::{self, DepthFormat, Filter, Policies, Projection, RenderOptions, Shading};
use alberti_app::render::{self, any_depth};
use alberti_app::scene::{Camera, Image, Model, Part, Vertex};
use alberti_app::scenes::BuiltIn;
use alberti_tests::reference::view;
use std::num::NonZero;

/// The policies that are timed, by the name that the benchmark gets. `App` is `Exact` by the kernels of the `alberti`
/// command, whose policies are chosen at run time.
pub const POLICIES: &[&str] = &["Exact", "Planes", "App"];

/// The pictures of these policies must be right: see [`crate::reference`].
#[must_use]
pub fn is_ours(name: &str) -> bool {
    POLICIES.contains(&name)
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
    if !is_ours(policy) {
        return None;
    }
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
    let bilinear = scene.built_in.filter == Filter::Bilinear;
    Some(match policy {
        "Planes" => boxed(canvas, image, bilinear, Planes),
        _ => boxed(canvas, image, bilinear, Exact),
    })
}

fn boxed<P: Interpolation>(
    canvas: Canvas,
    image: Option<Image>,
    bilinear: bool,
    interpolation: P,
) -> Box<dyn Renderer> {
    let vertices = canvas.vertices.len();
    match image {
        Some(image) => {
            Box::new(Textured { canvas, slots: vec![Slot::EMPTY; vertices], image, bilinear, interpolation })
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
    image: Image,
    bilinear: bool,
    interpolation: P,
}

impl<P: Interpolation> Renderer for Textured<P> {
    fn render(&mut self) {
        let texture = Texture::new(Rgba8888, &self.image.texels, self.image.width, self.image.height);
        let texture = texture.expect("a texture").power_of_two().expect("sides that are powers of two");
        let vertex = |v: &Vertex| (position(v), Vec2::from_array(v.uv));
        if self.bilinear {
            self.canvas.render(
                &mut self.slots,
                vertex,
                Unlit(texture.sampler(Bilinear, Repeat)),
                self.interpolation,
            );
        } else {
            self.canvas.render(
                &mut self.slots,
                vertex,
                Unlit(texture.sampler(Nearest, Repeat)),
                self.interpolation,
            );
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
