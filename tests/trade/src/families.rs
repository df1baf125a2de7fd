//! The families of policies, and the rows of each.

mod light;
mod perspective;
mod storage;
mod textures;

use crate::row::Row;

/// A family: policies that can take each other's place.
pub struct Family {
    /// Its name.
    pub name: &'static str,
    /// The title of its chapter.
    pub title: &'static str,
    /// The paragraph that says what to pick when.
    pub advice: &'static str,
    /// The error that its plot shows, and its front goes by.
    pub axis: Axis,
    /// Makes its rows for pictures of a size: in each scene the reference first.
    pub rows: fn(&'static str, [u32; 2]) -> Vec<Row>,
}

impl std::fmt::Debug for Family {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Family").field("name", &self.name).finish_non_exhaustive()
    }
}

/// The error of a plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Of texture coordinates, in texels.
    Texels,
    /// Of the picture, as somebody sees it who flips between the two.
    Flip,
}

/// All of them, in the order of the page.
pub const FAMILIES: &[Family] = &[
    perspective::PERSPECTIVE,
    perspective::NUMBERS,
    storage::SUBPIXELS,
    storage::DEPTHS,
    textures::FILTERS,
    textures::DERIVATIVES,
    textures::ADDRESSES,
    light::LIGHT,
    light::RELIEF,
];
