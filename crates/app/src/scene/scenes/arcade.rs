//! An arcade after Brunelleschi's hospital: grey stone columns, round arches in a plastered wall, a roundel over
//! each column, an entablature. One side is described, the other is its mirror image.
//!
//! ```text
//!      ===========================   top      y
//!      |  o    ____    o   ____  |            ^
//!      |     /      \    /       |            |
//!      +----+        +--+        +   spring   +--> s = -z, seen from the nave
//!           ||       ||
//!           ||       ||               d: from the wall's face towards the nave
//!     ======^^=======^^===========
//! ```

use super::build::{Builder, Sides, TURN, Vec3};
use super::paint::{cover, grain, mix, paint, rgb};
use crate::scene::Image;

/// From the middle of the nave to the faces of its walls.
pub(super) const HALF_WIDTH: f64 = 2.6;
/// From column to column.
pub(super) const BAY: f64 = 3.0;
/// The height at which the arches begin.
pub(super) const SPRING: f64 = 3.3;
/// Their radius.
pub(super) const ARCH: f64 = 1.2;
/// The top of the entablature.
pub(super) const TOP: f64 = 5.7;
/// The thickness of the wall.
pub(super) const WALL: f64 = 0.5;
/// The z of the first column in sight.
pub(super) const FIRST: f64 = 2.0;
/// Columns a side.
pub(super) const COLUMNS: u32 = 9;

/// The textures of the arcade.
#[derive(Clone, Copy)]
pub(super) struct Stones {
    pub(super) pietra_serena: usize,
    pub(super) plaster: usize,
    pub(super) roundel: usize,
}

impl Stones {
    pub(super) fn new(b: &mut Builder) -> Self {
        Self {
            pietra_serena: b.texture(paint(128, 128, |u, v| grain(u, v, 6, 61, rgb(0xb0_a898), 0.28))),
            plaster: b.texture(paint(256, 256, |u, v| {
                let warm = grain(u, v, 3, 62, rgb(0xf0_dfbe), 0.16);
                mix(warm, grain(u, v, 32, 63, rgb(0xe2_c698), 0.12), 0.35)
            })),
            roundel: b.texture(roundel()),
        }
    }
}

/// One side of the nave: -1 left, 1 right.
pub(super) fn arcade(b: &mut Builder, side: f64, stones: Stones) {
    b.part("columns", Some(stones.pietra_serena));
    for k in 0..COLUMNS {
        column(b, [side * (HALF_WIDTH + WALL / 2.0), 0.0, FIRST - BAY * f64::from(k)], k);
    }
    b.part("wall", Some(stones.plaster));
    // The first bay comes before the first column: the picture's edge cuts through it.
    for k in 0..COLUMNS {
        bay(b, side, BAY * f64::from(k) - FIRST - BAY / 2.0, k);
    }
    b.part("trim", Some(stones.pietra_serena));
    for k in 0..COLUMNS {
        archivolt(b, side, BAY * f64::from(k) - FIRST - BAY / 2.0, k);
    }
    entablature(b, side);
    b.part("roundels", Some(stones.roundel));
    for k in 0..COLUMNS {
        medallion(b, side, BAY * f64::from(k) - FIRST, k);
    }
}

/// Fewer faces further away: what is left out is smaller than a pixel.
fn detail(k: u32, near: u32, far: u32) -> u32 {
    match k {
        0..=1 => near,
        2..=3 => u32::midpoint(near, far),
        _ => far,
    }
}

/// A face given in (d, y, s), counter-clockwise seen from the left wall's nave side, put on either side.
fn put(b: &mut Builder, side: f64, corners: &[(Vec3, [f64; 2])]) {
    let place = |&([d, y, s], uv): &(Vec3, [f64; 2])| ([side * (HALF_WIDTH - d), y, -s], uv);
    let mut face: Vec<_> = corners.iter().map(place).collect();
    // The mirror image turns the other way.
    if side > 0.0 {
        face.reverse();
    }
    b.face(&face);
}

/// Plinth, torus, shaft with entasis, necking, bell and abacus.
fn column(b: &mut Builder, foot: Vec3, k: u32) {
    const BELOW: f64 = SPRING - 0.16;
    b.lathe(foot, Sides::prism(4), &[[0.50, 0.0], [0.50, 0.14], [0.0, 0.14]], 2.0, 1.0);
    let shaft = [
        [0.33, 0.14],
        [0.36, 0.19],
        [0.33, 0.25],
        [0.27, 0.28],
        [0.26, 0.36],
        [0.262, 1.3],
        [0.225, BELOW - 0.50],
        [0.26, BELOW - 0.46],
        [0.235, BELOW - 0.42],
        [0.26, BELOW - 0.16],
        [0.36, BELOW],
    ];
    if k < 4 {
        b.lathe(foot, Sides::round(detail(k, 24, 12)), &shaft, 2.0, 1.0);
    } else {
        let plain = [shaft[1], shaft[4], shaft[6], shaft[9], shaft[10]];
        b.lathe(foot, Sides::round(8), &plain, 2.0, 1.0);
    }
    b.lathe(foot, Sides::prism(4), &[[0.0, BELOW], [0.56, BELOW], [0.56, SPRING], [0.0, SPRING]], 2.0, 1.0);
}

/// A point of the arch over the bay around `s`, at `turn` of the half circle from the left.
fn on_arch(s: f64, radius: f64, turn: f64) -> [f64; 2] {
    let (sin, cos) = (TURN / 2.0 * turn).sin_cos();
    [SPRING + radius * sin, s - radius * cos]
}

/// The wall over one opening, and the underside of its arch.
fn bay(b: &mut Builder, side: f64, s: f64, k: u32) {
    let steps = detail(k, 20, 8);
    let uv = |y: f64, s: f64| [s / 2.0, y / 2.0];
    let flat = |[y, s]: [f64; 2]| ([0.0, y, s], uv(y, s));
    let half = BAY / 2.0;
    for (from, to) in [(s - half, s - ARCH), (s + ARCH, s + half)] {
        put(b, side, &[[SPRING, from], [SPRING, to], [TOP, to], [TOP, from]].map(flat));
    }
    for i in 0..steps {
        let turn = |i: u32| f64::from(i) / f64::from(steps);
        let (p, q) = (on_arch(s, ARCH, turn(i)), on_arch(s, ARCH, turn(i + 1)));
        put(b, side, &[p, q, [TOP, q[1]], [TOP, p[1]]].map(flat));
        let under = |[y, s]: [f64; 2], depth: f64, i: u32| ([-depth, y, s], [depth, 1.9 * turn(i)]);
        put(b, side, &[under(p, 0.0, i), under(p, WALL, i), under(q, WALL, i + 1), under(q, 0.0, i + 1)]);
    }
}

/// The grey band around an arch, a little in front of the plaster.
fn archivolt(b: &mut Builder, side: f64, s: f64, k: u32) {
    let steps = detail(k, 20, 8);
    for i in 0..steps {
        let turn = |i: u32| f64::from(i) / f64::from(steps);
        let corner = |radius: f64, d: f64, i: u32| {
            let [y, s] = on_arch(s, radius, turn(i));
            ([d, y, s], [radius, 3.8 * turn(i)])
        };
        let outer = ARCH + 0.24;
        put(
            b,
            side,
            &[
                corner(ARCH, 0.04, i),
                corner(ARCH, 0.04, i + 1),
                corner(outer, 0.04, i + 1),
                corner(outer, 0.04, i),
            ],
        );
        // Its edge towards the opening.
        put(
            b,
            side,
            &[
                corner(ARCH, 0.04, i),
                corner(ARCH, 0.0, i),
                corner(ARCH, 0.0, i + 1),
                corner(ARCH, 0.04, i + 1),
            ],
        );
    }
}

/// Architrave, frieze and cornice along the whole wall.
fn entablature(b: &mut Builder, side: f64) {
    let (start, end) = (-FIRST - BAY, BAY * f64::from(COLUMNS) - FIRST);
    let profile = [
        [0.0, TOP - 0.75],
        [0.07, TOP - 0.75],
        [0.07, TOP - 0.52],
        [0.13, TOP - 0.48],
        [0.05, TOP - 0.46],
        [0.05, TOP - 0.24],
        [0.30, TOP - 0.10],
        [0.30, TOP],
        [-WALL, TOP],
    ];
    for (i, pair) in (0_u32..).zip(profile.windows(2)) {
        let v = f64::from(i) * 0.3;
        let corner = |[d, y]: [f64; 2], s: f64, dv: f64| ([d, y, s], [s, v + dv]);
        let (low, high) = (pair[0], pair[1]);
        put(
            b,
            side,
            &[
                corner(low, start, 0.0),
                corner(low, end, 0.0),
                corner(high, end, 0.3),
                corner(high, start, 0.3),
            ],
        );
    }
}

/// A glazed roundel in the spandrel over a column.
fn medallion(b: &mut Builder, side: f64, s: f64, k: u32) {
    let steps = detail(k, 20, 8);
    let face: Vec<_> = (0..steps)
        .map(|i| {
            let (sin, cos) = (TURN * f64::from(i) / f64::from(steps)).sin_cos();
            ([0.03, SPRING + 1.12 + 0.30 * sin, s + 0.30 * cos], [0.5 + 0.5 * cos, 0.5 + 0.5 * sin])
        })
        .collect();
    put(b, side, &face);
}

/// White relief on blue in a green and gold rim.
fn roundel() -> Image {
    paint(128, 128, |u, v| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        let r = (x * x + y * y).sqrt();
        let petals = 0.52 + 0.16 * (5.0 * y.atan2(x)).sin();
        let blue = grain(u, v, 6, 71, rgb(0x2c_5aa0), 0.3);
        let flower = mix(blue, rgb(0xf6_f0e0), cover(r - petals, 0.03));
        let heart = mix(flower, rgb(0xe0_b040), cover(r - 0.16, 0.03));
        let wreath = mix(heart, rgb(0x4c_6a3a), cover(0.80 - r, 0.03));
        mix(wreath, rgb(0xe8_d8b0), cover(0.93 - r, 0.03))
    })
}
