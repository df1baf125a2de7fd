//! Pixels against their definition: which samples are a triangle's in integers, and what these carry in `f64`.
#![expect(clippy::cast_precision_loss, reason = "numbers are small")]

use super::*;
use crate::{Affine, Exact, FixedPoint, NoDepth, Planes};
use alberti_math::lanes::Machine;
use alberti_math::{Fixed, Rgba8888, for_lanes};
use std::vec;
use std::vec::Vec;

/// Columns that are no whole number of lanes, and rows.
const SIZE: [u32; 2] = [83, 61];
/// Words that no varying has.
const EMPTY: u32 = u32::MAX;

/// A corner in subpixels, 256 to a pixel; q, and what it carries.
type Given = ([i64; 2], f32, f32);

/// Twice the area of a, b and p, positive if they run clockwise.
fn area([a, b, p]: [[i64; 2]; 3]) -> i64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// The side of an edge on which a sample lies that is moved by an infinitesimal (e, e²).
fn side([a, b, p]: [[i64; 2]; 3]) -> i64 {
    let signs = [area([a, b, p]), a[1] - b[1], b[0] - a[0]];
    signs.into_iter().find(|&sign| sign != 0).map_or(0, i64::signum)
}

/// The number that a sample carries, if it is the triangle's.
fn carried([(a, qa, ua), (b, qb, ub), (c, qc, uc)]: [Given; 3], p: [i64; 2]) -> Option<f64> {
    let edges = [[b, c, p], [c, a, p], [a, b, p]];
    let sides = edges.map(side);
    if sides[0] == 0 || sides != [sides[0]; 3] {
        return None;
    }
    let [wa, wb, wc] = [0, 1, 2].map(|k| area(edges[k]) as f64 * f64::from([qa, qb, qc][k]));
    Some((wa * f64::from(ua) + wb * f64::from(ub) + wc * f64::from(uc)) / (wa + wb + wc))
}

/// The words of what a triangle's pixels carry.
fn drawn<L: Floating>(lanes: L, interpolation: impl Interpolation, triangle: [Given; 3]) -> Vec<u32> {
    let count = (SIZE[0] * SIZE[1]) as usize;
    let (mut color, mut depth) = (vec![EMPTY; count], vec![(); count]);
    let mut target =
        Target::new(Rgba8888, NoDepth, SIZE[0], SIZE[1], &mut color, &mut depth).expect("pixels");
    let [a, b, c] = triangle.map(|(place, q, varying)| {
        let [x, y] = place.map(|c| Fixed::wrapping(i32::try_from(c).expect("small")));
        Vertex { x, y, zs: 0.5, q, varying }
    });
    let stage = |u: f32| Some(u.to_bits());
    let paint = Paint { stage, interpolation, subpixel: Sub8, cull: Cull::None };
    paint.triangle(lanes, &mut target, [&a, &b, &c], &mut ());
    color
}

/// Triangles within and beside the target, of some pixels and of many, half of their corners on samples or halfway
/// between. Each has q that differ by a factor of two at most, or are all the same.
fn triangles(level: bool) -> Vec<[Given; 3]> {
    let mut state = 1_u64;
    let mut random = |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % below
    };
    let mut all = Vec::new();
    for k in 0..600_u64 {
        let extent = [6, 12, 30, 90][(k % 4) as usize] * 256;
        let origin = [random(70), random(50)].map(|c| c * 256);
        all.push([(); 3].map(|()| {
            let place = origin.map(|origin| {
                let place = (origin + random(extent)).cast_signed() - 5 * 256;
                if k % 8 < 4 { place & !127 } else { place }
            });
            let q = if level { 1.0 } else { 1.0 + random(1000) as f32 / 1000.0 };
            (place, q, random(4001) as f32 / 1000.0 - 2.0)
        }));
    }
    all
}

/// Compares all pixels: those that are the triangle's, and what they carry, within so much of it.
fn check<L: Floating>(lanes: L, interpolation: impl Interpolation, level: bool, bound: f64) {
    let (mut covered, mut on_edges) = (0, 0);
    for triangle in triangles(level) {
        let [a, b, c] = triangle.map(|(place, ..)| place);
        for (pixel, number) in drawn(lanes, interpolation, triangle).into_iter().zip(0..) {
            let place = [number % SIZE[0], number / SIZE[0]];
            let sample = place.map(|c| i64::from(256 * c + 128));
            let expected = carried(triangle, sample);
            assert_eq!(pixel != EMPTY, expected.is_some(), "{triangle:?} at {place:?}");
            if let Some(expected) = expected {
                let off = (f64::from(f32::from_bits(pixel)) - expected).abs();
                assert!(off <= bound, "{interpolation:?}: {triangle:?} at {place:?}, {off} off");
                covered += 1;
                on_edges +=
                    u32::from([[a, b], [b, c], [c, a]].iter().any(|&[a, b]| area([a, b, sample]) == 0));
            }
        }
    }
    assert!(covered > 30_000 && on_edges > 100, "{covered}, {on_edges}");
}

#[test]
fn pixels_are_those_of_the_triangle_and_carry_what_is_there() {
    for machine in Machine::all() {
        for_lanes!(machine, lanes => {
            // 9 and 15 r + 5 with r = 2, in 2^-24 of the greatest, which is 2.
            check(lanes, Exact, false, 18.0 / 16_777_216.0);
            check(lanes, Planes, false, 70.0 / 16_777_216.0);
        });
    }
}

#[test]
fn pixels_in_fixed_point_are_those_of_the_triangle_too() {
    // As many steps of 2^-16 as there are columns, three, and less than one for the columns of slopes.
    check(One, FixedPoint(Affine), true, (83.0 + 4.0) / 65_536.0);
}
