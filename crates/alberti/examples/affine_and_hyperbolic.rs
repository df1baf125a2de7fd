//! The same floor with the same texture coordinates at its corners, twice: on the left interpolated linearly on the
//! screen (wrong: the pattern breaks along the diagonal between its two triangles), on the right hyperbolically,
//! Σ α' t/z over Σ α'/z.
//!
//!     cargo run --release -p alberti --example affine_and_hyperbolic -- affine_and_hyperbolic.png

mod common;

use alberti::glam::{Vec2, Vec3};
use alberti::shaders::Unlit;
use alberti::texture::{Nearest, Repeat, Texture, format::L8};
use alberti::*;
use std::process::ExitCode;

/// Of each half.
const WIDTH: u16 = 200;
const HEIGHT: u16 = 100;
const PIXELS: usize = 2 * WIDTH as usize * HEIGHT as usize;

fn main() -> ExitCode {
    common::write("affine_and_hyperbolic.png", picture)
}

fn picture() -> common::File {
    let (mut color, mut depth) = (vec![0; PIXELS], vec![0.0; PIXELS]);
    let (width, height) = (u32::from(2 * WIDTH), u32::from(HEIGHT));
    let mut target = Target::new(Rgba8888, F32, width, height, &mut color, &mut depth)?;
    target.clear(common::BACKGROUND);

    // Left and right differ in the policy and in nothing else.
    floor(&mut target, 0, Affine)?;
    floor(&mut target, WIDTH, Exact)?;

    common::png(width, &color)
}

/// Draws the floor to the right of a column of the picture.
fn floor(
    target: &mut Target<'_, Rgba8888, F32>,
    left: u16,
    interpolation: impl Interpolation,
) -> Result<(), Box<dyn std::error::Error>> {
    // Eight by eight fields: two by two texels, repeated four times in each direction.
    let board = Texture::new(L8, &[64, 232, 232, 64], 2, 2)?;
    let corners = [Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(1.0, 1.0), Vec2::new(0.0, 1.0)];

    // From (0, 0), near on the left, to (1, 1), far on the right.
    let place = |&Vec2 { x, y }: &Vec2| (Vec3::new(2.0 * x - 1.0, 0.0, 1.0 - 2.0 * y), 4.0 * Vec2::new(x, y));
    let mesh = Mesh::new(&corners, &[[0u16, 1, 2], [0, 2, 3]], place);
    let camera = Camera::look_at(Vec3::new(0.0, 1.0, 2.0), Vec3::new(0.0, 0.0, 0.2), Vec3::Y)?;
    let view = camera.perspective(0.72, 0.1..10.0)?;
    // Of the picture, a half.
    let half = Viewport::new(left.into(), 0, WIDTH.into(), HEIGHT.into())?;
    Pass::new(&view, &mesh, Unlit(board.sampler(Nearest, Repeat)))
        .viewport(half)
        .interpolation(interpolation)
        .draw(target);
    Ok(())
}
