//! From a model as it was loaded, with the settings of its materials, to one that can be drawn.

use crate::error::{Error, Warnings};
use crate::load::images::Images;
use crate::load::mtl::see_through;
use crate::options::{Material, Wrap};
use crate::scene::camera;
use crate::scene::normals::narrow;
use crate::scene::{Detail, Map, MaterialNote, Model, Relief};
use crate::scene::{displace, tangents};
use alberti::raster::color::AnyBlend;

/// The exponent below which a highlight is so broad that it fades, to none at 0.
const BROAD: f32 = 8.0;

/// Gives this material to all parts of a model.
///
/// # Errors
/// An image cannot be used.
pub(crate) fn replace_materials(
    model: &mut Model,
    material: &Material,
    images: &mut Images,
) -> Result<(), Error> {
    let radius = narrow(camera::bounding_sphere(model).radius);
    model.parts.iter_mut().try_for_each(|part| material.apply(part, radius, images, &mut Err))?;
    let maps = images.notes(material.maps());
    let notes = &mut model.notes.materials;
    if notes.is_empty() && !maps.is_empty() {
        notes.push(MaterialNote::default());
    }
    for note in notes {
        note.maps.retain(|old| maps.iter().all(|new| new.key != old.key));
        note.maps.extend(maps.iter().cloned());
    }
    Ok(())
}

/// A texture or a colour of the command line replaces the colours of vertices as well, and a texture the holes of the
/// materials' by its own.
pub(crate) fn unmix(model: &mut Model, material: &Material, images: &mut Images) {
    for part in &mut model.parts {
        part.detail.colored &= material.color.is_none();
        if material.color_map.is_some() {
            (part.detail.blend, part.detail.alpha_test) = (AnyBlend::Replace, 0);
            part.detail.is_share = false;
            see_through(part, 1.0, images);
        }
    }
}

/// Moves the vertices where a height map says so, and completes what maps need: the lengths of the textures' sides on
/// the surface, and tangents. `wrap` is how heights continue where their map does not say. Broad highlights fade.
pub(crate) fn complete(model: &mut Model, images: &mut Images, wrap: Wrap, warnings: &mut Warnings) {
    for part in &mut model.parts {
        fade(&mut part.detail, images);
        if part.detail.is_seen_through() {
            part.texture = part.texture.map(|texture| images.filled(texture));
        }
        let extent = tangents::extent(&model.vertices, part);
        part.detail.height.iter_mut().for_each(|height| height.extent = extent);
    }
    let displaced = |height: &crate::scene::HeightMap| height.relief == Relief::Displacement;
    if model.parts.iter().any(|part| part.detail.height.as_ref().is_some_and(displaced)) {
        displace::displace(model, images, wrap, warnings);
    }
    tangents::complete(model, |part| part.detail.needs_tangents());
}

/// Has highlights fade where their exponents make them broad: as their greatest does, and where a map has less, more.
fn fade(detail: &mut Detail, images: &mut Images) {
    let faintness = |exponent: f32| (exponent / BROAD).min(1.0);
    let Detail { shininess, shininess_map, specular, specular_map, .. } = detail;
    if *specular == [0.0; 3] {
        return;
    }
    let most = faintness(shininess[1]);
    *specular = specular.map(|c| c * most);
    let Some(gloss) = shininess_map.filter(|_| most > 0.0) else { return };
    let share = |exponent| (faintness(exponent) / most).min(1.0);
    if let Some(image) = images.fainter(specular_map.map(|map| map.image), gloss.image, *shininess, share) {
        *specular_map = Some(Map { image, ..specular_map.unwrap_or(gloss) });
    }
}
