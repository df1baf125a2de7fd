//! Parallax maps: where on the map a ray of sight meets the heights, so that the colour is looked up there.
//!
//! Space in: coordinates (u, v) and a vector to the eye in the tangent frame, with unit axes. Space out: (u, v).

use super::relief::{HeightMap, Relief};
use super::tangent::Tangent;
use super::unit::unit;
use alberti_math::Vector3;
use core::fmt::Debug;
use glam::Vec2;

/// A way of finding where a ray of sight meets the heights; they are sorted by what they cost.
///
/// | policy | heights read | exact where the heights | breaks |
/// |---|---|---|---|
/// | [`Offset`] | 1 | are the same at both ends of the shift | at grazing angles: the shift is unbounded |
/// | [`OffsetLimited`] | 1 | as above, seen from straight above | nowhere, but flattens: too little at grazing angles |
/// | [`Steep<N>`](Steep) | 1 to N + 1 | are one of N layers | layers show; peaks thinner than a step are missed |
/// | [`Occlusion<N>`](Occlusion) | 2 to N + 1 | are linear across a step | peaks thinner than a step are missed |
///
/// The ray meets the surface itself at (u, v). Heights above it, where they are positive, shift what is seen towards
/// the eye; heights below it, away from it.
pub trait Parallax: Copy + Debug + Default + 'static {
    /// The coordinates where the ray from `uv`, which rises by 1 while it moves by `slant`, meets the heights.
    fn meet<H: HeightMap>(relief: &Relief<H>, uv: Vec2, slant: Vec2) -> Vec2;
}

/// u + h(u)/Vz·Vx: the height at (u, v) is taken for that where the ray ends.
///
/// On heights that rise by the slope a along the ray, whose slant is k = |Vxy|/Vz, the shift is short by the share a k
/// of itself: it needs |a k| ≪ 1.
///
/// Source: Kaneko et al., "Detailed shape representation with parallax mapping", ICAT 2001.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Offset;

/// u + h(u)·Vx, with V of length 1: not divided by Vz, the shift never exceeds the height, and at grazing angles, where
/// that of [`Offset`] swims, the surface turns flat.
///
/// Source: Welsh, "Parallax mapping with offset limiting", 2004.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct OffsetLimited;

/// The first of `N` layers between the greatest and the least height, from above, at which the ray is not above the
/// heights.
///
/// The place is off by at most one layer along the ray: |high − low|/N·|Vxy|/Vz on the surface, if no peak is thinner
/// than that. N for 8 to 64 is usual; at grazing angles it takes more, so choose it by the slant.
///
/// Source: McGuire and McGuire, "Steep parallax mapping", I3D 2005.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Steep<const N: u32>;

/// [`Steep`], and between that layer and the one above, the place where a straight line between the heights at both
/// meets the ray.
///
/// With heights whose slope is at most a and whose curvature, their second derivative, is at most c, in object units, a
/// ray of slant k = |Vxy|/Vz, and a step of d = |high − low|/N·k on the surface, the place is off by at most k c d²/8 /
/// (1 − a k). Where a k is 1 and more, the ray may meet the heights twice, and from a step on, a second place may be
/// found, or both missed.
///
/// Source: Tatarchuk, "Dynamic parallax occlusion mapping with approximate soft shadows", I3D 2006.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Occlusion<const N: u32>;

impl<H: HeightMap> Relief<H> {
    /// The coordinates of what is seen at `uv` along `view`, a vector of any length from the surface towards the eye:
    /// `relief.parallax::<Occlusion<16>>(uv, view)`.
    ///
    /// `uv` itself where the eye is not above the surface, or where the result is not finite.
    ///
    /// # Precision
    /// [`Parallax`] says how far each policy is from the place that is seen; beyond that, rounding moves it by
    /// 16ε·(|uv| + |slant|·max(|low|, |high|)) (ε = 2^-24).
    ///
    /// # Cost
    /// The heights that the policy reads, and some divisions; [`OffsetLimited`] a square root in `f64`.
    ///
    /// ```
    /// use alberti_math::Vector3;
    /// use alberti_texture::surface::{Offset, Relief};
    /// use glam::{Vec2, Vec3};
    ///
    /// // A plain, half a unit above the surface, seen at 45°.
    /// let plain = Relief { map: |_: Vec2| 0.5, low: 0.0, high: 1.0, extent: Vec2::ONE };
    /// let view = Vector3::new(Vec3::new(1.0, 0.0, 1.0));
    /// assert_eq!(plain.parallax::<Offset>(Vec2::ZERO, view), Vec2::new(0.5, 0.0));
    /// ```
    #[must_use]
    pub fn parallax<P: Parallax>(&self, uv: Vec2, view: Vector3<Tangent>) -> Vec2 {
        let slant = view.coords.truncate() / view.coords.z / self.extent;
        if !(view.coords.z > 0.0 && slant.is_finite()) {
            return uv;
        }
        let found = P::meet(self, uv, slant);
        if found.is_finite() { found } else { uv }
    }
}

impl Parallax for Offset {
    fn meet<H: HeightMap>(relief: &Relief<H>, uv: Vec2, slant: Vec2) -> Vec2 {
        uv + slant * relief.height(uv)
    }
}

impl Parallax for OffsetLimited {
    fn meet<H: HeightMap>(relief: &Relief<H>, uv: Vec2, slant: Vec2) -> Vec2 {
        // The ray in object units, of which the z of a unit vector along it is 1/length.
        let ray = slant * relief.extent;
        let upright = unit(ray.extend(1.0).as_dvec3()).map_or(0.0, |ray| ray.z);
        #[expect(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
        let upright = upright as f32;
        uv + slant * (relief.height(uv) * upright)
    }
}

impl<const N: u32> Parallax for Steep<N> {
    fn meet<H: HeightMap>(relief: &Relief<H>, uv: Vec2, slant: Vec2) -> Vec2 {
        let [_, [found, _]] = first_hit(relief, uv, slant, N);
        uv + slant * found
    }
}

impl<const N: u32> Parallax for Occlusion<N> {
    fn meet<H: HeightMap>(relief: &Relief<H>, uv: Vec2, slant: Vec2) -> Vec2 {
        let [[above, clear], [found, depth]] = first_hit(relief, uv, slant, N);
        // `clear` above the heights at one end, `depth` below them at the other.
        let whole = clear + depth;
        let back = if whole > 0.0 { depth / whole } else { 0.0 };
        uv + slant * (found + (above - found) * back)
    }
}

/// The last layer at which the ray is above the heights and by how much, and the first at which it is not and by how
/// much it is below; the latter twice where that is the highest.
fn first_hit<H: HeightMap>(relief: &Relief<H>, uv: Vec2, slant: Vec2, layers: u32) -> [[f32; 2]; 2] {
    let layers = layers.max(1);
    let (top, bottom) =
        if relief.low < relief.high { (relief.high, relief.low) } else { (relief.low, relief.high) };
    let mut above = None;
    for k in 0..layers {
        #[expect(clippy::cast_precision_loss, reason = "rounding moves the layers, and that is all")]
        let z = top + (bottom - top) * (k as f32 / layers as f32);
        let clear = z - relief.height(uv + slant * z);
        if clear > 0.0 {
            above = Some([z, clear]);
        } else {
            return [above.unwrap_or([z, 0.0]), [z, -clear]];
        }
    }
    let depth = (relief.height(uv + slant * bottom) - bottom).max(0.0);
    [above.unwrap_or([bottom, 0.0]), [bottom, depth]]
}
