//! The images of a model, each file read once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::error::{Error, quote};
use crate::load::image_file;
use crate::options::MapFile;
use crate::output::clock::{Work, timed};
use crate::scene::{HeightImage, Image, Model};

/// Images read so far.
#[derive(Debug)]
pub(crate) struct Images {
    textures: Read<Image>,
    heights: Read<HeightImage>,
    texels_left: u64,
}

/// Images of a kind, and their indices by file. `None` is a file of which an error has been told.
#[derive(Debug)]
struct Read<T> {
    all: Vec<T>,
    at: HashMap<PathBuf, Option<usize>>,
}

impl<T> Read<T> {
    fn new() -> Self {
        Self { all: Vec::new(), at: HashMap::new() }
    }

    /// The index of an image, which `load` reads if it has not been read.
    fn index(
        &mut self,
        map: &MapFile,
        load: impl FnOnce(&Path) -> Result<T, Error>,
    ) -> Result<Option<usize>, Error> {
        if let Some(&known) = self.at.get(&map.path) {
            return Ok(known);
        }
        let index = load(&map.path).map(|image| {
            self.all.push(image);
            self.all.len() - 1
        });
        self.at.insert(map.path.clone(), index.as_ref().ok().copied());
        index.map(Some).map_err(|error| unusable(map, error))
    }
}

impl Images {
    /// None yet.
    pub(crate) fn new() -> Self {
        Self { textures: Read::new(), heights: Read::new(), texels_left: image_file::MAX_TEXELS }
    }

    /// The index of a texture; `None` where an error has been told before.
    ///
    /// # Errors
    /// The file cannot be read, or is no image.
    pub(crate) fn texture(&mut self, map: &MapFile) -> Result<Option<usize>, Error> {
        let left = &mut self.texels_left;
        self.textures.index(map, |path| {
            let image = timed(Work::Maps, || image_file::load(path, *left))?;
            *left = left.saturating_sub(image.texels.len() as u64);
            Ok(image)
        })
    }

    /// The index of a height image; `None` where an error has been told before.
    ///
    /// # Errors
    /// The file cannot be read, or is no image.
    pub(crate) fn heights(&mut self, map: &MapFile) -> Result<Option<usize>, Error> {
        let left = &mut self.texels_left;
        self.heights.index(map, |path| {
            let image = timed(Work::Maps, || image_file::load_heights(path, *left))?;
            *left = left.saturating_sub(image.heights.len() as u64);
            Ok(image)
        })
    }

    /// A texture's width and height.
    pub(crate) fn size(&self, index: usize) -> Option<[u32; 2]> {
        self.textures.all.get(index).map(|image| [image.width, image.height])
    }

    /// Heights that have been read.
    pub(crate) fn height_image(&self, index: usize) -> Option<&HeightImage> {
        self.heights.all.get(index)
    }

    /// Whether a texture is blue all over, as normals in tangent space are and heights are not.
    pub(crate) fn looks_like_normals(&self, index: usize) -> bool {
        let Some(image) = self.textures.all.get(index) else { return false };
        let sums = image.texels.iter().fold([0_u64; 3], |[r, g, b], &[x, y, z, _]| {
            [r + u64::from(x), g + u64::from(y), b + u64::from(z)]
        });
        let count = image.texels.len() as u64;
        // Means as of bytes: blue above 0.8, red and green within 0.1 of 0.5.
        let [red, green, blue] = sums.map(|sum| sum / count.max(1));
        blue > 204 && (102..=153).contains(&red) && (102..=153).contains(&green)
    }

    /// Takes over the images of a model, whose parts are told their new indices.
    pub(crate) fn adopt(&mut self, model: &mut Model) {
        let (textures, heights) = (self.textures.all.len(), self.heights.all.len());
        for part in &mut model.parts {
            part.texture.iter_mut().chain(part.detail.images_mut()).for_each(|index| *index += textures);
            part.detail.height.iter_mut().for_each(|height| height.heights += heights);
        }
        let texels: u64 = model.textures.iter().map(|image| image.texels.len() as u64).sum();
        self.texels_left = self.texels_left.saturating_sub(texels);
        self.textures.all.append(&mut model.textures);
        self.heights.all.append(&mut model.heights);
    }

    /// Gives a model the images that its parts name, and drops the others.
    pub(crate) fn give(self, model: &mut Model) {
        let mut textures = Renumbered::new(self.textures.all);
        let mut heights = Renumbered::new(self.heights.all);
        for part in &mut model.parts {
            part.texture
                .iter_mut()
                .chain(part.detail.images_mut())
                .for_each(|index| textures.renumber(index));
            part.detail.height.iter_mut().for_each(|height| heights.renumber(&mut height.heights));
        }
        (model.textures, model.heights) = (textures.used, heights.used);
    }
}

/// Images in the order in which they are named.
struct Renumbered<T> {
    all: Vec<Option<T>>,
    index: Vec<usize>,
    used: Vec<T>,
}

impl<T> Renumbered<T> {
    fn new(all: Vec<T>) -> Self {
        let index = vec![0; all.len()];
        Self { all: all.into_iter().map(Some).collect(), index, used: Vec::new() }
    }

    fn renumber(&mut self, index: &mut usize) {
        if let Some(image) = self.all[*index].take() {
            self.index[*index] = self.used.len();
            self.used.push(image);
        }
        *index = self.index[*index];
    }
}

/// The error of an image, at the line that names it if a file does.
fn unusable(map: &MapFile, error: Error) -> Error {
    let Some(origin) = &map.origin else { return error };
    let found = format!("a texture {} that cannot be used ({error})", quote(origin.text.as_bytes()));
    map.place(Error::new(found, "an image"))
}
