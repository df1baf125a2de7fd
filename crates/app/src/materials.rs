//! The materials of an OBJ model: its libraries, and the textures that they name.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use crate::error::{Error, Warnings, quote};
use crate::mtl_check::{self, CheckedMtl};
use crate::obj_check::{CheckedObj, Named};
use crate::scene::Image;
use crate::{image_file, input};

/// The largest material library that is read, in bytes.
const MAX_LIBRARY_BYTES: u64 = 1 << 26;

/// The libraries of a model and the textures read so far. What is missing or broken becomes a warning, but for the
/// numbers of a `Kd`.
#[derive(Debug)]
pub(crate) struct Materials {
    checked: CheckedMtl,
    libraries: Vec<PathBuf>,
    /// None for a file that has been warned of.
    by_path: HashMap<PathBuf, Option<usize>>,
    textures: Vec<Image>,
    texels_left: u64,
}

impl Materials {
    /// Reads the libraries that the model at `path` names, and looks for the materials that it uses.
    ///
    /// # Errors
    /// A `Kd` whose numbers are missing or are none.
    pub(crate) fn read(path: &Path, obj: &CheckedObj, warnings: &mut Warnings) -> Result<Self, Error> {
        let mut materials = Self {
            checked: CheckedMtl::default(),
            libraries: Vec::new(),
            by_path: HashMap::new(),
            textures: Vec::new(),
            texels_left: image_file::MAX_TEXELS,
        };
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut complete = true;
        for named in &obj.libraries {
            for file in files_of(folder, named) {
                match bytes_of(path, named, &file) {
                    Ok(bytes) => materials.checked.add(&bytes, &file, warnings)?,
                    Err(warning) => {
                        warnings.push(warning);
                        complete = false;
                        continue;
                    }
                }
                materials.libraries.push(file);
            }
        }
        // Without a library each of its names would be unknown, which says nothing new.
        if complete {
            materials.look_up(path, obj, warnings);
        }
        Ok(materials)
    }

    /// The libraries as text for the reader.
    pub(crate) fn texts(&self) -> &[String] {
        &self.checked.texts
    }

    /// The texture that a `map_Kd` of [`Self::texts`] means, as an index into what [`Self::into_textures`] gives.
    pub(crate) fn texture(&mut self, map: &str, warnings: &mut Warnings) -> Option<usize> {
        let map = self.checked.maps.get(map.parse::<usize>().ok()?)?;
        let library = self.libraries.get(map.library)?;
        let folder = library.parent().unwrap_or(Path::new(""));
        let file = existing(folder, &map.name).unwrap_or_else(|| folder.join(&map.name));
        if let Some(&known) = self.by_path.get(&file) {
            return known;
        }
        let index = match image_file::load(&file, self.texels_left) {
            Ok(texture) => {
                self.texels_left = self.texels_left.saturating_sub(texture.texels.len() as u64);
                self.textures.push(texture);
                Some(self.textures.len() - 1)
            }
            Err(error) => {
                let found = format!("a texture {} that cannot be used ({error})", quote(map.name.as_bytes()));
                warnings.push(
                    Error::new(found, "an image beside the library")
                        .file(library)
                        .line(map.line)
                        .hint("the material's colour is used"),
                );
                None
            }
        };
        self.by_path.insert(file, index);
        index
    }

    /// The textures read.
    pub(crate) fn into_textures(self) -> Vec<Image> {
        self.textures
    }

    fn look_up(&self, path: &Path, obj: &CheckedObj, warnings: &mut Warnings) {
        let names: HashSet<&str> = self.checked.names.iter().map(String::as_str).collect();
        let expected = if obj.libraries.is_empty() {
            "a material of that name (the file names no `mtllib`)"
        } else {
            "a material of that name in the libraries"
        };
        for used in obj.materials.iter().filter(|m| !names.contains(m.name.as_str())) {
            warnings.push(
                Error::new(format!("`usemtl` {}", quote(used.name.as_bytes())), expected)
                    .file(path)
                    .line(used.line)
                    .hint("the default material is used"),
            );
        }
    }
}

/// The library that `obj` names.
fn bytes_of(obj: &Path, named: &Named, file: &Path) -> Result<Vec<u8>, Error> {
    const HINT: &str = "the default material is used";
    if !file.exists() {
        let found = format!("no file \"{}\"", file.display());
        return Err(Error::new(found, mtl_check::KIND).file(obj).line(named.line).hint(HINT));
    }
    input::read(file, mtl_check::KIND, MAX_LIBRARY_BYTES).map_err(|e| e.hint(HINT))
}

/// A `mtllib` line names one file, with spaces perhaps, or several files.
fn files_of(folder: &Path, named: &Named) -> Vec<PathBuf> {
    if let Some(file) = existing(folder, &named.name) {
        return vec![file];
    }
    let words: Vec<PathBuf> = named
        .name
        .split_whitespace()
        .map(|word| existing(folder, word).unwrap_or_else(|| folder.join(word)))
        .collect();
    if words.iter().any(|file| file.exists()) { words } else { vec![folder.join(&named.name)] }
}

/// The file of that name in the folder. Files written on Windows may have `\` between folders.
fn existing(folder: &Path, name: &str) -> Option<PathBuf> {
    let as_is = folder.join(name);
    let with_slashes = || folder.join(name.replace('\\', "/"));
    if name.is_empty() {
        None
    } else if as_is.exists() {
        Some(as_is)
    } else {
        Some(with_slashes()).filter(|file| file.exists())
    }
}
