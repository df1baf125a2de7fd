//! A texture together with the way of reading it.

use core::fmt;

use alberti_math::lanes::{Lanes, One};
use alberti_math::{Rgba8, map2};
use glam::Vec2;

use crate::blend::scalar_number;
use crate::filter::{Filter, bordered};
use crate::format::Storage;
use crate::{AnySize, Bilinear, Nearest, Size, TexelFormat, Texture, Wrap};

/// A texture with a filter and a wrap mode for each axis, which a fragment asks for a colour.
///
/// Made by [`Texture::sampler`] and [`Texture::sampler_per_axis`]; as cheap to copy as the texture.
#[derive(Clone, Copy)]
pub struct Sampler<'a, F: Storage, Fl, U, V = U, Z: Size = AnySize> {
    texture: Texture<'a, F, Z>,
    filter: Fl,
    wrap: (U, V),
}

impl<'a, F: Storage, Fl: Filter, U: Wrap, V: Wrap, Z: Size> Sampler<'a, F, Fl, U, V, Z> {
    #[inline]
    pub(crate) const fn new(texture: Texture<'a, F, Z>, filter: Fl, wrap: (U, V)) -> Self {
        Self { texture, filter, wrap }
    }

    /// The wrap modes of u and v.
    #[inline(always)]
    pub(crate) const fn wraps(&self) -> (U, V) {
        self.wrap
    }

    /// The texture that is sampled.
    #[must_use]
    pub const fn texture(&self) -> Texture<'a, F, Z> {
        self.texture
    }

    /// The colour at `uv`: u to the right, v up, (0, 0) the bottom left corner of the image and (1, 1) the top right.
    ///
    /// Any two floats have a colour: see [`Wrap`].
    ///
    /// # Precision
    /// See [`Nearest`](crate::Nearest) and [`Bilinear`](crate::Bilinear).
    #[inline]
    #[must_use]
    pub fn sample(&self, uv: Vec2) -> Rgba8 {
        Rgba8::from_bits(self.sample_lanes(One, uv.x, uv.y).0)
    }

    /// [`sample`](Self::sample) at several places: the colours as words, as [`Rgba8::to_bits`] makes them.
    #[inline(always)]
    pub fn sample_lanes<L: Lanes>(&self, lanes: L, u: L::Number, v: L::Number) -> L::U32 {
        let [colors] = lanes.apart(
            #[inline(always)]
            || self.filter.sample(lanes, &self.texture, self.wrap, [u, v]),
        );
        colors
    }

    /// The numbers from 0 to 1 at several places of a map of numbers, such as heights: the red channel. They are in
    /// steps of 1/65535, as a filter's mean has them, and [`L16`](crate::format::L16) in each texel.
    ///
    /// # Precision
    /// In [`Nearest`], the texel's number correctly rounded. In [`Bilinear`](crate::Bilinear), the formula of its
    /// documentation with 65535ths instead of bytes: within 1/256 of the texels' difference, and 0.5/65535, of the
    /// filter in real numbers. In fixed point rounded down.
    #[inline(always)]
    pub fn scalar_lanes<L: Lanes>(&self, lanes: L, u: L::Number, v: L::Number) -> L::Number {
        lanes.apart(
            #[inline(always)]
            || scalar_number(lanes, self.filter.scalars(lanes, &self.texture, self.wrap, [u, v])),
        )
    }
}

impl<F: TexelFormat, U: Wrap, V: Wrap, Z: Size> Sampler<'_, F, Nearest, U, V, Z> {
    /// The words that `word` makes of the texels as they are stored; there always is one, but in a
    /// [`Border`](crate::Border).
    #[inline(always)]
    pub fn stored_lanes<L: Lanes>(
        &self,
        lanes: L,
        u: L::Number,
        v: L::Number,
        word: impl Fn(Option<F::Texel>) -> u32,
    ) -> L::U32 {
        stored(lanes, &self.texture, self.wrap, self.texture.cells(lanes, [u, v], self.wrap), word)
    }
}

impl<F: TexelFormat, U: Wrap, V: Wrap, Z: Size> Sampler<'_, F, Bilinear, U, V, Z> {
    /// The words that `word` makes of one of the four texels each, as they are stored.
    ///
    /// It is the right one where its share, in 256ths, and the first of `thresholds`, from 0 to 255, add up to one. It
    /// is the upper one by the second. So of many samples with all thresholds the mean is the filter's.
    #[inline(always)]
    pub fn either_lanes<L: Lanes>(
        &self,
        lanes: L,
        uv: [L::Number; 2],
        thresholds: [L::U32; 2],
        word: impl Fn(Option<F::Texel>) -> u32,
    ) -> L::U32 {
        let at = self.texture.either(lanes, uv, self.wrap, thresholds);
        stored(lanes, &self.texture, self.wrap, at, word)
    }
}

/// The words that `word` makes of the texels in a column and a row that is counted from the bottom.
#[inline(always)]
fn stored<L: Lanes, F: TexelFormat, U: Wrap, V: Wrap, Z: Size>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    wrap: (U, V),
    at: [L::U32; 2],
    word: impl Fn(Option<F::Texel>) -> u32,
) -> L::U32 {
    let borders = map2([wrap.0.border(), wrap.1.border()], |border| border.map(|_| word(None)));
    bordered(lanes, texture.height(), at, borders, |row, column| {
        texture.lone_words(lanes, row, column, |texel| word(texel.copied()))
    })
}

impl<F: Storage, Fl: Filter, U: Wrap, V: Wrap, Z: Size> fmt::Debug for Sampler<'_, F, Fl, U, V, Z> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sampler")
            .field("texture", &self.texture)
            .field("filter", &self.filter)
            .field("wrap", &self.wrap)
            .finish()
    }
}
