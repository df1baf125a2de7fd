//! Barycentric coordinates, areas and what is interpolated with them, against linear systems in integers.

use super::{Region, magnitude, one_of, point_near, relative, row, weights};
use crate::{Sample, Table};
use alberti_math::glam::{Vec2, Vec3};
use alberti_math::{
    Point, World, interpolate, map_triangle, plane_coefficients, segment_parameter, segment_weights,
    signed_area, tetrahedron_weights, triangle_weights,
};
use alberti_oracle::linear::{integer, quotient, solve};
use alberti_oracle::rational::{Rational, from_f32, to_f64};
use alberti_oracle::rng::Rng;
use num_bigint::BigInt;
use std::array::from_fn;

/// What the quotients of determinants promise.
const QUOTIENT: f64 = 1.05;

pub(super) fn table() -> Table {
    let mut rows = Vec::new();
    for region in Region::EACH {
        // The area of a triangle of size 10^30 is no f32.
        if !matches!(region, Region::Huge) {
            rows.push(row("signed_area", region, QUOTIENT, area));
        }
        rows.push(row("triangle_weights, 2D", region, QUOTIENT, in_the_plane));
        rows.push(row("triangle_weights, 3D", region, QUOTIENT, in_space::<3>));
        rows.push(row("triangle_weights, 5D", region, QUOTIENT, in_space::<5>));
        rows.push(row("tetrahedron_weights", region, QUOTIENT, tetrahedron));
        rows.push(row("plane_coefficients", region, QUOTIENT, plane));
        rows.push(row("segment_weights, 2D", region, QUOTIENT, segment::<2>));
        rows.push(row("segment_weights, 5D", region, QUOTIENT, segment::<5>));
        rows.push(row("segment_parameter", region, 1.05, parameter));
        rows.push(row("map_triangle", region, 4.1, map));
        rows.push(row("interpolate", region, 3.0, combination));
    }
    Table {
        title: "Barycentric coordinates",
        about: "Errors are relative to the exact result, but to |pbc|/|abc| for triangles in 3D and 5D, to |pb|/|ab| for \
                segments, and to the sum of the magnitudes of the three terms where attributes are combined. Where \
                that is below the smallest normal number, it is that number that they are relative to.",
        rows,
    }
}

fn typed<const K: usize>(points: [[f32; 2]; K]) -> [Point<Vec2, World>; K] {
    points.map(|p| Point::new(Vec2::from(p)))
}

/// 1 in the units of [`integer`].
fn unit() -> BigInt {
    integer(1.0)
}

/// The rows x, y (, z) and 1 of the vertices, and the point they are to sum to: the linear system of barycentric
/// coordinates.
fn exact_weights<const N: usize, const K: usize>(
    p: [f32; N],
    vertices: [[f32; N]; K],
) -> Option<([BigInt; K], BigInt)> {
    let component = |v: &[f32; N], i: usize| v.get(i).map_or_else(unit, |x| integer(*x));
    solve(from_fn(|i| from_fn(|k| component(&vertices[k], i))), from_fn(|i| component(&p, i)))
}

fn area(rng: &mut Rng, region: Region) -> Option<Sample> {
    let [a, b, c] = region.points::<2, 3>(rng);
    // The trapezoids under the edges.
    let twice: BigInt = [[a, b], [b, c], [c, a]]
        .map(|[p, q]| (integer(p[0]) - integer(q[0])) * (integer(p[1]) + integer(q[1])))
        .iter()
        .sum();
    let exact = quotient(&twice, &(BigInt::from(2) * unit() * unit()));
    let [a, b, c] = typed([a, b, c]);
    let got = signed_area(a, b, c);
    let size = to_f64(&exact).abs();
    (size < f64::from(f32::MAX)).then(|| relative(got, &exact, size))
}

fn in_the_plane(rng: &mut Rng, region: Region) -> Option<Sample> {
    let triangle = region.points::<2, 3>(rng);
    let p = point_near(rng, &triangle);
    let [at] = typed([p]);
    one_of(rng, triangle_weights(at, typed(triangle)), exact_weights(p, triangle), magnitude)
}

fn tetrahedron(rng: &mut Rng, region: Region) -> Option<Sample> {
    let corners = region.points::<3, 4>(rng);
    let p = point_near(rng, &corners);
    let typed = |p: [f32; 3]| Point::<_, World>::new(Vec3::from(p));
    let got = tetrahedron_weights(typed(p), corners.map(typed));
    one_of(rng, got, exact_weights(p, corners), magnitude)
}

fn minus<const N: usize>(p: [f32; N], q: [f32; N]) -> [BigInt; N] {
    from_fn(|i| integer(p[i]) - integer(q[i]))
}

fn dot<const N: usize>(u: &[BigInt; N], v: &[BigInt; N]) -> BigInt {
    u.iter().zip(v).map(|(u, v)| u * v).sum()
}

/// The squares of twice the area of a triangle, by Gram's determinant.
fn squared_area<const N: usize>([a, b, c]: [[f32; N]; 3]) -> BigInt {
    let (u, v) = (minus(b, a), minus(c, a));
    dot(&u, &u) * dot(&v, &v) - dot(&u, &v) * dot(&u, &v)
}

/// Against the normal equations of the orthogonal projection.
fn in_space<const N: usize>(rng: &mut Rng, region: Region) -> Option<Sample> {
    let triangle = region.points::<N, 3>(rng);
    let p = point_near(rng, &triangle);
    let [a, b, c] = triangle;
    let (u, v, w) = (minus(b, a), minus(c, a), minus(p, a));
    let exact = solve([[dot(&u, &u), dot(&u, &v)], [dot(&u, &v), dot(&v, &v)]], [dot(&w, &u), dot(&w, &v)])
        .map(|([beta, gamma], d)| ([&d - &beta - &gamma, beta, gamma], d));
    let got = triangle_weights(Point::<_, World>::new(p), triangle.map(Point::new));
    let whole = squared_area(triangle);
    one_of(rng, got, exact, |k, _| {
        let mut part = triangle;
        part[k] = p;
        to_f64(&quotient(&squared_area(part), &whole)).sqrt()
    })
}

fn segment<const N: usize>(rng: &mut Rng, region: Region) -> Option<Sample> {
    let [a, b] = region.points::<N, 2>(rng);
    let p = point_near(rng, &[a, b]);
    let along = minus(b, a);
    let exact = solve([[dot(&along, &along)]], [dot(&minus(p, a), &along)])
        .map(|([beta], d)| ([&d - &beta, beta], d));
    let got = segment_weights(Point::<_, World>::new(p), [a, b].map(Point::new));
    let whole = dot(&along, &along);
    one_of(rng, got, exact, |k, _| {
        let to = minus(p, [b, a][k]);
        to_f64(&quotient(&dot(&to, &to), &whole)).sqrt()
    })
}

fn parameter(rng: &mut Rng, region: Region) -> Option<Sample> {
    let [a, b] = region.points::<3, 2>(rng);
    let p = point_near(rng, &[a, b]);
    let along = minus(b, a);
    // By how much the longest is longest: where the code may see two as equal, either will do.
    let longest = (0..3).max_by_key(|&k| along[k].magnitude().clone())?;
    let close = |k: usize| along[k].magnitude() * 1001u32 > along[longest].magnitude() * 1000u32;
    if (0..3).any(|k| k != longest && close(k)) {
        return None;
    }
    let exact = solve([[along[longest].clone()]], [integer(p[longest]) - integer(a[longest])]);
    let got = segment_parameter(Point::<_, World>::new(p), [a, b].map(Point::new));
    one_of(rng, got.map(|t| [t]), exact, magnitude)
}

fn plane(rng: &mut Rng, region: Region) -> Option<Sample> {
    let points = region.points::<2, 3>(rng);
    let [values]: [[f32; 3]; 1] = Region::Mixed.points(rng);
    let rows = points.map(|[x, y]| [integer(x), integer(y), unit()]);
    one_of(rng, plane_coefficients(typed(points), values), solve(rows, values.map(integer)), magnitude)
}

/// To a triangle in space, of another size.
fn map(rng: &mut Rng, region: Region) -> Option<Sample> {
    let from = region.points::<2, 3>(rng);
    let size = [Region::Ordinary, Region::Screen, Region::Huge, Region::Subnormal][rng.index(4)];
    let to: [[f32; 3]; 3] = size.points(rng);
    let p = point_near(rng, &from);
    let [at] = typed([p]);
    let image = map_triangle(at, typed(from), to.map(|q| Point::<_, World>::new(Vec3::from(q))));
    let exact = exact_weights(p, from);
    let (got, (weights, d)) = match (image, exact) {
        (Some(image), Some(exact)) => (image.coords.to_array(), exact),
        (None, None) => return None,
        // Weights that are no f32, as a point far beside a triangle that is nearly a line has them.
        (None, Some((weights, d)))
            if weights.iter().any(|w| to_f64(&quotient(w, &d)).abs() > f64::from(f32::MAX)) =>
        {
            return None;
        }
        _ => return Some(Sample { eps: f64::NAN, ulp: f64::NAN }),
    };
    let k = rng.index(3);
    let terms: [BigInt; 3] = from_fn(|i| &weights[i] * integer(to[i][k]));
    let scale = d * unit();
    let exact = quotient(&terms.iter().sum(), &scale);
    let size: f64 = terms.iter().map(|term| to_f64(&quotient(term, &scale)).abs()).sum();
    let largest = to.iter().map(|q| f64::from(q[k].abs())).fold(1.0, f64::max);
    let finite = size < f64::from(f32::MAX);
    finite.then(|| Sample::new(got[k], &exact, size + f64::from(f32::MIN_POSITIVE) * largest))
}

fn combination(rng: &mut Rng, region: Region) -> Option<Sample> {
    let [values] = region.points::<3, 1>(rng);
    let weights: [f32; 3] = weights::<3>(rng).map(|weight| weight as f32);
    let terms: [Rational; 3] = from_fn(|i| from_f32(weights[i]) * from_f32(values[i]));
    let size = terms.iter().map(|term| to_f64(term).abs()).sum();
    Some(relative(interpolate(weights, values), &terms.iter().sum(), size))
}
