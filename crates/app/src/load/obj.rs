//! OBJ models with their materials and textures.
//!
//! Polygons become fans of triangles, so concave ones may come out wrong. Missing normals are made
//! ([`crate::scene::normals`]), missing texture coordinates are (0, 0), missing colours white, missing materials grey.
//! Texture coordinates are kept as they are, v up. Materials are looked for beside the model, textures beside the
//! material library.

use std::io::{self, BufReader, Read};
use std::path::Path;

use crate::error::{Error, Warnings};
use crate::load::libraries::Libraries;

use crate::load::input;
use crate::scene::{Model, Part, Vertex};
use crate::scene::{camera, normals};

pub(crate) mod check;

use check::CheckedObj;

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

/// Loads a model. `progress` hears (done, total), in bytes.
///
/// # Errors
/// The file cannot be read or has an error, which is named with its line. What else is wrong with materials and
/// textures is a warning.
pub fn load(path: &Path, progress: &mut dyn FnMut(u64, u64)) -> Result<Loaded, Error> {
    let bytes = input::read(path, check::KIND, input::MAX_TEXT_BYTES)?;
    // Checking takes about as long as reading what was checked.
    let half = bytes.len() as u64;
    let checked = check::check(&bytes, path, &mut |done| progress(done as u64, 2 * half))?;
    drop(bytes);

    let mut warnings = Warnings::default();
    if checked.colors_out_of_range > 0 {
        let found = format!("{} vertex colours outside 0 to 1", checked.colors_out_of_range);
        warnings.push(Error::new(found, "red, green and blue in 0 to 1").file(path).hint("they are clamped"));
    }
    let mut libraries = Libraries::read(path, &checked, &mut warnings)?;
    let objects = read(&checked, &libraries, &mut |done, total| {
        progress(half + done * half / total.max(1), 2 * half);
    })
    .map_err(|e| e.file(path))?;

    let mut model = Model { source: Some(path.to_owned()), ..Model::default() };
    let objects: Vec<_> = objects.iter().filter(|object| !object.mesh.indices.is_empty()).collect();
    for object in &objects {
        add_part(&mut model, object).map_err(|e| e.file(path))?;
    }
    let radius = normals::narrow(camera::bounding_sphere(&model).radius);
    for (part, object) in model.parts.iter_mut().zip(objects) {
        if let Some(index) = object.mesh.material_id {
            libraries.apply(index, part, radius, &mut warnings);
        }
    }
    libraries.give_images(&mut model);
    normals::complete(&mut model);
    Ok(Loaded { model, warnings, has_uv: checked.corners_with_uv > 0 })
}

/// The checked text through `tobj`, which is told the materials' names alone.
fn read(
    checked: &CheckedObj,
    libraries: &Libraries,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Vec<tobj::Model>, Error> {
    let options = tobj::LoadOptions { triangulate: true, single_index: true, ..tobj::LoadOptions::default() };
    let library = "mtllib all\n";
    let total = (checked.head.len() + library.len() + checked.body.len()) as u64;
    let text = checked.head.as_bytes().chain(library.as_bytes()).chain(checked.body.as_bytes());
    let reader = Counting { inner: text, done: 0, report: &mut |done| progress(done, total) };
    let mut reader = BufReader::with_capacity(1 << 20, reader);
    let names = |_: &Path| Ok((Vec::new(), libraries.names().clone()));
    tobj::load_obj_buf(&mut reader, &options, names).map(|(objects, _)| objects).map_err(|error| {
        Error::new(format!("a file that the OBJ reader refuses ({error})"), check::KIND)
            .hint("export the model again")
    })
}

/// Appends the triangles of an object.
fn add_part(model: &mut Model, object: &tobj::Model) -> Result<(), Error> {
    let mesh = &object.mesh;
    // The check gave each vertex all attributes, so these run in step.
    let attributes = triples(&mesh.positions)
        .zip(triples(&mesh.normals))
        .zip(mesh.texcoords.chunks_exact(2).map(|uv| [uv[0], uv[1]]))
        .zip(triples(&mesh.vertex_color));
    let first = u32::try_from(model.vertices.len()).unwrap_or(u32::MAX);
    model.vertices.extend(attributes.map(|(((position, normal), uv), color)| Vertex {
        position,
        normal,
        uv,
        color: color.map(|c| c.clamp(0.0, 1.0)),
        ..Vertex::default()
    }));
    if u32::try_from(model.vertices.len()).is_err() {
        return Err(Error::new("more than 4 billion vertices", "fewer").hint("reduce the model"));
    }
    model.parts.push(Part {
        name: object.name.clone(),
        triangles: mesh.indices.chunks_exact(3).map(|t| [first + t[0], first + t[1], first + t[2]]).collect(),
        diffuse: DEFAULT_DIFFUSE,
        ..Part::default()
    });
    Ok(())
}

fn triples(flat: &[f32]) -> impl Iterator<Item = [f32; 3]> {
    flat.chunks_exact(3).map(|x| [x[0], x[1], x[2]])
}

/// A reader that reports how many bytes it has given.
struct Counting<'a, R> {
    inner: R,
    done: u64,
    report: &'a mut dyn FnMut(u64),
}

impl<R: Read> Read for Counting<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let bytes = self.inner.read(buffer)?;
        self.done += bytes as u64;
        (self.report)(self.done);
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests;
