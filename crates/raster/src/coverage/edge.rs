//! An edge, from pixel to pixel.

use super::edges::Place;
use super::pieces::{BITS, Piece, SHORT, Steps, Way};
use core::ops::Range;

/// An edge on the screen, in subpixels, from its upper end to its lower one; a horizontal one from left to right. It is
/// the same for both triangles at it, so that roundings cancel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    ends: [[i32; 2]; 2],
}

impl Edge {
    /// The edge between two ends, and whether the first is its upper one.
    pub(super) fn new([a, b]: [[i32; 2]; 2]) -> (Self, bool) {
        let down = [a[1], a[0]] <= [b[1], b[0]];
        (Self { ends: if down { [a, b] } else { [b, a] } }, down)
    }

    /// A number in which edges near one another differ.
    #[inline(always)]
    pub(super) fn hash(self) -> u32 {
        let [[x0, y0], [x1, y1]] = self.ends.map(|end| end.map(i32::cast_unsigned));
        let mixed = (x0 ^ y1.rotate_left(16)).wrapping_add(x1 ^ y0.rotate_left(16));
        mixed.wrapping_mul(0x9e37_79b1)
    }

    /// The words of an edge that waits and counts so often, and the edge of such words.
    #[inline(always)]
    pub(super) fn wait(self, times: i32) -> Place {
        let [[x0, y0], [x1, y1]] = self.ends;
        [x0, y0, x1, y1, times]
    }

    #[inline(always)]
    pub(super) fn waiting([x0, y0, x1, y1, times]: Place) -> (Self, i32) {
        (Self { ends: [[x0, y0], [x1, y1]] }, times)
    }

    /// Whether both are one edge. Without branches: a comparison of arrays is a call.
    #[inline(always)]
    pub(super) fn is(self, other: Self) -> bool {
        let [[a, b], [c, d]] = self.ends;
        let [[e, f], [g, h]] = other.ends;
        (a ^ e) | (b ^ f) | (c ^ g) | (d ^ h) == 0
    }

    /// Whether it has no height.
    pub(super) fn is_level(self) -> bool {
        let [[_, y0], [_, y1]] = self.ends;
        y0 == y1
    }

    /// Whether the height is more than the width.
    pub(super) fn is_steep(self) -> bool {
        let [[x0, y0], [x1, y1]] = self.ends;
        x0.abs_diff(x1) < y0.abs_diff(y1)
    }

    /// The weights of the upper and the lower end at a place on the longer axis, in pixels' parts.
    pub(super) fn weights(self, middle: i64, bits: u32) -> [i32; 2] {
        let axis = usize::from(self.is_steep());
        let [from, to] = self.ends.map(|end| end[axis]);
        let place = i32::try_from(middle >> (BITS - bits)).unwrap_or(from);
        let length = (to - from).abs();
        let far = (if to < from { from - place } else { place - from }).clamp(0, length);
        [length - far, far]
    }

    /// The pixels in these columns and rows that the edge passes, row by row, each once. The part left of the columns
    /// comes as a piece of the first, with no area. The part right of them is one of the column after the last.
    ///
    /// ```text
    ///    from _            x where the edge crosses rows and y where it crosses columns are rounded to the nearest
    ///        |\|    |      2^-16, so it is drawn as a line of as many straight pieces.
    ///     ---+-*----+---
    ///        |  \   |
    ///        |   \__|_ to
    /// ```
    #[inline(always)]
    pub(super) fn pieces(self, bits: u32, limits: &[Range<i32>; 2], mut sink: impl FnMut(Piece)) {
        let [[x0, y0], [x1, y1]] = self.ends;
        let way = Way { ends: self.ends, bits, steep: self.is_steep() };
        if x0.abs_diff(x1) | y0.abs_diff(y1) < SHORT << bits {
            way.pieces::<i32>(limits, &mut sink);
        } else {
            way.pieces::<i64>(limits, &mut sink);
        }
    }

    /// In each row whose centres are between the ends, the first pixel whose centre is right of the edge. If that is
    /// left of the columns it is their first, and if it is right of them the one after their last.
    ///
    /// It is the top-left rule: centres on the edge are on its right.
    pub(super) fn centres(
        self,
        bits: u32,
        [columns, rows]: &[Range<i32>; 2],
        mut sink: impl FnMut([i32; 2]),
    ) {
        let (one, half) = (1_i64 << bits, 1_i64 << bits >> 1);
        let [[x0, y0], [x1, y1]] = self.ends.map(|end| end.map(i64::from));
        let [first, end] = [y0, y1].map(|y| (y + half - 1) >> bits);
        let (first, end) = (first.max(rows.start.into()), end.min(rows.end.into()));
        if first >= end {
            return;
        }
        let (dx, dy) = (x1 - x0, y1 - y0);
        // Rounded up: to the nearest after a half more, less the least there is.
        let divisor = dy << bits;
        let start = (x0 - half) * dy + dx * (first * one + half - y0) + (divisor - 1 - divisor / 2);
        let mut crossings = Steps::<i64>::new(start, dx << bits, divisor, whole(end - first));
        for row in first..end {
            let column = crossings.next().clamp(columns.start.into(), columns.end.into());
            sink([column, row].map(whole));
        }
    }
}

/// A number that fits.
#[expect(clippy::cast_possible_truncation, reason = "columns and rows")]
#[inline(always)]
fn whole(number: i64) -> i32 {
    number as i32
}
