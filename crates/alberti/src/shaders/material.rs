//! Materials: the layers that a surface is made of, and the lighting that makes a colour of them.
//!
//! ```text
//! vertex:    position, axes, texture coordinates          Placed or Framed
//! fragment:  where to look      Parallax                  layers, in the order in which they are given,
//!            which way it faces Bump, NormalMap, ...      each of which changes the Surface
//!            what it is         Color, Specular, Gloss, Wetness, Occlusion, Emission, Reflection
//!            what is seen       Lighting: lights, a reflectance, the viewer; or light found at the vertices
//! ```
//!
//! A [`Material`] is compiled for its layers: one that is absent is no code. [`Together`] are layers that find their
//! places in maps of one size once. Everything is wide, and the same at every
//! width. Directions and places are in world space; colours are numbers from 0 to 1 in the encoding of the texels, like
//! those of all built-in stages. In [`LinearLight`] they are amounts of light: see [`InSpace`].
//!
//! ```
//! use alberti::shaders::material::{
//!     BlinnPhong, Color, Directional, Lighting, Material, Placed, Specular, Viewer,
//! };
//! use alberti::{FragmentStage, Point3, Rgba8, Vector3, World, glam::{Vec2, Vec3}};
//!
//! let eye = Point3::<World>::new(Vec3::new(0.0, 0.0, 5.0));
//! let brass = Material {
//!     layers: (Color(Rgba8::from_rgb24(0xb0_80_30)), Specular(Rgba8::from_rgb24(0x80_80_60))),
//!     lighting: Lighting {
//!         viewer: Viewer::at(eye),
//!         ambient: Vec3::splat(0.2),
//!         lights: Directional::new(Vector3::new(Vec3::Z), Vec3::splat(0.8)),
//!         reflectance: BlinnPhong(20),
//!     },
//! };
//! // Between the light and the eye, the highlight is on top.
//! let facing = Placed { position: Vec3::ZERO, normal: Vec3::Z, uv: Vec2::ZERO };
//! assert_eq!(brass.shade_one(facing), Some(Rgba8::from_rgb24(0xff_e6_7d)));
//! // From the side there is the ambient light.
//! let aside = Placed { normal: Vec3::X, ..facing };
//! assert_eq!(brass.shade_one(aside), Some(Rgba8::from_rgb24(0x23_1a_0a)));
//! ```

mod layers;
mod light;
mod light_space;
mod reflectance;
mod reflection;
mod relief;
mod surface;
mod together;
mod vector;

pub use layers::{Color, Emission, Gloss, Occlusion, Specular, Wetness};
pub use light::{AnyLight, Directional, Light, PointLight, SpotLight};
pub use light_space::{AnyLightSpace, InSpace, LightSpace, LinearLight};
pub use map::{Called, Map, Times};
pub use reflectance::{AnyReflectance, BlinnPhong, Grazing, Lambert, Phong, Reflectance};
pub use reflection::Reflection;
pub use relief::{Bump, NormalMap, ObjectNormals, Parallax, TwoChannels};
pub use surface::{Axes, Framed, Layer, OnSurface, Placed, Surface, Viewer};
pub use together::{OfTexels, Shared, Together};

use super::map;
use alberti_math::glam::{Vec2, Vec3};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Point3, Rgba8, Vector3, World};
use alberti_raster::{FragmentStage, Fragments};
use alberti_texture::surface::unit_lanes;
use vector::{plus, splat, times};

/// A surface of layers under lights, fragment by fragment.
///
/// # Precision
/// Texels as they are read, each channel is rounded once: within ½ + (40 + 64 e)·2^-16·S of a byte of the exact colour.
/// That is for normals from 2^-60 to 2^60 long, and frames at right angles. e is the exponent of the highlight, 0 for
/// [`Lambert`]. S is 1 or the light that arrives with emission and ambient light in the brightest channel, whichever is
/// more.
///
/// The reason: 255ε is less than 2^-16 (ε = 2^-24). Cosines of unit vectors that are computed are within 20ε, the
/// falloff within 10ε of itself, sums and products take the rest of the 40. With the normal n, the direction v to the
/// viewer, and h and r as in [`blinn_phong`](alberti_texture::surface::blinn_phong) and
/// [`phong`](alberti_texture::surface::phong), n·h is within 19ε and r·v within 34ε. Both are within 64ε with a normal
/// that was read from a map, of which powers make e times that. To this comes,
///
/// * on the edge of a [`SpotLight`], 16·2^-16·S/(inner − outer);
/// * for [`BlinnPhong`], where light and viewer are more than 120° apart, the factor 1/|l + v| of e, for unit vectors;
/// * where a light comes in at right angles to the normal, within 20ε, all of its highlight or none.
///
/// A place, normal or direction that is not finite takes no light but the ambient one. A normal of length 0 is (0, 0,
/// 1). In fixed point nothing wraps: what exceeds 2^15 is that, so that what is brighter than white is white. Lights
/// farther than 100 on an axis fall off as if they were so far on it (see [`PointLight`]).
///
/// # Cost
/// The layers', and the lighting's. Normals and the direction to the viewer are made unit once each, if something asks
/// for them.
#[derive(Clone, Copy, Debug)]
pub struct Material<M, Ls, R> {
    /// The [`Layer`] that it is made of, or a tuple of layers.
    pub layers: M,
    /// The light that falls on it, and the way in which it reflects that.
    pub lighting: Lighting<Ls, R>,
}

impl<M, Ls: Light, R> Material<M, Ls, R> {
    /// The surface at fragments after all layers: all that the lighting takes.
    #[inline(always)]
    pub fn surface<L: Lanes, V: OnSurface>(&self, fragments: &Fragments<L, V>) -> Surface<L>
    where
        M: Layer<V>,
    {
        self.surface_in(fragments, false)
    }

    /// The same in linear light or not.
    #[inline(always)]
    fn surface_in<L: Lanes, V: OnSurface>(&self, fragments: &Fragments<L, V>, linear: bool) -> Surface<L>
    where
        M: Layer<V>,
    {
        let Fragments { lanes, varying, gradient, .. } = *fragments;
        let surface = Surface::new(lanes, V::uv(&varying), gradient.map(|bundle| V::uv(&bundle)), linear);
        let mut surface = surface.placed::<V>(lanes, &varying, self.lighting.viewer);
        self.layers.apply(lanes, &varying, &mut surface);
        surface
    }
}

impl<V, M, Ls, R> FragmentStage<V> for Material<M, Ls, R>
where
    V: OnSurface,
    M: Layer<V>,
    Ls: Light,
    R: Reflectance,
{
    type Color = Rgba8;
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
        (self.lighting.color(fragments.lanes, &self.surface(fragments)), fragments.mask)
    }
}

/// The light that falls on surfaces, and the way in which these reflect it: ambient light, lights, a reflectance.
///
/// A channel of the colour is
///
/// ```text
/// emission + diffuse (ambient occlusion + Σ light max(n·l, 0)) + specular Σ light s
/// ```
///
/// with the normal n, the direction l to the light, and s the [`Reflectance`]'s specular share.
#[derive(Clone, Copy, Debug)]
pub struct Lighting<Ls, R> {
    /// The point or direction from which surfaces are seen.
    pub viewer: Viewer,
    /// The light that falls everywhere: red, green and blue.
    pub ambient: Vec3,
    /// A [`Light`], or a tuple, an array or a slice of lights.
    pub lights: Ls,
    /// [`Lambert`], [`Phong`] or [`BlinnPhong`].
    pub reflectance: R,
}

impl<Ls: Light, R: Reflectance> Lighting<Ls, R> {
    /// The light that a place scatters and mirrors towards the viewer, for white diffuse and specular colours: for
    /// lighting by vertex, whose results [`Gouraud`] takes.
    ///
    /// # Precision
    /// For unit vectors and light S that arrives, ambient light included, within (40 + 64 e)·S·ε of the exact sums, in
    /// each channel, as in [`Material`]. Finite if position, normal and lights, below 2^100, are.
    ///
    /// # Cost
    /// That of a fragment, once a vertex.
    #[must_use]
    pub fn at_vertex(&self, position: Point3<World>, normal: Vector3<World>) -> [Vec3; 2] {
        let (position, normal) = (position.coords.to_array(), unit_lanes(One, normal.coords.to_array()));
        let to_viewer = self.viewer.direction(One, position);
        let [diffuse, specular] = self.shine(One, position, normal, to_viewer, 1.0);
        [self.ambient + Vec3::from(diffuse), Vec3::from(specular)]
    }

    /// The scattered and the mirrored part of all lights.
    #[inline(always)]
    fn shine<L: Lanes>(
        &self,
        lanes: L,
        position: [L::Number; 3],
        normal: [L::Number; 3],
        to_viewer: [L::Number; 3],
        gloss: L::Number,
    ) -> [[L::Number; 3]; 2] {
        let none = [[lanes.splat(0.0); 3]; 2];
        self.lights.fold(
            lanes,
            position,
            none,
            #[inline(always)]
            |[scattered, mirrored], to_light, color| {
                let [diffuse, specular] = self.reflectance.shares(lanes, normal, to_light, to_viewer, gloss);
                [
                    plus(lanes, scattered, times(lanes, color, diffuse)),
                    plus(lanes, mirrored, times(lanes, color, specular)),
                ]
            },
        )
    }

    /// The colours that are seen.
    #[inline(always)]
    fn color<L: Lanes>(&self, lanes: L, surface: &Surface<L>) -> L::U32 {
        let Surface { position, normal, to_viewer, gloss, .. } = *surface;
        let [scattered, mirrored] = self.shine(lanes, position, normal, to_viewer, gloss);
        let ambient = times(lanes, splat(lanes, self.ambient), surface.openness);
        surface.seen(lanes, plus(lanes, scattered, ambient), mirrored)
    }
}

/// A surface of layers under lights that were found at the vertices and are interpolated.
///
/// The varying is (scattered, (mirrored, texture coordinates)): the first two come from [`Lighting::at_vertex`]. Layers
/// that need a place or a frame, such as [`Reflection`], [`Occlusion`] or [`Bump`], do not fit.
///
/// Source: Gouraud, "Continuous shading of curved surfaces", IEEE Transactions on Computers 20 (1971).
///
/// # Precision
/// Texels as they are read, each channel is rounded once: within ½ + 6·2^-16·S of a byte of the exact colour of the
/// interpolated lights. S is their greatest sum in a channel, or 1. Highlights smaller than triangles are lost, or
/// flicker as their vertices turn; [`Material`] lights each fragment.
///
/// # Cost
/// The layers', six components to interpolate, and four operations a channel; no root and no division.
#[derive(Clone, Copy, Debug)]
pub struct Gouraud<M> {
    /// The [`Layer`] that it is made of, or a tuple of layers.
    pub layers: M,
}

impl<M: Layer<Vec2>> Gouraud<M> {
    /// The surface at fragments after all layers.
    #[inline(always)]
    pub fn surface<L: Lanes>(&self, fragments: &Fragments<L, (Vec3, (Vec3, Vec2))>) -> Surface<L> {
        self.surface_in(fragments, false)
    }

    /// The same in linear light or not.
    #[inline(always)]
    fn surface_in<L: Lanes>(
        &self,
        fragments: &Fragments<L, (Vec3, (Vec3, Vec2))>,
        linear: bool,
    ) -> Surface<L> {
        let Fragments { lanes, varying: (_, (_, uv)), gradient, .. } = *fragments;
        let mut surface = Surface::new(lanes, uv, gradient.map(|(_, (_, uv))| uv), linear);
        self.layers.apply(lanes, &uv, &mut surface);
        surface
    }
}

impl<M: Layer<Vec2>> FragmentStage<(Vec3, (Vec3, Vec2))> for Gouraud<M> {
    type Color = Rgba8;
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, (Vec3, (Vec3, Vec2))>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying: (scattered, (mirrored, _)), mask, .. } = *fragments;
        (self.surface(fragments).seen(lanes, scattered, mirrored), mask)
    }
}
