//! Parallel projection through the whole pipeline: values that are linear in space are linear on the screen, for every
//! policy of interpolation, and everything that is drawn lies between the planes, wherever these are.
//!
//! Straight lines are `Lines`, and the directions of depth `AnyDepth`: each a kernel.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    reason = "pixels and subpixels are small"
)]

use alberti::glam::Vec3;
use alberti::{
    AnyDepth, Cull, DepthFormat, Exact, Flat, Frame, Interpolation, Lines, Mesh, Parallel, Pass, Rgba8,
    Rgba8888, Sides, Slot, Target, View,
};
use alberti_oracle::cases::pixel_centre;
use alberti_oracle::coverage::covers;
use alberti_oracle::dd;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::for_widest;
use alberti_tests::narrow::Narrow;
use alberti_tests::probe::{Recorded, Seen};

const EPS: f64 = 1.0 / (1 << 24) as f64;
/// Columns and rows; a window's unit is half of it, which makes every step from object to screen exact.
const SIDE: usize = 128;
const SIZE: u32 = SIDE as u32;
const HALF: f32 = 64.0;
const PLANES: [f32; 2] = [-3.0, 5.0];

/// A vertex with a dyadic position, depth and value.
type Given = (Vec3, f32);

fn view([near, far]: [f32; 2]) -> View<Parallel> {
    View::new(Frame::IDENTITY, Parallel::new(2.0, 1.0, near, far).expect("a box"))
}

/// The pixels of a triangle, each with its fragment's varying and depth.
fn drawn(policy: impl Interpolation, triangle: &[Given; 3]) -> Vec<([i64; 2], f32, f32)> {
    let (mut color, mut depth) = ([0; SIDE * SIDE], [1.0; SIDE * SIDE]);
    let mut target = Target::new(Rgba8888, Recorded, SIZE, SIZE, &mut color, &mut depth).expect("a frame");
    let seen = Seen::default();
    let (view, mesh) = (view(PLANES), Mesh::new(triangle, &[[0u16, 1, 2]], |v: &Given| *v));
    let stage = |u: f32| seen.keep(u);
    let mut pass = Pass::new(&view, &mesh, Narrow(stage)).cull(Cull::None).interpolation(policy);
    for_widest!(lanes => pass.draw_by(lanes, &mut target));
    let place = |i: usize| [(i % SIDE) as i64, (i / SIDE) as i64];
    let kept = color.iter().zip(&depth).enumerate().filter(|(_, (c, _))| **c != 0);
    kept.map(|(i, (&c, &zs))| (place(i), seen.at(c), zs)).collect()
}

/// Varyings within `attribute` ε of the greatest, depths within `depth` ε.
fn linear(policy: impl Interpolation, stream: u64, attribute: f64, depth: f64) {
    let mut rng = Rng::stream(run_seed(), stream);
    let (mut worst_u, mut worst_zs, mut samples) = (0.0, 0.0, 0);
    for _ in 0..150 {
        let mut of_2_14 = |most: f64| (rng.uniform(-most, most) * 16384.0).round() as f32 / 16384.0;
        let triangle = [(); 3].map(|()| {
            let position = Vec3::new(of_2_14(1.5), of_2_14(1.5), (of_2_14(0.999) + 0.25) * 4.0);
            (position, of_2_14(100.0))
        });
        // Subpixels from the upper left corner, without the pipeline: a window's unit is 64 pixels of 256.
        let per_unit = HALF * 256.0;
        let tri = triangle.map(|(p, _)| [(1.0 + p.x) * per_unit, (1.0 - p.y) * per_unit].map(|c| c as i64));
        let u = triangle.map(|(_, u)| u);
        let z = triangle.map(|(p, _)| p.z);
        let largest = u.iter().fold(0.0, |l, u| f64::max(l, f64::from(u.abs())));
        let fragments = drawn(policy, &triangle);
        let side = 0..SIDE as i64;
        let covered = side.clone().flat_map(|y| side.clone().map(move |x| pixel_centre(x, y, 8)));
        assert_eq!(fragments.len(), covered.filter(|sample| covers(tri, *sample)).count(), "{triangle:?}");
        for ([x, y], found, zs) in fragments {
            let sample = pixel_centre(x, y, 8);
            let error = f64::from(found) - dd::linear(tri, sample, u).to_f64();
            worst_u = f64::max(worst_u, error.abs() / (EPS * largest));
            let [near, far] = PLANES.map(f64::from);
            let exact = (dd::linear(tri, sample, z).to_f64() - near) / (far - near);
            worst_zs = f64::max(worst_zs, (f64::from(zs) - exact).abs() / EPS);
            samples += 1;
        }
    }
    println!("{policy:?}: attributes {worst_u:.3}ε, depths {worst_zs:.3}ε in {samples} samples");
    assert!(worst_u <= attribute && worst_zs <= depth && samples > 150_000);
}

/// That of the policy, for depths with the 3ε of the vertices. Straight lines miss nothing.
#[test]
fn what_is_linear_in_space_is_linear_on_the_screen() {
    linear(Lines::affine(), 1, 6.0, 9.0);
    linear(Exact, 2, 9.0, 9.0);
    linear(Lines::spans(8).expect("a power of two"), 3, 6.0, 9.0);
    linear(Lines::bounded(1e-9), 4, 6.0, 9.0);
}

/// A sheet that is wider than the window and leans back by 8 units of depth a unit of height: which rows are drawn says
/// where it is cut, by planes before the eye, behind it, or on both sides of it.
#[test]
fn only_what_lies_between_the_planes_is_drawn() {
    let sheet = [(-4.0, -2.0), (4.0, -2.0), (4.0, 2.0), (-4.0, 2.0)]
        .map(|(x, y)| (Vec3::new(x, y, 8.0 * y), 8.0 * y));
    for planes in [[-4.0, 2.0], [-6.0, -1.0], [0.5, 7.5], [-100.0, 0.0], [-3.0, 100.0]] {
        for sides in [Sides::GuardBand, Sides::Cube] {
            let seen = Seen::default();
            let mesh = Mesh::new(&sheet, &[[0u16, 1, 2], [0, 2, 3]], |v: &Given| *v);
            let view = view(planes);
            let (mut color, mut depth) = ([0; SIDE * SIDE], [1.0; SIDE * SIDE]);
            let mut target =
                Target::new(Rgba8888, Recorded, SIZE, SIZE, &mut color, &mut depth).expect("a frame");
            let stage = |u: f32| seen.keep(u);
            let pass = Pass::new(&view, &mesh, Narrow(stage)).sides(sides);
            let mut pass = pass.interpolation(Lines::affine());
            for_widest!(lanes => pass.draw_by(lanes, &mut target));
            let mut rows = 0;
            for (i, (&c, &zs)) in color.iter().zip(&depth).enumerate() {
                let z = 8.0 * (1.0 - ((i / SIDE) as f32 + 0.5) / HALF);
                let between = planes[0] <= z && z <= planes[1];
                assert_eq!(c != 0, between, "{planes:?} {sides:?}: pixel {i} at depth {z}");
                if between {
                    let expected = (z - planes[0]) / (planes[1] - planes[0]);
                    assert!((seen.at(c) - z).abs() < 1e-4 && (zs - expected).abs() < 1e-4, "{planes:?} {i}");
                    rows += 1;
                }
            }
            assert!(rows > 10 * SIDE, "{planes:?}");
        }
    }
}

/// Which of many triangles is in front does not depend on the direction in which depths are counted.
#[test]
fn both_directions_of_depth_show_the_same() {
    let mut rng = Rng::stream(run_seed(), 5);
    let mut at = |most: f64| rng.uniform(-most, most) as f32;
    let soup: Vec<Given> = (0..300).map(|_| (Vec3::new(at(1.2), at(1.2), 1.0 + at(6.0)), at(1.0))).collect();
    let triangles: Vec<_> = (0..100u16).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let forward = picture(AnyDepth::F32, &soup, &triangles);
    let reversed = picture(AnyDepth::F32Reversed, &soup, &triangles);
    let differ = forward.iter().zip(&reversed).filter(|(a, b)| a != b).count();
    let covered = forward.iter().filter(|c| **c != 0).count();
    println!("{differ} of {covered} pixels differ");
    assert!(covered > SIDE * SIDE / 2 && differ * 1000 < covered, "{differ} of {covered}");
}

fn picture(format: AnyDepth, soup: &[Given], triangles: &[[u16; 3]]) -> Vec<u32> {
    let (mut color, mut depth) = (vec![0; SIDE * SIDE], vec![format.farthest(); SIDE * SIDE]);
    let mut target = Target::new(Rgba8888, format, SIZE, SIZE, &mut color, &mut depth).expect("a frame");
    let mesh = Mesh::new(soup, triangles, |v: &Given| (v.0, Flat(v.1)));
    let stage = |Flat(u): Flat<f32>| Some(Rgba8::from_bits(u.to_bits()));
    let (view, mut slots) = (view(PLANES), [Slot::EMPTY; 16]);
    let pass = Pass::new(&view, &mesh, Narrow(stage)).cull(Cull::None);
    let mut pass = pass.interpolation(Lines::affine()).slots(&mut slots);
    for_widest!(lanes => pass.draw_by(lanes, &mut target));
    color
}
