//! A picture in which the shadow around a model is seen, and not cut off by its edge.

use super::{Ground, others, places};
use crate::error::Error;
use crate::scene::normals::narrow;
use crate::scene::{Camera, Model, Part, Vertex};
use std::f64::consts::TAU;

/// The share of a ground's side that what stands on it darkens around it, for an eye to see.
const SHADOW: f64 = 1.0 / 16.0;

/// The directions in which that is beside the outermost place, in a frame.
const AROUND: u32 = 16;

/// Frames a model so that what its ground has of a shadow around it is in the picture, if it has one: not if the camera
/// is below it.
///
/// # Errors
/// Those of `frame`.
pub(crate) fn in_view(
    model: &mut Model,
    up: Option<[f32; 3]>,
    frame: impl Fn(&Model) -> Result<Camera, Error>,
) -> Result<Camera, Error> {
    if up.is_some()
        && let Ok(camera) = frame(model)
        && Ground::under(model, &camera, 0.0).is_none()
    {
        return Ok(camera);
    }
    let kept = (model.vertices.len(), model.parts.len());
    if let Some(ground) = up.and_then(|up| Ground::of(model, up, 0.0)) {
        let axes = others(ground.up.0);
        let first = u32::try_from(model.vertices.len()).unwrap_or(u32::MAX - AROUND);
        for k in 0..AROUND {
            let (sin, cos) = (f64::from(k) / f64::from(AROUND) * TAU).sin_cos();
            let along = |place: &[f64; 3]| place[axes[0]] * cos + place[axes[1]] * sin;
            let farthest = places(model).max_by(|a, b| along(a).total_cmp(&along(b)));
            let Some(mut place) = farthest else { continue };
            place[axes[0]] += cos * ground.side * SHADOW;
            place[axes[1]] += sin * ground.side * SHADOW;
            place[ground.up.0] = ground.low;
            model.vertices.push(Vertex { position: place.map(narrow), ..Vertex::default() });
        }
        let triangles = (2..AROUND).map(|k| [first, first + k - 1, first + k]).collect();
        model.parts.push(Part { triangles, ..Part::default() });
    }
    let framed = frame(model);
    model.vertices.truncate(kept.0);
    model.parts.truncate(kept.1);
    framed
}
