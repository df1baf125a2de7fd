//! The camera: as far as the user says, and for the rest so that the whole model is in view.

use crate::error::{Error, number};
use crate::options::values::Point;
use crate::options::{CameraTable, DEFAULT_FOV, Projection};
use crate::scene::normals::{cross, dot, length, narrow, normalize, sub};
use crate::scene::{Camera, Model};
use alberti::ViewError;
use fit::{Lens, fit};

pub(crate) use planes::clear;
pub(crate) use pyramid::{Pyramid, Sight, within};
pub(crate) use turns::{Turn, fitted_at_all_times, turned};

mod fit;
mod planes;
mod pose;
mod pyramid;
mod turns;

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

/// The camera of these options. Parts that they leave open come from `base`, a scene's own camera. Without it the
/// silhouette of the model fills the picture of `aspect` (width to height). It is seen from the front, the right and
/// above, or from where the options say. Near and far enclose the ball as seen from the eye that results,
/// unless eye, target and base leave them as they were made. `clear` moves near for an eye within the ball.
///
/// # Errors
/// The first of these that does not hold, with the option that sets it:
///
/// * all is finite, and the model neither too small nor too large to look at;
/// * the opening angle is between 0 and 180 degrees;
/// * the eye is apart from its target;
/// * up is a direction;
/// * near < far, and 0 < near unless the view is parallel.
pub fn frame(
    wishes: &CameraTable,
    base: Option<&Camera>,
    (model, ball): (&Model, Sphere),
    aspect: f64,
) -> Result<Camera, Error> {
    let point = |point: Option<Point>| point.map(<[f32; 3]>::from);
    let wide = |v: [f32; 3]| v.map(f64::from);
    let usual = if wishes.eye.is_some() { DEFAULT_FOV } else { usual_fov(aspect) };
    let fov = wishes.fov.map(f32::from).or(base.map(|b| b.fov)).unwrap_or(usual);
    check_fov(fov, &CAMERA)?;
    let given = point(wishes.target).or(base.map(|b| b.target));
    let up = point(wishes.up).or(base.map(|b| b.up)).unwrap_or([0.0, 1.0, 0.0]);
    let mut roll = wishes.roll.map(|roll| <[f64; 1]>::from(roll)[0]).or(base.map(|b| b.roll)).unwrap_or(0.0);
    let own = point(wishes.eye).or(base.filter(|_| !wishes.turns()).map(|b| b.eye));
    let angles = pose::angles(wishes, base, wide(up));
    let away = pose::away(angles, wide(up));
    let turn =
        |view| if pose::is_straight(wide(up), view) { pose::turn(angles, wide(up), view) } else { 0.0 };
    let (eye, target) = match (own, base) {
        (Some(eye), _) => (eye, given.unwrap_or(ball.center.map(narrow))),
        (None, Some(base)) => {
            // Around the target of the scene, as far from it.
            let distance = length(sub(wide(base.target), wide(base.eye)));
            let target = given.unwrap_or(base.target);
            ([0, 1, 2].map(|k| narrow(f64::from(target[k]) + away[k] * distance)), target)
        }
        (None, None) => {
            check_radius(model, ball)?;
            let view = away.map(|x| -x);
            let upwards = pose::upwards(wide(up), view, roll + turn(view));
            let right = normalize(cross(view, upwards)).unwrap_or([1.0, 0.0, 0.0]);
            let tangent = (f64::from(fov).to_radians() / 2.0).tan();
            let lens = Lens { tangents: [tangent * aspect, tangent], parallel: wishes.is_parallel() };
            let axes = [right, cross(right, view), view];
            let (eye, target) = fit((model, ball), axes, lens, given.map(wide));
            (eye.map(narrow), given.unwrap_or(target.map(narrow)))
        }
    };
    let view = sub(wide(target), wide(eye));
    if own.is_none() {
        roll += turn(view);
    }
    let fov = zoomed(fov, wishes.zoom());
    planed(Camera { eye, target, up, roll, fov, near: 0.0, far: 0.0 }, wishes, base, (model, ball))
}

/// A camera with planes around the ball of a model, but for those that are given, or that the camera has of one that it
/// is based on.
///
/// # Errors
/// Those of [`frame`].
pub(crate) fn planed(
    camera: Camera,
    wishes: &CameraTable,
    base: Option<&Camera>,
    (model, ball): (&Model, Sphere),
) -> Result<Camera, Error> {
    let wide = |v: [f32; 3]| v.map(f64::from);
    let (eye, target) = (wide(camera.eye), wide(camera.target));
    let (near, far) = match base {
        Some(base) if planes::are_kept(wishes) => (base.near, base.far),
        _ => planes::around(sub(ball.center, eye), sub(target, eye), ball.radius, wishes.is_parallel()),
    };
    let camera = Camera {
        near: wishes.near.map_or(near, f32::from),
        far: wishes.far.map_or(far, f32::from),
        ..camera
    };
    let names = Names { origin: model.origin, ..CAMERA };
    let checked = check(&camera, &names).and_then(|()| match base {
        // The planes are those around the ball.
        None if wishes.near.is_none() && wishes.far.is_none() => check_distance(&camera, &names),
        _ => check_planes(&camera, wishes, [near, far]),
    });
    // Of a model that no camera can look at, places are wrong by themselves.
    checked.map_err(|error| check_radius(model, ball).err().unwrap_or(error))?;
    Ok(camera)
}

/// The opening angle of pictures for which none is given: as wide at most as those of 16:9, since what is far aside is
/// stretched.
fn usual_fov(aspect: f64) -> f32 {
    let tangent = (f64::from(DEFAULT_FOV).to_radians() / 2.0).tan();
    let widest = tangent * 16.0 / 9.0;
    if tangent * aspect <= widest {
        return DEFAULT_FOV;
    }
    narrow(2.0 * (widest / aspect).atan().to_degrees())
}

/// The angle that shows things so many times as large in the middle of the picture.
fn zoomed(fov: f32, zoom: f32) -> f32 {
    if zoom == 1.0 {
        return fov;
    }
    let tangent = (f64::from(fov).to_radians() / 2.0).tan() / f64::from(zoom);
    narrow(2.0 * tangent.atan().to_degrees())
}

/// A camera of such a zoom so far aside that `middle` is where it is in the picture without it, if that makes things
/// larger. The middle of the picture may be beside the model. Smaller ones are all in view as it is.
pub(crate) fn zoomed_about(camera: &Camera, middle: [f64; 3], zoom: f32) -> Camera {
    beside(camera, middle, 1.0 - 1.0 / f64::from(zoom).max(1.0))
}

/// The camera before a zoom about `middle`.
pub(crate) fn unzoomed(camera: &Camera, middle: [f64; 3], zoom: f32) -> Camera {
    let camera = beside(camera, middle, 1.0 - f64::from(zoom).max(1.0));
    Camera { fov: zoomed(camera.fov, 1.0 / zoom), ..camera }
}

/// A camera that has gone aside by a share of the way to where a point is in the middle of its picture.
fn beside(camera: &Camera, point: [f64; 3], share: f64) -> Camera {
    let wide = |v: [f32; 3]| v.map(f64::from);
    let (eye, target) = (wide(camera.eye), wide(camera.target));
    let Some(forward) = normalize(sub(target, eye)).filter(|_| share != 0.0) else { return *camera };
    let to = sub(point, target);
    let depth = dot(to, forward);
    let by = [0, 1, 2].map(|k| share * (to[k] - depth * forward[k]));
    let [eye, target] = [eye, target].map(|place| [0, 1, 2].map(|k| narrow(place[k] + by[k])));
    Camera { eye, target, ..*camera }
}

/// The options that make this camera again, bit for bit, for a model whose coordinates are counted from `origin`, and
/// with a scene file that has `wishes` of its own. Without its planes, they are those that such a camera gets.
#[must_use]
pub fn as_options(
    camera: &Camera,
    origin: [f64; 3],
    projection: Projection,
    wishes: &CameraTable,
    has_planes: bool,
) -> String {
    let point = |point: [f32; 3]| point.map(number).join(",");
    let place = |point| place(point, origin);
    let Camera { eye, target, up, roll, fov, near, far } = *camera;
    let upright = roll == 0.0 && wishes.roll.is_none();
    let leaning = if upright { String::new() } else { format!(" --roll {roll}") };
    let [eye, target, up, fov] = [place(eye), place(target), point(up), number(fov)];
    let mut options = format!("--eye {eye} --target {target} --up {up}{leaning} --fov {fov}");
    if has_planes {
        options += &format!(" --near {} --far {}", number(near), number(far));
    }
    if wishes.zoom.is_some() {
        // It is in the angle.
        options += " --zoom 1";
    }
    match projection {
        Projection::Parallel { height } => {
            options += &format!(" --projection parallel --view-height {}", number(height));
        }
        Projection::Perspective if wishes.projection.is_some() => options += " --projection perspective",
        Projection::Perspective => {}
    }
    options
}

/// # Errors
/// Coordinates in which no camera can be placed.
fn check_radius(model: &Model, ball: Sphere) -> Result<(), Error> {
    if (1e-15..=1e15).contains(&ball.radius) {
        return Ok(());
    }
    let found = format!("a model of radius {:.2e}", ball.radius);
    let error = Error::new(found, "one from 1e-15 to 1e15").hint("scale its coordinates");
    Err(match &model.source {
        Some(path) => error.file(path),
        None => error,
    })
}

/// The camera around whose target another is turned, at its distance: with these places, and usual otherwise.
pub(crate) fn orbit(places: &CameraTable, ball: Sphere) -> Camera {
    let point = |point: Option<Point>| point.map(<[f32; 3]>::from);
    let target = point(places.target).unwrap_or(ball.center.map(narrow));
    let eye = point(places.eye).unwrap_or(target);
    Camera { eye, target, up: [0.0, 1.0, 0.0], roll: 0.0, fov: DEFAULT_FOV, near: 1.0, far: 2.0 }
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

/// The place and the opening angle of a projector, upright. Its places are counted
/// from `origin`.
///
/// # Errors
/// As those of [`frame`], with the options that set them.
pub fn projector(eye: [f32; 3], target: [f32; 3], fov: f32, origin: [f64; 3]) -> Result<Camera, Error> {
    let camera = Camera { eye, target, up: [0.0, 1.0, 0.0], roll: 0.0, fov, near: 1.0, far: 2.0 };
    check(&camera, &Names { origin, ..PROJECTOR })?;
    Ok(camera)
}

/// Whether the ball lies wholly behind the camera, or behind a front plane that lies behind the eye, so that nothing of
/// it can be seen.
pub fn is_behind(camera: &Camera, ball: Sphere) -> bool {
    let eye = camera.eye.map(f64::from);
    let view = normalize(sub(camera.target.map(f64::from), eye)).unwrap_or([0.0; 3]);
    dot(sub(ball.center, eye), view) < f64::from(camera.near).min(0.0) - ball.radius
}

/// The least opening angle, in degrees: of a smaller one, places from which all is in view are too far away.
const LEAST_FOV: f32 = 0.001;

/// The options that set a camera's parts.
pub(crate) struct Names {
    eye: &'static str,
    target: &'static str,
    up: &'static str,
    fov: &'static str,
    shape: &'static str,
    /// The point from which the camera's places are counted; messages have the file's.
    origin: [f64; 3],
}

impl Names {
    fn show(&self, point: [f32; 3]) -> String {
        place(point, self.origin)
    }
}

/// The camera's own.
pub(crate) const CAMERA: Names =
    Names { eye: "--eye", target: "--target", up: "--up", fov: "--fov", shape: "--size", origin: [0.0; 3] };

/// A projector's `up` is chosen so that it cannot be wrong.
pub(crate) const PROJECTOR: Names = Names {
    eye: "--projector-eye",
    target: "--projector-target",
    up: "--projector-target",
    fov: "--projector-fov",
    shape: "--projector",
    origin: [0.0; 3],
};

/// The library's refusal of a camera that has passed the checks here: numbers too small or too large for it.
pub(crate) fn refused(why: ViewError, camera: &Camera, projection: Projection, names: &Names) -> Error {
    let Camera { near, far, .. } = *camera;
    match (why, projection) {
        (ViewError::NotFinite | ViewError::EyeAtTarget, _) => {
            let found = "an eye and a target between which 32-bit floats have no direction";
            Error::new(found, "two points whose difference fits a 32-bit float").place(names.eye)
        }
        (ViewError::UpAlongView, _) => no_up(camera, names),
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

/// The planes around a ball are apart, unless it is a point in 32 bits from there.
fn check_distance(camera: &Camera, names: &Names) -> Result<(), Error> {
    if camera.far > camera.near && camera.far.is_finite() && camera.near.is_finite() {
        return Ok(());
    }
    let found =
        format!("an eye at {}, from where the model is a point in 32-bit floats", names.show(camera.eye));
    Err(Error::new(found, "one nearer to the model").place(names.eye))
}

fn check(camera: &Camera, names: &Names) -> Result<(), Error> {
    let Camera { eye, target, up, fov, .. } = *camera;
    for (option, point) in [(names.eye, eye), (names.target, target), (names.up, up)] {
        if point.iter().any(|x| !x.is_finite()) {
            let hint = format!("give {} and {} nearer to the model", names.eye, names.target);
            return Err(Error::new(names.show(point), "finite coordinates").place(option).hint(hint));
        }
    }
    check_fov(fov, names)?;
    let view = sub(target.map(f64::from), eye.map(f64::from));
    if normalize(view).is_none() {
        let [at, towards] = [eye, target].map(|point| names.show(point));
        let found = if at == towards {
            format!("the eye and its target both at {at}")
        } else {
            format!("the eye at {at} and its target at {towards}, too near for 32-bit floats")
        };
        let hint = format!("move {} or {}", names.eye, names.target);
        return Err(Error::new(found, "two points").place(names.eye).hint(hint));
    }
    if normalize(up.map(f64::from)).is_none() {
        return Err(no_up(camera, names));
    }
    Ok(())
}

fn no_up(camera: &Camera, names: &Names) -> Error {
    let found = format!("{}, which is no direction in 32-bit floats", camera.up.map(number).join(","));
    Error::new(found, "a direction").place(names.up).hint("0,1,0 is usual")
}

/// `usable` are the planes that apply unless others are given.
fn check_planes(camera: &Camera, wishes: &CameraTable, usable: [f32; 2]) -> Result<(), Error> {
    let (Camera { near, far, .. }, parallel) = (*camera, wishes.is_parallel());
    let hint = format!("try --near {} --far {}", number(usable[0]), number(usable[1]));
    if !near.is_finite() || (near <= 0.0 && !parallel) {
        let expected = if parallel { "a finite number" } else { "a finite number above 0" };
        let found = format!("near {}", number(near));
        return Err(Error::new(found, expected).place("--near").hint(hint));
    }
    if !(far > near && far.is_finite()) {
        let found = format!("near {} and far {}", number(near), number(far));
        let given = if wishes.far.is_none() && wishes.near.is_some() { "--near" } else { "--far" };
        return Err(Error::new(found, "near < far, both finite").place(given).hint(hint));
    }
    Ok(())
}

/// # Errors
/// An angle that no camera has.
pub(crate) fn check_fov(fov: f32, names: &Names) -> Result<(), Error> {
    if (LEAST_FOV..180.0).contains(&fov) {
        return Ok(());
    }
    if fov > 0.0 && fov < LEAST_FOV {
        let found = format!("{} degrees", number(fov));
        let expected = format!("an angle of at least {LEAST_FOV} degrees");
        return Err(Error::new(found, expected).place(names.fov).hint("40 is usual"));
    }
    Err(Error::new(format!("{} degrees", number(fov)), "an angle above 0 and below 180 degrees")
        .place(names.fov)
        .hint("40 is usual"))
}

/// A place as its author has it, whose coordinates are counted from `origin`.
fn place(point: [f32; 3], origin: [f64; 3]) -> String {
    let coordinate = |axis: usize| match origin[axis] {
        0.0 => number(point[axis]),
        origin => (f64::from(point[axis]) + origin).to_string(),
    };
    [0, 1, 2].map(coordinate).join(",")
}

#[cfg(test)]
mod tests;
