//! Transformed vertices, and the store in which each is transformed once.

use crate::geometry::Geometry;
use crate::walk::Screen;
use alberti_math::lanes::{Floating, One};
use alberti_math::{Fixed, Varying, is_finite};
use alberti_projection::Projection;
use alberti_raster::Vertex;
use core::num::NonZeroU32;
use core::slice::from_mut;

/// Room for a transformed vertex. In a slice with a slot for each vertex of the mesh, each is transformed once, several
/// at a time. A shorter slice is a cache, in which vertex i shares the slot i modulo the length.
#[derive(Clone, Copy, Debug)]
pub struct Slot<V>(Option<Transformed<V>>);

/// A vertex after the steps that concern it alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transformed<V> {
    /// The vertex's index plus one.
    tag: NonZeroU32,
    /// Bits of [`outside`].
    pub(crate) outside: u8,
    /// On the screen; where `outside` has NEAR, FAR, GUARD or NOWHERE only the varying has a meaning.
    pub(crate) screen: Vertex<V>,
}

/// An index plus one; none for indices that a mesh cannot have.
#[inline(always)]
fn tag(index: usize) -> Option<NonZeroU32> {
    NonZeroU32::new(u32::try_from(index).ok()?.wrapping_add(1))
}

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

    /// The vertex `index`, if it is in this slot.
    #[inline(always)]
    pub(crate) fn kept(&self, index: usize) -> Option<&Transformed<V>> {
        self.0.as_ref().filter(|vertex| Some(vertex.tag) == tag(index))
    }

    /// Makes sure that the vertex `index` is in this slot, if there is such a vertex.
    #[inline(always)]
    pub(crate) fn keep<M, Pr>(&mut self, mesh: &M, screen: &Screen<Pr>, index: usize)
    where
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        if self.kept(index).is_none() {
            self.fill_alone(mesh, screen, index);
        }
    }

    /// Puts the vertex `index` into this slot.
    #[inline]
    fn fill_alone<M, Pr>(&mut self, mesh: &M, screen: &Screen<Pr>, index: usize)
    where
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        Self::fill(One, mesh, screen, index, from_mut(self));
    }

    /// Fills the slots with so many vertices from number 0 on, and empties those that are left.
    #[inline]
    pub(crate) fn fill_all<L, M, Pr>(
        lanes: L,
        mesh: &M,
        screen: &Screen<Pr>,
        vertices: usize,
        slots: &mut [Self],
    ) where
        L: Floating,
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        let (slots, unused) = slots.split_at_mut_checked(vertices).unwrap_or_default();
        unused.fill(Self::EMPTY);
        if const { L::COUNT == 1 } {
            slots.iter_mut().zip(0..).for_each(|(slot, index)| slot.fill_alone(mesh, screen, index));
            return;
        }
        for (slots, first) in slots.chunks_mut(L::COUNT).zip((0..).step_by(L::COUNT)) {
            Self::fill(lanes, mesh, screen, first, slots);
        }
    }

    /// Fills slots, at most as many as lanes, with the vertices from number `first` on: steps 1, 2, 4 and 6.
    ///
    /// The guard band is the bound that the clip uses too: a vertex is clipped in all of its triangles or in none.
    #[inline(always)]
    fn fill<L, M, Pr>(lanes: L, mesh: &M, screen: &Screen<Pr>, first: usize, slots: &mut [Self])
    where
        L: Floating,
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        let mut points = [lanes.each(|_| 0.0); 3];
        let [xs, ys, zs] = &mut points;
        let components = xs.as_mut().iter_mut().zip(ys.as_mut()).zip(zs.as_mut());
        for ((slot, index), ((x, y), z)) in slots.iter_mut().zip(first..).zip(components) {
            let vertex = mesh.vertex(index);
            slot.0 = vertex.and_then(|(point, varying)| {
                [*x, *y, *z] = point.coords.to_array();
                let outside = if is_finite(varying) { 0 } else { outside::NOWHERE };
                let screen = Vertex { x: Fixed::ZERO, y: Fixed::ZERO, zs: 0.0, q: 0.0, varying };
                Some(Transformed { tag: tag(index)?, outside, screen })
            });
        }
        let ([outside, x, y], [zs, q]) = screen.place(lanes, &points);
        let screen = x.as_ref().iter().zip(y.as_ref()).zip(zs.as_ref().iter().zip(q.as_ref()));
        for (slot, (outside, ((x, y), (zs, q)))) in slots.iter_mut().zip(outside.as_ref().iter().zip(screen))
        {
            let Some(vertex) = &mut slot.0 else { continue };
            let [place, ..] = outside.to_le_bytes();
            vertex.outside |= place;
            let [x, y] = [x, y].map(|subpixels| Fixed::from_subpixels(subpixels.cast_signed()));
            if let (Some(x), Some(y), true) = (x, y, vertex.outside & outside::UNPLACED == 0) {
                vertex.screen = Vertex { x, y, zs: *zs, q: *q, varying: vertex.screen.varying };
            }
        }
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
    /// Without a place on the screen.
    pub(crate) const UNPLACED: u8 = NEAR + FAR + GUARD + NOWHERE;
}
