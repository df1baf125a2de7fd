//! The command line: what can be asked for, and how the words become values.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::options::{
    ColorFormat, Cull, DepthFormat, Filter, Interpolation, MAX_SIDE, Numbers, Profile, Shading, Subpixel,
    Wrap,
};
use crate::scenes;

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
    /// Draw a model or a built-in scene into an image file.
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
  alberti render --scene floor --interpolation affine
  alberti render --scene cube --projection parallel
  alberti render --projector slide.png --projector-eye 0,2,6 --projector-target 0,1,0
  alberti render --scene floor --size 1920x1080 --stats json";

/// The options of `alberti render`. Those that are absent are left to the model or the scene.
#[derive(Clone, Debug, Args)]
pub struct RenderArgs {
    /// Wavefront OBJ model to draw; materials and textures are found beside it.
    #[arg(value_name = "MODEL.obj")]
    pub model: Option<PathBuf>,

    /// Built-in scene to draw instead of a model [default: hero].
    #[arg(long, value_name = "NAME", conflicts_with = "model", value_parser = PossibleValuesParser::new(scenes::NAMES))]
    pub scene: Option<String>,

    /// Image to write; the extension says the format: png, jpg, bmp or tga.
    #[arg(short, long, value_name = "FILE", default_value = "alberti.png")]
    pub output: PathBuf,

    /// Width and height of the image in pixels, each up to 16384.
    #[arg(long, value_name = "WxH", default_value = "640x480", allow_hyphen_values = true, value_parser = size)]
    pub size: (u32, u32),

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

    /// How textures are read between their texels [default: bilinear].
    #[arg(long, value_enum, value_name = "FILTER", help_heading = SURFACE)]
    pub filter: Option<Filter>,

    /// What textures show outside 0 to 1 [default: repeat].
    #[arg(long, value_enum, value_name = "WRAP", help_heading = SURFACE)]
    pub wrap: Option<Wrap>,

    /// How surfaces are coloured [default: lambert].
    #[arg(long, value_enum, value_name = "SHADING", help_heading = SURFACE)]
    pub shading: Option<Shading>,

    /// Which triangles to leave out by the side they show [default: none].
    #[arg(long, value_enum, value_name = "SIDE", help_heading = SURFACE)]
    pub cull: Option<Cull>,

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
    #[arg(long, value_name = "HOW", help_heading = PRECISION, verbatim_doc_comment, value_parser = Interpolation::parse)]
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

fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    sides
        .filter(|(w, h)| (1..=MAX_SIDE).contains(w) && (1..=MAX_SIDE).contains(h))
        .ok_or_else(|| format!("WIDTHxHEIGHT with 1 to {MAX_SIDE} pixels each, such as 640x480"))
}

fn point(text: &str) -> Result<[f32; 3], String> {
    let expected = || "three finite numbers X,Y,Z without spaces, such as 0,1.5,-3".to_owned();
    let numbers: Vec<f32> = text.split(',').map(finite).collect::<Option<_>>().ok_or_else(expected)?;
    numbers.try_into().map_err(|_| expected())
}

fn number(text: &str) -> Result<f32, String> {
    finite(text).ok_or_else(|| "a finite number".to_owned())
}

fn finite(text: &str) -> Option<f32> {
    text.trim().parse().ok().filter(|x: &f32| x.is_finite())
}

fn color(text: &str) -> Result<[u8; 3], String> {
    let digits = text.strip_prefix('#').unwrap_or(text);
    let value = u32::from_str_radix(digits, 16).ok();
    // from_str_radix takes a sign as well.
    let value = value.filter(|_| digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit()));
    let [_, r, g, b] = value.ok_or("six hexadecimal digits RRGGBB, such as 20242c")?.to_be_bytes();
    Ok([r, g, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_declaration_is_consistent() {
        use clap::CommandFactory as _;
        Cli::command().debug_assert();
    }

    #[test]
    fn values_are_read() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert_eq!(size("16384X1"), Ok((16384, 1)));
        assert_eq!(point("-1,2.5,3e2"), Ok([-1.0, 2.5, 300.0]));
        assert_eq!(color("20242c"), Ok([0x20, 0x24, 0x2c]));
        assert_eq!(color("#FFffFF"), Ok([255; 3]));
    }

    #[test]
    fn what_is_no_value_is_refused() {
        for text in ["", "640", "0x480", "640x0", "100000x100000", "16385x1", "-1x5", "axb", "1x2x3"] {
            assert!(size(text).is_err(), "{text}");
        }
        for text in ["", "1,2", "1,2,3,4", "1,2,x", "nan,0,0", "inf,0,0", "1e400,0,0"] {
            assert!(point(text).is_err(), "{text}");
        }
        for text in ["", "fff", "gggggg", "+12345", "-12345", "1234567", "ééé"] {
            assert!(color(text).is_err(), "{text}");
        }
        assert!(number("nan").is_err() && number("1e400").is_err());
    }
}
