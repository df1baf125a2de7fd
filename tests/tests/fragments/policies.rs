//! The approximate interpolations keep the bounds that they state, over depth ratios up to 10^6, rows up to a thousand
//! pixels, slivers, and values of both signs: against arithmetic of 106 bits at every sample that is looked at.
//!
//! Straight lines are `Lines`, in `f32` and in fixed point, one sample at a time; `lanes.rs` compares that with
//! several.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels and subpixels are small"
)]

use alberti_math::Sub8;
use alberti_math::lanes::One;
use alberti_oracle::cases::pixel_centre;
use alberti_oracle::climb::climb;
use alberti_oracle::coverage::Triangle;
use alberti_oracle::dd;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::{Cull, FixedPoint, Interpolation, Lines, Paint, Planes, Rgba8888, Target};
use alberti_tests::probe::{LARGEST, Recorded, Seen, vertex};

const EPS: f64 = 1.0 / (1 << 24) as f64;
const WIDTH: i32 = 1000;
const ROW: i32 = 400;

/// A triangle, its values, and the covered columns of one row.
struct Case {
    tri: Triangle,
    q: [f32; 3],
    zs: [f32; 3],
    u: [f32; 3],
    covered: std::ops::Range<i32>,
}

impl Case {
    fn sample(column: i32) -> [i64; 2] {
        pixel_centre(i64::from(column), i64::from(ROW), 8)
    }

    fn q_at(&self, column: i32) -> f64 {
        dd::linear(self.tri, Self::sample(column), self.q).to_f64()
    }

    fn hyperbolic(&self, column: i32) -> f64 {
        dd::hyperbolic(self.tri, Self::sample(column), self.q, self.u).to_f64()
    }

    /// The greatest miss of a straight line between two samples.
    fn missed(&self, [first, last]: [i32; 2]) -> f64 {
        let [q0, q1] = [self.q_at(first), self.q_at(last)];
        let root = (f64::max(q0, q1) / f64::min(q0, q1)).sqrt();
        (self.hyperbolic(last) - self.hyperbolic(first)).abs() * (root - 1.0) / (root + 1.0)
    }

    /// The greatest ratio of q.
    fn ratio(&self) -> f64 {
        let [least, greatest] =
            [f32::min, f32::max].map(|pick| f64::from(self.q.into_iter().reduce(pick).unwrap_or(1.0)));
        greatest / least
    }

    /// The least and the greatest value of the vertices.
    fn range(&self) -> [f64; 2] {
        [f32::min, f32::max].map(|pick| f64::from(self.u.into_iter().reduce(pick).unwrap_or(0.0)))
    }

    /// The greatest difference between two vertices.
    fn spread(&self) -> f64 {
        let [least, greatest] = self.range();
        greatest - least
    }

    /// The most that a straight line over the whole triangle misses, where `FixedPoint` may draw it as one run.
    fn missed_by_one_run(&self) -> f64 {
        let side = |axis: usize| {
            let at = self.tri.map(|corner| corner[axis]);
            at.iter().max().unwrap() - at.iter().min().unwrap()
        };
        let pixels = side(0).max(side(1)) as f64 / 256.0;
        let most = 1.0 + 1.001 / pixels.max(1.0);
        if pixels < 16.0 && self.ratio() < most { self.spread() / (4.0 * pixels.max(1.0)) } else { 0.0 }
    }

    /// The share of fixed point in the bound of a policy, of which so many steps are rounding.
    fn fixed_point(&self, steps: i32) -> f64 {
        const UNIT: f64 = 1.0 / 65536.0;
        let columns = f64::from(self.covered.end - self.covered.start);
        let slopes = self.ratio() * (columns + 4.0) * 3.0 * 2f64.powi(-29);
        // A closure gets f32.
        f64::from(steps) * UNIT + self.spread() * (2f64.powi(-17) + slopes) + EPS * self.largest()
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

fn any_case(rng: &mut Rng) -> Case {
    let one = 256.0;
    let center = [rng.uniform(0.0, f64::from(WIDTH)), f64::from(ROW)];
    let wide = f64::from(rng.log_uniform(1.0, 2000.0));
    let high = if rng.one_in(3) { f64::from(rng.log_uniform(0.6, 4.0)) } else { wide };
    let tri = [(); 3].map(|()| {
        [(center[0] + rng.uniform(-wide, wide)) * one, (center[1] + rng.uniform(-high, high)) * one]
            .map(|c| c.round() as i64)
    });
    let ratio = rng.log_uniform(1.0, 1e6);
    let mut q = [1.0, 1.0 / ratio, 1.0 / rng.log_uniform(1.0, ratio)];
    q.rotate_left(rng.index(3));
    let unit = rng.log_uniform(1e-3, 4096.0);
    // Far from 0 and near one another, too.
    let (base, spread) = if rng.one_in(4) { (unit, unit * rng.log_uniform(1e-7, 1.0)) } else { (0.0, unit) };
    let u = [(); 3].map(|()| (base + rng.uniform(-1.0, 1.0) as f32 * spread).clamp(-4096.0, 4096.0));
    // Beyond 0 and 1 there is no depth.
    let zs = [(); 3].map(|()| if rng.one_in(3) { rng.index(2) as f32 } else { rng.unit() as f32 });
    Case { tri, q, zs, u, covered: 0..0 }
}

/// Draws triangles with a policy and hands each of a row's samples to `check`: the case, the column, the value, the
/// depth.
fn each_sample(
    interpolation: impl Interpolation,
    stream: u64,
    samples: u64,
    check: impl FnMut(&Case, i32, f64, f64),
) {
    each_scaled(interpolation, stream, samples, 1.0, check);
}

/// The same with values that are larger by a factor, a power of two.
fn each_scaled(
    interpolation: impl Interpolation,
    stream: u64,
    samples: u64,
    factor: f32,
    mut check: impl FnMut(&Case, i32, f64, f64),
) {
    let samples = if std::env::var_os("ALBERTI_SWEEP").is_some() { 10_000_000 } else { samples };
    let mut rng = Rng::stream(run_seed(), stream);
    let mut count = 0;
    while count < samples {
        count += of_any_case(interpolation, &mut rng, factor, &mut check);
    }
}

/// Some samples of one triangle; tells how many.
fn of_any_case(
    interpolation: impl Interpolation,
    rng: &mut Rng,
    factor: f32,
    check: &mut impl FnMut(&Case, i32, f64, f64),
) -> u64 {
    let mut case = any_case(rng);
    let (mut color, mut depth) = ([0; WIDTH as usize], [-1.0; WIDTH as usize]);
    let size = [WIDTH as u32, LARGEST as u32];
    let mut band = Target::band(Rgba8888, Recorded, size, ROW as u32, &mut color, &mut depth).expect("a row");
    let seen = Seen::default();
    let [a, b, c] = [0, 1, 2].map(|i| vertex(case.tri[i], case.zs[i], case.q[i], case.u[i] * factor));
    let keep = |u: f32| seen.keep(u);
    let paint = Paint { stage: keep, interpolation, subpixel: Sub8, cull: Cull::None };
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
    let (samples, steps) =
        if std::env::var_os("ALBERTI_SWEEP").is_some() { (100_000, 100_000) } else { (4000, 1500) };
    let found = climb(run_seed() ^ stream, samples, steps, |rng| {
        let mut worst = 0.0;
        of_any_case(policy, rng, 1.0, &mut |case, column, u, _| {
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

/// A factor that makes the greatest values 2^120.
const LARGE: f32 = f32::from_bits((127 + 108) << 23);

/// Screen depth is a plane for every policy.
fn depth_error(case: &Case, column: i32, zs: f64) -> f64 {
    let largest = case.zs.iter().fold(0.0, |largest, zs| f64::max(largest, f64::from(*zs)));
    (zs - dd::linear(case.tri, Case::sample(column), case.zs).to_f64()).abs() / (LINEAR * EPS * largest)
}

/// Values as they come, and up to 2^120.
#[test]
fn planes() {
    planes_of(1, 1_000_000, 1.0);
    planes_of(11, 100_000, LARGE);
    climbs(Planes, 1, |case, column, u| (u - case.hyperbolic(column)).abs() / planes_bound(case, column).0);
}

/// The bound of `Planes`, and its r.
fn planes_bound(case: &Case, column: i32) -> (f64, f64) {
    let first = case.run(column, 64)[0];
    let last = (column | 63).min(case.covered.end - 1);
    let r = f64::midpoint(case.q_at(first), case.q_at(last)) / case.q_at(column);
    ((15.0 * r + 5.0) * EPS * case.largest(), r)
}

fn planes_of(stream: u64, samples: u64, factor: f32) {
    let (mut worst, mut worst_depth, mut steep) = (0.0, 0.0, 0);
    each_scaled(Planes, stream, samples, factor, |case, column, u, zs| {
        let (bound, r) = planes_bound(case, column);
        worst = f64::max(worst, (u - case.hyperbolic(column)).abs() / bound);
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
    each_scaled(lines(length), stream, samples, factor, |case, column, u, zs| {
        let [first, last] = case.run(column, length);
        let missed = case.missed([first, last]);
        let rounded = DIVIDED * EPS * case.largest();
        let error = (u - case.hyperbolic(column)).abs();
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
        let bound = case.missed(case.run(column, length)) + DIVIDED * EPS * case.largest();
        (u - case.hyperbolic(column)).abs() / bound
    });
}

#[test]
fn affine() {
    let (mut worst, mut worst_depth, mut lines) = (0.0, 0.0, 0);
    each_sample(Lines::affine(), 4, 1_000_000, |case, column, u, zs| {
        let straight = dd::linear(case.tri, Case::sample(column), case.u).to_f64();
        worst = f64::max(worst, (u - straight).abs() / (LINEAR * EPS * case.largest()));
        worst_depth = f64::max(worst_depth, depth_error(case, column, zs));
        // Perspective lies within the formula, between any two vertices.
        let root = case.ratio().sqrt();
        let missed = case.spread() * (root - 1.0) / (root + 1.0);
        let error = (u - case.hyperbolic(column)).abs();
        assert!(error <= missed + LINEAR * EPS * case.largest(), "{error:e} where {missed:e} is the bound");
        lines += u64::from(error > 0.3 * missed);
    });
    println!("Affine: {worst:.3} of the bound, depth {worst_depth:.3}; {lines} samples far from perspective");
    assert!(worst <= 1.0 && worst_depth <= 1.0 && worst > 0.1 && lines > 1000);
    climbs(Lines::affine(), 4, |case, column, u| {
        let straight = dd::linear(case.tri, Case::sample(column), case.u).to_f64();
        (u - straight).abs() / (LINEAR * EPS * case.largest())
    });
}

#[test]
fn never_over_the_budget() {
    for (stream, budget) in [(5, 1.0 / 16.0 / 256.0), (6, 0.5)] {
        let (mut worst, mut worst_depth, mut reached) = (0.0, 0.0, 0);
        each_sample(Lines::bounded(budget), stream, 500_000, |case, column, u, zs| {
            let bound = f64::from(budget) + BOUNDED * EPS * case.largest();
            let error = (u - case.hyperbolic(column)).abs();
            worst = f64::max(worst, error / bound);
            worst_depth = f64::max(worst_depth, depth_error(case, column, zs));
            reached += u64::from(error > 0.3 * f64::from(budget));
        });
        println!(
            "Bounded {budget:.1e}: {worst:.3} of the bound, depth {worst_depth:.3}; {reached} samples near it"
        );
        assert!(worst <= 1.0 && worst_depth <= 1.0);
        assert!(reached > 1000, "the budget is not used");
        climbs(Lines::bounded(budget), stream, |case, column, u| {
            (u - case.hyperbolic(column)).abs() / (f64::from(budget) + BOUNDED * EPS * case.largest())
        });
    }
}

/// A unit of depth in fixed point.
const DEPTH_UNIT: f64 = 1.0 / (1u32 << 31) as f64;

fn fixed_point(
    policy: impl Interpolation,
    stream: u64,
    steps: i32,
    policy_bound: impl Fn(&Case, i32) -> [f64; 2],
) {
    let (mut worst, mut worst_depth, mut near) = (0.0, 0.0, 0);
    each_sample(policy, stream, 1_000_000, |case, column, u, zs| {
        let [exact, missed] = policy_bound(case, column);
        let fixed = case.fixed_point(steps);
        let error = (u - exact).abs();
        // Half a step for each vertex's rounding, and the rounding of an f32.
        let outside = f64::max(case.range()[0] - u, u - case.range()[1]);
        assert!(
            outside <= 0.51 / 65536.0 + EPS * case.largest(),
            "{u} is {outside:e} outside of {:?}",
            case.u
        );
        worst = f64::max(worst, error / (missed + fixed));
        near += u64::from(error > 0.25 * (missed + fixed));
        let depth = dd::linear(case.tri, Case::sample(column), case.zs).to_f64();
        let row = f64::from(case.covered.end - case.covered.start);
        let depth_bound = (row + 8.0) * DEPTH_UNIT + EPS;
        worst_depth = f64::max(worst_depth, (zs - depth).abs() / depth_bound);
    });
    println!("{policy:?}: {worst:.3} of the bound, depth {worst_depth:.3}; {near} samples near it");
    assert!(worst <= 1.0 && worst_depth <= 1.0);
    assert!(near > 100, "the bound is not tested");
    climbs(policy, stream, |case, column, u| {
        let [exact, missed] = policy_bound(case, column);
        (u - exact).abs() / (missed + case.fixed_point(steps))
    });
}

#[test]
fn lines_in_fixed_point() {
    fixed_point(FixedPoint(lines(16)), 7, 16 + 3, |case, column| {
        [case.hyperbolic(column), case.missed(case.run(column, 16)).max(case.missed_by_one_run())]
    });
    fixed_point(FixedPoint(lines(1)), 8, 1 + 3, |case, column| {
        [case.hyperbolic(column), case.missed(case.run(column, 1))]
    });
    let straight =
        |case: &Case, column: i32| [dd::linear(case.tri, Case::sample(column), case.u).to_f64(), 0.0];
    fixed_point(FixedPoint(Lines::affine()), 9, 64 + 3, straight);
    let budget = 1.0 / 256.0;
    let within = |case: &Case, column: i32| [case.hyperbolic(column), f64::from(budget)];
    // Rounding is part of the budget.
    fixed_point(FixedPoint(Lines::bounded(budget)), 10, 0, within);
    // One that is smaller than that cannot be kept: runs are of one column then.
    let step = 1.0 / 65536.0;
    fixed_point(FixedPoint(Lines::bounded(step)), 13, 1 + 3, |case, column| [case.hyperbolic(column), 0.0]);
}
