//! From a scene and its options to pixels: the one place where names that a user picks at run time become the types
//! that the pipeline is compiled for. Each choice is matched once per part, never per triangle or pixel.
//!
//! Compiling all of them with each other would take hours. So the default policies have a kernel for each fragment
//! stage, in which the two are optimized together, and all others a kernel for each of the rasterizer's policies, which
//! calls any stage through a pointer: see `draw/general.rs`.

use crate::camera::{self, CAMERA};
use crate::error::Error;
use crate::options::{Cull, Filter, Interpolation, Projection, RenderOptions, Shading, Subpixel, Wrap};
use crate::scene::{Camera, Image, Model, Part, Vertex};
use crate::slide;
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::{Lambert, Solid, Tinted, Unlit, VertexColor};
use alberti::texture::{self, Texture, TextureError};
use alberti::{
    Band, Exact, Eye, FragmentStage, Frame, Object, Parallel, Pass, Perspective, Point3, Projector, Rgba8,
    Sides, Slot, Stats, Sub8, Varying, Vector3, VertexStage, View, ViewError, Viewport, World, draw, look_at,
};
use projection::Either;

mod erased;
mod lamps;
mod lines;
mod lit;
mod maps;
mod painted;
mod projection;

pub(crate) use lit::Studio;

/// Light that falls everywhere, and light that falls on what faces it.
pub const AMBIENT: f32 = 0.3;
/// See [`AMBIENT`].
pub const DIFFUSE: f32 = 0.7;

/// Triangles drawn between two reports of progress.
const CHUNK: usize = 1 << 16;

/// The view of a camera, in perspective.
///
/// # Errors
/// An impossible camera or size.
pub fn view(camera: &Camera, width: u32, height: u32) -> Result<View, ViewError> {
    Ok(View {
        to_eye: to_eye(camera)?,
        projection: perspective(camera, aspect(width, height))?,
        viewport: Viewport::new(0, 0, width, height)?,
    })
}

#[expect(clippy::cast_possible_truncation, reason = "rounded once")]
pub(crate) fn aspect(width: u32, height: u32) -> f32 {
    (f64::from(width) / f64::from(height)) as f32
}

/// The same through either projection.
fn either(camera: &Camera, options: &RenderOptions) -> Result<View<Either>, ViewError> {
    let RenderOptions { width, height, .. } = *options;
    let aspect = aspect(width, height);
    Ok(View {
        to_eye: to_eye(camera)?,
        projection: match options.projection {
            Projection::Perspective => Either::Perspective(perspective(camera, aspect)?),
            Projection::Parallel { height } => {
                Either::Parallel(Parallel::new(height, aspect, camera.near, camera.far)?)
            }
        },
        viewport: Viewport::new(0, 0, width, height)?,
    })
}

/// The model stands in the world where it was made.
fn to_eye(camera: &Camera) -> Result<Frame<Object, Eye>, ViewError> {
    Ok(frame(camera)?.inverse_orthonormal() * Frame::<Object, World>::IDENTITY)
}

fn perspective(camera: &Camera, aspect: f32) -> Result<Perspective, ViewError> {
    Perspective::new(camera.fov.to_radians(), aspect, camera.near, camera.far)
}

pub(crate) fn frame(camera: &Camera) -> Result<Frame<Eye, World>, ViewError> {
    let point = |p: [f32; 3]| Point3::new(Vec3::from_array(p));
    look_at(point(camera.eye), point(camera.target), Vector3::new(Vec3::from_array(camera.up)))
}

/// The direction towards the light, in world space: from beside, above and behind the camera.
#[must_use]
pub fn to_light(camera: &Camera) -> Vec3 {
    frame(camera).map_or(Vec3::Y, |frame| (frame.axes() * Vec3::new(-0.45, 0.6, -1.0)).normalize())
}

/// What there is of the filters so far.
#[derive(Clone, Copy)]
enum Taps {
    Nearest,
    Bilinear,
}

impl Taps {
    fn of(filter: Filter) -> Self {
        if filter == Filter::Nearest { Self::Nearest } else { Self::Bilinear }
    }
}

/// From names to types: the filter and the wrap mode.
macro_rules! with_sampler {
    ($texture:expr, $filter:expr, $wrap:expr, |$sampler:ident| $body:expr) => {
        with_sampler!(@ $texture, $filter, $wrap, $sampler, $body,
            Nearest Repeat, Nearest Clamp, Nearest Mirror, Bilinear Repeat, Bilinear Clamp, Bilinear Mirror)
    };
    (@ $texture:expr, $filter:expr, $wrap:expr, $sampler:ident, $body:expr, $($f:ident $w:ident),*) => {
        match (Taps::of($filter), $wrap) {
            $((Taps::$f, Wrap::$w) => {
                let $sampler = $texture.sampler::<texture::$f, texture::$w>();
                $body
            })*
        }
    };
}

// After the macro, which it uses.
mod general;

/// A picture under way.
pub(crate) struct Canvas<'a> {
    model: &'a Model,
    options: &'a RenderOptions,
    view: View<Either>,
    /// Where the camera stands.
    camera: Frame<Eye, World>,
    light: Vector3<World>,
    studio: &'a Studio,
    textures: Vec<Texture<'a, Rgba8>>,
    /// The projector and its image.
    slide: Option<(Projector, Texture<'a, Rgba8>)>,
    stats: Stats,
}

/// How triangles of a part are drawn.
pub(crate) type DrawPart<'a, D> = fn(&mut Canvas<'a>, &Part, &[[u32; 3]], &mut Band<'_, Rgba8, D>);

impl<'a> Canvas<'a> {
    /// # Errors
    /// What is wrong with the camera, the size, the projector or a texture.
    pub(crate) fn new(
        model: &'a Model,
        camera: &Camera,
        options: &'a RenderOptions,
        studio: &'a Studio,
    ) -> Result<Self, Error> {
        let view =
            either(camera, options).map_err(|e| camera::refused(e, camera, options.projection, &CAMERA))?;
        let borrow = |image: &'a Image| Texture::new(&image.texels, image.width, image.height);
        let textures: Result<Vec<_>, TextureError> = model.textures.iter().map(borrow).collect();
        let in_words = |e: TextureError| Error::new(e.to_string(), "textures that can be drawn");
        let textures = textures.map_err(in_words)?;
        let slide = model.slide.as_ref().map(|slide| {
            let image = borrow(&slide.image).map_err(|e| in_words(e).place("--projector"))?;
            Ok((slide::projector(slide)?, image))
        });
        Ok(Self {
            model,
            options,
            view,
            camera: frame(camera).map_err(|e| camera::refused(e, camera, options.projection, &CAMERA))?,
            light: Vector3::new(to_light(camera)),
            studio,
            textures,
            slide: slide.transpose()?,
            stats: Stats::default(),
        })
    }

    /// Draws the whole model into a band; `progress` hears how many of how many triangles are done.
    pub(crate) fn draw_all<D: alberti::DepthFormat>(
        mut self,
        draw_part: DrawPart<'a, D>,
        band: &mut Band<'_, Rgba8, D>,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Stats {
        let [r, g, b] = self.options.background;
        band.clear(Rgba8::new(r, g, b, 255));
        let total = self.model.parts.iter().map(|part| part.triangles.len() as u64).sum();
        let mut done = 0;
        for part in &self.model.parts {
            for triangles in part.triangles.chunks(CHUNK) {
                if lit::is_lit(part, self.model, self.options) {
                    self.draw_lit(part, triangles, band);
                } else {
                    draw_part(&mut self, part, triangles, band);
                }
                done += triangles.len() as u64;
                progress(done, total);
            }
        }
        self.stats
    }

    /// With a kernel for the stage, if the policies are those for which there is one; otherwise [`Self::in_general`].
    pub(crate) fn by_default<D: alberti::DepthFormat>(
        &mut self,
        part: &Part,
        triangles: &[[u32; 3]],
        band: &mut Band<'_, Rgba8, D>,
    ) {
        let policies = self.options.policies;
        if policies.interpolation == Interpolation::Exact
            && policies.subpixel == Subpixel::Sub8
            && self.in_perspective().is_some()
            && self.slide.is_none()
        {
            self.draw_part(part, triangles, band);
        } else {
            self.in_general(part, triangles, band);
        }
    }

    /// From names to types: what a part's surface shows.
    fn draw_part<D: alberti::DepthFormat>(
        &mut self,
        part: &Part,
        triangles: &[[u32; 3]],
        band: &mut Band<'_, Rgba8, D>,
    ) {
        let tint = color(part.diffuse);
        match part.texture.and_then(|t| self.textures.get(t)).copied() {
            _ if self.options.shading == Shading::VertexColor => {
                let vertex = |v: &Vertex| (position(v), Vec3::from_array(v.color));
                self.draw(triangles, vertex, VertexColor, band);
            }
            None => self.draw_surface(Solid(tint), triangles, band),
            Some(texture) => match texture.power_of_two() {
                Some(texture) => with_sampler!(texture, self.options.filter, self.options.wrap, |sampler| {
                    if tint == Rgba8::WHITE {
                        self.draw_surface(Unlit(sampler), triangles, band);
                    } else {
                        self.draw_surface(Tinted { surface: Unlit(sampler), tint }, triangles, band);
                    }
                }),
                // For the rarer sizes, texels are found one by one, beside which a call is little.
                None => self.in_general(part, triangles, band),
            },
        }
    }

    /// From names to types: whether the surface is lit.
    fn draw_surface<D, F>(&mut self, surface: F, triangles: &[[u32; 3]], band: &mut Band<'_, Rgba8, D>)
    where
        D: alberti::DepthFormat,
        F: FragmentStage<Vec2, Color = Rgba8>,
    {
        if self.options.shading.is_lit() {
            let vertex = |v: &Vertex| (position(v), (Vec3::from_array(v.normal), Vec2::from_array(v.uv)));
            self.draw(triangles, vertex, lambert(surface, self.light), band);
        } else {
            self.draw(triangles, |v: &Vertex| (position(v), Vec2::from_array(v.uv)), surface, band);
        }
    }

    fn draw<D, V, F>(
        &mut self,
        triangles: &[[u32; 3]],
        vertex_stage: impl VertexStage<Vertex, Varying = V>,
        fragment_stage: F,
        band: &mut Band<'_, Rgba8, D>,
    ) where
        D: alberti::DepthFormat,
        V: Varying,
        F: FragmentStage<V, Color = Rgba8>,
    {
        let Some(view) = self.in_perspective() else { return };
        let pass = self.pass(view, triangles, vertex_stage, fragment_stage, Exact);
        let mut slots = self.slots::<Sub8, V>(triangles);
        draw(&pass, band, &mut slots, &mut self.stats);
    }

    fn projector(&self) -> Option<Projector> {
        self.slide.map(|(projector, _)| projector)
    }

    /// The view, if it is of the kind that the kernels of the default policies are for.
    fn in_perspective(&self) -> Option<View> {
        let View { to_eye, projection, viewport } = self.view;
        match projection {
            Either::Perspective(projection) => Some(View { to_eye, projection, viewport }),
            Either::Parallel(_) => None,
        }
    }

    fn pass<'t, Vs, F, P, Pr>(
        &self,
        view: View<Pr>,
        triangles: &'t [[u32; 3]],
        vertex_stage: Vs,
        fragment_stage: F,
        interpolation: P,
    ) -> Pass<'t, Vertex, u32, Vs, F, P, Pr>
    where
        'a: 't,
    {
        let cull = match self.options.cull {
            Cull::Back => alberti::Cull::Back,
            Cull::Front => alberti::Cull::Front,
            Cull::None => alberti::Cull::None,
        };
        Pass {
            view,
            vertices: &self.model.vertices,
            triangles,
            vertex_stage,
            fragment_stage,
            cull,
            sides: Sides::GuardBand,
            interpolation,
        }
    }

    /// Enough for each vertex of these triangles; a model of many small parts must not pay for all of its vertices in
    /// each.
    fn slots<S: alberti::Subpixel, V>(&self, triangles: &[[u32; 3]]) -> Vec<Slot<S, V>>
    where
        Slot<S, V>: Clone,
    {
        vec![Slot::EMPTY; self.model.vertices.len().min(3 * triangles.len())]
    }
}

fn lambert<F>(surface: F, light: Vector3<World>) -> Lambert<F> {
    Lambert::new(surface, light, AMBIENT, DIFFUSE)
}

fn position(v: &Vertex) -> Point3<Object> {
    Point3::new(Vec3::from_array(v.position))
}

fn color(c: [f32; 3]) -> Rgba8 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
    let [r, g, b] = c.map(|x| (x * 255.0 + 0.5) as u8);
    Rgba8::new(r, g, b, 255)
}
