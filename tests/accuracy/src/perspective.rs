//! The pyramid scale and the division.

use crate::{Row, Sample, Table};
use alberti_math::Point3;
use alberti_math::glam::Vec3;
use alberti_oracle::rational::{from_f32, from_f64, from_int};
use alberti_oracle::rng::Rng;
use alberti_projection::{EyeVertex, Perspective};

pub(crate) fn tables() -> Vec<Table> {
    let scale = |region: &'static str, fov: [f32; 2], sizes: [f32; 2]| {
        Row::new("Perspective::scale", region, 2.001, move |rng| {
            let fov = if rng.one_in(2) { rng.log_uniform(fov[0], fov[1]) } else { any(rng, fov) };
            let aspect = rng.log_uniform(0.1, 10.0);
            let view = Perspective::new(fov, aspect, 1.0, 2.0).expect("a pyramid");
            let p = Vec3::new(signed(rng, sizes), signed(rng, sizes), 1.0);
            let got = view.scale(Point3::new(p)).coords;
            // The tangent in f64 is within 2^-52 of the exact one, relatively.
            let cotangent = from_f64(1.0 / (f64::from(fov) / 2.0).tan());
            let y = from_f32(p.y) * &cotangent;
            let x = from_f32(p.x) * cotangent / from_f32(aspect);
            Sample::relative(got.x, &x).worst(Sample::relative(got.y, &y))
        })
    };
    let project = |region: &'static str, sizes: [f32; 2], z: [f32; 2]| {
        Row::new("Perspective::project", region, 1.0, move |rng| {
            let view = Perspective::new(1.0, 1.0, z[0], z[1]).expect("a pyramid");
            let p = Vec3::new(signed(rng, sizes), signed(rng, sizes), rng.log_uniform(z[0], z[1]));
            let v = EyeVertex { position: Point3::new(p), varying: () };
            let got = view.project(&view.depth_map(false), &v);
            let [x, y, z] = p.to_array().map(from_f32);
            let quotients = Sample::relative(got.x, &(x / &z)).worst(Sample::relative(got.y, &(y / &z)));
            quotients.worst(Sample::relative(got.q, &(from_int(1) / z)))
        })
    };
    let tiny = [f32::from_bits(1), 1e-38];
    vec![Table {
        title: "Perspective",
        about: "Errors are relative to the exact value, or to the smallest normal number if that is larger. \
                `scale` is judged against the cotangent of half the angle, `project` by xs, ys and q; for zs see below.",
        rows: vec![
            scale("opening angle from 1° to 179°", [0.0175, 3.124], [1e-3, 1e3]),
            scale("opening angle from 1e-6 to π - 1e-6", [1e-6, 3.141_591_6], [1e-3, 1e3]),
            scale("coordinates to 1e30", [0.1, 3.0], [1e-30, 1e30]),
            project("coordinates to 1e3, B/A = 1e3", [1e-3, 1e3], [0.1, 100.0]),
            project("coordinates to 1e30, B/A = 1e12", [1e-30, 1e30], [1e-6, 1e6]),
            project("coordinates subnormal", tiny, [1e-6, 1e6]),
            project("depths to `f32::MAX`/16", [1e-30, 1e30], [1e30, f32::MAX / 16.0]),
        ],
    }]
}

fn any(rng: &mut Rng, [least, most]: [f32; 2]) -> f32 {
    rng.uniform(f64::from(least), f64::from(most)) as f32
}

fn signed(rng: &mut Rng, [least, most]: [f32; 2]) -> f32 {
    let size = rng.log_uniform(least, most);
    if rng.one_in(2) { -size } else { size }
}
