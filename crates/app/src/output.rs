//! The command's output: the picture's file, counts and times, and a bar for people who wait.

pub mod aov;
pub mod exr;
pub mod file;
pub mod stats;

pub(crate) mod clock;
pub(crate) mod progress;
