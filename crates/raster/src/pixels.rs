//! Pixels of a target, row by row.

use core::mem::take;
use core::ops::Range;

/// Colours and depths.
pub(crate) type Pixels<'a, C, D> = (&'a mut [C], &'a mut [D]);

/// Pixels from one on, in its row and in those below.
pub(crate) struct Rows<'a, C, D> {
    pub(crate) colors: &'a mut [C],
    pub(crate) depths: &'a mut [D],
    /// Pixels and depths from a row to the next.
    pub(crate) strides: [usize; 2],
}

impl<'a, C, D> Rows<'a, C, D> {
    /// As many pixels as depths from the row on.
    #[inline(always)]
    pub(crate) fn pixels(self) -> Pixels<'a, C, D> {
        let count = self.colors.len().min(self.depths.len());
        (self.colors.get_mut(..count).unwrap_or_default(), self.depths.get_mut(..count).unwrap_or_default())
    }

    /// The same, for a while.
    #[inline(always)]
    pub(crate) fn row(&mut self) -> Pixels<'_, C, D> {
        Rows { colors: &mut *self.colors, depths: &mut *self.depths, strides: self.strides }.pixels()
    }

    /// Goes down one row.
    #[inline(always)]
    pub(crate) fn down(&mut self) {
        self.colors = take(&mut self.colors).get_mut(self.strides[0]..).unwrap_or_default();
        self.depths = take(&mut self.depths).get_mut(self.strides[1]..).unwrap_or_default();
    }
}

/// Gives the first of some pixels a value, 16 at a time: small cores store words then, and several with one
/// instruction.
pub(crate) fn fill<T: Copy>(pixels: &mut [T], count: usize, value: T) {
    let pixels = pixels.split_at_mut_checked(count).map_or(&mut [] as &mut [T], |(pixels, _)| pixels);
    let (chunks, rest) = pixels.as_chunks_mut();
    chunks.iter_mut().for_each(|chunk| *chunk = [value; 16]);
    rest.fill(value);
}

/// The columns or rows in both, at a place within the first also where nothing is left.
#[inline(always)]
pub(crate) fn narrowed(a: &Range<i32>, b: Range<i32>) -> Range<i32> {
    let start = a.start.max(b.start).min(a.end);
    start..a.end.min(b.end).max(start)
}
