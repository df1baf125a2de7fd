//! Displaced meshes: divisions are partitions whatever their number, and vertices go where exact sums say.

use std::collections::HashMap;

use crate::bits::Bits;
use alberti::glam::{Vec2, Vec3};
use alberti::math::interpolate;
use alberti::texture::surface::{
    Cylinder, Grid, MeshBuffers, Parametric, Relief, Sphere, Subdivision, Torus, displace, displaced_mesh,
};

pub(crate) fn run(bytes: &[u8]) {
    let mut bits = Bits::new(bytes);
    match bits.below(4) {
        0 => divided(&mut bits),
        1 => squares(&mut bits),
        2 => moved(&mut bits),
        _ => surface(&mut bits),
    }
}

/// Each edge within is that of two triangles, one each way; the others are the border: how many there are.
fn border(triangles: impl Iterator<Item = [u32; 3]>) -> usize {
    let mut edges: HashMap<[u32; 2], i32> = HashMap::new();
    for [a, b, c] in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let turn = if from < to { 1 } else { -1 };
            let sum = edges.entry([from.min(to), from.max(to)]).or_default();
            assert!(*sum != turn, "two triangles take the edge from {from} to {to}");
            *sum += turn;
        }
    }
    edges.values().filter(|sum| **sum != 0).count()
}

fn divided(bits: &mut Bits<'_>) {
    let n = 1 + bits.below(24) as u32;
    let division = Subdivision::new(n);
    let parts = |vertex: u32| {
        let weights = division.weights(vertex).map(|weight| (f64::from(weight) * f64::from(n)).round());
        assert_eq!(division.weights(vertex), weights.map(|part| part as f32 / n as f32), "{vertex} of {n}");
        assert!(weights.iter().sum::<f64>() == f64::from(n), "{vertex} of {n}");
        weights.map(|part| part as i32)
    };
    for triangle in (0..division.triangles() as u32).map(|k| division.triangle(k)) {
        let [a, b, c] = triangle.map(parts);
        // Each is as large as the others, and turns as the whole.
        let area = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
        assert_eq!(area, 1, "{triangle:?} of {n}");
    }
    let outside = border((0..division.triangles() as u32).map(|k| division.triangle(k)));
    assert_eq!(outside, 3 * n as usize);
    // A neighbour across the second edge, whose corners are in any order, has the same vertices there.
    let [a, b, c, d] = [(); 4].map(|()| Vec3::from_array(bits.floats()));
    let (first, second) = ([a, b, c], if bits.bit() { [c, b, d] } else { [d, c, b] });
    let of = |corners: [Vec3; 3], k: u32| interpolate(division.weights(k), corners);
    let along = |corners: [Vec3; 3], without: usize| -> Vec<[u32; 3]> {
        let vertices = (0..division.vertices() as u32).filter(|&k| parts(k)[without] == 0);
        // Positive zero is the same place as negative zero.
        let mut edge: Vec<_> =
            vertices.map(|k| of(corners, k).to_array().map(|x| (x + 0.0).to_bits())).collect();
        edge.sort_unstable();
        edge
    };
    if [a, b, c, d].iter().all(|corner| corner.is_finite()) {
        let without = if second[2] == d { 2 } else { 0 };
        assert_eq!(along(first, 0), along(second, without), "{n} parts of {first:?} and {second:?}");
    }
}

fn squares(bits: &mut Bits<'_>) {
    let [columns, rows] = [(); 2].map(|()| 1 + bits.below(20) as u32);
    let texels = bits.bit();
    let grid = if texels { Grid::of_texels(columns + 1, rows + 1) } else { Grid::new(columns, rows) };
    assert_eq!(grid.vertices(), (columns as usize + 1) * (rows as usize + 1));
    let cell = |vertex: u32| [vertex % (columns + 1), vertex / (columns + 1)].map(i64::from);
    for vertex in 0..grid.vertices() as u32 {
        let exact = |k: i64, cells: u32| {
            let half = i64::from(texels);
            (2 * k + half) as f64 / f64::from(2 * (cells + u32::from(texels)))
        };
        let [column, row] = cell(vertex);
        let uv = [exact(column, columns) as f32, exact(row, rows) as f32];
        assert_eq!(grid.uv(vertex).to_array(), uv, "{vertex} of {grid:?}");
    }
    for k in 0..grid.triangles() as u32 {
        let [a, b, c] = grid.triangle(k).map(cell);
        assert_eq!((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 1, "{k} of {grid:?}");
    }
    let outside = border((0..grid.triangles() as u32).map(|k| grid.triangle(k)));
    assert_eq!(outside, 2 * (columns + rows) as usize);
}

/// Heights of any numbers, from a row of five.
fn heights(bits: &mut Bits<'_>) -> Relief<impl Fn(Vec2) -> f32 + use<>> {
    let row: [f32; 5] = bits.floats();
    let [low, high] = bits.floats();
    let map = move |uv: Vec2| row[(uv.x.abs() * 5.0) as usize % 5];
    Relief { map, low, high, extent: Vec2::ONE }
}

fn moved(bits: &mut Bits<'_>) {
    let relief = heights(bits);
    let count = bits.below(9);
    let mut positions: Vec<_> = (0..count).map(|_| Vec3::from_array(bits.floats())).collect();
    // Unit vectors, which floats that are tiny make in 64 bits alone.
    let unit = |v: Vec3| v.as_dvec3().normalize_or_zero().as_vec3();
    let normals: Vec<_> = (0..count).map(|_| unit(Vec3::from_array(bits.floats()))).collect();
    let uvs: Vec<_> = (0..count).map(|_| Vec2::from_array(bits.floats())).collect();
    let before = positions.clone();
    assert!(displace(&relief, &normals, &uvs, &mut positions).is_ok());
    for k in 0..count {
        let height = relief.height(uvs[k]);
        for axis in 0..3 {
            let [found, from, along] = [positions[k], before[k], normals[k]].map(|v| v[axis]);
            let exact = f64::from(from) + f64::from(along) * f64::from(height);
            let product = f64::from(along) * f64::from(height);
            if !exact.is_finite() || exact.abs().max(product.abs()) >= f64::from(f32::MAX) {
                continue;
            }
            let epsilon = 2f64.powi(-24);
            let bound = epsilon * (exact.abs() + f64::from(height.abs())) + 2f64.powi(-149);
            assert!(
                (f64::from(found) - exact).abs() <= bound * 1.001,
                "{found} for {exact}: {from} and {height} along {along}"
            );
        }
    }
    if count > 0 {
        assert!(displace(&relief, &normals[1..], &uvs, &mut positions).is_err());
        assert!(displace(&relief, &normals, &uvs[1..], &mut positions).is_err());
    }
}

fn surface(bits: &mut Bits<'_>) {
    match bits.below(3) {
        0 => mesh(&Sphere { radius: bits.float() }, bits),
        1 => mesh(&Cylinder { radius: bits.float(), height: bits.float() }, bits),
        _ => mesh(&Torus { major: bits.float(), minor: bits.float() }, bits),
    }
}

fn mesh(surface: &impl Parametric, bits: &mut Bits<'_>) {
    let relief = heights(bits);
    let grid = Grid::new(bits.below(6) as u32, bits.below(6) as u32);
    let fewer = [(); 4].map(|()| usize::from(bits.below(32) == 1));
    let [vertices, triangles] = [grid.vertices(), grid.triangles()];
    let mut positions = vec![Vec3::ZERO; vertices - fewer[0]];
    let mut normals = vec![Vec3::ZERO; vertices - fewer[1]];
    let mut uvs = vec![Vec2::ZERO; vertices - fewer[2]];
    let mut indices = vec![[0; 3]; triangles - fewer[3]];
    let buffers = MeshBuffers {
        positions: &mut positions,
        normals: &mut normals,
        uvs: &mut uvs,
        triangles: &mut indices,
    };
    let made = displaced_mesh(surface, &relief, grid, buffers);
    assert_eq!(made.is_ok(), fewer == [0; 4]);
    if made.is_ok() {
        for normal in normals {
            let length = normal.as_dvec3().length();
            assert!((length - 1.0).abs() < 1e-5, "{normal} is {length} long");
        }
    }
}
