//! The command line: what can be asked for, and how the words become values.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::options::{
    ColorFormat, Cull, DepthFormat, Filter, Interpolation, Numbers, Profile, Shading, Subpixel, Wrap,
};
use crate::scene::scenes;

mod material;
pub(crate) mod partners;
pub mod run;
pub(crate) mod values;

pub use material::MaterialArgs;
use values::{color, number, point, size};

/// Draws 3D models on the CPU, with perspective done right.
#[derive(Clone, Debug, Parser)]
#[command(name = "alberti", version, max_term_width = 100)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What `alberti` can do.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Draw a model, a scene file or a built-in scene into an image file.
    ///
    /// Without arguments, a built-in scene is drawn into alberti.png. A model is looked at from the front, the
    /// right and above, from where all of it is in the picture; camera options that are given replace parts of
    /// that view.
    #[command(after_help = EXAMPLES)]
    Render(Box<RenderArgs>),
}

const EXAMPLES: &str = "\
Examples:
  alberti render                                     the built-in scene, into alberti.png
  alberti render teapot.obj -o teapot.png            a model, all of it in view
  alberti render cow.obj --texture cow.png --eye 2,1,-3
  alberti render wet.toml --shading phong            a scene file, drawn with other light
  alberti render --scene floor --interpolation affine
  alberti render --scene cube --projection parallel
  alberti render --projector slide.png --projector-eye 0,2,6 --projector-target 0,1,0
  alberti render --scene floor --size 1920x1080 --stats json";

/// The options of `alberti render`. Those that are absent are left to the model or the scene.
#[derive(Clone, Debug, Default, Args)]
pub struct RenderArgs {
    /// Wavefront OBJ model to draw, with the materials and textures that it names; or a scene file, whose name ends in
    /// .toml, and which options override.
    #[arg(value_name = "MODEL.obj or SCENE.toml")]
    pub model: Option<PathBuf>,

    /// Built-in scene to draw instead of a model [default: hero].
    #[arg(long, value_name = "NAME", conflicts_with = "model", value_parser = PossibleValuesParser::new(scenes::NAMES))]
    pub scene: Option<String>,

    /// Image to write; the extension says the format: png, jpg, bmp or tga [default: alberti.png].
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Width and height of the image in pixels, each up to 16384 [default: 640x480].
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = size)]
    pub size: Option<(u32, u32)>,

    /// Colour behind the model, as hexadecimal sRGB [default: 20242c for a model].
    #[arg(long, value_name = "RRGGBB", allow_hyphen_values = true, value_parser = color)]
    pub background: Option<[u8; 3]>,

    /// Print counts and times, as a table or as one line of JSON.
    #[arg(long, value_name = "FORMAT", num_args = 0..=1, default_missing_value = "text")]
    pub stats: Option<StatsFormat>,

    /// Where the camera is [default: where all of the model is in view].
    #[arg(long, value_name = "X,Y,Z", help_heading = CAMERA, allow_hyphen_values = true, value_parser = point)]
    pub eye: Option<[f32; 3]>,

    /// The point that the camera looks at [default: the model's middle].
    #[arg(long, value_name = "X,Y,Z", help_heading = CAMERA, allow_hyphen_values = true, value_parser = point)]
    pub target: Option<[f32; 3]>,

    /// The direction that is up in the image [default: 0,1,0].
    #[arg(long, value_name = "X,Y,Z", help_heading = CAMERA, allow_hyphen_values = true, value_parser = point)]
    pub up: Option<[f32; 3]>,

    /// Vertical opening angle in degrees, from the bottom of the image to the top [default: 40].
    #[arg(long, value_name = "DEG", help_heading = CAMERA, allow_hyphen_values = true, value_parser = number)]
    pub fov: Option<f32>,

    /// Distance of the front clipping plane [default: just before the model].
    #[arg(long, value_name = "A", help_heading = CAMERA, allow_hyphen_values = true, value_parser = number)]
    pub near: Option<f32>,

    /// Distance of the back clipping plane [default: just behind the model].
    #[arg(long, value_name = "B", help_heading = CAMERA, allow_hyphen_values = true, value_parser = number)]
    pub far: Option<f32>,

    /// Perspective, or along parallel lines, where size does not tell distance [default: perspective].
    #[arg(long, value_enum, value_name = "HOW", help_heading = CAMERA)]
    pub projection: Option<Projection>,

    /// Height of what a parallel projection shows [default: that of the perspective view, at the target].
    #[arg(long, value_name = "HEIGHT", help_heading = CAMERA, allow_hyphen_values = true, value_parser = number)]
    pub view_height: Option<f32>,

    /// Image that a slide projector throws on the model; it multiplies the colours that it falls on.
    ///
    /// It needs --projector-eye and --projector-target. The image is upright and as wide as its own shape says.
    /// It falls on all that is before the projector within its pyramid, without shadows, and is read as --filter says.
    #[arg(long, value_name = "FILE", help_heading = PROJECTOR)]
    pub projector: Option<PathBuf>,

    /// Where the projector is.
    #[arg(long, value_name = "X,Y,Z", help_heading = PROJECTOR, allow_hyphen_values = true, value_parser = point)]
    pub projector_eye: Option<[f32; 3]>,

    /// The point in the middle of its image.
    #[arg(long, value_name = "X,Y,Z", help_heading = PROJECTOR, allow_hyphen_values = true, value_parser = point)]
    pub projector_target: Option<[f32; 3]>,

    /// Its opening angle in degrees, from the bottom of the image to the top [default: 40].
    #[arg(long, value_name = "DEG", help_heading = PROJECTOR, allow_hyphen_values = true, value_parser = number)]
    pub projector_fov: Option<f32>,

    /// Image to put on every surface instead of the materials' textures.
    #[arg(long, value_name = "FILE", help_heading = SURFACE)]
    pub texture: Option<PathBuf>,

    /// How textures are read: nearest, bilinear, trilinear or anisotropic:N [default: bilinear]
    ///
    /// nearest: the texel that contains the point;
    /// bilinear: a weighted mean of the four texels around the point;
    /// trilinear: a mean of that in the two nearest levels of a mip map, so that the distance does not shimmer;
    /// anisotropic:N: up to N = 2, 4, 8 or 16 of those along the direction in which the texture is squeezed most, so
    /// that it stays sharp at flat angles.
    #[arg(long, value_name = "FILTER", help_heading = SURFACE, verbatim_doc_comment, value_parser = Filter::parse)]
    pub filter: Option<Filter>,

    /// What textures show outside 0 to 1 [default: repeat].
    #[arg(long, value_enum, value_name = "WRAP", help_heading = SURFACE)]
    pub wrap: Option<Wrap>,

    /// How surfaces are coloured [default: blinn if something is said of highlights, else lambert].
    #[arg(long, value_enum, value_name = "SHADING", help_heading = SURFACE)]
    pub shading: Option<Shading>,

    /// Which triangles to leave out by the side they show [default: none].
    #[arg(long, value_enum, value_name = "SIDE", help_heading = SURFACE)]
    pub cull: Option<Cull>,

    /// Parts of every material.
    #[command(flatten)]
    pub material: MaterialArgs,

    /// A choice of all that follow, each of which overrides it [default: the scene's depth, else desktop].
    #[arg(long, value_enum, value_name = "PROFILE", help_heading = PRECISION)]
    pub profile: Option<Profile>,

    /// How vertices' data comes to pixels: exact, plane, spans:N, bounded:TEXELS or affine [default: exact]
    ///
    /// exact: right to 9 units of 2^-24, a division a pixel;
    /// plane: to tens of such units, a division a pixel but fewer operations beside it;
    /// spans:N: exact every N = 4, 8, 16 or 32 columns, straight lines between, so textures are bent a little;
    /// bounded:TEXELS: straight lines that miss no more than that much of the largest texture's texel, such as 0.0625
    /// (a projector's image has no part in this, and may be bent more);
    /// affine: straight lines across a triangle, no division, textures swim and break along edges.
    #[arg(long, value_name = "HOW", help_heading = PRECISION, verbatim_doc_comment)]
    #[arg(value_parser = Interpolation::parse)]
    pub interpolation: Option<Interpolation>,

    /// The numbers in which that is computed; fixed is for straight lines only [default: float].
    #[arg(long, value_enum, value_name = "NUMBERS", help_heading = PRECISION)]
    pub numbers: Option<Numbers>,

    /// What the depth buffer stores [default: f32].
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = PRECISION)]
    pub depth: Option<DepthFormat>,

    /// What a pixel's colour is stored as [default: rgba8].
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = PRECISION)]
    pub color: Option<ColorFormat>,

    /// Bits of a pixel's fraction to which vertices are snapped [default: 8].
    #[arg(long, value_enum, value_name = "BITS", help_heading = PRECISION)]
    pub subpixel: Option<Subpixel>,
}

const CAMERA: &str = "Camera";
const PROJECTOR: &str = "Projector";
const SURFACE: &str = "Surface";
const PRECISION: &str = "Precision";

/// How space comes to the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Projection {
    /// What is farther away is smaller.
    Perspective,
    /// What is parallel stays parallel; straight lines unless --interpolation says otherwise, as they are exact then.
    Parallel,
}

/// How counts and times are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StatsFormat {
    /// A table, after the summary.
    Text,
    /// One line of JSON, and nothing else on standard output.
    Json,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_declaration_is_consistent() {
        use clap::CommandFactory as _;
        Cli::command().debug_assert();
    }
}
