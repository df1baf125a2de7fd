//! Directions in `f64`, for work that is done once a vertex rather than once a fragment.

use alberti_math::lanes::{Lanes, One};
use glam::{DVec3, Vec3};

/// The vector of length 1 in the direction of `v`; `None` where it has none, as it is zero or not finite.
///
/// Components are within 2^-50, relatively, unless `v` is below 2^-1000 or above 2^1000.
pub(super) fn unit(v: DVec3) -> Option<DVec3> {
    let greatest = v.x.abs().max(v.y.abs()).max(v.z.abs());
    if !v.is_finite() || greatest < f64::MIN_POSITIVE {
        return None;
    }
    // To 1 or more and below 2, by a power of two.
    let exponent = (greatest.to_bits() >> 52).min(2045);
    let v = v * f64::from_bits((2046 - exponent) << 52);
    let square = v.dot(v);
    #[expect(clippy::cast_possible_truncation, reason = "what the steps start from")]
    let start = square as f32;
    let mut inverse = f64::from(1.0 / One.sqrt(start));
    for _ in 0..2 {
        inverse *= 1.5 - 0.5 * square * inverse * inverse;
    }
    Some(v * inverse)
}

/// Rounded to `f32`.
pub(super) fn narrow(v: DVec3) -> Vec3 {
    v.as_vec3()
}

/// The square of 2^-20.
const PARALLEL: f64 = 1.0 / 1_099_511_627_776.0;

/// The part of a unit vector `v` that is perpendicular to the unit vector `n`, as a unit vector. `None` where `v` is
/// within 2^-20 radians of `n` or of its opposite.
pub(super) fn reject(v: DVec3, n: DVec3) -> Option<DVec3> {
    let across = v - n * n.dot(v);
    (across.dot(across) > PARALLEL).then(|| unit(across)).flatten()
}

/// A unit vector that is perpendicular to the unit vector `n`: the perpendicular part of the coordinate axis that is
/// least along it, of equals the first.
pub(super) fn perpendicular(n: DVec3) -> DVec3 {
    let size = n.abs();
    let axis = if size.x <= size.y && size.x <= size.z {
        DVec3::X
    } else if size.y <= size.z {
        DVec3::Y
    } else {
        DVec3::Z
    };
    // The least component of a unit vector is at most 0.58, so there is something left.
    reject(axis, n).unwrap_or(axis)
}
