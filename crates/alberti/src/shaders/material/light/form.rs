//! Lights as values that files and fuzzers give: made as by their constructors, and found again bit by bit.

#[cfg(feature = "arbitrary")]
use arbitrary::{Arbitrary, Unstructured};

use super::{Directional, PointLight, SpotLight, direction};
use alberti_math::Vector3;
use alberti_math::glam::Vec3;

/// A [`Directional`].
#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
pub(super) struct Sun {
    to_light: Vec3,
    color: Vec3,
}

impl From<Directional> for Sun {
    fn from(Directional { to_light, color }: Directional) -> Self {
        Self { to_light, color }
    }
}

impl From<Sun> for Directional {
    fn from(Sun { to_light, color }: Sun) -> Self {
        Self { to_light: unit(to_light), color }
    }
}

/// A [`SpotLight`].
#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(Arbitrary))]
pub(super) struct Cone {
    point: PointLight,
    axis: Vec3,
    /// Of the inner and the outer angle.
    cosines: [f32; 2],
}

impl From<SpotLight> for Cone {
    fn from(light: SpotLight) -> Self {
        Self { point: light.point, axis: light.axis, cosines: light.cosines() }
    }
}

impl From<Cone> for SpotLight {
    fn from(Cone { point, axis, cosines }: Cone) -> Self {
        Self { axis: unit(axis), ..Self::new(point, Vector3::new(axis), cosines) }
    }
}

/// The direction of a vector. One of length 1 stays as it is.
fn unit(v: Vec3) -> Vec3 {
    // Components of a direction are within 2^-24.
    const OFF: f64 = 1.0 / 4_194_304.0;
    if (v.as_dvec3().length_squared() - 1.0).abs() <= OFF { v } else { direction(Vector3::new(v)) }
}

macro_rules! of_form {
    ($($light:ident: $form:ident;)*) => {$(
        #[cfg(feature = "arbitrary")]
        impl<'a> Arbitrary<'a> for $light {
            fn arbitrary(bytes: &mut Unstructured<'a>) -> arbitrary::Result<Self> {
                $form::arbitrary(bytes).map(Self::from)
            }
        }
    )*};
}
of_form! {
    Directional: Sun;
    SpotLight: Cone;
}
