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

use alberti_math::Subpixel;
use alberti_oracle::climb::climb;
use alberti_oracle::coverage::{Triangle, covers, weights};
use alberti_oracle::dd::{self, Dd};
use alberti_oracle::rational::{self, Rational};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::attributes::{Case, any_case, within};
use alberti_tests::errors::Errors;
use alberti_tests::probe::{Probe, Recorded};
use alberti_tests::sweep::or_swept;

/// The documented bounds, in ε: of a varying against 1/z as given and against z, and of depth.
const FROM_Q: f64 = 9.0;
const FROM_Z: f64 = 10.0;
const DEPTH: f64 = 6.0;

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
