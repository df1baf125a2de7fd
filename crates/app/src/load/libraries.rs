//! The material libraries of an OBJ model, and the textures that they name.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use crate::cli::words::nearest;
use crate::error::{Error, Warnings, quote};
use crate::load::images::Images;
use crate::load::input;
use crate::load::mtl::{self, CheckedMtl};
use crate::load::obj::{DEFAULT_DIFFUSE, Named, ObjText};
use crate::load::paths::{Found, existing, file_name};
use crate::load::seen;
use crate::options::Material;
use crate::options::values::Color;
use crate::scene::{MaterialNote, Model, Part, Vertex};

/// The largest material library that is read, in bytes.
const MAX_LIBRARY_BYTES: u64 = 1 << 26;

/// The material of a surface without one.
const HINT: &str = "the default material is used";

/// The libraries of a model and the textures read so far. What is missing or broken becomes a warning.
#[derive(Debug)]
pub(crate) struct Libraries {
    checked: CheckedMtl,
    images: Images,
    /// The materials that parts have been given.
    notes: BTreeMap<usize, MaterialNote>,
}

impl Libraries {
    /// Reads the libraries that the model at `path` names, and looks for the materials that it uses.
    pub(crate) fn read(path: &Path, obj: &ObjText, warnings: &mut Warnings) -> Self {
        let mut libraries =
            Self { checked: CheckedMtl::default(), images: Images::new(), notes: BTreeMap::new() };
        let folder = input::folder(path);
        let mut complete = true;
        for named in &obj.libraries {
            for Found { path: file, renamed } in files_of(folder, named) {
                if renamed {
                    let shown = file.strip_prefix(folder).unwrap_or(&file).display().to_string();
                    let error = Error::new(format!("no file {}", quote(named.name.as_bytes())), mtl::KIND);
                    let error = error.file(path).line(named.line);
                    warnings.push(error.hint(format!("{} is used", quote(shown.as_bytes()))));
                }
                match bytes_of(path, named, &file) {
                    Ok(bytes) => libraries.checked.add(&bytes, &file, warnings),
                    Err(warning) => {
                        warnings.push(warning);
                        complete = false;
                    }
                }
            }
        }
        // Without a library each of its names would be unknown, which says nothing new.
        if complete {
            libraries.look_up(path, obj, warnings);
        }
        libraries
    }

    /// The materials' names and indices.
    pub(crate) fn names(&self) -> &HashMap<String, usize> {
        &self.checked.names
    }

    /// Gives a part of a model of this radius the material with that index. What cannot be used becomes a warning.
    pub(crate) fn apply(&mut self, index: usize, part: &mut Part, radius: f32, warnings: &mut Warnings) {
        let Some(entry) = self.checked.materials.get_mut(index) else { return };
        if let Some(warning) = normals_as_bump(&mut entry.material, &mut self.images) {
            warnings.push(warning);
        }
        let mut warn = |error: Error| {
            warnings.push(error.hint("the surface goes without"));
            Ok(())
        };
        // Errors have become warnings.
        let _ = entry.drawn().apply(part, radius, &mut self.images, &mut warn);
        let _ = entry.complete(part, &mut self.images, &mut warn);
        if let (None, Some(Color(color))) = (part.texture, entry.material.color) {
            // Beside a texture that is not there, it is the colour.
            part.diffuse =
                if entry.has_grey() && entry.material.color_map.is_some() { color } else { part.diffuse };
        }
        part.material.clone_from(&entry.name);
        self.notes.entry(index).or_insert_with(|| entry.note(&self.images));
    }

    /// Gives the model the images read, and its surfaces the rest of what files say of them.
    pub(crate) fn give_images(self, model: &mut Model) {
        model.notes.materials.extend(self.notes.into_values());
        show_colors(model);
        place_textures(model);
        self.images.give(model);
    }

    fn look_up(&self, path: &Path, obj: &ObjText, warnings: &mut Warnings) {
        let expected = if obj.libraries.is_empty() {
            "a material of that name (the file names no `mtllib`)"
        } else {
            "a material of that name in the libraries"
        };
        for used in obj.materials.iter().filter(|m| !self.names().contains_key(&m.name)) {
            warnings.push(
                Error::new(format!("`usemtl` {}", quote(used.name.as_bytes())), expected)
                    .file(path)
                    .line(used.line)
                    .hint(match self.meant(&used.name) {
                        Some(name) => format!("{HINT}; did you mean {}?", quote(name.as_bytes())),
                        None => HINT.to_owned(),
                    }),
            );
        }
    }

    /// The name that is most like one that there is not.
    fn meant(&self, name: &str) -> Option<&str> {
        let names = || self.names().keys().map(String::as_str);
        names().find(|known| known.eq_ignore_ascii_case(name)).or_else(|| nearest(name, names()))
    }
}

/// Has the colours of vertices show where a file has such. They multiply the material's, and the grey of none is white.
fn show_colors(model: &mut Model) {
    let Model { vertices, parts, .. } = model;
    let colored = |&index: &u32| vertices.get(index as usize).is_some_and(|v| v.color != [1.0; 3]);
    for part in parts {
        part.detail.colored = part.triangles.iter().flatten().any(colored);
        if part.detail.colored && part.diffuse == DEFAULT_DIFFUSE {
            part.diffuse = [1.0; 3];
        }
    }
}

/// Scales and moves coordinates as the textures of a part ask for: of vertices that belong to that part alone.
fn place_textures(model: &mut Model) {
    let Model { vertices, parts, .. } = model;
    for part in parts {
        let Some([scale, offset]) = part.detail.placed.take() else { continue };
        let mut own: HashMap<u32, u32> = HashMap::new();
        for index in part.triangles.iter_mut().flatten() {
            *index = *own.entry(*index).or_insert_with(|| {
                let vertex = vertices.get(*index as usize).copied().unwrap_or_default();
                let uv = [0, 1].map(|k| vertex.uv[k] * scale[k] + offset[k]);
                vertices.push(Vertex { uv, ..vertex });
                u32::try_from(vertices.len() - 1).unwrap_or(u32::MAX)
            });
        }
    }
}

/// Warns of triangles that have maps but no texture coordinates, in a model that has these elsewhere.
pub(crate) fn bare(model: &Model) -> Option<Error> {
    let placed = |&index: &u32| model.vertices.get(index as usize).is_some_and(|v| v.uv != [0.0; 2]);
    let bare = |part: &&Part| part.triangles.iter().any(|triangle| !triangle.iter().any(placed));
    let part = model.parts.iter().filter(|part| part.has_maps()).find(bare)?;
    let found = format!("faces of {} without texture coordinates", quote(part.material.as_bytes()));
    Some(Error::new(found, "some for its texture").hint("all of each gets the same texel"))
}

/// Exporters write normal maps into `bump` as well. They are used as normal maps.
fn normals_as_bump(material: &mut Material, images: &mut Images) -> Option<Error> {
    let map = material.height_map.as_ref().filter(|_| material.normal_map.is_none())?;
    // Faults of the file are told when it is used.
    let index = images.texture(map).ok().flatten()?;
    if !images.looks_like_normals(index) {
        return None;
    }
    let origin = map.origin.clone()?;
    material.normal_map = material.height_map.take();
    material.normal_strength = material.height_scale.map(|scale| scale.clamp(0.0, 100.0).into());
    let found = format!("normals in {} as a bump map", quote(origin.text.as_bytes()));
    let warning = Error::new(found, "heights").file(&origin.file).line(origin.line);
    Some(warning.hint("they are used as `norm` has them"))
}

/// The library that `obj` names.
fn bytes_of(obj: &Path, named: &Named, file: &Path) -> Result<Vec<u8>, Error> {
    const HINT: &str = "its materials are the default one";
    seen::see(file);
    if !file.exists() {
        let found = format!("no file \"{}\"", file.display());
        return Err(Error::new(found, mtl::KIND).file(obj).line(named.line).hint(HINT));
    }
    input::read_text(file, mtl::KIND, MAX_LIBRARY_BYTES).map_err(|e| e.hint(HINT))
}

/// A `mtllib` line names one file, with spaces perhaps, or several files.
fn files_of(folder: &Path, named: &Named) -> Vec<Found> {
    let missing = |name: &str| Found { path: folder.join(name), renamed: false };
    let name = file_name(folder, &named.name);
    if let Some(found) = existing(folder, name) {
        return vec![found];
    }
    let words = name.split_whitespace();
    let words: Vec<_> = words.map(|word| existing(folder, word).unwrap_or_else(|| missing(word))).collect();
    let is_library = |found: &Found| found.path.extension().is_some_and(|of| of.eq_ignore_ascii_case("mtl"));
    let several = words.iter().any(|found| found.path.exists()) || words.iter().all(is_library);
    if several { words } else { vec![missing(name)] }
}
