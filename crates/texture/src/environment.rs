//! Environment maps: from a direction to the place of an image of all that is around.
//!
//! Space in: directions of any length. Space out: coordinates (u, v) of the image, each from 0 to 1, for any sampler.
//!
//! | image | space in | wrap of u, v | cost |
//! |---|---|---|---|
//! | [`LatLong`]: longitude and latitude | world | `Repeat`, `Clamp` | two divisions and a square root |
//! | [`SphereMap`]: a mirror ball | eye | `Clamp` | six divisions and two square roots |
//! | [`CubeMap`]: six faces | world | `Clamp` | three divisions |
//!
//! [`Turned`] gives any of them another frame. All work over lanes, in `f32` and in fixed point. A direction that is
//! zero or not finite has a place too: each says which.
//!
//! ```
//! use alberti_math::lanes::One;
//! use alberti_texture::environment::{Environment, LatLong, reflect_lanes};
//! use alberti_texture::{Bilinear, Clamp, Repeat, Texture, format::L8};
//!
//! // Ground and sky.
//! let around = Texture::new(L8, &[200, 50], 1, 2)?;
//! let around = around.sampler_per_axis(Bilinear, Repeat, Clamp);
//! // A mirror that lies on the ground, and an eye above it.
//! let seen = reflect_lanes(One, [0.0, 1.0, 0.0], [0.6, 0.8, 0.0]);
//! let [u, v] = LatLong.place(One, seen);
//! assert_eq!(around.sample([u, v].into()).to_bytes()[0], 200);
//! # Ok::<(), alberti_texture::TextureError>(())
//! ```

mod any;
mod cube_map;
mod lat_long;
mod sphere_map;
mod turned;

pub use any::AnyEnvironment;
pub use cube_map::CubeMap;
pub use lat_long::LatLong;
pub use sphere_map::SphereMap;
pub use turned::Turned;

use crate::surface::dot_lanes;
use alberti_math::lanes::Lanes;
use core::fmt::Debug;

/// A way of laying out all directions in one image: [`LatLong`], [`SphereMap`], [`CubeMap`], or [`AnyEnvironment`] for
/// one that is picked at run time.
pub trait Environment: Copy + Debug {
    /// The coordinates (u, v) on the image of several directions, of any length.
    fn place<L: Lanes>(&self, lanes: L, direction: [L::Number; 3]) -> [L::Number; 2];
}

/// The direction in which an eye sees a mirror's environment: 2(n·v)n − v, for the unit normal n and the unit vector v
/// to the eye. Light's own reflection is the same, with the vector to the light.
///
/// # Precision
/// Each component is within 8ε of that of the given vectors (ε = 2^-24), in fixed point within 4·2^-16.
#[must_use]
#[inline(always)]
pub fn reflect_lanes<L: Lanes>(_: L, n: [L::Number; 3], v: [L::Number; 3]) -> [L::Number; 3] {
    let cosine = dot_lanes(n, v);
    let twice = cosine + cosine;
    [n[0] * twice - v[0], n[1] * twice - v[1], n[2] * twice - v[2]]
}

/// The direction, and zero where it is not finite.
#[inline(always)]
fn finite_or_zero<L: Lanes>(lanes: L, [x, y, z]: [L::Number; 3]) -> [L::Number; 3] {
    let zero = lanes.splat(0.0);
    // 0 times what is not finite is NaN.
    let finite = lanes.less(x * zero + y * zero + z * zero, lanes.splat(1.0));
    [lanes.select(finite, x, zero), lanes.select(finite, y, zero), lanes.select(finite, z, zero)]
}
