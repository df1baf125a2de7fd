//! Colours and directions of several samples. In fixed point colours saturate, so that no light is so bright that it
//! wraps.

use alberti_math::glam::Vec3;
use alberti_math::lanes::Lanes;

/// The same vector for each lane.
#[inline(always)]
pub(super) fn splat<L: Lanes>(lanes: L, v: Vec3) -> [L::Number; 3] {
    [lanes.splat(v.x), lanes.splat(v.y), lanes.splat(v.z)]
}

/// The sum of colours.
#[inline(always)]
pub(super) fn plus<L: Lanes>(
    lanes: L,
    [x, y, z]: [L::Number; 3],
    [a, b, c]: [L::Number; 3],
) -> [L::Number; 3] {
    [lanes.saturating_add(x, a), lanes.saturating_add(y, b), lanes.saturating_add(z, c)]
}

/// The product of colours, component by component.
#[inline(always)]
pub(super) fn by<L: Lanes>(lanes: L, [x, y, z]: [L::Number; 3], [a, b, c]: [L::Number; 3]) -> [L::Number; 3] {
    [lanes.saturating_mul(x, a), lanes.saturating_mul(y, b), lanes.saturating_mul(z, c)]
}

/// A colour times a number.
#[inline(always)]
pub(super) fn times<L: Lanes>(lanes: L, color: [L::Number; 3], k: L::Number) -> [L::Number; 3] {
    by(lanes, color, [k; 3])
}

/// The vectors from positions to a place. In fixed point positions are within ±4096, as vertices carry them, and the
/// place counts as within ±28000 on each axis: no difference wraps.
#[inline(always)]
pub(super) fn towards<L: Lanes>(lanes: L, place: Vec3, [x, y, z]: [L::Number; 3]) -> [L::Number; 3] {
    let [a, b, c] = within(lanes, 28000.0, splat(lanes, place));
    [a - x, b - y, c - z]
}

/// In fixed point each component at most so far from 0; in floats the vector as it is.
#[inline(always)]
pub(super) fn within<L: Lanes>(lanes: L, most: f32, v: [L::Number; 3]) -> [L::Number; 3] {
    if !L::FIXED {
        return v;
    }
    let [x, y, z] = v;
    let clamped = |c: L::Number| lanes.max(lanes.min(c, lanes.splat(most)), lanes.splat(-most));
    [clamped(x), clamped(y), clamped(z)]
}
