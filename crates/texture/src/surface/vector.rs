//! Vectors of several samples at a time, one number a component.

use alberti_math::lanes::Lanes;
use core::ops::{Add, Mul};

/// A vector divided by its length, to length 1; (0, 0, 1) for zero.
///
/// # Precision
/// In `f32` each component is within 4ε of itself (ε = 2^-24) for lengths between 2^-60 and 2^60, and the length within
/// 3.1ε of 1. In fixed point components, which may be any between ±32767, are first divided by the greatest of them, as
/// squares would not fit: each comes out within 2.5·2^-16. Of a vector that is not finite, a component is NaN and the
/// others are NaN or 0; of one longer than 2^64, all may be 0.
///
/// # Cost
/// A square root and three divisions, in fixed point three more.
#[must_use]
#[inline(always)]
pub fn unit_lanes<L: Lanes>(lanes: L, v: [L::Number; 3]) -> [L::Number; 3] {
    if has_range(lanes) {
        return over_length(lanes, v);
    }
    let [x, y, z] = v;
    let level = lanes.max(absolute_lanes(lanes, x), absolute_lanes(lanes, y));
    // At least one step, which changes nothing but 0.
    let greatest = lanes.max(lanes.max(level, absolute_lanes(lanes, z)), lanes.splat(1.0 / 65536.0));
    over_length(lanes, [x / greatest, y / greatest, z / greatest])
}

/// A vector divided by its length; (0, 0, 1) for zero, also where squares round to it.
#[inline(always)]
pub(super) fn over_length<L: Lanes>(lanes: L, [x, y, z]: [L::Number; 3]) -> [L::Number; 3] {
    let square = dot_lanes([x, y, z], [x, y, z]);
    // Not so for NaN, which all components become then.
    let none =
        lanes.less(square, lanes.splat(if has_range(lanes) { f32::from_bits(1) } else { 1.0 / 65536.0 }));
    let length = lanes.select(none, lanes.splat(1.0), lanes.sqrt(square));
    [x / length, y / length, lanes.select(none, lanes.splat(1.0), z) / length]
}

/// The scalar product, summed from left to right.
///
/// # Precision
/// Within 3ε of the sum of the products' magnitudes (ε = 2^-24), in fixed point within 1.5·2^-16.
///
/// # Cost
/// Three multiplications, two additions.
#[must_use]
#[inline(always)]
pub fn dot_lanes<N: Copy + Add<Output = N> + Mul<Output = N>>(
    [ax, ay, az]: [N; 3],
    [bx, by, bz]: [N; 3],
) -> N {
    ax * bx + ay * by + az * bz
}

/// Between 0 and 1; 0 for NaN.
///
/// # Cost
/// A minimum and a maximum.
#[must_use]
#[inline(always)]
pub fn clamped_lanes<L: Lanes>(lanes: L, x: L::Number) -> L::Number {
    // Of a comparison with NaN, the second.
    lanes.min(lanes.max(x, lanes.splat(0.0)), lanes.splat(1.0))
}

/// |x|.
///
/// # Cost
/// A subtraction and a maximum.
#[must_use]
#[inline(always)]
pub fn absolute_lanes<L: Lanes>(lanes: L, x: L::Number) -> L::Number {
    lanes.max(x, lanes.splat(0.0) - x)
}

/// Whether there are numbers beyond 2^15, and so squares of large ones, as in floating point: known when compiling.
#[inline(always)]
pub(crate) fn has_range<L: Lanes>(lanes: L) -> bool {
    lanes.bits(lanes.less(lanes.splat(32768.0), lanes.splat(65536.0))) != 0
}
