//! The images of a model, each file read once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::error::{Error, quote};
use crate::load::image_file;
use crate::load::mtl::Alpha;
use crate::options::{MapFile, byte};
use crate::output::stage::{Stage, during};
use crate::scene::{HeightImage, Image, MapNote, Model};

mod holes;

/// Images read so far.
#[derive(Clone, Debug)]
pub(crate) struct Images {
    textures: Read<Arc<Image>>,
    heights: Read<Arc<HeightImage>>,
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
    /// It with colours in its holes.
    Filled(usize),
    /// Its alpha times this.
    Faded(usize, u8),
    /// Its colours by a factor, as an `f32`'s bits, and more by a term.
    Ranged(usize, [u32; 2]),
    /// The colours of the first, white without one, of which metal by the second, times a byte, scatters half.
    Dull(Option<usize>, (usize, u8)),
    /// The light that such a surface mirrors.
    Mirroring(Mirroring),
    /// The first, white without one, fainter by the second, where exponents go from the first to the second of these.
    Fainter(Option<usize>, usize, [u32; 2]),
}

/// A surface whose highlights differ from place to place. Maps that are missing are white.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Mirroring {
    /// The texture, and what its colours are multiplied by.
    pub(crate) colors: (Option<usize>, [u8; 3]),
    /// The share of metal.
    pub(crate) metal: (Option<usize>, u8),
    /// Where exponents of highlights go from the first to the second.
    pub(crate) gloss: (Option<usize>, [u32; 2]),
}

/// The share of light that a surface that is no metal mirrors head-on.
pub(crate) const DIELECTRIC: f32 = 0.04;

/// All three maps are smooth.
const SMOOTH: [bool; 3] = [true; 3];

/// Images of a kind, and their indices by file. `None` is a file of which an error has been told.
#[derive(Clone, Debug)]
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
        let index = self.textures.index(map, |path| {
            let image = during(Stage::Maps, |_| image_file::load(path, *left))?;
            *left = left.saturating_sub(image.texels.len() as u64);
            Ok(Arc::new(image))
        })?;
        Ok(match map.range {
            Some(range) => index.map(|index| self.ranged(index, range)),
            None => index,
        })
    }

    /// The index of a height image; `None` where an error has been told before.
    ///
    /// # Errors
    /// The file cannot be read, or is no image.
    pub(crate) fn heights(&mut self, map: &MapFile) -> Result<Option<usize>, Error> {
        let left = &mut self.texels_left;
        self.heights.index(map, |path| {
            let image = during(Stage::Maps, |_| image_file::load_heights(path, *left))?;
            *left = left.saturating_sub(image.heights.len() as u64);
            Ok(Arc::new(image))
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
        self.textures
            .all
            .get(index)
            .map_or(Alpha::Opaque, |image| Alpha::of(&image.texels, image.width as usize))
    }

    /// The texture of 255 less its colours: of roughness, smoothness.
    pub(crate) fn inverted(&mut self, index: usize) -> usize {
        self.changed(index, Made::Inverted(index), |[r, g, b, a]| [255 - r, 255 - g, 255 - b, a])
    }

    /// A texture without other colours at the rims of its holes.
    pub(crate) fn filled(&mut self, index: usize) -> usize {
        self.made(Made::Filled(index), |all| holes::filled(all.get(index)?)).unwrap_or(index)
    }

    /// A texture whose alpha is multiplied by a share, a byte.
    pub(crate) fn faded(&mut self, index: usize, share: u8) -> usize {
        self.changed(index, Made::Faded(index, share), |[r, g, b, a]| [r, g, b, times(a, share)])
    }

    /// A texture whose colours are multiplied by the second of `range`, to which the first is added, from 0 to 1.
    fn ranged(&mut self, index: usize, [base, gain]: [f32; 2]) -> usize {
        self.changed(index, Made::Ranged(index, [base, gain].map(f32::to_bits)), |[r, g, b, a]| {
            let [r, g, b] = [r, g, b].map(|c| byte(base + gain * share(c)));
            [r, g, b, a]
        })
    }

    fn changed(&mut self, index: usize, made: Made, change: impl Fn([u8; 4]) -> [u8; 4]) -> usize {
        let make = |all: &[Arc<Image>]| {
            let image = all.get(index)?;
            Some(Image { texels: image.texels.iter().map(|&texel| change(texel)).collect(), ..**image })
        };
        self.made(made, make).unwrap_or(index)
    }

    /// A texture whose alpha is that of another one: its alpha if it has such, else its red.
    pub(crate) fn with_alpha(&mut self, colors: Option<usize>, alpha: usize) -> Option<usize> {
        let has_alpha = self.alpha(alpha) != Alpha::Opaque;
        let maps = [colors.or(Some(alpha)), Some(alpha), None];
        // Holes stay holes, without shades at their rims.
        self.together(
            maps,
            [true, false, true],
            Made::WithAlpha(colors, alpha),
            |[color, [red, .., own], _]| {
                let [r, g, b, _] = if colors.is_some() { color } else { [255; 4] };
                [r, g, b, if has_alpha { own } else { red }]
            },
        )
    }

    /// The texture of a surface that is metal in places: the light that it scatters.
    pub(crate) fn dull(&mut self, colors: Option<usize>, (metal, by): (usize, u8)) -> Option<usize> {
        let made = Made::Dull(colors, (metal, by));
        self.together([colors, Some(metal), None], SMOOTH, made, |[[r, g, b, a], [metal, ..], _]| {
            let scattered = 255 - times(metal, by) / 2;
            let [r, g, b] = [r, g, b].map(|c| times(c, scattered));
            [r, g, b, a]
        })
    }

    /// The light that a surface mirrors head-on, times `height` of the exponent there.
    pub(crate) fn mirroring(&mut self, of: Mirroring, height: impl Fn(f32) -> f32) -> Option<usize> {
        let Mirroring { colors, metal, gloss } = of;
        self.together(
            [colors.0, metal.0, gloss.0],
            SMOOTH,
            Made::Mirroring(of),
            |[color, [red, ..], [sharp, ..]]| {
                let metal = share(times(red, metal.1));
                let [least, greatest] = gloss.1.map(f32::from_bits);
                let height = height(least + (greatest - least) * share(sharp));
                let mirrored = |axis: usize| {
                    let own = share(times(color[axis], colors.1[axis]));
                    byte((DIELECTRIC + (own - DIELECTRIC) * metal) * height)
                };
                [mirrored(0), mirrored(1), mirrored(2), 255]
            },
        )
    }

    /// The colours of highlights, times a share of the exponent there. `None` where that is 1 everywhere, or where
    /// there is no room for it.
    pub(crate) fn fainter(
        &mut self,
        colors: Option<usize>,
        gloss: usize,
        [least, greatest]: [f32; 2],
        share_of: impl Fn(f32) -> f32,
    ) -> Option<usize> {
        let light = |gloss: u8| byte(share_of(least + (greatest - least) * share(gloss)));
        if self.textures.all.get(gloss)?.texels.iter().all(|&[gloss, ..]| light(gloss) == 255) {
            return None;
        }
        let made = Made::Fainter(colors, gloss, [least, greatest].map(f32::to_bits));
        self.together([colors, Some(gloss), None], SMOOTH, made, |[[r, g, b, a], [gloss, ..], _]| {
            let [r, g, b] = [r, g, b].map(|c| times(c, light(gloss)));
            [r, g, b, a]
        })
    }

    /// A texture of others: as large as the largest on each axis, of their colours in the middles of its texels. Of
    /// maps that are `smooth` these are means, of others texels of their own. `None` where there is no room for it.
    fn together(
        &mut self,
        maps: [Option<usize>; 3],
        smooth: [bool; 3],
        made: Made,
        change: impl Fn([[u8; 4]; 3]) -> [u8; 4],
    ) -> Option<usize> {
        self.made(made, |all| {
            let images = maps.map(|index| all.get(index?));
            let sides = images.iter().flatten().map(|image| [image.width, image.height]);
            let [width, height] = sides.reduce(|[a, b], [c, d]| [a.max(c), b.max(d)])?;
            let texel = |row: u32, column: u32| {
                change([0, 1, 2].map(|number| {
                    let Some(image) = images[number] else { return [255; 4] };
                    let axes = [(column, width, image.width), (row, height, image.height)];
                    magnified(image, axes.map(if smooth[number] { between } else { on }))
                }))
            };
            let texels = (0..height).flat_map(|row| (0..width).map(move |column| (row, column)));
            let texels = texels.map(|(row, column)| texel(row, column)).collect();
            Some(Image { width, height, texels })
        })
    }

    /// The index of a texture that is made of others; `None` where there is no room for it.
    fn made(&mut self, made: Made, make: impl FnOnce(&[Arc<Image>]) -> Option<Image>) -> Option<usize> {
        if let Some(&known) = self.made.get(&made) {
            return Some(known);
        }
        let image = make(&self.textures.all).filter(|image| image.texels.len() as u64 <= self.texels_left)?;
        self.texels_left -= image.texels.len() as u64;
        self.textures.all.push(Arc::new(image));
        let index = self.textures.all.len() - 1;
        self.made.insert(made, index);
        Some(index)
    }

    /// Heights that have been read.
    pub(crate) fn height_image(&self, index: usize) -> Option<&HeightImage> {
        self.heights.all.get(index).map(Arc::as_ref)
    }

    /// Whether a texture is blue all over, as normals in tangent space are and heights are not.
    pub(crate) fn looks_like_normals(&self, index: usize) -> bool {
        let Some(image) = self.textures.all.get(index) else { return false };
        let sums = image.texels.iter().fold([0_u64; 3], |[r, g, b], &[x, y, z, _]| {
            [r + u64::from(x), g + u64::from(y), b + u64::from(z)]
        });
        let count = image.texels.len() as u64;
        // Means as of bytes: blue above 0.8, red and green within 0.1 of 0.5. Nearly all are of about unit length.
        let [red, green, blue] = sums.map(|sum| sum / count.max(1));
        let is_unit = |[r, g, b, _]: &&[u8; 4]| {
            let square: f32 = [*r, *g, *b].map(|byte| (2.0 * share(byte) - 1.0).powi(2)).iter().sum();
            (0.6..1.4).contains(&square)
        };
        let units = image.texels.iter().filter(is_unit).count() as u64;
        blue > 204 && (102..=153).contains(&red) && (102..=153).contains(&green) && 10 * units >= 9 * count
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

/// The texel of a side on which the middle of texel `k` of `of` lies or after which it comes, and how far towards the
/// next, in 256ths. Beyond the outermost middles it is theirs.
fn between((k, of, side): (u32, u32, u32)) -> [u32; 2] {
    // Sides are at most 2^14.
    let at = 128 * (2 * u64::from(k) + 1) * u64::from(side) / u64::from(of.max(1));
    let at = at.saturating_sub(128).min(256 * u64::from(side.saturating_sub(1)));
    [at >> 8, at & 255].map(|part| u32::try_from(part).unwrap_or(0))
}

/// The texel of a side that the middle of texel `k` of `of` is in, with nothing of the next.
fn on((k, of, side): (u32, u32, u32)) -> [u32; 2] {
    let at = (2 * u64::from(k) + 1) * u64::from(side) / (2 * u64::from(of.max(1)));
    [u32::try_from(at).unwrap_or(0), 0]
}

/// The colour of an image between texels, by the shares of four of them.
fn magnified(image: &Image, [[x, right], [y, down]]: [[u32; 2]; 2]) -> [u8; 4] {
    let texel = |x: u32, y: u32| {
        let at = y as usize * image.width as usize + x as usize;
        image.texels.get(at).copied().unwrap_or([255; 4])
    };
    if [right, down] == [0; 2] {
        return texel(x, y);
    }
    let (next, below) = (x + u32::from(right > 0), y + u32::from(down > 0));
    let four = [
        (x, y, 256 - right, 256 - down),
        (next, y, right, 256 - down),
        (x, below, 256 - right, down),
        (next, below, right, down),
    ];
    let four = four.map(|(x, y, across, along)| (texel(x, y), across * along));
    [0, 1, 2, 3].map(|k: usize| {
        let sum: u32 = four.iter().map(|(texel, share)| u32::from(texel[k]) * share).sum();
        ((sum + (1 << 15)) >> 16).to_le_bytes()[0]
    })
}

/// A byte as a share of 255.
fn share(byte: u8) -> f32 {
    f32::from(byte) / 255.0
}

/// The product of two shares, rounded to nearest.
fn times(a: u8, b: u8) -> u8 {
    ((u32::from(a) * u32::from(b) + 127) / 255).to_le_bytes()[0]
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
    map.place(error.of(&format!("the texture {}", quote(origin.text.as_bytes()))))
}

#[cfg(test)]
mod tests;
