//! Cameras that go round a model.

use super::fit::{Lens, View, balanced};
use super::{Camera, CameraTable, Model, Sight, Sphere, clear, planes, pose, zoomed};
use super::{cross, dot, narrow, normalize, sub};

/// The most directions from which it is seen how far away a camera has to be.
const LOOKS: u32 = 64;

/// A way round a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turn {
    /// The axis through the target; the upward direction without it.
    pub(crate) axis: Option<[f64; 3]>,
    /// Degrees from the first frame to the one after the last.
    pub(crate) degrees: f64,
    /// Frames.
    pub(crate) frames: u32,
}

impl Turn {
    /// The cameras of all frames, of which the first is `first`. But where `fits` says that all of the model has to be
    /// in view, they are as far away as that takes. Then they turn about the model's middle, unless the wishes have a
    /// target. Planes that the wishes leave open are those around the ball, the same in all frames.
    pub(crate) fn cameras(
        &self,
        (model, ball): (&Model, Sphere),
        first: &Camera,
        wishes: &CameraTable,
        (sight, fits): (Sight, bool),
    ) -> Vec<Camera> {
        let first = if fits { self.fitted((model, ball), *first, wishes, sight.aspect) } else { *first };
        let frames = f64::from(self.frames.max(1));
        let at = |frame| self.at(&first, f64::from(frame) / frames);
        let mut cameras: Vec<Camera> =
            (0..self.frames).map(|frame| between((model, ball), at(frame), wishes, sight)).collect();
        let planes = cameras.iter().map(|camera| (camera.near, camera.far));
        let (near, far) = planes.fold((f32::MAX, f32::MIN), |(near, far), (n, f)| (near.min(n), far.max(f)));
        cameras.iter_mut().for_each(|camera| (camera.near, camera.far) = (near, far));
        cameras
    }

    /// The camera after a share of the turn, where things move, and perhaps the camera as well. At that time it would
    /// be `here` without the turn. Things come to all of `swept`, and its planes are around where they are `now`.
    pub(crate) fn moved(
        &self,
        [now, swept]: [(&Model, Sphere); 2],
        here: &Camera,
        wishes: &CameraTable,
        (sight, fits): (Sight, bool),
        share: f64,
    ) -> Camera {
        if self.degrees == 0.0 {
            return *here;
        }
        let here = if fits { self.fitted(swept, *here, wishes, sight.aspect) } else { *here };
        between(now, self.at(&here, share), wishes, sight)
    }

    /// A camera as far away as it takes to have all in view in all frames, with as much room below as above.
    fn fitted(&self, of: (&Model, Sphere), mut first: Camera, wishes: &CameraTable, aspect: f64) -> Camera {
        let arm = sub(wide(first.eye), wide(first.target));
        let target = wishes.target.map_or(of.1.center.map(narrow), <[f32; 3]>::from);
        first.target = target;
        first.eye = [0, 1, 2].map(|k| narrow(f64::from(target[k]) + arm[k]));
        // Those of the frames, or as many of one turn.
        let looks = self.frames.clamp(1, LOOKS);
        let degrees = if self.frames > LOOKS { self.degrees.clamp(-360.0, 360.0) } else { self.degrees };
        let looks = (0..looks).map(|k| turned(&first, self.axis, degrees * f64::from(k) / f64::from(looks)));
        let lens = lens(&first, wishes, aspect);
        let views: Vec<_> = looks.filter_map(|camera| view(of, &camera, lens)).collect();
        let axis = self.axis.unwrap_or(wide(first.up));
        placed(first, arm, &views, axis, wishes.target.is_some())
    }

    /// The camera after a share of the turn.
    pub(crate) fn at(&self, camera: &Camera, share: f64) -> Camera {
        turned(camera, self.axis, share * self.degrees)
    }
}

/// The first of these cameras, which look at a model from all the sides of a motion, as far away as each of them takes
/// to have all in view. It looks at the model's middle, or as far above or below that as leaves as much room on both
/// sides, unless the wishes have a target.
pub(crate) fn fitted_at_all_times(
    (model, ball): (&Model, Sphere),
    cameras: &[(Camera, CameraTable)],
    aspect: f64,
) -> Option<Camera> {
    let (mut first, wishes) = *cameras.first()?;
    let views = cameras
        .iter()
        .filter_map(|(camera, wishes)| view((model, ball), camera, lens(camera, wishes, aspect)))
        .collect::<Vec<_>>();
    let arm = normalize(sub(wide(first.eye), wide(first.target)))?;
    first.target = wishes.target.map_or(ball.center.map(narrow), <[f32; 3]>::from);
    Some(placed(first, arm, &views, wide(first.up), wishes.target.is_some()))
}

/// A camera on an arm, as far away as all views take from its target. That may be moved along an axis unless it
/// `is_given`.
fn placed(
    first: Camera,
    arm: [f64; 3],
    views: &[(View, Vec<[f64; 2]>)],
    axis: [f64; 3],
    is_given: bool,
) -> Camera {
    let (Some(arm), Some(axis)) = (normalize(arm), normalize(axis)) else { return first };
    let mut target = wide(first.target);
    if !is_given && !views.is_empty() {
        target = balanced(views, target, axis).map(narrow).map(f64::from);
    }
    let needed = views.iter().map(|(view, _)| view.distance(target)).fold(0.0, f64::max);
    let eye = [0, 1, 2].map(|k| narrow(target[k] + arm[k] * needed));
    Camera { eye, target: target.map(narrow), ..first }
}

/// A camera with planes around what it sees of a model, but for those that are given.
fn between((model, ball): (&Model, Sphere), camera: Camera, wishes: &CameraTable, sight: Sight) -> Camera {
    let (eye, view) = (wide(camera.eye), sub(wide(camera.target), wide(camera.eye)));
    let (near, far) = planes::around(sub(ball.center, eye), view, ball.radius, wishes.is_parallel());
    let (near, far) = (wishes.near.map_or(near, f32::from), wishes.far.map_or(far, f32::from));
    let mut camera = Camera { near, far, ..camera };
    clear(&mut camera, model, wishes, None, sight);
    camera
}

/// The opening of a picture, without its zoom.
fn lens(camera: &Camera, wishes: &CameraTable, aspect: f64) -> Lens {
    let tangent = (f64::from(zoomed(camera.fov, 1.0 / wishes.zoom())).to_radians() / 2.0).tan();
    Lens { tangents: [tangent * aspect, tangent], parallel: wishes.is_parallel() }
}

/// A model as a camera sees it, with its outline.
fn view(of: (&Model, Sphere), camera: &Camera, lens: Lens) -> Option<(View, Vec<[f64; 2]>)> {
    let forward = normalize(sub(wide(camera.target), wide(camera.eye)))?;
    let right = normalize(cross(forward, wide(camera.picture_up())))?;
    let view = View::new(of, [right, cross(right, forward), forward], lens);
    let outline = view.outline(of.0);
    Some((view, outline))
}

/// The camera after a turn of so many degrees around its target, about an axis, or else about its upward direction. The
/// planes stay as far away.
pub(crate) fn turned(camera: &Camera, axis: Option<[f64; 3]>, degrees: f64) -> Camera {
    if degrees == 0.0 {
        return *camera;
    }
    let up = normalize(wide(camera.up)).unwrap_or([0.0, 1.0, 0.0]);
    let given = axis.and_then(normalize);
    let (axis, target) = (given.unwrap_or(up), wide(camera.target));
    let arm = sub(wide(camera.eye), target);
    let (sin, cos) = degrees.to_radians().sin_cos();
    // Rodrigues' formula.
    let rotated = |arm: [f64; 3]| {
        let (across, along) = (cross(axis, arm), dot(axis, arm) * (1.0 - cos));
        [0, 1, 2].map(|k| arm[k] * cos + across[k] * sin + axis[k] * along)
    };
    let moved = rotated(arm);
    let eye = [0, 1, 2].map(|k| narrow(target[k] + moved[k]));
    if given.is_some() {
        return Camera { eye, up: rotated(wide(camera.up)).map(narrow), ..*camera };
    }
    // Seen from above, things turn in the picture.
    let roll = if pose::is_straight(axis, arm) {
        camera.roll + if dot(axis, arm) > 0.0 { -degrees } else { degrees }
    } else {
        camera.roll
    };
    Camera { eye, roll, ..*camera }
}

fn wide(v: [f32; 3]) -> [f64; 3] {
    v.map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Vertex;

    const CAMERA: Camera = Camera {
        eye: [0.0, 1.0, 5.0],
        target: [0.0, 1.0, 0.0],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 40.0,
        near: 1.0,
        far: 9.0,
    };

    fn close(found: [f32; 3], right: [f32; 3]) {
        assert!(found.iter().zip(right).all(|(f, r)| (f - r).abs() < 1e-5), "{found:?} {right:?}");
    }

    #[test]
    fn a_quarter_is_a_quarter() {
        let quarter = turned(&CAMERA, None, 90.0);
        close(quarter.eye, [5.0, 1.0, 0.0]);
        close(quarter.up, [0.0, 1.0, 0.0]);
        let over = turned(&CAMERA, Some([2.0, 0.0, 0.0]), -90.0);
        close(over.eye, [0.0, 6.0, 0.0]);
        close(over.up, [0.0, 0.0, -1.0]);
        close(turned(&CAMERA, Some([0.0, 0.0, 1.0]), 33.0).eye, CAMERA.eye);
        // From above, the picture turns.
        let above = Camera { eye: [0.0, 6.0, 0.0], ..CAMERA };
        assert!((turned(&above, None, 30.0).roll + 30.0).abs() < 1e-9);
    }

    /// A long box, seen along it first: each of its corners is in each picture, and reaches an edge in one.
    #[test]
    fn all_of_the_model_is_in_all_pictures() {
        let corners = [[-3.0, 0.0], [3.0, 0.5]].map(|[x, y]: [f32; 2]| [[x, y, -0.2], [x, y, 0.2]]).concat();
        let vertices = corners.iter().map(|&position| Vertex { position, ..Vertex::default() }).collect();
        let mut model = Model { vertices, ..Model::default() };
        model.parts =
            vec![crate::scene::Part { triangles: vec![[0, 1, 2], [1, 2, 3]], ..Default::default() }];
        let ball = super::super::bounding_sphere(&model);
        for (degrees, frames) in [(360.0, 36), (1440.0, 77), (-90.0, 200)] {
            whole((&model, ball), &corners, &Turn { axis: None, degrees, frames });
        }
    }

    /// Whether all corners are in all pictures of a turn, and nearly fill one of a whole turn.
    fn whole((model, ball): (&Model, Sphere), corners: &[[f32; 3]], turn: &Turn) {
        let along = Camera { eye: [4.0, 1.0, 0.0], target: [0.0; 3], ..CAMERA };
        let sight = Sight { aspect: 1.0, reach: 1e5 };
        let cameras = turn.cameras((model, ball), &along, &CameraTable::default(), (sight, true));
        assert_eq!(cameras.len(), turn.frames as usize);
        let tangent = 20.0_f64.to_radians().tan();
        let (mut most, mut rooms) = (0.0_f64, [0.0_f64; 2]);
        for camera in &cameras {
            let view = normalize(sub(wide(camera.target), wide(camera.eye))).unwrap();
            let right = normalize(cross(view, wide(camera.up))).unwrap();
            let axes = [right, cross(right, view)];
            for corner in corners {
                let from = sub(wide(*corner), wide(camera.eye));
                let depth = dot(from, view);
                assert!(
                    depth > f64::from(camera.near) && depth < f64::from(camera.far),
                    "{depth} {camera:?}"
                );
                let height = dot(from, axes[1]) / depth / tangent;
                rooms = [rooms[0].max(height), rooms[1].max(-height)];
                most =
                    axes.iter().map(|axis| (dot(from, *axis) / depth / tangent).abs()).fold(most, f64::max);
            }
            assert!((camera.near, camera.far) == (cameras[0].near, cameras[0].far));
        }
        assert!((0.85..1.0).contains(&most), "{most} {turn:?}");
        // As much room below as above.
        assert!((rooms[0] - rooms[1]).abs() < 0.03, "{rooms:?} {turn:?}");
    }
}
