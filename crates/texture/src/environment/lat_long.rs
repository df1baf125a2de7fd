//! Longitude and latitude.

use super::{Environment, finite_or_zero};
use crate::surface::absolute_lanes;
use alberti_math::lanes::Lanes;

/// An image whose columns are longitudes and whose rows are latitudes, also called equirectangular: twice as wide as
/// high.
///
/// ```text
///  v = 1  +-----------------------------+  +y, the whole side
///         |                             |
///         |      -x     -z     +x       |       u = 1/2 + atan2(x, −z)/2π
///         |                             |       v = 1/2 + atan2(y, √(x² + z²))/π
///  v = 0  +-----------------------------+  −y
///       u = 0         1/2             u = 1  +z
/// ```
///
/// The middle is −z, where a camera of world space looks if it is not turned, and u grows to the right as seen from
/// inside. The seam, u = 0 and u = 1, is +z: (0, y, z) has u = 1 where z > 0. At the poles, x = z = 0, u is 1/2; a
/// direction that is zero or not finite is as (0, 0, −1). Differences of u between neighbouring pixels are no
/// derivatives across the seam.
///
/// # Precision
/// u is within 2.5ε of a turn (ε = 2^-24), v within 3ε of 1, which is half a turn. The arc tangent is the polynomial of
/// seven coefficients with the least error, 0.67ε of a turn.
///
/// In fixed point, for directions from 1 to 16384 long, v is within 6·2^-16. u is within 4·2^-16, or as many times more
/// as the part across y is shorter than 1.
///
/// # Cost
/// Two divisions, a square root and some 50 operations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LatLong;

impl Environment for LatLong {
    #[inline(always)]
    fn place<L: Lanes>(&self, lanes: L, direction: [L::Number; 3]) -> [L::Number; 2] {
        let [x, y, z] = finite_or_zero(lanes, direction);
        let (zero, half) = (lanes.splat(0.0), lanes.splat(0.5));
        let (across, up, along) =
            (absolute_lanes(lanes, x), absolute_lanes(lanes, y), absolute_lanes(lanes, z));
        let (around, ratio) = first_quarter(lanes, across, along);
        let around = lanes.select(lanes.less(zero, z), half - around, around);
        let u = half + lanes.select(lanes.less(x, zero), zero - around, around);

        // Halved, as the length may be √2 times as much.
        let level = lanes.max(across, along) * half * lanes.sqrt(lanes.splat(1.0) + ratio * ratio);
        let (elevation, _) = first_quarter(lanes, up * half, level);
        let elevation = elevation + elevation;
        [u, half + lanes.select(lanes.less(y, zero), zero - elevation, elevation)]
    }
}

/// atan2(y, x)/2π for x and y of at least 0, from 0 to 1/4, and the lesser of x and y in parts of the greater; 0 for
/// zeros.
#[inline(always)]
fn first_quarter<L: Lanes>(lanes: L, y: L::Number, x: L::Number) -> (L::Number, L::Number) {
    /// Σ cₖ t^(2k + 1) is atan(t)/2π from 0 to 1.
    const ATAN: [f32; 7] = [
        0.159_154_33,
        -0.053_026_237,
        0.031_525_116,
        -0.021_061_517,
        0.012_672_499,
        -0.005_348_276_3,
        0.001_084_13,
    ];
    let (zero, greater) = (lanes.splat(0.0), lanes.max(x, y));
    let t = lanes.select(lanes.less(zero, greater), lanes.min(x, y) / greater, zero);
    let square = t * t;
    let mut sum = zero;
    for &coefficient in ATAN.iter().rev() {
        sum = sum * square + lanes.splat(coefficient);
    }
    let turns = sum * t;
    (lanes.select(lanes.less(x, y), lanes.splat(0.25) - turns, turns), t)
}
