//! Lights: the directions from which light falls on a surface, and its colours.

#[cfg(any(feature = "serde", feature = "arbitrary"))]
mod form;

use super::vector::{splat, times, towards, within};
use alberti_math::glam::Vec3;
use alberti_math::lanes::Lanes;
use alberti_math::{Point3, Vector3, World, logged};
use alberti_texture::surface::unit_lanes;
use core::fmt::Debug;

/// A light, or several: tuples, arrays and slices of lights are lights, and `()` is none.
pub trait Light: Copy + Debug {
    /// Folds the lights with `and`, from `sum` on. It takes the sum so far, the unit vectors from the positions towards
    /// a light, and the amount of each colour that arrives where the surface faces it.
    fn fold<L: Lanes, T>(
        &self,
        lanes: L,
        position: [L::Number; 3],
        sum: T,
        and: impl Fn(T, [L::Number; 3], [L::Number; 3]) -> T + Copy,
    ) -> T;
}

/// A light so far away that it shines in one direction, such as the sun.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "form::Sun", into = "form::Sun"))]
pub struct Directional {
    to_light: Vec3,
    color: Vec3,
}

impl Directional {
    /// Light from the direction `to_light`, of any length; none where that is zero or not finite.
    #[must_use]
    pub fn new(to_light: Vector3<World>, color: Vec3) -> Self {
        Self { to_light: direction(to_light), color }
    }
}

impl Light for Directional {
    #[inline(always)]
    fn fold<L: Lanes, T>(
        &self,
        lanes: L,
        _: [L::Number; 3],
        sum: T,
        and: impl Fn(T, [L::Number; 3], [L::Number; 3]) -> T + Copy,
    ) -> T {
        and(sum, splat(lanes, self.to_light), splat(lanes, self.color))
    }
}

/// A light that shines from a point in all directions, such as a bulb. In its own place it shines from (0, 0, 1).
///
/// # Precision
/// The light that arrives is within 10ε of itself (ε = 2^-24), for distances up to 10^19. Farther away, and where a
/// number of the light is not finite, nothing is promised but that colours are.
///
/// In fixed point the light counts as within ±28000 on each axis, and its direction is within 2.5·2^-16 from anywhere.
/// For the falloff, components of the vector to it count as at most 100: a light that is farther is no dimmer. That
/// distance is within 13·2^-16 where it is 1/16 or more, its square within 1.5·2^-16, and 1/(c + l d + q d²) is rounded
/// down to 2^-16. The divisor and what arrives are at most 2^15.
///
/// # Cost
/// Two square roots and four divisions a fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct PointLight {
    /// The place of the light.
    pub position: Point3<World>,
    /// The amount of each colour that arrives at a distance where the falloff is 1.
    pub color: Vec3,
    /// The falloff: \[c, l, q\] for 1/(c + l d + q d²) at the distance d, none of them below zero. A result above 2^14
    /// counts as that, such as the infinite one that a light has in its own place without c.
    pub falloff: [f32; 3],
}

impl PointLight {
    /// The unit vectors towards it, and the colours that arrive.
    #[inline(always)]
    fn arrives<L: Lanes>(&self, lanes: L, position: [L::Number; 3]) -> [[L::Number; 3]; 2] {
        let to_light = towards(lanes, self.position.coords, position);
        // Three squares of 100 still fit.
        let [a, b, c] = within(lanes, 100.0, to_light);
        let square = a * a + b * b + c * c;
        let [constant, linear, quadratic] = splat(lanes, Vec3::from_array(self.falloff));
        let slow = lanes.saturating_add(constant, lanes.saturating_mul(linear, lanes.sqrt(square)));
        let decay = lanes.saturating_add(slow, lanes.saturating_mul(quadratic, square));
        let falloff = lanes.splat(1.0) / lanes.max(decay, lanes.splat(1.0 / 16384.0));
        [unit_lanes(lanes, to_light), times(lanes, splat(lanes, self.color), falloff)]
    }
}

impl Light for PointLight {
    #[inline(always)]
    fn fold<L: Lanes, T>(
        &self,
        lanes: L,
        position: [L::Number; 3],
        sum: T,
        and: impl Fn(T, [L::Number; 3], [L::Number; 3]) -> T + Copy,
    ) -> T {
        let [to_light, color] = self.arrives(lanes, position);
        and(sum, to_light, color)
    }
}

/// A light that shines from a point into a cone, such as a stage light.
///
/// # Precision
/// As a [`PointLight`], and at the edge within 16ε/(inner − outer) of all that arrives (ε = 2^-24).
///
/// # Cost
/// That of a [`PointLight`], and seven multiplications.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "form::Cone", into = "form::Cone"))]
pub struct SpotLight {
    point: PointLight,
    /// Away from the light.
    axis: Vec3,
    /// The cosines up to which it is whole, and beyond which nothing arrives.
    inner: f32,
    outer: f32,
    /// The increment of the share by a cosine of one.
    slope: f32,
}

impl SpotLight {
    /// A light that shines along `axis`, of any length but zero. It is whole up to the angle with the cosine `inner`,
    /// and from there less, linearly in the cosine, up to the angle with the cosine `outer`. An `inner` that is not
    /// above `outer` by at least 2^-12 counts as that: the edge is sharp.
    #[must_use]
    pub fn new(point: PointLight, axis: Vector3<World>, [inner, outer]: [f32; 2]) -> Self {
        // A sharp edge is as steep as numbers in fixed point can tell.
        let slope = 1.0 / (inner - outer).max(1.0 / 4096.0);
        Self { point, axis: direction(axis), inner, outer, slope }
    }

    /// The cosines of the inner and the outer angle.
    #[must_use]
    pub const fn cosines(&self) -> [f32; 2] {
        [self.inner, self.outer]
    }
}

impl Light for SpotLight {
    #[inline(always)]
    fn fold<L: Lanes, T>(
        &self,
        lanes: L,
        position: [L::Number; 3],
        sum: T,
        and: impl Fn(T, [L::Number; 3], [L::Number; 3]) -> T + Copy,
    ) -> T {
        let [to_light, color] = self.point.arrives(lanes, position);
        let ([x, y, z], [a, b, c]) = (to_light, splat(lanes, self.axis));
        let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
        let inside = lanes.saturating_sub(zero - (x * a + y * b + z * c), lanes.splat(self.outer));
        let share = lanes.saturating_mul(inside, lanes.splat(self.slope));
        and(sum, to_light, times(lanes, color, lanes.min(lanes.max(share, zero), one)))
    }
}

/// A [`Light`] that is picked at run time.
///
/// # Cost
/// A match for the samples that are worked on together. The code of all three.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyLight {
    /// One so far away that it shines in one direction.
    Directional(Directional),
    /// One that shines in all directions.
    Point(PointLight),
    /// One that shines into a cone.
    Spot(SpotLight),
}

impl Light for AnyLight {
    #[inline(always)]
    fn fold<L: Lanes, T>(
        &self,
        lanes: L,
        position: [L::Number; 3],
        sum: T,
        and: impl Fn(T, [L::Number; 3], [L::Number; 3]) -> T + Copy,
    ) -> T {
        match self {
            Self::Directional(light) => light.fold(lanes, position, sum, and),
            Self::Point(light) => light.fold(lanes, position, sum, and),
            Self::Spot(light) => light.fold(lanes, position, sum, and),
        }
    }
}

logged! {
    [] Directional: "Directional {{ to_light: {}, color: {} }}",
        |light| light.to_light.to_array(), light.color.to_array();
    [] PointLight: "PointLight {{ position: {}, color: {}, falloff: {} }}",
        |light| light.position, light.color.to_array(), light.falloff;
    [] SpotLight: "SpotLight {{ point: {}, axis: {}, cosines: {} }}",
        |light| light.point, light.axis.to_array(), light.cosines();
}

/// The unit vector, each component within ε; zero where there is none.
fn direction(v: Vector3<World>) -> Vec3 {
    // Squares of `f32` neither overflow nor vanish in `f64`.
    v.coords.as_dvec3().normalize_or_zero().as_vec3()
}

impl Light for () {
    #[inline(always)]
    fn fold<L: Lanes, T>(
        &self,
        _: L,
        _: [L::Number; 3],
        sum: T,
        _: impl Fn(T, [L::Number; 3], [L::Number; 3]) -> T + Copy,
    ) -> T {
        sum
    }
}

/// Lights that are several.
macro_rules! several {
    ($([$($generics:tt)*] $lights:ty: |$self:ident| $each:expr;)+) => {$(
        impl<$($generics)*> Light for $lights {
            #[inline(always)]
            fn fold<L: Lanes, T>(
                &self,
                lanes: L,
                position: [L::Number; 3],
                sum: T,
                and: impl Fn(T, [L::Number; 3], [L::Number; 3]) -> T + Copy,
            ) -> T {
                let $self = self;
                let mut sum = sum;
                for light in $each {
                    sum = light.fold(lanes, position, sum, and);
                }
                sum
            }
        }
    )+};
}
several! {
    [A: Light, const N: usize] [A; N]: |lights| lights;
    [A: Light] &[A]: |lights| *lights;
}

macro_rules! tuples {
    ($($($name:ident $index:tt)+;)+) => {$(
        impl<$($name: Light),+> Light for ($($name,)+) {
            #[inline(always)]
            fn fold<L: Lanes, T>(
                &self,
                lanes: L,
                position: [L::Number; 3],
                sum: T,
                and: impl Fn(T, [L::Number; 3], [L::Number; 3]) -> T + Copy,
            ) -> T {
                $(let sum = self.$index.fold(lanes, position, sum, and);)+
                sum
            }
        }
    )+};
}
tuples! {
    A 0;
    A 0 B 1;
    A 0 B 1 C 2;
    A 0 B 1 C 2 D 3;
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::lanes::One;

    #[test]
    fn any_light_is_the_one_of_its_kind() {
        fn arrives(light: impl Light, position: [f32; 3]) -> Option<[[f32; 3]; 2]> {
            light.fold(One, position, None, |_, to_light, color| Some([to_light, color]))
        }
        let sun = Directional::new(Vector3::new(Vec3::new(1.0, 2.0, 3.0)), Vec3::new(0.5, 0.25, 1.0));
        let position = Point3::new(Vec3::new(0.5, 4.0, 1.0));
        let bulb = PointLight { position, color: Vec3::ONE, falloff: [1.0, 0.0, 0.25] };
        let spot = SpotLight::new(bulb, Vector3::new(Vec3::NEG_Y), [0.9, 0.7]);
        let mut edges = 0;
        for x in (-8..8i8).map(f32::from) {
            let place = [x, 0.5, -x];
            assert_eq!(arrives(AnyLight::Directional(sun), place), arrives(sun, place));
            assert_eq!(arrives(AnyLight::Point(bulb), place), arrives(bulb, place));
            assert_eq!(arrives(AnyLight::Spot(spot), place), arrives(spot, place));
            assert!(arrives(sun, place) != arrives(bulb, place));
            edges += u32::from(arrives(bulb, place) != arrives(spot, place));
        }
        assert!(edges > 4, "{edges}");
    }
}
