//! The depth map and the depth formats against exact arithmetic: how far off, whether in order, and how well a distance
//! comes back.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "random f64 become the f32 that are tested, and counts are small"
)]

use alberti_oracle::rational::{self, Rational, from_f32, from_int};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_projection::DepthMap;
use alberti_raster::{D16, D24, DepthFormat, F32, F32Reversed};
use alberti_tests::errors::Errors;

/// ε = 2^-24, half the spacing of f32 from 1 to 2.
const EPS: f64 = 1.0 / 16_777_216.0;
/// The documented bounds, in ε: of zs, absolutely, and of a distance through the reversed map and back, relatively.
const ZS: f64 = 2.0;
const ROUND_TRIP: f64 = 4.0;

/// Planes with a far to near ratio of which the logarithm is uniform.
fn any_planes(rng: &mut Rng, least: f32, most: f32) -> [f32; 2] {
    let near = rng.log_uniform(1e-4, 1e3);
    [near, near * rng.log_uniform(least, most)]
}

fn maps([near, far]: [f32; 2]) -> [DepthMap; 2] {
    let map = |map: Result<DepthMap, _>| map.expect("0 < near < far");
    [map(DepthMap::forward(near, far)), map(DepthMap::reversed(near, far))]
}

/// Between the planes: near one of them, or anywhere on a logarithmic scale.
fn any_z(rng: &mut Rng, [near, far]: [f32; 2]) -> f32 {
    let z = match rng.index(4) {
        0 => near * (1.0 + rng.log_uniform(1e-7, 1.0)),
        1 => far * (1.0 - rng.log_uniform(1e-7, 0.5)),
        _ => rng.log_uniform(near, far),
    };
    z.clamp(near, far)
}

/// α + β/z of the map's own α and β, in f64: within 2^-51 of exact, which is nothing beside ε.
fn own(map: &DepthMap, z: f32) -> f64 {
    f64::from(map.alpha()) + f64::from(map.beta()) / f64::from(z)
}

/// The depth that the planes ask for, likewise.
fn ideal(reversed: bool, [near, far]: [f32; 2], z: f32) -> f64 {
    let [a, b, z] = [near, far, z].map(f64::from);
    if reversed { a * (b - z) / (z * (b - a)) } else { b * (z - a) / (z * (b - a)) }
}

/// A reference in f64 is good enough where it agrees with rationals to a small part of ε.
fn assert_close(f64_value: f64, exact: &Rational) {
    let off = rational::to_f64(&(rational::from_f64(f64_value) - exact));
    assert!(off.abs() <= 1e-4 * EPS, "{f64_value} is off by {off:e}");
}

/// From α and β as they are: the division's error, half an ulp of β/z, and the sum's, half an ulp of at most 1. From
/// the planes α's and β's own roundings come on top. α = B/(B-A) is the largest |β/z|: for planes close together it is
/// large.
#[test]
fn screen_depth_is_within_its_bounds() {
    let mut rng = Rng::stream(run_seed(), 1);
    for (least, most) in [(1.01, 4.0), (4.0, 1e9)] {
        let mut own_errors = [(); 2].map(|()| Errors::default());
        let mut errors = own_errors.clone();
        for i in 0..150_000 {
            let planes = any_planes(&mut rng, least, most);
            let alpha = f64::from(planes[1]) / (f64::from(planes[1]) - f64::from(planes[0]));
            for (kind, map) in maps(planes).into_iter().enumerate() {
                for _ in 0..10 {
                    let z = any_z(&mut rng, planes);
                    let zs = f64::from(map.zs(z));
                    assert!((0.0..=1.0).contains(&zs));
                    let own = (zs - own(&map, z).clamp(0.0, 1.0)) / EPS;
                    let wanted = ideal(kind == 1, planes, z);
                    let error = (zs - wanted) / EPS;
                    assert!(own.abs() <= alpha + 0.5, "{own} at {z} between {planes:?}");
                    assert!(error.abs() <= 3.0 * alpha + 0.5, "{error} at {z} between {planes:?}");
                    own_errors[kind].add(own);
                    errors[kind].add(error);
                    if i < 500 {
                        let full = if kind == 1 { rational::depth_reversed } else { rational::depth };
                        assert_close(wanted, &full(z, planes[0], planes[1]));
                    }
                }
            }
        }
        for (kind, name) in ["forward", "reversed"].into_iter().enumerate() {
            println!("B/A {least} to {most:e}, {name}: from its α and β {}", own_errors[kind]);
            println!("  from the planes {}", errors[kind]);
            assert!(least < 3.0 || own_errors[kind].max() <= ZS, "{}", own_errors[kind]);
        }
    }
}

/// Every f32 of a run of a million, next to the near plane, up to the far plane, and in between.
#[test]
fn no_later_depth_comes_before_an_earlier_one() {
    const RUN: u32 = 1 << 20;
    let mut rng = Rng::stream(run_seed(), 2);
    let (mut checked, mut steps) = (0u64, [0u64; 2]);
    for _ in 0..32 {
        let planes = any_planes(&mut rng, 2.0, 1e9);
        let [forward, reversed] = maps(planes);
        let [first, last] = planes.map(f32::to_bits);
        let runs = [first, last - RUN, rng.range(i64::from(first), i64::from(last - RUN)) as u32];
        for start in runs {
            let at = |bits: u32| f32::from_bits(bits.clamp(first, last));
            let mut before = [forward.zs(at(start)), reversed.zs(at(start))];
            for bits in start + 1..=start + RUN {
                let z = at(bits);
                let now = [forward.zs(z), reversed.zs(z)];
                assert!(before[0] <= now[0] && before[1] >= now[1], "at {z} between {planes:?}");
                steps[0] += u64::from(before[0] != now[0]);
                steps[1] += u64::from(before[1] != now[1]);
                before = now;
            }
            checked += u64::from(RUN);
        }
    }
    println!("{checked} neighbours in order, of which told apart {steps:?}");
    assert!(steps[1] > steps[0] && steps[0] * 50 > checked);
}

/// The distance of the stored depth, at B/A from 10 to 10^9.
#[test]
fn distances_come_back_as_documented() {
    let mut rng = Rng::stream(run_seed(), 3);
    println!("B/A      forward, relative     reversed          depths in the far half, forward and reversed");
    for exponent in 0..=9 {
        let ratio = if exponent == 0 { 1.5 } else { 10f32.powi(exponent) };
        let (mut forward_error, mut reversed_error) = (0f64, Errors::default());
        let mut told_apart = [0, 0];
        for i in 0..40 {
            let near = if i == 0 { 1.0 } else { rng.log_uniform(1e-3, 1e3) };
            let planes = [near, near * ratio];
            let [forward, reversed] = maps(planes);
            for _ in 0..20_000 {
                let z = any_z(&mut rng, planes);
                let back = |map: &DepthMap| (f64::from(map.z(map.zs(z))) - f64::from(z)) / f64::from(z);
                forward_error = forward_error.max(back(&forward).abs());
                reversed_error.add(back(&reversed) / EPS);
            }
            if i == 0 {
                told_apart = [forward, reversed].map(|map| {
                    let mut seen: Vec<u32> = (0..=200_000)
                        .map(|k| {
                            map.zs((planes[1] * (1.0 + k as f32 / 200_000.0) / 2.0).min(planes[1])).to_bits()
                        })
                        .collect();
                    seen.dedup();
                    seen.len()
                });
            }
        }
        println!("{ratio:<8e} {forward_error:>15.2e}     {reversed_error}     {told_apart:?}");
        assert!(reversed_error.max() <= ROUND_TRIP, "{reversed_error}");
        let documented = match exponent {
            3 => 1e-5..1e-4,
            6 => 1e-2..1e-1,
            _ => 0.0..f64::INFINITY,
        };
        assert!(exponent > 7 || documented.contains(&forward_error), "10^{exponent}: {forward_error:e}");
        assert!(exponent != 6 || (16..=20).contains(&told_apart[0]), "{told_apart:?}");
        assert!(exponent == 0 || told_apart[1] >= 199_000, "{told_apart:?}");
    }
}

/// Integers: zs (2^n - 1), to the nearest, halves upwards; in order.
#[test]
fn integer_depths_are_correctly_rounded() {
    let mut rng = Rng::stream(run_seed(), 4);
    let mut next_to_halves = 0;
    for i in 0..60_000 {
        // As they come, tiny, and around the places where the rounding changes.
        let zs = match i % 3 {
            _ if i <= 4 => [0.0, 0.25, 0.5, 0.75, 1.0][i],
            0 => rng.unit() as f32,
            1 => rng.log_uniform(1e-9, 1.0),
            _ => {
                let max = if rng.one_in(2) { 65_535.0 } else { 16_777_215.0 };
                let step = (rng.unit() * max).floor() + 0.5;
                next_to_halves += 1;
                f32::from_bits(
                    (((step / max) as f32).to_bits()).saturating_add_signed(rng.range(-1, 1) as i32),
                )
            }
        };
        let zs = zs.clamp(0.0, 1.0);
        let nearest = |max: i64| (from_f32(zs) * from_int(i128::from(max)) + rational::from_f64(0.5)).floor();
        for (max, got) in [(0xffff, i128::from(D16.encode(zs))), (0xff_ffff, i128::from(D24.encode(zs)))] {
            assert_eq!(from_int(got), nearest(max), "{zs:e} of {max}");
        }
        assert_eq!((F32.encode(zs), F32Reversed.encode(zs)), (zs, zs));
    }
    println!("{next_to_halves} next to a half");
    assert!(next_to_halves > 10_000);

    let (mut before, mut steps) = ((0, 0), 0);
    for bits in (0..=1f32.to_bits()).step_by(61) {
        let zs = f32::from_bits(bits);
        let now = (D16.encode(zs), D24.encode(zs));
        assert!(before.0 <= now.0 && before.1 <= now.1, "{zs:e}");
        steps += u32::from(before != now);
        before = now;
    }
    assert!(steps > 100_000, "{steps}");
}
