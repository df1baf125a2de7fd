//! Height maps with their slopes: what a bump map is made of.
//!
//! Space in: coordinates (u, v). Space out: slopes by unit of u and of v, of numbers without a unit.

use super::height::{HeightMap, bilinear_height_lanes};
use super::relief::differences;
use crate::format::Storage;
use crate::{AnySize, Size, Texture, Wrap};
use alberti_math::lanes::Lanes;
use core::fmt;
use core::marker::PhantomData;
use glam::Vec2;

/// How steeply a map rises: [`BilinearHeights`], or any [`HeightMap`] by [`CentralDifferences`].
pub trait Slopes {
    /// ∂h/∂u and ∂h/∂v at several (u, v).
    fn slopes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> [L::Number; 2];
}

/// The bilinear surface through a texture's texel centres, with its own slopes: [`bilinear_height`] says how precise.
///
/// [`bilinear_height`]: super::bilinear_height
pub struct BilinearHeights<'a, F: Storage, U, V = U, Z: Size = AnySize> {
    texture: Texture<'a, F, Z>,
    modes: PhantomData<(U, V)>,
}

impl<'a, F: Storage, U: Wrap, V: Wrap, Z: Size> BilinearHeights<'a, F, U, V, Z> {
    /// The red channel of a texture.
    #[must_use]
    pub const fn new(texture: Texture<'a, F, Z>) -> Self {
        Self { texture, modes: PhantomData }
    }
}

impl<F: Storage, U: Wrap, V: Wrap, Z: Size> HeightMap for BilinearHeights<'_, F, U, V, Z> {
    #[inline(always)]
    fn height_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> L::Number {
        bilinear_height_lanes::<L, F, Z, U, V>(lanes, &self.texture, uv).0
    }
}

impl<F: Storage, U: Wrap, V: Wrap, Z: Size> Slopes for BilinearHeights<'_, F, U, V, Z> {
    #[inline(always)]
    fn slopes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> [L::Number; 2] {
        bilinear_height_lanes::<L, F, Z, U, V>(lanes, &self.texture, uv).1
    }
}

impl<F: Storage, U, V, Z: Size> Clone for BilinearHeights<'_, F, U, V, Z> {
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: Storage, U, V, Z: Size> Copy for BilinearHeights<'_, F, U, V, Z> {}

impl<F: Storage, U: Wrap, V: Wrap, Z: Size> fmt::Debug for BilinearHeights<'_, F, U, V, Z> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("BilinearHeights").field("texture", &self.texture).finish_non_exhaustive()
    }
}

/// A map whose slopes are central differences: (h(u + s) − h(u − s)) / 2s. [`Relief::slope`](super::Relief::slope)
/// says how precise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentralDifferences<H> {
    /// The heights.
    pub map: H,
    /// s for u and for v: usually one texel.
    pub step: Vec2,
}

impl<H: HeightMap> HeightMap for CentralDifferences<H> {
    #[inline(always)]
    fn height_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> L::Number {
        self.map.height_lanes(lanes, uv)
    }
}

impl<H: HeightMap> Slopes for CentralDifferences<H> {
    #[inline(always)]
    fn slopes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> [L::Number; 2] {
        differences(lanes, &self.map, uv, self.step)
    }
}
