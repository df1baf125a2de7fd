//! Frames of triangles, against the solution of the linear system that they are defined by.

use crate::support::{EPS, angle, axes, not_orthonormal, vec2, vec3};
use alberti_math::Point3;
use alberti_oracle::rational::{Rational, from_f32, from_int, to_f64};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::surface::{triangle_directions, triangle_frame};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// ∂p/∂u and ∂p/∂v from [p1 − p0, p2 − p0] = [∂p/∂u, ∂p/∂v] [t1 − t0, t2 − t0], in rationals, and the normal; `None`
/// where the texture has no area.
fn exact(p: [Vec3; 3], t: [Vec2; 3]) -> Option<[DVec3; 3]> {
    let difference = |a: f32, b: f32| from_f32(a) - from_f32(b);
    let [a, b] = [1, 2].map(|i| [difference(t[i].x, t[0].x), difference(t[i].y, t[0].y)]);
    let determinant = &a[0] * &b[1] - &a[1] * &b[0];
    if determinant == from_int(0) {
        return None;
    }
    let e = [1, 2].map(|i| [0, 1, 2].map(|k| difference(p[i][k], p[0][k])));
    let vector = |v: [Rational; 3]| DVec3::from(v.map(|x| to_f64(&x)));
    // The inverse of the 2x2 matrix, row by row.
    let du = [0, 1, 2].map(|k| (&e[0][k] * &b[1] - &e[1][k] * &a[1]) / &determinant);
    let dv = [0, 1, 2].map(|k| (&e[1][k] * &a[0] - &e[0][k] * &b[0]) / &determinant);
    let normal = [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        &e[0][i] * &e[1][j] - &e[0][j] * &e[1][i]
    });
    Some([vector(du), vector(dv), vector(normal)])
}

fn counter_clockwise([a, b, c]: [Vec2; 3]) -> bool {
    let [ax, ay, bx, by, cx, cy] = [a.x, a.y, b.x, b.y, c.x, c.y].map(from_f32);
    (bx - &ax) * (cy - &ay) > (by - ay) * (cx - ax)
}

/// A triangle with this angle at the first vertex, as far as coordinates allow.
fn thin(rng: &mut Rng, sine: f64) -> [Vec2; 3] {
    let origin = vec2(rng, 2.0);
    let turn = rng.uniform(0.0, std::f64::consts::TAU);
    let length = f64::from(rng.log_uniform(0.01, 10.0));
    let at =
        |angle: f64, length: f64| Vec2::new((angle.cos() * length) as f32, (angle.sin() * length) as f32);
    let other = turn + if rng.one_in(2) { sine } else { -sine };
    [origin, origin + at(turn, length), origin + at(other, length * rng.uniform(0.3, 1.0))]
}

#[test]
fn directions_are_the_derivatives() {
    let mut rng = Rng::new(run_seed());
    let mut tables = Vec::new();
    for least in [0.1, 1e-2, 1e-3, 1e-4, 1e-6] {
        let (mut worst, mut mirrored, mut count) = ([0.0f64; 4], 0, 0);
        for _ in 0..4_000 {
            let sines = [least * rng.uniform(1.0, 10.0), rng.uniform(least, 1.0)];
            let [uv, shape] = sines.map(|sine| thin(&mut rng, sine));
            let plane = [vec3(&mut rng, 1.0), vec3(&mut rng, 1.0)];
            let p = shape.map(|c| plane[0] * c.x + plane[1] * c.y);
            let frame = triangle_frame(p.map(Point3::new), uv);
            let Some(exact) = exact(p, uv) else {
                assert_eq!(frame, None);
                continue;
            };
            let Some(frame) = frame else {
                assert_eq!(exact[2], DVec3::ZERO);
                continue;
            };
            assert_eq!(frame.origin().coords, p[0]);
            let [x, y, z] = axes(frame).map(|axis| axis.as_dvec3());
            // As a product of exact signs: the derivatives can be as good as parallel.
            let mirrored_here = !counter_clockwise(uv);
            assert_eq!(x.cross(y).dot(z) < -0.99, mirrored_here);
            let along = triangle_directions(p.map(Point3::new), uv).expect("as the frame");
            let [du, dv] = along.map(|axis| axis.coords.as_dvec3());
            worst[0] = worst[0].max(angle(du, exact[0])).max(angle(dv, exact[1]));
            worst[1] = worst[1].max(angle(x, exact[0])).max(angle(z, exact[2]));
            let [length, cosine] = not_orthonormal(axes(frame));
            worst[2] =
                worst[2].max(length * EPS).max((du.length() - 1.0).abs()).max((dv.length() - 1.0).abs());
            worst[3] = worst[3].max(cosine * EPS);
            count += 1;
            mirrored += u32::from(mirrored_here);
        }
        assert!(count > 3_000 && mirrored > count / 4 && mirrored < count / 4 * 3);
        tables.push((least, worst));
    }
    for (least, worst) in tables {
        let [directions, frames, lengths, cosines] = worst.map(|error| error / EPS);
        println!(
            "angles from {least:e}: directions {directions:.3}ε = {:.1e} rad, frames {frames:.3}ε, lengths {lengths:.3}ε, \
             cosines {cosines:.3}ε",
            worst[0]
        );
        assert!(directions <= 1.1 && frames <= 2.1 && lengths <= 1.1 && cosines <= 2.2);
    }
}

/// On a flat triangle, whose points are their own (u, v), ∂p/∂u is x and ∂p/∂v is y, whatever its corners. With −t10.u
/// in the place of −t10.v, as is often printed, ∂p/∂u is any other direction, up to the opposite one, or none. And
/// n × x is y only where the texture is not mirrored.
#[test]
fn a_coefficient_that_is_often_misprinted() {
    let printed = |t10: Vec2, t20: Vec2| {
        let [t10, t20] = [t10, t20].map(|t| t.as_dvec2());
        (t10 * t20.y - t20 * t10.x) / t10.perp_dot(t20)
    };
    // The usual corners of a square, half of a turn off, and nothing at all.
    let (minus_x, diagonal) = (Vec2::NEG_X, Vec2::new(-1.0, 1.0));
    assert_eq!(printed(Vec2::X, Vec2::Y), DVec2::new(1.0, -1.0));
    assert_eq!(printed(diagonal, Vec2::X), minus_x.as_dvec2());
    assert_eq!(printed(Vec2::Y, Vec2::X), DVec2::ZERO);

    let mut rng = Rng::new(run_seed());
    let (mut worst, mut far, mut mirrored, mut count) = (0.0f64, 0, 0, 0);
    for _ in 0..20_000 {
        let uv = [(); 3].map(|()| Vec2::new(rng.range(-8, 8) as f32, rng.range(-8, 8) as f32));
        let [t10, t20] = [uv[1] - uv[0], uv[2] - uv[0]];
        let corners = uv.map(|t| Point3::new(t.extend(0.0)));
        let Some([du, dv]) = triangle_directions(corners, uv) else {
            assert_eq!(t10.perp_dot(t20), 0.0);
            continue;
        };
        assert_eq!([du.coords, dv.coords], [Vec3::X, Vec3::Y], "{uv:?}");
        let [x, y, n] = axes(triangle_frame(corners, uv).expect("it has an area"));
        assert_eq!([x, y], [Vec3::X, Vec3::Y], "{uv:?}");
        let clockwise = t10.perp_dot(t20) < 0.0;
        assert_eq!(n.cross(x), if clockwise { Vec3::NEG_Y } else { Vec3::Y });
        let off = printed(t10, t20).angle_to(DVec2::X).abs();
        worst = if off.is_finite() { worst.max(off) } else { worst };
        far += u32::from(off > 0.5);
        mirrored += u32::from(clockwise);
        count += 1;
    }
    println!("{far} of {count} are more than half a radian off, up to {worst:.4}; {mirrored} mirrored");
    assert!(worst > 3.1 && far > count / 2 && mirrored > count / 3);
}

/// Coordinates on a line of small integers, moved, so that only exact arithmetic sees it; and a step beside it.
#[test]
fn degenerate_textures_are_seen_exactly() {
    let mut rng = Rng::new(run_seed());
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(Point3::new);
    let (mut none, mut some) = (0, 0);
    for _ in 0..20_000 {
        let mut coordinate = || rng.range(-1000, 1000) as f32;
        let (from, step) = (Vec2::new(coordinate(), coordinate()), Vec2::new(coordinate(), coordinate()));
        let (a, b) = (rng.range(-50, 50) as f32, rng.range(-50, 50) as f32);
        let uv = [from, from + step * a, from + step * b].map(|t| t / 4096.0);
        assert_eq!(triangle_frame(corners, uv), None);
        none += 1;
        let beside = [uv[0], uv[1], Vec2::new(uv[2].x, uv[2].y.next_up())];
        let frame = triangle_frame(corners, beside);
        assert_eq!(frame.is_some(), uv[0].x != uv[1].x, "{beside:?}");
        if let Some(frame) = frame {
            some += 1;
            assert!(axes(frame).iter().all(|axis| axis.is_finite()));
            assert_eq!(frame.axes().determinant() > 0.0, uv[1].x > uv[0].x);
        }
    }
    println!("{none} degenerate, {some} beside them");
    assert!(some > 15_000);
}

#[test]
fn any_floats_give_unit_axes_or_none() {
    let mut rng = Rng::new(run_seed());
    let mut found = 0;
    for round in 0..200_000 {
        let mut number = || if round % 2 == 0 { rng.any_f32() } else { rng.log_uniform(1e-30, 1e15) };
        let corners = [(); 3].map(|()| Vec3::new(number(), number(), number()));
        let uv = [(); 3].map(|()| Vec2::new(number(), number()));
        if let Some(frame) = triangle_frame(corners.map(Point3::new), uv) {
            found += 1;
            for axis in axes(frame) {
                assert!((axis.as_dvec3().length() - 1.0).abs() <= 1.1 * EPS, "{corners:?}, {uv:?}: {axis}");
            }
        }
    }
    println!("{found} frames");
    assert!(found > 20_000);
}
