//! Weights in eye space and on the screen.

use crate::depth::about;
use crate::{Row, Sample, Table};
use alberti_oracle::rational::{Rational, from_f32, from_int};
use alberti_oracle::rng::Rng;
use alberti_projection::{DepthMap, EyeWeights, ScreenWeights};

/// The documented bounds.
const WEIGHTS: f64 = 1.001;
const PARAMETER: f64 = 2.001;

/// Depths of a region.
type Depths = fn(&mut Rng) -> f32;

/// Depths, and the regions' names.
const REGIONS: [(&str, Depths); 5] = [
    ("depth ratio to 1.1", |rng| 10.0 * rng.log_uniform(1.0, 1.1)),
    ("to 1e3", |rng| rng.log_uniform(1e-1, 1e2)),
    ("to 1e9", |rng| rng.log_uniform(1e-3, 1e6)),
    ("to 1e12", |rng| rng.log_uniform(1e-6, 1e6)),
    ("any depth to `f32::MAX`/16", |rng| rng.log_uniform(f32::from_bits(1), f32::MAX / 16.0)),
];

pub(crate) fn tables() -> Vec<Table> {
    let mut rows = Vec::new();
    for (region, z) in REGIONS {
        rows.push(Row::new("EyeWeights::<2>::to_screen", region, WEIGHTS, move |rng| to_screen::<2>(rng, z)));
        rows.push(Row::new("EyeWeights::at(t).to_screen", region, PARAMETER, move |rng| {
            parameter(rng, z, |t, z| EyeWeights::at(t).to_screen(z).0, |w, z| w * z)
        }));
        rows.push(Row::new("EyeWeights::<3>::to_screen", region, WEIGHTS, move |rng| to_screen::<3>(rng, z)));
        rows.push(Row::new("ScreenWeights::<2>::to_eye", region, WEIGHTS, move |rng| to_eye::<2>(rng, z)));
        rows.push(Row::new("ScreenWeights::at(τ).to_eye", region, PARAMETER, move |rng| {
            parameter(rng, z, |t, z| ScreenWeights::at(t).to_eye(z).0, |w, z| w / z)
        }));
        rows.push(Row::new("ScreenWeights::<3>::to_eye", region, WEIGHTS, move |rng| to_eye::<3>(rng, z)));
        rows.push(Row::new("EyeWeights::z", region, WEIGHTS, move |rng| {
            let (w, z) = (weights::<3>(rng), depths(rng, z));
            Sample::relative(EyeWeights(w).z(z), &terms(w, z, |w, z| w * z).iter().sum())
        }));
    }
    // 1/z of a subnormal z overflows.
    for (region, z) in REGIONS.into_iter().take(4) {
        rows.push(Row::new("ScreenWeights::q", region, WEIGHTS, move |rng| {
            let (w, z) = (weights::<3>(rng), depths(rng, z));
            Sample::relative(ScreenWeights(w).q(z), &terms(w, z, |w, z| w / z).iter().sum())
        }));
    }
    for ratio in [1.1f32, 1e3, 1e9, f32::INFINITY] {
        for (function, reversed) in
            [("ScreenWeights::z_of_depths, forward", false), ("ScreenWeights::z_of_depths, reversed", true)]
        {
            let region = format!("zs as they are, {}", about(ratio));
            rows.push(Row::new(function, region, WEIGHTS, move |rng| {
                z_of_depths(rng, ratio, reversed, true)
            }));
        }
        let (function, region) =
            ("ScreenWeights::z_of_depths, reversed", format!("zs of the map, {}", about(ratio)));
        rows.push(Row::new(function, region, 4.0, move |rng| z_of_depths(rng, ratio, true, false)));
    }
    vec![Table {
        title: "Relations between eye space and screen",
        about: "Errors are relative to the exact value, or to the smallest normal number if that is larger. Of several \
                weights the worst counts. Rows of a parameter alone count the rounding of 1−t.",
        rows,
    }]
}

/// Numbers that are not negative and sum to 1 but for their roundings, of any sizes.
fn weights<const N: usize>(rng: &mut Rng) -> [f32; N] {
    let parts = [(); N].map(|()| match rng.index(8) {
        0 => 0.0,
        1 => f64::from(rng.log_uniform(1e-30, 1.0)),
        _ => f64::from(rng.log_uniform(1e-4, 1.0)),
    });
    let sum: f64 = parts.iter().sum();
    if sum == 0.0 { weights(rng) } else { parts.map(|part| (part / sum) as f32) }
}

fn depths<const N: usize>(rng: &mut Rng, z: Depths) -> [f32; N] {
    [(); N].map(|()| z(rng))
}

fn terms<const N: usize>(
    w: [f32; N],
    z: [f32; N],
    f: impl Fn(Rational, Rational) -> Rational,
) -> [Rational; N] {
    std::array::from_fn(|i| f(from_f32(w[i]), from_f32(z[i])))
}

/// The worst of the weights, each against its term's share.
fn shares<const N: usize>(got: [f32; N], terms: &[Rational; N]) -> Sample {
    let sum: Rational = terms.iter().sum();
    got.iter()
        .zip(terms)
        .map(|(&got, term)| Sample::relative(got, &(term / &sum)))
        .reduce(Sample::worst)
        .expect("a weight")
}

fn to_screen<const N: usize>(rng: &mut Rng, z: Depths) -> Sample {
    let (w, z) = (weights::<N>(rng), depths(rng, z));
    shares(EyeWeights(w).to_screen(z).0, &terms(w, z, |w, z| w * z))
}

fn to_eye<const N: usize>(rng: &mut Rng, z: Depths) -> Sample {
    let (w, z) = (weights::<N>(rng), depths(rng, z));
    shares(ScreenWeights(w).to_eye(z).0, &terms(w, z, |w, z| w / z))
}

/// A parameter alone, taken as exact.
fn parameter(
    rng: &mut Rng,
    z: Depths,
    got: fn(f32, [f32; 2]) -> [f32; 2],
    term: fn(Rational, Rational) -> Rational,
) -> Sample {
    let t = match rng.index(3) {
        0 => rng.unit() as f32,
        1 => rng.log_uniform(1e-30, 1.0),
        _ => 1.0 - rng.log_uniform(1e-7, 1.0),
    };
    let z = depths(rng, z);
    let exact = from_f32(t);
    let [z1, z2] = z.map(from_f32);
    shares(got(t, z), &[term(from_int(1) - &exact, z1), term(exact, z2)])
}

/// Depths between the planes, and the exact one from their zs, or from themselves.
fn z_of_depths(rng: &mut Rng, ratio: f32, reversed: bool, own: bool) -> Sample {
    let near = rng.log_uniform(1e-3, 1e3);
    let far = near * ratio;
    let map = if reversed { DepthMap::reversed(near, far) } else { DepthMap::forward(near, far) };
    let map = map.expect("0 < near < far");
    let last = far.min(near * 1e30);
    let (w, z) = (weights::<3>(rng), [(); 3].map(|()| rng.log_uniform(near, last)));
    let zs = z.map(|z| map.zs(z));
    let got = ScreenWeights(w).z_of_depths(zs, &map);
    let sum: Rational = if own {
        let [alpha, beta] = [map.alpha(), map.beta()].map(from_f32);
        terms(w, zs, |w, zs| w * (zs - &alpha) / &beta).iter().sum()
    } else {
        terms(w, z, |w, z| w / z).iter().sum()
    };
    if sum == from_int(0) {
        // Where α is rounded to 1, a zs of 1 is that of infinity.
        return Sample { eps: if got == f32::INFINITY { 0.0 } else { f64::NAN }, ulp: 0.0 };
    }
    Sample::relative(got, &(from_int(1) / sum))
}
