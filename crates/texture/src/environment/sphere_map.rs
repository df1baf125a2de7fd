//! A mirror ball.

use super::{Environment, finite_or_zero};
use crate::surface::{clamped_lanes, unit_lanes};
use alberti_math::lanes::Lanes;

/// The image of a small mirror ball, as seen from far away: one that is made for one direction of view.
///
/// Directions are those of **eye space**: x right, y up, z forward (OpenGL's eye looks along −z, so its z is the
/// opposite). Where the ball shows a reflected direction d of length 1, its normal is halfway between d and the
/// direction to the eye, (0, 0, −1):
///
/// ```text
/// m = 2 √(dx² + dy² + (dz − 1)²)       u = dx/m + 1/2       v = dy/m + 1/2
/// ```
///
/// The middle is the eye itself, the circle of radius 1/2 about it straight forward: the one direction that has no
/// place, and gets the middle. So does a direction that is zero or not finite. All directions have the same
/// share of the image, but shapes near the rim, which is straight forward, are drawn out along it.
///
/// Source: OpenGL 2.1 specification, 2.11.4, `GL_SPHERE_MAP`.
///
/// # Precision
/// With α the angle from straight forward, within (2 + 2/α)ε (ε = 2^-24); in fixed point within (3 + 4/α)·2^-16. For
/// lengths as in [`unit_lanes`](crate::surface::unit_lanes), in fixed point of 1 and more.
///
/// # Cost
/// That of two unit vectors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SphereMap;

impl Environment for SphereMap {
    #[inline(always)]
    fn place<L: Lanes>(&self, lanes: L, direction: [L::Number; 3]) -> [L::Number; 2] {
        let half = lanes.splat(0.5);
        let [x, y, z] = unit_lanes(lanes, finite_or_zero(lanes, direction));
        let [x, y, _] = unit_lanes(lanes, [x, y, z - lanes.splat(1.0)]);
        // Only next to straight forward, where squares vanish, components may be above 1.
        [clamped_lanes(lanes, x * half + half), clamped_lanes(lanes, y * half + half)]
    }
}
