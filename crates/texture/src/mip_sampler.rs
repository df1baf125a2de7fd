//! A mip map together with the way of reading it.

use core::fmt;

use alberti_math::Rgba8;
use alberti_math::lanes::{Lanes, One};
use glam::Vec2;

use crate::format::Storage;
use crate::minify::MipFilter;
use crate::{AnySize, Gradient, Mipmap, Size, Wrap};

/// A mip map with a filter and a wrap mode for each axis, which a fragment that knows its size asks for a colour.
///
/// Made by [`Mipmap::sampler`] and [`Mipmap::sampler_per_axis`].
///
/// ```
/// use alberti_texture::format::L8;
/// use alberti_texture::{Gradient, Mipmap, Repeat, Trilinear};
/// use glam::Vec2;
///
/// let board = Mipmap::new(L8, &[0, 255, 255, 0, 188], 2, 2)?;
/// let sampler = board.sampler(Trilinear, Repeat);
/// let uv = Vec2::new(0.25, 0.25);
/// // Pixels as large as texels, four times as large, and in between.
/// assert_eq!(sampler.sample_lod(uv, 0.0).to_bytes()[0], 255);
/// assert_eq!(sampler.sample_lod(uv, 1.0).to_bytes()[0], 188);
/// assert_eq!(sampler.sample_lod(uv, 0.5).to_bytes()[0], 222);
/// // A texel across and two down.
/// let gradient = Gradient { dx: [0.5, 0.0], dy: [0.0, 1.0] };
/// assert_eq!(sampler.sample_grad(uv, gradient).to_bytes()[0], 188);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
#[derive(Clone, Copy)]
pub struct MipSampler<'a, F: Storage, M, U, V = U, Z: Size = AnySize, const N: usize = 1> {
    mipmap: Mipmap<'a, F, Z, N>,
    filter: M,
    wrap: (U, V),
}

impl<'a, F: Storage, M: MipFilter, U: Wrap, V: Wrap, Z: Size, const N: usize>
    MipSampler<'a, F, M, U, V, Z, N>
{
    #[inline]
    pub(crate) const fn new(mipmap: Mipmap<'a, F, Z, N>, filter: M, wrap: (U, V)) -> Self {
        Self { mipmap, filter, wrap }
    }

    /// The wrap modes of u and v.
    #[inline(always)]
    pub(crate) const fn wraps(&self) -> (U, V) {
        self.wrap
    }

    /// The filter.
    #[inline(always)]
    pub(crate) const fn filter(&self) -> M {
        self.filter
    }

    /// The mip map that is sampled.
    #[must_use]
    pub const fn mipmap(&self) -> &Mipmap<'a, F, Z, N> {
        &self.mipmap
    }

    /// The colours of each of several maps ([`Mipmap::together`]): those of [`sample_grad`](MipSampler::sample_grad),
    /// to the bit.
    #[inline]
    #[must_use]
    pub fn sample_each(&self, uv: Vec2, gradient: Gradient<[f32; 2]>) -> [Rgba8; N] {
        self.sample_each_lanes(One, uv.to_array(), gradient).map(|color| Rgba8::from_bits(color.0))
    }

    /// [`sample_each`](Self::sample_each) at several places: the colours as words, as [`Rgba8::to_bits`] makes them.
    ///
    /// # Cost
    /// For each map after the first, its texels and their means alone.
    #[inline(always)]
    pub fn sample_each_lanes<L: Lanes>(
        &self,
        lanes: L,
        uv: [L::Number; 2],
        gradient: Gradient<[L::Number; 2]>,
    ) -> [L::U32; N] {
        lanes.apart(
            #[inline(always)]
            || self.filter.in_footprint(lanes, &self.mipmap, self.wrap, uv, gradient, |lambda| lambda),
        )
    }
}

impl<F: Storage, M: MipFilter, U: Wrap, V: Wrap, Z: Size> MipSampler<'_, F, M, U, V, Z> {
    /// The colour at `uv` for a level of detail of λ, which [`Gradient::lod`] tells.
    ///
    /// Any three floats have a colour: see [`Wrap`]; of λ, NaN is a pixel smaller than texels, and infinities are the
    /// last level or such a pixel.
    ///
    /// # Precision
    /// That of the filter.
    #[inline]
    #[must_use]
    pub fn sample_lod(&self, uv: Vec2, lambda: f32) -> Rgba8 {
        Rgba8::from_bits(self.sample_lod_lanes(One, uv.x, uv.y, lambda).0)
    }

    /// [`sample_lod`](Self::sample_lod) at several places: the colours as words, as [`Rgba8::to_bits`] makes them.
    #[inline(always)]
    pub fn sample_lod_lanes<L: Lanes>(
        &self,
        lanes: L,
        u: L::Number,
        v: L::Number,
        lambda: L::Number,
    ) -> L::U32 {
        let [colors] = self.filter.at_lod(lanes, &self.mipmap, self.wrap, [u, v], lambda);
        colors
    }

    /// The colour at `uv` of a pixel with these derivatives: for λ, or with its shape
    /// ([`Anisotropic`](crate::Anisotropic)).
    ///
    /// # Precision
    /// That of the filter and of [`Gradient::lod`].
    #[inline]
    #[must_use]
    pub fn sample_grad(&self, uv: Vec2, gradient: Gradient<[f32; 2]>) -> Rgba8 {
        Rgba8::from_bits(self.sample_grad_lanes(One, uv.x, uv.y, gradient).0)
    }

    /// [`sample_grad`](Self::sample_grad) at several places: the colours as words, as [`Rgba8::to_bits`] makes them.
    #[inline(always)]
    pub fn sample_grad_lanes<L: Lanes>(
        &self,
        lanes: L,
        u: L::Number,
        v: L::Number,
        gradient: Gradient<[L::Number; 2]>,
    ) -> L::U32 {
        let [colors] = self.sample_each_lanes(lanes, [u, v], gradient);
        colors
    }
}

impl<F: Storage, M: MipFilter, U: Wrap, V: Wrap, Z: Size, const N: usize> fmt::Debug
    for MipSampler<'_, F, M, U, V, Z, N>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MipSampler")
            .field("mipmap", &self.mipmap)
            .field("filter", &self.filter)
            .field("wrap", &self.wrap)
            .finish()
    }
}
