//! Transformed vertices, and the store in which each is transformed once.

use crate::geometry::Geometry;
use crate::walk::Screen;
use alberti_math::{Eye, Fixed, Object, Point3, Subpixel, Varying, is_finite};
use alberti_projection::{EyeVertex, Projection};
use alberti_raster::Vertex;
use core::num::NonZeroUsize;

/// Room for a transformed vertex. In a slice with a slot for each vertex of the mesh, each is transformed once. A
/// shorter slice is a cache, in which vertex i shares the slot i modulo the length.
#[derive(Clone, Copy, Debug)]
pub struct Slot<V>(Option<(Place, Transformed<V>)>);

/// A vertex's index plus one, so that it and the tag are one word.
type Place = NonZeroUsize;

impl<V> Slot<V> {
    /// A slot without a vertex.
    pub const EMPTY: Self = Self(None);
}

impl<V: Varying> Slot<V> {
    /// The place of a vertex among so many slots, at least one.
    #[inline(always)]
    pub(crate) fn place(index: usize, slots: usize) -> usize {
        if index < slots { index } else { index.checked_rem(slots).unwrap_or(0) }
    }

    /// The vertex `index`, which is transformed unless it is here; `None` if there is no such vertex.
    #[inline(always)]
    pub(crate) fn vertex<M: Geometry<Varying = V>, Pr: Projection, S: Subpixel>(
        &mut self,
        mesh: &M,
        screen: &Screen<Pr, S>,
        index: usize,
    ) -> Option<&Transformed<V>> {
        let number = Place::new(index.wrapping_add(1))?;
        if self.0.as_ref().is_none_or(|(kept, _)| *kept != number) {
            let (point, varying) = mesh.vertex(index)?;
            self.0 = Some((number, Transformed::new(screen, point, varying)));
        }
        self.0.as_ref().map(|(_, vertex)| vertex)
    }
}

/// The places of a vertex with respect to the view volume: a set of bits.
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
pub(crate) struct Transformed<V> {
    /// The position in scaled eye space.
    pub(crate) position: Point3<Eye>,
    /// Bits of [`outside`].
    pub(crate) outside: u8,
    /// The vertex on the screen; where `outside` has NEAR, FAR, GUARD or NOWHERE only the varying has a meaning.
    pub(crate) screen: Vertex<V>,
}

/// Coordinates above this may overflow when they are subtracted or multiplied.
const LARGEST: f32 = f32::MAX / 16.0;

impl<V: Varying> Transformed<V> {
    /// Steps 1 and 2, and for a vertex within the planes also 4 and 6.
    ///
    /// The guard band is the bound that the clip uses too: a vertex is clipped in all of its triangles or in none.
    #[inline]
    pub(crate) fn new<Pr: Projection, S: Subpixel>(
        screen: &Screen<Pr, S>,
        point: Point3<Object>,
        varying: V,
    ) -> Self {
        let Screen { to_eye, projection, viewport, depth, guard, subpixel, .. } = screen;
        let position = projection.scale(to_eye.to_parent(point));
        let p = position.coords;
        let nowhere = Vertex { x: Fixed::ZERO, y: Fixed::ZERO, zs: 0.0, q: 0.0, varying };
        // Written so that NaN is not within.
        let within = p.x.abs() <= LARGEST && p.y.abs() <= LARGEST && p.z.abs() <= LARGEST;
        if !within || !is_finite(varying) {
            return Self { position, outside: outside::NOWHERE, screen: nowhere };
        }
        let bit = |condition: bool, bit: u8| if condition { bit } else { 0 };
        let side = projection.side(p.z);
        let sides = bit(p.x < -side, outside::LEFT)
            | bit(p.x > side, outside::RIGHT)
            | bit(p.y < -side, outside::BELOW)
            | bit(p.y > side, outside::ABOVE);
        let planes = bit(p.z < projection.near(), outside::NEAR) | bit(p.z > projection.far(), outside::FAR);
        if planes != 0 {
            return Self { position, outside: sides | planes, screen: nowhere };
        }
        let projected = projection.project(depth, &EyeVertex { position, varying });
        let on_screen = viewport.to_screen(*subpixel, projected.x, projected.y);
        match on_screen.filter(|_| projected.x.abs() <= guard.x && projected.y.abs() <= guard.y) {
            Some([x, y]) => {
                let screen = Vertex { x, y, zs: projected.zs, q: projected.q, varying };
                Self { position, outside: sides, screen }
            }
            None => Self { position, outside: sides | outside::GUARD, screen: nowhere },
        }
    }
}
