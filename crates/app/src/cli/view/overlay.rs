//! Text over a picture.

use std::convert::Infallible;
use std::ops::Range;

use embedded_graphics::Drawable as _;
use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::iso_8859_1::FONT_8X13;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::{Baseline, Text};

/// A letter's width and height.
const LETTER: [u32; 2] = [8, 13];

/// The pixels of a window, 0x00RRGGBB each, by rows from the top.
pub(super) struct Canvas<'a> {
    pub(super) pixels: &'a mut [u32],
    pub(super) size: [u32; 2],
    /// Pixels of the window a pixel of a letter, along each side.
    pub(super) scale: u32,
}

impl Canvas<'_> {
    /// Letters in a line of a window of that width.
    pub(super) fn columns(width: u32, scale: u32) -> usize {
        (width / (LETTER[0] * scale)).saturating_sub(2) as usize
    }

    /// Lines on a darkened patch in the upper left corner, after so many others. In a line of a legend the colour is
    /// seen instead of its digits.
    pub(super) fn write(&mut self, lines: &[String], before: usize, color: [u8; 3]) {
        let widest = lines.iter().map(|line| line.chars().count()).max().unwrap_or_default();
        let to_u32 = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        let left = LETTER[0] / 2;
        let top = to_u32(before) * LETTER[1] + 3;
        if widest > 0 {
            let width = (to_u32(widest) + 1) * LETTER[0];
            self.darken([width, to_u32(lines.len()) * LETTER[1] + 1], top);
        }
        let style = MonoTextStyle::new(&FONT_8X13, Rgb888::new(color[0], color[1], color[2]));
        for (line, row) in lines.iter().zip(0_u32..) {
            let mut line = line.clone();
            if let Some(color) = legend_color(&line) {
                line.replace_range(DIGITS, "      ");
                let [begin, end] = [DIGITS.start, DIGITS.end].map(to_u32);
                let corner = point([left + begin * LETTER[0], top + row * LETTER[1] + 1]);
                let size = Size::new((end - begin) * LETTER[0], LETTER[1] - 2);
                // There is nothing that could fail.
                _ = self.fill_solid(&Rectangle::new(corner, size), color);
            }
            let at = point([left, top + row * LETTER[1]]);
            _ = Text::with_baseline(&line, at, style, Baseline::Top).draw(self);
        }
    }

    fn darken(&mut self, [width, height]: [u32; 2], top: u32) {
        let [columns, rows] = self.size;
        let right = (width * self.scale).min(columns) as usize;
        for row in (top * self.scale).min(rows)..((top + height) * self.scale).min(rows) {
            let begin = row as usize * columns as usize;
            for pixel in &mut self.pixels[begin..begin + right] {
                *pixel = (*pixel >> 2) & 0x003f_3f3f;
            }
        }
    }
}

/// The place of a colour's digits in a line of a legend.
const DIGITS: Range<usize> = 2..8;

/// The colour of a line of a legend.
fn legend_color(line: &str) -> Option<Rgb888> {
    let rest = line.strip_prefix("  ")?;
    let digits = rest.get(..6).filter(|_| rest.get(6..8) == Some("  "))?;
    let is_color = digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    let [_, r, g, b] = u32::from_str_radix(digits, 16).ok().filter(|_| is_color)?.to_be_bytes();
    Some(Rgb888::new(r, g, b))
}

fn point(at: [u32; 2]) -> Point {
    let [x, y] = at.map(|x| i32::try_from(x).unwrap_or(i32::MAX));
    Point::new(x, y)
}

impl OriginDimensions for Canvas<'_> {
    fn size(&self) -> Size {
        Size::new(self.size[0] / self.scale, self.size[1] / self.scale)
    }
}

impl DrawTarget for Canvas<'_> {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let [columns, rows] = self.size;
        for Pixel(Point { x, y }, color) in pixels {
            let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { continue };
            let word = u32::from_be_bytes([0, color.r(), color.g(), color.b()]);
            for (x, y) in (0..self.scale * self.scale)
                .map(|k| (x * self.scale + k % self.scale, y * self.scale + k / self.scale))
                .filter(|&(x, y)| x < columns && y < rows)
            {
                self.pixels[y as usize * columns as usize + x as usize] = word;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A colour of a legend is a patch; digits that are none stay.
    #[test]
    fn colours_of_legends_are_seen() {
        let mut pixels = vec![0; 200 * 60];
        let mut canvas = Canvas { pixels: &mut pixels, size: [200, 60], scale: 1 };
        let lines = ["title", "  ff8000  0 to 1", "  least 3, greatest 4", "  +12345  none"];
        canvas.write(&lines.map(str::to_owned), 0, [255; 3]);
        let count = |color: u32| pixels.iter().filter(|pixel| **pixel == color).count();
        assert_eq!(count(0x00ff_8000), 48 * 11);
        assert_eq!(pixels[(3 + 13 + 6) * 200 + 4 + 16 + 24], 0x00ff_8000);
        assert!(count(0x00ff_ffff) > 200);
    }

    #[test]
    fn letters_are_within_the_window_at_any_size() {
        for size in [[1, 1], [7, 90], [300, 40]] {
            for scale in [1, 2, 3] {
                let mut pixels = vec![0x00ff_ffff; (size[0] * size[1]) as usize];
                let mut canvas = Canvas { pixels: &mut pixels, size, scale };
                canvas.write(&["Ag|\u{e9}\u{2026}".to_owned(), String::new()], 0, [255, 200, 100]);
                assert!(Canvas::columns(size[0], scale) <= size[0] as usize);
                if size[0] == 300 {
                    let inked = pixels.iter().filter(|pixel| **pixel == 0x00ff_c864).count();
                    assert!(inked > 20 * (scale * scale) as usize, "{inked}");
                    // Far from the text nothing changes.
                    assert_eq!(pixels[299], 0x00ff_ffff);
                }
            }
        }
    }
}
