//! The right picture of a scene, by rays in f64, and how far a renderer's picture is from it.

use crate::Size;
use crate::scene_data::Scene;
use alberti_oracle::ideal::render_ideal;
use alberti_oracle::image::{Image as Picture, compare};
use alberti_oracle::scene as oracle;
use alberti_oracle::snapped::render_snapped;
use alberti_tests::reference::{options, with_scene};

/// A pixel is off when a channel differs by more than this.
pub const TOLERANCE: u8 = 8;

/// The subpixel bits of alberti's timed policies.
const SUBPIXEL_BITS: u32 = 8;

/// The picture that the scene's definition asks for.
#[must_use]
pub fn ideal(scene: &Scene, size: Size) -> Vec<[u8; 4]> {
    drawn(scene, size, render_ideal)
}

/// The picture after vertices have been snapped as alberti snaps them, everything else in `f64`. Close to a horizon a
/// snapped vertex moves the texture by whole texels; that is a property of the policy, not an error of its arithmetic.
#[must_use]
pub fn snapped(scene: &Scene, size: Size) -> Vec<[u8; 4]> {
    drawn(scene, size, |scene| render_snapped(scene, SUBPIXEL_BITS))
}

fn drawn(scene: &Scene, size: Size, render: impl Fn(&oracle::Scene<'_>) -> Picture) -> Vec<[u8; 4]> {
    let built_in = &scene.built_in;
    let options = options(built_in, size.width, size.height);
    with_scene(&built_in.model, &built_in.camera, &options, |drawn| render(drawn).pixels)
}

/// How many pixels are off by more than [`TOLERANCE`].
#[must_use]
pub fn pixels_off(pixels: &[[u8; 4]], reference: &[[u8; 4]]) -> usize {
    compare(pixels, reference, TOLERANCE).differing
}

/// [`pixels_off`] as a part of all pixels.
#[must_use]
pub fn part_off(pixels: &[[u8; 4]], reference: &[[u8; 4]]) -> f64 {
    pixels_off(pixels, reference) as f64 / reference.len() as f64
}
