//! Counts of the steps of a drawing.

use alberti_raster::{Counters, Outcome};

/// The fates of triangles and fragments in a drawing: [`Pass::draw_counted`](crate::Pass::draw_counted) has them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Stats {
    /// Triangles submitted.
    pub submitted: u64,
    /// Submitted triangles wholly outside the view, or with an index or a coordinate that has no meaning.
    pub dropped: u64,
    /// Submitted triangles that crossed a clipping plane.
    pub clipped: u64,
    /// Screen triangles (clipping makes several of one) left out for facing the wrong way or having no area.
    pub culled: u64,
    /// Screen triangles between the samples, or outside the band.
    pub missed: u64,
    /// Screen triangles drawn.
    pub drawn: u64,
    /// Covered samples.
    pub fragments: u64,
    /// Covered samples that passed the depth test and were written.
    pub written: u64,
}

impl core::ops::AddAssign for Stats {
    fn add_assign(&mut self, other: Self) {
        let Self { submitted, dropped, clipped, culled, missed, drawn, fragments, written } = other;
        self.submitted += submitted;
        self.dropped += dropped;
        self.clipped += clipped;
        self.culled += culled;
        self.missed += missed;
        self.drawn += drawn;
        self.fragments += fragments;
        self.written += written;
    }
}

impl Counters for Stats {
    #[inline]
    fn submitted(&mut self) {
        self.submitted += 1;
    }

    #[inline]
    fn clipped(&mut self) {
        self.clipped += 1;
    }

    #[inline]
    fn dropped(&mut self) {
        self.dropped += 1;
    }

    #[inline]
    fn rasterized(&mut self, outcome: Outcome) {
        match outcome {
            Outcome::Culled => self.culled += 1,
            Outcome::Missed => self.missed += 1,
            Outcome::Drawn => self.drawn += 1,
        }
    }

    #[inline]
    fn span(&mut self, covered: u32, written: u32) {
        self.fragments += u64::from(covered);
        self.written += u64::from(written);
    }

    fn add(&mut self, other: Self) {
        *self += other;
    }
}
