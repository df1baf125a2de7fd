//! Lines through the whole pipeline: their pixels and what they carry against rays in `f64`, cut at all planes, hidden
//! by surfaces, and with a bias upon them.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    reason = "pixels are few"
)]

use alberti::glam::{DVec3, Vec3};
use alberti::shaders::Solid;
use alberti::{
    Ball, Biased, Camera, Cull, Exact, F32Reversed, FixedPoint, Frame, Geometry, Interpolation, Mesh,
    Meshlet, Meshlets, NoDepth, Pass, Point3, PreparedTriangle, Rgba8, Rgba8888, Slot, Spans16, Target,
    Touched, View,
};
use alberti_oracle::rng::{Rng, run_seed};
use std::cell::RefCell;
use std::collections::BTreeSet;

const WIDTH: u32 = 160;
const HEIGHT: u32 = 120;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;
const FOV: f32 = 1.2;
const NEAR: f32 = 0.25;
const FAR: f32 = 30.0;

fn view() -> View {
    let camera = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y).expect("a camera");
    camera.perspective(FOV, NEAR..FAR).expect("a view")
}

/// A place on the screen in pixels.
fn projected(p: DVec3) -> [f64; 2] {
    let half = f64::from(HEIGHT) / 2.0;
    let scale = half / (f64::from(FOV) / 2.0).tan();
    [f64::from(WIDTH) / 2.0 + p.x / -p.z * scale, half - p.y / -p.z * scale]
}

/// The pixels of a line, each with the part of the way that its fragment carries.
fn drawn(ends: [Vec3; 2], interpolation: impl Interpolation) -> Vec<([f64; 2], f64)> {
    let (mut color, mut depth) = (vec![0; PIXELS], vec![(); PIXELS]);
    let vertices = [(ends[0], 0.0), (ends[1], 1.0)];
    let mesh = Mesh::new(&vertices, &[] as &[[u16; 3]], |&(v, t): &(Vec3, f32)| (v, t));
    let parts = RefCell::new(vec![]);
    let stage = |t: f32| {
        parts.borrow_mut().push(f64::from(t));
        Some(Rgba8::from_bits(u32::try_from(parts.borrow().len()).expect("few")))
    };
    let mut target = Target::new(Rgba8888, NoDepth, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
    let view = view();
    Pass::new(&view, &mesh, &stage).interpolation(interpolation).draw_lines(&mut target, [[0, 1]]);
    let parts = parts.into_inner();
    let place = |k: usize| [(k % WIDTH as usize) as f64 + 0.5, (k / WIDTH as usize) as f64 + 0.5];
    let found = color.iter().enumerate().filter(|(_, pixel)| **pixel != 0);
    found.map(|(k, pixel)| (place(k), parts[*pixel as usize - 1])).collect()
}

/// What of a line is between the near and the far plane, as parts of its way.
fn between([a, b]: [DVec3; 2]) -> Option<[f64; 2]> {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    let (za, zb) = (-a.z, -b.z);
    for (from, to) in
        [(za - f64::from(NEAR), zb - f64::from(NEAR)), (f64::from(FAR) - za, f64::from(FAR) - zb)]
    {
        let at = from / (from - to);
        if from < 0.0 && to < 0.0 {
            return None;
        } else if from < 0.0 {
            low = low.max(at);
        } else if to < 0.0 {
            high = high.min(at);
        }
    }
    (low < high).then_some([low, high])
}

fn lines_are_right(interpolation: impl Interpolation, stream: u64, step: f64) {
    let mut rng = Rng::stream(run_seed(), stream);
    let (mut pixels, mut cut) = (0, 0);
    for _ in 0..400 {
        let size = f64::from(rng.log_uniform(0.3, 40.0));
        let ends = [(); 2].map(|()| {
            let [x, y] = [(); 2].map(|()| rng.uniform(-size, size) as f32);
            Vec3::new(x, y, rng.uniform(-size, 0.3 * size) as f32)
        });
        let exact = ends.map(Vec3::as_dvec3);
        let found = drawn(ends, interpolation);
        let Some([low, high]) = between(exact) else {
            assert!(found.is_empty(), "{ends:?}");
            continue;
        };
        cut += u32::from(low > 0.0 || high < 1.0);
        let at = |t: f64| exact[0] + (exact[1] - exact[0]) * t;
        let [from, to] = [projected(at(low)), projected(at(high))];
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let axis = usize::from(dx.abs() < dy.abs());
        // Snapped by up to 1/512 pixel, and what is far beyond the frame is cut, which moves it as much.
        let slack = 0.02;
        for (place, part) in &found {
            let along = (place[axis] - from[axis]) / (to[axis] - from[axis]);
            let across = from[1 - axis] + along * (to[1 - axis] - from[1 - axis]);
            assert!((place[1 - axis] - across).abs() <= 0.5 + slack, "{ends:?} {place:?} {across}");
            // Along the screen 1/z is linear.
            let [qa, qb] = [-1.0 / at(low).z, -1.0 / at(high).z];
            let hyperbolic = along * qb / ((1.0 - along) * qa + along * qb);
            let exact_part = low + (high - low) * hyperbolic.clamp(0.0, 1.0);
            // The change along half a subpixel each way, and along a pixel that an end is in.
            let shift =
                slack * (high - low) * (qa.max(qb) / qa.min(qb)) / (to[axis] - from[axis]).abs().max(1.0);
            assert!((part - exact_part).abs() <= 2.0 * shift + step + 1e-5, "{ends:?} {part} {exact_part}");
        }
        // One for each column, or row, within the frame, but for the ends.
        let limit = f64::from([WIDTH, HEIGHT][axis]);
        let other = f64::from([WIDTH, HEIGHT][1 - axis]);
        let inside = |c: &i64| {
            let centre = *c as f64 + 0.5;
            let along = (centre - from[axis]) / (to[axis] - from[axis]);
            let across = from[1 - axis] + along * (to[1 - axis] - from[1 - axis]);
            (0.0..=1.0).contains(&along) && (0.0..other).contains(&across)
        };
        let expected = (0..limit as i64).filter(inside).count();
        assert!(found.len().abs_diff(expected) <= 3, "{ends:?}: {} pixels, {expected}", found.len());
        pixels += found.len();
    }
    assert!(pixels > 5000 && cut > 100, "{pixels} pixels, {cut} lines cut");
}

#[test]
fn lines_are_those_of_space() {
    lines_are_right(Exact, 1, 0.0);
    lines_are_right(FixedPoint(Spans16), 2, 1.0 / 32768.0);
}

/// A cube's wires, of which those behind it are hidden, and all others are on it.
#[test]
fn wires_are_seen_on_their_surface() {
    let corner = |k: usize| Vec3::new([-1.0, 1.0][k & 1], [-1.0, 1.0][k >> 1 & 1], [-1.0, 1.0][k >> 2]);
    let vertices: Vec<Vec3> = (0..8).map(corner).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5_u16]];
    let triangles: Vec<[u16; 3]> =
        faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    let mesh = Mesh::new(&vertices, &triangles, |v: &Vec3| (*v, ()));
    let view = Camera::look_at(Vec3::new(2.0, 2.6, 4.0), Vec3::ZERO, Vec3::Y).expect("a camera");
    let view = view.perspective(0.7, 0.5..20.0).expect("a view");
    let wires = |interpolation, solid: bool, constant: f32, slots: &mut [Slot<()>]| {
        let (mut color, mut depth) = (vec![0; PIXELS], vec![0.0; PIXELS]);
        let mut target =
            Target::new(Rgba8888, F32Reversed, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
        let by = |stage| Pass::new(&view, &mesh, stage).cull(Cull::None);
        if solid {
            by(Solid(Rgba8::BLACK)).draw(&mut target);
        }
        let slope = if constant == 0.0 { 0.0 } else { -1.0 };
        let mut upon = target.with_depth(Biased { format: F32Reversed, constant, slope, clamp: 0.0 });
        let mut touched = Touched::default();
        by(Solid(Rgba8::WHITE)).slots(slots).count_lines(&mut upon, mesh.edges(), &mut touched);
        let _: Exact = interpolation;
        let white: Vec<usize> = (0..PIXELS).filter(|k| color[*k] == u32::MAX).collect();
        for k in &white {
            let [column, row] = [k % WIDTH as usize, k / WIDTH as usize].map(|c| c as i32);
            assert!(touched.columns().contains(&column) && touched.rows().contains(&row));
        }
        white.len()
    };
    let all = wires(Exact, false, 0.0, &mut []);
    let seen = wires(Exact, true, -4.0, &mut []);
    let fighting = wires(Exact, true, 0.0, &mut []);
    assert_eq!(seen, wires(Exact, true, -4.0, &mut [Slot::EMPTY; 8]), "slots change pixels");
    // Nine of the twelve edges are seen, and three of the six diagonals.
    let part = seen as f64 / all as f64;
    assert!((0.6..0.8).contains(&part), "{seen} of {all}");
    assert!(fighting < seen * 9 / 10, "without a bias {fighting} of {seen} are seen");
}

/// A band's rows of a frame: colours and depths.
type Rows = (Vec<u32>, Vec<f32>);

/// Lines and points in bands of any heights, prepared or not, with any slots, have the bits of the whole frame. So they
/// do in rows that are further apart, and touch nothing between these.
fn bands_are_the_frame<M: Geometry<Varying = f32>>(mesh: &M, interpolation: impl Interpolation, seed: u64) {
    let mut rng = Rng::stream(run_seed(), seed);
    let view = view();
    let frame = Frame::at(Point3::new(Vec3::new(0.0, 0.0, -2.0)));
    let stage = |t: f32| Some(Rgba8::from_bits(t.to_bits() | 1));
    let upon = Biased { format: F32Reversed, constant: 3.0, slope: 1.0, clamp: 0.0 };
    let vertices = mesh.vertices();
    let mut room = vec![[0; 2]; 3 * mesh.triangles()];
    let edges = mesh.unique_edges(&mut room).expect("room for all").iter().copied();
    let mut frame_of = |slots: usize, height: usize, apart: usize, prepared: bool| -> Rows {
        let (row, stride) = (WIDTH as usize, WIDTH as usize + apart);
        let (mut color, mut depth) = (vec![0; stride * HEIGHT as usize], vec![0.0; PIXELS]);
        let mut slots = vec![Slot::EMPTY; slots];
        let pass = Pass::new(&view, mesh, &stage).at(frame).interpolation(interpolation);
        let mut pass = pass.slots(&mut slots);
        let bands = color.chunks_mut(height * stride).zip(depth.chunks_mut(height * row));
        let bands = bands.zip((0..).step_by(height));
        let band = |color, depth, top: u32| {
            let rows = top..HEIGHT.min(top + height as u32);
            Target::window(Rgba8888, upon, [WIDTH, HEIGHT], rows, stride, color, depth).expect("a band")
        };
        if prepared {
            let mut listed = vec![PreparedTriangle::EMPTY; rng.index(9)];
            let (mut prepared, _) = pass.count_prepare([WIDTH, HEIGHT], upon, &mut listed, &mut ());
            for ((color, depth), top) in bands {
                let mut band = band(color, depth, top);
                prepared.draw_lines(&mut band, edges.clone());
                prepared.draw_points(&mut band, 0..vertices, 3);
            }
        } else {
            for ((color, depth), top) in bands {
                let mut band = band(color, depth, top);
                pass.draw_lines(&mut band, edges.clone());
                pass.draw_points(&mut band, 0..vertices, 3);
            }
        }
        assert!(color.chunks(stride).flat_map(|pixels| &pixels[row..]).all(|&beside| beside == 0));
        (color.chunks(stride).flat_map(|pixels| &pixels[..row]).copied().collect(), depth)
    };
    let whole = frame_of(0, HEIGHT as usize, 0, false);
    assert!(whole.0.iter().filter(|pixel| **pixel != 0).count() > 1000);
    for (slots, height) in [(0, 8), (7, 8), (vertices, 8), (vertices, 1), (vertices + 3, 13), (vertices, 120)]
    {
        for prepared in [false, true] {
            let bits = |rows: &Rows| rows.1.iter().map(|depth| depth.to_bits()).collect::<Vec<_>>();
            let found = frame_of(slots, height, height % 5, prepared);
            assert!(found.0 == whole.0 && bits(&found) == bits(&whole), "{slots} {height} {prepared}");
        }
    }
}

#[test]
fn lines_in_bands_are_those_of_the_frame() {
    // A wide strip, some of whose vertices are behind the eye, beyond the far plane or far outside of the view.
    let mut rng = Rng::stream(run_seed(), 4);
    let vertices: Vec<(Vec3, f32)> = (0..60)
        .map(|_| {
            let size = f64::from(rng.log_uniform(0.5, 30.0));
            let [x, y, t] = [(); 3].map(|()| rng.uniform(-size, size) as f32);
            (Vec3::new(x, y, rng.uniform(-size, 2.4) as f32), t)
        })
        .collect();
    let triangles: Vec<[u16; 3]> = (0..58).map(|k| [k, k + 1, k + 2]).collect();
    let mesh = Mesh::new(&vertices, &triangles, |v: &(Vec3, f32)| *v);
    bands_are_the_frame(&mesh, Exact, 5);
    bands_are_the_frame(&mesh, FixedPoint(Spans16), 6);
}

/// Vertices of meshlets that face away are left out, but lines between them are drawn.
#[test]
fn lines_of_meshlets_are_drawn() {
    let vertices: Vec<(Vec3, f32)> = (0..42)
        .map(|k| {
            let angle = k as f32 * 0.15;
            let radius = if k % 2 == 0 { 0.5 } else { 0.9 };
            (Vec3::new(angle.cos() * radius, angle.sin() * radius, 0.0), angle)
        })
        .collect();
    // A ring, of which each half of the triangles faces another way.
    let triangles: Vec<[u16; 3]> = (0..40_u16)
        .map(|k| if (k % 2 == 0) == (k < 20) { [k, k + 1, k + 2] } else { [k + 1, k, k + 2] })
        .collect();
    let mesh = Mesh::new(&vertices, &triangles, |v: &(Vec3, f32)| *v);
    let ball = Ball::of(&mesh);
    let parts: Vec<Meshlet> =
        [0..10, 10..20, 20..30, 30..40].into_iter().map(|part| Meshlet::new(&mesh, &ball, part)).collect();
    let meshlets = Meshlets { mesh, meshlets: &parts, ball };
    bands_are_the_frame(&meshlets, Exact, 7);
    bands_are_the_frame(&meshlets, FixedPoint(Spans16), 7);
}

#[test]
fn unique_edges_are_a_set() {
    let mut rng = Rng::stream(run_seed(), 8);
    for round in 0..200_usize {
        let vertices = 3 + rng.index(12);
        let triangles: Vec<[u8; 3]> = (0..rng.index(40) + round % 2)
            .map(|_| [(); 3].map(|()| u8::try_from(rng.index(vertices)).expect("few")))
            .collect();
        let mesh = Mesh::new(&[Vec3::ZERO; 16], &triangles, |v: &Vec3| (*v, ()));
        let pairs = triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
        let expected: BTreeSet<[usize; 2]> = pairs
            .filter(|[a, b]| a != b)
            .map(|[a, b]| [usize::from(a.min(b)), usize::from(a.max(b))])
            .collect();
        let expected: Vec<[usize; 2]> = expected.into_iter().collect();
        for room in
            [3 * triangles.len(), expected.len(), expected.len() + 3, expected.len().saturating_sub(1)]
        {
            let mut room = vec![[7; 2]; room];
            let enough = room.len() >= expected.len();
            assert_eq!(mesh.unique_edges(&mut room), enough.then_some(&expected[..]));
        }
    }
}
