//! Alberti, one renderer per policy.

use crate::scene_data::Scene;
use crate::{Renderer, Size};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::{Unlit, VertexColor};
use alberti::texture::{Bilinear, Nearest, Repeat, Texture};
use alberti::{
    Band, Cull, Exact, F32, FragmentStage, Interpolation, Pass, Plane, Point3, Rgba8, Sides, Slot, Sub8,
    Varying, VertexStage, View, draw,
};
use alberti_app::draw::view;
use alberti_app::options::Filter;
use alberti_app::scene::{Image, Vertex};

/// The policies that are timed, by the name that the benchmark gets.
pub const POLICIES: &[&str] = &["Exact", "Plane"];

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
    let image = model.textures.first().filter(|_| scene.texture.is_some()).cloned();
    let bilinear = scene.built_in.filter == Filter::Bilinear;
    Some(match policy {
        "Plane" => boxed(canvas, image, bilinear, Plane),
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
    fn render<Vs, Fs, P>(
        &mut self,
        slots: &mut [Slot<Sub8, Vs::Varying>],
        vertex_stage: Vs,
        fragment_stage: Fs,
        interpolation: P,
    ) where
        P: Interpolation,
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
            interpolation,
        };
        draw(&pass, &mut band, slots, &mut ());
    }
}

fn position(v: &Vertex) -> Point3<alberti::Object> {
    Point3::new(Vec3::from_array(v.position))
}

#[derive(Debug)]
struct Textured<P> {
    canvas: Canvas,
    slots: Vec<Slot<Sub8, Vec2>>,
    image: Image,
    bilinear: bool,
    interpolation: P,
}

impl<P: Interpolation> Renderer for Textured<P> {
    fn render(&mut self) {
        let texture = Texture::<Rgba8>::new(&self.image.texels, self.image.width, self.image.height);
        let texture = texture.expect("a texture").power_of_two().expect("sides that are powers of two");
        let vertex = |v: &Vertex| (position(v), Vec2::from_array(v.uv));
        if self.bilinear {
            self.canvas.render(
                &mut self.slots,
                vertex,
                Unlit(texture.sampler::<Bilinear, Repeat>()),
                self.interpolation,
            );
        } else {
            self.canvas.render(
                &mut self.slots,
                vertex,
                Unlit(texture.sampler::<Nearest, Repeat>()),
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
    slots: Vec<Slot<Sub8, Vec3>>,
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
