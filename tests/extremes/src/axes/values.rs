//! Axes of what triangles carry: the ratio of their depths, and the repeats of a texture.

use super::shapes::{around, triangles};
use crate::EPS;
use crate::axis::{Axis, Note, Series, decades, named};
use crate::case::{Case, LARGEST};
use crate::measured::Sample;
use crate::policy;
use alberti::texture::{Mirror, Repeat, Wrap};
use alberti_oracle::rng::Rng;

/// The ratio of 1/w, over triangles of 1 to 2000 pixels.
pub(super) fn ratios() -> Axis {
    let measure = |ratio: f64, rng: &mut Rng| {
        let mut case = screen_triangle(rng);
        case.q = depths_of_ratio(rng, ratio as f32);
        case.u = coordinates(rng, 0.0, 1.0);
        case
    };
    Axis {
        name: "ratios",
        title: "Ratios of depth within a triangle",
        about: "Triangles of 1 to 2000 pixels whose farthest vertex is so many times as far as the nearest. They \
                carry coordinates from 0 to 1 of a texture with 256 texels a side. `Exact` does not see the ratio at \
                all. `Planes` loses accuracy in the far part of a triangle in which 1/w falls steeply. Straight lines \
                miss the curve, as far as their formula says; the budget of `Lines::bounded` is a 16th of a texel. \
                `FixedPoint` states a bound up to a ratio of 2^20.",
        parameter: "ratio of depths",
        points: named(&[1.0, 1.001, 1.01, 1.1, 2.0]).into_iter().chain(decades(1, 12)).collect(),
        unit: "texels",
        limit: (0.5, "half a texel"),
        dear: 1,
        series: triangles(&policy::ALL, LARGEST, measure),
    }
}

/// The repeats of a texture, in octaves.
pub(super) fn repeats() -> Axis {
    let measure = |repeats: f64, rng: &mut Rng| {
        let mut case = screen_triangle(rng);
        case.q = depths_of_ratio(rng, 10.0);
        // All repeats across the triangle, or the last one alone.
        let first = if rng.one_in(2) { 0.0 } else { repeats - 1.0 };
        case.u = coordinates(rng, first, repeats);
        case
    };
    let mut series = triangles(&policy::KINDS, LARGEST, measure);
    series.push(Series::new("f32 itself", |repeats, rng, note| {
        let u = rng.uniform(0.0, repeats);
        note.take(|| format!("{u}"));
        Sample::new(256.0 * (f64::from(u as f32) - u), 256.0 * EPS * u)
    }));
    series.push(Series::new("Repeat", |repeats, rng, note| wrapped(Repeat, 1.0, repeats, rng, note)));
    series.push(Series::new("Mirror", |repeats, rng, note| wrapped(Mirror, 2.0, repeats, rng, note)));
    Axis {
        name: "repeats",
        title: "Repeats of a texture",
        about: "A texture of 256 texels a side, repeated so often. Half of the triangles show all repeats, half only \
                the last one; depths are in a ratio of up to 10. All errors grow with the largest coordinate, as \
                `f32` has 24 bits for repeats and texels together. The row `f32 itself` is the rounding of a right \
                coordinate to `f32`: from 2^23 repeats on there is no fraction left, and the texture is one texel. \
                The wrap modes add nothing: they find the texel of every `f32`. `FixedPoint` holds ±4096.",
        parameter: "repeats",
        points: [0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 23, 24]
            .map(|k| (f64::from(1 << k), format!("2^{k}")))
            .into(),
        unit: "texels",
        limit: (0.5, "half a texel"),
        dear: 1,
        series,
    }
}

/// The texel that a wrap mode finds for an `f32`, against remainders in `f64`, which are exact.
fn wrapped(wrap: impl Wrap, period: f64, repeats: f64, rng: &mut Rng, note: &mut Note) -> Sample {
    const SIDE: u32 = 256;
    let sign = if rng.one_in(2) { -1.0 } else { 1.0 };
    let u = (sign * rng.uniform(0.0, repeats)) as f32;
    note.take(|| format!("{u:e}"));
    let place = f64::from(u).rem_euclid(period) * f64::from(SIDE);
    // Beyond the first copy a mirrored texture runs back.
    let side = f64::from(SIDE);
    let texel = if place < side { place.floor() } else { 2.0 * side - 1.0 - place.floor() };
    Sample::new(f64::from(wrap.cell_at(u, SIDE)) - texel, 0.0)
}

/// A triangle of 1 to 2000 pixels, sometimes flat, somewhere in the first columns and rows.
fn screen_triangle(rng: &mut Rng) -> Case {
    let pixel = [rng.range(0, 999), rng.range(0, 999)];
    let wide = f64::from(rng.log_uniform(1.0, 2000.0));
    let high = if rng.one_in(3) { f64::from(rng.log_uniform(0.6, 4.0)) } else { wide };
    around(rng, pixel, [wide, high])
}

/// 1/w of three vertices: the nearest, the farthest, and one between.
pub(super) fn depths_of_ratio(rng: &mut Rng, ratio: f32) -> [f32; 3] {
    let mut q = [1.0, 1.0 / ratio, 1.0 / rng.log_uniform(1.0, ratio)];
    q.rotate_left(rng.index(3));
    q
}

/// Coordinates of three vertices, often at the ends.
pub(super) fn coordinates(rng: &mut Rng, least: f64, most: f64) -> [f32; 3] {
    [(); 3].map(|()| match rng.index(4) {
        0 => least as f32,
        1 => most as f32,
        _ => rng.uniform(least, most) as f32,
    })
}

/// Points that are the same for several axes.
pub(super) fn powers_of_four(from: u32, to: u32) -> Vec<(f64, String)> {
    named(&(from..=to).map(|k| f64::from(4u32.pow(k))).collect::<Vec<_>>())
}
