//! The bodies on which the painters of the Quattrocento practised, and a pedestal to put them on. They are the
//! mazzocchio (a faceted ring, in truth the frame of a hat), the sphere of 72 faces, and the dodecahedron.

use super::build::{Builder, Sides, TURN, Vec3, add, cross, dot, scale, sub, unit};
use super::paint::{cover, grain, marble, mix, paint, rgb};
use crate::scene::Image;

/// Three axes at right angles, right-handed.
#[derive(Clone, Copy)]
pub(super) struct Frame([Vec3; 3]);

impl Frame {
    /// Turned by `yaw` around the vertical, then leaning back by `pitch` (both in turns).
    pub(super) fn turned(yaw: f64, pitch: f64) -> Self {
        let ((sy, cy), (sp, cp)) = ((TURN * yaw).sin_cos(), (TURN * pitch).sin_cos());
        let (right, ahead) = ([cy, 0.0, -sy], [sy, 0.0, cy]);
        let up = add(scale([0.0, 1.0, 0.0], cp), scale(ahead, -sp));
        Self([right, up, cross(right, up)])
    }

    /// With its second axis along `up`.
    fn upright(up: Vec3) -> Self {
        let up = unit(up);
        let right = unit(cross(up, [0.3, 0.1, 0.9]));
        Self([right, up, cross(right, up)])
    }

    fn to_world(self, p: Vec3) -> Vec3 {
        let [x, y, z] = self.0;
        add(add(scale(x, p[0]), scale(y, p[1])), scale(z, p[2]))
    }

    fn to_local(self, p: Vec3) -> Vec3 {
        self.0.map(|axis| dot(axis, p))
    }
}

/// The corners of the texture of a face.
const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// The ring: 32 by 8 flat faces, light and dark in turn, around the third axis of `frame`.
pub(super) fn mazzocchio(b: &mut Builder, middle: Vec3, frame: Frame, ring: f64, tube: f64, texture: usize) {
    const ALONG: u32 = 32;
    const AROUND: u32 = 8;
    b.part("mazzocchio", Some(texture));
    let at = |i: u32, j: u32| {
        let along = TURN * f64::from(i % ALONG) / f64::from(ALONG);
        let around = TURN * (f64::from(j % AROUND) + 0.5) / f64::from(AROUND);
        let r = ring + tube * around.cos();
        add(middle, frame.to_world([r * along.cos(), r * along.sin(), tube * around.sin()]))
    };
    for i in 0..ALONG {
        for j in 0..AROUND {
            let shift = f64::from((i + j) % 2) * 0.5;
            let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let face: Vec<_> = corners.into_iter().zip(SQUARE.map(|[u, v]| [0.5 * u + shift, v])).collect();
            b.face(&face);
        }
    }
}

/// The sphere of 72 faces that Euclid's commentator Campanus describes and Leonardo drew for Pacioli.
pub(super) fn sphere_of_72(b: &mut Builder, middle: Vec3, radius: f64, texture: usize) {
    const AROUND: u32 = 12;
    const UP: u32 = 6;
    b.part("sphere of 72 faces", Some(texture));
    let at = |i: u32, j: u32| {
        let (longitude, latitude) =
            (TURN * f64::from(i % AROUND) / f64::from(AROUND), TURN / 2.0 * f64::from(j) / f64::from(UP));
        // Exactly on the axis at the poles.
        let ring = if j == 0 || j == UP { 0.0 } else { latitude.sin() };
        add(middle, scale([ring * longitude.sin(), -latitude.cos(), ring * longitude.cos()], radius))
    };
    for j in 0..UP {
        for i in 0..AROUND {
            let [a, p, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if j == 0 {
                b.face(&[(a, [0.5, 0.0]), (c, SQUARE[2]), (d, SQUARE[3])]);
            } else if j == UP - 1 {
                b.face(&[(a, SQUARE[0]), (p, SQUARE[1]), (c, [0.5, 1.0])]);
            } else {
                b.face(&[(a, SQUARE[0]), (p, SQUARE[1]), (c, SQUARE[2]), (d, SQUARE[3])]);
            }
        }
    }
}

/// The dodecahedron, a face turned straight down; `radius` is that of its corners. It lies on the floor when its middle
/// is [`DODECAHEDRON_REST`] radii above.
pub(super) fn dodecahedron(b: &mut Builder, middle: Vec3, radius: f64, texture: usize) {
    b.part("dodecahedron", Some(texture));
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let signs = [-1.0, 1.0];
    let mut corners: Vec<Vec3> = Vec::new();
    let mut faces: Vec<Vec3> = Vec::new();
    for s in signs {
        for t in signs {
            corners.extend(signs.map(|r| [r, s, t]));
            corners.extend([
                [0.0, s / golden, t * golden],
                [s / golden, t * golden, 0.0],
                [t * golden, 0.0, s / golden],
            ]);
            faces.extend([[0.0, s * golden, t], [s * golden, t, 0.0], [t, 0.0, s * golden]]);
        }
    }
    // Laid on its last face.
    let frame = Frame::upright(scale(faces[faces.len() - 1], -1.0));
    for normal in faces {
        // Its five corners are those farthest along the normal, ordered by angle.
        let reach = corners.iter().map(|&c| dot(c, normal)).fold(0.0, f64::max);
        let plane = Frame::upright(normal);
        let mut ring: Vec<(f64, Vec3)> = corners
            .iter()
            .filter(|&&c| dot(c, normal) > reach - 1e-9)
            .map(|&c| {
                let [x, _, z] = plane.to_local(c);
                // Counter-clockwise seen against the normal, which is the second axis: from z to x.
                (x.atan2(z), c)
            })
            .collect();
        ring.sort_by(|a, b| a.0.total_cmp(&b.0));
        let start = ring[0].0;
        let face: Vec<_> = ring
            .iter()
            .map(|&(angle, c)| {
                let (sin, cos) = (angle - start).sin_cos();
                let position = add(middle, scale(frame.to_local(c), radius / 3.0_f64.sqrt()));
                (position, [0.5 + 0.5 * cos, 0.5 + 0.5 * sin])
            })
            .collect();
        b.face(&face);
    }
}

/// An eight-sided pedestal, `height` tall.
pub(super) fn pedestal(b: &mut Builder, foot: Vec3, height: f64, texture: usize) {
    b.part("pedestal", Some(texture));
    let profile = [
        [0.56, 0.0],
        [0.56, 0.10],
        [0.50, 0.12],
        [0.50, 0.17],
        [0.40, 0.24],
        [0.36, height - 0.24],
        [0.40, height - 0.17],
        [0.49, height - 0.11],
        [0.49, height - 0.02],
        [0.47, height],
        [0.0, height],
    ];
    b.lathe(foot, Sides::prism(8), &profile, 4.0, 0.7);
}

/// Two inlaid squares side by side: ivory and ultramarine, each in a gilt frame.
pub(super) fn inlay() -> Image {
    paint(512, 256, |u, v| {
        let dark = u >= 0.5;
        let (x, y) = ((u * 2.0).fract(), v);
        let (stone, vein) =
            if dark { (rgb(0x1f_3a6e), rgb(0x0c_1a3c)) } else { (rgb(0xf7_ecd4), rgb(0xc8_a878)) };
        let stone = marble(x, y, 3, if dark { 5 } else { 6 }, stone, vein);
        let edge = x.min(1.0 - x).min(y).min(1.0 - y);
        let gold = grain(x, y, 12, 8, rgb(0xc8_9638), 0.3);
        let line = rgb(0x4a_2c12);
        let framed = mix(stone, line, cover(edge - 0.105, 0.008));
        let framed = mix(framed, gold, cover(edge - 0.09, 0.008));
        mix(framed, line, cover(edge - 0.022, 0.008))
    })
}

/// A square of walnut and boxwood marquetry.
pub(super) fn marquetry() -> Image {
    paint(256, 256, |u, v| {
        let wood = |color: Vec3, seed| {
            let fibre = super::paint::cloud(u * 3.0, v * 24.0, 24, seed);
            scale(color, 0.78 + 0.44 * fibre)
        };
        let edge = u.min(1.0 - u).min(v).min(1.0 - v);
        let star = (u - 0.5).abs() + (v - 0.5).abs();
        let field = mix(wood(rgb(0xd9_a45c), 31), wood(rgb(0x7a_3c1c), 32), cover(star - 0.3, 0.012));
        mix(field, wood(rgb(0x5c_2c14), 33), cover(edge - 0.07, 0.012))
    })
}

/// A pentagon of terracotta with a lighter field; the pentagon's corners lie on the circle in the square.
pub(super) fn pentagon() -> Image {
    paint(256, 256, |u, v| {
        let p = [u - 0.5, v - 0.5];
        // The distance to the nearest side, along whose normal the corner-to-corner symmetry points.
        let reach = (0..5)
            .map(|k| {
                let (sin, cos) = (TURN * (f64::from(k) + 0.5) / 5.0).sin_cos();
                p[0] * cos + p[1] * sin
            })
            .fold(-1.0, f64::max);
        let clay = grain(u, v, 8, 41, rgb(0xb8_5634), 0.35);
        let field = grain(u, v, 8, 42, rgb(0xe9_c08a), 0.25);
        let framed = mix(clay, field, cover(reach - 0.30, 0.01));
        mix(framed, rgb(0x6e_2a18), cover((reach - 0.315).abs() - 0.012, 0.008))
    })
}

/// The height of the dodecahedron's middle above the floor, as a part of its radius.
pub(super) const DODECAHEDRON_REST: f64 = 0.794_654_472_291_766;

/// The distance from the tube's middle line at which a ray passes through the ring's plane: the ring's shadow is where
/// that is less than the tube's radius.
pub(super) fn ring_distance(from: Vec3, toward: Vec3, middle: Vec3, frame: Frame, ring: f64) -> f64 {
    let (p, d) = (frame.to_local(sub(from, middle)), frame.to_local(toward));
    let t = -p[2] / d[2];
    let (x, y) = (p[0] + t * d[0], p[1] + t * d[1]);
    ((x * x + y * y).sqrt() - ring).abs()
}
