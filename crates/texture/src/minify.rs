//! From the levels of a mip map to a colour: which filter, in which levels.
//!
//! Space in: texture coordinates, and λ or the derivatives that it comes from ([`Gradient`]). Space out: the colours
//! as they are stored.

use core::fmt::Debug;

use alberti_math::each_pair;
use alberti_math::lanes::Lanes;

use crate::blend::between;
use crate::filter::{Bilinear, Filter};
use crate::format::Storage;
use crate::sealed::Sealed;
use crate::{Gradient, Mipmap, Size, Wrap};

/// The way of reading a [`Mipmap`]: [`BaseLevel`], [`NearestLevel`] or [`BetweenLevels`] with a [`Filter`],
/// [`Trilinear`], [`Minify`], [`Anisotropic`](crate::Anisotropic) or [`Bounded`](crate::Bounded), and
/// [`AnyMipFilter`](crate::AnyMipFilter) for one that is picked at run time. Sealed.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a filter of mip maps",
    note = "a filter of one level becomes one by `NearestLevel`, `BetweenLevels` or `BaseLevel` around it"
)]
pub trait MipFilter: Sealed + Copy + Debug + 'static {
    /// The colours of each map at (u, v), as words, for a level of detail of λ, with a wrap mode for u and one for v.
    fn at_lod<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        lambda: L::Number,
    ) -> [L::U32; N];

    /// The same for pixels that the derivatives tell the shapes of, and so λ, which `bounded` changes.
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
        let lambda = bounded(gradient.lod_lanes(lanes, mipmap.size()));
        self.at_lod(lanes, mipmap, wrap, uv, lambda)
    }
}

/// Level 0 alone: no mip map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BaseLevel<F>(
    /// The [`Filter`].
    pub F,
);

/// The level nearest to λ, of two as near the one with fewer texels: level floor(λ + 1/2), exactly, of those there are.
///
/// # Cost
/// One level for each of those that samples worked on together are in: mostly one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct NearestLevel<F>(
    /// The [`Filter`] in the level.
    pub F,
);

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
/// the weights in the levels and 0.5 of those between levels. It is less than 1.5 where λ is a whole number of 256ths.
///
/// # Cost
/// Eight texels and 20 multiplications with `Bilinear`; only the nearer level where all are whole numbers, as where λ
/// is beyond the last level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BetweenLevels<F>(
    /// The [`Filter`] in each level.
    pub F,
);

/// [`Bilinear`] in two levels, and the mean of these: [`BetweenLevels`], with a short way for magnification.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Trilinear;

/// Where texels are smaller than pixels (λ > 0) the filter `min`, elsewhere (also where λ is NaN) the filter `mag` in
/// level 0.
///
/// ```
/// use alberti_texture::{Bilinear, Minify, Mipmap, Nearest, NearestLevel, Repeat, format::L8};
///
/// // Pixels of the largest level have sharp edges, smaller ones a smooth picture.
/// let board = Mipmap::new(L8, &[0, 255, 255, 0, 188], 2, 2)?;
/// let sampler = board.sampler(Minify { min: NearestLevel(Bilinear), mag: Nearest }, Repeat);
/// assert_eq!(sampler.sample_lod([0.3, 0.3].into(), -1.0).to_bytes()[0], 255);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Cost
/// One filter, if all samples that are worked on together are on the same side of 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Minify<Min, Mag> {
    /// The [`MipFilter`] of minification.
    pub min: Min,
    /// The [`Filter`] of magnification.
    pub mag: Mag,
}

impl<F> Sealed for BaseLevel<F> {}
impl<F> Sealed for NearestLevel<F> {}
impl<F> Sealed for BetweenLevels<F> {}
impl Sealed for Trilinear {}
impl<Min, Mag> Sealed for Minify<Min, Mag> {}

impl<Fl: Filter> MipFilter for BaseLevel<Fl> {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        _: L::Number,
    ) -> [L::U32; N] {
        self.0.sample(lanes, &mipmap.level(0), wrap, uv)
    }
}

impl<Fl: Filter> MipFilter for NearestLevel<Fl> {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        lambda: L::Number,
    ) -> [L::U32; N] {
        each_word(
            lanes,
            lanes.round_scaled(among_levels(lanes, mipmap, lambda), 0),
            #[inline(always)]
            |level| self.0.sample(lanes, &mipmap.level(level as usize), wrap, uv),
        )
    }
}

impl<Fl: Filter> MipFilter for BetweenLevels<Fl> {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        lambda: L::Number,
    ) -> [L::U32; N] {
        let position = lanes.round_scaled(among_levels(lanes, mipmap, lambda), 8);
        let along = position & lanes.word(255);
        let whole = lanes.bits(lanes.equal_words(along, lanes.word(0))) == every::<L>();
        each_word(
            lanes,
            lanes.shr(position, 8),
            #[inline(always)]
            |level| {
                let level = level as usize;
                let near = self.0.sums(lanes, &mipmap.level(level), wrap, uv);
                let far = if whole { near } else { self.0.sums(lanes, &mipmap.level(level + 1), wrap, uv) };
                each_pair(
                    near,
                    far,
                    lanes.word(0),
                    #[inline(always)]
                    |near, far| between(lanes, near, far, along),
                )
            },
        )
    }
}

impl MipFilter for Trilinear {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        lambda: L::Number,
    ) -> [L::U32; N] {
        Minify { min: BetweenLevels(Bilinear), mag: Bilinear }.at_lod(lanes, mipmap, wrap, uv, lambda)
    }
}

impl<Min: MipFilter, Mag: Filter> MipFilter for Minify<Min, Mag> {
    #[inline(always)]
    fn at_lod<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        mipmap: &Mipmap<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
        lambda: L::Number,
    ) -> [L::U32; N] {
        let minified = lanes.less(lanes.splat(0.0), lambda);
        let bits = lanes.bits(minified);
        let mut found = [lanes.word(0); N];
        if bits != 0 {
            found = self.min.at_lod(lanes, mipmap, wrap, uv, lambda);
        }
        if bits != every::<L>() {
            let magnified = self.mag.sample(lanes, &mipmap.level(0), wrap, uv);
            found = each_pair(
                found,
                magnified,
                lanes.word(0),
                #[inline(always)]
                |found, magnified| lanes.select_words(minified, found, magnified),
            );
        }
        found
    }
}

/// λ from that of level 0 to that of the last; that of level 0 for NaN.
#[inline(always)]
pub(crate) fn among_levels<L: Lanes, F: Storage, Z: Size, const N: usize>(
    lanes: L,
    mipmap: &Mipmap<'_, F, Z, N>,
    lambda: L::Number,
) -> L::Number {
    let last = lanes.int_to_number(lanes.int(mipmap.last()));
    lanes.min(lanes.max(lambda, lanes.splat(0.0)), last)
}

/// All lanes, as the bits of a mask.
const fn every<L: Lanes>() -> u32 {
    (1 << L::COUNT) - 1
}

/// The words that `f` makes of each word, asked once for all lanes that have the same. Closures that are this large are
/// only inlined, and so compiled for the lanes, if they say so.
#[inline(always)]
pub(crate) fn each_word<L: Lanes, const N: usize>(
    lanes: L,
    words: L::U32,
    mut f: impl FnMut(u32) -> [L::U32; N],
) -> [L::U32; N] {
    let each = lanes.store_words(words);
    let mut found = [lanes.word(0); N];
    let mut left = every::<L>();
    while let Some(&word) = each.as_ref().get(left.trailing_zeros() as usize) {
        let same = lanes.equal_words(words, lanes.word(word));
        found = each_pair(
            found,
            f(word),
            lanes.word(0),
            #[inline(always)]
            |found, new| lanes.select_words(same, new, found),
        );
        left &= !lanes.bits(same);
    }
    found
}
