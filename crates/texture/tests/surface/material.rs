//! Shares of light, against `f64` and rationals.

use crate::support::{EPS, vec3};
use alberti_math::{Object, Vector3};
use alberti_oracle::rational::{error_in_eps, from_f32, from_int, to_f64};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::surface::{Wettable, ambient_occlusion, blinn_phong, lambert, phong, power, shininess};
use glam::{DVec3, Vec3};

type V = Vector3<Object>;

fn unit(rng: &mut Rng) -> V {
    Vector3::new(vec3(rng, 1.0).normalize_or(Vec3::Z))
}

/// Three unit vectors, often near to where the highlight is.
fn lit(rng: &mut Rng) -> [V; 3] {
    let (n, l) = (unit(rng), unit(rng));
    let mirrored = n.coords * (2.0 * n.coords.dot(l.coords)) - l.coords;
    let near = mirrored + vec3(rng, 1.0) * rng.log_uniform(1e-4, 2.0);
    [n, l, Vector3::new(near.normalize_or(Vec3::X))]
}

fn wide(v: V) -> DVec3 {
    v.coords.as_dvec3()
}

/// The rational power is exact; few cases, as its digits are as many as the exponent.
#[test]
fn powers_keep_their_bound() {
    let mut rng = Rng::new(run_seed());
    let mut worst = 0.0f64;
    for _ in 0..1000 {
        let exponent = rng.log_integer(80) as u32;
        let x = rng.uniform(0.9, 1.1) as f32;
        let exact = num(x, exponent);
        let error = error_in_eps(power(x, exponent), &exact, to_f64(&exact));
        assert!(exponent > 1 || error == 0.0);
        worst = worst.max(error.abs() / f64::from(exponent.saturating_sub(1).max(1)));
    }
    let mut tiny = 0;
    // Larger ones in `f64`, whose logarithm is precise enough near 1.
    for _ in 0..200_000 {
        let exponent = rng.log_integer(1 << 16) as u32;
        let x = (1.0 - rng.unit() * 100.0 / f64::from(exponent)).clamp(0.05, 1.0) as f32;
        let exact = ((f64::from(x) - 1.0).ln_1p() * f64::from(exponent)).exp();
        if exact < f64::from(f32::MIN_POSITIVE) * 1.1 {
            tiny += 1;
            assert!((f64::from(power(x, exponent)) - exact).abs() <= f32::MIN_POSITIVE.into());
            continue;
        }
        let error = (f64::from(power(x, exponent)) / exact - 1.0).abs() / EPS;
        worst = worst.max((error - 0.01).max(0.0) / f64::from(exponent.saturating_sub(1).max(1)));
    }
    println!("{worst:.3} (exponent − 1)ε");
    assert!(worst <= 1.01 && worst > 0.3 && tiny > 1000);
    assert_eq!([power(0.0, 0), power(0.0, 3), power(2.0, 10), power(1.0, u32::MAX)], [1.0, 0.0, 1024.0, 1.0]);
    assert_eq!(power(0.5, 1000), 0.0);
}

fn num(x: f32, exponent: u32) -> alberti_oracle::rational::Rational {
    (0..exponent).fold(from_int(1), |product, _| product * from_f32(x))
}

#[test]
fn shares_of_light() {
    let mut rng = Rng::new(run_seed());
    let (mut worst, mut seen) = ([0.0f64; 3], [0; 2]);
    for _ in 0..300_000 {
        let [n, l, v] = lit(&mut rng);
        let cosine = wide(n).dot(wide(l));
        worst[0] = worst[0].max((f64::from(lambert(n, l)) - cosine.max(0.0)).abs() / EPS);
        if cosine.abs() < 1e-6 {
            continue;
        }
        let mirrored = wide(n) * (2.0 * cosine) - wide(l);
        let halfway = wide(l) + wide(v);
        let cosines = [mirrored.dot(wide(v)), wide(n).dot(halfway.normalize())];
        // The first power is the cosine; cosines above 1 are what unit vectors of `f32` make.
        let found = [phong(n, l, v, 1), blinn_phong(n, l, v, 1)];
        for k in 0..2 {
            let exact = if cosine > 0.0 { cosines[k].clamp(0.0, 1.0) } else { 0.0 };
            if k == 0 || halfway.length() >= 1.0 {
                worst[k + 1] = worst[k + 1].max((f64::from(found[k]) - exact).abs() / EPS);
                seen[k] += u32::from(exact > 0.99);
            }
            let e = rng.log_integer(1000) as u32;
            let high = [phong(n, l, v, e), blinn_phong(n, l, v, e)][k];
            assert_eq!(high, if found[k] > 0.0 { power(found[k], e) } else { 0.0 });
            if exact > 0.99 && (k == 0 || halfway.length() >= 1.0) {
                let exact = exact.powi(e.cast_signed());
                let bound = [13.0, 8.0][k] * EPS * f64::from(e);
                assert!((f64::from(high) - exact).abs() <= bound * 1.011f64);
            }
        }
    }
    println!("Lambert {:.3}ε, Phong {:.3}ε, Blinn {:.3}ε, {seen:?} highlights", worst[0], worst[1], worst[2]);
    assert!(worst[0] <= 3.0 && worst[1] <= 12.0 && worst[2] <= 7.0 && seen[0].min(seen[1]) > 10_000);
}

#[test]
fn highlights_in_closed_form() {
    let at = |x: f32, y: f32| V::new(Vec3::new(x, 0.0, y));
    let up = at(0.0, 1.0);
    // The light and the eye mirror each other.
    assert_eq!(
        phong(up, at(0.6, 0.8), at(-0.6, 0.8), 50),
        power(phong(up, at(0.6, 0.8), at(-0.6, 0.8), 1), 50)
    );
    assert!((phong(up, at(0.6, 0.8), at(-0.6, 0.8), 50) - 1.0).abs() < 1e-5);
    assert!((blinn_phong(up, at(0.6, 0.8), at(-0.6, 0.8), 50) - 1.0).abs() < 1e-5);
    // An eye straight above: r·v = 0.8, n·h = cos of half of acos 0.8 = √0.9.
    assert!((phong(up, at(0.6, 0.8), up, 2) - 0.64).abs() < 1e-6);
    assert!((blinn_phong(up, at(0.6, 0.8), up, 4) - 0.81).abs() < 1e-6);
    for behind in [at(0.6, -0.8), at(1.0, 0.0), V::new(Vec3::NAN)] {
        let shares = [lambert(up, behind), phong(up, behind, up, 3), blinn_phong(up, behind, up, 3)];
        assert_eq!(shares, [0.0; 3]);
    }
    // What is mirrored away from the eye, r·v = -0.352, and an eye far below the surface, n·h = -0.481.
    assert_eq!([0, 1, 2, 3].map(|m| phong(up, at(0.6, 0.8), at(0.96, 0.28), m)), [0.0; 4]);
    assert_eq!([0, 1, 2, 3].map(|m| blinn_phong(up, at(0.96, 0.28), at(0.28, -0.96), m)), [0.0; 4]);
    // Behind the surface both cosines may be above 0: r·v = 0.352 and n·h = 0.822.
    let (below, above) = (at(0.96, -0.28), at(-0.6, 0.8));
    assert_eq!([0, 1, 2].map(|m| phong(up, below, above, m)), [0.0; 3]);
    assert_eq!([0, 1, 2].map(|m| blinn_phong(up, below, above, m)), [0.0; 3]);
    // Light and eye opposite to each other have nothing halfway.
    assert_eq!(blinn_phong(up, up, at(0.0, -1.0), 3), 0.0);
}

#[test]
fn maps() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 3];
    for _ in 0..200_000 {
        let (m, strength) = (rng.unit() as f32, rng.unit() as f32);
        let range = [rng.range(0, 100) as u32, rng.range(100, 1 << 16) as u32];
        let exact = f64::from(range[0]) + (f64::from(range[1]) - f64::from(range[0])) * f64::from(m);
        worst[0] = worst[0].max((f64::from(shininess(m, range)) - exact).abs());
        let exact = 1.0 + f64::from(strength) * (f64::from(m) - 1.0);
        worst[1] = worst[1].max((f64::from(ambient_occlusion(m, strength)) - exact).abs() / EPS);
        let dry = Wettable { diffuse: vec3(&mut rng, 0.5) + 0.5, gloss: rng.unit() as f32 };
        let wet = dry.wet(m);
        let gloss = (f64::from(dry.gloss) * (1.0 + 1.5 * f64::from(m))).min(1.0);
        worst[2] = worst[2].max((f64::from(wet.gloss) / gloss - 1.0).abs() / EPS);
        for k in 0..3 {
            let exact = f64::from(dry.diffuse[k]) * (1.0 - 0.7 * f64::from(m));
            worst[2] = worst[2].max((f64::from(wet.diffuse[k]) - exact).abs() / exact.max(1e-30) / EPS);
        }
    }
    println!("shininess {:.4}, occlusion {:.3}ε, wetness {:.3}ε", worst[0], worst[1], worst[2]);
    assert!(worst[0] <= 0.51 && worst[1] <= 3.0 && worst[2] <= 5.0);
    assert_eq!(
        [shininess(0.0, [3, 1000]), shininess(1.0, [3, 1000]), shininess(f32::NAN, [3, 9])],
        [3, 1000, 3]
    );
    assert_eq!(
        [ambient_occlusion(0.25, 1.0), ambient_occlusion(0.25, 0.0), ambient_occlusion(9.0, 1.0)],
        [0.25, 1.0, 1.0]
    );
    let road = Wettable { diffuse: Vec3::splat(0.5), gloss: 0.5 };
    assert_eq!([road.wet(0.0), road.wet(-3.0), road.wet(f32::NAN)], [road; 3]);
    assert_eq!(road.wet(1.0).gloss, 1.0);
    assert_eq!(road.wet(7.0), road.wet(1.0));
}
