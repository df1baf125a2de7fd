//! Assets for flash: a scene's meshes and textures in few bytes, in the form in which programs draw them.
//!
//! Each part of the model goes the same way. Its triangles are simplified to their share of a budget, and ordered in
//! meshlets (`shape.rs`). Its vertices are rounded to integers, and joined where nothing parts them any more
//! (`packed.rs`). Textures are halved, dithered and encoded, level by level (`texels.rs`). The result is an [`Asset`].
//! It is written as a file that is read in place (`binary.rs`) and as the source of a module (`source.rs`). The
//! report's errors are those of the file, as the library reads it (`restored.rs`).

mod binary;
mod missing;
mod packed;
mod palette;
mod report;
mod restored;
mod shape;
mod source;
mod texels;

pub use binary::bytes;
pub use missing::{left_out, missing};
pub use packed::{Grids, Losses, Packed};
pub use report::{Estimate, Report};
pub use restored::restored;
pub use shape::{Order, Piece};
pub use source::source;
pub use texels::{Role, Texture};

use clap::ValueEnum;
use std::borrow::Cow;
use std::str::FromStr;

use crate::error::Error;
use crate::options::values::name_of;
use crate::options::{Dither, Filter, RenderOptions, Shading};
use crate::scene::{Camera, Model, Part, tangents};
use alberti::baked::{Attributes, TexelCode};

/// The format of textures of colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, ValueEnum)]
pub enum Format {
    /// 5, 6 and 5 bits in two bytes, which displays of either byte order take.
    #[default]
    Rgb565,
    /// The same with the high byte first: to be sent as they are to displays of that order.
    Rgb565be,
    /// rgb565, each texel with the next in a word: twice the flash, and less to do for bilinear filters in integers.
    Rgb565Pairs,
    /// rgb565 with alpha, multiplied by it, in four bytes: drawn over RGB565 in half the time of rgba8.
    Rgb565Alpha,
    /// 4 bits for red, green, blue and alpha each.
    Rgb444,
    /// 3, 3 and 2 bits in a byte.
    Rgb332,
    /// A byte of luminance.
    Grey8,
    /// 16 levels of luminance, two texels a byte.
    Grey4,
    /// 4 levels of luminance, four texels a byte.
    Grey2,
    /// Black and white, eight texels a byte.
    Grey1,
    /// A bit, with a palette of 2 colours.
    Indexed1,
    /// 2 bits, with a palette of 4 colours.
    Indexed2,
    /// 4 bits, with a palette of 16 colours.
    Indexed4,
    /// A byte, with a palette of 256 colours.
    Indexed8,
    /// A byte for red, green and blue each.
    Rgb888,
    /// A byte for red, green, blue and alpha each.
    Rgba8,
    /// 16 bits of height: not for colours.
    #[value(skip)]
    Grey16,
}

impl Format {
    /// Its name, as users write it.
    fn name(self) -> String {
        if self == Self::Grey16 { "grey16".to_owned() } else { name_of(self) }
    }

    /// The number of the format in a file. Levels of grey are indices into a ramp of as many.
    fn code(self) -> TexelCode {
        match self {
            Self::Rgb565 => TexelCode::Rgb565,
            Self::Rgb565be => TexelCode::Rgb565Be,
            Self::Rgb444 => TexelCode::Rgba4444,
            Self::Rgb332 => TexelCode::Rgb332,
            Self::Grey8 => TexelCode::L8,
            Self::Grey16 => TexelCode::L16,
            Self::Rgb565Pairs => TexelCode::Rgb565Pairs,
            Self::Rgb565Alpha => TexelCode::Rgb565Alpha,
            Self::Grey1 | Self::Indexed1 => TexelCode::Indexed1,
            Self::Grey2 | Self::Indexed2 => TexelCode::Indexed2,
            Self::Grey4 | Self::Indexed4 => TexelCode::Indexed4,
            Self::Indexed8 => TexelCode::Indexed8,
            Self::Rgb888 => TexelCode::Rgb8,
            Self::Rgba8 => TexelCode::Rgba8888,
        }
    }
}

/// The attributes that are asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Asked {
    /// Those that the scene's shading uses.
    #[default]
    Auto,
    /// These.
    These(Attributes),
}

impl Asked {
    const NAMES: [(&str, Attributes); 5] = [
        ("none", Attributes::NONE),
        ("uv", Attributes::UV),
        ("normal", Attributes::NORMAL),
        ("tangent", Attributes::TANGENT),
        ("color", Attributes::COLOR),
    ];
    const EXPECTED: &str = "auto, none, or some of uv,normal,tangent,color";

    /// The attributes of a file.
    fn of(self, model: &Model, options: &RenderOptions) -> Attributes {
        match self {
            Self::Auto => used(model, options),
            Self::These(attributes) => attributes,
        }
    }

    /// The words that ask for some.
    fn names(attributes: Attributes) -> String {
        let all = Self::NAMES.into_iter();
        let asked = all.filter(|&(_, one)| one != Attributes::NONE && attributes.contains(one));
        asked.map(|(name, _)| name).collect::<Vec<_>>().join(",")
    }
}

impl FromStr for Asked {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = &*text.to_ascii_lowercase();
        if text == "auto" {
            return Ok(Self::Auto);
        }
        let mut set = Attributes::NONE;
        for word in text.split(',') {
            let known = Self::NAMES.into_iter().find(|(name, _)| *name == word.trim());
            // None is nothing beside others.
            let known = known.filter(|&(_, attribute)| attribute != Attributes::NONE || word == text);
            let (_, attribute) = known.ok_or_else(|| Self::EXPECTED.to_owned())?;
            set = set | attribute;
        }
        Ok(Self::These(set))
    }
}

/// A user's wish.
#[derive(Clone, Copy, Debug)]
pub struct Wish {
    /// The format of textures of colours.
    pub format: Format,
    /// Their rounding.
    pub dither: Dither,
    /// The most triangles.
    pub triangles: Option<usize>,
    /// The longest side of a texture.
    pub texture_size: Option<u32>,
    /// The attributes.
    pub attributes: Asked,
    /// The most triangles of a meshlet; 0 for no meshlets.
    pub meshlets: usize,
}

impl Default for Wish {
    fn default() -> Self {
        Self {
            format: Format::default(),
            dither: Dither::default(),
            triangles: None,
            texture_size: None,
            attributes: Asked::Auto,
            meshlets: 16,
        }
    }
}

/// Meshes and textures as they lie in flash.
#[derive(Clone, Debug)]
pub struct Asset {
    /// The attributes of all vertices.
    pub attributes: Attributes,
    /// The unit of places, in object space.
    pub unit: f32,
    /// The parts that have triangles with an area, in the model's order.
    pub pieces: Vec<Piece>,
    /// The numbers of those that had triangles, of which none has an area on the grid.
    pub lost_parts: Vec<usize>,
    /// Those that the parts read. Colours of surfaces come first.
    pub textures: Vec<Texture>,
    /// The losses by rounding vertices.
    pub losses: Losses,
}

impl Asset {
    /// Triangles of all parts.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.pieces.iter().map(|piece| piece.triangles.len()).sum()
    }

    /// The most that simplification has moved a surface, in object space.
    #[must_use]
    pub fn moved(&self) -> f32 {
        self.pieces.iter().fold(0.0, |most, piece| most.max(piece.moved))
    }

    /// Vertices of all parts.
    #[must_use]
    pub fn vertices(&self) -> usize {
        self.pieces.iter().map(|piece| piece.vertices.len()).sum()
    }
}

/// Bakes a model, as these options draw it. Of several parts those near the camera keep more of their triangles.
///
/// # Errors
/// There is nothing to draw, too many vertices, parts or textures for their numbers, or texture coordinates too far
/// from 0.
pub fn bake(
    (model, camera): (&Model, &Camera),
    options: &RenderOptions,
    wish: &Wish,
) -> Result<Asset, Error> {
    let attributes = wish.attributes.of(model, options);
    let mut model = Cow::Borrowed(model);
    if attributes.contains(Attributes::TANGENT) {
        tangents::complete(model.to_mut(), |_| true);
    }
    let (textures, of_parts) = texels::textures(&model, options, attributes, wish)?;
    let asset = shape::asset((&model, camera.eye), wish, attributes, textures, &of_parts)?;
    let few = |found: usize, of: &str, hint: &str| {
        let most = u16::MAX;
        let error = Error::new(format!("{found} {of}"), format!("at most {most} in a file"));
        if found > most.into() { Err(error.hint(hint)) } else { Ok(()) }
    };
    few(asset.pieces.len(), "parts", "join those of one material")?;
    few(asset.textures.len(), "textures", "join some")?;
    Ok(asset)
}

/// The attributes that a picture reads.
#[must_use]
pub fn used(model: &Model, options: &RenderOptions) -> Attributes {
    if options.shading == Shading::VertexColor {
        return Attributes::COLOR;
    }
    let lit = options.shading.is_lit();
    let any = |attribute, has: &dyn Fn(&Part) -> bool| {
        if model.parts.iter().any(has) { attribute } else { Attributes::NONE }
    };
    any(Attributes::UV, &Part::has_maps)
        | any(Attributes::NORMAL, &|part| lit || part.detail.environment.is_some())
        | any(Attributes::TANGENT, &|part| lit && part.detail.needs_tangents())
}

/// Whether a filter reads smaller levels.
fn is_mipmapped(filter: Filter) -> bool {
    !matches!(filter, Filter::Nearest | Filter::Bilinear)
}
