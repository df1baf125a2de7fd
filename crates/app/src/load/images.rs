//! The images of a model, each file read once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::error::{Error, quote};
use crate::load::image_file;
use crate::load::mtl::Alpha;
use crate::options::MapFile;
use crate::output::clock::{Work, timed};
use crate::scene::{HeightImage, Image, MapNote, Model};

/// Images read so far.
#[derive(Debug)]
pub(crate) struct Images {
    textures: Read<Image>,
    heights: Read<HeightImage>,
    texels_left: u64,
    /// Textures that were made of others, by what they were made of.
    made: HashMap<Made, usize>,
}

/// A texture that is made of others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Made {
    /// 255 less its colours.
    Inverted(usize),
    /// The colours of the first, white without one, and as its alpha the second.
    WithAlpha(Option<usize>, usize),
    /// Its alpha times this.
    Faded(usize, u8),
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

    /// The image of a file that has been read.
    fn image(&self, path: &Path) -> Option<&T> {
        self.all.get((*self.at.get(path)?)?)
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
        Self {
            textures: Read::new(),
            heights: Read::new(),
            texels_left: image_file::MAX_TEXELS,
            made: HashMap::new(),
        }
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

    /// Maps, and the sizes of those that have been read.
    pub(crate) fn notes(&self, maps: Vec<(&'static str, MapFile)>) -> Vec<MapNote> {
        let size = |path: &PathBuf| {
            let heights = || self.heights.image(path).map(|image| [image.width, image.height]);
            self.textures.image(path).map(|image| [image.width, image.height]).or_else(heights)
        };
        maps.into_iter().map(|(key, map)| MapNote { key, size: size(&map.path), path: map.path }).collect()
    }

    /// The alpha of a texture.
    pub(crate) fn alpha(&self, index: usize) -> Alpha {
        self.textures.all.get(index).map_or(Alpha::Opaque, |image| Alpha::of(&image.texels))
    }

    /// The texture of 255 less its colours: of roughness, smoothness.
    pub(crate) fn inverted(&mut self, index: usize) -> usize {
        self.made(Made::Inverted(index), |all| {
            let mut image = all.get(index)?.clone();
            for [r, g, b, _] in &mut image.texels {
                [*r, *g, *b] = [255 - *r, 255 - *g, 255 - *b];
            }
            Some(image)
        })
    }

    /// A texture whose alpha is that of another one: its alpha if it has such, else its red.
    pub(crate) fn with_alpha(&mut self, colors: Option<usize>, alpha: usize) -> usize {
        self.made(Made::WithAlpha(colors, alpha), |all| {
            let source = all.get(alpha)?;
            let has_alpha = Alpha::of(&source.texels) != Alpha::Opaque;
            let white = Image { texels: vec![[255; 4]; source.texels.len()], ..*source };
            let mut image = colors.and_then(|index| all.get(index)).unwrap_or(&white).clone();
            // The texel of the other that holds the middle of this one.
            // Sides are at most 2^14.
            let at = |k: u32, of: u32, side: u32| ((2 * k + 1) * side / (2 * of)) as usize;
            let (width, height) = (image.width, image.height);
            for (texels, row) in image.texels.chunks_mut(width as usize).zip(0..) {
                for ([.., alpha], column) in texels.iter_mut().zip(0..) {
                    let (x, y) = (at(column, width, source.width), at(row, height, source.height));
                    let [red, .., own] = source.texels.get(y * source.width as usize + x).copied()?;
                    *alpha = if has_alpha { own } else { red };
                }
            }
            Some(image)
        })
    }

    /// A texture whose alpha is multiplied by a share, a byte.
    pub(crate) fn faded(&mut self, index: usize, share: u8) -> usize {
        self.made(Made::Faded(index, share), |all| {
            let mut image = all.get(index)?.clone();
            for [.., alpha] in &mut image.texels {
                let product = u32::from(*alpha) * u32::from(share);
                *alpha = ((product + 127) / 255).to_le_bytes()[0];
            }
            Some(image)
        })
    }

    /// The index of a texture that is made of others, or of the first of them where there is no room for it.
    fn made(&mut self, made: Made, make: impl FnOnce(&[Image]) -> Option<Image>) -> usize {
        if let Some(&known) = self.made.get(&made) {
            return known;
        }
        let (Made::Inverted(source) | Made::WithAlpha(_, source) | Made::Faded(source, _)) = made;
        let index = match make(&self.textures.all) {
            Some(image) if image.texels.len() as u64 <= self.texels_left => {
                self.texels_left -= image.texels.len() as u64;
                self.textures.all.push(image);
                self.textures.all.len() - 1
            }
            _ => source,
        };
        self.made.insert(made, index);
        index
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
