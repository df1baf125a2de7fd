//! Displaced meshes, against the surfaces that they stand for, and subdivisions, by counting.

use crate::support::{EPS, angle, vec3};
use alberti_math::{Object, Point3, Vector3, interpolate};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::surface::{
    Grid, HeightMap, LengthError, MeshBuffers, Parametric, Plane, Relief, Sphere, Subdivision, displace,
    displaced, displaced_mesh,
};
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::collections::HashMap;

struct Mesh {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
}

fn build(surface: &impl Parametric, relief: &Relief<impl HeightMap>, grid: Grid) -> Mesh {
    let (mut positions, mut normals) = (vec![Vec3::ZERO; grid.vertices()], vec![Vec3::ZERO; grid.vertices()]);
    let (mut uvs, mut triangles) = (vec![Vec2::ZERO; grid.vertices()], vec![[0; 3]; grid.triangles()]);
    let buffers = MeshBuffers {
        positions: &mut positions,
        normals: &mut normals,
        uvs: &mut uvs,
        triangles: &mut triangles,
    };
    displaced_mesh(surface, relief, grid, buffers).expect("as long as needed");
    Mesh { positions, normals, uvs }
}

/// Every edge once in each direction, but for those of the border.
fn border(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut edges = HashMap::new();
    for &[a, b, c] in triangles {
        for edge in [[a, b], [b, c], [c, a]] {
            assert_eq!(edges.insert(edge, ()), None, "twice: {edge:?}");
        }
    }
    edges.keys().copied().filter(|&[a, b]| !edges.contains_key(&[b, a])).collect()
}

fn doubled_area([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

#[test]
fn grids_cover_the_square() {
    for grid in
        [Grid::new(1, 1), Grid::new(5, 3), Grid::new(16, 32), Grid::of_texels(8, 4), Grid::of_texels(1, 2)]
    {
        let triangles: Vec<[u32; 3]> = (0..grid.triangles() as u32).map(|k| grid.triangle(k)).collect();
        let uvs: Vec<DVec2> = (0..grid.vertices() as u32).map(|k| grid.uv(k).as_dvec2()).collect();
        let areas = triangles.iter().map(|t| doubled_area(t.map(|i| uvs[i as usize])));
        assert!(areas.clone().all(|area| area > 0.0));
        let (first, last) = (uvs[0], uvs[uvs.len() - 1]);
        let size = last - first;
        assert!((areas.sum::<f64>() / 2.0 - size.x * size.y).abs() < 1e-6, "{grid:?}");
        for [a, b] in border(&triangles) {
            let (a, b) = (uvs[a as usize], uvs[b as usize]);
            let along = |k: usize| a[k] == b[k] && (a[k] == first[k] || a[k] == last[k]);
            assert!(along(0) || along(1));
        }
    }
    let uneven = Grid::of_texels(49, 3);
    for (i, k) in (0..49).zip(49..) {
        let middle = Vec2::new(((f64::from(i) + 0.5) / 49.0) as f32, 0.5);
        assert_eq!(uneven.uv(k), middle);
    }
    assert_eq!(Grid::new(0, 7), Grid::new(1, 7));
    assert_eq!(Grid::new(u32::MAX, 1).triangles(), 2 << 14);
    // The middles of texels, exactly where they are numbers.
    let texels = Grid::of_texels(4, 2);
    assert_eq!(
        (texels.vertices(), texels.uv(0), texels.uv(7)),
        (8, Vec2::new(0.125, 0.25), Vec2::new(0.875, 0.75))
    );
    let edges = Grid::of_edges(Vec2::new(10.0, 0.5), 3.0);
    assert_eq!(edges, Grid::new(4, 1));
    assert_eq!(Grid::of_edges(Vec2::new(9.0, f32::NAN), 3.0), Grid::new(3, 1));
    assert_eq!(Grid::of_edges(Vec2::ONE, 0.0), Grid::new(Grid::MAX_CELLS, Grid::MAX_CELLS));
}

#[test]
fn subdivisions_cover_the_triangle() {
    let corners = [DVec2::new(0.0, 1.0), DVec2::new(-1.0, 0.0), DVec2::new(1.0, 0.0)];
    for n in [1, 2, 3, 4, 7, 16, 100] {
        let parts = Subdivision::new(n);
        let triangles: Vec<[u32; 3]> = (0..parts.triangles() as u32).map(|k| parts.triangle(k)).collect();
        let at: Vec<DVec2> = (0..parts.vertices() as u32)
            .map(|k| {
                let [a, b, c] = parts.weights(k).map(f64::from);
                assert!((a + b + c - 1.0).abs() <= 3.0 * EPS);
                corners[0] * a + corners[1] * b + corners[2] * c
            })
            .collect();
        let whole = doubled_area(corners);
        for triangle in &triangles {
            let part = doubled_area(triangle.map(|i| at[i as usize]));
            assert!((part / whole * f64::from(n * n) - 1.0).abs() < 1e-4, "{n}: {part}");
        }
        assert_eq!(border(&triangles).len(), 3 * n as usize);
        assert_eq!(at[0], corners[0]);
        assert_eq!((at[at.len() - 1 - n as usize], at[at.len() - 1]), (corners[1], corners[2]));
    }
    // The quotients, correctly rounded, row by row.
    for n in [1u32, 3, 7, 49, 1000] {
        let parts = Subdivision::new(n);
        let rows = (0..=n).flat_map(|row| (0..=row).map(move |place| [n - row, row - place, place]));
        for (k, exact) in (0..).zip(rows) {
            assert_eq!(parts.weights(k), exact.map(|part| (f64::from(part) / f64::from(n)) as f32));
        }
    }
    let largest = Subdivision::new(u32::MAX);
    assert_eq!(largest.parts(), Subdivision::MAX_PARTS);
    let last = largest.vertices() as u32 - 1;
    assert_eq!(largest.weights(last), [0.0, 0.0, 1.0]);
    assert_eq!(largest.triangle(largest.triangles() as u32 - 1)[2], last);
    let corners = [Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 4.0].map(Point3::new);
    assert_eq!(Subdivision::of_edges(corners, 1.0), Subdivision::new(5));
    assert_eq!(Subdivision::of_edges(corners, 1.1), Subdivision::new(5));
    assert_eq!(Subdivision::of_edges(corners, f32::NAN), Subdivision::new(1));
}

/// The vertices that two triangles have along a common edge, whichever corners come first.
#[test]
fn shared_edges_are_equal() {
    let mut rng = Rng::new(run_seed());
    let mut compared = 0;
    for _ in 0..2000 {
        let parts = Subdivision::new(rng.range(1, 12) as u32);
        let [a, b, c, d] = [(); 4].map(|()| vec3(&mut rng, 1.0) * rng.log_uniform(1e-3, 1e3));
        let points = |corners: [Vec3; 3], zero: usize| {
            let all = (0..parts.vertices() as u32).map(|k| parts.weights(k));
            let edge = all.filter(|weights| weights[zero] == 0.0);
            let mut edge: Vec<[u32; 3]> = edge
                .map(|weights| (interpolate(weights, corners) + 0.0).to_array().map(f32::to_bits))
                .collect();
            edge.sort_unstable();
            edge
        };
        // The edge ab, opposite to the third corner.
        let one = points([a, b, c], 2);
        assert_eq!(one.len(), parts.parts() as usize + 1);
        for (corners, zero) in [([b, a, d], 2), ([d, b, a], 0), ([a, d, b], 1), ([b, d, a], 1)] {
            assert_eq!(points(corners, zero), one);
            compared += one.len();
        }
    }
    println!("{compared} vertices");
    assert!(compared > 20_000);
}

/// A plain that becomes a paraboloid z = x² + y², of which points and normals are known.
#[test]
fn a_paraboloid() {
    let plane = Plane {
        origin: Point3::new(Vec3::ZERO),
        du: Vector3::new(Vec3::X * 2.0),
        dv: Vector3::new(Vec3::Y * 2.0),
    };
    let relief =
        Relief { map: |uv: Vec2| uv.length_squared() / 2.0, low: 0.0, high: 8.0, extent: Vec2::splat(2.0) };
    let mut last = f64::INFINITY;
    for n in [8, 16, 32, 64] {
        let mesh = build(&plane, &relief, Grid::new(n, n));
        let mut worst = 0.0f64;
        for ((position, normal), uv) in mesh.positions.iter().zip(&mesh.normals).zip(&mesh.uvs) {
            let [x, y] = [uv.x, uv.y].map(|c| 2.0 * f64::from(c));
            let exact = DVec3::new(x, y, x * x + y * y);
            assert!((position.as_dvec3() - exact).abs().max_element() <= 8.0 * EPS * (1.0 + exact.z));
            let slope = DVec3::new(-2.0 * x, -2.0 * y, 1.0);
            worst = worst.max(angle(normal.as_dvec3(), slope));
        }
        println!("{n} cells: normals within {worst:.4} rad");
        // At the border, to the first order of the cells' size.
        assert!(worst < last * 0.6 && worst < 4.0 / f64::from(n));
        last = worst;
    }
}

/// A constant height makes a sphere a larger sphere.
#[test]
fn a_larger_sphere() {
    let sphere = Sphere { radius: 2.0 };
    let relief = Relief { map: |_: Vec2| 0.5, low: 0.0, high: 3.0, extent: Vec2::ONE };
    let mesh = build(&sphere, &relief, Grid::new(64, 32));
    let (mut worst, mut bent) = (0.0f64, 0.0f64);
    for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
        worst = worst.max((position.as_dvec3().length() - 3.5).abs() / 3.5 / EPS);
        bent = bent.max(angle(normal.as_dvec3(), position.as_dvec3()));
    }
    println!("radius {worst:.3}ε, normals {bent:.4} rad");
    assert!(worst <= 3.0 && bent < 0.1);
}

#[test]
fn points_move_along_normals() {
    let mut rng = Rng::new(run_seed());
    let mut worst = 0.0f64;
    for _ in 0..200_000 {
        let (point, normal) = (vec3(&mut rng, 10.0), vec3(&mut rng, 1.0).normalize());
        let height = rng.uniform(-5.0, 5.0) as f32;
        let found = displaced(Point3::<Object>::new(point), Vector3::new(normal), height).coords;
        let exact = point.as_dvec3() + normal.as_dvec3() * f64::from(height);
        for i in 0..3 {
            let scale = exact[i].abs() + f64::from(height.abs());
            worst = worst.max((f64::from(found[i]) - exact[i]).abs() / scale / EPS);
        }
    }
    println!("{worst:.3}ε");
    assert!(worst <= 1.0);

    let relief = Relief { map: |uv: Vec2| uv.x, low: -1.0, high: 1.0, extent: Vec2::ONE };
    let mut positions = [Vec3::ZERO, Vec3::ONE];
    displace(&relief, &[Vec3::Z, Vec3::X], &[Vec2::ZERO, Vec2::X], &mut positions).expect("as many");
    assert_eq!(positions, [Vec3::NEG_Z, Vec3::new(2.0, 1.0, 1.0)]);
    let error = displace(&relief, &[Vec3::Z], &[Vec2::ZERO, Vec2::X], &mut positions).unwrap_err();
    assert_eq!(error, LengthError { found: 1, expected: 2 });
}
