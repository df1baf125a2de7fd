//! The things of a scene that its file has not: a program adds them, or draws without.

use std::borrow::Cow;

use super::report::named;
use crate::error::Error;
use crate::options::RenderOptions;
use crate::scene::{Detail, Light, Model};
use alberti::raster::color::AnyBlend;

/// The words on what only the report's frames have.
const DRAWN: &str = "the file and the instructions have none, the report's frames have it";

/// A warning for each of them.
pub fn missing(model: &Model, options: &RenderOptions) -> Vec<Error> {
    let mut all = vec![];
    let own = |error: Error| match &model.source {
        Some(path) => error.file(path),
        None => error,
    };
    for part in model.parts.iter().filter(|part| !part.triangles.is_empty()) {
        let of = named(part);
        let things = [
            (part.detail.blend != AnyBlend::Replace, "that is blended", "an opaque one", "no blend"),
            (part.detail.alpha_test > 0, "that has holes", "one without", "no alpha test"),
        ];
        for (_, found, expected, hint) in things.into_iter().filter(|thing| thing.0) {
            let error = Error::new(format!("a surface {found}{of}"), expected);
            let error = error.hint(format!("the file has {hint}, and neither have the report's frames"));
            all.push(own(error));
        }
    }
    if options.haze.is_some() {
        let error = Error::new("a fog", "a scene without").place("--fog");
        all.push(error.hint("the file has none, and neither have the report's frames"));
    }
    // Frames of the report are under all of the scene's lights, and under its image.
    let plain = |light: &Light| matches!(light, Light::Directional { .. });
    let first = model.lights.iter().position(plain);
    let lights = model.lights.iter().enumerate().filter(|&(number, _)| Some(number) != first);
    for (number, light) in lights.filter(|_| options.shading.is_lit()) {
        let kind = match light {
            Light::Directional { .. } => "a further directional light",
            Light::Point { .. } => "a point light",
            Light::Spot { .. } => "a spot light",
        };
        let error = Error::new(format!("{kind} (light[{number}])"), "at most one, from one direction");
        all.push(own(error.hint(DRAWN)));
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

/// The model without them, as the file has it: nothing is seen through its surfaces.
pub(super) fn opaque(model: &Model) -> Cow<'_, Model> {
    if !model.parts.iter().any(|part| part.detail.is_seen_through()) {
        return Cow::Borrowed(model);
    }
    let mut opaque = model.clone();
    for part in &mut opaque.parts {
        let Detail { blend, alpha_test, .. } = Detail::default();
        (part.detail.blend, part.detail.alpha_test) = (blend, alpha_test);
    }
    Cow::Owned(opaque)
}
