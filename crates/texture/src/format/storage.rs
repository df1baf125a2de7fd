//! The texels that a texture keeps, and the way to one of them.

use alberti_math::lanes::Lanes;
use alberti_math::map2;
use core::fmt::Debug;

use super::TexelFormat;
use crate::sealed::Sealed;
use crate::{Size, Texture};

/// The way in which a texture keeps its texels: any [`TexelFormat`], one texel after the other, or
/// [`Indexed`](super::Indexed), packed and with a palette. Sealed; other crates add to it by [`TexelFormat`].
pub trait Storage: Sealed + Copy + Debug {
    /// A piece of the texture's memory: a texel, or a byte with several.
    type Element: Copy + Send + Sync + 'static;

    /// The number of texels in such a piece; each row begins with a new one.
    const IN_ELEMENT: u32 = 1;

    /// The colours of texels as words; anything for those that do not lie in the texture.
    fn fetch<L: Lanes, Z: Size>(
        self,
        lanes: L,
        texture: &Texture<'_, Self, Z>,
        row: L::U32,
        column: L::U32,
    ) -> L::U32;

    /// [`fetch`](Self::fetch) of each plane in two columns, the second of which mostly follows the first.
    #[inline(always)]
    fn fetch_pairs<L: Lanes, Z: Size, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, Self, Z, N>,
        row: L::U32,
        columns: [L::U32; 2],
    ) -> [[L::U32; 2]; N] {
        texture.each_plane(
            [lanes.word(0); 2],
            #[inline(always)]
            |plane| {
                map2(
                    columns,
                    #[inline(always)]
                    |column| self.fetch(lanes, &plane, row, column),
                )
            },
        )
    }

    /// The texels as numbers, which count 65535ths: [`TexelFormat::scalar`]. Anything from 0 to 65535 for those that do
    /// not lie in the texture.
    #[inline(always)]
    fn fetch_scalars<L: Lanes, Z: Size>(
        self,
        lanes: L,
        texture: &Texture<'_, Self, Z>,
        row: L::U32,
        column: L::U32,
    ) -> L::U32 {
        (self.fetch(lanes, texture, row, column) & lanes.word(255)) * lanes.word(257)
    }
}

impl<F: TexelFormat> Sealed for F {}

impl<F: TexelFormat> Storage for F {
    type Element = F::Texel;

    #[inline(always)]
    fn fetch<L: Lanes, Z: Size>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z>,
        row: L::U32,
        column: L::U32,
    ) -> L::U32 {
        texture.words(
            lanes,
            row,
            column,
            #[inline(always)]
            |texel| texel.map_or(0, |&texel| self.decode(texel).to_bits()),
        )
    }

    #[inline(always)]
    fn fetch_pairs<L: Lanes, Z: Size, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z, N>,
        row: L::U32,
        columns: [L::U32; 2],
    ) -> [[L::U32; 2]; N] {
        texture.word_pairs(
            lanes,
            row,
            columns,
            #[inline(always)]
            |texel| texel.map_or(0, |&texel| self.decode(texel).to_bits()),
        )
    }

    #[inline(always)]
    fn fetch_scalars<L: Lanes, Z: Size>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z>,
        row: L::U32,
        column: L::U32,
    ) -> L::U32 {
        texture.words(
            lanes,
            row,
            column,
            #[inline(always)]
            |texel| texel.map_or(0, |&texel| self.scalar(texel).into()),
        )
    }
}
