//! Images whose filter and wrap mode are chosen at run time, as maps of a material. Which they are is asked once for
//! the samples that are worked on together; the colours are those of the library's samplers.

use crate::error::Error;
use crate::memory;
use crate::options::{Filter, RenderOptions, Wrap};
use crate::output::stage::{Stage, during};
use crate::scene::{EnvironmentKind, HeightImage, Image, Map, Model, Part};
use crate::threads::{Task, by_threads};
use alberti::glam::Vec2;
use alberti::shaders::material::{Called, Times};
use alberti::texture::format::{Content, L16, Normals, Rgba8888, Scalars};
use alberti::texture::mipmap::Piece;
use alberti::texture::surface::BilinearHeights;
use alberti::texture::{
    AnyFilter, AnyMipFilter, AnyWrap, MipSampler, Mipmap, Nearest, PowerOfTwo, Repeat, Sampler, TexelFormat,
    Texture, TextureError, mipmap,
};
use std::collections::{BTreeMap, HashMap};

/// The mip maps that a model's surfaces are drawn with.
#[derive(Debug, Default)]
pub(crate) struct Chains(HashMap<(usize, Content), Vec<[u8; 4]>>);

impl Chains {
    /// Those that are needed.
    ///
    /// # Errors
    /// A texture that cannot be drawn.
    pub(crate) fn new(model: &Model, options: &RenderOptions) -> Result<Self, Error> {
        let mut wanted = BTreeMap::new();
        for part in &model.parts {
            for (map, content) in part.maps() {
                let mipmapped =
                    !matches!(map.filter.unwrap_or(options.filter), Filter::Nearest | Filter::Bilinear);
                if let Some(image) = model.textures.get(map.image).filter(|_| mipmapped) {
                    wanted.insert((map.image, content as u8), (image, content));
                }
            }
        }
        during(Stage::MipMaps, |_| {
            let counts = wanted.values().map(|(image, _)| mipmap::texel_count(image.width, image.height));
            memory::need(4 * counts.sum::<usize>() as u64, "a set of mip maps")?;
            let mut chains = HashMap::new();
            for (&(index, _), &(image, content)) in &wanted {
                let count = mipmap::texel_count(image.width, image.height);
                chains.insert((index, content), vec![[0; 4]; count]);
            }
            let threads = options.threads.get();
            let mut work = vec![];
            for (&(index, content), texels) in &mut chains {
                work.extend(copies(&wanted[&(index, content as u8)].0.texels, texels));
            }
            by_threads(work, threads);
            let mut work = vec![];
            for ((index, content), texels) in &mut chains {
                let (image, _) = wanted[&(*index, *content as u8)];
                work.extend(pieces(*content, texels, [image.width, image.height], threads)?);
            }
            by_threads(work, threads);
            Ok(Self(chains))
        })
    }
}

/// The work of copying an image, which is the largest level. Most of it is the memory's first use.
fn copies<'a>(image: &'a [[u8; 4]], texels: &'a mut [[u8; 4]]) -> impl Iterator<Item = Task<'a>> {
    const PIECE: usize = 1 << 20;
    let pieces = image.chunks(PIECE).zip(texels.chunks_mut(PIECE));
    pieces.map(|(from, to)| -> Task<'a> { Box::new(|| to[..from.len()].copy_from_slice(from)) })
}

/// The work of filling the smaller levels, for so many threads.
fn pieces(
    content: Content,
    texels: &mut [[u8; 4]],
    size: [u32; 2],
    threads: usize,
) -> Result<Vec<Task<'_>>, Error> {
    fn of<'a, F: TexelFormat<Texel = [u8; 4]> + Send>(
        format: F,
        texels: &'a mut [[u8; 4]],
        [width, height]: [u32; 2],
        threads: usize,
    ) -> Result<Vec<Task<'a>>, TextureError> {
        let mut pieces: Vec<_> = mipmap::pieces(format, texels, width, height)?.collect();
        // Halves of halves, until there are some for each thread, or nothing can be split.
        let mut before = 0;
        while threads > 1 && before < pieces.len() && pieces.len() < 16 * threads {
            before = pieces.len();
            let lower: Vec<_> = pieces.iter_mut().filter_map(Piece::split).collect();
            pieces.extend(lower);
        }
        let task = |piece: Piece<'a, F>| -> Task<'a> { Box::new(move || piece.build()) };
        Ok(pieces.into_iter().map(task).collect())
    }
    let pieces = match content {
        Content::Srgb => of(Rgba8888, texels, size, threads),
        Content::Scalars => of(Scalars(Rgba8888), texels, size, threads),
        Content::Normals => of(Normals(Rgba8888), texels, size, threads),
    };
    pieces.map_err(|e| Error::new(e.to_string(), "textures that can be drawn"))
}

impl Part {
    /// The way of reading its texture, if it has one.
    pub(super) fn color_map(&self) -> Option<Map> {
        let image = self.texture?;
        Some(Map { image, filter: self.detail.filter, wrap: self.detail.wrap })
    }

    /// All images on it that may have mip maps, and what their texels stand for.
    pub(crate) fn maps(&self) -> impl Iterator<Item = (Map, Content)> {
        let detail = &self.detail;
        let colors = [self.color_map(), detail.specular_map, detail.emissive_map];
        let numbers = [detail.occlusion, detail.wetness_map, detail.shininess_map, detail.reflection_map];
        let normals = [detail.normal.map(|normal| normal.map)];
        let content = |content| move |map: Option<Map>| Some((map?, content));
        let colors = colors.into_iter().filter_map(content(Content::Srgb));
        let numbers = numbers.into_iter().filter_map(content(Content::Scalars));
        colors.chain(numbers).chain(normals.into_iter().filter_map(content(Content::Normals)))
    }
}

/// A filter for mip maps, which may have one level only.
pub(super) fn mip_filter(filter: Filter) -> AnyMipFilter {
    match filter {
        Filter::Nearest => AnyMipFilter::Base(AnyFilter::Nearest),
        Filter::Bilinear => AnyMipFilter::Base(AnyFilter::Bilinear),
        Filter::Trilinear => AnyMipFilter::Trilinear,
        Filter::Anisotropic(probes) => AnyMipFilter::Anisotropic { probes: probes.count() },
    }
}

/// The filter of plain surfaces, which read no mip maps.
pub(super) fn any_filter(filter: Filter) -> AnyFilter {
    if filter == Filter::Nearest { AnyFilter::Nearest } else { AnyFilter::Bilinear }
}

/// The library's wrap mode of that name.
pub(super) fn any_wrap(wrap: Wrap) -> AnyWrap {
    match wrap {
        Wrap::Repeat => AnyWrap::Repeat,
        Wrap::Clamp => AnyWrap::Clamp,
        Wrap::Mirror => AnyWrap::Mirror,
    }
}

/// An image, perhaps with smaller levels, with the way of reading it; all filters and wrap modes are long code.
pub(super) type AnyMap<'a> = Called<MipSampler<'a, Rgba8888, AnyMipFilter, AnyWrap>>;

/// An image without smaller levels.
pub(super) type FlatMap<'a> = Called<Sampler<'a, Rgba8888, AnyFilter, AnyWrap>>;

/// The same, read in the shortest way, which is not worth a call.
pub(super) type TileMap<'a> = Sampler<'a, Rgba8888, Nearest, Repeat, Repeat, PowerOfTwo>;

/// An image that the model has, if it has it.
pub(super) fn any_map<'a>(
    model: &'a Model,
    chains: &'a Chains,
    options: &RenderOptions,
    map: Map,
    content: Content,
) -> Option<AnyMap<'a>> {
    let image = model.textures.get(map.image)?;
    let texels = chains.0.get(&(map.image, content)).unwrap_or(&image.texels);
    let mipmap = Mipmap::new(Rgba8888, texels, image.width, image.height).ok()?;
    let filter = mip_filter(map.filter.unwrap_or(options.filter));
    Some(Called(mipmap.sampler(filter, any_wrap(map.wrap.unwrap_or(options.wrap)))))
}

/// A texture of a plain surface.
pub(super) fn flat_map<'a>(texture: Texture<'a, Rgba8888>, options: &RenderOptions) -> FlatMap<'a> {
    Called(texture.sampler(any_filter(options.filter), any_wrap(options.wrap)))
}

/// An image of all directions.
pub(super) fn surroundings(kind: EnvironmentKind, image: &Image) -> Option<FlatMap<'_>> {
    let texture = Texture::new(Rgba8888, &image.texels, image.width, image.height).ok()?;
    let round = if kind == EnvironmentKind::LatLong { AnyWrap::Repeat } else { AnyWrap::Clamp };
    Some(Called(texture.sampler_per_axis(AnyFilter::Bilinear, round, AnyWrap::Clamp)))
}

/// A texture of a plain surface, if it is one for the shortest way.
pub(super) fn tile_map<'a>(texture: Texture<'a, Rgba8888>, options: &RenderOptions) -> Option<TileMap<'a>> {
    let tiles = (options.filter, options.wrap) == (Filter::Nearest, Wrap::Repeat);
    Some(texture.power_of_two().filter(|_| tiles)?.sampler(Nearest, Repeat))
}

/// A constant, times a map where there is one.
pub(super) type Scaled<M> = Times<Option<M>>;

/// Heights with a wrap mode.
pub(super) type AnyHeights<'a> = Called<BilinearHeights<'a, L16, AnyWrap>>;

/// Heights and, in u and v, the size of a texel.
#[expect(clippy::cast_precision_loss, reason = "at most 2^14")]
pub(super) fn any_heights(image: &HeightImage, wrap: Wrap) -> Option<(AnyHeights<'_>, Vec2)> {
    let texture = Texture::new(L16, &image.heights, image.width, image.height).ok()?;
    let texel = Vec2::new(1.0 / image.width as f32, 1.0 / image.height as f32);
    Some((Called(BilinearHeights::new(texture, any_wrap(wrap))), texel))
}
