//! From a scene and its options to pixels: the one place where names that a user picks at run time become the
//! library's policies.
//!
//! All of them are values, so few pipelines are compiled for each kind of vector registers and of interpolation. Five
//! are for plain surfaces in floats: in these, kernel and fragment stage are optimized together (`draw/plain.rs`). One
//! more calls the stage through a pointer (`draw/general.rs`). Numbers of pixels come out of that as well
//! (`draw/tapped.rs`); runs of straight lines have two small ones of their own (`draw/runs.rs`).

use crate::camera::{self, CAMERA};
use crate::error::Error;
use crate::options::{Arithmetic, Cull, Lod, Projection, RenderOptions};
use crate::scene::{Camera, Image, Model, Part, Vertex};
use crate::slide;
use alberti::glam::Vec3;
use alberti::texture::{Texture, TextureError, format::Rgba8888};
use alberti::{
    AnyDepth, AnyDerivatives, AnyProjection, Eye, Frame, Geometry, Object, Pass, Point3, PreparedTriangle,
    Projector, Rgba8, Slot, Stats, Subpixel, Target, Vector3, View, ViewError, World, clear_by_threads,
    look_at,
};
use std::sync::Arc;

mod clothed;
mod erased;
mod facing;
mod general;
mod hazy;
mod kept;
mod lamps;
mod maps;
mod painted;
mod plain;
mod runs;
mod studio;
mod surveyed;
mod tapped;
mod traced;
mod used;

use facing::Viewpoint;
pub(crate) use general::Studio;
pub(crate) use maps::Chains;
pub(crate) use runs::Counted;
use studio::Rig;
pub(crate) use surveyed::{KNOWN, Known};
pub(crate) use tapped::{Taken, Tap, WHOLE, Word};
pub(crate) use traced::{
    Arrival, COMPONENTS, Corner3, Light, LightRead, Look, MapRead, Piece, ProbeRead, Traced, components,
};
use used::Used;

/// Light that falls everywhere.
pub const AMBIENT: f32 = 0.3;
/// Light that falls on surfaces that face it.
pub const DIFFUSE: f32 = 0.7;

/// Triangles drawn between two reports of progress.
const CHUNK: usize = 1 << 20;

/// The bytes that the vertices and triangles of a model take while they are drawn: copies for both sides, vertices on
/// the screen, lists. Of a large part these are as many as its share.
pub(crate) fn bytes_of(model: &Model) -> u64 {
    let counts = model.parts.iter().map(|part| part.triangles.len());
    let most = counts.clone().max().unwrap_or(0).min(CHUNK) as u64;
    let vertices = model.vertices.len() as u64 * most / counts.sum::<usize>().max(1) as u64;
    4 * size_of::<Vertex>() as u64 * vertices.min(3 * most) + 48 * most
}

/// A target whose depth format is chosen at run time.
pub(crate) type Canvas<'a> = Target<'a, Rgba8888, AnyDepth>;

/// The view of a camera, in perspective; its aspect ratio is the target's.
///
/// # Errors
/// An impossible camera.
pub fn view(camera: &Camera) -> Result<View, ViewError> {
    alberti::Camera::at(frame(camera)?).perspective(camera.fov.to_radians(), camera.near..camera.far)
}

#[expect(clippy::cast_possible_truncation, reason = "rounded once")]
pub(crate) fn aspect(width: u32, height: u32) -> f32 {
    (f64::from(width) / f64::from(height)) as f32
}

/// The same through either projection.
fn any_view(camera: &Camera, projection: Projection) -> Result<View<AnyProjection>, ViewError> {
    match projection {
        Projection::Perspective => Ok(view(camera)?.into()),
        Projection::Parallel { height } => {
            Ok(alberti::Camera::at(frame(camera)?).parallel(height, camera.near..camera.far)?.into())
        }
    }
}

pub(crate) fn frame(camera: &Camera) -> Result<Frame<Eye, World>, ViewError> {
    let point = |p: [f32; 3]| Point3::new(Vec3::from_array(p));
    look_at(point(camera.eye), point(camera.target), Vector3::new(Vec3::from_array(camera.picture_up())))
}

/// The direction towards the light, in world space: from beside, above and behind the camera.
#[must_use]
pub fn to_light(camera: &Camera) -> Vec3 {
    frame(camera).map_or(Vec3::Y, |frame| (frame.axes() * Vec3::new(-0.45, 0.6, -1.0)).normalize())
}

/// A picture under way.
pub(crate) struct Drawing<'a> {
    pub(crate) model: &'a Model,
    options: &'a RenderOptions,
    view: View<AnyProjection>,
    /// The camera's place.
    camera: Frame<Eye, World>,
    rig: Rig,
    /// For two-sided light.
    viewpoint: Option<Viewpoint>,
    studio: &'a Studio,
    textures: Vec<Texture<'a, Rgba8888>>,
    /// The projector and its image.
    slide: Option<(Projector, Texture<'a, Rgba8888>)>,
    stats: Stats,
}

impl<'a> Drawing<'a> {
    /// # Errors
    /// The fault of the camera, the size, the projector or a texture.
    pub(crate) fn new(
        model: &'a Model,
        camera: &Camera,
        options: &'a RenderOptions,
        studio: &'a Studio,
    ) -> Result<Self, Error> {
        let refused = |e| camera::refused(e, camera, options.projection, &CAMERA);
        let view = any_view(camera, options.projection).map_err(refused)?;
        let borrow = |image: &'a Arc<Image>| Texture::new(Rgba8888, &image.texels, image.width, image.height);
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
            camera: frame(camera).map_err(refused)?,
            rig: Rig::new(camera, options),
            viewpoint: Viewpoint::of(camera, options),
            studio,
            textures,
            slide: slide.transpose()?,
            stats: Stats::default(),
        })
    }

    /// Draws the whole model; `progress` hears how many of how many triangles are done.
    pub(crate) fn draw_all(mut self, target: &mut Canvas<'_>, progress: &mut dyn FnMut(u64, u64)) -> Stats {
        let [r, g, b] = self.options.background;
        clear_by_threads(self.options.threads, target, Rgba8::new(r, g, b, 255));
        self.draw_parts(target, progress)
    }

    /// The same over what the target holds already.
    pub(crate) fn draw_parts(
        &mut self,
        target: &mut Canvas<'_>,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Stats {
        let total = self.model.parts.iter().map(|part| part.triangles.len() as u64).sum();
        let mut done = 0;
        let model = self.model;
        for part in &model.parts {
            for triangles in part.triangles.chunks(CHUNK) {
                if self.is_plain(part) {
                    self.draw_plain(part, triangles, target);
                } else {
                    self.draw_general(part, triangles, target);
                }
                done += triangles.len() as u64;
                progress(done, total);
            }
        }
        std::mem::take(&mut self.stats)
    }

    /// Whether a part is drawn by the kernels for plain surfaces.
    fn is_plain(&self, part: &Part) -> bool {
        let float = self.options.policies.arithmetic == Arithmetic::Float && plain::has_kernels();
        let alone = self.slide.is_none() && self.options.haze.is_none() && !part.detail.is_seen_through();
        float && alone && !general::is_lit(part, self.model, self.options)
    }

    /// The triangles of a part, and the vertices that they use.
    fn sided<'t>(&self, triangles: &'t [[u32; 3]]) -> Used<'t>
    where
        'a: 't,
    {
        let Used { vertices, triangles } = Used::of(&self.model.vertices, triangles);
        let Some(viewpoint) = self.viewpoint else { return Used { vertices, triangles } };
        let (vertices, triangles) = viewpoint.turned(vertices, triangles);
        Used { vertices, triangles }
    }

    /// A pass with the options' policies but for the interpolation.
    fn pass<'p, M: Geometry, F>(
        &'p self,
        mesh: &'p M,
        stage: F,
        slots: &'p mut [Slot<M::Varying>],
    ) -> Pass<'p, M, F, alberti::Exact, AnyProjection> {
        Pass::new(&self.view, mesh, stage).cull(self.cull()).subpixel(self.subpixel()).slots(slots)
    }

    /// The view of the camera.
    pub(crate) fn view(&self) -> &View<AnyProjection> {
        &self.view
    }

    /// The vertices' grid.
    pub(crate) fn subpixel(&self) -> Subpixel {
        match self.options.policies.subpixel {
            crate::options::Subpixel::Sub4 => Subpixel::Sub4,
            crate::options::Subpixel::Sub8 => Subpixel::Sub8,
        }
    }

    /// The policy for levels of detail.
    pub(crate) fn derivatives(&self) -> AnyDerivatives {
        match self.options.policies.lod {
            Lod::Pixel => AnyDerivatives::PerPixel,
            Lod::Run => AnyDerivatives::PerRun,
            Lod::Triangle => AnyDerivatives::PerTriangle,
        }
    }

    /// The faces that are left out.
    pub(crate) fn cull(&self) -> alberti::Cull {
        match self.options.cull {
            Cull::Back => alberti::Cull::Back,
            Cull::Front => alberti::Cull::Front,
            Cull::None => alberti::Cull::None,
        }
    }
}

/// Room for a mesh's triangles in bands, and for all of its vertices.
fn memory<M: Geometry>(mesh: &M) -> (Vec<PreparedTriangle>, Vec<Slot<M::Varying>>) {
    (vec![PreparedTriangle::EMPTY; mesh.triangles()], vec![Slot::EMPTY; mesh.vertices()])
}

fn position(v: &Vertex) -> Point3<Object> {
    Point3::new(Vec3::from_array(v.position))
}

pub(crate) fn color(c: [f32; 3]) -> Rgba8 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
    let [r, g, b] = c.map(|x| (x * 255.0 + 0.5) as u8);
    Rgba8::new(r, g, b, 255)
}
