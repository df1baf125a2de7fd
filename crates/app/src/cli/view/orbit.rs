//! Cameras that are moved by hand.

use super::keys::Place;
use crate::options::{Cull, Projection};
use crate::scene::camera::{turned as around, window_height};
use crate::scene::normals::{cross, dot, length, narrow, normalize, sub};
use crate::scene::{Camera, Model};

/// The highest elevation, in degrees: from the pole there is no way up or down.
const HIGHEST: f64 = 89.0;

/// The distances between which a model of radius 1 is looked at.
const DISTANCES: [f64; 2] = [1e-3, 300.0];

/// A camera that is moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Orbit {
    pub(super) camera: Camera,
    /// The point about which it turns.
    pub(super) pivot: [f64; 3],
    pub(super) projection: Projection,
}

impl Orbit {
    /// The same after a turn about the pivot: degrees to the right, and upwards.
    pub(super) fn turned(self, degrees: [f64; 2]) -> Self {
        let camera = about_target(&self.camera, degrees);
        let (Some(before), Some(after)) = (axes(&self.camera), axes(&camera)) else { return self };
        // The pivot stays where it is before the eye.
        let to = sub(self.pivot, wide(self.camera.eye));
        let to = weighted(after, before.map(|axis| dot(to, axis)));
        let by = sub(sub(self.pivot, to), wide(camera.eye));
        Self { camera: moved(&camera, by), ..self }
    }

    /// The same after a move across the view: heights of the picture, at the target, to the right and upwards.
    pub(super) fn panned(self, [right, upwards]: Place) -> Self {
        let Some(axes) = axes(&self.camera) else { return self };
        let height = match self.projection {
            Projection::Parallel { height } => f64::from(height),
            Projection::Perspective => self.opening() * length(view(&self.camera)),
        };
        let by = weighted(axes, [right * height, upwards * height, 0.0]);
        Self { camera: moved(&self.camera, by), pivot: add(self.pivot, by), ..self }
    }

    /// The same so many times as near to what is seen of a model at a place, which stays where it is in the picture.
    /// Without a place it is what is before the pivot. The model has this `radius`, and sides that are left out.
    pub(super) fn nearer(
        self,
        (model, radius): (&Model, f64),
        cull: Cull,
        (factor, place): (f64, Option<Place>),
    ) -> Self {
        let Some(axes) = axes(&self.camera) else { return self };
        let to = sub(self.pivot, wide(self.camera.eye));
        let [right, upwards, before] = axes.map(|axis| dot(to, axis));
        let before = if before > 0.0 { before } else { length(view(&self.camera)) };
        let height = match self.projection {
            Projection::Parallel { height } => f64::from(height),
            Projection::Perspective => self.opening() * before,
        };
        // Where the line of sight is at the distance of the pivot.
        let at = place.map_or([right, upwards], |place| place.map(|share| share * height));
        let aside = weighted(axes, [at[0], at[1], 0.0]);
        let (from, along) = match self.projection {
            Projection::Parallel { .. } => (add(wide(self.camera.eye), aside), axes[2]),
            Projection::Perspective => (wide(self.camera.eye), add(axes[2], aside.map(|x| x / before))),
        };
        let depths = [self.camera.near, self.camera.far].map(f64::from);
        let depth = struck(model, cull, (from, along), depths).unwrap_or(before);
        let point = add(from, along.map(|x| x * depth));
        let nearer = |place: [f64; 3]| [0, 1, 2].map(|k| point[k] + (place[k] - point[k]) / factor);

        let distance = match self.projection {
            Projection::Parallel { .. } => height,
            Projection::Perspective if factor > 1.0 => depth,
            Projection::Perspective => before,
        } / factor;
        // One that is too far away may come back.
        let [least, most] = DISTANCES.map(|distance| distance * radius);
        let is_useful = if factor > 1.0 { distance >= least } else { distance <= most };
        let (mut camera, mut projection) = (self.camera, self.projection);
        if let Projection::Parallel { height } = &mut projection {
            *height = narrow(distance);
            let by = sub(nearer(wide(camera.eye)), wide(camera.eye));
            camera = moved(&camera, weighted(axes, [dot(by, axes[0]), dot(by, axes[1]), 0.0]));
        } else {
            [camera.eye, camera.target] =
                [camera.eye, camera.target].map(|place| nearer(wide(place)).map(narrow));
        }
        if !is_useful || camera.eye == camera.target || camera.eye.iter().any(|x| !x.is_finite()) {
            return self;
        }
        Self { camera, pivot: nearer(self.pivot), projection }
    }

    /// The same by another projection, which has as much in view at the target.
    pub(super) fn projected(self, is_parallel: bool) -> Self {
        match self.projection {
            Projection::Perspective if is_parallel => {
                Self { projection: Projection::Parallel { height: window_height(&self.camera) }, ..self }
            }
            Projection::Parallel { height } if !is_parallel => {
                let Some(axes) = axes(&self.camera) else { return self };
                let by = length(view(&self.camera)) - f64::from(height) / self.opening();
                let eye = add(wide(self.camera.eye), axes[2].map(|x| x * by)).map(narrow);
                Self { camera: Camera { eye, ..self.camera }, projection: Projection::Perspective, ..self }
            }
            _ => self,
        }
    }

    /// The height of what a camera with perspective sees, as a share of its distance.
    fn opening(&self) -> f64 {
        2.0 * (f64::from(self.camera.fov).to_radians() / 2.0).tan()
    }
}

/// The distance at which a line of sight meets a model first, between two distances, in lengths of its direction.
fn struck(
    model: &Model,
    cull: Cull,
    (from, along): ([f64; 3], [f64; 3]),
    [near, far]: [f64; 2],
) -> Option<f64> {
    let corner = |index: u32| model.vertices.get(index as usize).map(|vertex| wide(vertex.position));
    let met = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(corner);
        let (a, b, c) = (a?, b?, c?);
        let (ab, ac, to) = (sub(b, a), sub(c, a), sub(from, a));
        let (across, over) = (cross(along, ac), cross(to, ab));
        let volume = dot(ab, across);
        let is_out = match cull {
            Cull::Back => volume <= 0.0,
            Cull::Front => volume >= 0.0,
            Cull::None => volume == 0.0,
        };
        let [u, v, distance] = [dot(to, across), dot(along, over), dot(ac, over)].map(|x| x / volume);
        let is_met = !is_out && u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (is_met && near <= distance && distance <= far).then_some(distance)
    };
    let triangles = model.parts.iter().flat_map(|part| &part.triangles);
    triangles.filter_map(met).min_by(f64::total_cmp)
}

/// Right, up and forward of a camera's picture.
fn axes(camera: &Camera) -> Option<[[f64; 3]; 3]> {
    let forward = normalize(view(camera))?;
    let right = normalize(cross(forward, wide(camera.picture_up())))?;
    Some([right, cross(right, forward), forward])
}

fn view(camera: &Camera) -> [f64; 3] {
    sub(wide(camera.target), wide(camera.eye))
}

fn moved(camera: &Camera, by: [f64; 3]) -> Camera {
    let [eye, target] = [camera.eye, camera.target].map(|place| add(wide(place), by).map(narrow));
    Camera { eye, target, ..*camera }
}

/// The sum of three vectors by these weights.
fn weighted(axes: [[f64; 3]; 3], weights: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| axes.iter().zip(weights).map(|(axis, weight)| axis[k] * weight).sum())
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + b[k])
}

fn wide(v: [f32; 3]) -> [f64; 3] {
    v.map(f64::from)
}

/// The camera after a turn about its target: degrees to the right, and upwards.
fn about_target(camera: &Camera, [right, upwards]: [f64; 2]) -> Camera {
    let mut camera = around(camera, None, right);
    let up = normalize(camera.up.map(f64::from)).unwrap_or([0.0, 1.0, 0.0]);
    let target = camera.target.map(f64::from);
    let arm = sub(camera.eye.map(f64::from), target);
    let distance = length(arm);
    let elevation = (dot(arm, up) / distance).clamp(-1.0, 1.0).asin().to_degrees();
    let flat = normalize([0, 1, 2].map(|k| arm[k] - dot(arm, up) * up[k]));
    // A camera at the pole is left alone until it is asked to come down.
    let (Some(flat), true) = (flat.or_else(|| away(&camera)), upwards != 0.0) else { return camera };
    let wanted = (elevation + upwards).clamp(-HIGHEST.max(-elevation), HIGHEST.max(elevation));
    let (sin, cos) = wanted.to_radians().sin_cos();
    camera.eye = [0, 1, 2].map(|k| narrow(target[k] + distance * (flat[k] * cos + up[k] * sin)));
    camera
}

/// The way from the target on the ground for a camera at the pole: against the upward direction of its picture.
fn away(camera: &Camera) -> Option<[f64; 3]> {
    let upwards = camera.picture_up().map(f64::from);
    let above = dot(sub(camera.eye.map(f64::from), camera.target.map(f64::from)), camera.up.map(f64::from));
    normalize(upwards.map(|x| if above > 0.0 { -x } else { x }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Part, Vertex};

    const CAMERA: Camera = Camera {
        eye: [1.0, 2.0, 6.0],
        target: [1.0, 2.0, 1.0],
        up: [0.0, 2.0, 0.0],
        roll: 0.0,
        fov: 90.0,
        near: 1.0,
        far: 9.0,
    };

    const ABOUT_TARGET: Orbit =
        Orbit { camera: CAMERA, pivot: [1.0, 2.0, 1.0], projection: Projection::Perspective };

    fn close(found: [f32; 3], right: [f32; 3]) {
        assert!(found.iter().zip(right).all(|(f, r)| (f - r).abs() < 1e-5), "{found:?} {right:?}");
    }

    /// A triangle of this depth, seen from the front, to the right of the middle of the picture.
    fn card(z: f32) -> Model {
        let corners = [[1.5, -9.0, z], [9.0, -9.0, z], [1.5, 99.0, z]];
        let vertices = corners.map(|position| Vertex { position, ..Vertex::default() }).into();
        let parts = vec![Part { triangles: vec![[0, 1, 2]], ..Part::default() }];
        Model { vertices, parts, ..Model::default() }
    }

    fn nearer(orbit: Orbit, model: &Model, factor: f64, place: Option<Place>) -> Orbit {
        orbit.nearer((model, 1.0), Cull::Back, (factor, place))
    }

    /// Where a point is in a picture of 90 degrees that is two by two, by plane geometry: the camera looks along -z.
    fn seen(orbit: Orbit, [x, y, z]: [f64; 3]) -> [f64; 2] {
        let [at_x, at_y, at_z] = wide(orbit.camera.eye);
        let half = match orbit.projection {
            Projection::Perspective => at_z - z,
            Projection::Parallel { height } => f64::from(height) / 2.0,
        };
        [(x - at_x) / half / 2.0, (y - at_y) / half / 2.0]
    }

    #[test]
    fn a_turn_is_about_the_pivot() {
        let turned = |camera: Camera, degrees| Orbit { camera, ..ABOUT_TARGET }.turned(degrees).camera;
        close(turned(CAMERA, [90.0, 0.0]).eye, [6.0, 2.0, 1.0]);
        close(turned(CAMERA, [0.0, 30.0]).eye, [1.0, 4.5, 1.0 + 5.0 * 0.75_f32.sqrt()]);
        // There and back, and no farther than the pole.
        let there = turned(CAMERA, [40.0, 50.0]);
        close(turned(turned(there, [0.0, -50.0]), [-40.0, 0.0]).eye, CAMERA.eye);
        let top = turned(CAMERA, [0.0, 500.0]);
        assert!(top.eye[1] > 6.99 && top.eye[2] > 1.0, "{:?}", top.eye);
        close(turned(top, [0.0, -HIGHEST]).eye, CAMERA.eye);
        // From straight above it comes down on the side that is below in the picture.
        let above = Camera { eye: [1.0, 7.0, 1.0], ..CAMERA };
        let down = turned(above, [0.0, -90.0]);
        close(down.eye, CAMERA.eye);
        // About a point beside the middle of the picture, half as far away.
        let beside = Orbit { pivot: [2.0, 2.0, 3.5], ..ABOUT_TARGET };
        let camera = beside.turned([90.0, 0.0]).camera;
        close(camera.eye, [4.5, 2.0, 4.5]);
        close(camera.target, [-0.5, 2.0, 4.5]);
    }

    #[test]
    fn a_pan_is_across_the_view() {
        // With 90 degrees a picture is twice as high as it is far away.
        let panned = ABOUT_TARGET.panned([0.5, -0.25]);
        close(panned.camera.eye, [6.0, -0.5, 6.0]);
        close(panned.camera.target, [6.0, -0.5, 1.0]);
        close(panned.pivot.map(narrow), [6.0, -0.5, 1.0]);
        let parallel = Orbit { projection: Projection::Parallel { height: 2.0 }, ..ABOUT_TARGET };
        close(parallel.panned([0.5, -0.25]).camera.eye, [2.0, 1.5, 6.0]);
    }

    #[test]
    fn a_factor_is_one_of_distance() {
        let model = Model::default();
        let eye = |factor| nearer(ABOUT_TARGET, &model, factor, None).camera.eye;
        close(eye(2.0), [1.0, 2.0, 3.5]);
        // A model is neither entered to its middle nor lost out of sight, and a lost one comes back.
        let mut orbit = ABOUT_TARGET;
        (0..200).for_each(|_| orbit = nearer(orbit, &model, 0.8, None));
        assert!((200.0..=300.0).contains(&(orbit.camera.eye[2] - 1.0)), "{orbit:?}");
        (0..200).for_each(|_| orbit = nearer(orbit, &model, 1.25, None));
        assert!((0.001..0.002).contains(&(orbit.camera.eye[2] - 1.0)), "{orbit:?}");
        let lost = Orbit { camera: Camera { eye: [1.0, 2.0, 9e3], ..CAMERA }, ..ABOUT_TARGET };
        assert!(nearer(lost, &model, 1.25, None).camera.eye[2] < 8e3);
        // An eye that rounds to the target stays where it is.
        let least = |factor| ABOUT_TARGET.nearer((&model, 1e-12), Cull::Back, (factor, None));
        assert_eq!(least(1e12), ABOUT_TARGET);
    }

    /// A point under the mouse stays there, and the pivot comes nearer to it.
    #[test]
    fn nearness_is_to_what_is_seen() {
        let model = card(3.0);
        let parallel = Orbit { projection: Projection::Parallel { height: 10.0 }, ..ABOUT_TARGET };
        for orbit in [ABOUT_TARGET, parallel] {
            for factor in [1.25, 0.5] {
                for (place, depth) in [([0.25, 0.125], 3.0), ([-0.25, 0.125], 1.0)] {
                    let half = match orbit.projection {
                        Projection::Perspective => 6.0 - depth,
                        Projection::Parallel { .. } => 5.0,
                    };
                    let point = [1.0 + 2.0 * place[0] * half, 2.0 + 2.0 * place[1] * half, depth];
                    let now = nearer(orbit, &model, factor, Some(place));
                    let at = seen(now, point);
                    assert!((at[0] - place[0]).hypot(at[1] - place[1]) < 1e-6, "{at:?} {place:?} {now:?}");
                    let way = sub(orbit.pivot, point).map(|x| x / factor);
                    close(sub(now.pivot, point).map(narrow), way.map(narrow));
                    // Back again.
                    let back = nearer(now, &model, 1.0 / factor, Some(place));
                    close(back.camera.eye, orbit.camera.eye);
                    close(back.pivot.map(narrow), orbit.pivot.map(narrow));
                }
            }
        }
        // Keys go to what is before the pivot, but not to a side that is left out.
        let behind = Orbit { pivot: [3.0, 2.0, 1.0], ..ABOUT_TARGET };
        let eye = |cull| behind.nearer((&model, 1.0), cull, (2.0, None)).camera.eye;
        close(eye(Cull::Back), [1.6, 2.0, 4.5]);
        close(eye(Cull::None), [1.6, 2.0, 4.5]);
        close(eye(Cull::Front), [2.0, 2.0, 3.5]);
        // Not what is before the front plane.
        let cut = Orbit { camera: Camera { near: 3.5, ..CAMERA }, ..behind };
        close(nearer(cut, &model, 2.0, None).camera.eye, [2.0, 2.0, 3.5]);
    }
}
