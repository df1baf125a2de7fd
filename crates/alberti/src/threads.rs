//! Frames drawn by several threads: vertices, lists of triangles, and bands of rows, each in parallel.

use crate::geometry::Geometry;
use crate::pipeline::Pass;
use crate::prepared::{PreparedTriangle, Room, draw_listed, list};
use crate::screen::Screen;
use crate::stats::Stats;
use crate::vertex::Slot;
use crate::walk::{Walk, stored_by};
use alberti_math::for_lanes;
use alberti_math::lanes::{Floating, Machine};
use alberti_projection::Projection;
use alberti_raster::{ColorFormat, DepthFormat, FragmentColor, FragmentStage, Interpolation, Paint, Target};
use core::num::NonZero;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, scope};

/// The most threads.
const MOST: usize = 256;
/// Bands for each thread, so that one whose bands have more to draw is helped by the others.
const BANDS: usize = 4;
/// Vertices or triangles that are worth a thread.
const FEW: usize = 2048;
/// Vertices that a thread takes at a time.
const PART: usize = 1024;
/// Parts of a mesh's triangles, of which a thread takes one at a time.
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
    /// Of triangles that bands of the frame have in common, each of these has the fate in the counts. What else they
    /// count does not depend on the threads.
    ///
    /// # Cost
    /// Threads, at most 256, are started three times, for some ten microseconds each. One thread draws the frame
    /// without [`slots`](Self::slots) for all vertices or `room` for all triangles, at most 2^20. So it does for meshes
    /// with more than twice as many vertices as triangles.
    pub fn draw_by_threads<C, D>(
        &mut self,
        threads: NonZero<usize>,
        room: Room<'_>,
        target: &mut Target<'_, C, D>,
    ) -> Stats
    where
        C: ColorFormat,
        D: DepthFormat,
    {
        let mut stats = Stats::default();
        if let Some(machine) = Machine::all().next() {
            for_lanes!(machine, lanes => stats = self.count_by_threads(lanes, threads, room, target));
        }
        stats
    }

    /// The same with as many samples at a time as there are `lanes`.
    pub fn count_by_threads<L, C, D>(
        &mut self,
        lanes: L,
        threads: NonZero<usize>,
        room: Room<'_>,
        target: &mut Target<'_, C, D>,
    ) -> Stats
    where
        L: Floating,
        C: ColorFormat,
        D: DepthFormat,
    {
        let mut stats = Stats::default();
        let (mesh, threads) = (self.mesh(), threads.get().min(MOST));
        let stored = stored_by(mesh, self.halves().0.len());
        let Some(screen) = self.screen(target.size(), target.depth_format()) else { return stats };
        let triangles = mesh.triangles();
        let roomy = triangles <= room.len() && triangles <= PreparedTriangle::MOST;
        if threads == 1 || stored == 0 || !roomy {
            self.count_by(lanes, target, &mut stats);
            return stats;
        }
        let (slots, paint) = self.halves();
        let Some(store) = slots.get_mut(..stored) else { return stats };
        fill(lanes, mesh, &screen, store, threads);
        let store = &*store;
        let walk = || Walk::over(mesh, screen, store);
        let listed = list_by(threads, walk, paint, room, &mut stats);

        let target_rows = target.limits()[1].len();
        let rows = target_rows.div_ceil(threads * BANDS).next_multiple_of(8).max(8);
        let bands = Mutex::new(target.split(rows));
        let total = Mutex::new(stats);
        together(threads.min(target_rows.div_ceil(rows)), || {
            let mut stats = Stats::default();
            while let Some(mut band) = next(&bands) {
                draw_listed(lanes, (listed, triangles), walk(), paint, &mut band, &mut stats);
            }
            *locked(&total) += stats;
        });
        total.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

/// [`Target::clear`] by so many threads, at most 256.
pub fn clear_by_threads<C, D, Shade>(threads: NonZero<usize>, target: &mut Target<'_, C, D>, color: Shade)
where
    C: ColorFormat,
    D: DepthFormat,
    Shade: FragmentColor + Sync,
{
    let (threads, rows) = (threads.get().min(MOST), target.limits()[1].len());
    if threads == 1 {
        return target.clear(color);
    }
    let bands = Mutex::new(target.split(rows.div_ceil(threads * BANDS)));
    together(threads.min(rows), || {
        while let Some(mut band) = next(&bands) {
            band.clear(color);
        }
    });
}

/// Does the work in so many threads, and comes back when all are done.
fn together(threads: usize, work: impl Fn() + Sync) {
    scope(|scope| {
        for _ in 1..threads {
            // Where the system has no more threads, there are fewer.
            if Builder::new().spawn_scoped(scope, &work).is_err() {
                break;
            }
        }
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
    let threads = if count < FEW { 1 } else { threads };
    let parts = Mutex::new(store.chunks_mut(PART).zip((0..).step_by(PART)));
    together(threads.min(count.div_ceil(PART)), || {
        while let Some((slots, first)) = next(&parts) {
            Slot::fill_all(lanes, mesh, screen, first, slots);
        }
    });
}

/// Lists the mesh's triangles in order; there is room for all.
fn list_by<'s, 'r, M, F, P, Pr>(
    threads: usize,
    walk: impl Fn() -> Walk<'s, M, Pr> + Sync,
    paint: &Paint<F, P>,
    room: Room<'r>,
    stats: &mut Stats,
) -> &'r [PreparedTriangle]
where
    M: Geometry + 's,
    F: Sync,
    P: Interpolation,
    Pr: Projection,
{
    let triangles = walk().mesh().triangles();
    let threads = if triangles < FEW { 1 } else { threads };
    let part = triangles.div_ceil(PARTS).max(1);
    let mut found = [0; PARTS];
    let parts = room.chunks_mut(part).zip((0..triangles).step_by(part)).zip(&mut found);
    let (parts, total) = (Mutex::new(parts), Mutex::new(*stats));
    together(threads.min(PARTS), || {
        let (mut walk, mut stats) = (walk(), Stats::default());
        let pixels = walk.pixels();
        while let Some(((room, first), found)) = next(&parts) {
            let numbers = first..triangles.min(first + part);
            (*found, _) = list(&mut walk, paint, &pixels, numbers, room, &mut stats);
        }
        *locked(&total) += stats;
    });
    *stats = total.into_inner().unwrap_or_else(PoisonError::into_inner);
    // The parts' lists, moved together.
    let mut listed = 0;
    for (first, count) in (0..triangles).step_by(part).zip(found) {
        room.copy_within(first..first + count, listed);
        listed += count;
    }
    room.get(..listed).unwrap_or_default()
}
