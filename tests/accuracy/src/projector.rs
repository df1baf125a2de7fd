//! Parallel projection, and the coordinates of a projector.

use crate::{Row, Sample, Table};
use alberti_math::glam::{Mat3, Vec2, Vec3};
use alberti_math::{Eye, Frame, Point3, Vector3, World};
use alberti_oracle::rational::{Rational, from_f32, from_f64, to_f64};
use alberti_oracle::rng::Rng;
use alberti_projection::{EyeVertex, Homogeneous, Parallel, Projection, Projector, look_at};

#[expect(clippy::cast_possible_truncation, reason = "any number near it will do")]
fn uniform(rng: &mut Rng, low: f64, high: f64) -> f32 {
    rng.uniform(low, high) as f32
}

/// Planes whose distance from each other is so many times the larger of their distances from the eye, or more.
fn planes(rng: &mut Rng, apart: f32) -> [f32; 2] {
    let size = rng.log_uniform(1e-6, 1e6);
    let near = size * uniform(rng, -1.0, 1.0);
    [near, near + size * apart * rng.log_uniform(1.0, 4.0)]
}

/// Between the planes, often close to one of them.
fn any_z(rng: &mut Rng, [near, far]: [f32; 2]) -> f32 {
    let share = rng.log_uniform(1e-7, 1.0);
    let z = if rng.one_in(2) { near + (far - near) * share } else { far - (far - near) * share };
    z.clamp(near, far)
}

fn parallel() -> Vec<Row> {
    let depths = [1.0f32, 1e-4].into_iter().flat_map(|apart| {
        let region = move |what: &str| format!("{what}, planes apart {apart:e} of their distance");
        let zs = move |reversed: bool| {
            move |rng: &mut Rng| {
                let [near, far] = planes(rng, apart);
                let z = any_z(rng, [near, far]);
                let map = Parallel::new(1.0, 1.0, near, far).expect("near < far").depth_map(reversed);
                let [z_exact, a, b] = [z, near, far].map(from_f32);
                let exact = if reversed { &b - z_exact } else { z_exact - &a } / (b - a);
                relative(map.zs(z), &exact)
            }
        };
        let back = move |rng: &mut Rng| {
            let [near, far] = planes(rng, apart);
            let zs = rng.log_uniform(1e-6, 1.0);
            let z = Parallel::new(1.0, 1.0, near, far).expect("near < far").depth_map(false).z(zs);
            let [zs, a, b] = [zs, near, far].map(from_f32);
            let distance = zs * (b - &a);
            let exact = a + &distance;
            Sample::new(z, &exact, to_f64(&distance) * 2.0 + to_f64(&exact).abs())
        };
        [
            Row::new("LinearDepth::zs", region("forward"), 3.0, zs(false)),
            Row::new("LinearDepth::zs", region("reversed"), 3.0, zs(true)),
            Row::new("LinearDepth::z", region("forward"), 1.0, back),
        ]
    });
    let scale = Row::new("Parallel::scale, project", "heights from 1e-6 to 1e6", 2.0, |rng| {
        let (height, aspect) = (rng.log_uniform(1e-6, 1e6), rng.log_uniform(0.1, 10.0));
        let view = Parallel::new(height, aspect, -1.0, 1.0).expect("a box");
        let [x, y] = [(); 2].map(|()| height * uniform(rng, -9.0, 9.0));
        let vertex = EyeVertex { position: view.scale(Point3::new(Vec3::new(x, y, 0.5))), varying: () };
        let projected = view.project(&view.depth_map(false), &vertex);
        let exact = |c: f32, extent: Rational| from_f32(c) * from_f32(2.0) / extent;
        let height = from_f32(height);
        let exact_x = exact(x, &height * from_f32(aspect));
        relative(projected.x, &exact_x).worst(relative(projected.y, &exact(y, height)))
    });
    depths.chain([scale]).collect()
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
        let size: f64 = terms.iter().map(|term| to_f64(term).abs()).sum();
        let exact: Rational = terms.into_iter().sum();
        Sample::new(got, &exact, size.max(f64::MIN_POSITIVE))
    };
    let of_u = error(u, axes.x_axis, scale[0]);
    of_u.worst(error(v, axes.y_axis, scale[1])).worst(error(q, axes.z_axis, 1.0))
}

fn projector() -> Vec<Row> {
    let rows = [
        ("near the origin", 1.0, 10.0),
        ("far from the origin", 1e4, 10.0),
        ("points close to it", 1.0, 1e-3),
    ];
    let rows = rows.into_iter().map(|(region, far, reach)| {
        Row::new("Projector::project", region, 5.0, move |rng| coordinates(rng, far, reach))
    });
    let divide = Row::new("Homogeneous::divide", "on the image", 1.0, |rng| {
        let q = rng.log_uniform(1e-30, 1e30);
        let [u, v] = [(); 2].map(|()| q * uniform(rng, -0.9999, 0.9999));
        let Vec2 { x, y } = Homogeneous { u, v, q }.divide().expect("within the pyramid");
        let [exact_x, exact_y] = [u, v].map(|c| from_f32(c) / from_f32(q));
        relative(x, &exact_x).worst(relative(y, &exact_y))
    });
    rows.chain([divide]).collect()
}

/// An error in ε of the exact value.
fn relative(got: f32, exact: &Rational) -> Sample {
    Sample::new(got, exact, to_f64(exact).abs().max(f64::from(f32::MIN_POSITIVE)))
}

pub(crate) fn tables() -> Vec<Table> {
    vec![
        Table {
            title: "Parallel projection",
            about: "Errors are in ε of the exact value; those of `LinearDepth::z` in ε of 2 |z − A| + |z|.",
            rows: parallel(),
        },
        Table {
            title: "Projector",
            about: "Errors of u, v and q are in ε of the sum of the magnitudes of their three terms, the worst of the \
                    three; those of `divide` in ε of the quotient.",
            rows: projector(),
        },
    ]
}
