//! Lights in fixed point beyond what its numbers hold: nothing wraps. They are judged by `f64`, in which distances and
//! places count as at most what the documentation says, and by intervals for the roundings on the way.

use alberti::glam::{DVec3, Vec2, Vec3};
use alberti::math::lanes::OneFixed;
use alberti::raster::{Fragments, Gradient};
use alberti::shaders::material::{Lambert, Light, Lighting, Material, Placed, PointLight, SpotLight, Viewer};
use alberti::{FragmentStage, Point3, Vector3};
use alberti_math::{Q16, Varying};
use alberti_oracle::rng::{Rng, run_seed};

/// A step of fixed point, and the greatest number.
const STEP: f64 = 1.0 / 65536.0;
const GREATEST: f64 = 32768.0 - STEP;

type Interval = [f64; 2];

fn real(x: Q16) -> f64 {
    f64::from(x.to_bits()) * STEP
}

fn real3(v: [Q16; 3]) -> DVec3 {
    DVec3::from(v.map(real))
}

/// The numbers in fixed point that stand for these, as they are documented to be rounded.
fn rounded(v: Vec3) -> DVec3 {
    real3(v.to_array().map(Q16::from_f32))
}

/// The vector to a place that counts as within 28000.
fn towards(place: Vec3, position: [Q16; 3]) -> DVec3 {
    rounded(place).clamp(DVec3::splat(-28000.0), DVec3::splat(28000.0)) - real3(position)
}

/// The falloff's limits by the exact one of the vector, whose components count as at most 100. The square has three
/// roundings of half a step, the root one of a step and what the square brings along.
fn falloff(light: &PointLight, to_light: DVec3) -> Interval {
    let square = to_light.clamp(DVec3::splat(-100.0), DVec3::splat(100.0)).length_squared();
    let distance = square.sqrt();
    let off = STEP * (1.0 + (0.75 / distance).min(314.0));
    let [constant, linear, quadratic] = rounded(Vec3::from(light.falloff)).to_array();
    let decay = constant + linear * distance + quadratic * square;
    let error = linear * off + STEP * (1.0 + 1.5 * quadratic);
    let [least, most] = [decay - error, decay + error].map(|decay| decay.clamp(1.0 / 16384.0, GREATEST));
    // Quotients are rounded towards 0.
    [1.0 / most - STEP, 1.0 / least]
}

/// A channel's limits where it arrives.
fn arriving(color: f64, [least, most]: Interval) -> Interval {
    [color * least - 0.5 * STEP, color * most + 0.5 * STEP].map(|c| c.min(GREATEST))
}

/// A light anywhere to a million away, dim to very bright, and a position that vertices carry.
fn lamp(rng: &mut Rng) -> (PointLight, [Q16; 3]) {
    let reach = f64::from(rng.log_uniform(1e-1, 1e6));
    let place = Vec3::from_array([(); 3].map(|()| rng.uniform(-reach, reach) as f32));
    let near = place.clamp(Vec3::splat(-4095.0), Vec3::splat(4095.0));
    let most = if rng.one_in(2) { 4095.0 } else { f64::from(rng.log_uniform(0.1, 4000.0)) };
    let position = near
        .to_array()
        .map(|c| Q16::from_f32((f64::from(c) + rng.uniform(-most, most)).clamp(-4096.0, 4096.0) as f32));
    let mut factor = || if rng.one_in(3) { 0.0 } else { rng.log_uniform(1e-3, 1e4) };
    let falloff = [factor(), factor(), factor()];
    let color = Vec3::from_array([(); 3].map(|()| rng.log_uniform(1e-2, 1e5)));
    (PointLight { position: Point3::new(place), color, falloff }, position)
}

#[test]
fn lights_far_away_and_too_bright() {
    let mut rng = Rng::stream(run_seed(), 40);
    let (mut far, mut bright) = (0, 0);
    for _ in 0..300_000 {
        let (light, position) = lamp(&mut rng);
        let to_light = towards(light.position.coords, position);
        let arrives = |light: &dyn Fn() -> Option<[[Q16; 3]; 2]>| light().expect("one light");
        let of_point =
            || light.fold(OneFixed, position, None, |_, direction, color| Some([direction, color]));
        let [direction, color] = arrives(&of_point);
        if to_light != DVec3::ZERO {
            let off = (real3(direction) - to_light.normalize()).abs().max_element();
            assert!(off <= 2.5 * STEP, "{direction:?} for {to_light}");
        }
        let limits = falloff(&light, to_light);
        for (found, exact) in color.map(real).into_iter().zip(rounded(light.color).to_array()) {
            let [least, most] = arriving(exact, limits);
            assert!((least..=most).contains(&found), "{found} in {least}..{most}: {light:?} {position:?}");
            bright += u32::from(exact * limits[0] > GREATEST);
        }
        far += u32::from(to_light.abs().max_element() > 105.0);
        // A cone that takes in all is no cone.
        let all = SpotLight::new(light, Vector3::new(Vec3::X), [-1.5, -2.0]);
        let of_spot = || all.fold(OneFixed, position, None, |_, direction, color| Some([direction, color]));
        assert_eq!(arrives(&of_spot), [direction, color]);
        let none = SpotLight::new(light, Vector3::new(Vec3::X), [40000.0, 39999.0]);
        let of_none = || none.fold(OneFixed, position, None, |_, direction, color| Some([direction, color]));
        assert_eq!(arrives(&of_none)[1], [Q16::ZERO; 3]);
    }
    assert!(far > 100_000 && bright > 30_000, "{far} {bright}");
}

/// The sum of several, and the byte: what is brighter than white is white. And the viewer may be as far.
#[test]
fn surfaces_under_them() {
    let mut rng = Rng::stream(run_seed(), 41);
    let mut counts = [0; 3];
    for _ in 0..100_000 {
        let (mut first, position) = lamp(&mut rng);
        let mut lights = [first, lamp(&mut rng).0, lamp(&mut rng).0];
        // Half of them dim.
        if rng.one_in(2) {
            first.color *= 1e-4;
            lights = lights.map(|light| PointLight { color: light.color * 1e-4, ..light });
        }
        let normal = Vec3::from_array([(); 3].map(|()| rng.uniform(-1.0, 1.0) as f32)).normalize_or(Vec3::Z);
        let viewer = lamp(&mut rng).0.position;
        let ambient = Vec3::splat(rng.uniform(0.0, 0.3) as f32);
        let lighting = Lighting { viewer: Viewer::at(viewer), ambient, lights, reflectance: Lambert };
        let stage = Material { layers: (), lighting };
        let place = Placed { position: Vec3::ZERO, normal, uv: Vec2::ZERO };
        let varying = Placed::map(&Placed::gather([place]), &|[x]: [f32; 1]| Q16::from_f32(x));
        let mut fragments = Fragments::<OneFixed, Placed> {
            lanes: OneFixed,
            varying,
            gradient: Gradient { dx: varying, dy: varying },
            mask: true,
            place: [0; 2],
        };
        fragments.varying.position = position;
        let to_viewer = towards(viewer.coords, position).normalize();
        let found = real3(stage.surface(&fragments).to_viewer);
        assert!((found - to_viewer).abs().max_element() <= 2.5 * STEP, "{found} for {to_viewer}");

        let bytes = stage.shade(&fragments).0.0.to_le_bytes();
        for (k, &byte) in bytes.iter().enumerate().take(3) {
            let mut sum = [f64::from(ambient[k]) - STEP, f64::from(ambient[k]) + STEP];
            for light in &lights {
                let to_light = towards(light.position.coords, position);
                let limits = arriving(rounded(light.color)[k], falloff(light, to_light));
                let cosine = normal.as_dvec3().dot(to_light.normalize());
                for (sum, (limit, off)) in sum.iter_mut().zip(limits.into_iter().zip([-12.0, 12.0])) {
                    *sum += (limit * (cosine + off * STEP).max(0.0) + off.signum() * STEP).max(0.0);
                }
            }
            let [least, most] = [255.0 * sum[0] - 0.51, 255.0 * sum[1] + 0.51];
            let found = f64::from(byte);
            assert!(
                found >= least.min(254.5) && found <= most,
                "{found} in {least}..{most}: {lights:?}, {position:?}"
            );
            counts[if least > 255.0 { 2 } else { usize::from(most - least < 2.0) }] += 1;
        }
    }
    println!("{counts:?} vague, told within a byte, white");
    assert!(counts[1] > 10_000 && counts[2] > 10_000, "{counts:?}");
}
