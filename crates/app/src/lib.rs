//! The `alberti` command as a library: scenes, input, rendering, output.

pub mod scene;
