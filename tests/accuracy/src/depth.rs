//! The depth map zs = α + β/z, and how fine it is.

use crate::{Row, Sample, Table, brief};
use alberti_oracle::rational::{Rational, depth, depth_reversed, from_f32, from_int, to_f64};
use alberti_oracle::rng::Rng;
use alberti_projection::{DepthMap, DepthSteps};

/// A way to make a map, and its ends at the near and the far plane.
#[derive(Clone, Copy)]
struct Kind {
    name: [&'static str; 5],
    make: fn(f32, f32) -> DepthMap,
    ends: [i128; 2],
}

const FORWARD: Kind = Kind {
    name: [
        "DepthMap::forward, α and β",
        "DepthMap::zs, forward",
        "DepthMap::z, forward",
        "DepthMap::z of zs, forward",
        "DepthMap::zs, forward, of α and β",
    ],
    make: |near, far| DepthMap::forward(near, far).expect("0 < near < far"),
    ends: [0, 1],
};

const REVERSED: Kind = Kind {
    name: [
        "DepthMap::reversed, α and β",
        "DepthMap::zs, reversed",
        "DepthMap::z, reversed",
        "DepthMap::z of zs, reversed",
        "DepthMap::zs, reversed, of α and β",
    ],
    make: |near, far| DepthMap::reversed(near, far).expect("0 < near < far"),
    ends: [1, 0],
};

const SYMMETRIC: Kind = Kind {
    name: [
        "DepthMap::onto [−1, 1], α and β",
        "DepthMap::zs, onto [−1, 1]",
        "DepthMap::z, onto [−1, 1]",
        "DepthMap::z of zs, onto [−1, 1]",
        "DepthMap::zs, onto [−1, 1], of α and β",
    ],
    make: |near, far| DepthMap::onto([-1.0, 1.0], near, far).expect("0 < near < far"),
    ends: [-1, 1],
};

const KINDS: [Kind; 3] = [FORWARD, REVERSED, SYMMETRIC];

/// Nearly the largest ratio of the planes that is accepted, 2^126.
const FARTHEST: f32 = 8.5e37;

/// Planes with this ratio of far to near; without a far plane, of an infinite one.
fn planes(rng: &mut Rng, ratio: f32) -> [f32; 2] {
    let most = if ratio.is_finite() { f32::MAX / 2.0 / ratio } else { 1e3 };
    let near = rng.log_uniform(1e-4, most.min(1e3));
    [near, near * ratio]
}

/// Between the planes: near one of them, or anywhere on a logarithmic scale.
fn any_z(rng: &mut Rng, [near, far]: [f32; 2]) -> f32 {
    let last = if far.is_finite() { far } else { near * 1e35 };
    let z = match rng.index(4) {
        0 => near * (1.0 + rng.log_uniform(1e-7, 1.0)),
        1 => last * (1.0 - rng.log_uniform(1e-7, 0.5)),
        _ => rng.log_uniform(near, last),
    };
    z.clamp(near, last)
}

/// α and β of the planes: (dB − cA)/(B−A) and (c−d)AB/(B−A), or their limits.
fn exact(kind: Kind, [near, far]: [f32; 2]) -> [Rational; 2] {
    let ([c, d], a) = (kind.ends.map(from_int), from_f32(near));
    if far == f32::INFINITY {
        return [d.clone(), (c - d) * a];
    }
    let b = from_f32(far);
    let range = &b - &a;
    [(&d * &b - &c * &a) / &range, (c - d) * a * b / range]
}

pub(crate) fn about(ratio: f32) -> String {
    if ratio.is_finite() { format!("B/A = {}", brief(ratio)) } else { "B = ∞".to_owned() }
}

pub(crate) fn tables() -> Vec<Table> {
    let ratios = [1.1f32, 4.0, 1e3, 1e6, 1e9, FARTHEST, f32::INFINITY];
    let (mut zs, mut z) = (Vec::new(), Vec::new());
    for kind in KINDS {
        for ratio in ratios {
            zs.push(Row::new(kind.name[1], about(ratio), zs_bound(kind, ratio), move |rng| {
                let planes = planes(rng, ratio);
                let z = any_z(rng, planes);
                let [alpha, beta] = exact(kind, planes);
                let exact = match kind.ends {
                    [0, 1] if ratio.is_finite() => depth(z, planes[0], planes[1]),
                    [1, 0] if ratio.is_finite() => depth_reversed(z, planes[0], planes[1]),
                    _ => alpha + beta / from_f32(z),
                };
                Sample::new((kind.make)(planes[0], planes[1]).zs(z), &exact, 1.0)
            }));
            zs.push(Row::new(kind.name[4], about(ratio), own_bound(kind, ratio), move |rng| {
                let planes = planes(rng, ratio);
                let (map, z) = ((kind.make)(planes[0], planes[1]), any_z(rng, planes));
                let exact = from_f32(map.alpha()) + from_f32(map.beta()) / from_f32(z);
                // The ends are the planes', where α and β miss them.
                let [least, most] = map.range().map(from_f32);
                Sample::new(map.zs(z), &exact.clamp(least, most), 1.0)
            }));
        }
    }
    for kind in KINDS {
        for ratio in [1.1, 1e3, 1e9, FARTHEST, f32::INFINITY] {
            z.push(Row::new(kind.name[0], about(ratio), 1.001, move |rng| {
                let planes = planes(rng, ratio);
                let ([alpha, beta], map) = (exact(kind, planes), (kind.make)(planes[0], planes[1]));
                Sample::relative(map.alpha(), &alpha).worst(Sample::relative(map.beta(), &beta))
            }));
            z.push(Row::new(kind.name[2], about(ratio), 2.0, move |rng| {
                let planes = planes(rng, ratio);
                let map = (kind.make)(planes[0], planes[1]);
                let zs = map.zs(any_z(rng, planes));
                let from_alpha = from_f32(zs) - from_f32(map.alpha());
                if from_alpha == from_int(0) {
                    // Where α is rounded to 1, a zs of 1 is that of infinity.
                    return Sample { eps: if map.z(zs) == f32::INFINITY { 0.0 } else { f64::NAN }, ulp: 0.0 };
                }
                Sample::relative(map.z(zs), &(from_f32(map.beta()) / from_alpha))
            }));
        }
    }
    for kind in [FORWARD, REVERSED] {
        for ratio in ratios {
            z.push(Row::new(kind.name[3], about(ratio), round_trip_bound(kind, ratio), move |rng| {
                let planes = planes(rng, ratio);
                let (map, z) = ((kind.make)(planes[0], planes[1]), any_z(rng, planes));
                Sample::relative(map.z(map.zs(z)), &from_f32(z))
            }));
        }
    }
    z.push(Row::new(REVERSED.name[3], "A down to `f32::MIN_POSITIVE`", 4.0, |rng| {
        let near = rng.log_uniform(f32::MIN_POSITIVE, 1e-36);
        let planes = [near, if rng.one_in(2) { f32::INFINITY } else { near * rng.log_uniform(1.1, 1e30) }];
        let z = any_z(rng, planes);
        Sample::relative(REVERSED.of(planes).z(REVERSED.of(planes).zs(z)), &from_f32(z))
    }));
    vec![
        Table { title: "Depth", about: "Errors of zs are absolute, in ε of 1.", rows: zs },
        Table { title: "Depth: the map and its inverse", about: INVERSE, rows: z },
        Table { title: "Depth: resolution", about: RESOLUTION, rows: resolution() },
    ]
}

const INVERSE: &str = "Errors are relative. `z` is judged by the map's own α and β, `z of zs` by the z that went in: \
                       with a forward map the far half of the view comes back worse the farther B is from A, and beyond \
                       B/A = 2^24 not at all.";

const RESOLUTION: &str = "Errors are relative: of `resolution` against z·δ/(|β|/z + δ) of the planes, δ being that of the \
                          zs and β/z that were computed, and of the gap \
                          whose reach `separable_until` is against the one asked for. What formats really tell apart is \
                          in `tests/tests/pipeline/resolution.rs`.";

/// As `DepthMap::zs` says of its own α and β.
fn own_bound(kind: Kind, ratio: f32) -> f64 {
    let ratio = f64::from(ratio);
    let nearest = if ratio.is_finite() { ratio / (ratio - 1.0) } else { 1.0 };
    // |β|/A, and half of the greatest |zs|; onto [−1, 1] the former is twice as much.
    if kind.ends == SYMMETRIC.ends { 2.0 * nearest + 0.5 } else { nearest + 0.5 }
}

/// As `DepthMap::zs` says.
fn zs_bound(kind: Kind, ratio: f32) -> f64 {
    let alpha = if ratio.is_finite() { f64::from(ratio) / (f64::from(ratio) - 1.0) } else { 1.0 };
    match kind.ends {
        // (B + A)/(B − A) = 2α − 1, and |β|/A is 2α.
        [-1, 1] => (2.0 * alpha - 1.0) + 4.0 * alpha + 1.0,
        _ => 3.0 * alpha + 0.5,
    }
}

/// As `DepthMap::z` says, at the far plane.
fn round_trip_bound(kind: Kind, ratio: f32) -> f64 {
    if kind.ends == REVERSED.ends {
        return 4.0;
    }
    let ratio = f64::from(ratio);
    let eps = 2f64.powi(-24);
    let r = (ratio / (ratio - 1.0) + 0.5) * eps * (ratio - 1.0);
    if r < 1.0 { r / (1.0 - r) / eps + 4.0 } else { f64::INFINITY }
}

/// Of `D16`, whose step is the same everywhere, and of those where the step of `f32` counts.
fn resolution() -> Vec<Row> {
    let mut rows = Vec::new();
    for ratio in [1.1, 1e3, 1e6, 1e9] {
        // Twice the range has twice the steps and twice β: the same resolution.
        for (function, kind) in
            [("DepthMap::resolution, D16", FORWARD), ("DepthMap::resolution, D16, onto [−1, 1]", SYMMETRIC)]
        {
            rows.push(Row::new(function, about(ratio), 4.0, move |rng| {
                let planes = planes(rng, ratio);
                let z = any_z(rng, planes);
                Sample::relative(kind.of(planes).resolution(DepthSteps::D16, z), &gap(planes, z))
            }));
        }
        for (function, kind, steps, [part, of]) in [
            ("DepthMap::resolution, D24", FORWARD, DepthSteps::D24, [1u32, 16_777_215]),
            ("DepthMap::resolution, D32", FORWARD, DepthSteps::D32, [1, 4_294_967_295]),
            ("DepthMap::resolution, F32", FORWARD, DepthSteps::F32, [0, 1]),
            ("DepthMap::resolution, F32, reversed", REVERSED, DepthSteps::F32, [0, 1]),
        ] {
            rows.push(Row::new(function, about(ratio), 4.0, move |rng| {
                let planes = planes(rng, ratio);
                let (map, z) = (kind.of(planes), any_z(rng, planes));
                let rounded = [map.zs(z), map.beta() / z];
                // What an f32 loses at least, or a step of the format.
                let step = rounded
                    .map(towards_zero)
                    .into_iter()
                    .chain([Rational::new(part.into(), of.into())])
                    .reduce(|a, b| if a > b { a } else { b })
                    .expect("three steps");
                Sample::relative(map.resolution(steps, z), &distance(exact(kind, planes), z, step))
            }));
        }
        rows.push(Row::new("DepthMap::separable_until, D16", about(ratio), 6.0, move |rng| {
            let planes = planes(rng, ratio);
            let wanted = any_z(rng, planes) * rng.log_uniform(1e-4, 1e-1);
            let reach = FORWARD.of(planes).separable_until(DepthSteps::D16, wanted);
            let there = gap(planes, reach);
            Sample::new(wanted, &there, to_f64(&there))
        }));
    }
    rows
}

impl Kind {
    fn of(self, [near, far]: [f32; 2]) -> DepthMap {
        (self.make)(near, far)
    }
}

/// z − z', where z' is one step of 1/65535 nearer.
fn gap(planes: [f32; 2], z: f32) -> Rational {
    distance(exact(FORWARD, planes), z, Rational::new(1.into(), 65_535.into()))
}

/// z − z', where zs of z' is so far from that of z, on the near side.
fn distance([alpha, beta]: [Rational; 2], z: f32, step: Rational) -> Rational {
    let z = from_f32(z);
    let zs = &alpha + &beta / &z;
    let nearer = if beta < from_int(0) { zs - step } else { zs + step };
    z - beta / (nearer - alpha)
}

/// The distance to the next f32 towards 0; from 0, to any other.
fn towards_zero(x: f32) -> Rational {
    let x = x.abs();
    from_f32(if x == 0.0 { x.next_up() } else { x - x.next_down() })
}
