//! The things of a scene that its file has not: a program adds them, or draws without.

use std::borrow::Cow;

use super::report::named;
use super::{Asked, Asset};
use crate::error::counted;
use crate::error::{Error, number};
use crate::options::RenderOptions;
use crate::scene::{Detail, Light, Model, Part};
use alberti::baked::Attributes;
use alberti::raster::color::AnyBlend;

/// The words on what only the report's frames have.
const DRAWN: &str = "the file and the instructions have none, the report's frames have it";

/// A warning for each of them, for motion that the file has as it is at a `moment`, and for attributes that are asked
/// of a model without. Those without a place are about the model.
pub fn missing(model: &Model, options: &RenderOptions, asked: Asked, moment: Option<f64>) -> Vec<Error> {
    let mut all = vec![];
    if let Some(moment) = moment {
        let error = Error::new("a scene in which something moves", "one that stands");
        let at = if moment > 0.0 { format!("{moment} s") } else { "the start".to_owned() };
        all.push(error.hint(format!("the file has it as it is at {at}: a program moves the parts")));
    }
    if let Asked::These(attributes) = asked
        && attributes.contains(Attributes::UV)
        && model.vertices.iter().all(|vertex| vertex.uv == [0.0; 2])
    {
        let error = Error::new("uv of a model without texture coordinates", "one that has some");
        all.push(error.place("--attributes").hint("all are 0"));
    }
    let all_colored = asked.of(model, options) | Attributes::COLOR;
    let no_colors =
        format!("no colours of vertices without `bake --attributes {}`", Asked::names(all_colored));
    for part in model.parts.iter().filter(|part| !part.triangles.is_empty()) {
        let of = named(part);
        let loses_colors =
            part.detail.carries_colors() && !asked.of(model, options).contains(Attributes::COLOR);
        let things = [
            (loses_colors, "that colours of its vertices multiply", "one without", &*no_colors),
            (part.detail.blend != AnyBlend::Replace, "that is blended", "an opaque one", "no blend"),
            (part.detail.alpha_test > 0, "that has holes", "one without", "no alpha test"),
        ];
        for (_, found, expected, hint) in things.into_iter().filter(|thing| thing.0) {
            let error = Error::new(format!("a surface {found}{of}"), expected);
            all.push(error.hint(format!("the file has {hint}, and neither have the report's frames")));
        }
    }
    if options.haze.is_some() {
        let error = Error::new("a fog", "a scene without").place("--fog");
        all.push(error.hint("the file has none, and neither have the report's frames"));
    }
    // Frames of the report are under all of the scene's lights, and under its image.
    let plain = |light: &Light| matches!(light, Light::Directional { .. });
    let first = model.lights.iter().position(plain);
    let lights = model.lights.iter().enumerate().filter(|&(k, _)| Some(k) != first);
    for (k, light) in lights.filter(|_| options.shading.is_lit()) {
        let kind = match light {
            Light::Directional { .. } => "a further directional light",
            Light::Point { .. } => "a point light",
            Light::Spot { .. } => "a spot light",
        };
        let error = Error::new(format!("{kind} (light[{k}])"), "at most one, from one direction");
        all.push(error.hint(DRAWN));
    }
    if model.slide.is_some() {
        let error = Error::new("a projector's image", "a scene without").place("--projector");
        all.push(error.hint(DRAWN));
    }
    // Objects share materials, and may have no names.
    let mut seen = vec![];
    all.retain(|error| {
        let is_new = !seen.contains(error);
        if is_new {
            seen.push(error.clone());
        }
        is_new
    });
    all
}

/// A warning of the parts that an asset has lost, about the model.
pub fn left_out(model: &Model, asset: &Asset) -> Option<Error> {
    let &first = asset.lost_parts.first()?;
    let (unit, of) = (number(asset.unit), named(&model.parts[first]));
    let parts = counted(asset.lost_parts.len(), "part", "parts");
    let found = format!("{parts} without an area in steps of {unit}, from part {first}{of} on");
    Some(Error::new(found, "larger triangles, or a smaller model").hint("the file has none of these"))
}

/// The model without them, as the file with these attributes has it: nothing is seen through its surfaces.
pub(super) fn as_filed(model: &Model, attributes: Attributes) -> Cow<'_, Model> {
    let has_colors = attributes.contains(Attributes::COLOR);
    let loses_colors = |part: &Part| part.detail.carries_colors() && !has_colors;
    if !model.parts.iter().any(|part| part.detail.is_seen_through() || loses_colors(part)) {
        return Cow::Borrowed(model);
    }
    let mut filed = model.clone();
    for part in &mut filed.parts {
        let Detail { blend, alpha_test, .. } = Detail::default();
        (part.detail.blend, part.detail.alpha_test) = (blend, alpha_test);
        part.detail.colored &= has_colors;
    }
    Cow::Owned(filed)
}
