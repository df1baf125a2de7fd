//! Blends against their definitions in integers and in reals.
#![expect(clippy::cast_possible_truncation, reason = "bytes")]

use super::*;
use alberti_math::lanes::One;

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
