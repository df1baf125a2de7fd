//! Frames that do not fit in memory: one band of rows after another.

use crate::color::ColorFormat;
use crate::depth::DepthFormat;
use crate::target::{LARGEST, Target, TargetError};

/// A frame that is drawn band by band in the same memory.
///
/// ```
/// use alberti_math::{Rgb565Be, Rgba8};
/// use alberti_raster::{Bands, D16};
///
/// // 320 x 240 in bands of 16 rows.
/// let (mut color, mut depth) = ([0u16; 320 * 16], [0u16; 320 * 16]);
/// let mut bands = Bands::new(Rgb565Be, D16, 320, 240, &mut color, &mut depth)?;
/// let mut sent = 0;
/// while let Some(mut band) = bands.next_band() {
///     band.clear(Rgba8::BLACK);
///     sent += band.pixels().len();
/// }
/// assert_eq!(sent, 320 * 240);
/// # Ok::<(), alberti_raster::TargetError>(())
/// ```
#[derive(Debug)]
pub struct Bands<'a, C: ColorFormat, D: DepthFormat> {
    color_format: C,
    depth_format: D,
    color: &'a mut [C::Pixel],
    depth: &'a mut [D::Stored],
    size: [u32; 2],
    next_row: u32,
}

impl<'a, C: ColorFormat, D: DepthFormat> Bands<'a, C, D> {
    /// A frame of `width` x `height` pixels in bands of as many rows as `color` has; the last may have fewer.
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
        let size = [width, height];
        let pixels = color.len().min(width as usize * height as usize);
        let (first, depths) = (color.get_mut(..pixels), depth.get_mut(..pixels));
        if let (Some(first), Some(depths)) = (first, depths) {
            Target::band(color_format, depth_format, size, 0, first, depths)?;
        }
        if depth.len() != color.len() {
            return Err(TargetError::Depth { found: depth.len(), expected: color.len() });
        }
        Ok(Self { color_format, depth_format, color, depth, size, next_row: 0 })
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

    /// The next band, from the top; `None` after the last. Its pixels are those of the band before.
    pub fn next_band(&mut self) -> Option<Target<'_, C, D>> {
        let [width, height] = self.size;
        let left = width as usize * height.checked_sub(self.next_row)? as usize;
        let pixels = self.color.len().min(left);
        let (color, depth) = (self.color.get_mut(..pixels)?, self.depth.get_mut(..pixels)?);
        let first_row = self.next_row;
        let band =
            Target::band(self.color_format, self.depth_format, self.size, first_row, color, depth).ok()?;
        self.next_row = first_row.saturating_add(band.limits()[1].len().try_into().ok()?);
        Some(band)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::depth::D16;
    use alberti_math::Rgba8888;

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
    }
}
