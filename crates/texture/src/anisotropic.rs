//! Pixels that are longer in the texture than they are wide.

use alberti_math::lanes::Lanes;

use crate::blend::mean_of;
use crate::format::Storage;
use crate::minify::each_word;
use crate::sealed::Sealed;
use crate::{AnyFilter, BetweenLevels, Bilinear, Gradient, Minify, MipFilter, Mipmap, Size, Trilinear, Wrap};

/// The mean of up to `probes` colours of `filter` along the longer axis of the ellipse that a round pixel covers of the
/// texture. Their number n is the ratio of the two axes, rounded up to a power of two. Sharp where a plane is seen at
/// an angle.
///
/// ```text
///         +---------------------------+
///  short  |   x      x      x      x  |     n = 2^k probes, k = ceil(log2(long / short)), at most probes
///         +---------------------------+     at (i + 1/2)/n - 1/2 of the axis, i from 0 to n - 1
///                    long                   λ = max(log2 short, log2 long - log2 probes)
/// ```
///
/// The axes are those of [`Gradient::axes_lanes`], and stay where they are when the camera is rolled. A level of
/// detail alone has no shape: then it is `filter`.
///
/// # Precision
/// Axes as [`Gradient::axes_lanes`] says, the logarithms of their lengths as [`Gradient::lod`]; the mean is
/// rounded once, halves up, after that of each probe. So equal texels give their colour, and none is outside of the
/// range of its texels.
///
/// # Cost
/// n times that of `filter`, the axes and two logarithms.
///
/// ```
/// use alberti_texture::{Anisotropic, Mipmap, Repeat, Trilinear, format::L8};
///
/// let board = Mipmap::new(L8, &[0, 255, 255, 0, 188], 2, 2)?;
/// let sampler = board.sampler(Anisotropic { probes: 8, filter: Trilinear }, Repeat);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Anisotropic<M = Trilinear> {
    /// The greatest number of probes: 1, 2, 4, 8 or 16. Others count as the next lower of these, 0 as 1.
    pub probes: u32,
    /// The [`MipFilter`] of each probe.
    pub filter: M,
}

impl<M> Sealed for Anisotropic<M> {}

impl<M: MipFilter> Anisotropic<M> {
    /// 0 to 4.
    #[inline(always)]
    fn log2_probes(self) -> u32 {
        u32::BITS - 1 - self.probes.clamp(1, 16).leading_zeros()
    }

    /// The probes of pixels.
    #[inline(always)]
    fn probes<L: Lanes>(
        self,
        lanes: L,
        gradient: Gradient<[L::Number; 2]>,
        size: [u32; 2],
        bounded: impl Fn(L::Number) -> L::Number,
    ) -> Probes<L> {
        let axes = gradient.axes_lanes(lanes, size);
        let [across, down] = axes.log2_lengths_lanes(lanes, size);
        let (long, short) = (lanes.max(across, down), lanes.min(across, down));
        let is_across = lanes.less(down, across);
        let du = lanes.select(is_across, axes.dx[0], axes.dy[0]);
        let dv = lanes.select(is_across, axes.dx[1], axes.dy[1]);
        let greatest = self.log2_probes();
        let all = lanes.int_to_number(lanes.int(greatest.cast_signed()));
        let lambda = bounded(lanes.max(short, long - all));
        // The least integer that is not less than the difference.
        let count = lanes.word(0) - lanes.floor_scaled(short - long, 0);
        Probes { log2_count: lanes.min_words(count, lanes.word(greatest)), axis: [du, dv], lambda }
    }
}

/// Places along an axis, of several pixels, all in one level of detail: those at which a filter reads its levels.
#[derive(Clone, Copy, Debug)]
pub struct Probes<L: Lanes> {
    /// log2 of their number, 0 to 4.
    pub log2_count: L::U32,
    /// The axis along which they lie, as a part of the texture.
    pub axis: [L::Number; 2],
    /// The level of detail.
    pub lambda: L::Number,
}

impl<L: Lanes> Probes<L> {
    /// The place of one of 2^`log2_count` probes of pixels at `uv`.
    #[inline(always)]
    pub fn place(&self, lanes: L, log2_count: u32, probe: u32, [u, v]: [L::Number; 2]) -> [L::Number; 2] {
        // (probe + 1/2)/n - 1/2 as a number of halves of n-ths: exact, and no division.
        let halves = (2 * probe + 1).cast_signed() - (1 << log2_count);
        let half_of_nth = f32::from_bits((126 - log2_count) << 23);
        let place = lanes.int_to_number(lanes.int(halves)) * lanes.splat(half_of_nth);
        let [du, dv] = self.axis;
        [u + du * place, v + dv * place]
    }

    /// The means of the colours of a filter there.
    #[inline(always)]
    fn mean<F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        filter: impl MipFilter,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> [L::U32; N] {
        each_word(
            lanes,
            self.log2_count,
            #[inline(always)]
            |count| {
                mean_of(
                    lanes,
                    count,
                    #[inline(always)]
                    |probe| {
                        filter.at_lod(lanes, mipmap, wrap, self.place(lanes, count, probe, uv), self.lambda)
                    },
                )
            },
        )
    }
}

impl<M: MipFilter> MipFilter for Anisotropic<M> {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        lambda: L::Number,
    ) -> [L::U32; N] {
        self.filter.at_lod(lanes, mipmap, wrap, uv, lambda)
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
        self.probes(lanes, gradient, mipmap.size(), bounded).mean(lanes, self.filter, mipmap, wrap, uv)
    }
}

/// A [`MipFilter`] that is picked at run time: each is the type of its name, bit for bit.
///
/// # Cost
/// Two matches a read and one a probe. The code of about four filters: all share that of [`Anisotropic`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyMipFilter {
    /// Level 0 alone, by this filter: no mip map.
    Base(AnyFilter),
    /// [`Trilinear`].
    Trilinear,
    /// [`Anisotropic`] of [`Trilinear`].
    Anisotropic {
        /// The greatest number of probes.
        probes: u32,
    },
}

impl Sealed for AnyMipFilter {}

impl AnyMipFilter {
    /// [`Trilinear`] with another filter where texels are larger than pixels.
    #[inline(always)]
    fn shared(self) -> Minify<BetweenLevels<Bilinear>, AnyFilter> {
        let mag = if let Self::Base(filter) = self { filter } else { AnyFilter::Bilinear };
        Minify { min: BetweenLevels(Bilinear), mag }
    }

    /// The places and the level of detail at which it reads a texture of these sides for pixels with these derivatives,
    /// of which λ comes out as `bounded` changes it. At each it is [`Trilinear`]; of level 0 alone λ is -1, as of
    /// magnification.
    #[inline(always)]
    pub fn probes<L: Lanes>(
        self,
        lanes: L,
        gradient: Gradient<[L::Number; 2]>,
        size: [u32; 2],
        bounded: impl Fn(L::Number) -> L::Number,
    ) -> Probes<L> {
        let zero = lanes.splat(0.0);
        let alone = |lambda| Probes { log2_count: lanes.word(0), axis: [zero; 2], lambda };
        match self {
            Self::Base(_) => alone(lanes.splat(-1.0)),
            Self::Trilinear => alone(bounded(gradient.lod_lanes(lanes, size))),
            Self::Anisotropic { probes } => {
                Anisotropic { probes, filter: Trilinear }.probes(lanes, gradient, size, bounded)
            }
        }
    }
}

impl MipFilter for AnyMipFilter {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        lambda: L::Number,
    ) -> [L::U32; N] {
        // Level 0 alone is that of the greatest texels.
        let lambda = if let Self::Base(_) = self { lanes.splat(-1.0) } else { lambda };
        self.shared().at_lod(lanes, mipmap, wrap, uv, lambda)
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
        self.probes(lanes, gradient, mipmap.size(), bounded).mean(lanes, self.shared(), mipmap, wrap, uv)
    }
}
