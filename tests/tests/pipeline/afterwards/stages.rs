//! Fogs and holes, of colours of 8 bits a channel and of texels as they are stored.

use super::{
    Corner, FOV, HEIGHT, KEY, NEAR, PIXELS, Place, WIDTH, bare, bayer, each, levels, sampler, texels, words,
};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::fog::{AnyFog, ExponentialFog, Fog, Fogged, LinearFog, SquaredFog};
use alberti::shaders::{AlphaDither, AlphaTest, ColorKey, Solid, Stored, Unlit};
use alberti::texture::format;
use alberti::{
    Camera, ColorFormat, Cull, FixedPoint, FragmentStage, Mesh, NoDepth, Pass, Rgb565Be, Rgba8, Rgba8888,
    Spans16, Target,
};
use alberti_math::lanes::One;
use alberti_raster::color::Bayer;

/// A fog's part of a colour at a distance.
type Formula = fn(f64) -> f64;

/// Fogs, their formulas, the errors in 256ths that they state, and how steep they are at most.
fn fogs() -> [(AnyFog, Formula, f64, f64); 3] {
    let linear = LinearFog { start: 2.5, end: 3.5 };
    [
        (AnyFog::Linear(linear), |z| (z - 2.5).clamp(0.0, 1.0), 0.51, 1.0),
        (AnyFog::Exponential(ExponentialFog { density: 0.5 }), |z| 1.0 - (-0.5 * z).exp(), 1.3, 0.5),
        (AnyFog::Squared(SquaredFog { density: 0.5 }), |z| 1.0 - (-0.25 * z * z).exp(), 1.3, 0.43),
    ]
}

/// Vertices with the coordinate of a fog.
fn misty(fog: AnyFog) -> impl Fn(&Corner) -> (Vec3, (f32, Vec2)) + Copy {
    move |corner| (corner.place, (fog.coordinate(-corner.place.z), corner.uv))
}

#[test]
fn fogs_are_their_formulas_of_the_distance() {
    const MIST: [u8; 4] = [150, 160, 250, 9];
    let texels = texels();
    let surface = Unlit(sampler(format::Rgba8888, &texels));
    for (fog, formula, error, steep) in fogs() {
        let stage = Fogged { surface, fog, color: Rgba8::from(MIST) };
        let mut range = [1.0_f64, 0.0];
        each(
            Rgba8888,
            |_| 0,
            misty(fog),
            stage,
            |place, found| {
                let Some(texel) = place.texel(&texels) else { return false };
                // The distance is twice v.
                let part = formula(2.0 * place.uv[1]);
                range = [range[0].min(part), range[1].max(part)];
                for (c, found) in found.to_ne_bytes().into_iter().enumerate() {
                    let [near, far] = [texel[c], if c == 3 { texel[3] } else { MIST[c] }].map(f64::from);
                    let off = (near * (1.0 - part) + far * part - f64::from(found)).abs();
                    let bound = 0.5 + (near - far).abs() * (error / 256.0 + steep * 2.0 * place.off);
                    assert!(off <= bound, "{fog:?} {place:?}: {off} of {bound}");
                }
                true
            },
        );
        assert!(range[1] - range[0] > 0.1, "{fog:?} is everywhere the same: {range:?}");
    }
}

/// A floor from behind the eye: distances go on being linear there, and fogs are those of the distance.
#[test]
fn fogs_go_on_behind_the_eye() {
    const DROP: f32 = 2.0;
    let floor = [[-400.0, 30.0], [400.0, 30.0], [0.0, -100.0]].map(|[x, z]| Vec3::new(x, -DROP, z));
    let view = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y)
        .and_then(|camera| camera.perspective(FOV.to_radians() as f32, NEAR..200.0))
        .expect("a view");
    let fogs: [(AnyFog, Formula); 3] = [
        (AnyFog::Linear(LinearFog { start: 3.0, end: 20.0 }), |z| ((z - 3.0) / 17.0).clamp(0.0, 1.0)),
        (AnyFog::Exponential(ExponentialFog { density: 0.1 }), |z| 1.0 - (-0.1 * z).exp()),
        (AnyFog::Squared(SquaredFog { density: 0.1 }), |z| 1.0 - (-0.01 * z * z).exp()),
    ];
    for (fog, formula) in fogs {
        let mesh = Mesh::new(&floor, &[[0_u16, 1, 2]], |&at: &Vec3| (at, (fog.coordinate(-at.z), ())));
        let stage = Fogged { surface: Solid(Rgba8::BLACK), fog, color: Rgba8::WHITE };
        let frames = [false, true].map(|fixed| {
            let (mut color, mut depth) = (vec![0_u32; PIXELS], vec![(); PIXELS]);
            let mut target =
                Target::new(Rgba8888, NoDepth, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
            let mut pass = Pass::new(&view, &mesh, stage).cull(Cull::None);
            match fixed {
                true => pass.interpolation(FixedPoint(Spans16)).draw_by(One, &mut target),
                false => pass.draw_by(One, &mut target),
            };
            color
        });
        let mut drawn = 0;
        for row in 0..HEIGHT as usize {
            let up = 1.0 - 2.0 * (row as f64 + 0.5) / f64::from(HEIGHT);
            let distance = -f64::from(DROP) / (up * (FOV.to_radians() / 2.0).tan());
            for column in 0..WIDTH as usize {
                for frame in &frames {
                    let [found, .., alpha] = frame[row * WIDTH as usize + column].to_ne_bytes();
                    if alpha == 0 {
                        continue;
                    }
                    // The fog's 1.3 256ths and half a byte, and as much for rounded distances.
                    let off = 255.0 * formula(distance) - f64::from(found);
                    assert!(off.abs() <= 2.6, "{fog:?} at {distance}: {found} is off by {off}");
                    drawn += 1;
                }
            }
        }
        assert!(drawn > PIXELS / 2, "{drawn}");
    }
}

#[test]
fn fogs_on_stored_texels_are_as_near_as_they_say() {
    const MIST: u16 = 0xffe0;
    let texels = texels();
    let words = words(&texels);
    let surface = Stored(sampler(format::Rgb565, &words));
    for (fog, formula, _, steep) in fogs() {
        let stage = Fogged { surface, fog, color: MIST };
        each(
            Rgb565Be,
            |_| 0,
            misty(fog),
            stage,
            |place, found| {
                let Some([low, high, ..]) = place.texel(&texels) else { return false };
                let part = formula(2.0 * place.uv[1]);
                let [near, far, found] =
                    [u16::from_le_bytes([low, high]), MIST, u16::from_be(found)].map(levels);
                for c in 0..3 {
                    let off = (near[c] * (1.0 - part) + far[c] * part - found[c]).abs();
                    let bound = [1.2, 1.9, 1.2][c] + (near[c] - far[c]).abs() * steep * 2.0 * place.off;
                    assert!(off <= bound, "{fog:?} {place:?}: {off} of {bound}");
                }
                true
            },
        );
    }
}

/// Pixels in holes are as before.
fn has_holes<C: ColorFormat<Pixel: PartialEq>>(
    format: C,
    before: C::Pixel,
    stage: impl FragmentStage<Vec2>,
    there: impl Fn(Place, [u8; 4]) -> bool,
) {
    let (texels, mut counts) = (texels(), [0; 2]);
    each(
        format,
        |_| before,
        bare,
        stage,
        |place, found| {
            let Some(texel) = place.texel(&texels) else { return false };
            let there = there(place, texel);
            assert_eq!(found != before, there, "{place:?}");
            counts[usize::from(there)] += 1;
            true
        },
    );
    assert!(counts.iter().all(|count| *count > PIXELS / 4), "{counts:?}");
}

#[test]
fn holes_are_where_alpha_and_keys_say() {
    let texels = texels();
    let words = words(&texels);
    let surface = Unlit(sampler(format::Rgba8888, &texels));
    // No texel is like the background, whose red is even.
    let before = u32::from_ne_bytes([2, 2, 3, 4]);
    has_holes(Rgba8888, before, AlphaTest { surface, least: 150 }, |_, [.., a]| a >= 150);
    let stored = Stored(sampler(format::Rgba8888, &texels));
    has_holes(Rgba8888, before, AlphaTest { surface: stored, least: 150 }, |_, [.., a]| a >= 150);
    has_holes(Rgba8888, before, AlphaDither { surface, by: Bayer }, |place, [.., a]| {
        let threshold = (bayer(place.of_frame().map(|c| c % 8)) as f64 + 0.5) / 64.0;
        f64::from(a) / 255.0 > threshold
    });
    let keyed = ColorKey { surface: Stored(sampler(format::Rgb565, &words)), key: 0x7a1f };
    has_holes(Rgb565Be, 0x1234_u16.to_be(), keyed, |_, texel| texel[..2] != KEY[..2]);
}
