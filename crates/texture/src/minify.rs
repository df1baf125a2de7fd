//! From the levels of a mip map to a colour: which filter, in which levels.
//!
//! Space in: texture coordinates, and λ or the derivatives that it comes from ([`Derivatives`]). Space out: the colours
//! as they are stored.

use core::fmt::Debug;
use core::marker::PhantomData;

use alberti_math::lanes::Lanes;

use crate::blend::between;
use crate::filter::{Bilinear, Filter};
use crate::format::Storage;
use crate::{Bounds, Derivatives, LevelSize, Mipmap, Wrap};

/// The way of reading a [`Mipmap`]: [`Minify`], [`Trilinear`] for one, or
/// [`Anisotropic`](crate::Anisotropic). Other crates cannot add to
/// them.
pub trait MipFilter: MipKernel + Copy + Debug + Default + 'static {}

/// The working part of [`MipFilter`]; not nameable outside, so that it can still change.
pub trait MipKernel {
    /// The colours at `u` and `v`, as words, for a level of detail of λ.
    fn at_lod<L: Lanes, F: Storage, Z: LevelSize, U: Wrap, V: Wrap>(
        lanes: L,
        mipmap: &Mipmap<'_, F, Z>,
        u: L::Number,
        v: L::Number,
        lambda: L::Number,
    ) -> L::U32;

    /// The same for pixels that the derivatives tell the shapes of, with their λ bounded.
    #[inline(always)]
    fn in_footprint<L: Lanes, F: Storage, Z: LevelSize, U: Wrap, V: Wrap>(
        lanes: L,
        mipmap: &Mipmap<'_, F, Z>,
        u: L::Number,
        v: L::Number,
        derivatives: Derivatives<L::Number>,
        bounds: impl Bounds,
    ) -> L::U32 {
        let lambda = bounds.bound_lanes(lanes, derivatives.lod_lanes(lanes, mipmap.size()));
        Self::at_lod::<L, F, Z, U, V>(lanes, mipmap, u, v, lambda)
    }
}

/// Where texels are smaller than pixels (λ > 0) the filter `Min` in the levels that `Lv` says, elsewhere (also where λ
/// is NaN) the filter `Mag` in level 0.
///
/// # Cost
/// One filter, if all samples that are worked on together are on the same side of 0; the levels are those of `Lv`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Minify<Min, Lv, Mag = Min>(PhantomData<(Min, Lv, Mag)>);

/// [`Bilinear`] in two levels, and the mean of these.
pub type Trilinear = Minify<Bilinear, BetweenLevels>;

/// Which levels are read: [`BaseLevel`], [`NearestLevel`] or [`BetweenLevels`]. Other crates cannot add to them.
pub trait Levels: LevelKernel + Copy + Debug + Default + 'static {}

/// The working part of [`Levels`]; not nameable outside, so that it can still change.
pub trait LevelKernel {
    /// The colours as words, for λ from 0 to that of the last level.
    fn sample<L: Lanes, F: Storage, Z: LevelSize, U: Wrap, V: Wrap, Fl: Filter>(
        lanes: L,
        mipmap: &Mipmap<'_, F, Z>,
        u: L::Number,
        v: L::Number,
        lambda: L::Number,
    ) -> L::U32;
}

/// Level 0 alone: no mip map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BaseLevel;

/// The level nearest to λ, of two as near the one with fewer texels: level floor(λ + 1/2), exactly.
///
/// # Cost
/// One level for each of those that samples worked on together are in: mostly one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct NearestLevel;

/// The mean of the two levels about λ. With `t` as 256 λ rounded to the nearest integer (halves up), `near` the level
/// t / 256, `far` the next, and `t` now modulo 256, each channel is
///
/// ```text
/// ((256 - t) near + t far + 2^23) >> 24
/// ```
///
/// where `near` and `far` are 2^16 times the filter's colour in the level: for [`Bilinear`](crate::Bilinear), the sum
/// in its documentation before 2^15 is added.
///
/// # Precision
/// Weights sum to 2^24 exactly and there is one rounding, so a colour is never outside of the range of its texels, and
/// equal texels give that colour. Against real numbers it is less than 2 of 255 off: 0.5 of rounding, less than 1 of
/// the weights in the levels and 0.5 of those between levels; 1.5 where λ is a whole number of 256ths.
///
/// # Cost
/// Eight texels and 20 multiplications with `Bilinear`; only the nearer level where all are whole numbers, as where λ
/// is beyond the last level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BetweenLevels;

impl<Min: Filter, Lv: Levels, Mag: Filter> MipFilter for Minify<Min, Lv, Mag> {}

impl<Min: Filter, Lv: Levels, Mag: Filter> MipKernel for Minify<Min, Lv, Mag> {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: LevelSize, U: Wrap, V: Wrap>(
        lanes: L,
        mipmap: &Mipmap<'_, F, Z>,
        u: L::Number,
        v: L::Number,
        lambda: L::Number,
    ) -> L::U32 {
        let minified = lanes.less(lanes.splat(0.0), lambda);
        let bits = lanes.bits(minified);
        let mut found = lanes.word(0);
        if bits != 0 {
            let last = lanes.int_to_number(lanes.int(mipmap.last()));
            let lambda = lanes.min(lanes.max(lambda, lanes.splat(0.0)), last);
            found = Lv::sample::<L, F, Z, U, V, Min>(lanes, mipmap, u, v, lambda);
        }
        if bits != every::<L>() {
            let magnified = Mag::sample::<L, F, Z, U, V>(lanes, &mipmap.level(0), u, v);
            found = lanes.select_words(minified, found, magnified);
        }
        found
    }
}

impl Levels for BaseLevel {}

impl LevelKernel for BaseLevel {
    #[inline(always)]
    fn sample<L: Lanes, F: Storage, Z: LevelSize, U: Wrap, V: Wrap, Fl: Filter>(
        lanes: L,
        mipmap: &Mipmap<'_, F, Z>,
        u: L::Number,
        v: L::Number,
        _: L::Number,
    ) -> L::U32 {
        Fl::sample::<L, F, Z, U, V>(lanes, &mipmap.level(0), u, v)
    }
}

impl Levels for NearestLevel {}

impl LevelKernel for NearestLevel {
    #[inline(always)]
    fn sample<L: Lanes, F: Storage, Z: LevelSize, U: Wrap, V: Wrap, Fl: Filter>(
        lanes: L,
        mipmap: &Mipmap<'_, F, Z>,
        u: L::Number,
        v: L::Number,
        lambda: L::Number,
    ) -> L::U32 {
        each_word(
            lanes,
            lanes.round_scaled(lambda, 0),
            #[inline(always)]
            |level| Fl::sample::<L, F, Z, U, V>(lanes, &mipmap.level(level as usize), u, v),
        )
    }
}

impl Levels for BetweenLevels {}

impl LevelKernel for BetweenLevels {
    #[inline(always)]
    fn sample<L: Lanes, F: Storage, Z: LevelSize, U: Wrap, V: Wrap, Fl: Filter>(
        lanes: L,
        mipmap: &Mipmap<'_, F, Z>,
        u: L::Number,
        v: L::Number,
        lambda: L::Number,
    ) -> L::U32 {
        let position = lanes.round_scaled(lambda, 8);
        let along = position & lanes.word(255);
        let whole = lanes.store_words(along).as_ref().iter().all(|&along| along == 0);
        each_word(
            lanes,
            lanes.shr(position, 8),
            #[inline(always)]
            |level| {
                let level = level as usize;
                let near = Fl::sums::<L, F, Z, U, V>(lanes, &mipmap.level(level), u, v);
                let far = if whole {
                    near
                } else {
                    Fl::sums::<L, F, Z, U, V>(lanes, &mipmap.level(level + 1), u, v)
                };
                between(lanes, near, far, along)
            },
        )
    }
}

/// All lanes, as the bits of a mask.
const fn every<L: Lanes>() -> u32 {
    (1 << L::COUNT) - 1
}

/// What `f` makes of each word, asked once for all lanes that have the same. Closures that are this large are only
/// inlined, and so compiled for the lanes, if they say so.
#[inline(always)]
pub(crate) fn each_word<L: Lanes>(lanes: L, words: L::U32, mut f: impl FnMut(u32) -> L::U32) -> L::U32 {
    let words = lanes.store_words(words);
    let mut found = lanes.word(0);
    let mut left = every::<L>();
    while let Some(&word) = words.as_ref().get(left.trailing_zeros() as usize) {
        let same = words.as_ref().iter().rev().fold(0, |bits, &other| bits << 1 | u32::from(other == word));
        found = lanes.select_words(lanes.mask(same), f(word), found);
        left &= !same;
    }
    found
}
