//! A cube with a colour at each of its eight corners turns once around: perspective, a depth buffer for what is hidden,
//! and colours that stick to the faces while these recede. Writes an animated GIF.
//!
//!     cargo run --release -p alberti --example perspective_cube -- perspective_cube.gif

mod common;

use alberti::glam::{Mat3, Vec3};
use alberti::shaders::VertexColor;
use alberti::*;
use std::process::ExitCode;

const WIDTH: u16 = 160;
const HEIGHT: u16 = 120;
const PIXELS: usize = WIDTH as usize * HEIGHT as usize;
const FRAMES: u16 = 24;

/// The cosine and the sine of a frame's share of a turn: written out, since not all machines agree on functions.
const STEP: [f32; 2] = [0.965_925_8, 0.258_819_05];

/// Two triangles a face, counter-clockwise seen from outside. Bit 0 of a corner's number is its x, bit 1 its y, bit 2
/// its z.
const FACES: [[[u16; 3]; 2]; 6] = [
    [[0, 2, 3], [0, 3, 1]],
    [[4, 5, 7], [4, 7, 6]],
    [[0, 1, 5], [0, 5, 4]],
    [[2, 6, 7], [2, 7, 3]],
    [[0, 4, 6], [0, 6, 2]],
    [[1, 3, 7], [1, 7, 5]],
];

fn main() -> ExitCode {
    common::write("perspective_cube.gif", picture)
}

fn picture() -> common::File {
    let [cos, sin] = STEP;
    let step = Mat3::from_cols(Vec3::new(cos, 0.0, -sin), Vec3::Y, Vec3::new(sin, 0.0, cos));
    let mut turned = Mat3::IDENTITY;
    let mut frames = Vec::new();
    for _ in 0..FRAMES {
        frames.push(cube(turned)?);
        turned = step * turned;
    }
    common::gif(WIDTH, HEIGHT, 10, &frames)
}

/// The picture of the cube with its axes turned like this.
fn cube(axes: Mat3) -> Result<Vec<u32>, Box<dyn std::error::Error>> {
    let (mut color, mut depth) = (vec![0; PIXELS], vec![0; PIXELS]);
    let mut target = Target::new(Rgba8888, D16, WIDTH.into(), HEIGHT.into(), &mut color, &mut depth)?;
    target.clear(common::BACKGROUND);

    // The cube stands in the world's origin; the camera looks down on it.
    let cube = Frame::<Object, World>::from_mat3(axes, Point3::new(Vec3::ZERO));
    let camera = Camera::look_at(Vec3::new(0.0, 2.5, 4.3), Vec3::ZERO, Vec3::Y)?;
    let view = camera.perspective(0.75, 1.0..10.0)?;

    let corners: [u16; 8] = [0, 1, 2, 3, 4, 5, 6, 7];
    let mesh = Mesh::new(&corners, FACES.as_flattened(), |&corner| {
        // A corner's coordinates, each 0 or 1, are its colour's red, green and blue as well.
        let unit = Vec3::from_array([corner & 1, corner >> 1 & 1, corner >> 2].map(f32::from));
        (unit * 2.0 - Vec3::ONE, unit)
    });
    Pass::new(&view, &mesh, VertexColor).at(cube).draw(&mut target);
    Ok(color)
}
