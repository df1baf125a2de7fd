//! Axes of the shapes and places of triangles: slivers, the least areas, the largest frames, the guard band.

use super::values::{coordinates, depths_of_ratio, powers_of_four};
use crate::axis::{Axis, Series, decades, named};
use crate::case::{BITS, Case, LARGEST};
use crate::policy::{self, Division, Policy};
use alberti_oracle::cases::{self, pixel_centre};
use alberti_oracle::coverage::area2;
use alberti_oracle::rng::Rng;

/// Subpixels of a pixel.
const ONE: i64 = 1 << BITS;
/// The guard band in subpixels, whose last one belongs to it on the left and top only.
const GUARD: i64 = 2 * LARGEST * ONE - 1;

/// The policies along triangles that `make` makes, judged in texels, in a frame of so many pixels.
pub(super) fn triangles(
    policies: &[Policy],
    side: i64,
    make: impl Fn(f64, &mut Rng) -> Case + Copy + Send + Sync + 'static,
) -> Vec<Series> {
    let series = |&policy: &Policy| {
        Series::new(policy.name(), move |point, rng, note| {
            let case = make(point, rng);
            note.take(|| format!("{case:?}"));
            case.texels(policy, side)
        })
    };
    policies.iter().map(series).collect()
}

/// Three vertices within so many pixels of a pixel that they cover.
pub(super) fn around(rng: &mut Rng, pixel: [i64; 2], reach: [f64; 2]) -> Case {
    let sample = pixel_centre(pixel[0], pixel[1], BITS);
    for _ in 0..200 {
        let tri = [(); 3].map(|()| {
            [0, 1].map(|k| {
                let steps = reach[k] * ONE as f64;
                (sample[k] + rng.uniform(-steps, steps).round() as i64).clamp(-GUARD - 1, GUARD)
            })
        });
        let case = Case::new(tri, pixel);
        if case.is_covered() {
            return case;
        }
    }
    // A generator that repeats itself, as one that is climbed with may: a triangle that is always covered.
    let [x, y] = sample;
    let [w, h] = reach.map(|r| (r * ONE as f64) as i64 + 1);
    Case::new([[x - w, y - h], [x + w, y - h], [x, y + h]], pixel)
}

/// Triangles 4096 pixels long, and so many times thinner.
fn sliver(aspect: f64, rng: &mut Rng) -> Case {
    const LENGTH: f64 = 4096.0 * ONE as f64;
    let pixel = [rng.range(4096, 12_000), rng.range(4096, 12_000)];
    let sample = pixel_centre(pixel[0], pixel[1], BITS).map(|c| c as f64);
    let width = LENGTH / aspect;
    let mut case = Case::new([[0; 2]; 3], pixel);
    for _ in 0..1000 {
        let angle = rng.uniform(0.0, std::f64::consts::TAU);
        let along = [angle.cos(), angle.sin()];
        // Two ends, a vertex between them, and each somewhere across the width.
        let before = rng.unit() * LENGTH;
        let places = [-before, LENGTH - before, rng.uniform(-before, LENGTH - before)];
        let across = [rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(-1.0, 1.0)];
        case.tri = [0, 1, 2].map(|i| {
            let (t, s) = (places[i], across[i] * width);
            [sample[0] + t * along[0] - s * along[1], sample[1] + t * along[1] + s * along[0]]
                .map(|c| c.round() as i64)
        });
        if case.is_covered() {
            break;
        }
    }
    if !case.is_covered() {
        case = around(rng, pixel, [4096.0, 1.0]);
    }
    with_values(case, rng)
}

/// Values of a texture's coordinates, and depths in a ratio of up to 10.
fn with_values(mut case: Case, rng: &mut Rng) -> Case {
    case.q = depths_of_ratio(rng, 10.0);
    case.u = coordinates(rng, 0.0, 1.0);
    case.zs = [(); 3].map(|()| rng.unit() as f32);
    case
}

/// The aspect of slivers.
pub(super) fn slivers() -> Axis {
    Axis {
        name: "slivers",
        title: "Slivers",
        about: "Triangles 4096 pixels long and so many times thinner, at any angle; at 10^6 they are a subpixel wide. \
                Depths are in a ratio of up to 10. A sliver is no worse than any other triangle of its length: edge \
                functions are integers, so their signs and sums are right however thin it is.",
        parameter: "length / width",
        points: decades(0, 6),
        unit: "texels",
        limit: (0.5, "half a texel"),
        dear: 1,
        series: triangles(&policy::KINDS, LARGEST, sliver),
    }
}

/// The same for depth.
pub(super) fn depths() -> Axis {
    let policies = [
        Policy::Exact,
        Policy::Planes,
        Policy::Floats(Division::Spans(16)),
        Policy::Fixed(Division::Spans(16)),
    ];
    let series = policies.map(|policy| {
        Series::new(policy.name(), move |aspect, rng, note| {
            let case = sliver(aspect, rng);
            note.take(|| format!("{case:?}"));
            case.depth_steps(policy, LARGEST)
        })
    });
    Axis {
        name: "sliver-depths",
        title: "Depth on slivers",
        about: "Screen depth on the same slivers, in steps of 2^-24, which are those of `D24`. The bound of \
                `FixedPoint` has a term for each column of the row; a step of its own is 2^-31.",
        parameter: "length / width",
        points: decades(0, 6),
        unit: "steps of 24 bits",
        limit: (256.0, "a step of `D16`"),
        dear: 1,
        series: series.into(),
    }
}

/// The least areas, in subpixels squared.
pub(super) fn areas() -> Axis {
    let make = |area: f64, rng: &mut Rng| {
        let area = area as i128;
        let mut best = None;
        for _ in 0..400 {
            let case = if rng.one_in(2) {
                cases::sliver_tie(rng, BITS, GUARD)
            } else {
                cases::sliver(rng, BITS, GUARD)
            };
            let mirror = case.sample.map(|c| if c < 0 { -1 } else { 1 });
            let flip = |p: [i64; 2]| [p[0] * mirror[0], p[1] * mirror[1]];
            let pixel = flip(case.sample).map(|c| c >> BITS);
            let found = Case::new(case.tri.map(flip), pixel);
            let doubled = area2(case.tri).abs();
            if pixel.iter().all(|&c| c < LARGEST) && found.is_covered() {
                best = Some(found);
                if (2 * area..8 * area).contains(&doubled) || (area == 1 && doubled <= 2) {
                    break;
                }
            }
        }
        let case = best.unwrap_or_else(|| around(rng, [100, 100], [1.0, 1.0]));
        with_values(case, rng)
    };
    Axis {
        name: "areas",
        title: "The least areas",
        about: "Triangles with an area of one to four times so many subpixels squared (65,536 to a pixel squared), up \
                to 65,000 pixels long, that cover a pixel's centre all the same. No area but 0 is too small. What \
                straight lines miss here is due to the length.",
        parameter: "area, subpixels squared",
        points: powers_of_four(0, 7),
        unit: "texels",
        limit: (0.5, "half a texel"),
        dear: 4,
        series: triangles(&policy::KINDS, LARGEST, make),
    }
}

/// The side of the frame.
pub(super) fn targets() -> Axis {
    let make = |side: f64, rng: &mut Rng| {
        let pixel = [(); 2].map(|()| rng.range(0, (side as i64).min(LARGEST) - 1));
        let reach = side * rng.uniform(0.5, 1.5);
        with_values(around(rng, pixel, [reach, reach]), rng)
    };
    let moved = move |side: f64, rng: &mut Rng| {
        let mut case = make(side.max(256.0), rng);
        case.moved = [(); 3].map(|()| [(); 2].map(|()| rng.range(-128, 127)));
        if case.is_large() { case } else { Case { moved: [[0; 2]; 3], ..case } }
    };
    let mut series: Vec<Series> = policy::KINDS
        .iter()
        .map(|&policy| {
            Series::new(policy.name(), move |side, rng, note| {
                let case = make(side, rng);
                note.take(|| format!("{case:?}"));
                case.texels(policy, side as i64)
            })
            .refused_by("`Target::band`")
        })
        .collect();
    series.insert(
        1,
        Series::new("Exact before snapping", move |side, rng, note| {
            let case = moved(side, rng);
            note.take(|| format!("{case:?}"));
            case.texels(Policy::Exact, (side as i64).max(256))
        })
        .refused_by("`Target::band`"),
    );
    Axis {
        name: "targets",
        title: "Sizes of the frame",
        about: "Triangles half to one and a half times as large as a square frame with sides of so many pixels. \
                Depths are in a ratio of up to 10. The second row counts from the vertices before they were snapped, \
                as large triangles do (of at least 65 pixels, so its frames begin at 256). The largest frame is no \
                worse than the smallest: where lines miss, the worst are triangles of few columns in any frame.",
        parameter: "side of the frame, pixels",
        points: named(&[16.0, 64.0, 256.0, 1024.0, 4096.0, 16_384.0, 32_768.0]),
        unit: "texels",
        limit: (0.5, "half a texel"),
        dear: 1,
        series,
    }
}

/// The distance of the farthest vertex from the frame's origin.
pub(super) fn offsets() -> Axis {
    let make = |offset: f64, rng: &mut Rng| {
        let far = offset as i64;
        let reach = f64::from(rng.log_uniform(4.0, 200.0));
        let pixel = [(far - rng.range(0, 50)).clamp(0, LARGEST - 1), rng.range(0, LARGEST - 1)];
        let mut case = around(rng, pixel, [reach, reach]);
        if far > LARGEST {
            // One vertex out there, and the others so that the pixel lies between them.
            let [x, y] = pixel_centre(pixel[0], pixel[1], BITS);
            let mut step = || (reach * ONE as f64 * rng.uniform(0.1, 1.0)) as i64 + 1;
            case.tri = [[far * ONE - 1, y], [x - step(), y - step()], [x - step(), y + step()]];
        }
        with_values(case, rng)
    };
    let mut series = triangles(&policy::KINDS, LARGEST, make);
    for each in &mut series {
        each.refuses = "`Fixed::from_subpixels`";
    }
    Axis {
        name: "offsets",
        title: "Distances from the frame's origin",
        about: "Triangles of 4 to 200 pixels as far from the upper left corner; beyond 16384 pixels, where frames end, \
                with a vertex at that distance, up to the guard band at 32768. Nothing gets worse: values start from a \
                pixel of the triangle, not from the origin.",
        parameter: "distance, pixels",
        points: named(&[1.0, 64.0, 1024.0, 4096.0, 16_384.0, 24_576.0, 32_768.0, 32_769.0]),
        unit: "texels",
        limit: (0.5, "half a texel"),
        dear: 1,
        series,
    }
}
