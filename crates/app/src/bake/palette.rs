//! Palettes: the few colours that stand for all of an image.

use crate::error::Error;
use crate::scene::Image;
use alberti::Rgba8;
use alberti::raster::ColorFormat as _;
use alberti::raster::color::Grey8;

/// A palette, and the way to its nearest colour.
pub(super) struct Palette {
    pub(super) colors: Vec<[u8; 4]>,
    /// How far a colour may be from it, on average: the reach of dithering.
    spread: i32,
    /// Whether it is a ramp of greys, whose levels are those of luminance.
    is_ramp: bool,
}

impl Palette {
    /// The palette of at most so many colours, up to 256, for an image.
    pub(super) fn new(image: &Image, most: u16) -> Result<Self, Error> {
        let refused = |error: &dyn std::fmt::Debug| {
            Error::new(format!("an image without a palette ({error:?})"), "colours that can be counted")
        };
        let bytes = image.texels.as_flattened();
        let picture = quantizr::Image::new(bytes, image.width as usize, image.height as usize);
        let picture = picture.map_err(|error| refused(&error))?;
        let mut options = quantizr::Options::default();
        options.set_max_colors(most.into()).map_err(|error| refused(&error))?;
        let found = quantizr::QuantizeResult::quantize(&picture, &options);
        let palette = found.get_palette();
        let colors = palette.entries.iter().take(palette.count as usize).map(|c| [c.r, c.g, c.b, c.a]);
        let mut palette = Self { colors: colors.collect(), spread: 0, is_ramp: false };
        let squares: i64 = image.texels.iter().map(|&texel| i64::from(palette.nearest(texel).1)).sum();
        // The deviation of a channel, twice on either side.
        let count = i64::try_from(image.texels.len()).unwrap_or(i64::MAX).max(1);
        palette.spread = i32::try_from((squares / (3 * count)).isqrt()).unwrap_or(255) * 4;
        Ok(palette)
    }

    /// So many greys from black to white, up to 16.
    pub(super) fn ramp(count: u8) -> Self {
        let steps = count - 1;
        let grey = |level: u8| [level * (255 / steps); 3];
        let colors = (0..count).map(|level| {
            let [r, g, b] = grey(level);
            [r, g, b, 255]
        });
        Self { colors: colors.collect(), spread: 0, is_ramp: true }
    }

    /// The number of the colour that is nearest, by the sum of the channels' squares, and that sum.
    fn nearest(&self, texel: [u8; 4]) -> (u8, i32) {
        let distance = |color: &[u8; 4]| -> i32 {
            let squares = color.iter().zip(texel).map(|(&a, b)| (i32::from(a) - i32::from(b)).pow(2));
            squares.sum()
        };
        let all = (0..=255).zip(self.colors.iter().map(distance));
        all.min_by_key(|&(_, distance)| distance).unwrap_or_default()
    }

    /// The number of the colour for a texel with a threshold of so many 255ths; 127 for the nearest.
    pub(super) fn index(&self, texel: [u8; 4], threshold: u32) -> u8 {
        if self.is_ramp {
            let [r, g, b, a] = texel;
            let greatest = u32::try_from(self.colors.len() - 1).unwrap_or(0);
            let level = (u32::from(Grey8.pixel(Rgba8::new(r, g, b, a))) * greatest + threshold) / 255;
            return level.to_le_bytes()[0];
        }
        let shift = self.spread * (threshold.cast_signed() - 127) / 255;
        let [r, g, b, a] = texel;
        let moved = |c: u8| u8::try_from((i32::from(c) + shift).clamp(0, 255)).unwrap_or(c);
        self.nearest([moved(r), moved(g), moved(b), a]).0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_as_they_are() {
        let few = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 0, 0], [9, 9, 200, 128]];
        let texels: Vec<_> = (0..64).map(|k| few[(k * 7 + k / 8) % 4]).collect();
        let image = Image { width: 8, height: 8, texels: texels.clone() };
        let palette = Palette::new(&image, 16).expect("a palette");
        assert!(palette.colors.len() <= 16);
        for texel in texels {
            for threshold in [0, 127, 254] {
                assert_eq!(palette.colors[usize::from(palette.index(texel, threshold))], texel);
            }
        }
    }

    #[test]
    fn a_ramp_has_as_many_colours_as_there_may_be() {
        let texels: Vec<_> = (0..=255).map(|c| [c, c, c, 255]).collect();
        let image = Image { width: 256, height: 1, texels: texels.clone() };
        let palette = Palette::new(&image, 16).expect("a palette");
        assert!((8..=16).contains(&palette.colors.len()), "{}", palette.colors.len());
        // Sixteen steps of 16 are at most 8 off; a quantiser is not that even.
        let off =
            |texel: [u8; 4]| palette.colors[usize::from(palette.index(texel, 127))][0].abs_diff(texel[0]);
        let worst = texels.into_iter().map(off).max();
        assert!(worst <= Some(24), "{worst:?}");
    }
}
