//! The common part of the tests across crates.

pub mod attributes;
pub mod derivatives;
pub mod errors;
pub mod narrow;
pub mod probe;
pub mod random;
pub mod reference;
pub mod sweep;
pub mod widest;

/// The README's example is a test.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
