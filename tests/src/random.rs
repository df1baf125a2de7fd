//! Random numbers, and triangles on the screen.

use alberti::glam::Vec3;
use alberti_math::Fixed;
use alberti_oracle::rng::Rng;
use alberti_raster::Vertex;

/// A random triangle in or about a small frame, often thin, sometimes a sliver as high as the guard band, with a wide
/// range of depths; snapped to 1/256 pixel.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "within the guard band, and f32 by choice")]
pub fn triangle(rng: &mut Rng) -> [Vertex<Vec3>; 3] {
    let center = [rng.uniform(-20.0, 120.0), rng.uniform(-20.0, 90.0)];
    let size = f64::from(rng.log_uniform(0.5, 4000.0));
    let size = if rng.one_in(8) { [f64::from(rng.log_uniform(0.3, 20.0)), 30_000.0] } else { [size; 2] };
    std::array::from_fn(|_| {
        let mut at = |axis: usize| {
            let pixels = center[axis] + rng.uniform(-size[axis], size[axis]);
            Fixed::from_bits(((pixels * 65_536.0) as i32).cast_unsigned())
        };
        let (x, y) = (at(0), at(1));
        let mut component = || rng.uniform(-1.0, 1.0) as f32;
        let varying = Vec3::new(component(), component(), component());
        Vertex { x, y, zs: rng.unit() as f32, q: rng.log_uniform(1e-6, 1e3), varying }
    })
}

/// Either sign, over many sizes or few.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "f32 by choice")]
pub fn any_number(rng: &mut Rng) -> f32 {
    let size = match rng.index(3) {
        0 => rng.log_uniform(1e-12, 1e12),
        1 => rng.log_uniform(0.1, 10.0),
        _ => rng.unit() as f32,
    };
    if rng.one_in(2) { -size } else { size }
}

/// A depth on one side of a plane, anywhere from next to it to far away.
#[must_use]
pub fn beside(rng: &mut Rng, plane: f32, sign: f32) -> f32 {
    loop {
        let z = plane + sign * plane * rng.log_uniform(1e-7, 1e7);
        if (z - plane) * sign > 0.0 {
            return z;
        }
    }
}
