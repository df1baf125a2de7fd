//! Several samples at a time: every number of lanes gives the bits of one, and fixed point keeps its own bounds.

use crate::support::{EPS, vec3};
use alberti_math::lanes::{Floating, Lanes, Machine, One, OneFixed};
use alberti_math::{Q16, for_lanes};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::surface::{
    NormalEncoding,
    NormalEncoding::{Centred, Unorm},
    ambient_occlusion_lanes, blinn_phong_cosine_lanes, blinn_phong_lanes, lambert_lanes, normal_lanes,
    normal_of_two_lanes, phong_cosine_lanes, phong_lanes, power_each_lanes, power_lanes, shininess_lanes,
    strengthened_lanes, to_parent_lanes, unit_lanes, wet_lanes,
};
use glam::{DVec3, Vec3};
use std::num::Wrapping;

/// Steps of fixed point.
const STEP: f64 = 1.0 / 65536.0;

pub(crate) fn real(x: Q16) -> f64 {
    f64::from(x.to_bits()) * STEP
}

fn real3(v: [Q16; 3]) -> DVec3 {
    DVec3::from(v.map(real))
}

fn fixed(v: DVec3) -> [Q16; 3] {
    v.to_array().map(|x| Q16::from_bits((x / STEP).round() as i32))
}

/// The greatest difference of components, in steps.
fn off(found: [Q16; 3], exact: DVec3) -> f64 {
    (real3(found) - exact).abs().max_element() / STEP
}

/// A unit vector and what is left of it in fixed point.
fn unit(rng: &mut Rng) -> DVec3 {
    vec3(rng, 1.0).as_dvec3().normalize_or(DVec3::Z)
}

fn texels(encoding: NormalEncoding, meaning: fn(f64) -> f64, one: f64) -> [f64; 2] {
    let mut worst = [0.0f64; 2];
    for word in (0..1 << 24).step_by(3) {
        let channel = |bits: u32| meaning(f64::from(word >> bits & 255));
        let v = DVec3::new(channel(0), channel(8), channel(16));
        let found = normal_lanes(encoding, OneFixed, Wrapping(word));
        if v == DVec3::ZERO {
            assert_eq!(found, fixed(DVec3::Z));
            continue;
        }
        worst[0] = worst[0].max(off(found, v.normalize()));
        if word < 1 << 16 {
            let rest = (one * one - v.x * v.x - v.y * v.y).max(0.0).sqrt();
            let found = normal_of_two_lanes(encoding, OneFixed, Wrapping(word));
            worst[1] = worst[1].max(off(found, DVec3::new(v.x, v.y, rest).normalize()));
        }
    }
    worst
}

#[test]
fn fixed_normals() {
    let unorm = texels(Unorm, |c| 2.0 * c - 255.0, 255.0);
    let centred = texels(Centred, |c| (c - 128.0).max(-127.0), 127.0);
    println!("of three and of two, in steps: {unorm:.3?}, {centred:.3?}");
    for [three, two] in [unorm, centred] {
        assert!(three <= 1.1 && two <= 1.1 && three > 0.9);
    }
}

#[test]
fn fixed_vectors() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 3];
    for _ in 0..300_000 {
        let given = fixed(unit(&mut rng) * f64::from(rng.log_uniform(1e-4, 32000.0)));
        if given != [Q16::ZERO; 3] {
            worst[0] = worst[0].max(off(unit_lanes(OneFixed, given), real3(given).normalize()));
        }
        let (x, z) = (unit(&mut rng), unit(&mut rng));
        let x = x.reject_from_normalized(z).normalize_or(z.any_orthonormal_vector());
        let axes = [fixed(x), fixed(z.cross(x)), fixed(z)];
        let n = fixed(unit(&mut rng));
        let [a, b, c] = axes.map(real3);
        let local = real3(n);
        let exact = (a * local.x + b * local.y + c * local.z).normalize();
        worst[1] = worst[1].max(off(to_parent_lanes(OneFixed, axes, n), exact));
        let strength = f64::from(rng.log_uniform(1e-3, 16000.0)) * if rng.one_in(2) { 1.0 } else { -1.0 };
        let exact = DVec3::new(local.x * strength, local.y * strength, local.z);
        if exact.length() > 3.0 * STEP {
            let error = off(strengthened_lanes(OneFixed, n, strength as f32), exact.normalize());
            worst[2] = worst[2].max(error / (3.0 + 1.5 / exact.length()));
        }
    }
    println!("unit, to parent, in steps, and a share of the bound, strengthened: {worst:.3?}");
    assert!(worst[0] <= 2.5 && worst[1] <= 4.0 && worst[2] <= 1.0 && worst[2] > 0.5);
    assert_eq!(unit_lanes(OneFixed, [Q16::ZERO; 3]), fixed(DVec3::Z));
    let n = [Q16::from_bits(30_000), Q16::ZERO, Q16::from_bits(58_000)];
    assert_eq!(strengthened_lanes(OneFixed, n, f32::INFINITY), strengthened_lanes(OneFixed, n, 16384.0));
    let greatest = [i32::MAX, -i32::MAX, 1].map(Q16::from_bits);
    assert!(off(unit_lanes(OneFixed, greatest), DVec3::new(0.5f64.sqrt(), -(0.5f64.sqrt()), 0.0)) <= 2.5);
}

#[test]
fn unit_vectors() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 2];
    for _ in 0..300_000 {
        let given = vec3(&mut rng, 1.0) * rng.log_uniform(1e-17, 1e17);
        let found = Vec3::from(unit_lanes(One, given.to_array())).as_dvec3();
        let exact = given.as_dvec3().normalize();
        worst[0] = worst[0].max(((found - exact) / exact).abs().max_element() / EPS);
        worst[1] = worst[1].max((found.length() - 1.0).abs() / EPS);
    }
    println!("components {:.3}ε, lengths {:.3}ε", worst[0], worst[1]);
    assert!(worst[0] <= 4.0 && worst[1] <= 3.1 && worst[0] > 2.0);
    assert_eq!([unit_lanes(One, [0.0; 3]), unit_lanes(One, [-0.0; 3])], [[0.0, 0.0, 1.0]; 2]);
}

#[test]
fn fixed_materials() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 7];
    let mut note = |k: usize, found: f64, exact: f64| worst[k] = worst[k].max((found - exact).abs() / STEP);
    for _ in 0..300_000 {
        let [n, l] = [unit(&mut rng), unit(&mut rng)].map(fixed);
        let near = real3(n) * (2.0 * real3(n).dot(real3(l))) - real3(l);
        let v = fixed((near + unit(&mut rng) * f64::from(rng.log_uniform(1e-3, 2.0))).normalize_or(DVec3::X));
        let [dn, dl, dv] = [n, l, v].map(real3);
        note(0, real(lambert_lanes(OneFixed, n, l)), dn.dot(dl).max(0.0));
        let e = rng.log_integer(256) as u32;
        if dn.dot(dl) > 1e-4 {
            let along = (dn * (2.0 * dn.dot(dl)) - dl).dot(dv).clamp(0.0, 1.0);
            let found = phong_cosine_lanes(OneFixed, n, l, v);
            note(1, real(found), along);
            let share = if found > Q16::ZERO { power_lanes(OneFixed, found, e) } else { Q16::ZERO };
            assert_eq!(phong_lanes(OneFixed, n, l, v, e), share);
            let found = blinn_phong_cosine_lanes(OneFixed, n, l, v);
            if (dl + dv).length() >= 1.0 {
                note(2, real(found), dn.dot((dl + dv).normalize()).clamp(0.0, 1.0));
            }
            let share = if found > Q16::ZERO { power_lanes(OneFixed, found, e) } else { Q16::ZERO };
            assert_eq!(blinn_phong_lanes(OneFixed, n, l, v, e), share);
        }
        let x = Q16::from_bits(65536 - (rng.unit() * 200_000.0 / f64::from(e)).min(65536.0) as i32);
        let power = power_lanes(OneFixed, x, e);
        // As shares of what the exponent allows.
        let exact = real(x).powi(e.cast_signed());
        note(3, exact + (real(power) - exact) / f64::from(e) * 2.0, exact);
        assert_eq!(power_each_lanes(OneFixed, x, Wrapping(e), 256), power);
        let m = Q16::from_bits(rng.range(0, 65536) as i32);
        let range = [rng.range(0, 100) as u32, rng.range(100, 32766) as u32];
        let exponent = f64::from(shininess_lanes(OneFixed, m, range).0);
        let [least, greatest] = range.map(f64::from);
        assert!((exponent - least - (greatest - least) * real(m)).abs() <= 0.51);
        note(4, real(ambient_occlusion_lanes(OneFixed, m, 0.75)), 1.0 + 0.75 * (real(m) - 1.0));
        let gloss = Q16::from_bits(rng.range(0, 65536) as i32);
        let (diffuse, wet) = wet_lanes(OneFixed, [gloss; 3], gloss, m);
        note(5, real(diffuse[1]), real(gloss) * (1.0 - 0.7 * real(m)));
        note(6, real(wet), (real(gloss) * (1.0 + 1.5 * real(m))).min(1.0));
    }
    println!("Lambert, cosines of Phong and Blinn, power, occlusion, wetness, in steps: {worst:.3?}");
    let bounds = [1.6, 5.0, 4.0, 1.0, 1.0, 1.5, 1.5];
    for (worst, bound) in worst.iter().zip(bounds) {
        assert!(worst <= &bound && *worst > 0.2 * bound, "{worst} {bound}");
    }
    let x = Q16::from_bits(60_000);
    assert_eq!([0, 1].map(|e| power_lanes(OneFixed, x, e)), [Q16::ONE, x]);
}

/// Numbers of each lane, any bits among them.
fn loads<L: Floating, const N: usize>(lanes: L, all: &[[f32; N]]) -> [L::Number; N] {
    std::array::from_fn(|k| lanes.load(&lanes.each(|i| all[i][k])))
}

/// What one lane makes of each is what many lanes make of all.
pub(crate) fn same<L: Floating, const N: usize, const M: usize>(
    lanes: L,
    given: &[[f32; N]],
    wide: impl FnOnce([L::Number; N]) -> [L::Number; M],
    one: impl Fn([f32; N]) -> [f32; M],
) {
    let found = wide(loads(lanes, given)).map(|x| lanes.store(x));
    for (i, &given) in given.iter().take(L::COUNT).enumerate() {
        for (k, expected) in one(given).into_iter().enumerate() {
            let found = found[k].as_ref()[i];
            let equal = found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan();
            assert!(equal, "lane {i}, component {k} of {given:?}: {found} {expected}");
        }
    }
}

fn vectors(rng: &mut Rng) -> [[f32; 12]; 8] {
    std::array::from_fn(|_| {
        let any = rng.one_in(4);
        std::array::from_fn(|_| if any { rng.any_f32() } else { rng.uniform(-1.0, 1.0) as f32 })
    })
}

fn three<T: Copy>(v: [T; 12], k: usize) -> [T; 3] {
    [v[3 * k], v[3 * k + 1], v[3 * k + 2]]
}

fn check_vectors<L: Lanes>(lanes: L, v: [L::Number; 12]) -> [L::Number; 14] {
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| three(v, k));
    let [ux, uy, uz] = unit_lanes(lanes, a);
    let [px, py, pz] = to_parent_lanes(lanes, [a, b, c], d);
    let (wet, gloss) = wet_lanes(lanes, a, b[0], b[1]);
    let exponents = shininess_lanes(lanes, c[0], [1, 300]);
    [
        ux,
        uy,
        uz,
        px,
        py,
        pz,
        lambert_lanes(lanes, a, b),
        phong_lanes(lanes, a, b, c, 7),
        blinn_phong_lanes(lanes, a, b, c, 40),
        power_each_lanes(lanes, blinn_phong_cosine_lanes(lanes, a, b, c), exponents, 300),
        power_lanes(lanes, phong_cosine_lanes(lanes, a, b, c), 12),
        ambient_occlusion_lanes(lanes, a[0], 0.7),
        wet[2],
        gloss,
    ]
}

#[test]
fn any_number_of_lanes_gives_the_same_bits() {
    let mut rng = Rng::new(run_seed());
    for _ in 0..20_000 {
        let given = vectors(&mut rng);
        for machine in Machine::all() {
            for_lanes!(machine, lanes => {
                same(lanes, &given, |v| check_vectors(lanes, v), |v| check_vectors(One, v));
            });
        }
    }
    // Exponents that differ from lane to lane are those of one.
    for e in (0..70).chain([255, 256, 65535]) {
        let x = Vec3::new(0.99, 0.5, 0.0);
        for x in x.to_array() {
            assert_eq!(power_each_lanes(One, x, Wrapping(e), 65535), power_lanes(One, x, e));
        }
    }
}
