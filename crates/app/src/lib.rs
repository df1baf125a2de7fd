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

mod displace;
mod images;
mod material;
mod materials;
mod mtl_check;
mod obj_check;
mod partners;
mod place;
mod prepare;
mod progress;
mod scene_file;
mod surfaces;
mod tangents;
