//! Texels that are mixed by the eye, `TexelDither`: how often each is drawn among neighbours, against the weights that
//! bilinear and trilinear filters give it in `f64`.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "small"
)]

use alberti::glam::Vec2;
use alberti::raster::{FragmentStage, Fragments, Gradient};
use alberti::shaders::TexelDither;
use alberti::texture::format::L8;
use alberti::texture::{Bilinear, Mipmap, Repeat, Texture, Trilinear};
use alberti_math::lanes::{Lanes, One, OneFixed};
use alberti_oracle::{sampling, scene};

/// The thresholds, and what rounding adds to shares, of texels in 256ths and of levels in 32nds.
const THRESHOLDS: [f64; 4] = [1.0 / 8.0, 3.0 / 8.0, 5.0 / 8.0, 7.0 / 8.0];
const ROUNDED: [f64; 2] = [1.0 / 512.0, 1.0 / 64.0];

/// How far from a threshold is on either side of it, for coordinates in texels and for λ.
const BESIDE: [f64; 2] = [1.0 / 512.0, 1.0 / 256.0];

/// Weights of all texels of a square level at a place, by samples of images in which one is white.
fn weights(images: &[Vec<[u8; 4]>], side: u32, uv: [f64; 2]) -> Vec<f64> {
    let weight = |texels: &Vec<[u8; 4]>| {
        let image = scene::Texture { width: side, height: side, texels };
        sampling::sample(&image, uv, scene::Filter::Bilinear, scene::Wrap::Repeat)[0] / 255.0
    };
    images.iter().map(weight).collect()
}

/// An image for each texel.
fn images(side: u32) -> Vec<Vec<[u8; 4]>> {
    let texels = (side * side) as usize;
    (0..texels).map(|white| (0..texels).map(|k| [255 * u8::from(k == white); 4]).collect()).collect()
}

/// Coordinates in a texture, in steps of 2^-16, beside all places where another texel of one of the levels is drawn.
/// Between these, weights of texels are linear along u, along v and along λ. So the error is greatest at such a place.
fn beside_thresholds(sides: &[u32]) -> Vec<f32> {
    let mut found = Vec::new();
    for side in sides.iter().map(|&side| f64::from(side)) {
        for texel in 0..side as u32 {
            for threshold in THRESHOLDS {
                let place = f64::from(texel) + 0.5 + threshold - ROUNDED[0];
                for beside in [-BESIDE[0], BESIDE[0]] {
                    found.push((((place + beside) / side * 65536.0).round() / 65536.0) as f32);
                }
            }
        }
    }
    found
}

/// How often texels are drawn in a block of pixels that have the same coordinates.
fn drawn<L: Lanes<Mask = bool>>(
    lanes: L,
    stage: impl FragmentStage<Vec2>,
    uv: [f32; 2],
    [columns, rows]: [i32; 2],
    from: [i32; 2],
    texels: usize,
) -> Vec<f64> {
    let mut counts = vec![0.0; texels];
    let none = [lanes.splat(0.0); 2];
    for row in (0..rows).map(|row| from[1] + row) {
        let stage = stage.in_row(row);
        for column in (0..columns).map(|column| from[0] + column) {
            let gradient = Gradient { dx: none, dy: none };
            let varying = uv.map(|t| lanes.splat(t));
            let place = [column, row];
            let (word, _) = stage.shade(&Fragments { lanes, varying, gradient, mask: true, place });
            counts[lanes.store_words(word).as_ref()[0] as usize] += 1.0 / f64::from(columns * rows);
        }
    }
    counts
}

/// The greatest difference that the mean of texels from 0 to 1 can have under both weights, which is the sum of what
/// some texels have more: of any texels, of those that differ by column alone, and by row alone. Texels are those of
/// levels with these sides, one after the other.
fn apart(found: &[f64], right: &[f64], sides: &[u32]) -> [f64; 3] {
    let mut more = [0.0; 3];
    let mut levels = found.iter().zip(right).map(|(found, right)| found - right);
    for side in sides.iter().map(|&side| side as usize) {
        let texels: Vec<f64> = levels.by_ref().take(side * side).collect();
        let columns = (0..side).map(|column| texels.iter().skip(column).step_by(side).sum());
        let rows = texels.chunks(side).map(|row| row.iter().sum());
        more[0] += texels.iter().map(|more| more.max(0.0)).sum::<f64>();
        more[1] += columns.map(|more: f64| more.max(0.0)).sum::<f64>();
        more[2] += rows.map(|more: f64| more.max(0.0)).sum::<f64>();
    }
    more
}

/// The greater of each two.
fn worse(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k].max(b[k]))
}

/// The greatest errors of squares of two by two.
fn of_bilinear<L: Lanes<Mask = bool>>(lanes: L, side: u32) -> [f64; 3] {
    let texels: Vec<u8> = (0..side * side).map(|k| k as u8).collect();
    let texture = Texture::new(L8, &texels, side, side).expect("a texture");
    let stage = TexelDither(texture.sampler(Bilinear, Repeat));
    let images = images(side);
    let places = beside_thresholds(&[side]);
    let mut worst = [0.0; 3];
    for (&u, &v) in places.iter().flat_map(|u| places.iter().map(move |v| (u, v))) {
        let right = weights(&images, side, [u, v].map(f64::from));
        for from in [[0, 0], [7, -3]] {
            let found = drawn(lanes, stage, [u, v], [2, 2], from, texels.len());
            worst = worse(worst, apart(&found, &right, &[side]));
        }
    }
    worst
}

/// The greatest errors of squares of four by four, of a level and the next.
fn of_trilinear<L: Lanes<Mask = bool>>(lanes: L, side: u32) -> [f64; 3] {
    let sides = [side, side / 2];
    let [near, far] = sides.map(images);
    let count = near.len() + far.len();
    let mut texels = vec![0; alberti::texture::mipmap::texel_count(side, side)];
    for (k, texel) in texels.iter_mut().take(count).enumerate() {
        *texel = k as u8;
    }
    let map = Mipmap::new(L8, &texels, side, side).expect("levels").sampler(Trilinear, Repeat);
    let places = beside_thresholds(&sides);
    let lambdas: Vec<f64> =
        THRESHOLDS.iter().flat_map(|t| [-1.0, 1.0].map(|way| t - ROUNDED[1] + way * BESIDE[1])).collect();
    let settled: Vec<_> = lambdas
        .iter()
        .map(|lambda| {
            let [step, none] = [(lambda.exp2() / f64::from(side)) as f32, 0.0].map(|x| lanes.splat(x));
            TexelDither(map.leveled()).settled(lanes, &Gradient { dx: [step, none], dy: [none, step] })
        })
        .collect();
    let mut worst = [0.0; 3];
    for (&u, &v) in places.iter().flat_map(|u| places.iter().map(move |v| (u, v))) {
        let uv = [u, v].map(f64::from);
        let (near, far) = (weights(&near, sides[0], uv), weights(&far, sides[1], uv));
        for (lambda, stage) in lambdas.iter().zip(&settled) {
            let right: Vec<f64> =
                near.iter().map(|w| w * (1.0 - lambda)).chain(far.iter().map(|w| w * lambda)).collect();
            let found = drawn(lanes, *stage, [u, v], [4, 4], [3, -6], count);
            worst = worse(worst, apart(&found, &right, &sides));
        }
    }
    worst
}

/// Bounds of the documentation, which are nearly reached: 0.003 is what shares are rounded by.
#[test]
fn means_of_squares_are_near_those_of_the_filters() {
    fn check(what: &str, worst: [f64; 3], bounds: [f64; 3], reached: f64) {
        println!("{what}: {worst:.4?} of the texels' difference, at most {bounds:.4?}");
        for (worst, bound) in worst.into_iter().zip(bounds) {
            assert!((reached * bound..bound + 0.003).contains(&worst), "{what}: {worst} of {bound}");
        }
    }
    let bounds = [11.0 / 32.0, 1.0 / 8.0, 1.0 / 8.0];
    check("bilinear", of_bilinear(One, 4), bounds, 0.99);
    check("bilinear in fixed point", of_bilinear(OneFixed, 4), bounds, 0.99);
    check("bilinear of an odd side", of_bilinear(One, 5), bounds, 0.99);
    // Levels of sides that are halved have places in common, others nearly all of two.
    let bounds = [69.0 / 128.0, 5.0 / 16.0, 3.0 / 8.0];
    for (side, reached) in [(4, 0.9), (11, 0.97)] {
        check("trilinear", of_trilinear(One, side), bounds, reached);
        check("trilinear in fixed point", of_trilinear(OneFixed, side), bounds, reached);
    }
}
