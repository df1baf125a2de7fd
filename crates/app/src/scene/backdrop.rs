//! The background of a picture, pixel by pixel.

use image::imageops::{self, FilterType};
use image::{ImageBuffer, Rgba};

use crate::error::Error;
use crate::load::image_file;
use crate::memory;
use crate::options::values::Color;
use crate::options::{Background, RenderOptions};
use crate::output::stage::{Stage, during};
use alberti::raster::color::{BlueNoise, Pattern as _};

/// All that is behind the model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Backdrop {
    /// One colour, sRGB.
    Color([u8; 3]),
    /// Nothing: pixels have an alpha.
    Transparent,
    /// From the top to the bottom, in even steps of sRGB, dithered by blue noise: it shows no bands.
    Gradient([[u8; 3]; 2]),
    /// An image as large as the picture: its pixels, row by row, all opaque.
    Image(Vec<[u8; 4]>),
}

impl Backdrop {
    /// That of an option, else the options' colour.
    ///
    /// # Errors
    /// The image cannot be used.
    pub(crate) fn new(wish: Option<&Background>, options: &RenderOptions) -> Result<Self, Error> {
        Ok(match wish {
            Some(Background::Transparent) => Self::Transparent,
            Some(Background::Gradient(ends)) => Self::Gradient(ends.map(Color::bytes)),
            Some(Background::Image(path)) => {
                let mut image =
                    during(Stage::Maps, |_| image_file::load_given(path, image_file::MAX_TEXELS))?;
                image.texels.iter_mut().for_each(|texel| *texel = over(*texel, options.background));
                // A middle step has as many columns as the image, and as many rows as the picture, of four floats.
                let [width, height] = [options.width, options.height].map(u64::from);
                let bytes = height * (16 * u64::from(image.width) + 8 * width);
                memory::need(bytes, "a background").map_err(|error| error.place("--size"))?;
                Self::Image(covering(image, options.width, options.height))
            }
            _ => Self::Color(options.background),
        })
    }

    /// The words of a row of pixels, of a picture of so many rows.
    pub(crate) fn row(&self, y: u32, height: u32, pixels: &mut [u32]) {
        let word = |[r, g, b]: [u8; 3]| u32::from_ne_bytes([r, g, b, 255]);
        match self {
            Self::Color(color) => pixels.fill(word(*color)),
            Self::Transparent => pixels.fill(0),
            Self::Gradient([top, bottom]) => {
                // The height of the pixel's middle, in halves of a row.
                let (whole, down) = (2 * u64::from(height.max(1)), 2 * u64::from(y) + 1);
                for (pixel, x) in pixels.iter_mut().zip(0..) {
                    let threshold = u64::from(BlueNoise.threshold([x, y.cast_signed()]));
                    let [r, g, b] = [0, 1, 2].map(|channel| {
                        let sum =
                            u64::from(top[channel]) * (whole - down) + u64::from(bottom[channel]) * down;
                        u8::try_from((sum * 255 + threshold * whole) / (whole * 255)).unwrap_or(u8::MAX)
                    });
                    *pixel = word([r, g, b]);
                }
            }
            Self::Image(texels) => {
                let row = texels.chunks(pixels.len().max(1)).nth(y as usize).unwrap_or_default();
                for (pixel, [r, g, b, _]) in pixels.iter_mut().zip(row) {
                    *pixel = word([*r, *g, *b]);
                }
            }
        }
    }
}

/// A texel before a colour, both sRGB: mixed as browsers do, in sRGB.
fn over([r, g, b, alpha]: [u8; 4], behind: [u8; 3]) -> [u8; 4] {
    let mixed = |front: u8, back: u8| {
        let sum = u32::from(front) * u32::from(alpha) + u32::from(back) * u32::from(255 - alpha);
        u8::try_from((sum + 127) / 255).unwrap_or(u8::MAX)
    };
    [mixed(r, behind[0]), mixed(g, behind[1]), mixed(b, behind[2]), 255]
}

/// The middle of an image, as much as has the picture's shape, as large as the picture.
fn covering(image: crate::scene::Image, width: u32, height: u32) -> Vec<[u8; 4]> {
    let (from, to) = ([image.width, image.height].map(u64::from), [width, height].map(u64::from));
    // The longest part of one side, and all of the other.
    let part = |k: usize| {
        let side = (from[1 - k] * to[k]).div_ceil(to[1 - k].max(1)).clamp(1, from[k]);
        u32::try_from(side).unwrap_or(u32::MAX)
    };
    let [columns, rows] = [part(0), part(1)];
    let (left, top) = ((image.width - columns) / 2, (image.height - rows) / 2);
    let Some(whole) =
        ImageBuffer::<Rgba<u8>, _>::from_raw(image.width, image.height, image.texels.into_flattened())
    else {
        return Vec::new();
    };
    let part = imageops::crop_imm(&whole, left, top, columns, rows);
    imageops::resize(&*part, width, height, FilterType::Triangle).pixels().map(|pixel| pixel.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Image;

    #[test]
    fn gradients_are_even_and_dithered() {
        let gradient = Backdrop::Gradient([[0, 100, 255], [10, 100, 0]]);
        let (width, height) = (512, 64);
        for y in 0..height {
            let mut row = vec![0; width];
            gradient.row(y, height, &mut row);
            let down = (f64::from(y) + 0.5) / f64::from(height);
            for (channel, [top, bottom]) in
                [[0.0, 10.0], [100.0, 100.0], [255.0, 0.0]].into_iter().enumerate()
            {
                let right = top + (bottom - top) * down;
                let bytes = || row.iter().map(|pixel| f64::from(pixel.to_ne_bytes()[channel]));
                assert!(bytes().all(|byte| (byte - right).abs() < 1.0), "{y}");
                let mean = bytes().sum::<f64>() / 512.0;
                assert!((mean - right).abs() < 0.25, "{y} {mean} {right}");
            }
        }
    }

    #[test]
    fn images_are_opaque() {
        for alpha in 0..=255_u8 {
            for (front, back) in [(0, 255), (255, 0), (10, 200), (77, 77), (255, 255)] {
                let [red, green, _, opaque] = over([front, back, 0, alpha], [back, front, 0]);
                let right = |front: u8, back: u8| {
                    let share = f64::from(alpha) / 255.0;
                    f64::from(front) * share + f64::from(back) * (1.0 - share)
                };
                assert!((f64::from(red) - right(front, back)).abs() <= 0.5);
                assert!((f64::from(green) - right(back, front)).abs() <= 0.5);
                assert_eq!(opaque, 255);
            }
        }
    }

    #[test]
    fn images_cover_the_picture() {
        // Four columns, of which the middle two have the shape of the picture.
        let texels = [1, 2, 3, 4, 1, 2, 3, 4].map(|byte| [byte; 4]).to_vec();
        let found = covering(Image { width: 4, height: 2, texels: texels.clone() }, 2, 2);
        assert_eq!(found, [2, 3, 2, 3].map(|byte| [byte; 4]));
        assert_eq!(covering(Image { width: 4, height: 2, texels }, 8, 1).len(), 8);
    }
}
