//! A slide projector in a dim room: one image over two walls, the floor and a box, without a texture coordinate in the
//! model. Beside it the result of dividing at the vertices instead of the fragments, which is wrong.
//!
//!     cargo run --release -p alberti --example slide_projector -- slide_projector.png

mod common;

use alberti::glam::Vec3;
use alberti::shaders::{Mix, Slide, Sunlit, VertexColor};
use alberti::texture::{Bilinear, Clamp, Texture, format::Rgba8888};
use alberti::*;
use std::process::ExitCode;

/// Of each of the two.
const SIZE: [u16; 2] = [256, 192];
const SLIDE: [u16; 2] = [96, 64];

/// A corner of a face.
#[derive(Clone, Copy)]
struct Corner {
    position: Vec3,
    normal: Vec3,
    color: Vec3,
}

fn main() -> ExitCode {
    common::write("slide_projector.png", picture)
}

fn picture() -> common::File {
    let [width, height] = SIZE.map(u32::from);
    let mut pixels = vec![0; 2 * (width * height) as usize];
    let right = throw(|on_image| on_image)?;
    // The middle of two vertices then no longer shows the middle of their places on the image.
    let wrong = throw(|Homogeneous { u, v, q }| Homogeneous { u: u / q, v: v / q, q: 1.0 })?;
    let columns = width as usize;
    let rows = right.chunks(columns).zip(wrong.chunks(columns));
    for (both, (right, wrong)) in pixels.chunks_mut(2 * columns).zip(rows) {
        both[..columns].copy_from_slice(right);
        both[columns..].copy_from_slice(wrong);
    }
    common::png(2 * width, &pixels)
}

/// The room, whose vertices carry their places on the image as `carried` changes them.
fn throw(carried: fn(Homogeneous) -> Homogeneous) -> Result<Vec<u32>, Box<dyn std::error::Error>> {
    let [width, height] = SIZE.map(u32::from);
    let (vertices, triangles) = room();
    let slide = slide();
    let image = Texture::new(Rgba8888, &slide, SLIDE[0].into(), SLIDE[1].into())?;

    // From the right, across the room: closer to one wall than to the other.
    let at = |x, y, z| Point3::new(Vec3::new(x, y, z));
    let place = look_at(at(5.5, 2.6, 2.2), at(0.0, 1.3, 0.9), Vector3::new(Vec3::Y))?;
    let projector = Projector::new(place, 0.52, f32::from(SLIDE[0]) / f32::from(SLIDE[1]))?;
    let camera = Camera::look_at(at(5.2, 3.6, 6.4), at(0.9, 1.1, 0.7), Vec3::Y)?;
    let view = camera.perspective(0.72, 0.1..50.0)?;

    // The room stands in the world where it was built. A projector's numbers are linear in space, so that vertices may
    // carry them; the division is the fragments' affair.
    let mesh = Mesh::new(&vertices, &triangles, |corner: &Corner| {
        let on_image = carried(projector.project(Point3::new(corner.position)));
        (corner.position, (on_image, (corner.normal, corner.color)))
    });
    let stage = Slide {
        surface: Sunlit::new(VertexColor, Vector3::new(Vec3::new(0.3, 1.0, 0.5)), 0.14, 0.26),
        image: image.sampler(Bilinear, Clamp),
        mix: Mix::Add,
    };

    let pixels = (width * height) as usize;
    let (mut color, mut depth) = (vec![0; pixels], vec![1.0; pixels]);
    let mut target = Target::new(Rgba8888, F32, width, height, &mut color, &mut depth)?;
    target.clear(Rgba8::BLACK);
    draw(&mut target, &view, &mesh, stage);
    Ok(color)
}

/// The floor and two walls that meet in the origin, and a box in their corner.
fn room() -> (Vec<Corner>, Vec<[u16; 3]>) {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    // A parallelogram from `o` along `a`, then `b`: seen from where these run counter-clockwise.
    let mut face = |o: Vec3, a: Vec3, b: Vec3, color: Vec3| {
        let first = u16::try_from(vertices.len()).expect("a few faces");
        let normal = a.cross(b).normalize();
        vertices.extend([o, o + a, o + a + b, o + b].map(|position| Corner { position, normal, color }));
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    };
    let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z];
    let (plaster, wood, paint) =
        (Vec3::new(0.85, 0.84, 0.8), Vec3::new(0.75, 0.55, 0.4), Vec3::new(0.5, 0.7, 0.9));
    face(Vec3::ZERO, z * 9.0, x * 9.0, wood);
    face(Vec3::ZERO, x * 9.0, y * 4.0, plaster);
    face(z * 9.0, z * -9.0, y * 4.0, plaster);
    let (o, a, b, c) =
        (Vec3::new(1.1, 0.0, 0.9), Vec3::new(0.8, 0.0, -0.3), y * 0.9, Vec3::new(0.3, 0.0, 0.8));
    face(o + c, a, b, paint);
    face(o + c + a, -c, b, paint);
    face(o + b, c, a, paint);
    (vertices, triangles)
}

/// A test card, its first row the top one: coloured fields, a white frame, and an arrow that points up and is longer to
/// the right.
fn slide() -> Vec<[u8; 4]> {
    let [width, height] = SLIDE.map(i32::from);
    let texel = |x: i32, y: i32| {
        let (left, top) = (x.min(width - 1 - x), y.min(height - 1 - y));
        let (dx, dy) = (x - width / 2, y - 12);
        let head = (0..18).contains(&dy) && dx.abs() <= dy;
        let shaft = (18..38).contains(&dy) && (-5..5).contains(&dx);
        let foot = (30..38).contains(&dy) && (0..24).contains(&dx);
        if left < 2 || top < 2 || head || shaft || foot {
            return [210, 210, 200, 255];
        }
        let dark = (x / 8 + y / 8) % 2 == 0;
        let ramp = |c: i32, length: i32| u8::try_from(20 + 160 * c / length).unwrap_or(u8::MAX);
        let [r, g, b] = [ramp(x, width), ramp(height - y, height), ramp(width - x, width)];
        if dark { [r / 3, g / 3, b / 3, 255] } else { [r, g, b, 255] }
    };
    (0..height).flat_map(|y| (0..width).map(move |x| texel(x, y))).collect()
}
