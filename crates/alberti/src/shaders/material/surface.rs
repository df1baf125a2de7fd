//! The state of a surface at a fragment, and the layers that change it.

use alberti_math::glam::{Vec2, Vec3};
use alberti_math::lanes::Lanes;
use alberti_math::{Point3, Varying, Vector3, World, varying};
use alberti_raster::{Differentiation, Gradient, NoDerivatives};
use alberti_texture::surface::unit_lanes;
use core::fmt::Debug;

use super::layers::colors;
use super::light_space::{decoded, shown};
use super::vector::{by, plus, times, towards};
use crate::shaders::wide::pack;

/// The varying of a lit surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placed {
    /// The position, in world space.
    pub position: Vec3,
    /// The normal, in world space, from 2^-60 to 2^60 long.
    pub normal: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
}

varying!(Placed { position: Vec3, normal: Vec3, uv: Vec2 });

/// The varying of a lit surface whose maps are relative to the tangent frame: bump, normal and parallax maps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Framed {
    /// The position, in world space.
    pub position: Vec3,
    /// The directions of growing u and v, and the normal, in world space: unit vectors, which are interpolated as they
    /// are.
    pub axes: [Vec3; 3],
    /// Texture coordinates.
    pub uv: Vec2,
}

varying!(Framed { position: Vec3, axes: [Vec3; 3], uv: Vec2 });

/// A varying with texture coordinates, a place and a normal: [`Placed`], [`Framed`], or one of yours.
pub trait OnSurface: Varying {
    /// The coordinates of a bundle.
    fn uv<N: Copy>(bundle: &Self::Of<N>) -> [N; 2];

    /// The place and the normal of a bundle.
    fn place<N: Copy>(bundle: &Self::Of<N>) -> [[N; 3]; 2];
}

/// An [`OnSurface`] varying with a tangent frame.
pub trait Axes: OnSurface {
    /// The axes of a bundle: the directions of u and v, and the normal.
    fn axes<N: Copy>(bundle: &Self::Of<N>) -> [[N; 3]; 3];
}

impl OnSurface for Placed {
    #[inline(always)]
    fn uv<N: Copy>(bundle: &Self::Of<N>) -> [N; 2] {
        bundle.uv
    }

    #[inline(always)]
    fn place<N: Copy>(bundle: &Self::Of<N>) -> [[N; 3]; 2] {
        [bundle.position, bundle.normal]
    }
}

impl OnSurface for Framed {
    #[inline(always)]
    fn uv<N: Copy>(bundle: &Self::Of<N>) -> [N; 2] {
        bundle.uv
    }

    #[inline(always)]
    fn place<N: Copy>(bundle: &Self::Of<N>) -> [[N; 3]; 2] {
        let [_, _, normal] = bundle.axes;
        [bundle.position, normal]
    }
}

impl Axes for Framed {
    #[inline(always)]
    fn axes<N: Copy>(bundle: &Self::Of<N>) -> [[N; 3]; 3] {
        bundle.axes
    }
}

/// The viewer of surfaces: a point, or a direction if that is infinitely far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewer {
    place: Vec3,
    /// 1 for a point, 0 for a direction.
    weight: f32,
}

impl Viewer {
    /// A viewer at a point: the camera of a perspective. In fixed point it counts as within ±28000 on each axis.
    #[must_use]
    pub const fn at(place: Point3<World>) -> Self {
        Self { place: place.coords, weight: 1.0 }
    }

    /// A viewer at infinity, in a direction from the surface: that of a parallel projection.
    #[must_use]
    pub const fn towards(direction: Vector3<World>) -> Self {
        Self { place: direction.coords, weight: 0.0 }
    }

    /// The unit vector from a position towards it; (0, 0, 1) where there is none.
    #[inline(always)]
    pub(super) fn direction<L: Lanes>(self, lanes: L, [x, y, z]: [L::Number; 3]) -> [L::Number; 3] {
        let weight = lanes.splat(self.weight);
        unit_lanes(lanes, towards(lanes, self.place, [x * weight, y * weight, z * weight]))
    }
}

/// The state of the surface at several fragments, which the layers change one after the other.
#[derive(Clone, Copy, Debug)]
pub struct Surface<L: Lanes> {
    /// Texture coordinates at which maps are read.
    pub uv: [L::Number; 2],
    /// The derivatives of these from pixel to pixel.
    pub gradient: Gradient<[L::Number; 2]>,
    /// The position, in world space; 0 where vertices do not carry it, like the next two.
    pub position: [L::Number; 3],
    /// The unit normal, in world space.
    pub normal: [L::Number; 3],
    /// The unit vector towards the viewer, in world space.
    pub to_viewer: [L::Number; 3],
    /// The share of each colour that is scattered: 1 to begin with.
    pub diffuse: [L::Number; 3],
    /// The share of each colour that is mirrored where lights are: 0 to begin with.
    pub specular: [L::Number; 3],
    /// The sharpness of that, from 0 to 1: 1 to begin with. A [`Reflectance`](super::Reflectance) makes an exponent of
    /// it.
    pub gloss: L::Number,
    /// The share of the ambient light that arrives: 1 to begin with.
    pub openness: L::Number,
    /// Light that is added: 0 to begin with.
    pub emission: [L::Number; 3],
    /// The alpha that is stored, a byte: 255 to begin with.
    pub alpha: L::U32,
    /// Whether the colours are amounts of light, or else bytes over 255: see [`InSpace`](super::InSpace).
    pub linear: bool,
}

impl<L: Lanes> Surface<L> {
    /// A surface that is white, matt, and nowhere.
    #[inline(always)]
    pub(super) fn new(
        lanes: L,
        uv: [L::Number; 2],
        gradient: Gradient<[L::Number; 2]>,
        linear: bool,
    ) -> Self {
        let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
        Self {
            uv,
            gradient,
            position: [zero; 3],
            normal: [zero; 3],
            to_viewer: [zero; 3],
            diffuse: [one; 3],
            specular: [zero; 3],
            gloss: one,
            openness: one,
            emission: [zero; 3],
            alpha: lanes.word(255),
            linear,
        }
    }

    /// The three colours of words, from 0 to 1, in the space of this surface.
    #[inline(always)]
    pub fn colors(&self, lanes: L, words: L::U32) -> [L::Number; 3] {
        if self.linear { decoded(lanes, words) } else { colors(lanes, words) }
    }

    /// The same surface in its place.
    #[inline(always)]
    pub(super) fn placed<V: OnSurface>(self, lanes: L, varyings: &V::Of<L::Number>, viewer: Viewer) -> Self {
        let [position, normal] = V::place(varyings);
        let (normal, to_viewer) = (unit_lanes(lanes, normal), viewer.direction(lanes, position));
        Self { position, normal, to_viewer, ..self }
    }

    /// The colours that are seen where so much light is scattered, and mirrored.
    #[inline(always)]
    pub(super) fn seen(&self, lanes: L, scattered: [L::Number; 3], mirrored: [L::Number; 3]) -> L::U32 {
        let seen = plus(lanes, by(lanes, self.diffuse, scattered), by(lanes, self.specular, mirrored));
        let seen = plus(lanes, self.emission, seen);
        let [r, g, b] = if self.linear { shown(lanes, seen) } else { times(lanes, seen, lanes.splat(255.0)) };
        pack(lanes, [lanes.nearest_byte(r), lanes.nearest_byte(g), lanes.nearest_byte(b), self.alpha])
    }
}

/// A part of a material, for vertices that carry `V`: it changes the state of the surface.
///
/// Tuples of up to eight are layers, one after the other. So is `()`, which changes nothing, and so is an `Option` of a
/// layer.
pub trait Layer<V: Varying>: Copy + Debug {
    /// The policy for the derivatives that its maps need.
    type Derivatives: Differentiation;

    /// Changes the surface.
    fn apply<L: Lanes>(&self, lanes: L, varyings: &V::Of<L::Number>, surface: &mut Surface<L>);
}

impl<V: Varying> Layer<V> for () {
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn apply<L: Lanes>(&self, _: L, _: &V::Of<L::Number>, _: &mut Surface<L>) {}
}

/// A layer that is there or not, as known at run time.
impl<V: Varying, T: Layer<V>> Layer<V> for Option<T> {
    type Derivatives = T::Derivatives;

    #[inline(always)]
    fn apply<L: Lanes>(&self, lanes: L, varyings: &V::Of<L::Number>, surface: &mut Surface<L>) {
        if let Some(layer) = self {
            layer.apply(lanes, varyings, surface);
        }
    }
}

/// The policy for the derivatives that several layers need.
macro_rules! together {
    ($first:ident) => { $first::Derivatives };
    ($first:ident $($rest:ident)+) => { <$first::Derivatives as Differentiation>::With<together!($($rest)+)> };
}

macro_rules! tuples {
    ($($($name:ident $index:tt)+;)+) => {$(
        impl<V: Varying, $($name: Layer<V>),+> Layer<V> for ($($name,)+) {
            type Derivatives = together!($($name)+);

            #[inline(always)]
            fn apply<L: Lanes>(&self, lanes: L, varyings: &V::Of<L::Number>, surface: &mut Surface<L>) {
                $(self.$index.apply(lanes, varyings, surface);)+
            }
        }
    )+};
}
tuples! {
    A 0;
    A 0 B 1;
    A 0 B 1 C 2;
    A 0 B 1 C 2 D 3;
    A 0 B 1 C 2 D 3 E 4;
    A 0 B 1 C 2 D 3 E 4 F 5;
    A 0 B 1 C 2 D 3 E 4 F 5 G 6;
    A 0 B 1 C 2 D 3 E 4 F 5 G 6 H 7;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FragmentStage;
    use crate::shaders::material::{Color, Directional, Emission, Lambert, Lighting, Material};
    use alberti_math::Rgba8;

    /// One that is there is the layer itself, one that is not changes nothing.
    #[test]
    fn layers_may_be_optional() {
        let lights = Directional::new(Vector3::new(Vec3::Z), Vec3::splat(0.7));
        let (ambient, reflectance) = (Vec3::splat(0.2), Lambert);
        let lighting =
            Lighting { viewer: Viewer::towards(Vector3::new(Vec3::Z)), ambient, lights, reflectance };
        let (color, glow) = (Color(Rgba8::new(200, 100, 50, 255)), Emission(Rgba8::new(10, 20, 30, 255)));
        let place = Placed { position: Vec3::ZERO, normal: Vec3::new(0.6, 0.0, 0.8), uv: Vec2::ZERO };
        let plain = Material { layers: color, lighting }.shade_one(place);
        let glowing = Material { layers: (color, glow), lighting }.shade_one(place);
        assert_ne!(plain, glowing);
        for (there, expected) in [(None, plain), (Some(glow), glowing)] {
            assert_eq!(Material { layers: (color, there), lighting }.shade_one(place), expected);
            assert_eq!(Material { layers: (Some(color), there), lighting }.shade_one(place), expected);
        }
    }
}
