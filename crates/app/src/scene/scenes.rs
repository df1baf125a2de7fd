//! Built-in scenes, made by formulas: pictures to look at, loads to time, and traps to fall into.
//!
//! Every scene is the same on every machine up to the last bit of `sin` and `cos`, which are taken in f64
//! and rounded to f32. Front faces are counter-clockwise; space is right-handed, y up.

mod arcade;
mod build;
mod hero;
mod paint;
mod pavement;
mod solids;
mod studies;
mod trials;

#[cfg(test)]
mod tests;

use crate::options::{Cull, DepthFormat, Filter, Shading, Wrap};
use crate::scene::{Camera, Model};

pub use trials::gouraud;

/// A scene that needs no file.
#[derive(Clone, Debug)]
pub struct BuiltIn {
    /// The model.
    pub model: Model,
    /// From where.
    pub camera: Camera,
    /// Behind the model, sRGB.
    pub background: [u8; 3],
    /// Its shading.
    pub shading: Shading,
    /// Filters of textures.
    pub filter: Filter,
    /// The textures' wrap mode.
    pub wrap: Wrap,
    /// The side that is left out.
    pub cull: Cull,
    /// The depth buffer.
    pub depth: DepthFormat,
}

/// The scenes' names, the default first, and their purpose.
const ABOUT: [(&str, &str); 7] = [
    ("hero", "a mazzocchio on a pedestal in a Florentine arcade: the default picture"),
    ("fill", "16 tilted textured screens with a depth test: fragments"),
    ("mesh", "a textured knot of 5,900 triangles"),
    ("gouraud", "a vertex-coloured lump of 69,312 triangles: vertices and setup"),
    ("floor", "one plane from behind the camera to the horizon: the near plane"),
    ("cube", "the colour cube"),
    ("inside", "a grotto from within: triangles across all six sides of the view volume"),
];

/// The names that [`by_name`] knows, the default first.
pub const NAMES: &[&str] = &{
    let mut names = [""; ABOUT.len()];
    let mut k = 0;
    while k < names.len() {
        names[k] = ABOUT[k].0;
        k += 1;
    }
    names
};

/// A line for each scene: its name and its purpose.
#[must_use]
pub fn list() -> String {
    ABOUT.iter().map(|(name, about)| format!("{name:<9}{about}\n")).collect()
}

/// The built-in scene of that name.
pub fn by_name(name: &str) -> Option<BuiltIn> {
    Some(match name {
        "hero" => hero::hero(),
        "fill" => trials::fill(),
        "mesh" => trials::mesh(),
        "gouraud" => gouraud(76),
        "floor" => trials::floor(),
        "cube" => studies::cube(),
        "inside" => studies::inside(),
        _ => return None,
    })
}
