#![doc = include_str!("../README.md")]

pub mod camera;
pub mod cli;
pub mod draw;
pub mod error;
pub mod image_file;
pub mod input;
pub mod normals;
pub mod obj;
pub mod options;
pub mod output;
pub mod render;
pub mod run;
pub mod scene;
pub mod scenes;
pub mod slide;
pub mod stats;

mod materials;
mod mtl_check;
mod obj_check;
mod progress;
