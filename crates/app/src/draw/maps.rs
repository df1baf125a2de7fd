//! Images whose filter and wrap mode are chosen at run time, as maps of a material. Which they are is asked once for
//! the samples that are worked on together; the colours are those of the library's samplers.

use crate::error::Error;
use crate::options::{Filter, Probes, RenderOptions, Wrap};
use crate::scene::{HeightImage, Image, Map, Model, Part};
use alberti::Rgba8;
use alberti::glam::Vec2;
use alberti::lanes::Lanes;
use alberti::raster::{Gradient, PerPixel};
use alberti::shaders::material::{self, Times};
use alberti::texture::format::{Content, L16, Linear, Normals};
use alberti::texture::mipmap::{self, Mean};
use alberti::texture::surface::{HeightMap, bilinear_height_lanes};
use alberti::texture::{
    self, Anisotropic, Clamp, LevelSize, Mipmap, Mirror, PowerOfTwo, Repeat, Size, Texture, Trilinear,
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
        let numbers = numbers.into_iter().filter_map(content(Content::Linear));
        colors.chain(numbers).chain(normals.into_iter().filter_map(content(Content::Normals)))
    }
}

/// All levels.
fn chain(image: &Image, content: Content) -> Result<Vec<[u8; 4]>, Error> {
    fn build<F: Mean<Texel = [u8; 4]>>(image: &Image) -> Result<Vec<[u8; 4]>, texture::TextureError> {
        let mut texels = image.texels.clone();
        texels.resize(mipmap::texel_count(image.width, image.height), [0; 4]);
        mipmap::build::<F>(&mut texels, image.width, image.height)?;
        Ok(texels)
    }
    let built = match content {
        Content::Srgb => build::<Rgba8>(image),
        Content::Linear => build::<Linear<Rgba8>>(image),
        Content::Normals => build::<Normals<Rgba8>>(image),
    };
    built.map_err(|e| Error::new(e.to_string(), "textures that can be drawn"))
}

/// From names to types: the wrap mode.
macro_rules! by_wrap {
    ($wrap:expr, |$mode:ident| $body:expr) => {
        match $wrap {
            Wrap::Repeat => {
                type $mode = Repeat;
                $body
            }
            Wrap::Clamp => {
                type $mode = Clamp;
                $body
            }
            Wrap::Mirror => {
                type $mode = Mirror;
                $body
            }
        }
    };
}
/// An image with the way of reading it.
#[derive(Clone, Copy, Debug)]
pub(super) struct AnyMap<'a> {
    texture: Texture<'a, Rgba8>,
    mipmap: Option<Mipmap<'a, Rgba8>>,
    filter: Filter,
    wrap: Wrap,
}

impl<'a> AnyMap<'a> {
    /// An image that the model has, if it has it.
    pub(super) fn new(
        model: &'a Model,
        chains: &'a Chains,
        options: &RenderOptions,
        map: Map,
        content: Content,
    ) -> Option<Self> {
        let image = model.textures.get(map.image)?;
        let chain = chains.0.get(&(map.image, content));
        Some(Self {
            texture: Texture::new(&image.texels, image.width, image.height).ok()?,
            mipmap: chain.and_then(|texels| Mipmap::new(texels, image.width, image.height).ok()),
            filter: map.filter.unwrap_or(options.filter),
            wrap: map.wrap.unwrap_or(options.wrap),
        })
    }

    /// With texels that are found by masks, if its size allows that.
    #[inline(always)]
    fn read_sized<L: Lanes, Z: LevelSize>(
        &self,
        lanes: L,
        texture: &Texture<'a, Rgba8, Z>,
        mipmap: Option<&Mipmap<'a, Rgba8, Z>>,
        uv: [L::Number; 2],
        gradient: &Gradient<[L::Number; 2]>,
    ) -> L::U32 {
        let Some(mipmap) = mipmap else {
            return if self.filter == Filter::Nearest {
                by_wrap!(self.wrap, |W| flat::<L, texture::Nearest, W, Z>(lanes, texture, uv))
            } else {
                by_wrap!(self.wrap, |W| flat::<L, texture::Bilinear, W, Z>(lanes, texture, uv))
            };
        };
        match self.filter {
            Filter::Anisotropic(Probes::Two) => {
                by_wrap!(self.wrap, |W| deep::<L, Anisotropic<2>, W, Z>(lanes, mipmap, uv, gradient))
            }
            Filter::Anisotropic(Probes::Four) => {
                by_wrap!(self.wrap, |W| deep::<L, Anisotropic<4>, W, Z>(lanes, mipmap, uv, gradient))
            }
            Filter::Anisotropic(Probes::Eight) => {
                by_wrap!(self.wrap, |W| deep::<L, Anisotropic<8>, W, Z>(lanes, mipmap, uv, gradient))
            }
            Filter::Anisotropic(Probes::Sixteen) => {
                by_wrap!(self.wrap, |W| deep::<L, Anisotropic<16>, W, Z>(lanes, mipmap, uv, gradient))
            }
            _ => by_wrap!(self.wrap, |W| deep::<L, Trilinear, W, Z>(lanes, mipmap, uv, gradient)),
        }
    }
}

impl material::Map for AnyMap<'_> {
    type Derivatives = PerPixel;

    #[inline(always)]
    fn read<L: Lanes>(&self, lanes: L, uv: [L::Number; 2], gradient: &Gradient<[L::Number; 2]>) -> L::U32 {
        let mipmap = self.mipmap.as_ref();
        match self.texture.power_of_two() {
            Some(texture) => {
                let mipmap = mipmap.and_then(|mipmap| mipmap.power_of_two());
                self.read_sized::<L, PowerOfTwo>(lanes, &texture, mipmap.as_ref(), uv, gradient)
            }
            None => self.read_sized(lanes, &self.texture, mipmap, uv, gradient),
        }
    }
}

/// One filter. Not inlined, so that there is one copy for each kind of lanes.
#[inline(never)]
fn flat<L: Lanes, Fl: texture::Filter, W: texture::Wrap, Z: Size>(
    lanes: L,
    texture: &Texture<'_, Rgba8, Z>,
    [u, v]: [L::Number; 2],
) -> L::U32 {
    lanes.vectorize(
        #[inline(always)]
        || texture.sampler::<Fl, W>().sample_lanes(lanes, u, v),
    )
}

/// One filter of mip maps.
#[inline(never)]
fn deep<L: Lanes, M: texture::MipFilter, W: texture::Wrap, Z: LevelSize>(
    lanes: L,
    mipmap: &Mipmap<'_, Rgba8, Z>,
    uv: [L::Number; 2],
    gradient: &Gradient<[L::Number; 2]>,
) -> L::U32 {
    lanes.vectorize(
        #[inline(always)]
        || material::Map::read(&mipmap.sampler::<M, W>(), lanes, uv, gradient),
    )
}

/// A constant, times a map where there is one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scaled<'a> {
    pub(super) factor: Rgba8,
    pub(super) map: Option<AnyMap<'a>>,
}

impl material::Map for Scaled<'_> {
    type Derivatives = PerPixel;

    #[inline(always)]
    fn read<L: Lanes>(&self, lanes: L, uv: [L::Number; 2], gradient: &Gradient<[L::Number; 2]>) -> L::U32 {
        match self.map {
            None => self.factor.read(lanes, uv, gradient),
            Some(map) => Times { map, factor: self.factor }.read(lanes, uv, gradient),
        }
    }
}

/// Heights with a wrap mode.
#[derive(Clone, Copy, Debug)]
pub(super) struct AnyHeights<'a> {
    texture: Texture<'a, L16>,
    wrap: Wrap,
}

impl<'a> AnyHeights<'a> {
    pub(super) fn new(image: &'a HeightImage, wrap: Wrap) -> Option<Self> {
        Some(Self { texture: Texture::new(&image.heights, image.width, image.height).ok()?, wrap })
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
        by_wrap!(self.wrap, |W| surface::<L, W>(lanes, &self.texture, uv))
    }
}

/// The heights between texels.
#[inline(never)]
fn surface<L: Lanes, W: texture::Wrap>(
    lanes: L,
    texture: &Texture<'_, L16>,
    uv: [L::Number; 2],
) -> L::Number {
    lanes.vectorize(
        #[inline(always)]
        || bilinear_height_lanes::<L, L16, _, W, W>(lanes, texture, uv).0,
    )
}
