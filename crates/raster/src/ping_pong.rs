//! Frames in bands of two memories: one is drawn while the other is sent.

use crate::color::ColorFormat;
use crate::depth::DepthFormat;
use crate::error::TargetError;
use crate::target::{LARGEST, Target};
use core::mem::swap;
use core::ops::Range;

/// A frame that is drawn band by band into two memories of colours by turns. In each [turn](Self::turn) one band is
/// drawn, while that of the turn before is sent to a display.
///
/// ```
/// use alberti_math::{Rgb565Be, Rgba8};
/// use alberti_raster::{D16, PingPong, Turn};
///
/// // 320 x 240 in bands of 16 rows.
/// let (mut colors, mut depths) = ([[0u16; 320 * 16]; 2], [0u16; 320 * 16]);
/// let [first, second] = &mut colors;
/// let mut bands = PingPong::new(Rgb565Be, D16, [320, 240], [first, second], &mut depths)?;
/// let mut sent = 0;
/// while let Some(Turn { band, ready }) = bands.turn() {
///     // Begins the transfer of `ready.pixels`, which are `ready.rows` of the display ...
///     sent += ready.map_or(0, |ready| ready.pixels.len());
///     if let Some(mut band) = band {
///         band.clear(Rgba8::BLACK);
///         // ... what is drawn into each band ...
///     }
///     // ... and waits for its end.
/// }
/// assert_eq!(sent, 320 * 240);
/// # Ok::<(), alberti_raster::TargetError>(())
/// ```
///
/// # Cost
/// A turn: a swap of two slices and the shape of a band. A frame has one turn more than bands.
#[derive(Debug)]
pub struct PingPong<'a, C: ColorFormat, D: DepthFormat> {
    formats: (C, D),
    size: [u32; 2],
    drawn: &'a mut [C::Pixel],
    ready: &'a mut [C::Pixel],
    depth: &'a mut [D::Stored],
    /// The rows that are drawn next; empty after the last.
    next: Range<u32>,
    /// The rows that were drawn last; empty before the first.
    last: Range<u32>,
}

/// Two bands: one to draw and one to send, at the same time or one after the other.
#[derive(Debug)]
pub struct Turn<'t, C: ColorFormat, D: DepthFormat> {
    /// The band to be drawn, whose pixels and depths are whatever its memory holds; none in the last turn.
    pub band: Option<Target<'t, C, D>>,
    /// The band to be sent, which was drawn in the turn before; none in the first.
    pub ready: Option<Ready<'t, C::Pixel>>,
}

/// A band that is drawn, for a display.
#[derive(Debug)]
pub struct Ready<'t, P> {
    /// Rows of the frame.
    pub rows: Range<u16>,
    /// Their colours, row by row from the top: for a display also where they change places, as by
    /// [`pack`](crate::color::pack).
    pub pixels: &'t mut [P],
}

impl<'a, C: ColorFormat, D: DepthFormat> PingPong<'a, C, D> {
    /// A frame of these columns and rows in bands of as many rows as each of the `colors` and `depth` have; the last
    /// may have fewer.
    ///
    /// # Errors
    /// [`TargetError`] when the buffers' lengths do not fit each other, the width or the limits.
    pub fn new(
        color_format: C,
        depth_format: D,
        size: [u32; 2],
        [drawn, ready]: [&'a mut [C::Pixel]; 2],
        depth: &'a mut [D::Stored],
    ) -> Result<Self, TargetError> {
        let [width, height] = size;
        if width == 0 || height == 0 || width > LARGEST || height > LARGEST {
            return Err(TargetError::Size);
        }
        let pixels = depth.len();
        if pixels == 0 || !pixels.is_multiple_of(width as usize) {
            return Err(TargetError::Rows { pixels, width });
        }
        for colors in [&drawn, &ready] {
            if colors.len() != pixels {
                return Err(TargetError::Color { found: colors.len(), expected: pixels });
            }
        }
        let rows = u32::try_from(pixels / width as usize).unwrap_or(height).min(height);
        Ok(Self {
            formats: (color_format, depth_format),
            size,
            drawn,
            ready,
            depth,
            next: 0..rows,
            last: 0..0,
        })
    }

    /// The next turn, from the top; `None` after the last, in which the last band is sent.
    pub fn turn(&mut self) -> Option<Turn<'_, C, D>> {
        let Self { formats, size: [width, height], .. } = *self;
        let (drawing, sending) = (self.next.clone(), self.last.clone());
        if drawing.is_empty() && sending.is_empty() {
            return None;
        }
        swap(&mut self.drawn, &mut self.ready);
        let rows = self.depth.len() / width.max(1) as usize;
        let below = drawing.end.saturating_add(u32::try_from(rows).unwrap_or(height)).min(height);
        self.next = drawing.end..below;
        self.last = drawing.clone();

        let pixels = |rows: &Range<u32>| rows.len() * width as usize;
        let ready =
            self.ready.get_mut(..pixels(&sending)).filter(|pixels| !pixels.is_empty()).map(|pixels| {
                // Frames are no larger than that.
                let [start, end] =
                    [sending.start, sending.end].map(|row| u16::try_from(row).unwrap_or(u16::MAX));
                Ready { rows: start..end, pixels }
            });
        let count = pixels(&drawing);
        let memory = self.drawn.get_mut(..count).zip(self.depth.get_mut(..count));
        let band = memory.and_then(|(color, depth)| {
            let rows = [drawing.start, drawing.end - drawing.start];
            Target::of_rows(formats, [width, height], rows, width as usize, color, depth).ok()
        });
        Some(Turn { band, ready })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::depth::D16;
    use alberti_math::{Rgba8, Rgba8888};
    use std::vec::Vec;

    #[test]
    fn each_band_is_sent_in_the_turn_after_it_was_drawn() {
        let (mut colors, mut depth) = ([[0u32; 4 * 3]; 2], [0u16; 4 * 3]);
        for (height, expected) in [
            (8, &[[0, 3], [3, 6], [6, 8]][..]),
            (6, &[[0, 3], [3, 6]]),
            (3, &[[0, 3]]),
            (2, &[[0, 2]]),
            (1, &[[0, 1]]),
        ] {
            let [a, b] = &mut colors;
            let mut bands = PingPong::new(Rgba8888, D16, [4, height], [a, b], &mut depth).expect("fits");
            let (mut drawn, mut sent) = (Vec::new(), Vec::new());
            while let Some(Turn { band, ready }) = bands.turn() {
                let number = u32::try_from(sent.len()).expect("few");
                if let Some(Ready { rows, pixels }) = ready {
                    assert_eq!(pixels.len(), 4 * rows.len());
                    // The turn before drew it, though another band has been drawn since.
                    if let Some(mut band) = band {
                        drawn.push(band.limits()[1].clone());
                        band.clear(Rgba8::from_rgb24(number + 1));
                    }
                    assert!(pixels.iter().all(|&pixel| pixel == Rgba8::from_rgb24(number).to_bits()));
                    sent.push([rows.start, rows.end]);
                } else {
                    assert!(sent.is_empty() && drawn.is_empty());
                    let mut band = band.expect("the first");
                    assert_eq!(band.size(), [4, height]);
                    drawn.push(band.limits()[1].clone());
                    band.clear(Rgba8::from_rgb24(0));
                }
            }
            assert!(bands.turn().is_none());
            assert_eq!(sent, expected, "{height}");
            assert_eq!(drawn.len(), sent.len());
            for (drawn, [start, end]) in drawn.into_iter().zip(sent) {
                assert_eq!(drawn, start.into()..end.into());
            }
        }
    }

    #[test]
    fn memories_must_fit() {
        let (mut colors, mut depth) = ([[0u32; 12]; 2], [0u16; 12]);
        let [a, b] = &mut colors;
        let mut error = |size, [first, second, depths]: [usize; 3]| {
            let colors = [&mut a[..first], &mut b[..second]];
            PingPong::new(Rgba8888, D16, size, colors, &mut depth[..depths]).map(|_| ()).err()
        };
        assert_eq!(error([4, 9], [12; 3]), None);
        assert_eq!(error([12, LARGEST], [12; 3]), None);
        assert_eq!(error([4, 9], [12, 8, 12]), Some(TargetError::Color { found: 8, expected: 12 }));
        assert_eq!(error([4, 9], [8, 12, 12]), Some(TargetError::Color { found: 8, expected: 12 }));
        assert_eq!(error([4, 9], [12, 12, 8]), Some(TargetError::Color { found: 12, expected: 8 }));
        assert_eq!(error([5, 9], [12; 3]), Some(TargetError::Rows { pixels: 12, width: 5 }));
        assert_eq!(error([4, 9], [0; 3]), Some(TargetError::Rows { pixels: 0, width: 4 }));
        for size in [[0, 9], [4, 0], [4, LARGEST + 1], [LARGEST + 1, 4]] {
            assert_eq!(error(size, [12; 3]), Some(TargetError::Size));
        }
    }
}
