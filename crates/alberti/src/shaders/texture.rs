//! A texture's colours as they are.

use alberti_math::Rgba8;
use alberti_math::glam::Vec2;
use alberti_math::lanes::{Lanes, One};
use alberti_raster::{Color, FragmentStage};
use alberti_texture::{Filter, Nearest, Sampler, Size, TexelFormat, Wrap};

/// The texture, read by a [`Sampler`].
#[derive(Clone, Copy, Debug)]
pub struct Unlit<S>(
    /// The texture with its filter and wrap mode.
    pub S,
);

impl<F: TexelFormat, Fl: Filter, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for Unlit<Sampler<'_, F, Fl, U, V, Z>>
{
    type Color = Rgba8;

    #[inline(always)]
    fn shade(&self, uv: Vec2) -> Option<Rgba8> {
        Some(self.0.sample(uv))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(&self, lanes: L, &[u, v]: &[L::Number; 2], mask: L::Mask) -> (L::U32, L::Mask) {
        (self.0.sample_lanes(lanes, u, v), mask)
    }
}

/// The texture's nearest texel as it is stored, for targets of the same format: nothing is decoded nor encoded.
#[derive(Clone, Copy, Debug)]
pub struct Stored<S>(
    /// The texture with its wrap mode.
    pub S,
);

impl<F: TexelFormat<Texel: Color>, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for Stored<Sampler<'_, F, Nearest, U, V, Z>>
{
    type Color = F::Texel;

    #[inline(always)]
    fn shade(&self, uv: Vec2) -> Option<F::Texel> {
        let (word, _) = self.shade_lanes(One, &uv.to_array(), true);
        Some(Color::from_word(word.0))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(&self, lanes: L, &[u, v]: &[L::Number; 2], mask: L::Mask) -> (L::U32, L::Mask) {
        let words = self.0.stored_lanes(lanes, u, v, |texel| texel.map_or(0, Color::to_word));
        (words, mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::Q16;
    use alberti_math::lanes::OneFixed;
    use alberti_texture::format::Rgb565;
    use alberti_texture::{Clamp, Mirror, Repeat, Texture};
    use core::num::Wrapping;

    /// Texels in fixed point, against the definition in integers: u is k / 65536, v is half a row up.
    #[test]
    fn stored_texels_are_those_of_their_cells_in_fixed_point() {
        let texels: [u16; 16] = core::array::from_fn(|i| 1000 + u16::try_from(i).expect("small"));
        let texture = Texture::<Rgb565>::new(&texels, 8, 2).expect("8 x 2").known::<8, 2>().expect("8 x 2");
        let v = Q16::from_f32(0.25);
        for k in (-300_000..300_000_i32).step_by(97).chain([-65_536, -1, 0, 65_535, 65_536]) {
            let at = [Q16::from_bits(k), v];
            let [repeat, mirror] = [k.rem_euclid(65_536) * 8 / 65_536, k.rem_euclid(131_072) * 8 / 65_536];
            let texel = |column: i32| 1008 + column.unsigned_abs();
            let stored = |(word, _): (Wrapping<u32>, bool)| word.0;
            let wrapped = Stored(texture.sampler::<Nearest, Repeat>()).shade_lanes(OneFixed, &at, true);
            assert_eq!(stored(wrapped), texel(repeat), "repeat {k}");
            let folded = Stored(texture.sampler::<Nearest, Mirror>()).shade_lanes(OneFixed, &at, true);
            assert_eq!(stored(folded), texel(mirror.min(15 - mirror)), "mirror {k}");
            let clamped = Stored(texture.sampler::<Nearest, Clamp>()).shade_lanes(OneFixed, &at, true);
            assert_eq!(stored(clamped), texel((k.clamp(0, 65_535)) * 8 / 65_536), "clamp {k}");
        }
    }
}
