#![no_std]
#![doc = include_str!("../README.md")]

#[cfg(test)]
extern crate std;

pub mod pipeline;
mod prepared;
mod profile;
pub mod shaders;
mod stats;
mod vertex;

pub use alberti_math as math;
pub use alberti_math::{
    Eye, Fixed, Flat, Frame, Linear, Mode, Object, Point3, Q16, Rgba8, Sub4, Sub8, Subpixel, Varying,
    Vector3, World, for_lanes, glam, lanes,
};
pub use alberti_projection as projection;
pub use alberti_projection::{
    Homogeneous, Parallel, Perspective, Projection, Projector, ViewError, Viewport, look_at,
};
pub use alberti_raster as raster;
pub use alberti_raster::{
    Affine, Always, Band, BandError, Bounded, Color, ColorFormat, Counters, Cull, D16, D24, D32, DepthFormat,
    Equal, Exact, F32, F32Reversed, Farther, FixedPoint, FragmentStage, Interpolation, NoDepth, OrEqual,
    Plane, ReadOnly, Rgb565Be, Rgb565Le, Spans, Store,
};
pub use alberti_texture as texture;
pub use pipeline::{Pass, Sides, View, draw, draw_by};
pub use prepared::{Prepared, ScreenTriangle, prepare};
pub use profile::{
    BandOf, Desktop, Interpolated, Mcu, PassOf, PixelOf, Profile, Reference, ScreenTriangleOf, SlotOf,
    StoredOf, Tiny,
};
pub use stats::Stats;
pub use vertex::{Slot, VertexStage};
