//! Axes of the depth formats: stored depths, the gaps that they tell apart, and many layers at one pixel.

use crate::EPS;
use crate::axis::{Axis, Note, Series, decades, named};
use crate::measured::Sample;
use alberti::lanes::One;
use alberti::projection::{DepthMap, DepthSteps};
use alberti::raster::{Paint, Vertex};
use alberti::{AnyDepth, Cull, DepthFormat, Exact, Fixed, Rgba8888, Sub8, Target};
use alberti_oracle::rational;
use alberti_oracle::rng::Rng;

/// A format of the rasterizer, under the name that `resolution` knows it by, with the integer that stands for 1.
#[derive(Clone, Copy, Debug)]
struct Format {
    any: AnyDepth,
    steps: DepthSteps,
    one: f64,
}

const FORMATS: [Format; 5] = [
    Format { any: AnyDepth::D16, steps: DepthSteps::D16, one: 65_535.0 },
    Format { any: AnyDepth::D24, steps: DepthSteps::D24, one: 16_777_215.0 },
    Format { any: AnyDepth::D32, steps: DepthSteps::D32, one: 4_294_967_295.0 },
    Format { any: AnyDepth::F32, steps: DepthSteps::F32, one: 0.0 },
    Format { any: AnyDepth::F32Reversed, steps: DepthSteps::F32, one: 0.0 },
];

impl Format {
    fn map(&self, [near, far]: [f32; 2]) -> Option<DepthMap> {
        let map = if self.any.reversed() { DepthMap::reversed } else { DepthMap::forward };
        map(near, far).ok()
    }

    fn stored(&self, map: &DepthMap, z: f32) -> u32 {
        self.any.encode(map.zs(z))
    }

    /// The depth that a stored word stands for, but for the rounding of one `f64`.
    fn meaning(&self, stored: u32) -> f64 {
        match self.any {
            AnyDepth::F32 => f64::from(f32::from_bits(stored)),
            AnyDepth::F32Reversed => f64::from(f32::from_bits(!stored)),
            _ => f64::from(stored) / self.one,
        }
    }
}

fn formats(
    measure: impl Fn(&Format, f64, &mut Rng, &mut Note) -> Sample + Copy + Send + Sync + 'static,
) -> Vec<Series> {
    let series = |format: Format| {
        Series::new(format!("{:?}", format.any), move |point, rng, note| measure(&format, point, rng, note))
            .refused_by("`DepthMap::forward` and `reversed`")
    };
    FORMATS.into_iter().map(series).collect()
}

/// Planes in this ratio.
fn planes(ratio: f64, rng: &mut Rng) -> [f32; 2] {
    // Where the ratio is beyond that of any two `f32` of middling size, the planes are about 1.
    let near = if ratio < 1e12 { f64::from(rng.log_uniform(1e-3, 1e3)) } else { ratio.sqrt().recip() };
    [near as f32, (near * ratio) as f32]
}

fn ratios() -> Vec<(f64, String)> {
    let mut points = named(&[1.0, 1.5]);
    points.extend(decades(1, 9));
    points.extend(named(&[1e12, 1e24, 1e40]));
    points
}

/// Stored depths against exact ones.
pub(super) fn stored() -> Axis {
    let measure = |format: &Format, ratio: f64, rng: &mut Rng, note: &mut Note| {
        let planes @ [near, far] = planes(ratio, rng);
        let Some(map) = format.map(planes) else { return Sample::REFUSED };
        let z = any_depth(planes, rng);
        note.take(|| format!("z {z:e} between {planes:?}"));
        let exact = if format.any.reversed() { rational::depth_reversed } else { rational::depth };
        let found = rational::from_f64(format.meaning(format.stored(&map, z)));
        let error = rational::to_f64(&(found - exact(z, near, far)));
        let half = if format.one > 0.0 { 0.5 / format.one } else { 0.0 };
        // |β|/A to two roundings.
        let largest = f64::from(map.beta().abs()) / f64::from(near) * (1.0 + 4.0 * EPS);
        Sample::new(error / EPS, (3.0 * largest + 0.5) + half / EPS)
    };
    Axis {
        name: "stored-depths",
        title: "Stored depths and the ratio of the planes",
        about: "A depth between near plane A and far plane B as it is stored, against the exact zs of the planes, in \
                2^-24. The error of zs depends on B/A only where the planes are close together. `D16` adds half of \
                its own step. So the ratio does not hurt what is stored: it hurts what a step of it is worth, which \
                is the next table.",
        parameter: "B/A",
        points: ratios(),
        unit: "2^-24",
        limit: (256.0, "a step of `D16`"),
        dear: 4,
        series: formats(measure),
    }
}

/// Next to the planes, and anywhere between.
fn any_depth([near, far]: [f32; 2], rng: &mut Rng) -> f32 {
    let z = match rng.index(4) {
        0 => near * (1.0 + rng.log_uniform(1e-7, 1.0)),
        1 => far * (1.0 - rng.log_uniform(1e-7, 0.5)),
        _ => rng.log_uniform(near, far),
    };
    z.clamp(near, far)
}

/// The gaps that are not told apart, in the far half of the view.
pub(super) fn gaps() -> Axis {
    let measure = |format: &Format, ratio: f64, rng: &mut Rng, note: &mut Note| {
        let planes @ [near, far] = planes(ratio, rng);
        let Some(map) = format.map(planes) else { return Sample::REFUSED };
        let z = (far * rng.uniform(0.5, 1.0) as f32).clamp(near, far);
        let [stored, at_near, at_far] = [z, near, far].map(|z| format.stored(&map, z));
        let begin = first(near, z, |z| format.stored(&map, z) == stored);
        let end = first(z, far, |z| format.stored(&map, z) != stored);
        note.take(|| format!("from {begin:e} to {end:e}, as {z:e} between {planes:?}"));
        let dz = f64::from(map.resolution(format.steps, z));
        let gap = f64::from(end) - f64::from(begin);
        let stated = stored != at_near && stored != at_far && dz <= f64::from(z) / 4.0;
        let factor = if dz < f64::from(z) / 2_097_152.0 { 4.0 } else { 2.0 };
        let bound = if stated { factor * dz / f64::from(end) } else { f64::INFINITY };
        Sample::new(100.0 * gap / f64::from(end), 100.0 * bound)
    };
    Axis {
        name: "gaps",
        title: "Gaps that depth formats tell apart",
        about: "The longest stretch of depths that are stored alike, in the far half of the view, in per cent of the \
                distance of their end. The bound is that of `DepthMap::resolution`: twice its dz, or four times where that is near \
                the spacing of `f32`; none is stated where a step is more than a quarter of the distance, or one of \
                the planes shares it. This is where forward maps break, and `D32` and `F32` no later than `D24`, as all \
                three come from a zs in `f32`. `F32Reversed` does not see the ratio.",
        parameter: "B/A",
        points: ratios(),
        unit: "% of the distance",
        limit: (1.0, "1 % of the distance"),
        dear: 4,
        series: formats(measure),
    }
}

/// The first f32 in (`from`, `to`] for which `beyond` holds, as it does for all after it.
fn first(from: f32, to: f32, beyond: impl Fn(f32) -> bool) -> f32 {
    let (mut before, mut after) = (from.to_bits(), to.to_bits());
    while after.saturating_sub(before) > 1 {
        let middle = before.midpoint(after);
        if beyond(f32::from_bits(middle)) { after = middle } else { before = middle }
    }
    f32::from_bits(after)
}

/// Layers of near-equal depth over one pixel.
pub(super) fn layers() -> Axis {
    Axis {
        name: "layers",
        title: "Layers of near-equal depth",
        about: "So many layers over one pixel, all within 10^-7 to 10^-1 of their distance, between planes at 1 and \
                1000: drawn from the nearest, from the farthest, and shuffled. Stored depths must be in the order of \
                the distances, the least must stay, and of equal ones the first that was drawn. The error is the \
                distance of the layer that is seen behind the nearest one; its bound is that of the gaps. It depends on the \
                format and the distance, not on the number of layers.",
        parameter: "layers",
        points: decades(1, 6),
        unit: "% of the distance",
        limit: (2.0, "2 % of the distance"),
        dear: 5000,
        series: formats(|format, count, rng, note| layered(format, count as usize, rng, note)),
    }
}

fn layered(format: &Format, count: usize, rng: &mut Rng, note: &mut Note) -> Sample {
    let Some(map) = format.map([1.0, 1000.0]) else { return Sample::REFUSED };
    let (nearest, spread) = (rng.log_uniform(1.0, 900.0), rng.log_uniform(1e-7, 1e-1));
    note.take(|| format!("{count} layers from {nearest:e} on, over {spread:e} of that"));
    let z: Vec<f32> =
        (0..count).map(|i| nearest * (1.0 + spread * (i as f32 / count.max(2) as f32))).collect();
    let stored: Vec<u32> = z.iter().map(|&z| format.stored(&map, z)).collect();
    // `AnyDepth` keeps words of which the lesser is the nearer.
    let in_order = stored.is_sorted();
    let mut order: Vec<usize> = (0..count).collect();
    let mut worst = Sample::new(0.0, f64::INFINITY);
    for turn in 0..3 {
        match turn {
            1 => order.reverse(),
            2 => (1..count).for_each(|i| order.swap(i, rng.index(i + 1))),
            _ => {}
        }
        let seen = drawn(format, &map, &z, &order);
        let first = order.iter().copied().find(|&i| stored[i] == stored[0]);
        if !in_order || seen.is_none() || seen != first {
            return Sample::new(f64::INFINITY, 0.0);
        }
        let farther = seen.map_or(f64::NAN, |i| f64::from(z[i]));
        let dz = f64::from(map.resolution(format.steps, farther as f32));
        let factor = if dz < farther / 2_097_152.0 { 4.0 } else { 2.0 };
        let shared = [1.0, 1000.0].iter().any(|&plane| format.stored(&map, plane) == stored[0]);
        let bound = if dz <= farther / 4.0 && !shared { factor * dz / farther } else { f64::INFINITY };
        let sample = Sample::new(100.0 * (farther - f64::from(z[0])) / farther, 100.0 * bound);
        if turn == 0 || sample.share() > worst.share() {
            worst = sample;
        }
    }
    worst
}

/// The layer that is seen after all were drawn in this order.
fn drawn(format: &Format, map: &DepthMap, z: &[f32], order: &[usize]) -> Option<usize> {
    let (mut color, mut depth) = ([0], [format.any.farthest()]);
    let mut target = Target::new(Rgba8888, format.any, 1, 1, &mut color, &mut depth).ok()?;
    let at = |x: i32| Fixed::from_subpixels(256 * x);
    let places = [[at(-2)?, at(-2)?], [at(4)?, at(-2)?], [at(-2)?, at(4)?]];
    for &layer in order {
        let (zs, q) = (map.zs(z[layer]), 1.0 / z[layer]);
        let [a, b, c] = &places.map(|[x, y]| Vertex { x, y, zs, q, varying: () });
        let number = layer as u32 + 1;
        let stage = |()| Some(number);
        let paint = Paint { stage, interpolation: Exact, subpixel: Sub8, cull: Cull::None };
        paint.triangle(One, &mut target, [a, b, c], &mut ());
    }
    (u32::from_le(color[0]) as usize).checked_sub(1)
}
