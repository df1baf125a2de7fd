//! Bounds of the level of detail, for pictures that are to be sharper or softer.

use alberti_math::lanes::{Lanes, One};

use crate::format::Storage;
use crate::sealed::Sealed;
use crate::{Gradient, MipFilter, Mipmap, Size, Trilinear, Wrap};

/// A bias of λ, and its limits: min(max(λ + bias, least), greatest).
/// [`Bounded`](crate::Bounded) filters have them.
///
/// ```
/// use alberti_texture::LodBounds;
///
/// let sharper = LodBounds { bias: -0.5, greatest: 4.0, ..LodBounds::default() };
/// assert_eq!([sharper.bound(2.0), sharper.bound(7.0)], [1.5, 4.0]);
/// ```
///
/// # Precision
/// One rounding, that of the sum; in fixed point none, but λ + bias is to be within ±2^15 there.
///
/// # Cost
/// An addition and two comparisons a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LodBounds {
    /// The summand: below 0 for sharper pictures, above for softer ones.
    pub bias: f32,
    /// The least that comes out. Above 0, the levels below it are never read, nor is the filter of magnification used.
    pub least: f32,
    /// The greatest that comes out.
    pub greatest: f32,
}

impl Default for LodBounds {
    /// λ as it is.
    fn default() -> Self {
        Self { bias: 0.0, least: -64.0, greatest: 64.0 }
    }
}

impl LodBounds {
    /// λ with the bias, bounded; the least for NaN.
    #[must_use]
    pub fn bound(self, lambda: f32) -> f32 {
        self.bound_lanes(One, lambda)
    }

    /// [`bound`](Self::bound) of several.
    #[must_use]
    #[inline(always)]
    pub fn bound_lanes<L: Lanes>(self, lanes: L, lambda: L::Number) -> L::Number {
        let biased = lambda + lanes.splat(self.bias);
        lanes.min(lanes.max(biased, lanes.splat(self.least)), lanes.splat(self.greatest))
    }
}

/// Another filter with bounds of λ. Of an [`Anisotropic`](crate::Anisotropic) one these are bounds of its own λ; the
/// probes and their places stay.
///
/// ```
/// use alberti_texture::format::L8;
/// use alberti_texture::{Bounded, LodBounds, Mipmap, Repeat, Trilinear};
/// use glam::Vec2;
///
/// let board = Mipmap::new(L8, &[0, 255, 255, 0, 188], 2, 2)?;
/// let softer = Bounded { filter: Trilinear, bounds: LodBounds { bias: 0.5, ..LodBounds::default() } };
/// let sampler = board.sampler(softer, Repeat);
/// assert_eq!(sampler.sample_lod(Vec2::new(0.25, 0.25), 0.0).to_bytes()[0], 222);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Cost
/// That of the filter and of [`LodBounds`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Bounded<M = Trilinear> {
    /// The [`MipFilter`].
    pub filter: M,
    /// The bounds, which also hold for a λ that is given.
    pub bounds: LodBounds,
}

impl<M> Sealed for Bounded<M> {}

impl<M: MipFilter> MipFilter for Bounded<M> {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        lambda: L::Number,
    ) -> [L::U32; N] {
        self.filter.at_lod(lanes, mipmap, wrap, uv, self.bounds.bound_lanes(lanes, lambda))
    }

    #[inline(always)]
    fn in_footprint<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        gradient: Gradient<[L::Number; 2]>,
        bounded: impl Fn(L::Number) -> L::Number,
    ) -> [L::U32; N] {
        self.filter.in_footprint(
            lanes,
            mipmap,
            wrap,
            uv,
            gradient,
            #[inline(always)]
            |lambda| self.bounds.bound_lanes(lanes, bounded(lambda)),
        )
    }
}
