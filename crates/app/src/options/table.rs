//! The options, each written once: scene files have a table for each group, the command line a heading.
//!
//! A field is a key of the table, in kebab case, and an option of that name. An option with another name has it in
//! `long`, and the table's name before its own in `id`, where that alone would not be unique.

use std::path::PathBuf;

use clap::builder::Resettable;
use clap::{Args, Command};
use serde::{Deserialize, Deserializer};

use super::values::{Color, Elevation, Finite, Number, Point, Size, Strength, Zoom, name_of, truth};
use super::{
    AovFormat, Aovs, Arithmetic, Background, ColorFormat, Cull, DepthFormat, Dither, FileFormat, Filter, Fog,
    Interpolation, KeyLight, LightSpace, Lod, Normals, Policies, Profile, ProjectionKind, Samples, Shading,
    Subpixel, ViewSide, Wrap,
};
use crate::error::{Error, number};
use crate::memory::Memory;
use crate::scene::camera;

/// `[camera]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Args, Deserialize)]
#[command(next_help_heading = "Camera")]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct CameraTable {
    /// Where the camera is [default: where all of the model is in view].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub eye: Option<Point>,

    /// The point that the camera looks at [default: the middle of what is seen of the model; with --eye,
    /// of the model].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub target: Option<Point>,

    /// The direction that is up in the world, or an axis such as z: lights and the ground follow it
    /// [default: 0,1,0].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = upwards)]
    pub up: Option<Point>,

    /// Degrees around the model, from the front to the right; instead of --eye [default: 30; of a
    /// scene's own camera, its].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub azimuth: Option<Number<Finite>>,

    /// Degrees above the model, -90 to 90; instead of --eye [default: 25; of a scene's own camera,
    /// its].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub elevation: Option<Number<Elevation>>,

    /// The side that is seen; instead of --eye, and of --azimuth, --elevation or, of iso, both.
    #[arg(long, value_enum, value_name = "SIDE")]
    pub view: Option<ViewSide>,

    /// Degrees by which the camera leans to the right [default: 0].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub roll: Option<Number<Finite>>,

    /// Factor by which things are larger in the picture, above 1 about the middle of the model, or a
    /// target that is given; it narrows the opening angle [default: 1].
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true)]
    pub zoom: Option<Number<Zoom>>,

    /// Vertical opening angle in degrees, from the bottom of the image to the top [default: 40; less in
    /// pictures wider than 16:9, unless --eye is given].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub fov: Option<Number<Finite>>,

    /// Distance of the front clipping plane [default: just before the model, or what is nearest in the picture].
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

/// A direction, or an axis that has a name.
pub(crate) fn upwards(text: &str) -> Result<Point, String> {
    let (name, sign) = text.strip_prefix('-').map_or((text, 1.0), |name| (name, -1.0));
    let axis = match name {
        "x" | "X" => [sign, 0.0, 0.0],
        "y" | "Y" => [0.0, sign, 0.0],
        "z" | "Z" => [0.0, 0.0, sign],
        _ => return text.parse().map_err(|error| format!("{error}, or one of x, y, z, -x, -y, -z")),
    };
    Ok(axis.into())
}

impl CameraTable {
    /// The same, counted from `origin`.
    #[must_use]
    pub(crate) fn counted_from(self, origin: [f64; 3]) -> Self {
        let [eye, target] =
            [self.eye, self.target].map(|point| point.map(|point| point.counted_from(origin)));
        Self { eye, target, ..self }
    }

    /// Whether the projection is parallel.
    #[must_use]
    pub fn is_parallel(&self) -> bool {
        self.projection == Some(ProjectionKind::Parallel)
    }

    /// Whether it says from which side the model is seen, instead of an eye.
    pub(crate) fn turns(&self) -> bool {
        self.azimuth.is_some() || self.elevation.is_some() || self.view.is_some()
    }

    /// The factor of sizes in the picture.
    pub(crate) fn zoom(&self) -> f32 {
        self.zoom.map_or(1.0, f32::from)
    }

    /// Leaves the place of the eye open, and the planes before it, for `given` options that say it in another way. One
    /// angle leaves the other, and what it has of a side. The eye and the target are handed back.
    pub(crate) fn forget_place(&mut self, given: &Self) -> Self {
        let Self { eye, target, azimuth, elevation, view, .. } = *self;
        let turned = given.eye.is_none() && given.view.is_none();
        let (azimuth, elevation) = (azimuth.filter(|_| turned), elevation.filter(|_| turned));
        let mut view = view.filter(|_| turned);
        let (mut azimuth, mut elevation) = (azimuth, elevation);
        if let Some([around, above]) = view.filter(|_| given.turns()).and_then(ViewSide::angles) {
            // It is said by angles, of which one may be another.
            (view, azimuth, elevation) =
                (None, azimuth.or(Some(around.into())), elevation.or(Some(above.into())));
        }
        *self = Self { eye: None, azimuth, elevation, view, near: None, far: None, ..*self };
        Self { eye, target, ..Self::default() }
    }

    /// # Errors
    /// A number that no camera has, whatever it looks at.
    pub(crate) fn check_numbers(&self) -> Result<(), Error> {
        self.fov.map_or(Ok(()), |fov| camera::check_fov(fov.into(), &camera::CAMERA))?;
        match (self.eye, self.target) {
            (Some(eye), Some(target)) if eye == target => {
                let [x, y, z] = <[f32; 3]>::from(eye).map(number);
                let found = format!("the eye and its target both at {x},{y},{z}");
                Err(Error::new(found, "two points").place("--eye").hint("move --eye or --target"))
            }
            _ => Ok(()),
        }
    }

    /// The same of a camera that moves, before anything is drawn.
    ///
    /// # Errors
    /// A number that no camera has, whatever it looks at.
    pub(crate) fn check_moving(&self) -> Result<(), Error> {
        self.check_numbers()?;
        if let Some(up) = self.up.map(<[f32; 3]>::from).filter(|up| *up == [0.0; 3]) {
            let error =
                Error::new(format!("the direction {}", up.map(number).join(",")), "one above 0 in length");
            return Err(error.place("--up"));
        }
        let near = self.near.map(f32::from);
        if let Some(near) = near.filter(|near| *near <= 0.0 && !self.is_parallel()) {
            return Err(
                Error::new(format!("near {}", number(near)), "a finite number above 0").place("--near")
            );
        }
        match near.zip(self.far.map(f32::from)) {
            Some((near, far)) if near >= far => {
                let found = format!("near {} and far {}", number(near), number(far));
                Err(Error::new(found, "near < far").place("--near"))
            }
            _ => Ok(()),
        }
    }

    /// # Errors
    /// The place of the eye is said in two ways.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let angle = self.azimuth.map(|_| "--azimuth").or(self.elevation.map(|_| "--elevation"));
        let eye = self.eye.map(|_| "--eye");
        let view = self.view.map(|_| "--view");
        let twice = match (view.or(angle), eye) {
            (Some(option), Some(eye)) => Some((option, eye.to_owned())),
            // A side is one of the two angles, and leaves the other to be said.
            _ => match self.view {
                Some(ViewSide::Top | ViewSide::Bottom) => self.elevation.map(|_| "--elevation"),
                Some(ViewSide::Iso) => angle,
                None => None,
                Some(_) => self.azimuth.map(|_| "--azimuth"),
            }
            .map(|option| (option, format!("--view {}", self.view.map(name_of).unwrap_or_default()))),
        };
        match twice {
            Some((option, other)) => {
                let found = format!("it with {other}, which says where the camera is as well");
                Err(Error::new(found, "one of the two").place(option))
            }
            None => Ok(()),
        }
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
    /// Image to write, and its folders; the extension says the format: png, jpg, bmp, tga, webp, qoi or ppm; - is
    /// standard output [default: alberti.png].
    #[arg(short, long, value_name = "FILE")]
    #[serde(deserialize_with = "file")]
    pub output: Option<PathBuf>,

    /// Format of the image, whatever its extension [default: of standard output png].
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub output_format: Option<FileFormat>,

    /// Numbers of what pixels show, in files beside the picture: depth, normal, uv, id and lod, with commas between.
    ///
    /// Beside x.png are x.depth.png, x.normal.png and so on, or x.exr with all of them. Numbers are those in the middle
    /// of a pixel, whatever --samples says, and exact, whatever --interpolation says.
    #[arg(long, value_name = "WHAT")]
    pub aov: Option<Aovs>,

    /// Format of --aov: png16 or exr [default: png16]
    ///
    /// png16: PNG of 16 bits a channel. The summary says how to get the numbers back.
    /// exr: one OpenEXR file of 32 bits a channel, with the picture as RGBA in linear light.
    /// Its layers are Z in units of the scene, N in world space, UV, id and lod.
    #[arg(long, value_enum, value_name = "FORMAT", hide_possible_values = true, verbatim_doc_comment)]
    pub aov_format: Option<AovFormat>,

    /// Width and height in pixels, each up to 16384 [default: 640x480].
    #[arg(short, long, value_name = "WxH", allow_hyphen_values = true)]
    pub size: Option<Size>,

    /// Memory that all may take at a time, in bytes or with K, M or G: more is an error [default: what is free].
    ///
    /// It is estimated before it is taken: of the picture with its samples, of models, of images and their mip maps.
    #[arg(long, value_name = "BYTES", allow_hyphen_values = true)]
    pub memory: Option<Memory>,

    /// Background: a colour (RRGGBB, RGB or a name), transparent, a gradient TOP..BOTTOM, or an image file
    /// [default: 20242c for a model, with --ground a8b0b8].
    #[arg(long, value_name = "WHAT", allow_hyphen_values = true)]
    pub background: Option<Background>,

    /// Samples a pixel, averaged in linear light: 4 and 16 smooth edges [default: 4; with --profile mcu or tiny 1].
    ///
    /// `explain`, `advise`, `bake` and --show have one.
    #[arg(long, value_enum, value_name = "N", hide_possible_values = true)]
    pub samples: Option<Samples>,

    /// How textures are read: nearest, bilinear, trilinear or anisotropic:N [default:
    /// trilinear; with --profile mcu or tiny bilinear; of a built-in scene its own]
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

    /// How surfaces get normals: smooth, flat, crease or crease:DEG; overrides the model's own [default: its own]
    ///
    /// smooth: one normal at each position, so that no edge is seen.
    /// flat: one for each face, so that every edge is seen.
    /// crease:DEG: edges at which faces turn by DEG degrees or more are sharp, 0 to 180; 60 without a number.
    /// The model's own: its `vn`, else its smoothing groups (`s`), else crease:60.
    #[arg(long, value_name = "HOW", help_heading = SURFACE, verbatim_doc_comment)]
    pub normals: Option<Normals>,

    /// Whether surfaces that are seen from behind are lit as if they faced the viewer [default: true].
    #[arg(long, value_name = "true|false", value_parser = truth(), help_heading = SURFACE)]
    pub two_sided: Option<bool>,

    /// Direction of the main light of a model without lights, as lamp or two angles [default: -35,50].
    ///
    /// Angles are degrees to the right of the camera and above the horizon, or above the camera where that looks up. A
    /// fill and a rim light turn with it. lamp is one light beside the camera, as built-in scenes have it.
    #[arg(long, value_name = "AZ,EL", allow_hyphen_values = true, help_heading = SURFACE)]
    pub light: Option<KeyLight>,

    /// Space in which light is added up: bytes of sRGB as they are, or amounts of light [default: srgb].
    ///
    /// In linear, colours are decoded from sRGB, and the sum is tone-mapped, so that highlights keep their shape, and
    /// encoded. Files of `bake` do not have it.
    #[arg(long, value_enum, value_name = "SPACE", help_heading = SURFACE)]
    pub light_space: Option<LightSpace>,

    /// Factor of all light, 0 to 100: of a scene's own lights too, and of what comes from all sides [default: 1].
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true, help_heading = SURFACE)]
    pub brightness: Option<Number<Strength>>,

    /// A ground with a soft shadow at the lowest point, in pictures alone.
    ///
    /// The shadow is that of a sky, wherever --light is.
    #[arg(long, value_name = "true|false", num_args = 0..=1, require_equals = true, default_missing_value = "true", value_parser = truth(), help_heading = SURFACE)]
    pub ground: Option<bool>,

    /// Fog, by distances before the camera: none, linear:START,END, exp:DENSITY or exp2:DENSITY [default: none]
    ///
    /// linear: from none at START to nothing else at END.
    /// exp: a haze, 1 - e^(-DENSITY z). exp2: one that begins softly, 1 - e^(-(DENSITY z)^2).
    #[arg(long, value_name = "FOG", allow_hyphen_values = true, help_heading = SURFACE, verbatim_doc_comment)]
    pub fog: Option<Fog>,

    /// Colour of the fog; needs --fog [default: the background's].
    #[arg(long, value_name = "COLOR", allow_hyphen_values = true, help_heading = SURFACE)]
    pub fog_color: Option<Color>,

    /// A choice of all that follow, each of which overrides it [default: the scene's depth, else desktop].
    ///
    /// With mcu and tiny, --filter is bilinear and --samples 1 unless they are given.
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
