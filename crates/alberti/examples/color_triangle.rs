//! A triangle with a colour at each vertex: every pixel has the colour α c1 + β c2 + γ c3, with its barycentric
//! coordinates.
//!
//!     cargo run --release -p alberti --example color_triangle -- color_triangle.png

mod common;

use alberti::glam::Vec3;
use alberti::shaders::VertexColor;
use alberti::*;
use std::f32::consts::FRAC_PI_2;
use std::process::ExitCode;

const WIDTH: u16 = 240;
const HEIGHT: u16 = 180;
const PIXELS: usize = WIDTH as usize * HEIGHT as usize;

/// A vertex is whatever you like: here two coordinates and a colour.
type Corner = ([f32; 2], Vec3);

fn main() -> ExitCode {
    common::write("color_triangle.png", picture)
}

pub(crate) fn picture() -> common::File {
    let corners: [Corner; 3] = [([-0.9, -0.8], Vec3::X), ([0.9, -0.8], Vec3::Y), ([0.0, 0.85], Vec3::Z)];

    // The picture is yours, and so is its memory: a colour and a depth for each pixel.
    let mut color = vec![0; PIXELS];
    let mut depth = vec![0.0; PIXELS];
    let mut band = Band::<Rgba8, F32>::new(WIDTH.into(), 0, &mut color, &mut depth)?;
    band.clear(common::BACKGROUND);

    let aspect = f32::from(WIDTH) / f32::from(HEIGHT);
    let pass = Pass {
        view: View {
            // The triangle faces an eye one unit away, whose right angle of view is two units high there.
            to_eye: Frame::at(Point3::new(Vec3::Z)),
            projection: Perspective::new(FRAC_PI_2, aspect, 0.1, 10.0)?,
            viewport: Viewport::new(0, 0, WIDTH.into(), HEIGHT.into())?,
        },
        vertices: &corners,
        triangles: &[[0u16, 1, 2]],
        // Where a vertex is, and what it carries to the pixels.
        vertex_stage: |&([x, y], color): &Corner| (Point3::new(Vec3::new(x, y, 0.0)), color),
        // What a pixel does with it.
        fragment_stage: VertexColor,
        cull: Cull::Back,
        sides: Sides::GuardBand,
        interpolation: Exact,
    };
    draw(&pass, &mut band, &mut [Slot::<Sub8, _>::EMPTY; 3], &mut ());

    common::png(WIDTH.into(), &color)
}
