//! The covered samples of each row of a narrow box, by testing all of them: no division, and no branch on where they lie.

use crate::edge::Edge;
use alberti_math::lanes::Lanes;

/// The columns of the widest box for which this is cheaper than finding where the edges cross the rows.
pub(crate) const NARROW: i32 = 32;

/// The lowest 1 to 32 bits.
#[inline(always)]
fn lowest(bits: usize) -> u32 {
    u32::MAX >> (32usize.saturating_sub(bits) & 31)
}

/// A row of a triangle's box, its three edge functions at the first lanes, and what leads to the others.
pub(crate) struct RowMask<L: Lanes> {
    lanes: L,
    /// The columns that are in the box.
    inside: u32,
    groups: u32,
    /// The functions plus their biases at the first lanes.
    values: [L::Int; 3],
    /// What a group of lanes to the right and a row down add.
    over: [L::Int; 3],
    down: [L::Int; 3],
    bias: [L::Int; 3],
    /// The edges at the first lane of the first row, and which row that is.
    edges: [Edge<i32>; 3],
    first_row: i32,
}

impl<L: Lanes> RowMask<L> {
    /// The row of the edges' reference sample, which is column 0 of a box of 1 to [`NARROW`] columns.
    #[inline(always)]
    pub(crate) fn new(lanes: L, edges: [Edge<i32>; 3], columns: usize, first_row: i32) -> Self {
        let [a, b, c] = edges;
        // Beyond the box, functions may wrap.
        let over = |e: &Edge<i32>| lanes.int(e.step_x.wrapping_mul(L::COUNT as i32));
        Self {
            lanes,
            inside: lowest(columns),
            groups: columns.div_ceil(L::COUNT) as u32,
            values: [
                lanes.int_ramp(a.value + a.bias, a.step_x),
                lanes.int_ramp(b.value + b.bias, b.step_x),
                lanes.int_ramp(c.value + c.bias, c.step_x),
            ],
            over: [over(&a), over(&b), over(&c)],
            down: [lanes.int(a.step_y), lanes.int(b.step_y), lanes.int(c.step_y)],
            bias: [lanes.int(-a.bias), lanes.int(-b.bias), lanes.int(-c.bias)],
            edges,
            first_row,
        }
    }

    /// The covered columns of the row, column 0 the lowest bit.
    #[inline(always)]
    pub(crate) fn bits(&self) -> u32 {
        let (mut bits, mut at) = (0, self.values);
        for group in 0..self.groups {
            let covered = self.lanes.not_negative(at[0] | at[1] | at[2]);
            bits |= self.lanes.bits(covered) << (group * L::COUNT as u32);
            at = self.right(at);
        }
        bits & self.inside
    }

    /// Goes down one row: its covered columns.
    #[inline(always)]
    pub(crate) fn next_row(&mut self) -> u32 {
        let ([a, b, c], [da, db, dc]) = (self.values, self.down);
        self.values = [a + da, b + db, c + dc];
        self.bits()
    }

    /// The edges in some row and column of the box.
    pub(crate) fn edges(&self, row: i32, column: i32) -> [Edge<i32>; 3] {
        let rows = row - self.first_row;
        self.edges.map(|e| Edge { value: e.value + e.step_x * column + e.step_y * rows, ..e })
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
    pub(crate) fn weights(&self, [a, b, c]: [L::Int; 3]) -> [L::F32; 3] {
        let (lanes, [bias_a, bias_b, bias_c]) = (self.lanes, self.bias);
        [lanes.int_to_f32(a + bias_a), lanes.int_to_f32(b + bias_b), lanes.int_to_f32(c + bias_c)]
    }
}
