//! Any bits are coordinates: no panic (overflow checks are on in tests), and a colour of the texture.

use alberti_math::Rgba8;
use alberti_texture::format::{Rgb565, Rgba8888};
use alberti_texture::{Bilinear, Clamp, Filter, Mirror, Nearest, Repeat, TexelFormat, Texture, Wrap};
use glam::Vec2;

use crate::oracle::{Random, SPECIAL};

/// In a texture of one colour there is no other.
fn constant<F: TexelFormat>(
    format: F,
    filter: impl Filter,
    u: impl Wrap,
    v: impl Wrap,
    texel: F::Texel,
    seed: u64,
) {
    let texels = [texel; 21];
    let color: Rgba8 = format.decode(texel);
    let mut random = Random(seed);
    for (width, height) in [(7, 3), (3, 7), (1, 21), (21, 1)] {
        let sampler = Texture::new(format, &texels, width, height).unwrap().sampler_per_axis(filter, u, v);
        for _ in 0..250_000 {
            assert_eq!(sampler.sample(Vec2::new(random.float(), random.float())), color);
        }
        for u in SPECIAL {
            for v in SPECIAL {
                assert_eq!(sampler.sample(Vec2::new(u, v)), color);
            }
        }
    }
}

#[test]
fn nearest_of_any_bits() {
    constant(Rgba8888, Nearest, Repeat, Repeat, [1, 2, 3, 4], 10);
    constant(Rgb565, Nearest, Clamp, Clamp, 0x8410, 11);
    constant(Rgba8888, Nearest, Mirror, Mirror, [255; 4], 12);
}

#[test]
fn bilinear_of_any_bits() {
    constant(Rgba8888, Bilinear, Repeat, Clamp, [255, 0, 254, 1], 20);
    constant(Rgb565, Bilinear, Clamp, Mirror, 0xffff, 21);
    constant(Rgba8888, Bilinear, Mirror, Repeat, [127, 128, 129, 255], 22);
}
