//! The `alberti` command.
fn main() {}
