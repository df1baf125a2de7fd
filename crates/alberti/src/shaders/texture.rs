//! A texture's colours as they are.

use super::alone;
use alberti_math::glam::Vec2;
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Rgba8, Varying};
use alberti_raster::{Color, Differentiation, FragmentStage, Gradient, NoDerivatives, PerPixel};
use alberti_texture::format::Storage;
use alberti_texture::{
    Derivatives, Filter, LevelSize, MipFilter, MipSampler, Nearest, Sampler, Size, TexelFormat, Wrap,
};
use core::marker::PhantomData;

/// The texture, read by a [`Sampler`].
#[derive(Clone, Copy, Debug)]
pub struct Unlit<S>(
    /// The texture with its filter and wrap mode.
    pub S,
);

impl<F: Storage, Fl: Filter, U: Wrap, V: Wrap, Z: Size> FragmentStage<Vec2>
    for Unlit<Sampler<'_, F, Fl, U, V, Z>>
{
    type Color = Rgba8;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade(&self, uv: Vec2) -> Option<Rgba8> {
        Some(self.0.sample(uv))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        &[u, v]: &[L::Number; 2],
        _: &Gradient<[L::Number; 2]>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        (self.0.sample_lanes(lanes, u, v), mask)
    }
}

/// A mip map, read by a [`MipSampler`] for what a pixel covers of it.
///
/// The derivatives are those at each pixel; [`Differentiated`] chooses others. [`FragmentStage::shade`] alone, which
/// knows of no other pixel, reads level 0.
impl<F: Storage, M: MipFilter, U: Wrap, V: Wrap, Z: LevelSize> FragmentStage<Vec2>
    for Unlit<MipSampler<'_, F, M, U, V, Z>>
{
    type Color = Rgba8;
    type Derivatives = PerPixel;

    #[inline(always)]
    fn shade(&self, uv: Vec2) -> Option<Rgba8> {
        alone(self, uv)
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        &[u, v]: &[L::Number; 2],
        gradient: &Gradient<[L::Number; 2]>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        (self.0.sample_grad_lanes(lanes, u, v, footprint(gradient)), mask)
    }
}

/// The derivatives of texture coordinates as samplers take them.
#[inline(always)]
pub(super) fn footprint<N: Copy>(
    &Gradient { dx: [du_dx, dv_dx], dy: [du_dy, dv_dy] }: &Gradient<[N; 2]>,
) -> Derivatives<N> {
    Derivatives { du_dx, dv_dx, du_dy, dv_dy }
}

/// Another stage that learns from `D` how fast its varying changes, whatever it would choose itself.
///
/// ```
/// use alberti::texture::{Mipmap, Repeat, Trilinear, format::L8};
/// use alberti::{raster::PerTriangle, shaders::{Differentiated, Unlit}};
///
/// let board = Mipmap::<L8>::new(&[0, 255, 255, 0, 188], 2, 2)?;
/// // One level of detail for all of a triangle, found once.
/// let stage = Differentiated::by(PerTriangle, Unlit(board.sampler::<Trilinear, Repeat>()));
/// # Ok::<(), alberti::texture::TextureError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Differentiated<D, S> {
    stage: S,
    policy: PhantomData<D>,
}

impl<D, S> Differentiated<D, S> {
    /// `stage` with this policy.
    #[must_use]
    pub fn by(_: D, stage: S) -> Self {
        Self { stage, policy: PhantomData }
    }
}

impl<V: Varying, D: Differentiation, S: FragmentStage<V>> FragmentStage<V> for Differentiated<D, S> {
    type Color = S::Color;
    type Derivatives = D;

    #[inline(always)]
    fn shade(&self, varying: V) -> Option<S::Color> {
        self.stage.shade(varying)
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        varyings: &V::Of<L::Number>,
        gradient: &Gradient<V::Of<L::Number>>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        self.stage.shade_lanes(lanes, varyings, gradient, mask)
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
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade(&self, uv: Vec2) -> Option<F::Texel> {
        let (word, _) = self.shade_lanes(One, &uv.to_array(), &Gradient::default(), true);
        Some(Color::from_word(word.0))
    }

    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        &[u, v]: &[L::Number; 2],
        _: &Gradient<[L::Number; 2]>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
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
            let steady = Gradient { dx: [Q16::ZERO; 2], dy: [Q16::ZERO; 2] };
            let [repeat, mirror] = [k.rem_euclid(65_536) * 8 / 65_536, k.rem_euclid(131_072) * 8 / 65_536];
            let texel = |column: i32| 1008 + column.unsigned_abs();
            let stored = |(word, _): (Wrapping<u32>, bool)| word.0;
            let wrapped =
                Stored(texture.sampler::<Nearest, Repeat>()).shade_lanes(OneFixed, &at, &steady, true);
            assert_eq!(stored(wrapped), texel(repeat), "repeat {k}");
            let folded =
                Stored(texture.sampler::<Nearest, Mirror>()).shade_lanes(OneFixed, &at, &steady, true);
            assert_eq!(stored(folded), texel(mirror.min(15 - mirror)), "mirror {k}");
            let clamped =
                Stored(texture.sampler::<Nearest, Clamp>()).shade_lanes(OneFixed, &at, &steady, true);
            assert_eq!(stored(clamped), texel((k.clamp(0, 65_535)) * 8 / 65_536), "clamp {k}");
        }
    }
}
