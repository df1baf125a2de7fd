//! How exact interpolated attributes and depths are: the documented bounds against arithmetic of 106 bits, over depth
//! ratios up to 10^12, triangles from a pixel to the largest frame, slivers, and values of both signs and many sizes.
//!
//! One kernel, exact and recorded, for both grids.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels and subpixels are within the guard band"
)]

use alberti_math::{GUARD_PIXELS, Subpixel};
use alberti_oracle::climb::climb;
use alberti_oracle::coverage::{Triangle, covers, weights};
use alberti_oracle::dd::{self, Dd};
use alberti_oracle::rational::{self, Rational};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_oracle::{cases, cases::pixel_centre};
use alberti_raster::Vertex;
use alberti_tests::errors::Errors;
use alberti_tests::probe::{LARGEST, Probe, Recorded, steps, vertex};
use alberti_tests::sweep::or_swept;

/// The documented bounds, in ε: of a varying against 1/z as given and against z, and of depth.
const FROM_Q: f64 = 9.0;
const FROM_Z: f64 = 10.0;
const DEPTH: f64 = 6.0;

/// A triangle with what it carries, and a pixel that it covers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    pub(crate) tri: Triangle,
    pub(crate) pixel: [i32; 2],
    pub(crate) z: [f32; 3],
    pub(crate) zs: [f32; 3],
    pub(crate) u: [f32; 3],
}

impl Case {
    pub(crate) fn sample(&self, subpixel: Subpixel) -> [i64; 2] {
        center(subpixel, self.pixel)
    }

    pub(crate) fn q(&self) -> [f32; 3] {
        self.z.map(|z| 1.0 / z)
    }

    fn vertices(&self) -> [Vertex<f32>; 3] {
        let q = self.q();
        [0, 1, 2].map(|i| vertex(self.tri[i], self.zs[i], q[i], self.u[i]))
    }

    fn with_other_values(self, rng: &mut Rng) -> Self {
        Self { z: any_z(rng), zs: any_zs(rng), u: any_u(rng), ..self }
    }

    /// The scale of errors: max|u|, not zero.
    pub(crate) fn largest(&self) -> f64 {
        self.u.iter().fold(0.0, |largest, u| f64::max(largest, f64::from(u.abs())))
    }
}

pub(crate) fn any_case(subpixel: Subpixel, rng: &mut Rng) -> Case {
    loop {
        let found = if rng.one_in(4) { thin(subpixel, rng) } else { Some(around(subpixel, rng)) };
        if let Some((tri, pixel)) = found
            && covers(tri, center(subpixel, pixel))
        {
            return Case { tri, pixel, z: [1.0; 3], zs: [0.0; 3], u: [1.0; 3] }.with_other_values(rng);
        }
    }
}

fn center(subpixel: Subpixel, [column, row]: [i32; 2]) -> [i64; 2] {
    pixel_centre(i64::from(column), i64::from(row), subpixel.bits())
}

/// Three vertices around a pixel of the frame, from a pixel to a frame away, and sometimes much flatter than wide.
fn around(subpixel: Subpixel, rng: &mut Rng) -> (Triangle, [i32; 2]) {
    let largest = f64::from(LARGEST);
    let pixel = [(); 2].map(|()| match rng.index(3) {
        0 => rng.range(0, 99),
        1 => i64::from(LARGEST) - 1 - rng.range(0, 99),
        _ => rng.range(0, i64::from(LARGEST) - 1),
    });
    let one = steps(subpixel)[0];
    let guard = i64::from(GUARD_PIXELS) * one;
    let sample = pixel_centre(pixel[0], pixel[1], subpixel.bits());
    let mut reach = [f64::from(rng.log_uniform(1.0, LARGEST as f32)).min(largest) * one as f64; 2];
    if rng.one_in(3) {
        reach[rng.index(2)] /= f64::from(rng.log_uniform(1.0, 1e6));
    }
    let tri = [(); 3].map(|()| {
        [0, 1].map(|k| (sample[k] + rng.uniform(-reach[k], reach[k]).round() as i64).clamp(-guard, guard))
    });
    (tri, pixel.map(|c| c as i32))
}

/// The oracle's hard cases, mirrored into the frame.
fn thin(subpixel: Subpixel, rng: &mut Rng) -> Option<(Triangle, [i32; 2])> {
    let case = cases::any(rng, subpixel.bits(), i64::from(GUARD_PIXELS) << subpixel.bits());
    let mirror = case.sample.map(|c| c.signum());
    let flip = |p: [i64; 2]| [p[0] * mirror[0], p[1] * mirror[1]];
    let pixel = flip(case.sample).map(|c| (c >> subpixel.bits()) as i32);
    pixel.iter().all(|&c| c < LARGEST).then(|| (case.tri.map(flip), pixel))
}

/// Depths in any ratio from 1 to 10^12.
fn any_z(rng: &mut Rng) -> [f32; 3] {
    let near = rng.log_uniform(1e-3, 1e3);
    let ratio = rng.log_uniform(1.0, 1e12);
    let mut z = [near, near * ratio, near * rng.log_uniform(1.0, ratio)];
    z.rotate_left(rng.index(3));
    z
}

/// Screen depths: near one another, near 1 as forward maps make them, or of any size as reversed ones do.
pub(crate) fn any_zs(rng: &mut Rng) -> [f32; 3] {
    let base = rng.unit() as f32;
    let kind = rng.index(3);
    [(); 3].map(|()| match kind {
        0 => (base + rng.uniform(-1e-4, 1e-4) as f32).clamp(0.0, 1.0),
        1 => 1.0 - rng.log_uniform(1e-7, 1.0),
        _ => rng.log_uniform(2f32.powi(-77), 1.0),
    })
}

/// Values of both signs over 80 binary orders, or alike, or the texels of a tiled texture.
pub(crate) fn any_u(rng: &mut Rng) -> [f32; 3] {
    let kind = rng.index(4);
    let base = rng.log_uniform(2f32.powi(-40), 2f32.powi(40));
    let spread = f64::from(rng.log_uniform(1e-6, 1.0));
    [(); 3].map(|()| {
        let sign = if rng.one_in(2) { -1.0 } else { 1.0 };
        match kind {
            0 => sign * rng.log_uniform(2f32.powi(-40), 2f32.powi(40)),
            1 => sign * base,
            2 => base * (1.0 + rng.uniform(-spread, spread)) as f32,
            _ => (sign * rng.range(1, 4096) as f32) / 16.0,
        }
    })
}

#[test]
fn varyings_and_depths_with_eight_bits() {
    interpolated(Subpixel::Sub8, 8, or_swept(1_000_000, 5_000_000));
}

#[test]
fn varyings_and_depths_with_four_bits() {
    interpolated(Subpixel::Sub4, 4, or_swept(1_000_000, 5_000_000));
}

fn interpolated(subpixel: Subpixel, stream: u64, samples: u64) {
    let mut rng = Rng::stream(run_seed(), stream);
    let mut probe = Probe::new(Recorded, subpixel);
    let (mut varying, mut one_sign, mut depth) = (Errors::default(), Errors::default(), Errors::default());
    let (mut steep, mut large, mut worst) = (0, 0, None);
    let mut case = any_case(subpixel, &mut rng);
    for i in 0..samples {
        // Finding a place takes longer than drawing it: several sets of values share one.
        case = if i % 4 == 0 { any_case(subpixel, &mut rng) } else { case.with_other_values(&mut rng) };
        let (u, zs) = probe.interpolated(&case.vertices(), case.pixel).expect("covered");
        let (sample, q) = (case.sample(subpixel), case.q());
        assert!(within(u, case.u) && within(zs, case.zs), "{u} or {zs} outside: {case:?}");
        let error = dd::hyperbolic(case.tri, sample, q, case.u).error_in_eps(u, case.largest());
        if error.abs() > varying.max() {
            worst = Some((error, case));
        }
        varying.add(error);
        if case.u.iter().all(|&u| u >= 0.0) {
            one_sign.add(error);
        }
        let exact = dd::linear(case.tri, sample, case.zs);
        if exact.to_f64() > 0.0 {
            depth.add(exact.error_in_eps(zs, exact.to_f64()));
        }
        steep += u64::from(ratio(case.z) > 1e6);
        large += u64::from(longest(case.tri) > 1024 << subpixel.bits());
    }
    println!("{} bits: varyings {varying}", subpixel.bits());
    println!("  of one sign {one_sign}");
    println!("  depth, relative, {depth}");
    println!("  worst {worst:?}");
    assert!(varying.max() <= FROM_Q, "{varying}: {worst:?}");
    assert!(depth.max() <= DEPTH, "{depth}");
    assert!(steep * 5 > samples && large * 5 > samples, "{steep} steep, {large} large of {samples}");

    let (samples, steps) = or_swept((40_000, 10_000), (1_000_000, 1_000_000));
    let mut shares = |which: usize| {
        climb(run_seed() ^ stream, samples, steps, |rng| {
            let case = any_case(subpixel, rng);
            let (u, zs) = probe.interpolated(&case.vertices(), case.pixel).expect("covered");
            let (sample, exact) =
                (case.sample(subpixel), dd::linear(case.tri, case.sample(subpixel), case.zs));
            let varying = dd::hyperbolic(case.tri, sample, case.q(), case.u).error_in_eps(u, case.largest());
            let depth = exact.error_in_eps(zs, exact.to_f64());
            [varying.abs(), if exact.to_f64() > 0.0 { depth.abs() } else { 0.0 }][which]
        })
    };
    let [varying, depth] = [shares(0), shares(1)];
    println!("  climbed: varyings {varying:?}, depth {depth:?}");
    assert!(varying.most <= FROM_Q && depth.most <= DEPTH, "{varying:?} {depth:?}");
}

pub(crate) fn within(x: f32, [a, b, c]: [f32; 3]) -> bool {
    a.min(b).min(c) <= x && x <= a.max(b).max(c)
}

fn ratio([a, b, c]: [f32; 3]) -> f32 {
    a.max(b).max(c) / a.min(b).min(c)
}

fn longest([a, b, c]: Triangle) -> i64 {
    let side = |p: [i64; 2], q: [i64; 2]| (p[0] - q[0]).abs().max((p[1] - q[1]).abs());
    side(a, b).max(side(b, c)).max(side(c, a))
}

/// Counted from the depths that the reciprocals were rounded from.
#[test]
fn varyings_from_depths() {
    let mut rng = Rng::stream(run_seed(), 1);
    let mut probe = Probe::new(Recorded, Subpixel::Sub8);
    let mut varying = Errors::default();
    while varying.count() < 1_000_000 {
        let case = any_case(Subpixel::Sub8, &mut rng);
        let (u, _) = probe.interpolated(&case.vertices(), case.pixel).expect("covered");
        let exact = from_depths(&case);
        varying.add(exact.error_in_eps(u, case.largest()));
        if varying.count() <= 10_000 {
            // The 106 bits are themselves checked where there is time for rationals.
            let full = rational_from_depths(&case);
            let error = rational::error_in_eps(u, &full, case.largest());
            assert!((error - exact.error_in_eps(u, case.largest())).abs() < 1e-9, "{case:?}");
        }
    }
    println!("varyings from z: {varying}");
    assert!(varying.max() <= FROM_Z, "{varying}");
}

/// E0/z0 : E1/z1 : E2/z2 is E0 z1 z2 : E1 z2 z0 : E2 z0 z1, without a division; products of two f32 are exact in f64.
fn from_depths(case: &Case) -> Dd {
    let e = weights(case.tri, case.sample(Subpixel::Sub8));
    let z = case.z.map(f64::from);
    let t = [0, 1, 2].map(|i| Dd::from_i128(e[i]) * (z[(i + 1) % 3] * z[(i + 2) % 3]));
    let term = |i: usize| t[i] * f64::from(case.u[i]);
    (term(0) + term(1) + term(2)) / (t[0] + t[1] + t[2])
}

fn rational_from_depths(case: &Case) -> Rational {
    let e = weights(case.tri, case.sample(Subpixel::Sub8));
    let t = [0, 1, 2].map(|i| rational::from_int(e[i]) / rational::from_f32(case.z[i]));
    let numerator: Rational = (0..3).map(|i| &t[i] * rational::from_f32(case.u[i])).sum();
    numerator / t.iter().sum::<Rational>()
}

/// A sample that is a vertex has two weights of zero: the vertex's value comes out, but for the roundings of a product
/// with the weight, of the weight's reciprocal, and of the product of the two.
#[test]
fn a_sample_on_a_vertex_sees_the_vertex() {
    let mut rng = Rng::stream(run_seed(), 2);
    let mut probe = Probe::new(Recorded, Subpixel::Sub8);
    let mut varying = Errors::default();
    let mut seen = 0;
    while seen < 50_000 {
        let mut case = any_case(Subpixel::Sub8, &mut rng);
        let corner = rng.index(3);
        case.tri[corner] = case.sample(Subpixel::Sub8);
        if !covers(case.tri, case.tri[corner]) {
            continue;
        }
        let (u, _) = probe.interpolated(&case.vertices(), case.pixel).expect("covered");
        seen += 1;
        varying.add(f64::from(u - case.u[corner]) / f64::from(case.u[corner].abs()) * 2f64.powi(24));
    }
    println!("at vertices: {varying}");
    assert!(varying.max() <= 3.0, "{varying}");
}
