#![no_std]
#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(any(test, feature = "arbitrary"))]
extern crate std;

mod camera;
mod clip;
mod depth;
mod error;
#[cfg(any(feature = "serde", feature = "arbitrary", feature = "defmt"))]
mod form;
mod matrix;
mod parallel;
mod perspective;
mod projection;
mod projector;
mod relations;
mod resolution;
mod viewport;

pub use camera::look_at;
pub use clip::{EyeVertex, MAX_POLYGON, Polygon, ProjectedVertex, SideBounds, clip_near_far, clip_sides};
pub use depth::DepthMap;
pub use error::ViewError;
pub use matrix::{ClipSpace, Handedness, eye_of_matrix};
pub use parallel::{LinearDepth, Parallel};
pub use perspective::Perspective;
pub use projection::{AnyProjection, Projection};
pub use projector::{Homogeneous, Projector};
pub use relations::{EyeWeights, ScreenWeights};
pub use resolution::DepthSteps;
pub use viewport::Viewport;
