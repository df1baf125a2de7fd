//! Polygons that snapping folds around each of their vertices: no fan of them is without a part that is turned over.

use super::super::*;
use crate::{AnyDepth, Mesh, Pass, Perspective, Sub4, Sub8, Subpixel, View};
use alberti_math::Frame;
use alberti_oracle::coverage::{area2, covers};
use alberti_oracle::rng::{Rng, run_seed};
use std::println;
use std::vec::Vec;

const SIZE: [u32; 2] = [320, 240];

/// The distances of vertices from the eye.
#[derive(Clone, Copy, Debug)]
enum Scale {
    /// Up to 100 near distances.
    Ordinary,
    /// From a hundredth of one to 10^5.
    Any,
}

/// Of random triangles about the eye, those that are clipped, those of them whose fan folds, and those that draw a
/// pixel twice.
fn counts(scale: Scale, subpixel: Subpixel, sides: Sides, stream: u64) -> [u64; 3] {
    let triangles = if std::env::var_os("ALBERTI_SWEEP").is_some() { 20_000_000 } else { 500_000 };
    let projection = Perspective::new(1.0, 4.0 / 3.0, 0.1, 100.0).expect("a pyramid");
    let view = View::new(Frame::IDENTITY, projection);
    let mesh = Mesh::new(&[Vec3::ZERO; 3], &[[0u16, 1, 2]], |&place| (place, ()));
    let pass = Pass::new(&view, &mesh, |()| Some(0u32)).sides(sides).subpixel(subpixel);
    let screen = pass.screen(SIZE, AnyDepth::D32).expect("pixels");
    let mut rng = Rng::stream(run_seed(), stream);
    let mut counts = [0; 3];
    for _ in 0..triangles {
        let mut coordinate = || match scale {
            #[expect(clippy::cast_possible_truncation, reason = "rounded on purpose")]
            Scale::Ordinary => rng.uniform(-10.0, 10.0) as f32,
            Scale::Any => rng.log_uniform(1e-3, 1e4) * if rng.one_in(2) { 1.0 } else { -1.0 },
        };
        let corners = [(); 3].map(|()| Vec3::new(coordinate(), coordinate(), coordinate()));
        let scaled = corners.map(|corner| Point3::new(screen.eye(One, corner.to_array()).into()));
        let mut polygon = in_terms_of_itself::<Vec3>(rotated(scaled, first_of(scaled)));
        cut(&screen, &mut polygon);
        if polygon.vertices().len() < 4 {
            continue;
        }
        let places = polygon.map(|v| screen.snapped([v.x, v.y]).map(Fixed::subpixels));
        let parts: Vec<_> =
            places.fan_around(unfolded(&places)).map(|part| part.map(|place| place.map(i64::from))).collect();
        let turned = |sign| parts.iter().any(|part| area2(*part).signum() == sign);
        counts[0] += 1;
        if turned(1) && turned(-1) {
            counts[1] += 1;
            counts[2] += u64::from(draws_twice(&parts, subpixel));
        }
    }
    counts
}

/// Whether a pixel of the frame is in two of the triangles.
fn draws_twice(parts: &[[[i64; 2]; 3]], subpixel: Subpixel) -> bool {
    let one = 1 << subpixel.bits();
    let mut all = (0..i64::from(SIZE[0] * SIZE[1])).map(|i| [i % i64::from(SIZE[0]), i / i64::from(SIZE[0])]);
    all.any(|pixel| {
        let sample = pixel.map(|c| c * one + one / 2);
        parts.iter().filter(|part| covers(**part, sample)).count() > 1
    })
}

/// The rates that `CONVENTIONS.md` states, with a margin: one in so many.
#[test]
fn fans_fold_as_rarely_as_is_said() {
    for (subpixel, scale, rate) in [
        (Sub4, Scale::Ordinary, 200_000),
        (Sub4, Scale::Any, 2000),
        (Sub8, Scale::Ordinary, 2_000_000),
        (Sub8, Scale::Any, 80_000),
    ] {
        for (sides, stream) in [(Sides::GuardBand, 1), (Sides::Cube, 2)] {
            let [clipped, folded, twice] = counts(scale, subpixel, sides, stream);
            println!(
                "{subpixel:?}, {scale:?}, {sides:?}: of {clipped} clipped {folded} fold, {twice} draw a pixel twice"
            );
            assert!(clipped > 100_000 && twice <= 3 + clipped / rate, "{twice} of {clipped}");
        }
    }
}
