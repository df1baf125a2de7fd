//! Policies that are values draw the bits of those that are types: [`AnyDepth`] those of each format,
//! [`Lines`] those of [`Spans16`] and [`Affine`], in `f32` and in fixed point.
//!
//! The other tests draw by values, whose kernels are few. This file has the kernels of the types, each beside its
//! value: the same random triangles, with one lane and with each kind of lanes that the machine has.
#![allow(clippy::cast_possible_truncation, reason = "a small frame")]

use alberti::glam::Vec3;
use alberti::lanes::{Floating, Machine, One};
use alberti::{
    Affine, AnyDepth, Cull, D16, D24, D32, DepthFormat, Equal, Exact, F32, F32Reversed, Farther, Fixed,
    FixedPoint, Interpolation, Lines, NoDepth, OrEqual, ReadOnly, Rgba8888, Spans16, Sub8, Subpixel, Target,
    for_lanes,
};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::{Paint, Vertex};
use alberti_tests::narrow::Narrow;
use alberti_tests::random::triangle;
use std::ops::Range;

const WIDTH: usize = 101;
const HEIGHT: usize = 70;
/// Frames of each pair, each with other triangles.
const FRAMES: u64 = 12;
const TRIANGLES: usize = 400;

/// The triangles of a frame: those in the second half of the list again are drawn by a second pass.
fn triangles(seed: u64, subpixel: Subpixel) -> Vec<[Vertex<Vec3>; 3]> {
    let mut rng = Rng::new(seed);
    let coarser = 8 - subpixel.bits();
    let on_grid = |c: Fixed| Fixed::from_subpixels(c.subpixels() >> coarser).expect("a smaller number");
    (0..TRIANGLES + TRIANGLES / 2)
        .map(|_| triangle(&mut rng).map(|v| Vertex { x: on_grid(v.x), y: on_grid(v.y), ..v }))
        .collect()
}

/// Paints triangles over each other, in colours with every bit of the varying and of `salt`.
fn paint<D: DepthFormat>(
    policies: (impl Interpolation, Subpixel),
    lanes: impl Floating,
    target: &mut Target<'_, Rgba8888, D>,
    triangles: &[[Vertex<Vec3>; 3]],
    salt: u32,
) {
    let stage = |v: Vec3| {
        let bits = v.to_array().map(f32::to_bits);
        let word = salt ^ bits[0] ^ bits[1].rotate_left(9) ^ bits[2].rotate_left(21);
        (bits[0] & 7 != 3).then_some(word)
    };
    let paint =
        Paint { stage: Narrow(stage), interpolation: policies.0, subpixel: policies.1, cull: Cull::None };
    for [a, b, c] in triangles {
        paint.triangle(lanes, target, [a, b, c], &mut ());
    }
}

/// A frame of two passes: the first with the plain format, the second, of which half the triangles are the first's
/// again, with one for the same memory.
fn frame<D: DepthFormat, E: DepthFormat<Stored = D::Stored>>(
    (plain, compared): (D, E),
    policies: (impl Interpolation, Subpixel),
    lanes: impl Floating,
    seed: u64,
) -> (Vec<u32>, Vec<D::Stored>) {
    let (mut color, mut depth) = (vec![0; WIDTH * HEIGHT], vec![plain.farthest(); WIDTH * HEIGHT]);
    let (width, height) = (WIDTH as u32, HEIGHT as u32);
    let mut target = Target::new(Rgba8888, plain, width, height, &mut color, &mut depth).expect("a frame");
    let all = triangles(seed, policies.1);
    let [first, second]: [Range<usize>; 2] = [0..TRIANGLES, TRIANGLES / 2..TRIANGLES + TRIANGLES / 2];
    paint(policies, lanes, &mut target, &all[first], 0);
    paint(policies, lanes, &mut target.with_depth(compared), &all[second], 0x5a5a_5a5a);
    (color, depth)
}

/// Asserts that two choices of policies draw the same, depths after `word` has made the same words of them.
fn assert_same<D, E, F, G>(
    stream: u64,
    typed: ((D, E), (impl Interpolation, Subpixel)),
    value: ((F, G), (impl Interpolation, Subpixel)),
    word: impl Fn(D::Stored) -> u32,
) where
    D: DepthFormat,
    E: DepthFormat<Stored = D::Stored>,
    F: DepthFormat<Stored = u32>,
    G: DepthFormat<Stored = u32>,
{
    let alike = |(color, depth): (Vec<u32>, Vec<D::Stored>)| {
        (color, depth.into_iter().map(&word).collect::<Vec<u32>>())
    };
    for part in 0..FRAMES {
        let seed = run_seed() ^ part ^ stream << 32;
        let expected = frame(value.0, value.1, One, seed);
        let drawn = expected.0.iter().filter(|&&pixel| pixel != 0).count();
        assert!(drawn > 3000, "next to nothing was drawn");
        assert!(alike(frame(typed.0, typed.1, One, seed)) == expected, "{typed:?}, {value:?}, one lane");
        for machine in Machine::all() {
            let [found, same] = for_lanes!(machine, lanes => [
                alike(frame(typed.0, typed.1, lanes, seed)),
                frame(value.0, value.1, lanes, seed),
            ]);
            assert!(found == expected, "{typed:?}, {machine:?}");
            assert!(same == expected, "{value:?}, {machine:?}");
        }
    }
}

#[test]
fn any_depth_is_each_of_the_formats() {
    let exact = (Exact, Sub8);
    let any = |format: AnyDepth| ((format, format), exact);
    assert_same(1, ((D16, D16), exact), any(AnyDepth::D16), u32::from);
    assert_same(2, ((D24, D24), exact), any(AnyDepth::D24), |depth| depth);
    assert_same(3, ((D32, D32), exact), any(AnyDepth::D32), |depth| depth);
    assert_same(4, ((F32, F32), exact), any(AnyDepth::F32), |depth: f32| depth.to_bits());
    assert_same(5, ((F32Reversed, F32Reversed), exact), any(AnyDepth::F32Reversed), |depth: f32| {
        !depth.to_bits()
    });
}

/// The one that has no memory, and whose value has some.
#[test]
fn any_depth_is_also_none() {
    let exact = (Exact, Sub8);
    let value = ((AnyDepth::NoDepth, AnyDepth::NoDepth), exact);
    assert_same(6, ((NoDepth, NoDepth), exact), value, |_depth| 0);
}

#[test]
fn comparisons_around_any_depth_are_those_around_the_formats() {
    let exact = (Exact, Sub8);
    let any = AnyDepth::D16;
    assert_same(7, ((D16, OrEqual(D16)), exact), ((any, OrEqual(any)), exact), u32::from);
    assert_same(8, ((D16, Equal(D16)), exact), ((any, Equal(any)), exact), u32::from);
    let any = AnyDepth::F32Reversed;
    let typed = ((F32Reversed, Farther(F32Reversed)), exact);
    assert_same(9, typed, ((any, Farther(any)), exact), |depth: f32| !depth.to_bits());
    let any = AnyDepth::F32;
    assert_same(10, ((F32, ReadOnly(F32)), exact), ((any, ReadOnly(any)), exact), |depth: f32| {
        depth.to_bits()
    });
}

#[test]
fn lines_are_spans_and_affine() {
    let depth = (AnyDepth::D16, AnyDepth::D16);
    let spans = Lines::spans(16).expect("a power of two");
    assert_same(15, (depth, (Spans16, Sub8)), (depth, (spans, Sub8)), |depth| depth);
    assert_same(16, (depth, (Affine, Sub8)), (depth, (Lines::affine(), Sub8)), |depth| depth);
    let typed = (depth, (FixedPoint(Spans16), Sub8));
    assert_same(17, typed, (depth, (FixedPoint(spans), Sub8)), |depth| depth);
    let typed = (depth, (FixedPoint(Affine), Sub8));
    assert_same(18, typed, (depth, (FixedPoint(Lines::affine()), Sub8)), |depth| depth);
}
