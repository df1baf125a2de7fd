//! Targets in embedded-graphics: as an image, as pixels of a display, and as a display that texts are drawn to.

use crate::color::{ColorFormat, EmbeddedBytes, EmbeddedColor};
use crate::depth::DepthFormat;
use crate::target::Target;
use bytemuck::NoUninit;
use core::convert::Infallible;
use core::ops::Range;
use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::image::{GetPixel, ImageDrawable, ImageRaw};
use embedded_graphics::primitives::Rectangle;

/// The pixels of a target as an image of embedded-graphics, where they are: [`Target::image`].
#[derive(Clone, Copy, Debug)]
pub struct TargetImage<'a, C: ColorFormat> {
    format: C,
    pixels: &'a [C::Pixel],
    size: Size,
    /// Pixels from a row to the next.
    stride: usize,
}

impl<C: EmbeddedColor, D: DepthFormat> Target<'_, C, D> {
    /// All rows of the target as an image: of a band its rows, of a window without what is beside it. Behind the
    /// feature `embedded-graphics`.
    ///
    /// ```
    /// use alberti_math::{Rgb565Be, Rgba8};
    /// use alberti_raster::{NoDepth, Target};
    /// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
    ///
    /// let (mut color, mut depth) = ([0; 3], [(); 3]);
    /// let mut target = Target::new(Rgb565Be, NoDepth, 3, 1, &mut color, &mut depth)?;
    /// target.clear(Rgba8::from_rgb24(0xff_00_00));
    ///
    /// let mut display = MockDisplay::<Rgb565>::new();
    /// Image::new(&target.image(), Point::new(1, 0)).draw(&mut display)?;
    /// display.assert_pattern(&[" RRR"]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Cost
    /// Drawn, it is one `fill_contiguous`, to which pixels go one after the other: for mixing with others.
    /// [`Target::bytes`] is faster where the display takes bytes.
    #[must_use]
    pub fn image(&self) -> TargetImage<'_, C> {
        let [width, _] = self.size();
        // As many rows as depths have, which are without padding.
        let rows = u32::try_from(self.depth.len() / (width as usize).max(1)).unwrap_or(0);
        TargetImage {
            format: self.color_format(),
            pixels: self.pixels(),
            size: Size::new(width, rows),
            stride: self.strides[0],
        }
    }

    /// Draws all rows of the target to their place in a frame on a display, a band by one `fill_contiguous`. A frame in
    /// the middle of a display is shown by the display's `translated`.
    ///
    /// # Errors
    /// Those of the display.
    ///
    /// # Cost
    /// That of [`image`](Self::image).
    pub fn show<T: DrawTarget<Color = C::Color>>(&self, display: &mut T) -> Result<(), T::Error> {
        let (image, first_row) = (self.image(), i32::try_from(self.first_row).unwrap_or(i32::MAX));
        let place = Rectangle::new(Point::new(0, first_row), image.size);
        display.fill_contiguous(&place, image.colors(image.columns(), image.rows()))
    }
}

impl<C: EmbeddedBytes<Pixel: NoUninit>, D: DepthFormat> Target<'_, C, D> {
    /// All rows of the target as an `ImageRaw` of its bytes; `None` of a window with others beside it.
    ///
    /// # Cost
    /// That of [`image`](Self::image).
    #[must_use]
    pub fn image_raw(&self) -> Option<ImageRaw<'_, C::Color, C::Order>> {
        let [width, _] = self.size();
        (self.strides[0] == self.strides[1] && self.pixels().len() == self.depth.len())
            .then(|| ImageRaw::new(self.bytes(), width))
    }
}

impl<C: EmbeddedColor> TargetImage<'_, C> {
    fn columns(&self) -> Range<usize> {
        0..self.size.width as usize
    }

    fn rows(&self) -> Range<usize> {
        0..self.size.height as usize
    }

    /// The colours of these columns and rows.
    fn colors(&self, columns: Range<usize>, rows: Range<usize>) -> impl Iterator<Item = C::Color> {
        rows.flat_map(move |row| {
            let row = self.pixels.get(row * self.stride..).and_then(|row| row.get(columns.clone()));
            row.unwrap_or_default().iter().map(|&pixel| self.format.to_embedded(pixel))
        })
    }
}

impl<C: ColorFormat> OriginDimensions for TargetImage<'_, C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: EmbeddedColor> ImageDrawable for TargetImage<'_, C> {
    type Color = C::Color;

    fn draw<T: DrawTarget<Color = C::Color>>(&self, display: &mut T) -> Result<(), T::Error> {
        let all = Rectangle::new(Point::zero(), self.size);
        display.fill_contiguous(&all, self.colors(self.columns(), self.rows()))
    }

    fn draw_sub_image<T: DrawTarget<Color = C::Color>>(
        &self,
        display: &mut T,
        area: &Rectangle,
    ) -> Result<(), T::Error> {
        let part = |from: i32, length: u32, all: Range<usize>| {
            let from = usize::try_from(from).ok()?;
            let end = from.checked_add(length as usize)?;
            (from < end && end <= all.end).then_some(from..end)
        };
        let columns = part(area.top_left.x, area.size.width, self.columns());
        let rows = part(area.top_left.y, area.size.height, self.rows());
        // As `ImageRaw` has it, nothing of an area that is partly outside.
        let (Some(columns), Some(rows)) = (columns, rows) else { return Ok(()) };
        display.fill_contiguous(&Rectangle::new(Point::zero(), area.size), self.colors(columns, rows))
    }
}

impl<C: EmbeddedColor> GetPixel for TargetImage<'_, C> {
    type Color = C::Color;

    fn pixel(&self, place: Point) -> Option<C::Color> {
        let [column, row] = [usize::try_from(place.x).ok()?, usize::try_from(place.y).ok()?];
        if !self.columns().contains(&column) || !self.rows().contains(&row) {
            return None;
        }
        self.pixels.get(row * self.stride + column).map(|&pixel| self.format.to_embedded(pixel))
    }
}

/// The whole frame, also of a band: code that draws a user interface is the same for each.
impl<C: ColorFormat, D: DepthFormat> OriginDimensions for Target<'_, C, D> {
    fn size(&self) -> Size {
        let [width, height] = self.size();
        Size::new(width, height)
    }
}

/// Texts and shapes of embedded-graphics over what is drawn, in the target's memory: only
/// [within limits](Target::limits), whatever the depth, which stays.
///
/// ```
/// use alberti_math::{Rgb565Be, Rgba8};
/// use alberti_raster::{NoDepth, Target};
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*, primitives::{PrimitiveStyle, Rectangle}};
///
/// let (mut color, mut depth) = ([0; 4 * 2], [(); 4 * 2]);
/// // The lower half of a frame.
/// let mut band = Target::band(Rgb565Be, NoDepth, [4, 4], 2, &mut color, &mut depth)?;
/// let frame = Rectangle::new(Point::zero(), Size::new(4, 4));
/// frame.into_styled(PrimitiveStyle::with_stroke(Rgb565::WHITE, 1)).draw(&mut band)?;
/// assert_eq!(color, [0xffff, 0, 0, 0xffff, 0xffff, 0xffff, 0xffff, 0xffff]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Cost
/// A shape filled row by row costs its pixels: 0.03 to 0.04 ns each on a desktop. Pixels that come alone, as of texts
/// and circles' edges, cost 2 to 3 ns each (`cargo bench -p alberti-benches --bench displays`).
impl<C: EmbeddedColor, D: DepthFormat> DrawTarget for Target<'_, C, D> {
    type Color = C::Color;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C::Color>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let ([columns, rows], format) = (self.limits(), self.color_format());
        for Pixel(Point { x, y }, color) in pixels {
            if !columns.contains(&x) || !rows.contains(&y) {
                continue;
            }
            if let Some((pixel, _)) = self.pixel(y, x) {
                *pixel = format.of_embedded(color);
            }
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C::Color>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        let (mut colors, format) = (colors.into_iter(), self.color_format());
        let [(left, columns), (above, rows)] = self.within(area);
        let width = area.size.width as usize;
        let right = width - left - columns.len();
        // Colours of whole rows above, then those beside the limits.
        let mut ahead = above.saturating_mul(width) + left;
        for row in rows {
            skip(&mut colors, ahead);
            let pixels = self.pixels_from(row, columns.start).0.iter_mut().take(columns.len());
            // The pixel first, since an iterator that ends must not have taken a colour of the next row.
            for (pixel, color) in pixels.zip(colors.by_ref()) {
                *pixel = format.of_embedded(color);
            }
            ahead = left + right;
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: C::Color) -> Result<(), Infallible> {
        let pixel = self.color_format().of_embedded(color);
        let [(_, columns), (_, rows)] = self.within(area);
        for row in rows {
            self.pixels_from(row, columns.start)
                .0
                .iter_mut()
                .take(columns.len())
                .for_each(|each| *each = pixel);
        }
        Ok(())
    }
}

impl<C: ColorFormat, D: DepthFormat> Target<'_, C, D> {
    /// The columns and the rows of an area within limits, each after the number of those before.
    fn within(&self, area: &Rectangle) -> [(usize, Range<i32>); 2] {
        let [columns, rows] = self.limits();
        let part = |from: i32, length: u32, limits: Range<i32>| {
            let end = i64::from(from) + i64::from(length);
            let end = i32::try_from(end).unwrap_or(i32::MAX).min(limits.end);
            let start = from.max(limits.start);
            // Nothing within: all are before.
            if start >= end { (length as usize, 0..0) } else { (start.abs_diff(from) as usize, start..end) }
        };
        [part(area.top_left.x, area.size.width, columns), part(area.top_left.y, area.size.height, rows)]
    }
}

/// Takes so many of an iterator.
fn skip(colors: &mut impl Iterator, count: usize) {
    if let Some(last) = count.checked_sub(1) {
        colors.nth(last);
    }
}
