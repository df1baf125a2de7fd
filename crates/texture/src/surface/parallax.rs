//! Parallax maps: the place on the map where a ray of sight meets the heights, at which the colour is looked up.
//!
//! Space in: coordinates (u, v) and a vector to the eye in the tangent frame, with unit axes. Space out: (u, v).

use super::height::HeightMap;
use super::relief::Relief;
use super::tangent::Tangent;
use super::vector::unit_lanes;
use alberti_math::Vector3;
use alberti_math::lanes::{Lanes, One};
use core::fmt::Debug;
use core::ops::{Add, Mul};
use glam::Vec2;

/// A search for the place where a ray of sight meets the heights; the policies are sorted by their cost.
///
/// | policy | heights read | exact where the heights | breaks |
/// |---|---|---|---|
/// | [`OffsetParallax`] | 1 | are the same at both ends of the shift | at grazing angles: the shift is unbounded |
/// | [`LimitedParallax`] | 1 | as above, seen from straight above | nowhere, but flattens: too little at grazing angles |
/// | [`SteepParallax`] of N layers | 1 to N + 1 | are one of the layers | layers show; peaks thinner than a step are missed |
/// | [`ParallaxOcclusion`] of N layers | 2 to N + 1 | are linear across a step | peaks thinner than a step are missed |
///
/// The ray meets the surface itself at (u, v). Heights above it, where they are positive, shift what is seen towards
/// the eye; heights below it, away from it.
///
/// # Where they break
/// With V the vector to the eye, k = |Vxy|/Vz its slant, h the height and a the slope of the heights along the ray:
///
/// * Grazing angles: the true shift is h k, and k has no bound (1 at 45° from the normal, 5.7 at 80°).
///   [`OffsetParallax`] goes as far. As soon as h k is more than a detail is wide, it ends at a place that has nothing
///   to do with the one that is seen. [`LimitedParallax`] goes the share Vz of it, half at 60° and a sixth at 80°, so
///   that the relief fades. A layer of [`SteepParallax`] is (high − low)/N·k wide on the surface. Below a pixel it
///   cannot be seen; above a detail's width it misses the detail, and so does [`ParallaxOcclusion`].
/// * Steep heights: where a k is 1 and more, the heights hide the places behind them. The single steps do not know of
///   it, and fold or tear the texture there; [`SteepParallax`] and [`ParallaxOcclusion`] find the front that hides.
///   Sides as steep as that are seen stretched, as a few texels of the map are all that they have.
/// * Any: only the place on the map moves. The outline and the depths stay those of the surface. So do the derivatives
///   that choose a mip level, although that place jumps where one height hides another. A curved surface counts as
///   flat, so that the shift is to be small beside the radius. Beyond the edge of the surface the map goes on as its
///   wrap mode says.
pub trait ParallaxSearch: Copy + Debug + 'static {
    /// The coordinates where the rays from `uv`, which rise by 1 while they move by `slant`, meet the heights.
    fn meet<H: HeightMap, L: Lanes>(
        self,
        lanes: L,
        relief: &Relief<H>,
        uv: [L::Number; 2],
        slant: [L::Number; 2],
    ) -> [L::Number; 2];
}

/// u + h(u)/Vz·Vx: the height at (u, v) is taken for that where the ray ends.
///
/// On heights that rise by the slope a along a ray of slant k (see [`ParallaxSearch`]), the shift is short by the share
/// a k of itself. So it needs |a k| ≪ 1.
///
/// Source: Kaneko et al., "Detailed shape representation with parallax mapping", ICAT 2001.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct OffsetParallax;

/// u + h(u)·Vx, with V of length 1: not divided by Vz, the shift never exceeds the height, and at grazing angles, where
/// that of [`OffsetParallax`] swims, the surface turns flat.
///
/// Source: Welsh, "Parallax mapping with offset limiting", 2004.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LimitedParallax;

/// The first of N `layers` between the greatest and the least height, from above, at which the ray is not above the
/// heights.
///
/// The place is off by at most one layer along the ray: |high − low|/N·|Vxy|/Vz on the surface, if no peak is thinner
/// than that. N from 8 to 64 is usual; at grazing angles it takes more, so choose it by the slant. Of several samples,
/// the search ends when all have met the heights.
///
/// Source: McGuire and McGuire, "Steep parallax mapping", I3D 2005.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SteepParallax {
    /// The number of layers: at least 1, and less than 2^15. Numbers beyond count as the nearest of these.
    pub layers: u32,
}

/// [`SteepParallax`], and between that layer and the one above, the place where a straight line between the heights at
/// both meets the ray.
///
/// Let the heights' slope be at most a and their curvature, the second derivative, at most c, in object units. With N
/// `layers`, a step along a ray of slant k (see [`ParallaxSearch`]) is d = |high − low|/N·k on the surface. The place
/// is then off by at most k c d²/8 / (1 − a k). Where a k is 1 and more, the ray may meet the heights twice, and from a
/// step on, a second place may be found, or both missed.
///
/// Source: Tatarchuk, "Dynamic parallax occlusion mapping with approximate soft shadows", I3D 2006.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ParallaxOcclusion {
    /// The number of layers: at least 1, and less than 2^15. Numbers beyond count as the nearest of these.
    pub layers: u32,
}

impl<H: HeightMap> Relief<H> {
    /// The coordinates of the place that is seen at `uv` along `view`, a vector of any length from the surface towards
    /// the eye: `relief.parallax(ParallaxOcclusion { layers: 16 }, uv, view)`.
    ///
    /// `uv` itself where the eye is not above the surface, or where the result is not finite.
    ///
    /// # Precision
    /// [`ParallaxSearch`] says how far each policy is from the place that is seen; beyond that, rounding moves it by
    /// 16ε·(|uv| + |slant|·max(|low|, |high|)) (ε = 2^-24). Where the slant |Vxy|/Vz is above 2^60, any coordinates.
    ///
    /// # Cost
    /// The heights that the policy reads, and some divisions; [`LimitedParallax`] a square root more.
    ///
    /// ```
    /// use alberti_math::Vector3;
    /// use alberti_texture::surface::{OffsetParallax, Relief};
    /// use glam::{Vec2, Vec3};
    ///
    /// // A plain, half a unit above the surface, seen at 45°.
    /// let plain = Relief { map: |_: Vec2| 0.5, low: 0.0, high: 1.0, extent: Vec2::ONE };
    /// let view = Vector3::new(Vec3::new(1.0, 0.0, 1.0));
    /// assert_eq!(plain.parallax(OffsetParallax, Vec2::ZERO, view), Vec2::new(0.5, 0.0));
    /// ```
    #[must_use]
    pub fn parallax(&self, policy: impl ParallaxSearch, uv: Vec2, view: Vector3<Tangent>) -> Vec2 {
        Vec2::from(self.parallax_lanes(policy, One, uv.to_array(), view.coords.to_array()))
    }

    /// [`parallax`](Self::parallax) at several places.
    ///
    /// # Precision
    /// In fixed point rounding moves the place by (4·|slant| + 4·max(|low|, |high|) + 4)·2^-16, for shifts and slants
    /// below 2^14; beyond, to any coordinates.
    #[must_use]
    #[inline(always)]
    pub fn parallax_lanes<L: Lanes>(
        &self,
        policy: impl ParallaxSearch,
        lanes: L,
        uv: [L::Number; 2],
        [x, y, z]: [L::Number; 3],
    ) -> [L::Number; 2] {
        let [width, height] = self.extent.to_array().map(|extent| lanes.splat(extent));
        let slant = [x / z / width, y / z / height];
        let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
        // 0 times what is not finite is NaN.
        let finite = |[u, v]: [L::Number; 2]| lanes.less(u * zero, one) & lanes.less(v * zero, one);
        let seen = finite(slant) & lanes.less(zero, z);
        let slant = slant.map(|along| lanes.select(seen, along, zero));
        let found = lanes.apart(
            #[inline(always)]
            || policy.meet(lanes, self, uv, slant),
        );
        let met = seen & finite(found);
        [lanes.select(met, found[0], uv[0]), lanes.select(met, found[1], uv[1])]
    }
}

impl ParallaxSearch for OffsetParallax {
    #[inline(always)]
    fn meet<H: HeightMap, L: Lanes>(
        self,
        lanes: L,
        relief: &Relief<H>,
        uv: [L::Number; 2],
        slant: [L::Number; 2],
    ) -> [L::Number; 2] {
        along(uv, slant, relief.height_lanes(lanes, uv))
    }
}

impl ParallaxSearch for LimitedParallax {
    #[inline(always)]
    fn meet<H: HeightMap, L: Lanes>(
        self,
        lanes: L,
        relief: &Relief<H>,
        uv: [L::Number; 2],
        slant: [L::Number; 2],
    ) -> [L::Number; 2] {
        // The ray in object units, and the z of a unit vector along it.
        let [width, height] = relief.extent.to_array().map(|extent| lanes.splat(extent));
        let [_, _, upright] = unit_lanes(lanes, [slant[0] * width, slant[1] * height, lanes.splat(1.0)]);
        along(uv, slant, relief.height_lanes(lanes, uv) * upright)
    }
}

impl ParallaxSearch for SteepParallax {
    #[inline(always)]
    fn meet<H: HeightMap, L: Lanes>(
        self,
        lanes: L,
        relief: &Relief<H>,
        uv: [L::Number; 2],
        slant: [L::Number; 2],
    ) -> [L::Number; 2] {
        let Hit { found, .. } = first_hit(lanes, relief, uv, slant, self.layers);
        along(uv, slant, found)
    }
}

impl ParallaxSearch for ParallaxOcclusion {
    #[inline(always)]
    fn meet<H: HeightMap, L: Lanes>(
        self,
        lanes: L,
        relief: &Relief<H>,
        uv: [L::Number; 2],
        slant: [L::Number; 2],
    ) -> [L::Number; 2] {
        let Hit { above, clear, found, depth } = first_hit(lanes, relief, uv, slant, self.layers);
        // `clear` above the heights at one end, `depth` below them at the other.
        let (zero, whole) = (lanes.splat(0.0), clear + depth);
        let back = lanes.select(lanes.less(zero, whole), depth / whole, zero);
        along(uv, slant, found + (above - found) * back)
    }
}

/// A [`ParallaxSearch`] that is picked at run time: each is the type of its name, bit for bit.
///
/// # Cost
/// A match for the samples that are worked on together. The code of all four.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyParallax {
    /// [`OffsetParallax`].
    Offset,
    /// [`LimitedParallax`].
    Limited,
    /// [`SteepParallax`].
    Steep {
        /// Its layers.
        layers: u32,
    },
    /// [`ParallaxOcclusion`].
    Occlusion {
        /// Its layers.
        layers: u32,
    },
}

impl ParallaxSearch for AnyParallax {
    #[inline(always)]
    fn meet<H: HeightMap, L: Lanes>(
        self,
        lanes: L,
        relief: &Relief<H>,
        uv: [L::Number; 2],
        slant: [L::Number; 2],
    ) -> [L::Number; 2] {
        match self {
            Self::Offset => OffsetParallax.meet(lanes, relief, uv, slant),
            Self::Limited => LimitedParallax.meet(lanes, relief, uv, slant),
            Self::Steep { layers } => SteepParallax { layers }.meet(lanes, relief, uv, slant),
            Self::Occlusion { layers } => ParallaxOcclusion { layers }.meet(lanes, relief, uv, slant),
        }
    }
}

/// A ray at the height z.
#[inline(always)]
fn along<N: Copy + Add<Output = N> + Mul<Output = N>>(uv: [N; 2], slant: [N; 2], z: N) -> [N; 2] {
    [uv[0] + slant[0] * z, uv[1] + slant[1] * z]
}

/// The last layer at which a ray is above the heights, and its clearance above them; the first at which it is not, and
/// its depth below them. Where that is the highest, it is both.
struct Hit<N> {
    above: N,
    clear: N,
    found: N,
    depth: N,
}

#[inline(always)]
fn first_hit<H: HeightMap, L: Lanes>(
    lanes: L,
    relief: &Relief<H>,
    uv: [L::Number; 2],
    slant: [L::Number; 2],
    layers: u32,
) -> Hit<L::Number> {
    let layers = layers.clamp(1, (1 << 15) - 1).cast_signed();
    let ends = if relief.low < relief.high { [relief.high, relief.low] } else { [relief.low, relief.high] };
    let ([top, bottom], zero) = (ends.map(|end| lanes.splat(end)), lanes.splat(0.0));
    let whole = lanes.int_to_number(lanes.int(layers));
    let mut hit = Hit { above: top, clear: zero, found: bottom, depth: zero };
    let mut searching = lanes.bits(lanes.less(zero, lanes.splat(1.0)));
    for k in 0..layers {
        let z = top + (bottom - top) * (lanes.int_to_number(lanes.int(k)) / whole);
        let clear = z - relief.height_lanes(lanes, along(uv, slant, z));
        let above = lanes.bits(lanes.less(zero, clear));
        let met = lanes.mask(searching & !above);
        hit.found = lanes.select(met, z, hit.found);
        hit.depth = lanes.select(met, zero - clear, hit.depth);
        searching &= above;
        if searching == 0 {
            return hit;
        }
        let above = lanes.mask(searching);
        hit.above = lanes.select(above, z, hit.above);
        hit.clear = lanes.select(above, clear, hit.clear);
    }
    let depth = lanes.max(relief.height_lanes(lanes, along(uv, slant, bottom)) - bottom, zero);
    hit.depth = lanes.select(lanes.mask(searching), depth, hit.depth);
    hit
}
