//! The options, each written once: scene files have a table for each group, the command line a heading.
//!
//! A field is a key of the table, in kebab case, and an option of that name. An option with another name has it in
//! `long`, and the table's name before its own in `id`, where that alone would not be unique.

use std::path::PathBuf;

use clap::builder::Resettable;
use clap::{Args, Command};
use serde::{Deserialize, Deserializer};

use super::values::{Color, Finite, Number, Point, Size};
use super::{
    Arithmetic, ColorFormat, Cull, DepthFormat, Dither, Filter, Fog, Interpolation, Lod, Policies, Profile,
    ProjectionKind, Shading, Subpixel, Wrap,
};
use crate::error::Error;

/// `[camera]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Args, Deserialize)]
#[command(next_help_heading = "Camera")]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct CameraTable {
    /// Where the camera is [default: where all of the model is in view].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub eye: Option<Point>,

    /// The point that the camera looks at [default: the model's middle].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub target: Option<Point>,

    /// The direction that is up in the image [default: 0,1,0].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub up: Option<Point>,

    /// Vertical opening angle in degrees, from the bottom of the image to the top [default: 40].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub fov: Option<Number<Finite>>,

    /// Distance of the front clipping plane [default: just before the model].
    #[arg(long, value_name = "A", allow_hyphen_values = true)]
    pub near: Option<Number<Finite>>,

    /// Distance of the back clipping plane [default: just behind the model].
    #[arg(long, value_name = "B", allow_hyphen_values = true)]
    pub far: Option<Number<Finite>>,

    /// Perspective, or along parallel lines, where size does not tell distance [default: perspective].
    #[arg(long, value_enum, value_name = "HOW")]
    pub projection: Option<ProjectionKind>,

    /// Height that a parallel projection shows [default: that of the perspective view, at the target].
    #[arg(long, value_name = "HEIGHT", allow_hyphen_values = true)]
    pub view_height: Option<Number<Finite>>,
}

impl CameraTable {
    /// Whether the projection is parallel.
    #[must_use]
    pub fn is_parallel(&self) -> bool {
        self.projection == Some(ProjectionKind::Parallel)
    }
}

/// `[projector]`.
#[derive(Clone, Debug, Default, PartialEq, Args, Deserialize)]
#[command(next_help_heading = "Projector")]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct ProjectorTable {
    /// Image that a slide projector throws on the model; it multiplies the colours that it falls on.
    ///
    /// It needs --projector-eye and --projector-target. The image is upright and as wide as its own shape says.
    /// It falls on all that is before the projector within its pyramid, without shadows, and is read as --filter says.
    #[arg(id = "projector-image", long = "projector", value_name = "FILE")]
    #[serde(deserialize_with = "file")]
    pub image: Option<PathBuf>,

    /// Where the projector is.
    #[arg(id = "projector-eye", long = "projector-eye", value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub eye: Option<Point>,

    /// The point in the middle of its image.
    #[arg(
        id = "projector-target",
        long = "projector-target",
        value_name = "X,Y,Z",
        allow_hyphen_values = true
    )]
    pub target: Option<Point>,

    /// Its opening angle in degrees, from the bottom of the image to the top [default: 40].
    #[arg(id = "projector-fov", long = "projector-fov", value_name = "DEG", allow_hyphen_values = true)]
    pub fov: Option<Number<Finite>>,
}

impl ProjectorTable {
    /// # Errors
    /// Some of it, but not all that a projector needs.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let together = [
            ("--projector", self.image.is_some()),
            ("--projector-eye", self.eye.is_some()),
            ("--projector-target", self.target.is_some()),
        ];
        let names = |with: bool| together.into_iter().filter(move |o| o.1 == with).map(|o| o.0);
        let missing = names(false).collect::<Vec<_>>().join(" and ");
        match names(true).next().or(self.fov.map(|_| "--projector-fov")) {
            Some(option) if !missing.is_empty() => {
                let expected = format!("all three of {}", together.map(|o| o.0).join(", "));
                Err(Error::new(format!("it without {missing}"), expected).place(option))
            }
            _ => Ok(()),
        }
    }
}

/// `[render]`; its first three keys may stand at the top of a scene file as well.
#[derive(Clone, Debug, Default, PartialEq, Args, Deserialize)]
#[command(next_help_heading = Resettable::Reset)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct RenderTable {
    /// Image to write; the extension says the format: png, jpg, bmp or tga [default: alberti.png].
    #[arg(short, long, value_name = "FILE")]
    #[serde(deserialize_with = "file")]
    pub output: Option<PathBuf>,

    /// Width and height of the image in pixels, each up to 16384 [default: 640x480].
    #[arg(short, long, value_name = "WxH", allow_hyphen_values = true)]
    pub size: Option<Size>,

    /// Colour behind the model, as hexadecimal sRGB [default: 20242c for a model].
    #[arg(long, value_name = "RRGGBB", allow_hyphen_values = true)]
    pub background: Option<Color>,

    /// How textures are read: nearest, bilinear, trilinear or anisotropic:N [default: bilinear]
    ///
    /// nearest: the texel that contains the point.
    /// bilinear: a weighted mean of the four texels around the point.
    /// trilinear: a mean of that in two levels of a mip map, so that the distance does not shimmer.
    /// anisotropic:N: up to N = 2, 4, 8 or 16 of those side by side; sharp at flat angles too.
    #[arg(long, value_name = "FILTER", help_heading = SURFACE, verbatim_doc_comment)]
    pub filter: Option<Filter>,

    /// Continuation of textures outside 0 to 1 [default: repeat].
    #[arg(long, value_enum, value_name = "WRAP", help_heading = SURFACE)]
    pub wrap: Option<Wrap>,

    /// How surfaces are coloured [default: blinn if something is said of highlights, else lambert].
    #[arg(long, value_enum, value_name = "SHADING", help_heading = SURFACE)]
    pub shading: Option<Shading>,

    /// Which triangles to leave out by the side they show [default: none].
    #[arg(long, value_enum, value_name = "SIDE", help_heading = SURFACE)]
    pub cull: Option<Cull>,

    /// Fog, by distances before the camera: none, linear:START,END, exp:DENSITY or exp2:DENSITY [default: none]
    ///
    /// linear: from none at START to nothing else at END.
    /// exp: a haze, 1 - e^(-DENSITY z). exp2: one that begins softly, 1 - e^(-(DENSITY z)^2).
    #[arg(long, value_name = "FOG", allow_hyphen_values = true, help_heading = SURFACE, verbatim_doc_comment)]
    pub fog: Option<Fog>,

    /// Colour of the fog; needs --fog [default: the background's].
    #[arg(long, value_name = "RRGGBB", allow_hyphen_values = true, help_heading = SURFACE)]
    pub fog_color: Option<Color>,

    /// A choice of all that follow, each of which overrides it [default: the scene's depth, else desktop].
    #[arg(long, value_enum, value_name = "PROFILE", help_heading = PRECISION)]
    pub profile: Option<Profile>,

    /// How vertices' data comes to pixels: exact, plane, spans:N, bounded:TEXELS or affine [default: exact]
    ///
    /// exact: right to 9 units of 2^-24, a division a pixel.
    /// plane: to tens of such units, a division a pixel but fewer operations beside it.
    /// spans:N: exact every N = 4, 8, 16 or 32 columns, straight lines between.
    /// bounded:TEXELS: straight lines that miss at most so much of a texel, such as 0.0625.
    /// affine: straight lines across a triangle, no division; textures break along edges.
    #[arg(long, value_name = "HOW", help_heading = PRECISION, verbatim_doc_comment)]
    pub interpolation: Option<Interpolation>,

    /// The arithmetic by which that is computed; fixed is for straight lines only [default: float].
    #[arg(long, value_enum, value_name = "ARITHMETIC", help_heading = PRECISION)]
    pub arithmetic: Option<Arithmetic>,

    /// Format of the depth buffer [default: f32].
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = PRECISION)]
    pub depth: Option<DepthFormat>,

    /// Format of a pixel's colour [default: rgba8].
    #[arg(long = "color", value_enum, value_name = "FORMAT", help_heading = PRECISION)]
    pub color_format: Option<ColorFormat>,

    /// Rounding of colours that the format lies between, also of those of baked textures [default: none].
    #[arg(long, value_enum, value_name = "PATTERN", help_heading = PRECISION)]
    pub dither: Option<Dither>,

    /// Bits of a pixel's fraction to which vertices are snapped [default: 8].
    #[arg(long, value_enum, value_name = "BITS", help_heading = PRECISION)]
    pub subpixel: Option<Subpixel>,

    /// Where levels of detail are found, for trilinear and anisotropic filters [default: pixel].
    #[arg(long, value_enum, value_name = "WHERE", help_heading = PRECISION)]
    pub lod: Option<Lod>,
}

/// The heading of options of surfaces.
pub(super) const SURFACE: &str = "Surface";
const PRECISION: &str = "Precision";

impl RenderTable {
    /// The profile with its overrides; no depth where neither says one. Of a parallel projection straight lines are
    /// exact, and the cheapest.
    #[must_use]
    pub fn policies(&self, parallel: bool) -> (Policies, Option<DepthFormat>) {
        let (profile, depth) = self.profile.map(Profile::policies).unzip();
        let profile = profile.unwrap_or_default();
        let straight = if parallel { Interpolation::Affine } else { profile.interpolation };
        let policies = Policies {
            interpolation: self.interpolation.unwrap_or(straight),
            arithmetic: self.arithmetic.unwrap_or(profile.arithmetic),
            color: self.color_format.unwrap_or(profile.color),
            dither: self.dither.unwrap_or(profile.dither),
            subpixel: self.subpixel.unwrap_or(profile.subpixel),
            lod: self.lod.unwrap_or(profile.lod),
        };
        (policies, self.depth.or(depth))
    }
}

/// The name of a file in a scene file.
fn file<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<PathBuf>, D::Error> {
    String::deserialize(deserializer).map(|name| Some(name.into()))
}

/// An option that scene files have as well.
#[derive(Clone, Debug)]
pub(crate) struct Shared {
    /// Its identity on the command line.
    pub(crate) id: String,
    /// With hyphens before it.
    pub(crate) option: String,
    /// With its table.
    pub(crate) key: String,
}

impl Shared {
    /// The key at the top of a file, without its table, if it may stand there.
    pub(crate) fn at_top(&self) -> Option<&str> {
        let key = self.key.strip_prefix("render.")?;
        ["output", "size", "background"].contains(&key).then_some(key)
    }
}

/// All options that scene files have as well.
pub(crate) fn shared() -> Vec<Shared> {
    let tables = [
        ("camera", CameraTable::augment_args(Command::new(""))),
        ("projector", ProjectorTable::augment_args(Command::new(""))),
        ("render", RenderTable::augment_args(Command::new(""))),
    ];
    let of_table = |(table, command): &(&str, Command)| {
        let options = command.get_arguments().filter_map(|argument| {
            let id = argument.get_id().to_string();
            let field = id.strip_prefix(&format!("{table}-")).unwrap_or(&id).replace('_', "-");
            Some(Shared {
                option: format!("--{}", argument.get_long()?),
                key: format!("{table}.{field}"),
                id,
            })
        });
        options.collect::<Vec<_>>()
    };
    tables.iter().flat_map(of_table).collect()
}
