//! What the functions on surfaces promise, against closed forms and `f64`.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "random numbers within the range of what they become"
)]

mod bump;
mod displacement;
mod environment;
mod lanes;
mod material;
mod mesh;
#[cfg(feature = "mikktspace")]
mod mikktspace;
mod normal;
mod parallax;
mod parametric;
mod support;
mod triangle;
mod wide_relief;
