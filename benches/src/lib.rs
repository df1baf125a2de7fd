//! The same scenes drawn by alberti and by its peers, for `benches/frames.rs` to check and to time.
//!
//! A [`Renderer`] is prepared for one scene and one size; what it does in [`Renderer::render`] is what is timed:
//! clear colour and depth, transform all vertices, draw all triangles. One thread each, but for `two threads`.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "shaders for the peers move between f32 and integers the way their users write it"
)]

pub mod ours;
pub mod pavement;
pub mod peer_euc;
pub mod peer_retrofire;
pub mod peers;
pub mod reference;
pub mod scene_data;
pub mod stones;

use alberti_app::options::Filter;
use scene_data::Scene;
use std::fmt::Debug;

/// Columns and rows of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Size {
    /// Pixels of the picture.
    #[must_use]
    pub fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

impl std::fmt::Display for Size {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// The sizes that are timed: a small display and a desktop window.
pub const SIZES: [Size; 2] = [Size { width: 320, height: 240 }, Size { width: 1280, height: 720 }];

/// One renderer, ready to draw one scene at one size again and again.
pub trait Renderer: Debug {
    /// Draws a frame: clears colour and depth, transforms all vertices and draws all triangles.
    fn render(&mut self);

    /// The last frame: R, G, B, A, rows from the top.
    fn pixels(&self) -> &[[u8; 4]];
}

/// Everyone who can draw the scene, by the name that the benchmark gets: alberti's policies, then the peers.
#[must_use]
pub fn renderers(scene: &Scene, size: Size) -> Vec<(&'static str, Box<dyn Renderer>)> {
    let mut all: Vec<(&'static str, Box<dyn Renderer>)> = Vec::new();
    for &policy in ours::POLICIES {
        if let Some(renderer) = ours::renderer(policy, scene, size) {
            all.push((policy, renderer));
        }
    }
    // The crates have no mip maps.
    if matches!(scene.built_in.filter, Filter::Nearest | Filter::Bilinear) {
        all.push(("euc", peer_euc::renderer(scene, size)));
        all.extend(peer_retrofire::renderers(scene, size));
    }
    all
}
