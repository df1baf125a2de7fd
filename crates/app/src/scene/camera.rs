//! The camera: as far as the user says, and for the rest so that the whole model is in view.

use crate::error::{Error, number};
use crate::options::values::Point;
use crate::options::{CameraTable, DEFAULT_FOV, Projection};
use crate::scene::normals::{cross, dot, length, narrow, normalize, sub};
use crate::scene::{Camera, Model};
use alberti::ViewError;

/// A ball around a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// The middle of the bounding box.
    pub center: [f64; 3],
    /// Greater than 0.
    pub radius: f64,
}

/// The ball around the model's bounding box's middle that contains all vertices: at most √3 times as large as
/// the smallest one, and most often much closer. A model without vertices, or all in one point, gets radius 1.
pub fn bounding_sphere(model: &Model) -> Sphere {
    let points = || model.vertices.iter().map(|v| v.position.map(f64::from));
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for point in points() {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    if low[0] > high[0] {
        return Sphere { center: [0.0; 3], radius: 1.0 };
    }
    let center = [0, 1, 2].map(|axis| f64::midpoint(low[axis], high[axis]));
    let radius = points().map(|p| length(sub(p, center))).fold(0.0, f64::max);
    Sphere { center, radius: if radius > 0.0 { radius } else { 1.0 } }
}

/// The camera of these options. Parts that they leave open come from `base`, a scene's own camera. Without it they are
/// chosen so that the ball fills the picture of `aspect` (width to height), seen from the front, the right and above.
/// Near and far enclose the ball as seen from the eye that results, unless eye, target and base leave them as they were
/// made.
///
/// # Errors
/// The first of these that does not hold, with the option that sets it:
///
/// * all is finite;
/// * the opening angle is between 0 and 180 degrees;
/// * the eye is apart from its target;
/// * up is not along the view;
/// * near < far, and 0 < near unless the view is parallel.
pub fn frame(
    wishes: &CameraTable,
    base: Option<&Camera>,
    ball: Sphere,
    aspect: f64,
) -> Result<Camera, Error> {
    let point = |point: Option<Point>| point.map(<[f32; 3]>::from);
    let fov = wishes.fov.map(f32::from).or(base.map(|b| b.fov)).unwrap_or(DEFAULT_FOV);
    check_fov(fov, &CAMERA)?;
    let target = point(wishes.target).or(base.map(|b| b.target)).unwrap_or(ball.center.map(narrow));
    let wide = |v: [f32; 3]| v.map(f64::from);
    let up = point(wishes.up).or(base.map(|b| b.up));
    let eye = match point(wishes.eye).or(base.map(|b| b.eye)) {
        Some(eye) => eye,
        None => {
            let away = three_quarter(wide(up.unwrap_or([0.0, 1.0, 0.0])));
            let distance = distance(ball.radius, f64::from(fov).to_radians(), aspect);
            let from = wide(target);
            [0, 1, 2].map(|axis| narrow(from[axis] + away[axis] * distance))
        }
    };
    let view = sub(wide(target), wide(eye));
    let up = up.unwrap_or_else(|| upwards(view));
    let (near, far) = match base {
        Some(base) if wishes.eye.is_none() && wishes.target.is_none() => (base.near, base.far),
        _ => planes(sub(ball.center, wide(eye)), view, ball.radius),
    };
    let camera = Camera {
        eye,
        target,
        up,
        fov,
        near: wishes.near.map_or(near, f32::from),
        far: wishes.far.map_or(far, f32::from),
    };
    check(&camera, &CAMERA)?;
    check_planes(&camera, wishes.is_parallel(), [near, far])?;
    Ok(camera)
}

/// The camera after so many of `turns` equal parts of a turn around its target, about its upward direction. The planes
/// stay as far away.
pub(crate) fn turned(camera: &Camera, turn: u32, turns: u32) -> Camera {
    let wide = |v: [f32; 3]| v.map(f64::from);
    let (axis, target) = (normalize(wide(camera.up)).unwrap_or([0.0, 1.0, 0.0]), wide(camera.target));
    let arm = sub(wide(camera.eye), target);
    let (sin, cos) = (std::f64::consts::TAU * f64::from(turn) / f64::from(turns.max(1))).sin_cos();
    // Rodrigues' formula.
    let (across, along) = (cross(axis, arm), dot(axis, arm) * (1.0 - cos));
    let eye = [0, 1, 2].map(|k| target[k] + arm[k] * cos + across[k] * sin + axis[k] * along);
    if turn == 0 { *camera } else { Camera { eye: eye.map(narrow), ..*camera } }
}

/// The distance of a model's nearest vertex, along the view.
pub(crate) fn nearest(model: &Model, camera: &Camera) -> f64 {
    let wide = |v: [f32; 3]| v.map(f64::from);
    let forward = normalize(sub(wide(camera.target), wide(camera.eye))).unwrap_or([0.0, 0.0, -1.0]);
    let used = model.parts.iter().flat_map(|part| part.triangles.iter().flatten());
    let distances = used.map(|&index| {
        let position = wide(model.vertices[index as usize].position);
        dot(sub(position, wide(camera.eye)), forward)
    });
    distances.fold(f64::MAX, f64::min)
}

/// The height that a camera with perspective sees at the distance of its target.
pub fn window_height(camera: &Camera) -> f32 {
    let distance = length(sub(camera.target.map(f64::from), camera.eye.map(f64::from)));
    narrow(2.0 * distance * (f64::from(camera.fov).to_radians() / 2.0).tan())
}

/// The place and the opening angle of a projector, upright unless it points straight up or down.
///
/// # Errors
/// As those of [`frame`], with the options that set them.
pub fn projector(eye: [f32; 3], target: [f32; 3], fov: f32) -> Result<Camera, Error> {
    let view = sub(target.map(f64::from), eye.map(f64::from));
    let camera = Camera { eye, target, up: upwards(view), fov, near: 1.0, far: 2.0 };
    check(&camera, &PROJECTOR)?;
    Ok(camera)
}

/// Whether the ball lies wholly behind the camera, or behind a front plane that lies behind the eye, so that nothing of
/// it can be seen.
pub fn is_behind(camera: &Camera, ball: Sphere) -> bool {
    let eye = camera.eye.map(f64::from);
    let view = normalize(sub(camera.target.map(f64::from), eye)).unwrap_or([0.0; 3]);
    dot(sub(ball.center, eye), view) < f64::from(camera.near).min(0.0) - ball.radius
}

/// The options that set a camera's parts.
pub(crate) struct Names {
    eye: &'static str,
    target: &'static str,
    up: &'static str,
    fov: &'static str,
    shape: &'static str,
}

/// The camera's own.
pub(crate) const CAMERA: Names =
    Names { eye: "--eye", target: "--target", up: "--up", fov: "--fov", shape: "--size" };

/// A projector's `up` is chosen so that it cannot be wrong.
pub(crate) const PROJECTOR: Names = Names {
    eye: "--projector-eye",
    target: "--projector-target",
    up: "--projector-target",
    fov: "--projector-fov",
    shape: "--projector",
};

/// The library's refusal of a camera that has passed the checks here: numbers too small or too large for it.
pub(crate) fn refused(why: ViewError, camera: &Camera, projection: Projection, names: &Names) -> Error {
    let Camera { eye, target, near, far, .. } = *camera;
    match (why, projection) {
        (ViewError::NotFinite | ViewError::EyeAtTarget, _) => {
            let found = format!("no direction from {} to {}", show(eye), show(target));
            Error::new(found, "two points whose difference fits a 32-bit float").place(names.eye)
        }
        (ViewError::UpAlongView, _) => up_along_view(camera, names),
        (ViewError::Angle, _) => {
            let found = format!("{} degrees, too small or too large for 32-bit floats", number(camera.fov));
            Error::new(found, "an angle from 1e-30 to 179 degrees").place(names.fov).hint("40 is usual")
        }
        (ViewError::Height, Projection::Parallel { height }) => {
            let found = format!("a height of {}, too small or too large for 32-bit floats", number(height));
            Error::new(found, "a height from 1e-30 to 1e30").place("--view-height")
        }
        (ViewError::NearFar, _) => {
            let found = format!("near {} and far {}", number(near), number(far));
            let expected = "planes farther apart, and neither too near nor too far for 32-bit floats";
            // With the far plane, as far as that is usable.
            let far = far.clamp(-1e30, 1e30);
            let near = if far > 1e-30 { far / 1000.0 } else { 2.0 * far - 1.0 };
            let hint = format!("try --near {} --far {}", number(near), number(far));
            Error::new(found, expected).place("--near").hint(hint)
        }
        _ => Error::new(why.to_string(), "a shape that can be drawn").place(names.shape),
    }
}

fn check(camera: &Camera, names: &Names) -> Result<(), Error> {
    let Camera { eye, target, up, fov, .. } = *camera;
    for (option, point) in [(names.eye, eye), (names.target, target), (names.up, up)] {
        if point.iter().any(|x| !x.is_finite()) {
            let hint = format!("give {} and {} nearer to the model", names.eye, names.target);
            return Err(Error::new(show(point), "finite coordinates").place(option).hint(hint));
        }
    }
    check_fov(fov, names)?;
    let view = sub(target.map(f64::from), eye.map(f64::from));
    if normalize(view).is_none() {
        let found = format!("the eye and its target both at {}", show(eye));
        let hint = format!("move {} or {}", names.eye, names.target);
        return Err(Error::new(found, "two points").place(names.eye).hint(hint));
    }
    if parallel(view, up.map(f64::from)) {
        return Err(up_along_view(camera, names));
    }
    Ok(())
}

fn up_along_view(camera: &Camera, names: &Names) -> Error {
    let found = format!("{}, which is 0 or along the view", show(camera.up));
    Error::new(found, "a direction across the view").place(names.up).hint("choose another axis")
}

/// `usable` are the planes that apply unless others are given.
fn check_planes(camera: &Camera, parallel: bool, usable: [f32; 2]) -> Result<(), Error> {
    let Camera { near, far, .. } = *camera;
    let hint = format!("try --near {} --far {}", number(usable[0]), number(usable[1]));
    if !near.is_finite() || (near <= 0.0 && !parallel) {
        let expected = if parallel { "a finite number" } else { "a finite number above 0" };
        let found = format!("near {}", number(near));
        return Err(Error::new(found, expected).place("--near").hint(hint));
    }
    if !(far > near && far.is_finite()) {
        let found = format!("near {} and far {}", number(near), number(far));
        return Err(Error::new(found, "near < far, both finite").place("--far").hint(hint));
    }
    Ok(())
}

fn check_fov(fov: f32, names: &Names) -> Result<(), Error> {
    if fov > 0.0 && fov < 180.0 {
        return Ok(());
    }
    Err(Error::new(format!("{} degrees", number(fov)), "an angle above 0 and below 180 degrees")
        .place(names.fov)
        .hint("40 is usual"))
}

/// The unit vector from a model to a viewer in front of it, a third to the right and a little above. The front
/// is +z when y is up, and -y when z is up, as modelling programs have it.
fn three_quarter(up: [f64; 3]) -> [f64; 3] {
    let up = normalize(up).unwrap_or([0.0, 1.0, 0.0]);
    let front = normalize(cross([1.0, 0.0, 0.0], up)).unwrap_or([0.0, 0.0, 1.0]);
    let right = cross(up, front);
    let away = [0, 1, 2].map(|axis| front[axis] + 0.6 * right[axis] + 0.45 * up[axis]);
    normalize(away).unwrap_or(front)
}

/// The direction upwards in a picture whose user has not said it: y, unless that is no direction across the view. When
/// looking straight up or down, it is away from a viewer in front of the model.
fn upwards(view: [f64; 3]) -> [f32; 3] {
    if parallel(view, [0.0, 1.0, 0.0]) { [0.0, 0.0, -1.0] } else { [0.0, 1.0, 0.0] }
}

/// The distance from a ball's centre at which it just fits between the sides of the view, with a little room.
fn distance(radius: f64, fov: f64, aspect: f64) -> f64 {
    let vertical = fov / 2.0;
    let horizontal = (vertical.tan() * aspect).atan();
    1.05 * radius / vertical.min(horizontal).sin()
}

/// Near and far planes around a ball, with a little room. From within the ball, near is a thousandth of far: the
/// depth buffer needs a ratio that it can resolve. For a ball behind the viewer, as if it were around him.
fn planes(to_center: [f64; 3], view: [f64; 3], radius: f64) -> (f32, f32) {
    let depth = dot(to_center, normalize(view).unwrap_or([0.0; 3]));
    let far = if depth + radius > 0.0 { depth + 1.01 * radius } else { radius };
    let near = (depth - 1.01 * radius).max(far / 1000.0);
    (narrow(near), narrow(far))
}

/// Whether two directions are so close that their cross product says nothing in f32, or one of them is 0.
fn parallel(a: [f64; 3], b: [f64; 3]) -> bool {
    match (normalize(a), normalize(b)) {
        (Some(a), Some(b)) => length(cross(a, b)) < 2e-5,
        _ => true,
    }
}

fn show([x, y, z]: [f32; 3]) -> String {
    format!("{x},{y},{z}")
}

#[cfg(test)]
mod tests;
