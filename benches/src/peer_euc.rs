//! [euc](https://crates.io/crates/euc) 0.5.3: shaders as a trait, half-spaces evaluated in f32 at every pixel of a
//! triangle's box.
//!
//! What is done for it, as a user of its API could:
//! * vertices are transformed once a frame; its own vertex stage runs for every corner, so here it only looks up;
//! * attributes are interpolated with plain multiplications: its own types use `mul_add`, which on a default x86-64
//!   build is a call;
//! * it does not clip: a triangle with a vertex behind the eye is drawn wrongly or fills the screen. The scenes'
//!   triangles
//!   are therefore cut at the near plane once, outside of the time. Only `floor` has such triangles.

use crate::scene_data::{Scene, Texture};
use crate::{Renderer, Size};
use alberti_app::options::Filter;
use euc::buffer::Buffer2d;
use euc::rasterizer::{BackfaceCullingEnabled, Triangles};
use euc::{Interpolate, Pipeline, Target};

/// The scene at that size.
#[must_use]
pub fn renderer(scene: &Scene, size: Size) -> Box<dyn Renderer> {
    let clip = scene.clip_from_world(size);
    let stage = |shade: Shade| Box::new(Euc::new(scene, size, clip, shade));
    match (&scene.texture, scene.built_in.filter) {
        (None, _) => stage(Shade::Color),
        (Some(_), Filter::Nearest) => stage(Shade::Nearest),
        (Some(_), _) => stage(Shade::Bilinear),
    }
}

#[derive(Clone, Copy, Debug)]
enum Shade {
    Nearest,
    Bilinear,
    Color,
}

#[derive(Debug)]
struct Euc {
    matrix: [[f32; 4]; 4],
    shade: Shade,
    background: [u8; 4],
    positions: Vec<[f32; 3]>,
    /// Texels and nothing, or colours.
    attributes: Vec<[f32; 3]>,
    indices: Vec<u32>,
    texture: Option<Texture>,
    transformed: Vec<[f32; 4]>,
    color: Buffer2d<[u8; 4]>,
    depth: Buffer2d<f32>,
}

impl Euc {
    fn new(scene: &Scene, size: Size, matrix: [[f32; 4]; 4], shade: Shade) -> Self {
        let attributes: Vec<[f32; 3]> = match shade {
            Shade::Color => scene.colors.clone(),
            Shade::Nearest | Shade::Bilinear => scene.texels.iter().map(|&[u, v]| [u, v, 0.0]).collect(),
        };
        let extent = [size.width as usize, size.height as usize];
        let mut euc = Self {
            matrix,
            shade,
            background: scene.background(),
            positions: scene.positions.clone(),
            attributes,
            indices: Vec::new(),
            texture: scene.texture.clone(),
            transformed: Vec::new(),
            color: Buffer2d::new(extent, [0; 4]),
            depth: Buffer2d::new(extent, 1.0),
        };
        for &triangle in &scene.triangles {
            euc.add_in_front(triangle);
        }
        euc
    }

    /// Adds the part of a triangle that lies beyond the near plane.
    fn add_in_front(&mut self, triangle: [u32; 3]) {
        let near = |[_, _, z, w]: [f32; 4]| f64::from(z) + f64::from(w);
        let distance = triangle.map(|i| near(transform(&self.matrix, self.positions[i as usize])));
        if distance.iter().all(|&d| d >= 0.0) {
            self.indices.extend(triangle);
            return;
        }
        let mut polygon = Vec::new();
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            if distance[i] >= 0.0 {
                polygon.push(triangle[i]);
            }
            if (distance[i] >= 0.0) != (distance[j] >= 0.0) {
                let t = distance[i] / (distance[i] - distance[j]);
                let [a, b] = [triangle[i], triangle[j]].map(|k| k as usize);
                let lerp = |a: f32, b: f32| (f64::from(a) + (f64::from(b) - f64::from(a)) * t) as f32;
                let between = |of: &[[f32; 3]]| std::array::from_fn(|axis| lerp(of[a][axis], of[b][axis]));
                let (position, attribute) = (between(&self.positions), between(&self.attributes));
                polygon.push(self.positions.len() as u32);
                self.positions.push(position);
                self.attributes.push(attribute);
            }
        }
        for i in 2..polygon.len() {
            self.indices.extend([polygon[0], polygon[i - 1], polygon[i]]);
        }
    }
}

impl Renderer for Euc {
    fn render(&mut self) {
        self.color.clear(self.background);
        self.depth.clear(1.0);
        let Self { matrix, positions, transformed, attributes, .. } = self;
        transformed.clear();
        transformed.extend(positions.iter().map(|&p| transform(matrix, p)));
        let (positions, indices) = (&transformed[..], &self.indices[..]);
        let (color, depth) = (&mut self.color, &mut self.depth);
        match (&self.texture, self.shade) {
            (Some(texture), Shade::Nearest) => {
                draw(&Textured::<false> { positions, texels: attributes, texture }, indices, color, depth);
            }
            (Some(texture), Shade::Bilinear) => {
                draw(&Textured::<true> { positions, texels: attributes, texture }, indices, color, depth);
            }
            _ => draw(&Colored { positions, colors: attributes }, indices, color, depth),
        }
    }

    fn pixels(&self) -> &[[u8; 4]] {
        self.color.as_ref()
    }
}

fn draw<P: Pipeline<Vertex = u32, Pixel = [u8; 4]>>(
    pipeline: &P,
    indices: &[u32],
    color: &mut Buffer2d<[u8; 4]>,
    depth: &mut Buffer2d<f32>,
) {
    pipeline.draw::<Triangles<'_, _, BackfaceCullingEnabled>, _>(indices, color, Some(depth));
}

#[inline(always)]
fn transform(m: &[[f32; 4]; 4], [x, y, z]: [f32; 3]) -> [f32; 4] {
    [0, 1, 2, 3].map(|i| m[i][0] * x + m[i][1] * y + m[i][2] * z + m[i][3])
}

/// Attributes that are interpolated without calls.
#[derive(Clone, Copy)]
struct Lanes<const N: usize>([f32; N]);

impl<const N: usize> Interpolate for Lanes<N> {
    #[inline(always)]
    fn lerp2(a: Self, b: Self, x: f32, y: f32) -> Self {
        Self(std::array::from_fn(|i| a.0[i] * x + b.0[i] * y))
    }

    #[inline(always)]
    fn lerp3(a: Self, b: Self, c: Self, x: f32, y: f32, z: f32) -> Self {
        Self(std::array::from_fn(|i| a.0[i] * x + b.0[i] * y + c.0[i] * z))
    }
}

struct Textured<'a, const BILINEAR: bool> {
    positions: &'a [[f32; 4]],
    texels: &'a [[f32; 3]],
    texture: &'a Texture,
}

impl<const BILINEAR: bool> Pipeline for Textured<'_, BILINEAR> {
    type Vertex = u32;
    type VsOut = Lanes<2>;
    type Pixel = [u8; 4];

    #[inline(always)]
    fn vert(&self, &index: &u32) -> ([f32; 4], Lanes<2>) {
        let [u, v, _] = self.texels[index as usize];
        (self.positions[index as usize], Lanes([u, v]))
    }

    #[inline(always)]
    fn frag(&self, &Lanes(uv): &Lanes<2>) -> [u8; 4] {
        if BILINEAR { self.texture.bilinear(uv) } else { self.texture.nearest(uv) }
    }
}

struct Colored<'a> {
    positions: &'a [[f32; 4]],
    colors: &'a [[f32; 3]],
}

impl Pipeline for Colored<'_> {
    type Vertex = u32;
    type VsOut = Lanes<3>;
    type Pixel = [u8; 4];

    #[inline(always)]
    fn vert(&self, &index: &u32) -> ([f32; 4], Lanes<3>) {
        (self.positions[index as usize], Lanes(self.colors[index as usize]))
    }

    #[inline(always)]
    fn frag(&self, &Lanes([r, g, b]): &Lanes<3>) -> [u8; 4] {
        [r as u8, g as u8, b as u8, 255]
    }
}
