//! The pictures in docs/pictures are what the examples draw now, byte by byte. After a change that is meant, run the
//! example by the command at its top, with the picture's path there.

#![allow(dead_code, reason = "nothing calls an example's `main`")]
#![allow(clippy::duplicate_mod, reason = "each example has the common part for itself")]

#[path = "../../../crates/alberti/examples/affine_and_hyperbolic.rs"]
mod affine_and_hyperbolic;
#[path = "../../../crates/alberti/examples/after_the_fragment.rs"]
mod after_the_fragment;
#[path = "../../../crates/alberti/examples/color_triangle.rs"]
mod color_triangle;
#[path = "../../../crates/alberti/examples/depth_precision.rs"]
mod depth_precision;
#[path = "../../../crates/alberti/examples/embedded_graphics.rs"]
mod embedded_graphics;
#[path = "../../../crates/alberti/examples/firmware_frame.rs"]
mod firmware_frame;
#[path = "../../../crates/alberti/examples/materials.rs"]
mod materials;
#[path = "../../../crates/alberti/examples/perspective_cube.rs"]
mod perspective_cube;
#[path = "../../../crates/alberti/examples/slide_projector.rs"]
mod slide_projector;
#[path = "../../../crates/alberti/examples/smooth_edges.rs"]
mod smooth_edges;

use std::error::Error;
use std::path::Path;

fn compare(name: &str, drawn: Result<Vec<u8>, Box<dyn Error>>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/pictures").join(name);
    let committed = std::fs::read(path).expect("a picture in docs/pictures");
    let drawn = drawn.expect("an example that draws");
    assert!(drawn == committed, "docs/pictures/{name} is not what its example draws");
    assert!(drawn.len() < 90_000, "{name} has {} bytes", drawn.len());
}

#[test]
fn color_triangle_is_what_it_was() {
    compare("color_triangle.png", color_triangle::picture());
}

#[test]
fn after_the_fragment_is_what_it_was() {
    compare("after_the_fragment.png", after_the_fragment::picture());
}

#[test]
fn perspective_cube_is_what_it_was() {
    compare("perspective_cube.gif", perspective_cube::picture());
}

#[test]
fn affine_and_hyperbolic_is_what_it_was() {
    compare("affine_and_hyperbolic.png", affine_and_hyperbolic::picture());
}

#[test]
fn depth_precision_is_what_it_was() {
    compare("depth_precision.png", depth_precision::picture());
}

#[test]
fn embedded_graphics_is_what_it_was() {
    compare("embedded_graphics.png", embedded_graphics::picture());
}

#[test]
fn firmware_frame_is_what_it_was() {
    compare("firmware_frame.png", firmware_frame::picture());
}

#[test]
fn smooth_edges_is_what_it_was() {
    compare("smooth_edges.png", smooth_edges::picture());
}

#[test]
fn slide_projector_is_what_it_was() {
    compare("slide_projector.png", slide_projector::picture());
}

#[test]
fn materials_are_what_they_were() {
    compare("materials.png", materials::picture());
}
