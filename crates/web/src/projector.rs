//! Station 6: a slide thrown on the corner of a room.
//!
//! ```text
//!   parameters  0 side from which the projector throws, degrees   1 its height   2 its opening angle, degrees
//!               3 whether vertices divide   4 side from which the camera looks, degrees
//!   results     0 1 the place on the slide of the middle of the floor's diagonal   2 3 the mean of the places of its
//!               ends   4 5 q of the ends
//! ```

use crate::canvas::Canvas;
use crate::numbers::{float, turn};
use crate::textures::{SLIDE, Textures};
use crate::{Drawn, Parameters};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::{Mix, Slide, Sunlit, VertexColor};
use alberti::texture::format::Rgba8888 as Texels;
use alberti::texture::{Bilinear, Clamp, Texture};
use alberti::*;
use alloc::vec::Vec;

/// The ends of a line on the floor, which a triangle's edge runs along.
const ENDS: [Vec3; 2] = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(ROOM, 0.0, ROOM)];

/// The length of the walls.
const ROOM: f32 = 3.4;

/// A corner of a face.
#[derive(Clone, Copy)]
struct Corner {
    position: Vec3,
    normal: Vec3,
    color: Vec3,
}

pub(crate) fn draw(
    canvas: &mut Canvas,
    results: &mut Vec<f32>,
    textures: &mut Textures,
    parameters: &Parameters,
) -> Drawn {
    let [degrees, height, opening, divided, looks, ..] = *parameters;
    let at = |degrees: f32, distance: f32, height: f32| {
        let [cos, sin] = turn(degrees);
        Point3::new(Vec3::new(distance * sin, height, distance * cos))
    };
    let middle = Point3::new(Vec3::new(0.9, 0.7, 0.9));
    let place = look_at(at(degrees, 5.4, height), middle, Vector3::new(Vec3::Y))?;
    let aspect = float(SLIDE[0] as usize) / float(SLIDE[1] as usize);
    let projector = Projector::new(place, opening.to_radians(), aspect)?;
    let camera = Camera::look_at(at(looks, 8.2, 3.9), Point3::new(Vec3::new(1.1, 0.9, 1.1)), Vec3::Y)?;
    let view = camera.perspective(0.62, 0.1..50.0)?;

    let (vertices, triangles) = room();
    let divides = divided > 0.5;
    // A projector's numbers are linear in space, so that vertices may carry them. Their quotients are not.
    let mesh = Mesh::new(&vertices, &triangles, |corner: &Corner| {
        let carried = projector.project(Point3::new(corner.position));
        let Homogeneous { u, v, q } = carried;
        let carried = if divides && q > 0.0 { Homogeneous { u: u / q, v: v / q, q: 1.0 } } else { carried };
        (corner.position, (carried, (corner.normal, corner.color)))
    });
    let image = Texture::new(Texels, textures.slide(), SLIDE[0], SLIDE[1])?;
    let stage = Slide {
        surface: Sunlit::new(VertexColor, Vector3::new(Vec3::new(0.35, 1.0, 0.5)), 0.16, 0.3),
        image: image.sampler(Bilinear, Clamp),
        mix: Mix::Add,
    };
    let mut target = canvas.target()?;
    alberti::draw(&mut target, &view, &mesh, stage);

    let of = |point: Vec3| projector.project(Point3::new(point));
    // Beside the image too, where nothing is shown.
    let divided = |Homogeneous { u, v, q }| if q > 0.0 { Vec2::new(u, v) / q } else { Vec2::NAN };
    let [a, b] = ENDS.map(of);
    let right = divided(of((ENDS[0] + ENDS[1]) / 2.0));
    let wrong = (divided(a) + divided(b)) / 2.0;
    results.extend([right.x, right.y, wrong.x, wrong.y, a.q, b.q]);
    Ok(())
}

/// The floor and two walls that meet in the origin, and a box in their corner.
fn room() -> (Vec<Corner>, Vec<[u16; 3]>) {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    // A parallelogram from `o` along `a`, then `b`: seen from where these run counter-clockwise.
    let mut face = |o: Vec3, a: Vec3, b: Vec3, color: Vec3| {
        let first = u16::try_from(vertices.len()).unwrap_or(u16::MAX);
        let normal = a.cross(b).normalize();
        vertices.extend([o, o + a, o + a + b, o + b].map(|position| Corner { position, normal, color }));
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    };
    let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z];
    let (plaster, wood, paint) =
        (Vec3::new(0.85, 0.84, 0.8), Vec3::new(0.75, 0.55, 0.4), Vec3::new(0.5, 0.7, 0.9));
    face(Vec3::ZERO, z * ROOM, x * ROOM, wood);
    face(Vec3::ZERO, x * ROOM, y * 2.6, plaster);
    face(z * ROOM, z * -ROOM, y * 2.6, plaster);
    let (o, a, b, c) =
        (Vec3::new(0.7, 0.0, 0.5), Vec3::new(0.8, 0.0, -0.25), y * 0.9, Vec3::new(0.25, 0.0, 0.8));
    face(o + c, a, b, paint);
    face(o + c + a, -c, b, paint);
    face(o + b, c, a, paint);
    face(o, c, b, paint);
    (vertices, triangles)
}

#[cfg(test)]
mod tests {
    use crate::{Page, Station};

    #[test]
    fn the_middle_is_not_the_mean_of_the_ends() {
        let mut page = Page::new();
        let mut parameters = [0.0; crate::PARAMETERS];
        parameters[..5].copy_from_slice(&[62.0, 2.4, 32.0, 0.0, 44.0]);
        page.draw(Station::Projector, [160, 120], &parameters).unwrap();
        let found = &page.results;
        assert!(found.iter().all(|number| number.is_finite()));
        assert!((found[1] - found[3]).abs() > 0.02, "{found:?}");
    }
}
