//! What the tests across crates share.

pub mod derivatives;
pub mod errors;
pub mod probe;
pub mod reference;

/// The README's example is a test.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
