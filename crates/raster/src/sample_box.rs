//! The samples in a triangle's box.

use crate::edge::{Edge, EdgeInt};
use crate::interpolation::Oriented;
use crate::triangle::Corners;
use alberti_math::Varying;
use core::ops::Range;

/// The samples in a triangle's box, and the columns of the target.
pub(crate) struct SampleBox<'a> {
    pub(crate) corners: &'a Corners,
    /// Bits of the subpixels.
    pub(crate) bits: u32,
    pub(crate) columns: Range<i32>,
    pub(crate) rows: Range<i32>,
    /// The columns of the target.
    pub(crate) limits: Range<i32>,
}

impl<'a> SampleBox<'a> {
    #[inline(always)]
    pub(crate) fn new<V: Varying>(
        oriented: &'a Oriented<'_, V>,
        [columns, rows]: [Range<i32>; 2],
        limits: Range<i32>,
    ) -> Self {
        Self { corners: &oriented.corners, bits: oriented.bits, columns, rows, limits }
    }

    /// The number of rows whose samples lie above the middle vertex.
    #[inline(always)]
    pub(crate) fn above(&self) -> i32 {
        // The first corner is the topmost.
        let [_, [_, b], [_, c]] = *self.corners;
        let half = 1 << (self.bits - 1);
        ((b.min(c) + half - 1) >> self.bits) - self.rows.start
    }

    /// The edges, each opposite the vertex whose weight it is, with their values at the box's first sample.
    #[inline(always)]
    pub(crate) fn edges<I: EdgeInt>(&self) -> [Edge<I>; 3] {
        let (one, half) = (1 << self.bits, 1 << (self.bits - 1));
        let first_sample = [self.columns.start * one + half, self.rows.start * one + half];
        let [a, b, c] = *self.corners;
        [
            Edge::new(b, c, first_sample, one),
            Edge::new(c, a, first_sample, one),
            Edge::new(a, b, first_sample, one),
        ]
    }
}
