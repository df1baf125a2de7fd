//! The image that a projector throws on the model.

use crate::draw::{aspect, frame};
use crate::error::Error;
use crate::load::image_file;
use crate::options::{DEFAULT_FOV, Projection, ProjectorTable};
use crate::output::stage::{Stage, during};
use crate::scene::camera::{self, PROJECTOR};
use crate::scene::{Image, Model, Slide};
use alberti::glam::Vec3;
use alberti::{Homogeneous, Point3, Projector};
use std::sync::Arc;

/// The projector that was asked for, with its image, in places that are counted from `origin`. An image that is `read`
/// is not read again.
///
/// # Errors
/// The projector or its image cannot be.
pub fn load(
    table: &ProjectorTable,
    read: Option<Arc<Image>>,
    origin: [f64; 3],
) -> Result<Option<Slide>, Error> {
    let ProjectorTable { image: Some(path), eye: Some(eye), target: Some(target), fov } = table else {
        return Ok(None);
    };
    let [eye, target] = [eye, target].map(|point| point.counted_from(origin));
    let fov = fov.map_or(DEFAULT_FOV, f32::from);
    let projector = camera::projector(eye.into(), target.into(), fov, origin)?;
    let image = match read {
        Some(image) => image,
        None => during(Stage::Maps, |_| image_file::load(path, image_file::MAX_TEXELS))?.into(),
    };
    Ok(Some(Slide { image, projector }))
}

/// The library's projector for it.
///
/// # Errors
/// Its numbers are too small or too large.
pub fn projector(slide: &Slide) -> Result<Projector, Error> {
    let aspect = aspect(slide.image.width, slide.image.height);
    frame(&slide.projector)
        .and_then(|place| Projector::new(place, slide.projector.fov.to_radians(), aspect))
        .map_err(|e| camera::refused(e, &slide.projector, Projection::Perspective, &PROJECTOR))
}

/// Whether the image falls nowhere on the model for certain: all of it lies behind the projector, or beyond the same
/// side of the projector's pyramid.
pub fn misses(projector: &Projector, model: &Model) -> bool {
    let beyond = model.vertices.iter().fold([true; 5], |beyond, vertex| {
        let Homogeneous { u, v, q } = projector.project(Point3::new(Vec3::from_array(vertex.position)));
        let [behind, left, right, below, above] = beyond;
        [behind && q <= 0.0, left && u <= -q, right && u >= q, below && v <= -q, above && v >= q]
    });
    beyond.contains(&true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Image, Vertex};

    /// Whether the segment from (-1, 0, 0) to (1, 0, 0) is missed from there.
    fn missed(eye: [f32; 3], target: [f32; 3]) -> bool {
        let vertex = |x| Vertex { position: [x, 0.0, 0.0], ..Vertex::default() };
        let model = Model { vertices: vec![vertex(-1.0), vertex(1.0)], ..Model::default() };
        let image = Image { width: 2, height: 1, texels: vec![[0; 4]; 2] };
        // At a distance of 1, it is 2 units high and 4 wide.
        let projector = camera::projector(eye, target, 90.0, [0.0; 3]).expect("a projector");
        misses(&projector_of(Slide { image: image.into(), projector }), &model)
    }

    fn projector_of(slide: Slide) -> Projector {
        projector(&slide).expect("a projector")
    }

    #[test]
    fn models_behind_or_beside_a_projector_are_missed() {
        assert!(!missed([0.0, 0.0, 1.0], [0.0; 3]));
        assert!(missed([0.0, 0.0, 1.0], [0.0, 0.0, 2.0]));
        for (beside, on) in [([3.1, 0.0], [2.9, 0.0]), ([0.0, 1.1], [0.0, 0.9])] {
            for sign in [-1.0, 1.0] {
                let from = |[x, y]: [f32; 2]| missed([sign * x, sign * y, 1.0], [sign * x, sign * y, 0.0]);
                assert!(from(beside) && !from(on), "{sign} {beside:?}");
            }
        }
        // One end before it, the other behind.
        assert!(!missed([0.0, 0.0, 0.1], [1.0, 0.0, 0.1]));
    }
}
