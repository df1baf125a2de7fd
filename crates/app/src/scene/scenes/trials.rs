//! The four scenes that the benchmarks time, each made to load one stage: fragments, a mesh, vertices and
//! setup, and the near plane.

use super::BuiltIn;
use super::build::{Builder, Corner, TURN, Vec3, add, cross, dot, scale, surface_normal, unit};
use super::paint::{cell, hash, marble, mix, paint, rgb};
use crate::options::{Cull, DepthFormat, Filter, Shading, Wrap};
use crate::scene::{Camera, Image, Model};

/// All four: front faces only, nearest texel, repeating textures.
fn trial(model: Model, camera: Camera, shading: Shading) -> BuiltIn {
    BuiltIn {
        model,
        camera,
        background: [24, 28, 36],
        shading,
        filter: Filter::Nearest,
        wrap: Wrap::Repeat,
        cull: Cull::Back,
        depth: DepthFormat::F32,
    }
}

/// The screens stacked in [`fill`].
pub(super) const LAYERS: u32 = 16;

/// The plane of layer `i` of [`fill`], seen along the ray through (x, y, -1): its 1/z is `(1 + a x + b y) / d`.
/// Returns `[a, b, d]`.
pub(super) fn layer(i: u32) -> [f64; 3] {
    let tilt = |seed: u32| (hash(i.cast_signed(), 0, seed) - 0.5) * 0.9;
    // Mostly from the back to the front, so that most fragments pass; the tilts make the layers cross.
    [tilt(11), tilt(12), 10.0 - 0.505 * f64::from(i)]
}

/// 16 tilted quads, each over the whole screen (up to an aspect of 2), with a depth test that about 64 % of
/// the fragments pass in drawing order.
pub(super) fn fill() -> BuiltIn {
    let mut b = Builder::default();
    let texture = b.texture(tiles());
    b.part("layers", Some(texture));
    for i in 0..LAYERS {
        let [tilt_x, tilt_y, d] = layer(i);
        // The plane z = -d + a x + b y, cut where the four rays of a slightly larger screen meet it.
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[sx, sy]| {
            let (x, y) = (sx * 1.25, sy * 0.62);
            let depth = d / (1.0 + tilt_x * x + tilt_y * y);
            scale([x, y, -1.0], depth)
        });
        // Texture coordinates are linear on the plane. Each layer is shifted, so that the layers can be told apart.
        let shift = f64::from(i) / f64::from(LAYERS);
        b.face(&corners.map(|p| (p, [0.4 * p[0] + shift, 0.4 * p[1] + shift])));
    }
    let camera = Camera {
        eye: [0.0; 3],
        target: [0.0, 0.0, -1.0],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 60.0,
        near: 1.0,
        far: 100.0,
    };
    trial(b.finish(), camera, Shading::Unlit)
}

/// A textured trefoil knot with a ribbed tube: 118 by 25 cells, 5,900 triangles.
pub(super) fn mesh() -> BuiltIn {
    const ALONG: u32 = 118;
    const AROUND: u32 = 25;
    let mut b = Builder::default();
    let texture = b.texture(paint(256, 256, |u, v| {
        let stripe = (cell(u * 16.0) + cell(v * 4.0)).rem_euclid(2) == 0;
        let stone = if stripe { rgb(0xd8_9a5a) } else { rgb(0x3c_6474) };
        let stone = marble(u, v, 4, 21, stone, mix(stone, rgb(0x20_1810), 0.5));
        let seam = (u * 16.0).rem_euclid(1.0) < 0.06 || (v * 4.0).rem_euclid(1.0) < 0.03;
        if seam { mix(stone, rgb(0xf4_e6c8), 0.8) } else { stone }
    }));
    b.part("knot", Some(texture));
    b.sheet(ALONG, AROUND, |i, j| {
        // Positions at the seams come from the same numbers, so that the mesh is closed to the bit.
        let at = |k: u32, n: u32| f64::from(k % n) / f64::from(n);
        let (u, v) = (at(i, ALONG), at(j, AROUND));
        let uv = [f64::from(i) / f64::from(ALONG) * 4.0, f64::from(j) / f64::from(AROUND)];
        Corner::new(knot(u, v), surface_normal(knot, u, v), uv)
    });
    let camera = Camera {
        eye: [0.9, 1.4, 9.2],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 40.0,
        near: 1.0,
        far: 30.0,
    };
    trial(b.finish(), camera, Shading::Unlit)
}

/// The trefoil's surface: `u` along the knot, `v` around the tube, both of period 1.
fn knot(u: f64, v: f64) -> Vec3 {
    let middle = |u: f64| {
        let (t, r) = (TURN * u, 1.7 + 0.75 * (TURN * 3.0 * u).cos());
        [r * (2.0 * t).cos(), r * (2.0 * t).sin(), 0.9 * (3.0 * t).sin()]
    };
    // The frame along the knot: its direction, and the direction away from the axis made square to it.
    const H: f64 = 1e-4;
    let along = unit(add(middle(u + H), scale(middle(u - H), -1.0)));
    let outward = middle(u);
    let outward = unit(add(outward, scale(along, -dot(outward, along))));
    let side = cross(along, outward);
    let ribs = 0.42 + 0.05 * (TURN * 24.0 * u).sin() * (TURN * 3.0 * v).cos();
    let (sin, cos) = (TURN * v).sin_cos();
    add(middle(u), add(scale(outward, ribs * cos), scale(side, ribs * sin)))
}

/// A vertex-coloured lump, closed, of 12 * `cells`^2 triangles of about the same size.
pub fn gouraud(cells: u32) -> BuiltIn {
    let mut b = Builder::default();
    b.part("lump", None);
    // The six sides of a cube: the axis that points outwards, then those of i and j, right-handed.
    let sides: [(usize, usize, usize, f64); 6] =
        [(0, 1, 2, 1.0), (1, 2, 0, 1.0), (2, 0, 1, 1.0), (0, 2, 1, -1.0), (1, 0, 2, -1.0), (2, 1, 0, -1.0)];
    for (out, right, up, sign) in sides {
        b.sheet(cells, cells, |i, j| {
            // Each coordinate depends on its own lattice number alone: neighbouring sides agree to the bit.
            let warp = |k: u32| {
                let t = 2.0 * f64::from(k) / f64::from(cells) - 1.0;
                (t * TURN / 8.0).tan()
            };
            let mut p = [0.0; 3];
            p[out] = sign;
            p[right] = if i == cells { 1.0 } else { warp(i) };
            p[up] = if j == cells { 1.0 } else { warp(j) };
            // The warp of 0 must be -1 exactly, as seen from the neighbour.
            p = p.map(|c| if c < -0.999_999 { -1.0 } else { c });
            let direction = unit(p);
            let position = scale(direction, lump(direction));
            let normal = lump_normal(position);
            Corner { position, normal, uv: [0.0; 2], color: lump_color(direction, normal) }
        });
    }
    let camera = Camera {
        eye: [1.1, 1.0, 3.8],
        target: [0.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 40.0,
        near: 1.0,
        far: 20.0,
    };
    trial(b.finish(), camera, Shading::VertexColor)
}

/// The lump's radius in a direction.
fn lump([x, y, z]: Vec3) -> f64 {
    let waves = (5.0 * x + 1.0).sin() * (4.0 * y).cos() + (6.0 * z + 2.0 * y).sin() * (3.0 * x).cos();
    let ripples = (23.0 * x).sin() * (21.0 * y).sin() * (22.0 * z).sin();
    1.0 + 0.12 * waves + 0.03 * ripples
}

/// The normal there: the gradient of the distance from the surface.
fn lump_normal(p: Vec3) -> Vec3 {
    const H: f64 = 1e-5;
    let excess = |p: Vec3| dot(p, p).sqrt() - lump(unit(p));
    let slope = |axis: usize| {
        let (mut low, mut high) = (p, p);
        low[axis] -= H;
        high[axis] += H;
        excess(high) - excess(low)
    };
    unit([slope(0), slope(1), slope(2)])
}

/// Light from above baked into colours from valley to ridge.
fn lump_color(direction: Vec3, normal: Vec3) -> Vec3 {
    let height = (lump(direction) - 0.75) / 0.5;
    let earth = mix(mix(rgb(0x27_4c5e), rgb(0xc9_6f4a), height * 2.0), rgb(0xf6_e3b4), height * 2.0 - 1.0);
    let light = 0.35 + 0.65 * dot(normal, unit([0.3, 0.8, 0.5])).max(0.0);
    earth.map(|c| (c * light).clamp(0.0, 1.0))
}

/// One plane from behind the camera to the far plane.
pub(super) fn floor() -> BuiltIn {
    let mut b = Builder::default();
    let texture = b.texture(tiles());
    b.part("floor", Some(texture));
    let corners: [Vec3; 4] =
        [[-300.0, 0.0, 40.0], [300.0, 0.0, 40.0], [300.0, 0.0, -200.0], [-300.0, 0.0, -200.0]];
    b.face(&corners.map(|p| (p, [0.25 * p[0], -0.25 * p[2]])));
    let camera = Camera {
        eye: [0.0, 1.5, 0.0],
        target: [0.35, 1.2, -1.0],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 60.0,
        near: 0.1,
        far: 150.0,
    };
    trial(b.finish(), camera, Shading::Unlit)
}

/// A chequer of two marbles, 256 by 256, four by four squares.
fn tiles() -> Image {
    paint(256, 256, |u, v| {
        let white = (cell(u * 4.0) + cell(v * 4.0)).rem_euclid(2) == 0;
        let (stone, vein) =
            if white { (rgb(0xf0_e6d2), rgb(0xb0_a08c)) } else { (rgb(0x9c_4a32), rgb(0x5e_2418)) };
        marble(u, v, 4, 3, stone, vein)
    })
}
