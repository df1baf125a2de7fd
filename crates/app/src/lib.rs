#![doc = include_str!("../README.md")]

pub mod advise;
pub mod aov;
pub mod bake;
pub mod cli;
pub mod colormap;
mod display;
pub mod draw;
pub mod error;
pub mod explain;
mod film;
pub mod info;
pub mod load;
pub mod measure;
pub mod memory;
pub mod options;
pub mod output;
pub mod probe;
pub mod render;
pub mod samples;
pub mod scene;
pub mod show;
mod threads;

pub use load::{image_file, obj};
pub use scene::{camera, scenes, slide};
