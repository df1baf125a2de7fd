//! The 256 colours of a film, and the nearest of them.

use alberti::raster::color::Pattern as _;

use crate::error::Error;
use crate::options::Dither;
use crate::scene::Image;

/// The most frames whose colours are counted, evenly spread.
const COUNTED: usize = 64;

/// Bits of a channel by which the nearest colour is looked up.
const BITS: u32 = 6;

/// Distances at which a second colour is looked for.
const REACHES: [i32; 4] = [6, 12, 24, 48];

/// One palette for all frames, so that still places stay still.
pub(super) struct Palette {
    colors: Vec<[u8; 3]>,
    /// The index of what is seen through.
    pub(super) clear: Option<u8>,
    /// The nearest colour of each cell of the cube, by red, green and blue.
    nearest: Vec<u8>,
}

impl Palette {
    /// The palette of these frames, of which one colour is clear if `alpha` counts.
    ///
    /// # Errors
    /// Colours cannot be counted.
    pub(super) fn new(frames: &[Image], alpha: bool) -> Result<Self, Error> {
        let refused = |error: &dyn std::fmt::Debug| {
            Error::new(format!("a film without a palette ({error:?})"), "colours that can be counted")
        };
        let mut histogram = quantizr::Histogram::new();
        let count = frames.len().min(COUNTED);
        for frame in (0..count).filter_map(|k| frames.get(k * frames.len() / count)) {
            // As few colours as the cube has cells.
            let cells: Vec<u8> = frame
                .texels
                .iter()
                .flat_map(|&[r, g, b, _]| [coarse(r), coarse(g), coarse(b), 255])
                .collect();
            let picture = quantizr::Image::new(&cells, frame.width as usize, frame.height as usize);
            histogram.add_image(&picture.map_err(|error| refused(&error))?);
        }
        let mut options = quantizr::Options::default();
        options.set_max_colors(if alpha { 255 } else { 256 }).map_err(|error| refused(&error))?;
        let found = quantizr::QuantizeResult::quantize_histogram(&histogram, &options);
        let found = found.get_palette();
        let colors = found.entries.iter().take(found.count as usize).map(|color| [color.r, color.g, color.b]);
        let colors: Vec<[u8; 3]> = colors.collect();
        let nearest = (0..1_u32 << (3 * BITS)).map(|cell| nearest(&colors, middle(cell))).collect();
        let clear = alpha.then(|| u8::try_from(colors.len()).unwrap_or(u8::MAX));
        Ok(Self { colors, clear, nearest })
    }

    /// Red, green and blue of all colours, one after the other.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.colors.concat();
        bytes.extend(self.clear.map(|_| [0; 3]).into_iter().flatten());
        bytes
    }

    /// The indices of a frame, dithered by blue noise that stays in its place.
    pub(super) fn indices(&self, frame: &Image) -> Vec<u8> {
        let mut indices = Vec::with_capacity(frame.texels.len());
        for (texels, row) in frame.texels.chunks(frame.width.max(1) as usize).zip(0..) {
            indices.extend(texels.iter().zip(0..).map(|(&[r, g, b, a], column)| {
                let threshold = Dither::BlueNoise.threshold([column, row]);
                match self.clear {
                    // Of pixels that are half clear each second one.
                    Some(clear) if u32::from(a) <= threshold => clear,
                    _ => self.index([r, g, b].map(i32::from), threshold),
                }
            }));
        }
        indices
    }

    /// The index of the nearest colour, or of one behind the colour that is sought, as seen from there: the second as
    /// often as makes the mean right. A threshold is one of 255.
    fn index(&self, sought: [i32; 3], threshold: u32) -> u8 {
        let first = self.nearest[cell(sought)];
        let color = |index: u8| self.colors[usize::from(index)].map(i32::from);
        let from = color(first);
        let off = [0, 1, 2].map(|k| sought[k] - from[k]);
        let most = off.iter().fold(0, |most, c| c.abs().max(most));
        if most == 0 {
            return first;
        }
        for reach in REACHES {
            let second = self.nearest[cell([0, 1, 2].map(|k| from[k] + off[k] * reach / most))];
            let to = color(second);
            let way = [0, 1, 2].map(|k| to[k] - from[k]);
            let dot = |a: [i32; 3], b: [i32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let (along, all) = (dot(off, way), dot(way, way));
            if along > 0 {
                return if 255 * along > all * threshold.cast_signed() + all / 2 { second } else { first };
            }
        }
        first
    }
}

/// A channel without its lowest bits, in all of its range.
fn coarse(channel: u8) -> u8 {
    let high = channel >> (8 - BITS);
    high << (8 - BITS) | high >> (2 * BITS - 8)
}

/// The cell of a colour, or of the next one within the cube.
fn cell(color: [i32; 3]) -> usize {
    let [r, g, b] = color.map(|c| c.clamp(0, 255).cast_unsigned() >> (8 - BITS));
    (r << (2 * BITS) | g << BITS | b) as usize
}

/// The colour that stands for a cell.
fn middle(cell: u32) -> [u8; 3] {
    [2 * BITS, BITS, 0].map(|shift| {
        let [high, ..] = (cell >> shift & ((1 << BITS) - 1)).to_le_bytes();
        coarse(high << (8 - BITS))
    })
}

/// The index of the nearest colour, by the sum of the channels' squared differences.
fn nearest(colors: &[[u8; 3]], to: [u8; 3]) -> u8 {
    let square = |color: &[u8; 3]| -> i32 {
        color.iter().zip(to).map(|(&a, b)| (i32::from(a) - i32::from(b)).pow(2)).sum()
    };
    (0..=255).zip(colors.iter().map(square)).min_by_key(|&(_, square)| square).unwrap_or_default().0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept() {
        let few = [[255, 0, 0, 255], [0, 255, 0, 255], [8, 8, 203, 255], [0, 0, 0, 0]];
        let texels: Vec<_> = (0..64).map(|k| few[(k * 7 + k / 8) % 4]).collect();
        let frame = Image { width: 8, height: 8, texels: texels.clone() };
        let palette = Palette::new(std::slice::from_ref(&frame), true).expect("a palette");
        let clear = palette.clear.expect("a clear colour");
        for (texel, index) in texels.into_iter().zip(palette.indices(&frame)) {
            let at = 3 * usize::from(index);
            let color = &palette.bytes()[at..at + 3];
            if texel[3] == 0 {
                assert_eq!(index, clear);
            } else {
                assert!(
                    index != clear && color.iter().zip(texel).all(|(a, b)| a.abs_diff(b) <= 2),
                    "{color:?}"
                );
            }
        }
    }

    /// The mean of a field of any grey is that grey, though few greys are in the palette.
    #[test]
    fn dithering_keeps_the_mean() {
        let greys = [0_u8, 40, 90, 150, 200, 255];
        let nearest = (0..1 << (3 * BITS)).map(|cell| super::nearest(&greys.map(|c| [c; 3]), middle(cell)));
        let palette =
            Palette { colors: greys.map(|c| [c; 3]).to_vec(), clear: None, nearest: nearest.collect() };
        for c in [0, 3, 39, 41, 60, 64, 66, 100, 149, 152, 220, 254] {
            let field = Image { width: 128, height: 128, texels: vec![[c, c, c, 255]; 1 << 14] };
            let sum: u32 =
                palette.indices(&field).iter().map(|&index| u32::from(greys[usize::from(index)])).sum();
            let mean = f64::from(sum) / f64::from(1 << 14);
            assert!((mean - f64::from(c)).abs() < 0.7, "{c} {mean}");
        }
    }
}
