//! Random vectors, and angles between vectors.

use alberti_math::{Frame, Object};
use alberti_oracle::rng::Rng;
use alberti_texture::surface::Tangent;
use glam::{DVec3, Vec2, Vec3};

/// The unit of errors.
pub(crate) const EPS: f64 = 1.0 / 16_777_216.0;

pub(crate) fn vec2(rng: &mut Rng, size: f64) -> Vec2 {
    Vec2::new(rng.uniform(-size, size) as f32, rng.uniform(-size, size) as f32)
}

pub(crate) fn vec3(rng: &mut Rng, size: f64) -> Vec3 {
    vec2(rng, size).extend(rng.uniform(-size, size) as f32)
}

/// The x, y and z axes.
pub(crate) fn axes(of: Frame<Tangent, Object>) -> [Vec3; 3] {
    [of.axes().x_axis, of.axes().y_axis, of.axes().z_axis]
}

/// The angle between two directions, in radians: accurate for small ones.
pub(crate) fn angle(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a / a.length(), b / b.length());
    2.0 * ((a - b).length() / 2.0).asin()
}

/// How far axes are from unit length and from right angles, in ε.
pub(crate) fn not_orthonormal(axes: [Vec3; 3]) -> [f64; 2] {
    let [x, y, z] = axes.map(|axis| axis.as_dvec3());
    let length = [x, y, z].map(|axis| (axis.length() - 1.0).abs()).into_iter().fold(0.0, f64::max);
    let cosine = [x.dot(y), y.dot(z), z.dot(x)].into_iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    assert!(length.is_finite() && cosine.is_finite(), "{axes:?}");
    [length / EPS, cosine / EPS]
}
