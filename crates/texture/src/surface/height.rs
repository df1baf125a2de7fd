//! Height maps: a number from 0 to 1 for each (u, v).
//!
//! Space in: coordinates (u, v). Space out: numbers without a unit, which [`Relief`](super::Relief) gives one.

use crate::blend::{SCALAR_ONE, in_256ths};
use crate::filter::scalars;
use crate::format::Storage;
use crate::{Filter, Sampler, Size, Texture, Wrap};
use alberti_math::lanes::{Lanes, One};
use glam::Vec2;

/// A height for each (u, v), from 0 to 1.
///
/// A [`Sampler`] is one: its red channel ([`Sampler::scalar_lanes`]), of 16 bits where the format has them. A filter's
/// weights have 8 bits, so that the differences of a magnified map have steps;
/// [`BilinearHeights`](super::BilinearHeights) are for those. A closure is one too, which is called for one sample
/// after the other.
pub trait HeightMap {
    /// The heights at several (u, v).
    fn height_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> L::Number;

    /// The slopes there, ∂h/∂u and ∂h/∂v.
    ///
    /// Here they are central differences, (h(u + s) − h(u − s)) / 2s; [`Relief::slope`](super::Relief::slope) says how
    /// precise. A [`Sampler`]'s s is a texel, any other's 2^-10; another one is that of
    /// [`CentralDifferences`](super::CentralDifferences).
    #[inline(always)]
    fn slopes_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> [L::Number; 2] {
        differences(lanes, self, uv, Vec2::splat(1.0 / 1024.0))
    }

    /// The height at (u, v).
    #[inline]
    fn height(&self, uv: Vec2) -> f32 {
        self.height_lanes(One, uv.to_array())
    }
}

impl<F: Fn(Vec2) -> f32> HeightMap for F {
    #[inline(always)]
    fn height_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> L::Number {
        let [u, v] = uv.map(|coordinate| lanes.store(coordinate));
        let at = |values: &[f32], k: usize| values.get(k).copied().unwrap_or_default();
        lanes.load(&lanes.each(|k| self(Vec2::new(at(u.as_ref(), k), at(v.as_ref(), k)))))
    }
}

impl<F: Storage, Fl: Filter, U: Wrap, V: Wrap, Z: Size> HeightMap for Sampler<'_, F, Fl, U, V, Z> {
    #[inline(always)]
    fn height_lanes<L: Lanes>(&self, lanes: L, [u, v]: [L::Number; 2]) -> L::Number {
        self.scalar_lanes(lanes, u, v)
    }

    #[inline(always)]
    fn slopes_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> [L::Number; 2] {
        #[expect(clippy::cast_precision_loss, reason = "at most 2^14")]
        let texel = self.texture().sides().map(|side| 1.0 / side as f32);
        differences(lanes, self, uv, Vec2::from(texel))
    }
}

/// The central differences of a map over `step` to either side.
#[inline(always)]
pub(super) fn differences<L: Lanes>(
    lanes: L,
    map: &(impl HeightMap + ?Sized),
    [u, v]: [L::Number; 2],
    step: Vec2,
) -> [L::Number; 2] {
    let (du, dv) = (lanes.splat(step.x), lanes.splat(step.y));
    let ([left, right], [down, up]) = ([u - du, u + du], [v - dv, v + dv]);
    let along_u = map.height_lanes(lanes, [right, v]) - map.height_lanes(lanes, [left, v]);
    let along_v = map.height_lanes(lanes, [u, up]) - map.height_lanes(lanes, [u, down]);
    // Over the distances of the coordinates as they were rounded.
    [along_u / (right - left), along_v / (up - down)]
}

/// The height h of a map at (u, v), from 0 to 1, and its gradient there, ∂h/∂u and ∂h/∂v. They are those of the
/// bilinear surface through the four texel centres around the point, without the steps of 8 bits that the weights of
/// [`Bilinear`](crate::Bilinear) have.
///
/// The height is continuous, the gradient jumps from one square of texel centres to the next.
///
/// # Precision
/// The height is within 6ε (ε = 2^-24), the gradient within 6ε times the texture's width, or its height, of those at
/// coordinates nearby. These, reduced to the period by [`Wrap`], are within 3ε (in [`Mirror`](crate::Mirror) 5ε) of the
/// given ones. Coordinates that are not finite are as in [`Wrap`].
///
/// # Cost
/// Four texels and about 60 operations.
#[must_use]
pub fn bilinear_height<F: Storage, Z: Size, U: Wrap, V: Wrap>(
    texture: &Texture<'_, F, Z>,
    wrap: (U, V),
    uv: Vec2,
) -> (f32, Vec2) {
    let (height, gradient) = bilinear_height_lanes(One, texture, wrap, uv.to_array());
    (height, Vec2::from(gradient))
}

/// [`bilinear_height`] at several places.
///
/// # Precision
/// In fixed point the height is within 2·2^-16, and the gradient within 2·2^-16 of the side, for sides up to 8192.
#[must_use]
#[inline(always)]
pub fn bilinear_height_lanes<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    wrap: (U, V),
    [u, v]: [L::Number; 2],
) -> (L::Number, [L::Number; 2]) {
    let [(left, s), (low, t)] = [
        cell(lanes, wrap.0.in_period(lanes, u), texture.width()),
        cell(lanes, wrap.1.in_period(lanes, v), texture.height()),
    ];
    let one = lanes.word(1);
    let [left_column, low_row] = texture.indices(lanes, [left, low], wrap);
    let [right_column, high_row] = texture.indices(lanes, [left + one, low + one], wrap);
    let quad = scalars(lanes, texture, wrap, [left_column, right_column], [low_row, high_row]);
    let (low_left, high_left) = (in_256ths(lanes, quad.low_left), in_256ths(lanes, quad.high_left));
    let low = in_256ths(lanes, quad.low_right) - low_left;
    let high = in_256ths(lanes, quad.high_right) - high_left;
    let below = low_left + s * low;
    let value = below + t * (high_left + s * high - below);
    let (left, rise) = (high_left - low_left, high - low);
    let gradient = [
        per_side(lanes, low + t * rise, texture.width()),
        per_side(lanes, left + s * rise, texture.height()),
    ];
    (value / lanes.splat(SCALAR_ONE), gradient)
}

/// A slope of numbers of 256ths per texel as one of heights per side, without numbers above 2^15.
#[inline(always)]
fn per_side<L: Lanes>(lanes: L, slope: L::Number, side: u32) -> L::Number {
    #[expect(clippy::cast_precision_loss, reason = "at most 2^14")]
    let scaled = slope * lanes.splat(side as f32 / 256.0);
    scaled / lanes.splat(SCALAR_ONE / 256.0)
}

/// The two's complement index of the texel whose centre is at or below a coordinate in its period, and how far above
/// that it is, from 0 to 1.
#[inline(always)]
fn cell<L: Lanes>(lanes: L, u: L::Number, size: u32) -> (L::U32, L::Number) {
    // Periods are at most 4 long; NaN is not less.
    let u = lanes.select(lanes.less(u, lanes.splat(4.0)), u, lanes.splat(0.0));
    #[expect(clippy::cast_precision_loss, reason = "at most 2^14")]
    let x = u * lanes.splat(size as f32) - lanes.splat(0.5);
    let below = lanes.floor_scaled(x, 0);
    // From -2^15 to 2^15: two bytes, and their numbers.
    let biased = below + lanes.word(1 << 15);
    let (high, low) = (lanes.to_numbers(lanes.shr(biased, 8)), lanes.to_numbers(biased & lanes.word(255)));
    let number = (high - lanes.splat(128.0)) * lanes.splat(256.0) + low;
    (below, x - number)
}
