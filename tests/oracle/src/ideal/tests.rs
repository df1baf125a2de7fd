//! Both renderers against formulas for simple scenes, and against each other on random ones.

use super::*;
use crate::image::{compare, compare_coverage, compare_where};
use crate::rng::{Rng, run_seed};
use crate::scene::{Camera, Cull, Filter, Part, Shading, Texture, Vertex, Wrap};
use crate::snapped::render_snapped;

const CAMERA: Camera =
    Camera { eye: [0.0; 3], target: [0.0, 0.0, -1.0], up: [0.0, 1.0, 0.0], fov: 90.0, near: 0.5, far: 100.0 };

fn vertex(position: [f64; 3], color: [f64; 3]) -> Vertex {
    Vertex { position, normal: [0.0, 0.0, 1.0], uv: [position[0], -position[2]], color }
}

fn scene<'a>(vertices: &'a [Vertex], parts: &'a [Part<'a>]) -> Scene<'a> {
    Scene {
        vertices,
        parts,
        textures: &[],
        camera: CAMERA,
        width: 64,
        height: 48,
        cull: Cull::Back,
        shading: Shading::Unlit,
        filter: Filter::Nearest,
        wrap: Wrap::Repeat,
        background: [1, 2, 3],
    }
}

fn part<'a>(triangles: &'a [[u32; 3]], diffuse: [f64; 3]) -> Part<'a> {
    Part { triangles, diffuse, texture: None }
}

/// A triangle in a plane of constant depth, counter-clockwise as seen, that fills the picture.
fn wall(z: f64) -> [Vertex; 3] {
    [[-9.0, -9.0], [9.0, -9.0], [0.0, 20.0]].map(|[x, y]| vertex([x * z, y * z, -z], [1.0; 3]))
}

#[test]
fn a_wall_fills_the_picture_at_its_distance() {
    let vertices = wall(5.0);
    let parts = [part(&[[0, 1, 2]], [1.0, 0.5, 0.0])];
    let scene = scene(&vertices, &parts);
    for image in [render_ideal(&scene), render_snapped(&scene, 8)] {
        assert_eq!(image.pixels.len(), 64 * 48);
        assert!(image.covered.iter().all(|&c| c));
        assert!(image.pixels.iter().all(|&p| p == [255, 128, 0, 255]));
        assert!(image.depth.iter().all(|z| (z - 5.0).abs() < 1e-9));
    }
}

#[test]
fn clockwise_faces_are_the_back() {
    let vertices = wall(5.0);
    for (triangle, kept) in [([0, 1, 2], Cull::Back), ([0, 2, 1], Cull::Front)] {
        let triangles = [triangle];
        let parts = [part(&triangles, [1.0; 3])];
        for cull in [Cull::Back, Cull::Front, Cull::None] {
            let scene = Scene { cull, ..scene(&vertices, &parts) };
            let drawn = cull == kept || cull == Cull::None;
            for image in [render_ideal(&scene), render_snapped(&scene, 4)] {
                assert!(image.covered.iter().all(|&c| c == drawn));
                if !drawn {
                    assert_eq!(image.pixels[7], [1, 2, 3, 255]);
                    assert!(image.depth[7].is_infinite());
                }
            }
        }
    }
}

#[test]
fn the_nearest_wins_and_of_equals_the_first() {
    let vertices = [wall(5.0), wall(3.0), wall(3.0), wall(0.4), wall(101.0)].concat();
    let parts = [
        part(&[[0, 1, 2]], [1.0, 0.0, 0.0]),
        part(&[[3, 4, 5]], [0.0, 1.0, 0.0]),
        part(&[[6, 7, 8]], [0.0, 0.0, 1.0]),
        // Before the near plane, and beyond the far one.
        part(&[[9, 10, 11], [12, 13, 14]], [1.0; 3]),
    ];
    let scene = scene(&vertices, &parts);
    for image in [render_ideal(&scene), render_snapped(&scene, 8)] {
        assert!(image.pixels.iter().all(|&p| p == [0, 255, 0, 255]));
    }
}

/// A floor one unit below the eye, which reaches far behind it.
fn floor() -> [Vertex; 3] {
    [[-300.0, 40.0], [300.0, 40.0], [0.0, -3000.0]].map(|[x, z]| vertex([x, -1.0, z], [x, 0.5, 0.5]))
}

#[test]
fn a_floor_through_the_eye_plane_is_seen_where_the_rays_meet_it() {
    let vertices = floor();
    let texels: Vec<[u8; 4]> = (0..64u8).map(|i| [i % 8 * 30, i / 8 * 30, 0, 255]).collect();
    let textures = [Texture { width: 8, height: 8, texels: &texels }];
    let parts = [Part { triangles: &[[0, 1, 2]], diffuse: [1.0; 3], texture: Some(0) }];
    let scene = Scene { textures: &textures, ..scene(&vertices, &parts) };
    let (ideal, snapped) = (render_ideal(&scene), render_snapped(&scene, 8));
    let mut checked = 0;
    for y in 0..48 {
        for x in 0..64 {
            let index = y * 64 + x;
            // At 90 degrees: ye/ze = 1 - 2(y + 0.5)/48, and the floor is at ye = -1.
            let slope = 2.0 * (y as f64 + 0.5) / 48.0 - 1.0;
            let z = 1.0 / slope;
            let visible = slope > 0.0 && (0.5..=100.0).contains(&z);
            assert_eq!(ideal.covered[index], visible, "pixel {x}, {y}");
            assert_eq!(snapped.covered[index], visible, "pixel {x}, {y}");
            if !visible {
                continue;
            }
            assert!((ideal.depth[index] / z - 1.0).abs() < 1e-9);
            // Snapping shifts the floor by up to half a subpixel, over a slope of at least half a pixel row.
            assert!((snapped.depth[index] / z - 1.0).abs() < 0.01);
            let u = (2.0 * (x as f64 + 0.5) / 64.0 - 1.0) * 64.0 / 48.0 * z;
            let column = (u * 8.0).floor();
            let row = ((1.0 - z) * 8.0).floor();
            if (u * 8.0 - column - 0.5).abs() > 0.499 || ((1.0 - z) * 8.0 - row - 0.5).abs() > 0.499 {
                continue;
            }
            let texel = row.rem_euclid(8.0) * 8.0 + column.rem_euclid(8.0);
            assert_eq!(ideal.pixels[index], texels[texel as usize], "pixel {x}, {y}");
            checked += 1;
        }
    }
    assert!(checked > 1_000, "only {checked} texels");
}

#[test]
fn a_mesh_has_no_cracks_for_either_renderer() {
    let mut rng = Rng::new(run_seed());
    for _ in 0..20 {
        // A rugged wall of shared vertices, some of them exactly where pixel centres are.
        let mut vertices = Vec::new();
        for row in 0..13 {
            for column in 0..13 {
                let z = rng.uniform(3.0, 9.0);
                let jitter = [rng.uniform(-0.4, 0.4), rng.uniform(-0.4, 0.4)];
                let jitter = if rng.one_in(4) { [0.0; 2] } else { jitter };
                let x = (f64::from(column) - 6.0 + jitter[0]) * z * 0.25;
                let y = (f64::from(row) - 6.0 + jitter[1]) * z * 0.25;
                vertices.push(vertex([x, y, -z], [1.0; 3]));
            }
        }
        let mut triangles = Vec::new();
        for row in 0..12u32 {
            for column in 0..12u32 {
                let a = row * 13 + column;
                triangles.extend([[a, a + 1, a + 14], [a, a + 14, a + 13]]);
            }
        }
        let parts = [part(&triangles, [1.0; 3])];
        let scene = scene(&vertices, &parts);
        for image in [render_ideal(&scene), render_snapped(&scene, 8), render_snapped(&scene, 2)] {
            let missing = image.covered.iter().filter(|&&c| !c).count();
            assert_eq!(missing, 0);
        }
    }
}

#[test]
fn both_renderers_agree_on_random_scenes_the_better_the_finer_the_grid() {
    let mut rng = Rng::new(run_seed());
    let mut totals = [[0usize; 3]; 2];
    for _ in 0..60 {
        // Triangles on all sides of the eye; many cross the near plane, the far plane or the border.
        let vertices: Vec<Vertex> = (0..36)
            .map(|_| {
                let z = f64::from(rng.log_uniform(0.1, 150.0)) - 2.0;
                let spread = 2.0 * z.abs() + 1.0;
                let [x, y] = [(); 2].map(|()| rng.uniform(-spread, spread));
                vertex([x, y, -z], [(); 3].map(|()| rng.unit()))
            })
            .collect();
        let triangles: Vec<[u32; 3]> = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let parts = [part(&triangles, [1.0; 3])];
        let scene = Scene {
            cull: [Cull::Back, Cull::Front, Cull::None][rng.index(3)],
            shading: Shading::VertexColor,
            width: 160,
            height: 120,
            ..scene(&vertices, &parts)
        };
        let ideal = render_ideal(&scene);
        for (totals, bits) in totals.iter_mut().zip([8, 14]) {
            let snapped = render_snapped(&scene, bits);
            let coverage = compare_coverage(&ideal.covered, &snapped.covered);
            totals[0] += coverage.both;
            totals[1] += coverage.differing();
            let both = |i: usize| ideal.covered[i] && snapped.covered[i];
            totals[2] += compare_where(&ideal.pixels, &snapped.pixels, 3, both).differing;
        }
    }
    println!("covered by both, by one, of another colour, at 8 and 14 bits: {totals:?}");
    let [coarse, fine] = totals;
    assert!(coarse[0] > 400_000, "{totals:?}");
    assert!(coarse[1] * 2_000 < coarse[0], "{totals:?}");
    assert!(coarse[2] * 200 < coarse[0], "{totals:?}");
    assert!(fine[1] * 20_000 < fine[0], "{totals:?}");
    assert!(fine[2] * 10_000 < fine[0], "{totals:?}");
}

#[test]
fn cyclic_order_of_the_vertices_does_not_matter() {
    let vertices = floor();
    let image = |triangle: [u32; 3]| {
        let triangles = [triangle];
        let parts = [part(&triangles, [1.0; 3])];
        let scene = Scene { shading: Shading::VertexColor, ..scene(&vertices, &parts) };
        render_ideal(&scene)
    };
    let first = image([0, 1, 2]);
    for order in [[1, 2, 0], [2, 0, 1]] {
        let other = image(order);
        assert_eq!(first.covered, other.covered);
        assert_eq!(compare(&first.pixels, &other.pixels, 1).differing, 0);
    }
}

#[test]
fn hostile_positions_draw_nothing_and_do_not_panic() {
    for bad in [f64::NAN, f64::INFINITY, f64::MAX] {
        let mut vertices = wall(5.0);
        vertices[1].position[0] = bad;
        let parts = [part(&[[0, 1, 2], [0, 0, 2]], [1.0; 3])];
        let scene = scene(&vertices, &parts);
        let _ = render_ideal(&scene);
        let _ = render_snapped(&scene, 8);
    }
}
