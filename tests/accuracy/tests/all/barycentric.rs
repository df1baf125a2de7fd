//! Orientation and zones are exact; barycentric coordinates, planes and affine maps are one relation.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "inputs are drawn in f64 or as small integers and rounded; what is judged is what they are rounded to"
)]

use alberti_math::glam::{Vec2, Vec3};
use alberti_math::{
    Frame, Frame2, Object, Point, Point2, World, Zone, map_triangle, orientation, plane_coefficients,
    segment_parameter, segment_weights, signed_area, tetrahedron_weights, triangle_weights,
};
use alberti_oracle::linear::{integer, solve};
use alberti_oracle::rational::{Rational, from_f32, to_f64};
use alberti_oracle::rng::{Rng, run_seed};
use num_bigint::{BigInt, Sign};
use std::array::from_fn;
use std::cmp::Ordering;
use std::collections::HashMap;

fn typed([x, y]: [f32; 2]) -> Point2<World> {
    Point::new(Vec2::new(x, y))
}

/// By the list of all signs that three coordinates with the sum 1 can have.
fn zone_of_signs(signs: [i32; 3]) -> Zone {
    match signs {
        [1, 1, 1] => Zone::Inside,
        [0, 1, 1] => Zone::OnEdge(0),
        [1, 0, 1] => Zone::OnEdge(1),
        [1, 1, 0] => Zone::OnEdge(2),
        [1, 0, 0] => Zone::OnVertex(0),
        [0, 1, 0] => Zone::OnVertex(1),
        [0, 0, 1] => Zone::OnVertex(2),
        [-1, 1, 1] | [-1, 0, 1] | [-1, 1, 0] => Zone::BeyondEdge(0),
        [1, -1, 1] | [0, -1, 1] | [1, -1, 0] => Zone::BeyondEdge(1),
        [1, 1, -1] | [0, 1, -1] | [1, 0, -1] => Zone::BeyondEdge(2),
        [1, -1, -1] => Zone::BeyondVertex(0),
        [-1, 1, -1] => Zone::BeyondVertex(1),
        [-1, -1, 1] => Zone::BeyondVertex(2),
        _ => panic!("{signs:?} do not sum to 1"),
    }
}

/// Every triangle on 3 x 3 points and every point on 5 x 5 around them, on grids from the smallest numbers to nearly
/// the largest, against 32-bit integers.
#[test]
fn zones_of_a_grid_are_exact() {
    let tiny = f32::from_bits(1);
    let places =
        [[0.0, 1.0], [0.0, tiny], [0.0, 2f32.powi(122)], [16_383.0, 1.0 / 256.0], [-2.0, 2f32.powi(-22)]];
    let grid = |i: i32| [i % 3 + 1, i / 3 + 1];
    let mut seen = HashMap::new();
    for [offset, step] in places {
        let place = |p: [i32; 2]| typed(p.map(|i| offset + i as f32 * step));
        for (i, j, k) in (0..729).map(|n| (n % 9, n / 9 % 9, n / 81)) {
            let corners = [grid(i), grid(j), grid(k)];
            let twice =
                |[a, b, c]: [[i32; 2]; 3]| a[0] * (b[1] - c[1]) + b[0] * (c[1] - a[1]) + c[0] * (a[1] - b[1]);
            let whole = twice(corners);
            let [a, b, c] = corners.map(place);
            assert_eq!(orientation(a, b, c), Some(whole.cmp(&0)));
            for p in (0..25).map(|n| [n % 5, n / 5]) {
                let expected = (whole != 0).then(|| {
                    zone_of_signs(from_fn(|n| {
                        let mut part = corners;
                        part[n] = p;
                        (twice(part) * whole).signum()
                    }))
                });
                assert_eq!(
                    Zone::of(place(p), [a, b, c]),
                    expected,
                    "{p:?} {corners:?} at {offset} by {step}"
                );
                *seen.entry(format!("{expected:?}")).or_insert(0) += 1;
            }
        }
    }
    assert_eq!(seen.len(), 14, "{seen:?}");
}

/// Points near lines and vertices, of magnitudes far apart, up to all that is finite.
fn adversarial(rng: &mut Rng) -> [[f32; 2]; 4] {
    let near = |rng: &mut Rng, x: f64| {
        let moved = f32::from_bits(((x as f32).to_bits()).wrapping_add_signed(rng.range(-1, 1) as i32));
        if moved.is_finite() { moved } else { x as f32 }
    };
    let mut points: [[f32; 2]; 4] = match rng.index(4) {
        0 => from_fn(|_| from_fn(|_| rng.finite_f32())),
        1 => {
            // Exactly on a line through the origin, from 2^-60 to 2^71.
            let along = [rng.range(-2047, 2047) as f32, rng.range(-2047, 2047) as f32];
            from_fn(|_| {
                let t = rng.range(-2047, 2047) as f32 * (rng.range(-60, 60) as f32).exp2();
                along.map(|x| x * t)
            })
        }
        2 => {
            // Multiples of the smallest number, or of any other power of two.
            let step = f32::from_bits(1) * (rng.range(0, 250) as f32).exp2().min(2f32.powi(120));
            from_fn(|_| from_fn(|_| rng.range(-9, 9) as f32 * step))
        }
        _ => {
            let [a, b]: [[f32; 2]; 2] = from_fn(|_| from_fn(|_| rng.uniform(-100.0, 100.0) as f32));
            from_fn(|k| match k {
                0 => a,
                1 => b,
                _ => {
                    let t = rng.uniform(-1.0, 2.0);
                    from_fn(|i| near(rng, f64::from(a[i]) * (1.0 - t) + f64::from(b[i]) * t))
                }
            })
        }
    };
    if rng.one_in(3) {
        let (k, i) = (rng.index(4), rng.index(2));
        points[k][i] = near(rng, f64::from(points[k][i]));
    }
    if rng.one_in(8) {
        points[rng.index(4)] = points[rng.index(4)];
    }
    points
}

/// Against the linear system of barycentric coordinates, solved in integers.
#[test]
fn zones_and_orientation_are_exact_for_all_that_is_finite() {
    let mut rng = Rng::new(run_seed());
    let one = integer(1.0);
    let mut seen: HashMap<_, u32> = HashMap::new();
    let (mut on_a_line, mut rounded_away) = (0, 0);
    for _ in 0..100_000 {
        let [p, a, b, c] = adversarial(&mut rng);
        let row = |i: usize| [a, b, c].map(|v| integer(v[i]));
        let system = [row(0), row(1), from_fn(|_| one.clone())];
        let weights = solve(system, [integer(p[0]), integer(p[1]), one.clone()]);
        let sign = |n: &BigInt| match n.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        };
        let expected = weights.map(|(numerators, _)| zone_of_signs(numerators.map(|n| sign(&n))));
        let [tp, ta, tb, tc] = [p, a, b, c].map(typed);
        assert_eq!(Zone::of(tp, [ta, tb, tc]), expected, "{p:?} {a:?} {b:?} {c:?}");
        *seen.entry(format!("{expected:?}")).or_default() += 1;

        // The trapezoids under the edges.
        let twice: BigInt = [[a, b], [b, c], [c, a]]
            .map(|[p, q]| (integer(p[0]) - integer(q[0])) * (integer(p[1]) + integer(q[1])))
            .iter()
            .sum();
        let turn = orientation(ta, tb, tc).expect("all is finite");
        assert_eq!(turn, twice.cmp(&BigInt::ZERO), "{a:?} {b:?} {c:?}");
        on_a_line += u32::from(turn == Ordering::Equal);
        rounded_away += u32::from(turn != Ordering::Equal && signed_area(ta, tb, tc) == 0.0);
    }
    println!("{seen:?}, {on_a_line} on a line, {rounded_away} areas that round to zero");
    assert_eq!(seen.len(), 14);
    assert!(seen.values().all(|count| *count > 100) && on_a_line > 5_000 && rounded_away > 100);
}

/// The formula as it is printed in lectures, from the clockwise triangle: numerators and denominator, which is minus
/// twice the signed area, both have the other sign, and it cancels. The denominator's first product is x_j y_i; with
/// another index there, or none, it is no determinant.
#[test]
fn planes_and_barycentric_coordinates_are_the_same_function() {
    let mut rng = Rng::new(run_seed());
    let ratio = |rng: &mut Rng| from_f32(rng.uniform(-50.0, 50.0) as f32);
    for _ in 0..300 {
        let points: [[f32; 2]; 3] = from_fn(|_| from_fn(|_| rng.uniform(-50.0, 50.0) as f32));
        let values: [f32; 3] = from_fn(|_| rng.uniform(-5.0, 5.0) as f32);
        let [[xi, yi], [xj, yj], [xk, yk]] = points.map(|p| p.map(from_f32));
        let [fi, fj, fk] = values.map(from_f32);
        let denominator = (&xj * &yi - &xi * &yj) + (&xk * &yj - &xj * &yk) + (&xi * &yk - &xk * &yi);
        let a = &fi * (&yk - &yj) + &fj * (&yi - &yk) + &fk * (&yj - &yi);
        let b = &fi * (&xj - &xk) + &fj * (&xk - &xi) + &fk * (&xi - &xj);
        let c = &fi * (&xk * &yj - &xj * &yk) + &fj * (&xi * &yk - &xk * &yi) + &fk * (&xj * &yi - &xi * &yj);
        let printed = [a, b, c].map(|numerator| numerator / &denominator);
        let area = signed_area(typed(points[0]), typed(points[1]), typed(points[2]));
        assert!((to_f64(&denominator) / f64::from(area) + 2.0).abs() < 1e-6);

        // Both at any point, without a rounding.
        let (x, y) = (ratio(&mut rng), ratio(&mut rng));
        let on_plane = &printed[0] * &x + &printed[1] * &y + &printed[2];
        let twice =
            |[a, b, c]: [[&Rational; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let corners = [[&xi, &yi], [&xj, &yj], [&xk, &yk]];
        let mixed: Rational = (0..3)
            .map(|k| {
                let mut part = corners;
                part[k] = [&x, &y];
                twice(part) / twice(corners) * [&fi, &fj, &fk][k]
            })
            .sum();
        assert_eq!(on_plane, mixed);

        // And the functions that are tested compute them.
        let got = plane_coefficients(points.map(typed), values).expect("an area");
        for (got, exact) in got.into_iter().zip(&printed) {
            assert!((f64::from(got) - to_f64(exact)).abs() <= to_f64(exact).abs() * 1e-7);
        }
    }
}

/// The map of one triangle to another takes vertices to vertices exactly, and is the composition of their frames.
#[test]
fn the_map_between_triangles_is_affine() {
    let mut rng = Rng::new(run_seed());
    let mut worst = 0.0f64;
    for _ in 0..2_000 {
        let mut triangle = || -> [[f32; 2]; 3] { from_fn(|_| from_fn(|_| rng.uniform(-50.0, 50.0) as f32)) };
        let (from, to) = (triangle().map(typed), triangle());
        let to = to.map(|[x, y]| Point2::<Object>::new(Vec2::new(x, y)));
        for k in 0..3 {
            assert_eq!(map_triangle(from[k], from, to), Some(to[k]));
        }
        if signed_area(from[0], from[1], from[2]).abs() < 100.0 {
            continue;
        }
        let back = Frame2::<World, World>::of_triangle(from).inverse().expect("an area");
        let p = typed(from_fn(|_| rng.uniform(-50.0, 50.0) as f32));
        let composed = (Frame2::<World, Object>::of_triangle(to) * back).to_parent(p);
        let mapped = map_triangle(p, from, to).expect("an area");
        worst = worst.max(f64::from((composed - mapped).coords.abs().max_element()));
        // In space: a frame whose third coordinate is the height over the triangle.
        let lifted = from.map(|v| Point::<Vec3, World>::new(v.coords.extend(v.coords.x - 2.0 * v.coords.y)));
        let frame = Frame::<Object, World>::of_triangle(lifted);
        let weights = triangle_weights(p, from).expect("an area");
        let above = Point::new(p.coords.extend(p.coords.x - 2.0 * p.coords.y));
        let local = frame.from_parent(above).expect("an area").coords;
        let size = weights.iter().fold(1.0, |size: f32, weight| size.max(weight.abs()));
        assert!((local - Vec3::new(weights[1], weights[2], 0.0)).abs().max_element() < 1e-3 * size);
    }
    println!("frames and weights differ by up to {worst:e} in 50");
    assert!(worst < 0.02);
}

#[test]
fn what_is_not_finite_has_no_coordinates() {
    let good = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0]];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for n in 0..8 {
            let mut points = good;
            points[n / 2][n % 2] = bad;
            let [a, b, c, p] = points.map(typed);
            assert_eq!(Zone::of(p, [a, b, c]), None);
            assert_eq!(triangle_weights(p, [a, b, c]), None);
            if n < 6 {
                assert!(signed_area(a, b, c).is_nan());
                assert_eq!(orientation(a, b, c), None);
                assert_eq!(plane_coefficients([a, b, c], [1.0, 2.0, 3.0]), None);
                assert_eq!(segment_weights(c, [a, b]), None);
            }
            let [a, b, c, p] = points.map(|[x, y]| Point::<_, World>::new([x, y, x + y]));
            assert_eq!(triangle_weights(p, [a, b, c]), None);
            let corners = points.map(|[x, y]| Point::new(Vec3::new(x, y, y * y)));
            assert_eq!(tetrahedron_weights(Point::<_, World>::new(Vec3::ONE), corners), None);
        }
        let line = [[0.0], [bad], [1.0]].map(Point::<[f32; 1], World>::new);
        assert_eq!(segment_parameter(line[1], [line[0], line[2]]), None);
        assert_eq!(segment_parameter(line[2], [line[0], line[1]]), None);
        assert_eq!(plane_coefficients([good[0], good[1], good[2]].map(typed), [0.0, bad, 0.0]), None);
    }
}
