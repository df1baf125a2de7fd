//! Alberti, one renderer per policy.

use crate::scene_data::Scene;
use crate::{Renderer, Size};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::{Unlit, VertexColor};
use alberti::texture::{Bilinear, Nearest, Repeat, Texture};
use alberti::{
    Band, Cull, F32, FragmentStage, Pass, Point3, Rgba8, Sides, Slot, Sub8, Varying, VertexStage, View, draw,
};
use alberti_app::draw::view;
use alberti_app::options::Filter;
use alberti_app::scene::{Image, Vertex};

/// The policies that are timed, by the name that the benchmark gets.
pub const POLICIES: &[&str] = &["Exact"];

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
    let canvas = Canvas {
        view: view(&scene.built_in.camera, size.width, size.height).expect("a view"),
        vertices: model.vertices.clone(),
        triangles: scene.triangles.clone(),
        background: scene.background(),
        width: size.width,
        color: vec![0; size.pixels()],
        depth: vec![0.0; size.pixels()],
    };
    let bilinear = scene.built_in.filter == Filter::Bilinear;
    Some(match model.textures.first().filter(|_| scene.texture.is_some()) {
        Some(image) => {
            let slots = vec![Slot::EMPTY; model.vertices.len()];
            Box::new(Textured { canvas, slots, image: image.clone(), bilinear })
        }
        None => {
            let slots = vec![Slot::EMPTY; model.vertices.len()];
            Box::new(Colored { canvas, slots })
        }
    })
}

/// What both kinds of surface need.
#[derive(Clone, Debug)]
struct Canvas {
    view: View,
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
    background: [u8; 4],
    width: u32,
    color: Vec<u32>,
    depth: Vec<f32>,
}

impl Canvas {
    fn render<Vs, Fs>(&mut self, slots: &mut [Slot<Sub8, Vs::Varying>], vertex_stage: Vs, fragment_stage: Fs)
    where
        Vs: VertexStage<Vertex>,
        Vs::Varying: Varying,
        Fs: FragmentStage<Vs::Varying, Color = Rgba8>,
    {
        let mut band = Band::<Rgba8, F32>::new(self.width, 0, &mut self.color, &mut self.depth)
            .expect("buffers that fit");
        let [r, g, b, a] = self.background;
        band.clear(Rgba8::new(r, g, b, a));
        let pass = Pass {
            view: self.view,
            vertices: &self.vertices,
            triangles: &self.triangles,
            vertex_stage,
            fragment_stage,
            cull: Cull::Back,
            sides: Sides::GuardBand,
        };
        draw(&pass, &mut band, slots, &mut ());
    }
}

fn position(v: &Vertex) -> Point3<alberti::Object> {
    Point3::new(Vec3::from_array(v.position))
}

#[derive(Debug)]
struct Textured {
    canvas: Canvas,
    slots: Vec<Slot<Sub8, Vec2>>,
    image: Image,
    bilinear: bool,
}

impl Renderer for Textured {
    fn render(&mut self) {
        let texture = Texture::<Rgba8>::new(&self.image.texels, self.image.width, self.image.height);
        let texture = texture.expect("a texture");
        let vertex = |v: &Vertex| (position(v), Vec2::from_array(v.uv));
        if self.bilinear {
            self.canvas.render(&mut self.slots, vertex, Unlit(texture.sampler::<Bilinear, Repeat>()));
        } else {
            self.canvas.render(&mut self.slots, vertex, Unlit(texture.sampler::<Nearest, Repeat>()));
        }
    }

    fn pixels(&self) -> &[[u8; 4]] {
        bytemuck::cast_slice(&self.canvas.color)
    }
}

#[derive(Debug)]
struct Colored {
    canvas: Canvas,
    slots: Vec<Slot<Sub8, Vec3>>,
}

impl Renderer for Colored {
    fn render(&mut self) {
        let vertex = |v: &Vertex| (position(v), Vec3::from_array(v.color));
        self.canvas.render(&mut self.slots, vertex, VertexColor);
    }

    fn pixels(&self) -> &[[u8; 4]] {
        bytemuck::cast_slice(&self.canvas.color)
    }
}
