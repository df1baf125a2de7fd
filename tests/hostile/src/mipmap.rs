//! Mip maps of any sizes and texels, against means in `f64`; whole and in pieces.

use crate::bits::Bits;
use alberti::texture::format::{Normals, Rgba8888, Scalars, TexelFormat};
use alberti::texture::mipmap::{self, level_count, texel_count};

pub(crate) fn run(bytes: &[u8]) {
    let mut bits = Bits::new(bytes);
    let [width, height] = [(); 2].map(|()| 1 + bits.below(20) as u32);
    match bits.below(3) {
        0 => check(Rgba8888, [width, height], &mut bits, light, 0.51),
        1 => check(Scalars(Rgba8888), [width, height], &mut bits, |c| f64::from(c) / 255.0, 0.5),
        _ => {
            let base = texels([width, height], &mut bits);
            pieces(Normals(Rgba8888), &base, [width, height], &mut bits);
        }
    }
    refused(&mut bits);
}

/// The amount of light of sRGB, by IEC 61966-2-1.
fn light(byte: u8) -> f64 {
    let s = f64::from(byte) / 255.0;
    if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
}

fn texels([width, height]: [u32; 2], bits: &mut Bits<'_>) -> Vec<[u8; 4]> {
    (0..width * height).map(|_| bits.bytes()).collect()
}

/// The mean of the part of level 0 that a texel of a level covers.
fn mean(
    base: &[[u8; 4]],
    [width, height]: [u32; 2],
    [columns, rows]: [u32; 2],
    [x, y]: [u32; 2],
    of: impl Fn([u8; 4]) -> f64,
) -> f64 {
    let share = |k: u32, all: u32, of: u32, at: u32| {
        let [from, to] = [k, k + 1].map(|k| f64::from(k) * f64::from(all) / f64::from(of));
        (to.min(f64::from(at + 1)) - from.max(f64::from(at))).max(0.0)
    };
    let mut sums = [0.0; 2];
    for row in 0..height {
        for column in 0..width {
            let weight = share(x, width, columns, column) * share(y, height, rows, row);
            sums[0] += weight * of(base[(row * width + column) as usize]);
            sums[1] += weight;
        }
    }
    sums[0] / sums[1]
}

fn check<F: TexelFormat<Texel = [u8; 4]>>(
    format: F,
    size: [u32; 2],
    bits: &mut Bits<'_>,
    number: fn(u8) -> f64,
    bound: f64,
) {
    let base = texels(size, bits);
    let all = pieces(format, &base, size, bits);
    let mut rest = &all[..];
    for level in 0..level_count(size[0], size[1]) {
        let [columns, rows] = size.map(|side| (side >> level).max(1));
        let (own, below) = rest.split_at((columns * rows) as usize);
        rest = below;
        for (k, texel) in (0..).zip(own) {
            let place = [k % columns, k / columns];
            for (channel, &found) in texel.iter().enumerate() {
                let number = |byte: u8| if channel == 3 { f64::from(byte) / 255.0 } else { number(byte) };
                let exact = mean(&base, size, [columns, rows], place, |texel| number(texel[channel]));
                // The byte whose number is nearest, in bytes: between its neighbours at the bound.
                let [below, above] = [found.saturating_sub(1), found.saturating_add(1)].map(number);
                let own = number(found);
                let [low, high] = [own - (own - below) * bound, own + (above - own) * bound];
                let slack = 1.2e-5;
                let sound = (found == 0 || exact >= low - slack) && (found == 255 || exact <= high + slack);
                assert!(sound, "{found} for {exact} at {place:?} of level {level}, {size:?}");
            }
        }
    }
    assert!(rest.is_empty());
}

/// All levels: those of the whole are those of pieces in any order.
fn pieces<F: TexelFormat<Texel = [u8; 4]>>(
    format: F,
    base: &[[u8; 4]],
    [width, height]: [u32; 2],
    bits: &mut Bits<'_>,
) -> Vec<[u8; 4]> {
    let mut all = base.to_vec();
    all.resize(texel_count(width, height), [0; 4]);
    let mut parts = all.clone();
    mipmap::build(format, &mut all, width, height).expect("room for all levels");
    let mut pieces: Vec<_> = mipmap::pieces(format, &mut parts, width, height).expect("room").collect();
    for _ in 0..bits.below(8) {
        let at = bits.below(pieces.len().max(1));
        let lower = pieces.get_mut(at).and_then(|piece| piece.split());
        pieces.extend(lower);
    }
    pieces.into_iter().rev().for_each(mipmap::Piece::build);
    assert_eq!(parts, all, "pieces make other levels of {width}x{height}");
    all
}

/// Sizes that do not fit.
fn refused(bits: &mut Bits<'_>) {
    let [width, height] = [(); 2].map(|()| bits.word() >> bits.below(32));
    let mut few = [[0; 4]; 8];
    let fits =
        width > 0 && height > 0 && width <= 16384 && height <= 16384 && texel_count(width, height) == 8;
    assert_eq!(mipmap::build(Rgba8888, &mut few, width, height).is_ok(), fits, "{width}x{height}");
}
