//! Mip chains against boxes in real numbers and in rationals.

use alberti_math::Rgba8;
use alberti_texture::format::{
    Indexed1, L8, L16, La8, Normals, Rgb8, Rgb565, Rgb565Be, Rgb565Le, Rgba4444, Rgba8888, Scalars,
};
use alberti_texture::mipmap::{self, level_count, preserve_coverage, texel_count};
use alberti_texture::{Mipmap, TexelFormat, TextureError};

use crate::oracle::Random;

const SIZES: [(u32, u32); 13] = [
    (1, 1),
    (2, 2),
    (3, 1),
    (5, 3),
    (1, 19),
    (7, 7),
    (64, 64),
    (32, 4),
    (100, 37),
    (31, 33),
    (127, 2),
    (255, 64),
    (3, 333),
];

/// A built chain: all texels, and the levels.
fn built<F: TexelFormat>(format: F, base: &[F::Texel], width: u32, height: u32) -> Vec<F::Texel> {
    let mut texels = vec![base[0]; texel_count(width, height)];
    texels[..base.len()].copy_from_slice(base);
    mipmap::build(format, &mut texels, width, height).unwrap();
    texels
}

/// Pieces fill the levels in any order, whole, in halves and in halves of these: as all at once.
#[test]
fn pieces_are_levels() {
    let mut random = Random(7);
    let mut most = 0;
    for (width, height) in SIZES.into_iter().chain([(60, 44), (16, 1), (256, 128), (1, 16384)]) {
        let base: Vec<[u8; 4]> = (0..width * height).map(|_| random.bits().to_le_bytes()).collect();
        let whole = built(Rgba8888, &base, width, height);
        for halvings in 0..4 {
            let mut texels = vec![[0; 4]; whole.len()];
            texels[..base.len()].copy_from_slice(&base);
            let mut pieces: Vec<_> = mipmap::pieces(Rgba8888, &mut texels, width, height).unwrap().collect();
            for _ in 0..halvings {
                let lower: Vec<_> = pieces.iter_mut().filter_map(mipmap::Piece::split).collect();
                pieces.extend(lower);
            }
            most = most.max(pieces.len());
            pieces.into_iter().rev().for_each(mipmap::Piece::build);
            assert_eq!(texels, whole, "{width} x {height}, {halvings}");
        }
    }
    assert!(most > 8, "{most}");
    assert!(mipmap::pieces(Rgba8888, &mut [[0; 4]; 4], 2, 2).is_err());
    assert!(mipmap::pieces(Rgba8888, &mut [], 0, 2).is_err());
}

/// Each texel of each smaller level, and the mean over its rectangle in real numbers, by what `value` makes of texels.
fn for_each_mean<T: Copy, const N: usize>(
    texels: &[T],
    [width, height]: [u32; 2],
    value: impl Fn(T) -> [f64; N],
    mut f: impl FnMut(T, [f64; N]),
) {
    let (mut x_size, mut y_size) = (width, height);
    let mut rest = &texels[(width * height) as usize..];
    while x_size > 1 || y_size > 1 {
        (x_size, y_size) = ((x_size / 2).max(1), (y_size / 2).max(1));
        for y in 0..y_size {
            for x in 0..x_size {
                let overlap = |i: u32, place: u32, places: u32, all: u32| {
                    let scale = f64::from(all) / f64::from(places);
                    let (begin, end) = (f64::from(place) * scale, f64::from(place + 1) * scale);
                    ((f64::from(i) + 1.0).min(end) - f64::from(i).max(begin)).max(0.0) / scale
                };
                let mut mean = [0.0; N];
                for j in 0..height {
                    let down = overlap(j, y, y_size, height);
                    for i in (0..width).filter(|_| down > 0.0) {
                        let weight = down * overlap(i, x, x_size, width);
                        let values = value(texels[(j * width + i) as usize]);
                        mean.iter_mut().zip(values).for_each(|(mean, v)| *mean += weight * v);
                    }
                }
                let (&texel, behind) = rest.split_first().unwrap();
                f(texel, mean);
                rest = behind;
            }
        }
    }
    assert!(rest.is_empty());
}

fn noise(random: &mut Random, extreme: bool) -> [u8; 4] {
    random.bits().to_le_bytes().map(|byte| if extreme { 255 * (byte & 1) } else { byte })
}

fn light(byte: u8) -> f64 {
    let s = f64::from(byte) / 255.0;
    if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
}

/// 0 to 255, not rounded.
fn steps(light: f64) -> f64 {
    255.0 * if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

#[test]
fn srgb_is_the_mean_of_light() {
    let mut random = Random(60);
    let mut worst = 0.0f64;
    for (width, height) in SIZES {
        for kind in 0..3 {
            let texel = |random: &mut Random| match kind {
                // Dark colours, whose bytes are steps of light in proportion.
                2 => noise(random, false).map(|byte| byte / 16),
                kind => noise(random, kind == 1),
            };
            let base: Vec<[u8; 4]> = (0..width * height).map(|_| texel(&mut random)).collect();
            let texels = built(Rgba8888, &base, width, height);
            let value = |[r, g, b, a]: [u8; 4]| [light(r), light(g), light(b), f64::from(a)];
            for_each_mean(&texels, [width, height], value, |found, [r, g, b, a]| {
                for (found, exact) in found.into_iter().zip([steps(r), steps(g), steps(b), a]) {
                    worst = worst.max((f64::from(found) - exact).abs());
                }
            });
        }
    }
    println!("sRGB mip chain: at most {worst:.4} of a step from the mean of light");
    assert!((0.499..=0.55).contains(&worst), "{worst}");
}

#[test]
fn linear_is_the_rounded_mean() {
    let mut random = Random(61);
    let mut worst = [0.0f64; 2];
    for (width, height) in SIZES {
        let base: Vec<[u8; 2]> =
            (0..width * height).map(|_| random.bits() as u16).map(u16::to_le_bytes).collect();
        let texels = built(Scalars(La8), &base, width, height);
        for_each_mean(
            &texels,
            [width, height],
            |t| t.map(f64::from),
            |found, exact| {
                for (found, exact) in found.into_iter().zip(exact) {
                    worst[0] = worst[0].max((f64::from(found) - exact).abs());
                }
            },
        );
        let base: Vec<u16> = (0..width * height).map(|_| random.bits() as u16).collect();
        let texels = built(L16, &base, width, height);
        assert_eq!(built(Scalars(L16), &base, width, height), texels, "all bits, wrapped or not");
        for_each_mean(
            &texels,
            [width, height],
            |t| [f64::from(t)],
            |found, [exact]| {
                worst[1] = worst[1].max((f64::from(found) - exact).abs());
            },
        );
    }
    println!("linear mip chain: at most {worst:?} of a step from the mean");
    assert!(worst.iter().all(|worst| (0.499..0.500_000_1).contains(worst)), "{worst:?}");
}

#[test]
fn normals_are_unit_vectors() {
    let mut random = Random(62);
    let mut worst = 0.0f64;
    for (width, height) in SIZES {
        for steep in [1, 8] {
            // About (0, 0, 1), and any.
            let component = |byte: u8, z: bool| if z || steep == 1 { byte } else { 112 + byte / steep };
            let texel = |random: &mut Random| {
                let [x, y, z, a] = noise(random, false);
                [component(x, false), component(y, false), component(z, true), a]
            };
            let base: Vec<[u8; 4]> = (0..width * height).map(|_| texel(&mut random)).collect();
            let texels = built(Normals(Rgba8888), &base, width, height);
            let value = |[x, y, z, _]: [u8; 4]| [x, y, z].map(|c| f64::from(c) / 127.5 - 1.0);
            for_each_mean(&texels, [width, height], value, |[x, y, z, _], mean| {
                let length = mean.iter().map(|c| c * c).sum::<f64>().sqrt();
                for (found, c) in [x, y, z].into_iter().zip(mean) {
                    worst = worst.max((f64::from(found) - 127.5 * (1.0 + c / length)).abs());
                }
            });
        }
    }
    println!("normals: at most {worst:.6} of a step from the unit vector");
    assert!((0.499..=0.501).contains(&worst), "{worst}");
    // What cancels out, and an axis.
    let opposite = built(Normals(Rgba8888), &[[255, 0, 255, 9], [0, 255, 0, 10]], 2, 1);
    assert_eq!(opposite[2], [128, 128, 255, 10]);
    let axis = built(Normals(Rgba8888), &[[255, 0, 99, 0], [255, 255, 156, 0]], 2, 1);
    assert_eq!(axis[2], [255, 128, 128, 0]);
}

fn constant<F: TexelFormat>(format: F, texel: F::Texel)
where
    F::Texel: PartialEq + std::fmt::Debug,
{
    for (width, height) in SIZES {
        let base = vec![texel; (width * height) as usize];
        assert!(built(format, &base, width, height).iter().all(|&found| found == texel), "{texel:?}");
    }
}

#[test]
fn constants_stay() {
    for byte in (0..=255u8).step_by(5) {
        let word = u16::from_le_bytes([byte, byte ^ 91]);
        constant(L8, byte);
        constant(Scalars(L8), byte);
        constant(La8, [byte, !byte]);
        constant(Rgb8, [byte, !byte, 7]);
        constant(Rgb565, word);
        constant(Scalars(Rgb565), word);
        constant(Rgb565Be, word);
        constant(Rgb565Le, word);
        constant(Rgba4444, word);
        constant(Scalars(Rgba4444), word);
        constant(L16, word);
    }
}

/// As many pass as of level 0, in proportion, or as near as any scale of alpha comes: all that may come out are the
/// counts of the alphas from some value on.
#[test]
fn coverage_is_preserved() {
    let mut random = Random(63);
    let (mut kept, mut lost) = (0.0, 0.0);
    for (width, height) in SIZES {
        for threshold in [1, 100, 128, 255] {
            let base: Vec<[u8; 2]> = (0..width * height)
                .map(|_| [7, if random.bits().is_multiple_of(4) { 255 } else { 0 }])
                .collect();
            let before = built(Scalars(La8), &base, width, height);
            let mut after = before.clone();
            preserve_coverage(Scalars(La8), &mut after, width, height, threshold);
            assert_eq!(after[..base.len()], base);
            let passes =
                |texels: &[[u8; 2]], from: u32| texels.iter().filter(|t| u32::from(t[1]) >= from).count();
            let wanted = passes(&base, threshold.into()) as f64 / base.len() as f64;
            let mut begin = base.len();
            for level in 1..level_count(width, height) {
                let count = ((width >> level).max(1) * (height >> level).max(1)) as usize;
                let (old, new) = (&before[begin..][..count], &after[begin..][..count]);
                let error = |passed: usize| (passed as f64 / count as f64 - wanted).abs();
                let best = (1..=256).map(|from| error(passes(old, from))).fold(1.0, f64::min);
                let found = error(passes(new, threshold.into()));
                assert!(found <= best + 1e-12, "{width} x {height}, level {level}: {found}, {best}");
                // Alphas keep their order.
                for (a, b) in
                    old.iter().zip(new).flat_map(|a| old.iter().zip(new).map(move |b| (a, b))).take(5000)
                {
                    assert!(a.0[1] > b.0[1] || a.1[1] <= b.1[1]);
                }
                kept += found;
                lost += error(passes(old, threshold.into()));
                begin += count;
            }
        }
    }
    // All pass from 0 on, whatever the alpha.
    let mut texels = built(Scalars(La8), &[[0, 7], [0, 9]], 2, 1);
    preserve_coverage(Scalars(La8), &mut texels, 2, 1, 0);
    assert_eq!(texels, [[0, 7], [0, 9], [0, 8]]);
    println!("coverage: off by {kept:.2} in all, {lost:.2} if nothing is done");
    assert!(kept < lost / 2.0);
}

#[test]
fn chains_are_checked() {
    for (width, height) in SIZES.into_iter().chain([(16384, 16384), (16384, 1), (0, 0)]) {
        let (mut x, mut y, mut count, mut levels) = (width, height, 0, 0);
        while x > 0 && y > 0 {
            count += (x * y) as usize;
            levels += 1;
            (x, y) = if (x, y) == (1, 1) { (0, 0) } else { ((x / 2).max(1), (y / 2).max(1)) };
        }
        assert_eq!((level_count(width, height), texel_count(width, height)), (levels, count));
    }
    let build = |count, width, height| mipmap::build(L8, &mut vec![0; count], width, height);
    assert_eq!(build(5, 2, 2), Ok(()));
    assert_eq!(build(4, 2, 2), Err(TextureError::Length { found: 4, expected: 5 }));
    assert_eq!(build(6, 2, 2), Err(TextureError::Length { found: 6, expected: 5 }));
    assert_eq!(build(3, 2, 2), Err(TextureError::Length { found: 3, expected: 4 }));
    assert_eq!(build(0, 0, 2), Err(TextureError::ZeroSize { width: 0, height: 2 }));
    assert_eq!(build(9, 1, 65536), Err(TextureError::TooLarge { width: 1, height: 65536 }));
    assert_eq!(build(0, 65536, 65536), Err(TextureError::TooLarge { width: 65536, height: 65536 }));

    let texels: Vec<u8> = (0..8).collect();
    let sizes = |count: usize| {
        let mipmap = Mipmap::new(L8, &texels[..count], 5, 1).map_err(|error| format!("{error:?}"))?;
        let levels = (0..mipmap.levels()).map(|level| mipmap.level(level));
        Ok::<_, String>(levels.map(|level| level.texels()).collect::<Vec<_>>())
    };
    assert_eq!(sizes(8).unwrap(), [&[0, 1, 2, 3, 4][..], &[5, 6], &[7]]);
    assert_eq!(sizes(7).unwrap(), [&[0, 1, 2, 3, 4][..], &[5, 6]]);
    assert_eq!(sizes(5).unwrap(), [[0, 1, 2, 3, 4]]);
    assert_eq!(sizes(0).unwrap_err(), "Length { found: 0, expected: 5 }");
    assert_eq!(sizes(4).unwrap_err(), "Length { found: 4, expected: 5 }");
    assert_eq!(sizes(6).unwrap_err(), "Length { found: 6, expected: 7 }");
    let error = |count, width, height| Mipmap::new(L8, &texels[..count], width, height).unwrap_err();
    assert_eq!(error(8, 3, 1), TextureError::Length { found: 8, expected: 4 });
    assert_eq!(error(8, 0, 1), TextureError::ZeroSize { width: 0, height: 1 });
    assert_eq!(error(8, 1, u32::MAX), TextureError::TooLarge { width: 1, height: u32::MAX });

    let mipmap = Mipmap::new(L8, &texels, 5, 1).unwrap();
    assert!(mipmap.power_of_two().is_none());
    assert_eq!(mipmap.level(usize::MAX).texels(), [7]);
    let mipmap = Mipmap::new(L8, &texels[..7], 4, 1).unwrap().power_of_two().unwrap();
    assert_eq!((mipmap.levels(), mipmap.level(1).texels(), mipmap.level(2).width()), (3, &[4, 5][..], 1));

    // Rows of a byte each: two of level 0, one each of level 1 and of level 2.
    let palette = [Rgba8::BLACK, Rgba8::WHITE];
    let mipmap =
        Mipmap::new(Indexed1 { palette: &palette }, &[0, 0, 0b0100_0000, 0b1000_0000], 4, 2).unwrap();
    assert_eq!(mipmap.levels(), 3);
    assert_eq!([mipmap.level(1).texel(0, 0), mipmap.level(1).texel(1, 0)], palette);
    assert_eq!(mipmap.level(2).texel(0, 0), Rgba8::WHITE);
}
