//! Mip filters are the documented integer formulas, close to real numbers, and the same in all lanes.

use alberti_math::lanes::{Lanes, Machine, OneFixed};
use alberti_math::{Q16, Rgba8, for_lanes};
use alberti_texture::format::{Indexed4, Rgba8888, Scalars, Storage};
use alberti_texture::mipmap::{build, texel_count};
use alberti_texture::{
    BaseLevel, BetweenLevels, Bilinear, Border, Clamp, Gradient, Minify, MipFilter, Mipmap, Mirror, Nearest,
    NearestLevel, Repeat, Size, Texture, Trilinear, Wrap,
};
use glam::Vec2;

use crate::bilinear::position;
use crate::oracle::{Mode, Random, SPECIAL};

pub(crate) const SIZES: [(u32, u32); 7] = [(1, 1), (2, 2), (8, 4), (5, 3), (64, 64), (1, 16), (33, 100)];

/// Noise in all levels, so that none can be taken for another; of 0 and 255, which stress weights, or of all bytes.
pub(crate) fn noise(random: &mut Random, width: u32, height: u32, extreme: bool) -> Vec<[u8; 4]> {
    let byte = |byte: u8| if extreme { 255 * (byte & 1) } else { byte };
    (0..texel_count(width, height)).map(|_| random.bits().to_le_bytes().map(byte)).collect()
}

#[derive(Clone, Copy, PartialEq)]
enum In {
    Nearest,
    Bilinear,
}

#[derive(Clone, Copy)]
enum Lv {
    Base,
    Nearest,
    Between,
}

/// A wrap mode on both axes, by its definition.
trait Known: Wrap {
    const MODE: Mode;
}
impl Known for Repeat {
    const MODE: Mode = Mode::Repeat;
}
impl Known for Clamp {
    const MODE: Mode = Mode::Clamp;
}
impl Known for Mirror {
    const MODE: Mode = Mode::Mirror;
}

/// The texels that a filter takes and their weights of 2^16.
fn taps<W: Known>(_: W, level: Texture<'_, Rgba8888>, uv: Vec2, filter: In) -> Vec<([u8; 4], i128)> {
    let (width, height) = (level.width(), level.height());
    let texel = |x: u32, from_bottom: u32| level.texel(x, height - 1 - from_bottom).to_bytes();
    if filter == In::Nearest {
        return vec![(texel(W::MODE.cell(uv.x, width), W::MODE.cell(uv.y, height)), 65536)];
    }
    let ((i, a), (j, b)) = (position(W::MODE, uv.x, width), position(W::MODE, uv.y, height));
    let at = |di, dj| texel(W::MODE.index(i + di, width), W::MODE.index(j + dj, height));
    vec![
        (at(0, 0), (256 - a) * (256 - b)),
        (at(1, 0), a * (256 - b)),
        (at(0, 1), (256 - a) * b),
        (at(1, 1), a * b),
    ]
}

/// The colour by the documentation of [`Minify`] and of what stands in it, and that it is within its texels.
fn check<W: Known>(
    wrap: W,
    mipmap: Mipmap<'_, Rgba8888>,
    uv: Vec2,
    lambda: f32,
    [min, mag]: [In; 2],
    lv: Lv,
    found: Rgba8,
) {
    let last = mipmap.levels() as i128 - 1;
    let all = if lambda > 0.0 {
        // 256 λ, rounded down after a half was added, in f64: exact for λ up to 2^20.
        let rounded = |scale: f64| {
            let lambda = f64::from(lambda).min(last as f64);
            (scale * lambda + 0.5).floor() as i128
        };
        let (near, t) = match lv {
            Lv::Base => (0, 0),
            Lv::Nearest => (rounded(1.0), 0),
            Lv::Between => (rounded(256.0) / 256, rounded(256.0) % 256),
        };
        let weigh = |level: i128, weight: i128| {
            taps(wrap, mipmap.level(level as usize), uv, min).into_iter().map(move |(c, w)| (c, w * weight))
        };
        weigh(near, 256 - t).chain(weigh(near + 1, t)).filter(|tap| tap.1 > 0).collect::<Vec<_>>()
    } else {
        taps(wrap, mipmap.level(0), uv, mag).into_iter().map(|(c, w)| (c, w * 256)).collect()
    };
    for channel in 0..4 {
        let sum: i128 = all.iter().map(|(color, weight)| weight * i128::from(color[channel])).sum();
        let byte = found.to_bytes()[channel];
        assert_eq!(i128::from(byte), (sum + (1 << 23)) >> 24, "{mipmap:?} at {uv:?}, {lambda}");
        let range = all.iter().map(|tap| tap.0[channel]);
        assert!(range.clone().min() <= Some(byte) && Some(byte) <= range.max());
    }
}

fn check_all(wrap: impl Known, mipmap: Mipmap<'_, Rgba8888>, uv: Vec2, lambda: f32) {
    fn both(
        filter: impl MipFilter,
        wrap: impl Known,
        mipmap: Mipmap<'_, Rgba8888>,
        uv: Vec2,
        lambda: f32,
    ) -> Rgba8 {
        let found = mipmap.sampler(filter, wrap).sample_lod(uv, lambda);
        if let Some(mipmap) = mipmap.power_of_two() {
            assert_eq!(mipmap.sampler(filter, wrap).sample_lod(uv, lambda), found);
        }
        found
    }
    let points = Minify { min: NearestLevel(Nearest), mag: Bilinear };
    let lines = BetweenLevels(Nearest);
    let areas = Minify { min: NearestLevel(Bilinear), mag: Nearest };
    let none = Minify { min: BaseLevel(Bilinear), mag: Nearest };
    let (n, b) = (In::Nearest, In::Bilinear);
    check(wrap, mipmap, uv, lambda, [b, b], Lv::Between, both(Trilinear, wrap, mipmap, uv, lambda));
    check(wrap, mipmap, uv, lambda, [n, b], Lv::Nearest, both(points, wrap, mipmap, uv, lambda));
    check(wrap, mipmap, uv, lambda, [n, n], Lv::Between, both(lines, wrap, mipmap, uv, lambda));
    check(wrap, mipmap, uv, lambda, [b, n], Lv::Nearest, both(areas, wrap, mipmap, uv, lambda));
    check(wrap, mipmap, uv, lambda, [b, n], Lv::Base, both(none, wrap, mipmap, uv, lambda));
}

#[test]
fn the_documented_formulas() {
    let mut random = Random(80);
    for (width, height) in SIZES {
        for extreme in [true, false] {
            let texels = noise(&mut random, width, height, extreme);
            let mipmap = Mipmap::new(Rgba8888, &texels, width, height).unwrap();
            let last = mipmap.levels() as f32 - 1.0;
            let mut lambdas =
                vec![f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.0, 1e-30, -1e-30, 1e30, 64.0, -63.5];
            // Where levels and weights change, and the floats next to it.
            for half in 0..=2 * mipmap.levels() as u16 {
                let exact = f32::from(half) / 2.0;
                lambdas.extend([
                    exact.next_down(),
                    exact,
                    exact.next_up(),
                    exact - 1.0 / 512.0,
                    exact + 1.0 / 512.0,
                ]);
            }
            lambdas.extend((0..600).map(|_| (last + 1.5) * (random.bits() as f32 / 2f32.powi(32)) - 0.5));
            for lambda in lambdas {
                let uv = Vec2::new(random.near_zero(), random.near_zero());
                check_all(Repeat, mipmap, uv, lambda);
                check_all(Clamp, mipmap, uv, lambda);
                check_all(Mirror, mipmap, uv, lambda);
                let special = Vec2::new(SPECIAL[random.bits() as usize % 26], random.float());
                check_all(Repeat, mipmap, special, lambda);
            }
        }
    }
}

/// The trilinear mean in `f64`, with weights of `f64`.
fn in_real_numbers(mipmap: Mipmap<'_, Rgba8888>, uv: Vec2, lambda: f32) -> [f64; 4] {
    let level = |level: usize| {
        let level = mipmap.level(level);
        let x = f64::from(uv.x) * f64::from(level.width()) - 0.5;
        let y = f64::from(uv.y) * f64::from(level.height()) - 0.5;
        let (s, t) = (x - x.floor(), y - y.floor());
        let at = |di: i128, dj: i128| {
            let column = Mode::Repeat.index(x.floor() as i128 + di, level.width());
            let row = Mode::Repeat.index(y.floor() as i128 + dj, level.height());
            level.texel(column, level.height() - 1 - row).to_bytes().map(f64::from)
        };
        let [a, b, c, d] = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
        [0, 1, 2, 3].map(|k| (a[k] * (1.0 - s) + b[k] * s) * (1.0 - t) + (c[k] * (1.0 - s) + d[k] * s) * t)
    };
    let near = (f64::from(lambda).floor() as usize).min(mipmap.levels() - 1);
    let part = f64::from(lambda) - near as f64;
    let (near, far) = (level(near), level(near + 1));
    [0, 1, 2, 3].map(|k| near[k] * (1.0 - part) + far[k] * part)
}

/// Levels of noise of extreme bytes, which no image has.
#[test]
fn within_two_of_real_numbers() {
    let mut random = Random(81);
    let mut worst = [0.0f64; 2];
    for (width, height) in SIZES {
        let texels = noise(&mut random, width, height, true);
        let mipmap = Mipmap::new(Rgba8888, &texels, width, height).unwrap();
        let sampler = mipmap.sampler(Trilinear, Repeat);
        let last = mipmap.levels() - 1;
        for i in 0..100_000 {
            let uv = Vec2::new(random.near_zero(), random.near_zero());
            let lambda = last as f32 * (random.bits() as f32 / 2f32.powi(32));
            let lambda = if i % 2 == 0 { lambda } else { (lambda * 256.0).round() / 256.0 };
            let exact = in_real_numbers(mipmap, uv, lambda);
            for (k, byte) in sampler.sample_lod(uv, lambda).to_bytes().into_iter().enumerate() {
                worst[i % 2] = worst[i % 2].max((f64::from(byte) - exact[k]).abs());
            }
        }
    }
    println!("trilinear: at most {:.3} off, {:.3} where λ is a whole number of 256ths", worst[0], worst[1]);
    assert!((1.0..2.0).contains(&worst[0]) && (1.0..1.5).contains(&worst[1]), "{worst:?}");
}

/// Images minified as floors are, whose levels are means: at most one step, and half a step of rounding.
#[test]
fn images_within_one_step_and_rounding() {
    let mut random = Random(82);
    let mut worst = [0.0f64; 3];
    let wave = |i: u32, j: u32| {
        let [x, y] = [i, j].map(|i| f64::from(i % 64) * std::f64::consts::TAU / 64.0);
        let byte = |x: f64| (127.5 + 127.5 * x) as u8;
        [byte(x.sin()), byte((3.0 * y).cos()), byte((x + 2.0 * y).sin()), byte((5.0 * x).cos() * y.sin())]
    };
    let board = |i: u32, j: u32| [255 * ((i / 8 + j / 8) % 2) as u8; 4];
    let mut images = [noise(&mut random, 64, 64, true), noise(&mut random, 64, 64, false), Vec::new()];
    images[1][..64 * 64].iter_mut().enumerate().for_each(|(i, texel)| *texel = wave(i as u32, i as u32 / 64));
    images[2] = images[0].clone();
    let place = |i: usize| board(i as u32 % 64, i as u32 / 64);
    images[2][..64 * 64].iter_mut().enumerate().for_each(|(i, texel)| *texel = place(i));
    for (image, worst) in images.iter_mut().zip(&mut worst) {
        build(Scalars(Rgba8888), image, 64, 64).unwrap();
        let mipmap = Mipmap::new(Rgba8888, image, 64, 64).unwrap();
        let sampler = mipmap.sampler(Trilinear, Repeat);
        for _ in 0..60 {
            // A floor: rows of pixels that are the farther the higher.
            let (turn, near) = (random.near_zero(), random.bits() as f32 / 2f32.powi(33) + 0.01);
            for pixel in 0..4096u32 {
                let (x, y) = ((pixel % 64) as f32 - 31.5, (pixel / 64) as f32 + 1.0);
                let depth = near * 64.0 / y;
                let uv = Vec2::from_angle(turn).rotate(Vec2::new(x * depth / 64.0, depth));
                let lambda = (depth * 8.0).log2().clamp(0.0, 6.0);
                let exact = in_real_numbers(mipmap, uv, lambda);
                for (k, byte) in sampler.sample_lod(uv, lambda).to_bytes().into_iter().enumerate() {
                    *worst = worst.max((f64::from(byte) - exact[k]).abs());
                }
            }
        }
    }
    println!("images of noise, waves and a board: at most {worst:.3?} off");
    assert!(worst.iter().all(|worst| (0.5..=1.5).contains(worst)), "{worst:?}");
}

/// Groups of lanes whose λ are in the same level, in two, and all over, with derivatives of all kinds.
pub(crate) fn same_lanes<F: Storage, Z: Size>(
    filter: impl MipFilter,
    u: impl Wrap,
    v: impl Wrap,
    mipmap: Mipmap<'_, F, Z>,
    random: &mut Random,
) {
    let sampler = mipmap.sampler_per_axis(filter, u, v);
    for i in 0..300 {
        let base = random.bits() as f32 / 2f32.powi(32) * 9.0 - 1.0;
        let mut each = |i: usize| match i % 3 {
            0 => [random.near_zero(), random.near_zero(), base],
            1 => [random.near_zero(), random.float(), base + random.near_zero() / 4.0],
            _ => [random.float(), random.near_zero(), random.float()],
        };
        let samples: [[f32; 3]; 8] = std::array::from_fn(|_| each(i));
        let mut slope = || random.near_zero() / 16.0;
        let slopes: [[f32; 4]; 8] = std::array::from_fn(|_| [slope(), slope(), slope(), slope()]);
        for machine in Machine::all() {
            for_lanes!(machine, lanes => {
                let (found, shaped) = lanes.vectorize(
                    #[inline(always)]
                    || {
                        let lane = |k: usize| lanes.load(&lanes.each(|i| samples[i][k]));
                        let found = sampler.sample_lod_lanes(lanes, lane(0), lane(1), lane(2));
                        let slope = |k: usize| lanes.load(&lanes.each(|i| slopes[i][k]));
                        let d = Gradient { dx: [slope(0), slope(1)], dy: [slope(2), slope(3)] };
                        let shaped = sampler.sample_grad_lanes(lanes, lane(0), lane(1), d);
                        (lanes.store_words(found), lanes.store_words(shaped))
                    },
                );
                for (k, (&found, &shaped)) in found.as_ref().iter().zip(shaped.as_ref()).enumerate() {
                    let [u, v, lambda] = samples[k];
                    assert_eq!(found, sampler.sample_lod(Vec2::new(u, v), lambda).to_bits(), "{samples:?}");
                    let [du_dx, dv_dx, du_dy, dv_dy] = slopes[k];
                    let d = Gradient { dx: [du_dx, dv_dx], dy: [du_dy, dv_dy] };
                    assert_eq!(shaped, sampler.sample_grad(Vec2::new(u, v), d).to_bits(), "{samples:?} {slopes:?}");
                }
            });
        }
    }
}

#[test]
fn lanes_are_one_lane() {
    let mut random = Random(82);
    for (width, height) in SIZES {
        let texels = noise(&mut random, width, height, false);
        let mipmap = Mipmap::new(Rgba8888, &texels, width, height).unwrap();
        same_lanes(Trilinear, Repeat, Clamp, mipmap, &mut random);
        same_lanes(
            Minify { min: NearestLevel(Nearest), mag: Bilinear },
            Mirror,
            Border(Rgba8::from_bits(7)),
            mipmap,
            &mut random,
        );
        if let Some(mipmap) = mipmap.power_of_two() {
            same_lanes(Trilinear, Border(Rgba8::from_bits(0xff)), Repeat, mipmap, &mut random);
            same_lanes(Minify { min: BaseLevel(Bilinear), mag: Nearest }, Clamp, Mirror, mipmap, &mut random);
        }
    }
}

/// In fixed point the same as in `f32`, for numbers that are exact in both.
#[test]
fn integers() {
    let mut random = Random(83);
    let texels = noise(&mut random, 32, 16, false);
    let mipmap = Mipmap::new(Rgba8888, &texels, 32, 16).unwrap().power_of_two().unwrap();
    for _ in 0..100_000 {
        let mut number = |shift: u32| Q16::from_bits(random.bits().cast_signed() >> shift);
        let (u, v, lambda) = (number(13), number(13), number(12));
        let float = |q: Q16| OneFixed.store(q)[0];
        let uv = Vec2::new(float(u), float(v));
        let trilinear = mipmap.sampler(Trilinear, Repeat);
        let found = trilinear.sample_lod_lanes(OneFixed, u, v, lambda).0;
        assert_eq!(found, trilinear.sample_lod(uv, float(lambda)).to_bits(), "{u:?} {v:?} {lambda:?}");
        let nearest = mipmap.sampler(NearestLevel(Nearest), Mirror);
        let found = nearest.sample_lod_lanes(OneFixed, u, v, lambda).0;
        assert_eq!(found, nearest.sample_lod(uv, float(lambda)).to_bits());
    }
}

/// Texels of one colour have no other, whatever the bits.
pub(crate) fn constant(filter: impl MipFilter, wrap: impl Wrap, random: &mut Random) {
    for (width, height) in SIZES {
        let texels = vec![[1, 255, 0, 254]; texel_count(width, height)];
        let mipmap = Mipmap::new(Rgba8888, &texels, width, height).unwrap();
        for _ in 0..10_000 {
            let mut float = || random.float();
            let uv = Vec2::new(float(), float());
            let d = Gradient { dx: [float(), float()], dy: [float(), float()] };
            let lambda = float();
            assert_eq!(mipmap.sampler(filter, wrap).sample_lod(uv, lambda).to_bytes(), texels[0]);
            assert_eq!(mipmap.sampler(filter, wrap).sample_grad(uv, d).to_bytes(), texels[0], "{uv} {d:?}");
            if let Some(mipmap) = mipmap.power_of_two() {
                assert_eq!(
                    mipmap.sampler(filter, wrap).sample_grad(uv, d).to_bytes(),
                    texels[0],
                    "{uv} {d:?}"
                );
            }
        }
    }
}

#[test]
fn hostile() {
    let mut random = Random(84);
    constant(Trilinear, Mirror, &mut random);
    constant(BetweenLevels(Nearest), Clamp, &mut random);
}

/// Indices show what their colours show.
#[test]
fn palettes() {
    let mut random = Random(87);
    let palette: [Rgba8; 16] = std::array::from_fn(|_| Rgba8::from_bits(random.bits()));
    for (width, height) in SIZES {
        // Rows of whole bytes, in each level.
        let (mut bytes, mut colors) = (Vec::new(), Vec::new());
        for level in 0..alberti_texture::mipmap::level_count(width, height) {
            for _ in 0..(height >> level).max(1) {
                let row: Vec<u8> = (0..(width >> level).max(1)).map(|_| random.bits() as u8 & 15).collect();
                bytes.extend(row.chunks(2).map(|pair| pair[0] << 4 | pair.get(1).unwrap_or(&0)));
                colors.extend(row.iter().map(|&index| palette[usize::from(index)].to_bytes()));
            }
        }
        let indexed = Mipmap::new(Indexed4 { palette: &palette }, &bytes, width, height).unwrap();
        let plain = Mipmap::new(Rgba8888, &colors, width, height).unwrap();
        same_lanes(Trilinear, Repeat, Clamp, indexed, &mut random);
        for _ in 0..5000 {
            let (uv, lambda) = (Vec2::new(random.near_zero(), random.near_zero()), random.near_zero() * 2.0);
            let expected = plain.sampler(Trilinear, Mirror).sample_lod(uv, lambda);
            assert_eq!(indexed.sampler(Trilinear, Mirror).sample_lod(uv, lambda), expected);
        }
    }
    // A chain that was built shows its levels.
    let mut texels = vec![[9, 9, 9, 255]; texel_count(4, 4)];
    build(Rgba8888, &mut texels, 4, 4).unwrap();
    assert_eq!(
        Mipmap::new(Rgba8888, &texels, 4, 4)
            .unwrap()
            .sampler(Trilinear, Repeat)
            .sample_lod(Vec2::ZERO, 1.3)
            .to_bytes()[0],
        9
    );
}
