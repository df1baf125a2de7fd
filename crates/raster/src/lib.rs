#![no_std]
#![doc = include_str!("../README.md")]

#[cfg(test)]
extern crate std;

mod band;
mod color;
mod comparison;
mod counters;
mod depth;
mod draw;
mod edge;
mod exact;
mod fixed_plane;
mod fixed_point;
mod floating;
mod fragment;
mod gradient;
mod interpolation;
mod lines;
mod mask;
mod paint;
mod plane;
mod planes;
mod spans;
mod triangle;

pub use band::{Band, BandError};
pub use color::{Color, ColorFormat, Rgb565Be, Rgb565Le, Store, rgb565};
pub use comparison::{Always, Equal, Farther, OrEqual, ReadOnly};
pub use counters::Counters;
pub use depth::{D16, D24, D32, DepthFormat, F32, F32Reversed, NoDepth};
pub use draw::{draw_triangle, reach};
pub use edge::{Edge, EdgeInt, FITS_I32};
pub use exact::{Exact, ExactTriangle};
pub use fixed_point::{FixedCursor, FixedEnds, FixedLines, FixedPoint};
pub use floating::{FloatingCursor, FloatingEnds, FloatingLines, FloatingPoint};
pub use fragment::FragmentStage;
pub use gradient::{
    Differentiation, Gradient, Neighbours, NoDerivatives, PerPixel, PerSpan, PerTriangle, Quotients,
    RunQuotients, Samples,
};
pub use interpolation::{Interpolate, Interpolation, Oriented, Row};
pub use lines::{Affine, Bounded, KnownRow, Left, LineTriangle, Lines, Numbers, Run, Spans, Subdivision};
pub use plane::{Plane, PlaneCursor, PlaneTriangle};
pub use spans::{Span, SpanWalker};
pub use triangle::{Corners, Cull, Outcome, Vertex};
