//! The covered run of each row, from the integer edges.
//!
//! A row meets a triangle in one run of samples [start, end). Along the row an edge whose value grows to the right
//! bounds the run from the left, one whose value falls bounds it from the right:
//!
//! ```text
//!         start        end
//!      . . | * * * * * | . .        *  value + bias >= 0 for all three edges
//! ```
//!
//! From row to row each bound moves by the same fraction of a column, whose integer part and remainder are found once
//! by division. After that a row costs a few additions and no branch. Inside a span no coverage test is needed.

use crate::edge::{Edge, EdgeInt};
use crate::paint::as_it_stands;

/// The covered samples of one row, in columns counted from the left of the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The first covered column.
    pub start: i32,
    /// One past the last covered column; not greater than `start` when the row has none.
    pub end: i32,
}

impl Span {
    /// Counted from `columns` columns farther to the left.
    #[inline(always)]
    pub(crate) fn shifted(self, columns: i32) -> Self {
        Self { start: self.start + columns, end: self.end + columns }
    }
}

/// The covered samples of a triangle's rows from the top, found in the way that suits its box.
pub(crate) enum RowSpans<I> {
    /// Edges with their biases at a row's first sample: each sample is tested.
    Tested { edges: [Edge<I>; 3], width: i32 },
    /// A walker that follows where the edges cross the rows.
    Walked { walker: SpanWalker<I>, walked: i32 },
}

/// The columns of the widest box in which testing is cheaper than the divisions that following takes.
const TESTED: i32 = 8;

impl<I: EdgeInt> RowSpans<I> {
    /// Starts as [`SpanWalker::new`] does.
    #[inline(always)]
    pub(crate) fn new(edges: &[Edge<I>; 3], width: i32, rows: [i32; 2]) -> Self {
        // Only in 32 bits: in 64 narrow boxes are higher than any target, or in fixed point mostly small.
        if const { size_of::<I>() == size_of::<i32>() } && width <= TESTED {
            Self::Tested { edges: edges.map(|e| Edge { value: e.value + e.bias, ..e }), width }
        } else {
            Self::Walked { walker: SpanWalker::new(edges, width, rows), walked: 0 }
        }
    }

    /// The next row's span; `start` is not less than `end` when it covers nothing.
    #[inline(always)]
    pub(crate) fn next_row(&mut self) -> Span {
        match self {
            Self::Tested { edges: [a, b, c], width } if const { size_of::<I>() == size_of::<i32>() } => {
                let zero = I::from(0);
                let mut at = [a.value, b.value, c.value];
                let (mut span, mut column) = (Span { start: *width, end: 0 }, 0);
                while column < *width {
                    as_it_stands();
                    if at[0] >= zero && at[1] >= zero && at[2] >= zero {
                        span.start = span.start.min(column);
                        span.end = column + 1;
                    }
                    at = [at[0] + a.step_x, at[1] + b.step_x, at[2] + c.step_x];
                    column += 1;
                }
                for edge in [a, b, c] {
                    edge.value = edge.value + edge.step_y;
                }
                span
            }
            Self::Tested { .. } => Span { start: 0, end: 0 },
            Self::Walked { walker, walked } => {
                let span = walker.span();
                walker.next_row();
                *walked += 1;
                if *walked > walker.rows() { Span { start: 0, end: 0 } } else { span }
            }
        }
    }
}

/// The place along the row where an edge's condition flips: the first column at which its function is not negative.
///
/// For an edge that bounds from the right the function is turned into -value-1, which is not negative exactly where
/// the edge's own value is negative: the first column outside. A horizontal edge bounds rows, not columns, and gets a
/// crossing that never moves. Where the edge is, columns fit 32 bits; in other rows nobody asks, and they may wrap.
#[derive(Clone, Copy, Debug)]
struct Crossing<I> {
    column: i32,
    /// The function at `column`, less than `step`.
    value: I,
    step: I,
    /// The function's increment for a row: `whole * step + part`, with 0 <= `part` < `step`.
    whole: i32,
    part: I,
}

impl<I: EdgeInt> Crossing<I> {
    /// The crossing so many rows below the edge's reference sample.
    fn new(edge: &Edge<I>, rows: i32) -> Self {
        let [zero, one] = [I::from(0), I::from(1)];
        let value = edge.value + edge.bias + edge.step_y * I::from(rows);
        let (value, step, step_y) = match edge.step_x >= zero {
            _ if edge.step_x == zero => (zero, one, zero),
            true => (value, edge.step_x, edge.step_y),
            false => (zero - value - one, zero - edge.step_x, zero - edge.step_y),
        };
        let (columns, value) = value.divided(step);
        let (whole, part) = step_y.divided(step);
        Self { column: columns.to_i32().wrapping_neg(), value, step, whole: whole.to_i32(), part }
    }

    #[inline(always)]
    fn next_row(&mut self) {
        let value = self.value + self.part;
        let carry = value >= self.step;
        self.value = if carry { value - self.step } else { value };
        self.column = self.column.wrapping_sub(self.whole).wrapping_sub(i32::from(carry));
    }
}

/// Walks the rows of a triangle's box from the top.
///
/// One side of a triangle is one edge; the other may have a second below the middle vertex.
#[derive(Clone, Copy, Debug)]
pub struct SpanWalker<I> {
    left: Crossing<I>,
    right: Crossing<I>,
    /// The second edge, where its first row is, and its side.
    second: Crossing<I>,
    second_is_left: bool,
    /// The number of rows before that.
    above: i32,
    width: i32,
    rows: i32,
}

impl<I: EdgeInt> SpanWalker<I> {
    /// Starts at the row of the edges' reference sample, which is column 0 of a box of `width` columns. The edges run
    /// clockwise, the last one from the topmost vertex, of two the left one. Of the rows from there on, so many have
    /// their samples above the triangle's middle vertex, and so many between its topmost and its lowest. The bounds of
    /// [`Edge::new`] hold for all of the box.
    #[must_use]
    #[inline(never)]
    pub fn new([second, left, right]: &[Edge<I>; 3], width: i32, [above, rows]: [i32; 2]) -> Self {
        let zero = I::from(0);
        let second_is_left = second.step_x > zero;
        // Of the rows only the last can be outside of a horizontal edge: when it lies exactly on a lower one.
        let cut =
            second.step_x == zero && second.value + second.bias + second.step_y * I::from(rows - 1) < zero;
        let begun = above <= 0;
        let above = above.min(rows).max(0);
        Self {
            left: Crossing::new(if begun && second_is_left { second } else { left }, 0),
            right: Crossing::new(if begun && !second_is_left { second } else { right }, 0),
            second: Crossing::new(second, above),
            second_is_left,
            above,
            width,
            rows: rows - i32::from(cut),
        }
    }

    /// The number of rows that have spans, empty ones included.
    #[must_use]
    #[inline]
    pub fn rows(&self) -> i32 {
        self.rows
    }

    /// The current row's span. An empty one may lie outside of the box; past [`rows`](Self::rows) it is anything.
    #[must_use]
    #[inline]
    pub fn span(&self) -> Span {
        Span { start: self.left.column.max(0), end: self.right.column.min(self.width) }
    }

    /// Goes down one row.
    #[inline]
    pub fn next_row(&mut self) {
        self.left.next_row();
        self.right.next_row();
        self.above -= 1;
        if self.above == 0 {
            *(if self.second_is_left { &mut self.left } else { &mut self.right }) = self.second;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every triangle on a small grid of subpixels: the span is the samples where all three edges agree.
    #[test]
    fn spans_are_where_all_edges_agree() {
        let corners = [-5, 0, 3, 8, 17, 24, 59];
        let vertices = || corners.into_iter().flat_map(|x| corners.map(|y| [x, y]));
        let mut covered = 0;
        for a in vertices() {
            for b in vertices() {
                for c in vertices() {
                    // The rows between the highest and the lowest vertex, as the walker demands.
                    let sample = |y: i32| (y - 8) >> 4;
                    let first = (sample(a[1].min(b[1]).min(c[1]) + 15)).max(0);
                    let rows = sample(a[1].max(b[1]).max(c[1])) + 1 - first;
                    let mut heights = [a, b, c].map(|[_, y]| y);
                    heights.sort_unstable();
                    let above = sample(heights[1] + 15) - first;
                    if (b[1], b[0]) < (a[1], a[0]) || (c[1], c[0]) < (a[1], a[0]) {
                        continue;
                    }
                    let edge = |a, b| Edge::<i32>::new(a, b, [8, first * 16 + 8], 16);
                    let edges = [edge(b, c), edge(c, a), edge(a, b)];
                    let area = edges.iter().map(|e| e.value).sum::<i32>();
                    if area <= 0 || rows < 1 {
                        continue;
                    }
                    let mut walker = SpanWalker::new(&edges, 3, [above, rows]);
                    for row in 0..rows {
                        let span = walker.span();
                        let span = if row < walker.rows() { span } else { Span { start: 0, end: 0 } };
                        for column in 0..3 {
                            let inside = edges
                                .iter()
                                .all(|e| e.value + e.bias + e.step_x * column + e.step_y * row >= 0);
                            assert_eq!((span.start..span.end).contains(&column), inside, "{a:?} {b:?} {c:?}");
                            covered += u32::from(inside);
                        }
                        walker.next_row();
                    }
                }
            }
        }
        assert!(covered > 5_000);
    }
}
