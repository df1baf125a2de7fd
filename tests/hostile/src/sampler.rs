//! Texture coordinates and derivatives of any numbers: a colour within those of the texels, the same by all lanes.

use crate::bits::Bits;
use alberti::glam::Vec2;
use alberti::lanes::{Lanes as _, Machine};
use alberti::texture::format::{L16, Rgb565, Rgba8888, TexelFormat};
use alberti::texture::{AnyFilter, AnyMipFilter, AnyWrap, Mipmap, Texture, mipmap};
use alberti::{Gradient, Rgba8, for_lanes};

pub(crate) fn run(bytes: &[u8]) {
    let mut bits = Bits::new(bytes);
    let size = [1 + bits.below(9) as u32, 1 + bits.below(9) as u32];
    match bits.below(3) {
        0 => check(Rgba8888, size, &mut bits, |bits| bits.bytes()),
        1 => check(Rgb565, size, &mut bits, |bits| bits.word() as u16),
        _ => check(L16, size, &mut bits, |bits| bits.word() as u16),
    }
}

fn check<F: TexelFormat>(
    format: F,
    [width, height]: [u32; 2],
    bits: &mut Bits<'_>,
    texel: impl Fn(&mut Bits<'_>) -> F::Texel,
) {
    let filter = bits.pick(&[AnyFilter::Nearest, AnyFilter::Bilinear]);
    let wraps = [(); 2].map(|()| bits.pick(&[AnyWrap::Repeat, AnyWrap::Clamp, AnyWrap::Mirror]));
    let places: [[f32; 2]; 16] = {
        let given: [[f32; 2]; 4] = [(); 4].map(|()| bits.floats());
        core::array::from_fn(|k| given[k & 3])
    };
    let [dx, dy] = [(); 2].map(|()| bits.floats::<2>());
    let lambda = bits.float();
    let mut texels: Vec<F::Texel> = (0..width * height).map(|_| texel(bits)).collect();
    let base: Vec<Rgba8> = texels.iter().map(|texel| format.decode(*texel)).collect();
    let range = |colors: &[Rgba8]| -> [[u8; 2]; 4] {
        core::array::from_fn(|channel| {
            let channels = colors.iter().map(|color| color.to_bytes()[channel]);
            [channels.clone().min().unwrap_or(0), channels.max().unwrap_or(0)]
        })
    };
    let within = |found: Rgba8, [r, g, b, a]: [[u8; 2]; 4], what: &str| {
        for (found, [least, most]) in found.to_bytes().into_iter().zip([r, g, b, a]) {
            assert!((least..=most).contains(&found), "{what}: {found} is not within {least} to {most}");
        }
    };
    let machine = Machine::all().next().expect("every machine has lanes");
    {
        let texture = Texture::new(format, &texels, width, height).expect("a texture");
        let sampler = texture.sampler_per_axis(filter, wraps[0], wraps[1]);
        let colors = for_lanes!(machine, lanes => {
            let [u, v] = [0, 1].map(|axis| lanes.load(&lanes.each(|k| places[k & 15][axis])));
            lanes.store_words(sampler.sample_lanes(lanes, u, v)).as_ref().to_vec()
        });
        let all = range(&base);
        for (color, uv) in colors.into_iter().zip(places) {
            let one = sampler.sample(Vec2::from_array(uv));
            assert_eq!(one.to_bits(), color, "lanes differ at {uv:?}");
            within(one, all, "a sample");
        }
    }
    let count = mipmap::texel_count(width, height);
    let first = texels[0];
    texels.resize(count, first);
    mipmap::build(format, &mut texels, width, height).expect("room for all levels");
    let all: Vec<Rgba8> = texels.iter().map(|texel| format.decode(*texel)).collect();
    let map = Mipmap::new(format, &texels, width, height).expect("a mip map");
    let filters =
        [AnyMipFilter::Base(filter), AnyMipFilter::Trilinear, AnyMipFilter::Anisotropic { probes: 8 }];
    for filter in filters {
        let sampler = map.sampler_per_axis(filter, wraps[0], wraps[1]);
        let gradient = Gradient { dx, dy };
        let colors = for_lanes!(machine, lanes => {
            let [u, v] = [0, 1].map(|axis| lanes.load(&lanes.each(|k| places[k & 15][axis])));
            let of = |pair: [f32; 2]| pair.map(|x| lanes.splat(x));
            let gradient = Gradient { dx: of(dx), dy: of(dy) };
            lanes.store_words(sampler.sample_grad_lanes(lanes, u, v, gradient)).as_ref().to_vec()
        });
        for (color, uv) in colors.into_iter().zip(places) {
            let one = sampler.sample_grad(Vec2::from_array(uv), gradient);
            assert_eq!(one.to_bits(), color, "lanes differ at {uv:?}, {gradient:?}");
            within(one, range(&all), "a mip map's sample");
        }
        within(sampler.sample_lod(Vec2::from_array(places[0]), lambda), range(&all), "a level's sample");
    }
}
