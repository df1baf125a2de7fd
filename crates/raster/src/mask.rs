//! The covered samples of each row of a narrow box, by testing all of them: no division, and no branch on where they
//! lie.

use crate::edge::Edge;
use crate::paint::aligned;
use alberti_math::lanes::Lanes;
use core::ops::Range;

/// The lowest 1 to 32 bits.
#[inline(always)]
fn lowest(bits: i32) -> u32 {
    u32::MAX >> ((32 - bits) & 31)
}

/// A row of a triangle's box, its three edge functions at the first lanes, and the increments to the others.
pub(crate) struct RowMask<L: Lanes> {
    lanes: L,
    /// The columns that are in the box.
    inside: u32,
    groups: i32,
    /// The functions plus their biases at the first lanes.
    values: [L::Int; 3],
    /// The increments for a group of lanes to the right, and for a row down.
    over: [L::Int; 3],
    down: [L::Int; 3],
    bias: [L::Int; 3],
    /// The edges in the first row at the lanes' first column, and that column and row.
    edges: [Edge<i32>; 3],
    first: [i32; 2],
}

impl<L: Lanes> RowMask<L> {
    /// The row of the edges' reference sample, which is in the column where the lanes begin. Up to 32 of them reach to
    /// before the end of the box's columns.
    #[inline(always)]
    pub(crate) fn new(lanes: L, edges: [Edge<i32>; 3], columns: Range<i32>, row: i32) -> Self {
        let [a, b, c] = &edges;
        let left = aligned::<L>(columns.start);
        let (before, end) = (columns.start - left, columns.end - left);
        let over = |e: &Edge<i32>| lanes.int(e.step_x.wrapping_mul(L::STEP));
        Self {
            lanes,
            inside: lowest(end) & (u32::MAX << before),
            groups: (end + L::STEP - 1) / L::STEP,
            values: [
                lanes.int_ramp(a.value + a.bias, a.step_x),
                lanes.int_ramp(b.value + b.bias, b.step_x),
                lanes.int_ramp(c.value + c.bias, c.step_x),
            ],
            over: [over(a), over(b), over(c)],
            down: [lanes.int(a.step_y), lanes.int(b.step_y), lanes.int(c.step_y)],
            bias: [lanes.int(-a.bias), lanes.int(-b.bias), lanes.int(-c.bias)],
            edges,
            first: [left, row],
        }
    }

    /// The covered columns of the row, column 0 the lowest bit.
    #[inline(always)]
    pub(crate) fn bits(&self) -> u32 {
        let (mut bits, mut at) = (0, self.values);
        for group in 0..self.groups {
            let covered = self.lanes.not_negative(at[0] | at[1] | at[2]);
            bits |= self.lanes.bits(covered) << (group * L::STEP);
            at = self.right(at);
        }
        bits & self.inside
    }

    /// Goes down one row: its covered columns.
    #[inline(always)]
    pub(crate) fn next_row(&mut self) -> u32 {
        self.down();
        self.bits()
    }

    /// Goes down one row.
    #[inline(always)]
    pub(crate) fn down(&mut self) {
        let ([a, b, c], [da, db, dc]) = (self.values, self.down);
        self.values = [a + da, b + db, c + dc];
    }

    /// The columns of the box, column 0 the lowest bit.
    #[inline(always)]
    pub(crate) fn inside(&self) -> u32 {
        self.inside
    }

    /// The lanes in which no function with its bias is negative. Where the lanes reach to before the end of the box's
    /// columns, all of them lie in it, as it has all samples of the triangle in its rows.
    #[inline(always)]
    pub(crate) fn covered(&self, [a, b, c]: [L::Int; 3]) -> L::Mask {
        self.lanes.not_negative(a | b | c)
    }

    /// The edges at a column and row.
    #[inline(always)]
    pub(crate) fn edges(&self, at: [i32; 2]) -> [Edge<i64>; 3] {
        let (columns, rows) = (i64::from(at[0] - self.first[0]), i64::from(at[1] - self.first[1]));
        let [a, b, c] = &self.edges;
        [a.moved(columns, rows), b.moved(columns, rows), c.moved(columns, rows)]
    }

    /// The functions, with their biases, at the first lanes.
    #[inline(always)]
    pub(crate) fn first(&self) -> [L::Int; 3] {
        self.values
    }

    /// The same for the lanes to the right of those.
    #[inline(always)]
    pub(crate) fn right(&self, [a, b, c]: [L::Int; 3]) -> [L::Int; 3] {
        let [da, db, dc] = self.over;
        [a + da, b + db, c + dc]
    }

    /// The functions without their biases, rounded to `f32`.
    #[inline(always)]
    pub(crate) fn weights(&self, [a, b, c]: [L::Int; 3]) -> [L::Number; 3] {
        let (lanes, [bias_a, bias_b, bias_c]) = (self.lanes, self.bias);
        [lanes.int_to_number(a + bias_a), lanes.int_to_number(b + bias_b), lanes.int_to_number(c + bias_c)]
    }
}
