//! A picture in which the shadow around a model is seen, and not cut off by its edge.

use super::{Ground, others, places};
use crate::error::Error;
use crate::scene::normals::narrow;
use crate::scene::{Camera, Model, Part, Vertex};
use std::f64::consts::TAU;

/// The share of a shadow's reach that is dark enough for an eye to see.
const SHADOW: f64 = 0.2;

/// The share of a model's height up to which its shadow is dark enough.
const LOW: f64 = 0.3;

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
    let Some(ground) = up.and_then(|up| Ground::of(model, up, 0.0)) else { return frame(model) };
    let kept = (model.vertices.len(), model.parts.len());
    let axes = others(ground.up.0);
    let first = u32::try_from(model.vertices.len()).unwrap_or(u32::MAX - AROUND);
    let ways = (0..AROUND).map(|k| (f64::from(k) / f64::from(AROUND) * TAU).sin_cos());
    // The outermost place of each way, and how far out it is.
    let mut farthest: Vec<_> = ways.map(|way| (way, f64::NEG_INFINITY, [0.0; 3])).collect();
    let is_low = |place: &[f64; 3]| {
        let height = ground.up.1 * (place[ground.up.0] - ground.low);
        height <= LOW * ground.height
    };
    for place in places(model).filter(is_low) {
        for ((sin, cos), most, at) in &mut farthest {
            let along = place[axes[0]] * *cos + place[axes[1]] * *sin;
            if along > *most {
                (*most, *at) = (along, place);
            }
        }
    }
    for ((sin, cos), _, mut place) in farthest {
        place[axes[0]] += cos * ground.reach * SHADOW;
        place[axes[1]] += sin * ground.reach * SHADOW;
        place[ground.up.0] = ground.low;
        model.vertices.push(Vertex { position: place.map(narrow), ..Vertex::default() });
    }
    let triangles = (2..AROUND).map(|k| [first, first + k - 1, first + k]).collect();
    model.parts.push(Part { triangles, ..Part::default() });
    let framed = frame(model);
    model.vertices.truncate(kept.0);
    model.parts.truncate(kept.1);
    // From below there is none.
    if framed.as_ref().is_ok_and(|camera| !ground.is_below(camera)) { frame(model) } else { framed }
}
