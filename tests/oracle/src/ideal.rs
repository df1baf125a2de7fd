//! The picture without a pipeline: a ray through every pixel centre, met with the triangles in eye space.
//!
//! Nothing is projected, clipped, snapped or interpolated in `1/w`. The ray of a pixel has the direction `d` with `d.z
//! = 1`, and a triangle `v0 v1 v2` is hit at `z d = b0 v0 + b1 v1 + b2 v2`, `b0 + b1 + b2 = 1`. Cramer's rule gives
//!
//! ```text
//!   b0 / z = d . (v1 x v2) / det      b1 / z = d . (v2 x v0) / det      b2 / z = d . (v0 x v1) / det
//!   det = v0 . (v1 x v2)              1 / z = the sum of the three
//! ```
//!
//! The hit lies within the triangle and before the eye if and only if no quotient is negative, wherever the vertices
//! are: triangles that cross the plane of the eye need no special care.

use crate::image::Image;
use crate::polygon::{Corner, clip_depth, corners};
use crate::scene::Scene;
use crate::vec3::{Vec3, cross, dot};
use crate::view::View;
use crate::visibility::{Place, Visibility, culled, pixels_between, triangles};
use std::ops::Range;

pub use crate::visibility::Seen;

/// Renders `scene` as it is, its vertices at their unrounded places.
///
/// # Precision
/// Coverage is decided by the signs of determinants in f64. At an edge that passes within rounding of a pixel centre
/// the decision is arbitrary but the same for both neighbours, so meshes show neither cracks nor doubly drawn pixels.
///
/// # Cost
/// Proportional to the pixels of all bounding boxes; shading is done once per pixel.
#[must_use]
pub fn render_ideal(scene: &Scene<'_>) -> Image {
    visible(scene).resolve(scene)
}

/// The point that is seen at each pixel, rows from the top: its triangle, counted over all parts, and its texture
/// coordinates. It is decided as in [`render_ideal`].
#[must_use]
pub fn see_ideal(scene: &Scene<'_>) -> Vec<Option<Seen>> {
    visible(scene).points(scene)
}

fn visible(scene: &Scene<'_>) -> Visibility {
    let view = View::new(scene);
    let mut visible = Visibility::new(scene);
    for (place, world) in triangles(scene) {
        let eye = world.map(|p| view.to_eye(p));
        draw(scene, &view, &mut visible, place, eye);
    }
    visible
}

fn draw(scene: &Scene<'_>, view: &View, visible: &mut Visibility, place: Place, eye: [Vec3; 3]) {
    let normals = [cross(eye[1], eye[2]), cross(eye[2], eye[0]), cross(eye[0], eye[1])];
    // Six times the volume between eye and triangle: positive when the vertices are seen counter-clockwise.
    let det = dot(eye[0], normals[0]);
    if det == 0.0 || !det.is_finite() || culled(scene.cull, det) {
        return;
    }
    let (columns, rows) = bounds(scene, view, eye);
    for y in rows {
        for x in columns.clone() {
            let ray = view.ray([x as f64 + 0.5, y as f64 + 0.5]);
            let shares = normals.map(|n| dot(ray, n));
            if !(0..3).all(|i| inside(shares[i], normals[i], det)) {
                continue;
            }
            let sum = shares[0] + shares[1] + shares[2];
            let z = det / sum;
            if z >= view.near && z <= view.far {
                visible.offer([x, y], z, place, || shares.map(|s| s / sum));
            }
        }
    }
}

/// Whether `share` has the sign of `det`, as seen from a pixel centre moved by `(e, e^2)` to the right and down: the
/// ray's x grows by a positive multiple of `e`, and its y shrinks by one of `e^2`.
fn inside(share: f64, normal: Vec3, det: f64) -> bool {
    [share, normal[0], -normal[1]].into_iter().find(|&c| c != 0.0).is_some_and(|c| (c > 0.0) == (det > 0.0))
}

/// The pixels that the part between near and far may cover: its projected box and two pixels around.
fn bounds(scene: &Scene<'_>, view: &View, eye: [Vec3; 3]) -> (Range<usize>, Range<usize>) {
    let between: Vec<Corner> = clip_depth(&corners(eye), view);
    if between.is_empty() {
        return (0..0, 0..0);
    }
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    for corner in &between {
        let pixel = view.project(corner.eye);
        for axis in 0..2 {
            low[axis] = low[axis].min(pixel[axis] - 2.0);
            high[axis] = high[axis].max(pixel[axis] + 2.0);
        }
    }
    (pixels_between(low[0], high[0], scene.width), pixels_between(low[1], high[1], scene.height))
}

#[cfg(test)]
mod tests;
