//! The geometry half of the pipeline: from a mesh to its triangles on the screen, steps 1 to 6.

mod clip;

use crate::geometry::Geometry;
use crate::meshlets::Seen;
use crate::screen::{Screen, Sides};
use crate::vertex::{Slot, outside};
use alberti_math::lanes::Floating;
use alberti_math::{Varying, map3};
use alberti_projection::Projection;
use alberti_raster::{Batch, ColorFormat, Corner, Counters, Cull, DepthFormat, FragmentStage, Interpolation};
use clip::clip;
use core::ops::Range;

/// The way of a mesh's triangles to the screen.
pub(crate) struct Walk<'a, M: Geometry, Pr: Projection> {
    mesh: &'a M,
    /// All vertices, or none.
    stored: &'a [Slot<M::Varying>],
    /// A cache for those that are not, in which the bits of an index that are in `mask` say the place.
    cache: &'a mut [Slot<M::Varying>],
    mask: usize,
    /// Whether the cache has a slot for each vertex, filled before the triangles of a part come to it.
    own: bool,
    screen: Screen<Pr>,
}

/// The number of a mesh's vertices that are stored in so many slots: all, where the slots hold them and all may be
/// used, or none.
#[inline]
pub(crate) fn stored_by(mesh: &impl Geometry, slots: usize) -> usize {
    let vertices = mesh.vertices();
    if vertices <= slots && vertices / 3 <= mesh.triangles() { vertices } else { 0 }
}

/// A taker of triangles on the screen.
pub(crate) trait Sink<'a, V: Varying, K> {
    /// Takes a triangle whose corners stay as long as the walk's slots.
    fn triangle(&mut self, corners: [&'a Corner<V>; 3], counters: &mut K);
    /// The same for one that is known to face the right way.
    fn facing(&mut self, corners: [&'a Corner<V>; 3], counters: &mut K);
    /// Takes a triangle whose corners do not stay.
    fn passing(&mut self, corners: [&Corner<V>; 3], counters: &mut K);
    /// The same on ways that are seldom taken, for which one copy of what follows is enough.
    fn seldom(&mut self, corners: [&Corner<V>; 3], counters: &mut K);
}

impl<'a, L, V, F, P, C, D, K> Sink<'a, V, K> for Batch<'_, '_, 'a, L, V, F, P, C, D>
where
    L: Floating,
    V: Varying,
    F: FragmentStage<V>,
    P: Interpolation,
    C: ColorFormat,
    D: DepthFormat,
    K: Counters,
{
    #[inline(always)]
    fn triangle(&mut self, corners: [&'a Corner<V>; 3], counters: &mut K) {
        self.triangle(corners, counters);
    }

    #[inline(always)]
    fn facing(&mut self, corners: [&'a Corner<V>; 3], counters: &mut K) {
        self.facing(corners, counters);
    }

    #[inline(always)]
    fn passing(&mut self, corners: [&Corner<V>; 3], counters: &mut K) {
        self.passing(corners, counters);
    }

    #[inline(never)]
    fn seldom(&mut self, corners: [&Corner<V>; 3], counters: &mut K) {
        self.passing(corners, counters);
    }
}

/// A taker of triangles whose corners do not stay.
type Passing<'a, V, K> = &'a mut dyn FnMut([&Corner<V>; 3], &mut K);

/// A taker of lines whose ends do not stay.
type PassingLine<'a, V> = &'a mut dyn FnMut([&Corner<V>; 2]);

impl<'a, M: Geometry, Pr: Projection> Walk<'a, M, Pr> {
    /// The walk with these slots, of which there is at least one. All vertices are transformed at once where the slots
    /// hold them, and where all may be used. With one lane and meshlets, which leave out some, each is
    /// transformed where a triangle needs it.
    #[inline]
    pub(crate) fn new<L: Floating>(
        lanes: L,
        mesh: &'a M,
        screen: &Screen<Pr>,
        slots: &'a mut [Slot<M::Varying>],
    ) -> Self {
        let stored = stored_by(mesh, slots.len());
        if const { M::MESHLETS && L::COUNT == 1 } && stored > 0 {
            slots.iter_mut().for_each(Slot::forget);
            return Self { mesh, stored: &[], cache: slots, mask: usize::MAX, own: true, screen: *screen };
        }
        let (store, unused) = slots.split_at_mut_checked(stored).unwrap_or_default();
        unused.fill(Slot::EMPTY);
        Slot::fill_all(lanes, mesh, screen, 0, store);
        Self::with_slots(mesh, screen, store, unused)
    }

    /// The walk over slots in which an earlier one has left so many vertices, each in the slot of its number. The
    /// others are a cache as the earlier one has left it.
    #[inline]
    pub(crate) fn again(
        mesh: &'a M,
        screen: &Screen<Pr>,
        slots: &'a mut [Slot<M::Varying>],
        filled: usize,
    ) -> Self {
        let (stored, cache) = slots.split_at_mut_checked(filled).unwrap_or_default();
        Self::with_slots(mesh, screen, stored, cache)
    }

    /// [`again`](Self::again) for any of the mesh's vertices. Of meshlets that are not seen an earlier walk may have
    /// left out vertices, which are transformed when they are needed.
    pub(crate) fn again_any(
        mesh: &'a M,
        screen: &Screen<Pr>,
        slots: &'a mut [Slot<M::Varying>],
        filled: usize,
    ) -> Self {
        if const { M::MESHLETS } && filled > 0 {
            return Self { mesh, stored: &[], cache: slots, mask: usize::MAX, own: true, screen: *screen };
        }
        Self::again(mesh, screen, slots, filled)
    }

    /// The walk over these slots.
    #[inline]
    fn with_slots(
        mesh: &'a M,
        screen: &Screen<Pr>,
        stored: &'a [Slot<M::Varying>],
        cache: &'a mut [Slot<M::Varying>],
    ) -> Self {
        let mask = Slot::<M::Varying>::mask(cache.len());
        Self { mesh, stored, mask, cache, own: false, screen: *screen }
    }

    /// The walk over a store of all vertices, which others may walk too.
    #[cfg(feature = "threads")]
    pub(crate) fn over(mesh: &'a M, screen: &Screen<Pr>, stored: &'a [Slot<M::Varying>]) -> Self {
        Self::with_slots(mesh, screen, stored, &mut [])
    }

    /// The mesh.
    pub(crate) fn mesh(&self) -> &'a M {
        self.mesh
    }

    /// Those of the mesh's triangles with these numbers of which something may be seen, in parts.
    #[inline(always)]
    pub(crate) fn seen(&self, cull: Cull, numbers: Range<usize>) -> Seen<'a, M> {
        Seen::new(self.mesh, &self.screen, cull, numbers)
    }

    /// Transforms the vertices of these triangles that have slots of their own, but are not there yet.
    #[inline(always)]
    pub(crate) fn ready(&mut self, part: &Range<usize>) {
        if const { M::MESHLETS } && self.own {
            transform(self.mesh, &self.screen, self.cache, part.clone());
        }
    }

    /// The columns and the rows of the viewport.
    pub(crate) fn pixels(&self) -> [Range<i32>; 2] {
        self.screen.viewport.pixels()
    }

    /// The number of vertices that have slots of their own.
    pub(crate) fn filled(&self) -> usize {
        if self.own { self.cache.len() } else { self.stored.len() }
    }

    /// Hands `sink` the visible parts of the triangles with these numbers, on the screen: of each nothing, itself, or
    /// the fan that clipping leaves. It ends before the first number that the mesh has not. Of those that are `LISTED`
    /// the counters have heard, and they face the right way if they are whole.
    #[inline(always)]
    pub(crate) fn triangles<const LISTED: bool, K: Counters>(
        &mut self,
        mut numbers: impl Iterator<Item = usize>,
        counters: &mut K,
        sink: &mut impl Sink<'a, M::Varying, K>,
    ) {
        let mesh = self.mesh;
        loop {
            let slots = self.stored;
            // Most triangles of a mesh that fits are inside.
            let indices = loop {
                let Some(number) = numbers.next() else { return };
                let Some(indices) = mesh.triangle(number) else { return };
                if slots.is_empty() {
                    let Some(corners) = self.cached(indices) else { break indices };
                    if !LISTED {
                        counters.submitted();
                    }
                    if const { M::MESHLETS } {
                        sink.passing(corners, counters);
                    } else {
                        sink.seldom(corners, counters);
                    }
                } else {
                    let Some(corners) = inside(slots, indices) else { break indices };
                    if !LISTED {
                        counters.submitted();
                    }
                    if LISTED {
                        sink.facing(corners, counters);
                    } else {
                        sink.triangle(corners, counters);
                    }
                }
            };
            let mut passing = |corners: [&_; 3], counters: &mut K| sink.seldom(corners, counters);
            let fate = self.seldom(indices, counters, &mut passing);
            if !LISTED {
                fate.count(counters);
            }
        }
    }

    /// [`triangles`](Self::triangles) for those that found no room in a list.
    #[cold]
    #[inline(never)]
    pub(crate) fn rest<K: Counters>(
        &mut self,
        cull: Cull,
        numbers: Range<usize>,
        counters: &mut K,
        sink: &mut impl Sink<'a, M::Varying, K>,
    ) {
        for part in self.seen(cull, numbers) {
            self.triangles::<false, _>(part, counters, sink);
        }
    }

    /// [`triangles`](Self::triangles) for one that may be clipped.
    #[inline]
    pub(crate) fn triangle(
        &mut self,
        indices: [usize; 3],
        mut sink: impl FnMut([&Corner<M::Varying>; 3]),
    ) -> Fate {
        self.seldom(indices, &mut (), &mut |corners, ()| sink(corners))
    }

    /// [`triangles`](Self::triangles) of which the counters hear nothing.
    pub(crate) fn each(
        &mut self,
        numbers: impl Iterator<Item = usize>,
        mut sink: impl FnMut([&Corner<M::Varying>; 3]),
    ) {
        let mesh = self.mesh;
        for indices in numbers.map_while(|number| mesh.triangle(number)) {
            match self.whole(indices) {
                Some(corners) => sink(corners),
                None => {
                    let _fate = self.triangle(indices, &mut sink);
                }
            }
        }
    }

    /// Hands `sink` the visible part of the line between two vertices, if there is one.
    #[inline(always)]
    pub(crate) fn line(
        &mut self,
        indices: [usize; 2],
        mut sink: impl FnMut([&Corner<M::Varying>; 2]),
    ) -> Fate {
        let Self { mesh, stored, cache, mask, screen, .. } = self;
        let [i, j] = indices;
        let ends = if stored.is_empty() {
            for index in indices {
                if let Some(slot) = cache.get_mut(index & *mask) {
                    slot.keep(*mesh, screen, index);
                }
            }
            [cache.get(i & *mask).filter(|slot| slot.holds(i)), cache.get(j & *mask)]
        } else {
            [stored.get(i), stored.get(j)]
        };
        if let [Some(a), Some(b)] = ends
            && a.outside | b.outside == 0
        {
            sink([&a.screen, &b.screen]);
            return Fate::Whole;
        }
        self.seldom_line(indices, &mut sink)
    }

    /// [`line`](Self::line) for one that may be cut, or whose ends may not be in slots.
    #[inline(never)]
    fn seldom_line(&self, indices: [usize; 2], sink: PassingLine<'_, M::Varying>) -> Fate {
        let (slots, mask) =
            if self.stored.is_empty() { (&*self.cache, self.mask) } else { (self.stored, usize::MAX) };
        let kept = |index: usize| slots.get(index & mask).filter(|slot| slot.holds(index));
        let [i, j] = indices;
        let own;
        let [a, b] = if let (Some(a), Some(b)) = (kept(i), kept(j)) {
            [a, b]
        } else {
            // Both share a slot, or there is no such vertex.
            own = alone(self.mesh, &self.screen, indices);
            let [a, b] = &own;
            [a, b]
        };
        let (any, common) = (a.outside | b.outside, a.outside & b.outside);
        let there = a.holds(i) && b.holds(j) && any & outside::NOWHERE == 0;
        if !there || common & (outside::NEAR | outside::FAR | outside::SIDES) != 0 {
            return Fate::Dropped;
        }
        let sides = if self.screen.sides == Sides::Cube { outside::SIDES } else { 0 };
        if any & (outside::NEAR | outside::FAR | outside::GUARD | sides) == 0 {
            sink([&a.screen, &b.screen]);
            return Fate::Whole;
        }
        match clip::clip_line(self.mesh, &self.screen, indices) {
            None => Fate::Dropped,
            Some([a, b]) => {
                sink([&a, &b]);
                Fate::Clipped
            }
        }
    }

    /// The corners of a triangle within all planes.
    #[inline(always)]
    pub(crate) fn whole(&mut self, indices: [usize; 3]) -> Option<[&Corner<M::Varying>; 3]> {
        if self.stored.is_empty() { self.cached(indices) } else { inside(self.stored, indices) }
    }

    /// The corners of a triangle within all planes, from the cache. None too where two share a slot.
    #[inline(always)]
    fn cached(&mut self, indices: [usize; 3]) -> Option<[&Corner<M::Varying>; 3]> {
        if const { M::MESHLETS } && self.own {
            return inside(self.cache, indices);
        }
        let Self { mesh, cache, mask, screen, .. } = self;
        for index in indices {
            cache.get_mut(index & *mask)?.keep(*mesh, screen, index);
        }
        let [a, b, c] = map3(indices, |index| cache.get(index & *mask));
        let (a, b, c) = (a?, b?, c?);
        let all_there = a.holds(indices[0]) && b.holds(indices[1]);
        (all_there && a.outside | b.outside | c.outside == 0).then_some([&a.screen, &b.screen, &c.screen])
    }

    /// [`triangles`](Self::triangles) for one that is to be clipped, or whose vertices may not be in slots.
    #[inline(never)]
    fn seldom<K>(&mut self, indices: [usize; 3], counters: &mut K, sink: Passing<'_, M::Varying, K>) -> Fate {
        let Self { mesh, stored, cache, mask, screen, .. } = self;
        let [i, j, k] = indices;
        let places = if stored.is_empty() { map3(indices, |index| index & *mask) } else { indices };
        let slots = if stored.is_empty() {
            for (place, index) in places.into_iter().zip(indices) {
                if let Some(slot) = cache.get_mut(place) {
                    slot.keep(*mesh, screen, index);
                }
            }
            &**cache
        } else {
            *stored
        };
        let kept = |place: usize, index| slots.get(place).filter(|slot: &&Slot<_>| slot.holds(index));
        let own;
        let [a, b, c] = places;
        let corners = if let (Some(a), Some(b), Some(c)) = (kept(a, i), kept(b, j), kept(c, k)) {
            [a, b, c]
        } else {
            // Two of the three share a slot, or there is no such vertex.
            own = alone(*mesh, screen, indices);
            let [a, b, c] = &own;
            if !(a.holds(i) && b.holds(j) && c.holds(k)) {
                return Fate::Dropped;
            }
            [a, b, c]
        };
        let all = corners[0].outside | corners[1].outside | corners[2].outside;
        let common = corners[0].outside & corners[1].outside & corners[2].outside;
        if all & outside::NOWHERE != 0 || common & (outside::NEAR | outside::FAR | outside::SIDES) != 0 {
            return Fate::Dropped;
        }
        let sides = if screen.sides == Sides::Cube { outside::SIDES } else { 0 };
        if all & (outside::NEAR | outside::FAR | outside::GUARD | sides) == 0 {
            sink([&corners[0].screen, &corners[1].screen, &corners[2].screen], counters);
            return Fate::Whole;
        }
        clip(*mesh, screen, indices, corners, sink, counters);
        Fate::Clipped
    }
}

/// Fills the slots of these triangles' vertices that are empty. They are arguments, so that compilers know them apart:
/// what is read of the screen then stays in registers.
#[inline(never)]
fn transform<M: Geometry, Pr: Projection>(
    mesh: &M,
    screen: &Screen<Pr>,
    slots: &mut [Slot<M::Varying>],
    part: Range<usize>,
) {
    for indices in part.map_while(|number| mesh.triangle(number)) {
        for index in indices {
            if let Some(slot) = slots.get_mut(index)
                && slot.is_empty()
            {
                slot.fill_alone(mesh, screen, index);
            }
        }
    }
}

/// The ways that a submitted triangle may go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    /// Wholly outside, or with a vertex that has no place.
    Dropped,
    /// Without a plane that it crosses.
    Whole,
    /// Cut at planes; the rest of it was handed on.
    Clipped,
}

impl Fate {
    /// Tells the counters.
    #[inline(always)]
    pub(crate) fn count(self, counters: &mut impl Counters) {
        counters.submitted();
        match self {
            Self::Dropped => counters.dropped(),
            Self::Whole => (),
            Self::Clipped => counters.clipped(),
        }
    }
}

/// The corners of a triangle whose vertices have slots of their own, and are within all planes.
#[inline(always)]
fn inside<V: Varying>(slots: &[Slot<V>], [i, j, k]: [usize; 3]) -> Option<[&Corner<V>; 3]> {
    let (Some(a), Some(b), Some(c)) = (slots.get(i), slots.get(j), slots.get(k)) else { return None };
    (a.outside | b.outside | c.outside == 0).then_some([&a.screen, &b.screen, &c.screen])
}

/// A triangle's vertices in slots of their own.
#[cold]
#[inline(never)]
fn alone<M: Geometry, Pr: Projection, const N: usize>(
    mesh: &M,
    screen: &Screen<Pr>,
    indices: [usize; N],
) -> [Slot<M::Varying>; N] {
    indices.map(|index| {
        let mut slot = Slot::EMPTY;
        slot.keep(mesh, screen, index);
        slot
    })
}
