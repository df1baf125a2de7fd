#![no_std]
#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(any(test, feature = "std", feature = "arbitrary"))]
extern crate std;

pub mod baked;
mod error;
mod geometry;
mod integers;
mod lines;
mod memory;
mod meshlets;
pub mod pipeline;
mod prepared;
mod profile;
mod screen;
pub mod shaders;
mod silhouettes;
mod staged;
mod stats;
#[cfg(feature = "threads")]
mod threads;
mod vertex;
mod view;
mod walk;

pub use alberti_math as math;
pub use alberti_math::{
    Eye, Fixed, Flat, Frame, Linear, Mode, Object, Octahedral, Point3, Q16, Rgb565Be, Rgb565Le, Rgba8,
    Rgba565, Rgba8888, Sub4, Sub8, Subpixel, Varying, Vector3, World, for_lanes, glam, lanes, lanes::Lanes,
    varying,
};
pub use alberti_projection as projection;
pub use alberti_projection::{
    AnyProjection, ClipSpace, Handedness, Homogeneous, Parallel, Perspective, Projection, Projector,
    ViewError, Viewport, eye_of_matrix, look_at,
};
pub use alberti_raster as raster;
pub use alberti_raster::{
    Affine, Always, AnyDepth, AnyDerivatives, Bands, Biased, ColorFormat, Counters, Coverage, Cull, D16, D24,
    D32, DepthFormat, Equal, Exact, F32, F32Reversed, Farther, FixedPoint, FragmentColor, FragmentStage,
    Fragments, Gradient, Interpolation, Lines, NoDepth, NoDerivatives, OrEqual, PerPixel, PerRun,
    PerTriangle, PingPong, Planes, ReadOnly, Ready, Silhouette, Spans16, Target, TargetError, Touched, Turn,
};
pub use alberti_texture as texture;
pub use error::Error;
pub use geometry::{Geometry, IntegerMesh, IntegerVertex, Mesh};
pub use memory::Memory;
#[cfg(feature = "std")]
pub use meshlets::Split;
pub use meshlets::{Ball, Meshlet, Meshlets};
pub use pipeline::{Pass, draw};
pub use prepared::{Prepared, PreparedTriangle};
pub use profile::{DESKTOP, MCU, Profile, REFERENCE, TINY};
pub use screen::Sides;
pub use staged::Staged;
pub use stats::Stats;
#[cfg(feature = "threads")]
pub use threads::clear_by_threads;
pub use vertex::Slot;
pub use view::{Camera, View};
