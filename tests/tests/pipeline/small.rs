//! Small triangles in fixed point, which have two kernels of their own: coverage is exact, numbers keep the bounds that
//! `FixedPoint` states, and nothing depends on the order of the vertices, on scissors or on lanes.
//!
//! Triangles reach from parts of a pixel to twice what counts as small, across the edges of the target.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels and subpixels are small"
)]

use alberti_math::lanes::One;
use alberti_math::{Flat, Linear, Sub4, Sub8, Subpixel};
use alberti_oracle::cases::pixel_centre;
use alberti_oracle::coverage::{Triangle, area2, covers};
use alberti_oracle::dd;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::{AnyDepth, Cull, FixedPoint, Interpolation, Lines, Paint, Rgba8888, Target, Vertex};
use alberti_tests::for_widest;
use alberti_tests::probe::{Seen, vertex};
use alberti_tests::sweep::or_swept;
use std::ops::Range;

const SIDE: i32 = 64;
const PIXELS: usize = (SIDE * SIDE) as usize;
const STEP: f64 = 1.0 / 65536.0;

/// A value that is hyperbolic, one that is linear, one that is flat.
type Carried = (f32, (Linear<f32>, Flat<f32>));

struct Case {
    subpixel: Subpixel,
    tri: Triangle,
    q: [f32; 3],
    zs: [f32; 3],
    u: [f32; 3],
}

impl Case {
    fn any(rng: &mut Rng, subpixel: Subpixel) -> Self {
        let one = f64::from(1 << subpixel.bits());
        let wide = f64::from(rng.log_uniform(0.3, 30.0)) * one;
        let high = if rng.one_in(3) { f64::from(rng.log_uniform(0.1, 2.0)) * one } else { wide };
        let center = [(); 2].map(|()| rng.uniform(-2.5, f64::from(SIDE) + 2.5) * one);
        let mut corner = || {
            let p = [center[0] + rng.uniform(-wide, wide), center[1] + rng.uniform(-high, high)];
            // Samples and the corners between pixels are hit as often as that can be.
            let half = 1 << (subpixel.bits() - 1);
            p.map(|c| {
                if rng.one_in(4) {
                    (c / f64::from(half)).round() as i64 * half as i64
                } else {
                    c.round() as i64
                }
            })
        };
        let tri = [corner(), corner(), corner()];
        let most = [1e3, 1.5, 1.08][rng.index(3)];
        let ratio = rng.log_uniform(1.0, most);
        let mut q = [1.0, 1.0 / ratio, 1.0 / rng.log_uniform(1.0, ratio)];
        q.rotate_left(rng.index(3));
        let unit = rng.log_uniform(1e-3, 6.0);
        let u = [(); 3].map(|()| rng.uniform(-1.0, 1.0) as f32 * unit);
        let (near, spread) = (rng.unit(), f64::from(rng.log_uniform(1e-5, 0.3)));
        let zs = [(); 3].map(|()| (near + rng.unit() * spread).clamp(0.0, 0.99) as f32);
        Self { subpixel, tri, q, zs, u }
    }

    fn vertices(&self) -> [Vertex<Carried>; 3] {
        std::array::from_fn(|i| {
            vertex(self.tri[i], self.zs[i], self.q[i], (self.u[i], (Linear(self.u[i]), Flat(self.u[i]))))
        })
    }

    fn spread(&self) -> f64 {
        let [a, b, c] = self.u.map(f64::from);
        a.max(b).max(c) - a.min(b).min(c)
    }

    /// The most that a straight line over the whole triangle misses.
    fn missed(&self) -> f64 {
        let root = self.ratio().sqrt();
        self.spread() * (root - 1.0) / (root + 1.0)
    }

    /// The same along the covered samples of a row, those outside of the frame too.
    fn missed_along(&self, row: i32) -> f64 {
        let sample = |column: i32| pixel_centre(column.into(), row.into(), self.subpixel.bits());
        let mut columns = (-SIDE..2 * SIDE).map(sample).filter(|&sample| covers(self.tri, sample));
        let Some(first) = columns.next() else { return 0.0 };
        let ends = [first, columns.next_back().unwrap_or(first)];
        let [q, u] = [
            ends.map(|end| dd::linear(self.tri, end, self.q).to_f64()),
            ends.map(|end| dd::hyperbolic(self.tri, end, self.q, self.u).to_f64()),
        ];
        let root = (q[0].max(q[1]) / q[0].min(q[1])).sqrt();
        (u[1] - u[0]).abs() * (root - 1.0) / (root + 1.0)
    }

    /// The greatest ratio of two q.
    fn ratio(&self) -> f64 {
        let [a, b, c] = self.q.map(f64::from);
        a.max(b).max(c) / a.min(b).min(c)
    }

    /// The pixels of the box's longer side.
    fn longest(&self) -> f64 {
        let extent = |k: usize| {
            let at = self.tri.map(|p| p[k]);
            at.iter().max().unwrap() - at.iter().min().unwrap()
        };
        extent(0).max(extent(1)) as f64 / f64::from(1 << self.subpixel.bits())
    }

    /// Whether it may be drawn as a small one, as far as the policy admits: short, with numbers that are small, and not
    /// steep. Products of 2^30 are in question, of a side up to the next power of two and the same of a difference.
    fn is_small(&self, format: AnyDepth) -> bool {
        let one = f64::from(1 << self.subpixel.bits());
        let longest = self.longest();
        let side = if longest < 16.0 { 16.0 } else { 32.0 };
        let fine = self.subpixel == Sub8;
        let area = area2(self.tri).unsigned_abs() as f64 / (one * one);
        let steepness = |spread: f64| spread * 2.0 * side / area;
        let [za, zb, zc] = self.zs.map(f64::from);
        let deep = za.max(zb).max(zc) - za.min(zb).min(zc);
        // A little less than the 2^18 units in which depths are followed, and where sides have 12 bits, of 2^16.
        let deepest = if format == AnyDepth::D16 { 0.24 } else { 0.95 / 1024.0 };
        let deepest = if fine { deepest / 4.0 } else { deepest };
        let widest = if fine { 0.95 } else { 30.0 };
        longest < if self.subpixel == Sub8 { 16.0 } else { 32.0 }
            && self.u.iter().all(|u| u.abs() < 15.0)
            && self.spread() < widest
            && steepness(self.spread()) < 0.95
            && steepness(deep) < 0.24 * deepest
            && deep < deepest
    }
}

/// The fragments that a policy makes of a triangle, and the depths: colours are places in the list.
struct Drawn {
    color: Vec<u32>,
    depth: Vec<u32>,
    seen: Seen<Carried>,
}

fn paint<I: Interpolation>(
    interpolation: I,
    format: AnyDepth,
    vertices: [&Vertex<Carried>; 3],
    scissors: &[[Range<i32>; 2]],
    (subpixel, widest): (Subpixel, bool),
) -> Drawn {
    let (mut color, mut depth) = (vec![0; PIXELS], vec![u32::MAX >> 1; PIXELS]);
    let seen = Seen::default();
    let mut target =
        Target::new(Rgba8888, format, SIDE as u32, SIDE as u32, &mut color, &mut depth).expect("a frame");
    target.clear(0u32);
    let stage = |v: Carried| seen.keep(v);
    let paint = Paint { stage, interpolation, subpixel, cull: Cull::None };
    for [columns, rows] in scissors {
        let mut visible = target.scissor(columns.clone(), rows.clone());
        if widest {
            for_widest!(lanes => paint.triangle(lanes, &mut visible, vertices, &mut ()));
        } else {
            paint.triangle(One, &mut visible, vertices, &mut ());
        }
    }
    Drawn { color, depth, seen }
}

/// What was drawn, pixel by pixel.
fn told(drawn: &Drawn) -> Vec<Option<([u32; 3], u32)>> {
    let at = |(&pixel, &zs): (&u32, &u32)| {
        (pixel != 0).then(|| {
            let (u, (Linear(v), Flat(w))) = drawn.seen.at(pixel);
            ([u, v, w].map(f32::to_bits), zs)
        })
    };
    drawn.color.iter().zip(&drawn.depth).map(at).collect()
}

const WHOLE: [Range<i32>; 2] = [0..SIDE, 0..SIDE];

/// The share of a step that a stored depth of so many bits may be off, and the depth of a word.
fn zs_of(format: AnyDepth, word: u32) -> (f64, f64) {
    match format {
        AnyDepth::D16 => (f64::from(word) / 65535.0, 0.57 / 65535.0),
        AnyDepth::D24 => (f64::from(word) / 16_777_215.0, 0.57 / 16_777_215.0),
        _ => (f64::from(f32::from_bits(word)), 1.2 / f64::from(1 << 28) + 1.0 / f64::from(1 << 24)),
    }
}

#[derive(Default, Debug)]
struct Counts {
    fragments: u64,
    small: u64,
    worst: f64,
    worst_depth: f64,
}

/// Draws triangles by a policy whose miss is at most `missed` of a case and a row. Those in `one_run` are certainly one
/// run.
fn keeps_its_bounds(
    (lines, subpixel): (Lines, Subpixel),
    format: AnyDepth,
    stream: u64,
    perspective: bool,
    one_run: impl Fn(&Case) -> bool,
    missed: impl Fn(&Case, i32) -> f64,
) {
    let count = or_swept(4_000, 1_000_000);
    let mut rng = Rng::stream(run_seed(), stream);
    let mut counts = Counts::default();
    for _ in 0..count {
        let case = Case::any(&mut rng, subpixel);
        let vertices = case.vertices();
        let [a, b, c] = &vertices;
        let drawn = paint(FixedPoint(lines), format, [a, b, c], &[WHOLE], (subpixel, false));
        let small = case.is_small(format) && one_run(&case);
        let [least, greatest] = [f64::min, f64::max].map(|pick| {
            case.u.iter().map(|&u| (f64::from(u) / STEP).round() * STEP).reduce(pick).expect("three")
        });
        for row in 0..SIDE {
            let missed = missed(&case, row);
            for column in 0..SIDE {
                let pixel = (row * SIDE + column) as usize;
                let sample = pixel_centre(column.into(), row.into(), subpixel.bits());
                let covered = area2(case.tri) != 0 && covers(case.tri, sample);
                assert_eq!(drawn.color[pixel] != 0, covered, "{:?} at {column}, {row}", case.tri);
                if !covered {
                    continue;
                }
                let (u, (Linear(v), Flat(w))) = drawn.seen.at(drawn.color[pixel]);
                counts.fragments += 1;
                counts.small += u64::from(small);
                assert!((f64::from(w) - f64::from(case.u[0])).abs() <= STEP / 2.0);
                let linear = dd::linear(case.tri, sample, case.u).to_f64();
                let exact = if perspective {
                    dd::hyperbolic(case.tri, sample, case.q, case.u).to_f64()
                } else {
                    linear
                };
                // 1/2 for the vertices, 126/256 for the way, 1/2 for the result; the plain way's more.
                let rounding = if small { 1.5 * STEP } else { 68.0 * STEP + case.spread() * 1e-3 };
                for (got, exact, missed) in [(u, exact, missed), (v, linear, 0.0)] {
                    let (got, bound) = (f64::from(got), missed + rounding);
                    let error = (got - exact).abs();
                    assert!(
                        error <= bound,
                        "{got} for {exact}: {} of the bound, {:?} {:?} {:?}",
                        error / bound,
                        case.tri,
                        case.q,
                        case.u
                    );
                    assert!(least <= got && got <= greatest, "{got} is not from {least} to {greatest}");
                    if small {
                        counts.worst = counts.worst.max(error / bound);
                    }
                }
                let (zs, bound) = zs_of(format, drawn.depth[pixel]);
                let bound = if small { bound } else { bound + 72.0 * 2f64.powi(-31) };
                let error = (zs - dd::linear(case.tri, sample, case.zs).to_f64()).abs();
                assert!(error <= bound, "{} of the bound of {format:?}", error / bound);
                counts.worst_depth = counts.worst_depth.max(error / bound);
            }
        }
    }
    println!("{lines:?}, {format:?}, {subpixel:?}: {counts:?}");
    assert!(counts.small * 50 > counts.fragments && counts.worst > 0.5, "{counts:?}");
}

#[test]
fn linear_ones_are_right_to_a_step() {
    let missed = |_: &Case, _| 0.0;
    for (stream, format) in [AnyDepth::D16, AnyDepth::D24, AnyDepth::F32].into_iter().enumerate() {
        for (subpixel, stream) in [(Sub4, stream), (Sub8, stream + 10)] {
            keeps_its_bounds((Lines::affine(), subpixel), format, stream as u64, false, |_| true, missed);
        }
    }
}

#[test]
fn spans_miss_what_their_ratio_of_depths_allows() {
    let spans = Lines::spans(16).expect("a power of two");
    for (subpixel, stream) in [(Sub4, 3), (Sub8, 13)] {
        // The difference of the words of q is at most twice that of q.
        let one_run = |case: &Case| (case.ratio() - 1.0) * 2.0 * case.longest().max(1.0) < 0.95;
        // As one run a quarter of what a pixel changes; otherwise along rows alone.
        let missed = |case: &Case, row| {
            let quarter = case.spread() / (4.0 * case.longest().max(1.0));
            case.missed().min(quarter.max(case.missed_along(row)))
        };
        keeps_its_bounds((spans, subpixel), AnyDepth::D16, stream, true, one_run, missed);
    }
    // Too short for triangles to be one run.
    let mut rng = Rng::stream(run_seed(), 4);
    let short = Lines::spans(1).expect("a power of two");
    for _ in 0..2_000 {
        let case = Case::any(&mut rng, Sub4);
        let [a, b, c] = &case.vertices();
        let drawn = paint(FixedPoint(short), AnyDepth::D16, [a, b, c], &[WHOLE], (Sub4, false));
        for (pixel, &color) in drawn.color.iter().enumerate().filter(|(_, color)| **color != 0) {
            let pixel = i32::try_from(pixel).expect("a small frame");
            let [column, row] = [pixel % SIDE, pixel / SIDE].map(i64::from);
            let exact = dd::hyperbolic(case.tri, pixel_centre(column, row, 4), case.q, case.u).to_f64();
            let error = (f64::from(drawn.seen.at(color).0) - exact).abs();
            assert!(error <= 5.0 * STEP + case.spread() * 1e-4);
        }
    }
}

#[test]
fn budgets_are_kept() {
    for (stream, budget) in [(5, 0.01f32), (6, 0.001)] {
        // The difference of the words of q is at most twice that of q.
        let one_run = |case: &Case| {
            let missed = case.spread() * (case.ratio() - 1.0) / 2.0;
            case.ratio() < 1.45 && missed < f64::from(budget) - 20.0 * STEP
        };
        let lines = (Lines::bounded(budget), [Sub4, Sub8][stream as usize % 2]);
        keeps_its_bounds(lines, AnyDepth::D16, stream, true, one_run, |_, _| f64::from(budget));
    }
}

/// A component that is large sends a triangle the way of large ones: it has the same pixels, and numbers that differ by
/// what the policy allows to each way.
#[test]
fn large_triangles_go_another_way_to_the_same_pixels() {
    let count = or_swept(8_000, 10_000_000);
    let mut rng = Rng::stream(run_seed(), 8);
    let (mut small, mut covered, mut differing, mut worst) = ([0; 2], 0, 0, 0.0f64);
    for turn in 0..count {
        let subpixel = [Sub4, Sub8][turn / 9 % 2];
        let case = Case::any(&mut rng, subpixel);
        let vertices = case.vertices();
        let large = vertices.map(|v| Vertex { varying: (v.varying.0, (v.varying.1.0, Flat(100.0))), ..v });
        let format = [AnyDepth::D16, AnyDepth::D24, AnyDepth::F32][turn / 3 % 3];
        let lines = [Lines::affine(), Lines::spans(16).expect("a length"), Lines::bounded(0.01)][turn % 3];
        let by = |vertices: &[Vertex<Carried>; 3]| {
            paint(FixedPoint(lines), format, vertices.each_ref(), &[WHOLE], (subpixel, false))
        };
        let [one, other] = [by(&vertices), by(&large)];
        let is_small = case.is_small(format);
        small[usize::from(subpixel == Sub8)] += u32::from(is_small);
        let missed = [0.0, 2.0 * case.missed(), 0.02][turn % 3];
        let bound = missed + 69.5 * STEP + case.spread() * 1e-3;
        for (pixel, (&a, &b)) in one.color.iter().zip(&other.color).enumerate() {
            assert_eq!(a != 0, b != 0, "pixel {pixel} of {:?}", case.tri);
            if a == 0 {
                continue;
            }
            covered += 1;
            let [(u, (Linear(v), _)), (x, (Linear(y), Flat(z)))] = [one.seen.at(a), other.seen.at(b)];
            assert_eq!(z.to_bits(), 100f32.to_bits());
            for (got, plain) in [(u, x), (v, y)] {
                let apart = f64::from((got - plain).abs());
                assert!(apart <= bound, "{got} and {plain}: {} of the bound, {:?}", apart / bound, case.tri);
                differing += u64::from(apart > 0.0);
                worst = worst.max(apart / bound);
            }
            let [(got, bound), (plain, _)] = [&one, &other].map(|drawn| zs_of(format, drawn.depth[pixel]));
            let apart = (got - plain).abs();
            assert!(
                apart <= 2.0 * bound + 64.0 * 2f64.powi(-31),
                "{got} and {plain} in {format:?}, {:?}",
                case.tri
            );
        }
    }
    println!(
        "{small:?} small of {count}, {covered} pixels, {differing} numbers differ, up to {worst:.3} of the bound"
    );
    let enough = small.iter().all(|&small| small > 300);
    assert!(enough && covered > 10_000 && differing > 1_000 && worst > 0.2, "two ways are one");
}

/// From any vertex, in either direction, in four pieces, and with the widest lanes: always the same.
#[test]
fn nothing_else_changes_a_bit() {
    let mut rng = Rng::stream(run_seed(), 7);
    let (mut covered, mut differing) = (0, 0);
    for turn in 0..6_000 {
        let subpixel = [Sub4, Sub8][turn / 12 % 2];
        let case = Case::any(&mut rng, subpixel);
        let [a, b, c] = &case.vertices();
        let format = [AnyDepth::D16, AnyDepth::D24, AnyDepth::F32, AnyDepth::F32Reversed][turn % 4];
        let lines = [Lines::affine(), Lines::spans(16).expect("a length"), Lines::bounded(0.01)][turn % 3];
        let by = |vertices, scissors: &[_], widest| {
            told(&paint(FixedPoint(lines), format, vertices, scissors, (subpixel, widest)))
        };
        let whole = by([a, b, c], &[WHOLE], false);
        covered += whole.iter().flatten().count();
        let [x, y] = [rng.range(1, 63) as i32, rng.range(1, 63) as i32];
        let pieces = [[0..x, 0..y], [x..SIDE, 0..y], [0..x, y..SIDE], [x..SIDE, y..SIDE]];
        assert_eq!(whole, by([a, b, c], &pieces, false), "{:?} in pieces", case.tri);
        assert_eq!(whole, by([a, b, c], &[WHOLE], true), "{:?} in wide lanes", case.tri);
        // The flat component is the first vertex's.
        let apart = |told: Vec<Option<([u32; 3], u32)>>| {
            told.into_iter().map(|pixel| pixel.map(|([u, v, _], zs)| [u, v, zs])).collect::<Vec<_>>()
        };
        let whole = apart(whole);
        for vertices in [[b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]] {
            assert_eq!(whole, apart(by(vertices, &[WHOLE], false)), "{:?} turned", case.tri);
        }
        differing +=
            u32::from(whole.iter().flatten().any(|pixel| Some(pixel) != whole.iter().flatten().next()));
    }
    assert!(covered > 10_000 && differing > 1_000, "{covered} fragments, {differing} of several colours");
}
