//! Counts and depths of whole scenes, and of layers that are known.

use crate::{options, policies};
use alberti::{Rgba8888, Target};
use alberti_app::options::{Arithmetic, DepthFormat, Profile, RenderOptions};
use alberti_app::probe::{Run, probe};
use alberti_app::render::{any_depth, draw};
use alberti_app::scene::{Camera, Model, Part, Slide, Vertex};
use alberti_app::scenes;
use std::num::NonZero;

/// The depth buffer and the counts of the picture itself.
fn picture(model: &Model, camera: &Camera, options: &RenderOptions) -> (Vec<u32>, alberti::Stats) {
    let pixels = (options.width * options.height) as usize;
    let (mut color, mut depth) = (vec![0; pixels], vec![0; pixels]);
    let (width, height) = (options.width, options.height);
    let format = any_depth(options.depth);
    let mut target = Target::new(Rgba8888, format, width, height, &mut color, &mut depth).expect("a target");
    // A triangle counts once, and fragments as often, for one thread.
    let alone = RenderOptions { threads: NonZero::<usize>::MIN, ..*options };
    let stats = draw(model, camera, &alone, &mut target, &mut |_, _| {}).expect("a picture");
    (depth, stats)
}

#[test]
fn depths_and_counts_are_those_of_the_picture() {
    let float = |name| (policies(name, Arithmetic::Float), DepthFormat::F32);
    let fixed = |name| (policies(name, Arithmetic::Fixed), DepthFormat::U24);
    let profile = |profile: Profile| profile.policies();
    for (name, choice) in [
        ("hero", float("exact")),
        ("hero", profile(Profile::Mcu)),
        ("floor", float("bounded:0.25")),
        ("floor", fixed("bounded:0.25")),
        ("mesh", profile(Profile::Reference)),
        ("mesh", profile(Profile::Mcu)),
        ("fill", profile(Profile::Tiny)),
        ("gouraud", (policies("plane", Arithmetic::Float), DepthFormat::U16)),
        ("inside", fixed("spans:8")),
    ] {
        let scene = scenes::by_name(name).expect("a scene");
        let plain = options((160, 120), choice.0, choice.1);
        let options =
            RenderOptions { shading: scene.shading, filter: scene.filter, cull: scene.cull, ..plain };
        let (depth, stats) = picture(&scene.model, &scene.camera, &options);
        let probes = probe(&scene.model, &scene.camera, &options).expect("probes");
        assert!((0..probes.pixels()).all(|index| probes.depth(index) == depth[index]), "{name} {choice:?}");
        let sum = |of: &dyn Fn(usize) -> u32| (0..depth.len()).map(|index| u64::from(of(index))).sum::<u64>();
        assert_eq!(sum(&|index| probes.shaded(index)), stats.written, "{name} {choice:?}");
        assert_eq!(sum(&|index| probes.covered(index)), stats.fragments, "{name} {choice:?}");
        let all: usize = scene.model.parts.iter().map(|part| part.triangles.len()).sum();
        let seen = (0..depth.len()).filter_map(|index| probes.seen(index));
        assert!(seen.into_iter().all(|seen| (seen.triangle as usize) < all));
    }
}

/// Squares that face a camera at the origin, at these distances, each a part; the n-th 8n + 16 pixels wide.
fn layers(distances: &[f32]) -> (Model, Camera) {
    let mut model = Model::default();
    for (n, &z) in (0u8..).zip(distances) {
        let half = f32::from(8 * n + 16) / 64.0 * z;
        let first = model.vertices.len() as u32;
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        model.vertices.extend(
            corners
                .map(|[x, y]: [f32; 2]| Vertex { position: [x * half, y * half, -z], ..Vertex::default() }),
        );
        let triangles = vec![[first, first + 1, first + 2], [first, first + 2, first + 3]];
        model.parts.push(Part { triangles, ..Part::default() });
    }
    let (eye, target, up) = ([0.0; 3], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]);
    (model, Camera { eye, target, up, roll: 0.0, fov: 90.0, near: 0.5, far: 50.0 })
}

#[test]
fn overdraw_of_known_layers() {
    let size = (64, 64);
    // The layers in which a pixel is: the n-th square reaches 4n + 8 pixels from the middle.
    let inside = |index: usize, n: u32| {
        let reach = |c: usize| (c as f64 + 0.5 - 32.0).abs();
        reach(index % 64).max(reach(index / 64)) < f64::from(4 * n + 8)
    };
    let at = |distances: &[f32], depth| {
        let (model, camera) = layers(distances);
        let options = options(size, policies("exact", Arithmetic::Float), depth);
        probe(&model, &camera, &options).expect("probes")
    };
    let count = |index: usize| (0..4).filter(|&n| inside(index, n)).count() as u32;
    let nearer = at(&[8.0, 7.0, 6.0, 5.0], DepthFormat::F32);
    let farther = at(&[5.0, 6.0, 7.0, 8.0], DepthFormat::F32);
    let blind = at(&[5.0, 6.0, 7.0, 8.0], DepthFormat::None);
    for index in 0..64 * 64 {
        let arrived = count(index);
        assert_eq!([nearer.covered(index), nearer.shaded(index)], [arrived; 2], "{index}");
        assert_eq!([farther.covered(index), farther.shaded(index)], [arrived, arrived.min(1)], "{index}");
        assert_eq!([blind.covered(index), blind.shaded(index)], [arrived; 2], "{index}");
        // The last that passed: the nearest, or without depths the last; both are the largest here or the smallest.
        let part = |seen: Option<alberti_app::probe::Seen>| seen.map(|seen| seen.part);
        let smallest = (0..4).find(|&n| inside(index, n)).map(|n| n as usize);
        let largest = smallest.map(|_| 3);
        assert_eq!(part(nearer.seen(index)), largest, "{index}");
        assert_eq!(part(farther.seen(index)), smallest, "{index}");
        assert_eq!(part(blind.seen(index)), largest, "{index}");
        assert!(nearer.seen(index).is_none_or(|seen| seen.uv.is_none() && seen.lod.is_none()));
        assert!(blind.seen(index).is_none_or(|seen| seen.zs.is_none()));
    }
}

/// Small ones in fixed point have no runs, but large ones have: a side of 32 pixels on the coarse grid divides them.
#[test]
fn small_triangles_in_fixed_point_are_one_run() {
    let (small, depth) = Profile::Mcu.policies();
    let (model, camera) = layers(&[5.0]);
    for (side, expected) in [(20, true), (200, false)] {
        let probes = probe(&model, &camera, &options((side, side), small, depth)).expect("probes");
        let runs: Vec<_> =
            (0..probes.pixels()).filter_map(|k| probes.seen(k)).filter_map(|s| s.run).collect();
        assert!(!runs.is_empty());
        assert!(runs.iter().all(|run| (*run == Run::Triangle) == expected), "{side}");
    }
}

/// The image of a projector takes the place in which a triangle's number travels: that comes from a second drawing.
#[test]
fn triangles_under_a_projector_are_the_same() {
    let scene = scenes::by_name("mesh").expect("a scene");
    let projector = Camera { fov: 60.0, ..scene.camera };
    let slide = Some(Slide { image: scene.model.textures[0].clone(), projector });
    let lit = Model { slide, ..scene.model.clone() };
    let options = options((120, 90), policies("exact", Arithmetic::Float), DepthFormat::F32);
    let [with, without] =
        [&lit, &scene.model].map(|model| probe(model, &scene.camera, &options).expect("probes"));
    let triangles = |probes: &alberti_app::probe::Probes| {
        (0..probes.pixels()).map(|k| probes.seen(k).map(|seen| seen.triangle)).collect::<Vec<_>>()
    };
    let expected = triangles(&without);
    assert_eq!(triangles(&with), expected);
    assert!(expected.iter().flatten().collect::<std::collections::HashSet<_>>().len() > 500);
}
