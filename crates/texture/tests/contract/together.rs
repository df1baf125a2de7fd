//! Several maps of one size, read together, are each as if read alone: in all lanes, also beside each other.

use alberti_math::lanes::{Lanes, Machine};
use alberti_math::{Rgba8, for_lanes};
use alberti_texture::format::{Indexed8, Rgba8888, Storage};
use alberti_texture::{
    Anisotropic, AnyFilter, AnyMipFilter, Bilinear, Border, Clamp, Gradient, Minify, MipFilter, Mipmap,
    Mirror, Nearest, NearestLevel, Repeat, Size, Trilinear, Wrap,
};
use glam::Vec2;

use crate::minify::{SIZES, noise};
use crate::oracle::Random;

/// Rows of pixels: places beside each other, so that texels are, and across the sides of the texture.
fn as_alone<F: Storage + PartialEq, Z: Size>(
    filter: impl MipFilter,
    u: impl Wrap,
    v: impl Wrap,
    maps: [Mipmap<'_, F, Z>; 3],
    random: &mut Random,
) {
    let alone = maps.map(|map| map.sampler_per_axis(filter, u, v));
    let together = Mipmap::together(maps).expect("one size").sampler_per_axis(filter, u, v);
    for i in 0..200 {
        let texels = 2f32.powi(i % 8 - 3);
        let step = texels / 64.0;
        // On either side of 0 and of 1, by pixels.
        let side = f32::from(u8::from(random.bits() & 1 == 0));
        let [begin, row] = [(); 2].map(|()| side + (random.bits() % 24) as f32 * step / 2.0 - 6.0 * step);
        let steepness = random.near_zero() * step;
        let slopes = Gradient { dx: [step, steepness], dy: [-steepness, step * 0.7] };
        let place = |k: usize| Vec2::new(begin + k as f32 * step, row + k as f32 * steepness);
        for machine in Machine::all() {
            for_lanes!(machine, lanes => {
                let found = lanes.vectorize(
                    #[inline(always)]
                    || {
                        let uv = [lanes.load(&lanes.each(|k| place(k).x)), lanes.load(&lanes.each(|k| place(k).y))];
                        let slopes = slopes.map(|[a, b]| [lanes.splat(a), lanes.splat(b)]);
                        together.sample_each_lanes(lanes, uv, slopes).map(|words| lanes.store_words(words))
                    },
                );
                for (found, alone) in found.iter().zip(&alone) {
                    for (k, &found) in found.as_ref().iter().enumerate() {
                        let expected = alone.sample_grad(place(k), slopes).to_bits();
                        assert_eq!(found, expected, "{filter:?}, {u:?}, {v:?} at {}, {slopes:?}", place(k));
                    }
                }
            });
        }
    }
}

#[test]
fn each_as_if_alone() {
    let mut random = Random(90);
    let border = Border(Rgba8::from_bits(0x1234_5678));
    for (width, height) in SIZES {
        let texels = [(); 3].map(|()| noise(&mut random, width, height, false));
        let maps = texels.each_ref().map(|texels| Mipmap::new(Rgba8888, texels, width, height).unwrap());
        as_alone(Trilinear, Repeat, Mirror, maps, &mut random);
        as_alone(AnyMipFilter::Base(AnyFilter::Bilinear), border, Clamp, maps, &mut random);
        let [a, b, c] = maps.map(|map| map.power_of_two());
        if let (Some(a), Some(b), Some(c)) = (a, b, c) {
            as_alone(Trilinear, border, border, [a, b, c], &mut random);
            let points = Minify { min: NearestLevel(Nearest), mag: Bilinear };
            as_alone(points, Clamp, Repeat, [a, b, c], &mut random);
            as_alone(Anisotropic { probes: 4, filter: Trilinear }, Repeat, Repeat, [a, b, c], &mut random);
        }
    }
}

#[test]
fn of_one_size_and_format() {
    let texels = [[0; 4]; 23];
    let map = |width, height, count: usize| {
        Mipmap::new(Rgba8888, &texels[..count], width, height).expect("whole levels")
    };
    assert!(Mipmap::together([map(4, 4, 21), map(4, 4, 21)]).is_some());
    for other in [map(4, 4, 20), map(2, 8, 23), map(2, 2, 5)] {
        assert!(Mipmap::together([map(4, 4, 21), other]).is_none(), "{other:?}");
    }
    // Another palette is another format.
    let [dark, light] = [[Rgba8::BLACK; 256], [Rgba8::WHITE; 256]];
    let of = |palette| Mipmap::new(Indexed8 { palette }, &[0; 5], 2, 2).expect("2 x 2");
    assert!(Mipmap::together([of(&dark), of(&dark)]).is_some());
    assert!(Mipmap::together([of(&dark), of(&light)]).is_none());
}
