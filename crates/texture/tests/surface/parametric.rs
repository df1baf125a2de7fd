//! Frames of surfaces that a formula gives, against sines and cosines of the standard library.

use crate::support::{EPS, angle, axes, not_orthonormal, vec2, vec3};
use alberti_math::{Frame, Object, Point3, Vector3};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::surface::{
    Cylinder, Differences, Parametric, Plane, Sphere, Tangent, Torus, frame_of_derivatives, orthonormal,
};
use glam::{DVec3, Vec2, Vec3};
use std::f64::consts::{PI, TAU};

/// sin(2πt), from the nearest zero, which is subtracted exactly.
fn sin(t: f64) -> f64 {
    let half = (2.0 * t).round();
    let sine = (TAU * (t - half / 2.0)).sin();
    if half.rem_euclid(2.0) == 1.0 { -sine } else { sine }
}

fn cos(t: f64) -> f64 {
    // An angle near a zero of the cosine loses nothing, and one near 0 nothing that counts.
    let quarter = (2.0 * t - 0.5).round() / 2.0 + 0.25;
    let sine = (TAU * (t - quarter)).sin();
    if (2.0 * (quarter - 0.25)).rem_euclid(2.0) == 1.0 { sine } else { -sine }
}

/// Point, ∂f/∂u and ∂f/∂v.
type Exact = [DVec3; 3];

fn torus(major: f64, minor: f64, [u, v]: [f64; 2], per_v: f64) -> Exact {
    let out = major + minor * cos(v);
    [
        DVec3::new(out * sin(u), minor * sin(v), out * cos(u)),
        DVec3::new(out * cos(u), 0.0, -out * sin(u)) * TAU,
        DVec3::new(-sin(v) * sin(u), cos(v), -sin(v) * cos(u)) * (TAU * per_v * minor),
    ]
}

fn cylinder(radius: f64, height: f64, [u, v]: [f64; 2]) -> Exact {
    [
        DVec3::new(radius * sin(u), height * v, radius * cos(u)),
        DVec3::new(radius * cos(u), 0.0, -radius * sin(u)) * TAU,
        DVec3::Y * height,
    ]
}

/// The worst component, in ε of itself.
fn components(found: Vec3, exact: DVec3) -> f64 {
    let worst = (0..3).map(|i| {
        let (found, exact) = (f64::from(found[i]), exact[i]);
        if found == exact { 0.0 } else { (found - exact).abs() / exact.abs().max(f32::MIN_POSITIVE.into()) }
    });
    worst.fold(0.0, f64::max) / EPS
}

struct Worst {
    component: f64,
    direction: f64,
    length: f64,
    cosine: f64,
}

fn check(worst: &mut Worst, surface: &impl Parametric, uv: Vec2, exact: Exact) {
    let frame = surface.tangent_frame(uv);
    let [x, y, z] = axes(frame);
    for (found, exact) in [(frame.origin().coords, exact[0]), (x, exact[1]), (y, exact[2])] {
        worst.component = worst.component.max(components(found, exact));
    }
    let cross = x.as_dvec3().cross(y.as_dvec3());
    let slack = 2f64.powi(-51) * x.as_dvec3().length() * y.as_dvec3().length();
    for i in 0..3 {
        let bound = EPS * cross[i].abs().max(f32::MIN_POSITIVE.into()) + slack;
        assert!((f64::from(z[i]) - cross[i]).abs() <= bound, "{uv}: {z} for {cross}");
    }
    let unit = surface.orthonormal_frame(uv);
    assert_eq!(unit.origin(), frame.origin());
    let [length, cosine] = not_orthonormal(axes(unit));
    worst.length = worst.length.max(length);
    worst.cosine = worst.cosine.max(cosine);
    let [x, y, z] = axes(unit).map(|axis| axis.as_dvec3());
    assert!(x.cross(y).dot(z) > 0.99);
    // All these surfaces have perpendicular derivatives.
    for (found, exact) in [(x, exact[1]), (y, exact[2]), (z, exact[1].cross(exact[2]))] {
        if exact.length() > 0.0 {
            worst.direction = worst.direction.max(angle(found, exact) / EPS);
        }
    }
}

#[test]
fn closed_forms() {
    let mut rng = Rng::new(run_seed());
    let mut worst = Worst { component: 0.0, direction: 0.0, length: 0.0, cosine: 0.0 };
    for round in 0..200_000 {
        let mut uv = vec2(&mut rng, 3.0);
        match round % 4 {
            0 => uv *= rng.log_uniform(1e-30, 1.0),
            1 => uv = (uv * 8.0).round() / 8.0 + vec2(&mut rng, 1e-6),
            _ => {}
        }
        let t = [f64::from(uv.x), f64::from(uv.y)];
        let (a, b) = (rng.log_uniform(1e-3, 1e3), rng.log_uniform(1e-3, 1e3));
        let (major, minor) = (a.max(b) * 2.0, a.min(b));
        let up = [t[0], (t[1] - 0.5) / 2.0];
        // Beyond a pole, the sphere's ∂f/∂u points backwards; its frame is the limit from this side.
        if (0.0..=1.0).contains(&uv.y) {
            check(&mut worst, &Sphere { radius: a }, uv, torus(0.0, a.into(), up, 0.5));
        }
        check(&mut worst, &Torus { major, minor }, uv, torus(major.into(), minor.into(), t, 1.0));
        check(&mut worst, &Cylinder { radius: a, height: b }, uv, cylinder(a.into(), b.into(), t));
    }
    let Worst { component, direction, length, cosine } = worst;
    println!(
        "components {component:.4}ε, directions {direction:.3}ε, lengths {length:.3}ε, cosines {cosine:.3}ε"
    );
    assert!(component <= 1.01 && direction <= 1.1 && length <= 1.1 && cosine <= 2.2);
}

#[test]
fn quarters_and_poles_are_exact() {
    let sphere = Sphere { radius: 2.0 };
    for (uv, point) in [
        ([0.0, 0.5], Vec3::Z),
        ([0.25, 0.5], Vec3::X),
        ([0.5, 0.5], Vec3::NEG_Z),
        ([-0.25, 0.5], Vec3::NEG_X),
        ([0.125, 0.0], Vec3::NEG_Y),
        ([1000.25, 1.0], Vec3::Y),
        ([f32::NAN, 1.0], Vec3::Y),
        ([f32::INFINITY, 0.5], Vec3::Z),
    ] {
        let frame = sphere.tangent_frame(Vec2::from(uv));
        assert_eq!(frame.origin().coords, point * 2.0, "{uv:?}");
    }
    let pole = sphere.tangent_frame(Vec2::new(0.25, 1.0));
    assert_eq!(pole.axes().x_axis, Vec3::ZERO);
    assert_eq!(axes(sphere.orthonormal_frame(Vec2::new(0.25, 1.0))), [Vec3::NEG_Z, Vec3::NEG_X, Vec3::Y]);
    // A closure knows no limit: the normal is chosen, along the axis that is least along the meridian.
    let closure = |_: Vec2| pole;
    assert_eq!(axes(closure.orthonormal_frame(Vec2::ZERO)), [Vec3::NEG_Z, Vec3::NEG_X, Vec3::Y]);
}

#[test]
fn planes() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 2];
    for _ in 0..100_000 {
        let [origin, du, dv] = [10.0, 1.0, 1.0].map(|size| vec3(&mut rng, size));
        let plane = Plane { origin: Point3::new(origin), du: Vector3::new(du), dv: Vector3::new(dv) };
        let uv = vec2(&mut rng, 4.0);
        let frame = plane.tangent_frame(uv);
        assert_eq!(axes(frame)[..2], [du, dv]);
        let [o, du, dv] = [origin, du, dv].map(|v| v.as_dvec3());
        let exact = o + du * f64::from(uv.x) + dv * f64::from(uv.y);
        for i in 0..3 {
            let error = (f64::from(frame.origin().coords[i]) - exact[i]).abs() / (exact[i].abs() + 1e-7);
            worst[0] = worst[0].max(error / EPS);
        }
        let normal = du.cross(dv);
        let bent = angle(plane.orthonormal_frame(uv).axes().z_axis.as_dvec3(), normal);
        worst[1] = worst[1].max(bent / EPS * (normal.length() / du.length() / dv.length()).min(1.0));
    }
    println!("points {:.3}ε, normals {:.3}ε", worst[0], worst[1]);
    assert!(worst[0] <= 1.01 && worst[1] <= 2.2);
}

/// Any three axes at all.
#[test]
fn every_frame_has_an_orthonormal_one() {
    let mut rng = Rng::new(run_seed());
    let (mut worst, mut mirrored) = ([0.0f64; 2], 0);
    for round in 0..300_000 {
        let mut axis = |k: u32| match (round >> (2 * k)) % 4 {
            0 => Vec3::new(rng.any_f32(), rng.any_f32(), rng.any_f32()),
            1 => vec3(&mut rng, 1.0).signum() * rng.log_uniform(1e-40, 1e30),
            2 => vec3(&mut rng, 1.0) * Vec3::new(1.0, 1e-7, 1e-7),
            _ => vec3(&mut rng, 1.0),
        };
        let given = [axis(0), axis(1), axis(2)];
        let [x, y, z] = given.map(Vector3::new);
        let frame = Frame::<Tangent, Object>::new(Point3::new(Vec3::ZERO), x, y, z);
        let found = axes(orthonormal(frame));
        for (worst, error) in worst.iter_mut().zip(not_orthonormal(found)) {
            *worst = worst.max(error);
        }
        let [x, y, z] = found.map(|axis| axis.as_dvec3());
        mirrored += u32::from(x.cross(y).dot(z) < 0.0);
    }
    println!("lengths {:.3}ε, cosines {:.3}ε, {mirrored} mirrored", worst[0], worst[1]);
    assert!(worst[0] <= 1.1 && worst[1] <= 2.2 && mirrored > 50_000);
}

/// The sphere as a closure, with derivatives by differences.
#[test]
fn differences_keep_their_bound() {
    let mut rng = Rng::new(run_seed());
    let sphere = Sphere { radius: 1.0 };
    let mut report = Vec::new();
    for exponent in [-14, -12, -10, -8, -6, -4] {
        let step = 2f32.powi(exponent);
        let differences =
            Differences { surface: |uv| sphere.tangent_frame(uv).origin(), step: Vec2::splat(step) };
        let mut worst = 0.0f64;
        for _ in 0..20_000 {
            let uv = Vec2::new(rng.uniform(-1.0, 1.0) as f32, rng.uniform(0.1, 0.9) as f32);
            let (found, exact) = (differences.tangent_frame(uv), sphere.tangent_frame(uv));
            assert_eq!(found.origin(), exact.origin());
            for k in 0..2 {
                let error = (axes(found)[k].as_dvec3() - axes(exact)[k].as_dvec3()).abs().max_element();
                // Third derivatives of sines: one turn per unit of u, half a turn per unit of v.
                let third = [TAU.powi(3), PI.powi(3)][k];
                let h = f64::from(step);
                // And the rounding of the two derivatives that are compared.
                let bound = h * h / 6.0 * third + 1.5 * EPS / h + 2.0 * EPS * TAU;
                worst = worst.max(error / bound);
            }
        }
        report.push((exponent, worst));
        assert!(worst <= 1.0, "2^{exponent}: {worst} of the bound");
    }
    println!("shares of the bound by step 2^k: {report:?}");
    assert!(report.iter().all(|&(_, share)| share > 0.3), "the bound is not tested");
}

/// The saddle z = uv has derivatives (1, 0, v) and (0, 1, u) and the normal (−v, −u, 1).
#[test]
fn closures_with_derivatives() {
    let saddle = |uv: Vec2| {
        let (du, dv) = (Vec3::new(1.0, 0.0, uv.y), Vec3::new(0.0, 1.0, uv.x));
        let point = Vec3::new(uv.x, uv.y, uv.x * uv.y);
        frame_of_derivatives(Point3::new(point), Vector3::new(du), Vector3::new(dv))
    };
    let mut rng = Rng::new(run_seed());
    for _ in 0..10_000 {
        let uv = vec2(&mut rng, 10.0);
        assert_eq!(saddle.tangent_frame(uv).axes().z_axis, Vec3::new(-uv.y, -uv.x, 1.0));
        let normal = saddle.orthonormal_frame(uv).axes().z_axis.as_dvec3();
        assert!(angle(normal, DVec3::new((-uv.y).into(), (-uv.x).into(), 1.0)) <= 2.2 * EPS);
    }
}
