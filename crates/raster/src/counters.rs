//! Counts of the events of drawing, for those who ask.

use crate::Outcome;
use core::ops::Range;

/// Receives counts while drawing. `()` is the one that costs nothing: its methods are empty, and so is what would be
/// computed for them.
pub trait Counters {
    /// A triangle was submitted.
    #[inline]
    fn submitted(&mut self) {}
    /// A submitted triangle crossed a clipping plane.
    #[inline]
    fn clipped(&mut self) {}
    /// A submitted triangle was dropped: wholly outside, or with a vertex that has no finite place.
    #[inline]
    fn dropped(&mut self) {}
    /// A triangle came to the rasterizer; clipping makes several of one.
    #[inline]
    fn rasterized(&mut self, outcome: Outcome) {
        let _ = outcome;
    }
    /// The same of a triangle, a line or a point whose samples are in the columns and the rows that `area` has.
    #[inline(always)]
    fn touched(&mut self, outcome: Outcome, area: impl FnOnce() -> [Range<i32>; 2]) {
        let _ = (outcome, area);
    }
    /// A span of `covered` samples was filled, of which `written` passed the depth test and were not discarded.
    #[inline]
    fn span(&mut self, covered: u32, written: u32) {
        let _ = (covered, written);
    }
    /// Other threads have counted this much in the same drawing.
    fn add(&mut self, other: Self)
    where
        Self: Sized;
}

impl Counters for () {
    #[inline]
    fn add(&mut self, (): Self) {}
}

/// Both hear of all.
impl<A: Counters, B: Counters> Counters for (A, B) {
    #[inline]
    fn submitted(&mut self) {
        self.0.submitted();
        self.1.submitted();
    }

    #[inline]
    fn clipped(&mut self) {
        self.0.clipped();
        self.1.clipped();
    }

    #[inline]
    fn dropped(&mut self) {
        self.0.dropped();
        self.1.dropped();
    }

    #[inline]
    fn rasterized(&mut self, outcome: Outcome) {
        self.0.rasterized(outcome);
        self.1.rasterized(outcome);
    }

    #[inline]
    fn touched(&mut self, outcome: Outcome, area: impl FnOnce() -> [Range<i32>; 2]) {
        let area = area();
        self.0.touched(outcome, || area.clone());
        self.1.touched(outcome, || area);
    }

    #[inline]
    fn span(&mut self, covered: u32, written: u32) {
        self.0.span(covered, written);
        self.1.span(covered, written);
    }

    #[inline]
    fn add(&mut self, other: Self) {
        self.0.add(other.0);
        self.1.add(other.1);
    }
}
