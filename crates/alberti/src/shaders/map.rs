//! Maps: colours that are read at texture coordinates.

use super::wide::times;
use alberti_math::Rgba8;
use alberti_math::lanes::Lanes;
use alberti_raster::{Differentiation, Gradient, NoDerivatives, PerPixel};
use alberti_texture::format::Storage;
use alberti_texture::surface::HeightMap;
use alberti_texture::{Filter, MipFilter, MipSampler, Sampler, Size, Wrap};
use core::fmt::Debug;

/// A colour for each place on a surface: a [`Sampler`], a [`MipSampler`] for all that a pixel covers, or an [`Rgba8`]
/// for one colour everywhere. [`Times`] and [`Called`] wrap another map.
pub trait Map: Copy + Debug {
    /// The policy for derivatives of the coordinates: [`NoDerivatives`], unless it needs them.
    type Derivatives: Differentiation;

    /// The colours at `uv`, of which `gradient` are the derivatives, as words. A stage that reads a map takes the map's
    /// policy, `type Derivatives = M::Derivatives`, and hands the derivatives on: with zeros a mip map is read in its
    /// largest level.
    fn read<L: Lanes>(&self, lanes: L, uv: [L::Number; 2], gradient: &Gradient<[L::Number; 2]>) -> L::U32;
}

impl Map for Rgba8 {
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn read<L: Lanes>(&self, lanes: L, _: [L::Number; 2], _: &Gradient<[L::Number; 2]>) -> L::U32 {
        lanes.word(self.to_bits())
    }
}

impl<F: Storage, Fl: Filter, U: Wrap, V: Wrap, Z: Size> Map for Sampler<'_, F, Fl, U, V, Z> {
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn read<L: Lanes>(&self, lanes: L, [u, v]: [L::Number; 2], _: &Gradient<[L::Number; 2]>) -> L::U32 {
        self.sample_lanes(lanes, u, v)
    }
}

impl<F: Storage, M: MipFilter, U: Wrap, V: Wrap, Z: Size> Map for MipSampler<'_, F, M, U, V, Z> {
    type Derivatives = PerPixel;

    #[inline(always)]
    fn read<L: Lanes>(
        &self,
        lanes: L,
        [u, v]: [L::Number; 2],
        gradient: &Gradient<[L::Number; 2]>,
    ) -> L::U32 {
        self.sample_grad_lanes(lanes, u, v, *gradient)
    }
}

/// A map that is there or not, as known at run time: without it, white.
impl<M: Map> Map for Option<M> {
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn read<L: Lanes>(&self, lanes: L, uv: [L::Number; 2], gradient: &Gradient<[L::Number; 2]>) -> L::U32 {
        match self {
            Some(map) => map.read(lanes, uv, gradient),
            None => Rgba8::WHITE.read(lanes, uv, gradient),
        }
    }
}

/// A map times a constant, to the nearest byte; the map's alpha is kept. White, as 1, is not multiplied.
#[derive(Clone, Copy, Debug)]
pub struct Times<M> {
    /// A [`Map`].
    pub map: M,
    /// The factor of each channel, in bytes: 255 is one.
    pub factor: Rgba8,
}

impl<M: Map> Map for Times<M> {
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn read<L: Lanes>(&self, lanes: L, uv: [L::Number; 2], gradient: &Gradient<[L::Number; 2]>) -> L::U32 {
        let words = self.map.read(lanes, uv, gradient);
        if self.factor == Rgba8::WHITE { words } else { times(lanes, words, self.factor) }
    }
}

/// A map of colours or heights that is read by a call, instead of in place.
///
/// # Cost
/// A call for the samples that are worked on together. In return the map's code is in a program once for each kind of
/// lanes, and not in every loop of every stage. Mip maps and filters that are picked at run time are long enough for
/// that, above all in materials of several maps.
#[derive(Clone, Copy, Debug)]
pub struct Called<M>(
    /// A [`Map`] or a [`HeightMap`].
    pub M,
);

impl<M: Map> Map for Called<M> {
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn read<L: Lanes>(&self, lanes: L, uv: [L::Number; 2], gradient: &Gradient<[L::Number; 2]>) -> L::U32 {
        called(lanes, &self.0, uv, gradient)
    }
}

#[inline(never)]
fn called<L: Lanes>(
    lanes: L,
    map: &impl Map,
    uv: [L::Number; 2],
    gradient: &Gradient<[L::Number; 2]>,
) -> L::U32 {
    lanes.vectorize(
        #[inline(always)]
        || map.read(lanes, uv, gradient),
    )
}

impl<H: HeightMap> HeightMap for Called<H> {
    #[inline(always)]
    fn height_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> L::Number {
        called_height(lanes, &self.0, uv)
    }
}

#[inline(never)]
fn called_height<L: Lanes>(lanes: L, map: &impl HeightMap, uv: [L::Number; 2]) -> L::Number {
    lanes.vectorize(
        #[inline(always)]
        || map.height_lanes(lanes, uv),
    )
}
