#![no_std]
#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(any(test, feature = "std", feature = "arbitrary"))]
extern crate std;

#[macro_use]
mod logged;
#[macro_use]
mod named;

mod barycentric;
mod color;
mod exact;
mod fixed;
mod frame;
mod frame2;
mod gradient;
mod inlined;
pub mod lanes;
#[cfg(feature = "mint")]
mod minted;
mod octahedral;
mod orientation;
mod product;
mod q16;
mod reciprocal;
mod rgba565;
mod round;
mod space;
pub mod srgb;
mod structs;
mod varying;

pub use barycentric::{
    interpolate, map_triangle, plane_coefficients, segment_parameter, segment_weights, tetrahedron_weights,
    triangle_weights,
};
pub use color::{Rgb332, Rgb565Be, Rgb565Le, Rgba8, Rgba8888};
pub use fixed::{Fixed, GUARD_PIXELS, Sub4, Sub8, Subpixel};
pub use frame::Frame;
pub use frame2::Frame2;
pub use glam;
pub use gradient::Gradient;
pub use inlined::{each, each_pair, in_line, map2, map3, map4};
#[cfg(feature = "mint")]
pub use minted::NotAffine;
pub use octahedral::Octahedral;
pub use orientation::{Zone, orientation, signed_area};
pub use product::{LOW_WORDS_ONLY, high, high_of_half, high_signed, middle};
pub use q16::{Q16, scaled};
pub use reciprocal::{reciprocal, reciprocal_of_half, reciprocal_signed};
pub use rgba565::Rgba565;
pub use round::{floor_i32, round_half_up};
pub use space::{Cube, Eye, Object, Point, Point2, Point3, Space, Vector, Vector2, Vector3, World};
pub use varying::{Flat, Linear, Mode, Varying, blend2, blend2_by_mode, combine, flatten, hull3, is_finite};
