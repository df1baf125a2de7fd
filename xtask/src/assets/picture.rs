//! Pictures in memory, and as PNG files.

use std::error::Error;

/// What a file holds, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Pixels {
    /// One byte each.
    Grey(Vec<u8>),
    /// Two bytes each, for heights.
    Grey16(Vec<u16>),
    /// Bytes that choose from at most 256 colours.
    Indexed(Vec<[u8; 3]>, Vec<u8>),
    /// Red, green, blue.
    Rgb(Vec<[u8; 3]>),
}

/// A picture of `width` columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) pixels: Pixels,
}

impl Picture {
    /// Of `width * height` pixels, each made from its place: u from 0 at the left to 1 at the right, v from 0 at the
    /// bottom to 1 at the top, at pixels' centres.
    pub(super) fn rgb(width: usize, height: usize, color: impl Fn([f64; 2]) -> [f64; 3]) -> Picture {
        let pixels = places(width, height).map(|uv| color(uv).map(byte)).collect();
        Picture { width, pixels: Pixels::Rgb(pixels) }
    }

    /// The same, each pixel the mean of `side * side` places in it: for what changes within one.
    pub(super) fn averaged(
        width: usize,
        height: usize,
        side: usize,
        color: impl Fn([f64; 2]) -> [f64; 3],
    ) -> Picture {
        Picture::rgb(width, height, |[u, v]| {
            let mut sum = [0.0; 3];
            for [s, t] in places(side, side) {
                let found = color([u + (s - 0.5) / width as f64, v + (t - 0.5) / height as f64]);
                sum = std::array::from_fn(|index| sum[index] + found[index]);
            }
            sum.map(|x| x / (side * side) as f64)
        })
    }

    /// The same with one of the palette's colours for each pixel.
    pub(super) fn indexed(
        width: usize,
        height: usize,
        palette: &Palette,
        index: impl Fn([f64; 2]) -> u8,
    ) -> Picture {
        let indices = places(width, height).map(index).collect();
        Picture { width, pixels: Pixels::Indexed(palette.colors.clone(), indices) }
    }

    /// The file.
    pub(super) fn png(&self) -> Result<Vec<u8>, Box<dyn Error>> {
        let (kind, depth, bytes) = match &self.pixels {
            Pixels::Grey(values) => (png::ColorType::Grayscale, png::BitDepth::Eight, values.clone()),
            Pixels::Grey16(values) => {
                let bytes = values.iter().flat_map(|value| value.to_be_bytes()).collect();
                (png::ColorType::Grayscale, png::BitDepth::Sixteen, bytes)
            }
            Pixels::Indexed(_, indices) => (png::ColorType::Indexed, png::BitDepth::Eight, indices.clone()),
            Pixels::Rgb(colors) => (png::ColorType::Rgb, png::BitDepth::Eight, colors.concat()),
        };
        let bytes_a_pixel = kind.samples() * if depth == png::BitDepth::Sixteen { 2 } else { 1 };
        let height = bytes.len() / bytes_a_pixel / self.width;
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, u32::try_from(self.width)?, u32::try_from(height)?);
        encoder.set_color(kind);
        encoder.set_depth(depth);
        encoder.set_compression(png::Compression::High);
        if let Pixels::Indexed(palette, _) = &self.pixels {
            encoder.set_palette(palette.concat());
            // The neighbours of an index say nothing about it.
            encoder.set_filter(png::Filter::NoFilter);
        }
        encoder.write_header()?.write_image_data(&bytes)?;
        Ok(file)
    }
}

/// The centres of the pixels as (u, v), rows from the top.
pub(super) fn places(width: usize, height: usize) -> impl Iterator<Item = [f64; 2]> {
    let centre = |index: usize, side: usize| (index as f64 + 0.5) / side as f64;
    (0..height)
        .flat_map(move |row| (0..width).map(move |column| [centre(column, width), 1.0 - centre(row, height)]))
}

/// A number from 0 to 1 as a byte, to the nearest.
pub(super) fn byte(x: f64) -> u8 {
    (x * 255.0 + 0.5) as u8
}

/// A colour of HTML, as numbers from 0 to 1.
pub(super) fn html(color: u32) -> [f64; 3] {
    let [_, red, green, blue] = color.to_be_bytes();
    [red, green, blue].map(|byte| f64::from(byte) / 255.0)
}

/// Ramps of equally many colours each, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Palette {
    colors: Vec<[u8; 3]>,
    steps: usize,
}

impl Palette {
    /// Each ramp goes from dark to light through the colours given, spread evenly over `steps`; all together have at
    /// most 256.
    pub(super) fn new(steps: usize, ramps: &[&[u32]]) -> Palette {
        assert!(steps * ramps.len() <= 256 && steps > 1, "{} colours", steps * ramps.len());
        let mut colors = Vec::new();
        for ramp in ramps {
            for step in 0..steps {
                let at = step as f64 * (ramp.len() - 1) as f64 / (steps - 1) as f64;
                let low = (at as usize).min(ramp.len() - 2);
                let color = super::noise::mix(html(ramp[low]), html(ramp[low + 1]), at - low as f64);
                colors.push(color.map(byte));
            }
        }
        Palette { colors, steps }
    }

    /// The index of a ramp's colour, from its darkest at 0 to its lightest at 1.
    pub(super) fn index(&self, ramp: usize, shade: f64) -> u8 {
        let step = shade.clamp(0.0, 1.0) * (self.steps - 1) as f64 + 0.5;
        (ramp * self.steps + step as usize) as u8
    }
}
