//! The memory of a picture: its pixels and its depths.

use crate::numbers::index;
use alberti::{AnyDepth, F32, NoDepth, Rgba8, Rgba8888, Target, TargetError};
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

/// The most pixels of a picture: 640 x 480.
pub const MAX_PIXELS: usize = 640 * 480;

/// The colour behind all pictures.
pub(crate) const BACKGROUND: Rgba8 = Rgba8::from_rgb24(0x1b_20_2a);

/// A picture, row by row from the top, whose pixels have the bytes R, G, B, A.
#[derive(Debug)]
pub struct Canvas {
    size: [u32; 2],
    /// The rows that are drawn.
    rows: Range<u32>,
    pixels: Vec<u32>,
    depths: Vec<f32>,
    /// Depths of any format.
    words: Vec<u32>,
    /// Depths of none.
    none: Vec<()>,
}

/// A size without pixels, or with more than [`MAX_PIXELS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizeError([u32; 2]);

impl fmt::Display for SizeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.0;
        write!(f, "a picture of {width} x {height} pixels: it takes at least one, and at most {MAX_PIXELS}")
    }
}

impl core::error::Error for SizeError {}

impl Canvas {
    pub(crate) const fn new() -> Self {
        Self {
            size: [0; 2],
            rows: 0..0,
            pixels: Vec::new(),
            depths: Vec::new(),
            words: Vec::new(),
            none: Vec::new(),
        }
    }

    /// Makes it a picture of this size, of which these rows are drawn, as far as it has them.
    pub(crate) fn resize(&mut self, size: [u32; 2], rows: Range<u32>) -> Result<(), SizeError> {
        let count = size[0].checked_mul(size[1]).map_or(0, |count| count as usize);
        if !(1..=MAX_PIXELS).contains(&count) {
            return Err(SizeError(size));
        }
        let end = rows.end.min(size[1]);
        (self.size, self.rows) = (size, rows.start.min(end)..end);
        self.pixels.resize(count, 0);
        self.depths.resize(count, 1.0);
        self.words.resize(count, u32::MAX);
        self.none.resize(count, ());
        Ok(())
    }

    /// The width and the height.
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The pixels.
    #[must_use]
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// The pixels of the rows that are drawn.
    #[must_use]
    pub fn drawn(&self) -> &[u32] {
        self.pixels.get(self.places_of_rows()).unwrap_or_default()
    }

    fn places_of_rows(&self) -> Range<usize> {
        let [start, end] = [self.rows.start, self.rows.end].map(|row| row as usize * self.size[0] as usize);
        start..end
    }

    pub(crate) fn pixels_mut(&mut self) -> &mut [u32] {
        &mut self.pixels
    }

    /// A cleared target with depths that are taught: 0 at the near plane, 1 at the far one.
    pub(crate) fn target(&mut self) -> Result<Target<'_, Rgba8888, F32>, TargetError> {
        let (size, first, places) = (self.size, self.rows.start, self.places_of_rows());
        let (pixels, depths) = (&mut self.pixels[places.clone()], &mut self.depths[places]);
        let mut target = Target::band(Rgba8888, F32, size, first, pixels, depths)?;
        target.clear(BACKGROUND);
        Ok(target)
    }

    /// A cleared target with depths of a format that is chosen at run time.
    pub(crate) fn target_of(
        &mut self,
        depth: AnyDepth,
    ) -> Result<Target<'_, Rgba8888, AnyDepth>, TargetError> {
        let (size, first, places) = (self.size, self.rows.start, self.places_of_rows());
        let (pixels, depths) = (&mut self.pixels[places.clone()], &mut self.words[places]);
        let mut target = Target::band(Rgba8888, depth, size, first, pixels, depths)?;
        target.clear(BACKGROUND);
        Ok(target)
    }

    /// A cleared target without depths.
    pub(crate) fn flat(&mut self) -> Result<Target<'_, Rgba8888, NoDepth>, TargetError> {
        let (size, first, places) = (self.size, self.rows.start, self.places_of_rows());
        let (pixels, depths) = (&mut self.pixels[places.clone()], &mut self.none[places]);
        let mut target = Target::band(Rgba8888, NoDepth, size, first, pixels, depths)?;
        target.clear(BACKGROUND);
        Ok(target)
    }

    /// A copy of the pixels.
    pub(crate) fn kept(&self) -> Vec<u32> {
        let mut kept = vec![0; self.pixels.len()];
        kept.copy_from_slice(&self.pixels);
        kept
    }

    /// The pixels of a column and a row, and their places.
    pub(crate) fn places(&self) -> impl Iterator<Item = [u32; 2]> + use<> {
        let width = self.size[0];
        (0..index(self.pixels.len())).map(move |k| [k % width, k / width])
    }
}

/// The hash of pixels: FNV-1a of 32 bits over their words, from two beginnings. The driver of the page has the same.
#[must_use]
pub fn hash(pixels: &[u32]) -> u64 {
    let from = |basis: u32| pixels.iter().fold(basis, |hash, word| (hash ^ word).wrapping_mul(0x0100_0193));
    u64::from(from(0x811c_9dc5)) << 32 | u64::from(from(0x9747_b28c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_checked() {
        let mut canvas = Canvas::new();
        for size in [[0, 1], [641, 480], [u32::MAX, u32::MAX]] {
            assert_eq!(canvas.resize(size, 0..1), Err(SizeError(size)));
        }
        assert_eq!(canvas.resize([640, 480], 0..480), Ok(()));
        assert_eq!(canvas.pixels().len(), MAX_PIXELS);
    }

    #[test]
    fn hashes_tell_the_order() {
        assert_ne!(hash(&[1, 2]), hash(&[2, 1]));
        assert_eq!(hash(&[]), 0x811c_9dc5_9747_b28c);
    }
}
