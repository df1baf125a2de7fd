//! Frames by any number of threads: the bits of one, in floats, in fixed point and of integers, in windows into larger
//! pictures, with more threads than there is work for, and never more than are asked for.
//!
//! No threads at all cannot be asked for: their number is a `NonZero`.

use crate::divisions::{Division, Memory, POOL, Scene, Way, all_arithmetic, every_bit, picture};
use alberti::glam::Vec3;
use alberti::{AnyDepth, Camera, Rgba8, Stats, Subpixel, Viewport};
use alberti_oracle::rng::{Rng, run_seed};
use std::num::NonZero;
use std::sync::{Condvar, Mutex, PoisonError};
use std::thread::{self, ThreadId};
use std::time::Duration;

const UNIT: f32 = 1.0 / 4096.0;

/// A closed ring of bumps around the eye, in so many columns and rows.
#[expect(clippy::cast_possible_truncation, reason = "random f64 become f32")]
fn ring(rng: &mut Rng, [columns, rows]: [u16; 2]) -> Scene {
    let mut vertices = Vec::new();
    for row in 0..=rows {
        for column in 0..columns {
            let (sin, cos) = (f32::from(column) / f32::from(columns) * core::f32::consts::TAU).sin_cos();
            let away = rng.uniform(0.8, 3.0) as f32;
            let place = Vec3::new(sin, f32::from(row) / f32::from(rows) * 2.0 - 1.0, cos) * away;
            vertices.push((place, Vec3::from_array([(); 3].map(|()| rng.uniform(-50.0, 50.0) as f32))));
        }
    }
    let cell = |i: u16| {
        let [row, column] = [i / columns, i % columns];
        let [a, b] = [row * columns + column, row * columns + (column + 1) % columns];
        [[a, b, a + columns], [b, b + columns, a + columns]]
    };
    let triangles = (0..rows * columns).flat_map(cell).collect();
    let view = Camera::look_at(Vec3::ZERO, Vec3::new(0.3, 0.1, -1.0), Vec3::Y).expect("a direction");
    Scene::new(vertices, triangles, view.perspective(1.3, 0.3..6.0).expect("a pyramid"))
}

/// The counts that do not depend on bands.
fn once(stats: Stats) -> [u64; 5] {
    [stats.submitted, stats.dropped, stats.clipped, stats.fragments, stats.written]
}

#[test]
fn any_number_makes_the_bits_of_one() {
    let mut rng = Rng::stream(run_seed(), 1);
    let many = usize::MAX;
    // A mesh of which everything is divided, one of a few triangles, one without any.
    for grid in [[64, 40], [3, 1], [7, 0]] {
        let scene = ring(&mut rng, grid);
        // A frame of many rows, of fewer than most numbers of threads, of one.
        for size in [[83, 130], [200, 5], [90, 1]] {
            for subpixel in [Subpixel::Sub4, Subpixel::Sub8] {
                let scene = Scene { subpixel, ..scene.clone() };
                for kind in all_arithmetic(UNIT) {
                    let (expected, fates) = picture(&scene, kind, Division::WHOLE, (size, AnyDepth::D16));
                    assert!(grid[1] < 40 || size[1] < 130 || fates.written > 5_000, "{fates:?}");
                    for threads in [1, 2, 3, 7, 64, many] {
                        let division = Division::threads(threads);
                        let (found, stats) = picture(&scene, kind, division, (size, AnyDepth::D16));
                        assert!(found == expected, "{grid:?} in {size:?} by {threads}: {kind:?}");
                        assert_eq!(once(stats), once(fates), "{grid:?} in {size:?} by {threads}: {kind:?}");
                    }
                }
            }
        }
    }
}

/// A picture around the frame stays as it is, whatever the rows of bands are.
#[test]
fn windows_are_drawn_by_threads_too() {
    let mut rng = Rng::stream(run_seed(), 2);
    let (size, format) = ([61, 150], AnyDepth::F32);
    let scene = ring(&mut rng, [60, 36]);
    for stride in [62, 64, 200] {
        // Of the frame, or of a part of it, whose rows are drawn alone.
        for viewport in [None, Some(Viewport::new(3, 40, 50, 77).expect("a viewport"))] {
            let scene = Scene { viewport, ..scene.clone() };
            for kind in all_arithmetic(UNIT) {
                let (whole, _) = picture(&scene, kind, Division::WHOLE, (size, format));
                assert!(whole.drawn() > 1500, "{}", whole.drawn());
                for division in [2, 7, 64].map(Division::threads).into_iter().chain([Division::bands(9)]) {
                    let mut found = Memory::new(size, stride, format);
                    scene.draw(kind, division, &mut found.target(format));
                    assert!(found.depth == whole.depth, "{stride}: {kind:?}, {division:?}");
                    let (rows, beside) = (found.color.chunks(stride), stride - 61);
                    for (row, expected) in rows.zip(whole.color.chunks(61)) {
                        assert!(
                            row[..61] == *expected && row[61..] == vec![0; beside],
                            "{kind:?}, {division:?}"
                        );
                    }
                }
            }
        }
    }
}

/// With fewer slots than vertices, or less room than triangles, one thread draws.
#[test]
fn memory_is_a_matter_of_time_alone() {
    let mut rng = Rng::stream(run_seed(), 3);
    let (scene, frame) = (ring(&mut rng, [64, 40]), ([83, 60], AnyDepth::D24));
    for kind in all_arithmetic(UNIT) {
        let (expected, fates) = picture(&scene, kind, Division::WHOLE, frame);
        for (slots, room) in [(0, 0), (0, usize::MAX), (100, usize::MAX), (usize::MAX, 5119), (usize::MAX, 0)]
        {
            let way = Way::Threads(NonZero::new(7).expect("some"));
            let (found, stats) = picture(&scene, kind, Division { way, slots, room }, frame);
            assert!(found == expected && stats == fates, "{slots} slots, room for {room}: {kind:?}");
        }
    }
}

/// The threads that have drawn, and a bell for each new one.
static THREADS: (Mutex<Vec<ThreadId>>, Condvar) = (Mutex::new(Vec::new()), Condvar::new());

/// A number of threads to ask for, fewer than the pool has.
const ASKED: usize = 3;

/// A stage in which a thread waits, the first time, for more threads than there may be. It gives up after a while.
fn waiting(v: Vec3) -> Option<Rgba8> {
    let (threads, bell) = &THREADS;
    let mut threads = threads.lock().unwrap_or_else(PoisonError::into_inner);
    if !threads.contains(&thread::current().id()) {
        threads.push(thread::current().id());
        bell.notify_all();
        let few = |threads: &mut Vec<ThreadId>| threads.len() <= ASKED;
        drop(bell.wait_timeout_while(threads, Duration::from_millis(300), few));
    }
    every_bit(v)
}

#[test]
fn as_many_threads_draw_as_are_asked_for() {
    assert!(POOL.current_num_threads() > ASKED);
    let (size, format) = ([1, 16_384], AnyDepth::D16);
    let corner = |x: f32, y: f32| (Vec3::new(x, y, -1.0), Vec3::new(x, y, 1.0));
    let vertices = vec![corner(-9.0, -9.0), corner(9.0, -9.0), corner(0.0, 18.0)];
    let view = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y).expect("a direction");
    let view = view.perspective(1.0, 0.5..2.0).expect("a pyramid");
    let scene = Scene { stage: waiting, ..Scene::new(vertices, vec![[0, 1, 2]], view) };
    for kind in all_arithmetic(UNIT) {
        THREADS.0.lock().unwrap_or_else(PoisonError::into_inner).clear();
        let (found, _) = picture(&scene, kind, Division::threads(ASKED), (size, format));
        assert_eq!(found.drawn(), 16_384, "{kind:?}");
        let threads = THREADS.0.lock().unwrap_or_else(PoisonError::into_inner).len();
        assert_eq!(threads, ASKED, "{kind:?}");
    }
}
