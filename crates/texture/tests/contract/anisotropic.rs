//! Probes along the longer axis, and what they are good for.

use alberti_math::lanes::{Lanes, OneFixed};
use alberti_math::{Q16, Rgba8};
use alberti_texture::format::{Rgba8888, Scalars};
use alberti_texture::mipmap::build;
use alberti_texture::{
    Anisotropic, Bilinear, Gradient, Mipmap, Mirror, Nearest, NearestLevel, Repeat, Trilinear,
};
use glam::{Vec2, Vec2Swizzles as _};

use crate::lod::{footprint, map};
use crate::minify::{SIZES, constant, noise, same_lanes};
use crate::oracle::Random;

/// The probes of the documentation, for lengths whose logarithms are clear: powers of two, and three times that.
#[test]
fn anisotropic_is_the_mean_of_its_probes() {
    fn check(probes: u32, random: &mut Random, mipmap: Mipmap<'_, Rgba8888>, seen: &mut [u32; 5]) {
        let long = 2f32.powi((random.bits() % 6).cast_signed()) / 64.0;
        let (ratio, k) =
            [(1.0, 0), (1.5, 1), (2.0, 1), (3.0, 2), (4.0, 2), (6.0, 3), (8.0, 3), (12.0, 4), (32.0, 5)]
                [random.bits() as usize % 9];
        let short = long / ratio;
        let log2_probes = k.min(probes.trailing_zeros());
        seen[log2_probes as usize] += 1;
        // λ of the shorter axis, or of the part of the longer one that a probe has.
        let lambda = |x: f32| Gradient { dx: [x, 0.0], ..Gradient::default() }.lod(64, 64);
        let lambda = lambda(short).max(lambda(long) - probes.trailing_zeros() as f32);
        let uv = Vec2::new(random.near_zero(), random.near_zero());
        let (across, swap) = (random.bits() & 1 == 0, random.bits() & 1 == 0);
        let axis = |x: f32| if across { Vec2::new(x, 0.0) } else { Vec2::new(0.0, x) };
        let (major, minor) = (axis(long), axis(short).yx());
        let (dx, dy) = if swap { (minor, major) } else { (major, minor) };
        let d = Gradient { dx: [dx.x, dx.y], dy: [dy.x, dy.y] };
        let n = 1 << log2_probes;
        let isotropic = mipmap.sampler(Trilinear, Repeat);
        let colors: Vec<[u8; 4]> = (0..n)
            .map(|i| {
                let place = (i as f32 + 0.5) / n as f32 - 0.5;
                // Of two equal axes either may be the longer one.
                isotropic.sample_lod(uv + major * place, lambda).to_bytes()
            })
            .collect();
        let found =
            mipmap.sampler(Anisotropic { probes, filter: Trilinear }, Repeat).sample_grad(uv, d).to_bytes();
        for channel in 0..4 {
            let sum: i32 = colors.iter().map(|color| i32::from(color[channel])).sum();
            assert_eq!(i32::from(found[channel]), (2 * sum + n) / (2 * n), "{uv} {d:?}, {n} probes");
        }
    }
    let mut random = Random(85);
    let texels = noise(&mut random, 64, 64, false);
    let mipmap = Mipmap::new(Rgba8888, &texels, 64, 64).unwrap();
    let mut seen = [0; 5];
    for _ in 0..20_000 {
        check(16, &mut random, mipmap, &mut seen);
        check(4, &mut random, mipmap, &mut seen);
        check(1, &mut random, mipmap, &mut seen);
    }
    assert!(seen.iter().all(|&seen| seen > 1000), "{seen:?}");
}

/// A floor seen at an angle, sixteen texels deep a pixel and one wide: what is nearer to the mean over the pixel. The
/// floor is turned, and the camera rolled, by any angle, with the floor upright first and then rolled by 45 degrees:
/// then both derivatives are nearly parallel and equally long.
#[test]
fn anisotropic_is_sharper() {
    let mut random = Random(86);
    let mut texels = noise(&mut random, 64, 64, false);
    build(Scalars(Rgba8888), &mut texels, 64, 64).unwrap();
    let mipmap = Mipmap::new(Rgba8888, &texels, 64, 64).unwrap();
    let mut squares = |angle: f32, roll: f32| {
        let d = map(footprint(16.0, 16.0, angle.into(), roll.into(), [64, 64]), |d| d as f32);
        let long = Vec2::from_angle(angle) * 16.0 / 64.0;
        let (mut sharp, mut soft) = (0.0, 0.0);
        for _ in 0..1000 {
            let uv = Vec2::new(random.near_zero(), random.near_zero());
            let base = mipmap.level(0).sampler(Bilinear, Repeat);
            let read = |i: u8| base.sample(uv + long * ((f32::from(i) + 0.5) / 160.0 - 0.5)).to_bytes()[0];
            let mean = (0..160).map(|i| f64::from(read(i))).sum::<f64>() / 160.0;
            let error = |found: Rgba8| (f64::from(found.to_bytes()[0]) - mean).powi(2) / 1000.0;
            sharp += error(
                mipmap.sampler(Anisotropic { probes: 16, filter: Trilinear }, Repeat).sample_grad(uv, d),
            );
            soft += error(mipmap.sampler(Trilinear, Repeat).sample_grad(uv, d));
        }
        (sharp, soft)
    };
    for turned in 0..4 {
        let angle = turned as f32 * std::f32::consts::FRAC_PI_8;
        let (upright, soft) = squares(angle, 0.0);
        let rolls = [0.1, 0.25, 0.5].map(|part| squares(angle, part * std::f32::consts::PI).0);
        println!(
            "turned by {turned}/8 of 180 degrees: trilinear {soft:.1}, upright {upright:.1}, rolled {rolls:.1?}"
        );
        assert!(upright < soft / 4.0);
        assert!(rolls.iter().all(|rolled| (rolled / upright - 1.0).abs() < 0.3));
    }
}

/// A rolled camera sees what one that is upright does: places, levels and numbers of probes are the same but for
/// rounding.
#[test]
fn rolling_changes_nothing() {
    let mut random = Random(88);
    let texels = noise(&mut random, 64, 64, false);
    let mipmap = Mipmap::new(Rgba8888, &texels, 64, 64).unwrap();
    let sampler = mipmap.sampler(Anisotropic { probes: 16, filter: Trilinear }, Repeat);
    let mut worst = 0;
    for _ in 0..20_000 {
        let mut unit = || f64::from(random.bits()) / 2f64.powi(32);
        // Not where rounding changes the number of probes.
        let ratio = 2f64.powf(0.01 + 0.98 * unit() + (unit() * 6.0).floor());
        let (long, angle, roll) = (2f64.powf(unit() * 8.0 - 2.0), unit() * 7.0, unit() * 7.0);
        let [upright, rolled] =
            [0.0, roll].map(|roll| map(footprint(long, ratio, angle, roll, [64, 64]), |d| d as f32));
        let uv = Vec2::new(unit() as f32, unit() as f32);
        let [a, b] = [upright, rolled].map(|d| sampler.sample_grad(uv, d).to_bytes());
        for (a, b) in a.into_iter().zip(b) {
            worst = worst.max(a.abs_diff(b));
        }
    }
    println!("rolled: at most {worst} of 255 off");
    assert!(worst <= 2, "{worst}");
}

#[test]
fn lanes_are_one_lane() {
    let mut random = Random(90);
    for (width, height) in SIZES {
        let texels = noise(&mut random, width, height, false);
        let mipmap = Mipmap::new(Rgba8888, &texels, width, height).unwrap();
        same_lanes(Anisotropic { probes: 8, filter: Trilinear }, Repeat, Mirror, mipmap, &mut random);
        if let Some(mipmap) = mipmap.power_of_two() {
            let points = NearestLevel(Nearest);
            same_lanes(Anisotropic { probes: 16, filter: points }, Repeat, Repeat, mipmap, &mut random);
        }
    }
}

/// In fixed point the same as in `f32`, for numbers and logarithms that are exact in both.
#[test]
fn integers() {
    let mut random = Random(91);
    let texels = noise(&mut random, 32, 16, false);
    let mipmap = Mipmap::new(Rgba8888, &texels, 32, 16).unwrap().power_of_two().unwrap();
    for _ in 0..100_000 {
        let mut number = || Q16::from_bits(random.bits().cast_signed() >> 13);
        let (u, v) = (number(), number());
        let float = |q: Q16| OneFixed.store(q)[0];
        let uv = Vec2::new(float(u), float(v));
        // Lengths that are powers of two have the same logarithm.
        let k = random.bits() % 10;
        let (long, short) = (1 << (16 - k), 1 << (16 - k) >> (random.bits() % 6));
        let [long, short] = [long, short].map(Q16::from_bits);
        let zero = Q16::ZERO;
        let d = Gradient { dx: [zero, long], dy: [short, zero] };
        let anisotropic = mipmap.sampler(Anisotropic { probes: 4, filter: Trilinear }, Repeat);
        let found = anisotropic.sample_grad_lanes(OneFixed, u, v, d).0;
        let d = Gradient { dx: [0.0, float(long)], dy: [float(short), 0.0] };
        assert_eq!(found, anisotropic.sample_grad(uv, d).to_bits(), "{u:?} {v:?} {d:?}");
    }
}

#[test]
fn hostile() {
    constant(Anisotropic { probes: 16, filter: Trilinear }, Repeat, &mut Random(92));
}
