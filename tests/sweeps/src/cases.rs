//! The cases of each sweep.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "subpixels are within the guard band, and counts far below 2^53"
)]

use alberti_oracle::rng::Rng;

pub mod attributes;
pub mod clip;
pub mod coverage;
pub mod depth;
pub mod floats;
pub mod rationals;
pub mod tangents;
pub mod triangles;

/// The numbers of a block.
fn rng(block: u64, seed: u64) -> Rng {
    Rng::stream(seed, block)
}

/// An error with its case, if something does not hold.
macro_rules! ensure {
    ($holds:expr, $($words:tt)+) => {
        // What is no number does not hold either.
        let holds: bool = $holds;
        if !holds {
            return Err(format!($($words)+));
        }
    };
}
use ensure;
