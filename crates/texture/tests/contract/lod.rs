//! The level of detail against real numbers.

use alberti_math::lanes::{Lanes, Machine, One, OneFixed};
use alberti_math::{Q16, for_lanes};
use alberti_texture::{Gradient, LodBounds};
use glam::Vec2;

use crate::oracle::Random;

/// The definition, in `f64`.
fn exact(d: Gradient<[f64; 2]>, [width, height]: [u32; 2]) -> f64 {
    let (w, h) = (f64::from(width), f64::from(height));
    (d.dx[0] * w).hypot(d.dx[1] * h).max((d.dy[0] * w).hypot(d.dy[1] * h)).log2()
}

pub(crate) fn map<A: Copy, B>(d: Gradient<[A; 2]>, mut f: impl FnMut(A) -> B) -> Gradient<[B; 2]> {
    Gradient { dx: [f(d.dx[0]), f(d.dx[1])], dy: [f(d.dy[0]), f(d.dy[1])] }
}

/// A pixel as a rectangle in the texture, `long` x `long / ratio` texels, turned by `angle` on the texture and by
/// `turn` on the screen.
pub(crate) fn footprint(
    long: f64,
    ratio: f64,
    angle: f64,
    turn: f64,
    [width, height]: [u32; 2],
) -> Gradient<[f64; 2]> {
    let axes =
        [(angle.cos() * long, angle.sin() * long), (-angle.sin() * long / ratio, angle.cos() * long / ratio)];
    let mix = |a: f64, b: f64, part: fn((f64, f64)) -> f64| part(axes[0]) * a + part(axes[1]) * b;
    let (c, s) = (turn.cos(), turn.sin());
    Gradient {
        dx: [mix(c, s, |axis| axis.0) / f64::from(width), mix(c, s, |axis| axis.1) / f64::from(height)],
        dy: [mix(-s, c, |axis| axis.0) / f64::from(width), mix(-s, c, |axis| axis.1) / f64::from(height)],
    }
}

/// 10^5 rotations, anisotropy up to 1000, every kind of lanes.
#[test]
fn rotations_and_anisotropy() {
    let mut random = Random(70);
    let mut worst = [0.0f64; 2];
    let mut unit = || f64::from(random.bits()) / 2f64.powi(32);
    for i in 0..100_000 {
        let size = [[256, 256], [1000, 37], [16384, 1], [2, 512]][i % 4];
        let angle = i as f64 * std::f64::consts::TAU / 100_000.0;
        let (ratio, long) = (1000f64.powf(unit()), 2f64.powf(unit() * 16.0 - 2.0));
        let d = footprint(long, ratio, angle, unit() * 7.0, size);
        let floats = map(d, |d| d as f32);
        let found = floats.lod(size[0], size[1]);
        // The derivatives are rounded before, by up to ε.
        worst[0] = worst[0].max((f64::from(found) - exact(d, size)).abs());
        for machine in Machine::all() {
            let same = for_lanes!(machine, lanes => {
                let d = map(floats, |d| lanes.splat(d));
                let d = Gradient::between([lanes.splat(0.0); 2], [d.dx[0], d.dx[1]], [d.dy[0], d.dy[1]]);
                lanes.store(d.lod_lanes(lanes, size)).as_ref()[0]
            });
            assert_eq!(same.to_bits(), found.to_bits());
        }
        let fixed = map(floats, Q16::from_f32);
        let rounded = map(fixed, |d| f64::from(d.to_bits()) / 65536.0);
        let expected = exact(rounded, size);
        if expected < 15.0 && expected > -16.0 {
            let found = f64::from(fixed.lod_lanes(OneFixed, size).to_bits()) / 65536.0;
            worst[1] = worst[1].max((found - expected).abs());
        }
    }
    println!("λ: at most {:?} of 2^-11 off, floats and integers", worst.map(|worst| worst * 2048.0));
    let within = |(worst, bound): (&f64, f64)| *worst > 0.8 / 2048.0 && *worst <= bound / 2048.0;
    assert!(worst.iter().zip([1.0, 1.1]).all(within), "{worst:?}");
}

#[test]
fn defined_for_any_bits() {
    let mut random = Random(71);
    for _ in 0..200_000 {
        let d = map(Gradient::default(), |()| random.float());
        let lambda = d.lod(16384, 16384);
        assert!((-63.5..=64.0).contains(&lambda), "{d:?}: {lambda}");
        let q = map(Gradient::default(), |()| Q16::from_bits(random.bits().cast_signed()));
        let lambda = q.lod_lanes(OneFixed, [16384, 16384]);
        assert!((Q16::from_bits(-16 << 16)..=Q16::from_bits(16 << 16)).contains(&lambda));
    }
    assert!((Gradient::<[f32; 2]>::default().lod(64, 64) + 63.5).abs() <= 0.0);
    let bounds = LodBounds { bias: 1.0, least: -2.0, greatest: 5.0 };
    assert_eq!([-9.0, 0.5, 7.0, f32::NAN].map(|lambda| bounds.bound(lambda)), [-2.0, 1.5, 5.0, -2.0]);
}

/// The axes of a footprint in texels, by the eigenvalues and eigenvectors of J Jᵀ in `f64`, the longer one first. All
/// that cancels there is 2^-52 of the longer one's square.
fn exact_axes(d: Gradient<[f64; 2]>, [width, height]: [u32; 2]) -> [[f64; 2]; 2] {
    let (w, h) = (f64::from(width), f64::from(height));
    let [x, y] = [[d.dx[0] * w, d.dx[1] * h], [d.dy[0] * w, d.dy[1] * h]];
    let [uu, uv, vv] = [x[0] * x[0] + y[0] * y[0], x[0] * x[1] + y[0] * y[1], x[1] * x[1] + y[1] * y[1]];
    let major = ((uu + vv) / 2.0 + ((uu - vv) / 2.0).hypot(uv)).sqrt();
    let minor = (x[0] * y[1] - x[1] * y[0]).abs() / major;
    let (s, c) = (uv.atan2((uu - vv) / 2.0) / 2.0).sin_cos();
    [[c * major, s * major], [-s * minor, c * minor]]
}

/// How far found axes are off, as shares of the longer one, A: their lengths, and the cosine between them times both
/// lengths; and how far the longer one is beside its line, times 1 - B²/A².
fn off_axes(found: Gradient<[f64; 2]>, exact: [[f64; 2]; 2], [width, height]: [u32; 2]) -> [f64; 3] {
    let (w, h) = (f64::from(width), f64::from(height));
    let mut found = [[found.dx[0] * w, found.dx[1] * h], [found.dy[0] * w, found.dy[1] * h]];
    let length = |v: [f64; 2]| v[0].hypot(v[1]);
    if length(found[0]) < length(found[1]) {
        found.swap(0, 1);
    }
    let [a, b] = exact.map(length);
    let cross = |v: [f64; 2], w: [f64; 2]| (v[0] * w[1] - v[1] * w[0]).abs();
    let [major, minor] = found;
    let off = (length(major) - a).abs().max((length(minor) - b).abs()) / a;
    let cosine = (major[0] * minor[0] + major[1] * minor[1]).abs() / (a * a);
    [off, cosine, cross(major, exact[0]) / (a * a) * (1.0 - b * b / (a * a))]
}

/// Footprints turned by any angle on the texture and on the screen, axes up to 1000 times as long as the other one,
/// every kind of lanes; lengths over all of the range.
#[test]
fn axes_are_those_of_the_ellipse() {
    let mut random = Random(74);
    let (mut floats, mut integers) = ([0.0f64; 3], [0.0f64; 3]);
    let mut unit = || f64::from(random.bits()) / 2f64.powi(32);
    for i in 0..100_000 {
        let size = [[256, 256], [1000, 37], [16384, 1], [2, 512]][i % 4];
        let (angle, turn) = (i as f64 * std::f64::consts::TAU / 100_000.0, unit() * 7.0);
        let ratio = 1000f64.powf(unit());
        let scale = 2f64.powf(unit() * 120.0 - 60.0);
        let d = map(footprint(1.0, ratio, angle, turn, size), |d| (d * scale) as f32);
        let found = Gradient::axes_lanes(d, One, size);
        let [rounded, axes] = [d, found].map(|d| map(d, |d| f64::from(d) / scale));
        let each = off_axes(axes, exact_axes(rounded, size), size);
        floats = std::array::from_fn(|k| floats[k].max(each[k] * 2f64.powi(24)));
        for machine in Machine::all() {
            let same = for_lanes!(machine, lanes => {
                map(map(d, |d| lanes.splat(d)).axes_lanes(lanes, size), |d| *lanes.store(d).as_ref().last().expect("lanes"))
            });
            assert_eq!(map(same, f32::to_bits), map(found, f32::to_bits));
        }
        // From 2 steps of the shorter side on.
        let long = 2f64.powf(unit() * 14.0) * f64::from(size[0].max(size[1])) / 32768.0;
        let d = map(footprint(long, ratio, angle, turn, size), |d| Q16::from_f32(d as f32));
        let float = |q: Q16| f64::from(q.to_bits()) / 65536.0;
        let exact = exact_axes(map(d, float), size);
        let each = off_axes(map(d.axes_lanes(OneFixed, size), float), exact, size);
        // Steps of the texture, in texels, as a share of the longer axis.
        let step =
            f64::from(size[0]).hypot(f64::from(size[1])) * 3.0 / 65536.0 / exact[0][0].hypot(exact[0][1]);
        let bound = step + 2f64.powi(-15);
        integers = std::array::from_fn(|k| integers[k].max(each[k] / bound / if k == 0 { 1.0 } else { 2.0 }));
    }
    println!("axes: lengths, cosine, place {floats:.2?}ε; in integers {integers:.3?} of the bounds");
    assert!(floats.iter().zip([8.0, 16.0, 16.0]).all(|(&off, bound)| (1.0..=bound).contains(&off)));
    assert!(integers.iter().all(|share| (0.1..=1.0).contains(share)), "{integers:?}");
}

/// Where derivatives are at right angles they are the axes, bit for bit; what is no number stays none, and turns
/// nothing.
#[test]
fn axes_of_any_bits() {
    let mut random = Random(75);
    for _ in 0..100_000 {
        let (a, b) = (random.float(), random.float());
        let (a, b) = (if a.is_finite() { a } else { 0.0 }, if b.is_finite() { b } else { 1.0 });
        for d in [Gradient { dx: [a, 0.0], dy: [0.0, b] }, Gradient { dx: [0.0, a], dy: [b, 0.0] }] {
            assert_eq!(d.axes_lanes(One, [64, 300]), d);
            let q = map(d, Q16::from_f32);
            assert_eq!(q.axes_lanes(OneFixed, [16384, 16384]), q);
        }
        let any = map(Gradient::default(), |()| random.float());
        let found = any.axes_lanes(One, [16384, 16384]);
        for machine in Machine::all() {
            let same = for_lanes!(machine, lanes => {
                let axes = map(any, |d| lanes.splat(d)).axes_lanes(lanes, [16384, 16384]);
                map(axes, |d| *lanes.store(d).as_ref().last().expect("lanes"))
            });
            let bits = |d: f32| if d.is_nan() { 0 } else { d.to_bits() };
            assert_eq!(map(same, bits), map(found, bits), "{any:?}");
        }
        let q = map(Gradient::default(), |()| Q16::from_bits(random.bits().cast_signed()));
        let _ = q.axes_lanes(OneFixed, [16384, 1]);
    }
    let none = Gradient::<[f32; 2]>::default();
    assert_eq!(none.axes_lanes(One, [1, 1]), none);
}

/// A plane in perspective: U, V and Q linear in x and y. The derivatives of u = U/Q in `f64`, by the quotient rule
/// written out, and by differences of a thousandth of a pixel.
#[test]
fn of_planes_within_the_bound() {
    let mut random = Random(72);
    let mut worst = 0.0f64;
    for _ in 0..200_000 {
        let mut number = || (f64::from(random.bits()) / 2f64.powi(31) - 1.0) as f32;
        let [dx, dy] = [[number(), number(), number()], [number(), number(), number()]];
        let [u, v, q] = [number() * 3.0, number() * 3.0, number().abs() + 0.1];
        let depth = 1.0 / q;
        let found = Gradient::of_planes([u, v], depth, dx, dy);
        let each = [
            (found.dx[0], u, dx[0], dx[2]),
            (found.dx[1], v, dx[1], dx[2]),
            (found.dy[0], u, dy[0], dy[2]),
            (found.dy[1], v, dy[1], dy[2]),
        ];
        for (found, value, numerator, of_q) in each {
            let [value, n, of_q] = [value, numerator, of_q].map(f64::from);
            let depth = f64::from(depth);
            let exact = (n - value * of_q) * depth;
            // The product is rounded, the difference, and the product with the depth.
            let bound = (2.0 * n.abs() + 3.0 * (value * of_q).abs()) * depth;
            worst = worst.max((f64::from(found) - exact).abs() / bound * 2f64.powi(24));
        }
        // U = (u + ∂u/∂x h)(Q + ∂Q/∂x h) + O(h²)
        let h = 1e-3 * f64::from(q);
        let at = |slopes: [f32; 3], i: usize, value: f32| {
            let numerator = f64::from(value) * f64::from(q) + f64::from(slopes[i]) * h;
            (numerator / (f64::from(q) + f64::from(slopes[2]) * h) - f64::from(value)) / h
        };
        for (found, difference) in [(found.dx[0], at(dx, 0, u)), (found.dy[1], at(dy, 1, v))] {
            let scale = 4.0 * f64::from(depth) * 2e-3;
            assert!((f64::from(found) - difference).abs() <= scale * 2.0, "{found} {difference}");
        }
    }
    println!("derivatives of planes: at most {worst:.3} of the bound");
    assert!((0.5..=1.0).contains(&worst));
}

/// The differences between neighbours on a plane in perspective, by the quotients themselves: off from the derivatives
/// by half of the greatest second derivative on the way, and by as much where perspective is slight.
#[test]
fn neighbours_are_off_by_half_of_the_second_derivative() {
    let mut random = Random(74);
    let (mut worst, mut apart) = (0.0f64, 0.0f64);
    for _ in 0..100_000 {
        let mut number = || f64::from(random.bits()) / 2f64.powi(31) - 1.0;
        let [u, v, q] = [number(), number(), number().abs() + 0.1].map(|at| [at, number(), number()]);
        // 1/z stays positive: it falls to a tenth at most.
        let q = [q[0], q[1] * 0.9 * q[0], q[2] * 0.9 * q[0]];
        let at = |step: [f64; 2]| {
            let [u, v, q] = [u, v, q].map(|plane| plane[0] + plane[1] * step[0] + plane[2] * step[1]);
            [u / q, v / q]
        };
        let found = Gradient::between(at([0.0; 2]), at([1.0, 0.0]), at([0.0, 1.0]));
        for (axis, found) in [(1, found.dx), (2, found.dy)] {
            for (plane, found) in [u, v].into_iter().zip(found) {
                // (U/Q)' = D/Q², (U/Q)'' = −2 D Q'/Q³
                let d = plane[axis] * q[0] - plane[0] * q[axis];
                let derivative = d / (q[0] * q[0]);
                let second = 2.0 * (d * q[axis]).abs() / q[0].min(q[0] + q[axis]).powi(3);
                let error = (found - derivative).abs();
                assert!(error <= second / 2.0 + 1e-12 * (1.0 + found.abs()) / q[0], "{error} of {second}");
                if second > 1e-6 {
                    worst = worst.max(error / second);
                }
                apart = apart.max(error / derivative.abs());
            }
        }
    }
    println!("differences of neighbours: off by up to {worst:.4} of the second derivative");
    assert!((0.49..0.51).contains(&worst) && apart > 5.0, "{worst}, {apart}");
}

#[test]
fn of_triangles() {
    let mut random = Random(73);
    for _ in 0..100_000 {
        // Small integers, so that all products are exact; the texture is 3x - y + 2, x + 4y - 5 of the screen's 8ths.
        let mut corner = || Vec2::new((random.bits() % 64) as f32, (random.bits() % 64) as f32);
        let screen = [corner(), corner(), corner()];
        let texture = screen.map(|p| Vec2::new(3.0 * p.x - p.y + 2.0, p.x + 4.0 * p.y - 5.0) / 8.0);
        let found = Gradient::of_triangle(screen, texture);
        let [a, b, c] = screen;
        if (b - a).perp_dot(c - a).abs() < 0.5 {
            assert_eq!(found, None);
            continue;
        }
        let d = found.unwrap();
        for (found, exact) in [(d.dx[0], 0.375), (d.dy[0], -0.125), (d.dx[1], 0.125), (d.dy[1], 0.5)] {
            assert!((found - exact).abs() < 2e-4, "{screen:?}: {d:?}");
        }
    }
    let not_finite = [Vec2::ZERO, Vec2::X, Vec2::new(f32::NAN, 1.0)];
    assert_eq!(Gradient::of_triangle(not_finite, [Vec2::ZERO, Vec2::X, Vec2::Y]), None);
}
