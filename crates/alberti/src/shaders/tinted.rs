//! A colour by which another stage's is multiplied.

use super::wide::times;
use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Varying};
use alberti_raster::{FragmentStage, Fragments, Gradient};

/// Another stage's colour times a constant one.
///
/// # Precision
/// To the nearest byte; white changes nothing.
#[derive(Clone, Copy, Debug)]
pub struct Tinted<S> {
    /// The stage that is tinted.
    pub surface: S,
    /// The factor, in bytes: 255 is one. The surface's alpha is kept.
    pub tint: Rgba8,
}

impl<V: Varying, S: FragmentStage<V, Color = Rgba8>> FragmentStage<V> for Tinted<S> {
    as_surface!(V, |gradient| gradient);

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
        let (surface, mask) = self.surface.shade(fragments);
        (times(fragments.lanes, surface, self.tint), mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;

    #[test]
    fn a_tint_multiplies_and_white_is_one() {
        for c in 0..=255u8 {
            let tinted = |tint| Tinted { surface: Solid(Rgba8::new(c, c, c, 9)), tint }.shade_one(());
            assert_eq!(tinted(Rgba8::WHITE), Some(Rgba8::new(c, c, c, 9)));
            let half = (f32::from(c) * 100.0 / 255.0).round();
            let bytes = tinted(Rgba8::new(100, 0, 255, 0)).expect("never discards").to_bytes();
            assert_eq!(bytes.map(f32::from), [half, 0.0, f32::from(c), 9.0]);
        }
    }
}
