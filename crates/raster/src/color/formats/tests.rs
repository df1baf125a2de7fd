//! Formats against levels in reals, and the bytes of displays.
#![expect(clippy::cast_possible_truncation, reason = "bytes")]

use super::rgb565::levels565;
use super::*;
use crate::color::{Blended, Constant};
use alberti_math::lanes::One;
use alberti_math::{Rgb565Be, Rgb565Le};

#[test]
fn every_byte_goes_to_the_nearest_step() {
    for c in 0..=255u8 {
        let packed = rgb565(Rgba8::new(c, c, c, 0));
        let nearest = |steps: f64| (f64::from(c) * steps / 255.0).round();
        assert_eq!(f64::from(packed >> 11), nearest(31.0), "red of {c}");
        assert_eq!(f64::from(packed >> 5 & 63), nearest(63.0), "green of {c}");
        assert_eq!(f64::from(packed & 31), nearest(31.0), "blue of {c}");
    }
}

#[test]
fn bytes_lie_in_memory_as_the_format_says() {
    let color = Rgba8::new(255, 128, 0, 7);
    assert_eq!(Rgba8888.pixel(color).to_ne_bytes(), [255, 128, 0, 7]);
    let [high, low] = [0b1111_1100, 0b0000_0000];
    assert_eq!(Rgb565Be.pixel(color).to_ne_bytes(), [high, low]);
    assert_eq!(Rgb565Le.pixel(color).to_ne_bytes(), [low, high]);
}

#[test]
fn parts_of_numbers_are_quotients() {
    for number in 0..1 << 16 {
        assert_eq!(One.store_words(parts(One, One.word(number))), [number / 255]);
    }
}

/// Levels of a format stay, through bytes and back; other bytes go to the nearest.
fn levels_stay<F: Levels<Pixel: PartialEq + Debug>>(format: F) {
    let [x, y, z] = F::GREATEST;
    for k in 0..=255_u32 {
        let levels = [k.min(x), (k / 2).min(y), (255 - k).min(z)];
        let word: u32 = levels.iter().zip(F::PLACES).map(|(level, place)| level * place).sum();
        let pixel = format.native(word);
        assert_eq!(format.pixel(format.color(pixel)), pixel, "{format:?} {levels:?}");
        let grey = Rgba8::new(k as u8, k as u8, k as u8, 9);
        let shown = format.color(format.pixel(grey)).to_bytes();
        for (shown, greatest) in
            shown.into_iter().zip([x, y.max(x * u32::from(y == 0)), z.max(x * u32::from(z == 0))])
        {
            let step = 255.0 / f64::from(greatest);
            assert!((f64::from(shown) - f64::from(k)).abs() <= step / 2.0 + 0.5, "{format:?} {k}: {shown}");
        }
    }
}

#[test]
fn every_format_has_the_nearest_levels() {
    levels_stay(Rgb565Le);
    levels_stay(Rgb565Be);
    levels_stay(Rgb444);
    levels_stay(Rgb666);
    levels_stay(Rgb888);
    levels_stay(Xrgb8888);
    levels_stay(Rgb332);
    levels_stay(Grey8);
    levels_stay(Grey4);
    levels_stay(Grey2);
    levels_stay(Grey1);
}

#[test]
fn pixels_have_the_bytes_of_displays() {
    let color = Rgba8::new(255, 136, 68, 7);
    assert_eq!(Rgb444.pixel(color), [0x0f, 0x84]);
    assert_eq!(Rgb666.pixel(color), [63 << 2, 34 << 2, 17 << 2]);
    assert_eq!(Rgb888.pixel(color), [255, 136, 68]);
    assert_eq!(Xrgb8888.pixel(color).to_ne_bytes(), [68, 136, 255, 0]);
    assert_eq!(Rgb332.pixel(color), 0b1111_0001);
    assert_eq!(
        [Grey8.pixel(Rgba8::WHITE), Grey4.pixel(Rgba8::WHITE), Grey1.pixel(Rgba8::BLACK)],
        [255, 15, 0]
    );
    // 0.299 · 255 + 0.587 · 136 + 0.114 · 68 is 163.8.
    assert_eq!(Grey8.pixel(color), 164);
    static PALETTE: [Rgba8; 3] = [Rgba8::BLACK, Rgba8::from_rgb24(0xff_80_40), Rgba8::WHITE];
    assert_eq!(Indexed(&PALETTE).pixel(color), 1);
    assert_eq!(Indexed(&PALETTE).color(2), Rgba8::WHITE);
    assert_eq!(Indexed(&PALETTE).native(2), 2);
}

/// Words that are pixels but for the order of bytes: those of the bytes that displays take, by hand.
#[test]
fn words_of_pixels_have_the_bytes_of_displays() {
    assert_eq!(Rgb565Be.native(0x1234).to_ne_bytes(), [0x12, 0x34]);
    assert_eq!(Rgb565Le.native(0x1234).to_ne_bytes(), [0x34, 0x12]);
    assert_eq!(Rgb444.native(0x0f84), [0x0f, 0x84]);
    assert_eq!(Xrgb8888.native(0x00ff_8844).to_ne_bytes(), [0x44, 0x88, 0xff, 0]);
    assert_eq!(Rgba8888.native(0x0744_88ff).to_ne_bytes(), [0xff, 0x88, 0x44, 7]);
    let bytes = [Rgb332.native(0xf1), Grey8.native(0xa4), Grey4.native(15), Grey2.native(3), Grey1.native(1)];
    assert_eq!(bytes, [0xf1, 0xa4, 15, 3, 1]);
}

/// Means in RGB565 against reals, for all shares, all bytes and all levels.
#[test]
fn means_of_16_bits_are_as_near_as_they_say() {
    let mut worst = [0.0_f64; 2];
    for share in 0..=255_u32 {
        for byte in 0..=255_u8 {
            for level in 0..64_u32 {
                let old = Rgb565Le.native((level / 2) << 11 | level << 5 | (level / 2));
                let new = Rgba8::new(byte, byte, byte, 0);
                let mut pixel = [old];
                let colors = (One.word(new.to_bits()), One.word(share));
                Rgb565Le.mix::<One, Rgba8>(One, colors, true, [0; 2], &mut pixel);
                let [r, g, b] = levels565(u16::from_le(pixel[0]));
                assert_eq!(r, b);
                let part = f64::from(share) / 255.0;
                for (k, (found, greatest, old)) in
                    [(r, 31.0, level / 2), (g, 63.0, level)].into_iter().enumerate()
                {
                    let exact = f64::from(byte) * greatest / 255.0 * part + f64::from(old) * (1.0 - part);
                    worst[k] = worst[k].max((f64::from(found) - exact).abs());
                }
                if share == 0 {
                    assert_eq!(pixel[0], old);
                } else if share == 255 {
                    assert_eq!(pixel[0], Rgb565Le.pixel(new));
                }
            }
        }
    }
    assert!(worst[0] <= 1.5 && worst[1] <= 2.0 && worst[0] > 1.2, "{worst:?}");
}

/// Words of the target mixed by a constant, in both orders of bytes, against the levels' means in reals.
#[test]
fn words_of_16_bits_are_mixed_as_they_are() {
    fn mixed<C: ReadColor<Pixel = u16>>(format: C, alpha: u8, [new, old]: [u16; 2]) -> u16 {
        let mut pixel = [format.native(old.into())];
        let blended = Blended { format, by: Constant(alpha) };
        blended.store::<One, u16>(One, One.word(new.into()), true, [0; 2], &mut pixel);
        pixel[0]
    }
    for alpha in 0..=255_u8 {
        for k in 0..1000_u32 {
            let [new, old] = [k, k + 1000].map(|k| (k.wrapping_mul(0x9e37_79b1) >> 16) as u16);
            let found = mixed(Rgb565Le, alpha, [new, old]);
            assert_eq!(mixed(Rgb565Be, alpha, [new, old]), found.swap_bytes());
            let part = f64::from(alpha) / 255.0;
            let found = levels565(u16::from_le(found));
            for ((found, [new, old]), most) in found
                .into_iter()
                .zip([0, 1, 2].map(|k| [levels565(new)[k], levels565(old)[k]]))
                .zip([1.05, 1.62, 1.05])
            {
                let exact = f64::from(new) * part + f64::from(old) * (1.0 - part);
                assert!((f64::from(found) - exact).abs() <= most, "{alpha}: {new} on {old} gave {found}");
            }
        }
    }
    assert_eq!(mixed(Rgb565Le, 255, [0x1234, 0xfedc]), 0x1234_u16.to_le());
    assert_eq!(mixed(Rgb565Le, 0, [0x1234, 0xfedc]), 0xfedc_u16.to_le());
}
