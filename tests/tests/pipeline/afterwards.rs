//! What comes after the fragment, drawn by passes over a whole frame, in floats by one lane and by several, and in fixed
//! point: each against its formula in `f64`. The places that a pixel shows are found by rays, or, without perspective,
//! on the screen.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "bytes, and frames are small"
)]

use alberti::glam::{Vec2, Vec3};
use alberti::shaders::fog::{AnyFog, ExponentialFog, Fog, Fogged, LinearFog, SquaredFog};
use alberti::shaders::{AlphaDither, AlphaTest, ColorKey, Stored, Unlit};
use alberti::texture::{Nearest, Repeat, Sampler, Texture, format};
use alberti::{
    Affine, Camera, ColorFormat, Cull, Exact, FixedPoint, FragmentStage, Interpolation, Mesh, NoDepth, Pass,
    Rgb565Be, Rgba8, Rgba8888, Target, Varying, View,
};
use alberti_math::lanes::{Floating, One};
use alberti_oracle::coverage::weights;
use alberti_oracle::ideal::see_ideal;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_oracle::{cases, dd, material, scene, snapped};
use alberti_raster::color::{AnyBlend, Bayer, Blended, BlueNoise, Dithered, InLight};
use alberti_tests::for_widest;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 64;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;
const FOV: f64 = 60.0;
const NEAR: f32 = 0.5;
const FAR: f32 = 20.0;

/// A triangle over the whole frame: places on the screen, distances, and u. The other coordinate is half the distance.
const CORNERS: [([f64; 2], f64, f32); 3] =
    [([-40.33, -30.71], 2.0, -0.3), ([330.28, -20.42], 8.0, 5.7), ([-20.67, 300.37], 6.0, 1.1)];

/// A vertex: its place in the world, its distance, its texture coordinates.
#[derive(Clone, Copy, Debug)]
struct Corner {
    place: Vec3,
    uv: Vec2,
}

fn corners() -> [Corner; 3] {
    let scale = f64::from(HEIGHT) / 2.0 / (FOV.to_radians() / 2.0).tan();
    CORNERS.map(|([x, y], z, u)| {
        let [x, y] =
            [x - f64::from(WIDTH) / 2.0, f64::from(HEIGHT) / 2.0 - y].map(|c| (c / scale * z) as f32);
        Corner { place: Vec3::new(x, y, -z as f32), uv: Vec2::new(u, (z / 2.0) as f32) }
    })
}

/// The coordinates at each pixel, by rays in space.
fn in_space() -> Vec<[f64; 2]> {
    let vertex = |corner: Corner| scene::Vertex {
        position: corner.place.to_array().map(f64::from),
        normal: [0.0, 0.0, 1.0],
        uv: corner.uv.to_array().map(f64::from),
        color: [0.0; 3],
    };
    let vertices = corners().map(vertex);
    let part = scene::Part { triangles: &[[0, 1, 2]], diffuse: [1.0; 3], texture: None };
    let seen = see_ideal(&scene::Scene {
        vertices: &vertices,
        parts: &[part],
        textures: &[],
        camera: scene::Camera {
            eye: [0.0; 3],
            target: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            fov: FOV,
            near: NEAR.into(),
            far: FAR.into(),
        },
        width: WIDTH,
        height: HEIGHT,
        cull: scene::Cull::None,
        shading: scene::Shading::Unlit,
        filter: scene::Filter::Nearest,
        wrap: scene::Wrap::Repeat,
        background: [0; 3],
    });
    seen.into_iter().map(|seen| seen.expect("the whole frame is covered").uv).collect()
}

/// The coordinates at each pixel, by a plane over the screen through those of the snapped vertices.
fn on_screen() -> Vec<[f64; 2]> {
    let corners = corners();
    let tri = CORNERS.map(|(at, ..)| at.map(|c| snapped::snap(c, 8)));
    let at = |k: usize| {
        let sample = cases::pixel_centre((k % WIDTH as usize) as i64, (k / WIDTH as usize) as i64, 8);
        assert!(
            weights(tri, sample).iter().all(|weight| weight.signum() == weights(tri, sample)[0].signum())
        );
        [0, 1].map(|axis| dd::linear(tri, sample, corners.map(|corner| corner.uv[axis])).to_f64())
    };
    (0..PIXELS).map(at).collect()
}

/// A pixel: its number, the coordinates that it shows, and how far off these may be.
#[derive(Clone, Copy, Debug)]
struct Place {
    k: usize,
    uv: [f64; 2],
    off: f64,
}

impl Place {
    /// The nearest texel, unless another is as near as coordinates may be off.
    fn texel(self, texels: &[[u8; 4]]) -> Option<[u8; 4]> {
        let texture = scene::Texture { width: SIDE, height: SIDE, texels };
        let at = |[u, v]: [f64; 2]| {
            material::nearest(&texture, [self.uv[0] + u * self.off, self.uv[1] + v * self.off])
        };
        let [first, others @ ..] = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]].map(at);
        others.iter().all(|other| *other == first).then_some(first)
    }

    /// The column and the row.
    fn of_frame(self) -> [usize; 2] {
        [self.k % WIDTH as usize, self.k / WIDTH as usize]
    }
}

const SIDE: u32 = 8;

/// Texels of any alpha, a quarter of which are the same.
fn texels() -> Vec<[u8; 4]> {
    let mut rng = Rng::stream(run_seed(), 77);
    let texel = |k: u32| if k % 4 == 1 { KEY } else { (rng.u64() as u32).to_le_bytes() };
    (0..SIDE * SIDE).map(texel).collect()
}

const KEY: [u8; 4] = [0x1f, 0xf8, 0, 200];

/// The first two bytes of the texels, the low one first.
fn words(texels: &[[u8; 4]]) -> Vec<u16> {
    texels.iter().map(|&[low, high, ..]| u16::from_le_bytes([low, high])).collect()
}

fn sampler<F: format::TexelFormat>(
    format: F,
    texels: &[F::Texel],
) -> Sampler<'_, F, Nearest, Repeat, Repeat> {
    Texture::new(format, texels, SIDE, SIDE).expect("a texture").sampler(Nearest, Repeat)
}

fn drawn<C: ColorFormat, V: Varying>(
    format: C,
    before: &[C::Pixel],
    vertex: impl Fn(&Corner) -> (Vec3, V),
    stage: impl FragmentStage<V>,
    interpolation: impl Interpolation,
    lanes: impl Floating,
) -> Vec<C::Pixel> {
    let (mut color, mut depth) = (before.to_vec(), vec![(); PIXELS]);
    let view: View = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y)
        .and_then(|camera| camera.perspective((FOV.to_radians()) as f32, NEAR..FAR))
        .expect("a view");
    let corners = corners();
    let mesh = Mesh::new(&corners, &[[0_u16, 1, 2]], vertex);
    let mut target = Target::new(format, NoDepth, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
    let pass = Pass::new(&view, &mesh, stage).cull(Cull::None);
    pass.interpolation(interpolation).draw_by(lanes, &mut target);
    color
}

/// Draws over `before` and hands each pixel to `check`, which says whether it was any; most have to be.
fn each<C: ColorFormat<Pixel: PartialEq>, V: Varying>(
    format: C,
    before: impl Fn(usize) -> C::Pixel,
    vertex: impl Fn(&Corner) -> (Vec3, V) + Copy,
    stage: impl FragmentStage<V>,
    mut check: impl FnMut(Place, C::Pixel) -> bool,
) {
    let before: Vec<C::Pixel> = (0..PIXELS).map(before).collect();
    let exact = drawn(format, &before, vertex, stage, Exact, One);
    let several = for_widest!(lanes => drawn(format, &before, vertex, stage, Exact, lanes));
    assert!(exact == several, "{format:?}: lanes change pixels");
    let fixed = drawn(format, &before, vertex, stage, FixedPoint(Affine), One);
    // In space the way of a vertex is rounded to 2^-16 pixel; on the screen a step of 2^-16 is lost by column.
    let ways = [(exact, in_space(), 1e-4), (fixed, on_screen(), f64::from(WIDTH + 4) / 65536.0)];
    for (pixels, places, off) in ways {
        let mut checked = 0;
        for (k, (pixel, uv)) in pixels.into_iter().zip(places).enumerate() {
            checked += u32::from(check(Place { k, uv, off }, pixel));
        }
        assert!(checked > WIDTH * HEIGHT * 3 / 4, "{format:?}: {checked} pixels");
    }
}

fn bare(corner: &Corner) -> (Vec3, Vec2) {
    (corner.place, corner.uv)
}

/// A background of every byte.
fn bytes_before(k: usize) -> [u8; 4] {
    [(k * 5) as u8, (k / 3) as u8, (k * k) as u8, (k * 11) as u8]
}

/// A background of every word.
fn word_before(k: usize) -> u16 {
    (k as u16).wrapping_mul(40_503)
}

type Channels = [f64; 4];
/// A blend of parts from 0 to 1.
type Formula = fn(Channels, Channels) -> Channels;

fn parts(bytes: [u8; 4]) -> Channels {
    bytes.map(|byte| f64::from(byte) / 255.0)
}

fn by_alpha(new: Channels, old: Channels, a: f64) -> Channels {
    let mixed = |k: usize| new[k] * a + old[k] * (1.0 - a);
    [mixed(0), mixed(1), mixed(2), a + old[3] * (1.0 - a)]
}

const BLENDS: [(AnyBlend, Formula); 6] = [
    (AnyBlend::Replace, |n, _| n),
    (AnyBlend::Over, |n, o| by_alpha(n, o, n[3])),
    (AnyBlend::Constant(51), |n, o| by_alpha(n, o, 0.2)),
    (AnyBlend::Premultiplied, |n, o| [0, 1, 2, 3].map(|k| (n[k] + o[k] * (1.0 - n[3])).min(1.0))),
    (AnyBlend::Additive, |n, o| {
        let sum = |k: usize| (n[k] * n[3] + o[k]).min(1.0);
        [sum(0), sum(1), sum(2), o[3]]
    }),
    (AnyBlend::Multiply, |n, o| [n[0] * o[0], n[1] * o[1], n[2] * o[2], o[3]]),
];

#[test]
fn blends_are_correctly_rounded_in_bytes() {
    let texels = texels();
    let stage = Unlit(sampler(format::Rgba8888, &texels));
    for (by, formula) in BLENDS {
        let blended = Blended { format: Rgba8888, by };
        each(
            blended,
            |k| u32::from_ne_bytes(bytes_before(k)),
            bare,
            stage,
            |place, found| {
                let Some(texel) = place.texel(&texels) else { return false };
                let right = formula(parts(texel), parts(bytes_before(place.k)));
                for (found, right) in found.to_ne_bytes().into_iter().zip(right) {
                    assert!((f64::from(found) - 255.0 * right).abs() <= 0.5 + 1e-9, "{by:?} {place:?}");
                }
                true
            },
        );
    }
}

/// Light by the formula of sRGB, and back.
fn light(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

fn encoded(c: f64) -> f64 {
    if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

#[test]
fn blends_in_light_are_of_light() {
    let texels = texels();
    let stage = Unlit(sampler(format::Rgba8888, &texels));
    for (by, formula) in BLENDS {
        let blended = Blended { format: Rgba8888, by: InLight(by) };
        each(
            blended,
            |k| u32::from_ne_bytes(bytes_before(k)),
            bare,
            stage,
            |place, found| {
                let Some(texel) = place.texel(&texels) else { return false };
                let lights = |bytes| {
                    let [r, g, b, a] = parts(bytes);
                    [light(r), light(g), light(b), a]
                };
                let [r, g, b, a] = formula(lights(texel), lights(bytes_before(place.k)));
                let right = [encoded(r), encoded(g), encoded(b), a];
                for (found, right) in found.to_ne_bytes().into_iter().zip(right) {
                    // Of light in 65535ths, at which black has 20 to a byte.
                    assert!((f64::from(found) - 255.0 * right).abs() <= 0.58, "{by:?} {place:?}");
                }
                true
            },
        );
    }
}

/// Red, green and blue of a word, and their greatest levels.
fn levels(word: u16) -> [f64; 3] {
    [word >> 11, word >> 5 & 63, word & 31].map(f64::from)
}

const GREATEST: [f64; 3] = [31.0, 63.0, 31.0];

#[test]
fn means_in_rgb565_are_as_near_as_they_say() {
    let texels = texels();
    let stage = Unlit(sampler(format::Rgba8888, &texels));
    let mut worst = [0.0_f64; 3];
    for (by, formula) in BLENDS {
        let blended = Blended { format: Rgb565Be, by };
        each(
            blended,
            |k| word_before(k).to_be(),
            bare,
            stage,
            |place, found| {
                let Some(texel) = place.texel(&texels) else { return false };
                let old = levels(word_before(place.k));
                let mean = matches!(by, AnyBlend::Over | AnyBlend::Constant(_));
                let old: Channels = std::array::from_fn(|c| match (c, mean) {
                    (3, _) => 1.0,
                    (c, true) => old[c] / GREATEST[c],
                    // By way of bytes.
                    (c, false) => (old[c] / GREATEST[c] * 255.0).round() / 255.0,
                });
                let right = formula(parts(texel), old);
                for (c, found) in levels(u16::from_be(found)).into_iter().enumerate() {
                    if mean {
                        let off = (found - right[c] * GREATEST[c]).abs();
                        worst[c] = worst[c].max(off);
                        assert!(off <= [1.5, 2.0, 1.5][c], "{by:?} {place:?}: {off}");
                    } else {
                        let byte = (right[c] * 255.0).round();
                        assert_eq!(found, (byte * GREATEST[c] / 255.0).round(), "{by:?} {place:?}");
                    }
                }
                true
            },
        );
    }
    assert!(worst.iter().all(|worst| *worst > 0.7), "{worst:?}");
}

/// The order of the thresholds of 2n by 2n pixels, from that of n by n.
fn bayer([column, row]: [usize; 2]) -> usize {
    let (mut rank, mut factor) = (0, 16);
    for bit in 0..3 {
        let quarter = [[0, 2], [3, 1]][row >> bit & 1][column >> bit & 1];
        rank += quarter * factor;
        factor /= 4;
    }
    rank
}

#[test]
fn dithers_are_levels_above_thresholds() {
    let texels = texels();
    let stage = Unlit(sampler(format::Rgba8888, &texels));
    let level = |byte: u8, c: usize, more: f64| (f64::from(byte) * GREATEST[c] / 255.0 + more).floor();
    let by_order = Dithered { format: Rgb565Be, by: Bayer };
    each(
        by_order,
        |_| 0,
        bare,
        stage,
        |place, found| {
            let Some(texel) = place.texel(&texels) else { return false };
            let [column, row] = place.of_frame();
            let threshold = (bayer([column % 8, row % 8]) as f64 + 0.5) / 64.0;
            for (c, found) in levels(u16::from_be(found)).into_iter().enumerate() {
                assert_eq!(found, level(texel[c], c, threshold), "{place:?}");
            }
            true
        },
    );
    let mut sum = 0.0;
    let by_noise = Dithered { format: Rgb565Be, by: BlueNoise };
    each(
        by_noise,
        |_| 0,
        bare,
        stage,
        |place, found| {
            let Some(texel) = place.texel(&texels) else { return false };
            for (c, found) in levels(u16::from_be(found)).into_iter().enumerate() {
                assert!([0.0, 1.0 - 1e-9].map(|more| level(texel[c], c, more)).contains(&found), "{place:?}");
                sum += found - f64::from(texel[c]) * GREATEST[c] / 255.0;
            }
            true
        },
    );
    // Of each channel of each pixel, by either way.
    assert!((sum / (6 * PIXELS) as f64).abs() < 0.02, "{sum}");
}

/// Fogs, the parts by their formulas of the distance, the errors of these, and how steep they are at most.
fn fogs() -> [(AnyFog, fn(f64) -> f64, f64, f64); 3] {
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

#[test]
fn fogs_on_stored_texels_are_as_near_as_they_say() {
    const MIST: u16 = 0x9cfb;
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

/// What is left out is as before.
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
    // No texel is like the background.
    let before = u32::from_ne_bytes([1, 2, 3, 4]);
    has_holes(Rgba8888, before, AlphaTest { surface, least: 150 }, |_, [.., a]| a >= 150);
    let stored = Stored(sampler(format::Rgba8888, &texels));
    has_holes(Rgba8888, before, AlphaTest { surface: stored, least: 150 }, |_, [.., a]| a >= 150);
    has_holes(Rgba8888, before, AlphaDither { surface, by: Bayer }, |place, [.., a]| {
        let threshold = (bayer(place.of_frame().map(|c| c % 8)) as f64 + 0.5) / 64.0;
        f64::from(a) / 255.0 > threshold
    });
    let keyed = ColorKey { surface: Stored(sampler(format::Rgb565, &words)), key: 0xf81f };
    let mist = 0x1234_u16;
    assert!(!words.contains(&mist.swap_bytes()));
    has_holes(Rgb565Be, mist, keyed, |_, texel| texel[..2] != KEY[..2]);
}
