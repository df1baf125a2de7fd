//! ParallaxSearch maps, against rays that are met exactly.

use crate::support::{EPS, vec2};
use alberti_math::Vector3;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::surface::{
    AnyParallax, LimitedParallax, OffsetParallax, ParallaxOcclusion, ParallaxSearch, Relief, SteepParallax,
    Tangent,
};
use glam::{DVec2, Vec2, Vec3};

fn view(rng: &mut Rng, steepest: f64) -> Vector3<Tangent> {
    let turn = rng.uniform(0.0, std::f64::consts::TAU);
    let slant = rng.uniform(0.0, steepest);
    let length = f64::from(rng.log_uniform(1e-3, 1e3));
    let v = [turn.cos() * slant, turn.sin() * slant, 1.0].map(|c| (c * length) as f32);
    Vector3::new(Vec3::from(v))
}

/// uv moved as far along the ray as it is at the height z.
fn at(uv: Vec2, view: Vector3<Tangent>, extent: Vec2, z: f64) -> DVec2 {
    let v = view.coords.as_dvec3();
    uv.as_dvec2() + v.truncate() / v.z / extent.as_dvec2() * z
}

fn slant(view: Vector3<Tangent>) -> f64 {
    let v = view.coords.as_dvec3();
    v.truncate().length() / v.z
}

/// What rounding may move, on a surface of extent 1.
fn rounding(uv: Vec2, slant: f64, high: f64) -> f64 {
    16.0 * EPS * (f64::from(uv.abs().max_element()) + slant * high)
}

fn check_plain(policy: impl ParallaxSearch, rng: &mut Rng, layers: f64) -> f64 {
    let (low, high, h) = (rng.uniform(-1.0, 0.0) as f32, rng.uniform(0.1, 1.0) as f32, rng.unit() as f32);
    let relief = Relief { map: |_: Vec2| h, low, high, extent: Vec2::ONE };
    let (uv, view) = (vec2(rng, 1.0), view(rng, 5.0));
    let z = f64::from(low) + (f64::from(high) - f64::from(low)) * f64::from(h);
    let off = relief.parallax(policy, uv, view).as_dvec2().distance(at(uv, view, Vec2::ONE, z));
    let layer = (f64::from(high) - f64::from(low)) * layers * slant(view);
    let size = f64::from(high.max(-low));
    off / (layer + rounding(uv, slant(view), size))
}

/// A level height is met exactly, by steep parallax to a layer.
#[test]
fn plains() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 4];
    for _ in 0..50_000 {
        let shares = [
            check_plain(OffsetParallax, &mut rng, 0.0),
            check_plain(ParallaxOcclusion { layers: 1 }, &mut rng, 0.0),
            check_plain(ParallaxOcclusion { layers: 16 }, &mut rng, 0.0),
            check_plain(SteepParallax { layers: 16 }, &mut rng, 1.0 / 16.0),
        ];
        worst = std::array::from_fn(|k| worst[k].max(shares[k]));
    }
    println!("shares of the bounds: {worst:?}");
    assert!(worst.iter().all(|&share| share <= 1.0) && worst[3] > 0.9);
}

/// Heights that rise by a along u, over a range that holds all that the ray sees. The ray from u meets them where
/// z = a (u + k z), that is z = a u/(1 − a k).
#[test]
fn ramps() {
    let mut rng = Rng::new(run_seed());
    let (mut shares, mut offset, mut count) = ([0.0f64; 2], 0.0f64, 0);
    for _ in 0..100_000 {
        let a = rng.uniform(-0.4, 0.4) as f32;
        let ramp = |uv: Vec2| a * uv.x + 0.5;
        let relief = Relief { map: ramp, low: -0.5, high: 0.5, extent: Vec2::ONE };
        let uv = vec2(&mut rng, 0.5);
        let k = rng.uniform(-2.0, 2.0) as f32;
        let view = Vector3::new(Vec3::new(k, rng.uniform(-2.0, 2.0) as f32, 1.0));
        let (da, dk, du) = (f64::from(a), f64::from(k), f64::from(uv.x));
        let z = da * du / (1.0 - da * dk);
        if z.abs() > 0.5 {
            continue;
        }
        let exact = at(uv, view, Vec2::ONE, z);
        // An error of the heights is one of the place, more so where the ray nearly runs along the ramp.
        let slack = 2.0 * rounding(uv, slant(view), 0.5) / (1.0 - da * dk).powi(2);
        let met = relief.parallax(ParallaxOcclusion { layers: 8 }, uv, view).as_dvec2().distance(exact);
        let stepped = relief.parallax(SteepParallax { layers: 8 }, uv, view).as_dvec2().distance(exact);
        shares[0] = shares[0].max(met / slack);
        shares[1] = shares[1].max(stepped / (slant(view) / 8.0 + slack));
        let simple = relief.parallax(OffsetParallax, uv, view).as_dvec2();
        let shift = exact - uv.as_dvec2();
        // Short by the share a k of itself.
        let predicted = exact - shift * (da * dk);
        offset = offset.max(simple.distance(predicted) / slack);
        count += 1;
    }
    println!("{count} ramps, shares of the bounds: {shares:?}, {offset}");
    assert!(shares[0] <= 1.0 && shares[1] <= 1.0 && shares[1] > 0.9 && offset <= 1.0 && count > 50_000);
}

#[test]
fn any_policy_is_the_one_of_its_name() {
    let mut rng = Rng::new(run_seed());
    let wave = |uv: Vec2| 0.5 + 0.5 * (9.0 * uv.x).sin() * (7.0 * uv.y).cos();
    let mut differ = [0; 3];
    for _ in 0..10_000 {
        let relief = Relief { map: wave, low: -0.1, high: 0.1, extent: Vec2::new(1.0, 2.0) };
        let (uv, view) = (vec2(&mut rng, 1.0), view(&mut rng, 4.0));
        let layers = 1 + rng.u64() as u32 % 20;
        let by = |policy: AnyParallax| relief.parallax(policy, uv, view);
        let found = [
            by(AnyParallax::Offset),
            by(AnyParallax::Limited),
            by(AnyParallax::Steep { layers }),
            by(AnyParallax::Occlusion { layers }),
        ];
        let expected = [
            relief.parallax(OffsetParallax, uv, view),
            relief.parallax(LimitedParallax, uv, view),
            relief.parallax(SteepParallax { layers }, uv, view),
            relief.parallax(ParallaxOcclusion { layers }, uv, view),
        ];
        assert_eq!(found, expected);
        (0..3).for_each(|i| differ[i] += u32::from(expected[i] != expected[i + 1]));
    }
    assert!(differ.iter().all(|&count| count > 5_000), "{differ:?}");
}

/// Heights of sine waves that no ray meets twice, against bisection.
#[test]
fn waves() {
    let mut rng = Rng::new(run_seed());
    let mut shares = [0.0f64; 3];
    for _ in 0..20_000 {
        let pitch = rng.uniform(1.0, 12.0);
        let extent = Vec2::new(rng.log_uniform(0.25, 4.0), 1.0);
        let size = f64::from(extent.x);
        let wave = |u: f64| 0.5 + 0.5 * (pitch * size * u).sin();
        let range = rng.uniform(0.05, 0.3) as f32;
        let relief = Relief { map: |uv: Vec2| wave(f64::from(uv.x)) as f32, low: -range, high: 0.0, extent };
        let uv = vec2(&mut rng, 1.0);
        let range = f64::from(range);
        let (slope, curvature) = (range / 2.0 * pitch, range / 2.0 * pitch * pitch);
        let view = view(&mut rng, 0.9 / slope);
        let k = slant(view);
        let (mut above, mut below) = (0.0, -range);
        for _ in 0..60 {
            let middle = (above + below) / 2.0;
            let height = (wave(at(uv, view, extent, middle).x) - 1.0) * range;
            if middle > height { above = middle } else { below = middle }
        }
        let exact = at(uv, view, extent, above);
        // In object units.
        let off = |found: Vec2| ((found.as_dvec2() - exact) * extent.as_dvec2()).length();
        let steep = 1.0 - slope * k;
        let slack = 8.0 * rounding(uv, k, range) * size.max(1.0) / steep;
        let bound = |n: f64| k * curvature * (range / n * k).powi(2) / 8.0 / steep + slack;
        shares[0] =
            shares[0].max(off(relief.parallax(ParallaxOcclusion { layers: 8 }, uv, view)) / bound(8.0));
        shares[1] =
            shares[1].max(off(relief.parallax(ParallaxOcclusion { layers: 32 }, uv, view)) / bound(32.0));
        shares[2] = shares[2]
            .max(off(relief.parallax(SteepParallax { layers: 32 }, uv, view)) / (range / 32.0 * k + slack));
    }
    println!("shares of the bounds: {shares:?}");
    assert!(shares.iter().all(|&share| share <= 1.0 && share > 0.3));
}

/// The shift of a level height, not divided by Vz, is at most the height.
#[test]
fn limited_offsets() {
    let mut rng = Rng::new(run_seed());
    let (mut worst, mut grazing) = (0.0f64, 0);
    for _ in 0..100_000 {
        let h = rng.unit() as f32;
        let extent = Vec2::new(rng.log_uniform(0.1, 10.0), rng.log_uniform(0.1, 10.0));
        let relief = Relief { map: |_: Vec2| h, low: 0.0, high: 1.0, extent };
        let steepest = f64::from(rng.log_uniform(1.0, 1e6));
        let (uv, view) = (vec2(&mut rng, 1.0), view(&mut rng, steepest));
        let v = view.coords.as_dvec3().normalize().truncate() / extent.as_dvec2() * f64::from(h);
        let found = relief.parallax(LimitedParallax, uv, view);
        let off = (found.as_dvec2() - uv.as_dvec2() - v).length();
        worst = worst.max(off / EPS / (f64::from(uv.abs().max_element()) + v.length()));
        let shift = (found - uv) * extent;
        assert!(shift.length() <= h * (1.0 + 1e-4) + 1e-5);
        grazing += u32::from(slant(view) > 1000.0);
    }
    println!("{worst:.3}ε, {grazing} grazing");
    assert!(worst <= 16.0 && grazing > 10_000);
}

/// Whatever comes in, what goes out is finite or the coordinates that came in.
#[test]
fn hostile_views() {
    fn check(
        policy: impl ParallaxSearch,
        relief: &Relief<impl Fn(Vec2) -> f32>,
        uv: Vec2,
        view: Vector3<Tangent>,
    ) {
        let found = relief.parallax(policy, uv, view);
        let unchanged = found.to_array().map(f32::to_bits) == uv.to_array().map(f32::to_bits);
        assert!(found.is_finite() || unchanged);
        assert!(unchanged || view.coords.z > 0.0);
    }
    let mut rng = Rng::new(run_seed());
    for _ in 0..100_000 {
        let mut any = || rng.any_f32();
        let (h, low, high) = (any(), any(), any());
        let relief = Relief { map: |_: Vec2| h, low, high, extent: Vec2::new(any(), any()) };
        let (uv, view) = (Vec2::new(any(), any()), Vector3::new(Vec3::new(any(), any(), any())));
        check(OffsetParallax, &relief, uv, view);
        check(LimitedParallax, &relief, uv, view);
        check(SteepParallax { layers: 4 }, &relief, uv, view);
        check(ParallaxOcclusion { layers: 4 }, &relief, uv, view);
        check(ParallaxOcclusion { layers: 0 }, &relief, uv, view);
    }
    let relief = Relief { map: |_: Vec2| 1.0, low: 0.0, high: 1.0, extent: Vec2::ONE };
    for view in [Vec3::X, Vec3::NEG_Z, Vec3::NAN, Vec3::new(1.0, 0.0, f32::from_bits(1))] {
        assert_eq!(relief.parallax(OffsetParallax, Vec2::ONE, Vector3::new(view)), Vec2::ONE);
    }
}
