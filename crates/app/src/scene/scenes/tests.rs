//! Tests of the built-in scenes: the promises of all, and the purpose of each.

use super::build::{Vec3, cross, dot, sub, unit};
use super::{BuiltIn, NAMES, by_name, trials};
use crate::scene::Camera;
use std::collections::HashMap;

fn scene(name: &str) -> BuiltIn {
    by_name(name).unwrap_or_else(|| panic!("no scene {name}"))
}

fn triangles(scene: &BuiltIn) -> Vec<[u32; 3]> {
    scene.model.parts.iter().flat_map(|part| part.triangles.iter().copied()).collect()
}

#[test]
fn scenes_are_well_formed() {
    for name in NAMES {
        let scene = scene(name);
        let model = &scene.model;
        assert!(!triangles(&scene).is_empty(), "{name} is empty");
        for t in triangles(&scene) {
            assert!(t.iter().all(|&i| (i as usize) < model.vertices.len()), "{name}: index out of range");
        }
        for v in &model.vertices {
            let n = v.normal.map(f64::from);
            assert!((dot(n, n) - 1.0).abs() < 1e-6, "{name}: normal {n:?}");
            assert!(v.position.iter().chain(&v.uv).all(|c| c.is_finite()), "{name}: {v:?}");
            assert!(v.color.iter().all(|c| (0.0..=1.0).contains(c)), "{name}: {v:?}");
        }
        for part in &model.parts {
            assert!(part.texture.is_none_or(|t| t < model.textures.len()), "{name}: {}", part.name);
        }
        for image in &model.textures {
            assert_eq!(image.texels.len(), (image.width * image.height) as usize, "{name}");
        }
        assert!(scene.camera.near > 0.0 && scene.camera.near < scene.camera.far, "{name}");
    }
}

#[test]
fn unknown_names_are_refused() {
    assert!(by_name("").is_none());
    assert!(by_name("Hero").is_none());
}

#[test]
fn faces_are_wound_to_the_side_of_their_normals() {
    for name in NAMES {
        let scene = scene(name);
        for part in &scene.model.parts {
            // The landscape's normals are those of its light.
            if part.name == "landscape" {
                continue;
            }
            for t in &part.triangles {
                let v = t.map(|i| scene.model.vertices[i as usize]);
                let [a, b, c] = v.map(|v| v.position.map(f64::from));
                let face = cross(sub(b, a), sub(c, a));
                assert!(dot(face, face) > 0.0, "{name}, {}: a triangle without area", part.name);
                for v in v {
                    let facing = dot(unit(face), v.normal.map(f64::from));
                    assert!(facing > 0.0, "{name}, {}: {facing} at {:?}", part.name, v.position);
                }
            }
        }
    }
}

/// The number of times that each directed edge occurs, vertices being the same if their positions are, bit for bit.
fn edges(scene: &BuiltIn) -> HashMap<([u32; 3], [u32; 3]), u32> {
    let mut count = HashMap::new();
    for t in triangles(scene) {
        // Adding zero turns -0 into 0.
        let key = |k: usize| scene.model.vertices[t[k % 3] as usize].position.map(|c| (c + 0.0).to_bits());
        for k in 0..3 {
            *count.entry((key(k), key(k + 1))).or_insert(0) += 1;
        }
    }
    count
}

#[test]
fn meshes_are_closed() {
    for name in ["mesh", "gouraud", "cube", "inside"] {
        let edges = edges(&scene(name));
        for (&(from, to), &times) in &edges {
            assert_eq!(times, 1, "{name}: an edge belongs to two triangles on the same side");
            assert_eq!(edges.get(&(to, from)), Some(&1), "{name}: an edge without an opposite");
        }
    }
}

#[test]
fn triangle_counts_are_as_documented() {
    let count = |name| triangles(&scene(name)).len();
    assert_eq!(count("fill"), 32);
    assert_eq!(count("mesh"), 5_900);
    assert_eq!(count("gouraud"), 69_312);
    assert_eq!(count("floor"), 2);
    assert_eq!(count("cube"), 12);
    assert!((4_000..10_000).contains(&count("hero")), "{}", count("hero"));
}

#[test]
fn about_64_percent_of_fill_passes_the_depth_test() {
    let camera = scene("fill").camera;
    let half = (f64::from(camera.fov).to_radians() / 2.0).tan();
    for (aspect, low, high) in [(4.0 / 3.0, 0.62, 0.68), (16.0 / 9.0, 0.60, 0.66)] {
        let (mut pass, mut all) = (0_u32, 0_u32);
        for y in 0..90 {
            for x in 0..160 {
                let sx = (2.0 * (f64::from(x) + 0.5) / 160.0 - 1.0) * half * aspect;
                let sy = (1.0 - 2.0 * (f64::from(y) + 0.5) / 90.0) * half;
                let mut nearest = 0.0;
                for i in 0..trials::LAYERS {
                    let [a, b, d] = trials::layer(i);
                    let q = (1.0 + a * sx + b * sy) / d;
                    assert!(1.0 / q > f64::from(camera.near) && 1.0 / q < f64::from(camera.far));
                    pass += u32::from(q > nearest);
                    all += 1;
                    nearest = q.max(nearest);
                }
            }
        }
        let share = f64::from(pass) / f64::from(all);
        assert!((low..high).contains(&share), "{share} at an aspect of {aspect}");
    }
}

/// A point's excess over the six planes of the view volume at an aspect of 4:3: positive inside.
fn inside_planes(camera: &Camera, p: Vec3) -> [f64; 6] {
    let [eye, target, up] = [camera.eye, camera.target, camera.picture_up()].map(|v| v.map(f64::from));
    let forward = unit(sub(target, eye));
    let right = unit(cross(forward, up));
    let [x, y, z] = [right, cross(right, forward), forward].map(|axis| dot(axis, sub(p, eye)));
    let half = (f64::from(camera.fov).to_radians() / 2.0).tan();
    let (w, h) = (z * half * 4.0 / 3.0, z * half);
    [z - f64::from(camera.near), f64::from(camera.far) - z, w - x, w + x, h - y, h + y]
}

#[test]
fn inside_crosses_every_plane_within_the_view_volume() {
    let scene = scene("inside");
    let mut crossings = [0; 6];
    for t in triangles(&scene) {
        let corners = t.map(|i| scene.model.vertices[i as usize].position.map(f64::from));
        // A fine grid on the triangle: some points within all other planes lie on either side of the one.
        let mut seen = [[false; 2]; 6];
        const STEPS: u32 = 24;
        for i in 0..=STEPS {
            for j in 0..=STEPS - i {
                let weights = [i, j, STEPS - i - j].map(|k| f64::from(k) / f64::from(STEPS));
                let p = [0, 1, 2].map(|axis| (0..3).map(|k| weights[k] * corners[k][axis]).sum());
                let excess = inside_planes(&scene.camera, p);
                for plane in 0..6 {
                    if (0..6).all(|other| other == plane || excess[other] >= 0.0) {
                        seen[plane][usize::from(excess[plane] >= 0.0)] = true;
                    }
                }
            }
        }
        for plane in 0..6 {
            crossings[plane] += u32::from(seen[plane] == [true; 2]);
        }
    }
    assert!(
        crossings.iter().all(|&n| n >= 3),
        "triangles across near, far, right, left, top, bottom: {crossings:?}"
    );
}

#[test]
fn floor_passes_behind_the_eye() {
    let scene = scene("floor");
    let depths =
        scene.model.vertices.iter().map(|v| inside_planes(&scene.camera, v.position.map(f64::from))[0]);
    let (low, high) = depths.fold((f64::MAX, f64::MIN), |(l, h), z| (l.min(z), h.max(z)));
    assert!(low < -1.0 && high > f64::from(scene.camera.far), "{low}..{high}");
}

#[test]
fn scenes_are_deterministic() {
    for name in ["fill", "mesh", "cube", "inside"] {
        assert_eq!(scene(name).model, scene(name).model, "{name}");
    }
}
