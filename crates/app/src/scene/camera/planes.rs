//! The planes between which a camera sees: as close around the model as depths need it.

use super::{Pyramid, Sight};
use crate::options::CameraTable;
use crate::scene::normals::{dot, narrow, normalize};
use crate::scene::{Camera, Model};

/// The ratio of far to near of a camera within a model's ball, before it is known what it sees.
const RATIO: f64 = 1000.0;

/// Near and far planes around a ball, with a little room. From within the ball, near is a thousandth of far: the
/// depth buffer needs a ratio that it can resolve. For a ball behind the viewer, as if it were around him. Planes of
/// parallel lines are around the ball wherever it is.
pub(super) fn around(to_center: [f64; 3], view: [f64; 3], radius: f64, is_parallel: bool) -> (f32, f32) {
    let depth = dot(to_center, normalize(view).unwrap_or([0.0; 3]));
    let far = if depth + radius > 0.0 { depth + 1.01 * radius } else { radius };
    let near = depth - 1.01 * radius;
    let near = if is_parallel { near } else { near.max(far / RATIO) };
    (narrow(near), narrow(far))
}

/// Whether a camera with these wishes has the planes of the one that it is based on.
pub(super) fn are_kept(wishes: &CameraTable) -> bool {
    wishes.eye.is_none() && wishes.target.is_none() && !wishes.turns()
}

/// Moves the front plane of a camera within a model's ball to just before what is nearest in its picture, as far as
/// depths resolve it. Planes stay that are given, are those of a camera that it is based on, or of parallel lines.
/// If faces are before it even so, the depth of the nearest is returned.
pub(crate) fn clear(
    camera: &mut Camera,
    model: &Model,
    wishes: &CameraTable,
    base: Option<&Camera>,
    sight: Sight,
) -> Option<f64> {
    let (near, far) = (f64::from(camera.near), f64::from(camera.far));
    let is_given = wishes.near.is_some() || (base.is_some() && are_kept(wishes));
    if is_given || wishes.is_parallel() || near > 1.001 * far / RATIO {
        return None;
    }
    let nearest = Pyramid::new(camera, Some(sight.aspect))?.nearest(model).filter(|depth| *depth < far)?;
    let least = far / sight.reach;
    camera.near = narrow((0.99 * nearest).max(least));
    (nearest < least).then_some(nearest)
}
