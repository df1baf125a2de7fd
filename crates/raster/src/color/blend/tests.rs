//! Blends against their definitions in integers and in reals.
#![expect(clippy::cast_possible_truncation, reason = "bytes")]

use super::*;
use crate::color::{Grey1, Grey2, Grey4, Grey8, Indexed, Rgb332, Rgb444, Rgb666, Rgb888, Xrgb8888};
use alberti_math::lanes::One;
use alberti_math::{Rgb565Be, Rgb565Le, Rgba565, Rgba8888};

/// The nearest integer to a/b.
fn nearest(a: u64, b: u64) -> u64 {
    (2 * a + b) / (2 * b)
}

/// A blend's definition: a channel and alpha of 255ths, from new, old, and both alphas.
type Definition = fn(u64, u64, [u64; 2]) -> [u64; 2];

/// All alphas with channels all over the range.
fn is(blend: impl Blend, definition: Definition) {
    for alpha in 0..=255_u8 {
        for k in 0..256_u32 {
            let new = Rgba8::new((k * 7) as u8, (k * 31 + 90) as u8, k as u8, alpha);
            let old =
                Rgba8::new((k * 13 + u32::from(alpha)) as u8, 255 - k as u8, (k * 3) as u8, (k * 5) as u8);
            let mixed = blend.mix(One, One.word(new.to_bits()), One.word(old.to_bits()));
            let found = Rgba8::from_bits(One.store_words(mixed)[0]).to_bytes();
            let ([.., a], [.., b]) = (new.to_bytes(), old.to_bytes());
            for (channel, found) in found.into_iter().enumerate().take(3) {
                let [n, o] = [new, old].map(|color| u64::from(color.to_bytes()[channel]));
                let [expected, expected_alpha] = definition(n, o, [a.into(), b.into()]);
                assert_eq!(u64::from(found), expected, "{blend:?} {new:?} {old:?}");
                let of_channel = blend.channel(n as u32, o as u32, a.into(), 255);
                assert_eq!(u64::from(of_channel), expected, "{blend:?} {new:?} {old:?}");
                assert_eq!(u64::from(blend.alpha(a.into(), b.into())), expected_alpha, "{blend:?} {a} {b}");
            }
            let [_, expected] = definition(0, 0, [a.into(), b.into()]);
            assert_eq!(u64::from(found[3]), expected, "{blend:?} {new:?} {old:?}");
        }
    }
}

fn over(n: u64, o: u64, [a, b]: [u64; 2]) -> [u64; 2] {
    [nearest(n * a + o * (255 - a), 255), nearest(255 * a + b * (255 - a), 255)]
}

#[test]
fn parts_of_255_are_nearest() {
    assert!((0..=65535 * 255).all(|x| of_255(x) == (2 * x + 255) / 510));
}

#[test]
fn blends_are_their_definitions() {
    is(Over, over);
    is(Constant(77), |n, o, [_, b]| over(n, o, [77, b]));
    is(Premultiplied, |n, o, [a, b]| {
        [(n + nearest(o * (255 - a), 255)).min(255), a + nearest(b * (255 - a), 255)]
    });
    is(Additive, |n, o, [a, b]| [(nearest(n * a, 255) + o).min(255), b]);
    is(Multiply, |n, o, [_, b]| [nearest(n * o, 255), b]);
    is(AnyBlend::Replace, |n, _, [a, _]| [n, a]);
    is(AnyBlend::Over, over);
    is(AnyBlend::Constant(77), |n, o, [_, b]| over(n, o, [77, b]));
    is(AnyBlend::Additive, |n, o, [a, b]| [(nearest(n * a, 255) + o).min(255), b]);
}

/// Light by the formula of sRGB, in reals.
fn light(byte: u8) -> f64 {
    let s = f64::from(byte) / 255.0;
    if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
}

#[test]
fn in_light_half_and_half_is_half_the_light() {
    for (n, o) in (0..=255_u8).step_by(3).flat_map(|n| (0..=255_u8).step_by(5).map(move |o| (n, o))) {
        let word = |byte| One.word(Rgba8::new(byte, byte, byte, 128).to_bits());
        let mixed = One.store_words(InLight(Over).mix(One, word(n), word(o)))[0].to_le_bytes()[0];
        let share = 128.0 / 255.0;
        let expected = light(n) * share + light(o) * (1.0 - share);
        // The byte whose light is nearest, but for two roundings to 65535ths.
        let apart = |byte: u8| (light(byte) - expected).abs();
        for other in [mixed.saturating_sub(1), mixed.saturating_add(1)] {
            assert!(apart(mixed) <= apart(other) * 1.1 + 2.0 / 65535.0, "{n} {o}: {mixed}");
        }
    }
}

/// A blend of channels in reals, from 0 to 255: of new, old, and the new one's alpha from 0 to 1.
type Real = fn(f64, f64, f64) -> f64;

const REALS: [(AnyBlend, Real); 5] = [
    (AnyBlend::Over, |n, o, a| n * a + o * (1.0 - a)),
    (AnyBlend::Constant(77), |n, o, _| (n * 77.0 + o * 178.0) / 255.0),
    (AnyBlend::Premultiplied, |n, o, a| (n + o * (1.0 - a)).min(255.0)),
    (AnyBlend::Additive, |n, o, a| (n * a + o).min(255.0)),
    (AnyBlend::Multiply, |n, o, _| n * o / 255.0),
];

/// The colours shown after each blend, against those of what was shown before; `off` is 1 for the most allowed.
fn in_format<F: ReadColor>(format: F, off: impl Fn([f64; 3], [f64; 3]) -> f64) {
    for (by, real) in REALS {
        for k in 0..3000_u32 {
            let bytes = [k, k + 5000].map(|k| k.wrapping_mul(0x9e37_79b1).to_le_bytes());
            let [new, before] = bytes.map(|[r, g, b, a]| Rgba8::new(r, g, b, a));
            let mut pixel = [format.pixel(before)];
            let [[n @ .., alpha], [o @ .., _]] =
                [new, format.color(pixel[0])].map(|color| color.to_bytes().map(f64::from));
            let exact = [0, 1, 2].map(|c| real(n[c], o[c], alpha / 255.0));
            Blended { format, by }.store::<One, Rgba8>(
                One,
                One.word(new.to_bits()),
                true,
                [0; 2],
                &mut pixel,
            );
            let [found @ .., _] = format.color(pixel[0]).to_bytes().map(f64::from);
            assert!(off(found, exact) <= 1.0, "{format:?} {by:?} {new:?} {o:?}: {found:?} {exact:?}");
        }
    }
}

/// Of formats with so many steps: half a step, and half a byte of the mean and of what is shown.
fn steps(greatest: [u32; 3]) -> impl Fn([f64; 3], [f64; 3]) -> f64 {
    move |found, exact| {
        let off = |c: usize| (found[c] - exact[c]).abs() / (127.5 / f64::from(greatest[c]) + 1.0);
        off(0).max(off(1)).max(off(2))
    }
}

/// Of greys, whose weights are 256ths: two bytes more.
fn greys(greatest: u32) -> impl Fn([f64; 3], [f64; 3]) -> f64 {
    move |[found, ..], [r, g, b]| {
        (found - (0.299 * r + 0.587 * g + 0.114 * b)).abs() / (127.5 / f64::from(greatest) + 3.0)
    }
}

#[test]
fn blends_in_every_format_are_of_what_is_shown() {
    in_format(Rgba8888, steps([255; 3]));
    in_format(Rgb444, steps([15; 3]));
    in_format(Rgb666, steps([63; 3]));
    in_format(Rgb888, steps([255; 3]));
    in_format(Xrgb8888, steps([255; 3]));
    in_format(Rgb332, steps([7, 7, 3]));
    in_format(Grey8, greys(255));
    in_format(Grey4, greys(15));
    in_format(Grey2, greys(3));
    in_format(Grey1, greys(1));
    static PALETTE: [Rgba8; 5] = [
        Rgba8::BLACK,
        Rgba8::WHITE,
        Rgba8::new(200, 30, 20, 255),
        Rgba8::new(9, 90, 240, 255),
        Rgba8::new(99, 99, 90, 255),
    ];
    in_format(Indexed(&PALETTE), |found, exact| {
        let apart = |[r, g, b]: [f64; 3]| {
            ((r - exact[0]).powi(2) + (g - exact[1]).powi(2) + (b - exact[2]).powi(2)).sqrt()
        };
        let all = PALETTE.map(|color| apart([0, 1, 2].map(|c| f64::from(color.to_bytes()[c]))));
        // The mean's rounding moves it by less than 1.
        apart(found) - all.into_iter().fold(f64::INFINITY, f64::min)
    });
}

/// Colours that are ready to be drawn over RGB565, and what is shown after that.
fn ready<F: ReadColor<Pixel: PartialEq>>(format: F, off: impl Fn([f64; 3], [f64; 3]) -> f64) {
    for k in 0..3000_u32 {
        let bytes = [k, k + 5000].map(|k| k.wrapping_mul(0x9e37_79b1).to_le_bytes());
        let [word, before] = bytes.map(|[r, g, b, a]| Rgba8::new(r, g, b, a));
        let word = Rgba565::new(word);
        let before = [format.pixel(before)];
        let [[n @ .., alpha], [o @ .., _]] =
            [word.to_rgba8(), format.color(before[0])].map(|color| color.to_bytes().map(f64::from));
        let after = |by: AnyBlend, mask| {
            let mut pixel = before;
            let word = One.word(word.to_bits());
            Blended { format, by }.store::<One, Rgba565>(One, word, mask, [0; 2], &mut pixel);
            pixel
        };
        let mut pixel = before;
        let bits = One.word(word.to_bits());
        Blended { format, by: Over }.store::<One, Rgba565>(One, bits, true, [0; 2], &mut pixel);
        assert!(pixel == after(AnyBlend::Over, true) && before == after(AnyBlend::Over, false));
        let [found @ .., _] = format.color(pixel[0]).to_bytes().map(f64::from);
        let a = alpha / 255.0;
        let exact = [0, 1, 2].map(|c| n[c] * a + o[c] * (1.0 - a));
        assert!(off(found, exact) <= 1.0, "{format:?} {word:?} {o:?}: {found:?} {exact:?}");
        // Other blends have its colour.
        let [found @ .., _] = format.color(after(AnyBlend::Multiply, true)[0]).to_bytes().map(f64::from);
        let exact = [0, 1, 2].map(|c| n[c] * o[c] / 255.0);
        assert!(off(found, exact) <= 1.0, "{format:?} {word:?} {o:?}: {found:?} {exact:?}");
    }
}

#[test]
fn colors_are_drawn_over_any_format_as_they_are() {
    // 1.5 levels, green 2, and half a byte of what is shown.
    let within = |found: [f64; 3], exact: [f64; 3]| {
        let off = |c: usize, most: f64| (found[c] - exact[c]).abs() / (most + 0.5);
        off(0, 1.5 * 255.0 / 31.0).max(off(1, 2.0 * 255.0 / 63.0)).max(off(2, 1.5 * 255.0 / 31.0))
    };
    ready(Rgb565Le, within);
    ready(Rgb565Be, within);
    ready(Rgba8888, steps([255; 3]));
    ready(Rgb444, steps([15; 3]));
    ready(Rgb332, steps([7, 7, 3]));
    ready(Grey8, greys(255));
}
