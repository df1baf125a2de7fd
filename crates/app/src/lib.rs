#![doc = include_str!("../README.md")]

pub mod cli;
pub mod draw;
pub mod error;
pub mod explain;
pub mod load;
pub mod options;
pub mod output;
pub mod render;
pub mod scene;

pub use load::{image_file, obj};
pub use scene::{camera, scenes, slide};
