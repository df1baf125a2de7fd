//! Station 3: one triangle on its way through the view pipeline, each step by the library's function for it.
//!
//! ```text
//!   parameters  0 the step that is shown, which changes no number   1 2 3 the triangle's place in the world
//!               4 its turn about y, degrees   5 6 near, far
//!   results     0 α   1 β   2 cot ω   3 fragments   4 near   5 far, then for each of STEPS steps
//!               the number of vertices, and of each x y z r g b
//!   steps       world, eye, scaled, clipped near and far, cube, clipped at the sides, pixels
//! ```

use crate::canvas::Canvas;
use crate::numbers::{float, turn};
use crate::shading::plain;
use crate::{Drawn, Parameters};
use alberti::glam::{Mat3, Vec3};
use alberti::lanes::One;
use alberti::projection::{EyeVertex, ProjectedVertex, SideBounds, clip_near_far, clip_sides};
use alberti::shaders::VertexColor;
use alberti::*;
use alloc::vec::Vec;

/// The full vertical opening angle, radians: ω is half of it.
const FOV: f32 = 1.0;

/// The triangle in its own space, and the colours of its vertices.
const TRIANGLE: [(Vec3, Vec3); 3] = [
    (Vec3::new(-1.2, -0.9, 0.0), Vec3::new(1.0, 0.3, 0.25)),
    (Vec3::new(1.2, -0.7, 0.0), Vec3::new(0.35, 0.9, 0.4)),
    (Vec3::new(0.1, 1.0, 0.0), Vec3::new(0.4, 0.55, 1.0)),
];

/// The camera's place; it looks at the origin.
const EYE: Vec3 = Vec3::new(0.0, 0.8, 4.0);

pub(crate) fn draw(canvas: &mut Canvas, results: &mut Vec<f32>, parameters: &Parameters) -> Drawn {
    let [_, x, y, z, degrees, near, far, ..] = *parameters;
    let [cos, sin] = turn(degrees);
    let axes = Mat3::from_cols(Vec3::new(cos, 0.0, -sin), Vec3::Y, Vec3::new(sin, 0.0, cos));
    let model = Frame::<Object, World>::from_mat3(axes, Point3::new(Vec3::new(x, y, z)));
    let view = Camera::look_at(EYE, Vec3::ZERO, Vec3::Y)?.perspective(FOV, near..far)?;

    let mut target = canvas.target()?;
    let mesh = plain(&TRIANGLE, &[[0, 1, 2]]);
    let pass = Pass::new(&view, &mesh, VertexColor).at(model).cull(Cull::None);
    let mut stats = Stats::default();
    pass.sides(Sides::Cube).count_by(One, &mut target, &mut stats);

    let [width, height] = canvas.size();
    let viewport = Viewport::new(0, 0, width, height)?;
    let lens = view.projection(&viewport);
    let depth = lens.depth_map(false);
    let to_eye = view.object_to_eye(Some(&model));
    let in_eye = TRIANGLE
        .map(|(place, color)| EyeVertex { position: to_eye.to_parent(Point3::new(place)), varying: color });
    let scaled =
        in_eye.map(|EyeVertex { position, varying }| EyeVertex { position: lens.scale(position), varying });
    let between = clip_near_far(scaled, near, far);
    let projected = between.map(|vertex| lens.project(&depth, &vertex));
    let inside = clip_sides(projected, SideBounds::CUBE);

    // The cotangent is the height that the scale makes of a point one up and one ahead.
    let cotangent = lens.scale(Point3::new(Vec3::new(0.0, 1.0, 1.0))).coords.y;
    let fragments = float(usize::try_from(stats.fragments).unwrap_or(usize::MAX));
    results.extend([depth.alpha(), depth.beta(), cotangent, fragments, near, far]);
    let of_eye = |vertex: &EyeVertex<Vec3>| (vertex.position.coords, vertex.varying);
    let of_cube = |vertex: &ProjectedVertex<Vec3>| (Vec3::new(vertex.x, vertex.y, vertex.zs), vertex.varying);
    push(
        results,
        TRIANGLE.iter().map(|(place, color)| (model.to_parent(Point3::new(*place)).coords, *color)),
    );
    push(results, in_eye.iter().map(of_eye));
    push(results, scaled.iter().map(of_eye));
    push(results, between.vertices().iter().map(of_eye));
    push(results, projected.vertices().iter().map(of_cube));
    push(results, inside.vertices().iter().map(of_cube));
    push(
        results,
        inside.vertices().iter().map(|vertex| {
            let subpixels = |fixed: Fixed| float(fixed.subpixels().unsigned_abs() as usize) / 256.0;
            let [x, y] =
                viewport.to_screen(Sub8, vertex.x, vertex.y).map_or([f32::NAN; 2], |at| at.map(subpixels));
            (Vec3::new(x, y, vertex.zs), vertex.varying)
        }),
    );
    Ok(())
}

/// Adds a step's vertices.
fn push(results: &mut Vec<f32>, vertices: impl ExactSizeIterator<Item = (Vec3, Vec3)>) {
    results.push(float(vertices.len()));
    results.extend(vertices.flat_map(|(place, color)| [place, color]).flat_map(|triple| triple.to_array()));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Page, Station};

    /// The vertices of each step.
    fn counts(place: [f32; 3]) -> (Vec<usize>, f32) {
        let mut page = Page::new();
        let mut parameters = [0.0; crate::PARAMETERS];
        parameters[1..4].copy_from_slice(&place);
        parameters[4..7].copy_from_slice(&[60.0, 1.0, 9.0]);
        page.draw(Station::Pipeline, [160, 120], &parameters).unwrap();
        let (mut counts, mut at) = (Vec::new(), 6);
        while let Some(count) = page.results.get(at) {
            let count = crate::numbers::whole(*count, 9);
            counts.push(count as usize);
            at += 1 + 6 * count as usize;
        }
        (counts, page.results[3])
    }

    #[test]
    fn what_is_in_view_keeps_its_vertices() {
        let (counts, fragments) = counts([0.0; 3]);
        assert_eq!(counts, [3; 7]);
        assert!(fragments > 100.0);
    }

    #[test]
    fn the_near_plane_cuts_and_what_is_behind_is_gone() {
        let (found, _) = counts([0.0, 0.0, 3.2]);
        assert_eq!(found[..3], [3; 3]);
        assert!(found[3] != 3 || found[5] > 3, "{found:?}");
        assert_eq!(counts([0.0, 0.0, 8.0]).0, [3, 3, 3, 0, 0, 0, 0]);
    }
}
