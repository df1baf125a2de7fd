//! Sweeps to the ends of parameters: each policy keeps the bound that it states, or a constructor refuses.
//!
//! An [`Axis`](axis::Axis) is a parameter that is swept by decades or octaves, and the policies that are tried along
//! it. Every pair of a policy and a point is a row. A [`Sweep`](sweep::Sweep) measures rows by random samples and by
//! climbing from the worst of them. It is cut into shards by [`Shard`](shard::Shard), whose results are merged by sums
//! and maxima, in any order: see [`Measured`](measured::Measured).
//!
//! `cargo xtask extremes` writes docs/extremes.md from it.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "random f64 become the f32 and pixels that are tested, and counts are small"
)]

pub mod axes;
pub mod axis;
pub mod measured;
pub mod options;
pub mod page;
pub mod parts;
pub mod plot;
pub mod shard;
pub mod sweep;

mod case;
mod pipeline;
mod policy;

/// ε, half the distance from 1 to the next `f32`.
const EPS: f64 = 1.0 / 16_777_216.0;
