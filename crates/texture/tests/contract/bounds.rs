//! Bias and limits of the level of detail: the colours are those of the bounded λ.

use alberti_math::lanes::{Lanes, Machine, OneFixed};
use alberti_math::{Q16, for_lanes};
use alberti_texture::format::Rgba8888;
use alberti_texture::{
    Anisotropic, BaseLevel, BetweenLevels, Bilinear, Bounded, Gradient, LodBounds, Minify, MipFilter, Mipmap,
    Nearest, NearestLevel, PowerOfTwo, Repeat, Trilinear,
};
use glam::Vec2;

use crate::minify::noise;
use crate::oracle::Random;

const POINTS: Minify<NearestLevel<Nearest>, Bilinear> = Minify { min: NearestLevel(Nearest), mag: Bilinear };

/// The definition; the sum of two `f32` is rounded once, as `f64` has more than twice the digits.
fn bounded(LodBounds { bias, least, greatest }: LodBounds, lambda: f32) -> f32 {
    let biased = (f64::from(lambda) + f64::from(bias)) as f32;
    if biased > greatest {
        greatest
    } else if biased >= least {
        biased
    } else {
        least
    }
}

/// Some bounds with one of the three, some with all; in 16ths.
fn some(random: &mut Random) -> LodBounds {
    let mut sixteenths = |range: u32| (random.bits() % (16 * range)) as f32 / 16.0;
    let least = sixteenths(5) - 1.0;
    let all = LodBounds { bias: sixteenths(6) - 3.0, least, greatest: least + sixteenths(3) };
    let none = LodBounds::default();
    match random.bits() % 5 {
        0 => LodBounds { bias: all.bias, ..none },
        1 => LodBounds { least, ..none },
        2 => LodBounds { greatest: least, ..none },
        3 => none,
        _ => all,
    }
}

fn slopes(random: &mut Random) -> Gradient<[f32; 2]> {
    let mut slope = || random.near_zero() / 8.0;
    Gradient { dx: [slope(), slope()], dy: [slope(), slope()] }
}

/// By a λ that is given, and by that of derivatives. How often the bounds could be seen.
fn check<M: MipFilter>(filter: M, mipmap: Mipmap<'_, Rgba8888>, random: &mut Random) -> u32 {
    let mut seen = 0;
    let plain = mipmap.sampler(filter, Repeat);
    for i in 0..20_000 {
        let bounds = some(random);
        let sampler = mipmap.sampler(Bounded { filter, bounds }, Repeat);
        let uv = Vec2::new(random.near_zero(), random.near_zero());
        let lambda = match i % 16 {
            0 => [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.0][i / 16 % 4],
            1 => random.float(),
            _ => (random.bits() as f32 / 2f32.powi(32)) * 8.0 - 1.0,
        };
        let found = sampler.sample_lod(uv, lambda);
        assert_eq!(found, plain.sample_lod(uv, bounded(bounds, lambda)), "{bounds:?} at {uv}, {lambda}");
        seen += u32::from(found != plain.sample_lod(uv, lambda));
        let d = slopes(random);
        let lambda = bounded(bounds, d.lod(64, 32));
        assert_eq!(sampler.sample_grad(uv, d), plain.sample_lod(uv, lambda), "{bounds:?} at {uv}, {d:?}");
        // Those of no effect have none.
        let none = Bounded { filter, bounds: LodBounds::default() };
        assert_eq!(mipmap.sampler(none, Repeat).sample_grad(uv, d), plain.sample_grad(uv, d));
    }
    seen
}

#[test]
fn colours_of_the_bounded_level() {
    let mut random = Random(110);
    let texels = noise(&mut random, 64, 32, false);
    let mipmap = Mipmap::new(Rgba8888, &texels, 64, 32).unwrap();
    let seen = [
        check(Trilinear, mipmap, &mut random),
        check(POINTS, mipmap, &mut random),
        check(BetweenLevels(Nearest), mipmap, &mut random),
        // One level only: magnified or not.
        check(Minify { min: BaseLevel(Bilinear), mag: Nearest }, mipmap, &mut random),
    ];
    println!("bounds changed {seen:?} of 20000 colours");
    assert!(seen.iter().all(|&seen| seen > 1000));
}

/// The probes are those without bounds; the level that they are read in is the bounded one.
#[test]
fn probes_keep_their_places() {
    let mut random = Random(111);
    let texels = noise(&mut random, 64, 64, false);
    let mipmap = Mipmap::new(Rgba8888, &texels, 64, 64).unwrap();
    let plain = mipmap.sampler(Trilinear, Repeat);
    for _ in 0..20_000 {
        let bounds = some(&mut random);
        let uv = Vec2::new(random.near_zero(), random.near_zero());
        // 2^k texels along u, 2^(k - j) along v, whose logarithms are exact.
        let (k, j) = (random.bits() % 6, random.bits() % 6);
        let [long, short] = [k.cast_signed(), k.cast_signed() - j.cast_signed()].map(|k| 2f32.powi(k) / 64.0);
        let d = Gradient { dx: [long, 0.0], dy: [0.0, short] };
        let log2_probes = j.min(2);
        let lambda = bounded(bounds, k as f32 - log2_probes as f32);
        let n = 1 << log2_probes;
        let colors: Vec<[u8; 4]> = (0..n)
            .map(|i| uv + Vec2::new(long * ((i as f32 + 0.5) / n as f32 - 0.5), 0.0))
            .map(|uv| plain.sample_lod(uv, lambda).to_bytes())
            .collect();
        let filter = Bounded { filter: Anisotropic { probes: 4, filter: Trilinear }, bounds };
        let sampler = mipmap.sampler(filter, Repeat);
        for (channel, found) in sampler.sample_grad(uv, d).to_bytes().into_iter().enumerate() {
            let sum: i32 = colors.iter().map(|color| i32::from(color[channel])).sum();
            assert_eq!(i32::from(found), (2 * sum + n) / (2 * n), "{bounds:?} at {uv}, {d:?}");
        }
        // A level alone has no shape.
        assert_eq!(sampler.sample_lod(uv, lambda), plain.sample_lod(uv, bounded(bounds, lambda)));
    }
}

/// Eight at a time, each with a λ of its own.
fn same_lanes(filter: impl MipFilter, mipmap: Mipmap<'_, Rgba8888>, random: &mut Random) {
    for _ in 0..300 {
        let sampler = mipmap.sampler(Bounded { filter, bounds: some(random) }, Repeat);
        let uv: [Vec2; 8] = std::array::from_fn(|_| Vec2::new(random.near_zero(), random.near_zero()));
        let slopes: [Gradient<[f32; 2]>; 8] = std::array::from_fn(|_| slopes(random));
        for machine in Machine::all() {
            for_lanes!(machine, lanes => {
                let found = lanes.vectorize(
                    #[inline(always)]
                    || {
                        let of = |f: &dyn Fn(usize) -> f32| lanes.load(&lanes.each(f));
                        let (u, v) = (of(&|k| uv[k].x), of(&|k| uv[k].y));
                        let (du_dx, dv_dx) = (of(&|k| slopes[k].dx[0]), of(&|k| slopes[k].dx[1]));
                        let (du_dy, dv_dy) = (of(&|k| slopes[k].dy[0]), of(&|k| slopes[k].dy[1]));
                        let d = Gradient { dx: [du_dx, dv_dx], dy: [du_dy, dv_dy] };
                        lanes.store_words(sampler.sample_grad_lanes(lanes, u, v, d))
                    },
                );
                for (k, &found) in found.as_ref().iter().enumerate() {
                    assert_eq!(found, sampler.sample_grad(uv[k], slopes[k]).to_bits(), "{sampler:?}");
                }
            });
        }
    }
}

#[test]
fn lanes_are_one_lane() {
    let mut random = Random(112);
    let texels = noise(&mut random, 64, 32, false);
    let mipmap = Mipmap::new(Rgba8888, &texels, 64, 32).unwrap();
    same_lanes(Trilinear, mipmap, &mut random);
    same_lanes(Anisotropic { probes: 4, filter: Trilinear }, mipmap, &mut random);
}

/// In fixed point the same as in `f32`, for numbers that are exact in both.
#[test]
fn integers() {
    fn check(filter: impl MipFilter, mipmap: Mipmap<'_, Rgba8888, PowerOfTwo>, random: &mut Random) {
        for _ in 0..20_000 {
            let mut number = |shift: u32| Q16::from_bits(random.bits().cast_signed() >> shift);
            let (u, v, lambda) = (number(13), number(13), number(12));
            let sampler = mipmap.sampler(Bounded { filter, bounds: some(random) }, Repeat);
            let float = |q: Q16| OneFixed.store(q)[0];
            let uv = Vec2::new(float(u), float(v));
            let found = sampler.sample_lod_lanes(OneFixed, u, v, lambda).0;
            assert_eq!(
                found,
                sampler.sample_lod(uv, float(lambda)).to_bits(),
                "{sampler:?} {u:?} {v:?} {lambda:?}"
            );
            let k = random.bits() % 10;
            let [long, short] = [16 - k, 16 - k.max(6)].map(|k| Q16::from_bits(1 << k));
            let zero = Q16::ZERO;
            let d = Gradient { dx: [zero, long], dy: [short, zero] };
            let found = sampler.sample_grad_lanes(OneFixed, u, v, d).0;
            let d = Gradient { dx: [0.0, float(long)], dy: [float(short), 0.0] };
            assert_eq!(found, sampler.sample_grad(uv, d).to_bits(), "{sampler:?} {u:?} {v:?} {d:?}");
        }
    }
    let mut random = Random(113);
    let texels = noise(&mut random, 32, 16, false);
    let mipmap = Mipmap::new(Rgba8888, &texels, 32, 16).unwrap().power_of_two().unwrap();
    check(Trilinear, mipmap, &mut random);
    check(POINTS, mipmap, &mut random);
    check(Anisotropic { probes: 4, filter: Trilinear }, mipmap, &mut random);
}
