//! The right picture of a scene, by rays in f64, and how far a renderer's picture is from it.

use crate::Size;
use crate::scene_data::Scene;
use alberti_oracle::ideal::render_ideal;
use alberti_oracle::image::{Image as Picture, compare};
use alberti_oracle::scene as oracle;
use alberti_tests::reference::{options, with_scene};

/// A pixel is off when a channel differs by more than this.
pub const TOLERANCE: u8 = 8;

/// The picture that the scene's definition asks for.
#[must_use]
pub fn ideal(scene: &Scene, size: Size) -> Vec<[u8; 4]> {
    drawn(scene, size, render_ideal)
}

fn drawn(scene: &Scene, size: Size, render: impl Fn(&oracle::Scene<'_>) -> Picture) -> Vec<[u8; 4]> {
    let built_in = &scene.built_in;
    let options = options(built_in, size.width, size.height);
    with_scene(&built_in.model, &built_in.camera, &options, |drawn| render(drawn).pixels)
}

/// How many pixels are off by more than [`TOLERANCE`].
#[must_use]
pub fn pixels_off(pixels: &[[u8; 4]], reference: &[[u8; 4]]) -> usize {
    compare(pixels, reference, TOLERANCE).differing
}

/// [`pixels_off`] as a part of all pixels.
#[must_use]
pub fn part_off(pixels: &[[u8; 4]], reference: &[[u8; 4]]) -> f64 {
    pixels_off(pixels, reference) as f64 / reference.len() as f64
}

/// The picture that the scene's definition asks for at some of its pixels, for sizes at which all would take long.
#[derive(Clone, Debug)]
pub struct Sparse {
    size: Size,
    /// The first pixel's column and row, and from a pixel to the next.
    first: [u32; 2],
    step: u32,
    /// How many there are a row.
    width: u32,
    pixels: Vec<[u8; 4]>,
}

impl Sparse {
    /// Every n-th pixel of every n-th row, at most this many.
    ///
    /// ```text
    ///   +---+---+---+---+---+---+      A picture of fewer pixels, each n times as wide, whose middle is that of the
    ///   |   .   x   .   .   x   |      whole one. Where n is odd its pixels' centres are those of pixels.
    ///   +---+---+---+---+---+---+
    /// ```
    #[must_use]
    pub fn new(scene: &Scene, size: Size, most: usize) -> Self {
        let step = (1..).step_by(2).find(|&n| size.pixels() <= most * (n * n) as usize).unwrap_or(1);
        // As many as fit, and as odd or even as the whole.
        let [width, height] = [size.width, size.height].map(|whole| {
            let fit = whole / step;
            fit - (whole - fit) % 2
        });
        let first = [size.width - width * step, size.height - height * step].map(|rest| rest / 2 + step / 2);
        let built_in = &scene.built_in;
        let options = options(built_in, width, height);
        let pixels = with_scene(&built_in.model, &built_in.camera, &options, |drawn| {
            let part = f64::from(height * step) / f64::from(size.height);
            let fov = 2.0 * ((drawn.camera.fov.to_radians() / 2.0).tan() * part).atan();
            let camera = oracle::Camera { fov: fov.to_degrees(), ..drawn.camera };
            render_ideal(&oracle::Scene { camera, ..*drawn }).pixels
        });
        Self { size, first, step, width, pixels }
    }

    /// The part of these pixels that a picture has off.
    #[must_use]
    pub fn part_off(&self, picture: &[[u8; 4]]) -> f64 {
        let found: Vec<_> = (0..self.pixels.len() as u32)
            .map(|i| {
                let place = [i % self.width, i / self.width];
                let [column, row] = [0, 1].map(|axis| self.first[axis] + self.step * place[axis]);
                picture[row as usize * self.size.width as usize + column as usize]
            })
            .collect();
        part_off(&found, &self.pixels)
    }
}
