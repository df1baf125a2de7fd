//! Edges that two triangles share, which leave nothing: most of a mesh's are gone before anything is divided.

use super::edge::Edge;
use super::{Silhouette, misses, seen};
use crate::draw::Paint;
use crate::interpolation::Interpolation;
use crate::triangle::{Corner, Corners, Cull};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Varying, map3};

/// The edges of triangles on their way to a silhouette: those of [`Paint::edges`].
///
/// An edge waits, if the silhouette has words for that, until another comes to its place. If that is the same edge of
/// the triangle beside it, both are gone; the silhouette would be the same with them, to the bit.
/// [`finish`](Self::finish) ends the waiting.
///
/// # Cost
/// An edge that finds its other: some 60 instructions instead of [`Silhouette`]'s. Of a mesh whose triangles come in
/// rows two thirds do with 16 places; nearly all with as many places as two rows have edges.
#[derive(Debug)]
#[must_use = "edges that still wait are not in the silhouette: `finish` adds them"]
pub struct Edges<'s, 'c> {
    silhouette: &'s mut Silhouette<'c>,
    cull: Cull,
    bits: u32,
    /// Whether corners have fixed-point numbers.
    fixed: bool,
}

/// A place to wait at: the two ends of an edge, and how often it counts. That is not at all if the place is free.
pub(super) type Place = [i32; Silhouette::PLACE];

impl<F, P: Interpolation> Paint<F, P> {
    /// A way for many triangles to add their edges to a silhouette.
    pub fn edges<'s, 'c>(&self, silhouette: &'s mut Silhouette<'c>) -> Edges<'s, 'c> {
        let fixed = const { <P::Lanes<One> as Lanes>::FIXED };
        Edges { silhouette, cull: self.cull, bits: self.subpixel.bits(), fixed }
    }

    /// Adds the edges of one triangle to a silhouette, if it faces the right way.
    ///
    /// # Precision
    /// See [`Silhouette`].
    pub fn cover<V: Varying>(&self, silhouette: &mut Silhouette<'_>, corners: [&Corner<V>; 3]) {
        let mut edges = self.edges(silhouette);
        edges.triangle(corners);
        edges.finish();
    }
}

impl Edges<'_, '_> {
    /// Adds the edges of a triangle, if it faces the right way.
    pub fn triangle<V: Varying>(&mut self, corners: [&Corner<V>; 3]) {
        self.add(&map3(corners, |corner| corner.place(self.fixed)));
    }

    /// Adds the edges that still wait.
    pub fn finish(self) {
        let Self { silhouette: Silhouette { cells, limits, waiting, .. }, bits, .. } = self;
        for place in &mut **waiting {
            let (edge, times) = Edge::waiting(*place);
            cells.add_edge(edge, times, bits, limits);
            *place = [0; Silhouette::PLACE];
        }
    }

    /// Adds the edges of a triangle, given in subpixels.
    #[inline(never)]
    fn add(&mut self, corners: &Corners) {
        let Self { silhouette: Silhouette { cells, limits, waiting, .. }, cull, bits, .. } = self;
        let Some(area) = seen(corners, *cull, *bits) else { return };
        if misses(corners, *bits, limits) {
            return;
        }
        let [a, b, c] = *corners;
        for ends in [[a, b], [b, c], [c, a]] {
            let (edge, down) = Edge::new(ends);
            if edge.is_level() {
                continue;
            }
            // Clockwise triangles have their right edges downwards.
            let times = if down == (area > 0) { -1 } else { 1 };
            let places = waiting.len() as u64;
            let Some(place) = waiting.get_mut(((u64::from(edge.hash()) * places) >> 32) as usize) else {
                cells.add_edge(edge, times, *bits, limits);
                continue;
            };
            let (there, before) = Edge::waiting(*place);
            if before != 0 && !there.is(edge) {
                cells.add_edge(there, before, *bits, limits);
                *place = edge.wait(times);
            } else {
                *place = edge.wait(before.wrapping_add(times));
            }
        }
    }
}
