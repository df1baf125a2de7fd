//! The thing drawn into: a band of rows of a frame.

use crate::color::{Color, ColorFormat, Store};
use crate::depth::DepthFormat;
use core::fmt;
use core::ops::Range;

/// Consecutive rows of a frame, in buffers of the caller's. A whole frame is one band; a frame that does not fit in
/// memory is drawn band by band, with the same pixels.
///
/// Both buffers hold `width` pixels a row from the top row down, without padding.
#[derive(Debug)]
pub struct Band<'a, C: ColorFormat, D: DepthFormat> {
    color: &'a mut [C::Pixel],
    depth: &'a mut [D::Stored],
    width: usize,
    first_row: usize,
    /// What may be drawn to: columns and rows of the frame.
    limits: [Range<i32>; 2],
}

/// Why buffers do not make a band.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BandError {
    /// No pixels, or more than 16384 columns, or rows beyond 16384.
    Size,
    /// The colour buffer does not hold whole rows.
    Rows {
        /// Pixels in the colour buffer.
        pixels: usize,
        /// Pixels a row.
        width: u32,
    },
    /// The depth buffer holds another number of pixels than the colour buffer.
    Depth {
        /// Pixels in the depth buffer.
        found: usize,
        /// Pixels in the colour buffer.
        expected: usize,
    },
}

impl fmt::Display for BandError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size => f.write_str("a band needs 1 to 16384 columns and rows within the first 16384"),
            Self::Rows { pixels, width } => {
                write!(f, "the colour buffer's {pixels} pixels are not whole rows of {width}")
            }
            Self::Depth { found, expected } => {
                write!(f, "the depth buffer holds {found} pixels, the colour buffer {expected}")
            }
        }
    }
}

impl core::error::Error for BandError {}

/// The largest width and the last row plus one of a frame.
const LARGEST: i32 = 1 << 14;

impl<'a, C: ColorFormat, D: DepthFormat> Band<'a, C, D> {
    /// The band of a frame of `width` columns that starts at `first_row`, as high as `color` has rows.
    ///
    /// For [`NoDepth`](crate::NoDepth), `depth` is a slice of `()`, for example `&mut [(); 320 * 240]`, without bytes.
    ///
    /// # Errors
    /// [`BandError`] when the buffers' lengths do not fit each other or the limits.
    pub fn new(
        width: u32,
        first_row: u32,
        color: &'a mut [C::Pixel],
        depth: &'a mut [D::Stored],
    ) -> Result<Self, BandError> {
        if width == 0 || color.is_empty() {
            return Err(BandError::Size);
        }
        let columns = width as usize;
        if !color.len().is_multiple_of(columns) {
            return Err(BandError::Rows { pixels: color.len(), width });
        }
        if depth.len() != color.len() {
            return Err(BandError::Depth { found: depth.len(), expected: color.len() });
        }
        let bound = |x: usize| i32::try_from(x).ok().filter(|&x| x <= LARGEST);
        let last = (color.len() / columns).checked_add(first_row as usize);
        match (bound(columns), bound(first_row as usize), last.and_then(bound)) {
            (Some(right), Some(top), Some(bottom)) => Ok(Self {
                color,
                depth,
                width: columns,
                first_row: first_row as usize,
                limits: [0..right, top..bottom],
            }),
            _ => Err(BandError::Size),
        }
    }

    /// The frame's columns and rows that may be drawn to.
    #[must_use]
    pub fn limits(&self) -> [Range<i32>; 2] {
        self.limits.clone()
    }

    /// The same band, of which only these columns and rows of the frame may be drawn to or cleared.
    pub fn scissor(&mut self, columns: Range<i32>, rows: Range<i32>) -> Band<'_, C, D> {
        let narrow = |a: &Range<i32>, b: Range<i32>| a.start.max(b.start)..a.end.min(b.end);
        let limits = [narrow(&self.limits[0], columns), narrow(&self.limits[1], rows)];
        Band { color: self.color, depth: self.depth, width: self.width, first_row: self.first_row, limits }
    }

    /// Gives every pixel this colour and the farthest depth.
    pub fn clear<Shade: Color>(&mut self, color: Shade)
    where
        C: Store<Shade>,
    {
        let pixel = C::pixel(color);
        let [columns, rows] = self.limits();
        for row in rows {
            let (color, depth) = self.pixels_from(row, columns.start);
            let count = columns.len();
            color.iter_mut().take(count).for_each(|p| *p = pixel);
            depth.iter_mut().take(count).for_each(|d| *d = D::FARTHEST);
        }
    }

    /// The pixels from `column` of the frame's row `row` on, to the end of the band; none where the band has none.
    #[inline]
    pub(crate) fn pixels_from(&mut self, row: i32, column: i32) -> (&mut [C::Pixel], &mut [D::Stored]) {
        let start = |row: i32| {
            let row = usize::try_from(row).ok()?.checked_sub(self.first_row)?;
            Some(row * self.width + usize::try_from(column).ok()?)
        };
        match start(row) {
            Some(start) => (
                self.color.get_mut(start..).unwrap_or_default(),
                self.depth.get_mut(start..).unwrap_or_default(),
            ),
            None => (&mut [], &mut []),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::depth::{D16, NoDepth};
    use alberti_math::Rgba8;

    #[test]
    fn buffers_must_fit() {
        let (mut color, mut depth) = ([0u32; 12], [0u16; 12]);
        assert!(
            Band::<Rgba8, D16>::new(4, 9, &mut color, &mut depth).is_ok_and(|b| b.limits() == [0..4, 9..12])
        );
        let error = |width, row, color: &mut [u32], depth: &mut [u16]| {
            Band::<Rgba8, D16>::new(width, row, color, depth).expect_err("must not fit")
        };
        assert_eq!(error(5, 0, &mut color, &mut depth), BandError::Rows { pixels: 12, width: 5 });
        assert_eq!(error(4, 0, &mut color, &mut depth[1..]), BandError::Depth { found: 11, expected: 12 });
        assert_eq!(error(0, 0, &mut color, &mut depth), BandError::Size);
        assert_eq!(error(4, 0, &mut [], &mut []), BandError::Size);
        assert_eq!(error(4, 16382, &mut color, &mut depth), BandError::Size);
        assert_eq!(error(4, u32::MAX, &mut color, &mut depth), BandError::Size);
    }

    #[test]
    fn a_depth_buffer_of_nothing_costs_nothing() {
        let (mut color, mut depth) = ([0u32; 6], [(); 6]);
        assert_eq!(size_of_val(&depth), 0);
        let mut band = Band::<Rgba8, NoDepth>::new(3, 0, &mut color, &mut depth).expect("fits");
        band.clear(Rgba8::WHITE);
        assert_eq!(color, [u32::MAX; 6]);
    }

    #[test]
    fn a_scissor_keeps_what_is_outside() {
        let (mut color, mut depth) = ([0u32; 12], [(); 12]);
        let mut band = Band::<Rgba8, NoDepth>::new(4, 7, &mut color, &mut depth).expect("fits");
        band.scissor(-3..3, 8..100).clear(Rgba8::WHITE);
        let w = u32::MAX;
        assert_eq!(color, [0, 0, 0, 0, w, w, w, 0, w, w, w, 0]);
    }

    #[test]
    fn there_are_no_pixels_outside_the_band() {
        let (mut color, mut depth) = ([0u32; 6], [(); 6]);
        let mut band = Band::<Rgba8, NoDepth>::new(3, 5, &mut color, &mut depth).expect("fits");
        assert_eq!(band.pixels_from(5, 1).0.len(), 5);
        assert_eq!(band.pixels_from(6, 2).0.len(), 1);
        assert_eq!(band.pixels_from(4, 1).0.len(), 0);
        assert_eq!(band.pixels_from(7, 1).0.len(), 0);
        assert_eq!(band.pixels_from(-1, -1).0.len(), 0);
    }
}
