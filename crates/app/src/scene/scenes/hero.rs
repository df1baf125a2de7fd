//! The default picture: a mazzocchio in an arcade, after the painters for whom Alberti wrote.
//!
//! One-point perspective as in De pictura: the eye is level, and the lines of the pavement and of the arcades meet in
//! the middle of the picture. They do so inside the ring.

use super::BuiltIn;
use super::arcade::{Stones, arcade};
use super::build::{Builder, add, scale};
use super::paint::{marble, paint, rgb};
use super::pavement::{SUN, arcade_shadow, backdrop, ground, swept};
use super::solids::{
    DODECAHEDRON_REST, Frame, dodecahedron, inlay, marquetry, mazzocchio, pedestal, pentagon, ring_distance,
    sphere_of_72,
};
use crate::options::{Cull, DepthFormat, Filter, Shading, Wrap};
use crate::scene::Camera;

/// The eye's height over the pavement, and its place on the axis.
const EYE: [f64; 2] = [1.75, 7.5];
/// The pedestal's foot and height.
const PEDESTAL: ([f64; 2], f64) = ([0.0, 2.6], 0.9);
/// The ring's and the tube's radius.
const RING: [f64; 2] = [0.64, 0.23];
/// The two bodies on the floor: place and radius.
const SPHERE: ([f64; 2], f64) = ([-1.12, 3.15], 0.36);
const DODECAHEDRON: ([f64; 2], f64) = ([1.22, 3.0], 0.36);

/// The scene.
pub(super) fn hero() -> BuiltIn {
    let mut b = Builder::default();
    let ([px, pz], height) = PEDESTAL;
    let [ring, tube] = RING;
    // The eighth-turned tube touches the pedestal with a flat face.
    let middle = [px, height + ring + tube * (super::build::TURN / 16.0).cos(), pz];
    let frame = Frame::turned(0.095, 0.012);

    backdrop(&mut b, -95.0, EYE[0]);
    let shadow = |x: f64, z: f64| {
        let ray = ring_distance([x, 0.0, z], SUN, middle, frame, ring) - tube * 0.9;
        let bodies = [
            swept([x, z], [px, pz], 0.0, height, 0.47),
            swept([x, z], [SPHERE.0[0], SPHERE.0[1]], 0.3, 0.42, SPHERE.1),
            swept([x, z], [DODECAHEDRON.0[0], DODECAHEDRON.0[1]], 0.25, 0.35, DODECAHEDRON.1),
        ];
        bodies.into_iter().fold(arcade_shadow(x, z).min(ray), f64::min)
    };
    b.lean = [0.0, 0.0, 0.6];
    ground(&mut b, EYE[1], 3.4, 100.0, &shadow);

    let stones = Stones::new(&mut b);
    for side in [-1.0, 1.0] {
        arcade(&mut b, side, stones);
    }
    b.lean = [0.0; 3];

    let white = b.texture(paint(256, 256, |u, v| marble(u, v, 3, 81, rgb(0xf4_ead8), rgb(0xb4_a494))));
    pedestal(&mut b, [px, 0.0, pz], height, white);
    let texture = b.texture(inlay());
    mazzocchio(&mut b, middle, frame, ring, tube, texture);
    let texture = b.texture(marquetry());
    let ([x, z], radius) = SPHERE;
    sphere_of_72(&mut b, add([x, 0.0, z], scale([0.0, 1.0, 0.0], radius)), radius, texture);
    let texture = b.texture(pentagon());
    let ([x, z], radius) = DODECAHEDRON;
    dodecahedron(&mut b, [x, radius * DODECAHEDRON_REST, z], radius, texture);

    let [eye_y, eye_z] = EYE.map(super::build::round);
    BuiltIn {
        model: b.finish(),
        camera: Camera {
            eye: [0.0, eye_y, eye_z],
            target: [0.0, eye_y, 0.0],
            up: [0.0, 1.0, 0.0],
            roll: 0.0,
            fov: 50.0,
            near: 1.0,
            far: 160.0,
        },
        background: [184, 205, 220],
        shading: Shading::Lambert,
        filter: Filter::Bilinear,
        wrap: Wrap::Repeat,
        cull: Cull::Back,
        depth: DepthFormat::F32,
    }
}
