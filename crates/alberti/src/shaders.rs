//! Built-in fragment stages. The last three wrap another, so that a scene pays for what it uses.
//!
//! | stage | varying | colour |
//! |---|---|---|
//! | [`Solid`] | any | one for all |
//! | [`VertexColor`] | `Vec3` | the varying, red, green, blue in [0, 1] |
//! | [`VertexColor565`] | [`Ready565`] | the same in 16 bits |
//! | [`Unlit`] | `Vec2` | a [`Map`]'s, a texture's for one, at the varying |
//! | [`Stored`] | `Vec2` | the same, in the texture's own format |
//! | [`Tinted`] | the wrapped stage's | the wrapped stage's times a colour |
//! | [`Lambert`] | `(Vec3, V)`: a normal and the wrapped stage's | the wrapped stage's, lit |
//! | [`Slide`] | `(Homogeneous, V)`: a place on an image and the wrapped stage's | the wrapped stage's, the image on it |
//!
//! [`material`] has stages that are composed of maps and lights.
//!
//! All arithmetic is on sRGB bytes, as they are stored.

mod color;
mod lambert;
mod map;
pub mod material;
mod slide;
mod texture;
mod tinted;

pub use color::{Ready565, Solid, VertexColor, VertexColor565};
pub use lambert::{Lambert, face_normal};
pub use map::{Map, Times};
pub use slide::{Add, Mix, Modulate, Slide};
pub use texture::{Differentiated, Stored, Unlit};
pub use tinted::Tinted;

use alberti_math::lanes::{Lanes, One};
use alberti_math::{Rgba8, Varying};
use alberti_raster::{FragmentStage, Gradient};

/// One sample's colour, by way of the code for several.
#[inline(always)]
fn alone<V: Varying>(stage: &impl FragmentStage<V, Color = Rgba8>, varying: V) -> Option<Rgba8> {
    let components = V::map(&V::gather([varying]), &|[x]: [f32; 1]| x);
    let steady = V::map(&components, &|_| 0.0);
    let (word, kept) = stage.shade_lanes(One, &components, &Gradient { dx: steady, dy: steady }, true);
    kept.then_some(Rgba8::from_bits(word.0))
}

/// A product of bytes over 255, to the nearest.
#[inline(always)]
fn per_255<L: Lanes>(lanes: L, product: L::U32) -> L::U32 {
    // x / 255 to the nearest is (x + 128) * 257 >> 16.
    let x = product + lanes.word(128);
    lanes.shr(x + lanes.shr(x, 8), 8)
}

/// The channels of colours.
#[inline(always)]
fn unpack<L: Lanes>(lanes: L, color: L::U32) -> [L::U32; 4] {
    let byte = lanes.word(255);
    [color & byte, lanes.shr(color, 8) & byte, lanes.shr(color, 16) & byte, lanes.shr(color, 24)]
}

/// Colours of these channels, which are bytes.
#[inline(always)]
fn pack<L: Lanes>(lanes: L, [r, g, b, a]: [L::U32; 4]) -> L::U32 {
    (r | lanes.shl(g, 8)) | (lanes.shl(b, 16) | lanes.shl(a, 24))
}
