//! A mesh that `alberti bake --scene cube` has made, drawn twice side by side: from constants of this program, and from
//! a file that is read in place. Both are in flash on a board; nothing is copied, and nothing is allocated.
//!
//!     cargo run --release -p alberti --example baked -- baked.png

#[path = "../common/mod.rs"]
mod common;

use alberti::baked::{Baked, Color};
use alberti::glam::Vec3;
use alberti::shaders::VertexColor;
use alberti::*;
use std::process::ExitCode;

/// The constants.
#[expect(unreachable_pub, reason = "public, for programs whose assets are a crate of their own")]
mod cube {
    include!("cube.rs");
}

/// The file.
static FILE: &[u8] = include_bytes!("cube.bin");

const SIDE: u16 = 240;
const PIXELS: usize = 2 * SIDE as usize * SIDE as usize;

fn main() -> ExitCode {
    common::write("baked.png", picture)
}

pub(crate) fn picture() -> common::File {
    let (mut color, mut depth) = (vec![0; PIXELS], vec![0; PIXELS]);
    let mut target = Target::new(Rgba8888, D16, 2 * u32::from(SIDE), SIDE.into(), &mut color, &mut depth)?;
    target.clear(common::BACKGROUND);
    frame(&mut target)?;
    common::png(2 * u32::from(SIDE), &color)
}

fn frame(target: &mut Target<'_, Rgba8888, D16>) -> Result<(), Error> {
    let camera = Camera::look_at(Vec3::new(2.6, 2.2, 3.4), Vec3::ZERO, Vec3::Y)?;
    let view = camera.perspective(0.9, 0.1..10.0)?;
    let side = u32::from(SIDE);
    let (left, right) = (Viewport::new(0, 0, side, side)?, Viewport::new(SIDE.into(), 0, side, side)?);

    let mesh = cube::mesh_0();
    Pass::new(&view, &mesh, VertexColor).with(MCU).viewport(left).draw(target);

    for part in Baked::read(FILE)?.parts() {
        let mesh = part.mesh::<Color>()?;
        Pass::new(&view, &mesh, VertexColor).with(MCU).viewport(right).draw(target);
    }
    Ok(())
}
