//! One colour, or the vertices' colours.

use super::wide::pack;
use alberti_math::glam::Vec3;
use alberti_math::lanes::Lanes;
use alberti_math::{Mode, Q16, Rgba8, Varying};
use alberti_raster::{FragmentColor, FragmentStage, Fragments, NoDerivatives};

/// One colour for everything.
///
/// # Cost
/// Nothing is interpolated.
#[derive(Clone, Copy, Debug)]
pub struct Solid<C = Rgba8>(
    /// The colour, of any type that the target can store.
    pub C,
);

impl<V: Varying, C: FragmentColor> FragmentStage<V> for Solid<C> {
    type Color = C;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
        let Fragments { lanes, mask, .. } = *fragments;
        (lanes.word(self.0.to_word()), mask)
    }
}

/// The interpolated colour of the vertices; components outside [0, 1] are clamped.
///
/// # Precision
/// Within half a byte and 2^-16.
#[derive(Clone, Copy, Debug)]
pub struct VertexColor;

impl FragmentStage<Vec3> for VertexColor {
    type Color = Rgba8;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Vec3>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying: [r, g, b], mask, .. } = *fragments;
        let [r, g, b] = [lanes.of_unit(r, 255), lanes.of_unit(g, 255), lanes.of_unit(b, 255)];
        (pack(lanes, [r, g, b, lanes.word(255)]), mask)
    }
}

/// [`VertexColor`] for targets of 16 bits, of which the vertices carry [`Ready565`].
///
/// # Precision
/// To the nearest step of each channel.
///
/// # Cost
/// Shifts and masks: clamping and rounding are done at the vertices.
#[derive(Clone, Copy, Debug)]
pub struct VertexColor565;

/// A colour of which the fragments need only take the highest bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ready565(Vec3);

impl Ready565 {
    /// For this colour; components outside [0, 1] are clamped.
    #[must_use]
    #[inline]
    pub fn new(color: Vec3) -> Self {
        // floor(32 x) of these is the integer nearest to 31 times the component.
        let steps = Vec3::new(32.0, 64.0, 32.0);
        Self((color.clamp(Vec3::ZERO, Vec3::ONE) * (steps - Vec3::ONE) + Vec3::splat(0.5)) / steps)
    }

    /// The components for this colour, where [vertices are integers](crate::IntegerVertex).
    #[must_use]
    #[inline]
    pub fn of_integers([r, g, b]: [Q16; 3]) -> [Q16; 3] {
        let ready = |c: Q16, bits: u32| {
            let c = c.clamp(Q16::ZERO, Q16::ONE).to_bits();
            Q16::from_bits(((c << bits) - c + (1 << 15)) >> bits)
        };
        [ready(r, 5), ready(g, 6), ready(b, 5)]
    }
}

impl Varying for Ready565 {
    type Of<T: Copy> = [T; 3];
    const ZEROS: [u32; 3] = [0; 3];

    #[inline(always)]
    fn gather<const N: usize>(values: [Self; N]) -> [[f32; N]; 3] {
        Vec3::gather(values.map(|v| v.0))
    }

    #[inline(always)]
    fn map_by_mode<T: Copy, U: Copy>(bundle: &[T; 3], f: &impl Fn(Mode, T) -> U) -> [U; 3] {
        Vec3::map_by_mode(bundle, f)
    }

    #[inline(always)]
    fn zip<T: Copy, U: Copy>(first: &[T; 3], second: &[U; 3]) -> [(T, U); 3] {
        Vec3::zip(first, second)
    }

    #[inline(always)]
    fn from_components(bundle: &[f32; 3]) -> Self {
        Self(Vec3::from_components(bundle))
    }
}

impl FragmentStage<Ready565> for VertexColor565 {
    type Color = u16;
    type Derivatives = NoDerivatives;
    const DEPTH_FIRST: bool = true;

    // Interpolated components stay between those of the vertices, and so do not leave the channels.
    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Ready565>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying: [r, g, b], mask, .. } = *fragments;
        let [r, g, b] = [lanes.floor_scaled(r, 5), lanes.floor_scaled(g, 6), lanes.floor_scaled(b, 5)];
        (lanes.shl(r, 11) | (lanes.shl(g, 5) | b), mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertex_colours_are_rounded_and_clamped() {
        let color = VertexColor.shade_one(Vec3::new(0.5, -1.0, 2.0));
        assert_eq!(color, Some(Rgba8::new(128, 0, 255, 255)));
    }

    #[test]
    fn colours_of_16_bits_are_the_nearest() {
        for step in -100..1100_i16 {
            let c = f32::from(step) / 1000.0;
            let nearest = |steps: f32| (c.clamp(0.0, 1.0) * steps + 0.5).floor();
            let packed = VertexColor565.shade_one(Ready565::new(Vec3::splat(c))).expect("never discards");
            assert_eq!(f32::from(packed >> 11), nearest(31.0), "red of {c}");
            assert_eq!(f32::from(packed >> 5 & 63), nearest(63.0), "green of {c}");
            assert_eq!(f32::from(packed & 31), nearest(31.0), "blue of {c}");
        }
    }
}
