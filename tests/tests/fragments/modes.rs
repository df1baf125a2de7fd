//! Components declared linear are linear on the screen, and those declared flat are the first vertex's, for every
//! policy of interpolation and through clipping.
//!
//! Straight lines are `Lines`: a kernel for all in `f32`, and one for all in fixed point.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    reason = "pixels and subpixels are small"
)]

use alberti::glam::Vec3;
use alberti::lanes::Floating;
use alberti::{Cull, Flat, Frame, Linear, Mesh, Pass, Perspective, Sides, Sub8, Varying, View};
use alberti_oracle::cases::pixel_centre;
use alberti_oracle::dd;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::{
    Exact, FixedPoint, Interpolation, Lines, NoDepth, Paint, Planes, Rgba8888, Target, Vertex,
};
use alberti_tests::for_widest;
use alberti_tests::narrow::Narrow;
use alberti_tests::probe::{Recorded, Seen, vertex};

const EPS: f64 = 1.0 / (1 << 24) as f64;
const WIDTH: usize = 96;
const HEIGHT: usize = 64;
/// The full vertical opening angle.
const FOV: f32 = 1.5;

/// Hyperbolic, linear and flat, one in another.
type Carried = (f32, Linear<(f32, Flat<f32>)>);

/// The pixels of a triangle, each with its fragment's varying.
fn drawn(
    interpolation: impl Interpolation,
    lanes: impl Floating,
    vertices: [&Vertex<Carried>; 3],
) -> Vec<([i32; 2], Carried)> {
    let (mut color, mut depth) = ([0; WIDTH * HEIGHT], [1.0; WIDTH * HEIGHT]);
    let (width, height) = (WIDTH as u32, HEIGHT as u32);
    let mut target = Target::new(Rgba8888, Recorded, width, height, &mut color, &mut depth).expect("a frame");
    let seen = Seen::default();
    let keep = |v: Carried| seen.keep(v);
    let paint = Paint { stage: &keep, interpolation, subpixel: Sub8, cull: Cull::None };
    paint.triangle(lanes, &mut target, vertices, &mut ());
    let place = |i: usize| [(i % WIDTH) as i32, (i / WIDTH) as i32];
    color.iter().enumerate().filter(|(_, c)| **c != 0).map(|(i, &c)| (place(i), seen.at(c))).collect()
}

/// `bound` is that of linear components, from the greatest value and the greatest difference.
fn check(policy: impl Interpolation, stream: u64, bound: impl Fn(f64, f64) -> f64) {
    let mut rng = Rng::stream(run_seed(), stream);
    let (mut worst, mut samples, mut apart) = (0.0, 0, 0);
    for _ in 0..300 {
        let one = 256.0;
        let tri = [(); 3].map(|()| {
            [rng.uniform(-40.0, 140.0), rng.uniform(-30.0, 100.0)].map(|c| (c * one).round() as i64)
        });
        let q = [(); 3].map(|()| rng.log_uniform(1e-3, 1.0));
        let u = [(); 3].map(|()| rng.uniform(-8.0, 8.0) as f32);
        // With few bits, so that every kind of number holds them.
        let w = [(); 3].map(|()| (rng.uniform(-8.0, 8.0) * 256.0).round() as f32 / 256.0);
        let vertices = [0, 1, 2].map(|i| vertex(tri[i], 0.5, q[i], (u[i], Linear((u[i], Flat(w[i]))))));
        let largest = u.iter().fold(0.0, |l, u| f64::max(l, f64::from(u.abs())));
        let spread = u.iter().flat_map(|a| u.map(|b| f64::from(a - b))).fold(0.0, f64::max);
        for first in 0..3 {
            let order = [first, (first + 1) % 3, (first + 2) % 3].map(|i| &vertices[i]);
            for (at, (hyperbolic, Linear((linear, Flat(flat))))) in
                for_widest!(lanes => drawn(policy, lanes, order))
            {
                assert_eq!(
                    flat.to_bits(),
                    w[first].to_bits(),
                    "{policy:?}: {flat} from vertex {first} of {w:?}"
                );
                let sample = pixel_centre(at[0].into(), at[1].into(), 8);
                let exact = dd::linear(tri, sample, u).to_f64();
                worst = f64::max(worst, (f64::from(linear) - exact).abs() / bound(largest, spread));
                samples += 1;
                apart += usize::from((f64::from(hyperbolic) - exact).abs() > 0.01);
            }
        }
    }
    println!("{policy:?}: {worst:.3} of the bound in {samples} samples, {apart} of which perspective moves");
    assert!(worst <= 1.0 && samples > 100_000);
}

fn spans(length: i32) -> Lines {
    Lines::spans(length).expect("a power of two")
}

#[test]
fn linear_and_flat_in_f32() {
    check(Exact, 1, |largest, _| 9.0 * EPS * largest);
    check(Planes, 2, |largest, _| 12.0 * EPS * largest);
    check(spans(8), 3, |largest, _| 12.0 * EPS * largest);
    check(Lines::bounded(0.01), 4, |largest, _| 12.0 * EPS * largest);
    check(Lines::affine(), 5, |largest, _| 12.0 * EPS * largest);
}

#[test]
fn linear_and_flat_in_fixed_point() {
    let bound =
        |columns: f64| move |_: f64, spread: f64| (columns + 3.0) / 65536.0 + spread / f64::from(1 << 17);
    check(FixedPoint(spans(16)), 6, bound(16.0));
    check(FixedPoint(Lines::affine()), 7, bound(64.0));
    check(FixedPoint(Lines::bounded(0.01)), 8, bound(64.0));
}

/// A floor that reaches behind the eye: all that clipping leaves of it carries its first vertex's value.
#[test]
fn flat_values_survive_clipping() {
    let vertices = [(-50.0, -1.0, -30.0, 0.1f32), (50.0, -1.0, -30.0, 0.2), (0.0, -1.0, 90.0, 0.3)];
    for first in 0..3u16 {
        let order = [first, (first + 1) % 3, (first + 2) % 3].map(|i| vertices[usize::from(i)]);
        let triangle = order.map(|(x, y, z, w)| (Vec3::new(x, y, z), Flat(w)));
        let drawn = through_the_view(Exact, Sides::Cube, &triangle);
        assert!(drawn.len() > 1000, "only {} pixels", drawn.len());
        assert!(drawn.iter().all(|(_, w)| w.0.to_bits() == order[0].3.to_bits()));
    }
}

/// The pixels that the pipeline draws of a triangle in eye space, each with its fragment's varying.
fn through_the_view<V: Varying + Default>(
    interpolation: impl Interpolation,
    sides: Sides,
    triangle: &[(Vec3, V); 3],
) -> Vec<([i32; 2], V)> {
    let seen = Seen::default();
    let view = View::new(Frame::IDENTITY, Perspective::new(FOV, 1.5, 0.1, 60.0).expect("possible"));
    let mesh = Mesh::new(triangle, &[[0u16, 1, 2]], |&vertex| vertex);
    let (mut color, mut depth) = ([0; WIDTH * HEIGHT], [(); WIDTH * HEIGHT]);
    let (width, height) = (WIDTH as u32, HEIGHT as u32);
    let mut target = Target::new(Rgba8888, NoDepth, width, height, &mut color, &mut depth).expect("a frame");
    let stage = |v: V| seen.keep(v);
    let pass = Pass::new(&view, &mesh, Narrow(stage)).cull(Cull::None).sides(sides);
    let mut pass = pass.interpolation(interpolation);
    for_widest!(lanes => pass.draw_by(lanes, &mut target));
    let place = |i: usize| [(i % WIDTH) as i32, (i / WIDTH) as i32];
    color.iter().enumerate().filter(|(_, c)| **c != 0).map(|(i, &c)| (place(i), seen.at(c))).collect()
}

/// Linear components are those of the whole triangle's plane on the screen, whether its sides are cut or not. A vertex
/// moves by half a step of snapping on each axis, and the plane with it.
#[test]
fn linear_values_survive_the_sides() {
    let scale = [1.0 / 1.5, 1.0].map(|by| by / (f64::from(FOV) / 2.0).tan());
    let mut rng = Rng::stream(run_seed(), 9);
    let (mut worst, mut samples, mut apart) = (0.0, 0, 0);
    for _ in 0..400 {
        let u = [(); 3].map(|()| rng.uniform(-8.0, 8.0) as f32);
        let triangle = u.map(|u| {
            let z = rng.log_uniform(0.2, 50.0);
            let [x, y] = scale.map(|scale| (rng.uniform(-4.0, 4.0) * f64::from(z) / scale) as f32);
            (Vec3::new(x, y, z), (u, Linear(u)))
        });
        let at = triangle.map(|(p, _)| {
            let [x, y] =
                [(p.x, scale[0]), (p.y, scale[1])].map(|(c, scale)| f64::from(c) * scale / f64::from(p.z));
            [(x + 1.0) * WIDTH as f64 / 2.0, (1.0 - y) * HEIGHT as f64 / 2.0]
        });
        let along = |k: usize| [at[1][k] - at[0][k], at[2][k] - at[0][k]];
        let ([x1, x2], [y1, y2]) = (along(0), along(1));
        let [u1, u2] = [1, 2].map(|i| f64::from(u[i]) - f64::from(u[0]));
        let area = x1 * y2 - x2 * y1;
        let [dx, dy] = [(u1 * y2 - u2 * y1) / area, (u2 * x1 - u1 * x2) / area];
        let largest = u.iter().fold(0.0, |l, u| f64::max(l, f64::from(u.abs())));
        let bound = (dx.abs() + dy.abs()) * (1.0 / 512.0 + 1e-4) + 32.0 * EPS * largest;
        for sides in [Sides::Cube, Sides::GuardBand] {
            for ([column, row], (hyperbolic, Linear(linear))) in through_the_view(Exact, sides, &triangle) {
                let [x, y] = [(column, at[0][0]), (row, at[0][1])].map(|(c, at)| f64::from(c) + 0.5 - at);
                let exact = f64::from(u[0]) + dx * x + dy * y;
                worst = f64::max(worst, (f64::from(linear) - exact).abs() / bound);
                samples += 1;
                apart += usize::from((f64::from(hyperbolic) - exact).abs() > 0.5);
            }
        }
    }
    println!("{worst:.3} of the bound in {samples} samples, {apart} of which perspective moves");
    assert!(worst <= 1.0 && samples > 100_000 && apart * 10 > samples);
}
