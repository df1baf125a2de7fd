//! Lines against the definition of their pixels in rational numbers, and their attributes against reals.
#![expect(clippy::cast_precision_loss, reason = "numbers are small")]

use super::*;
use crate::{Cull, D16, Exact, F32, FixedPoint, NoDepth, Numbers, Spans16, Target, Vertex};
use alberti_math::{Fixed, Flat, Linear, Rgba8, Rgba8888, Sub8};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::vec;
use std::vec::Vec;

const SIDE: i32 = 6;
const BITS: u32 = 4;
const ONE: i64 = 1 << BITS;

/// Whether a line leaves the diamond about a pixel's centre: it is in it somewhere, and does not end in it.
fn leaves([a, b]: [[i64; 2]; 2], pixel: [i64; 2]) -> bool {
    let half = ONE / 2;
    let centre = pixel.map(|c| c * ONE + half);
    let [ax, ay] = [a[0] - centre[0], a[1] - centre[1]];
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let steep = dx.abs() < dy.abs();
    // Each edge as p + t d <= half, where the two lower ones belong to the diamond.
    let edges = [
        (ax + ay, dx + dy, true),
        (ay - ax, dy - dx, true),
        (ax - ay, dx - dy, false),
        (-ax - ay, -dx - dy, false),
    ];
    let inside = |x: i64, y: i64| {
        let apart = x.abs() + y.abs();
        apart < half || (apart == half && (y > 0 || (steep && y == 0 && x > 0)))
    };
    if inside(b[0] - centre[0], b[1] - centre[1]) {
        return false;
    }
    // The greatest lower and the least upper bound of t, as fractions with positive denominators.
    let (mut low, mut high) = ((0_i64, 1_i64, true), (1_i64, 1_i64, true));
    for (p, d, closed) in edges {
        let (n, m) = (half - p, d);
        if m == 0 {
            if n < 0 || (n == 0 && !closed) {
                return at_right_corner(ax, ay, dx, dy, half, steep);
            }
        } else if m > 0 {
            let (l, r) = (n * high.1, high.0 * m);
            if l < r || (l == r && !closed) {
                high = (n, m, closed);
            }
        } else {
            let (n, m) = (-n, -m);
            let (l, r) = (n * low.1, low.0 * m);
            if l > r || (l == r && !closed) {
                low = (n, m, closed);
            }
        }
    }
    let (l, r) = (low.0 * high.1, high.0 * low.1);
    l < r || (l == r && low.2 && high.2) || at_right_corner(ax, ay, dx, dy, half, steep)
}

/// Whether a steep line passes through the corner at (half, 0).
fn at_right_corner(ax: i64, ay: i64, dx: i64, dy: i64, half: i64, steep: bool) -> bool {
    let (low, high) = (ay.min(ay + dy), ay.max(ay + dy));
    steep && (half - ax) * dy == -ay * dx && low <= 0 && high >= 0
}

/// The pixels that are drawn, and whether one was drawn twice.
fn drawn(line: [[i64; 2]; 2]) -> Vec<[i64; 2]> {
    let limits = [0..SIDE, 0..SIDE];
    let places = line.map(|point| point.map(|c| i32::try_from(c).expect("small")));
    Walk::new(places, BITS, &limits).map(|(place, _)| place.map(i64::from)).collect()
}

fn is_right(line: [[i64; 2]; 2]) {
    let found = drawn(line);
    let set: BTreeSet<[i64; 2]> = found.iter().copied().collect();
    assert_eq!(set.len(), found.len(), "{line:?}: a pixel twice");
    let side = i64::from(SIDE);
    let all = (0..side).flat_map(|y| (0..side).map(move |x| [x, y]));
    let expected: BTreeSet<[i64; 2]> =
        all.filter(|pixel| line[0] != line[1] && leaves(line, *pixel)).collect();
    assert_eq!(set, expected, "{line:?}");
}

#[test]
fn pixels_are_those_whose_diamonds_a_line_leaves() {
    // All lines between points a quarter of a pixel apart, and some between any.
    let points: Vec<[i64; 2]> =
        (0..12).flat_map(|y| (0..12).map(move |x| [x * 4 + 16, y * 4 + 16])).collect();
    for a in &points {
        for b in &points {
            is_right([*a, *b]);
        }
    }
    let mut state = 7_u64;
    let mut random = |range: i64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        i64::try_from(state >> 33).expect("31 bits") % range
    };
    for _ in 0..30_000 {
        let mut point = || [random(200) - 50, random(200) - 50];
        is_right([point(), point()]);
    }
}

/// Windows of a frame have of a line those of its pixels that are in them, so far along it as in the whole frame. Lines
/// are of any length, so that divisions are of 32 and of 64 bits.
#[test]
fn windows_have_the_pixels_of_the_whole_line() {
    let mut state = 11_u64;
    let mut random = |range: i64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        i64::try_from(state >> 33).expect("31 bits") % range
    };
    let mut drawn = 0;
    for k in 0..40_000 {
        let size = [300, 3000, 1 << 14, 1 << 23][k % 4];
        let mut point = || [random(2 * size) - size, random(2 * size) - size];
        let line = [point(), point()];
        // A window about a point of the line, or near it.
        let (t, off) = (random(1001), random(9) - 4);
        let middle = [0, 1].map(|c: usize| {
            let place = line[0][c] + (line[1][c] - line[0][c]) * t / 1000;
            (place >> BITS) + off * i64::from(u8::from(c == 0))
        });
        let sides = [random(7) + 1, random(7) + 1];
        let window = [0, 1].map(|c: usize| middle[c] - sides[c] / 2..middle[c] - sides[c] / 2 + sides[c]);
        let limits = window.clone().map(|range| {
            i32::try_from(range.start).expect("small")..i32::try_from(range.end).expect("small")
        });
        let places = line.map(|point| point.map(|c| i32::try_from(c).expect("small")));
        let found: Vec<([i32; 2], i32)> = Walk::new(places, BITS, &limits).collect();
        let mut pixels: Vec<[i64; 2]> = found.iter().map(|(place, _)| place.map(i64::from)).collect();
        pixels.sort_unstable();
        let [columns, rows] = window;
        let all = columns.flat_map(|x| rows.clone().map(move |y| [x, y]));
        let expected: Vec<[i64; 2]> =
            all.filter(|pixel| line[0] != line[1] && leaves(line, *pixel)).collect();
        assert_eq!(pixels, expected, "{line:?} in {limits:?}");
        assert!(found.is_empty() || !misses(places, BITS, &limits), "{line:?} in {limits:?}");
        let axis = usize::from((line[0][0] - line[1][0]).abs() < (line[0][1] - line[1][1]).abs());
        let length = (line[1][axis] - line[0][axis]).abs();
        for (place, far) in found {
            let centre = i64::from(place[axis]) * ONE + ONE / 2;
            let way = (centre - line[0][axis]) * (line[1][axis] - line[0][axis]).signum();
            assert_eq!(i64::from(far.max(0)), way.clamp(0, length), "{line:?} {place:?}");
            drawn += 1;
        }
    }
    assert!(drawn > 60_000, "{drawn} pixels");
}

/// Depths by sums are within their bounds of reals, between the ends, and the same wherever the sums begin.
#[test]
fn depths_are_those_of_the_line() {
    let mut state = 3_u64;
    let mut random = |range: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 20) % range
    };
    for k in 0..20_000 {
        let length = 1 + random([40, 3000, 1 << 17, 1 << 24][k % 4]);
        let length = i32::try_from(length).expect("24 bits");
        let mut depth = || match random(5) {
            0 => 0,
            1 => i32::MAX as u32,
            _ => u32::try_from(random(1 << 31)).expect("31 bits"),
        };
        let words = [depth(), depth()];
        let corners = |zs: u32| Corner::<()> { zs, ..Corner::NONE };
        let [a, b] = words.map(corners);
        let first = i32::try_from(random(u64::from(length.cast_unsigned()) + 16)).expect("24 bits") - 16;
        let mut sums = FixedSegment::new([&a, &b], length, [first, 16]);
        let [c, d] = words.map(|word| corners((word as f32 / (1_u32 << 31) as f32).to_bits()));
        let mut floats = FloatSegment::new([&c, &d], length);
        let greatest = f64::from(c.zs().max(d.zs()));
        for far in (first..=length).step_by(16).take(400) {
            let t = f64::from(far.max(0)) / f64::from(length);
            let [from, to] = words.map(f64::from);
            let exact = from + (to - from) * t;
            let found = Segment::<OneFixed, ()>::depth(&mut sums, OneFixed, far);
            let again = FixedSegment::new([&a, &b], length, [far, 16]);
            let again = Segment::<OneFixed, ()>::depth(&mut { again }, OneFixed, far);
            assert_eq!(found, again, "{words:?} {far} of {length}");
            // Depth formats take twice as much.
            let found = found >> 1;
            assert!((words[0].min(words[1])..=words[0].max(words[1])).contains(&found), "{words:?} {found}");
            let allowed = 1.0 + (to - from).abs() / f64::from(1 << 28);
            assert!((f64::from(found) - exact).abs() <= allowed, "{words:?} {far} of {length}: {found}");
            let exact = f64::from(c.zs()) + (f64::from(d.zs()) - f64::from(c.zs())) * t;
            let found = f64::from(Segment::<One, ()>::depth(&mut floats, One, far));
            assert!((found - exact).abs() <= 9.0 / f64::from(1 << 24) * greatest, "{found} {exact}");
        }
    }
}

/// Lines that go on to the right draw each column once.
#[test]
fn a_path_has_each_column_once() {
    let path = [[17, 20], [29, 31], [30, 31], [40, 30], [71, 5], [88, 21]];
    let all: Vec<i64> = path.windows(2).flat_map(|pair| drawn([pair[0], pair[1]])).map(|[x, _]| x).collect();
    // From the pixel that the path begins in to the one before that which it ends in.
    assert_eq!(all, [1, 2, 3, 4]);
}

type Carried = (f32, Linear<f32>, Flat<f32>);

fn corner(numbers: Numbers, at: [f32; 2], zs: f32, q: f32, values: [f32; 3]) -> Corner<Carried> {
    let place = at.map(|c| Fixed::snap(Sub8, 0, c).expect("small"));
    let [hyperbolic, linear, flat] = values;
    let varying = (hyperbolic, Linear(linear), Flat(flat));
    Corner::new(numbers, &Vertex { x: place[0], y: place[1], zs, q, varying })
}

/// The fragments of a line, with the weight of its second end, and its stored depths.
fn fragments(
    interpolation: impl Interpolation,
    ends: [([f32; 2], f32, f32, [f32; 3]); 2],
) -> (Vec<(i32, Carried)>, Vec<u16>) {
    const WIDTH: u32 = 64;
    let (mut color, mut depth) = (vec![0; 64 * 64], vec![u16::MAX; 64 * 64]);
    let mut target = Target::new(Rgba8888, D16, WIDTH, WIDTH, &mut color, &mut depth).expect("a frame");
    let seen = RefCell::new(Vec::new());
    let stage = |varying: Carried| {
        seen.borrow_mut().push(varying);
        Some(Rgba8::WHITE)
    };
    let paint = Paint { stage: &stage, interpolation, subpixel: Sub8, cull: Cull::None };
    let numbers = paint.numbers(D16);
    let [a, b] = ends.map(|(at, zs, q, values)| corner(numbers, at, zs, q, values));
    paint.line(&mut target, [&a, &b], &mut ());
    let columns = (0..).zip(color.chunks(64)).flat_map(|(_, row): (i32, &[u32])| {
        (0..).zip(row).filter(|(_, pixel)| **pixel != 0).map(|(column, _)| column).collect::<Vec<i32>>()
    });
    let mut columns: Vec<i32> = columns.collect();
    columns.sort_unstable();
    let depths = depth.iter().copied().filter(|depth| *depth != u16::MAX).collect();
    (columns.into_iter().zip(seen.into_inner()).collect(), depths)
}

#[test]
fn attributes_are_those_of_the_line() {
    let ends = [([3.25, 10.5], 0.2, 1.0, [-3.0, 2.0, 7.0]), ([60.75, 31.0], 0.6, 0.125, [5.0, -1.0, 9.0])];
    let (a, b) = (ends[0], ends[1]);
    let check = |found: Vec<(i32, Carried)>, depths: Vec<u16>, allowed: f64| {
        assert_eq!((found.len(), depths.len()), (58, 58));
        for ((column, (hyperbolic, Linear(linear), Flat(flat))), depth) in found.into_iter().zip(depths) {
            let t = (f64::from(column) + 0.5 - 3.25) / 57.5;
            let along = |a: f32, b: f32| f64::from(a) + (f64::from(b) - f64::from(a)) * t;
            let q = along(a.2, b.2);
            let exact = along(a.3[0] * a.2, b.3[0] * b.2) / q;
            assert!((f64::from(hyperbolic) - exact).abs() <= allowed, "{column}: {hyperbolic} {exact}");
            assert!((f64::from(linear) - along(a.3[1], b.3[1])).abs() <= allowed, "{column}");
            assert!((flat - 7.0).abs() < 1e-6);
            let steps = along(a.1, b.1) * 65535.0;
            assert!((f64::from(depth) - steps).abs() <= 0.51, "{column}: {depth} {steps}");
        }
    };
    // 8ε of the greatest value, which is 5.
    let (found, depths) = fragments(Exact, ends);
    check(found, depths, 8.0 * 5.0 / f64::from(1 << 24));
    let (found, depths) = fragments(FixedPoint(Spans16), ends);
    check(found, depths, 1.0 / 32768.0 + 8.0 / f64::from(1 << 28));
}

/// The pixels of a point, by its place and its size.
fn point(at: [f32; 2], size: u16, interpolation: impl Interpolation) -> Vec<usize> {
    let (mut color, mut depth) = (vec![0; 8 * 8], vec![(); 8 * 8]);
    let mut target = Target::new(Rgba8888, NoDepth, 8, 8, &mut color, &mut depth).expect("a frame");
    let stage = |_: Carried| Some(Rgba8::WHITE);
    let paint = Paint { stage, interpolation, subpixel: Sub8, cull: Cull::None };
    let corner = corner(paint.numbers(NoDepth), at, 0.5, 1.0, [0.0; 3]);
    paint.point(&mut target, &corner, size, &mut ());
    (0..64).filter(|k| color[*k] != 0).collect()
}

/// All pixels of a point have its depth and attributes, to the bit.
#[test]
fn points_are_their_corner() {
    fn check(interpolation: impl Interpolation, values: [f32; 3]) {
        let (mut color, mut depth) = (vec![0; 8 * 8], vec![1.0; 8 * 8]);
        let mut target = Target::new(Rgba8888, F32, 8, 8, &mut color, &mut depth).expect("a frame");
        let seen = RefCell::new(Vec::new());
        let stage = |varying: Carried| {
            seen.borrow_mut().push(varying);
            Some(Rgba8::WHITE)
        };
        let paint = Paint { stage: &stage, interpolation, subpixel: Sub8, cull: Cull::None };
        let corner = corner(paint.numbers(F32), [4.2, 3.9], 0.375, 0.7, values);
        paint.point(&mut target, &corner, 3, &mut ());
        let [a, b, c] = values;
        assert_eq!(seen.into_inner(), [(a, Linear(b), Flat(c)); 9]);
        assert_eq!(depth.iter().filter(|depth| depth.to_bits() == 0.375_f32.to_bits()).count(), 9);
    }
    check(Exact, [0.1, -3.7, 1e9]);
    check(FixedPoint(Spans16), [0.125, -3.5, 17.0625]);
}

#[test]
fn points_are_squares_about_their_place() {
    for interpolation in [true, false] {
        let drawn = |at: [f32; 2], size: u16| {
            if interpolation { point(at, size, Exact) } else { point(at, size, FixedPoint(Spans16)) }
        };
        for (x, y) in (0..120).map(|k| (k as f32 * 0.0625, 7.3 - k as f32 * 0.06)) {
            for size in 0..4_u16 {
                // On the grid.
                let [px, py] = [x, y].map(|c| (c * 256.0).round() / 256.0);
                let half = f32::from(size) / 2.0;
                let within = |k: usize| {
                    let [cx, cy] = [(k % 8) as f32 + 0.5, (k / 8) as f32 + 0.5];
                    px - half <= cx && cx < px + half && py - half <= cy && cy < py + half
                };
                let expected: Vec<usize> = (0..64).filter(|k| within(*k)).collect();
                assert_eq!(drawn([x, y], size), expected, "{x} {y} {size}");
            }
        }
    }
}
