//! Reflectances: the shares of a light that a surface sends towards the viewer.

use alberti_math::lanes::Lanes;
use alberti_texture::surface::{
    blinn_phong_cosine_lanes, lambert_lanes, phong_cosine_lanes, power_each_lanes, power_lanes,
    shininess_lanes,
};
use core::fmt::Debug;

/// A model of reflection: [`Lambert`], [`Phong`] or [`BlinnPhong`].
pub trait Reflectance: Copy + Debug {
    /// The shares of a light that are scattered, and that are mirrored, for unit vectors: the normal, and from the
    /// surface to the light and to the viewer.
    fn shares<L: Lanes>(
        &self,
        lanes: L,
        normal: [L::Number; 3],
        to_light: [L::Number; 3],
        to_viewer: [L::Number; 3],
        gloss: L::Number,
    ) -> [L::Number; 2];
}

/// Evenly scattered light: [`lambert`](alberti_texture::surface::lambert). Nothing is mirrored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lambert;

/// Scattering as by [`Lambert`], and a mirrored share as by [`phong`](alberti_texture::surface::phong), with this
/// exponent: see [`BlinnPhong`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Phong<E = u32>(
    /// The exponent.
    pub E,
);

/// Scattering as by [`Lambert`], and a mirrored share as by [`blinn_phong`](alberti_texture::surface::blinn_phong).
///
/// The exponent, up to 2^16, is a number (`u32`), which takes no notice of the gloss, or two (`[u32; 2]`). Of two, the
/// gloss makes one between the first and the second, as [`shininess`](alberti_texture::surface::shininess) says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlinnPhong<E = u32>(
    /// The exponent.
    pub E,
);

impl Reflectance for Lambert {
    #[inline(always)]
    fn shares<L: Lanes>(
        &self,
        lanes: L,
        normal: [L::Number; 3],
        to_light: [L::Number; 3],
        _: [L::Number; 3],
        _: L::Number,
    ) -> [L::Number; 2] {
        [lambert_lanes(lanes, normal, to_light), lanes.splat(0.0)]
    }
}

/// The cosine to a power that is the same for all samples.
#[inline(always)]
fn one_power<L: Lanes>(lanes: L, cosine: L::Number, _: L::Number, exponent: u32) -> L::Number {
    power_lanes(lanes, cosine, exponent)
}

/// The cosine to the power that the gloss makes of two.
#[inline(always)]
fn power_by_gloss<L: Lanes>(lanes: L, cosine: L::Number, gloss: L::Number, range: [u32; 2]) -> L::Number {
    let [least, greatest] = range;
    power_each_lanes(lanes, cosine, shininess_lanes(lanes, gloss, range), least.max(greatest))
}

/// Those that differ in the cosine and the exponent only.
macro_rules! with_highlight {
    ($($name:ident of $exponent:ty: $cosine:ident, $power:ident;)+) => {$(
        impl Reflectance for $name<$exponent> {
            #[inline(always)]
            fn shares<L: Lanes>(
                &self,
                lanes: L,
                normal: [L::Number; 3],
                to_light: [L::Number; 3],
                to_viewer: [L::Number; 3],
                gloss: L::Number,
            ) -> [L::Number; 2] {
                let cosine = $cosine(lanes, normal, to_light, to_viewer);
                let seen = lanes.less(lanes.splat(0.0), cosine);
                let mirrored = lanes.select(seen, $power(lanes, cosine, gloss, self.0), lanes.splat(0.0));
                [lambert_lanes(lanes, normal, to_light), mirrored]
            }
        }
    )+};
}
with_highlight! {
    Phong of u32: phong_cosine_lanes, one_power;
    Phong of [u32; 2]: phong_cosine_lanes, power_by_gloss;
    BlinnPhong of u32: blinn_phong_cosine_lanes, one_power;
    BlinnPhong of [u32; 2]: blinn_phong_cosine_lanes, power_by_gloss;
}

alberti_math::named!(Lambert, Phong(E: exponent), BlinnPhong(E: exponent));

/// A [`Reflectance`] that is picked at run time, its exponent between two, which may be one: each is the type of its
/// name, bit for bit.
///
/// # Cost
/// A match a light, for the samples that are worked on together. The code of all three.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyReflectance {
    /// [`Lambert`].
    Lambert,
    /// [`Phong`].
    Phong([u32; 2]),
    /// [`BlinnPhong`].
    BlinnPhong([u32; 2]),
}

impl Reflectance for AnyReflectance {
    #[inline(always)]
    fn shares<L: Lanes>(
        &self,
        lanes: L,
        normal: [L::Number; 3],
        to_light: [L::Number; 3],
        to_viewer: [L::Number; 3],
        gloss: L::Number,
    ) -> [L::Number; 2] {
        match *self {
            Self::Lambert => Lambert.shares(lanes, normal, to_light, to_viewer, gloss),
            Self::Phong(exponents) => Phong(exponents).shares(lanes, normal, to_light, to_viewer, gloss),
            Self::BlinnPhong(exponents) => {
                BlinnPhong(exponents).shares(lanes, normal, to_light, to_viewer, gloss)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::lanes::One;

    #[test]
    fn any_reflectance_is_the_one_of_its_name() {
        let exponents = [3, 40];
        for k in 0..64u8 {
            let (sin, cos) = (f32::from(k) / 10.0).sin_cos();
            let shares = |by: &dyn Fn(f32) -> [f32; 2]| by(f32::from(k) / 63.0);
            let (normal, to_light, to_viewer) = ([0.0, 0.0, 1.0], [sin, 0.0, cos], [0.6, 0.0, 0.8]);
            let any =
                |of: AnyReflectance| shares(&|gloss| of.shares(One, normal, to_light, to_viewer, gloss));
            let lambert = shares(&|gloss| Lambert.shares(One, normal, to_light, to_viewer, gloss));
            let phong = shares(&|gloss| Phong(exponents).shares(One, normal, to_light, to_viewer, gloss));
            let blinn =
                shares(&|gloss| BlinnPhong(exponents).shares(One, normal, to_light, to_viewer, gloss));
            assert_eq!(any(AnyReflectance::Lambert), lambert);
            assert_eq!(any(AnyReflectance::Phong(exponents)), phong);
            assert_eq!(any(AnyReflectance::BlinnPhong(exponents)), blinn);
            assert!(k > 5 || (lambert != phong && phong != blinn));
        }
    }
}
