//! Triangles with a covered pixel, and all that is interpolated there: the cases of tests and of sweeps.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "pixels and subpixels are within the guard band"
)]

use crate::probe::{LARGEST, steps, vertex};
use alberti_math::{GUARD_PIXELS, Subpixel};
use alberti_oracle::coverage::{Triangle, covers};
use alberti_oracle::rng::Rng;
use alberti_oracle::{cases, cases::pixel_centre};
use alberti_raster::Vertex;

/// A triangle with what it carries, and a pixel that it covers.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Vertices in subpixels.
    pub tri: Triangle,
    /// Column and row.
    pub pixel: [i32; 2],
    /// Distances of the vertices.
    pub z: [f32; 3],
    /// Screen depths.
    pub zs: [f32; 3],
    /// Values to interpolate.
    pub u: [f32; 3],
}

impl Case {
    /// The pixel's sample, in subpixels.
    #[must_use]
    pub fn sample(&self, subpixel: Subpixel) -> [i64; 2] {
        center(subpixel, self.pixel)
    }

    /// Reciprocals of the distances, rounded.
    #[must_use]
    pub fn q(&self) -> [f32; 3] {
        self.z.map(|z| 1.0 / z)
    }

    /// The triangle as it is drawn.
    #[must_use]
    pub fn vertices(&self) -> [Vertex<f32>; 3] {
        let q = self.q();
        [0, 1, 2].map(|i| vertex(self.tri[i], self.zs[i], q[i], self.u[i]))
    }

    /// The same triangle and pixel with other depths and values.
    #[must_use]
    pub fn with_other_values(self, rng: &mut Rng) -> Self {
        Self { z: any_z(rng), zs: any_zs(rng), u: any_u(rng), ..self }
    }

    /// The scale of errors: max|u|, not zero.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.u.iter().fold(0.0, |largest, u| f64::max(largest, f64::from(u.abs())))
    }
}

/// A covered pixel of any triangle with any values.
pub fn any_case(subpixel: Subpixel, rng: &mut Rng) -> Case {
    loop {
        let found = if rng.one_in(4) { thin(subpixel, rng) } else { Some(around(subpixel, rng)) };
        if let Some((tri, pixel)) = found
            && covers(tri, center(subpixel, pixel))
        {
            return Case { tri, pixel, z: [1.0; 3], zs: [0.0; 3], u: [1.0; 3] }.with_other_values(rng);
        }
    }
}

fn center(subpixel: Subpixel, [column, row]: [i32; 2]) -> [i64; 2] {
    pixel_centre(i64::from(column), i64::from(row), subpixel.bits())
}

/// Three vertices around a pixel of the frame, from a pixel to a frame away, and sometimes much flatter than wide.
fn around(subpixel: Subpixel, rng: &mut Rng) -> (Triangle, [i32; 2]) {
    let largest = f64::from(LARGEST);
    let pixel = [(); 2].map(|()| match rng.index(3) {
        0 => rng.range(0, 99),
        1 => i64::from(LARGEST) - 1 - rng.range(0, 99),
        _ => rng.range(0, i64::from(LARGEST) - 1),
    });
    let one = steps(subpixel)[0];
    let guard = i64::from(GUARD_PIXELS) * one;
    let sample = pixel_centre(pixel[0], pixel[1], subpixel.bits());
    let mut reach = [f64::from(rng.log_uniform(1.0, LARGEST as f32)).min(largest) * one as f64; 2];
    if rng.one_in(3) {
        reach[rng.index(2)] /= f64::from(rng.log_uniform(1.0, 1e6));
    }
    let tri = [(); 3].map(|()| {
        [0, 1].map(|k| (sample[k] + rng.uniform(-reach[k], reach[k]).round() as i64).clamp(-guard, guard))
    });
    (tri, pixel.map(|c| c as i32))
}

/// The oracle's hard cases, mirrored into the frame.
fn thin(subpixel: Subpixel, rng: &mut Rng) -> Option<(Triangle, [i32; 2])> {
    let case = cases::any(rng, subpixel.bits(), i64::from(GUARD_PIXELS) << subpixel.bits());
    let mirror = case.sample.map(|c| c.signum());
    let flip = |p: [i64; 2]| [p[0] * mirror[0], p[1] * mirror[1]];
    let pixel = flip(case.sample).map(|c| (c >> subpixel.bits()) as i32);
    pixel.iter().all(|&c| c < LARGEST).then(|| (case.tri.map(flip), pixel))
}

/// Depths in any ratio from 1 to 10^12.
fn any_z(rng: &mut Rng) -> [f32; 3] {
    let near = rng.log_uniform(1e-3, 1e3);
    let ratio = rng.log_uniform(1.0, 1e12);
    let mut z = [near, near * ratio, near * rng.log_uniform(1.0, ratio)];
    z.rotate_left(rng.index(3));
    z
}

/// Screen depths: near one another, near 1 as forward maps make them, or of any size as reversed ones do.
pub fn any_zs(rng: &mut Rng) -> [f32; 3] {
    let base = rng.unit() as f32;
    let kind = rng.index(3);
    [(); 3].map(|()| match kind {
        0 => (base + rng.uniform(-1e-4, 1e-4) as f32).clamp(0.0, 1.0),
        1 => 1.0 - rng.log_uniform(1e-7, 1.0),
        _ => rng.log_uniform(2f32.powi(-77), 1.0),
    })
}

/// Values of both signs over 80 binary orders, or alike, or the texels of a tiled texture.
pub fn any_u(rng: &mut Rng) -> [f32; 3] {
    let kind = rng.index(4);
    let base = rng.log_uniform(2f32.powi(-40), 2f32.powi(40));
    let spread = f64::from(rng.log_uniform(1e-6, 1.0));
    [(); 3].map(|()| {
        let sign = if rng.one_in(2) { -1.0 } else { 1.0 };
        match kind {
            0 => sign * rng.log_uniform(2f32.powi(-40), 2f32.powi(40)),
            1 => sign * base,
            2 => base * (1.0 + rng.uniform(-spread, spread)) as f32,
            _ => (sign * rng.range(1, 4096) as f32) / 16.0,
        }
    })
}

/// Whether a number lies between the least and the greatest of three.
#[must_use]
pub fn within(x: f32, [a, b, c]: [f32; 3]) -> bool {
    a.min(b).min(c) <= x && x <= a.max(b).max(c)
}
