//! Detail of the surface's shape: where to look on it, and which way it faces.

use super::map::Map;
use super::surface::{Axes, Layer, OnSurface, Surface};
use super::together::{OfTexels, of_maps};
use super::vector::splat;
use alberti_math::lanes::Lanes;
use alberti_math::{Frame, Object, World};
use alberti_raster::NoDerivatives;
use alberti_texture::surface::{
    HeightMap, NormalEncoding, ParallaxSearch, Relief, bump_lanes, normal_lanes, normal_of_two_lanes,
    strengthened_lanes, to_parent_lanes,
};
use core::fmt::Debug;

/// A normal map in the tangent frame.
///
/// Its texels are read as colours, so a filter's means are those of stored bytes; the result is made unit again. Build
/// its mip map in a format of [`Normals`](alberti_texture::format::Normals).
///
/// # Cost
/// The map, two square roots, six divisions and nine multiplications; with a strength other than 1 a root and three
/// divisions more. Beside a colour map of the same size the map itself is cheaper in [`Together`](super::Together).
#[derive(Clone, Copy, Debug)]
pub struct NormalMap<M> {
    /// A [`Map`].
    pub map: M,
    /// The numbers that bytes stand for.
    pub encoding: NormalEncoding,
    /// The steepness of slopes: 1 as they are, or so many times as steep, as
    /// [`strengthened`](alberti_texture::surface::strengthened) says.
    pub strength: f32,
}

/// A map of which only x and y are stored, in red and green: see
/// [`normal_of_two`](alberti_texture::surface::normal_of_two).
#[derive(Clone, Copy, Debug)]
pub struct TwoChannels<M> {
    /// A [`Map`].
    pub map: M,
    /// The numbers that bytes stand for.
    pub encoding: NormalEncoding,
    /// The steepness of slopes: 1 as they are, or so many times as steep, as
    /// [`strengthened`](alberti_texture::surface::strengthened) says.
    pub strength: f32,
}

/// A normal map in object space: it fits one object, and needs no tangent frame.
#[derive(Clone, Copy, Debug)]
pub struct ObjectNormals<M> {
    /// A [`Map`].
    pub map: M,
    /// The numbers that bytes stand for.
    pub encoding: NormalEncoding,
    /// The object's frame in the world, with axes at right angles. Normals are made unit, so of a stretched object each
    /// axis is to be divided by the square of its length: the axes of the inverse transpose.
    pub to_world: Frame<Object, World>,
}

/// A bump map: the normal that heights would have, by the slopes of their map ([`HeightMap::slopes_lanes`]).
///
/// The normal is that of the heights on a plane. On a curved surface it misses the share h/R of the slope, for heights
/// h and the radius of curvature R.
///
/// # Precision
/// That of the slopes, times |high − low|/extent, as an angle, and 8ε radians (ε = 2^-24), for frames at right angles.
///
/// # Cost
/// The slopes, a square root, three divisions and eleven multiplications.
#[derive(Clone, Copy, Debug)]
pub struct Bump<H>(
    /// The heights, with their range and extent in world units.
    pub Relief<H>,
);

/// A parallax map: the place on the surface that the heights would show, seen from aside. It comes before all that
/// reads maps. Where each policy breaks, at grazing angles and on steep heights, [`ParallaxSearch`] says.
///
/// The level of detail of these stays that of the surface itself, and so does the place for lights.
///
/// # Precision
/// [`Relief::parallax`] says how far the place is from the one that is seen, for frames at right angles.
///
/// # Cost
/// The heights that the policy reads, nine multiplications and some divisions.
#[derive(Clone, Copy, Debug)]
pub struct Parallax<H, P> {
    /// The heights, with their range and extent in world units.
    pub relief: Relief<H>,
    /// The search for the place that is seen.
    pub policy: P,
}

/// The normals that texels stand for, in the tangent frame.
macro_rules! of_strength {
    ($($name:ident: $decode:ident;)+) => {$(
        impl<V: Axes, M: Copy + Debug> OfTexels<V> for $name<M> {
            #[inline(always)]
            fn change<L: Lanes>(
                &self,
                lanes: L,
                varyings: &V::Of<L::Number>,
                texels: L::U32,
                surface: &mut Surface<L>,
            ) {
                let mut normal = $decode(self.encoding, lanes, texels);
                if self.strength.to_bits() != 1.0_f32.to_bits() {
                    normal = strengthened_lanes(lanes, normal, self.strength);
                }
                surface.normal = to_parent_lanes(lanes, V::axes(varyings), normal);
            }
        }
    )+};
}
of_strength! {
    NormalMap: normal_lanes;
    TwoChannels: normal_of_two_lanes;
}

impl<V: OnSurface, M: Copy + Debug> OfTexels<V> for ObjectNormals<M> {
    #[inline(always)]
    fn change<L: Lanes>(&self, lanes: L, _: &V::Of<L::Number>, texels: L::U32, surface: &mut Surface<L>) {
        let axes = self.to_world.axes();
        let axes = [splat(lanes, axes.x_axis), splat(lanes, axes.y_axis), splat(lanes, axes.z_axis)];
        surface.normal = to_parent_lanes(lanes, axes, normal_lanes(self.encoding, lanes, texels));
    }
}

of_maps! {
    NormalMap map of Axes;
    TwoChannels map of Axes;
    ObjectNormals map of OnSurface;
}

impl<V: Axes, H: HeightMap + Copy + Debug> Layer<V> for Bump<H> {
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn apply<L: Lanes>(&self, lanes: L, varyings: &V::Of<L::Number>, surface: &mut Surface<L>) {
        let Relief { map, low, high, extent } = &self.0;
        let [along_u, along_v] = map.slopes_lanes(lanes, surface.uv);
        let range = high - low;
        let slope = [along_u * lanes.splat(range / extent.x), along_v * lanes.splat(range / extent.y)];
        surface.normal = bump_lanes(lanes, V::axes(varyings), slope);
    }
}

impl<V, H, P> Layer<V> for Parallax<H, P>
where
    V: Axes,
    H: HeightMap + Copy + Debug,
    P: ParallaxSearch,
{
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn apply<L: Lanes>(&self, lanes: L, varyings: &V::Of<L::Number>, surface: &mut Surface<L>) {
        let [x, y, z] = surface.to_viewer;
        let along = |[a, b, c]: [L::Number; 3]| x * a + y * b + z * c;
        let [u, v, n] = V::axes(varyings);
        let view = [along(u), along(v), along(n)];
        surface.uv = self.relief.parallax_lanes(self.policy, lanes, surface.uv, view);
    }
}
