//! The command's output: the picture's file, counts and times, and the stages that people wait for.

pub mod aov;
pub mod exr;
pub mod file;
pub mod stats;

pub(crate) mod stage;
