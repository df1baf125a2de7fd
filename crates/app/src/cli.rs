//! The command line: the options that scene files have as well ([`crate::options`]), and its own.

use crate::options::values::{Finite, Number, Threads};
use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::options::{CameraTable, Material, ProjectorTable, RenderTable};
use crate::scene::scenes;
use crate::show::Show;

pub mod advise;
pub mod bake;
pub mod compare;
mod explain;
mod film;
mod help;
mod info;
mod manual;
pub(crate) mod partners;
mod picture;
mod request;
pub mod run;
mod staged;
mod told;
pub mod turntable;
#[cfg(feature = "window")]
mod view;
mod watch;
pub(crate) mod words;

/// Draws 3D models on the CPU, with perspective done right.
#[derive(Clone, Debug, Parser)]
#[command(name = "alberti", version, max_term_width = 100, disable_help_subcommand = true)]
pub struct Cli {
    /// The subcommand.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The subcommands.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Draw a model, a scene file or a built-in scene into an image file.
    ///
    /// Without arguments, a built-in scene is drawn into alberti.png. A model is looked at from the front, the right
    /// and above, from where all of it is in the picture. Camera options that are given replace parts of that view.
    #[command(after_help = EXAMPLES)]
    Render(Box<RenderArgs>),
    /// Find the cheapest policies for a scene within a budget of error, and what it pays for nothing.
    ///
    /// Draws the scene under all interpolations, arithmetics, depth formats and subpixels, alone and together, and
    /// measures errors and times. Prints the options and the lines of a program that select the pick.
    #[command(after_help = advise::HELP)]
    Advise(Box<advise::AdviseArgs>),
    /// Bake a scene's meshes and textures for flash, and say what they take there.
    ///
    /// Vertices become integers, triangles are put in the order of meshlets, textures get the format of the display.
    /// Only what the shading uses is written: as a file that the library reads in place, and as Rust constants. The
    /// report has bytes, errors, memory, and instructions a frame.
    #[command(after_help = bake::HELP)]
    Bake(Box<bake::BakeArgs>),
    /// Measure the difference between two pictures.
    ///
    /// Prints the largest difference, its 99.9 % percentile, the number of outliers, MSE, PSNR and mean FLIP. It does
    /// not matter which picture comes first.
    #[command(after_help = compare::HELP)]
    Compare(compare::CompareArgs),
    /// Explain a pixel: the journey from the triangle that is seen there to the word that is stored.
    ///
    /// All options of `render` hold, but that no picture is written. Each step is printed with its numbers, and with
    /// the name of its relation in docs/theory.md; what is interpolated is set beside the same in 64 bits. In the end
    /// the colour is compared with that of the picture.
    #[command(after_help = explain::EXAMPLES)]
    Explain(Box<explain::ExplainArgs>),
    /// Draw a film of a model that turns, or its frames.
    ///
    /// Takes the options of `render`. The camera goes round the target, and the light with it. All of the model is in
    /// view at all times unless --eye is given. The last frame is before the first one.
    #[command(after_help = turntable::HELP)]
    Turntable(Box<turntable::TurntableArgs>),
    /// Join pictures to a film: the frames that processes have drawn apart.
    #[command(after_help = turntable::ASSEMBLE_HELP)]
    Assemble(turntable::AssembleArgs),
    /// Tell of a model: its size, materials and maps, and what it takes on boards.
    ///
    /// Triangles, extents, parts, materials with their files, memory, and flash, RAM and instructions as `alberti bake`
    /// has them, for a frame of 320x240.
    #[command(after_help = info::HELP)]
    Info(Box<info::InfoArgs>),
    /// Draw a picture, and again whenever one of its files changes.
    ///
    /// Takes the options of `render`. The scene file, models, material libraries and images are watched. A file that
    /// has an error is told, and the last picture stays. Ctrl-C ends it.
    #[command(after_help = watch::HELP)]
    Watch(Box<RenderArgs>),
    /// Look at a scene in a window.
    ///
    /// Takes the options of `render`. The mouse turns, moves and zooms, keys choose options: H lists them. The picture
    /// follows its files, and those that are dropped on the window. P keeps it as `render` draws it.
    #[cfg(feature = "window")]
    #[command(after_help = view::HELP)]
    View(Box<RenderArgs>),
    /// Print a shell's completions of this command.
    #[command(
        after_help = "Examples:\n  alberti completions bash > ~/.local/share/bash-completion/completions/alberti\n  \
        alberti completions zsh > ~/.zfunc/_alberti"
    )]
    Completions {
        /// The shell.
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
    /// Print the manual page: `alberti man | man -l -`.
    Man,
    /// Print help on a command or a kind of options.
    Help {
        /// A command, or a kind of options, such as camera.
        topic: Option<String>,
    },
}

const EXAMPLES: &str = "\
Examples:
  alberti teapot.obj -o teapot.png      a model; the word render may be left out
  alberti cow.obj --texture cow.png --eye 2,1,-3
  alberti wet.toml --shading phong      a scene file, drawn with other light
  alberti render                        the built-in scene, into alberti.png
  alberti --scene floor --interpolation affine -s 1920x1080 --stats json";

/// The options of `alberti render`. Those that are absent are left to the model or the scene.
#[derive(Clone, Debug, Default, Args)]
pub struct RenderArgs {
    /// Wavefront OBJ model to draw, or a scene file.
    ///
    /// A model is drawn with the materials and textures that it names; it may be compressed by gzip, and - is standard
    /// input. A scene file's name ends in .toml; options override what it says.
    #[arg(value_name = "MODEL.obj or SCENE.toml")]
    pub model: Option<PathBuf>,

    /// Built-in scene to draw instead of a model [default: hero].
    #[arg(long, value_name = "NAME", conflicts_with = "model", value_parser = PossibleValuesParser::new(scenes::NAMES))]
    pub scene: Option<String>,

    /// `[camera]` of a scene file.
    #[command(flatten)]
    pub camera: CameraTable,

    /// `[projector]` of a scene file.
    #[command(flatten)]
    pub projector: ProjectorTable,

    /// `[render]` of a scene file.
    #[command(flatten)]
    pub render: RenderTable,

    /// The time in seconds at which a scene file is seen in which something moves [default: 0].
    #[arg(long, value_name = "S", allow_hyphen_values = true, help_heading = "Camera")]
    pub time: Option<Number<Finite>>,

    /// List the built-in scenes.
    #[arg(long)]
    pub list_scenes: bool,

    /// Threads that draw [default: as many as the machine runs at once].
    ///
    /// The picture is the same for any number.
    #[arg(short = 'j', long, value_name = "N", allow_hyphen_values = true)]
    pub threads: Option<Threads>,

    /// Print counts and times, as a table or as one line of JSON.
    ///
    /// Of several threads' pictures, the counts are those of the same drawn by one, after the times were taken.
    #[arg(long, value_name = "FORMAT", num_args = 0..=1, default_missing_value = "text")]
    pub stats: Option<StatsFormat>,

    /// Print errors alone, and what --stats asks for: no summary, no legend, no warnings, no progress.
    #[arg(short, long)]
    pub quiet: bool,

    /// Draw one number of each pixel in false colours, and print what they mean.
    #[arg(long, value_enum, value_name = "WHAT")]
    pub show: Option<Show>,

    /// Parts of every material.
    #[command(flatten)]
    pub material: Material,
}

/// The form of counts and times.
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
