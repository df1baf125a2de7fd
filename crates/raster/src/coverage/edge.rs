//! An edge, from pixel to pixel.

use core::ops::Range;

/// An edge on the screen, in subpixels, from its upper end to its lower one; a horizontal one from left to right. It is
/// the same for both triangles at it, so that roundings cancel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    ends: [[i32; 2]; 2],
}

/// The part of an edge in one pixel, in 2^-16 of pixels and of their areas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Piece {
    pub(super) place: [i32; 2],
    /// Its height, at most a pixel's.
    pub(super) height: i32,
    /// The area on its left.
    pub(super) left: i32,
    /// Its middle along the edge's longer axis. None for all that is left or right of the columns.
    pub(super) middle: Option<i64>,
}

/// Bits of a pixel's parts.
const BITS: u32 = 16;
/// The parts of a pixel.
const ONE: i64 = 1 << BITS;

impl Edge {
    /// The edge between two ends, and whether the first is its upper one.
    pub(super) fn new([a, b]: [[i32; 2]; 2]) -> (Self, bool) {
        let down = [a[1], a[0]] <= [b[1], b[0]];
        (Self { ends: if down { [a, b] } else { [b, a] } }, down)
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
    pub(super) fn pieces(self, bits: u32, [columns, rows]: &[Range<i32>; 2], mut sink: impl FnMut(Piece)) {
        let parts = |c: i32| i64::from(c) << (BITS - bits);
        let [[x0, y0], [x1, y1]] = self.ends.map(|end| end.map(parts));
        let [dx, dy] = [0, 1].map(|axis: usize| i64::from(self.ends[1][axis] - self.ends[0][axis]));
        let steep = self.is_steep();
        let first = (y0 >> BITS).max(rows.start.into());
        let last = ((y1 - 1).max(y0) >> BITS).min(i64::from(rows.end) - 1);
        // The sides of rows that are crossed in sight.
        let top = if y0 < first << BITS { first } else { first + 1 };
        let crossed = ((y1 - 1) >> BITS).min(last + 1) - top + 1;
        let mut crossings = Steps::new(dx * ((top << BITS) - y0), dx << BITS, dy, crossed);
        let mut from = if top == first { [x0 + crossings.next(), first << BITS] } else { [x0, y0] };
        for row in first..=last {
            let bottom = (row + 1) << BITS;
            let to = if bottom < y1 { [x0 + crossings.next(), bottom] } else { [x1, y1] };
            row_pieces(row, [from, to], columns, steep, &mut sink);
            from = to;
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
        let mut crossings = Steps::new(start, dx << bits, divisor, end - first);
        for row in first..end {
            let column = crossings.next().clamp(columns.start.into(), columns.end.into());
            sink([column, row].map(whole));
        }
    }
}

/// The pieces of a row, in which the edge is a straight line.
#[inline(always)]
fn row_pieces(
    row: i64,
    [from, to]: [[i64; 2]; 2],
    columns: &Range<i32>,
    steep: bool,
    sink: &mut impl FnMut(Piece),
) {
    let height = to[1] - from[1];
    let leftwards = to[0] < from[0];
    let (left, right) = if leftwards { (to[0], from[0]) } else { (from[0], to[0]) };
    // The pixels of its ends; a right end on a side is in the pixel left of it.
    let [first, last] = [left, (right - 1).max(left)].map(|x| x >> BITS);
    let [start, end] = [columns.start, columns.end].map(i64::from);
    let outside = |column: i32, height: i64| {
        let place = [column, whole(row)];
        Piece { place, height: whole(height), left: 0, middle: None }
    };
    if last < start {
        return sink(outside(columns.start, height));
    }
    if first >= end {
        return sink(outside(columns.end, height));
    }
    // Heights are from the left end on.
    let next = if first < start { start } else { first + 1 };
    let crossed = (last + 1).min(end + 1) - next;
    let mut crossings = Steps::new(height * ((next << BITS) - left), height << BITS, right - left, crossed);
    let (mut x, mut done) = (left, 0);
    if first < start {
        (x, done) = (start << BITS, crossings.next());
        sink(outside(columns.start, done));
    }
    for column in first.max(start)..=last.min(end - 1) {
        let side = (column + 1) << BITS;
        let (to_x, to_done) = if column < last { (side, crossings.next()) } else { (right, height) };
        let high = to_done - done;
        let twice = x + to_x - (column << (BITS + 1));
        let middle = if !steep {
            (x + to_x) >> 1
        } else if leftwards {
            to[1] - ((done + to_done) >> 1)
        } else {
            from[1] + ((done + to_done) >> 1)
        };
        sink(Piece {
            place: [column, row].map(whole),
            height: whole(high),
            left: whole((high * twice + ONE) >> (BITS + 1)),
            middle: Some(middle),
        });
        (x, done) = (to_x, to_done);
    }
    if last >= end {
        sink(outside(columns.end, height - done));
    }
}

/// A number that fits.
#[expect(clippy::cast_possible_truncation, reason = "columns, rows and parts of a pixel")]
#[inline(always)]
fn whole(number: i64) -> i32 {
    number as i32
}

/// Quotients of a numerator that grows by the same each time, to the nearest, halves upwards.
struct Steps {
    quotient: i64,
    rest: i64,
    step: i64,
    step_rest: i64,
    divisor: i64,
}

impl Steps {
    /// The first `count` of them; none are asked for if it is not above 0. The divisor is above 0 then.
    #[inline(always)]
    fn new(start: i64, step: i64, divisor: i64, count: i64) -> Self {
        let divided = |x: i64| (x.div_euclid(divisor), x.rem_euclid(divisor));
        let (quotient, rest) = if count > 0 && divisor > 0 { divided(start + divisor / 2) } else { (0, 0) };
        let (step, step_rest) = if count > 1 && divisor > 0 { divided(step) } else { (0, 0) };
        Self { quotient, rest, step, step_rest, divisor }
    }

    #[inline(always)]
    fn next(&mut self) -> i64 {
        let quotient = self.quotient;
        self.quotient += self.step;
        self.rest += self.step_rest;
        if self.rest >= self.divisor {
            self.rest -= self.divisor;
            self.quotient += 1;
        }
        quotient
    }
}
