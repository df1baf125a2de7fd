//! Environments in other frames.

use super::Environment;
use crate::surface::dot_lanes;
use alberti_math::lanes::Lanes;
use alberti_math::{logged, map3};
use glam::Mat3;

/// An environment that stands turned: directions are given in one frame, such as the world's, and looked up in another,
/// such as the eye's, for which a [`SphereMap`](super::SphereMap) is made.
///
/// # Precision
/// The direction is within 3ε radians (ε = 2^-24), besides the error of the environment's place.
///
/// # Cost
/// Nine multiplications.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Turned<E> {
    /// The environment in which directions are looked up.
    pub environment: E,
    /// Its axes x, y and z, as columns in the frame in which directions are given: unit vectors at right angles.
    pub axes: Mat3,
}

logged! {
    [E: defmt::Format] Turned<E>: "Turned {{ environment: {}, axes: {} }}",
        |turned| turned.environment, turned.axes.to_cols_array_2d();
}

impl<E: Environment> Environment for Turned<E> {
    #[inline(always)]
    fn place<L: Lanes>(&self, lanes: L, [x, y, z]: [L::Number; 3]) -> [L::Number; 2] {
        let Mat3 { x_axis, y_axis, z_axis } = self.axes;
        let turned = map3(
            [x_axis, y_axis, z_axis],
            #[inline(always)]
            |axis| dot_lanes([x, y, z], [lanes.splat(axis.x), lanes.splat(axis.y), lanes.splat(axis.z)]),
        );
        self.environment.place(lanes, turned)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::environment::SphereMap;
    use alberti_math::lanes::One;
    use glam::Vec3;

    #[test]
    fn directions_are_looked_up_in_the_frame() {
        // An eye that looks along x: its x axis is along z, and -x, backwards, is the middle of the ball.
        let axes = Mat3::from_cols(Vec3::Z, Vec3::Y, Vec3::X);
        let turned = Turned { environment: SphereMap, axes };
        assert_eq!(turned.place(One, [-1.0, 0.0, 0.0]), [0.5, 0.5]);
        for direction in [[0.6, 0.0, 0.8], [0.0, -0.6, 0.8], [0.48, 0.6, 0.64]] {
            let [x, y, z] = direction;
            assert_eq!(turned.place(One, [z, y, x]), SphereMap.place(One, direction));
        }
    }
}
