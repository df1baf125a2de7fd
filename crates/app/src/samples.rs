//! Anti-aliased pictures: an ordered grid of samples a pixel, whose light is averaged, in bands of few samples.

use std::num::NonZero;
use std::sync::Arc;

use alberti::raster::color::{Average, resolve};
use alberti::{AnyDepth, DepthFormat as _, Rgba8888, Stats, Target};

use crate::display::stored;
use crate::draw::{Chains, Drawing, Studio};
use crate::error::Error;
use crate::options::{RenderOptions, Samples};
use crate::render::{Picture, any_depth, buffer, room};
use crate::scene::backdrop::Backdrop;
use crate::scene::{Camera, Image, Model};
use crate::threads::{Task, by_threads};

mod straight;

/// The most samples of a band, unless a row of pixels has more: 64 MiB with their depths.
const BAND: usize = 1 << 23;

/// Draws the model with so many samples a pixel before a backdrop. `progress` hears (triangles done, all triangles).
///
/// Pixels are those of a picture as many times as wide and as high, resolved in linear light; the options' colour
/// format rounds the result. Before [`Backdrop::Transparent`] alpha is the covered part of a pixel, and its colour that
/// of this part.
///
/// # Cost
/// Eight bytes a sample of a band, and four a pixel. Vertices are worked on once for each band. A transparent backdrop
/// draws all twice.
///
/// # Errors
/// Those of [`render`](crate::render::render), and a picture of too many samples.
pub fn supersampled(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    samples: Samples,
    backdrop: &Backdrop,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Picture, Error> {
    let chains = Arc::new(Chains::new(model, options)?);
    supersampled_with(&chains, (model, camera), options, samples, backdrop, progress)
}

/// The same with mip maps that are there.
///
/// # Errors
/// As those of [`supersampled`].
pub(crate) fn supersampled_with(
    chains: &Arc<Chains>,
    (model, camera): (&Model, &Camera),
    options: &RenderOptions,
    samples: Samples,
    backdrop: &Backdrop,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Picture, Error> {
    options.policies.check()?;
    samples.check(options.width, options.height)?;
    let studio = Studio::with(chains.clone(), model, camera, options);
    let mut drawing = Drawing::new(model, camera, options, &studio)?;
    let mut band = Band::new(options, samples, backdrop)?;
    let mut texels = buffer(options, [0; 4])?;
    let (mut stats, bands) = (Stats::default(), u64::from(options.height.div_ceil(band.rows)));
    let row = options.width as usize;
    for (texels, k) in texels.chunks_mut(row * band.rows as usize).zip(0..) {
        let mut hear = |done, total| progress(k * total + done, bands * total);
        let first_row = u32::try_from(k).unwrap_or_default() * band.rows;
        let counts = band.draw(&mut drawing, first_row, texels.len() / row, &mut hear)?;
        stats = if k == 0 { counts } else { added(stats, counts) };
        band.resolve(first_row, texels);
    }
    Ok(Picture { image: Image { width: options.width, height: options.height, texels }, stats })
}

/// Counts of one more band. What the sides of the view decide is the same in each.
fn added(all: Stats, Stats { missed, drawn, fragments, written, .. }: Stats) -> Stats {
    Stats {
        missed: all.missed + missed,
        drawn: all.drawn + drawn,
        fragments: all.fragments + fragments,
        written: all.written + written,
        ..all
    }
}

/// The bytes that a picture of so many samples a pixel takes while it is drawn, at most.
pub(crate) fn bytes([width, height]: [u32; 2], samples: Samples, transparent: bool) -> u64 {
    let row = u64::from(width) * u64::from(samples.side() * samples.side());
    let band = (row * u64::from(height)).min(row.max(BAND as u64));
    4 * u64::from(width) * u64::from(height) + band * if transparent { 12 } else { 8 }
}

/// The samples of some rows.
struct Band<'a> {
    options: &'a RenderOptions,
    backdrop: &'a Backdrop,
    /// Columns, and rows, of samples in a pixel.
    side: u32,
    /// Rows of pixels.
    rows: u32,
    color: Vec<u32>,
    /// The same before white, of a transparent picture.
    white: Vec<u32>,
    depth: Vec<<AnyDepth as alberti::DepthFormat>::Stored>,
}

impl<'a> Band<'a> {
    fn new(options: &'a RenderOptions, samples: Samples, backdrop: &'a Backdrop) -> Result<Self, Error> {
        let side = samples.side();
        let row = options.width as usize * (side * side) as usize;
        let rows = u32::try_from(BAND / row).unwrap_or(u32::MAX).clamp(1, options.height);
        let area = row * rows as usize;
        let white = if *backdrop == Backdrop::Transparent { area } else { 0 };
        Ok(Self {
            options,
            backdrop,
            side,
            rows,
            color: room(options, area, 0)?,
            white: room(options, white, 0)?,
            depth: room(options, area, any_depth(options.depth).farthest())?,
        })
    }

    /// Draws so many rows of pixels.
    fn draw(
        &mut self,
        drawing: &mut Drawing<'_>,
        first_row: u32,
        rows: usize,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<Stats, Error> {
        let (format, side) = (any_depth(self.options.depth), self.side);
        let size = [self.options.width * side, self.options.height * side];
        let area = size[0] as usize * rows * side as usize;
        let refused = |found: alberti::raster::TargetError| {
            Error::new(found.to_string(), "a size that can be drawn").place("--size")
        };
        self.lay(first_row);
        let depth = self.depth.get_mut(..area).unwrap_or_default();
        let mut draw = |color: &mut [u32]| {
            depth.fill(format.farthest());
            let color = color.get_mut(..area).unwrap_or_default();
            let mut target = Target::band(Rgba8888, format, size, first_row * side, color, depth)?;
            Ok(drawing.draw_parts(&mut target, progress))
        };
        let stats = draw(&mut self.color).map_err(refused)?;
        if *self.backdrop == Backdrop::Transparent {
            draw(&mut self.white).map_err(refused)?;
        }
        Ok(stats)
    }

    /// Lays the backdrop under all samples.
    fn lay(&mut self, first_row: u32) {
        self.white.fill(u32::MAX);
        let [width, height] = [self.options.width, self.options.height];
        let (side, columns) = (self.side as usize, width as usize * self.side as usize);
        let mut row = vec![0; width as usize];
        for (samples, y) in self.color.chunks_mut(columns * side).zip(first_row..height) {
            self.backdrop.row(y, height, &mut row);
            let mut rows = samples.chunks_mut(columns);
            let Some(first) = rows.next() else { continue };
            for (samples, pixel) in first.chunks_mut(side).zip(&row) {
                samples.fill(*pixel);
            }
            rows.for_each(|row| row.copy_from_slice(first));
        }
    }

    /// Makes pixels of the samples: the same by any number of threads.
    fn resolve(&self, first_row: u32, texels: &mut [[u8; 4]]) {
        let row = self.options.width as usize;
        let samples = row * (self.side * self.side) as usize;
        let rows = (texels.len() / row).div_ceil(self.options.threads.min(MOST).get());
        let work = texels.chunks_mut(row * rows).zip(0..).map(|(texels, k)| -> Task<'_> {
            Box::new(move || {
                for (texels, r) in texels.chunks_mut(row).zip(k * rows..) {
                    let of = r * samples..(r + 1) * samples;
                    let place = first_row + u32::try_from(r).unwrap_or_default();
                    let white = self.white.get(of.clone());
                    self.resolve_row(place, self.color.get(of).unwrap_or_default(), white, texels);
                }
            })
        });
        by_threads(work.collect(), MOST.get());
    }

    fn resolve_row(&self, place: u32, color: &[u32], white: Option<&[u32]>, texels: &mut [[u8; 4]]) {
        let (width, side) = (texels.len(), self.side as usize);
        let mut pixels = vec![0_u32; width];
        match white {
            Some(white) => straight::resolve([color, white], &mut pixels, side),
            None => {
                let (from, to) = ((Rgba8888, color), (Rgba8888, pixels.as_mut_slice()));
                resolve(from, to, width, 0, side, Average::Light);
            }
        }
        let place = place.cast_signed();
        for ((texel, pixel), column) in texels.iter_mut().zip(&pixels).zip(0..) {
            let color = pixel.to_ne_bytes();
            let [r, g, b, _] = stored(&self.options.policies, [column, place], color).color;
            *texel = [r, g, b, if white.is_some() { color[3] } else { 255 }];
        }
    }
}

/// The most threads that resolve samples.
const MOST: NonZero<usize> = NonZero::new(16).unwrap();

#[cfg(test)]
mod tests;
