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

pub(crate) fn picture() -> common::File {
    let (mut color, mut depth) = (vec![0; PIXELS], vec![0.0; PIXELS]);
    let mut band = Band::<Rgba8, F32>::new((2 * WIDTH).into(), 0, &mut color, &mut depth)?;
    band.clear(common::BACKGROUND);

    // Left and right differ in the policy and in nothing else.
    floor(&mut band, 0, Affine)?;
    floor(&mut band, WIDTH, Exact)?;

    common::png((2 * WIDTH).into(), &color)
}

/// Draws the floor to the right of a column of the picture.
fn floor(
    band: &mut Band<'_, Rgba8, F32>,
    left: u16,
    interpolation: impl Interpolation,
) -> Result<(), Box<dyn std::error::Error>> {
    // Eight by eight fields: two by two texels, repeated four times in each direction.
    let board = Texture::<L8>::new(&[64, 232, 232, 64], 2, 2)?;
    let corners = [Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(1.0, 1.0), Vec2::new(0.0, 1.0)];

    let at = |x, y, z| Point3::<World>::new(Vec3::new(x, y, z));
    let camera = look_at(at(0.0, 1.0, 2.0), at(0.0, 0.0, 0.2), Vector3::new(Vec3::Y))?;
    let pass = Pass {
        view: View {
            to_eye: camera.inverse_orthonormal() * Frame::<Object, World>::IDENTITY,
            projection: Perspective::new(0.72, f32::from(WIDTH) / f32::from(HEIGHT), 0.1, 10.0)?,
            viewport: Viewport::new(left.into(), 0, WIDTH.into(), HEIGHT.into())?,
        },
        vertices: &corners,
        triangles: &[[0u16, 1, 2], [0, 2, 3]],
        // From (0, 0), near on the left, to (1, 1), far on the right.
        vertex_stage: |&Vec2 { x, y }: &Vec2| {
            (Point3::new(Vec3::new(2.0 * x - 1.0, 0.0, 1.0 - 2.0 * y)), 4.0 * Vec2::new(x, y))
        },
        fragment_stage: Unlit(board.sampler::<Nearest, Repeat>()),
        cull: Cull::Back,
        sides: Sides::GuardBand,
        interpolation,
    };
    draw(&pass, band, &mut [Slot::<Sub8, _>::EMPTY; 4], &mut ());
    Ok(())
}
