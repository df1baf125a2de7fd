//! Frames that do not fit in memory, or not in a cache: one band of rows after another.

use crate::color::{ColorFormat, FragmentColor};
use crate::depth::DepthFormat;
use crate::error::TargetError;
use crate::target::{LARGEST, Target, must_reach};

/// A frame that is drawn band by band, each in the memory of the one before: its depths, and its colours too where
/// these are no whole frame or [window](Self::window).
///
/// ```
/// use alberti_math::{Rgb565Be, Rgba8};
/// use alberti_raster::{Bands, D16};
///
/// // 320 x 240 in bands of 16 rows.
/// let (mut color, mut depth) = ([0u16; 320 * 16], [0u16; 320 * 16]);
/// let mut bands = Bands::new(Rgb565Be, D16, 320, 240, &mut color, &mut depth)?;
/// let mut sent = 0;
/// bands.draw(Rgba8::BLACK, |band| sent += band.pixels().len());
/// assert_eq!(sent, 320 * 240);
///
/// // A whole frame of colours, with a depth buffer of 16 rows.
/// let mut frame = [0u16; 320 * 240];
/// Bands::new(Rgb565Be, D16, 320, 240, &mut frame, &mut depth)?.draw(Rgba8::WHITE, |band| {
///     // ... what is drawn into each band ...
/// });
/// assert_eq!(frame, [0xffff; 320 * 240]);
/// # Ok::<(), alberti_raster::TargetError>(())
/// ```
///
/// # Cost
/// Depths of a megabyte or two stay in a desktop's caches, where those of a large frame do not: memory is written once,
/// by the colours. A triangle across several bands is set up in each of them.
#[derive(Debug)]
pub struct Bands<'a, C: ColorFormat, D: DepthFormat> {
    color_format: C,
    depth_format: D,
    color: &'a mut [C::Pixel],
    depth: &'a mut [D::Stored],
    size: [u32; 2],
    /// Pixels of colours from a row to the next, in a band and from band to band: 0 if all have the same memory.
    strides: [usize; 2],
    next_row: u32,
}

impl<'a, C: ColorFormat, D: DepthFormat> Bands<'a, C, D> {
    /// A frame of `width` x `height` pixels in bands of as many rows as `depth` has; the last may have fewer. Colours
    /// are as many, for a frame that is nowhere whole, or those of the whole frame.
    ///
    /// # Errors
    /// [`TargetError`] when the buffers' lengths do not fit each other, the width or the limits.
    pub fn new(
        color_format: C,
        depth_format: D,
        width: u32,
        height: u32,
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Self, TargetError> {
        if width > LARGEST || height > LARGEST {
            return Err(TargetError::Size);
        }
        let (row, frame) = (width as usize, width as usize * height as usize);
        if color.len() != depth.len() && color.len() != frame {
            return Err(TargetError::Depth { found: depth.len(), expected: color.len() });
        }
        // Colours of a band are the memory of all bands.
        let strides = [row, if color.len() == frame { row } else { 0 }];
        Self::of_strides((color_format, depth_format), [width, height], strides, color, depth)
    }

    /// The bands of a window of `width` x `height` pixels in a larger picture, of as many rows as `depth` has; the last
    /// may have fewer. `color` begins with the window's first pixel, and each row begins `stride` pixels after the one
    /// above, as those of [`Target::window`].
    ///
    /// ```
    /// use alberti_math::{Rgb565Be, Rgba8};
    /// use alberti_raster::{Bands, D16};
    ///
    /// // A view of 160 x 120 in the middle of a picture of 320 x 240, with a depth buffer of 16 rows.
    /// let (mut picture, mut depth) = ([0u16; 320 * 240], [0u16; 160 * 16]);
    /// let place = &mut picture[60 * 320 + 80..];
    /// Bands::window(Rgb565Be, D16, [160, 120], 320, place, &mut depth)?.draw(Rgba8::WHITE, |band| {
    ///     // ... what is drawn into each band ...
    /// });
    /// assert_eq!(picture.iter().filter(|&&pixel| pixel == 0xffff).count(), 160 * 120);
    /// # Ok::<(), alberti_raster::TargetError>(())
    /// ```
    ///
    /// # Errors
    /// [`TargetError`] when the buffers' lengths do not fit the size and the stride, or these the limits.
    pub fn window(
        color_format: C,
        depth_format: D,
        size: [u32; 2],
        stride: usize,
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Self, TargetError> {
        must_reach(color.len(), size, stride)?;
        Self::of_strides((color_format, depth_format), size, [stride; 2], color, depth)
    }

    fn of_strides(
        (color_format, depth_format): (C, D),
        size: [u32; 2],
        strides: [usize; 2],
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Self, TargetError> {
        let [columns, rows] = size.map(|side| side as usize);
        // Pixels behind a whole frame are no part of any row.
        let (pixels, width) = (depth.len().min(columns.saturating_mul(rows)), size[0]);
        if width != 0 && !pixels.is_multiple_of(columns) {
            return Err(TargetError::Rows { pixels, width });
        }
        let mut bands = Self { color_format, depth_format, color, depth, size, strides, next_row: 0 };
        bands.band(0)?;
        Ok(bands)
    }

    /// Columns and rows of the frame.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The depth format.
    #[must_use]
    pub fn depth_format(&self) -> D {
        self.depth_format
    }

    /// The next band, from the top; `None` after the last. Its pixels are whatever its memory holds.
    pub fn next_band(&mut self) -> Option<Target<'_, C, D>> {
        let first_row = self.next_row;
        let rows = self.band(first_row).ok()?.limits()[1].len();
        self.next_row = first_row.saturating_add(rows.try_into().ok()?);
        self.band(first_row).ok()
    }

    /// Clears each of the bands that are left to this colour and the farthest depth, just before `draw` has it.
    pub fn draw<Shade: FragmentColor>(
        &mut self,
        background: Shade,
        mut draw: impl FnMut(&mut Target<'_, C, D>),
    ) {
        while let Some(mut band) = self.next_band() {
            band.clear(background);
            draw(&mut band);
        }
    }

    /// The band whose first row this is.
    fn band(&mut self, first_row: u32) -> Result<Target<'_, C, D>, TargetError> {
        let Self { color_format, depth_format, ref mut color, ref mut depth, size, strides, .. } = *self;
        let width = size[0] as usize;
        let left = size[1].saturating_sub(first_row) as usize;
        let rows = depth.len().checked_div(width).unwrap_or(0).min(left);
        let (count, above) = (u32::try_from(rows).unwrap_or(0), rows.saturating_sub(1));
        // A window's last row ends with it.
        let color = color.get_mut((first_row as usize).saturating_mul(strides[1])..).unwrap_or_default();
        let color = color.get_mut(..above * strides[0] + width).unwrap_or_default();
        let depth = depth.get_mut(..rows * width).unwrap_or_default();
        Target::of_rows((color_format, depth_format), size, [first_row, count], strides[0], color, depth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::depth::D16;
    use alberti_math::{Rgba8, Rgba8888};

    #[test]
    fn a_whole_frame_keeps_the_colours_of_all_bands() {
        let (mut color, mut depth) = ([0u32; 4 * 8], [0u16; 4 * 3]);
        let mut bands =
            Bands::new(Rgba8888, D16, 4, 8, &mut color, &mut depth).expect("three rows of depths");
        let mut number = 0;
        bands.draw(Rgba8::from_rgb24(0), |band| {
            assert!(band.pixels().iter().all(|&pixel| pixel == u32::from_ne_bytes([0, 0, 0, 255])));
            number += 1;
            band.clear(Rgba8::from_rgb24(number));
        });
        assert!(bands.next_band().is_none());
        let numbers = color.map(|pixel| pixel.to_ne_bytes()[2]);
        assert!(numbers.iter().enumerate().all(|(i, &number)| usize::from(number) == 1 + i / 12));
        for (columns, rows, depths) in [(4, 8, 0), (4, 8, 5), (4, 7, 12), (8, 5, 8)] {
            let short = depth.get_mut(..depths).expect("twelve");
            assert!(Bands::new(Rgba8888, D16, columns, rows, &mut color, short).is_err());
        }
    }

    #[test]
    fn bands_are_all_rows_of_a_frame() {
        let (mut color, mut depth) = ([0u32; 12], [0u16; 12]);
        let mut rows = |height| {
            let mut bands = Bands::new(Rgba8888, D16, 4, height, &mut color, &mut depth).expect("three rows");
            let mut rows = std::vec::Vec::new();
            while let Some(band) = bands.next_band() {
                rows.push(band.limits()[1].clone());
            }
            rows
        };
        assert_eq!(rows(8), [0..3, 3..6, 6..8]);
        assert_eq!(rows(6), [0..3, 3..6]);
        assert_eq!(rows(2).first(), Some(&(0..2)));
        assert!(Bands::new(Rgba8888, D16, 5, 9, &mut color, &mut depth).is_err());
        assert!(Bands::new(Rgba8888, D16, 4, 0, &mut color, &mut depth).is_err());
        assert!(Bands::new(Rgba8888, D16, 4, 9, &mut color, &mut depth[1..]).is_err());
        // Two rows of five in memory of twelve.
        assert!(Bands::new(Rgba8888, D16, 5, 2, &mut color, &mut depth).is_ok());
    }

    #[test]
    fn bands_of_a_window_end_with_it() {
        // 3 x 4 in rows of 5, in bands of three rows and one.
        let (mut color, mut depth) = ([0u32; 5 * 3 + 3], [0u16; 9]);
        let mut bands = Bands::window(Rgba8888, D16, [3, 4], 5, &mut color, &mut depth).expect("fits");
        assert_eq!(bands.size(), [3, 4]);
        let seen = |band: Target<'_, _, _>| (band.limits(), band.pixels().len());
        assert_eq!(bands.next_band().map(seen), Some(([0..3, 0..3], 13)));
        assert_eq!(bands.next_band().map(seen), Some(([0..3, 3..4], 3)));
        assert!(bands.next_band().is_none());

        let mut error = |size, stride, pixels: usize, depths: usize| {
            let (color, depth) = (&mut color[..pixels], &mut depth[..depths]);
            Bands::window(Rgba8888, D16, size, stride, color, depth).map(|_| ()).err()
        };
        assert_eq!(error([3, 4], 5, 18, 3), None);
        assert_eq!(error([3, 4], 5, 17, 9), Some(TargetError::Color { found: 17, expected: 18 }));
        assert_eq!(error([3, 4], 2, 18, 9), Some(TargetError::Stride { stride: 2, width: 3 }));
        assert_eq!(error([3, 4], 5, 18, 8), Some(TargetError::Rows { pixels: 8, width: 3 }));
        let expected = usize::MAX;
        assert_eq!(error([3, 4], expected, 18, 9), Some(TargetError::Color { found: 18, expected }));
        assert_eq!(error([3, 1], usize::MAX, 3, 3), None);
        for (size, depths) in [([3, 4], 0), ([3, 0], 3), ([0, 4], 3), ([0, 4], 0), ([1 << 15, 1], 9)] {
            assert!(error(size, 1 << 15, 18, depths).is_some(), "{size:?}, {depths}");
        }
        assert_eq!(error([3, 0], 3, 18, 3), Some(TargetError::Size));
        assert_eq!(error([0, 4], 3, 18, 3), Some(TargetError::Size));
    }
}
