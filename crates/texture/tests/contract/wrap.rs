//! The modes by their definitions.

use alberti_texture::{Clamp, Mirror, Nearest, Repeat, Texture, Wrap};
use glam::Vec2;

use crate::oracle::{Index, Mode};

/// `Wrap::index` for all indices near 0 and some far away.
#[test]
fn indices() {
    let far = [i32::MIN, i32::MIN + 1, -1_000_000_007, -65_536, 65_537, 1 << 30, i32::MAX - 1, i32::MAX];
    for size in (1..=40).chain([64, 1000, 16383, 16384, 65535, 1 << 30, 1 << 31, u32::MAX]) {
        let far =
            far.into_iter().chain((1 << 23) - 200..(1 << 23) + 200).chain(-(1 << 23) - 200..-(1 << 23) + 200);
        for i in (-500..=500).chain(-16_500..-16_300).chain(16_300..33_000).chain(far) {
            assert_eq!(Repeat.index(i, size), Mode::Repeat.index(i.into(), size), "{i} of {size}");
            assert_eq!(Clamp.index(i, size), Mode::Clamp.index(i.into(), size), "{i} of {size}");
            assert_eq!(Mirror.index(i, size), Mode::Mirror.index(i.into(), size), "{i} of {size}");
        }
    }
    for i in [i32::MIN, -1, 0, 1, i32::MAX] {
        assert_eq!([Repeat.index(i, 0), Clamp.index(i, 0), Mirror.index(i, 0)], [0; 3]);
    }
}

/// The same indices by sampling: the centres of the texels of a continued row are floats up to 2^22 texels away.
#[test]
fn centres() {
    let texels: Vec<u16> = (0..64).collect();
    let row = Texture::new(Index, &texels, 64, 1).unwrap();
    for i in (-5000..5000).chain(-4_194_303..-4_193_000).chain(523_000..525_500).chain(4_193_000..4_194_303) {
        let uv = Vec2::new((i as f32 + 0.5) / 64.0, 0.0);
        assert_eq!(row.sampler(Nearest, Repeat).sample(uv).to_bits(), Mode::Repeat.index(i.into(), 64));
        assert_eq!(row.sampler(Nearest, Clamp).sample(uv).to_bits(), Mode::Clamp.index(i.into(), 64));
        assert_eq!(row.sampler(Nearest, Mirror).sample(uv).to_bits(), Mode::Mirror.index(i.into(), 64));
    }
}

/// The table in the documentation of `Wrap`.
#[test]
fn no_numbers() {
    let texture = Texture::new(Index, &[0, 1, 2, 3, 4, 5, 6, 7, 8], 3, 3).unwrap();
    for value in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let uv = Vec2::splat(value);
        assert_eq!(texture.sampler(Nearest, Repeat).sample(uv).to_bits(), 6);
        assert_eq!(texture.sampler(Nearest, Mirror).sample(uv).to_bits(), 6);
        let clamped = texture.sampler(Nearest, Clamp).sample(uv).to_bits();
        assert_eq!(clamped, if value == f32::INFINITY { 2 } else { 6 });
    }
}
