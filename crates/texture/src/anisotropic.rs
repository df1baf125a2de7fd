//! Pixels that are longer in the texture than they are wide.

use core::marker::PhantomData;

use alberti_math::lanes::Lanes;

use crate::blend::mean_of;
use crate::format::Storage;
use crate::minify::{MipKernel, each_word};
use crate::{Bounds, Derivatives, LevelSize, MipFilter, Mipmap, Trilinear, Wrap};

/// The mean of up to `PROBES` (1, 2, 4, 8 or 16) colours of `M` along the longer axis of the ellipse that a round pixel
/// covers of the texture, as many as it is longer than the other one: sharp where a plane is seen at an angle.
///
/// ```text
///         +---------------------------+
///  short  |   x      x      x      x  |     n = 2^k probes, k = ceil(log2(long / short)), at most PROBES
///         +---------------------------+     at (i + 1/2)/n - 1/2 of the axis, i from 0 to n - 1
///                    long                   λ = max(log2 short, log2 long - log2 PROBES)
/// ```
///
/// The axes are those of [`Derivatives::axes_lanes`], and stay where they are when the camera is rolled. A level of
/// detail alone has no shape: then it is `M`. [`LodBounds`](crate::LodBounds) are those of this λ; n and the places
/// stay.
///
/// # Precision
/// Axes as [`Derivatives::axes_lanes`] says, the logarithms of their lengths as [`Derivatives::lod`]; the mean is
/// rounded once, halves up, after that of each probe. So equal texels give their colour, and none is outside of the
/// range of its texels.
///
/// # Cost
/// n times that of `M`, the axes and two logarithms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Anisotropic<const PROBES: u32, M = Trilinear>(PhantomData<M>);

impl<const PROBES: u32, M: MipFilter> MipFilter for Anisotropic<PROBES, M> {}

impl<const PROBES: u32, M> Anisotropic<PROBES, M> {
    const LOG2: u32 = {
        assert!(PROBES.is_power_of_two() && PROBES <= 16, "Anisotropic: 1, 2, 4, 8 or 16 probes");
        PROBES.trailing_zeros()
    };
}

impl<const PROBES: u32, M: MipFilter> MipKernel for Anisotropic<PROBES, M> {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: LevelSize, U: Wrap, V: Wrap>(
        lanes: L,
        mipmap: &Mipmap<'_, F, Z>,
        u: L::Number,
        v: L::Number,
        lambda: L::Number,
    ) -> L::U32 {
        M::at_lod::<L, F, Z, U, V>(lanes, mipmap, u, v, lambda)
    }

    #[inline(always)]
    fn in_footprint<L: Lanes, F: Storage, Z: LevelSize, U: Wrap, V: Wrap>(
        lanes: L,
        mipmap: &Mipmap<'_, F, Z>,
        u: L::Number,
        v: L::Number,
        derivatives: Derivatives<L::Number>,
        bounds: impl Bounds,
    ) -> L::U32 {
        let axes = derivatives.axes_lanes(lanes, mipmap.size());
        let [across, down] = axes.log2_lengths(lanes, mipmap.size());
        let (long, short) = (lanes.max(across, down), lanes.min(across, down));
        let is_across = lanes.less(down, across);
        let du = lanes.select(is_across, axes.du_dx, axes.du_dy);
        let dv = lanes.select(is_across, axes.dv_dx, axes.dv_dy);
        let greatest = Self::LOG2;
        let all = lanes.int_to_number(lanes.int(greatest.cast_signed()));
        let lambda = bounds.bound_lanes(lanes, lanes.max(short, long - all));
        // The least integer that is not less than the difference.
        let count = lanes.word(0) - lanes.floor_scaled(short - long, 0);
        each_word(
            lanes,
            lanes.min_words(count, lanes.word(greatest)),
            #[inline(always)]
            |count| {
                mean_of(
                    lanes,
                    count,
                    #[inline(always)]
                    |probe| {
                        // (probe + 1/2)/n - 1/2 as a number of halves of n-ths: exact, and no division.
                        let halves = (2 * probe + 1).cast_signed() - (1 << count);
                        let half_of_nth = f32::from_bits((126 - count) << 23);
                        let place = lanes.int_to_number(lanes.int(halves)) * lanes.splat(half_of_nth);
                        M::at_lod::<L, F, Z, U, V>(lanes, mipmap, u + du * place, v + dv * place, lambda)
                    },
                )
            },
        )
    }
}
