//! Layers of one map: the colours and numbers of a surface.

use super::map::Map;
use super::surface::{Layer, OnSurface, Surface};
use super::together::{OfTexels, of_maps};
use super::vector::plus;
use crate::shaders::wide::unpack;
use alberti_math::Varying;
use alberti_math::lanes::Lanes;
use alberti_texture::surface::{ambient_occlusion_lanes, wet_lanes};
use core::fmt::Debug;

/// The diffuse colour and the alpha. A factor of it is [`Times`](super::Times).
#[derive(Clone, Copy, Debug)]
pub struct Color<M>(
    /// A [`Map`].
    pub M,
);

/// The specular colour: how much of each colour a highlight mirrors.
#[derive(Clone, Copy, Debug)]
pub struct Specular<M>(
    /// A [`Map`].
    pub M,
);

/// A shininess map, in the red channel: how sharp highlights are between the two exponents of the
/// [`Reflectance`](super::Reflectance).
#[derive(Clone, Copy, Debug)]
pub struct Gloss<M>(
    /// A [`Map`].
    pub M,
);

/// A wetness map, in the red channel: water darkens the diffuse colour and sharpens the highlight, as
/// [`Wettable::wet`](alberti_texture::surface::Wettable::wet) says. It comes after [`Color`] and [`Gloss`].
#[derive(Clone, Copy, Debug)]
pub struct Wetness<M>(
    /// A [`Map`].
    pub M,
);

/// An ambient occlusion map, in the red channel: the share of the ambient light that arrives, as
/// [`ambient_occlusion`](alberti_texture::surface::ambient_occlusion) says.
#[derive(Clone, Copy, Debug)]
pub struct Occlusion<M> {
    /// A [`Map`].
    pub map: M,
    /// The strength of it, from 0 to 1.
    pub strength: f32,
}

/// Light that the surface itself sends out, or that it sends on: the light of several layers is added.
#[derive(Clone, Copy, Debug)]
pub struct Emission<M>(
    /// A [`Map`].
    pub M,
);

/// The three colours of words, from 0 to 1.
#[inline(always)]
pub(super) fn colors<L: Lanes>(lanes: L, words: L::U32) -> [L::Number; 3] {
    let [r, g, b, _] = unpack(lanes, words);
    [unit(lanes, r), unit(lanes, g), unit(lanes, b)]
}

/// The first of them.
#[inline(always)]
pub(super) fn red<L: Lanes>(lanes: L, words: L::U32) -> L::Number {
    unit(lanes, words & lanes.word(255))
}

/// A byte over 255.
#[inline(always)]
fn unit<L: Lanes>(lanes: L, byte: L::U32) -> L::Number {
    lanes.to_numbers(byte) / lanes.splat(255.0)
}

/// Layers of one map's texels.
macro_rules! of_texels {
    ($($name:ident of $bound:ident: |$layer:pat_param, $lanes:ident, $surface:ident, $words:ident| $change:expr;)+) => {$(
        impl<V: $bound, M: Copy + Debug> OfTexels<V> for $name<M> {
            #[inline(always)]
            fn change<L: Lanes>(
                &self,
                $lanes: L,
                _: &V::Of<L::Number>,
                $words: L::U32,
                $surface: &mut Surface<L>,
            ) {
                let $layer = self;
                $change;
            }
        }
    )+};
}
of_texels! {
    Color of Varying: |_, lanes, surface, words| {
        surface.diffuse = surface.colors(lanes, words);
        surface.alpha = lanes.shr(words, 24);
    };
    Specular of Varying: |_, lanes, surface, words| surface.specular = surface.colors(lanes, words);
    Gloss of Varying: |_, lanes, surface, words| surface.gloss = red(lanes, words);
    Wetness of Varying: |_, lanes, surface, words| {
        let wetness = red(lanes, words);
        (surface.diffuse, surface.gloss) = wet_lanes(lanes, surface.diffuse, surface.gloss, wetness);
    };
    Occlusion of OnSurface: |layer, lanes, surface, words| {
        surface.openness = ambient_occlusion_lanes(lanes, red(lanes, words), layer.strength);
    };
    Emission of Varying: |_, lanes, surface, words| {
        surface.emission = plus(lanes, surface.emission, surface.colors(lanes, words));
    };
}
of_maps! {
    Color 0 of Varying;
    Specular 0 of Varying;
    Gloss 0 of Varying;
    Wetness 0 of Varying;
    Occlusion map of OnSurface;
    Emission 0 of Varying;
}
