//! The planes of a camera, moved for a ground.

use super::Ground;
use crate::scene::camera::{Pyramid, Sight};
use crate::scene::normals::narrow;
use crate::scene::{Camera, Image};
use std::sync::Arc;

/// A ground that a model has been given, for the cameras that look at it.
#[derive(Debug)]
pub(crate) struct Stood {
    /// The lower one, if there are two.
    pub(super) lowest: Ground,
    /// The images of the shadows.
    pub(crate) shadows: Vec<Arc<Image>>,
    /// The corners of those that go on all around.
    pub(super) around: Vec<[[f64; 3]; 4]>,
    /// Those of [`Manner`](super::Manner).
    pub(super) sight: Option<Sight>,
    pub(super) fixed: [bool; 2],
}

impl Stood {
    /// Whether a camera sees it from above.
    pub(crate) fn is_below(&self, camera: &Camera) -> bool {
        self.lowest.is_below(camera)
    }

    /// Moves the planes of a camera above it so that all that is in the picture is between them.
    pub(crate) fn stretch(&self, camera: &mut Camera) {
        if self.is_below(camera) {
            self.around.iter().for_each(|corners| stretch(camera, corners, self.sight, self.fixed));
        }
    }
}

/// Moves the planes of a camera so that all is between them that is seen of the ground with these corners.
///
/// In perspective, ground beside the picture does not count. It may be next to the eye, and depths behind a plane so
/// near would have few bits.
fn stretch(camera: &mut Camera, corners: &[[f64; 3]; 4], sight: Option<Sight>, fixed: [bool; 2]) {
    let pyramid = Pyramid::new(camera, sight.map(|sight| sight.aspect));
    let Some([nearest, farthest]) = pyramid.and_then(|pyramid| pyramid.depths(corners)) else { return };
    if !fixed[1] {
        camera.far = camera.far.max(narrow(farthest + 0.01 * farthest.abs()));
    }
    if !fixed[0] {
        let mut near = narrow(nearest - 0.01 * nearest.abs());
        if let Some(Sight { reach, .. }) = sight {
            // It may reach up to the eye.
            near = near.max(camera.far / narrow(reach));
        }
        camera.near = camera.near.min(near);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two units over a ground that reaches from behind the eye to the horizon.
    const CAMERA: Camera = Camera {
        eye: [0.0, 2.0, 0.0],
        target: [0.0, 1.0, -1.0],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 60.0,
        near: 1000.0,
        far: 1.0,
    };
    const CORNERS: [[f64; 3]; 4] =
        [[-50.0, 0.0, 50.0], [50.0, 0.0, 50.0], [50.0, 0.0, -50.0], [-50.0, 0.0, -50.0]];

    #[expect(clippy::unnecessary_wraps, reason = "parallel lines have none")]
    fn seen(aspect: f64) -> Option<Sight> {
        Some(Sight { aspect, reach: 1e5 })
    }

    /// The camera looks down at 45 degrees, so the lowest ray of its picture is at 75 degrees and the highest at 15.
    /// Rays through the middle of the lower edge meet the ground 2/sin 75° away, of which the depth has cos 30°.
    #[test]
    fn depths_are_those_within_the_picture() {
        for roll in [0.0, 180.0] {
            let mut camera = Camera { roll, ..CAMERA };
            stretch(&mut camera, &CORNERS, seen(1.5), [false; 2]);
            let depth = |degrees: f64| 2.0 / degrees.to_radians().sin() * 30f64.to_radians().cos();
            let near = f64::from(camera.near) / depth(75.0);
            assert!((0.97..0.995).contains(&near), "{near}");
            let far = f64::from(camera.far) / depth(15.0);
            assert!((1.005..1.2).contains(&far), "{far}");
        }
        // On its side it is as high as it was wide.
        let mut camera = Camera { roll: 90.0, ..CAMERA };
        stretch(&mut camera, &CORNERS, seen(1.5), [false; 2]);
        assert!(f64::from(camera.near) < 1.7 && camera.near > 1.0, "{camera:?}");
    }

    #[test]
    fn parallel_lines_see_all() {
        let mut camera = CAMERA;
        stretch(&mut camera, &CORNERS, None, [false; 2]);
        // The depth of (x, 0, z) is (2 - z)/sqrt 2.
        let half = 0.5_f64.sqrt();
        assert!((f64::from(camera.near) + 1.01 * 48.0 * half).abs() < 1e-3, "{camera:?}");
        assert!((f64::from(camera.far) - 1.01 * 52.0 * half).abs() < 1e-3, "{camera:?}");
    }

    #[test]
    fn what_is_not_seen_or_fixed_moves_nothing() {
        let away = Camera { target: [0.0, 3.0, -1.0], near: 5.0, far: 6.0, ..CAMERA };
        let mut camera = away;
        stretch(&mut camera, &CORNERS, seen(1.0), [false; 2]);
        assert_eq!(camera, away);
        let fixed = Camera { near: 5.0, far: 6.0, ..CAMERA };
        camera = fixed;
        stretch(&mut camera, &CORNERS, seen(1.0), [true; 2]);
        assert_eq!(camera, fixed);
    }
}
