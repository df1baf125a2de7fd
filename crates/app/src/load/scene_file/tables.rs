//! The tables of a scene file, as they stand there. The README says what each key means.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::values::{
    Factor, Finite, HalfAngle, Intensity, Length, MapEntry, Named, Number, Numbers, OneOrMore, Place, Share,
    Shininess, Side, Strength, Text,
};
use crate::cli::Projection;
use crate::options::{
    ColorFormat, Cull, DepthFormat, Filter, Interpolation, Numbers as NumberKind, Profile, Shading, Subpixel,
    Wrap,
};
use crate::scene::{EnvironmentKind, NormalSpace, Relief};

/// A value, if there is one, and where it stands.
pub(super) type At<T> = Option<Spanned<T>>;

type Color = Text<[u8; 3]>;

/// The whole file.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub(super) struct File {
    pub(super) size: At<Numbers<2, Side>>,
    pub(super) background: At<Color>,
    pub(super) output: At<String>,
    pub(super) camera: Camera,
    pub(super) projector: Projector,
    pub(super) render: Render,
    pub(super) object: Vec<Spanned<Object>>,
    pub(super) material: BTreeMap<String, Spanned<Material>>,
    pub(super) ambient: Option<Ambient>,
    pub(super) light: Vec<Spanned<Light>>,
}

/// `[camera]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub(super) struct Camera {
    pub(super) eye: At<Numbers<3>>,
    pub(super) target: At<Numbers<3>>,
    pub(super) up: At<Numbers<3>>,
    pub(super) fov: At<Number<Finite>>,
    pub(super) near: At<Number<Finite>>,
    pub(super) far: At<Number<Finite>>,
    pub(super) projection: At<Text<Named<Projection>>>,
    pub(super) view_height: At<Number<Finite>>,
}

/// `[projector]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub(super) struct Projector {
    pub(super) image: At<String>,
    pub(super) eye: At<Numbers<3>>,
    pub(super) target: At<Numbers<3>>,
    pub(super) fov: At<Number<Finite>>,
}

/// `[render]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub(super) struct Render {
    pub(super) size: At<Numbers<2, Side>>,
    pub(super) background: At<Color>,
    pub(super) output: At<String>,
    pub(super) shading: At<Text<Named<Shading>>>,
    pub(super) filter: At<Text<Filter>>,
    pub(super) wrap: At<Text<Named<Wrap>>>,
    pub(super) cull: At<Text<Named<Cull>>>,
    pub(super) depth: At<Text<Named<DepthFormat>>>,
    pub(super) profile: At<Text<Named<Profile>>>,
    pub(super) interpolation: At<Text<Interpolation>>,
    pub(super) numbers: At<Text<Named<NumberKind>>>,
    pub(super) color_format: At<Text<Named<ColorFormat>>>,
    pub(super) subpixel: At<Text<Named<Subpixel>>>,
}

/// `[[object]]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub(super) struct Object {
    pub(super) model: At<String>,
    pub(super) surface: At<Text<Named<SurfaceKind>>>,
    pub(super) segments: At<Numbers<2, Side>>,
    pub(super) size: At<Numbers<2, Length>>,
    pub(super) radius: At<Number<Length>>,
    pub(super) radii: At<Numbers<2, Length>>,
    pub(super) height: At<Number<Length>>,
    pub(super) position: At<Numbers<3, Place>>,
    pub(super) rotation: At<Numbers<3, Place>>,
    pub(super) scale: At<OneOrMore<3, Factor>>,
    pub(super) material: At<String>,
}

/// What `surface` may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum SurfaceKind {
    Plane,
    Sphere,
    Torus,
    Cylinder,
}

/// `[material.NAME]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub(super) struct Material {
    pub(super) color: At<Color>,
    pub(super) color_map: At<MapEntry>,
    pub(super) normal_map: At<MapEntry>,
    pub(super) normal_space: At<Text<Named<NormalSpace>>>,
    pub(super) normal_strength: At<Number<Strength>>,
    pub(super) height_map: At<MapEntry>,
    pub(super) relief: At<Text<Named<Relief>>>,
    pub(super) height_range: At<Numbers<2, Place>>,
    pub(super) ao_map: At<MapEntry>,
    pub(super) wetness: At<Number<Share>>,
    pub(super) wetness_map: At<MapEntry>,
    pub(super) specular: At<Color>,
    pub(super) specular_map: At<MapEntry>,
    pub(super) shininess: At<Shininess>,
    pub(super) shininess_map: At<MapEntry>,
    pub(super) emissive: At<Color>,
    pub(super) emissive_map: At<MapEntry>,
    pub(super) environment: At<MapEntry>,
    pub(super) environment_kind: At<Text<Named<EnvironmentKind>>>,
    pub(super) reflection: At<Number<Share>>,
    pub(super) reflection_map: At<MapEntry>,
    pub(super) filter: At<Text<Filter>>,
    pub(super) wrap: At<Text<Named<Wrap>>>,
    pub(super) uv_scale: At<OneOrMore<2, Length>>,
}

/// `[ambient]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub(super) struct Ambient {
    pub(super) color: At<Color>,
    pub(super) intensity: At<Number<Intensity>>,
}

/// `[[light]]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub(super) struct Light {
    pub(super) kind: At<Text<Named<LightKind>>>,
    pub(super) direction: At<Numbers<3, Place>>,
    pub(super) position: At<Numbers<3, Place>>,
    pub(super) target: At<Numbers<3, Place>>,
    pub(super) color: At<Color>,
    pub(super) intensity: At<Number<Intensity>>,
    pub(super) angle: At<OneOrMore<2, HalfAngle>>,
    pub(super) range: At<Number<Length>>,
}

/// What `kind` may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum LightKind {
    Directional,
    Point,
    Spot,
}
