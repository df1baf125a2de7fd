//! The cost of lines, points and depth bias: a torus of 16,200 triangles in 1280x720 pixels, in floats.
//!
//! Before lines are timed, their pixels are held against the places of the vertices in `f64`, and those in bands
//! against the whole frame, from which they must not differ in a bit. Depths with a bias are held against those
//! without.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "places of pixels in a frame"
)]

use alberti::glam::{Mat3, Vec3};
use alberti::shaders::Solid;
use alberti::texture::surface::{Grid, Parametric, Torus};
use alberti::{
    Bands, Biased, Exact, F32, Frame, Geometry, Mesh, Object, Pass, Perspective, Point3, Rgba8, Rgba8888,
    Slot, Target, View,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 720;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;
const FOV: f32 = 0.66;

type Buffers = (Vec<u32>, Vec<f32>);

fn cleared() -> Buffers {
    (vec![0; PIXELS], vec![1.0; PIXELS])
}

/// The whole frame in those buffers.
fn whole((color, depth): &mut Buffers) -> Target<'_, Rgba8888, F32> {
    Target::new(Rgba8888, F32, WIDTH, HEIGHT, color, depth).expect("buffers that fit")
}

fn torus() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (torus, grid) = (Torus { major: 1.0, minor: 0.42 }, Grid::new(90, 90));
    let turned = Mat3::from_rotation_x(0.9);
    let places = (0..grid.vertices() as u32).map(|k| {
        let position: Point3<Object> = torus.orthonormal_frame(grid.uv(k)).origin();
        turned * position.coords + Vec3::Z * 4.2
    });
    let triangles = (0..grid.triangles() as u32).map(|k| {
        let [a, b, c] = grid.triangle(k);
        [a, c, b]
    });
    (places.collect(), triangles.collect())
}

/// A place on the screen, in pixels.
fn on_screen(place: Vec3) -> [f64; 2] {
    let [x, y, z] = place.to_array().map(f64::from);
    let half = f64::from(HEIGHT) / 2.0;
    let scale = half / (f64::from(FOV) / 2.0).tan();
    [f64::from(WIDTH) / 2.0 + x / z * scale, half - y / z * scale]
}

fn lines(criterion: &mut Criterion) {
    let (vertices, triangles) = torus();
    let mesh = Mesh::new(&vertices, &triangles, |v: &Vec3| (*v, ()));
    let lens = Perspective::new(FOV, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0).expect("a perspective");
    let view = View::new(Frame::IDENTITY, lens);
    let mut room = vec![[0; 2]; 3 * triangles.len()];
    let edges = mesh.unique_edges(&mut room).expect("room for all");
    let mut slots = vec![Slot::EMPTY; vertices.len()];
    let mut pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE)).interpolation(Exact).slots(&mut slots);
    let mut buffers = cleared();
    let mut group = criterion.benchmark_group("lines");
    let each = || edges.iter().copied();

    // Each pixel is within a half of an edge, across its longer axis, and each column of an edge has one.
    pass.draw_lines(&mut whole(&mut buffers), each());
    let expected = buffers.clone();
    let mut near = vec![false; PIXELS];
    for [a, b] in each() {
        let [p, q] = [a, b].map(|index| on_screen(vertices[index]));
        let axis = usize::from((p[0] - q[0]).abs() < (p[1] - q[1]).abs());
        let (low, high) = (p[axis].min(q[axis]), p[axis].max(q[axis]));
        for along in (low - 1.0).floor() as u32..(high + 1.0) as u32 {
            let centre = f64::from(along) + 0.5;
            let across = p[1 - axis] + (q[1 - axis] - p[1 - axis]) * (centre - p[axis]) / (q[axis] - p[axis]);
            let pixel = |across: f64| {
                let [column, row] = if axis == 0 { [along, across as u32] } else { [across as u32, along] };
                (row * WIDTH + column) as usize
            };
            let ends = [across - 0.02, across + 0.02].map(pixel);
            let inside = centre > low + 0.5 && centre < high - 0.5;
            assert!(!inside || ends.iter().any(|k| expected.0[*k] != 0), "an edge is not drawn");
            ends.iter().for_each(|k| near[*k] = true);
        }
    }
    let strange = (0..PIXELS).filter(|k| expected.0[*k] != 0 && !near[*k]).count();
    assert_eq!(strange, 0, "pixels are beside all edges");

    group.throughput(Throughput::Elements(edges.len() as u64));
    group.bench_function("whole", |bencher| {
        bencher.iter(|| {
            let mut target = whole(&mut buffers);
            target.clear(Rgba8::new(0, 0, 0, 0));
            pass.draw_lines(&mut target, each());
        });
    });
    for (name, prepare) in [("bands of 8 rows", true), ("bands of 8 rows, each anew", false)] {
        let mut frame = || {
            let (color, depth) = &mut buffers;
            let depth = &mut depth[..8 * WIDTH as usize];
            let mut bands = Bands::new(Rgba8888, F32, WIDTH, HEIGHT, color, depth).expect("bands");
            if prepare {
                let (mut prepared, _) = pass.prepare(&bands, &mut []);
                bands.draw(Rgba8::new(0, 0, 0, 0), |band| prepared.draw_lines(band, each()));
            } else {
                bands.draw(Rgba8::new(0, 0, 0, 0), |band| pass.draw_lines(band, each()));
            }
        };
        frame();
        group.bench_function(name, |bencher| bencher.iter(&mut frame));
        assert!(buffers.0 == expected.0, "{name}: other pixels");
    }

    // A point of a pixel about each vertex.
    let mut buffers = cleared();
    pass.draw_points(&mut whole(&mut buffers), 0..vertices.len(), 1);
    let pixel = |[x, y]: [f64; 2]| (y as u32 * WIDTH + x as u32) as usize;
    for vertex in &vertices {
        let [x, y] = on_screen(*vertex);
        // Places are rounded to subpixels, so that one near a border may be on either side of it.
        let near = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];
        let moved = near.map(|[right, down]| pixel([x + 0.004 * right, y + 0.004 * down]));
        assert!(moved.iter().any(|k| buffers.0[*k] != 0), "a point is not drawn");
    }
    group.throughput(Throughput::Elements(vertices.len() as u64));
    for size in [1, 4] {
        group.bench_function(format!("points {size}x{size}"), |bencher| {
            bencher.iter(|| {
                let mut target = whole(&mut buffers);
                target.clear(Rgba8::new(0, 0, 0, 0));
                pass.draw_points(&mut target, 0..vertices.len(), size);
            });
        });
    }
    group.finish();
}

/// Triangles whose depths have a bias, beside those without.
fn bias(criterion: &mut Criterion) {
    let (vertices, triangles) = torus();
    let mesh = Mesh::new(&vertices, &triangles, |v: &Vec3| (*v, ()));
    let lens = Perspective::new(FOV, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0).expect("a perspective");
    let view = View::new(Frame::IDENTITY, lens);
    let mut slots = vec![Slot::EMPTY; vertices.len()];
    let mut pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE)).slots(&mut slots);
    let mut plain = cleared();
    pass.draw(&mut whole(&mut plain));
    let mut group = criterion.benchmark_group("bias");
    group.throughput(Throughput::Elements(triangles.len() as u64));
    for (name, constant, slope) in
        [("none", 0.0, 0.0), ("constant", 1000.0, 0.0), ("slope", 0.0, 1.0), ("both", 1000.0, 1.0)]
    {
        let biased = Biased { format: F32, constant, slope, clamp: 0.0 };
        let mut buffers = cleared();
        let frame = |buffers: &mut Buffers, pass: &mut Pass<'_, _, _>| {
            let mut target = whole(buffers);
            target.clear(Rgba8::new(0, 0, 0, 0));
            if constant == 0.0 && slope == 0.0 {
                pass.draw(&mut target);
            } else {
                pass.draw(&mut target.with_depth(biased));
            }
        };
        frame(&mut buffers, &mut pass);
        assert!(buffers.0 == plain.0, "{name}: a bias moves pixels");
        // Steps of depths from 1/2 to 1 are 2^-24; a slope is never towards the eye.
        let least = f64::from(constant) / 16_777_216.0 - 3e-7;
        let pairs = buffers.1.iter().zip(&plain.1).zip(&plain.0).filter(|(_, color)| **color != 0);
        let most = if slope == 0.0 { f64::from(constant) / 16_777_216.0 + 3e-7 } else { 1.0 };
        for ((found, without), _) in pairs {
            let farther = f64::from(*found) - f64::from(*without);
            assert!((least..=most).contains(&farther), "{name}: {farther}");
        }
        group.bench_function(name, |bencher| bencher.iter(|| frame(black_box(&mut buffers), &mut pass)));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(2));
    targets = lines, bias
}
criterion_main!(benches);
