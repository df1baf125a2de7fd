//! Materials: `[material.NAME]` of a scene file, the options under "Material", and an MTL file's.

use std::fmt;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};

use super::table::SURFACE;
use super::values::{Color, Finite, Number, Repeats, Share, Shininess, Strength, Tuple};
use super::{Blend, Filter, Wrap};
use crate::error::Error;
use crate::scene::{Detail, EnvironmentKind, NormalSpace, Relief};

/// Parts of a material; the others are left as they are.
#[derive(Clone, Debug, Default, PartialEq, Args, Deserialize)]
#[command(next_help_heading = "Material")]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct Material {
    /// Colour of every surface, a name or hexadecimal sRGB [default: the materials', else grey].
    #[arg(long = "diffuse", value_name = "COLOR", allow_hyphen_values = true, help_heading = SURFACE)]
    pub color: Option<Color>,

    /// Image to put on every surface instead of the materials' textures.
    #[arg(long = "texture", value_name = "FILE", value_parser = file(), help_heading = SURFACE, display_order = 0)]
    pub color_map: Option<MapFile>,

    /// Image whose red, green and blue are the surface's normal, from -1 at 0 to 1 at 255; green points to growing v.
    #[arg(long, value_name = "FILE", value_parser = file())]
    pub normal_map: Option<MapFile>,

    /// Between which axes those normals are; needs --normal-map [default: tangent].
    #[arg(long, value_enum, value_name = "SPACE")]
    pub normal_space: Option<NormalSpace>,

    /// How steep they are, from 0, smooth, to 100; needs --normal-map [default: 1, as they are].
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    pub normal_strength: Option<Number<Strength>>,

    /// Image of heights, black low and white high; 16-bit PNG keeps its 65536 steps.
    #[arg(long, value_name = "FILE", value_parser = file())]
    pub height_map: Option<MapFile>,

    /// Effect of the heights; needs --height-map [default: bump].
    #[arg(long, value_enum, value_name = "HOW")]
    pub relief: Option<Relief>,

    /// Heights of black and white, in units of the model; needs --height-map.
    ///
    /// The default goes over a fiftieth of the model's radius: from 0 on with bump and displacement, and up to 0 with
    /// all others, which press the surface in.
    #[arg(long, value_name = "LO,HI", allow_hyphen_values = true)]
    pub height_range: Option<Tuple<2, Finite>>,

    /// Multiplies the default of the range.
    #[arg(skip)]
    #[serde(skip)]
    pub height_scale: Option<f32>,

    /// Image of how much surrounding light arrives: red, from none at 0 to all at 255.
    #[arg(long = "ao", value_name = "FILE", value_parser = file())]
    pub ao_map: Option<MapFile>,

    /// Wetness, from 0, dry, to 1.
    #[arg(skip)]
    pub wetness: Option<Number<Share>>,

    /// Image of how wet the surface is, which makes it darker and its highlights sharper: red, from dry at 0 to 255.
    #[arg(long, value_name = "FILE", value_parser = file())]
    pub wetness_map: Option<MapFile>,

    /// Colour of highlights, as hexadecimal sRGB [default: the materials', else 404040].
    #[arg(long, value_name = "COLOR", allow_hyphen_values = true)]
    pub specular: Option<Color>,

    /// Multiplies `specular`.
    #[arg(skip)]
    pub specular_map: Option<MapFile>,

    /// Exponent of highlights, or the two that --shininess-map goes between, from 0 to 65536 [default: the materials',
    /// else 1,32, of which the second counts where there is no map].
    #[arg(long, value_name = "N or LO,HI", allow_hyphen_values = true)]
    pub shininess: Option<Shininess>,

    /// Image of how sharp highlights are: red, from the least of --shininess at 0 to the greatest at 255.
    #[arg(long, value_name = "FILE", value_parser = file())]
    pub shininess_map: Option<MapFile>,

    /// Light of the surface's own.
    #[arg(skip)]
    pub emissive: Option<Color>,

    /// Multiplies `emissive`.
    #[arg(skip)]
    pub emissive_map: Option<MapFile>,

    /// Image of what the surface mirrors.
    #[arg(long, value_name = "FILE", value_parser = file())]
    pub environment: Option<MapFile>,

    /// How it shows all directions; needs --environment [default: lat-long].
    #[arg(long, value_enum, value_name = "KIND")]
    pub environment_kind: Option<EnvironmentKind>,

    /// How much of it is mirrored, from 0 to 1; needs --environment [default: 0.5].
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    pub reflection: Option<Number<Share>>,

    /// Multiplies `reflection`.
    #[arg(skip)]
    pub reflection_map: Option<MapFile>,

    /// Its mixture with what is behind it.
    #[arg(skip)]
    pub blend: Option<Blend>,

    /// The least alpha that is drawn.
    #[arg(skip)]
    pub alpha_test: Option<Number<Share>>,

    /// The filter of all its maps.
    #[arg(skip)]
    pub filter: Option<Filter>,

    /// The wrap mode of all its maps.
    #[arg(skip)]
    pub wrap: Option<Wrap>,

    /// Repeats of its maps along u and v, each 1e-6 to 1e6.
    #[arg(skip)]
    pub uv_scale: Option<Tuple<2, Repeats>>,
}

/// A map that other keys say something of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Base {
    /// Its key.
    pub(crate) key: &'static str,
    /// In words, with its article.
    pub(crate) name: &'static str,
    said: fn(&Material) -> bool,
    /// Whether a part has one.
    pub(crate) drawn: fn(&Detail) -> bool,
}

const NORMALS: Base = Base {
    key: "normal-map",
    name: "a normal map",
    said: |material| material.normal_map.is_some(),
    drawn: |detail| detail.normal.is_some(),
};
const HEIGHTS: Base = Base {
    key: "height-map",
    name: "a height map",
    said: |material| material.height_map.is_some(),
    drawn: |detail| detail.height.is_some(),
};
const ENVIRONMENT: Base = Base {
    key: "environment",
    name: "an environment",
    said: |material| material.environment.is_some(),
    drawn: |detail| detail.environment.is_some(),
};

impl Material {
    /// Whether it says nothing of its texture's alpha.
    pub(crate) fn ignores_alpha(&self) -> bool {
        self.blend.is_none() && self.alpha_test.is_none()
    }

    /// The keys that are given and say something of a map.
    pub(crate) fn about_maps(&self) -> impl Iterator<Item = (&'static str, Base)> {
        let keys = [
            ("normal-space", self.normal_space.is_some(), NORMALS),
            ("normal-strength", self.normal_strength.is_some(), NORMALS),
            ("relief", self.relief.is_some(), HEIGHTS),
            ("height-range", self.height_range.is_some(), HEIGHTS),
            ("environment-kind", self.environment_kind.is_some(), ENVIRONMENT),
            ("reflection", self.reflection.is_some(), ENVIRONMENT),
            ("reflection-map", self.reflection_map.is_some(), ENVIRONMENT),
        ];
        keys.into_iter().filter(|(_, given, _)| *given).map(|(key, _, base)| (key, base))
    }

    /// The first key that is given without its map, and that map's key.
    pub(crate) fn lonely(&self) -> Option<(&'static str, &'static str)> {
        self.about_maps().find(|(_, base)| !(base.said)(self)).map(|(key, base)| (key, base.key))
    }

    /// The first key that says something of the alpha of a colour map, where there is none.
    pub(crate) fn unmapped_alpha(&self) -> Option<&'static str> {
        let over = self
            .blend
            .is_some_and(|Blend(blend)| blend == alberti::raster::color::AnyBlend::Over)
            .then_some("blend");
        over.or(self.alpha_test.map(|_| "alpha-test")).filter(|_| self.color_map.is_none())
    }

    /// All maps that are given, with their keys.
    pub(crate) fn maps_mut(&mut self) -> impl Iterator<Item = (&'static str, &mut MapFile)> {
        let maps = [
            ("color-map", &mut self.color_map),
            ("normal-map", &mut self.normal_map),
            ("height-map", &mut self.height_map),
            ("ao-map", &mut self.ao_map),
            ("shininess-map", &mut self.shininess_map),
            ("wetness-map", &mut self.wetness_map),
            ("specular-map", &mut self.specular_map),
            ("emissive-map", &mut self.emissive_map),
            ("environment", &mut self.environment),
            ("reflection-map", &mut self.reflection_map),
        ];
        maps.into_iter().filter_map(|(key, map)| Some((key, map.as_mut()?)))
    }

    /// A copy of them.
    pub(crate) fn maps(&self) -> Vec<(&'static str, MapFile)> {
        self.clone().maps_mut().map(|(key, map)| (key, std::mem::take(map))).collect()
    }

    /// A texture without a colour is shown as it is.
    pub(crate) fn whiten(&mut self) {
        if self.color_map.is_some() && self.color.is_none() {
            self.color = Some(Color([1.0; 3]));
        }
    }
}

/// An image that a material names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapFile {
    /// The image's file.
    pub path: PathBuf,
    /// The place that names the file; `None` on the command line.
    pub origin: Option<Origin>,
    /// Its own filter.
    pub filter: Option<Filter>,
    /// Its own wrap mode.
    pub wrap: Option<Wrap>,
    /// A term added to its colours, from 0 to 1, after they were multiplied by the second.
    pub range: Option<[f32; 2]>,
}

/// A place in a file of text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// The file.
    pub file: PathBuf,
    /// From 1.
    pub line: usize,
    /// The key there, if lines are not enough.
    pub key: Option<String>,
    /// The text there.
    pub text: String,
}

impl MapFile {
    /// A file that the command line names.
    pub(crate) fn given(path: &Path) -> Self {
        Self { path: path.to_owned(), ..Self::default() }
    }

    /// Puts an error where the image is named, or at the image, if that is on the command line.
    pub(crate) fn place(&self, error: Error) -> Error {
        let Some(origin) = &self.origin else { return error.file(&self.path) };
        let error = error.file(&origin.file).line(origin.line);
        match &origin.key {
            Some(key) => error.key(key.as_str()),
            None => error,
        }
    }
}

/// From a word of the command line.
fn file() -> impl TypedValueParser<Value = MapFile> {
    PathBufValueParser::new().map(|path| MapFile { path, ..MapFile::default() })
}

/// From a scene file: the name of a file, or that and how it is read.
impl<'de> Deserialize<'de> for MapFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Table {
            file: String,
            filter: Option<Filter>,
            wrap: Option<Wrap>,
        }
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = MapFile;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "the name of a file, or { file = \"NAME\", filter = \"FILTER\", wrap = \"WRAP\" }",
                )
            }

            fn visit_str<E>(self, file: &str) -> Result<MapFile, E> {
                Ok(MapFile::given(Path::new(file)))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MapFile, A::Error> {
                let Table { file, filter, wrap } = Table::deserialize(MapAccessDeserializer::new(map))?;
                Ok(MapFile { filter, wrap, ..MapFile::given(Path::new(&file)) })
            }
        }
        deserializer.deserialize_any(Either)
    }
}
