//! After the fragment: colours that are mixed with those that are there or rounded by a pattern, depths with a bias,
//! and holes. Each against plain drawing, fragment by fragment, and the same bits by any lanes and in any pieces.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "colours are bytes, and frames are small"
)]

use alberti::glam::Vec3;
use alberti::shaders::{AlphaDither, AlphaTest, Solid};
use alberti_math::lanes::{Floating, One};
use alberti_math::{Fixed, Rgb565Be, Rgba8, Rgba565, Sub8};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::color::{
    AnyBlend, Bayer, Blended, BlueNoise, Dithered, InLight, Over, ReadColor, Rgb332, Rgb888,
};
use alberti_raster::{
    Affine, Biased, ColorFormat, Cull, D16, DepthFormat, Exact, F32, F32Reversed, FixedPoint, FragmentStage,
    Interpolation, NoDepth, Paint, Rgba8888, Spans16, Target, Vertex,
};
use alberti_tests::for_widest;
use alberti_tests::random::triangle;

const WIDTH: usize = 101;
const HEIGHT: usize = 70;
const SIZE: [u32; 2] = [WIDTH as u32, HEIGHT as u32];
const TRIANGLES: usize = 60;

/// A colour whose alpha changes as well.
fn shade(v: Vec3) -> Option<Rgba8> {
    let [r, g, b] = v.to_array().map(|x| ((x * 0.5 + 0.5) * 255.0) as u8);
    Some(Rgba8::new(r, g, b, r.wrapping_mul(3) ^ b))
}

fn triangles(seed: u64) -> Vec<[Vertex<Vec3>; 3]> {
    let mut rng = Rng::new(seed);
    (0..TRIANGLES).map(|_| triangle(&mut rng)).collect()
}

/// The pixels after drawing, over a background that is everywhere another.
fn drawn<C: ColorFormat>(
    format: C,
    interpolation: impl Interpolation,
    lanes: impl Floating,
    triangles: &[[Vertex<Vec3>; 3]],
    pieces: &[[usize; 4]],
) -> Vec<C::Pixel> {
    drawn_by(shade, format, interpolation, lanes, (triangles, pieces))
}

/// The same by another stage.
fn drawn_by<C: ColorFormat>(
    stage: impl FragmentStage<Vec3>,
    format: C,
    interpolation: impl Interpolation,
    lanes: impl Floating,
    (triangles, pieces): (&[[Vertex<Vec3>; 3]], &[[usize; 4]]),
) -> Vec<C::Pixel> {
    let mut color: Vec<C::Pixel> = (0..WIDTH * HEIGHT).map(|k| format.pixel(background(k))).collect();
    let mut depth = vec![(); color.len()];
    let paint = Paint { stage, interpolation, subpixel: Sub8, cull: Cull::None };
    for &[left, right, top, bottom] in pieces {
        let (color, depth) =
            (&mut color[top * WIDTH..bottom * WIDTH], &mut depth[top * WIDTH..bottom * WIDTH]);
        let mut band = Target::band(format, NoDepth, SIZE, top as u32, color, depth).expect("rows");
        let mut piece = band.scissor(left as i32..right as i32, 0..i32::MAX);
        for [a, b, c] in triangles {
            paint.triangle(lanes, &mut piece, [a, b, c], &mut ());
        }
    }
    color
}

const WHOLE: [[usize; 4]; 1] = [[0, WIDTH, 0, HEIGHT]];
const PIECES: [[usize; 4]; 5] =
    [[0, 13, 0, 9], [13, WIDTH, 0, 9], [0, WIDTH, 9, 10], [0, 64, 10, HEIGHT], [64, WIDTH, 10, HEIGHT]];

fn background(k: usize) -> Rgba8 {
    Rgba8::new((k * 5) as u8, (k / 3) as u8, (k * k) as u8, (k * 11) as u8)
}

/// The same bits by one lane and by several, in one piece and in some.
fn same_bits<C: ColorFormat<Pixel: PartialEq>>(format: C, interpolation: impl Interpolation, stream: u64) {
    same_bits_by(shade, format, interpolation, stream);
}

/// The same by another stage.
fn same_bits_by<C: ColorFormat<Pixel: PartialEq>>(
    stage: impl FragmentStage<Vec3>,
    format: C,
    interpolation: impl Interpolation,
    stream: u64,
) {
    let all = &triangles(run_seed() ^ stream << 32);
    let whole = drawn_by(stage, format, interpolation, One, (all, &WHOLE));
    let pieces = for_widest!(lanes => drawn_by(stage, format, interpolation, lanes, (all, &PIECES)));
    assert!(whole == pieces, "{format:?}");
    let untouched = drawn_by(stage, format, interpolation, One, (&[], &WHOLE));
    let changed = whole.iter().zip(&untouched).filter(|(a, b)| a != b).count();
    assert!(changed > 3000, "next to nothing was drawn");
}

#[test]
fn lanes_and_pieces_change_no_bit() {
    same_bits(Blended { format: Rgba8888, by: AnyBlend::Premultiplied }, Exact, 1);
    same_bits(Blended { format: Rgb565Be, by: Over }, Exact, 2);
    same_bits(Dithered { format: Rgb332, by: BlueNoise }, Exact, 3);
    same_bits(Blended { format: Dithered { format: Rgb888, by: Bayer }, by: InLight(Over) }, Exact, 4);
    // Colours that are ready to be drawn over.
    let ready = |v: Vec3| shade(v).map(Rgba565::new);
    same_bits_by(ready, Blended { format: Rgb565Be, by: Over }, Exact, 5);
    same_bits_by(ready, Blended { format: Rgb565Be, by: Over }, FixedPoint(Spans16), 6);
}

/// Each triangle drawn alone says where its fragments are and what they are; by the definition each is mixed with what
/// was there before.
fn is_mixed_one_by_one(
    by: AnyBlend,
    interpolation: impl Interpolation,
    stream: u64,
    expected: fn([f64; 4], [f64; 4]) -> [f64; 4],
) {
    let all = triangles(run_seed() ^ stream << 32);
    let mut right: Vec<Rgba8> = (0..WIDTH * HEIGHT).map(background).collect();
    for one in &all {
        let alone = drawn(Rgba8888, interpolation, One, std::slice::from_ref(one), &WHOLE);
        // A colour that is not the background's, as no fragment is likely to have all of its bytes.
        for (k, (pixel, right)) in alone.into_iter().zip(&mut right).enumerate() {
            let new = Rgba8888.color(pixel);
            if new != background(k) {
                let [new, old] =
                    [new, *right].map(|color| color.to_bytes().map(|byte| f64::from(byte) / 255.0));
                let [r, g, b, a] = expected(new, old).map(|part| (part * 255.0).round() as u8);
                *right = Rgba8::new(r, g, b, a);
            }
        }
    }
    let found = drawn(Blended { format: Rgba8888, by }, interpolation, One, &all, &WHOLE);
    let wrong =
        found.into_iter().zip(right).filter(|(found, right)| Rgba8888.color(*found) != *right).count();
    // But for pixels that happen to be as the background.
    assert!(wrong <= 2, "{by:?}: {wrong} pixels");
}

fn rounded(part: f64) -> f64 {
    (part * 255.0).round() / 255.0
}

#[test]
fn fragments_are_mixed_with_what_is_there() {
    fn over(n: [f64; 4], o: [f64; 4], a: f64) -> [f64; 4] {
        let mixed = |k: usize| n[k] * a + o[k] * (1.0 - a);
        [mixed(0), mixed(1), mixed(2), a + o[3] * (1.0 - a)]
    }
    is_mixed_one_by_one(AnyBlend::Over, Exact, 10, |n, o| over(n, o, n[3]));
    is_mixed_one_by_one(AnyBlend::Over, FixedPoint(Spans16), 11, |n, o| over(n, o, n[3]));
    is_mixed_one_by_one(AnyBlend::Constant(51), Exact, 12, |n, o| over(n, o, 0.2));
    is_mixed_one_by_one(AnyBlend::Multiply, FixedPoint(Spans16), 13, |n, o| {
        [n[0] * o[0], n[1] * o[1], n[2] * o[2], o[3]]
    });
    is_mixed_one_by_one(AnyBlend::Additive, Exact, 14, |n, o| {
        let sum = |k: usize| (rounded(n[k] * n[3]) + o[k]).min(1.0);
        [sum(0), sum(1), sum(2), o[3]]
    });
}

/// A screen of two triangles about whose plane zs is 0.5, tilted, and another division of a part of it.
fn plane(corners: [[f32; 2]; 4]) -> [[Vertex<()>; 3]; 2] {
    let vertex = |[x, y]: [f32; 2]| Vertex {
        x: Fixed::from_bits(((x * 65_536.0) as i32).cast_unsigned()),
        y: Fixed::from_bits(((y * 65_536.0) as i32).cast_unsigned()),
        zs: 0.3 + x * 0.003 + y * 0.001,
        q: 1.0,
        varying: (),
    };
    let [a, b, c, d] = corners.map(vertex);
    [[a, b, c], [a, c, d]]
}

/// The pixels of a decal that are seen, and those that it covers.
fn seen<D: DepthFormat>(
    format: D,
    decal: impl DepthFormat<Stored = D::Stored>,
    interpolation: impl Interpolation,
    lanes: impl Floating,
) -> [usize; 2] {
    let wall = plane([[0.0, 0.0], [100.0, 3.0], [97.0, 69.0], [1.0, 66.0]]);
    let sticker = plane([[20.3, 11.7], [71.1, 19.9], [63.3, 51.2], [17.4, 40.6]]);
    let (mut color, mut depth) = (vec![0; WIDTH * HEIGHT], vec![format.farthest(); WIDTH * HEIGHT]);
    let mut target =
        Target::new(Rgba8888, format, SIZE[0], SIZE[1], &mut color, &mut depth).expect("a frame");
    let by = |stage| Paint { stage, interpolation, subpixel: Sub8, cull: Cull::None };
    let [black, white] = [Solid(Rgba8::BLACK), Solid(Rgba8::WHITE)];
    for [a, b, c] in &wall {
        by(black).triangle(lanes, &mut target, [a, b, c], &mut ());
    }
    for [a, b, c] in &sticker {
        by(white).triangle(lanes, &mut target.with_depth(decal), [a, b, c], &mut ());
    }
    let count = |pixels: &[u32]| pixels.iter().filter(|pixel| **pixel == u32::MAX).count();
    let shown = count(target.pixels());
    for [a, b, c] in &sticker {
        let mut target = target.with_depth(alberti_raster::Always(format));
        by(white).triangle(lanes, &mut target, [a, b, c], &mut ());
    }
    [shown, count(&color)]
}

#[test]
fn a_bias_settles_who_is_seen() {
    fn settled<D: DepthFormat>(format: D, interpolation: impl Interpolation) {
        let bias = |constant, slope| Biased { format, constant, slope, clamp: 0.0 };
        let by = |decal| for_widest!(lanes => seen(format, decal, interpolation, lanes));
        let [shown, all] = by(bias(0.0, 0.0));
        assert!(all > 1500 && shown < all, "{format:?}: without a bias {shown} of {all} are seen");
        assert_eq!(by(bias(-2.0, -0.5)), [all; 2], "{format:?}: nearer");
        assert_eq!(by(bias(2.0, 0.5)), [0, all], "{format:?}: farther");
        // Half of a slope is no more than half of a pixel's.
        assert_eq!(seen(format, bias(-2.0, -0.5), interpolation, One), [all; 2]);
    }
    settled(F32, Exact);
    settled(F32Reversed, Affine);
    settled(D16, FixedPoint(Spans16));
}

/// What a stage leaves out keeps colour and depth.
#[test]
fn holes_have_no_depth() {
    fn holes(stage: impl FragmentStage<(), Color = Rgba8>, interpolation: impl Interpolation) -> usize {
        let (mut color, mut depth) = (vec![7; WIDTH * HEIGHT], vec![u16::MAX; WIDTH * HEIGHT]);
        let mut target =
            Target::new(Rgba8888, D16, SIZE[0], SIZE[1], &mut color, &mut depth).expect("a frame");
        let paint = Paint { stage, interpolation, subpixel: Sub8, cull: Cull::None };
        for [a, b, c] in &plane([[0.0, 0.0], [101.0, 0.0], [101.0, 70.0], [0.0, 70.0]]) {
            for_widest!(lanes => paint.triangle(lanes, &mut target, [a, b, c], &mut ()));
        }
        for (color, depth) in color.iter().zip(&depth) {
            assert_eq!(*color == 7, *depth == u16::MAX);
        }
        color.iter().filter(|color| **color == 7).count()
    }
    let half = Solid(Rgba8::new(200, 100, 50, 128));
    for least in [128, 129] {
        let stage = AlphaTest { surface: half, least };
        assert_eq!(holes(stage, Exact), if least == 128 { 0 } else { WIDTH * HEIGHT });
    }
    let stage = AlphaDither { surface: half, by: Bayer };
    let left = holes(stage, Exact);
    assert!(left.abs_diff(WIDTH * HEIGHT / 2) < WIDTH && left == holes(stage, FixedPoint(Spans16)), "{left}");
}
