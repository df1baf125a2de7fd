//! Coverage by hand: cells, limits, what is hidden, and what stays as it is.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels and colours are few"
)]

use super::*;
use crate::{Exact, F32, NoDepth, Numbers, Vertex};
use alberti_math::{Fixed, Flat, Rgba8888, Sub4};

fn corner<V: Varying>([x, y]: [i32; 2], zs: f32, varying: V) -> Corner<V> {
    let [x, y] = [x, y].map(|c| Fixed::from_subpixels(c).expect("near"));
    Corner::new(Numbers::Float, &Vertex { x, y, zs, q: 1.0, varying })
}

fn paint<F>(stage: F) -> Paint<F, Exact> {
    Paint { stage, interpolation: Exact, subpixel: Sub4, cull: Cull::None }
}

/// Two triangles that are a rectangle, in subpixels of [`Sub4`].
fn rectangle([left, top, right, bottom]: [i32; 4], zs: f32) -> [[Corner<()>; 3]; 2] {
    let [a, b, c, d] =
        [[left, top], [right, top], [left, bottom], [right, bottom]].map(|p| corner(p, zs, ()));
    [[a, b, d], [d, c, a]]
}

const WHITE: fn(()) -> Option<Rgba8> = |()| Some(Rgba8::WHITE);

/// The parts of 4 x 3 pixels in 256ths, of a silhouette within `columns`.
fn parts(columns: Range<i32>, rectangles: &[[i32; 4]]) -> [u32; 12] {
    let (mut color, mut depth, mut cells) = ([0; 12], [(); 12], [9; 12]);
    let target = Target::new(Rgba8888, NoDepth, 4, 3, &mut color, &mut depth).expect("a frame");
    let mut silhouette = Silhouette::new(&target, &mut cells).expect("enough words");
    let mut within = silhouette.scissor(columns, 0..3);
    for corners in rectangles.iter().flat_map(|sides| rectangle(*sides, 0.5)) {
        paint(()).cover(&mut within, corners.each_ref());
    }
    let coverage = silhouette.coverage();
    core::array::from_fn(|k| coverage.part([k as i32 % 4, k as i32 / 4]) >> 8)
}

#[test]
fn rectangles_cover_their_parts() {
    let one = [16, 8, 40, 40];
    assert_eq!(parts(0..4, &[one]), [0, 128, 64, 0, 0, 256, 128, 0, 0, 128, 64, 0]);
    // A rectangle that begins far on the left counts, and so does one that ends far on the right.
    assert_eq!(parts(0..4, &[[-900, -70, 8, 700]]), [128, 0, 0, 0, 128, 0, 0, 0, 128, 0, 0, 0]);
    assert_eq!(parts(0..4, &[[40, 32, 900, 36]]), [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 32, 64]);
    // Within two columns in the middle, and none outside.
    assert_eq!(parts(1..3, &[[-900, 0, 900, 40]]), [0, 256, 256, 0, 0, 256, 256, 0, 0, 128, 128, 0]);
    assert_eq!(parts(2..2, &[one]), [0; 12]);
    // Areas are added, up to the whole.
    assert_eq!(parts(0..4, &[one, one])[..4], [0, 256, 128, 0]);
    assert_eq!(parts(0..4, &[one, one, one])[..8], [0, 256, 192, 0, 0, 256, 256, 0]);
}

#[test]
fn words_must_be_enough() {
    let (mut color, mut depth, mut cells) = ([0; 12], [(); 12], [9; 12]);
    let mut target = Target::new(Rgba8888, NoDepth, 4, 3, &mut color, &mut depth).expect("a frame");
    let error = Silhouette::new(&target, &mut cells[1..]).map(|_| ()).expect_err("too few");
    assert_eq!(error, TargetError::Coverage { found: 11, expected: 12 });
    let part = target.scissor(1..3, 1..3);
    let silhouette = Silhouette::new(&part, &mut cells[..5]).expect("enough for four");
    assert_eq!((silhouette.limits(), silhouette.size()), ([1..3, 1..3], [4, 3]));
    let coverage = silhouette.coverage();
    assert_eq!((coverage.part([1, 1]), coverage.part([0, 0]), coverage.part([3, -4])), (0, 0, 0));
}

/// Columns that no triangle touches keep what is there, those covered in part are mixed, and what is before the fringe
/// hides it.
#[test]
fn pixels_beside_the_mesh_stay() {
    let (mut color, mut depth, mut cells) = ([7; 8], [1.0; 8], [0; 8]);
    depth[3] = 0.2;
    let mut target = Target::new(Rgba8888, F32, 4, 2, &mut color, &mut depth).expect("a frame");
    let mut silhouette = Silhouette::new(&target, &mut cells).expect("enough words");
    // A quarter of the last column, at 0.5.
    let corners = rectangle([60, 0, 90, 32], 0.5);
    corners.iter().for_each(|corners| paint(()).cover(&mut silhouette, corners.each_ref()));
    let coverage = silhouette.coverage();
    corners
        .iter()
        .for_each(|corners| paint(WHITE).fringe(&mut target, &coverage, corners.each_ref(), &mut ()));
    let fringe = target.pixels().to_vec();
    assert_eq!(fringe, [7, 7, 7, 7, 7, 7, 7, u32::MAX]);
    coverage.resolve(&mut target, Average::Bytes, |place| Rgba8::new(0, 100, place[0] as u8, 255));
    let mixed = |old: [u8; 3]| u32::from_ne_bytes([old[0], old[1], old[2], 255]);
    // The first of the two is what hides the fringe, a quarter of it.
    assert_eq!(color, [7, 7, 7, mixed([2, 75, 2]), 7, 7, 7, mixed([64, 139, 66])]);
}

/// Any part less than the whole is mixed, and the whole is not.
#[test]
fn nearly_whole_pixels_are_mixed() {
    for (sides, red) in [([0, 15, 15, 16], 254), ([0, 15, 16, 16], 255), ([0, 15, 0, 16], 239)] {
        let (mut color, mut depth, mut cells) = ([u32::MAX; 1], [(); 1], [0; 1]);
        let mut target = Target::new(Rgba8888, NoDepth, 1, 1, &mut color, &mut depth).expect("a frame");
        let mut silhouette = Silhouette::new(&target, &mut cells).expect("enough words");
        for corners in [[0, 0, 16, 15], sides].iter().flat_map(|sides| rectangle(*sides, 0.5)) {
            paint(()).cover(&mut silhouette, corners.each_ref());
        }
        silhouette.coverage().resolve(&mut target, Average::Bytes, |_| Rgba8::BLACK);
        assert_eq!(color[0].to_ne_bytes()[0], red, "{sides:?}");
    }
}

#[test]
fn what_is_flat_is_that_of_the_first_vertex() {
    let (mut color, mut depth, mut cells) = ([0; 16], [(); 16], [0; 16]);
    let mut target = Target::new(Rgba8888, NoDepth, 4, 4, &mut color, &mut depth).expect("a frame");
    let stage = |Flat(number): Flat<f32>| Some(Rgba8::from_bits(number as u32));
    let places = [[5, 3], [61, 20], [9, 60]];
    for first in 0..3 {
        let corners = [0, 1, 2].map(|k| {
            let k = (first + k) % 3;
            corner(places[k], 0.5, Flat(1.0 + k as f32))
        });
        target.clear(Rgba8::from_bits(0));
        let mut silhouette = Silhouette::new(&target, &mut cells).expect("enough words");
        paint(()).cover(&mut silhouette, corners.each_ref());
        let coverage = silhouette.coverage();
        paint(stage).fringe(&mut target, &coverage, corners.each_ref(), &mut ());
        let drawn: std::vec::Vec<u32> = target.pixels().iter().copied().filter(|pixel| *pixel != 0).collect();
        assert!(
            drawn.len() > 3 && drawn.iter().all(|pixel| u32::from_le(*pixel) == 1 + first as u32),
            "{drawn:?}"
        );
    }
}
