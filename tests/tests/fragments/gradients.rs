//! Changes of attributes from pixel to pixel: each policy against integers within the bound that it states.
//!
//! A kernel for each policy of derivatives with each kind of interpolation that it knows; straight lines of any length
//! are `Lines`, one kernel, which `values.rs` compares with the policies that are types.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels and subpixels are within the guard band"
)]

mod same_bits;

use alberti_math::GUARD_PIXELS;
use alberti_oracle::coverage::{Triangle, area2, covers};
use alberti_oracle::gradient::{self, Slopes};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_oracle::{cases, cases::pixel_centre};
use alberti_raster::{
    Differentiation, Exact, FixedPoint, Interpolation, Lines, PerPixel, PerRun, PerTriangle, Planes, Vertex,
};
use alberti_tests::derivatives::{Carried, Told, carried, told};
use alberti_tests::probe::{LARGEST, vertex};
use alberti_tests::sweep::or_swept;
use std::ops::Range;

/// Bits of the grid.
const BITS: u32 = 8;
const STEP: f64 = 1.0 / 65536.0;
const EPS: f64 = 1.0 / (1 << 24) as f64;
/// The documented bounds in ε, relatively and of M: by column and by row of each sample, in the middle of a run, at the
/// centroid, and of linear components.
const BY_COLUMN: [f64; 2] = [13.0 * EPS, 7.0 * EPS];
const BY_ROW: [f64; 2] = [14.0 * EPS, 10.0 * EPS];
const IN_MIDDLE: [f64; 2] = [12.0 * EPS, 7.0 * EPS];
const IN_CENTROID: [f64; 2] = [12.0 * EPS, 8.0 * EPS];
const LINEAR: [f64; 2] = [4.0 * EPS, 4.0 * EPS];
/// In integers, parts of N: the documented one, and half of the documented one for each unit of r.
const FIXED: [f64; 2] = [1.0 / 256.0, 1.0 / (1 << 25) as f64];

/// A triangle with its values, and a pixel that it covers.
#[derive(Clone, Copy, Debug)]
struct Case {
    tri: Triangle,
    pixel: [i32; 2],
    q: [f32; 3],
    /// Of each vertex.
    values: [[f32; 4]; 3],
}

impl Case {
    fn vertices(&self) -> [Vertex<Carried>; 3] {
        std::array::from_fn(|i| vertex(self.tri[i], 0.5, self.q[i], carried(self.values[i])))
    }

    fn component(&self, k: usize) -> [f32; 3] {
        self.values.map(|values| values[k])
    }

    fn sample(&self, column: i32) -> [i64; 2] {
        pixel_centre(i64::from(column), i64::from(self.pixel[1]), BITS)
    }

    fn slopes(&self, column: i32, k: usize) -> Slopes {
        gradient::hyperbolic(self.tri, self.sample(column), BITS, self.q, self.component(k))
    }

    /// The covered columns of the row, which are side by side.
    fn covered(&self) -> Range<i32> {
        let inside = |column: i32| covers(self.tri, self.sample(column));
        let last = |mut inside_at: i32, mut outside_at: i32| {
            while (outside_at - inside_at).abs() > 1 {
                let middle = i32::midpoint(inside_at, outside_at);
                *(if inside(middle) { &mut inside_at } else { &mut outside_at }) = middle;
            }
            inside_at
        };
        last(self.pixel[0], -GUARD_PIXELS - 1)..last(self.pixel[0], GUARD_PIXELS + 1) + 1
    }

    /// The longer side of the box, in subpixels a pixel: pixels times 2^16.
    fn longest(&self) -> f64 {
        let side = |k: usize| {
            let at = self.tri.map(|p| p[k]);
            (at.iter().max().unwrap() - at.iter().min().unwrap()) as f64
        };
        side(0).max(side(1)) * f64::from(1 << BITS)
    }

    /// M: the greatest derivative of a component, had nothing cancelled in its numerator.
    fn magnitude(&self, k: usize, t: f64) -> f64 {
        let [a, b, c] = self.q.map(f64::from);
        let area = area2(self.tri).unsigned_abs() as f64;
        self.longest() * area * spread(self.component(k)) * (a * b + b * c + c * a) / (t * t)
    }

    /// The same in steps of 2^-16. None beyond 255, where `f32` does not hold these, nor, from 4096 on, do integers.
    fn in_steps(&self) -> Option<Self> {
        let rounded = |u: f32| ((f64::from(u) / STEP).round() * STEP) as f32;
        let case = Self { values: self.values.map(|values| values.map(rounded)), ..*self };
        case.values.as_flattened().iter().all(|u| u.abs() <= 255.0).then_some(case)
    }

    /// The bound in integers, but for the last step: N and its parts.
    fn of_integers(&self, k: usize, t: f64) -> f64 {
        let area = area2(self.tri).unsigned_abs() as f64;
        let steepest = f64::from(self.q.into_iter().fold(0.0, f32::max)) * area / t.abs();
        let n = self.longest() * spread(self.component(k)) * steepest / area;
        n * (FIXED[0] + steepest * FIXED[1])
    }
}

fn spread([a, b, c]: [f32; 3]) -> f64 {
    f64::from(a.max(b).max(c)) - f64::from(a.min(b).min(c))
}

/// Triangles from a subpixel thin to the largest, ratios of q from 1 to 10^12, values near one another, far from 0, of
/// both signs.
fn any_case(rng: &mut Rng) -> Case {
    loop {
        let found = if rng.one_in(3) { Some(around(rng)) } else { thin(rng) };
        if let Some((tri, pixel)) = found
            && covers(tri, pixel_centre(i64::from(pixel[0]), i64::from(pixel[1]), BITS))
        {
            let ratio = if rng.one_in(4) { 1.0 } else { rng.log_uniform(1.0, 1e12) };
            let mut q = [1.0, 1.0 / ratio, 1.0 / rng.log_uniform(1.0, ratio.max(1.000_001))];
            q.rotate_left(rng.index(3));
            let unit = rng.log_uniform(1e-6, 1e6);
            let center = if rng.one_in(2) { 0.0 } else { f64::from(rng.log_uniform(1.0, 1e7)) };
            let mut value = || (center + rng.uniform(-1.0, 1.0)) as f32 * unit;
            // The flat one is so large that no triangle is a small one of fixed point, which would be a single run.
            let values = [(); 3].map(|()| [value(), value(), value(), 100.0]);
            return Case { tri, pixel, q, values };
        }
    }
}

fn around(rng: &mut Rng) -> (Triangle, [i32; 2]) {
    let pixel = [(); 2].map(|()| rng.range(0, i64::from(LARGEST) - 1));
    let guard = i64::from(GUARD_PIXELS) << BITS;
    let reach = f64::from(rng.log_uniform(1.0, LARGEST as f32)) * f64::from(1 << BITS);
    let sample = pixel_centre(pixel[0], pixel[1], BITS);
    let tri = [(); 3]
        .map(|()| sample.map(|c| (c + rng.uniform(-reach, reach).round() as i64).clamp(-guard, guard)));
    (tri, pixel.map(|c| c as i32))
}

/// The oracle's hard cases, mirrored into the frame.
fn thin(rng: &mut Rng) -> Option<(Triangle, [i32; 2])> {
    let case = cases::any(rng, BITS, i64::from(GUARD_PIXELS) << BITS);
    let mirror = case.sample.map(i64::signum);
    let flip = |p: [i64; 2]| [p[0] * mirror[0], p[1] * mirror[1]];
    let pixel = flip(case.sample).map(|c| (c >> BITS) as i32);
    pixel.iter().all(|&c| c < LARGEST).then(|| (case.tri.map(flip), pixel))
}

fn spans(length: i32) -> Lines {
    Lines::spans(length).expect("a power of two")
}

fn samples(of: u64) -> u64 {
    or_swept(of, 100 * of)
}

/// The same with q of the smallest numbers, subnormal ones and a few above these.
fn with_smallest_q(rng: &mut Rng) -> Case {
    let q = [(); 3].map(|()| {
        let most = 1 << rng.range(1, 25);
        f32::from_bits(rng.range(1, most) as u32)
    });
    Case { q, ..any_case(rng) }
}

/// Draws the pixel of many triangles, and some beside it, and hands on the news of each.
fn each_sample(
    differentiation: impl Differentiation,
    policy: impl Interpolation,
    cases: fn(&mut Rng) -> Case,
    (stream, count): (u64, u64),
    mut check: impl FnMut(&Case, i32, &Told),
) {
    let mut rng = Rng::stream(run_seed(), stream);
    let mut seen = 0;
    while seen < samples(count) {
        let case = cases(&mut rng);
        let start = (case.pixel[0] - rng.index(3) as i32).max(0);
        let told =
            told(differentiation, policy, &case.vertices(), case.pixel[1], start..(start + 3).min(LARGEST));
        assert!(told.iter().any(|(column, _)| *column == case.pixel[0]), "{case:?}");
        for (column, told) in &told {
            check(&case, *column, told);
            seen += 1;
        }
    }
}

/// The greatest error as a part of its bound.
#[derive(Debug, Default)]
struct Worst {
    of_bound: f64,
    /// The same where the bound is more than 100 steps of 2^-16, so that rounding to these is nothing.
    of_much: f64,
}

impl Worst {
    fn add(&mut self, case: &Case, got: f32, exact: f64, [relative, absolute]: [f64; 2]) {
        let error = (f64::from(got) - exact).abs();
        let bound = relative * exact.abs() + absolute;
        // NaN as well.
        assert!(error <= bound, "{got:e} for {exact:e}: {:.3} of the bound, {case:?}", error / bound);
        if bound > 0.0 {
            self.of_bound = self.of_bound.max(error / bound);
            if bound > 100.0 * STEP {
                self.of_much = self.of_much.max(error / bound);
            }
        }
    }

    fn report(&self, name: &str) {
        println!("{name}: {:.3} of the bound, {:.3} where it is large", self.of_bound, self.of_much);
    }
}

/// Linear components have the slopes of a plane, flat ones none.
fn check_others(case: &Case, told: &Told, worst: &mut Worst) {
    let plane = gradient::hyperbolic(case.tri, case.sample(case.pixel[0]), BITS, [1.0; 3], case.component(2));
    let area = area2(case.tri).unsigned_abs() as f64;
    let apart = LINEAR[1] * case.longest() * spread(case.component(2)) / area;
    for (got, exact) in [told.dx[2], told.dy[2]].into_iter().zip(plane.derivative) {
        worst.add(case, got, exact, [LINEAR[0], apart]);
    }
    assert_eq!([told.dx[3], told.dy[3]], [0.0; 2]);
}

#[test]
fn per_pixel() {
    let (mut by_column, mut by_row, mut linear) = (Worst::default(), Worst::default(), Worst::default());
    let (mut far, mut thin) = (0, 0);
    each_sample(PerPixel, Exact, any_case, (1, 40_000), |case, column, told| {
        let columns = column - case.covered().start;
        for k in 0..2 {
            let exact = case.slopes(column, k);
            let magnitude = case.magnitude(k, exact.t);
            by_column.add(case, told.dx[k], exact.derivative[0], [BY_COLUMN[0], BY_COLUMN[1] * magnitude]);
            by_row.add(case, told.dy[k], exact.derivative[1], [BY_ROW[0], BY_ROW[1] * magnitude]);
            far += u32::from(columns > 100);
            thin += u32::from(magnitude > 1000.0 * exact.derivative[0].abs());
        }
        check_others(case, told, &mut linear);
    });
    by_column.report("PerPixel, by column");
    by_row.report("PerPixel, by row");
    linear.report("linear components");
    assert!(
        by_column.of_bound > 0.2 && by_row.of_bound > 0.2 && linear.of_bound > 0.4,
        "the bounds are not tested"
    );
    assert!(far > 40 && thin > 40, "{far} far, {thin} thin");
}

#[test]
fn per_span() {
    in_middles(PerRun, Exact, any_case, 3, i32::MAX, 0.0);
    in_middles(PerRun, Planes, any_case, 4, 64, 0.0);
    in_middles(PerRun, spans(8), any_case, 5, 8, 0.0);
    in_middles(PerRun, spans(32), any_case, 6, 32, 0.0);
    in_middles(PerRun, Lines::affine(), any_case, 7, 64, 0.0);
}

/// There all policies but that of triangles are that of runs, and numbers are rounded to 2^-16: those at the vertices
/// as well.
#[test]
fn in_fixed_point() {
    in_middles(PerRun, FixedPoint(spans(16)), any_case, 8, 16, STEP / 2.0);
    in_middles(PerPixel, FixedPoint(spans(8)), any_case, 9, 8, STEP / 2.0);
    in_middles(PerRun, FixedPoint(spans(16)), with_smallest_q, 10, 16, STEP / 2.0);
}

/// The derivatives that each sample gets are right in the middle of its run: of up to `length` columns from a multiple
/// of that on.
fn in_middles(
    differentiation: impl Differentiation,
    policy: impl Interpolation,
    cases: fn(&mut Rng) -> Case,
    stream: u64,
    length: i32,
    step: f64,
) {
    let (mut worst, mut linear, mut off) = (Worst::default(), Worst::default(), 0);
    each_sample(differentiation, policy, cases, (stream, 8_000), |case, column, told| {
        let Some(case) = (if step == 0.0 { Some(*case) } else { case.in_steps() }) else { return };
        let case = &case;
        let first = if length == i32::MAX { i32::MIN / 2 } else { column & !(length - 1) };
        let covered = case.covered();
        let run = covered.start.max(first)..covered.end.min(first.saturating_add(length));
        let middle = run.start + (run.end - run.start) / 2;
        for k in 0..2 {
            let exact = case.slopes(middle, k);
            let bound = if step == 0.0 {
                [IN_MIDDLE[0], IN_MIDDLE[1] * case.magnitude(k, exact.t)]
            } else {
                [0.0, case.of_integers(k, exact.t) + step]
            };
            for (got, exact) in [told.dx[k], told.dy[k]].into_iter().zip(exact.derivative) {
                if step == 0.0 || exact.abs() < 32767.0 {
                    worst.add(case, got, exact, bound);
                }
            }
            let here = case.slopes(column, k).derivative[0];
            off += u32::from((here - exact.derivative[0]).abs() > 0.01 * here.abs() + step);
        }
        if step == 0.0 {
            check_others(case, told, &mut linear);
        }
    });
    worst.report(&format!("{differentiation:?} of {policy:?}"));
    assert!(
        worst.of_bound > 0.2 && worst.of_much > 0.05 && off > 300,
        "{off} samples are off from the middle"
    );
}

#[test]
fn per_triangle() {
    let (mut worst, mut linear) = (Worst::default(), Worst::default());
    each_sample(PerTriangle, Exact, any_case, (11, 40_000), |case, _, told| {
        for k in 0..2 {
            let exact = gradient::in_centroid(case.tri, BITS, case.q, case.component(k));
            let apart = IN_CENTROID[1] * case.magnitude(k, exact.t);
            for (got, exact) in [told.dx[k], told.dy[k]].into_iter().zip(exact.derivative) {
                worst.add(case, got, exact, [IN_CENTROID[0], apart]);
            }
        }
        check_others(case, told, &mut linear);
    });
    worst.report("PerTriangle");
    assert!(worst.of_bound > 0.2);
}

#[test]
fn per_triangle_in_fixed_point() {
    in_centroids_of_integers(any_case, 12);
    in_centroids_of_integers(with_smallest_q, 13);
}

fn in_centroids_of_integers(cases: fn(&mut Rng) -> Case, stream: u64) {
    let mut worst = Worst::default();
    each_sample(PerTriangle, FixedPoint(spans(16)), cases, (stream, 20_000), |case, _, told| {
        let Some(case) = case.in_steps() else { return };
        for k in 0..3 {
            let q = if k == 2 { [1.0; 3] } else { case.q };
            let exact = gradient::in_centroid(case.tri, BITS, q, case.component(k));
            let bound = Case { q, ..case }.of_integers(k, exact.t) + STEP / 2.0;
            for (got, exact) in [told.dx[k], told.dy[k]].into_iter().zip(exact.derivative) {
                if exact.abs() < 32767.0 {
                    worst.add(&case, got, exact, [0.0, bound]);
                }
            }
        }
        assert_eq!([told.dx[3], told.dy[3]], [0.0; 2]);
    });
    worst.report("PerTriangle in fixed point");
    assert!(worst.of_bound > 0.2 && worst.of_much > 0.1);
}
