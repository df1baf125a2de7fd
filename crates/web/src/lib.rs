#![cfg_attr(target_arch = "wasm32", no_std)]
#![doc = include_str!("../README.md")]

extern crate alloc;

mod affine;
mod canvas;
mod depth;
pub mod exports;
mod frames;
mod mipmaps;
pub mod model;
mod numbers;
mod pipeline;
mod projector;
mod relief;
mod shading;
mod textures;

pub use canvas::{Canvas, MAX_PIXELS, SizeError, hash};

use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

/// The most parameters of a station.
pub const PARAMETERS: usize = 16;

/// The positions of a station's controls, as the page has them.
pub type Parameters = [f32; PARAMETERS];

/// The reason that there is no picture, in words: an error of the library's, or of this crate's.
///
/// A boxed error would bring the formatting of every number into the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault(pub String);

impl<E: core::error::Error> From<E> for Fault {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Nothing, or the reason that there is no picture.
pub type Drawn = Result<(), Fault>;

/// A station of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Station {
    /// Affine against hyperbolic interpolation.
    Affine,
    /// The depth map.
    Depth,
    /// The view pipeline, step by step.
    Pipeline,
    /// Mip maps and anisotropy.
    Mipmaps,
    /// Bump, normal, parallax and displacement maps.
    Relief,
    /// The projector.
    Projector,
    /// Tangent frames.
    Frames,
    /// A model of the visitor's.
    Model,
}

impl Station {
    /// All of them, in the page's order.
    pub const ALL: [Self; 8] = [
        Self::Affine,
        Self::Depth,
        Self::Pipeline,
        Self::Mipmaps,
        Self::Relief,
        Self::Projector,
        Self::Frames,
        Self::Model,
    ];

    /// Whether rows can be drawn on their own: the others compare pictures with each other.
    #[must_use]
    pub const fn has_bands(self) -> bool {
        !matches!(self, Self::Affine | Self::Depth)
    }

    /// The name, by which the page links to it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Affine => "affine",
            Self::Depth => "depth",
            Self::Pipeline => "pipeline",
            Self::Mipmaps => "mipmaps",
            Self::Relief => "relief",
            Self::Projector => "projector",
            Self::Frames => "frames",
            Self::Model => "model",
        }
    }
}

/// All that the page keeps in memory between two pictures.
#[derive(Debug)]
pub struct Page {
    /// The picture that was drawn last.
    pub canvas: Canvas,
    /// The numbers that belong to it, in the order that its station documents.
    pub results: Vec<f32>,
    /// The reason that there is no picture, or none.
    pub message: String,
    textures: textures::Textures,
    model: model::Model,
}

impl Page {
    /// A page before its first picture.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            canvas: Canvas::new(),
            results: Vec::new(),
            message: String::new(),
            textures: textures::Textures::new(),
            model: model::Model::new(),
        }
    }

    /// Draws a station's picture of this size.
    ///
    /// # Errors
    /// When the size is out of range, or when the parameters leave no view.
    pub fn draw(&mut self, station: Station, size: [u32; 2], parameters: &Parameters) -> Drawn {
        self.draw_rows(station, (size, 0..size[1]), parameters)
    }

    /// Draws some rows of it. Together they are the picture, of a station [in bands](Station::has_bands).
    ///
    /// # Errors
    /// As [`draw`](Self::draw), and when there are no such rows.
    pub fn draw_rows(
        &mut self,
        station: Station,
        (size, rows): ([u32; 2], Range<u32>),
        parameters: &Parameters,
    ) -> Drawn {
        let Self { canvas, results, textures, model, .. } = self;
        canvas.resize(size, rows)?;
        results.clear();
        match station {
            Station::Affine => affine::draw(canvas, results, textures, parameters),
            Station::Depth => depth::draw(canvas, results, parameters),
            Station::Pipeline => pipeline::draw(canvas, results, parameters),
            Station::Mipmaps => mipmaps::draw(canvas, results, textures, parameters),
            Station::Relief => relief::draw(canvas, results, textures, parameters),
            Station::Projector => projector::draw(canvas, results, textures, parameters),
            Station::Frames => frames::draw(canvas, results, textures, parameters),
            Station::Model => model.draw(canvas, results, parameters),
        }
    }

    /// The model of the last station.
    pub const fn model(&mut self) -> &mut model::Model {
        &mut self.model
    }
}

impl Default for Page {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_rows_of_the_picture() {
        let size = [160, 120];
        let mut parameters = [0.4; PARAMETERS];
        parameters[..7].copy_from_slice(&[6.0, 0.9, 0.2, 2.0, 40.0, 1.0, 9.0]);
        for station in Station::ALL.into_iter().filter(|station| station.has_bands()) {
            let (mut whole, mut part) = (Page::new(), Page::new());
            whole.draw(station, size, &parameters).unwrap();
            let (mut pixels, mut sums, mut bands) = (Vec::new(), whole.results.clone(), 0.0);
            sums.fill(0.0);
            for rows in [0..7, 7..60, 60..119, 119..200] {
                part.draw_rows(station, (size, rows), &parameters).unwrap();
                pixels.extend_from_slice(part.canvas.drawn());
                for (sum, number) in sums.iter_mut().zip(&part.results) {
                    *sum += number;
                }
                bands += 1.0;
            }
            assert!(pixels == whole.canvas.pixels(), "{}", station.name());
            // Numbers are those of the picture, but for pixels, of which each band has its own.
            for (sum, number) in sums.iter().zip(&whole.results) {
                let same = (sum / bands - number).abs() <= 1e-6 * number.abs();
                assert!(same || sum == number || number.is_nan(), "{}: {sum} {number}", station.name());
            }
            assert!(whole.canvas.pixels().iter().any(|pixel| *pixel != pixels[0]), "{}", station.name());
        }
        assert!(Page::new().draw_rows(Station::Model, (size, 120..121), &parameters).is_err());
    }
}
