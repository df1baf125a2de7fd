//! What a texture keeps, and how a texel is found in it.

use alberti_math::lanes::Lanes;

use super::TexelFormat;
use crate::{Size, Texture};

/// The way in which a texture keeps its texels: any [`TexelFormat`], one texel after the other, or
/// [`Indexed`](super::Indexed), packed and with a palette. Other crates add to it by [`TexelFormat`].
pub trait Storage: Sized + 'static {
    /// What the texture's memory is made of: a texel, or a byte with several.
    type Element: Copy + Send + Sync + 'static;
    /// What the texture refers to beside the texels: nothing, or colours.
    type Palette<'a>: Copy;

    /// The colours of texels as words; anything for those that do not lie in the texture.
    fn fetch<L: Lanes, Z: Size>(
        lanes: L,
        texture: &Texture<'_, Self, Z>,
        row: L::U32,
        column: L::U32,
    ) -> L::U32;

    /// The texels as numbers, which count 65535ths: [`TexelFormat::scalar`]. Anything from 0 to 65535 for those that do
    /// not lie in the texture.
    #[inline(always)]
    fn fetch_scalars<L: Lanes, Z: Size>(
        lanes: L,
        texture: &Texture<'_, Self, Z>,
        row: L::U32,
        column: L::U32,
    ) -> L::U32 {
        (Self::fetch(lanes, texture, row, column) & lanes.word(255)) * lanes.word(257)
    }
}

impl<F: TexelFormat> Storage for F {
    type Element = F::Texel;
    type Palette<'a> = ();

    #[inline(always)]
    fn fetch<L: Lanes, Z: Size>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        row: L::U32,
        column: L::U32,
    ) -> L::U32 {
        texture.words(lanes, row, column, |texel| texel.map_or(0, |&texel| F::decode(texel).to_bits()))
    }

    #[inline(always)]
    fn fetch_scalars<L: Lanes, Z: Size>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        row: L::U32,
        column: L::U32,
    ) -> L::U32 {
        texture.words(lanes, row, column, |texel| texel.map_or(0, |&texel| F::scalar(texel).into()))
    }
}
