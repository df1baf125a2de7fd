#![no_std]
#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(any(test, feature = "arbitrary"))]
extern crate std;

mod bands;
mod batch;
mod bias;
mod chosen;
pub mod color;
mod comparison;
mod counters;
mod coverage;
mod depth;
mod differentiation;
mod draw;
mod edge;
#[cfg(feature = "embedded-graphics")]
mod embedded;
mod error;
mod fill;
mod fragment;
mod interpolation;
mod line;
mod mask;
#[cfg(any(feature = "serde", feature = "arbitrary", feature = "defmt"))]
mod named;
mod paint;
mod ping_pong;
mod pixels;
mod sample_box;
mod setup;
mod small;
mod spans;
mod target;
mod touched;
mod triangle;
mod unsnapped;
mod weights;

pub use alberti_math::{Gradient, Rgb565Be, Rgb565Le, Rgba8888};
pub use bands::Bands;
pub use batch::Batch;
pub use bias::Biased;
pub use color::{ColorFormat, FragmentColor, rgb565};
pub use comparison::{Always, Equal, Farther, OrEqual, ReadOnly};
pub use counters::Counters;
pub use coverage::{Coverage, Edges, Silhouette};
pub use depth::{AnyDepth, D16, D24, D32, DepthFormat, F32, F32Reversed, NoDepth};
pub use differentiation::{AnyDerivatives, Differentiation, NoDerivatives, PerPixel, PerRun, PerTriangle};
pub use draw::Paint;
pub use edge::{Edge, EdgeInt, FITS_I32};
#[cfg(feature = "embedded-graphics")]
pub use embedded::TargetImage;
pub use error::TargetError;
pub use fragment::{FragmentStage, Fragments};
pub use interpolation::{Affine, Exact, FixedPoint, Interpolation, Lines, Planes, Spans16};
pub use ping_pong::{PingPong, Ready, Turn};
pub use spans::{Span, SpanWalker};
pub use target::Target;
pub use touched::Touched;
pub use triangle::{Corner, Cull, Numbers, Outcome, Reach, Vertex};

// For the command of this workspace, which draws where straight lines divide. They change as the kernels do.
#[doc(hidden)]
pub use differentiation::{Differentiate, Quotients, Samples};
#[doc(hidden)]
pub use interpolation::{Oriented, Row};
