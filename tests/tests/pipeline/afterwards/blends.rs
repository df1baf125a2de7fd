//! Blends and dithers, whose colours are those of texels and of the background, to the bit.

use super::{GREATEST, PIXELS, bare, bayer, each, levels, sampler, texels};
use alberti::shaders::Unlit;
use alberti::texture::format;
use alberti::{Rgb565Be, Rgba8888};
use alberti_raster::color::{AnyBlend, Bayer, Blended, BlueNoise, Dithered, InLight};

/// A background of every byte.
fn bytes_before(k: usize) -> [u8; 4] {
    [(k * 5) as u8, (k / 3) as u8, (k * k) as u8, (k * 11) as u8]
}

/// A background of every word.
fn word_before(k: usize) -> u16 {
    (k as u16).wrapping_mul(40_503)
}

type Channels = [f64; 4];
/// A blend of parts from 0 to 1.
type Formula = fn(Channels, Channels) -> Channels;

fn parts(bytes: [u8; 4]) -> Channels {
    bytes.map(|byte| f64::from(byte) / 255.0)
}

fn by_alpha(new: Channels, old: Channels, a: f64) -> Channels {
    let mixed = |k: usize| new[k] * a + old[k] * (1.0 - a);
    [mixed(0), mixed(1), mixed(2), a + old[3] * (1.0 - a)]
}

const BLENDS: [(AnyBlend, Formula); 6] = [
    (AnyBlend::Replace, |n, _| n),
    (AnyBlend::Over, |n, o| by_alpha(n, o, n[3])),
    (AnyBlend::Constant(51), |n, o| by_alpha(n, o, 0.2)),
    (AnyBlend::Premultiplied, |n, o| [0, 1, 2, 3].map(|k| (n[k] + o[k] * (1.0 - n[3])).min(1.0))),
    (AnyBlend::Additive, |n, o| {
        let sum = |k: usize| (n[k] * n[3] + o[k]).min(1.0);
        [sum(0), sum(1), sum(2), o[3]]
    }),
    (AnyBlend::Multiply, |n, o| [n[0] * o[0], n[1] * o[1], n[2] * o[2], o[3]]),
];

#[test]
fn blends_are_correctly_rounded_in_bytes() {
    let texels = texels();
    let stage = Unlit(sampler(format::Rgba8888, &texels));
    for (by, formula) in BLENDS {
        let blended = Blended { format: Rgba8888, by };
        each(
            blended,
            |k| u32::from_ne_bytes(bytes_before(k)),
            bare,
            stage,
            |place, found| {
                let Some(texel) = place.texel(&texels) else { return false };
                let right = formula(parts(texel), parts(bytes_before(place.k)));
                for (found, right) in found.to_ne_bytes().into_iter().zip(right) {
                    assert!((f64::from(found) - 255.0 * right).abs() <= 0.5 + 1e-9, "{by:?} {place:?}");
                }
                true
            },
        );
    }
}

/// Light by the formula of sRGB, and back.
fn light(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

fn encoded(c: f64) -> f64 {
    if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

#[test]
fn blends_in_light_are_of_light() {
    let texels = texels();
    let stage = Unlit(sampler(format::Rgba8888, &texels));
    for (by, formula) in BLENDS {
        let blended = Blended { format: Rgba8888, by: InLight(by) };
        each(
            blended,
            |k| u32::from_ne_bytes(bytes_before(k)),
            bare,
            stage,
            |place, found| {
                let Some(texel) = place.texel(&texels) else { return false };
                let lights = |bytes| {
                    let [r, g, b, a] = parts(bytes);
                    [light(r), light(g), light(b), a]
                };
                let [r, g, b, a] = formula(lights(texel), lights(bytes_before(place.k)));
                let right = [encoded(r), encoded(g), encoded(b), a];
                for (found, right) in found.to_ne_bytes().into_iter().zip(right) {
                    // Of light in 65535ths, at which black has 20 to a byte.
                    assert!((f64::from(found) - 255.0 * right).abs() <= 0.58, "{by:?} {place:?}");
                }
                true
            },
        );
    }
}

#[test]
fn means_in_rgb565_are_as_near_as_they_say() {
    let texels = texels();
    let stage = Unlit(sampler(format::Rgba8888, &texels));
    let mut worst = [0.0_f64; 3];
    for (by, formula) in BLENDS {
        let blended = Blended { format: Rgb565Be, by };
        each(
            blended,
            |k| word_before(k).to_be(),
            bare,
            stage,
            |place, found| {
                let Some(texel) = place.texel(&texels) else { return false };
                let old = levels(word_before(place.k));
                let mean = matches!(by, AnyBlend::Over | AnyBlend::Constant(_));
                let old: Channels = std::array::from_fn(|c| match (c, mean) {
                    (3, _) => 1.0,
                    (c, true) => old[c] / GREATEST[c],
                    // By way of bytes.
                    (c, false) => (old[c] / GREATEST[c] * 255.0).round() / 255.0,
                });
                let right = formula(parts(texel), old);
                for (c, found) in levels(u16::from_be(found)).into_iter().enumerate() {
                    if mean {
                        let off = (found - right[c] * GREATEST[c]).abs();
                        worst[c] = worst[c].max(off);
                        assert!(off <= [1.5, 2.0, 1.5][c], "{by:?} {place:?}: {off}");
                    } else {
                        let byte = (right[c] * 255.0).round();
                        assert_eq!(found, (byte * GREATEST[c] / 255.0).round(), "{by:?} {place:?}");
                    }
                }
                true
            },
        );
    }
    assert!(worst.iter().all(|worst| *worst > 0.7), "{worst:?}");
}

#[test]
fn dithers_are_levels_above_thresholds() {
    let texels = texels();
    let stage = Unlit(sampler(format::Rgba8888, &texels));
    let level = |byte: u8, c: usize, more: f64| (f64::from(byte) * GREATEST[c] / 255.0 + more).floor();
    let by_order = Dithered { format: Rgb565Be, by: Bayer };
    each(
        by_order,
        |_| 0,
        bare,
        stage,
        |place, found| {
            let Some(texel) = place.texel(&texels) else { return false };
            let [column, row] = place.of_frame();
            let threshold = (bayer([column % 8, row % 8]) as f64 + 0.5) / 64.0;
            for (c, found) in levels(u16::from_be(found)).into_iter().enumerate() {
                assert_eq!(found, level(texel[c], c, threshold), "{place:?}");
            }
            true
        },
    );
    let mut sum = 0.0;
    let by_noise = Dithered { format: Rgb565Be, by: BlueNoise };
    each(
        by_noise,
        |_| 0,
        bare,
        stage,
        |place, found| {
            let Some(texel) = place.texel(&texels) else { return false };
            for (c, found) in levels(u16::from_be(found)).into_iter().enumerate() {
                assert!([0.0, 1.0 - 1e-9].map(|more| level(texel[c], c, more)).contains(&found), "{place:?}");
                sum += found - f64::from(texel[c]) * GREATEST[c] / 255.0;
            }
            true
        },
    );
    // Of each channel of each pixel, by either way.
    assert!((sum / (6 * PIXELS) as f64).abs() < 0.02, "{sum}");
}
