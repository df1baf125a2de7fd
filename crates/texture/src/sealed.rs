//! The mark of traits that other crates cannot implement.

/// Implemented for the policies of this crate only.
pub trait Sealed {}
