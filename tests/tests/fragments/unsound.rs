//! Vertices that are not finite in one number: their triangles are dropped, all others have the pixels of a mesh
//! without these, and no fragment hears of them. However the frame is divided, and in whichever numbers it is drawn.
#![allow(clippy::cast_precision_loss, reason = "a small grid")]

use crate::divisions::{Arithmetic, Division, Memory, Scene, Way, all_arithmetic, picture};
use alberti::glam::{Mat3, Vec3};
use alberti::lanes::Machine;
use alberti::{AnyDepth, Camera, Frame, Lines, Point3, Stats};
use std::num::NonZero;

/// Vertices and triangles enough for each step to be divided among threads.
const COLUMNS: u16 = 48;
const ROWS: u16 = 45;
const FRAME: ([u32; 2], AnyDepth) = ([97, 61], AnyDepth::F32);
const UNIT: f32 = 1.0 / 4096.0;

/// A wavy sheet from behind the eye to far before it, wider than the view.
fn sheet() -> Scene {
    let vertex = |i: u16| {
        let [s, t] = [i % COLUMNS, i / COLUMNS].map(f32::from);
        let [x, z] = [s / f32::from(COLUMNS - 1) * 8.0 - 4.0, 1.5 - t / f32::from(ROWS - 1) * 7.0];
        let color = Vec3::new(s - 20.0, t * 0.125, (s * t).rem_euclid(7.0));
        (Vec3::new(x, -0.7 + 0.3 * (s * 0.9).rem_euclid(1.0), z), color)
    };
    let cell = |i: u16| {
        let (column, row) = (i % (COLUMNS - 1), i / (COLUMNS - 1));
        let a = row * COLUMNS + column;
        [[a, a + 1, a + COLUMNS], [a + 1, a + COLUMNS + 1, a + COLUMNS]]
    };
    let triangles = (0..(COLUMNS - 1) * (ROWS - 1)).flat_map(cell).collect();
    let camera = Camera::look_at(Vec3::ZERO, Vec3::new(0.0, -0.4, -1.0), Vec3::Y).expect("a direction");
    let view = camera.perspective(1.2, 0.2..5.0).expect("a pyramid");
    Scene::new((0..COLUMNS * ROWS).map(vertex).collect(), triangles, view)
}

/// Room for some of the triangles.
const FEW: usize = 900;

/// Whole with all kinds of slots, in bands, and by threads.
fn divisions() -> Vec<Division> {
    let whole = [0, 1, 7, usize::MAX].map(|slots| Division { slots, ..Division::WHOLE });
    let bands = [Division::bands(1), Division { slots: 5, room: FEW, way: Way::Bands(13) }];
    let threads = [2, 5].map(Division::threads);
    whole.into_iter().chain(bands).chain(threads).collect()
}

/// The number of a vertex with this number, of its place and what it carries.
fn component(scene: &mut Scene, vertex: usize, k: usize) -> &mut f32 {
    let (place, carried) = &mut scene.vertices[vertex];
    if k < 3 { &mut place[k] } else { &mut carried[k - 3] }
}

#[test]
fn one_number_drops_the_triangles_of_its_vertex_and_no_others() {
    let sheet = sheet();
    // The first and the last, and many in the view.
    let seen = (14..40).flat_map(|row| [19, 23, 28].map(|column| row * COLUMNS + column));
    let mut vertices = [0, COLUMNS * ROWS - 1].into_iter().chain(seen.step_by(2)).map(usize::from);
    let kinds = all_arithmetic(UNIT).into_iter().filter(|kind| !matches!(kind, Arithmetic::Integers(..)));
    let kinds: Vec<_> = kinds.collect();
    let whole: Vec<_> = kinds.iter().map(|&kind| picture(&sheet, kind, Division::WHOLE, FRAME).0).collect();
    let mut differing = 0;
    for k in 0..6 {
        // Finite ones are too large for a place, not for what is carried.
        let finite = if k < 3 { [f32::MAX, f32::MIN] } else { [f32::NAN; 2] };
        for number in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY].into_iter().chain(finite) {
            let vertex = vertices.next().expect("enough of them");
            let mut broken = sheet.clone();
            *component(&mut broken, vertex, k) = number;
            let mut without = sheet.clone();
            without.triangles.retain(|indices| indices.iter().all(|&i| usize::from(i) != vertex));
            let left_out = (sheet.triangles.len() - without.triangles.len()) as u64;
            assert!((1..7).contains(&left_out));
            for (kind, whole) in kinds.iter().zip(&whole) {
                let (expected, fates) = picture(&without, *kind, Division::WHOLE, FRAME);
                differing += u32::from(expected != *whole);
                for division in divisions() {
                    let (found, stats) = picture(&broken, *kind, division, FRAME);
                    let what =
                        || format!("{number} in number {k} of vertex {vertex}: {kind:?}, {division:?}");
                    assert!(found == expected, "{}", what());
                    assert_eq!(stats.written, fates.written, "{}", what());
                    // Bands count each on their own what found no room.
                    if division.room != FEW {
                        let expected = [fates.dropped + left_out, fates.clipped];
                        assert_eq!([stats.dropped, stats.clipped], expected, "{}", what());
                    }
                }
            }
        }
    }
    assert!(differing > 60, "the vertices are not in the view: {differing}");
}

/// Whatever is finite is drawn, however large: sums of products may overflow, what a fragment gets does not.
#[test]
fn the_largest_numbers_that_are_carried_stay_finite() {
    let mut scene = sheet();
    let extremes = [f32::MAX, f32::MIN, 1.0, f32::MIN_POSITIVE, -0.0];
    for (i, (_, carried)) in scene.vertices.iter_mut().enumerate() {
        *carried = Vec3::from_array([extremes[i % 5], extremes[i / 5 % 5], extremes[i / 3 % 2]]);
    }
    let plain = sheet();
    for kind in all_arithmetic(UNIT) {
        // The stage looks at them.
        let (found, stats) = picture(&scene, kind, Division::WHOLE, FRAME);
        let (expected, fates) = picture(&plain, kind, Division::WHOLE, FRAME);
        assert_eq!(found.depth, expected.depth, "{kind:?}");
        assert_eq!(
            [stats.dropped, stats.clipped, stats.written],
            [fates.dropped, fates.clipped, fates.written]
        );
        assert!(stats.written > 2000 && stats.clipped > 20, "{stats:?}");
    }
}

/// A mesh of integers has no vertex of its own that is not finite, but a unit and a frame.
#[test]
fn integers_in_no_unit_or_no_frame_are_dropped() {
    let nothing = Memory::new(FRAME.0, FRAME.0[0] as usize, FRAME.1);
    let check = |scene: &Scene, kind: Arithmetic| {
        for division in [Division::WHOLE, Division::bands(9), Division::threads(3)] {
            let (found, Stats { submitted, dropped, .. }) = picture(scene, kind, division, FRAME);
            assert!(found == nothing && dropped == submitted && submitted > 0, "{kind:?}, {division:?}");
        }
    };
    let sheet = sheet();
    for number in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        check(&sheet, Arithmetic::Integers(Lines::affine(), number));
        for k in 0..12 {
            let mut numbers = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
            numbers[k] = number;
            let axes = Mat3::from_cols_slice(&numbers[..9]);
            let frame = Frame::from_mat3(axes, Point3::new(Vec3::from_slice(&numbers[9..])));
            let scene = Scene { frame, ..sheet.clone() };
            let machine = Machine::all().next().expect("every machine has lanes");
            for kind in [Arithmetic::Integers(Lines::affine(), UNIT), Arithmetic::Floats(machine)] {
                check(&scene, kind);
            }
        }
    }
    let threads = Division { way: Way::Threads(NonZero::<usize>::MIN), ..Division::WHOLE };
    let sound = picture(&sheet, Arithmetic::Integers(Lines::affine(), UNIT), threads, FRAME).0;
    assert!(sound.drawn() > 2000);
}
