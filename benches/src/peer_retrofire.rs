//! [retrofire-core](https://crates.io/crates/retrofire-core) 0.4: scanlines, typed spaces, a full clipper, 1/w as
//! depth.
//!
//! It is timed twice: with its own sampler, as its users have it, and with a texture read by a mask and a truncation of
//! ours, because its sampler's `floor` is a call on a default x86-64 build. The frame has the pixel format in which its
//! colours need no conversion. It has no filter other than nearest, and one written as a shader would be our code, not
//! its own, so bilinear scenes are left out.

use crate::scene_data::{Scene, Texture};
use crate::{Renderer, Size};
use alberti_app::options::Filter;
use retrofire_core::geom::{Tri, Vertex3, vertex};
use retrofire_core::math::{Color3f, Color4, Mat4, ProjMat3, pt2, pt3, rgb, rgba, viewport};
use retrofire_core::render::ctx::FaceCull;
use retrofire_core::render::tex::{self, SamplerRepeatPot};
use retrofire_core::render::{
    Colorbuf, Context, Frag, Framebuf, Model, Ndc, Screen, TexCoord, render, shader, uv,
};
use retrofire_core::util::{Buf2, Dims, pixfmt::Rgba8888};

/// The scene at that size by each of its ways to read a texture; nothing if it needs a filter.
#[must_use]
pub fn renderers(scene: &Scene, size: Size) -> Vec<(&'static str, Box<dyn Renderer>)> {
    if scene.texture.is_some() && scene.built_in.filter == Filter::Bilinear {
        return Vec::new();
    }
    let mut all: Vec<(&'static str, Box<dyn Renderer>)> =
        vec![("retrofire", Box::new(Retrofire::new(scene, size)))];
    if scene.texture.is_some() {
        let mut masked = Retrofire::new(scene, size);
        masked.own_sampler = None;
        all.push(("retrofire-masked", Box::new(masked)));
    }
    all
}

struct Retrofire {
    project: ProjMat3<Model>,
    to_screen: Mat4<Ndc, Screen>,
    context: Context,
    background: [u8; 4],
    triangles: Vec<Tri<usize>>,
    surface: Surface,
    own_sampler: Option<(tex::Texture<Buf2<Color4>>, SamplerRepeatPot)>,
    target: Framebuf<Colorbuf<Buf2<[u8; 4]>, Rgba8888>, Buf2<f32>>,
}

enum Surface {
    Textured(Vec<Vertex3<TexCoord>>, Texture),
    Colored(Vec<Vertex3<Color3f>>),
}

impl Retrofire {
    fn new(scene: &Scene, size: Size) -> Self {
        let mut matrix = scene.clip_from_world(size);
        // Its viewport has y down like its screen, so y is turned here, and with it the side that is seen.
        matrix[1] = matrix[1].map(|c| -c);
        let context = Context { face_cull: Some(FaceCull::Front), ..Context::default() };
        let points = scene.positions.iter().map(|&[x, y, z]| pt3(x, y, z));
        let surface = match &scene.texture {
            Some(texture) => {
                let texels = scene.texels.iter().map(|&[u, v]| uv(u, v));
                Surface::Textured(points.zip(texels).map(|(p, t)| vertex(p, t)).collect(), texture.clone())
            }
            None => {
                let colors = scene.colors.iter().map(|&[r, g, b]| rgb(r, g, b));
                Surface::Colored(points.zip(colors).map(|(p, c)| vertex(p, c)).collect())
            }
        };
        let dims = Dims(size.width, size.height);
        Self {
            project: ProjMat3::new(matrix),
            to_screen: viewport(pt2(0, 0)..pt2(size.width, size.height)),
            context,
            background: scene.background(),
            triangles: scene.triangles.iter().map(|t| Tri(t.map(|i| i as usize))).collect(),
            surface,
            own_sampler: scene.texture.as_ref().map(own_sampler),
            target: Framebuf { color_buf: Colorbuf::new(Buf2::new(dims)), depth_buf: Buf2::new(dims) },
        }
    }
}

fn own_sampler(texture: &Texture) -> (tex::Texture<Buf2<Color4>>, SamplerRepeatPot) {
    let texels = texture.data().iter().map(|&[r, g, b, a]| rgba(r, g, b, a));
    let texture = Buf2::new_from(Dims(texture.width(), texture.height()), texels).into();
    let sampler = SamplerRepeatPot::new(&texture);
    (texture, sampler)
}

impl Renderer for Retrofire {
    fn render(&mut self) {
        self.target.color_buf.buf.fill(self.background);
        // Its depth is 1/w: nothing is farther than 0.
        self.target.depth_buf.fill(0.0);
        let Self { project, to_screen, context, triangles, surface, own_sampler, target, .. } = self;
        match (surface, own_sampler) {
            (Surface::Textured(vertices, _), Some((texture, sampler))) => {
                let shader = shader::new(
                    |v: Vertex3<TexCoord>, m: &ProjMat3<Model>| vertex(m.apply(&v.pos), v.attrib),
                    |frag: Frag<TexCoord>, _: &ProjMat3<Model>| sampler.sample_abs(texture, frag.var),
                );
                render(&*triangles, &*vertices, &shader, &*project, *to_screen, target, context);
            }
            (Surface::Textured(vertices, texture), None) => {
                let shader = shader::new(
                    |v: Vertex3<TexCoord>, m: &ProjMat3<Model>| vertex(m.apply(&v.pos), v.attrib),
                    |frag: Frag<TexCoord>, _: &ProjMat3<Model>| {
                        let [r, g, b, a] = texture.nearest(frag.var.0);
                        rgba(r, g, b, a)
                    },
                );
                render(&*triangles, &*vertices, &shader, &*project, *to_screen, target, context);
            }
            (Surface::Colored(vertices), _) => {
                let shader = shader::new(
                    |v: Vertex3<Color3f>, m: &ProjMat3<Model>| vertex(m.apply(&v.pos), v.attrib),
                    |frag: Frag<Color3f>, _: &ProjMat3<Model>| -> Color4 {
                        let [r, g, b] = frag.var.0;
                        rgba(r as u8, g as u8, b as u8, 255)
                    },
                );
                render(&*triangles, &*vertices, &shader, &*project, *to_screen, target, context);
            }
        }
    }

    fn pixels(&self) -> &[[u8; 4]] {
        self.target.color_buf.buf.data()
    }
}

impl std::fmt::Debug for Retrofire {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Retrofire").field("triangles", &self.triangles.len()).finish_non_exhaustive()
    }
}
