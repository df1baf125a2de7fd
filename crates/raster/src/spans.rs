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
//! From row to row each bound walks to its new place by additions, a few columns at most; farther ones, which only edges
//! near the horizontal need, are found by a division. Inside a span no coverage test is needed.

use crate::edge::{Edge, EdgeInt};

/// The covered samples of one row, in columns counted from the left of the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The first covered column.
    pub start: i32,
    /// One past the last covered column; not greater than `start` when the row has none.
    pub end: i32,
}

/// Where an edge's condition flips along the row: the first column at which `value >= 0`, with `step` >= 0.
///
/// For an edge that bounds from the right the function is turned into -value-1, which is not negative exactly where
/// the edge's own value is negative: the first column outside.
#[derive(Clone, Copy, Debug)]
struct Crossing<I> {
    column: i32,
    value: I,
    step: I,
    step_y: I,
    from_left: bool,
}

impl<I: EdgeInt> Crossing<I> {
    #[inline]
    fn new(edge: &Edge<I>) -> Self {
        let zero = I::from(0);
        let value = edge.value + edge.bias;
        let from_left = edge.step_x >= zero;
        if from_left {
            Self { column: 0, value, step: edge.step_x, step_y: edge.step_y, from_left }
        } else {
            let value = zero - value - I::from(1);
            Self { column: 0, value, step: zero - edge.step_x, step_y: zero - edge.step_y, from_left }
        }
    }

    /// Goes to the crossing of the current row, within columns [0, width]. A step of 0 goes to one of the ends.
    #[inline]
    fn settle(&mut self, width: i32) {
        let zero = I::from(0);
        if self.value < zero {
            for _ in 0..WALK {
                if self.value >= zero || self.column == width {
                    return;
                }
                self.go(1);
            }
            if self.value < zero {
                // The least n with value + n step >= 0.
                let room = width - self.column;
                self.go(self.at_most(room, self.step - I::from(1) - self.value));
            }
        } else {
            for _ in 0..WALK {
                if self.value < self.step || self.column == 0 {
                    return;
                }
                self.go(-1);
            }
            if self.value >= self.step {
                // The greatest n with value - n step >= 0.
                self.go(-self.at_most(self.column, self.value));
            }
        }
    }

    #[inline]
    fn go(&mut self, columns: i32) {
        self.value = self.value + self.step * I::from(columns);
        self.column += columns;
    }

    /// `distance / step`, but no more than `room`.
    #[inline]
    fn at_most(&self, room: i32, distance: I) -> i32 {
        if self.step == I::from(0) { room } else { (distance / self.step).min(I::from(room)).to_columns() }
    }
}

/// How many columns a bound walks before a division is quicker.
const WALK: usize = 3;

/// Walks the rows of a triangle's box from the top.
#[derive(Clone, Copy, Debug)]
pub struct SpanWalker<I> {
    crossings: [Crossing<I>; 3],
    width: i32,
}

impl<I: EdgeInt> SpanWalker<I> {
    /// Starts at the row of the edges' reference sample, which is column 0 of a box of `width` columns.
    #[must_use]
    #[inline]
    pub fn new(edges: &[Edge<I>; 3], width: i32) -> Self {
        Self {
            crossings: [Crossing::new(&edges[0]), Crossing::new(&edges[1]), Crossing::new(&edges[2])],
            width,
        }
    }

    /// The current row's span.
    #[inline]
    pub fn span(&mut self) -> Span {
        let mut span = Span { start: 0, end: self.width };
        for crossing in &mut self.crossings {
            crossing.settle(self.width);
            if crossing.from_left {
                span.start = span.start.max(crossing.column);
            } else {
                span.end = span.end.min(crossing.column);
            }
        }
        span
    }

    /// Goes down one row.
    #[inline]
    pub fn next_row(&mut self) {
        for crossing in &mut self.crossings {
            crossing.value = crossing.value + crossing.step_y;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every triangle on a small grid of subpixels: the span is the samples where all three edges agree.
    #[test]
    fn spans_are_where_all_edges_agree() {
        let corners = [-5, 0, 3, 8, 24, 37];
        let vertices = || corners.into_iter().flat_map(|x| corners.map(|y| [x, y]));
        let mut covered = 0;
        for a in vertices() {
            for b in vertices() {
                for c in vertices() {
                    let edge = |a, b| Edge::<i32>::new(a, b, [8, 8], 16);
                    let edges = [edge(b, c), edge(c, a), edge(a, b)];
                    if edges.iter().map(|e| e.value).sum::<i32>() <= 0 {
                        continue;
                    }
                    let mut walker = SpanWalker::new(&edges, 3);
                    for row in 0..3 {
                        let span = walker.span();
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
        assert!(covered > 10_000);
    }
}
