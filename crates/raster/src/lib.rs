#![no_std]
#![doc = include_str!("../README.md")]

#[cfg(test)]
extern crate std;

mod band;
mod color;
mod counters;
mod depth;
mod draw;
mod edge;
mod exact;
mod fragment;
mod interpolation;
mod mask;
mod paint;
mod plane;
mod planes;
mod spans;
mod subdivided;
mod triangle;

pub use band::{Band, BandError};
pub use color::{Color, ColorFormat, Rgb565Be, Rgb565Le, Store, rgb565};
pub use counters::Counters;
pub use depth::{D16, D24, D32, DepthFormat, F32, F32Reversed, NoDepth, OrEqual, ReadOnly};
pub use draw::draw_triangle;
pub use edge::{Edge, EdgeInt, FITS_I32};
pub use exact::{Exact, ExactTriangle};
pub use fragment::FragmentStage;
pub use interpolation::{Interpolate, Interpolation};
pub use plane::{Affine, AffineTriangle, LinearCursor, Plane, PlaneCursor, PlaneTriangle};
pub use spans::{Span, SpanWalker};
pub use subdivided::{Spans, SubdividedTriangle};
pub use triangle::{Cull, Outcome, Vertex};
