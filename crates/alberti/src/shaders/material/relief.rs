//! Detail of the surface's shape: where to look on it, and which way it faces.

use super::map::Map;
use super::surface::{Axes, Layer, OnSurface, Surface};
use super::vector::splat;
use alberti_math::lanes::Lanes;
use alberti_math::{Frame, Object, World};
use alberti_raster::NoDerivatives;
use alberti_texture::surface::{
    self, HeightMap, NormalEncoding, Relief, Slopes, bump_lanes, normal_lanes, normal_of_two_lanes,
    strengthened_lanes, to_parent_lanes,
};
use core::fmt::Debug;
use core::marker::PhantomData;

/// A normal map in the tangent frame.
///
/// Its texels are read as colours, so a filter's means are those of stored bytes; the result is made unit again. Build
/// its mip map in a format of [`Normals`](alberti_texture::format::Normals).
///
/// # Cost
/// The map, two square roots, six divisions and nine multiplications; with a strength of `f32` a root and three
/// divisions more.
#[derive(Clone, Copy, Debug)]
pub struct NormalMap<M, E = surface::Unorm, S = ()> {
    map: M,
    strength: S,
    encoding: PhantomData<E>,
}

/// A map of which only x and y are stored, in red and green: see
/// [`normal_of_two`](alberti_texture::surface::normal_of_two).
#[derive(Clone, Copy, Debug)]
pub struct TwoChannels<M, E = surface::Unorm, S = ()> {
    map: M,
    strength: S,
    encoding: PhantomData<E>,
}

/// How steep the slopes of a map are: `()` as they are, or an `f32` times as steep, as
/// [`strengthened`](alberti_texture::surface::strengthened) says.
pub trait Strength: Copy + Debug {
    /// The normals of that.
    fn bend<L: Lanes>(&self, lanes: L, normal: [L::Number; 3]) -> [L::Number; 3];
}

impl Strength for () {
    #[inline(always)]
    fn bend<L: Lanes>(&self, _: L, normal: [L::Number; 3]) -> [L::Number; 3] {
        normal
    }
}

impl Strength for f32 {
    #[inline(always)]
    fn bend<L: Lanes>(&self, lanes: L, normal: [L::Number; 3]) -> [L::Number; 3] {
        strengthened_lanes(lanes, normal, *self)
    }
}

/// A normal map in object space: it fits one object, and needs no tangent frame.
#[derive(Clone, Copy, Debug)]
pub struct ObjectNormals<M, E = surface::Unorm> {
    map: M,
    to_world: Frame<Object, World>,
    encoding: PhantomData<E>,
}

/// A bump map: the normal that heights would have, whose map has [`Slopes`].
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
    /// The heights, with what they are in world units.
    pub Relief<H>,
);

/// A parallax map: what the heights would show of the surface, seen from aside. It comes before all that reads maps.
/// Where each policy breaks, at grazing angles and on steep heights, [`surface::Parallax`] says.
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
    /// The heights, with what they are in world units.
    pub relief: Relief<H>,
    /// How the place that is seen is found.
    pub policy: P,
}

/// Maps of the tangent frame, which differ in what their texels are.
macro_rules! of_strength {
    ($($name:ident: $decode:ident;)+) => {$(
        impl<M, E: NormalEncoding, S: Strength> $name<M, E, S> {
            /// A map with this [`Strength`].
            #[must_use]
            pub const fn new(map: M, strength: S) -> Self {
                Self { map, strength, encoding: PhantomData }
            }
        }

        impl<V: Axes, M: Map, E: NormalEncoding, S: Strength> Layer<V> for $name<M, E, S> {
            type Derivatives = M::Derivatives;

            #[inline(always)]
            fn apply<L: Lanes>(&self, lanes: L, varyings: &V::Of<L::Number>, surface: &mut Surface<L>) {
                let texels = self.map.read(lanes, surface.uv, &surface.gradient);
                let normal = self.strength.bend(lanes, $decode::<E, L>(lanes, texels));
                surface.normal = to_parent_lanes(lanes, V::axes(varyings), normal);
            }
        }
    )+};
}
of_strength! {
    NormalMap: normal_lanes;
    TwoChannels: normal_of_two_lanes;
}

impl<M, E: NormalEncoding> ObjectNormals<M, E> {
    /// A map for an object that stands so in the world, with its frame's axes at right angles. Normals are made unit,
    /// so of a stretched object each axis is to be divided by the square of its length: the axes of the inverse
    /// transpose.
    #[must_use]
    pub const fn new(map: M, to_world: Frame<Object, World>) -> Self {
        Self { map, to_world, encoding: PhantomData }
    }
}

impl<V: OnSurface, M: Map, E: NormalEncoding> Layer<V> for ObjectNormals<M, E> {
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn apply<L: Lanes>(&self, lanes: L, _: &V::Of<L::Number>, surface: &mut Surface<L>) {
        let texels = self.map.read(lanes, surface.uv, &surface.gradient);
        let axes = self.to_world.axes();
        let axes = [splat(lanes, axes.x_axis), splat(lanes, axes.y_axis), splat(lanes, axes.z_axis)];
        surface.normal = to_parent_lanes(lanes, axes, normal_lanes::<E, L>(lanes, texels));
    }
}

impl<V: Axes, H: Slopes + Copy + Debug> Layer<V> for Bump<H> {
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn apply<L: Lanes>(&self, lanes: L, varyings: &V::Of<L::Number>, surface: &mut Surface<L>) {
        let Relief { map, low, high, extent } = &self.0;
        let [along_u, along_v] = map.slopes(lanes, surface.uv);
        let range = high - low;
        let slope = [along_u * lanes.splat(range / extent.x), along_v * lanes.splat(range / extent.y)];
        surface.normal = bump_lanes(lanes, V::axes(varyings), slope);
    }
}

impl<V, H, P> Layer<V> for Parallax<H, P>
where
    V: Axes,
    H: HeightMap + Copy + Debug,
    P: surface::Parallax,
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
