//! The families of policies, and the rows of each.

mod after;
mod light;
mod perspective;
mod storage;
mod textures;

use alberti_trade::family::Family;
use alberti_trade::row::Row;

/// Makes the rows of a family for pictures of a size: in each scene the reference first.
pub(crate) type Rows = fn(&'static str, [u32; 2]) -> Vec<Row>;

/// All of them, in the order of the page.
pub(crate) const FAMILIES: &[(Family, Rows)] = &[
    (perspective::PERSPECTIVE, perspective::perspective),
    (perspective::NUMBERS, perspective::numbers),
    (storage::SUBPIXELS, storage::subpixels),
    (storage::DEPTHS, storage::depths),
    (textures::FILTERS, textures::filters),
    (textures::DERIVATIVES, textures::derivatives),
    (textures::ADDRESSES, textures::addresses),
    (light::LIGHT, light::light),
    (light::RELIEF, light::relief),
    (after::BLENDS, after::blends),
];
