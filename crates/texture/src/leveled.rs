//! Mip maps of which the levels are chosen once for many samples.

use core::fmt;

use alberti_math::lanes::Lanes;

use crate::format::{Rgb565, Storage};
use crate::minify::{NearestLevel, Trilinear, among_levels};
use crate::packed::{Packed, bilinear};
use crate::{
    AnySize, Bilinear, Filter, Gradient, MipFilter, MipSampler, Sampler, Size, TexelFormat, Texture, Wrap,
};

/// Filters of a level, or of one and the next, that need nothing of λ but which.
pub trait Levels: MipFilter {
    /// Whether there are two, with a share of the second.
    const TWO: bool;
}

impl<F: Filter> Levels for NearestLevel<F> {
    const TWO: bool = false;
}

impl Levels for Trilinear {
    const TWO: bool = true;
}

/// A mip map that is read in levels which were [chosen](Self::settled) before, by one level of detail for many samples;
/// until then in the largest. Made by [`MipSampler::leveled`].
///
/// # Cost
/// A sample costs what a texture does, or two and a mean. The choice has a logarithm, and the slices of the levels. It
/// refers to the mip map, as it is copied for each triangle.
#[derive(Clone, Copy)]
pub struct Leveled<'a, F: Storage, M, U, V = U, Z: Size = AnySize> {
    map: &'a MipSampler<'a, F, M, U, V, Z>,
    near: Texture<'a, F, Z::Level>,
    far: Texture<'a, F, Z::Level>,
    /// The share of the farther level, in 32nds.
    along: u8,
}

impl<'a, F: Storage, M: Levels, U: Wrap, V: Wrap, Z: Size> MipSampler<'a, F, M, U, V, Z> {
    /// The same for derivatives that are not asked for at each sample.
    #[must_use]
    pub fn leveled(&'a self) -> Leveled<'a, F, M, U, V, Z> {
        let level = self.mipmap().level(0);
        Leveled { map: self, near: level, far: level, along: 0 }
    }
}

impl<'a, F: Storage, M: Levels, U: Wrap, V: Wrap, Z: Size> Leveled<'a, F, M, U, V, Z> {
    /// The format of the texels.
    #[must_use]
    pub fn format(&self) -> F {
        self.near.format()
    }

    /// The same in the levels for the derivatives in the first lane: those of the filter, but that the way between two
    /// is rounded to 32nds.
    #[inline(always)]
    #[must_use]
    pub fn settled<L: Lanes>(&self, lanes: L, gradient: &Gradient<[L::Number; 2]>) -> Self {
        let map = self.map.mipmap();
        let lambda = among_levels(lanes, map, gradient.lod_lanes(lanes, map.size()));
        let bits = const { if M::TWO { 5 } else { 0 } };
        let position = lanes.store_words(lanes.round_scaled(lambda, bits));
        let position = position.as_ref().first().copied().unwrap_or_default();
        let level = (position >> bits) as usize;
        #[expect(clippy::cast_possible_truncation, reason = "at most 5 bits")]
        let along = (position & ((1 << bits) - 1)) as u8;
        let near = map.level(level);
        Self { map: self.map, near, far: if along == 0 { near } else { map.level(level + 1) }, along }
    }
}

impl<'a, F: Storage, Fl: Filter, U: Wrap, V: Wrap, Z: Size> Leveled<'a, F, NearestLevel<Fl>, U, V, Z> {
    /// The level alone, with the filter.
    #[inline(always)]
    #[must_use]
    pub fn level(&self) -> Sampler<'a, F, Fl, U, V, Z::Level> {
        let (u, v) = self.map.wraps();
        self.near.sampler_per_axis(self.map.filter().0, u, v)
    }
}

impl<'a, F: TexelFormat, U: Wrap, V: Wrap, Z: Size> Leveled<'a, F, Trilinear, U, V, Z> {
    /// The same in one of the two levels: the second where its share, in 32nds, and the threshold, from 0 to 31, add up
    /// to one.
    #[inline(always)]
    #[must_use]
    pub fn either(&self, threshold: u8) -> Self {
        let near = if self.along + (threshold & 31) < 32 { self.near } else { self.far };
        Self { map: self.map, near, far: near, along: 0 }
    }

    /// The first level alone, with the filter of each.
    #[inline(always)]
    #[must_use]
    pub fn level(&self) -> Sampler<'a, F, Bilinear, U, V, Z::Level> {
        let (u, v) = self.map.wraps();
        self.near.sampler_per_axis(Bilinear, u, v)
    }
}

impl<F: Packed, U: Wrap, V: Wrap, Z: Size> Leveled<'_, F, Trilinear, U, V, Z> {
    /// The mean of both levels as a texel: [`MipSampler::packed_grad_lanes`].
    #[inline(always)]
    pub fn packed_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> L::U32 {
        let wraps = self.map.wraps();
        let near = bilinear(lanes, &self.near, wraps, uv);
        if self.along == 0 {
            return Rgb565::gathered(lanes, near);
        }
        let far = bilinear(lanes, &self.far, wraps, uv);
        Rgb565::gathered(lanes, Rgb565::blended(lanes, near, far, lanes.word(self.along.into())))
    }
}

impl<F: Storage, M, U, V, Z: Size> fmt::Debug for Leveled<'_, F, M, U, V, Z> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Leveled")
            .field("near", &self.near)
            .field("along", &self.along)
            .finish_non_exhaustive()
    }
}
