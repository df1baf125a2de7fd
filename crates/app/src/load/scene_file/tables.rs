//! The tables of a scene file that the command line has no options for. The README says what each key means.

use std::collections::BTreeMap;

use clap::ValueEnum;
use serde::Deserialize;

use super::animation::Easing;
use crate::options::values::{
    Color, Finite, HalfAngle, Intensity, Length, Number, Place, Scale, Side, Size, Tuple, one_of, words,
};
use crate::options::{Background, CameraTable, Material, Normals, ProjectorTable, RenderTable};

/// The whole file.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct File {
    pub(super) size: Option<Size>,
    pub(super) background: Option<Background>,
    pub(super) output: Option<String>,
    pub(super) camera: CameraTable,
    pub(super) projector: ProjectorTable,
    pub(super) render: RenderTable,
    pub(super) object: Vec<Object>,
    pub(super) material: BTreeMap<String, Material>,
    pub(super) ambient: Option<Ambient>,
    pub(super) light: Vec<Light>,
    pub(super) animation: Vec<Animation>,
}

/// `[[object]]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Object {
    pub(super) name: Option<String>,
    pub(super) model: Option<String>,
    pub(super) normals: Option<Normals>,
    pub(super) surface: Option<SurfaceKind>,
    pub(super) segments: Option<Tuple<2, Side>>,
    pub(super) size: Option<Tuple<2, Length>>,
    pub(super) radius: Option<Number<Length>>,
    pub(super) radii: Option<Tuple<2, Length>>,
    pub(super) height: Option<Number<Length>>,
    pub(super) position: Option<Tuple<3, Place>>,
    pub(super) rotation: Option<Tuple<3, Place>>,
    pub(super) scale: Option<Tuple<3, Scale>>,
    pub(super) material: Option<String>,
}

/// The values of `surface`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum SurfaceKind {
    Plane,
    Sphere,
    Torus,
    Cylinder,
}

/// `[ambient]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Ambient {
    pub(super) color: Option<Color>,
    pub(super) intensity: Option<Number<Intensity>>,
}

/// `[[light]]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Light {
    pub(super) name: Option<String>,
    pub(super) kind: Option<LightKind>,
    pub(super) direction: Option<Tuple<3, Place>>,
    pub(super) position: Option<Tuple<3, Place>>,
    pub(super) target: Option<Tuple<3, Place>>,
    pub(super) color: Option<Color>,
    pub(super) intensity: Option<Number<Intensity>>,
    pub(super) angle: Option<Tuple<2, HalfAngle>>,
    pub(super) range: Option<Number<Length>>,
}

/// `[[animation]]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Animation {
    pub(super) of: Option<String>,
    pub(super) key: Option<String>,
    pub(super) times: Option<Vec<Number<Finite>>>,
    pub(super) values: Option<Vec<toml::Value>>,
    pub(super) easing: Option<Easing>,
    pub(super) repeat: Option<bool>,
}

/// The values of `kind`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum LightKind {
    Directional,
    Point,
    Spot,
}

words!(one_of: SurfaceKind, LightKind);
