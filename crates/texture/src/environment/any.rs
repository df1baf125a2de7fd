//! Environments that are picked at run time.

use super::{CubeMap, Environment, LatLong, SphereMap, Turned};
use alberti_math::lanes::Lanes;

/// An [`Environment`] that is picked at run time: each is the type of its name, bit for bit.
///
/// # Cost
/// A match for the samples that are worked on together. The code of all three.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyEnvironment {
    /// [`LatLong`].
    LatLong,
    /// [`SphereMap`], in the frame of the eye that it is made for.
    SphereMap(Turned<SphereMap>),
    /// [`CubeMap`].
    CubeMap(CubeMap),
}

impl Environment for AnyEnvironment {
    #[inline(always)]
    fn place<L: Lanes>(&self, lanes: L, direction: [L::Number; 3]) -> [L::Number; 2] {
        match self {
            Self::LatLong => LatLong.place(lanes, direction),
            Self::SphereMap(turned) => turned.place(lanes, direction),
            Self::CubeMap(cube) => cube.place(lanes, direction),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::lanes::One;
    use glam::Mat3;

    #[test]
    fn any_environment_is_the_one_of_its_name() {
        let turned = Turned { environment: SphereMap, axes: Mat3::from_rotation_y(0.7) };
        let cube = CubeMap { side: 64 };
        for direction in [[0.6, 0.0, 0.8], [-3.0, 1.0, 0.5], [0.1, -0.9, -0.2], [0.3, 0.2, -0.9]] {
            let place = |any: AnyEnvironment| any.place(One, direction);
            let [of_angles, of_ball, of_cube] =
                [LatLong.place(One, direction), turned.place(One, direction), cube.place(One, direction)];
            assert_eq!(place(AnyEnvironment::LatLong), of_angles);
            assert_eq!(place(AnyEnvironment::SphereMap(turned)), of_ball);
            assert_eq!(place(AnyEnvironment::CubeMap(cube)), of_cube);
            assert!(of_angles != of_ball && of_ball != of_cube, "{direction:?}");
        }
    }
}
