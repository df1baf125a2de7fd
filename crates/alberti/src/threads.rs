//! Frames drawn by several threads: vertices, lists of triangles, and bands of rows, each in parallel.

use crate::geometry::Geometry;
use crate::pipeline::Pass;
use crate::prepared::{PreparedTriangle, Room, Slices, draw_listed, list, sampled};
use crate::screen::Screen;
use crate::vertex::Slot;
use crate::walk::{Walk, stored_by};
use alberti_math::for_lanes;
use alberti_math::lanes::{Floating, Machine};
use alberti_projection::Projection;
use alberti_raster::{
    ColorFormat, Counters, DepthFormat, FragmentColor, FragmentStage, Interpolation, Paint, Target,
};
use core::mem::take;
use core::num::NonZero;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The most threads.
const MOST: usize = 256;
/// Bands for each thread, so that one whose bands have more to draw is helped by the others.
const BANDS: usize = 8;
/// Vertices or triangles that are worth a thread.
const FEW: usize = 2048;
/// Vertices that a thread takes at a time.
const PART: usize = 1024;
/// Parts of a mesh's triangles, of which a thread takes one at a time, and a band leaves out those that are elsewhere.
const PARTS: usize = 64;

impl<M, F, P, Pr> Pass<'_, M, F, P, Pr>
where
    M: Geometry + Sync,
    F: FragmentStage<M::Varying> + Sync,
    P: Interpolation,
    Pr: Projection,
    Slot<M::Varying>: Send + Sync,
{
    /// [`draw`](Self::draw) by so many threads: the pixels are the same for any number.
    ///
    /// The threads are those of the pool of [rayon](https://docs.rs/rayon) in which it is called, else of its global
    /// one, which has one for each core. Of so many that are asked for, there are at most as many as these, and 256.
    ///
    /// # Cost
    /// The threads wait for each other three times, some microseconds where the pool is awake. One thread draws the
    /// frame without [`slots`](Self::slots) for all vertices or `room` for all triangles, at most 2^20. So it does for
    /// meshes with more than three times as many vertices as triangles.
    pub fn draw_by_threads<C, D>(
        &mut self,
        threads: NonZero<usize>,
        room: Room<'_>,
        target: &mut Target<'_, C, D>,
    ) where
        C: ColorFormat,
        D: DepthFormat,
    {
        if let Some(machine) = Machine::all().next() {
            for_lanes!(machine, lanes => self.count_by_threads(lanes, threads, room, target, &mut ()));
        }
    }

    /// The same with as many samples at a time as there are `lanes`, of which `counters` hear.
    ///
    /// Of triangles that bands of the frame have in common, each of these has the fate in the counts. What else they
    /// count does not depend on the threads.
    pub fn count_by_threads<L, C, D, K>(
        &mut self,
        lanes: L,
        threads: NonZero<usize>,
        room: Room<'_>,
        target: &mut Target<'_, C, D>,
        counters: &mut K,
    ) where
        L: Floating,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters + Default + Send,
    {
        let (mesh, threads) = (self.mesh(), at_most(threads));
        let stored = stored_by(mesh, self.halves().0.len());
        let Some(screen) = self.screen(target.size(), target.depth_format()) else { return };
        let triangles = mesh.triangles();
        let roomy = triangles <= room.len() && triangles <= PreparedTriangle::MOST;
        if threads == 1 || stored == 0 || !roomy {
            return self.count_by(lanes, target, counters);
        }
        let (slots, paint) = self.halves();
        let Some(store) = slots.get_mut(..stored) else { return };
        fill(lanes, mesh, &screen, store, threads);
        let store = &*store;
        let walk = || Walk::over(mesh, &screen, store);
        let lists = &list_by(threads, walk, paint, room, counters);

        let bands = Mutex::new(target.split(band_rows(target.limits()[1].len(), threads)));
        let total = Mutex::new(take(counters));
        together(threads, || {
            let mut counters = K::default();
            while let Some(mut band) = next(&bands) {
                let listed = |its: Slices| {
                    let lists = lists.iter().filter(move |(slices, _)| slices.meet(its));
                    lists.flat_map(|(_, list)| *list).filter(PreparedTriangle::meets(its))
                };
                draw_listed(lanes, (listed, triangles), walk(), paint, &mut band, &mut counters);
            }
            locked(&total).add(counters);
        });
        *counters = total.into_inner().unwrap_or_else(PoisonError::into_inner);
    }
}

/// [`Target::clear`] by so many threads, as in [`Pass::draw_by_threads`].
pub fn clear_by_threads<C, D, Shade>(threads: NonZero<usize>, target: &mut Target<'_, C, D>, color: Shade)
where
    C: ColorFormat,
    D: DepthFormat,
    Shade: FragmentColor + Sync,
{
    let threads = at_most(threads);
    if threads == 1 {
        return target.clear(color);
    }
    let bands = Mutex::new(target.split(band_rows(target.limits()[1].len(), threads)));
    together(threads, || {
        while let Some(mut band) = next(&bands) {
            band.clear(color);
        }
    });
}

/// So many threads, or as many as there are.
fn at_most(threads: NonZero<usize>) -> usize {
    threads.get().min(rayon_core::current_num_threads()).min(MOST)
}

/// Rows of each band but the last, of a frame of so many.
fn band_rows(rows: usize, threads: usize) -> usize {
    rows.div_ceil(threads * BANDS)
}

/// Does the work in so many threads, and comes back when all are done.
fn together(threads: usize, work: impl Fn() + Sync) {
    if threads == 1 {
        return work();
    }
    rayon_core::scope(|scope| {
        (1..threads).for_each(|_| scope.spawn(|_| work()));
        work();
    });
}

/// The contents of a mutex. A thread that panicked takes the others with it when they are joined.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The next one, for this thread alone.
fn next<I: Iterator>(shared: &Mutex<I>) -> Option<I::Item> {
    locked(shared).next()
}

/// Fills the store with all vertices.
fn fill<L, M, Pr>(lanes: L, mesh: &M, screen: &Screen<Pr>, store: &mut [Slot<M::Varying>], threads: usize)
where
    L: Floating,
    M: Geometry + Sync,
    Pr: Projection,
    Slot<M::Varying>: Send,
{
    let count = store.len();
    let threads = if count < FEW { 1 } else { threads.min(count.div_ceil(PART)) };
    let parts = Mutex::new(store.chunks_mut(PART).zip((0..).step_by(PART)));
    together(threads, || {
        while let Some((slots, first)) = next(&parts) {
            Slot::fill_all(lanes, mesh, screen, first, slots);
        }
    });
}

/// Some of the listed triangles, and the slices of their rows.
type List<'r> = (Slices, &'r [PreparedTriangle]);

/// Lists the mesh's triangles in order; there is room for all.
fn list_by<'s, 'r, M, F, P, Pr, K>(
    threads: usize,
    walk: impl Fn() -> Walk<'s, M, Pr> + Sync,
    paint: &Paint<F, P>,
    room: Room<'r>,
    counters: &mut K,
) -> [List<'r>; PARTS]
where
    M: Geometry + 's,
    F: Sync,
    P: Interpolation,
    Pr: Projection,
    K: Counters + Default + Send,
{
    let triangles = walk().mesh().triangles();
    let threads = if triangles < FEW { 1 } else { threads };
    let part = triangles.div_ceil(PARTS).max(1);
    let mut lists = [(Slices::NONE, &[][..]); PARTS];
    let parts = room.chunks_mut(part).zip((0..triangles).step_by(part)).zip(&mut lists);
    let (parts, total) = (Mutex::new(parts), Mutex::new(take(counters)));
    together(threads, || {
        let (mut walk, mut counters) = (walk(), K::default());
        let pixels = walk.pixels();
        while let Some(((room, first), listed)) = next(&parts) {
            let numbers = first..triangles.min(first + part);
            let (count, _) = list(&mut walk, paint, (&pixels, sampled), numbers, room, &mut counters);
            let room = room.get(..count).unwrap_or_default();
            *listed = (Slices::of_all(room), room);
        }
        locked(&total).add(counters);
    });
    *counters = total.into_inner().unwrap_or_else(PoisonError::into_inner);
    lists
}
