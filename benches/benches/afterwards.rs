//! The cost of what comes after the fragment: blends, dithers, fogs and holes, on a tilted square of 1280x720 pixels
//! with one texel each.
//!
//! Before a way is timed, its picture is held against the same drawn one sample at a time, which must not differ in a
//! bit. It is held against the formula in `f64` as well, from the picture without it. Figures are for written pixels,
//! of drawing alone.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels, texels and bytes"
)]

use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Floating, Machine, One};
use alberti::raster::color::{
    Additive, Bayer, Blended, BlueNoise, Constant, Dithered, InLight, Multiply, Over, Premultiplied,
};
use alberti::shaders::fog::{ExponentialFog, Fog, Fogged, LinearFog, SquaredFog};
use alberti::shaders::{AlphaDither, AlphaTest, Unlit};
use alberti::texture::format::Rgba8888 as Texels;
use alberti::texture::{Nearest, Repeat, Texture};
use alberti::{
    Always, ColorFormat, Cull, F32, FragmentStage, Frame, Mesh, Pass, Perspective, Rgb565Le, Rgba8, Rgba8888,
    Stats, Target, View, for_lanes,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 720;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;
const SIDE: u32 = 256;

/// What was there before.
const BEFORE: Rgba8 = Rgba8::new(40, 120, 200, 255);
/// The fog's colour.
const MIST: Rgba8 = Rgba8::new(150, 160, 170, 255);

/// The square's corners: a place, its distance and its texture coordinates.
const CORNERS: [(Vec3, Vec2); 4] = [
    (Vec3::new(-4.0, -1.6, 2.0), Vec2::new(0.0, 0.0)),
    (Vec3::new(4.0, -1.6, 2.0), Vec2::new(4.0, 0.0)),
    (Vec3::new(8.0, 3.2, 4.0), Vec2::new(4.0, 4.0)),
    (Vec3::new(-8.0, 3.2, 4.0), Vec2::new(0.0, 4.0)),
];

/// Draws the square over [`BEFORE`], and returns the number of pixels that are written.
fn draw<C: ColorFormat<Pixel: Default>, V: alberti::Varying>(
    lanes: impl Floating,
    format: C,
    color: &mut [C::Pixel],
    depth: &mut [f32],
    vertex_stage: impl Fn(&(Vec3, Vec2)) -> (Vec3, V),
    stage: impl FragmentStage<V>,
) -> u64 {
    let mesh = Mesh::new(&CORNERS, &[[0_u16, 1, 2], [0, 2, 3]], vertex_stage);
    let lens = Perspective::new(1.2, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0).expect("a perspective");
    let view = View::new(Frame::IDENTITY, lens);
    let mut target = Target::new(format, Always(F32), WIDTH, HEIGHT, color, depth).expect("buffers that fit");
    let mut stats = Stats::default();
    Pass::new(&view, &mesh, stage).cull(Cull::None).count_by(lanes, &mut target, &mut stats);
    stats.written
}

/// Colours with any alpha, of which none is greater than it.
fn texels() -> Vec<[u8; 4]> {
    let noise = |k: u32| (k.wrapping_mul(0x9e37_79b1) ^ k.wrapping_mul(0x85eb_ca77) >> 11).to_le_bytes();
    let texel = |k| {
        let [r, g, b, a] = noise(k);
        [r.min(a), g.min(a), b.min(a), a]
    };
    (0..SIDE * SIDE).map(texel).collect()
}

/// The colour of a pixel in bytes, as numbers.
type Channels = [f64; 4];

fn channels(pixel: u32) -> Channels {
    pixel.to_ne_bytes().map(f64::from)
}

fn afterwards(criterion: &mut Criterion) {
    let texels = texels();
    let texture = Texture::new(Texels, &texels, SIDE, SIDE).expect("a texture");
    let texture = texture.power_of_two().expect("a power of two").sampler(Nearest, Repeat);
    let surface = Unlit(texture);
    let bare = |&(place, uv): &(Vec3, Vec2)| (place, uv);
    let machine = Machine::all().next().expect("every machine has lanes");
    let mut depth = vec![1.0; PIXELS];
    let before = u32::from_ne_bytes(BEFORE.to_bytes());
    // The colours of the texels, and where there are any.
    let mut plain = vec![before; PIXELS];
    let covered = draw(One, Rgba8888, &mut plain, &mut depth, bare, surface);
    let mut distances = vec![0; PIXELS];
    let tell = |distance: f32| Some(Rgba8::from_bits((distance * 65536.0) as u32));
    draw(One, Rgba8888, &mut distances, &mut depth, |v| (v.0, v.0.z), tell);

    let mut group = criterion.benchmark_group("afterwards");
    macro_rules! rows {
        ($($name:literal: $format:expr, $background:expr, $vertex:expr, $stage:expr, $check:expr;)+) => {$({
            let background = vec![$background; PIXELS];
            let (mut alone, mut color) = (background.clone(), background.clone());
            let written = draw(One, $format, &mut alone, &mut depth, $vertex, $stage);
            for_lanes!(machine, lanes => draw(lanes, $format, &mut color, &mut depth, $vertex, $stage));
            assert!(color == alone, "{}: one lane draws another picture", $name);
            let check = $check;
            let wrong = (0..PIXELS).filter(|&k| distances[k] != 0 && !check(k, color[k])).count();
            assert_eq!(wrong, 0, "{}: pixels are wrong, of {covered}", $name);
            group.throughput(Throughput::Elements(covered));
            group.bench_function($name, |bencher| {
                bencher.iter(|| {
                    for_lanes!(machine, lanes => draw(lanes, $format, &mut color, &mut depth, $vertex, $stage))
                });
            });
            let _ = written;
        })+};
    }
    // The formula of a blend, of texel and background as numbers from 0 to 1, holds within a byte.
    let blend = |formula: fn(f64, f64, f64) -> f64| {
        let plain = &plain;
        move |k: usize, found: u32| {
            let (texel, there) = (channels(plain[k]), channels(before));
            (0..3).all(|c| {
                let right = formula(texel[c] / 255.0, there[c] / 255.0, texel[3] / 255.0).clamp(0.0, 1.0);
                (channels(found)[c] - 255.0 * right).abs() < 1.01
            })
        }
    };
    let light = |c: f64| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    let byte = |c: f64| if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    // Dithered levels are one of the two about the colour.
    let dithered = |k: usize, found: u16| {
        let levels = [found >> 11, found >> 5 & 63, found & 31].map(f64::from);
        let texel = channels(plain[k]);
        (0..3).all(|c| (levels[c] - texel[c] / 255.0 * [31.0, 63.0, 31.0][c]).abs() < 1.0)
    };
    // A fog's amount, of the distance.
    let fogged = |amount: fn(f64) -> f64| {
        let (plain, distances) = (&plain, &distances);
        move |k: usize, found: u32| {
            let fog = amount(f64::from(u32::from_ne_bytes(distances[k].to_ne_bytes())) / 65536.0);
            let (texel, mist) = (channels(plain[k]), channels(u32::from_ne_bytes(MIST.to_bytes())));
            let near = |c: usize| (channels(found)[c] - (texel[c] * (1.0 - fog) + mist[c] * fog)).abs() < 2.0;
            (0..3).all(near)
        }
    };
    let misty = |vertex: &(Vec3, Vec2), fog: &dyn Fn(f32) -> f32| (vertex.0, (fog(vertex.0.z), vertex.1));
    let linear = LinearFog { start: 2.0, end: 4.0 };
    let exponential = ExponentialFog { density: 0.4 };
    let squared = SquaredFog { density: 0.4 };
    let kept = |k: usize, found: u32, kept: bool| found == if kept { plain[k] } else { before };
    rows! {
        "replace": Rgba8888, before, bare, surface, |k: usize, found: u32| found == plain[k];
        "over": Blended { format: Rgba8888, by: Over }, before, bare, surface, blend(|s, d, a| s * a + d * (1.0 - a));
        "premultiplied": Blended { format: Rgba8888, by: Premultiplied }, before, bare, surface,
            blend(|s, d, a| s + d * (1.0 - a));
        "constant": Blended { format: Rgba8888, by: Constant(51) }, before, bare, surface,
            blend(|s, d, _| s * 0.2 + d * 0.8);
        "additive": Blended { format: Rgba8888, by: Additive }, before, bare, surface, blend(|s, d, a| s * a + d);
        "multiply": Blended { format: Rgba8888, by: Multiply }, before, bare, surface, blend(|s, d, _| s * d);
        "over in light": Blended { format: Rgba8888, by: InLight(Over) }, before, bare, surface,
            |k: usize, found: u32| {
                let (texel, there) = (channels(plain[k]), channels(before));
                let a = texel[3] / 255.0;
                let mixed = |c: usize| byte(light(texel[c] / 255.0) * a + light(there[c] / 255.0) * (1.0 - a));
                (0..3).all(|c| (channels(found)[c] - 255.0 * mixed(c)).abs() < 1.5)
            };
        "rgb565": Rgb565Le, 0, bare, surface, dithered;
        "rgb565 bayer": Dithered { format: Rgb565Le, by: Bayer }, 0, bare, surface, dithered;
        "rgb565 blue noise": Dithered { format: Rgb565Le, by: BlueNoise }, 0, bare, surface, dithered;
        "linear fog": Rgba8888, before, |v: &_| misty(v, &|z| linear.coordinate(z)),
            Fogged { surface, fog: linear, color: MIST }, fogged(|z| ((z - 2.0) / 2.0).clamp(0.0, 1.0));
        "exponential fog": Rgba8888, before, |v: &_| misty(v, &|z| exponential.coordinate(z)),
            Fogged { surface, fog: exponential, color: MIST }, fogged(|z| 1.0 - (-0.4 * z).exp());
        "squared fog": Rgba8888, before, |v: &_| misty(v, &|z| squared.coordinate(z)),
            Fogged { surface, fog: squared, color: MIST }, fogged(|z| 1.0 - (-(0.4 * z).powi(2)).exp());
        "alpha test": Rgba8888, before, bare, AlphaTest { surface, least: 128 },
            |k, found| kept(k, found, channels(plain[k])[3] >= 128.0);
        "alpha dither": Rgba8888, before, bare, AlphaDither { surface, by: Bayer },
            |k, found| kept(k, found, true) || kept(k, found, false);
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(2));
    targets = afterwards
}
criterion_main!(benches);
