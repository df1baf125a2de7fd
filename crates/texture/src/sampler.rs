//! A texture together with the way of reading it.

use core::fmt;
use core::marker::PhantomData;

use alberti_math::Rgba8;
use glam::Vec2;

use crate::filter::Filter;
use crate::{TexelFormat, Texture, Wrap};

/// A texture with a filter and a wrap mode for each axis: what a fragment asks for a colour.
///
/// Made by [`Texture::sampler`] and [`Texture::sampler_per_axis`]; as cheap to copy as the texture.
pub struct Sampler<'a, F: TexelFormat, Fl, U, V = U> {
    texture: Texture<'a, F>,
    modes: PhantomData<(Fl, U, V)>,
}

impl<'a, F: TexelFormat, Fl: Filter, U: Wrap, V: Wrap> Sampler<'a, F, Fl, U, V> {
    #[inline]
    pub(crate) const fn new(texture: Texture<'a, F>) -> Self {
        Self { texture, modes: PhantomData }
    }

    /// The texture that is sampled.
    #[must_use]
    pub const fn texture(&self) -> Texture<'a, F> {
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
        Fl::sample::<F, U, V>(&self.texture, uv)
    }
}

impl<F: TexelFormat, Fl, U, V> Clone for Sampler<'_, F, Fl, U, V> {
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: TexelFormat, Fl, U, V> Copy for Sampler<'_, F, Fl, U, V> {}

impl<F: TexelFormat, Fl: Filter, U: Wrap, V: Wrap> fmt::Debug for Sampler<'_, F, Fl, U, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sampler")
            .field("texture", &self.texture)
            .field("filter", &Fl::default())
            .field("wrap", &(U::default(), V::default()))
            .finish()
    }
}
