//! The nearest place from which a camera of some direction sees all of a model, in closed form.
//!
//! ```text
//!        \  x   .  /        A point is right of the left side and left of the right one, if x − tz and −x − tz are at
//!         \    x  /         most those of the camera's place, t the tangent of half of the angle. So the greatest of
//!          \ x   /          each over all points are two lines, whose crossing is the nearest place.
//!           \   /
//!            \ /
//! ```

use super::{Sphere, dot, sub};
use crate::scene::Model;

/// The share of half of the picture that stays free on each side.
const MARGIN: f64 = 0.04;

/// The least distance from the eye to the nearest vertex, as a share of the model's radius.
const CLEARANCE: f64 = 0.1;

/// Right, up and forward: unit vectors at right angles.
pub(super) type Axes = [[f64; 3]; 3];

/// The greatest that the points have along the normals of the four sides, and the least distance.
struct Extremes {
    sides: [[f64; 2]; 2],
    nearest: f64,
}

/// Tangents of half of the view's angles, and whether its lines are parallel: then the view is as wide everywhere as
/// at the middle of the model.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    pub(super) tangents: [f64; 2],
    pub(super) parallel: bool,
}

/// The eye and its target. A `target` that is given stays in the middle of the picture; else the silhouette is.
pub(super) fn fit(
    (model, ball): (&Model, Sphere),
    axes: Axes,
    lens: Lens,
    target: Option<[f64; 3]>,
) -> ([f64; 3], [f64; 3]) {
    let tangents = lens.tangents.map(|tangent| tangent * (1.0 - MARGIN));
    let depths = if lens.parallel { [0.0; 2] } else { tangents };
    let Extremes { sides, nearest } = extremes(model, ball, axes, depths);
    // Parallel lines see what is behind the eye as well.
    let (clear, least) = if lens.parallel {
        (f64::INFINITY, 1e-3 * ball.radius)
    } else {
        (nearest - CLEARANCE * ball.radius, CLEARANCE * ball.radius)
    };
    let [right, up, forward] = axes;
    let at =
        |[x, y, z]: [f64; 3]| [0, 1, 2].map(|k| ball.center[k] + x * right[k] + y * up[k] + z * forward[k]);
    if let Some(target) = target {
        let from = sub(target, ball.center);
        let (place, depth) = ([dot(from, right), dot(from, up)], dot(from, forward));
        let mut distance = (depth - clear).max(least);
        for k in 0..2 {
            for (side, sign) in sides[k].into_iter().zip([1.0, -1.0]) {
                distance = distance.max((side - sign * place[k] + depths[k] * depth) / tangents[k]);
            }
        }
        return (at([place[0], place[1], depth - distance]), target);
    }
    let mut depth = clear.min(-least);
    for (pair, tangent) in sides.into_iter().zip(tangents) {
        depth = depth.min(-(pair[0] + pair[1]) / (2.0 * tangent));
    }
    let [x, y] = sides.map(|[high, low]| (high - low) / 2.0);
    (at([x, y, depth]), at([x, y, 0.0]))
}

/// Those of all vertices that triangles use, relative to the ball's middle.
fn extremes(model: &Model, ball: Sphere, [right, up, forward]: Axes, depths: [f64; 2]) -> Extremes {
    let mut used = vec![false; model.vertices.len()];
    for index in model.parts.iter().flat_map(|part| part.triangles.iter().flatten()) {
        if let Some(used) = used.get_mut(*index as usize) {
            *used = true;
        }
    }
    let all = !used.contains(&true);
    let mut found = Extremes { sides: [[f64::NEG_INFINITY; 2]; 2], nearest: f64::INFINITY };
    for (vertex, _) in model.vertices.iter().zip(used).filter(|(_, used)| *used || all) {
        let from = sub(vertex.position.map(f64::from), ball.center);
        let (place, z) = ([dot(from, right), dot(from, up)], dot(from, forward));
        for k in 0..2 {
            let [high, low] = found.sides[k];
            found.sides[k] = [high.max(place[k] - depths[k] * z), low.max(-place[k] - depths[k] * z)];
        }
        found.nearest = found.nearest.min(z);
    }
    if found.nearest.is_finite() {
        return found;
    }
    // Nothing: as for the ball.
    let side = ball.radius;
    Extremes { sides: depths.map(|t| [side * t.hypot(1.0); 2]), nearest: -side }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::camera::bounding_sphere;
    use crate::scene::{Part, Vertex};

    fn model(points: &[[f32; 3]]) -> Model {
        let vertices = points.iter().map(|&position| Vertex { position, ..Vertex::default() }).collect();
        let triangles = (0..u32::try_from(points.len()).unwrap() - 2).map(|k| [k, k + 1, k + 2]).collect();
        // A vertex that nothing uses.
        let mut model = Model { vertices, ..Model::default() };
        model.parts.push(Part { triangles, ..Part::default() });
        model.vertices.push(Vertex { position: [0.0; 3], ..Vertex::default() });
        model
    }

    /// The places of all points on the picture, from -1 to 1.
    fn seen(
        points: &[[f32; 3]],
        eye: [f64; 3],
        [right, up, forward]: Axes,
        lens: Lens,
        distance: f64,
    ) -> [[f64; 2]; 2] {
        let mut box_of = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for point in points {
            let from = sub(point.map(f64::from), eye);
            let depth = if lens.parallel { distance } else { dot(from, forward) };
            assert!(depth > 0.0);
            for (range, (axis, tangent)) in box_of.iter_mut().zip([right, up].into_iter().zip(lens.tangents))
            {
                let place = dot(from, axis) / (depth * tangent);
                *range = [range[0].min(place), range[1].max(place)];
            }
        }
        box_of
    }

    #[test]
    fn silhouettes_touch_the_margins_and_are_in_the_middle() {
        let points: Vec<[f32; 3]> = (0..40_u16)
            .map(|k| [1.7, 2.9, 4.3].map(|f: f32| 50.0 + 3.0 * (f * f32::from(k)).sin()))
            .map(|[x, y, z]| [x, 0.2 * y, 1.5 * z])
            .collect();
        let model = model(&points);
        let ball = bounding_sphere(&model);
        let axes = [[0.8, 0.0, -0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, -0.8]];
        for parallel in [false, true] {
            for tangents in [[0.1, 0.3], [0.5, 0.4], [2.0, 1.0]] {
                let lens = Lens { tangents, parallel };
                let (eye, target) = fit((&model, ball), axes, lens, None);
                let distance = dot(sub(target, eye), axes[2]);
                let sides = seen(&points, eye, axes, lens, distance);
                let widest = sides.into_iter().map(|[low, high]| high - low).fold(0.0, f64::max);
                let clear =
                    points.iter().map(|p| dot(sub(p.map(f64::from), eye), axes[2])).fold(f64::MAX, f64::min);
                // Where the eye is not too near to go nearer.
                if parallel || clear > 1.001 * CLEARANCE * ball.radius {
                    assert!((widest - 2.0 * (1.0 - MARGIN)).abs() < 1e-9, "{sides:?}");
                }
                for [low, high] in sides {
                    assert!(low >= MARGIN - 1.0 - 1e-9 && high <= 1.0 - MARGIN + 1e-9, "{sides:?}");
                }
                // A given target stays, and all is in view.
                let aside = [52.0, 11.0, 70.0];
                let (eye, target) = fit((&model, ball), axes, lens, Some(aside));
                assert_eq!(target.map(f64::to_bits), aside.map(f64::to_bits));
                let distance = dot(sub(target, eye), axes[2]);
                for [low, high] in seen(&points, eye, axes, lens, distance) {
                    assert!(low >= MARGIN - 1.0 - 1e-9 && high <= 1.0 - MARGIN + 1e-9);
                }
            }
        }
    }
}
