//! Colours and directions of several samples.

use alberti_math::glam::Vec3;
use alberti_math::lanes::Lanes;
use core::ops::{Add, Mul};

/// The same vector for each lane.
#[inline(always)]
pub(super) fn splat<L: Lanes>(lanes: L, v: Vec3) -> [L::Number; 3] {
    [lanes.splat(v.x), lanes.splat(v.y), lanes.splat(v.z)]
}

/// The sum.
#[inline(always)]
pub(super) fn plus<N: Copy + Add<Output = N>>([x, y, z]: [N; 3], [a, b, c]: [N; 3]) -> [N; 3] {
    [x + a, y + b, z + c]
}

/// The product, component by component.
#[inline(always)]
pub(super) fn by<N: Copy + Mul<Output = N>>([x, y, z]: [N; 3], [a, b, c]: [N; 3]) -> [N; 3] {
    [x * a, y * b, z * c]
}

/// A vector times a number.
#[inline(always)]
pub(super) fn times<N: Copy + Mul<Output = N>>([x, y, z]: [N; 3], k: N) -> [N; 3] {
    [x * k, y * k, z * k]
}
