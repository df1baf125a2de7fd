//! The approximate interpolations keep the bounds that they state, over depth ratios up to 10^6, rows up to a thousand
//! pixels, slivers, and values of both signs: against arithmetic of 106 bits at every sample that is looked at. Half of
//! the triangles have vertices that snapping has moved, which counts where the rule of `unsnapped.rs` says so.
//!
//! Straight lines are `Lines`, in `f32` and in fixed point, one sample at a time; `lanes.rs` compares that with
//! several.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels and subpixels are small"
)]

mod fixed_point;

use crate::unsnapped::{Plane, any_move, plane};
use alberti_math::Sub8;
use alberti_math::lanes::One;
use alberti_oracle::cases::pixel_centre;
use alberti_oracle::climb::climb;
use alberti_oracle::coverage::{Triangle, weights};
use alberti_oracle::dd;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::{Cull, Interpolation, Lines, Paint, Planes, Rgba8888, Target};
use alberti_tests::probe::{LARGEST, Recorded, Seen, snapped, unsnapped};
use alberti_tests::sweep::or_swept;

const EPS: f64 = 1.0 / (1 << 24) as f64;
const WIDTH: i32 = 1000;
const ROW: i32 = 400;

/// A triangle, its values, and the covered columns of one row.
struct Case {
    /// In 256ths of subpixels, before snapping.
    parts: Triangle,
    /// After it, in subpixels.
    tri: Triangle,
    /// Whether the values lie in the plane before.
    moved: bool,
    q: [f32; 3],
    zs: [f32; 3],
    u: [f32; 3],
    covered: std::ops::Range<i32>,
}

impl Case {
    fn sample(column: i32) -> [i64; 2] {
        pixel_centre(i64::from(column), i64::from(ROW), 8)
    }

    /// The triangle in whose plane the values lie, in 256ths of subpixels.
    fn plane(&self) -> Triangle {
        if self.moved { self.parts } else { self.tri.map(|p| p.map(|c| 256 * c)) }
    }

    fn linear_at(&self, sample: [i64; 2], values: [f32; 3]) -> f64 {
        dd::linear(self.plane(), sample.map(|c| 256 * c), values).to_f64()
    }

    fn hyperbolic_at(&self, sample: [i64; 2]) -> f64 {
        dd::hyperbolic(self.plane(), sample.map(|c| 256 * c), self.q, self.u).to_f64()
    }

    fn q_at(&self, column: i32) -> f64 {
        self.linear_at(Self::sample(column), self.q)
    }

    fn hyperbolic(&self, column: i32) -> f64 {
        self.hyperbolic_at(Self::sample(column))
    }

    /// The straight line between the values at the subpixels.
    fn straight(&self, column: i32) -> f64 {
        let e = weights(self.tri, Self::sample(column)).map(|e| e as f64);
        let u = self.tri.map(|p| self.hyperbolic_at(p));
        (e[0] * u[0] + e[1] * u[1] + e[2] * u[2]) / (e[0] + e[1] + e[2])
    }

    /// The distance of a value from the exact one within the range.
    fn error(&self, u: f64, exact: f64) -> f64 {
        let [least, greatest] = self.range();
        (u - exact.clamp(least, greatest)).abs()
    }

    /// So many ε of the greatest value, and what moving adds.
    fn rounded(&self, epsilons: f64) -> f64 {
        let (more, greater) = if self.moved { (MOVED, 16.0 / 15.0) } else { (0.0, 1.0) };
        (epsilons * greater + more) * EPS * self.largest()
    }

    /// The greatest miss of a straight line between two samples.
    fn missed(&self, [first, last]: [i32; 2]) -> f64 {
        let [q0, q1] = [self.q_at(first), self.q_at(last)];
        let root = (f64::max(q0, q1) / f64::min(q0, q1)).sqrt();
        (self.hyperbolic(last) - self.hyperbolic(first)).abs() * (root - 1.0) / (root + 1.0)
    }

    /// The greatest ratio of q.
    fn ratio(&self) -> f64 {
        let [least, greatest] = extremes(self.tri.map(|p| self.linear_at(p, self.q)));
        greatest / least
    }

    /// The least and the greatest value of the vertices.
    fn range(&self) -> [f64; 2] {
        extremes(self.u.map(f64::from))
    }

    /// The greatest difference between two values at the subpixels.
    fn spread(&self) -> f64 {
        let [least, greatest] = extremes(self.tri.map(|p| self.hyperbolic_at(p)));
        greatest - least
    }

    fn largest(&self) -> f64 {
        self.u.iter().fold(0.0, |largest, u| f64::max(largest, f64::from(u.abs())))
    }

    /// The first and the last sample of the run of `length` columns that a column is in, and whose values count for it.
    fn run(&self, column: i32, length: i32) -> [i32; 2] {
        let first = column & !(length - 1);
        [first.max(self.covered.start), (first + length).min(self.covered.end - 1)]
    }
}

fn extremes(values: [f64; 3]) -> [f64; 2] {
    [f64::min, f64::max].map(|pick| values.into_iter().reduce(pick).unwrap_or(0.0))
}

/// A triangle whose q have ratios up to this.
fn any_case(rng: &mut Rng, steepest: f32) -> Case {
    let one = 256.0;
    let center = [rng.uniform(0.0, f64::from(WIDTH)), f64::from(ROW)];
    let wide = f64::from(rng.log_uniform(1.0, 2000.0));
    let high = if rng.one_in(3) { f64::from(rng.log_uniform(0.6, 4.0)) } else { wide };
    let tri = [(); 3].map(|()| {
        [(center[0] + rng.uniform(-wide, wide)) * one, (center[1] + rng.uniform(-high, high)) * one]
            .map(|c| c.round() as i64)
    });
    let ratio = rng.log_uniform(1.0, steepest);
    let mut q = [1.0, 1.0 / ratio, 1.0 / rng.log_uniform(1.0, ratio)];
    q.rotate_left(rng.index(3));
    let unit = rng.log_uniform(1e-3, 4096.0);
    // Far from 0 and near one another, too.
    let (base, spread) = if rng.one_in(4) { (unit, unit * rng.log_uniform(1e-7, 1.0)) } else { (0.0, unit) };
    let u = [(); 3].map(|()| (base + rng.uniform(-1.0, 1.0) as f32 * spread).clamp(-4096.0, 4096.0));
    // Beyond 0 and 1 there is no depth.
    let zs = [(); 3].map(|()| if rng.one_in(3) { rng.index(2) as f32 } else { rng.unit() as f32 });
    let moved = if rng.one_in(2) { [(); 3].map(|()| any_move(rng)) } else { [[0; 2]; 3] };
    let parts = [0, 1, 2].map(|i| [0, 1].map(|k| 256 * tri[i][k] + moved[i][k]));
    Case { parts, tri: parts.map(snapped), moved: false, q, zs, u, covered: 0..0 }
}

/// Draws triangles with a policy and hands each of a row's samples to `check`: the case, the column, the value, the
/// depth.
fn each_sample(
    interpolation: impl Interpolation,
    stream: u64,
    samples: u64,
    check: impl FnMut(&Case, i32, f64, f64),
) {
    each_scaled(interpolation, stream, samples, [1.0, STEEPEST], check);
}

/// The ratio of q up to which triangles are drawn.
const STEEPEST: f32 = 1e6;

/// The same with values that are larger by a factor, a power of two, and other ratios of q.
fn each_scaled(
    interpolation: impl Interpolation,
    stream: u64,
    samples: u64,
    [factor, steepest]: [f32; 2],
    mut check: impl FnMut(&Case, i32, f64, f64),
) {
    let samples = or_swept(samples, 10_000_000);
    let mut rng = Rng::stream(run_seed(), stream);
    let (mut count, mut moved) = (0, 0);
    while count < samples {
        count +=
            of_any_case(interpolation, &mut rng, [factor, steepest], &mut |case: &Case, column, u, zs| {
                moved += u64::from(case.moved);
                check(case, column, u, zs);
            });
    }
    let fixed = format!("{interpolation:?}").starts_with("FixedPoint");
    assert!(if fixed { moved == 0 } else { moved > samples / 10 }, "{moved} of {samples}");
}

/// Some samples of one triangle; tells how many.
fn of_any_case(
    interpolation: impl Interpolation,
    rng: &mut Rng,
    [factor, steepest]: [f32; 2],
    check: &mut impl FnMut(&Case, i32, f64, f64),
) -> u64 {
    let mut case = any_case(rng, steepest);
    let (mut color, mut depth) = ([0; WIDTH as usize], [-1.0; WIDTH as usize]);
    let size = [WIDTH as u32, LARGEST as u32];
    let mut band = Target::band(Rgba8888, Recorded, size, ROW as u32, &mut color, &mut depth).expect("a row");
    let seen = Seen::default();
    let [a, b, c] = [0, 1, 2].map(|i| unsnapped(case.parts[i], case.zs[i], case.q[i], case.u[i] * factor));
    let keep = |u: f32| seen.keep(u);
    let paint = Paint { stage: keep, interpolation, subpixel: Sub8, cull: Cull::None };
    case.moved = match plane(case.parts, case.q, Sub8) {
        Plane::Before => case.parts != case.plane() && !paint.numbers(Recorded).are_fixed(),
        Plane::After => false,
        Plane::Either => return 0,
    };
    paint.triangle(One, &mut band, [&a, &b, &c], &mut ());
    let covered: Vec<i32> = (0..WIDTH).filter(|&i| color[i as usize] != 0).collect();
    let (Some(&first), Some(&last)) = (covered.first(), covered.last()) else { return 0 };
    // The frame's edges cut rows, whose runs would then start outside of it.
    if first == 0 || last == WIDTH - 1 {
        return 0;
    }
    case.covered = first..last + 1;
    let stride = covered.len() / 24 + 1;
    let offset = rng.index(stride);
    let looked_at = covered.iter().skip(offset).step_by(stride);
    for &column in looked_at.clone() {
        let i = column as usize;
        let u = f64::from(seen.at(color[i])) / f64::from(factor);
        check(&case, column, u, f64::from(depth[i]));
    }
    looked_at.count() as u64
}

/// Climbs to the worst triangles for a policy. `share` is that of the bound at a sample, which must not exceed 1.
fn climbs(policy: impl Interpolation, stream: u64, share: impl Fn(&Case, i32, f64) -> f64) {
    climbs_up_to(policy, stream, STEEPEST, share);
}

/// The same with ratios of q up to this.
fn climbs_up_to(
    policy: impl Interpolation,
    stream: u64,
    steepest: f32,
    share: impl Fn(&Case, i32, f64) -> f64,
) {
    let (samples, steps) = or_swept((2000, 800), (100_000, 100_000));
    let found = climb(run_seed() ^ stream, samples, steps, |rng| {
        let mut worst = 0.0;
        of_any_case(policy, rng, [1.0, steepest], &mut |case, column, u, _| {
            worst = f64::max(worst, share(case, column, u));
        });
        worst
    });
    println!("{policy:?}: climbed to {:.3} of the bound, from {:.3}", found.most, found.random);
    assert!(found.most <= 1.0, "{policy:?}: {found:?}");
}

/// The documented shares of rounding in the bounds, in ε: of what is linear on the screen and depth, of lines between
/// divided ends, and of those within a budget.
const LINEAR: f64 = 12.0;
const DIVIDED: f64 = 15.0;
const BOUNDED: f64 = 19.0;
/// What moving adds, to values and, half of it, to depths.
const MOVED: f64 = 4.0;

/// A factor that makes the greatest values 2^120.
const LARGE: f32 = f32::from_bits((127 + 108) << 23);

/// Screen depth is a plane for every policy.
fn depth_error(case: &Case, column: i32, zs: f64) -> f64 {
    let [least, largest] = extremes(case.zs.map(f64::from));
    let exact = case.linear_at(Case::sample(column), case.zs).clamp(least, largest);
    let epsilons = LINEAR + if case.moved { MOVED / 2.0 } else { 0.0 };
    (zs - exact).abs() / (epsilons * EPS * largest)
}

/// Values as they come, and up to 2^120.
#[test]
fn planes() {
    planes_of(1, 1_000_000, 1.0);
    planes_of(11, 100_000, LARGE);
    climbs(Planes, 1, |case, column, u| {
        case.error(u, case.hyperbolic(column)) / planes_bound(case, column).0
    });
}

/// The bound of `Planes`, and its r.
fn planes_bound(case: &Case, column: i32) -> (f64, f64) {
    let first = case.run(column, 64)[0];
    let last = (column | 63).min(case.covered.end - 1);
    let r = f64::midpoint(case.q_at(first), case.q_at(last)) / case.q_at(column);
    (case.rounded(15.0 * r + 5.0), r)
}

fn planes_of(stream: u64, samples: u64, factor: f32) {
    let (mut worst, mut worst_depth, mut steep) = (0.0, 0.0, 0);
    each_scaled(Planes, stream, samples, [factor, STEEPEST], |case, column, u, zs| {
        let (bound, r) = planes_bound(case, column);
        worst = f64::max(worst, case.error(u, case.hyperbolic(column)) / bound);
        worst_depth = f64::max(worst_depth, depth_error(case, column, zs));
        steep += u64::from(r > 2.0);
    });
    println!("Planes: {worst:.3} of the bound, depth {worst_depth:.3}; {steep} samples with r > 2");
    assert!(worst <= 1.0 && worst_depth <= 1.0);
    assert!(worst > 0.1 && steep > 1000, "the bound is not tested");
}

#[test]
fn spans_of_8_and_16() {
    spans(8, 2, 1_000_000, 1.0);
    spans(16, 3, 1_000_000, 1.0);
    spans(16, 12, 100_000, LARGE);
}

fn lines(length: i32) -> Lines {
    Lines::spans(length).expect("a power of two")
}

fn spans(length: i32, stream: u64, samples: u64, factor: f32) {
    let (mut worst, mut worst_depth, mut reached) = (0.0, 0.0, 0);
    each_scaled(lines(length), stream, samples, [factor, STEEPEST], |case, column, u, zs| {
        let [first, last] = case.run(column, length);
        let missed = case.missed([first, last]);
        let rounded = case.rounded(DIVIDED);
        let error = case.error(u, case.hyperbolic(column));
        worst = f64::max(worst, error / (missed + rounded));
        worst_depth = f64::max(worst_depth, depth_error(case, column, zs));
        reached += u64::from(missed > 100.0 * rounded && error > 0.9 * missed);
    });
    println!(
        "Spans of {length}: {worst:.3} of the bound, depth {worst_depth:.3}; {reached} samples next to it"
    );
    assert!(worst <= 1.0 && worst_depth <= 1.0);
    assert!(reached > 1000, "the bound is not tested");
    climbs(lines(length), stream, |case, column, u| {
        let bound = case.missed(case.run(column, length)) + case.rounded(DIVIDED);
        case.error(u, case.hyperbolic(column)) / bound
    });
}

#[test]
fn affine() {
    let (mut worst, mut worst_depth, mut lines) = (0.0, 0.0, 0);
    each_sample(Lines::affine(), 4, 1_000_000, |case, column, u, zs| {
        worst = f64::max(worst, case.error(u, case.straight(column)) / case.rounded(LINEAR));
        worst_depth = f64::max(worst_depth, depth_error(case, column, zs));
        // Perspective lies within the formula, between any two vertices.
        let root = case.ratio().sqrt();
        let missed = case.spread() * (root - 1.0) / (root + 1.0);
        let error = case.error(u, case.hyperbolic(column));
        assert!(error <= missed + case.rounded(LINEAR), "{error:e} where {missed:e} is the bound");
        lines += u64::from(error > 0.3 * missed);
    });
    println!("Affine: {worst:.3} of the bound, depth {worst_depth:.3}; {lines} samples far from perspective");
    assert!(worst <= 1.0 && worst_depth <= 1.0 && worst > 0.1 && lines > 1000);
    climbs(Lines::affine(), 4, |case, column, u| case.error(u, case.straight(column)) / case.rounded(LINEAR));
}

/// Steep ones, of which some are level along rows, and gentle ones.
#[test]
fn never_over_the_budget() {
    for (stream, budget, steepest, share) in [
        (5, 1.0 / 16.0 / 256.0, STEEPEST, 0.01),
        (6, 0.5, STEEPEST, 0.01),
        (14, 1.0 / 16.0 / 256.0, 1.2, 0.7),
        (15, 0.5, 1.2, 0.7),
    ] {
        let bounded = Lines::bounded(budget);
        let bound = |case: &Case| f64::from(budget) + case.rounded(BOUNDED);
        let (mut worst, mut worst_depth, mut reached) = (0.0, 0.0, 0);
        each_scaled(bounded, stream, 500_000, [1.0, steepest], |case, column, u, zs| {
            let error = case.error(u, case.hyperbolic(column));
            worst = f64::max(worst, error / bound(case));
            worst_depth = f64::max(worst_depth, depth_error(case, column, zs));
            reached += u64::from(error > share * f64::from(budget));
        });
        println!(
            "Bounded {budget:.1e}: {worst:.3} of the bound, depth {worst_depth:.3}; {reached} samples near it"
        );
        assert!(worst <= 1.0 && worst_depth <= 1.0);
        assert!(reached > 100, "the budget is not used: {reached}");
        climbs_up_to(bounded, stream, steepest, |case, column, u| {
            case.error(u, case.hyperbolic(column)) / bound(case)
        });
    }
}
