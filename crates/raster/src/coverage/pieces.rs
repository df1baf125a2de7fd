//! The parts of an edge in the pixels that it passes.

use core::ops::{Add, AddAssign, Mul, Neg, Range, Shl, Shr, Sub, SubAssign};

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
pub(super) const BITS: u32 = 16;
/// The parts of a pixel.
const ONE: i32 = 1 << BITS;

/// A number of parts of a pixel: `i32` for edges of up to [`SHORT`] pixels, `i64` for all.
pub(super) trait Whole:
    Copy
    + Ord
    + From<i32>
    + Into<i64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + Shl<u32, Output = Self>
    + Shr<u32, Output = Self>
    + AddAssign
    + SubAssign
{
    /// A number that fits.
    fn of(number: i64) -> Self;
    /// A number that fits 32 bits.
    fn narrow(self) -> i32;
}

impl Whole for i32 {
    #[expect(clippy::cast_possible_truncation, reason = "numbers that fit")]
    #[inline(always)]
    fn of(number: i64) -> Self {
        number as i32
    }
    #[inline(always)]
    fn narrow(self) -> i32 {
        self
    }
}

impl Whole for i64 {
    #[inline(always)]
    fn of(number: i64) -> Self {
        number
    }
    #[expect(clippy::cast_possible_truncation, reason = "columns, rows and parts of a pixel")]
    #[inline(always)]
    fn narrow(self) -> i32 {
        self as i32
    }
}

/// The sides of the box around an edge of which all numbers fit 32 bits, in pixels: a quarter of what 2^31 parts are.
pub(super) const SHORT: u32 = 1 << 13;

/// An edge that is not level, from its upper end to its lower one, in subpixels.
pub(super) struct Way {
    pub(super) ends: [[i32; 2]; 2],
    pub(super) bits: u32,
    pub(super) steep: bool,
}

impl Way {
    /// The pixels in these columns and rows that the edge passes: see [`Edge::pieces`](super::Edge::pieces). Numbers
    /// are counted from the pixel of the upper end.
    #[inline(always)]
    pub(super) fn pieces<N: Whole>(self, [columns, rows]: &[Range<i32>; 2], sink: &mut impl FnMut(Piece)) {
        let Self { ends, bits, steep } = self;
        let origin = ends[0].map(|c| c >> bits);
        let [[x0, y0], [x1, y1]] = ends.map(|[x, y]| {
            let local = [
                i64::from(x) - (i64::from(origin[0]) << bits),
                i64::from(y) - (i64::from(origin[1]) << bits),
            ];
            local.map(|c| N::of(c) << (BITS - bits))
        });
        let [dx, dy] = [0, 1].map(|axis: usize| i64::from(ends[1][axis]) - i64::from(ends[0][axis]));
        let [zero, one] = [0, 1].map(N::from);
        let local = |range: &Range<i32>, origin: i32| {
            let [start, end] = [range.start, range.end].map(|c| N::from(c.saturating_sub(origin)));
            start..end
        };
        let (columns, rows) = (local(columns, origin[0]), local(rows, origin[1]));
        let first = zero.max(rows.start);
        let last = ((y1 - one).max(y0) >> BITS).min(rows.end - one);
        if first > last {
            return;
        }
        let row_of = Row { columns, origin, steep };
        // The sides of rows that are crossed in sight.
        let top = if y0 < first << BITS { first } else { first + one };
        let crossed = ((y1 - one) >> BITS).min(last + one) - top + one;
        let to_top: i64 = ((top << BITS) - y0).into();
        let mut crossings = Steps::<N>::new(dx * to_top, dx << BITS, dy, crossed.narrow());
        let mut from = if top == first { [x0 + crossings.next(), first << BITS] } else { [x0, y0] };
        let mut row = first;
        while row <= last {
            let bottom = (row + one) << BITS;
            let to = if bottom < y1 { [x0 + crossings.next(), bottom] } else { [x1, y1] };
            row_of.pieces(row, [from, to], sink);
            from = to;
            row += one;
        }
    }
}

/// The rows of an edge: all that they have in common.
struct Row<N> {
    columns: Range<N>,
    origin: [i32; 2],
    steep: bool,
}

impl<N: Whole> Row<N> {
    /// The pieces of a row, in which the edge is a straight line.
    #[inline(always)]
    fn pieces(&self, row: N, [from, to]: [[N; 2]; 2], sink: &mut impl FnMut(Piece)) {
        let one = N::from(1);
        let height = to[1] - from[1];
        let leftwards = to[0] < from[0];
        let (left, right) = if leftwards { (to[0], from[0]) } else { (from[0], to[0]) };
        // The pixels of its ends; a right end on a side is in the pixel left of it.
        let [first, last] = [left, (right - one).max(left)].map(|x| x >> BITS);
        let Range { start, end } = self.columns;
        let place = |column: N| {
            let [x, y] = self.origin;
            [column.narrow().wrapping_add(x), row.narrow().wrapping_add(y)]
        };
        let outside = |column: N, height: N| Piece {
            place: place(column),
            height: height.narrow(),
            left: 0,
            middle: None,
        };
        if last < start {
            return sink(outside(start, height));
        }
        if first >= end {
            return sink(outside(end, height));
        }
        // Heights are from the left end on.
        let next = if first < start { start } else { first + one };
        let crossed = (last + one).min(end + one) - next;
        let (all, to_next): (i64, i64) = (height.into(), ((next << BITS) - left).into());
        let width: i64 = (right - left).into();
        let mut crossings = Steps::<N>::new(all * to_next, all << BITS, width, crossed.narrow());
        let (mut x, mut done) = (left, N::from(0));
        if first < start {
            (x, done) = (start << BITS, crossings.next());
            sink(outside(start, done));
        }
        let mut column = first.max(start);
        while column <= last.min(end - one) {
            let side = (column + one) << BITS;
            let (to_x, to_done) = if column < last { (side, crossings.next()) } else { (right, height) };
            let high = to_done - done;
            let twice = (x - (column << BITS)) + (to_x - (column << BITS));
            let middle = || {
                let origin = self.origin.map(|c| i64::from(c) << BITS);
                let [x, done, y]: [i64; 3] = [
                    (x + to_x).into(),
                    (done + to_done).into(),
                    if leftwards { to[1] } else { from[1] }.into(),
                ];
                match (self.steep, leftwards) {
                    (false, _) => origin[0] + (x >> 1),
                    (true, true) => origin[1] + y - (done >> 1),
                    (true, false) => origin[1] + y + (done >> 1),
                }
            };
            // At most 2^16 times 2^17, and a half more.
            let area = (i64::from(high.narrow()) * i64::from(twice.narrow()) + i64::from(ONE)) >> (BITS + 1);
            sink(Piece {
                place: place(column),
                height: high.narrow(),
                left: area.narrow(),
                middle: Some(middle()),
            });
            (x, done) = (to_x, to_done);
            column += one;
        }
        if last >= end {
            sink(outside(end, height - done));
        }
    }
}

/// Quotients of a numerator that grows by the same each time, to the nearest, halves upwards.
pub(super) struct Steps<N> {
    quotient: N,
    rest: N,
    step: N,
    step_rest: N,
    divisor: N,
}

impl<N: Whole> Steps<N> {
    /// The first `count` of them; none are asked for if it is not above 0. The divisor is above 0 then, and it and the
    /// quotients fit.
    #[inline(always)]
    pub(super) fn new(start: i64, step: i64, divisor: i64, count: i32) -> Self {
        let (quotient, rest) =
            if count > 0 && divisor > 0 { divided(start + divisor / 2, divisor) } else { (0, 0) };
        let (step, step_rest) = if count > 1 && divisor > 0 { divided(step, divisor) } else { (0, 0) };
        let [quotient, rest, step, step_rest, divisor] =
            [quotient, rest, step, step_rest, divisor].map(N::of);
        Self { quotient, rest, step, step_rest, divisor }
    }

    #[inline(always)]
    pub(super) fn next(&mut self) -> N {
        let quotient = self.quotient;
        self.quotient += self.step;
        self.rest += self.step_rest;
        if self.rest >= self.divisor {
            self.rest -= self.divisor;
            self.quotient += N::from(1);
        }
        quotient
    }
}

/// The quotient by a number above 0, rounded down, and what is left. Most edges are short, so that 32 bits hold them.
#[inline(always)]
fn divided(x: i64, divisor: i64) -> (i64, i64) {
    let (Ok(magnitude), Ok(by)) = (u32::try_from(x.unsigned_abs()), u32::try_from(divisor)) else {
        return divided_wide(x, divisor);
    };
    let (quotient, rest) = match (magnitude.checked_div(by), magnitude.checked_rem(by)) {
        (Some(quotient), Some(rest)) => (i64::from(quotient), i64::from(rest)),
        _ => return (0, 0),
    };
    match (x < 0, rest) {
        (false, _) => (quotient, rest),
        (true, 0) => (-quotient, 0),
        (true, _) => (-quotient - 1, divisor - rest),
    }
}

/// Not inlined, as it is long and seldom needed.
#[inline(never)]
fn divided_wide(x: i64, divisor: i64) -> (i64, i64) {
    (x.div_euclid(divisor), x.rem_euclid(divisor))
}
