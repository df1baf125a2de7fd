//! Independent references that the alberti pipeline is tested against.
//!
//! This crate depends on no alberti crate, and reaches every result by a method that the pipeline does not use:
//!
//! | question | the pipeline | here |
//! |---|---|---|
//! | is a sample covered? | edge functions and a tie rule | the sample moved by an infinitesimal: [`coverage`] |
//! | what part of a pixel is covered? | sums of heights along edges | the triangle clipped at the pixel's sides: [`area`] |
//! | what is an attribute worth? | f32 weights | rationals ([`rational`]), or 106-bit floats with a proven bound ([`dd`]) |
//! | what are a point's coordinates? | quotients of determinants | linear systems in integers: [`linear`] |
//! | what does a scene look like? | clip, project, interpolate `1/w` | rays against planes in eye space: [`ideal`] |
//!
//! [`snapped`] is the exception: an f64 pipeline of the usual shape, with exact coverage, so that what snapping does to
//! a picture can be told apart from what the pipeline's rounding does to it.
//!
//! Bounds are tried on random cases, and on worse ones that [`climb`] finds from these.
//!
//! Conventions: screen y grows downwards, pixel centres lie at +0.5, eye space has x right, y up and z forward, the
//! world is right-handed, and counter-clockwise triangles are front faces.
//!
//! ```
//! use alberti_oracle::coverage::covers;
//!
//! // Two triangles share the edge from (0, 16) to (16, 0), and the sample (8, 8) lies on it: one of them owns it.
//! let sample = [8, 8];
//! let upper = covers([[0, 0], [16, 0], [0, 16]], sample);
//! let lower = covers([[16, 0], [16, 16], [0, 16]], sample);
//! assert!(upper != lower);
//! ```
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "references move between integers, f32, f64 and rationals all the time; the bounds stand beside the code"
)]

#[cfg(feature = "rationals")]
pub mod area;
pub mod cases;
pub mod climb;
pub mod coverage;
pub mod dd;
#[cfg(feature = "rationals")]
pub mod gradient;
pub mod ideal;
pub mod image;
#[cfg(feature = "rationals")]
pub mod linear;
pub mod material;
#[cfg(feature = "rationals")]
pub mod rational;
pub mod rng;
pub mod sampling;
pub mod scene;
pub mod snapped;

mod polygon;
mod shading;
mod vec3;
mod view;
mod visibility;
