//! A stage that takes as many samples at a time in long rows as in short ones.

use alberti::lanes::Lanes;
use alberti::raster::FragmentStage;
use alberti::{Fragments, Varying};

/// A stage in half of the code: without the wide lanes, which `lanes.rs` and `watertight.rs` compare with one lane.
#[derive(Clone, Copy, Debug)]
pub struct Narrow<S>(
    /// The stage.
    pub S,
);

impl<V: Varying, S: FragmentStage<V>> FragmentStage<V> for Narrow<S> {
    type Color = S::Color;
    type Derivatives = S::Derivatives;
    const WIDE: bool = false;

    #[inline(always)]
    fn derivatives(&self) -> S::Derivatives {
        self.0.derivatives()
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
        self.0.shade(fragments)
    }
}
