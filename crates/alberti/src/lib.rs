#![no_std]
#![doc = include_str!("../README.md")]

#[cfg(test)]
extern crate std;

pub mod pipeline;
pub mod shaders;
mod stats;
mod vertex;

pub use alberti_math::{
    Eye, Fixed, Frame, Object, Point3, Rgba8, Sub4, Sub8, Subpixel, Varying, Vector3, World, glam,
};
pub use alberti_projection::{Perspective, ViewError, Viewport, look_at};
pub use alberti_raster::{
    Band, BandError, ColorFormat, Counters, Cull, D16, D24, DepthFormat, F32, F32Reversed, FragmentStage,
    NoDepth, Rgb565Be, Rgb565Le, Store,
};
pub use alberti_texture as texture;
pub use pipeline::{Pass, Sides, View, draw};
pub use stats::Stats;
pub use vertex::{Slot, VertexStage};
