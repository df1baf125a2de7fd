//! The vertex stage, and the store in which each vertex is transformed once.

use crate::pipeline::View;
use alberti_math::{Fixed, Object, Point3, Subpixel, Varying, is_finite};
use alberti_projection::{EyeVertex, Projection, SideBounds};
use alberti_raster::Vertex;
use core::num::NonZeroUsize;

/// Maps a mesh vertex to its place in object space and to what it carries.
///
/// Any closure `Fn(&T) -> (Point3<Object>, V)` is one.
pub trait VertexStage<T> {
    /// What the vertex carries to the fragments.
    type Varying: Varying;

    /// The place and the varying of this vertex.
    fn shade(&self, vertex: &T) -> (Point3<Object>, Self::Varying);
}

impl<T, V: Varying, F: Fn(&T) -> (Point3<Object>, V)> VertexStage<T> for F {
    type Varying = V;

    #[inline]
    fn shade(&self, vertex: &T) -> (Point3<Object>, V) {
        self(vertex)
    }
}

/// Where a transformed vertex is kept. A slice with a slot for each vertex of the mesh transforms each vertex once; a
/// shorter one is a cache, in which vertex i shares the slot i modulo the length.
#[derive(Clone, Copy, Debug)]
pub struct Slot<S: Subpixel, V>(Option<(Place, Transformed<S, V>)>);

/// A vertex's index plus one, so that it and the tag are one word.
type Place = NonZeroUsize;

impl<S: Subpixel, V> Slot<S, V> {
    /// A slot without a vertex.
    pub const EMPTY: Self = Self(None);
}

impl<S: Subpixel, V: Varying> Slot<S, V> {
    /// Makes sure that vertex `index` is in its slot, and says which that is.
    #[inline]
    pub(crate) fn fill(
        slots: &mut [Self],
        index: usize,
        transform: impl FnOnce() -> Transformed<S, V>,
    ) -> usize {
        let place = if index < slots.len() { index } else { index.checked_rem(slots.len()).unwrap_or(0) };
        let index = index.checked_add(1).and_then(Place::new);
        match (slots.get_mut(place), index) {
            (Some(Self(Some((kept, _)))), Some(index)) if *kept == index => {}
            (Some(slot), Some(index)) => *slot = Self(Some((index, transform()))),
            _ => {}
        }
        place
    }

    /// Vertex `index`, if it is in the slot `place`.
    #[inline]
    pub(crate) fn at(slots: &[Self], place: usize, index: usize) -> Option<&Transformed<S, V>> {
        match slots.get(place) {
            Some(Self(Some((kept, vertex)))) if kept.get() == index.wrapping_add(1) => Some(vertex),
            _ => None,
        }
    }
}

/// Where a vertex lies with respect to the view volume: a set of bits.
pub(crate) mod outside {
    /// Nearer than the near plane.
    pub(crate) const NEAR: u8 = 1;
    /// Farther than the far plane.
    pub(crate) const FAR: u8 = 2;
    /// Beyond one of the sides of the view.
    pub(crate) const SIDES: u8 = 4 + 8 + 16 + 32;
    pub(crate) const LEFT: u8 = 4;
    pub(crate) const RIGHT: u8 = 8;
    pub(crate) const BELOW: u8 = 16;
    pub(crate) const ABOVE: u8 = 32;
    /// Beyond the guard band: sides must be clipped.
    pub(crate) const GUARD: u8 = 64;
    /// Not finite, or so large that arithmetic might overflow.
    pub(crate) const NOWHERE: u8 = 128;
}

/// A vertex after the steps that concern it alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transformed<S: Subpixel, V> {
    /// Scaled eye space.
    pub(crate) position: Point3<alberti_math::Eye>,
    /// Bits of [`outside`].
    pub(crate) outside: u8,
    /// On the screen; where `outside` has NEAR, FAR, GUARD or NOWHERE only the varying has a meaning.
    pub(crate) screen: Vertex<S, V>,
}

/// Coordinates above this may overflow when they are subtracted or multiplied.
const LARGEST: f32 = f32::MAX / 16.0;

impl<S: Subpixel, V: Varying> Transformed<S, V> {
    /// Steps 1 and 2, and for a vertex within the planes also 4 and 6.
    ///
    /// `guard` is the bound that the clip uses too: a vertex is clipped in all of its triangles or in none.
    #[inline]
    pub(crate) fn new<Pr: Projection>(
        view: &View<Pr>,
        depth: &Pr::Depth,
        guard: SideBounds,
        point: Point3<Object>,
        varying: V,
    ) -> Self {
        let position = view.projection.scale(view.to_eye.to_parent(point));
        let p = position.coords;
        let nowhere = Vertex { x: Fixed::ZERO, y: Fixed::ZERO, zs: 0.0, q: 0.0, varying };
        // Written so that NaN is not within.
        let within = p.x.abs() <= LARGEST && p.y.abs() <= LARGEST && p.z.abs() <= LARGEST;
        if !within || !is_finite(varying) {
            return Self { position, outside: outside::NOWHERE, screen: nowhere };
        }
        let bit = |condition: bool, bit: u8| if condition { bit } else { 0 };
        let side = view.projection.side(p.z);
        let sides = bit(p.x < -side, outside::LEFT)
            | bit(p.x > side, outside::RIGHT)
            | bit(p.y < -side, outside::BELOW)
            | bit(p.y > side, outside::ABOVE);
        let planes =
            bit(p.z < view.projection.near(), outside::NEAR) | bit(p.z > view.projection.far(), outside::FAR);
        if planes != 0 {
            return Self { position, outside: sides | planes, screen: nowhere };
        }
        let projected = view.projection.project(depth, &EyeVertex { position, varying });
        let on_screen = view.viewport.to_screen(projected.x, projected.y);
        match on_screen.filter(|_| projected.x.abs() <= guard.x && projected.y.abs() <= guard.y) {
            Some([x, y]) => {
                let screen = Vertex { x, y, zs: projected.zs, q: projected.q, varying };
                Self { position, outside: sides, screen }
            }
            None => Self { position, outside: sides | outside::GUARD, screen: nowhere },
        }
    }
}
