//! Layers whose maps have one size, and are read together.

use super::surface::{Layer, Surface};
use alberti_math::Varying;
use alberti_math::lanes::Lanes;
use alberti_raster::PerPixel;
use alberti_texture::format::Storage;
use alberti_texture::{MipFilter, MipSampler, Size, Wrap};
use core::fmt::Debug;

/// Layers, from the first to the last, of which each has the texels of one of several maps of one size: as many maps as
/// layers. In the places of the layers' own maps is [`Shared`]. The bits are those of layers with maps of their own.
///
/// ```
/// use alberti::Rgba8;
/// use alberti::glam::{Vec2, Vec3};
/// use alberti::shaders::material::{
///     Color, Directional, Framed, Lambert, Lighting, Material, NormalMap, Shared, Together, Viewer,
/// };
/// use alberti::texture::{Mipmap, Repeat, Trilinear, format::Rgba8888, surface::NormalEncoding::Centred};
/// use alberti::{FragmentStage, Vector3};
///
/// let [color, normal] = [[200, 100, 50, 255], [128, 128, 255, 255]];
/// let [color, normal] = [[color; 5], [normal; 5]];
/// let [color, normal] = [&color, &normal].map(|texels| Mipmap::new(Rgba8888, texels, 2, 2).expect("2 x 2"));
/// let surface = Material {
///     layers: Together {
///         maps: Mipmap::together([color, normal]).expect("one size").sampler(Trilinear, Repeat),
///         layers: (Color(Shared), NormalMap { map: Shared, encoding: Centred, strength: 1.0 }),
///     },
///     lighting: Lighting {
///         viewer: Viewer::towards(Vector3::new(Vec3::Z)),
///         ambient: Vec3::ZERO,
///         lights: Directional::new(Vector3::new(Vec3::Y), Vec3::splat(0.5)),
///         reflectance: Lambert,
///     },
/// };
/// let flat = Framed { position: Vec3::ZERO, axes: [Vec3::X, Vec3::NEG_Z, Vec3::Y], uv: Vec2::ZERO };
/// assert_eq!(surface.shade_one(flat), Some(Rgba8::new(100, 50, 25, 255)));
/// ```
///
/// # Cost
/// That of one map and, for each after the first, its texels and their means.
#[derive(Clone, Copy, Debug)]
pub struct Together<S, T> {
    /// A [`MipSampler`] of several maps: see [`Mipmap::together`](alberti_texture::Mipmap::together).
    pub maps: S,
    /// A tuple of two to eight layers that are [`OfTexels`].
    pub layers: T,
}

/// In the place of a layer's map: its texels come from the maps of [`Together`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shared;

/// A layer that changes the surface by the texels of one map: one that has none of its own, but [`Shared`].
pub trait OfTexels<V: Varying>: Copy + Debug {
    /// Changes the surface by texels, as words.
    fn change<L: Lanes>(
        &self,
        lanes: L,
        varyings: &V::Of<L::Number>,
        texels: L::U32,
        surface: &mut Surface<L>,
    );
}

/// Layers that read a map of their own, in a field, and change the surface by its texels.
macro_rules! of_maps {
    ($($name:ident $field:tt of $bound:ident;)+) => {$(
        impl<V: $bound, M: Map> Layer<V> for $name<M> {
            type Derivatives = M::Derivatives;

            #[inline(always)]
            fn apply<L: Lanes>(&self, lanes: L, varyings: &V::Of<L::Number>, surface: &mut Surface<L>) {
                let texels = self.$field.read(lanes, surface.uv, &surface.gradient);
                <Self as OfTexels<V>>::change(self, lanes, varyings, texels, surface);
            }
        }
    )+};
}
pub(super) use of_maps;

macro_rules! tuples {
    ($($count:literal: $($name:ident $texels:ident $index:tt)+;)+) => {$(
        impl<Vs, F, M, U, V, Z, $($name),+> Layer<Vs>
            for Together<MipSampler<'_, F, M, U, V, Z, $count>, ($($name,)+)>
        where
            Vs: Varying,
            F: Storage,
            M: MipFilter,
            U: Wrap,
            V: Wrap,
            Z: Size,
            $($name: OfTexels<Vs>,)+
        {
            type Derivatives = PerPixel;

            #[inline(always)]
            fn apply<L: Lanes>(&self, lanes: L, varyings: &Vs::Of<L::Number>, surface: &mut Surface<L>) {
                let [$($texels),+] = self.maps.sample_each_lanes(lanes, surface.uv, surface.gradient);
                $(self.layers.$index.change(lanes, varyings, $texels, surface);)+
            }
        }
    )+};
}
tuples! {
    2: A a 0 B b 1;
    3: A a 0 B b 1 C c 2;
    4: A a 0 B b 1 C c 2 D d 3;
    5: A a 0 B b 1 C c 2 D d 3 E e 4;
    6: A a 0 B b 1 C c 2 D d 3 E e 4 G g 5;
    7: A a 0 B b 1 C c 2 D d 3 E e 4 G g 5 H h 6;
    8: A a 0 B b 1 C c 2 D d 3 E e 4 G g 5 H h 6 I i 7;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::material::{
        Color, Directional, Emission, Framed, Gloss, Lighting, Material, NormalMap, Occlusion, Phong,
        Specular, Viewer, Wetness,
    };
    use crate::{FragmentStage, Vector3};
    use alberti_math::Rgba8888;
    use alberti_math::glam::{Vec2, Vec3};
    use alberti_texture::surface::NormalEncoding::Unorm;
    use alberti_texture::{Mipmap, Repeat, Trilinear};

    /// Each layer gets the texels of its own map, and of no other.
    #[test]
    fn layers_are_those_with_maps_of_their_own() {
        let mut byte = 90_u8;
        let chains = [(); 7].map(|()| {
            [(); 5].map(|()| {
                [(); 4].map(|()| {
                    byte = byte.wrapping_mul(29).wrapping_add(67);
                    byte
                })
            })
        });
        let maps = chains.each_ref().map(|chain| Mipmap::new(Rgba8888, chain, 2, 2).expect("2 x 2"));
        let [color, normal, specular, gloss, wetness, openness, glow] =
            maps.map(|map| map.sampler(Trilinear, Repeat));
        let alone = (
            Color(color),
            NormalMap { map: normal, encoding: Unorm, strength: 2.0 },
            Specular(specular),
            Gloss(gloss),
            Wetness(wetness),
            Occlusion { map: openness, strength: 0.5 },
            Emission(glow),
        );
        let layers = (
            Color(Shared),
            NormalMap { map: Shared, encoding: Unorm, strength: 2.0 },
            Specular(Shared),
            Gloss(Shared),
            Wetness(Shared),
            Occlusion { map: Shared, strength: 0.5 },
            Emission(Shared),
        );
        let maps = Mipmap::together(maps).expect("one size").sampler(Trilinear, Repeat);
        let up = Vector3::new(Vec3::Z);
        let lights = Directional::new(up, Vec3::splat(0.3));
        let lighting = Lighting {
            viewer: Viewer::towards(up),
            ambient: Vec3::splat(0.1),
            lights,
            reflectance: Phong([3, 20]),
        };
        for [u, v] in [[0.2, 0.7], [0.6, 0.1], [0.9, 0.4]] {
            let axes = [Vec3::X, Vec3::Y, Vec3::Z];
            let place = Framed { position: Vec3::ZERO, axes, uv: Vec2::new(u, v) };
            let expected = Material { layers: alone, lighting }.shade_one(place);
            assert_eq!(Material { layers: Together { maps, layers }, lighting }.shade_one(place), expected);
        }
    }
}
