//! The way that each triangle goes under a budget: told by the bits, which are those of the policy that draws it.
//!
//! One kernel for all lines, and those of planes and of exact triangles, on every kind of lanes.
#![allow(clippy::cast_possible_truncation, reason = "subpixels are within the frame")]

use alberti::glam::Vec2;
use alberti::lanes::{Floating, Machine, One};
use alberti::{Cull, Exact, F32, Interpolation, Lines, Planes, Rgba8, Rgba8888, Sub8, Target, for_lanes};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::{Corner, Paint, Vertex};
use alberti_tests::probe::vertex;
use std::ops::Range;

const SIZE: [usize; 2] = [200, 150];
const WIDTH: f64 = 200.0;
const HEIGHT: f64 = 150.0;

type Triangle = [Vertex<Vec2>; 3];

/// Colours and depths of a frame.
#[derive(Clone, PartialEq)]
struct Picture {
    color: Vec<u32>,
    depth: Vec<f32>,
}

impl Picture {
    fn new() -> Self {
        Self { color: vec![0; SIZE[0] * SIZE[1]], depth: vec![1.0; SIZE[0] * SIZE[1]] }
    }

    /// The bits of the pixels that some triangles have by a policy, in these columns and rows.
    fn draw(
        &mut self,
        policy: impl Interpolation,
        lanes: impl Floating,
        triangles: &[Triangle],
        [columns, rows]: [Range<usize>; 2],
    ) {
        let pixels = rows.start * SIZE[0]..rows.end * SIZE[0];
        let (color, depth) = (&mut self.color[pixels.clone()], &mut self.depth[pixels]);
        let [size, place] = [SIZE, [columns.start, columns.end]].map(|n| n.map(|n| n as u32));
        let mut band = Target::band(Rgba8888, F32, size, rows.start as u32, color, depth).expect("rows");
        let columns = place[0].cast_signed()..place[1].cast_signed();
        let mut target = band.scissor(columns, 0..i32::MAX);
        let stage = |v: Vec2| {
            let [u, v] = v.to_array().map(f32::to_bits);
            Some(Rgba8::from_bits(u ^ v.rotate_left(11) | 1))
        };
        let paint = Paint { stage, interpolation: policy, subpixel: Sub8, cull: Cull::None };
        let numbers = paint.numbers(F32);
        let corners: Vec<_> =
            triangles.iter().map(|t| t.each_ref().map(|vertex| Corner::new(numbers, vertex))).collect();
        let mut batch = paint.batch(lanes, &mut target);
        for [a, b, c] in &corners {
            batch.triangle([a, b, c], &mut ());
        }
        batch.finish(&mut ());
    }
}

const WHOLE: [Range<usize>; 2] = [0..SIZE[0], 0..SIZE[1]];

fn picture(policy: impl Interpolation, triangles: &[Triangle]) -> Picture {
    let mut picture = Picture::new();
    picture.draw(policy, One, triangles, WHOLE);
    picture
}

/// A triangle of these corners in pixels, of q, and of values from -1 to 1.
fn triangle(rng: &mut Rng, corners: [[f64; 2]; 3], q: [f32; 3]) -> Triangle {
    [0, 1, 2].map(|i| {
        let place = corners[i].map(|c| (c * 256.0).round() as i64);
        let values = [(); 2].map(|()| rng.uniform(-1.0, 1.0) as f32);
        vertex(place, rng.unit() as f32, q[i], Vec2::from_array(values))
    })
}

/// A triangle in a box of at least this width, within some columns.
fn wide(rng: &mut Rng, columns: Range<f64>, width: f64, q: [f32; 3]) -> Triangle {
    let left = rng.uniform(columns.start, columns.end - width);
    let right = rng.uniform(left + width, columns.end);
    let between = rng.uniform(left, right);
    let mut rows = || rng.uniform(0.0, HEIGHT);
    let corners = [[left, rows()], [right, rows()], [between, rows()]];
    triangle(rng, corners, q)
}

const COLUMNS: Range<f64> = 0.0..WIDTH;

/// q of three vertices from 1 to this, both of which some have.
fn steep(rng: &mut Rng, ratio: f32) -> [f32; 3] {
    let mut q = [1.0, ratio, rng.uniform(1.0, f64::from(ratio)) as f32];
    q.rotate_left(rng.index(3));
    q
}

/// A triangle of which q is the same along each row: of two vertices in a row, and for the rest.
fn level(rng: &mut Rng, ratio: f32) -> Triangle {
    let left = rng.uniform(0.0, 60.0);
    let right = rng.uniform(left + 65.0, WIDTH);
    let [row, other] = [rng.uniform(0.0, 60.0), rng.uniform(80.0, 150.0)];
    let tip = rng.uniform(0.0, WIDTH);
    triangle(rng, [[left, row], [right, row], [tip, other]], [1.0, 1.0, ratio])
}

fn spans_of_64() -> Lines {
    Lines::spans(64).expect("a power of two")
}

/// Perspective that is nowhere, within one run of `Affine`, is not computed.
#[test]
fn without_perspective_bits_are_those_of_affine() {
    let mut rng = Rng::stream(run_seed(), 1);
    for _ in 0..300 {
        let q = [rng.log_uniform(1e-3, 1e3); 3];
        let triangles = [wide(&mut rng, 64.0..128.0, 33.0, q)];
        let found = picture(Lines::bounded(1e-9), &triangles);
        assert!(found == picture(Lines::affine(), &triangles), "{triangles:?}");
    }
}

/// Where q is the same along rows, straight lines have no end but at every 64th column, however steep the triangle.
#[test]
fn level_rows_are_long_lines() {
    let mut rng = Rng::stream(run_seed(), 2);
    let mut apart = 0;
    for _ in 0..300 {
        let ratio = rng.log_uniform(1.2, 100.0);
        let ratio = if rng.one_in(2) { ratio } else { 1.0 / ratio };
        let triangles = [level(&mut rng, ratio)];
        let found = picture(Lines::bounded(1e-3), &triangles);
        assert!(found == picture(spans_of_64(), &triangles), "{triangles:?}");
        apart += u32::from(found != picture(Exact, &triangles));
    }
    assert!(apart > 250, "{apart}");
}

/// Where one way of lines after the other is too far off, and in boxes of up to 32 columns.
#[test]
fn steep_and_narrow_triangles_are_exact() {
    let mut rng = Rng::stream(run_seed(), 3);
    let mut drawn = 0;
    for turn in 0..600 {
        let triangles = if turn % 2 == 0 {
            let ratio = rng.log_uniform(2.0, 1e4);
            let q = steep(&mut rng, ratio);
            [wide(&mut rng, COLUMNS, 33.0, q)]
        } else {
            let q = steep(&mut rng, 1.01);
            let left = rng.uniform(0.0, 160.0);
            [wide(&mut rng, left..left + 32.0, 4.0, q)]
        };
        // In what is not steep along rows, a budget above rounding would allow lines.
        let found = picture(Lines::bounded(if turn % 2 == 0 { 1e-9 } else { 1.0 }), &triangles);
        assert!(found == picture(Exact, &triangles), "{triangles:?}");
        drawn += u32::from(found != Picture::new());
    }
    assert!(drawn > 500, "{drawn}");
}

/// The number of a triangle's way in their order, by its bits.
fn way(budget: f32, triangle: &Triangle) -> usize {
    let triangles = [*triangle];
    let found = picture(Lines::bounded(budget), &triangles);
    if found == picture(Exact, &triangles) {
        3
    } else if found == picture(Planes, &triangles) {
        2
    } else {
        usize::from(found == picture(spans_of_64(), &triangles))
    }
}

/// Where q falls steeply along rows, a budget above the rounding of planes allows these, and one below does not.
#[test]
fn planes_are_for_budgets_above_their_rounding() {
    const EPS: f64 = 1.0 / (1 << 24) as f64;
    let mut rng = Rng::stream(run_seed(), 6);
    let mut apart = 0;
    for _ in 0..300 {
        let ratio = rng.log_uniform(3.0, 1e3);
        let q = steep(&mut rng, ratio);
        let triangles = [wide(&mut rng, COLUMNS, 33.0, q)];
        let largest =
            triangles[0].iter().flat_map(|v| v.varying.to_array()).fold(0.0, |m, u: f32| u.abs().max(m));
        let rounding = (15.0 * f64::from(ratio) + 5.0) * EPS * f64::from(largest);
        // Those that are moved to subpixels have other ratios and values, by a few hundredths.
        let above = picture(Lines::bounded((1.3 * rounding) as f32), &triangles);
        assert!(
            above == picture(Planes, &triangles) || above == picture(spans_of_64(), &triangles),
            "{triangles:?}"
        );
        let below = picture(Lines::bounded((0.7 * rounding) as f32), &triangles);
        assert!(
            below == picture(Exact, &triangles) || below == picture(spans_of_64(), &triangles),
            "{triangles:?}"
        );
        apart += u32::from(above != below);
    }
    assert!(apart > 200, "{apart}");
}

/// Twice the budget never asks for a dearer way, and each way has budgets that lead to it.
#[test]
fn a_greater_budget_is_never_dearer() {
    let mut rng = Rng::stream(run_seed(), 4);
    let mut seen = [0; 4];
    for _ in 0..60 {
        let ratio = rng.log_uniform(1.001, 2.0);
        let q = steep(&mut rng, ratio);
        let triangle = wide(&mut rng, COLUMNS, 66.0, q);
        if picture(Exact, &[triangle]) == picture(spans_of_64(), &[triangle]) {
            continue;
        }
        let mut last = 3;
        for step in 0..40 {
            let found = way(1e-9 * 2f32.powi(step), &triangle);
            assert!(found <= last, "way {found} after {last}: {triangle:?}");
            last = found;
            seen[found] += 1;
        }
        assert!(last < 2 && (last == 0) == (ratio <= 1.125), "way {last} of {ratio}");
    }
    assert!(seen.iter().all(|&count| count > 100), "{seen:?}");
}

/// Triangles that go all ways, in any order, drawn together or in pieces, by all lanes, and turned.
#[test]
fn ways_do_not_depend_on_lanes_pieces_or_order() {
    let mut rng = Rng::stream(run_seed(), 5);
    let budget = 1.0 / 4096.0;
    let mut seen = [0; 4];
    for _ in 0..20 {
        let triangles: Vec<Triangle> = (0..50)
            .map(|_| {
                if rng.one_in(3) {
                    return level(&mut rng, 3.0);
                }
                let ratio = rng.log_uniform(1.001, 1.3);
                let q = steep(&mut rng, ratio);
                if rng.one_in(3) {
                    let left = rng.uniform(0.0, 160.0);
                    return wide(&mut rng, left..left + 32.0, 4.0, q);
                }
                wide(&mut rng, COLUMNS, 34.0, q)
            })
            .collect();
        triangles.iter().for_each(|triangle| seen[way(budget, triangle)] += 1);
        let bounded = Lines::bounded(budget);
        let expected = picture(bounded, &triangles);
        for machine in Machine::all() {
            let mut found = Picture::new();
            for_lanes!(machine, lanes => found.draw(bounded, lanes, &triangles, WHOLE));
            assert!(found == expected, "{machine:?}");
            let mut found = Picture::new();
            for rows in [0..31, 31..32, 32..150] {
                for columns in [0..7, 7..100, 100..SIZE[0]] {
                    let part = [columns, rows.clone()];
                    for_lanes!(machine, lanes => found.draw(bounded, lanes, &triangles, part));
                }
            }
            assert!(found == expected, "in pieces, {machine:?}");
        }
        let turned: Vec<_> = triangles.iter().map(|[a, b, c]| [*b, *c, *a]).collect();
        assert!(picture(bounded, &turned) == expected, "turned");
    }
    assert!(seen.iter().all(|&count| count > 50), "{seen:?}");
}
