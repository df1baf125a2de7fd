//! The difference between two pictures, in numbers and as a map.
//!
//! | measure | unit | meaning |
//! |---|---|---|
//! | [`Measures::largest`] | steps of a byte (lsb) | the worst pixel |
//! | [`Measures::most`] | steps of a byte (lsb) | the worst pixel but for one in a thousand |
//! | [`Measures::outliers`] | pixels | how many are off by more than [`OUTLIER`] |
//! | [`Measures::mse`], [`Measures::psnr`] | squared steps, dB | the energy of all differences |
//! | [`Measures::flip`] | 0 to 1 | what somebody sees who flips between the two |
//!
//! The first three compare four channels, red, green, blue and alpha, as stored. Energy and FLIP compare the three
//! colours, as stored too: nothing is composited, since the pictures of this project are opaque.

mod flip;
pub mod heat;
mod max_error;
mod percentile;

pub use max_error::MaxError;
pub use percentile::percentile;

use crate::error::Error;
use crate::scene::Image;

/// The difference beyond which a pixel is an outlier, in steps of a byte.
pub const OUTLIER: u8 = 8;

/// The share of pixels that [`Measures::most`] speaks of, in thousandths.
pub const MOST: u32 = 999;

/// The measures between two pictures. None depends on which of the two comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// The pictures' width and height.
    pub size: [u32; 2],
    /// The largest difference of a channel, in steps of a byte.
    pub largest: u8,
    /// The first pixel with that difference, row by row from the top: column and row. Equal pictures have none.
    pub largest_at: Option<[u32; 2]>,
    /// The 99.9 % [`percentile`] of the pixels' differences, each of which is the largest of its channels.
    pub most: u8,
    /// The number of pixels that are off by more than [`OUTLIER`].
    pub outliers: usize,
    /// The mean squared difference of red, green and blue, in squared steps of a byte.
    pub mse: f64,
    /// The mean of LDR-FLIP over the pixels, 0 to 1, at 67 pixels per degree.
    pub flip: f64,
}

impl Measures {
    /// The peak signal-to-noise ratio in dB, 10 log10(255² / MSE); infinite for equal colours.
    #[must_use]
    pub fn psnr(&self) -> f64 {
        10.0 * (255.0 * 255.0 / self.mse).log10()
    }

    /// The number of pixels.
    #[must_use]
    pub fn pixels(&self) -> u64 {
        let [width, height] = self.size;
        u64::from(width) * u64::from(height)
    }
}

/// Two pictures' differences, pixel by pixel from the top, and what sums them up.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The sum of it.
    pub measures: Measures,
    /// The largest difference of each pixel's channels, in steps of a byte.
    pub steps: Vec<u8>,
    /// The FLIP of each pixel, 0 to 1.
    pub flip: Vec<f32>,
}

impl Comparison {
    /// The measures of two pictures, and their maps. The FLIP of large pictures is divided among threads, without a
    /// trace in its numbers.
    ///
    /// # Errors
    /// The sizes differ, a picture has no pixels or not as many as its size says, or memory is short.
    pub fn new(first: &Image, second: &Image) -> Result<Self, Error> {
        let steps = steps(first, second)?;
        let pairs = || first.texels.iter().zip(&second.texels);
        let largest = steps.iter().copied().max().unwrap_or_default();
        let place = steps.iter().position(|&step| step == largest && step > 0);
        let squares: u64 = pairs().map(|(a, b)| squared(a, b)).sum();
        let flip = flip::map(first, second)?;
        let measures = Measures {
            size: [first.width, first.height],
            largest,
            largest_at: place.and_then(|index| pixel(index, first.width)),
            most: percentile(&steps, MOST).unwrap_or_default(),
            outliers: steps.iter().filter(|&&step| step > OUTLIER).count(),
            mse: real(squares) / (3.0 * count(steps.len())),
            flip: flip.iter().copied().map(f64::from).sum::<f64>() / count(flip.len()),
        };
        Ok(Self { measures, steps, flip })
    }

    /// A picture of the FLIP of each pixel in false colours, [`heat::color`], from black for equal to nearly white. The
    /// colours follow the square root, so that what is hardly visible in the pictures is visible here.
    #[must_use]
    pub fn heat(&self) -> Image {
        let [width, height] = self.measures.size;
        let texels = self.flip.iter().map(|error| heat::color(error.sqrt())).collect();
        Image { width, height, texels }
    }
}

/// The largest difference of each pixel's channels alone, in steps of a byte.
///
/// # Errors
/// Those of [`Comparison::new`], but for memory.
pub fn steps(first: &Image, second: &Image) -> Result<Vec<u8>, Error> {
    check(first, second)?;
    Ok(first.texels.iter().zip(&second.texels).map(|(a, b)| difference(a, b)).collect())
}

fn check(first: &Image, second: &Image) -> Result<(), Error> {
    let size = |picture: &Image| format!("{}x{}", picture.width, picture.height);
    if (first.width, first.height) != (second.width, second.height) {
        let found = format!("pictures of {} and {} pixels", size(first), size(second));
        return Err(Error::new(found, "two of the same size"));
    }
    let pixels = u64::from(first.width) * u64::from(first.height);
    let whole = |picture: &Image| usize::try_from(pixels).is_ok_and(|pixels| pixels == picture.texels.len());
    if pixels == 0 || !whole(first) || !whole(second) {
        let (first, second) = (first.texels.len(), second.texels.len());
        let found = format!("pictures with {first} and {second} pixels");
        return Err(Error::new(found, format!("{pixels} in each, and at least one")));
    }
    Ok(())
}

fn difference(a: &[u8; 4], b: &[u8; 4]) -> u8 {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or_default()
}

fn squared([ar, ag, ab, _]: &[u8; 4], [br, bg, bb, _]: &[u8; 4]) -> u64 {
    [ar.abs_diff(*br), ag.abs_diff(*bg), ab.abs_diff(*bb)].map(|step| u64::from(step).pow(2)).iter().sum()
}

fn pixel(index: usize, width: u32) -> Option<[u32; 2]> {
    let index = u64::try_from(index).ok()?;
    let [x, y] = [index % u64::from(width), index / u64::from(width)];
    Some([u32::try_from(x).ok()?, u32::try_from(y).ok()?])
}

#[expect(clippy::cast_precision_loss, reason = "below 2^53 for all pictures that memory holds")]
fn real(sum: u64) -> f64 {
    sum as f64
}

#[expect(clippy::cast_precision_loss, reason = "as above")]
fn count(pixels: usize) -> f64 {
    pixels as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32) -> Image {
        Image { width, height, texels: vec![[100, 150, 200, 255]; (width * height) as usize] }
    }

    fn measures(first: &Image, second: &Image) -> Measures {
        let measures = Comparison::new(first, second).unwrap().measures;
        assert_eq!(Comparison::new(second, first).unwrap().measures, measures);
        measures
    }

    #[test]
    fn equal_pictures_differ_by_nothing() {
        let comparison = Comparison::new(&picture(5, 3), &picture(5, 3)).unwrap();
        let expected = Measures {
            size: [5, 3],
            largest: 0,
            largest_at: None,
            most: 0,
            outliers: 0,
            mse: 0.0,
            flip: 0.0,
        };
        assert_eq!(comparison.measures, expected);
        assert_eq!(comparison.measures.psnr(), f64::INFINITY);
        assert_eq!((comparison.steps, comparison.flip), (vec![0; 15], vec![0.0; 15]));
    }

    #[test]
    fn steps_are_counted_by_pixel_and_energy_by_channel() {
        let mut changed = picture(50, 40);
        changed.texels[0] = [100, 150, 208, 255];
        changed.texels[50] = [109, 142, 200, 255];
        changed.texels[1999] = [60, 190, 160, 255];
        let measures = measures(&picture(50, 40), &changed);
        assert_eq!((measures.largest, measures.largest_at), (40, Some([49, 39])));
        // Of 2000 pixels, 0.1 % are two: the third worst is that of which all others are within.
        assert_eq!((measures.most, measures.outliers), (8, 2));
        assert_eq!(measures.pixels(), 2000);
        // 8², 9² + 8², 3·40² over 6000 channels.
        assert_eq!(measures.mse, f64::from(64 + 81 + 64 + 3 * 1600) / 6000.0);
    }

    #[test]
    fn decibels_have_their_zero_at_black_and_white() {
        let filled = |value| Image { width: 2, height: 1, texels: vec![[value, value, value, 255]; 2] };
        assert_eq!(measures(&filled(0), &filled(255)).psnr(), 0.0);
        // 20 log10(255/51) = 20 log10(5).
        let psnr = measures(&filled(0), &filled(51)).psnr();
        assert!((psnr - 13.979_400_086_720_376).abs() < 1e-12, "{psnr}");
    }

    #[test]
    fn alpha_is_a_channel_of_steps_alone() {
        let mut changed = picture(4, 4);
        changed.texels[6][3] = 100;
        let measures = measures(&picture(4, 4), &changed);
        assert_eq!((measures.largest, measures.largest_at, measures.outliers), (155, Some([2, 1]), 1));
        assert_eq!((measures.mse, measures.flip), (0.0, 0.0));
    }

    #[test]
    fn pictures_that_do_not_match_are_refused() {
        let message = |a: &Image, b: &Image| Comparison::new(a, b).unwrap_err().to_string();
        let found = message(&picture(4, 3), &picture(3, 4));
        assert_eq!(found, "found pictures of 4x3 and 3x4 pixels, expected two of the same size");
        assert!(message(&picture(0, 3), &picture(0, 3)).contains("with 0 and 0 pixels"));
        let mut short = picture(2, 2);
        short.texels.pop();
        assert!(message(&picture(2, 2), &short).contains("with 4 and 3 pixels, expected 4 in each"));
    }

    #[test]
    fn heat_is_black_where_nothing_differs() {
        let mut changed = picture(64, 48);
        changed.texels[0] = [255, 255, 255, 255];
        let heat = Comparison::new(&picture(64, 48), &changed).unwrap().heat();
        assert_eq!((heat.width, heat.height), (64, 48));
        assert_eq!(heat.texels[64 * 48 - 1], [0, 0, 0, 255]);
        let light = |texel: [u8; 4]| texel.map(u32::from)[..3].iter().sum::<u32>();
        assert!(light(heat.texels[0]) > 300, "{:?}", heat.texels[0]);
        assert!(light(heat.texels[0]) > light(heat.texels[5]));
    }
}
