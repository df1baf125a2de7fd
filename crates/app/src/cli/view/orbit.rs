//! Cameras that are moved by hand.

use crate::options::Projection;
use crate::scene::Camera;
use crate::scene::camera::turned as around;
use crate::scene::normals::{cross, dot, length, narrow, normalize, sub};

/// The highest elevation, in degrees: from the pole there is no way up or down.
const HIGHEST: f64 = 89.0;

/// The camera after a turn about its target: degrees to the right, and upwards.
pub(super) fn turned(camera: &Camera, [right, upwards]: [f64; 2]) -> Camera {
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

/// The height that a camera sees at its target, of a projection.
fn height(camera: &Camera, projection: Projection) -> f64 {
    match projection {
        Projection::Parallel { height } => f64::from(height),
        Projection::Perspective => {
            let view = sub(camera.target.map(f64::from), camera.eye.map(f64::from));
            2.0 * length(view) * (f64::from(camera.fov).to_radians() / 2.0).tan()
        }
    }
}

/// The camera after a move across its view: heights of the picture, at the target, to the right and upwards.
pub(super) fn panned(camera: &Camera, projection: Projection, [right, upwards]: [f64; 2]) -> Camera {
    let view = sub(camera.target.map(f64::from), camera.eye.map(f64::from));
    let up = normalize(camera.picture_up().map(f64::from)).unwrap_or([0.0, 1.0, 0.0]);
    let Some(across) = normalize(cross(view, up)) else { return *camera };
    let upright = normalize(cross(across, view)).unwrap_or(up);
    let height = height(camera, projection);
    let by = [0, 1, 2].map(|k| height * (across[k] * right + upright[k] * upwards));
    let moved = |point: [f32; 3]| [0, 1, 2].map(|k| narrow(f64::from(point[k]) + by[k]));
    Camera { eye: moved(camera.eye), target: moved(camera.target), ..*camera }
}

/// The distances between which a model of radius 1 is looked at.
const DISTANCES: [f64; 2] = [1e-3, 300.0];

/// Whether a distance from a model is one to look from, after it was made so many times less. One that is too far away
/// may come back.
pub(super) fn is_useful(distance: f64, radius: f64, factor: f64) -> bool {
    let [least, most] = DISTANCES.map(|distance| distance * radius);
    if factor > 1.0 { distance >= least } else { distance <= most }
}

/// The camera so many times as near to its target, before a model of this radius.
pub(super) fn nearer(camera: &Camera, radius: f64, factor: f64) -> Camera {
    let target = camera.target.map(f64::from);
    let arm = sub(camera.eye.map(f64::from), target);
    let eye = [0, 1, 2].map(|k| narrow(target[k] + arm[k] / factor));
    if eye == camera.target
        || !is_useful(length(arm) / factor, radius, factor)
        || eye.iter().any(|x| !x.is_finite())
    {
        return *camera;
    }
    Camera { eye, ..*camera }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERA: Camera = Camera {
        eye: [1.0, 2.0, 6.0],
        target: [1.0, 2.0, 1.0],
        up: [0.0, 2.0, 0.0],
        roll: 0.0,
        fov: 90.0,
        near: 1.0,
        far: 9.0,
    };

    fn close(found: [f32; 3], right: [f32; 3]) {
        assert!(found.iter().zip(right).all(|(f, r)| (f - r).abs() < 1e-5), "{found:?} {right:?}");
    }

    #[test]
    fn a_turn_is_about_the_target() {
        close(turned(&CAMERA, [90.0, 0.0]).eye, [6.0, 2.0, 1.0]);
        close(turned(&CAMERA, [0.0, 30.0]).eye, [1.0, 4.5, 1.0 + 5.0 * 0.75_f32.sqrt()]);
        // There and back, and no farther than the pole.
        let there = turned(&CAMERA, [40.0, 50.0]);
        close(turned(&turned(&there, [0.0, -50.0]), [-40.0, 0.0]).eye, CAMERA.eye);
        let top = turned(&CAMERA, [0.0, 500.0]);
        assert!(top.eye[1] > 6.99 && top.eye[2] > 1.0, "{:?}", top.eye);
        close(turned(&top, [0.0, -HIGHEST]).eye, CAMERA.eye);
        // From straight above it comes down on the side that is below in the picture.
        let above = Camera { eye: [1.0, 7.0, 1.0], ..CAMERA };
        let down = turned(&above, [0.0, -90.0]);
        close(down.eye, CAMERA.eye);
    }

    #[test]
    fn a_pan_is_across_the_view() {
        // With 90 degrees a picture is twice as high as it is far away.
        let moved = panned(&CAMERA, Projection::Perspective, [0.5, -0.25]);
        close(moved.eye, [6.0, -0.5, 6.0]);
        close(moved.target, [6.0, -0.5, 1.0]);
        let moved = panned(&CAMERA, Projection::Parallel { height: 2.0 }, [0.5, -0.25]);
        close(moved.eye, [2.0, 1.5, 6.0]);
    }

    #[test]
    fn a_factor_is_one_of_distance() {
        close(nearer(&CAMERA, 1.0, 2.0).eye, [1.0, 2.0, 3.5]);
        // A model is neither entered to its middle nor lost out of sight, and a lost one comes back.
        let mut camera = CAMERA;
        (0..200).for_each(|_| camera = nearer(&camera, 1.0, 0.8));
        assert!((200.0..=300.0).contains(&(camera.eye[2] - 1.0)), "{camera:?}");
        (0..200).for_each(|_| camera = nearer(&camera, 1.0, 1.25));
        assert!((0.001..0.002).contains(&(camera.eye[2] - 1.0)), "{camera:?}");
        let lost = Camera { eye: [1.0, 2.0, 9e3], ..CAMERA };
        assert!(nearer(&lost, 1.0, 1.25).eye[2] < 8e3);
        // An eye that rounds to the target stays where it is.
        assert_eq!(nearer(&CAMERA, 1e-12, 1e12), CAMERA);
    }
}
