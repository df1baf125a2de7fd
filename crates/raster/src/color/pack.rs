//! Pixels put side by side in place: the bytes to send, of a rectangle, and of pixels of less than a byte or two.
//!
//! As long as it is drawn, a pixel has bytes of its own, since threads, vector registers and blending want to reach it
//! alone. Afterwards a row or a whole band is packed, in the same memory.

use core::array::from_fn;
use core::cell::Cell;
use core::ops::Range;

/// The pixels of a rectangle, row by row in one piece, as a display and a DMA want them. `pixels` are rows of `width`,
/// from which `columns` and `rows` count; of these, as far as there are any. The rectangle's first row stays, and those
/// below move up to its end, over pixels that are sent already or not at all.
///
/// ```
/// use alberti_raster::color::pack;
///
/// let mut band = [11, 12, 13, 14, 21, 22, 23, 24, 31, 32, 33, 34];
/// assert_eq!(pack::rectangle(&mut band, 4, 1..3, 1..3), [22, 23, 32, 33]);
/// ```
///
/// Pixels that share bytes are packed after that: `pack::rgb444(pack::rectangle(..))`, of columns that are
/// [aligned](crate::Touched::aligned).
///
/// # Cost
/// Each row but the first is copied; of whole rows none is. A `u32`, of which a caller makes two pixels of 16 bits,
/// takes as long as one of these: 2.7 instructions on a Cortex-M4F, 4 on a Cortex-M0+.
pub fn rectangle<P: Copy>(
    pixels: &mut [P],
    width: usize,
    columns: Range<usize>,
    rows: Range<usize>,
) -> &mut [P] {
    let columns = columns.start..columns.end.min(width);
    let rows = rows.start..rows.end.min(pixels.len() / width.max(1));
    if columns.is_empty() || rows.is_empty() {
        return &mut [];
    }
    let (count, first) = (columns.len(), rows.start * width + columns.start);
    let pixels = pixels.get_mut(first..).unwrap_or_default();
    if count < width {
        // Cells, since a row may overlap the place that it moves to. Four at a time are few instructions for a loop.
        let pixels = Cell::from_mut(&mut *pixels).as_slice_of_cells();
        for row in 1..rows.len() {
            let part = |first: usize| pixels.get(first..first + count).unwrap_or_default().as_chunks::<4>();
            let ((from, last_from), (to, last_to)) = (part(row * width), part(row * count));
            for (to, from) in to.iter().zip(from) {
                let moved = from.each_ref().map(Cell::get);
                to.iter().zip(moved).for_each(|(to, pixel)| to.set(pixel));
            }
            last_to.iter().zip(last_from).for_each(|(to, from)| to.set(from.get()));
        }
    }
    pixels.get_mut(..rows.len() * count).unwrap_or_default()
}

/// Two pixels of [`Rgb444`](super::Rgb444) in three bytes, RRRRGGGG BBBBRRRR GGGGBBBB; an odd last one in two. Displays
/// may not take that one: [`Touched::aligned`](crate::Touched::aligned) has even columns.
///
/// # Cost
/// Two pixels: four loads, three stores, four operations. A pixel takes 6.5 instructions on a Cortex-M4F, 9.5 on a
/// Cortex-M0+.
pub fn rgb444(pixels: &mut [[u8; 2]]) -> &[u8] {
    let count = pixels.len();
    let bytes = pixels.as_flattened_mut();
    for pair in 0..count.div_ceil(2) {
        let at = |k: usize| bytes.get(4 * pair + k).copied().unwrap_or(0);
        let [high, low, next_high, next_low] = [at(0), at(1), at(2), at(3)];
        let packed = [high << 4 | low >> 4, low << 4 | next_high & 15, next_low];
        // Never beyond what was read.
        bytes.iter_mut().skip(3 * pair).zip(packed).for_each(|(byte, packed)| *byte = packed);
    }
    let length = (3 * count).div_ceil(2);
    bytes.get(..length).unwrap_or_default()
}

/// Two pixels of [`Grey4`](super::Grey4) in a byte, the first in the high half; each row of `width` begins a byte.
///
/// # Cost
/// A pixel: a load, a shift, an operation. A byte: a check and a store. A pixel takes 6 instructions on a Cortex-M4F, 9
/// on a Cortex-M0+.
pub fn grey4(pixels: &mut [u8], width: usize) -> &[u8] {
    packed::<2>(pixels, width)
}

/// Four pixels of [`Grey2`](super::Grey2) in a byte, the first in the highest bits; each row begins a byte.
///
/// # Cost
/// That of [`grey4`], with a byte for four pixels: 4 instructions a pixel, and 7.
pub fn grey2(pixels: &mut [u8], width: usize) -> &[u8] {
    packed::<4>(pixels, width)
}

/// Eight pixels of [`Grey1`](super::Grey1) in a byte, the first in the highest bit; each row begins a byte.
///
/// # Cost
/// That of [`grey4`], with a byte for eight pixels: 3.3 instructions a pixel, and 5.4.
pub fn grey1(pixels: &mut [u8], width: usize) -> &[u8] {
    packed::<8>(pixels, width)
}

/// So many pixels in a byte.
fn packed<const EACH: usize>(pixels: &mut [u8], width: usize) -> &[u8] {
    let (bits, width, mut length) = (const { 8 / EACH }, width.max(1), 0);
    for first in (0..pixels.len()).step_by(width) {
        let end = pixels.len().min(first + width);
        let mut from = first;
        while from < end {
            let group = pixels.get(from..end.min(from + EACH)).unwrap_or_default();
            // Nothing where a row ends in the middle of a byte.
            let end_of_row = || from_fn(|k| group.get(k).copied().unwrap_or(0));
            let whole: [u8; EACH] = group.first_chunk().copied().unwrap_or_else(end_of_row);
            let byte = whole.iter().fold(0, |byte, pixel| byte << bits | pixel);
            if let Some(place) = pixels.get_mut(length) {
                *place = byte;
            }
            (from, length) = (from + EACH, length + 1);
        }
    }
    pixels.get(..length).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn rectangles_are_copied_exactly() {
        for (width, height, more) in
            [(7, 5, 0), (14, 3, 0), (1, 4, 0), (4, 1, 0), (6, 3, 5), (3, 0, 2), (0, 0, 4)]
        {
            // Each place has a number of its own.
            let band: Vec<usize> = (0..width * height + more).collect();
            let ranges = |end: usize| (0..=end).flat_map(move |a| (0..=end + 2).map(move |b| a..b));
            for (columns, rows) in ranges(width).flat_map(|c| ranges(height).map(move |r| (c.clone(), r))) {
                let inside =
                    |k: &usize| width > 0 && columns.contains(&(k % width)) && rows.contains(&(k / width));
                let expected: Vec<usize> = (0..width * height).filter(inside).collect();
                let mut pixels = band.clone();
                let found = rectangle(&mut pixels, width, columns.clone(), rows.clone());
                assert_eq!(found, expected, "{columns:?} {rows:?} of {width} x {height}");
                // Of whole rows nothing is moved.
                assert!(
                    pixels == band || columns.start > 0 || columns.end < width,
                    "{columns:?} {rows:?} of {width} x {height}"
                );
            }
        }
        assert!(rectangle(&mut [0; 6], 3, usize::MAX..usize::MAX, 0..2).is_empty());
        assert_eq!(rectangle(&mut [1, 2, 3, 4], 2, 1..usize::MAX, 0..usize::MAX), [2, 4]);
    }

    /// Bits in a row, the highest first.
    fn bits(bytes: &[u8]) -> Vec<u8> {
        bytes.iter().flat_map(|byte| (0..8).rev().map(move |k| byte >> k & 1)).collect()
    }

    #[test]
    fn twelve_bits_follow_each_other() {
        for count in 0..7 {
            let colors: Vec<u16> = (0..count).map(|k| (k * 0x357 + 0x0c1) & 0xfff).collect();
            let mut pixels: Vec<[u8; 2]> = colors.iter().map(|color| color.to_be_bytes()).collect();
            let mut expected: Vec<u8> =
                colors.iter().flat_map(|color| (0..12).rev().map(move |k| (color >> k & 1) as u8)).collect();
            expected.resize(expected.len().next_multiple_of(8), 0);
            assert_eq!(bits(rgb444(&mut pixels)), expected, "{count}");
        }
    }

    #[test]
    fn rows_begin_a_byte() {
        type Pack = fn(&mut [u8], usize) -> &[u8];
        for (pack, bits_each) in [(grey4 as Pack, 4), (grey2, 2), (grey1, 1)] {
            for (width, rows) in [(1, 3), (5, 2), (8, 2), (13, 4), (7, 0)] {
                let mut pixels: Vec<u8> = (0..width * rows)
                    .map(|k| usize::to_le_bytes(k * 7 + k / 3)[0] & ((1 << bits_each) - 1))
                    .collect();
                let mut expected = Vec::new();
                for row in pixels.chunks(width) {
                    expected.extend(row.iter().flat_map(|p| (0..bits_each).rev().map(move |k| p >> k & 1)));
                    expected.resize(expected.len().next_multiple_of(8), 0);
                }
                assert_eq!(bits(pack(&mut pixels, width)), expected, "{bits_each} {width}");
            }
        }
    }
}
