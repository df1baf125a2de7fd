//! OBJ models with their materials and textures.
//!
//! Polygons become triangles (`crate::scene::polygon`). Missing normals are made ([`crate::scene::normals`]): in
//! smoothing groups where the file has some, else by the angle between faces. Missing texture coordinates are (0, 0),
//! missing colours white, missing materials grey. Texture coordinates are kept as they are, v up. Materials are looked
//! for beside the model, textures beside the material library.

use std::path::Path;

use crate::error::{Error, Warnings};
use crate::load::input::{self, Stream};
use crate::load::libraries::{self, Libraries};
use crate::memory;
use crate::options::{DEFAULT_CREASE, Normals};
use crate::scene::Model;
use crate::scene::{camera, normals};

mod block;
mod build;
mod number;
mod read;

use build::{Built, build};
pub(crate) use read::{Named, ObjText};

/// The name of an OBJ model in messages.
pub(crate) const KIND: &str = "a Wavefront OBJ model";

/// The diffuse colour of a part without a material.
pub const DEFAULT_DIFFUSE: [f32; 3] = [0.8; 3];

/// A model, and what had to be repaired.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// At least one triangle.
    pub model: Model,
    /// Broken or missing materials and textures, each replaced by a default.
    pub warnings: Warnings,
    /// Whether any corner has a texture coordinate of its own.
    pub has_uv: bool,
}

/// Loads a model: a file, or [`input::STDIN`]; either may be compressed by gzip. `normals` says how normals are made,
/// whatever the file has; without it they are the file's. `progress` hears (done, total), in bytes.
///
/// # Errors
/// The file cannot be read or has an error, which is named with its line. What else is wrong with materials and
/// textures is a warning.
pub fn load(
    path: &Path,
    normals: Option<Normals>,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Loaded, Error> {
    let mut stream = Stream::open(path, KIND, input::MAX_TEXT_BYTES)?;
    let path = input::shown(path);
    let mut text = ObjText::read(&mut stream, path, progress)?;
    drop(stream);

    let mut warnings = Warnings::default();
    if text.colors_out_of_range > 0 {
        let found = format!("{} vertex colours outside 0 to 1", text.colors_out_of_range);
        warnings.push(Error::new(found, "red, green and blue in 0 to 1").file(path).hint("they are clamped"));
    }
    if let Some(undrawn) = text.undrawn() {
        warnings.push(Error::new(undrawn, "faces").file(path).hint("they are not drawn"));
    }
    if let Some(warning) = text.unknown() {
        warnings.push(warning.file(path));
    }
    for warning in std::mem::take(&mut text.left_out) {
        warnings.push(warning.file(path));
    }
    let mut libraries = Libraries::read(path, &text, &mut warnings);
    let has_uv = text.corners_with_uv > 0;
    let corners: usize = text.faces.iter().map(|faces| faces.corners.len()).sum();
    let some_uv = has_uv && text.corners_with_uv < corners;
    memory::need(text.bytes() + text.bytes_of_model(), "a model").map_err(|error| error.file(path))?;
    let Built { mut model, materials, groups, crossing, has_area } =
        build(text, libraries.names(), normals).map_err(|error| error.file(path))?;
    memory::hold(model.bytes(), "a model").map_err(|error| error.file(path))?;
    if crossing.0 > 0 {
        let (count, line) = crossing;
        let (found, hint) = match count {
            1 => ("a face that crosses itself".to_owned(), "its fill may be wrong"),
            _ => {
                (format!("{count} faces that cross themselves"), "this is the first; their fill may be wrong")
            }
        };
        let warning = Error::new(found, "outlines that do not cross themselves");
        warnings.push(warning.file(path).line(line).hint(hint));
    }
    if !has_area {
        let warning = Error::new("only faces without area", "a surface").file(path);
        warnings.push(warning.hint("there is nothing to see"));
    }
    model.source = Some(path.to_owned());
    let radius = normals::narrow(camera::bounding_sphere(&model).radius);
    for (part, material) in model.parts.iter_mut().zip(materials) {
        if let Some(index) = material {
            libraries.apply(index, part, radius, &mut warnings);
        }
    }
    if let Some(warning) = libraries::bare(&model).filter(|_| some_uv) {
        warnings.push(warning.file(path));
    }
    libraries.give_images(&mut model);
    model.notes.normals = model.vertices.iter().filter(|vertex| vertex.normal != [0.0; 3]).count();
    let crease = if let Some(Normals::Crease(degrees)) = normals { degrees } else { DEFAULT_CREASE };
    normals::complete(&mut model, &groups, crease).map_err(|error| error.file(path))?;
    Ok(Loaded { model, warnings, has_uv })
}

#[cfg(test)]
mod tests;
