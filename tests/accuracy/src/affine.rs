//! Frames and barycentric coordinates: the regions that their vertices and points are drawn from.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "inputs are drawn in f64 or as small integers and rounded; what is judged is what they are rounded to"
)]

use crate::{Row, Sample, Table};
use alberti_oracle::linear::quotient;
use alberti_oracle::rational::{self, Rational};
use alberti_oracle::rng::Rng;
use num_bigint::BigInt;
use std::array::from_fn;
use std::fmt;

mod barycentric;
mod frames;

pub(crate) fn tables() -> Vec<Table> {
    vec![frames::table(), barycentric::table()]
}

/// Where the vertices of a segment, triangle or tetrahedron lie.
#[derive(Clone, Copy)]
enum Region {
    Ordinary,
    Sliver,
    Screen,
    Subpixel,
    Large,
    Huge,
    Subnormal,
    NearlyFlat,
    Spread,
    /// Any of the others.
    Mixed,
}

impl Region {
    const EACH: [Self; 9] = [
        Self::Ordinary,
        Self::Sliver,
        Self::Screen,
        Self::Subpixel,
        Self::Large,
        Self::Huge,
        Self::Subnormal,
        Self::NearlyFlat,
        Self::Spread,
    ];
    const FEW: [Self; 3] = [Self::Ordinary, Self::Sliver, Self::Mixed];

    /// `K` points of `N` coordinates.
    fn points<const N: usize, const K: usize>(self, rng: &mut Rng) -> [[f32; N]; K] {
        match self {
            Self::Ordinary => cube(rng, 1.0),
            Self::Huge => cube(rng, 1e30),
            Self::Subnormal => cube(rng, 1e-40),
            Self::Screen => cube(rng, 32_768.0).map(|p: [f32; N]| p.map(|x| (x * 256.0).round() / 256.0)),
            Self::Sliver => {
                let [a, along] = cube::<N, 2>(rng, 1.0);
                from_fn(|_| {
                    let t = rng.unit() as f32;
                    from_fn(|i| a[i] + along[i] * t + rng.uniform(-1e-6, 1e-6) as f32)
                })
            }
            Self::Subpixel => {
                let base: [f32; N] = from_fn(|_| rng.range(-16_384 * 256, 16_384 * 256) as f32);
                from_fn(|_| from_fn(|i| (base[i] + rng.range(-1, 1) as f32) / 256.0))
            }
            Self::Large => from_fn(|k| {
                from_fn(|i| {
                    let corner = if k == i + 1 { 16_384.0 } else { 0.0 };
                    (corner + rng.range(-100 * 256, 100 * 256) as f64 / 256.0) as f32
                })
            }),
            Self::NearlyFlat => {
                // On a line or in a plane but for a few units in the last place.
                let [a, along] = cube::<N, 2>(rng, 1.0);
                from_fn(|_| {
                    let t = rng.unit() as f32;
                    from_fn(|i| nudged(rng, a[i] + along[i] * t))
                })
            }
            Self::Spread => {
                // On a line through the origin, exactly but for some units in the last place: where differences have
                // more bits than f64 has.
                let along: [f32; N] = from_fn(|_| rng.range(-2047, 2047) as f32);
                from_fn(|_| {
                    let t = rng.range(1, 2047) as f32 * (rng.range(-40, 40) as f32).exp2();
                    from_fn(|i| if rng.one_in(4) { nudged(rng, along[i] * t) } else { along[i] * t })
                })
            }
            Self::Mixed => Self::EACH[rng.index(Self::EACH.len())].points(rng),
        }
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ordinary => "within ±1",
            Self::Sliver => "slivers, 1 to 10^6",
            Self::Screen => "within ±32768, in 1/256",
            Self::Subpixel => "sides of 1/256, within ±16384",
            Self::Large => "sides of 16384",
            Self::Huge => "within ±10^30",
            Self::Subnormal => "within ±10^-40",
            Self::NearlyFlat => "flat but for two units in the last place",
            Self::Spread => "nearly on a line, from 2^-40 to 2^51",
            Self::Mixed => "any of all regions",
        })
    }
}

/// Points of which all coordinates are within `size`.
fn cube<const N: usize, const K: usize>(rng: &mut Rng, size: f64) -> [[f32; N]; K] {
    from_fn(|_| from_fn(|_| rng.uniform(-size, size) as f32))
}

/// `x`, up to two floats further up or down.
fn nudged(rng: &mut Rng, x: f32) -> f32 {
    let bits = i64::from(x.to_bits()) + rng.range(-2, 2);
    f32::from_bits(bits.max(0) as u32)
}

/// Weights of which the sum is about 1: inside, near an edge, near or at a vertex, or far outside.
fn weights<const K: usize>(rng: &mut Rng) -> [f64; K] {
    let special = rng.index(K);
    let mut weights: [f64; K] = match rng.index(5) {
        0 => from_fn(|_| rng.unit()),
        1 => from_fn(|k| if k == special { f64::from(rng.log_uniform(1e-9, 1e-3)) } else { rng.unit() }),
        2 => from_fn(|k| if k == special { 1.0 } else { f64::from(rng.log_uniform(1e-9, 1e-3)) }),
        3 => from_fn(|k| if k == special { 1.0 } else { 0.0 }),
        _ => from_fn(|_| rng.uniform(-1e3, 1e3)),
    };
    if rng.one_in(2) {
        weights[rng.index(K)] *= -1.0;
    }
    let rest: f64 = (0..K).filter(|&k| k != special).map(|k| weights[k]).sum();
    weights[special] = 1.0 - rest;
    weights
}

/// The point with such weights, rounded; in some cases, in more dimensions than `K - 1`, beside all combinations.
fn point_near<const N: usize, const K: usize>(rng: &mut Rng, vertices: &[[f32; N]; K]) -> [f32; N] {
    let weights = weights::<K>(rng);
    let beside = if rng.one_in(4) { 1.0 } else { 0.0 };
    from_fn(|i| {
        let on: f64 = vertices.iter().zip(weights).map(|(v, weight)| f64::from(v[i]) * weight).sum();
        (on + beside * rng.uniform(-1.0, 1.0) * f64::from(vertices[0][i])) as f32
    })
}

/// The error of an answer that promises ε of the larger of `scale` and the smallest normal number.
fn relative(got: f32, exact: &Rational, scale: f64) -> Sample {
    Sample::new(got, exact, scale.max(f64::from(f32::MIN_POSITIVE)))
}

/// Of several answers, which must be there unless one is beyond what is finite, the error of one, drawn at random;
/// `None` where the answer is rightly missing.
fn one_of<const N: usize>(
    rng: &mut Rng,
    got: Option<[f32; N]>,
    exact: Option<([BigInt; N], BigInt)>,
    scale: impl Fn(usize, &Rational) -> f64,
) -> Option<Sample> {
    let too_large = |n: &BigInt, d: &BigInt| rational::to_f64(&quotient(n, d)).abs() >= f64::from(f32::MAX);
    let wrong = Some(Sample { eps: f64::NAN, ulp: f64::NAN });
    match (got, exact) {
        (None, None) => None,
        (None, Some((numerators, d))) => match numerators.iter().any(|n| too_large(n, &d)) {
            true => None,
            false => wrong,
        },
        (Some(_), None) => wrong,
        (Some(got), Some((numerators, d))) => {
            let k = rng.index(N);
            let exact = quotient(&numerators[k], &d);
            Some(relative(got[k], &exact, scale(k, &exact)))
        }
    }
}

/// A row that draws from the region until there is something to measure.
fn row(
    function: &'static str,
    region: Region,
    bound: f64,
    measure: impl Fn(&mut Rng, Region) -> Option<Sample> + 'static,
) -> Row {
    Row::new(function, region.to_string(), bound, move |rng| {
        let found = (0..1000).find_map(|_| measure(rng, region));
        found.expect("a region of which every draw is degenerate tests nothing")
    })
}

/// The magnitude, for an error that is relative.
fn magnitude(_: usize, exact: &Rational) -> f64 {
    rational::to_f64(exact).abs()
}
