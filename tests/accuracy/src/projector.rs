//! Parallel projection, and the coordinates of a projector.

use crate::{Row, SMALLEST, Sample, Table};
use alberti_math::glam::{Mat3, Vec2, Vec3};
use alberti_math::{Eye, Frame, Point3, Vector3, World};
use alberti_oracle::rational::{Rational, from_f32, from_f64, to_f64};
use alberti_oracle::rng::Rng;
use alberti_projection::{EyeVertex, Homogeneous, Parallel, Projection, Projector, look_at};

#[expect(clippy::cast_possible_truncation, reason = "any number near it will do")]
fn uniform(rng: &mut Rng, low: f64, high: f64) -> f32 {
    rng.uniform(low, high) as f32
}

/// Planes whose distance from each other is so many times the larger of their distances from the eye, or more; these
/// are of such sizes.
fn planes(rng: &mut Rng, apart: f32, [least, most]: [f32; 2]) -> [f32; 2] {
    let size = rng.log_uniform(least, most);
    let near = size * uniform(rng, -1.0, 1.0);
    [near, near + size * apart * rng.log_uniform(1.0, 4.0)]
}

/// Between the planes, often close to one of them.
fn any_z(rng: &mut Rng, [near, far]: [f32; 2]) -> f32 {
    let share = rng.log_uniform(1e-9, 1.0);
    let z = if rng.one_in(2) { near + (far - near) * share } else { far - (far - near) * share };
    z.clamp(near, far)
}

fn parallel() -> Vec<Row> {
    let regions = [
        (1.0f32, [1e-6, 1e6], ""),
        (1e-4, [1e-6, 1e6], ""),
        // Differences between depths are subnormal; and of the largest planes, and of the largest box.
        (1.0, [1e-38, 1e-36], ", at 1e-38 to 1e-36"),
        (1.0, [1e36, 4e36], ", at 1e36 to 4e36"),
    ];
    let depths = regions.into_iter().flat_map(|(apart, sizes, at)| {
        let region = move |what: &str| format!("{what}, planes apart {apart:e} of their distance{at}");
        let zs = move |reversed: bool| {
            move |rng: &mut Rng| {
                let [near, far] = planes(rng, apart, sizes);
                let z = any_z(rng, [near, far]);
                let map = Parallel::new(1.0, 1.0, near, far).expect("near < far").depth_map(reversed);
                let [z_exact, a, b] = [z, near, far].map(from_f32);
                let exact = if reversed { &b - z_exact } else { z_exact - &a } / (b - a);
                Sample::relative(map.zs(z), &exact)
            }
        };
        let back = move |reversed: bool| {
            move |rng: &mut Rng| {
                let [near, far] = planes(rng, apart, sizes);
                let zs =
                    if rng.one_in(8) { rng.log_uniform(1e-44, 1e-30) } else { rng.log_uniform(1e-6, 1.0) };
                let z = Parallel::new(1.0, 1.0, near, far).expect("near < far").depth_map(reversed).z(zs);
                let [zs, a, b] = [zs, near, far].map(from_f32);
                let distance = zs * (&b - &a);
                let exact = if reversed { b - &distance } else { a + &distance };
                Sample::new(z, &exact, to_f64(&distance).max(SMALLEST) * 2.0 + to_f64(&exact).abs())
            }
        };
        [
            Row::new("LinearDepth::zs", region("forward"), 3.0, zs(false)),
            Row::new("LinearDepth::zs", region("reversed"), 3.0, zs(true)),
            Row::new("LinearDepth::z", region("forward"), 1.0, back(false)),
            Row::new("LinearDepth::z", region("reversed"), 1.0, back(true)),
        ]
    });
    let scales = [
        ("heights from 1e-6 to 1e6", [1e-6, 1e6], [1e-3, 9.0]),
        ("heights from 1e-37 to 1e-30, nothing to 9 times as much", [1e-37, 1e-30], [1e-30, 9.0]),
        ("heights from 1e30 to 1e37, nothing to 9 times as much", [1e30, 1e37], [1e-45, 9.0]),
    ];
    let scales = scales.into_iter().map(|(region, heights, shares)| {
        Row::new("Parallel::scale, project", region, 2.0, move |rng| scaled(rng, heights, shares))
    });
    depths.chain(scales).collect()
}

/// A point as far from the axis as a share of the view's height.
fn scaled(rng: &mut Rng, [least, most]: [f32; 2], shares: [f32; 2]) -> Sample {
    let (height, aspect) = (rng.log_uniform(least, most), rng.log_uniform(0.1, 10.0));
    let view = Parallel::new(height, aspect, -1.0, 1.0).expect("a box");
    let [x, y] = [(); 2].map(|()| {
        let c = height * rng.log_uniform(shares[0], shares[1]);
        if rng.one_in(2) { -c } else { c }
    });
    let vertex = EyeVertex { position: view.scale(Point3::new(Vec3::new(x, y, 0.5))), varying: () };
    let projected = view.project(&view.depth_map(false), &vertex);
    let exact = |c: f32, extent: Rational| from_f32(c) * from_f32(2.0) / extent;
    let height = from_f32(height);
    let exact_x = exact(x, &height * from_f32(aspect));
    Sample::relative(projected.x, &exact_x).worst(Sample::relative(projected.y, &exact(y, height)))
}

/// A projector, as it was asked for: its frame, the cotangent of half its angle, its aspect.
struct Asked {
    place: Frame<Eye, World>,
    scale: [f64; 2],
    projector: Projector,
}

/// About so far from the origin of the world.
fn any_projector(rng: &mut Rng, far: f32) -> Asked {
    let mut direction = || Vec3::from_array([(); 3].map(|()| uniform(rng, -1.0, 1.0)));
    let (eye, ahead, up) = (direction() * far, direction(), direction());
    let place = look_at(Point3::new(eye), Point3::new(eye + ahead * far), Vector3::new(up)).unwrap_or_else(
        // Once in many thousands: up along the view.
        |_| Frame::from_mat3(Mat3::IDENTITY, Point3::new(eye)),
    );
    // Of axes nearly along those of the world, components that vanish.
    let place = if rng.one_in(8) {
        let mut tiny = || [1.0, -1.0][rng.index(2)] * rng.log_uniform(1e-45, 1e-36);
        let axes = [(); 3].map(|()| Vec3::new(tiny(), tiny(), tiny()));
        let axes = Mat3::from_cols(axes[0] + Vec3::X, axes[1] + Vec3::Y, axes[2] + Vec3::Z);
        Frame::from_mat3(axes, Point3::new(eye))
    } else {
        place
    };
    let (fov, aspect) = (uniform(rng, 0.01, 3.0), rng.log_uniform(0.25, 4.0));
    let cot = 1.0 / (f64::from(fov) / 2.0).tan();
    let projector = Projector::new(place, fov, aspect).expect("an angle below 180 degrees");
    Asked { place, scale: [cot / f64::from(aspect), cot], projector }
}

/// Each coordinate's error against the sum of its terms' magnitudes.
fn coordinates(rng: &mut Rng, far: f32, reach: f32) -> Sample {
    let Asked { place, scale, projector } = any_projector(rng, far);
    let away = Vec3::from_array([(); 3].map(|()| uniform(rng, -1.0, 1.0))) * reach;
    let point = place.origin().coords + away;
    let Homogeneous { u, v, q } = projector.project(Point3::new(point));
    let (eye, axes) = (place.origin().coords, place.axes());
    let error = |got: f32, axis: Vec3, scale: f64| {
        let terms: Vec<Rational> = (0..3)
            .map(|k| (from_f32(point[k]) - from_f32(eye[k])) * from_f32(axis[k]) * from_f64(scale))
            .collect();
        // As the documentation says, what is tiny of the axis counts as the smallest normal number.
        let size: f64 = (0..3)
            .map(|k| {
                let away = to_f64(&(from_f32(point[k]) - from_f32(eye[k]))).abs();
                away * (f64::from(axis[k]) * scale).abs().max(SMALLEST)
            })
            .sum();
        let exact: Rational = terms.into_iter().sum();
        Sample::new(got, &exact, size.max(SMALLEST))
    };
    let of_u = error(u, axes.x_axis, scale[0]);
    of_u.worst(error(v, axes.y_axis, scale[1])).worst(error(q, axes.z_axis, 1.0))
}

fn projector() -> Vec<Row> {
    let rows = [
        ("near the origin", 1.0, 10.0),
        ("far from the origin", 1e4, 10.0),
        ("points close to it", 1.0, 1e-3),
        ("within 1e-38 of the origin, points as close", 1e-38, 1e-38),
        ("within 1e34 of the origin, points in 1e34", 1e34, 1e34),
    ];
    let rows = rows.into_iter().map(|(region, far, reach)| {
        Row::new("Projector::project", region, 5.0, move |rng| coordinates(rng, far, reach))
    });
    let divide = Row::new("Homogeneous::divide", "on the image", 1.0, |rng| {
        let q = rng.log_uniform(1e-30, 1e30);
        let [u, v] = [(); 2].map(|()| q * uniform(rng, -0.9999, 0.9999));
        let Vec2 { x, y } = Homogeneous { u, v, q }.divide().expect("within the pyramid");
        let [exact_x, exact_y] = [u, v].map(|c| from_f32(c) / from_f32(q));
        Sample::relative(x, &exact_x).worst(Sample::relative(y, &exact_y))
    });
    rows.chain([divide]).collect()
}

pub(crate) fn tables() -> Vec<Table> {
    vec![
        Table {
            title: "Parallel projection",
            about: "Errors are in ε of the exact value, or of the smallest normal number if that is larger; those of \
                    `LinearDepth::z` in ε of 2 |z − A| + |z|, or 2 |z − B| + |z| reversed, with the same least distance.",
            rows: parallel(),
        },
        Table {
            title: "Projector",
            about: "Errors of u, v and q are in ε of the sum of the magnitudes of their three terms, the worst of the \
                    three, where what is below the smallest normal number of an axis or a sum counts as that; those of \
                    `divide` in ε of the quotient.",
            rows: projector(),
        },
    ]
}
