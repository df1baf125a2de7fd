//! Reflectances: the shares of a light that a surface sends towards the viewer.

use alberti_math::lanes::Lanes;
use alberti_texture::surface::{
    blinn_phong_cosine_lanes, lambert_lanes, phong_cosine_lanes, power_each_lanes, power_lanes,
    shininess_lanes,
};
use core::fmt::Debug;

/// A model of reflection: [`Lambert`], [`Phong`] or [`BlinnPhong`], or one of the last two in [`Grazing`].
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

/// A reflectance whose mirrored share fades where light grazes the surface: times 4 n·l, where that is below 1.
///
/// By Phong and by Blinn alone, highlights end at once where light comes from behind. Those of exponents up to about 30
/// are still bright there, and have an edge across the surface.
///
/// # Precision
/// The factor is within 13ε (ε = 2^-24); in fixed point within 7·2^-16.
///
/// # Cost
/// Two multiplications and a minimum a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grazing<R>(
    /// The reflectance.
    pub R,
);

impl<R: Reflectance> Reflectance for Grazing<R> {
    #[inline(always)]
    fn shares<L: Lanes>(
        &self,
        lanes: L,
        normal: [L::Number; 3],
        to_light: [L::Number; 3],
        to_viewer: [L::Number; 3],
        gloss: L::Number,
    ) -> [L::Number; 2] {
        let [scattered, mirrored] = self.0.shares(lanes, normal, to_light, to_viewer, gloss);
        let facing = lambert_lanes(lanes, normal, to_light);
        [scattered, mirrored * lanes.min(facing * lanes.splat(4.0), lanes.splat(1.0))]
    }
}

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

alberti_math::named!(Lambert, Phong(E: exponent), BlinnPhong(E: exponent), Grazing(R: reflectance));

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
    use alberti_math::Q16;
    use alberti_math::lanes::{One, OneFixed};

    /// All light that there is is mirrored.
    #[derive(Clone, Copy, Debug)]
    struct Mirror;

    impl Reflectance for Mirror {
        fn shares<L: Lanes>(
            &self,
            lanes: L,
            _: [L::Number; 3],
            _: [L::Number; 3],
            _: [L::Number; 3],
            _: L::Number,
        ) -> [L::Number; 2] {
            [lanes.splat(0.5), lanes.splat(1.0)]
        }
    }

    #[test]
    fn mirrored_light_fades_where_it_grazes() {
        for k in 0..6284_u16 {
            let (sin, cos) = (f32::from(k) / 1000.0).sin_cos();
            let (normal, to_light) = ([0.6, 0.0, 0.8], [sin, 0.0, cos]);
            let cosine = f64::from(0.6_f32) * f64::from(sin) + f64::from(0.8_f32) * f64::from(cos);
            let exact = (4.0 * cosine).clamp(0.0, 1.0);
            let [scattered, mirrored] = Grazing(Mirror).shares(One, normal, to_light, [0.0; 3], 1.0);
            assert_eq!(scattered, 0.5);
            assert!((f64::from(mirrored) - exact).abs() <= 13.0 / 16_777_216.0, "{cosine}");
            // Components of 16 bits of fraction.
            let [normal, to_light] = [normal, to_light].map(|v| v.map(Q16::from_f32));
            let real = |x: Q16| f64::from(x.to_bits()) / 65536.0;
            let cosine: f64 = normal.into_iter().zip(to_light).map(|(n, l)| real(n) * real(l)).sum();
            let exact = (4.0 * cosine).clamp(0.0, 1.0);
            let [_, mirrored] = Grazing(Mirror).shares(OneFixed, normal, to_light, [Q16::ZERO; 3], Q16::ZERO);
            assert!((real(mirrored) - exact).abs() <= 7.0 / 65536.0, "{cosine}");
        }
    }

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
