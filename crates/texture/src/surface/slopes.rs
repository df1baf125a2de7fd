//! Height maps with slopes of their own, for bump maps.
//!
//! Space in: coordinates (u, v). Space out: slopes by unit of u and of v, of numbers without a unit.

use super::height::{HeightMap, bilinear_height_lanes, differences};
use crate::format::Storage;
use crate::{AnySize, Size, Texture, Wrap};
use alberti_math::lanes::Lanes;
use core::fmt;
use glam::Vec2;

/// The bilinear surface through a texture's texel centres, with its own slopes: [`bilinear_height`] says how precise.
///
/// [`bilinear_height`]: super::bilinear_height
#[derive(Clone, Copy)]
pub struct BilinearHeights<'a, F: Storage, U, V = U, Z: Size = AnySize> {
    texture: Texture<'a, F, Z>,
    wrap: (U, V),
}

impl<'a, F: Storage, U: Wrap, Z: Size> BilinearHeights<'a, F, U, U, Z> {
    /// The red channel of a texture, with the same wrap mode on both axes.
    #[must_use]
    pub const fn new(texture: Texture<'a, F, Z>, wrap: U) -> Self {
        Self { texture, wrap: (wrap, wrap) }
    }
}

impl<'a, F: Storage, U: Wrap, V: Wrap, Z: Size> BilinearHeights<'a, F, U, V, Z> {
    /// The red channel of a texture, with one wrap mode from left to right and one from bottom to top.
    #[must_use]
    pub const fn per_axis(texture: Texture<'a, F, Z>, u: U, v: V) -> Self {
        Self { texture, wrap: (u, v) }
    }
}

impl<F: Storage, U: Wrap, V: Wrap, Z: Size> HeightMap for BilinearHeights<'_, F, U, V, Z> {
    #[inline(always)]
    fn height_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> L::Number {
        bilinear_height_lanes(lanes, &self.texture, self.wrap, uv).0
    }

    #[inline(always)]
    fn slopes_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> [L::Number; 2] {
        bilinear_height_lanes(lanes, &self.texture, self.wrap, uv).1
    }
}

impl<F: Storage, U: Wrap, V: Wrap, Z: Size> fmt::Debug for BilinearHeights<'_, F, U, V, Z> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("BilinearHeights").field("texture", &self.texture).field("wrap", &self.wrap).finish()
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

    #[inline(always)]
    fn slopes_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> [L::Number; 2] {
        differences(lanes, &self.map, uv, self.step)
    }
}
