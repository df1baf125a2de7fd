//! Affine frames in the plane and in space, against linear systems in integers.

use super::{Region, magnitude, one_of, point_near, relative, row};
use crate::{Row, Sample, Table};
use alberti_math::glam::{Mat2, Mat3, Vec2, Vec3};
use alberti_math::{Frame, Frame2, Object, Point, Vector, World};
use alberti_oracle::linear::{integer, quotient, solve};
use alberti_oracle::rational::{Rational, from_f32, to_f64};
use alberti_oracle::rng::Rng;
use num_bigint::BigInt;
use std::array::from_fn;

/// The axes, and the origin.
type Given<const N: usize> = ([[f32; N]; N], [f32; N]);

/// A frame's functions on arrays, so that both dimensions are measured by the same code.
struct Functions<const N: usize> {
    to_parent: fn(Given<N>, [f32; N]) -> [f32; N],
    from_parent: fn(Given<N>, [f32; N]) -> Option<[f32; N]>,
    vector_to_parent: fn(Given<N>, [f32; N]) -> [f32; N],
    vector_from_parent: fn(Given<N>, [f32; N]) -> Option<[f32; N]>,
    inverse: fn(Given<N>) -> Option<Given<N>>,
    inverse_orthonormal: fn(Given<N>) -> Given<N>,
    composed: fn(Given<N>, Given<N>) -> Given<N>,
    of_triangle: fn([[f32; N]; 3]) -> Given<N>,
}

fn frame2((axes, origin): Given<2>) -> Frame2<Object, World> {
    Frame2::from_mat2(Mat2::from_cols_array_2d(&axes), Point::new(Vec2::from(origin)))
}

fn frame3((axes, origin): Given<3>) -> Frame<Object, World> {
    Frame::from_mat3(Mat3::from_cols_array_2d(&axes), Point::new(Vec3::from(origin)))
}

const IN_THE_PLANE: Functions<2> = Functions {
    to_parent: |frame, p| frame2(frame).to_parent(Point::new(Vec2::from(p))).coords.to_array(),
    from_parent: |frame, p| Some(frame2(frame).from_parent(Point::new(Vec2::from(p)))?.coords.to_array()),
    vector_to_parent: |frame, v| frame2(frame).vector_to_parent(Vector::new(Vec2::from(v))).coords.to_array(),
    vector_from_parent: |frame, v| {
        Some(frame2(frame).vector_from_parent(Vector::new(Vec2::from(v)))?.coords.to_array())
    },
    inverse: |frame| {
        frame2(frame).inverse().map(|f| (f.axes().to_cols_array_2d(), f.origin().coords.to_array()))
    },
    inverse_orthonormal: |frame| {
        let inverse = frame2(frame).inverse_orthonormal();
        (inverse.axes().to_cols_array_2d(), inverse.origin().coords.to_array())
    },
    composed: |outer, (axes, origin)| {
        let inner: Frame2<Object, Object> =
            Frame2::from_mat2(Mat2::from_cols_array_2d(&axes), Point::new(Vec2::from(origin)));
        let composed = frame2(outer) * inner;
        (composed.axes().to_cols_array_2d(), composed.origin().coords.to_array())
    },
    of_triangle: |corners| {
        let frame = Frame2::<Object, World>::of_triangle(corners.map(|v| Point::new(Vec2::from(v))));
        (frame.axes().to_cols_array_2d(), frame.origin().coords.to_array())
    },
};

const IN_SPACE: Functions<3> = Functions {
    to_parent: |frame, p| frame3(frame).to_parent(Point::new(Vec3::from(p))).coords.to_array(),
    from_parent: |frame, p| Some(frame3(frame).from_parent(Point::new(Vec3::from(p)))?.coords.to_array()),
    vector_to_parent: |frame, v| frame3(frame).vector_to_parent(Vector::new(Vec3::from(v))).coords.to_array(),
    vector_from_parent: |frame, v| {
        Some(frame3(frame).vector_from_parent(Vector::new(Vec3::from(v)))?.coords.to_array())
    },
    inverse: |frame| {
        frame3(frame).inverse().map(|f| (f.axes().to_cols_array_2d(), f.origin().coords.to_array()))
    },
    inverse_orthonormal: |frame| {
        let inverse = frame3(frame).inverse_orthonormal();
        (inverse.axes().to_cols_array_2d(), inverse.origin().coords.to_array())
    },
    composed: |outer, (axes, origin)| {
        let inner: Frame<Object, Object> =
            Frame::from_mat3(Mat3::from_cols_array_2d(&axes), Point::new(Vec3::from(origin)));
        let composed = frame3(outer) * inner;
        (composed.axes().to_cols_array_2d(), composed.origin().coords.to_array())
    },
    of_triangle: |corners| {
        let frame = Frame::<Object, World>::of_triangle(corners.map(|v| Point::new(Vec3::from(v))));
        (frame.axes().to_cols_array_2d(), frame.origin().coords.to_array())
    },
};

pub(super) fn table() -> Table {
    let mut rows = rows(
        [
            "Frame2::to_parent",
            "Frame2::from_parent",
            "Frame2::inverse",
            "Frame2::inverse_orthonormal",
            "Frame2 * Frame2, axes",
            "Frame2 * Frame2, origin",
            "Frame2::of_triangle, edges",
            "Frame2::vector_to_parent",
            "Frame2::vector_from_parent",
        ],
        &IN_THE_PLANE,
    );
    rows.extend(self::rows(
        [
            "Frame::to_parent",
            "Frame::from_parent",
            "Frame::inverse",
            "Frame::inverse_orthonormal",
            "Frame * Frame, axes",
            "Frame * Frame, origin",
            "Frame::of_triangle, edges",
            "Frame::vector_to_parent",
            "Frame::vector_from_parent",
        ],
        &IN_SPACE,
    ));
    for region in Region::FEW {
        rows.push(row("Frame::of_triangle, normal", region, 1.05, normal));
    }
    Table {
        title: "Affine frames",
        about: "Errors of coordinates in a frame, of inverses, and of the edges and normal of a triangle are relative to the exact result, the others \
                to the sum of the magnitudes of the terms. Where that is below the smallest normal number, it is that \
                number that they are relative to.",
        rows,
    }
}

fn rows<const N: usize>(names: [&'static str; 9], functions: &'static Functions<N>) -> Vec<Row> {
    // One rounding for each product, and one for each addition but the first.
    let terms = (N + 1) as f64;
    let mut rows = Vec::new();
    for region in Region::FEW {
        rows.push(row(names[0], region, terms, move |rng, region| {
            let (frame, p) = drawn(rng, region);
            let k = rng.index(N);
            let local = [p, frame.0[rng.index(N)]][rng.index(2)];
            sum((functions.to_parent)(frame, local)[k], &matrix_row(&frame, k), &with_one(local))
        }));
        rows.push(row(names[1], region, 1.05, move |rng, region| {
            let (frame, p) = drawn(rng, region);
            let right = from_fn(|i| integer(p[i]) - integer(frame.1[i]));
            one_of(rng, (functions.from_parent)(frame, p), solved(frame.0, right), magnitude)
        }));
        rows.push(row(names[2], region, 1.05, move |rng, region| {
            let (frame, _) = drawn(rng, region);
            inverse(rng, frame, (functions.inverse)(frame))
        }));
        rows.push(row(names[3], region, terms - 1.0, move |rng, region| {
            let (frame, _) = drawn(rng, region);
            let (axes, origin) = (functions.inverse_orthonormal)(frame);
            let k = rng.index(N);
            assert!((0..N).all(|i| axes[i][k] == frame.0[k][i]), "a transposed matrix is exact");
            sum(-origin[k], &frame.0[k], &frame.1)
        }));
        rows.push(row(names[4], region, terms - 1.0, move |rng, region| {
            let ((outer, _), (inner, _)) = (drawn(rng, region), drawn(rng, Region::Ordinary));
            let (axes, _) = (functions.composed)(outer, inner);
            let (i, k) = (rng.index(N), rng.index(N));
            sum(axes[k][i], &outer.0.map(|axis| axis[i]), &inner.0[k])
        }));
        rows.push(row(names[5], region, terms, move |rng, region| {
            let ((outer, _), (inner, _)) = (drawn(rng, region), drawn(rng, Region::Ordinary));
            let (_, origin) = (functions.composed)(outer, inner);
            let i = rng.index(N);
            sum(origin[i], &matrix_row(&outer, i), &with_one(inner.1))
        }));
        rows.push(row(names[6], region, 1.0, move |rng, region| {
            let corners = region.points::<N, 3>(rng);
            let (axes, origin) = (functions.of_triangle)(corners);
            assert_eq!(origin, corners[0], "the first vertex is the origin");
            let (i, k) = (rng.index(N), rng.index(2));
            let exact = from_f32(corners[k + 1][i]) - from_f32(origin[i]);
            let size = to_f64(&exact).abs();
            (size < f64::from(f32::MAX)).then(|| relative(axes[k][i], &exact, size))
        }));
        rows.push(row(names[7], region, terms - 1.0, move |rng, region| {
            let (frame, p) = drawn(rng, region);
            let k = rng.index(N);
            let local = [p, frame.0[rng.index(N)]][rng.index(2)];
            sum((functions.vector_to_parent)(frame, local)[k], &frame.0.map(|axis| axis[k]), &local)
        }));
        rows.push(row(names[8], region, 1.05, move |rng, region| {
            let (frame, v) = drawn(rng, region);
            let exact = solved(frame.0, v.map(integer));
            one_of(rng, (functions.vector_from_parent)(frame, v), exact, magnitude)
        }));
    }
    rows
}

/// Axes from the region, an origin of their size or not, and a point that is near neither by accident.
fn drawn<const N: usize>(rng: &mut Rng, region: Region) -> (Given<N>, [f32; N]) {
    let axes = region.points(rng);
    let origin = match rng.index(3) {
        0 => axes[rng.index(N)],
        1 => [0.0; N],
        _ => {
            let [origin] = Region::Ordinary.points(rng);
            origin
        }
    };
    let [p] = region.points(rng);
    let near = point_near(rng, &[origin, axes[0], p]);
    ((axes, origin), [p, near][rng.index(2)])
}

fn matrix_row<const N: usize>((axes, origin): &Given<N>, i: usize) -> Vec<f32> {
    axes.iter().chain([origin]).map(|column| column[i]).collect()
}

fn with_one<const N: usize>(p: [f32; N]) -> Vec<f32> {
    p.into_iter().chain([1.0]).collect()
}

/// The error of a sum of products; `None` where a term overflows.
fn sum(got: f32, left: &[f32], right: &[f32]) -> Option<Sample> {
    let terms: Vec<Rational> = left.iter().zip(right).map(|(x, y)| from_f32(*x) * from_f32(*y)).collect();
    let size = terms.iter().map(|term| to_f64(term).abs()).sum::<f64>();
    (size < f64::from(f32::MAX)).then(|| relative(got, &terms.iter().sum(), size))
}

/// The coordinates of `right` along the axes.
fn solved<const N: usize>(axes: [[f32; N]; N], right: [BigInt; N]) -> Option<([BigInt; N], BigInt)> {
    solve(from_fn(|i| from_fn(|k| integer(axes[k][i]))), right)
}

/// The error of one component of an inverse; `None` where there is none, rightly.
fn inverse<const N: usize>(rng: &mut Rng, (axes, origin): Given<N>, got: Option<Given<N>>) -> Option<Sample> {
    // The columns of the inverse: the coordinates of the parent's axes, and those of its origin.
    let column = |k: usize| match k {
        k if k < N => solved(axes, from_fn(|i| integer(if i == k { 1.0 } else { 0.0 }))),
        _ => solved(axes, origin.map(|x| -integer(x))),
    };
    match got {
        Some((axes, origin)) => {
            let k = rng.index(N + 1);
            one_of(rng, Some(if k < N { axes[k] } else { origin }), column(k), magnitude)
        }
        // Missing, it is measured like a missing column: one of them must not be finite.
        None => (0..=N).map(|k| one_of(rng, None, column(k), magnitude)).reduce(Option::and)?,
    }
}

fn normal(rng: &mut Rng, region: Region) -> Option<Sample> {
    let corners = region.points::<3, 3>(rng);
    let frame = Frame::<Object, World>::of_triangle(corners.map(|v| Point::new(Vec3::from(v))));
    let [u, v]: [[BigInt; 3]; 2] =
        [1, 2].map(|k| from_fn(|i| integer(corners[k][i]) - integer(corners[0][i])));
    let k = rng.index(3);
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let scale = integer(1.0);
    let exact = quotient(&(&u[i] * &v[j] - &u[j] * &v[i]), &(&scale * &scale));
    let size = to_f64(&exact).abs();
    (size < f64::from(f32::MAX)).then(|| relative(frame.axes().z_axis[k], &exact, size))
}
