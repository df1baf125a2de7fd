//! From files to a scene: models with their materials and textures, and scene files.

pub mod image_file;
pub mod input;
pub mod obj;

pub(crate) mod images;
mod libraries;
mod material;
pub(crate) mod prepare;
pub(crate) mod scene_file;

mod mtl;
mod paths;
pub(crate) mod seen;
mod statements;
