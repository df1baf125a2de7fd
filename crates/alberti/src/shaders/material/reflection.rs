//! Reflections of a surface's surroundings.

use super::layers::red;
use super::map::Map;
use super::surface::{Layer, OnSurface, Surface};
use super::vector::{plus, times};
use alberti_math::lanes::Lanes;
use alberti_raster::Gradient;
use alberti_texture::environment::{Environment, reflect_lanes};

/// A reflection map: an image of the surroundings, which are far away, mirrored by the surface. It comes after the
/// layers that bend the normal, and after [`Color`](super::Color) and [`Wetness`](super::Wetness): light that is
/// mirrored is not scattered, so that the diffuse colour loses the share.
///
/// The mirrored share is, by Schlick, strength (f + (1 − f) (1 − n·v)^5), with the normal n and the direction v to the
/// viewer. f is the share that the surface mirrors when looked at from above: 1 for a mirror, 0.04 for glass or
/// lacquer, 0.02 for water.
///
/// Source: Blinn and Newell, "Texture and reflection in computer generated images", CACM 19 (1976); Schlick, "An
/// inexpensive BRDF model for physically-based rendering", Eurographics 1994.
///
/// # Cost
/// The direction's place in the image, as its [`Environment`] says, two maps, and some 25 operations. The derivatives
/// of the mirrored direction are not known, so of mip maps level 0 is read.
#[derive(Clone, Copy, Debug)]
pub struct Reflection<E, I, M> {
    /// The map from directions to places in the image, see [`alberti_texture::environment`].
    pub environment: E,
    /// The image, a [`Map`].
    pub image: I,
    /// A [`Map`] of the strength, in the red channel.
    pub strength: M,
    /// f, from 0 to 1.
    pub facing: f32,
}

impl<V: OnSurface, E: Environment, I: Map, M: Map> Layer<V> for Reflection<E, I, M> {
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn apply<L: Lanes>(&self, lanes: L, _: &V::Of<L::Number>, surface: &mut Surface<L>) {
        let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
        let ([nx, ny, nz], [vx, vy, vz]) = (surface.normal, surface.to_viewer);
        let direction = reflect_lanes(lanes, surface.normal, surface.to_viewer);
        let uv = self.environment.place(lanes, direction);
        let steady = Gradient { dx: [zero; 2], dy: [zero; 2] };
        let mirrored = surface.colors(lanes, self.image.read(lanes, uv, &steady));
        let strength = red(lanes, self.strength.read(lanes, surface.uv, &surface.gradient));

        let cosine = lanes.min(lanes.max(nx * vx + ny * vy + nz * vz, zero), one);
        let aside = one - cosine;
        let square = aside * aside;
        let facing = lanes.splat(self.facing);
        let share = strength * (facing + (one - facing) * (square * square * aside));
        surface.emission = plus(lanes, surface.emission, times(lanes, mirrored, share));
        surface.diffuse = times(lanes, surface.diffuse, one - share);
    }
}
