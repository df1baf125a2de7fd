//! The observer's frame.

use crate::{Row, Sample, Table, brief};
use alberti_math::glam::Vec3;
use alberti_math::{Eye, Frame, Point3, Vector3, World};
use alberti_oracle::rational::{from_f32, from_f64};
use alberti_oracle::rng::Rng;
use alberti_projection::look_at;

pub(crate) fn tables() -> Vec<Table> {
    let mut rows = Vec::new();
    let scales = [("coordinates around 1", 1.0f32), ("around 1e30", 1e30), ("around 1e-30", 1e-30)];
    for (region, scale) in scales {
        let axes = [("look_at, right", ACROSS), ("look_at, up", ACROSS), ("look_at, forward", FORWARD)];
        rows.extend(axes.into_iter().enumerate().map(|(axis, (function, bound))| {
            Row::new(function, region, bound, move |rng| axis_error(rng, scale, [0.1, 1.0], axis))
        }));
    }
    for sine in [1.0f32, 1e-1, 1e-3, 2e-5] {
        let region = format!("sin φ = {}", brief(sine));
        for (axis, function) in ["look_at, right", "look_at, up"].into_iter().enumerate() {
            rows.push(Row::new(function, region.clone(), ACROSS, move |rng| {
                axis_error(rng, 1.0, [0.99 * sine, sine], axis)
            }));
        }
        rows.push(Row::new("look_at, unit", region.clone(), UNIT, move |rng| {
            let (frame, _) = any_view(rng, 1.0, [0.99 * sine, sine]);
            products(&frame, |i| (i, i), 1.0)
        }));
        rows.push(Row::new("look_at, perpendicular", region, ACROSS, move |rng| {
            let (frame, [right, _]) = any_view(rng, 1.0, [0.99 * sine, sine]);
            products(&frame, |i| (i, (i + 1) % 3), 1.0 / length(right))
        }));
    }
    vec![Table {
        title: "Camera",
        about: "Errors of the axes' components are in ε for forward, and in ε/sin φ for right and up, φ being the angle \
                between the view and `up`; those references are in `f64`. Axes multiplied by themselves are off from 1 in \
                ε, by each other from 0 in ε/sin φ.",
        rows,
    }]
}

/// The documented bounds.
const FORWARD: f64 = 3.0;
const ACROSS: f64 = 4.0;
/// Of the square of a length.
const UNIT: f64 = 6.001;

fn any_vector(rng: &mut Rng) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| {
        let size = rng.log_uniform(1e-3, 1.0);
        if rng.one_in(2) { size } else { -size }
    }))
}

/// A view whose `up` is at an angle of about this sine to it, with the exact right (not unit: its length is the sine)
/// and forward.
fn any_view(rng: &mut Rng, scale: f32, [least, most]: [f32; 2]) -> (Frame<Eye, World>, [[f64; 3]; 2]) {
    loop {
        let (eye, target, side) = (any_vector(rng) * scale, any_vector(rng) * scale, any_vector(rng));
        let forward = unit(difference(target, eye));
        let across = unit(cross(forward, wide(side)));
        let sine = f64::from(rng.log_uniform(least, most));
        let cosine = (1.0 - sine * sine).sqrt();
        let up =
            std::array::from_fn(|i| ((forward[i] * cosine + across[i] * sine) * f64::from(scale)) as f32);
        // Rounded, `up` has another angle: that one counts.
        let up = Vec3::from_array(up);
        let right = cross(forward, unit(wide(up)));
        if let Ok(frame) = look_at(Point3::new(eye), Point3::new(target), Vector3::new(up)) {
            return (frame, [right, forward]);
        }
    }
}

/// The error of one axis.
fn axis_error(rng: &mut Rng, scale: f32, sines: [f32; 2], axis: usize) -> Sample {
    let (frame, [right, forward]) = any_view(rng, scale, sines);
    let exact = [unit(right), unit(cross(right, forward)), forward][axis];
    let scale = if axis == 2 { 1.0 } else { 1.0 / length(right) };
    let got = frame.axes().col(axis).to_array();
    let [x, y, z] = [0, 1, 2].map(|i| Sample::new(got[i], &from_f64(exact[i]), scale));
    x.worst(y).worst(z)
}

/// How far the products of three pairs of axes are off from what they should be.
fn products(frame: &Frame<Eye, World>, pair: fn(usize) -> (usize, usize), scale: f64) -> Sample {
    let [a, b, c] = [0, 1, 2].map(|i| {
        let (i, j) = pair(i);
        let [v, w] = [i, j].map(|axis| frame.axes().col(axis).to_array().map(from_f32));
        let product = &v[0] * &w[0] + &v[1] * &w[1] + &v[2] * &w[2];
        Sample::new(if i == j { 1.0 } else { 0.0 }, &product, scale)
    });
    a.worst(b).worst(c)
}

fn wide(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

fn difference(a: Vec3, b: Vec3) -> [f64; 3] {
    let (a, b) = (wide(a), wide(b));
    std::array::from_fn(|i| a[i] - b[i])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    v.map(|x| x / length(v))
}
