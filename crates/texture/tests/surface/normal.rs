//! Normal maps: all texels, against integers and `f64`.

use crate::support::{EPS, angle, vec3};
use alberti_math::lanes::{Floating, Machine, One};
use alberti_math::{Object, Point3, Rgba8, Vector3, for_lanes};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::surface::{
    NormalEncoding,
    NormalEncoding::{Centred, Unorm},
    Tangent, frame_of_tangent, normal, normal_lanes, normal_of_two, normal_of_two_lanes, normal_to_parent,
    strengthened, strengthened_lanes,
};
use glam::{DVec3, Vec3};
use std::num::Wrapping;

/// The number of a byte, from the definition.
type Meaning = fn(u8) -> f64;

fn unorm(c: u8) -> f64 {
    2.0 * f64::from(c) / 255.0 - 1.0
}

fn centred(c: u8) -> f64 {
    ((f64::from(c) - 128.0) / 127.0).max(-1.0)
}

/// Errors of components and of the length, and of the direction, in ε.
fn errors(found: Vec3, exact: DVec3) -> [f64; 3] {
    let (found, exact) = (found.as_dvec3(), exact.normalize());
    let worst =
        (0..3).map(|i| if found[i] == exact[i] { 0.0 } else { ((found[i] - exact[i]) / exact[i]).abs() });
    [
        worst.fold(0.0, f64::max) / EPS,
        (found.length() - 1.0).abs() / EPS,
        (found / found.length()).distance(exact) / EPS,
    ]
}

fn all(encoding: NormalEncoding, meaning: Meaning) -> [f64; 3] {
    let mut worst = [0.0f64; 3];
    // The numbers of bytes in integers over one denominator, so that `f64` adds no noise to a zero.
    let denominator = if encoding == Unorm { 255.0 } else { 127.0 };
    let numbers: Vec<f64> = (0..=255).map(|c| (meaning(c) * denominator).round()).collect();
    for word in 0..1 << 24 {
        let [r, g, b, _] = Rgba8::from_bits(word).to_bytes();
        let exact = DVec3::new(numbers[usize::from(r)], numbers[usize::from(g)], numbers[usize::from(b)]);
        let found: Vector3<Tangent> = normal(encoding, Rgba8::from_bits(word | 0xff00_0000));
        let found = found.coords;
        if exact == DVec3::ZERO {
            assert_eq!(found, Vec3::Z);
            continue;
        }
        for (worst, error) in worst.iter_mut().zip(errors(found, exact)) {
            assert!(error.is_finite());
            *worst = worst.max(error);
        }
    }
    worst
}

#[test]
fn all_texels_are_unit_vectors() {
    for [component, length, direction] in [all(Unorm, unorm), all(Centred, centred)] {
        println!("components {component:.3}ε, lengths {length:.3}ε, directions {direction:.3}ε");
        assert!(component <= 2.0 && length <= 2.0 && direction <= 1.1);
        assert!(component > 1.5, "the bound is not tested");
    }
}

fn all_pairs(encoding: NormalEncoding, meaning: Meaning) -> [f64; 2] {
    let mut worst = [0.0f64; 2];
    let denominator = if encoding == Unorm { 255.0 } else { 127.0 };
    for word in 0..1 << 16 {
        let [x, y] = [word & 255, word >> 8].map(|c| (meaning(c as u8) * denominator).round());
        let rest = denominator * denominator - x * x - y * y;
        let exact = DVec3::new(x, y, rest.max(0.0).sqrt());
        // Blue and alpha are not looked at.
        let found = normal_of_two(encoding, Rgba8::from_bits(word | word << 16)).coords;
        let [component, length, _] = errors(found, exact);
        worst = [worst[0].max(component), worst[1].max(length)];
        assert_eq!(found.z > 0.0, rest > 0.0);
    }
    worst
}

#[test]
fn all_pairs_have_a_third() {
    for [component, length] in [all_pairs(Unorm, unorm), all_pairs(Centred, centred)] {
        println!("components {component:.3}ε, lengths {length:.3}ε");
        assert!(component <= 2.0 && length <= 2.0);
    }
}

/// Every 7th texel, through all functions.
fn same_bits<L: Floating>(lanes: L, encoding: NormalEncoding) {
    let mut word = 0u32;
    while word < 1 << 24 {
        let texels = lanes.each(|i| word + 7 * i as u32);
        let words = lanes.load_words(&texels);
        let three = normal_lanes(encoding, lanes, words);
        let found =
            [three, normal_of_two_lanes(encoding, lanes, words), strengthened_lanes(lanes, three, 2.5)];
        let stored = found.map(|normal| normal.map(|component| lanes.store(component)));
        for (i, &texel) in texels.as_ref().iter().enumerate() {
            let alone = normal_lanes(encoding, One, Wrapping(texel));
            let expected = [
                alone,
                normal_of_two_lanes(encoding, One, Wrapping(texel)),
                strengthened(Vector3::new(Vec3::from(alone)), 2.5).coords.to_array(),
            ];
            for (stored, expected) in stored.iter().zip(expected) {
                let bits = [0, 1, 2].map(|k| stored[k].as_ref()[i].to_bits());
                assert_eq!(bits, expected.map(f32::to_bits), "{texel:#x}");
            }
        }
        word += 7 * L::COUNT as u32;
    }
}

#[test]
fn any_number_of_lanes_gives_the_same_bits() {
    for machine in Machine::all() {
        for_lanes!(machine, lanes => {
            same_bits(lanes, Unorm);
            same_bits(lanes, Centred);
        });
    }
}

#[test]
fn strength_multiplies_slopes() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 2];
    for _ in 0..300_000 {
        let given: Vector3<Tangent> = normal(Unorm, Rgba8::from_bits(rng.u64() as u32));
        let strength = rng.log_uniform(1e-3, 65536.0) * if rng.one_in(2) { 1.0 } else { -1.0 };
        let found = strengthened(given, strength).coords;
        let n = given.coords.as_dvec3();
        let exact = DVec3::new(n.x * f64::from(strength), n.y * f64::from(strength), n.z);
        let [component, length, _] = errors(found, exact);
        worst = [worst[0].max(component), worst[1].max(length)];
    }
    println!("components {:.3}ε, lengths {:.3}ε", worst[0], worst[1]);
    assert!(worst[0] <= 5.0 && worst[1] <= 4.0);
    let slanted = Vector3::<Tangent>::new(Vec3::new(0.6, 0.0, 0.8));
    // Of a steep one, however small it is; next to 0 it is flat.
    let steep = Vector3::new(Vec3::new(0.6, -0.8, 0.0));
    for exponent in 0..=149 {
        for strength in [0.5_f32.powi(exponent), -1.7 * 0.5_f32.powi(exponent)] {
            let found = strengthened(steep, strength).coords;
            let right =
                if strength.abs() >= 0.5_f32.powi(50) { steep.coords * strength.signum() } else { Vec3::Z };
            assert!((found - right).as_dvec3().abs().max_element() < 5.0 * EPS, "{strength}: {found}");
        }
    }
    assert_eq!(strengthened(slanted, 0.0).coords, Vec3::Z);
    assert_eq!(strengthened(slanted, f32::NAN).coords, Vec3::Z);
    assert_eq!(strengthened(slanted, f32::INFINITY), strengthened(slanted, 65536.0));
    assert_eq!(strengthened(Vector3::new(Vec3::X), 0.0).coords, Vec3::Z);
}

#[test]
fn normals_leave_the_frame() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 2];
    for _ in 0..200_000 {
        let (n, t) = (vec3(&mut rng, 1.0), vec3(&mut rng, 1.0));
        let w = if rng.one_in(2) { 1.0 } else { -1.0 };
        let origin = Point3::<Object>::new(vec3(&mut rng, 100.0));
        let frame = frame_of_tangent(origin, Vector3::new(n), [t.x, t.y, t.z, w]);
        let given: Vector3<Tangent> = normal(Unorm, Rgba8::from_bits(rng.u64() as u32));
        let found = normal_to_parent(&frame, given).coords.as_dvec3();
        let [x, y, z] = [frame.axes().x_axis, frame.axes().y_axis, frame.axes().z_axis].map(|a| a.as_dvec3());
        let local = given.coords.as_dvec3();
        let exact = x * local.x + y * local.y + z * local.z;
        worst[0] = worst[0].max(angle(found, exact) / EPS);
        worst[1] = worst[1].max((found.length() - 1.0).abs() / EPS);
    }
    println!("directions {:.3}ε, lengths {:.3}ε", worst[0], worst[1]);
    assert!(worst[0] <= 6.0 && worst[1] <= 3.1);
}
