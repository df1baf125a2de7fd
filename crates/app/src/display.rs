//! Pixels as displays store them, in the formats that `--color` names.

use crate::options::{ColorFormat, Dither, Policies};
use alberti::lanes::One;
use alberti::raster::color::{
    Dithered, Grey1, Grey2, Grey4, Grey8, Levels, ReadColor, Rgb332, Rgb444, Rgb666, Rgb888, Xrgb8888,
};
use alberti::raster::{self, ColorFormat as _};
use alberti::texture::TexelFormat as _;
use alberti::{Rgb565Le, Rgba8};
use std::num::Wrapping;

/// A pixel that is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stored {
    /// Its bits, red in the highest.
    pub(crate) word: u32,
    /// The hexadecimal digits of these.
    pub(crate) digits: usize,
    /// The colour that is seen.
    pub(crate) color: [u8; 4],
}

/// The pixel at a place that stores a colour in the policies' format.
///
/// Surfaces that are mixed with others are mixed in 8 bits a channel. Nothing else that is drawn reads a colour back,
/// and the last one to be stored is all that counts. To round it afterwards gives the pixels that a buffer of that
/// format would hold.
pub(crate) fn stored(policies: &Policies, place: [i32; 2], color: [u8; 4]) -> Stored {
    let of = (policies.dither, place, color);
    let bytes = |[r, g, b]: [u8; 3]| u32::from_be_bytes([0, r, g, b]);
    match policies.color {
        ColorFormat::Rgba8 => Stored { word: u32::from_be_bytes(color), digits: 8, color },
        ColorFormat::Rgb565 => {
            let pixel = pixel(Rgb565Le, of);
            let color = Rgb565Le.decode(pixel).to_bytes();
            Stored { word: u16::from_le(pixel).into(), digits: 4, color }
        }
        ColorFormat::Rgb444 => seen(Rgb444, of, 3, |pixel| u16::from_be_bytes(pixel).into()),
        ColorFormat::Rgb666 => seen(Rgb666, of, 6, bytes),
        ColorFormat::Rgb888 => seen(Rgb888, of, 6, bytes),
        ColorFormat::Xrgb8888 => seen(Xrgb8888, of, 8, u32::from_le),
        ColorFormat::Rgb332 => seen(Rgb332, of, 2, u32::from),
        ColorFormat::Indexed8 => seen(Cube, of, 2, u32::from),
        ColorFormat::Grey8 => seen(Grey8, of, 2, u32::from),
        ColorFormat::Grey4 => seen(Grey4, of, 1, u32::from),
        ColorFormat::Grey2 => seen(Grey2, of, 1, u32::from),
        ColorFormat::Grey1 => seen(Grey1, of, 1, u32::from),
    }
}

/// A pattern, the place in it, and a colour.
type Placed = (Dither, [i32; 2], [u8; 4]);

/// A pixel of a format, with the word that is made of it.
fn seen<F: Levels>(format: F, of: Placed, digits: usize, word: impl Fn(F::Pixel) -> u32) -> Stored {
    let pixel = pixel(format, of);
    Stored { word: word(pixel), digits, color: format.color(pixel).to_bytes() }
}

/// A pixel, as a target of the library stores it.
fn pixel<F: Levels>(format: F, (by, place, [r, g, b, a]): Placed) -> F::Pixel {
    let color = Rgba8::new(r, g, b, a);
    let mut pixel = [format.pixel(color)];
    Dithered { format, by }.store::<One, Rgba8>(One, Wrapping(color.to_bits()), true, place, &mut pixel);
    let [pixel] = pixel;
    pixel
}

/// Indices into a palette that is not made for a scene: 6 levels of red, of green and of blue, red the slowest.
#[derive(Clone, Copy, Debug)]
struct Cube;

impl raster::ColorFormat for Cube {
    type Pixel = u8;

    fn pixel(self, color: Rgba8) -> u8 {
        let [r, g, b, _] = color.to_bytes().map(|byte| (u32::from(byte) * 5 + 127) / 255);
        self.native(36 * r + 6 * g + b)
    }

    fn native(self, word: u32) -> u8 {
        word.to_le_bytes()[0]
    }
}

impl ReadColor for Cube {
    fn color(self, index: u8) -> Rgba8 {
        let [r, g, b] = [index / 36, index / 6 % 6, index % 6].map(|level| level.min(5) * 51);
        Rgba8::new(r, g, b, 255)
    }
}

impl Levels for Cube {
    const GREATEST: [u32; 3] = [5; 3];
    const PLACES: [u32; 3] = [36, 6, 1];
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti::raster::color::Indexed;

    fn of(color: ColorFormat, dither: Dither, place: [i32; 2], rgb: [u8; 3]) -> Stored {
        let [r, g, b] = rgb;
        stored(&Policies { color, dither, ..Policies::default() }, place, [r, g, b, 255])
    }

    /// Words of a colour whose digits are those of its bytes, by hand.
    #[test]
    fn words_have_the_bits_of_their_format() {
        for (format, word, digits) in [
            (ColorFormat::Rgba8, 0xff33_66ff, 8),
            (ColorFormat::Rgb565, 31 << 11 | 13 << 5 | 12, 4),
            (ColorFormat::Rgb444, 0xf36, 3),
            // Six bits each, in the upper of eight: 63, 51·63/255 = 12.6 and 102·63/255 = 25.2.
            (ColorFormat::Rgb666, 0x00fc_3464, 6),
            (ColorFormat::Rgb888, 0x00ff_3366, 6),
            (ColorFormat::Xrgb8888, 0x00ff_3366, 8),
            (ColorFormat::Rgb332, 7 << 5 | 1 << 2 | 1, 2),
            (ColorFormat::Indexed8, 5 * 36 + 6 + 2, 2),
        ] {
            let found = of(format, Dither::None, [0; 2], [0xff, 0x33, 0x66]);
            assert_eq!((found.word, found.digits), (word, digits), "{format:?}");
        }
    }

    /// The palette of all combinations, by the library's search for the nearest.
    #[test]
    fn indices_are_those_of_the_nearest_colour() {
        let levels = 0..6_u8;
        let palette: Vec<Rgba8> = levels
            .clone()
            .flat_map(|r| (0..6).flat_map(move |g| (0..6).map(move |b| [r, g, b].map(|level| level * 51))))
            .map(|[r, g, b]| Rgba8::new(r, g, b, 255))
            .collect();
        let library = Indexed(palette.leak());
        for k in 0..=255_u8 {
            let color = Rgba8::new(k, 255 - k, k.wrapping_mul(77), 255);
            let index = Cube.pixel(color);
            assert_eq!((index, Cube.color(index)), (library.pixel(color), library.color(index)), "{color:?}");
        }
    }
}
