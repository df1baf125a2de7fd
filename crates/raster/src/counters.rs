//! Counts of the events of drawing, for those who ask.

use crate::Outcome;

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
