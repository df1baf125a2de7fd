//! The cost of what comes after the fragment: blends, dithers, fogs and holes, on a tilted square of 1280x720 pixels
//! with one texel each; and of smooth edges by coverage and by supersampling, on a torus.
//!
//! Before a way is timed, its picture is held against the same drawn one sample at a time, which must not differ in a
//! bit. It is held against the formula in `f64` as well, from the picture without it. Figures are for written pixels,
//! of drawing alone. Those of smooth edges are for whole frames, clears included, and each way is held against the
//! other.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels, texels and bytes"
)]

use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::lanes::{Floating, Machine, One};
use alberti::raster::color::{
    Additive, Average, Bayer, Blended, BlueNoise, Constant, Dithered, Grey1, Grey2, Grey4, Grey8, InLight,
    Indexed, Multiply, Over, Premultiplied, Rgb332, Rgb444, Rgb666, Rgb888, Xrgb8888, resolve, rgb565,
};
use alberti::shaders::fog::{ExponentialFog, Fog, Fogged, LinearFog, SquaredFog};
use alberti::shaders::{AlphaDither, AlphaTest, ColorKey, Solid, Stored, StoredAlpha, Sunlit, Unlit};
use alberti::texture::format::{L8, Rgb565, Rgb565Alpha, Rgba8888 as Texels};
use alberti::texture::surface::{Grid, Parametric, Torus};
use alberti::texture::{Nearest, Repeat, TexelFormat as _, Texture};
use alberti::{
    Always, Bands, ColorFormat, Cull, F32, FragmentStage, Frame, Geometry, Mesh, Object, Pass, Perspective,
    Point3, Rgb565Le, Rgba8, Rgba8888, Silhouette, Slot, Stats, Target, Vector3, View, for_lanes,
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

/// The colour that is no colour.
const KEY: u16 = 0;

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

/// The greatest levels of a pixel of 16 bits.
const MOST: [f64; 3] = [31.0, 63.0, 31.0];

/// Red, green and blue of a pixel of 16 bits.
fn levels(pixel: u16) -> [f64; 3] {
    [pixel >> 11, pixel >> 5 & 63, pixel & 31].map(f64::from)
}

fn afterwards(criterion: &mut Criterion) {
    let texels = texels();
    let words: Vec<u16> = texels.iter().map(|&texel| rgb565(texel.into())).collect();
    let stored = Texture::new(Rgb565, &words, SIDE, SIDE).expect("a texture");
    let stored = Stored(stored.power_of_two().expect("a power of two").sampler(Nearest, Repeat));
    let ready: Vec<u32> = texels.iter().map(|&texel| Rgb565Alpha.encode(texel.into())).collect();
    let ready = Texture::new(Rgb565Alpha, &ready, SIDE, SIDE).expect("a texture");
    let ready = StoredAlpha(ready.power_of_two().expect("a power of two").sampler(Nearest, Repeat));
    let reds: Vec<u8> = texels.iter().map(|texel| texel[0]).collect();
    let indices = Texture::new(L8, &reds, SIDE, SIDE).expect("a texture");
    let indices = Stored(indices.power_of_two().expect("a power of two").sampler(Nearest, Repeat));
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

    let mut packed = vec![0; PIXELS];
    draw(One, Rgb565Le, &mut packed, &mut depth, bare, stored);

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
    let near = |k: usize, found: [f64; 3], greatest: [f64; 3]| {
        let texel = channels(plain[k]);
        (0..3).all(|c| (found[c] - texel[c] / 255.0 * greatest[c]).abs() < 1.0)
    };
    let grey = |k: usize| {
        let [r, g, b, _] = channels(plain[k]);
        0.299 * r + 0.587 * g + 0.114 * b
    };
    let dithered = |k: usize, found: u16| near(k, levels(found), MOST);
    // Of a mean in levels the share is rounded to 32nds.
    let mean565 = |k: usize, found: u16, share: f64| {
        let (texel, there) = (channels(plain[k]), levels(rgb565(BEFORE)));
        let mean = |c: usize| texel[c] / 255.0 * MOST[c] * share + there[c] * (1.0 - share);
        (0..3).all(|c| (mean(c) - levels(found)[c]).abs() < [1.5, 2.0, 1.5][c])
    };
    let keyed = |k: usize, found: u16| found == if packed[k] == KEY { 0 } else { packed[k] };
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
        "rgb565 over": Blended { format: Rgb565Le, by: Over }, rgb565(BEFORE), bare, surface,
            |k: usize, found: u16| mean565(k, found, channels(plain[k])[3] / 255.0);
        "rgb565 over, stored": Blended { format: Rgb565Le, by: Over }, rgb565(BEFORE), bare, ready,
            |k: usize, found: u16| mean565(k, found, channels(plain[k])[3] / 255.0);
        "rgb565 constant": Blended { format: Rgb565Le, by: Constant(51) }, rgb565(BEFORE), bare, surface,
            |k: usize, found: u16| mean565(k, found, 0.2);
        "rgb565 additive": Blended { format: Rgb565Le, by: Additive }, rgb565(BEFORE), bare, surface,
            |k: usize, found: u16| {
                let ([texel @ .., a], there) = (channels(plain[k]), levels(rgb565(BEFORE)));
                let sum = |c: usize| (texel[c] * a / 65025.0 + there[c] / MOST[c]).min(1.0) * MOST[c];
                (0..3).all(|c| (sum(c) - levels(found)[c]).abs() < 0.8)
            };
        "stored": Rgb565Le, 0, bare, stored, |k: usize, found: u16| found == packed[k];
        "color key": Rgb565Le, 0, bare, ColorKey { surface: stored, key: KEY }, keyed;
        "linear fog on stored": Rgb565Le, 0, |v: &_| misty(v, &|z| linear.coordinate(z)),
            Fogged { surface: stored, fog: linear, color: rgb565(MIST) },
            |k: usize, found: u16| {
                let z = f64::from(u32::from_ne_bytes(distances[k].to_ne_bytes())) / 65536.0;
                let fog = ((z - 2.0) / 2.0).clamp(0.0, 1.0);
                let [texel, mist, found] = [packed[k], rgb565(MIST), found].map(levels);
                (0..3).all(|c| (texel[c] * (1.0 - fog) + mist[c] * fog - found[c]).abs() < 2.0)
            };
        "rgb332": Rgb332, 0, bare, surface, |k: usize, found: u8| {
            near(k, [found >> 5, found >> 2 & 7, found & 3].map(f64::from), [7.0, 7.0, 3.0])
        };
        "rgb666": Rgb666, [0; 3], bare, surface, |k: usize, found: [u8; 3]| {
            near(k, found.map(|byte| f64::from(byte >> 2)), [63.0; 3])
        };
        "rgb444": Rgb444, [0; 2], bare, surface, |k: usize, [high, low]: [u8; 2]| {
            near(k, [high & 15, low >> 4, low & 15].map(f64::from), [15.0; 3])
        };
        "rgb888": Rgb888, [0; 3], bare, surface, |k: usize, found: [u8; 3]| found == plain[k].to_ne_bytes()[..3];
        "xrgb8888": Xrgb8888, 0, bare, surface, |k: usize, found: u32| {
            let [r, g, b, _] = plain[k].to_ne_bytes();
            found.to_le_bytes() == [b, g, r, 0]
        };
        "grey8": Grey8, 0, bare, surface, |k: usize, found: u8| (f64::from(found) - grey(k)).abs() < 1.0;
        "grey4 bayer": Dithered { format: Grey4, by: Bayer }, 0, bare, surface,
            |k: usize, found: u8| (f64::from(found) - grey(k) / 17.0).abs() < 1.1;
        "grey2 bayer": Dithered { format: Grey2, by: Bayer }, 0, bare, surface,
            |k: usize, found: u8| (f64::from(found) - grey(k) / 85.0).abs() < 1.1;
        "grey1 bayer": Dithered { format: Grey1, by: Bayer }, 0, bare, surface,
            |k: usize, found: u8| (f64::from(found) - grey(k) / 255.0).abs() < 1.1;
        "indexed": Indexed(&[Rgba8::BLACK, Rgba8::WHITE]), 0, bare, indices,
            |k: usize, found: u8| found == plain[k].to_ne_bytes()[0];
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
        "alpha dither blue noise": Rgba8888, before, bare, AlphaDither { surface, by: BlueNoise },
            |k, found| kept(k, found, true) || kept(k, found, false);
    }
    group.finish();
}

/// A torus over [`BEFORE`], with smooth edges in one of these ways.
#[derive(Clone, Copy, PartialEq)]
enum Edges {
    Plain,
    Coverage,
    /// So many samples on each side of a pixel.
    Supersampled(u32),
}

/// The buffers of a frame: colours, depths, words, and those of larger bands.
struct Buffers {
    color: Vec<u32>,
    depth: Vec<f32>,
    cells: Vec<i32>,
    samples: Vec<u32>,
}

fn frame<M: Geometry>(
    edges: Edges,
    pass: &mut Pass<'_, M, impl FragmentStage<M::Varying>>,
    average: Average,
    buffers: &mut Buffers,
) {
    let Buffers { color, depth, cells, samples } = buffers;
    if let Edges::Supersampled(factor) = edges {
        let [width, height] = [WIDTH, HEIGHT].map(|side| side * factor);
        let samples = &mut samples[..PIXELS.min((16 * factor * width) as usize)];
        let depth = &mut depth[..samples.len()];
        let mut bands = Bands::new(Rgba8888, F32, width, height, samples, depth).expect("bands");
        return bands.draw(BEFORE, |band| {
            pass.draw(band);
            let first = band.limits()[1].start / factor.cast_signed();
            let own = &mut color[(first * WIDTH.cast_signed()) as usize..];
            let from = (Rgba8888, band.pixels());
            resolve(from, (Rgba8888, own), WIDTH as usize, first, factor as usize, average);
        });
    }
    let mut target = Target::new(Rgba8888, F32, WIDTH, HEIGHT, color, depth).expect("buffers that fit");
    target.clear(BEFORE);
    pass.draw(&mut target);
    if edges == Edges::Coverage {
        let mut silhouette = Silhouette::new(&target, cells).expect("words");
        pass.cover(&mut silhouette);
        let coverage = silhouette.coverage();
        pass.draw_fringe(&mut target, &coverage);
        coverage.resolve(&mut target, average, |_| BEFORE);
    }
}

fn smooth_edges(criterion: &mut Criterion) {
    let ways = [
        ("plain", Edges::Plain),
        ("coverage", Edges::Coverage),
        ("supersampled 2x2", Edges::Supersampled(2)),
        ("supersampled 4x4", Edges::Supersampled(4)),
    ];
    let mut group = criterion.benchmark_group("smooth edges");
    for (columns, rows) in [(36, 18), (180, 90)] {
        let (torus, grid) = (Torus { major: 1.0, minor: 0.42 }, Grid::new(columns, rows));
        let turned = Mat3::from_rotation_x(0.9);
        let vertices: Vec<(Vec3, Vec3)> = (0..grid.vertices() as u32)
            .map(|k| {
                let frame = torus.orthonormal_frame(grid.uv(k));
                let position: Point3<Object> = frame.origin();
                (turned * position.coords + Vec3::Z * 4.2, turned * frame.axes().z_axis)
            })
            .collect();
        // As seen from the front, z forward.
        let triangles: Vec<[u32; 3]> = (0..grid.triangles() as u32)
            .map(|k| {
                let [a, b, c] = grid.triangle(k);
                [a, c, b]
            })
            .collect();
        let lens = Perspective::new(0.66, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0).expect("a perspective");
        let view = View::new(Frame::IDENTITY, lens);
        let mut buffers = Buffers {
            color: vec![0; PIXELS],
            depth: vec![0.0; PIXELS],
            cells: vec![0; PIXELS + 1024 * Silhouette::PLACE],
            samples: vec![0; PIXELS],
        };
        // In one colour, each way is nearer to the finest than the ways before.
        let solid = Mesh::new(&vertices, &triangles, |v: &(Vec3, Vec3)| (v.0, ()));
        let pictures = ways.map(|(_, edges)| {
            let mut slots = vec![Slot::EMPTY; vertices.len()];
            let mut pass = Pass::new(&view, &solid, Solid(Rgba8::WHITE)).slots(&mut slots);
            frame(edges, &mut pass, Average::Bytes, &mut buffers);
            buffers.color.clone()
        });
        let off = |picture: &[u32]| -> f64 {
            let pairs = picture.iter().zip(&pictures[3]);
            pairs.map(|(a, b)| (channels(*a)[0] - channels(*b)[0]).abs()).sum()
        };
        let [plain, coverage, coarse, _] = [0, 1, 2, 3].map(|k: usize| off(&pictures[k]));
        assert!(coverage * 5.0 < plain && coverage < coarse, "{plain} {coverage} {coarse}");

        let lit = Mesh::new(&vertices, &triangles, |v: &(Vec3, Vec3)| (v.0, (v.1, ())));
        let stage = Sunlit::new(Solid(MIST), Vector3::new(Vec3::new(0.4, 0.7, -0.6)), 0.25, 0.8);
        group.throughput(Throughput::Elements(PIXELS as u64));
        for (name, edges) in ways {
            let mut slots = vec![Slot::EMPTY; vertices.len()];
            let mut pass = Pass::new(&view, &lit, stage).slots(&mut slots);
            group.bench_function(format!("{name}/{} triangles", triangles.len()), |bencher| {
                bencher.iter(|| frame(edges, &mut pass, Average::Light, &mut buffers));
            });
        }
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(2));
    targets = afterwards, smooth_edges
}
criterion_main!(benches);
