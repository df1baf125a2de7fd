//! Two small scenes for looking at one thing at a time: perspective, and clipping.

use super::BuiltIn;
use super::build::{Builder, Corner, TURN, Vec3, cross, scale, sub, surface_normal, unit};
use super::paint::{cell, marble, mix, paint, rgb};
use crate::options::{Cull, DepthFormat, Filter, Shading, Wrap};
use crate::scene::Camera;

/// The cube of every introduction to perspective: its corners carry the colours of the colour cube.
pub(super) fn cube() -> BuiltIn {
    let mut b = Builder::default();
    b.part("cube", None);
    // Corner k of a side, counter-clockwise: along the axes `right` and `up`, which with `out` are right-handed.
    for (out, right, up, sign) in
        [(0, 1, 2, 1.0), (1, 2, 0, 1.0), (2, 0, 1, 1.0), (0, 2, 1, -1.0), (1, 0, 2, -1.0), (2, 1, 0, -1.0)]
    {
        let mut normal = [0.0; 3];
        normal[out] = sign;
        b.sheet(1, 1, |i, j| {
            let mut position: Vec3 = normal;
            position[right] = 2.0 * f64::from(i) - 1.0;
            position[up] = 2.0 * f64::from(j) - 1.0;
            let color = position.map(|c| 0.5 + 0.5 * c);
            Corner { position, normal, uv: [f64::from(i), f64::from(j)], color }
        });
    }
    BuiltIn {
        model: b.finish(),
        camera: Camera {
            eye: [2.2, 2.0, 3.4],
            target: [0.0, -0.1, 0.0],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 45.0,
            near: 0.5,
            far: 20.0,
        },
        background: [38, 40, 46],
        shading: Shading::VertexColor,
        filter: Filter::Bilinear,
        wrap: Wrap::Repeat,
        cull: Cull::Back,
        depth: DepthFormat::F32,
    }
}

/// A grotto seen from within, so close to its wall and with a far plane so near that triangles cross all six sides of
/// the view volume. The background shows where the near and the far plane cut it open.
pub(super) fn inside() -> BuiltIn {
    const AROUND: u32 = 24;
    const UP: u32 = 12;
    let mut b = Builder::default();
    let texture = b.texture(paint(256, 256, |u, v| {
        let light = (cell(u * 8.0) + cell(v * 8.0)).rem_euclid(2) == 0;
        let stone = if light { rgb(0xe8_d8b4) } else { rgb(0x8a_5a3c) };
        marble(u, v, 4, 51, stone, mix(stone, rgb(0x40_2818), 0.6))
    }));
    b.part("grotto", Some(texture));
    // Rows from pole to pole; du and dv are ordered so that the front is the inside.
    b.sheet(UP, AROUND, |j, i| {
        let (u, v) = (f64::from(i % AROUND) / f64::from(AROUND), f64::from(j) / f64::from(UP));
        let pole = j == 0 || j == UP;
        let position = if pole { grotto(0.0, v) } else { grotto(u, v) };
        let normal =
            if pole { unit(scale(position, -1.0)) } else { surface_normal(|v, u| grotto(u, v), v, u) };
        let uv = [f64::from(i) / f64::from(AROUND) * 4.0, v * 2.0];
        Corner::new(position, normal, uv)
    });
    BuiltIn {
        model: drop_empty(b),
        camera: Camera {
            eye: [1.75, 0.2, 0.9],
            target: [0.9, -0.1, -3.0],
            up: [0.1, 1.0, 0.0],
            roll: 0.0,
            fov: 75.0,
            near: 0.7,
            far: 3.3,
        },
        background: [16, 18, 24],
        shading: Shading::Lambert,
        filter: Filter::Bilinear,
        wrap: Wrap::Repeat,
        cull: Cull::Back,
        depth: DepthFormat::F32,
    }
}

/// The grotto's wall: `u` around the vertical, `v` from the bottom to the top.
fn grotto(u: f64, v: f64) -> Vec3 {
    // At the poles exactly on the axis, so that all columns meet there.
    let (ring, height) = if v <= 0.0 {
        (0.0, -1.0)
    } else if v >= 1.0 {
        (0.0, 1.0)
    } else {
        ((TURN * v / 2.0).sin(), -(TURN * v / 2.0).cos())
    };
    let r = 2.6 + 0.25 * (TURN * 3.0 * u).sin() * ring * ring;
    let (sin, cos) = (TURN * u).sin_cos();
    [r * ring * sin, 2.2 * height, r * ring * cos]
}

/// The model without the triangles that have no area, which the poles of a sheet leave behind.
fn drop_empty(b: Builder) -> crate::scene::Model {
    let mut model = b.finish();
    let vertices = &model.vertices;
    for part in &mut model.parts {
        part.triangles.retain(|t| {
            let [a, b, c] = t.map(|i| vertices[i as usize].position.map(f64::from));
            cross(sub(b, a), sub(c, a)).iter().any(|&x| x.abs() > 1e-12)
        });
    }
    model
}
