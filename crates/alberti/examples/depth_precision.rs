//! What depth buffers can tell apart: pairs of cards that cross, at 10, 100, ... 100,000 times the near plane's
//! distance (from left to right), under four depth formats (from top to bottom: 16 bits, 24 bits, floats, floats
//! reversed).
//!
//! Each card is as large on the screen as any other, and the two of a pair cross in its vertical middle line: half of
//! it should be blue, and half orange. Where the steps of the format are longer than the distance of the cards, they
//! fight. The numbers that say where are printed.
//!
//!     cargo run --release -p alberti --example depth_precision -- depth_precision.png

mod common;

use alberti::glam::{Vec2, Vec3};
use alberti::projection::{DepthMap, DepthSteps};
use alberti::shaders::VertexColor;
use alberti::*;
use std::error::Error;
use std::f32::consts::FRAC_PI_2;
use std::process::ExitCode;

const NEAR: f32 = 1.0;
const FAR: f32 = 200_000.0;
const DISTANCES: [f32; 5] = [10.0, 100.0, 1000.0, 10_000.0, 100_000.0];
/// How far the cards of a pair are apart at their left and right edges, as a share of their distance from the eye.
const GAP: f32 = 0.01;

/// Pixels of a pair with its margin.
const SIDE: u16 = 72;
const WIDTH: u16 = 5 * SIDE;
const PANEL: usize = WIDTH as usize * SIDE as usize;
const BLUE: Vec3 = Vec3::new(0.25, 0.5, 0.95);
const ORANGE: Vec3 = Vec3::new(1.0, 0.65, 0.15);

fn main() -> ExitCode {
    common::write("depth_precision.png", picture)
}

fn picture() -> common::File {
    println!("The depth that one step of the buffer takes; cards are {GAP} of their distance apart:\n");
    println!("{:>12}{}  dz = 1 at", "distance", DISTANCES.map(|z| format!("{z:>10}")).concat());

    let mut color = vec![0; 4 * PANEL];
    let mut panels = color.chunks_exact_mut(PANEL);
    let mut next = || panels.next().ok_or("a picture of four panels");
    draw_cards("D16", D16, DepthSteps::D16, next()?)?;
    draw_cards("D24", D24, DepthSteps::D24, next()?)?;
    draw_cards("F32", F32, DepthSteps::F32, next()?)?;
    draw_cards("F32Reversed", F32Reversed, DepthSteps::F32, next()?)?;
    println!();

    common::png(WIDTH.into(), &color)
}

/// One panel, and its line of the table.
fn draw_cards<D: DepthFormat>(
    name: &str,
    format: D,
    steps: DepthSteps,
    color: &mut [u32],
) -> Result<(), Box<dyn Error>> {
    let mut depth = vec![format.farthest(); color.len()];
    let mut target = Target::new(Rgba8888, format, WIDTH.into(), SIDE.into(), color, &mut depth)?;
    target.clear(common::BACKGROUND);

    let aspect = f32::from(WIDTH) / f32::from(SIDE);
    let perspective = Perspective::new(FRAC_PI_2, aspect, NEAR, FAR)?;
    // The cards are given in eye coordinates.
    let view = View::new(Frame::IDENTITY, perspective);
    let (vertices, triangles) = cards();
    let mesh = Mesh::new(&vertices, &triangles, |&corner| corner);
    Pass::new(&view, &mesh, VertexColor).cull(Cull::None).draw(&mut target);

    let map: DepthMap = perspective.depth_map(format.reversed());
    let numbers = DISTANCES.map(|z| format!("{:>10.1e}", map.resolution(steps, z))).concat();
    println!("{name:>12}{numbers}{:>11.0}", map.separable_until(steps, 1.0));
    Ok(())
}

/// Corners with their colours. Both cards of a pair lean back; the orange one is turned around the vertical as well.
fn cards() -> (Vec<(Vec3, Vec3)>, Vec<[u16; 3]>) {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for (pair, distance) in (0u16..).zip(DISTANCES) {
        // The window is 10 wide and 2 high.
        let middle = Vec2::new(f32::from(2 * pair) - 4.0, 0.0);
        for (turn, color) in [(0.0, BLUE), (GAP, ORANGE)] {
            let first = u16::try_from(vertices.len()).unwrap_or(u16::MAX);
            for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                // What is linear on the screen is 1/z: so this is a plane, and the card a square.
                let z = distance / (1.0 - 0.3 * y + turn * x);
                let on_screen = middle + 0.85 * Vec2::new(x, y);
                vertices.push(((on_screen * z).extend(z), color));
            }
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    (vertices, triangles)
}
