//! Large triangles carry what their vertices have where these were before snapping: against arithmetic of 106 bits on
//! the triangle before, or on the one after where the documented rule says so.
//!
//! Triangles are those of `attributes.rs`; slivers along whose edges vertices are moved; and steep ones, whose far edge
//! is moved along itself. A third of them are as steep as the rule lets them be.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "subpixels are within the guard band"
)]

use alberti_math::{Fixed, Linear, Subpixel};
use alberti_oracle::cases::pixel_centre;
use alberti_oracle::climb::climb;
use alberti_oracle::coverage::{Triangle, area2, covers};
use alberti_oracle::dd::{self, Dd};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::Vertex;
use alberti_tests::attributes::{any_case, any_u, any_zs, within};
use alberti_tests::probe::{LARGEST, Probe, Recorded, snapped, unsnapped};
use alberti_tests::sweep::or_swept;

const EPS: f64 = 1.0 / (1 << 24) as f64;

/// The plane in which a triangle's values lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Plane {
    Before,
    After,
    /// Next to the limit of the rule, which the code decides in floats.
    Either,
}

/// The rule for a triangle in 256ths of subpixels: its box after snapping has 65 pixels, and before, for each vertex,
/// the doubled area is at least 32 (|x| + |y|) q/min q, (x, y) being the opposite edge.
pub(crate) fn plane(parts: Triangle, q: [f32; 3], subpixel: Subpixel) -> Plane {
    let after = parts.map(snapped);
    let length = |k: usize| {
        let at = after.map(|corner| corner[k]);
        at.iter().max().unwrap() - at.iter().min().unwrap()
    };
    if length(0).max(length(1)) < 65 << subpixel.bits() {
        return Plane::After;
    }
    let least = q.into_iter().reduce(f32::min).map_or(1.0, f64::from);
    let heights = heights(parts).map(|height| height * area2(after).signum() as f64);
    match (0..3).map(|i| heights[i] * least / f64::from(q[i])).fold(f64::INFINITY, f64::min) {
        ..0.999_999 => Plane::After,
        1.000_001.. => Plane::Before,
        _ => Plane::Either,
    }
}

/// The doubled area over 32 times the length |x| + |y| of each vertex's opposite edge, in subpixels.
fn heights(parts: Triangle) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let (from, to) = (parts[(i + 1) % 3], parts[(i + 2) % 3]);
        let edge = (to[0] - from[0]).abs() + (to[1] - from[1]).abs();
        area2(parts) as f64 / (32.0 * 256.0 * edge as f64)
    })
}

/// A triangle in 256ths of subpixels with what it carries, and a pixel that it covers after snapping.
#[derive(Clone, Copy, Debug)]
struct Moved {
    parts: Triangle,
    pixel: [i32; 2],
    q: [f32; 3],
    zs: [f32; 3],
    u: [f32; 3],
}

impl Moved {
    /// Of one of the kinds; none if it covers no pixel, or is beyond the guard band.
    fn any(subpixel: Subpixel, rng: &mut Rng) -> Option<Self> {
        let (kind, zs) = (rng.index(4), any_zs(rng));
        let u = if rng.one_in(2) { any_u(rng) } else { near_one(rng) };
        let Shape { tri, pixel, moved, q } = match kind {
            0 => anywhere(subpixel, rng),
            1 => diagonal(subpixel, rng),
            2 => sliver(subpixel, rng),
            _ => horizon(subpixel, rng),
        };
        let guard = i64::from(Fixed::LIMIT) >> (8 - subpixel.bits());
        let seen = pixel.iter().all(|c| (0..LARGEST).contains(c));
        let within = tri.iter().flatten().all(|c| c.abs() < guard);
        let parts = by(tri, moved);
        let q = if rng.one_in(3) { limit(heights(parts), rng) } else { q };
        let found = Self { parts, pixel, q, zs, u };
        (seen && within && covers(tri, found.sample(subpixel))).then_some(found)
    }

    fn sample(&self, subpixel: Subpixel) -> [i64; 2] {
        pixel_centre(self.pixel[0].into(), self.pixel[1].into(), subpixel.bits())
    }

    fn covers(&self, subpixel: Subpixel) -> bool {
        covers(self.parts.map(snapped), self.sample(subpixel))
    }

    /// One beside it: each number stays, or is changed by a step of any size.
    fn beside(self, rng: &mut Rng) -> Self {
        let step = |rng: &mut Rng, least: f32, most: f32| {
            let by = f64::from(rng.log_uniform(least, most));
            if rng.one_in(4) { rng.uniform(-by, by) } else { 0.0 }
        };
        let near = |rng: &mut Rng, x: f32| (f64::from(x) * (1.0 + step(rng, 1e-8, 1e-2))) as f32;
        Self {
            parts: self.parts.map(|corner| corner.map(|c| c + step(rng, 1.0, 1e5) as i64)),
            pixel: self.pixel.map(|c| c + step(rng, 1.0, 10.0) as i32),
            q: self.q.map(|q| near(rng, q)),
            u: self.u.map(|u| near(rng, u)),
            ..self
        }
    }

    fn vertices<V>(&self, varying: impl Fn(f32) -> V) -> [Vertex<V>; 3] {
        [0, 1, 2].map(|i| unsnapped(self.parts[i], self.zs[i], self.q[i], varying(self.u[i])))
    }

    /// The shares of the documented bounds that the value and the depth make use of, and the plane in which they lie.
    fn used(&self, probe: &mut Probe<Recorded>, subpixel: Subpixel, linear: bool) -> ([f64; 2], Plane) {
        let [before, after] = self.shares(probe, subpixel, linear);
        let plane = plane(self.parts, self.q, subpixel);
        let used = match plane {
            Plane::Before => before,
            Plane::After => after,
            // Of both numbers the same one.
            Plane::Either if before[0].max(before[1]) < after[0].max(after[1]) => before,
            Plane::Either => after,
        };
        (used, plane)
    }

    /// The same as if they lay in the plane before, and in the one after.
    fn shares(&self, probe: &mut Probe<Recorded>, subpixel: Subpixel, linear: bool) -> [[f64; 2]; 2] {
        let Self { parts, pixel, q, u, zs, .. } = *self;
        let (value, depth) = if linear {
            let found = probe.interpolated(&self.vertices(Linear), pixel);
            found.map(|(Linear(u), zs)| (u, zs)).expect("covered")
        } else {
            probe.interpolated(&self.vertices(|u| u), pixel).expect("covered")
        };
        assert!(within(value, u) && within(depth, zs), "{value} or {depth} outside: {self:?}");
        let on = |tri: Triangle, sample, more: f64| {
            let exact = if linear { dd::linear(tri, sample, u) } else { dd::hyperbolic(tri, sample, q, u) };
            [
                share(value, exact, u, [0.0, 9.0 + more]),
                share(depth, dd::linear(tri, sample, zs), zs, [6.0, more / 2.0]),
            ]
        };
        let (after, sample) = (parts.map(snapped), self.sample(subpixel));
        [on(parts, sample.map(|c| 256 * c), 4.0), on(after, sample, 0.0)]
    }
}

/// The share of a bound: so many ε of the exact value, and of the greatest one. Results are kept within the range.
fn share(found: f32, exact: Dd, values: [f32; 3], [relative, absolute]: [f64; 2]) -> f64 {
    let [least, most] =
        [f32::min, f32::max].map(|pick| values.into_iter().reduce(pick).map_or(0.0, f64::from));
    let exact = exact.to_f64().clamp(least, most);
    let bound = EPS * (relative * exact.abs() + absolute * least.abs().max(most.abs()));
    let error = (f64::from(found) - exact).abs();
    if error > 0.0 { error / bound } else { 0.0 }
}

/// A triangle after snapping, a pixel, what was moved, in 256ths, and q.
struct Shape {
    tri: Triangle,
    pixel: [i32; 2],
    moved: Triangle,
    q: [f32; 3],
}

/// Values near one another, and near to where steps of `f32` double: their roundings do not get smaller with them.
fn near_one(rng: &mut Rng) -> [f32; 3] {
    let spread = f64::from(rng.log_uniform(1e-5, 1e-2));
    [(); 3].map(|()| 1.0 + rng.uniform(-spread, spread) as f32)
}

/// As great a q as the rule lets each vertex have, or some less.
fn limit(heights: [f64; 3], rng: &mut Rng) -> [f32; 3] {
    let mut q = heights.map(|height| {
        let less = f64::from(rng.log_uniform(1e-5, 0.9));
        (height.abs() * (1.0 - less)).clamp(1.0, 1e12) as f32
    });
    q[rng.index(3)] = 1.0;
    q
}

/// The triangle before snapping.
fn by(tri: Triangle, moved: Triangle) -> Triangle {
    [0, 1, 2].map(|i| [0, 1].map(|k| 256 * tri[i][k] + moved[i][k]))
}

pub(crate) fn any_move(rng: &mut Rng) -> [i64; 2] {
    [(); 2].map(|()| rng.range(-128, 127))
}

/// A move along a direction.
fn along(rng: &mut Rng, [x, y]: [i64; 2]) -> [i64; 2] {
    let most = 127 / x.abs().max(y.abs());
    let k = rng.range(-most, most);
    [k * x, k * y]
}

fn any_pixel(rng: &mut Rng) -> [i32; 2] {
    let reach = if rng.one_in(2) { 2000 } else { i64::from(LARGEST) - 1 };
    [(); 2].map(|()| rng.range(0, reach) as i32)
}

/// One of `attributes.rs`, moved anyhow.
fn anywhere(subpixel: Subpixel, rng: &mut Rng) -> Shape {
    let case = any_case(subpixel, rng);
    Shape { tri: case.tri, pixel: case.pixel, moved: [(); 3].map(|()| any_move(rng)), q: case.q() }
}

/// A diagonal and a point a subpixel beside it, all moved along.
fn diagonal(subpixel: Subpixel, rng: &mut Rng) -> Shape {
    let one = 1 << subpixel.bits();
    let pixel = [(); 2].map(|()| rng.range(0, 300) as i32);
    let center = pixel_centre(pixel[0].into(), pixel[1].into(), subpixel.bits());
    let near = rng.range(1, 4000);
    let start = rng.range(0, near);
    let far = f64::from(rng.log_uniform(100.0, 32000.0)) as i64 * one - rng.range(0, 400);
    let a = center.map(|c| c - start);
    let beside = if rng.one_in(2) { [far + 1, far] } else { [far, far + 1] };
    let tri = [a, [a[0] + beside[0], a[1] + beside[1]], a.map(|c| c + near)];
    let [most, last] = [(); 2].map(|()| along(rng, [1, 1]));
    let q = [(); 3].map(|()| rng.log_uniform(1.0, 2.0));
    Shape { tri, pixel, moved: [most, most, if rng.one_in(2) { last } else { most }], q }
}

/// Slivers along any direction, from half a subpixel to thousands wide, moved along it.
fn sliver(subpixel: Subpixel, rng: &mut Rng) -> Shape {
    let one = f64::from(1 << subpixel.bits());
    let pixel = any_pixel(rng);
    let center = pixel_centre(pixel[0].into(), pixel[1].into(), subpixel.bits());
    let direction = [rng.range(1, 9), rng.range(-9, 9)];
    let wide = f64::from(rng.log_uniform(0.5, 3000.0));
    let mut at = |sign: i64| {
        let length = (f64::from(rng.log_uniform(60.0, 30_000.0)) * one / 9.0) as i64 * sign;
        [0, 1].map(|k| center[k] + length * direction[k] + rng.uniform(-wide, wide) as i64)
    };
    let tri = [at(-1), at(1), at(1)];
    let moved = [(); 3].map(|()| along(rng, direction));
    let ratio = rng.log_uniform(1.0, 1e6);
    Shape { tri, pixel, moved, q: [(); 3].map(|()| rng.log_uniform(1.0, ratio)) }
}

/// Steep ones: an edge as far as 10^12 times the third vertex, through the pixel or beside it, moved along itself.
fn horizon(subpixel: Subpixel, rng: &mut Rng) -> Shape {
    let one = f64::from(1 << subpixel.bits());
    let pixel = any_pixel(rng);
    let center = pixel_centre(pixel[0].into(), pixel[1].into(), subpixel.bits());
    let direction = [rng.range(1, 9), rng.range(1, 9)];
    let beside = f64::from(rng.log_uniform(1.0, 300.0));
    let mut far = |sign: i64| {
        let length = (f64::from(rng.log_uniform(60.0, 15_000.0)) * one / 9.0) as i64 * sign;
        [0, 1].map(|k| center[k] + length * direction[k] + rng.uniform(-beside, beside) as i64)
    };
    let (a, c) = (far(-1), far(1));
    let away = (f64::from(rng.log_uniform(20.0, 15_000.0)) * one) as i64;
    let b = [center[0] + away, center[1] - away];
    let near = if rng.one_in(2) { any_move(rng) } else { along(rng, direction) };
    let deep = if rng.one_in(2) { 1e3 } else { 1e12 };
    let z = rng.log_uniform(1.0, deep);
    let q = [1.0 / z, 1.0, 1.0 / (z * rng.log_uniform(0.25, 4.0))];
    Shape { tri: [a, b, c], pixel, moved: [along(rng, direction), near, along(rng, direction)], q }
}

fn large_ones(subpixel: Subpixel, stream: u64, linear: bool) {
    let mut probe = Probe::new(Recorded, subpixel);
    let (samples, steps) = or_swept((100_000, 20_000), (1_000_000, 500_000));
    for which in [0, 1] {
        let mut counts = [0; 2];
        // The planes are climbed apart, so that neither hides the other.
        for (count, wanted) in counts.iter_mut().zip([Plane::Before, Plane::After]) {
            let found = climb(run_seed() ^ stream, samples, steps, |rng| {
                let Some(case) = Moved::any(subpixel, rng) else { return 0.0 };
                let (used, plane) = case.used(&mut probe, subpixel, linear);
                assert!(used[which] <= 1.0, "{:.3} of the bound: {case:?}, {plane:?}", used[which]);
                *count += u64::from(plane == wanted);
                if plane == wanted { used[which] } else { 0.0 }
            });
            println!("{subpixel:?}, linear: {linear}, {which}: {found:?}, {wanted:?}");
            assert!(found.most > 0.2, "the bound is not tested: {found:?}, {wanted:?}");
        }
        assert!(counts.iter().all(|&count| count > samples / 10), "{counts:?} of {samples}");
    }
}

#[test]
fn in_space_with_eight_bits() {
    large_ones(Subpixel::Sub8, 31, false);
}

#[test]
fn on_the_screen_with_four_bits() {
    large_ones(Subpixel::Sub4, 32, true);
}

#[test]
fn in_space_with_four_bits() {
    large_ones(Subpixel::Sub4, 33, false);
}

/// A triangle after snapping, what was moved, q, u and a pixel.
type Known = (Subpixel, Triangle, Triangle, [f32; 3], [f32; 3], [i32; 2]);

fn known((_, tri, moved, q, u, pixel): Known) -> Moved {
    Moved { parts: by(tri, moved), pixel, q, zs: [0.25, 0.75, 0.5], u }
}

/// Triangles whose vertices move along their edges, too narrow or too steep for their planes: the rule refuses them.
#[test]
fn moves_along_edges_that_are_refused() {
    let cases: [Known; 4] = [
        (
            Subpixel::Sub8,
            [[231_752, 302_904], [322_399, 502_289], [323_182, 504_050]],
            [[-35, -77], [-35, -77], [-50, -110]],
            [2.864_914_7e-6, 1.0, 1.792_669_7e-6],
            [-1.0, -1.0, 1.0],
            [1244, 1929],
        ),
        (
            Subpixel::Sub4,
            [[161_135, 169_425], [311_279, 21_345], [243_764, 233_692]],
            [[-117, -91], [-58, -128], [-36, -28]],
            [1.957_313_4e-12, 1.0, 1.828_013_4e-12],
            [-1.0, 1.0, 1.0],
            [10_143, 10_645],
        ),
        (
            Subpixel::Sub4,
            [[-8936, -115_384], [118_369, 46_591], [124_715, 56_453]],
            [[14, 18], [-36, 105], [-77, -99]],
            [3.511_573_6e-6, 1.0, 1.926_123e-6],
            [1.0, -1.0, 1.0],
            [7351, 2958],
        ),
        (
            Subpixel::Sub8,
            [[67_711, 29_055], [5_914_877, 5_876_220], [67_718, 29_062]],
            [[-56, -56], [-56, -56], [-70, -70]],
            [1.252_779_5, 1.354_111_3, 1.848_667_3],
            [0.673_412_9, -0.441_444_46, -0.782_076_36],
            [264, 113],
        ),
    ];
    for case in cases {
        let (used, plane) = known(case).used(&mut Probe::new(Recorded, case.0), case.0, false);
        println!("{used:?}, {plane:?}");
        assert!(plane == Plane::After && used.iter().all(|&used| used <= 1.0), "{used:?} of {case:?}");
    }
}

/// The same next to the limit of the rule, where products cancel: moved above it, refused below it. Either plane is
/// beyond the bounds of the other.
#[test]
fn moves_along_edges_next_to_the_limit() {
    // An edge along (4, 3), 40,000 subpixels long, and a vertex above its middle, by so many times (-3, 4). The area
    // is as many times 200,000, the edge's |x| + |y| is 56,000: the limit is at 8.96.
    let sliver = |height: i64| -> Known {
        let [x, y] = pixel_centre(700, 500, 8);
        let a = [x - 12_000 + 9, y - 9_000 - 12];
        let tri =
            [a, [a[0] + 16_000 - 3 * height, a[1] + 12_000 + 4 * height], [a[0] + 32_000, a[1] + 24_000]];
        let moved = [[-124, -93], [120, 90], [124, 93]];
        (Subpixel::Sub8, tri, moved, [1.0; 3], [-1.0, 1.0, 1.0], [700, 500])
    };
    // The heights of the second vertex are 4655.72 and 23.27 times the least ones.
    let [second, third] = [
        |q| -> Known {
            (
                Subpixel::Sub4,
                [[161_135, 169_425], [311_279, 21_345], [243_764, 233_692]],
                [[-117, -91], [-58, -128], [117, 91]],
                [1.0, q, 1.0],
                [-1.0, 1.0, 1.0],
                [10_143, 10_645],
            )
        },
        |q| -> Known {
            (
                Subpixel::Sub4,
                [[-8936, -115_384], [118_369, 46_591], [124_715, 56_453]],
                [[98, 126], [-36, 105], [-98, -126]],
                [1.0, q, 1.0],
                [1.0, -1.0, -1.0],
                [7351, 2958],
            )
        },
    ];
    let cases = [
        (sliver(9), Plane::Before),
        (sliver(8), Plane::After),
        (second(4655.0), Plane::Before),
        (second(4657.0), Plane::After),
        (third(23.26), Plane::Before),
        (third(23.29), Plane::After),
    ];
    for (case, expected) in cases {
        let [before, after] = known(case).shares(&mut Probe::new(Recorded, case.0), case.0, false);
        println!("{before:?} before, {after:?} after, {expected:?}");
        let [used, other] = if expected == Plane::Before { [before, after] } else { [after, before] };
        assert_eq!(plane(known(case).parts, case.3, case.0), expected, "{case:?}");
        assert!(used.iter().all(|&used| used <= 1.0) && other[0] > 1.0, "{used:?}, {other:?} of {case:?}");
    }
}

/// From the worst that is known, by steps of any size in all that it is made of.
#[test]
fn values_near_one_another() {
    let parts = [[934_288, 16_398_450], [1_007_068, 16_407_881], [1_305_056, 15_996_544]];
    let (q, u) = ([6504.349, 4626.3784, 9124.507], [0.999_374_5, 1.000_000_2, 1.000_450_3]);
    let known = Moved { parts, pixel: [314, 3910], q, zs: [0.25, 0.75, 0.5], u };
    let subpixel = Subpixel::Sub4;
    let mut probe = Probe::new(Recorded, subpixel);
    let (used, plane) = known.used(&mut probe, subpixel, false);
    assert!(plane == Plane::Before && used[0] > 7.0 / 13.0, "{used:?}, {plane:?}");
    // It is one of the cases itself.
    let steps = or_swept(20_000, 1_000_000);
    let found = climb(run_seed() ^ 35, steps, steps, |rng| {
        let case = known.beside(rng);
        if !case.covers(subpixel) {
            return 0.0;
        }
        let (used, plane) = case.used(&mut probe, subpixel, false);
        assert!(used[0] <= 1.0, "{:.3} of the bound: {case:?}, {plane:?}", used[0]);
        if plane == Plane::Before { used[0] } else { 0.0 }
    });
    println!("{:.3}ε, climbed {:.3}ε", 13.0 * used[0], 13.0 * found.most);
    assert!(found.most >= used[0], "{found:?}");
}
