//! The light of the vertices on texels that stay as they are stored.

use alberti_math::lanes::Lanes;
use alberti_math::{Gradient, Mode, Q16, Varying};
use alberti_raster::{FragmentStage, Fragments};
use alberti_texture::format::Rgb565;

/// Another stage's RGB565 times the light of the vertices, all of it in 16 bits: for textures as they are
/// [stored](super::Stored), on small cores.
///
/// ```
/// use alberti::glam::Vec2;
/// use alberti::shaders::{Light, Lit565, Stored};
/// use alberti::texture::{Nearest, Repeat, Texture, format::Rgb565};
/// use alberti::FragmentStage;
///
/// let white = Texture::new(Rgb565, &[0xffff], 1, 1)?;
/// let stage = Lit565 { surface: Stored(white.sampler(Nearest, Repeat)) };
/// assert_eq!(stage.shade_one((Light::new(0.5), Vec2::ZERO)), Some(16 << 11 | 32 << 5 | 16));
/// # Ok::<(), alberti::texture::TextureError>(())
/// ```
///
/// # Precision
/// The light is rounded to 32nds, and each channel to a level: within one level, of green within 1.5.
///
/// # Cost
/// A product of 32 bits and some five shifts and masks, in place of the 30 instructions that colours of 8 bits take.
#[derive(Clone, Copy, Debug)]
pub struct Lit565<S> {
    /// The stage.
    pub surface: S,
}

/// Light on a vertex, from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light(f32);

/// A half of a 32nd, so that fragments need not round.
const HALF: f32 = 1.0 / 64.0;

impl Light {
    /// So much, clamped to 0 and 1; NaN is 0.
    #[must_use]
    #[inline]
    pub fn new(light: f32) -> Self {
        let light = if light > 0.0 { light } else { 0.0 };
        Self(if light < 1.0 { light } else { 1.0 } + HALF)
    }

    /// The component for so much, where [vertices are integers](crate::IntegerVertex).
    #[must_use]
    #[inline]
    pub fn of_integer(light: Q16) -> [Q16; 1] {
        [Q16::from_bits(light.clamp(Q16::ZERO, Q16::ONE).to_bits() + (1 << 10))]
    }
}

impl Varying for Light {
    type Of<T: Copy> = [T; 1];
    const ZEROS: [u32; 1] = [0];

    #[inline(always)]
    fn gather<const N: usize>(values: [Self; N]) -> [[f32; N]; 1] {
        [values.map(|Self(light)| light)]
    }

    #[inline(always)]
    fn map_by_mode<T: Copy, U: Copy>(&[light]: &[T; 1], f: &impl Fn(Mode, T) -> U) -> [U; 1] {
        [f(Mode::Hyperbolic, light)]
    }

    #[inline(always)]
    fn zip<T: Copy, U: Copy>(&[first]: &[T; 1], &[second]: &[U; 1]) -> [(T, U); 1] {
        [(first, second)]
    }

    #[inline(always)]
    fn from_components(&[light]: &[f32; 1]) -> Self {
        Self(light)
    }
}

impl<V: Varying, S: FragmentStage<V, Color = u16>> FragmentStage<(Light, V)> for Lit565<S> {
    type Color = u16;
    type Derivatives = S::Derivatives;
    const WIDE: bool = S::WIDE;
    const SETTLES: bool = S::SETTLES;

    #[inline(always)]
    fn derivatives(&self) -> S::Derivatives {
        self.surface.derivatives()
    }

    #[inline(always)]
    fn settled<L: Lanes>(
        &self,
        lanes: L,
        gradient: &Gradient<<(Light, V) as Varying>::Of<L::Number>>,
    ) -> Self {
        Self { surface: self.surface.settled(lanes, &gradient.map(|(_, part)| part)) }
    }

    const BY_ROWS: bool = S::BY_ROWS;

    #[inline(always)]
    fn in_row(&self, row: i32) -> Self {
        Self { surface: self.surface.in_row(row) }
    }

    // Interpolated light stays between that of the vertices, and so does not leave the channels.
    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, (Light, V)>) -> (L::U32, L::Mask) {
        let (lanes, ([light], _)) = (fragments.lanes, fragments.varying);
        let (texels, mask) = self.surface.shade(&fragments.part(|(_, varying)| *varying));
        let texels = Rgb565::spread(lanes, texels);
        let lit = Rgb565::blended(lanes, lanes.word(0), texels, lanes.floor_scaled(light, 5));
        (Rgb565::gathered(lanes, lit), mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;

    #[test]
    fn light_on_texels_is_their_product() {
        for texel in [0_u16, 0xffff, 0x8410, 0x1234, 0xf81f, 0x07e0] {
            for step in -3..=40_i16 {
                let light = f32::from(step) / 37.0;
                let lit =
                    Lit565 { surface: Solid(texel) }.shade_one((Light::new(light), ())).expect("a colour");
                for (shift, mask, within) in [(11, 31, 1.0), (5, 63, 1.5), (0, 31, 1.0)] {
                    let channel = |word: u16| f32::from(word >> shift & mask);
                    let right = channel(texel) * light.clamp(0.0, 1.0);
                    assert!((channel(lit) - right).abs() < within, "{texel:x} by {light}: {lit:x}");
                }
            }
        }
    }

    #[test]
    fn no_light_is_a_number() {
        for light in [f32::NAN, f32::NEG_INFINITY, f32::INFINITY, -1.0, 2.0, 1e-30] {
            let Light(word) = Light::new(light);
            assert!((HALF..=1.0 + HALF).contains(&word), "{light}");
            let [fixed] = Light::of_integer(Q16::from_f32(light));
            assert!((fixed.to_f32() - word).abs() <= 1.0 / 65536.0, "{light}");
        }
    }
}
