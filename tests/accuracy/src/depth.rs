//! The depth map zs = α + β/z.

use crate::{Row, Sample, Table};
use alberti_oracle::rational;
use alberti_oracle::rng::Rng;
use alberti_projection::DepthMap;

/// Planes with this ratio of far to near.
fn planes(rng: &mut Rng, ratio: f32) -> [f32; 2] {
    let near = rng.log_uniform(1e-4, 1e3);
    [near, near * ratio]
}

/// Between the planes: near one of them, or anywhere on a logarithmic scale.
fn any_z(rng: &mut Rng, [near, far]: [f32; 2]) -> f32 {
    let z = match rng.index(4) {
        0 => near * (1.0 + rng.log_uniform(1e-7, 1.0)),
        1 => far * (1.0 - rng.log_uniform(1e-7, 0.5)),
        _ => rng.log_uniform(near, far),
    };
    z.clamp(near, far)
}

pub(crate) fn tables() -> Vec<Table> {
    let ratios = [4.0f32, 1e3, 1e6, 1e9];
    let zs = ratios.map(|ratio| {
        Row::new(
            "DepthMap::zs, forward",
            format!("B/A = {ratio:e}"),
            3.0 * f64::from(ratio / (ratio - 1.0)) + 0.5,
            move |rng| {
                let [near, far] = planes(rng, ratio);
                let z = any_z(rng, [near, far]);
                let map = DepthMap::forward(near, far).expect("0 < near < far");
                Sample::new(map.zs(z), &rational::depth(z, near, far), 1.0)
            },
        )
    });
    vec![Table { title: "Depth", about: "Errors of zs are absolute, in ε of 1.", rows: zs.into() }]
}
