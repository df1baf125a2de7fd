//! Images whose filter and wrap mode are chosen at run time, as maps of a material. Which they are is asked once for
//! the samples that are worked on together; the colours are those of the library's samplers.

use crate::error::Error;
use crate::options::{Filter, RenderOptions, Wrap};
use crate::scene::{HeightImage, Image, Map, Model, Part};
use alberti::Rgba8;
use alberti::glam::Vec2;
use alberti::lanes::Lanes;
use alberti::raster::Gradient;
use alberti::shaders::material::{self, Called, Times};
use alberti::texture::format::{Content, L16, Normals, Rgba8888, Scalars};
use alberti::texture::surface::{HeightMap, bilinear_height_lanes};
use alberti::texture::{
    AnyFilter, AnyMipFilter, AnyWrap, MipSampler, Mipmap, Nearest, PowerOfTwo, Repeat, Sampler, Texture,
    mipmap,
};
use std::collections::HashMap;

/// The mip maps that a model's surfaces are drawn with.
#[derive(Debug, Default)]
pub(crate) struct Chains(HashMap<(usize, Content), Vec<[u8; 4]>>);

impl Chains {
    /// Those that are needed.
    ///
    /// # Errors
    /// A texture that cannot be drawn.
    pub(crate) fn new(model: &Model, options: &RenderOptions) -> Result<Self, Error> {
        let mut chains = HashMap::new();
        for part in &model.parts {
            for (map, content) in part.maps() {
                let mipmapped =
                    !matches!(map.filter.unwrap_or(options.filter), Filter::Nearest | Filter::Bilinear);
                if let Some(image) = model.textures.get(map.image).filter(|_| mipmapped)
                    && !chains.contains_key(&(map.image, content))
                {
                    chains.insert((map.image, content), chain(image, content)?);
                }
            }
        }
        Ok(Self(chains))
    }
}

impl Part {
    /// How its texture is read, if it has one.
    pub(super) fn color_map(&self) -> Option<Map> {
        let image = self.texture?;
        Some(Map { image, filter: self.detail.filter, wrap: self.detail.wrap })
    }

    /// All images on it that may have mip maps, and what their texels stand for.
    fn maps(&self) -> impl Iterator<Item = (Map, Content)> {
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

/// All levels.
fn chain(image: &Image, content: Content) -> Result<Vec<[u8; 4]>, Error> {
    let (width, height) = (image.width, image.height);
    let mut texels = image.texels.clone();
    texels.resize(mipmap::texel_count(width, height), [0; 4]);
    let built = match content {
        Content::Srgb => mipmap::build(Rgba8888, &mut texels, width, height),
        Content::Scalars => mipmap::build(Scalars(Rgba8888), &mut texels, width, height),
        Content::Normals => mipmap::build(Normals(Rgba8888), &mut texels, width, height),
    };
    built.map_err(|e| Error::new(e.to_string(), "textures that can be drawn"))?;
    Ok(texels)
}

/// A filter for mip maps, which may have one level only.
fn mip_filter(filter: Filter) -> AnyMipFilter {
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
fn any_wrap(wrap: Wrap) -> AnyWrap {
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

/// A texture of a plain surface, if it is one for the shortest way.
pub(super) fn tile_map<'a>(texture: Texture<'a, Rgba8888>, options: &RenderOptions) -> Option<TileMap<'a>> {
    let tiles = (options.filter, options.wrap) == (Filter::Nearest, Wrap::Repeat);
    Some(texture.power_of_two().filter(|_| tiles)?.sampler(Nearest, Repeat))
}

/// A constant, times a map where there is one. A map times white is the map.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scaled<M> {
    pub(super) factor: Rgba8,
    pub(super) map: Option<M>,
}

impl<M: material::Map> material::Map for Scaled<M> {
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn read<L: Lanes>(&self, lanes: L, uv: [L::Number; 2], gradient: &Gradient<[L::Number; 2]>) -> L::U32 {
        match self.map {
            None => self.factor.read(lanes, uv, gradient),
            Some(map) if self.factor == Rgba8::WHITE => map.read(lanes, uv, gradient),
            Some(map) => Times { map, factor: self.factor }.read(lanes, uv, gradient),
        }
    }
}

/// Heights with a wrap mode.
#[derive(Clone, Copy, Debug)]
pub(super) struct AnyHeights<'a> {
    texture: Texture<'a, L16>,
    wrap: AnyWrap,
}

impl<'a> AnyHeights<'a> {
    pub(super) fn new(image: &'a HeightImage, wrap: Wrap) -> Option<Self> {
        let texture = Texture::new(L16, &image.heights, image.width, image.height).ok()?;
        Some(Self { texture, wrap: any_wrap(wrap) })
    }

    /// The size of a texel in u and v.
    #[expect(clippy::cast_precision_loss, reason = "at most 2^14")]
    pub(super) fn texel(&self) -> Vec2 {
        Vec2::new(1.0 / self.texture.width() as f32, 1.0 / self.texture.height() as f32)
    }
}

impl HeightMap for AnyHeights<'_> {
    #[inline(always)]
    fn height_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> L::Number {
        heights(lanes, self, uv)
    }
}

/// The heights between texels.
#[inline(never)]
fn heights<L: Lanes>(lanes: L, of: &AnyHeights<'_>, uv: [L::Number; 2]) -> L::Number {
    lanes.vectorize(
        #[inline(always)]
        || bilinear_height_lanes(lanes, &of.texture, (of.wrap, of.wrap), uv).0,
    )
}
