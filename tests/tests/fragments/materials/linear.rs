//! Materials in linear light, against `f64`: texels become light, light becomes bytes, and what is too bright keeps its
//! shape.

use super::{MIRRORED, Maps, SCATTERED, STEP, exponent, framed, lit, plain, wide};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Machine, One, OneFixed};
use alberti::raster::{Fragments, Gradient};
use alberti::shaders::material::{
    AnyLightSpace, BlinnPhong, Color, Emission, Gouraud, InSpace, LinearLight, Material, Reflection,
    Specular, Wetness,
};
use alberti::texture::environment::LatLong;
use alberti::{FragmentStage, Lanes, Q16, Rgba8, Varying, for_lanes};
use alberti_oracle::material::{self as oracle, Model, Point, light, numbers, on_screen, schlick};
use alberti_oracle::rng::{Rng, run_seed};

/// The bound of [`InSpace`], where a [`Material`] has ½ + `more` of a byte.
fn bound(more: f64, arriving: f64) -> f64 {
    0.5 + 1.0 / 64.0 + arriving.max(1.0) / 32.0 + 13.0 * more
}

type Carried = (Vec3, (Vec3, Vec2));

/// A surface of three colours, and what lights make of it that are given: scattered and mirrored.
struct Given {
    layers: (Color<Rgba8>, Specular<Rgba8>, Emission<Rgba8>),
    carried: Carried,
    /// In amounts of light, and what arrives in the brightest channel.
    sum: [f64; 3],
    arriving: f64,
}

fn given(rng: &mut Rng, most: f64) -> Given {
    let colors = [(); 3].map(|()| {
        // A third of the colours is dark.
        let dark = if rng.one_in(3) { 15 } else { 255 };
        [(); 4].map(|()| (rng.u64() as u8) & dark)
    });
    let carried = [(); 2].map(|()| {
        let scale = most * if rng.one_in(2) { 0.1 } else { 1.0 };
        Vec3::from_array([(); 3].map(|()| rng.uniform(0.0, scale) as f32))
    });
    let [scattered, mirrored] = carried.map(|v| v.as_dvec3().to_array());
    let [diffuse, specular, emission] = colors.map(|color| light(numbers(color)));
    let part = |k: usize| [emission[k], diffuse[k] * scattered[k], specular[k] * mirrored[k]];
    let arriving =
        [0, 1, 2].map(|k| emission[k] + scattered[k] + mirrored[k]).into_iter().fold(1.0, f64::max);
    let [a, b, c] = colors.map(|[r, g, b, a]| Rgba8::new(r, g, b, a));
    Given {
        layers: (Color(a), Specular(b), Emission(c)),
        carried: (carried[0], (carried[1], Vec2::ZERO)),
        sum: [0, 1, 2].map(|k| part(k).iter().sum()),
        arriving,
    }
}

fn off(found: Rgba8, sum: [f64; 3]) -> f64 {
    let pairs = found.to_bytes().into_iter().zip(on_screen(sum));
    pairs.map(|(found, exact)| (f64::from(found) - 255.0 * exact).abs()).fold(0.0, f64::max)
}

#[test]
fn lights_that_are_given() {
    let mut rng = Rng::stream(run_seed(), 60);
    let (mut worst, mut bright) = (0.0_f64, 0);
    for _ in 0..200_000 {
        let most = [0.5, 1.0, 8.0][rng.index(3)];
        let Given { layers, carried, sum, arriving } = given(&mut rng, most);
        let stage = InSpace { surface: Gouraud { layers }, space: LinearLight };
        let found = stage.shade_one(carried).expect("never discards");
        let off = off(found, sum);
        assert!(off <= bound(6.0 * STEP * arriving, arriving), "{off}: {found:?} for {sum:?} {arriving}");
        worst = worst.max(off);
        bright += u32::from(sum.iter().any(|&c| c > 1.0));
        // Chosen when running it is the same; the other space is none.
        let any = |space| InSpace { surface: Gouraud { layers }, space }.shade_one(carried);
        assert_eq!(any(AnyLightSpace::Linear), Some(found));
        assert_eq!(any(AnyLightSpace::Srgb), Gouraud { layers }.shade_one(carried));
    }
    println!("in linear light: at most {worst:.5} of a byte off, {bright} brighter than white");
    assert!(worst > 0.49 && bright > 20_000);
}

/// Each byte is itself under a light of 1 as long as it is not compressed.
#[test]
fn colours_come_back() {
    for byte in 0..=255_u8 {
        let layers = Color(Rgba8::new(byte, byte, byte, byte));
        let stage = InSpace { surface: Gouraud { layers }, space: LinearLight };
        let found = stage.shade_one((Vec3::ONE, (Vec3::ZERO, Vec2::ZERO))).map(Rgba8::to_bytes);
        let compressed = light([f64::from(byte) / 255.0; 3])[0] > 0.8;
        let [gray, _, _, alpha] = found.expect("never discards");
        assert!(byte < 240 || gray < byte, "{byte}: {found:?}");
        assert!(alpha == byte && if compressed { gray <= byte } else { gray == byte }, "{byte}: {found:?}");
    }
}

#[test]
fn materials_and_reflections() {
    let mut rng = Rng::stream(run_seed(), 61);
    let (mut worst, mut judged) = (0.0_f64, 0);
    for _ in 0..20_000 {
        let (maps, lit, surface) = (Maps::new(&mut rng), lit(&mut rng), framed(&mut rng));
        let e = exponent(&mut rng) / 256;
        let sky = Rgba8::from_rgb24(0x40_80_c0);
        let facing = rng.unit() as f32;
        let mirror = Reflection { environment: LatLong, image: sky, strength: maps.sampler(1), facing };
        let layers = (Color(maps.sampler(0)), Specular(maps.sampler(2)), Wetness(maps.sampler(2)), mirror);
        let material = Material { layers, lighting: lit.lighting(BlinnPhong(e)) };
        let found = InSpace { surface: material, space: LinearLight }.shade_one(surface);
        let found = found.expect("never discards");

        let [color, share, wet] = [0, 1, 2].map(|k| maps.texel(k, surface.uv));
        let white = plain(surface.position, surface.axes[2]);
        let to_eye = match lit.eye {
            oracle::Viewer::At(place) => [0, 1, 2].map(|i| place[i] - white.position[i]),
            oracle::Viewer::Towards(direction) => direction,
        };
        let share = numbers(share)[0] * schlick(f64::from(facing), white.normal, to_eye);
        let dry = 1.0 - super::WETNESS[0] * numbers(wet)[0];
        let point = Point {
            diffuse: light(numbers(color)).map(|c| c * dry * (1.0 - share)),
            specular: light(numbers(wet)),
            emission: light(numbers(sky.to_bytes())).map(|c| c * share),
            ..white
        };
        let seen = oracle::seen(&point, &lit.same, wide(lit.ambient), Model::Blinn(e), lit.eye);
        if seen.margin < 1e-5 {
            continue;
        }
        let steps = SCATTERED + super::EDGE * seen.steepness + MIRRORED * f64::from(e) * seen.opposite;
        let off = off(found, seen.color);
        let bound = bound(steps * STEP * seen.light.max(1.0), seen.light);
        assert!(off <= bound, "{off} of {bound}: {found:?} for {seen:?} {point:?}");
        (worst, judged) = (worst.max(off), judged + 1);
    }
    println!("materials in linear light: at most {worst:.5} of a byte off, in {judged}");
    assert!(judged > 10_000);
}

fn fragments<L: Lanes>(
    lanes: L,
    carried: Carried,
    number: impl Fn(f32) -> L::Number,
) -> Fragments<L, Carried> {
    let (scattered, (mirrored, _)) = carried;
    let numbers = |v: Vec3| v.to_array().map(&number);
    let varying = (numbers(scattered), (numbers(mirrored), [number(0.0); 2]));
    let none = <Carried as Varying>::map(&varying, &|_| number(0.0));
    Fragments {
        lanes,
        varying,
        gradient: Gradient { dx: none, dy: none },
        mask: lanes.mask(1),
        place: [0; 2],
    }
}

/// The same bits at every width, and in fixed point within two bytes.
#[test]
fn every_kind_of_lanes() {
    let mut rng = Rng::stream(run_seed(), 62);
    let mut worst = 0.0_f64;
    for _ in 0..20_000 {
        let Given { layers, carried, sum, arriving } = given(&mut rng, 1.5);
        let stage = InSpace { surface: Gouraud { layers }, space: LinearLight };
        let first = |words: &[u32]| words.first().copied().map(Rgba8::from_bits);
        let one = stage.shade(&fragments(One, carried, |x| x)).0;
        for machine in Machine::all() {
            for_lanes!(machine, lanes => {
                let found = stage.shade(&fragments(lanes, carried, |x| lanes.splat(x))).0;
                assert_eq!(first(lanes.store_words(found).as_ref()), Some(Rgba8::from_bits(one.0)));
            });
        }
        let fixed = stage.shade(&fragments(OneFixed, carried, Q16::from_f32)).0.0;
        if arriving <= 4.0 {
            worst = worst.max(off(Rgba8::from_bits(fixed), sum));
        }
    }
    println!("fixed point in linear light: at most {worst:.5} of a byte off");
    assert!((0.5..2.0).contains(&worst), "{worst}");
}

/// Whatever is carried, a colour comes out, and too much light is bright.
#[test]
fn hostile_light() {
    let extremes = [0.0, -1.0, 1e-40, 0.8, 1e9, 1e30, f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
    let layers = (Color(Rgba8::WHITE), Specular(Rgba8::WHITE));
    let stage = InSpace { surface: Gouraud { layers }, space: LinearLight };
    for r in extremes {
        for g in extremes {
            let carried = (Vec3::new(r, g, 0.5), (Vec3::ZERO, Vec2::ZERO));
            let [_, _, _, alpha] = stage.shade_one(carried).expect("never discards").to_bytes();
            let _ = stage.shade(&fragments(OneFixed, carried, Q16::from_f32));
            assert_eq!(alpha, 255);
        }
        let gray = stage.shade_one((Vec3::splat(r), (Vec3::ZERO, Vec2::ZERO))).expect("never discards");
        if r > 1.0 {
            assert!(gray.to_bytes()[0] >= 254, "{r} {gray:?}");
        }
    }
}
