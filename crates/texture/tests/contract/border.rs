//! A border by its definition: texels inside, one colour outside, and both axes on their own.

use alberti_math::lanes::{Lanes, One, OneFixed};
use alberti_math::{Q16, Rgba8};
use alberti_texture::{Bilinear, Border, Clamp, Filter, Nearest, Repeat, Size, Texture, Wrap};
use glam::Vec2;

use crate::oracle::{Index, Mode, Random, SPECIAL};

const U_COLOR: u32 = 0x8040_20ff;
const V_COLOR: u32 = 0x01fe_3377;
const U: Border = Border(Rgba8::from_bits(U_COLOR));
const V: Border = Border(Rgba8::from_bits(V_COLOR));

/// floor(256 u size + 1/2) in 256ths, less than any for what is no number. In `f64`, where the product is exact; so is
/// the sum, unless it is next to 1.
fn scaled(u: f32, size: u32) -> i128 {
    let halves = if u.is_nan() { f64::NEG_INFINITY } else { f64::from(u) * f64::from(512 * size) + 1.0 };
    (halves / 2.0).floor().clamp(-1e30, 1e30) as i128
}

fn cell(u: f32, size: u32) -> Option<u32> {
    if !(0.0..1.0).contains(&u) {
        return None;
    }
    Some(Mode::Clamp.cell(u, size))
}

/// `Wrap::index` for all indices about 0 and at 2^23 either way.
#[test]
fn indices() {
    for size in (1..=40).chain([64, 1000, 16383, 16384]) {
        let far = 1 << 23;
        for i in (-40_000..40_000).chain(far - 500..far + 500).chain(-far - 500..-far + 500) {
            let expected = u32::try_from(i).ok().filter(|&i| i < size).unwrap_or(u32::MAX);
            assert_eq!(U.index(i, size), expected, "{i} of {size}");
        }
    }
    assert_eq!(U.index(3, 0), 0);
}

fn nearest<Z: Size>(texture: Texture<'_, Index, Z>, uv: Vec2) {
    let column = cell(uv.x, texture.width());
    let row = cell(uv.y, texture.height());
    let texel = |x, y| texture.texel(x, texture.height() - 1 - y).to_bits();
    let both = match (column, row) {
        (None, _) => U_COLOR,
        (_, None) => V_COLOR,
        (Some(x), Some(y)) => texel(x, y),
    };
    assert_eq!(texture.sampler_per_axis(Nearest, U, V).sample(uv).to_bits(), both, "{uv:?} {texture:?}");
    // The other axis as it ever was.
    let clamped = texel(column.unwrap_or(0), Mode::Clamp.cell(uv.y, texture.height()));
    let one = column.map_or(U_COLOR, |_| clamped);
    assert_eq!(texture.sampler_per_axis(Nearest, U, Clamp).sample(uv).to_bits(), one, "{uv:?} {texture:?}");
    // As they are stored.
    let stored = texture
        .sampler_per_axis(Nearest, U, Clamp)
        .stored_lanes(One, uv.x, uv.y, |texel| texel.map_or(99_999, u32::from));
    assert_eq!(stored.0, column.map_or(99_999, |_| clamped));
}

fn bilinear<Z: Size>(texture: Texture<'_, Index, Z>, uv: Vec2) {
    let position = |u, size| scaled(u, size) - 128;
    let (x, y) = (position(uv.x, texture.width()), position(uv.y, texture.height()));
    let color = |i: i128, j: i128| {
        let (width, height) = (i128::from(texture.width()), i128::from(texture.height()));
        let bits = match () {
            () if !(0..width).contains(&i) => U_COLOR,
            () if !(0..height).contains(&j) => V_COLOR,
            () => texture.texel(i as u32, (height - 1 - j) as u32).to_bits(),
        };
        bits.to_le_bytes()
    };
    let (i, j, a, b) = (x.div_euclid(256), y.div_euclid(256), x.rem_euclid(256), y.rem_euclid(256));
    let corners = [color(i, j), color(i + 1, j), color(i, j + 1), color(i + 1, j + 1)];
    let weights = [(256 - a) * (256 - b), a * (256 - b), (256 - a) * b, a * b];
    let expected: [u8; 4] = std::array::from_fn(|channel| {
        let sum: i128 = weights.iter().zip(corners).map(|(w, corner)| w * i128::from(corner[channel])).sum();
        ((sum + 32768) >> 16) as u8
    });
    let found = texture.sampler_per_axis(Bilinear, U, V).sample(uv);
    assert_eq!(found.to_bytes(), expected, "{uv:?} {texture:?}");
}

#[test]
fn samples() {
    let texels: Vec<u16> = (0..16384).map(|i: u16| i.wrapping_mul(40_503)).collect();
    let mut random = Random(40);
    let sizes = [(1, 1), (2, 4), (1, 16), (5, 3), (64, 32), (7, 16), (4328, 3), (1, 16384), (16384, 1)];
    for (width, height) in sizes {
        let texture = Texture::new(Index, &texels[..(width * height) as usize], width, height).unwrap();
        let check = |uv| {
            nearest(texture, uv);
            bilinear(texture, uv);
            if let Some(texture) = texture.power_of_two() {
                nearest(texture, uv);
                bilinear(texture, uv);
            }
        };
        for u in SPECIAL {
            SPECIAL.iter().for_each(|&v| check(Vec2::new(u, v)));
        }
        // Of 4328 texels, the 256ths of which 38 bits would get wrong.
        check(Vec2::new(-6.769_148_5e-6, 0.5));
        for _ in 0..20_000 {
            check(Vec2::new(random.near_zero(), random.near_zero()));
            check(Vec2::new(random.float(), random.near_zero()));
            check(Vec2::new(1.0 + random.near_zero() / width as f32, random.near_zero() / height as f32));
        }
    }
}

/// In fixed point the same, for coordinates that are exact there.
#[test]
fn integers() {
    fn check(filter: impl Filter, texture: Texture<'_, Index, alberti_texture::PowerOfTwo>) {
        let sampler = texture.sampler_per_axis(filter, U, Repeat);
        for i in -200_000..200_000 {
            let (u, v) = (Q16::from_bits(i), Q16::from_bits(i.wrapping_mul(7)));
            let found = sampler.sample_lanes(OneFixed, u, v);
            assert_eq!(found, sampler.sample_lanes(One, OneFixed.store(u)[0], OneFixed.store(v)[0]));
        }
    }
    let texels: Vec<u16> = (0..64).map(|i: u16| i.wrapping_mul(40_503)).collect();
    let texture = Texture::new(Index, &texels, 8, 8).unwrap().power_of_two().unwrap();
    check(Nearest, texture);
    check(Bilinear, texture);
}
