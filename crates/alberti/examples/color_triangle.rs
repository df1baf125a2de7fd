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

fn picture() -> common::File {
    let corners: [Corner; 3] = [([-0.9, -0.8], Vec3::X), ([0.9, -0.8], Vec3::Y), ([0.0, 0.85], Vec3::Z)];

    // The picture is yours, and so is its memory: a colour and a depth for each pixel.
    let mut color = vec![0; PIXELS];
    let mut depth = vec![0.0; PIXELS];
    let mut target = Target::new(Rgba8888, F32, WIDTH.into(), HEIGHT.into(), &mut color, &mut depth)?;
    target.clear(common::BACKGROUND);

    // The triangle faces an eye one unit away, whose right angle of view is two units high there.
    let camera = Camera::look_at(Vec3::Z, Vec3::ZERO, Vec3::Y)?;
    let view = camera.perspective(FRAC_PI_2, 0.1..10.0)?;
    // A vertex stage says where a vertex is, and which varying it carries to the pixels.
    let mesh = Mesh::new(&corners, &[[0u16, 1, 2]], |&([x, y], color)| (Vec3::new(x, y, 0.0), color));
    // A fragment stage makes a pixel's colour of that.
    draw(&mut target, &view, &mesh, VertexColor);

    common::png(WIDTH.into(), &color)
}
