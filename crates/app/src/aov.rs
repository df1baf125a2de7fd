//! Numbers of the surface that is seen at each pixel, for programs that work on pictures: arbitrary output variables.
//!
//! They come out of the kernels that draw the pictures, at the middles of pixels. Depth test, subpixels and culling are
//! the picture's. Interpolation is [`Interpolation::Exact`] in floats, whatever its policies are.

use crate::draw::{Drawing, KNOWN, Known, Studio, Tap};
use crate::error::Error;
use crate::options::{Arithmetic, Interpolation, Policies, RenderOptions};
use crate::render::{any_depth, buffer};
use crate::scene::{Camera, Model};
use alberti::{DepthFormat as _, Rgba8888, Target};

/// The numbers of a picture's pixels.
#[derive(Debug)]
pub struct Layers {
    width: u32,
    height: u32,
    tap: Tap<KNOWN>,
    /// The number of the triangle after each part's last.
    ends: Vec<u32>,
}

/// The numbers of a pixel on which something is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The distance before the camera's plane, z in eye space, in units of the scene.
    pub depth: f32,
    /// The unit normal in world space, after all maps. Of a two-sided surface it is on the viewer's side.
    pub normal: [f32; 3],
    /// Texture coordinates, before any parallax; 0 where the model has none.
    pub uv: [f32; 2],
    /// The level of detail λ of the surface's texture, if it has one.
    pub lod: Option<f32>,
    /// The number of the part, from 1 on, in drawing order.
    pub object: u32,
    /// The number of the triangle over all parts, from 1 on, in drawing order.
    pub triangle: u32,
}

/// Draws the model for the numbers of its pixels. Holes are left out, and surfaces that are seen through where they
/// hide less than half of what is behind them.
///
/// # Cost
/// A drawing of the picture with one sample a pixel, on which materials are worked one fragment at a time, and 32 bytes
/// a pixel.
///
/// # Errors
/// Those of [`render`](crate::render::render).
pub fn layers(model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Layers, Error> {
    options.policies.check()?;
    let policies =
        Policies { interpolation: Interpolation::Exact, arithmetic: Arithmetic::Float, ..options.policies };
    let options = RenderOptions { policies, ..*options };
    let RenderOptions { width, height, .. } = options;
    let studio = Studio::new(model, camera, &options)?;
    let drawing = Drawing::new(model, camera, &options, &studio)?;
    if !drawing.is_numberable() {
        return Err(Error::new("more than 2^30 triangles", "a model whose triangles can be numbered"));
    }
    let tap = Tap::new(width, height)?;
    let format = any_depth(options.depth);
    let (mut pixels, mut depth) = (buffer(&options, 0)?, buffer(&options, format.farthest())?);
    let target = Target::new(Rgba8888, format, width, height, &mut pixels, &mut depth);
    let mut target = target.map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
    drawing.survey(&tap, &mut target);
    let mut end = 0;
    let ends = model.parts.iter().map(|part| {
        end += u32::try_from(part.triangles.len()).unwrap_or(0);
        end
    });
    let ends = ends.collect();
    Ok(Layers { width, height, tap, ends })
}

impl Layers {
    /// The columns and rows.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// The numbers of all pixels: rows from the top, columns from the left.
    pub fn pixels(&self) -> impl Iterator<Item = Option<Seen>> + '_ {
        (0..self.width as usize * self.height as usize).map(|index| self.seen(index))
    }

    fn seen(&self, index: usize) -> Option<Seen> {
        let number = |known| f32::from_bits(self.tap.read(index, known));
        let triangle = self.tap.read(index, Known::Triangle);
        let part = self.ends.partition_point(|end| *end < triangle);
        (triangle > 0).then(|| Seen {
            depth: number(Known::Depth),
            normal: [Known::X, Known::Y, Known::Z].map(number),
            uv: [Known::U, Known::V].map(number),
            lod: Some(number(Known::Lod)).filter(|lod| !lod.is_nan()),
            object: u32::try_from(part).unwrap_or(u32::MAX).saturating_add(1),
            triangle,
        })
    }
}
