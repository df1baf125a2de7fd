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

/// A model as it is seen from a direction: what tells how far away all of it is in the picture.
pub(super) struct View {
    ball: Sphere,
    axes: Axes,
    /// Within the margins.
    tangents: [f64; 2],
    depths: [f64; 2],
    sides: [[f64; 2]; 2],
    /// The depth before which the eye is, and its least distance.
    clear: f64,
    least: f64,
}

impl View {
    pub(super) fn new((model, ball): (&Model, Sphere), axes: Axes, lens: Lens) -> Self {
        let tangents = lens.tangents.map(|tangent| tangent * (1.0 - MARGIN));
        let depths = if lens.parallel { [0.0; 2] } else { tangents };
        let Extremes { sides, nearest } = extremes(points(model, ball, &used(model)), ball, axes, depths);
        // Parallel lines see what is behind the eye as well.
        let (clear, least) = if lens.parallel {
            (f64::INFINITY, 1e-3 * ball.radius)
        } else {
            (nearest - CLEARANCE * ball.radius, CLEARANCE * ball.radius)
        };
        Self { ball, axes, tangents, depths, sides, clear, least }
    }

    /// How far away all is within the left and the right side, and the lower and the upper one.
    fn distances(&self, target: [f64; 3]) -> [f64; 2] {
        let [right, up, forward] = self.axes;
        let from = sub(target, self.ball.center);
        let depth = dot(from, forward);
        let distance = |k: usize, place: f64| {
            let side =
                |side: f64, sign: f64| (side - sign * place + self.depths[k] * depth) / self.tangents[k];
            side(self.sides[k][0], 1.0).max(side(self.sides[k][1], -1.0))
        };
        [distance(0, dot(from, right)), distance(1, dot(from, up))]
    }

    /// How far from a target, which is in the middle of the picture, all is in view.
    pub(super) fn distance(&self, target: [f64; 3]) -> f64 {
        let depth = dot(sub(target, self.ball.center), self.axes[2]);
        let [across, upright] = self.distances(target);
        across.max(upright).max(depth - self.clear).max(self.least)
    }
}

/// The least and the greatest height in a view at each of so many depths, with that depth, from the ball's middle.
const OUTLINE: u16 = 256;

impl View {
    /// The points that are at the upper or lower edge of the model, from whatever distance.
    pub(super) fn outline(&self, model: &Model) -> Vec<[f64; 2]> {
        let [_, up, forward] = self.axes;
        let mut ends = vec![[None::<[f64; 2]>; 2]; usize::from(OUTLINE)];
        for from in points(model, self.ball, &used(model)) {
            let [depth, height] = [dot(from, forward), dot(from, up)];
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
            let at = ((depth / self.ball.radius + 1.0) / 2.0 * f64::from(OUTLINE)) as usize;
            let [low, high] = &mut ends[at.min(usize::from(OUTLINE) - 1)];
            if low.is_none_or(|low| height < low[1]) {
                *low = Some([depth, height]);
            }
            if high.is_none_or(|high| height > high[1]) {
                *high = Some([depth, height]);
            }
        }
        ends.into_iter().flatten().flatten().collect()
    }
}

/// The point on an axis through the middle of a model at which as much room is left below as above in all pictures.
/// They are those of cameras that turn about it, as far away as all of them take. Views have their outlines.
///
/// It is found as [`centred`] finds a place.
pub(super) fn balanced(views: &[(View, Vec<[f64; 2]>)], middle: [f64; 3], axis: [f64; 3]) -> [f64; 3] {
    const STEPS: usize = 16;
    let mut target = middle;
    for _ in 0..STEPS {
        let distance = views.iter().map(|(view, _)| view.distance(target)).fold(0.0, f64::max);
        // The least and the greatest tangent, with the height, the nearness and the axis's share of height there.
        let mut ends = [(f64::INFINITY, [0.0; 3]), (f64::NEG_INFINITY, [0.0; 3])];
        for (view, outline) in views {
            let [_, up, forward] = view.axes;
            let from = sub(target, view.ball.center);
            let (place, depth, share) = (dot(from, up), dot(from, forward) - distance, dot(axis, up));
            for [z, y] in outline {
                let near = if view.depths[1] > 0.0 { 1.0 / (z - depth) } else { 1.0 };
                let (height, tangent) = (y - place, (y - place) * near);
                if tangent < ends[0].0 {
                    ends[0] = (tangent, [height, near, share]);
                }
                if tangent > ends[1].0 {
                    ends[1] = (tangent, [height, near, share]);
                }
            }
        }
        let [(_, [low, near_low, share_low]), (_, [high, near_high, share_high])] = ends;
        let by = (low * near_low + high * near_high) / (near_low * share_low + near_high * share_high);
        if !by.is_finite() {
            break;
        }
        target = [0, 1, 2].map(|k| target[k] + by * axis[k]);
    }
    target
}

/// The eye and its target. A `target` that is given stays in the middle of the picture; else the silhouette is.
pub(super) fn fit(
    (model, ball): (&Model, Sphere),
    axes: Axes,
    lens: Lens,
    target: Option<[f64; 3]>,
) -> ([f64; 3], [f64; 3]) {
    let view = View::new((model, ball), axes, lens);
    let [right, up, forward] = axes;
    let at =
        |[x, y, z]: [f64; 3]| [0, 1, 2].map(|k| ball.center[k] + x * right[k] + y * up[k] + z * forward[k]);
    if let Some(target) = target {
        let from = sub(target, ball.center);
        let depth = dot(from, forward) - view.distance(target);
        return (at([dot(from, right), dot(from, up), depth]), target);
    }
    let mut depth = view.clear.min(-view.least);
    for (pair, tangent) in view.sides.into_iter().zip(view.tangents) {
        depth = depth.min(-(pair[0] + pair[1]) / (2.0 * tangent));
    }
    let mut place = view.sides.map(|[high, low]| (high - low) / 2.0);
    if !lens.parallel {
        let used = used(model);
        place = centred(|| points(model, ball, &used), axes, place, depth);
    }
    let [x, y] = place;
    (at([x, y, depth]), at([x, y, 0.0]))
}

/// The place beside the view, near this one, from which the silhouette is in the middle of the picture, for an eye at
/// that depth.
///
/// At the place x, a point at (p, z) is seen at (p − x)/(z − depth). Both extremes are as far from the middle at the
/// mean of their places by their nearness. Those are new extremes, at most a few times.
fn centred<P: Iterator<Item = [f64; 3]>>(
    points: impl Fn() -> P,
    [right, up, forward]: Axes,
    place: [f64; 2],
    depth: f64,
) -> [f64; 2] {
    const STEPS: usize = 8;
    let mut place = place;
    for _ in 0..STEPS {
        // Of each axis the least and the greatest tangent, and the place and the nearness there.
        let mut ends = [[(f64::INFINITY, 0.0, 0.0), (f64::NEG_INFINITY, 0.0, 0.0)]; 2];
        for from in points() {
            let near = 1.0 / (dot(from, forward) - depth);
            for ((ends, at), axis) in ends.iter_mut().zip(place).zip([right, up]) {
                let p = dot(from, axis);
                let end = ((p - at) * near, p, near);
                if end.0 < ends[0].0 {
                    ends[0] = end;
                }
                if end.0 > ends[1].0 {
                    ends[1] = end;
                }
            }
        }
        let before = place;
        for (at, [(_, a, near_a), (_, b, near_b)]) in place.iter_mut().zip(ends) {
            let middle = (a * near_a + b * near_b) / (near_a + near_b);
            *at = if middle.is_finite() { middle } else { *at };
        }
        if place == before {
            break;
        }
    }
    place
}

/// Whether triangles use each vertex; all, if there are no triangles.
fn used(model: &Model) -> Vec<bool> {
    let mut used = vec![false; model.vertices.len()];
    for index in model.parts.iter().flat_map(|part| part.triangles.iter().flatten()) {
        if let Some(used) = used.get_mut(*index as usize) {
            *used = true;
        }
    }
    if !used.contains(&true) {
        used.fill(true);
    }
    used
}

/// The places of vertices that are used, relative to the ball's middle.
fn points(model: &Model, ball: Sphere, used: &[bool]) -> impl Iterator<Item = [f64; 3]> {
    let pairs = model.vertices.iter().zip(used).filter(|(_, used)| **used);
    pairs.map(move |(vertex, _)| sub(vertex.position.map(f64::from), ball.center))
}

/// Those of these points; of none, those of the ball.
fn extremes(
    points: impl Iterator<Item = [f64; 3]>,
    ball: Sphere,
    [right, up, forward]: Axes,
    depths: [f64; 2],
) -> Extremes {
    let mut found = Extremes { sides: [[f64::NEG_INFINITY; 2]; 2], nearest: f64::INFINITY };
    for from in points {
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
                // The side that does not limit the distance is in the middle as well.
                assert!(sides.iter().all(|[low, high]| (low + high).abs() < 1e-9), "{sides:?}");
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
