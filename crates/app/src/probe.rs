//! Numbers of each pixel instead of a colour: interpolated values, and counts of fragments.
//!
//! They come out of the kernels that draw the pictures, by the same policies, to the bit. Three drawings take them: one
//! with the depth test, one without, and for straight lines one that hears of their runs.

use crate::draw::{Drawing, Studio, Taken, Tap, WHOLE, Word};
use crate::error::Error;
use crate::options::{Arithmetic, DepthFormat, RenderOptions};
use crate::render::{any_depth, buffer};
use crate::scene::{Camera, Model};
use alberti::{AnyDepth, Rgba8, Rgba8888, Target};

/// The numbers of a picture's pixels.
#[derive(Debug)]
pub struct Probes {
    width: u32,
    height: u32,
    arithmetic: Arithmetic,
    format: DepthFormat,
    parts: Vec<PartOf>,
    tap: Tap,
    depth: Vec<u32>,
}

/// A part, as far as pixels ask.
#[derive(Clone, Copy, Debug)]
struct PartOf {
    /// The number of the triangle after its last.
    end: u32,
    textured: bool,
    mapped: bool,
}

/// The numbers of a pixel on which something was drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The running number, over all parts, of the triangle that is seen.
    pub triangle: u32,
    /// The index of its part.
    pub part: usize,
    /// Texture coordinates as interpolated, exactly; `None` where the surface uses none.
    pub uv: Option<[f64; 2]>,
    /// The level of detail λ that a mip map of the part's texture is read at, if it has one: 0 or less is
    /// magnification.
    pub lod: Option<f32>,
    /// zs, exactly as it is stored; `None` without a depth buffer.
    pub zs: Option<f64>,
    /// The run that the pixel is in, where straight lines interpolate.
    pub run: Option<Run>,
}

/// A run of samples along which attributes are on straight lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Run {
    /// Columns of the row. Under `affine` there is no division at its ends either.
    Columns {
        /// The first.
        start: u32,
        /// How many.
        length: u32,
    },
    /// All of a small triangle in fixed point.
    Triangle,
}

/// Draws the model for the numbers of its pixels.
///
/// Under the image of a projector triangles are numbered by a drawing of its own, without that image. So, of two
/// surfaces at nearly the same depth, it may tell the other.
///
/// # Errors
/// Those of [`render`](crate::render::render).
pub fn probe(model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Probes, Error> {
    probe_some(model, camera, options, true)
}

/// The same without counts of what arrived and without runs, which take a drawing each.
pub(crate) fn probe_values(model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Probes, Error> {
    probe_some(model, camera, options, false)
}

fn probe_some(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    counts: bool,
) -> Result<Probes, Error> {
    options.policies.check()?;
    let RenderOptions { width, height, .. } = *options;
    let studio = Studio::new(model, camera, options)?;
    let drawing = Drawing::new(model, camera, options, &studio)?;
    if !drawing.is_numberable() {
        return Err(Error::new("more than 2^30 triangles", "a model whose triangles can be numbered"));
    }
    let tap = Tap::new(width, height)?;
    let (mut pixels, mut depth) = (buffer(options, 0)?, buffer(options, 0)?);
    let mut draw = |format: AnyDepth, how: &dyn Fn(&mut Target<'_, Rgba8888, AnyDepth>)| {
        let target = Target::new(Rgba8888, format, width, height, &mut pixels, &mut depth);
        let mut target = target.map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
        target.clear(Rgba8::BLACK);
        how(&mut target);
        Ok(())
    };
    let format = any_depth(options.depth);
    if counts {
        draw(AnyDepth::NoDepth, &|target| drawing.tap(&tap, Taken::Arrival, target))?;
        draw(format, &|target| drawing.tap_runs(&tap, target))?;
    }
    if drawing.numbers_apart() {
        draw(format, &|target| drawing.tap(&tap, Taken::Triangle, target))?;
    }
    // The last, whose depths are kept.
    draw(format, &|target| drawing.tap(&tap, Taken::Values, target))?;
    let mut end = 0;
    let parts = model.parts.iter().zip(drawing.textured()).map(|(part, textured)| {
        end += u32::try_from(part.triangles.len()).unwrap_or(0);
        let mapped = textured && part.texture.is_some_and(|texture| texture < model.textures.len());
        PartOf { end, textured, mapped }
    });
    let parts = parts.collect();
    Ok(Probes {
        width,
        height,
        arithmetic: options.policies.arithmetic,
        format: options.depth,
        parts,
        tap,
        depth,
    })
}

impl Probes {
    /// The columns and rows.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// The number of pixels. All others go by their index: rows from the top, columns from the left.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.depth.len()
    }

    /// The fragments that were shaded: those that passed the depth test.
    #[must_use]
    pub fn shaded(&self, index: usize) -> u32 {
        self.tap.read(index, Word::Shaded)
    }

    /// The fragments that arrived.
    #[must_use]
    pub fn covered(&self, index: usize) -> u32 {
        self.tap.read(index, Word::Covered)
    }

    /// The word in the depth buffer, as [`AnyDepth`] stores it.
    #[must_use]
    pub fn depth(&self, index: usize) -> u32 {
        self.depth.get(index).copied().unwrap_or_default()
    }

    /// The numbers of a pixel, if something was drawn on it.
    #[must_use]
    pub fn seen(&self, index: usize) -> Option<Seen> {
        if self.shaded(index) == 0 {
            return None;
        }
        let read = |word| self.tap.read(index, word);
        let triangle = read(Word::Triangle);
        let part = self.parts.partition_point(|part| part.end <= triangle);
        let PartOf { textured, mapped, .. } = *self.parts.get(part)?;
        let run = match (read(Word::RunStart), read(Word::RunLength)) {
            (_, 0) => None,
            (_, WHOLE) => Some(Run::Triangle),
            (start, length) => Some(Run::Columns { start, length }),
        };
        Some(Seen {
            triangle,
            part,
            uv: textured.then(|| [Word::U, Word::V].map(|word| self.number(read(word)))),
            lod: mapped.then(|| f32::from_bits(read(Word::Lod))),
            zs: zs(self.format, self.depth(index)),
            run,
        })
    }

    fn number(&self, word: u32) -> f64 {
        match self.arithmetic {
            Arithmetic::Float => f32::from_bits(word).into(),
            Arithmetic::Fixed => f64::from(word.cast_signed()) / 65536.0,
        }
    }
}

/// zs of a stored word.
fn zs(format: DepthFormat, word: u32) -> Option<f64> {
    let of_bits = |bits: u32| f64::from(word) / f64::from(u32::MAX >> (32 - bits));
    match format {
        DepthFormat::F32 => Some(f32::from_bits(word).into()),
        DepthFormat::F32Reversed => Some(f32::from_bits(!word).into()),
        DepthFormat::U32 => Some(of_bits(32)),
        DepthFormat::U24 => Some(of_bits(24)),
        DepthFormat::U16 => Some(of_bits(16)),
        DepthFormat::None => None,
    }
}
