//! The pavement, from the picture's lower edge to the horizon, and the painted landscape behind.
//!
//! The pavement is one formula of the place on the ground. It is painted in strips across the view, each with a texture
//! of its own whose texels are about as large as the screen's pixels there. The squares are averaged over a texel
//! exactly: no moiré at the horizon, although the renderer is given no mip maps.

use super::arcade::{ARCH, BAY, COLUMNS, FIRST, HALF_WIDTH, SPRING, TOP, WALL};
use super::build::{Builder, Vec3, add, scale};
use super::paint::{cell, cloud, cover, grain, hash, look, marble, mix, paint, ramp, rgb};
use crate::scene::Image;

/// Towards the sun: to the left, above, and behind the camera.
pub(super) const SUN: Vec3 = [-0.36, 0.80, 0.48];
/// The pavement ends here on either side, the lawn begins.
const EDGE: f64 = 3.6;
/// The side of a square.
const SQUARE: f64 = 0.6;

/// A shadow on the ground: the distance from the shadow's edge outwards to a point.
pub(super) type Shadow<'a> = &'a (dyn Fn(f64, f64) -> f64 + Sync);

/// The ground from `near` to `far` in front of an eye at `eye_z`, under the given shadow.
pub(super) fn ground(b: &mut Builder, eye_z: f64, near: f64, far: f64, shadow: Shadow) {
    // Each strip ends this much farther away than it begins.
    const GROWTH: f64 = 1.35;
    // Half the width that a picture of 16:9 shows at distance 1.
    const SPREAD: f64 = 0.85;
    let stones = Stones::new();
    let mut from = near;
    while from < far {
        let to = from * GROWTH;
        let (half, depth) = (SPREAD * to, to - from);
        // Strips are seen ever more from the side: fewer and fewer rows are needed.
        let rows = match from {
            d if d < 6.0 => 128,
            d if d < 12.0 => 64,
            d if d < 24.0 => 32,
            _ => 16,
        };
        let size = [2.0 * half / 1024.0, depth / f64::from(rows)];
        let texture = b.texture(paint(1024, rows, |u, v| {
            let at = [(2.0 * u - 1.0) * half, eye_z - from - v * depth];
            let shade = cover(shadow(at[0], at[1]), 0.06 + size[0] + 0.3 * size[1]);
            let stone = stones.at(at, size);
            // Sun is warm; shade is darker, and cooler by the sky.
            let tint = mix([1.06, 1.02, 0.95], [0.50, 0.53, 0.62], shade);
            [stone[0] * tint[0], stone[1] * tint[1], stone[2] * tint[2]]
        }));
        b.part("ground", Some(texture));
        let z = [eye_z - from, eye_z - to];
        // Half a texel inside the edge, so that filtering does not reach round to the other end.
        let (l, h) = (0.5 / 1024.0, 0.5 / f64::from(rows));
        b.face(&[
            ([-half * (1.0 - 2.0 * l), 0.0, z[0]], [l, h]),
            ([half * (1.0 - 2.0 * l), 0.0, z[0]], [1.0 - l, h]),
            ([half * (1.0 - 2.0 * l), 0.0, z[1]], [1.0 - l, 1.0 - h]),
            ([-half * (1.0 - 2.0 * l), 0.0, z[1]], [l, 1.0 - h]),
        ]);
        from = to;
    }
}

/// Images of the ground's materials, each over a repeating square.
struct Stones {
    ivory: Image,
    rosso: Image,
    green: Image,
    kerb: Image,
    grass: Image,
}

impl Stones {
    fn new() -> Self {
        Self {
            ivory: paint(256, 256, |u, v| marble(u, v, 3, 93, rgb(0xf4_e6c8), rgb(0xc4_a888))),
            rosso: paint(256, 256, |u, v| marble(u, v, 4, 95, rgb(0xb0_5236), rgb(0x74_3020))),
            green: paint(64, 64, |u, v| grain(u, v, 8, 97, rgb(0x56_6c58), 0.4)),
            kerb: paint(64, 64, |u, v| grain(u, v, 8, 98, rgb(0xc4_b8a0), 0.25)),
            grass: paint(256, 256, |u, v| grain(u, v, 24, 100, rgb(0xa2_a45c), 0.9)),
        }
    }

    /// The ground without light at `[x, z]`, averaged over a texel of the given size.
    fn at(&self, [x, z]: [f64; 2], size: [f64; 2]) -> Vec3 {
        let out = x.abs() - EDGE;
        let inside = cover(out, size[0]);
        let mut color = [0.0; 3];
        if inside > 0.0 {
            color = self.squares([x, z], size);
        }
        if inside < 1.0 {
            let patch = 0.75 + 0.5 * cloud(x * 0.35, z * 0.35, 64, 99);
            let blades = look(&self.grass, x / 3.0, z / 3.0);
            let lawn = scale(mix(rgb(0xa2_a45c), blades, 1.0 - ramp(0.04, 0.3, size[1])), patch);
            let kerb = look(&self.kerb, x / 2.0, z / 2.0);
            color = mix(mix(lawn, kerb, cover(out - 0.25, size[0])), color, inside);
        }
        color
    }

    /// The chequer with its inlays.
    fn squares(&self, [x, z]: [f64; 2], [wx, wz]: [f64; 2]) -> Vec3 {
        // Detail too fine to be told apart fades out; the chequer itself is averaged.
        let fine = 1.0 - ramp(0.15, 0.5, wz);
        // The average of (+1, -1, ...) in one direction; the product of two is a chequer.
        let wave = |t: f64, w: f64| {
            let sum = |t: f64| 1.0 - ((t.rem_euclid(2.0)) - 1.0).abs();
            (sum(t + w / 2.0) - sum(t - w / 2.0)) / w
        };
        let light = 0.5 + 0.5 * wave(x / SQUARE, wx / SQUARE) * wave(z / SQUARE, wz / SQUARE);
        // No two slabs are cut from the same place.
        let slab = |seed: u32| hash(cell(x / SQUARE), cell(z / SQUARE), seed);
        let (u, v) = (x / 2.4 + 4.0 * slab(92), z / 2.4 + 7.0 * slab(92));
        let tint = 1.0 + 0.2 * (slab(91) - 0.5) * fine;
        let ivory = look(&self.ivory, u, v).map(|c| c * f64::midpoint(tint, 1.0));
        let tile = mix(scale(look(&self.rosso, u, v), tint), ivory, light);
        // A green lozenge in every ivory square, and a thin joint around all.
        let (fx, fz) = ((x / SQUARE).rem_euclid(1.0) - 0.5, (z / SQUARE).rem_euclid(1.0) - 0.5);
        let inlay = cover(fx.abs() + fz.abs() - 0.21, (wx + wz) / SQUARE) * light * fine;
        let tile = mix(tile, look(&self.green, x, z), inlay * inlay);
        let joint = cover(0.488 - fx.abs(), wx / SQUARE).max(cover(0.488 - fz.abs(), wz / SQUARE));
        mix(tile, rgb(0x6a_5444), 0.6 * joint * fine)
    }
}

/// The shadows of the two arcades, whose walls are taken for planes, and the dark around the columns' feet.
pub(super) fn arcade_shadow(x: f64, z: f64) -> f64 {
    let wall = |side: f64| {
        let plane = side * (HALF_WIDTH + WALL / 2.0);
        // Where the ray from the ground to the sun passes the wall.
        let t = (plane - x) / SUN[0];
        if t < 0.0 {
            return f64::INFINITY;
        }
        let (y, z) = (t * SUN[1], z + t * SUN[2]);
        // Bays before the first column are out of sight, but their shadows are not.
        let past_end = (FIRST - BAY * (f64::from(COLUMNS) - 1.0) - 0.3) - z;
        let along = (FIRST - z).rem_euclid(BAY);
        let column = along.min(BAY - along) - 0.27;
        let from_arch = ((along - BAY / 2.0) * (along - BAY / 2.0) + (y - SPRING) * (y - SPRING)).sqrt();
        let spandrel = (ARCH - from_arch).max(SPRING - y).max(y - TOP);
        column.max(y - SPRING).min(spandrel).max(past_end)
    };
    wall(-1.0).min(wall(1.0))
}

/// The shadow of an upright rod of radius `r` over `foot`, from height `low` to `high`.
pub(super) fn swept(at: [f64; 2], foot: [f64; 2], low: f64, high: f64, r: f64) -> f64 {
    // A segment on the ground, r thick.
    let end = |h: f64| [foot[0] - SUN[0] / SUN[1] * h, foot[1] - SUN[2] / SUN[1] * h];
    let (a, b) = (end(low), end(high));
    let (ab, ap) = ([b[0] - a[0], b[1] - a[1]], [at[0] - a[0], at[1] - a[1]]);
    let t = ((ab[0] * ap[0] + ab[1] * ap[1]) / (ab[0] * ab[0] + ab[1] * ab[1])).clamp(0.0, 1.0);
    let d = [ap[0] - t * ab[0], ap[1] - t * ab[1]];
    (d[0] * d[0] + d[1] * d[1]).sqrt() - r
}

/// The landscape: a wall of air at distance, facing the light.
pub(super) fn backdrop(b: &mut Builder, z: f64, horizon: f64) {
    const HALF: f64 = 90.0;
    const HEIGHT: f64 = 52.0;
    let texture = b.texture(landscape(2.0 * HALF, HEIGHT, horizon));
    b.part("landscape", Some(texture));
    // It shines by itself: its normals point to the light of the camera, whichever the wall's own are.
    let normal = super::build::unit(add(SUN, [0.0, 0.0, 0.4]));
    b.sheet(1, 1, |i, j| {
        let (u, v) = (f64::from(i), f64::from(j));
        let inset = |t: f64, n: f64| (t * (n - 1.0) + 0.5) / n;
        super::build::Corner::new(
            [(2.0 * u - 1.0) * HALF, v * HEIGHT, z],
            normal,
            [inset(u, 1024.0), inset(v, 512.0)],
        )
    });
}

/// Sky, three ranges of hills, cypresses, and a town with a cupola where the lines of the pavement meet.
fn landscape(width: f64, height: f64, horizon: f64) -> Image {
    paint(1024, 512, |u, v| {
        let (x, y) = ((u - 0.5) * width, v * height - horizon);
        let texel = width / 1024.0;
        let mut color = sky(x, y, y / (height - horizon));
        // Nothing on the ground is higher than this.
        if y > 9.0 {
            return color;
        }
        let range = |base: f64, swing: f64, pace: f64, seed: u32| {
            base + swing * (cloud((x + 300.0) * pace, 0.5, 512, seed) - 0.5)
        };
        for (edge, far, near) in [
            (range(4.6, 6.0, 0.05, 121), rgb(0x9c_b2c2), rgb(0xc0_cace)),
            (range(2.6, 3.6, 0.08, 122), rgb(0x7e_9a98), rgb(0xae_bcac)),
            (range(1.0, 1.8, 0.15, 123), rgb(0x6c_8450), rgb(0x96_a268)),
        ] {
            let depth = 1.0 - (y / edge.max(0.1)).clamp(0.0, 1.0);
            color = mix(color, mix(far, near, depth), cover(y - edge, texel));
        }
        let bodies = if x.abs() < 15.0 { town(x, y) } else { cypresses(x, y) };
        bodies.into_iter().fold(color, |color, (body, paint)| mix(color, paint, cover(body, texel)))
    })
}

/// The air at a point, `t` of the way from the horizon to the top.
fn sky(x: f64, y: f64, t: f64) -> Vec3 {
    let air = mix(rgb(0xfd_e9c8), rgb(0xbc_d0dc), ramp(0.0, 0.30, t));
    let air = mix(air, rgb(0x5c_8abb), ramp(0.15, 1.0, t));
    let wisps = cloud(x * 0.045 + 3.0, y * 0.14 + 0.02 * x, 64, 111);
    mix(air, rgb(0xff_f6e6), 0.85 * ramp(0.52, 0.72, wisps) * ramp(0.02, 0.15, t))
}

/// Bodies in the landscape at a point, from the back to the front: signed distance and colour.
type Bodies = Vec<(f64, Vec3)>;

/// Rows of cypresses on the near hills.
fn cypresses(x: f64, y: f64) -> Bodies {
    const PACE: f64 = 4.5;
    let mut bodies = Bodies::new();
    for k in [-1, 0, 1] {
        let k = cell(x / PACE) + k;
        if hash(k, 0, 141) < 0.35 {
            continue;
        }
        let middle = x - PACE * (0.5 + 0.8 * (hash(k, 1, 141) - 0.5)) - (x / PACE).floor() * PACE;
        let middle = middle - PACE * f64::from(k - cell(x / PACE));
        let (tall, wide) = (3.5 + 3.5 * hash(k, 2, 141), 0.55 + 0.25 * hash(k, 3, 141));
        // A flame: narrow above, rounded below.
        let flame = middle.abs() / wide - ((y / tall).clamp(0.0, 1.0).sqrt() * (1.0 - y / tall)) * 2.4;
        let ragged = 0.35 * (cloud(x * 3.0, y * 3.0, 512, 142) - 0.5);
        bodies.push((
            (flame + ragged) * wide,
            mix(rgb(0x5e_7248), rgb(0x26_3a2c), ramp(-0.5, 0.5, middle / wide)),
        ));
    }
    bodies
}

/// The town.
fn town(x: f64, y: f64) -> Bodies {
    let block = |left: f64, right: f64, top: f64| (left - x).max(x - right).max(y - top);
    let mut bodies = Bodies::new();
    // Houses: a row of boxes with pitched roofs.
    for k in -9..=9_i32 {
        let dice = |what: i32| hash(k, what, 131);
        let middle = 2.1 * (dice(0) - 0.5) + 1.3 * f64::from(k);
        let (half, top) = (0.55 + 0.5 * dice(2), 0.5 + 0.9 * dice(1));
        let plaster = mix(rgb(0xd8_c0a0), rgb(0xb0_9478), ramp(-half, half, x - middle));
        bodies.push(((x - middle).abs() * 0.45 + y - top - 0.45 * half, rgb(0xb4_6a48)));
        bodies.push((block(middle - half, middle + half, top), plaster));
    }
    // The campanile.
    bodies.push((block(-3.5, -2.7, 4.9), mix(rgb(0xf2_e2c4), rgb(0xb4_987c), ramp(-3.5, -2.7, x))));
    bodies.push((block(-3.65, -2.55, 5.05).max(4.8 - y), rgb(0x9a_7c64)));
    // The cupola: drum, dome, ribs, lantern.
    let round = ramp(-2.6, 2.6, x - 0.6);
    bodies.push((block(-2.2, 3.4, 2.0), mix(rgb(0xf0_e0c4), rgb(0xa8_8c74), round)));
    let (dx, dy) = ((x - 0.6) / 2.3, (y - 2.0).max(0.0) / 2.9);
    let dome = ((dx * dx + dy * dy).sqrt() - 1.0).max((2.0 - y) / 3.0) * 2.3;
    bodies.push((dome, mix(rgb(0xd8_7c50), rgb(0x7c_3c2c), round)));
    let rib = (dx / (1.0 - dy * dy).max(0.01).sqrt()).clamp(-1.0, 1.0).asin() * 2.2;
    bodies.push((dome.max((rib - rib.round()).abs() - 0.06), rgb(0xf0_dcbc)));
    bodies.push((
        block(0.25, 0.95, 5.7).max(4.6 - y),
        mix(rgb(0xf4_e8d0), rgb(0xb8_9c84), ramp(0.25, 0.95, x)),
    ));
    bodies.push((((x - 0.6).abs() * 2.0 + y - 6.5).max(5.7 - y), rgb(0xc8_a878)));
    bodies
}
