//! What the depth formats really tell apart, against what `resolution` and its relatives promise.
#![allow(clippy::cast_possible_truncation, reason = "random f64 become the f32 that are tested")]

use alberti_math::Subpixel;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_projection::{DepthMap, DepthSteps};
use alberti_raster::{D16, D24, D32, DepthFormat, F32, F32Reversed, Vertex};
use alberti_tests::probe::{Probe, Recorded, unsnapped};

/// A format of the rasterizer, under the name that `resolution` knows it by.
#[derive(Clone, Copy, Debug)]
struct Format {
    steps: DepthSteps,
    reversed: bool,
    /// From zs to the bits that are stored.
    encode: fn(f32) -> u32,
}

const FORMATS: [Format; 5] = [
    Format { steps: DepthSteps::D16, reversed: false, encode: |zs| u32::from(D16.encode(zs)) },
    Format { steps: DepthSteps::D24, reversed: false, encode: |zs| D24.encode(zs) },
    Format { steps: DepthSteps::D32, reversed: false, encode: |zs| D32.encode(zs) },
    Format { steps: DepthSteps::F32, reversed: false, encode: |zs| F32.encode(zs).to_bits() },
    Format { steps: DepthSteps::F32, reversed: true, encode: |zs| F32Reversed.encode(zs).to_bits() },
];

#[test]
fn the_rasterizer_counts_depths_in_the_same_direction() {
    let reversed = [D16.reversed(), D24.reversed(), D32.reversed(), F32.reversed(), F32Reversed.reversed()];
    assert_eq!(FORMATS.map(|format| format.reversed), reversed);
}

impl Format {
    fn map(&self, near: f32, far: f32) -> DepthMap {
        let map = if self.reversed { DepthMap::reversed(near, far) } else { DepthMap::forward(near, far) };
        map.expect("0 < near < far")
    }

    fn stored(&self, map: &DepthMap, z: f32) -> u32 {
        (self.encode)(map.zs(z))
    }
}

/// The first f32 in (`from`, `to`] for which `beyond` holds, as it does for all after it.
fn first(from: f32, to: f32, beyond: impl Fn(f32) -> bool) -> f32 {
    let (mut before, mut after) = (from.to_bits(), to.to_bits());
    while after - before > 1 {
        let middle = before.midpoint(after);
        if beyond(f32::from_bits(middle)) { after = middle } else { before = middle }
    }
    f32::from_bits(after)
}

#[test]
fn the_names_are_those_of_the_formats() {
    assert_eq!(DepthSteps::FORMATS, FORMATS.map(|format| (format.steps, format.reversed)));
}

/// The depths stored like z extend over half to twice the resolution, and surfaces twice as far apart differ. Where the
/// resolution is hardly coarser than the f32 z itself, a quarter to four times.
#[test]
fn depths_stored_alike_extend_over_the_resolution() {
    let mut rng = Rng::stream(run_seed(), 1);
    for format in FORMATS {
        // Of what is no finer than four neighbours of z, and of what is.
        let mut extremes = [[f64::INFINITY, 0.0]; 2];
        let mut checked = [0; 2];
        for _ in 0..60_000 {
            let near = rng.log_uniform(1e-3, 1e3);
            let far = if rng.one_in(8) { f32::INFINITY } else { near * rng.log_uniform(1.1, 1e9) };
            let (map, last) = (format.map(near, far), far.min(1e12));
            let z = rng.log_uniform(near, last);
            let resolution = map.resolution(format.steps, z);
            assert!(resolution > 0.0 && resolution <= z, "{resolution} at {z}");
            let [stored, at_near, at_last] = [z, near, last].map(|z| format.stored(&map, z));
            if resolution > z / 4.0 || stored == at_near || stored == at_last {
                continue;
            }
            let begin = first(near, z, |z| format.stored(&map, z) == stored);
            let end = first(z, last, |z| format.stored(&map, z) != stored);
            let ratio = (f64::from(end) - f64::from(begin)) / f64::from(resolution);
            let fine = resolution < z / 2_097_152.0;
            let (at, factor) = if fine { (1, 4.0) } else { (0, 2.0) };
            extremes[at] = [extremes[at][0].min(ratio), extremes[at][1].max(ratio)];
            checked[at] += 1;
            if z - factor * resolution > near {
                let nearer = format.stored(&map, z - factor * resolution);
                assert!(nearer != stored, "{:?}: {z} between {near} and {far}", format.steps);
            }
        }
        println!("{:?}, reversed {}: {checked:?}, {extremes:.3?}", format.steps, format.reversed);
        for ([least, most], [low, high]) in extremes.into_iter().zip([[0.5, 2.0], [0.25, 4.0]]) {
            assert!(least >= low && most <= high, "{format:?}: {least} to {most}");
        }
        assert!(checked[usize::from(format.reversed)] > 15_000, "{format:?}: {checked:?}");
    }
}

/// Up to the depth that `separable_until` names the resolution is the gap or less, and at twice the depth more; at a
/// quarter of it the format itself tells the surfaces apart.
#[test]
fn surfaces_are_separable_until_the_depth_that_is_named() {
    let mut rng = Rng::stream(run_seed(), 2);
    let (mut inside, mut beyond, mut stored) = (0, 0, 0);
    for i in 0..200_000 {
        let range = [[0.0, 1.0], [1.0, 0.0], [-1.0, 1.0], [1.0, -1.0]][i % 4];
        let near = rng.log_uniform(1e-3, 1e3);
        let far = near * rng.log_uniform(1.1, 1e9);
        let map = DepthMap::onto(range, near, far).expect("valid");
        let format = FORMATS[rng.index(5)];
        let gap = far * rng.log_uniform(1e-9, 1e-1);
        let until = map.separable_until(format.steps, gap);
        assert!(until >= gap, "{until} of {gap}");
        if until > near {
            let z = rng.log_uniform(near, until.min(far));
            let resolution = map.resolution(format.steps, z);
            let allowed = gap * (1.0 + 10.0 / 16_777_216.0);
            assert!(resolution <= allowed, "{resolution} of {gap} at {z}, until {until}, {format:?} {map:?}");
            inside += 1;
        }
        // Near the eye the steps of f32 are finer than at the far plane, which is what a depth is named for.
        let twice = 2.0 * until;
        if twice < far && twice > 4.0 * near {
            let resolution = map.resolution(format.steps, twice);
            assert!(resolution > gap, "{resolution} of {gap} at {twice}, {format:?} {map:?}");
            beyond += 1;
        }
        let map = format.map(near, far);
        let quarter = (map.separable_until(format.steps, gap) / 4.0).min(far);
        if quarter > near + gap {
            let z = rng.log_uniform(near + gap, quarter);
            let [a, b, at_near, at_far] = [z - gap, z, near, far].map(|z| format.stored(&map, z));
            if a != at_near && b != at_far {
                assert!(a != b, "{format:?}: {gap} at {z} between {near} and {far}");
                stored += 1;
            }
        }
    }
    println!("{inside} inside, {beyond} beyond, {stored} pairs stored");
    assert!(inside > 100_000 && beyond > 20_000 && stored > 50_000);
}

/// Gaps down to the least that the format is chosen for, where it has the least to spare.
#[test]
fn the_cheapest_format_stores_the_gap_before_the_far_plane() {
    let mut rng = Rng::stream(run_seed(), 5);
    let mut checked = [0; 5];
    for i in 0..40_000 {
        let near = rng.log_uniform(1e-3, 1e3);
        let far = near * (1.0 + rng.log_uniform(1e-2, 1e9));
        // At each format in turn: about its own limit, from below and from above.
        let format = FORMATS[i % 5];
        let resolution = format.map(near, far).resolution(format.steps, far);
        let gap = resolution * rng.log_uniform(0.9, 8.0);
        let Some((steps, map)) = DepthMap::cheapest(near, far, gap).expect("0 < near < far") else {
            continue;
        };
        let nearer = far - gap;
        if nearer < near {
            continue;
        }
        let reversed = map.beta() > 0.0;
        let index =
            FORMATS.iter().position(|f| f.steps == steps && f.reversed == reversed).expect("a format");
        let [a, b] = [far, nearer].map(|z| FORMATS[index].stored(&map, z));
        assert!(a != b, "{steps:?}, reversed {reversed}: {far} and {nearer}, near {near}, gap {gap}");
        checked[index] += 1;
    }
    println!("stored apart: {checked:?}");
    assert!([checked[0], checked[1], checked[4]].iter().all(|&n| n > 2_000), "{checked:?}");
}

/// A plane whose 1/z is linear on the screen, drawn as a triangle around a pixel: the zs of that pixel.
fn drawn(probe: &mut Probe<Recorded>, rng: &mut Rng, map: &DepthMap, plane: &Plane) -> Option<f32> {
    let reach = f64::from(rng.log_uniform(2.0, 300.0));
    let vertices = [(); 3].map(|()| {
        let p = plane.pixel.map(|c| f64::from(c) + 0.5 + rng.uniform(-reach, reach));
        let z = (1.0 / plane.q(p)) as f32;
        unsnapped(p.map(|c| (c * 65_536.0).floor() as i64), map.zs(z), 1.0 / z, ())
    });
    let within = |v: &Vertex<()>| (plane.planes[0]..plane.planes[1]).contains(&(1.0 / v.q));
    if !vertices.iter().all(within) {
        return None;
    }
    probe.interpolated(&vertices, plane.pixel).map(|((), zs)| zs)
}

struct Plane {
    pixel: [i32; 2],
    q: f64,
    gradient: [f64; 2],
    planes: [f32; 2],
}

impl Plane {
    fn q(&self, p: [f64; 2]) -> f64 {
        let [x, y] = [0, 1].map(|k| p[k] - f64::from(self.pixel[k]) - 0.5);
        self.q + self.gradient[0] * x + self.gradient[1] * y
    }
}

/// Slanted planes of other triangles each: as far apart as `drawn_resolution` says, the nearer one is stored nearer.
/// At the resolution of zs alone it often is not.
#[test]
fn slanted_surfaces_are_told_apart_as_they_are_drawn() {
    let mut rng = Rng::stream(run_seed(), 6);
    let mut probe = Probe::new(Recorded, Subpixel::Sub8);
    let (mut checked, mut closer, mut wrong) = ([0; 5], 0, 0);
    for i in 0..400_000 {
        let format = FORMATS[i % 5];
        let near = rng.log_uniform(1e-2, 10.0);
        let planes = [near, near * rng.log_uniform(10.0, 1e6)];
        let map = format.map(planes[0], planes[1]);
        let z = rng.log_uniform(planes[0], planes[1]);
        let slope = rng.log_uniform(1e-6, 3e-2);
        let resolution = map.drawn_resolution(format.steps, z, slope, Subpixel::Sub8);
        // What is needed, or what zs alone would take.
        let enough = rng.one_in(2);
        let gap = if enough { resolution } else { 4.0 * map.resolution(format.steps, z) };
        let pixel = [(); 2].map(|()| rng.range(1000, 2000) as i32);
        let share = rng.uniform(-1.0, 1.0);
        let at = |z: f64| {
            let both = [share, (1.0 - share.abs()).copysign(share)];
            Plane { pixel, q: 1.0 / z, gradient: both.map(|part| part * f64::from(slope) / z), planes }
        };
        let [farther, nearer] = [f64::from(z), f64::from(z) - f64::from(gap)].map(at);
        let zs = [drawn(&mut probe, &mut rng, &map, &farther), drawn(&mut probe, &mut rng, &map, &nearer)];
        let [Some(a), Some(b)] = zs else { continue };
        let ends = planes.map(|z| format.stored(&map, z));
        let [a, b] = [a, b].map(format.encode);
        if ends.contains(&a) || ends.contains(&b) {
            continue;
        }
        let right = if format.reversed { b > a } else { b < a };
        if enough {
            assert!(right, "{format:?}: {gap} at {z}, slope {slope}, {planes:?}");
            checked[i % 5] += 1;
        } else if gap < resolution {
            closer += 1;
            wrong += u32::from(!right);
        }
    }
    println!("told apart {checked:?}; of {closer} that are closer {wrong} wrong");
    assert!(checked.iter().all(|&n| n > 500) && wrong * 20 > closer, "{checked:?}, {wrong} of {closer}");
}

/// The cheapest format of surfaces as they are drawn keeps the gap at the far plane, and none before it does.
#[test]
fn the_cheapest_format_of_drawn_surfaces_is_found() {
    let mut rng = Rng::stream(run_seed(), 7);
    let mut found = [0; 6];
    for _ in 0..20_000 {
        let near = rng.log_uniform(1e-3, 1e3);
        let far = near * rng.log_uniform(2.0, 1e7);
        let (gap, slope) = (far * rng.log_uniform(1e-7, 1.0), rng.log_uniform(1e-7, 1e-1));
        let does = |format: &Format| {
            let map = format.map(near, far);
            map.drawn_resolution(format.steps, far, slope, Subpixel::Sub4) <= gap
        };
        let expected = FORMATS.iter().position(does);
        let got = DepthMap::cheapest_drawn([near, far], gap, slope, Subpixel::Sub4).expect("0 < near < far");
        let same = |(steps, map): (DepthSteps, DepthMap)| {
            FORMATS.iter().position(|f| f.steps == steps && f.reversed == (map.beta() > 0.0))
        };
        assert_eq!(got.and_then(same), expected);
        found[expected.unwrap_or(5)] += 1;
    }
    println!("{found:?}");
    assert!([found[0], found[1], found[5]].iter().all(|&n| n > 500), "{found:?}");
}

/// Against z - z' in f64, z' being one step nearer, where the answer is beyond doubt.
#[test]
fn the_cheapest_format_that_does_is_found() {
    let mut rng = Rng::stream(run_seed(), 3);
    let mut found = [0; 4];
    for _ in 0..100_000 {
        let near = rng.log_uniform(1e-3, 1e3);
        let far = near * rng.log_uniform(2.0, 1e8);
        let gap = far * rng.log_uniform(1e-9, 1.0);
        let [a, b, wanted] = [near, far, gap].map(f64::from);
        // zs = 1 - step at z' = AB / (A + step (B - A)).
        let dz = |step: f64| b - a * b / (a + step * (b - a));
        let clear = |dz: f64| !(0.999..1.001).contains(&(dz / wanted));
        // Twice that, or four times where f32 is as coarse as the format.
        let integers = [2.0 * dz(1.0 / 65_535.0), 4.0 * dz(1.0 / 16_777_215.0)];
        let float = [4.0 * b * 2f64.powi(-24), 4.0 * b * 2f64.powi(-23)];
        let expected = match () {
            () if !integers.into_iter().all(clear) => continue,
            () if integers[0] < wanted => Some((DepthSteps::D16, false)),
            () if integers[1] < wanted => Some((DepthSteps::D24, false)),
            () if float[1] < wanted => Some((DepthSteps::F32, true)),
            () if float[0] > wanted => None,
            () => continue,
        };
        let got = DepthMap::cheapest(near, far, gap).expect("0 < near < far");
        assert_eq!(got.map(|(steps, map)| (steps, map.beta() > 0.0)), expected, "{gap} from {near} to {far}");
        found[expected.map_or(3, |(steps, _)| match steps {
            DepthSteps::D16 => 0,
            DepthSteps::D24 => 1,
            _ => 2,
        })] += 1;
    }
    println!("D16, D24, F32 reversed, none: {found:?}");
    assert!(found.iter().all(|&n| n > 2_000), "{found:?}");
}

/// Neighbouring f32 between the planes, onto any range: never out of order, never out of range.
#[test]
fn order_is_kept_or_reversed_by_the_sign_of_beta() {
    let mut rng = Rng::stream(run_seed(), 4);
    let mut apart = [0u32; 2];
    for _ in 0..400_000 {
        let [c, d] = [(); 2].map(|()| rng.uniform(-1.0, 1.0) as f32 * rng.log_uniform(1e-3, 1e6));
        let near = rng.log_uniform(1e-30, 1e30);
        let far = if rng.one_in(8) { f32::INFINITY } else { near * rng.log_uniform(1.01, 1e7) };
        let Ok(map) = DepthMap::onto([c, d], near, far) else { continue };
        let z = rng.log_uniform(near, (near * 1e7).min(far)).min(far.next_down());
        let [this, next] = [z, z.next_up()].map(|z| map.zs(z));
        assert!(if map.beta() < 0.0 { this <= next } else { this >= next }, "{this} {next} at {z}, {map:?}");
        assert_eq!(map.beta() < 0.0, c < d);
        assert!([this, next].iter().all(|zs| map.range()[0] <= *zs && *zs <= map.range()[1]));
        assert!(map.z(this) > 0.0, "{this} {map:?}");
        apart[usize::from(c < d)] += u32::from(this != next);
    }
    println!("told apart {apart:?}");
    assert!(apart.iter().all(|&n| n > 20_000), "{apart:?}");
}
