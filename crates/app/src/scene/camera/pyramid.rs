//! The part of space that a picture shows: a pyramid from the eye on, or all of it for parallel lines.

use crate::options::{DepthFormat, RenderOptions};
use crate::scene::normals::{cross, dot, length, normalize, sub};
use crate::scene::{Camera, Model};

/// The share of half of the picture by which more is taken for seen than is.
const MARGIN: f64 = 0.02;

/// The share of a face's size within which an eye is in its plane, so that the face is seen as nothing.
const EDGE_ON: f64 = 1e-6;

/// A picture, as far as planes of its camera depend on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sight {
    /// Width to height.
    pub(crate) aspect: f64,
    /// The greatest ratio of the far to the near plane that is chosen without being asked for.
    pub(crate) reach: f64,
}

impl Sight {
    /// The picture that options say. At the far plane, steps of depth are at most 2 % of the distance: of `n` steps
    /// each is `reach/n` of it, and reversed floats have as many steps anywhere.
    pub(crate) fn of(options: &RenderOptions) -> Self {
        let reach = match options.depth {
            DepthFormat::U16 => 1e3,
            DepthFormat::F32 | DepthFormat::U32 | DepthFormat::U24 => 1e5,
            DepthFormat::F32Reversed | DepthFormat::None => 1e6,
        };
        Self { aspect: f64::from(options.width) / f64::from(options.height), reach }
    }
}

/// A camera's eye and directions, and what it sees.
pub(crate) struct Pyramid {
    eye: [f64; 3],
    /// To the right, upwards, and forwards.
    axes: [[f64; 3]; 3],
    /// Half the width and the height of what is seen at the depth 1; none for parallel lines.
    tangents: Option<[f64; 2]>,
}

impl Pyramid {
    /// That of a picture in perspective with an `aspect`, or of parallel lines. There is none for a camera without a
    /// direction.
    pub(crate) fn new(camera: &Camera, aspect: Option<f64>) -> Option<Self> {
        let eye = camera.eye.map(f64::from);
        let forward = normalize(sub(camera.target.map(f64::from), eye))?;
        let right = normalize(cross(forward, camera.picture_up().map(f64::from)))?;
        let tangent = (f64::from(camera.fov).to_radians() / 2.0).tan() * (1.0 + MARGIN);
        let tangents = aspect.map(|aspect| [tangent * aspect, tangent]);
        Some(Self { eye, axes: [right, cross(right, forward), forward], tangents })
    }

    /// The least and the greatest depth of what is seen of a polygon; none if nothing is.
    pub(crate) fn depths(&self, corners: &[[f64; 3]]) -> Option<[f64; 2]> {
        self.depths_of(corners.iter().map(|corner| self.place(*corner)).collect())
    }

    /// The depth of the nearest point that is seen of a model's faces.
    pub(crate) fn nearest(&self, model: &Model) -> Option<f64> {
        let mut nearest = f64::INFINITY;
        for indices in model.parts.iter().flat_map(|part| &part.triangles) {
            let corner = |index: u32| model.vertices.get(index as usize).map(|vertex| vertex.position);
            let [Some(a), Some(b), Some(c)] = indices.map(corner) else { continue };
            let corners = [a, b, c].map(|corner| self.place(corner.map(f64::from)));
            let is_farther = corners.iter().all(|corner| corner[2] >= nearest);
            if is_farther || self.is_beside(&corners) || is_edge_on(&corners) {
                continue;
            }
            nearest = self.depths_of(corners.into()).map_or(nearest, |[least, _]| nearest.min(least));
        }
        (nearest < f64::INFINITY).then_some(nearest)
    }

    /// A place as the camera has it: to the right, upwards, and how deep.
    fn place(&self, point: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| dot(sub(point, self.eye), axis))
    }

    fn depths_of(&self, mut places: Vec<[f64; 3]>) -> Option<[f64; 2]> {
        for side in self.sides() {
            places = within(&places, |place| dot(side, *place));
        }
        let depths = places.iter().map(|place| place[2]);
        Some([depths.clone().reduce(f64::min)?, depths.reduce(f64::max)?])
    }

    fn is_beside(&self, places: &[[f64; 3]]) -> bool {
        self.sides().any(|side| places.iter().all(|place| dot(side, *place) < 0.0))
    }

    /// The directions into the pyramid from its sides, in the camera's axes.
    fn sides(&self) -> impl Iterator<Item = [f64; 3]> {
        let of = |[x, y]: [f64; 2]| [[1.0, 0.0, x], [-1.0, 0.0, x], [0.0, 1.0, y], [0.0, -1.0, y]];
        self.tangents.map(of).into_iter().flatten()
    }
}

/// Whether an eye at 0 is in the plane of a triangle, as exactly as places are known.
fn is_edge_on([a, b, c]: &[[f64; 3]; 3]) -> bool {
    let normal = cross(sub(*b, *a), sub(*c, *a));
    dot(normal, *a).abs() <= EDGE_ON * length(normal) * length(sub(*b, *a)).max(length(sub(*c, *a)))
}

/// The part of a polygon where a linear function is at least 0 (Sutherland and Hodgman 1974).
pub(crate) fn within(places: &[[f64; 3]], function: impl Fn(&[f64; 3]) -> f64) -> Vec<[f64; 3]> {
    let mut kept = Vec::with_capacity(places.len() + 1);
    for (k, here) in places.iter().enumerate() {
        let next = &places[(k + 1) % places.len()];
        let [at, then] = [function(here), function(next)];
        if at >= 0.0 {
            kept.push(*here);
        }
        if (at >= 0.0) != (then >= 0.0) {
            let share = at / (at - then);
            kept.push([0, 1, 2].map(|axis| here[axis] + share * (next[axis] - here[axis])));
        }
    }
    kept
}
