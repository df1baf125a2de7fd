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
mod lanes;
mod paint;
mod spans;
mod triangle;

pub use band::{Band, BandError};
pub use color::{ColorFormat, Rgb565Be, Rgb565Le, Store, rgb565};
pub use counters::Counters;
pub use depth::{D16, D24, DepthFormat, F32, F32Reversed, NoDepth};
pub use draw::{draw_triangle, draw_triangle_by};
pub use edge::{Edge, EdgeInt, FITS_I32};
pub use exact::Exact;
pub use fragment::FragmentStage;
pub use lanes::Lanes;
pub use spans::{Span, SpanWalker};
pub use triangle::{Cull, Outcome, Vertex};
