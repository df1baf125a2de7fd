//! A colour by which another stage's is multiplied.

use super::{pack, per_255, unpack};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Rgba8, Varying};
use alberti_raster::{FragmentStage, Gradient};
use core::num::Wrapping;

/// Another stage's colour times a constant one.
///
/// # Precision
/// To the nearest byte; white changes nothing.
#[derive(Clone, Copy, Debug)]
pub struct Tinted<S> {
    /// What is tinted.
    pub surface: S,
    /// The factor, in bytes: 255 is one. The surface's alpha is kept.
    pub tint: Rgba8,
}

impl<V: Varying, S: FragmentStage<V, Color = Rgba8>> FragmentStage<V> for Tinted<S> {
    type Color = Rgba8;
    type Derivatives = S::Derivatives;

    #[inline(always)]
    fn shade(&self, varying: V) -> Option<Rgba8> {
        let surface = self.surface.shade(varying)?;
        let tinted = times(One, unpack(One, Wrapping(surface.to_bits())), self.tint);
        Some(Rgba8::from_bits(tinted.0))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        varyings: &V::Of<L::Number>,
        gradient: &Gradient<V::Of<L::Number>>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        let (surface, mask) = self.surface.shade_lanes(lanes, varyings, gradient, mask);
        (times(lanes, unpack(lanes, surface), self.tint), mask)
    }
}

/// A colour's channels times a constant's, to the nearest byte; alpha is kept.
#[inline(always)]
pub(super) fn times<L: Lanes>(lanes: L, [r, g, b, a]: [L::U32; 4], tint: Rgba8) -> L::U32 {
    let [tint_r, tint_g, tint_b, _] = tint.to_bytes();
    let times = |channel: L::U32, tint: u8| per_255(lanes, channel * lanes.word(tint.into()));
    pack(lanes, [times(r, tint_r), times(g, tint_g), times(b, tint_b), a])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;

    #[test]
    fn a_tint_multiplies_and_white_is_one() {
        for c in 0..=255u8 {
            let tinted = |tint| Tinted { surface: Solid(Rgba8::new(c, c, c, 9)), tint }.shade(());
            assert_eq!(tinted(Rgba8::WHITE), Some(Rgba8::new(c, c, c, 9)));
            let half = (f32::from(c) * 100.0 / 255.0).round();
            let bytes = tinted(Rgba8::new(100, 0, 255, 0)).expect("never discards").to_bytes();
            assert_eq!(bytes.map(f32::from), [half, 0.0, f32::from(c), 9.0]);
        }
    }
}
