//! Instructions of frames of 320x240, and of parts of the pipeline alone, by valgrind: repeatable where times are not.
//!
//! `cargo xtask bench counts` runs this and compares with `benches/results/counts.csv`. A frame's picture is held
//! against rays in `f64` before the frame is counted, and what a part returns against plain formulas; memory and
//! vertices are in place by then.
#![allow(missing_docs, reason = "macros that make functions")]
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "texels"
)]

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::Machine;
use alberti::projection::{EyeVertex, clip_near_far};
use alberti::texture::{Bilinear, Gradient, Mipmap, Nearest, Repeat, Trilinear, mipmap};
use alberti::{Eye, Point3, Rgba8, Rgba8888};
use alberti_benches::reference::Sparse;
use alberti_benches::scene_data::{SCENES, Scene};
use alberti_benches::stones::{SIDE, Stones, bilinear, nearest, trilinear};
use alberti_benches::{Renderer, SIZES, ours, pavement, reference};
use gungraun::{library_benchmark, library_benchmark_group, main};

/// The pixels that are looked at.
const RAYS: usize = 1000;
/// The part of them that may be off: a picture of so few pixels has a few edges.
const OFF: f64 = 0.005;

/// A renderer that has drawn a frame, which was right.
fn drawn(name: &str, policy: &str) -> Box<dyn Renderer> {
    assert!(matches!(Machine::all().next(), Some(Machine::Avx2(_))), "counts are those of AVX2");
    let size = SIZES[0];
    let found = SCENES.into_iter().find(|scene| scene.0 == name);
    let scene = found.map_or_else(Scene::normal_mapped, Scene::load);
    let mut renderer = ours::renderer(policy, &scene, size).expect("a policy that draws the scene");
    renderer.render();
    if ours::is_right(policy) {
        let off = match &scene.stones {
            None => Sparse::new(&scene, size, RAYS).part_off(renderer.pixels()),
            Some(stones) => reference::part_off(renderer.pixels(), &pavement::picture(&scene, stones, size)),
        };
        assert!(off < OFF, "{name} {policy}: {off} of the pixels are off");
    }
    renderer
}

#[library_benchmark]
#[bench::fill_exact(args = ("fill", "Exact"), setup = drawn)]
#[bench::fill_planes(args = ("fill", "Planes"), setup = drawn)]
#[bench::fill_spans(args = ("fill", "Spans16"), setup = drawn)]
#[bench::bilinear_exact(args = ("fill-bilinear", "Exact"), setup = drawn)]
#[bench::bilinear_app(args = ("fill-bilinear", "App"), setup = drawn)]
#[bench::mesh_exact(args = ("mesh", "Exact"), setup = drawn)]
#[bench::mesh_planes(args = ("mesh", "Planes"), setup = drawn)]
#[bench::mesh_spans(args = ("mesh", "Spans16"), setup = drawn)]
#[bench::mesh_affine(args = ("mesh", "Affine"), setup = drawn)]
#[bench::mesh_slots(args = ("mesh", "Exact-without-slots"), setup = drawn)]
#[bench::mesh_bands(args = ("mesh", "Exact-by-bands"), setup = drawn)]
#[bench::mesh_app(args = ("mesh", "App"), setup = drawn)]
#[bench::gouraud_exact(args = ("gouraud", "Exact"), setup = drawn)]
#[bench::gouraud_planes(args = ("gouraud", "Planes"), setup = drawn)]
#[bench::gouraud_affine(args = ("gouraud", "Affine"), setup = drawn)]
#[bench::floor_exact(args = ("floor", "Exact"), setup = drawn)]
#[bench::floor_spans(args = ("floor", "Spans16"), setup = drawn)]
#[bench::pavement_exact(args = ("normal-mapped", "Exact"), setup = drawn)]
#[bench::pavement_planes(args = ("normal-mapped", "Planes"), setup = drawn)]
fn frame(mut renderer: Box<dyn Renderer>) -> Box<dyn Renderer> {
    renderer.render();
    renderer
}

/// How often a part is called.
const CALLS: u32 = 4096;

/// A level of detail between two levels, for a square map.
const LAMBDA: f32 = 1.25;

type Texels = Vec<[u8; 4]>;

/// The colour map, and the places where it is read, all over it and beside it.
fn map() -> (Texels, Vec<Vec2>) {
    let place = |k: u32| Vec2::new(k as f32 * 0.618_034 - 900.0, k as f32 * 0.002_7 - 3.0);
    (Stones::new().color, (0..CALLS).map(place).collect())
}

fn samples(filter: &str, (texels, places): &(Texels, Vec<Vec2>)) -> Vec<Rgba8> {
    let levels =
        Mipmap::new(Rgba8888, texels, SIDE, SIDE).expect("a map").power_of_two().expect("its sides are");
    let level = levels.level(0);
    let step = LAMBDA.exp2() / SIDE as f32;
    let gradient = Gradient { dx: [step, 0.0], dy: [0.0, step] };
    let places = places.iter().copied();
    match filter {
        "nearest" => places.map(|uv| level.sampler(Nearest, Repeat).sample(uv)).collect(),
        "bilinear" => places.map(|uv| level.sampler(Bilinear, Repeat).sample(uv)).collect(),
        _ => places.map(|uv| levels.sampler(Trilinear, Repeat).sample_grad(uv, gradient)).collect(),
    }
}

/// A map, of which a filter reads what it should.
fn sampled(filter: &'static str) -> (&'static str, (Texels, Vec<Vec2>)) {
    let map = map();
    for (uv, sample) in map.1.iter().zip(samples(filter, &map)) {
        let right = match filter {
            "nearest" => nearest(&map.0, uv.as_dvec2()),
            "bilinear" => bilinear(&map.0, 0, uv.as_dvec2()),
            _ => trilinear(&map.0, uv.as_dvec2(), f64::from(LAMBDA)),
        };
        let off = right.iter().zip(sample.to_bytes()).map(|(a, b)| (a - f64::from(b)).abs());
        assert!(off.fold(0.0, f64::max) < 1.5, "{filter} at {uv}: {sample:?}, expected {right:?}");
    }
    (filter, map)
}

#[library_benchmark]
#[bench::nearest(args = ("nearest"), setup = sampled)]
#[bench::bilinear(args = ("bilinear"), setup = sampled)]
#[bench::trilinear(args = ("trilinear"), setup = sampled)]
fn sample((filter, map): (&'static str, (Texels, Vec<Vec2>))) -> Vec<Rgba8> {
    samples(filter, &map)
}

/// A triangle whose first corner alone is before the near plane.
fn crossing(k: u32) -> [EyeVertex<Vec2>; 3] {
    let part = |n: u32| (k * n % 997) as f32 / 997.0;
    let corner =
        |x, y, z| EyeVertex { position: Point3::<Eye>::new(Vec3::new(x, y, z)), varying: Vec2::new(x, y) };
    [
        corner(part(7), part(31), 0.9 * part(57)),
        corner(2.0 + part(71), part(13), 1.1 + part(91)),
        corner(part(3), 2.0 + part(29), 1.1 + part(17)),
    ]
}

/// Triangles, of which the clipper leaves the right area: by similar triangles, all but the product of the shares of
/// two sides.
fn clipped() -> Vec<[EyeVertex<Vec2>; 3]> {
    let triangles: Vec<_> = (0..CALLS).map(crossing).collect();
    for triangle in &triangles {
        let area = |corners: &[EyeVertex<Vec2>]| {
            let fan = corners.windows(2).skip(1);
            let first = corners[0].varying.as_dvec2();
            let parts = fan.map(|pair| {
                let [a, b] = [0, 1].map(|k| pair[k].varying.as_dvec2() - first);
                a.perp_dot(b) / 2.0
            });
            parts.sum::<f64>()
        };
        let share = |k: usize| {
            let [z, other] = [0, k].map(|k| f64::from(triangle[k].position.coords.z));
            (1.0 - z) / (other - z)
        };
        let right = area(triangle) * (1.0 - share(1) * share(2));
        let polygon = clip_near_far(*triangle, 1.0, 4.0);
        assert!((area(polygon.vertices()) - right).abs() < 1e-5, "{triangle:?}");
    }
    triangles
}

#[library_benchmark]
#[bench::near(args = (), setup = clipped)]
fn clip(triangles: Vec<[EyeVertex<Vec2>; 3]>) -> usize {
    triangles.into_iter().map(|triangle| clip_near_far(triangle, 1.0, 4.0).vertices().len()).sum()
}

/// The map's first level, with room for the others. Its smallest is the mean of its light.
fn unbuilt() -> Texels {
    let texels = Stones::new().color;
    let first = &texels[..(SIDE * SIDE) as usize];
    for channel in 0..3 {
        let light = |texel: &[u8; 4]| match f64::from(texel[channel]) / 255.0 {
            byte if byte <= 0.040_45 => byte / 12.92,
            byte => ((byte + 0.055) / 1.055).powf(2.4),
        };
        let mean = first.iter().map(light).sum::<f64>() / first.len() as f64;
        let [found, right] = [light(&texels[texels.len() - 1]), mean];
        assert!((found - right).abs() < 0.01, "{channel}: {found}, expected {right}");
    }
    texels
}

#[library_benchmark]
#[bench::build(args = (), setup = unbuilt)]
fn mip_maps(mut texels: Texels) -> Texels {
    mipmap::build(Rgba8888, &mut texels, SIDE, SIDE).expect("levels");
    texels
}

library_benchmark_group!(name = frames, benchmarks = frame);
library_benchmark_group!(name = parts, benchmarks = [sample, clip, mip_maps]);
main!(library_benchmark_groups = [frames, parts]);
