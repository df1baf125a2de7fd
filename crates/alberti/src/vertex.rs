//! Transformed vertices, and the store in which each is transformed once.

use crate::geometry::{Geometry, IntegerVertex};
use crate::integers::{IntegerScreen, Place};
use crate::screen::Screen;
use alberti_math::lanes::{Floating, One};
use alberti_math::{Fixed, Q16, Varying, is_finite, map2, map3};
use alberti_projection::Projection;
use alberti_raster::Corner;
use core::slice::from_mut;

/// Room for a transformed vertex. In a slice with a slot for each vertex of the mesh, each is transformed once, several
/// at a time. A shorter slice is a cache, in which vertex i shares the slot i modulo the greatest power of two in the
/// length.
#[derive(Clone, Copy, Debug)]
pub struct Slot<V: Varying> {
    /// The vertex's index plus one, or 0.
    tag: u32,
    /// Bits of [`outside`].
    pub(crate) outside: u32,
    /// On the screen; where `outside` has NEAR, FAR, GUARD or NOWHERE only the components have a meaning.
    pub(crate) screen: Corner<V>,
}

/// An index plus one; 0 for indices that a mesh cannot have.
#[inline(always)]
fn tag(index: usize) -> u32 {
    u32::try_from(index).map_or(0, |index| index.wrapping_add(1))
}

impl<V: Varying> Slot<V> {
    /// A slot without a vertex.
    pub const EMPTY: Self = Self { tag: 0, outside: 0, screen: Corner::NONE };

    /// The slot of a vertex that the mesh has not.
    const MISSING: Self = Self { outside: outside::NOWHERE, ..Self::EMPTY };

    /// Whether no vertex is in this slot.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.tag == 0
    }

    /// Takes the vertex out of this slot.
    #[inline(always)]
    pub(crate) fn forget(&mut self) {
        (self.tag, self.outside) = (0, outside::NOWHERE);
    }

    /// The bits of an index that say the place of a vertex in a cache of so many slots, at least one.
    #[inline]
    pub(crate) fn mask(slots: usize) -> usize {
        (1 << slots.max(1).ilog2()) - 1
    }

    /// Whether the vertex `index` is in this slot.
    #[inline(always)]
    pub(crate) fn holds(&self, index: usize) -> bool {
        self.tag != 0 && self.tag == tag(index)
    }

    /// Makes sure that the vertex `index` is in this slot, if there is such a vertex.
    #[inline(always)]
    pub(crate) fn keep<M, Pr>(&mut self, mesh: &M, screen: &Screen<Pr>, index: usize)
    where
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        if !self.holds(index) {
            Self::fill_one_by_one(mesh, screen, index, from_mut(self));
        }
    }

    /// Fills slots with the vertices from number `first` on. Not inlined, as one copy of this is enough.
    #[inline(never)]
    fn fill_one_by_one<M, Pr>(mesh: &M, screen: &Screen<Pr>, first: usize, slots: &mut [Self])
    where
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        slots.iter_mut().zip(first..).for_each(|(slot, index)| slot.fill_alone(mesh, screen, index));
    }

    /// Puts the vertex `index` into this slot.
    #[inline(always)]
    pub(crate) fn fill_alone<M, Pr>(&mut self, mesh: &M, screen: &Screen<Pr>, index: usize)
    where
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        if const { M::INTEGERS }
            && let Some(way) = &screen.integers
        {
            self.fill_integers(mesh, &screen.projection, way, index);
            return;
        }
        let Some((point, varying)) = mesh.vertex(index) else {
            *self = Self::MISSING;
            return;
        };
        let ([[outside], [x], [y]], [[zs], [q]]) = screen.place(One, &map3(point.coords.to_array(), |c| [c]));
        let outside = outside | if is_finite(varying) { 0 } else { outside::NOWHERE };
        let place = map2([x, y], Fixed::from_bits);
        let components = Corner::<V>::components(screen.numbers, varying);
        let screen = Corner::at(place, screen.numbers, [zs, q], components);
        *self = Self { tag: tag(index), outside, screen };
    }

    /// The same for a mesh of integers. Not inlined: a loop has no registers left for its constants.
    #[inline(never)]
    fn fill_integers<M, Pr>(&mut self, mesh: &M, projection: &Pr, way: &IntegerScreen, index: usize)
    where
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        if let Some(IntegerVertex { place, components }) = mesh.integers(index)
            && let Some(place) = way.place(projection, place)
        {
            self.put(index, &place, &components);
            return;
        }
        self.fill_beyond(mesh, projection, way, index);
    }

    /// The same for a vertex out of the view.
    #[cold]
    #[inline(never)]
    fn fill_beyond<M, Pr>(&mut self, mesh: &M, projection: &Pr, way: &IntegerScreen, index: usize)
    where
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        match mesh.integers(index) {
            Some(IntegerVertex { place, components }) => {
                self.put(index, &way.beyond(projection, place), &components);
            }
            None => *self = Self::MISSING,
        }
    }

    #[inline(always)]
    fn put(&mut self, index: usize, &Place { outside, place, depths }: &Place, components: &V::Of<Q16>) {
        *self = Self { tag: tag(index), outside, screen: Corner::of_integers(place, depths, components) };
    }

    /// Fills slots with the vertices from number `first` on.
    #[inline]
    pub(crate) fn fill_all<L, M, Pr>(
        lanes: L,
        mesh: &M,
        screen: &Screen<Pr>,
        first: usize,
        slots: &mut [Self],
    ) where
        L: Floating,
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        if const { L::COUNT == 1 } || const { M::INTEGERS } && screen.integers.is_some() {
            Self::fill_one_by_one(mesh, screen, first, slots);
        } else {
            Self::fill_side_by_side(lanes, mesh, screen, first, slots);
        }
    }

    /// The same, several at a time. Not inlined: frames of all formats and stages share it with what is prepared.
    #[inline(never)]
    fn fill_side_by_side<L, M, Pr>(lanes: L, mesh: &M, screen: &Screen<Pr>, first: usize, slots: &mut [Self])
    where
        L: Floating,
        M: Geometry<Varying = V>,
        Pr: Projection,
    {
        for (slots, first) in slots.chunks_mut(L::COUNT).zip((first..).step_by(L::COUNT)) {
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
            *slot = Self::MISSING;
            if let Some((point, varying)) = mesh.vertex(index) {
                [*x, *y, *z] = point.coords.to_array();
                let outside = if is_finite(varying) { 0 } else { outside::NOWHERE };
                let components = Corner::<V>::components(screen.numbers, varying);
                let screen = Corner::at([Fixed::ZERO; 2], screen.numbers, [0.0; 2], components);
                *slot = Self { tag: tag(index), outside, screen };
            }
        }
        let ([outside, x, y], [zs, q]) = screen.place(lanes, &points);
        let places = x.as_ref().iter().zip(y.as_ref()).zip(zs.as_ref().iter().zip(q.as_ref()));
        for (slot, (outside, ((&x, &y), (zs, q)))) in
            slots.iter_mut().zip(outside.as_ref().iter().zip(places))
        {
            slot.outside |= outside;
            let place = map2([x, y], Fixed::from_bits);
            slot.screen = slot.screen.moved(place, screen.numbers, [*zs, *q]);
        }
    }
}

/// The places of a vertex with respect to the view volume: a set of bits.
pub(crate) mod outside {
    /// Nearer than the near plane.
    pub(crate) const NEAR: u32 = 1;
    /// Farther than the far plane.
    pub(crate) const FAR: u32 = 2;
    /// Beyond one of the sides of the view.
    pub(crate) const SIDES: u32 = 4 + 8 + 16 + 32;
    pub(crate) const LEFT: u32 = 4;
    pub(crate) const RIGHT: u32 = 8;
    pub(crate) const BELOW: u32 = 16;
    pub(crate) const ABOVE: u32 = 32;
    /// Beyond the guard band: sides must be clipped.
    pub(crate) const GUARD: u32 = 64;
    /// Not finite, or so large that arithmetic might overflow.
    pub(crate) const NOWHERE: u32 = 128;
}
