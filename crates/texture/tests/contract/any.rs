//! Policies that are picked at run time against those of types: the same bits, for hostile coordinates, in any number
//! of lanes and in fixed point.

use alberti_math::lanes::{Lanes, Machine, One, OneFixed};
use alberti_math::{Q16, Rgba8, for_lanes};
use alberti_texture::format::{L16, Rgba8888, Storage};
use alberti_texture::surface::{bilinear_height, bilinear_height_lanes};
use alberti_texture::{
    Anisotropic, AnyFilter, AnyMipFilter, AnyWrap, BaseLevel, BetweenLevels, Bilinear, Border, Bounded,
    Clamp, Filter, Gradient, LodBounds, Minify, MipFilter, Mipmap, Mirror, Nearest, Repeat, Sampler, Size,
    Texture, Trilinear, Wrap,
};
use glam::Vec2;

use crate::minify::noise;
use crate::oracle::{Random, SPECIAL};

const SIZES: [(u32, u32); 7] = [(1, 1), (8, 4), (5, 3), (64, 1), (16, 7), (1, 33), (256, 32)];
const COLOR: Rgba8 = Rgba8::from_bits(0x8040_20ff);
const WRAPS: [AnyWrap; 4] = [AnyWrap::Repeat, AnyWrap::Clamp, AnyWrap::Mirror, AnyWrap::Border(COLOR)];

/// Eight of anything: floats of any bits, of all special ones, and near the texture.
fn hostile(random: &mut Random) -> [f32; 8] {
    std::array::from_fn(|_| match random.bits() % 4 {
        0 => random.float(),
        1 => SPECIAL[random.bits() as usize % SPECIAL.len()],
        // Borders of texels, their middles and the floats next to both.
        2 => {
            let exact = (random.bits() % 1025) as f32 / 256.0 - 2.0;
            f32::from_bits(exact.to_bits().wrapping_add(random.bits() % 3).wrapping_sub(1))
        }
        _ => random.near_zero(),
    })
}

fn fixed(random: &mut Random) -> Q16 {
    let shift = random.bits() % 16;
    Q16::from_bits(random.bits().cast_signed() >> shift)
}

/// The type for each wrap mode.
macro_rules! for_wrap {
    ($any:expr, |$wrap:ident| $body:expr) => {
        match $any {
            AnyWrap::Repeat => {
                let $wrap = Repeat;
                $body
            }
            AnyWrap::Clamp => {
                let $wrap = Clamp;
                $body
            }
            AnyWrap::Mirror => {
                let $wrap = Mirror;
                $body
            }
            AnyWrap::Border(color) => {
                let $wrap = Border(color);
                $body
            }
        }
    };
}

/// Coordinates for all lanes, and in fixed point.
type Places = [([f32; 8], [f32; 8], [Q16; 2])];

fn places(random: &mut Random) -> Vec<([f32; 8], [f32; 8], [Q16; 2])> {
    (0..150).map(|_| (hostile(random), hostile(random), [fixed(random), fixed(random)])).collect()
}

/// Colours and numbers of a sampler: of eight places one by one, and of one in fixed point.
type Shown = ([[u32; 2]; 8], [u32; 2]);

fn shown<F: Storage, Fl: Filter, U: Wrap, V: Wrap, Z: Size>(
    sampler: Sampler<'_, F, Fl, U, V, Z>,
    places: &Places,
) -> Vec<Shown> {
    let of = |&(u, v, [x, y]): &([f32; 8], [f32; 8], [Q16; 2])| {
        let one = std::array::from_fn(|k| {
            let color = sampler.sample(Vec2::new(u[k], v[k])).to_bits();
            [color, sampler.scalar_lanes(One, u[k], v[k]).to_bits()]
        });
        let number = sampler.scalar_lanes(OneFixed, x, y).to_bits().cast_unsigned();
        (one, [sampler.sample_lanes(OneFixed, x, y).0, number])
    };
    places.iter().map(of).collect()
}

/// At every width what there is one by one.
fn check_wide<F: Storage, Fl: Filter, U: Wrap, V: Wrap, Z: Size>(
    sampler: Sampler<'_, F, Fl, U, V, Z>,
    places: &Places,
    expected: &[Shown],
) {
    for (&(u, v, _), (expected, _)) in places.iter().zip(expected) {
        for machine in Machine::all() {
            for_lanes!(machine, lanes => {
                let (words, numbers) = lanes.vectorize(
                    #[inline(always)]
                    || {
                        let (u, v) = (lanes.load(&lanes.each(|k| u[k])), lanes.load(&lanes.each(|k| v[k])));
                        let words = lanes.store_words(sampler.sample_lanes(lanes, u, v));
                        (words, lanes.store(sampler.scalar_lanes(lanes, u, v)))
                    },
                );
                for ((&word, &number), expected) in words.as_ref().iter().zip(numbers.as_ref()).zip(expected) {
                    assert_eq!([word, number.to_bits()], *expected, "{sampler:?} {u:?} {v:?}");
                }
            });
        }
    }
}

/// Each wrap mode on each axis, with both filters, in textures of any size and of powers of two.
#[test]
fn filters_wrap_modes_and_sizes() {
    let mut random = Random(120);
    for (width, height) in SIZES {
        let texels = noise(&mut random, width, height, false);
        let texture = Texture::new(Rgba8888, &texels[..(width * height) as usize], width, height).unwrap();
        let places = places(&mut random);
        let check_any = |filter, u, v, expected: &[Shown]| {
            let any = texture.sampler_per_axis(filter, u, v);
            assert_eq!(shown(any, &places), expected, "{any:?}");
            check_wide(any, &places, expected);
        };
        macro_rules! pair {
            ($u:expr, $v:expr, $any_u:expr, $any_v:expr, |$power_of_two:ident, $expected:ident| $wide:block) => {
                let nearest = shown(texture.sampler_per_axis(Nearest, $u, $v), &places);
                check_any(AnyFilter::Nearest, $any_u, $any_v, &nearest);
                let bilinear = shown(texture.sampler_per_axis(Bilinear, $u, $v), &places);
                check_any(AnyFilter::Bilinear, $any_u, $any_v, &bilinear);
                if let Some(texture) = texture.power_of_two() {
                    assert_eq!(shown(texture.sampler_per_axis(Nearest, $u, $v), &places), nearest);
                    let ($power_of_two, $expected) = (texture.sampler_per_axis(Bilinear, $u, $v), bilinear);
                    assert_eq!(shown($power_of_two, &places), $expected);
                    $wide
                }
            };
        }
        pair!(Repeat, Clamp, AnyWrap::Repeat, AnyWrap::Clamp, |sampler, expected| {
            check_wide(sampler, &places, &expected);
        });
        pair!(Clamp, Mirror, AnyWrap::Clamp, AnyWrap::Mirror, |sampler, expected| {});
        pair!(Mirror, Border(COLOR), AnyWrap::Mirror, AnyWrap::Border(COLOR), |sampler, expected| {
            check_wide(sampler, &places, &expected);
        });
        pair!(Border(COLOR), Repeat, AnyWrap::Border(COLOR), AnyWrap::Repeat, |sampler, expected| {});
    }
}

/// The definitions of indices, and texels as they are stored.
#[test]
fn indices_and_stored_texels() {
    let mut random = Random(121);
    let texels: Vec<u16> = (0..35).collect();
    let texture = Texture::new(L16, &texels, 7, 5).unwrap();
    for any in WRAPS {
        for_wrap!(any, |wrap| {
            for size in [0, 1, 2, 5, 64, 100, 16384] {
                for i in (-300..300).chain([i32::MIN, i32::MIN + 1, -65_536, 1 << 23, i32::MAX - 1, i32::MAX])
                {
                    assert_eq!(any.index(i, size), wrap.index(i, size), "{any:?} {i} of {size}");
                }
            }
            assert_eq!(any.border(), wrap.border());
            let (any, typed) = (texture.sampler(Nearest, any), texture.sampler(Nearest, wrap));
            for _ in 0..500 {
                let (u, v) = (hostile(&mut random), hostile(&mut random));
                for (&u, &v) in u.iter().zip(&v) {
                    let word = |texel: Option<u16>| texel.map_or(99_999, u32::from);
                    assert_eq!(any.stored_lanes(One, u, v, word), typed.stored_lanes(One, u, v, word));
                }
            }
        });
    }
}

/// The two ways along a side that is a power of two, for all that an `f32` can be, in every number of lanes.
#[test]
fn ways_along_a_side() {
    fn check<L: Lanes>(lanes: L, wrap: impl Wrap, each: [f32; 8], size: u32) {
        let u = lanes.load(&lanes.each(|k| each[k]));
        let words = |words: L::U32| lanes.store_words(words);
        let (wide, masked) = (wrap.cell_wide(lanes, u, size), wrap.cell_masked(lanes, u, size));
        assert_eq!(words(wide).as_ref(), words(masked).as_ref(), "{wrap:?} {each:?} of {size}");
        for bits in [5, 8] {
            let wide = wrap.between_wide(lanes, u, size, bits);
            for (wide, masked) in wide.into_iter().zip(wrap.between_masked(lanes, u, size, bits)) {
                assert_eq!(words(wide).as_ref(), words(masked).as_ref(), "{wrap:?} {each:?} of {size}");
            }
        }
    }
    let mut random = Random(122);
    for any in WRAPS {
        for size in (0..15).map(|log2| 1 << log2) {
            for i in 0..3000 {
                let each = match i % 2 {
                    0 => hostile(&mut random),
                    // Borders of texels and 512ths of them, in any period nearby, and the floats next to them.
                    _ => std::array::from_fn(|_| {
                        let place = (random.bits() % (6 * 512 * size)) as f32 / (512 * size) as f32 - 3.0;
                        f32::from_bits(place.to_bits().wrapping_add(random.bits() % 3).wrapping_sub(1))
                    }),
                };
                check(One, any, each, size);
                for_wrap!(any, |wrap| {
                    check(One, wrap, each, size);
                    for machine in Machine::all() {
                        for_lanes!(machine, lanes => {
                            check(lanes, wrap, each, size);
                        });
                    }
                });
            }
            let period = size.cast_signed();
            for i in (-1..2 * period.min(100)).chain(2 * period - 100..=2 * period).filter(|&i| i >= -1) {
                let word = std::num::Wrapping(i.cast_unsigned());
                assert_eq!(
                    any.index_wide(One, word, size),
                    any.fold(One, word, size),
                    "{any:?} {i} of {size}"
                );
            }
        }
    }
}

/// Heights with their gradients, of wrap modes and of sizes.
#[test]
fn bilinear_heights() {
    let mut random = Random(123);
    for (width, height) in SIZES {
        let texels: Vec<u16> = (0..width * height).map(|_| random.bits() as u16).collect();
        let texture = Texture::new(L16, &texels, width, height).unwrap();
        for any in WRAPS {
            for_wrap!(any, |wrap| for _ in 0..300 {
                let (u, v) = (hostile(&mut random), hostile(&mut random));
                let uv = Vec2::new(u[0], v[0]);
                let bits = |(h, d): (f32, Vec2)| [h, d.x, d.y].map(f32::to_bits);
                let expected = bilinear_height(&texture, (wrap, Mirror), uv);
                assert_eq!(bits(bilinear_height(&texture, (any, AnyWrap::Mirror), uv)), bits(expected));
                for machine in Machine::all() {
                    for_lanes!(machine, lanes => {
                        let uv = [u, v].map(|each| lanes.load(&lanes.each(|k| each[k])));
                        let wraps = (any, AnyWrap::Mirror);
                        let (h, [x, y]) = bilinear_height_lanes(lanes, &texture, wraps, uv);
                        let found = [h, x, y].map(|number| lanes.store(number).as_ref()[0].to_bits());
                        assert_eq!(found, bits(expected));
                    });
                }
                if let Some(texture) = texture.power_of_two() {
                    assert_eq!(bits(bilinear_height(&texture, (wrap, Mirror), uv)), bits(expected));
                }
            });
        }
    }
}

/// Coordinates, λ and derivatives for all lanes, and in fixed point.
type Footprint = ([[f32; 8]; 7], [Q16; 7]);

/// Colours by a level of detail, by derivatives and by these with bounds: of eight places one by one, and the first two
/// of one in fixed point.
type Read = ([[u32; 3]; 8], [u32; 2]);

fn read<M: MipFilter, U: Wrap, V: Wrap, Z: Size>(
    mipmap: Mipmap<'_, Rgba8888, Z>,
    filter: M,
    (u_wrap, v_wrap): (U, V),
    values: &[Footprint],
) -> Vec<Read> {
    let sampler = mipmap.sampler_per_axis(filter, u_wrap, v_wrap);
    let bounds = LodBounds { bias: 0.5, least: -1.0, greatest: 2.5 };
    let bounded = mipmap.sampler_per_axis(Bounded { filter, bounds }, u_wrap, v_wrap);
    let of = |&(values, [x, y, level, du_dx, dv_dx, du_dy, dv_dy]): &Footprint| {
        let one = std::array::from_fn(|k| {
            let [u, v, lambda, du_dx, dv_dx, du_dy, dv_dy] = values.map(|each| each[k]);
            let (uv, d) = (Vec2::new(u, v), Gradient { dx: [du_dx, dv_dx], dy: [du_dy, dv_dy] });
            let colors =
                [sampler.sample_lod(uv, lambda), sampler.sample_grad(uv, d), bounded.sample_grad(uv, d)];
            colors.map(Rgba8::to_bits)
        });
        let d = Gradient { dx: [du_dx, dv_dx], dy: [du_dy, dv_dy] };
        let by_lod = sampler.sample_lod_lanes(OneFixed, x, y, level).0;
        (one, [by_lod, sampler.sample_grad_lanes(OneFixed, x, y, d).0])
    };
    values.iter().map(of).collect()
}

/// At every width what there is one by one.
fn check_wide_read<M: MipFilter, U: Wrap, V: Wrap, Z: Size>(
    mipmap: Mipmap<'_, Rgba8888, Z>,
    filter: M,
    (u_wrap, v_wrap): (U, V),
    values: &[Footprint],
    expected: &[Read],
) {
    let sampler = mipmap.sampler_per_axis(filter, u_wrap, v_wrap);
    for (&(values, _), (expected, _)) in values.iter().zip(expected) {
        for machine in Machine::all() {
            for_lanes!(machine, lanes => {
                let [by_lod, by_gradient] = lanes.vectorize(
                    #[inline(always)]
                    || {
                        let [u, v, lambda, du_dx, dv_dx, du_dy, dv_dy] =
                            values.map(|each| lanes.load(&lanes.each(|k| each[k])));
                        let by_lod = lanes.store_words(sampler.sample_lod_lanes(lanes, u, v, lambda));
                        let d = Gradient { dx: [du_dx, dv_dx], dy: [du_dy, dv_dy] };
                        [by_lod, lanes.store_words(sampler.sample_grad_lanes(lanes, u, v, d))]
                    },
                );
                let found = by_lod.as_ref().iter().zip(by_gradient.as_ref());
                for ((&by_lod, &by_gradient), expected) in found.zip(expected) {
                    assert_eq!([by_lod, by_gradient], expected[..2], "{sampler:?} {values:?}");
                }
            });
        }
    }
}

/// Coordinates, λ and derivatives: any, or such as pixels have.
fn footprints(random: &mut Random) -> Vec<Footprint> {
    let each = |i: u32, random: &mut Random| {
        let scale = if i.is_multiple_of(2) { 1.0 } else { 1.0 / 16.0 };
        let mut values: [[f32; 8]; 7] = std::array::from_fn(|_| hostile(random));
        values[3..].iter_mut().flatten().for_each(|slope| *slope *= scale);
        (values, [(); 7].map(|()| fixed(random)))
    };
    (0..120).map(|i| each(i, random)).collect()
}

#[test]
fn mip_filters() {
    let mut random = Random(124);
    for (width, height) in SIZES {
        let texels = noise(&mut random, width, height, false);
        let mipmap = Mipmap::new(Rgba8888, &texels, width, height).unwrap();
        let values = footprints(&mut random);
        let check_any = |filter, expected: &[Read]| {
            let wraps = (AnyWrap::Repeat, AnyWrap::Mirror);
            assert_eq!(read(mipmap, filter, wraps, &values), expected, "{filter:?} {mipmap:?}");
            check_wide_read(mipmap, filter, wraps, &values, expected);
        };
        let nearest = read(mipmap, BaseLevel(Nearest), (Repeat, Mirror), &values);
        check_any(AnyMipFilter::Base(AnyFilter::Nearest), &nearest);
        let bilinear = read(mipmap, BaseLevel(Bilinear), (Repeat, Mirror), &values);
        check_any(AnyMipFilter::Base(AnyFilter::Bilinear), &bilinear);
        let trilinear = read(mipmap, Trilinear, (Repeat, Mirror), &values);
        check_any(AnyMipFilter::Trilinear, &trilinear);
        // The name and its parts, with and without a way for magnification.
        let parts = BetweenLevels(Bilinear);
        assert_eq!(read(mipmap, parts, (Repeat, Mirror), &values), trilinear, "{mipmap:?}");
        let parts = Minify { min: parts, mag: Bilinear };
        assert_eq!(read(mipmap, parts, (Repeat, Mirror), &values), trilinear, "{mipmap:?}");
        for probes in [1, 2, 4, 8, 16] {
            let filter = Anisotropic { probes, filter: Trilinear };
            let expected = read(mipmap, filter, (Repeat, Mirror), &values);
            check_any(AnyMipFilter::Anisotropic { probes }, &expected);
            if let Some(mipmap) = mipmap.power_of_two() {
                assert_eq!(read(mipmap, filter, (Repeat, Mirror), &values), expected);
                check_wide_read(mipmap, filter, (Repeat, Mirror), &values, &expected);
            }
        }
    }
}

/// Numbers of probes that are no power of two count as the next lower one.
#[test]
fn numbers_of_probes() {
    let mut random = Random(125);
    let texels = noise(&mut random, 64, 64, false);
    let mipmap = Mipmap::new(Rgba8888, &texels, 64, 64).unwrap();
    let values = footprints(&mut random);
    let of = |probes| {
        let filter = Anisotropic { probes, filter: Trilinear };
        read(mipmap, filter, (Repeat, Mirror), &values)
    };
    for (probes, counts) in [(0, 1), (3, 2), (5, 4), (7, 4), (15, 8), (17, 16), (u32::MAX, 16)] {
        assert_eq!(of(probes), of(counts), "{probes}");
    }
    assert_ne!(of(1), of(16));
}

/// Policies of types take no place.
#[test]
fn types_have_no_size() {
    fn check<T: Copy>(sampler: T, bytes: usize) {
        assert_eq!(size_of_val(&sampler), bytes, "{}", std::any::type_name::<T>());
    }
    let texels = [[0; 4]; 4];
    let texture = Texture::new(Rgba8888, &texels, 2, 2).unwrap().power_of_two().unwrap();
    // A slice and two sides of 16 bits.
    check(texture.sampler_per_axis(Bilinear, Repeat, Clamp), size_of::<(&[u8], u32)>());
    let mipmap = Mipmap::new(Rgba8888, &texels, 2, 2).unwrap();
    check(mipmap.sampler_per_axis(Trilinear, Mirror, Clamp), size_of_val(&mipmap));
}
