//! `alberti advise`: a scene and a budget of error in, the cheapest policies out.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{ArgMatches, Args, CommandFactory as _, FromArgMatches as _};

use super::request::{OF_PICTURES, Request, refuse};
use super::run::print;
use super::staged::Staged;
use super::{Cli, RenderArgs};
use crate::advise::{Advice, Machine, Wish, advise, json, text, waste};
use crate::error::Error;
use crate::measure::{Comparison, MaxError};
use crate::options::{LightOptions, RenderOptions};
use crate::output::file::Output;
use crate::output::stage::{Stage, during};
use crate::scene::{Camera, Model};

/// The text after the options.
pub(super) const HELP: &str = "\
Examples:
  alberti advise teapot.obj --max-error 2lsb
  alberti advise --scene floor --max-error 2lsb --size 320x240
  alberti advise wet.toml --max-error 0.01flip --image differences
  alberti advise --scene mesh --max-error 1texel --target m4f
  alberti advise cow.obj --texture cow.png --max-error 40db --turntable 12 --json";

/// The options on which there is advice.
pub(super) const ADVISED_ON: [&str; 4] = ["interpolation", "arithmetic", "depth", "subpixel"];

/// The heading of its own options.
const OWN: &str = "Advice";

/// The most cameras of a turntable.
const MAX_TURNS: u32 = 360;

fn turns(text: &str) -> Result<u32, String> {
    let turns = text.parse().ok().filter(|turns| (1..=MAX_TURNS).contains(turns));
    turns.ok_or_else(|| format!("an integer from 1 to {MAX_TURNS}"))
}

/// The options of `alberti advise`: those of `render`, and these.
#[derive(Clone, Debug, Args)]
pub struct AdviseArgs {
    /// The scene, as `render` takes it. Its interpolation, arithmetic, depth and subpixels are what is advised on.
    #[command(flatten)]
    pub render: RenderArgs,

    /// Limit of the error, a number with its unit: texel (of texture coordinates), lsb (of bytes), flip (mean), or db
    /// (PSNR, at least). Texels and bytes are those of the 99.9 % of the pixels that are least off.
    #[arg(
        long,
        value_name = "0.5texel|2lsb|0.01flip|40db",
        allow_hyphen_values = true,
        default_value = "2lsb",
        help_heading = OWN
    )]
    pub max_error: MaxError,

    /// Machine that is to draw. This one is timed. Instructions of chips are a model's, for a textured, unlit mesh with
    /// the scene's own counts of vertices, rows and fragments; errors are those of any machine, in RGB565. `--target
    /// MACHINE` is the same.
    #[arg(long, value_enum, value_name = "MACHINE", default_value_t = Machine::Host, help_heading = OWN)]
    pub machine: Machine,

    /// Try all combinations, not only the promising ones: some 200 frames instead of 50.
    #[arg(long, help_heading = OWN)]
    pub thorough: bool,

    /// Write the picture of the pick, the right one and their difference into this folder.
    #[arg(long, value_name = "FOLDER", help_heading = OWN)]
    pub image: Option<PathBuf>,

    /// Look for triangles that are never seen from N cameras around the target.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = turns, help_heading = OWN)]
    pub turntable: u32,

    /// Print one line of JSON instead of the table; docs/advice.md has its keys.
    #[arg(long, help_heading = OWN)]
    pub json: bool,
}

/// The scene that these arguments of `alberti advise` name, with its camera and options.
///
/// # Errors
/// An argument or a file that cannot be used.
pub fn scene(arguments: &[&str]) -> Result<(Model, Camera, RenderOptions), Error> {
    let words = ["alberti", "advise"].into_iter().chain(arguments.iter().copied());
    let matches = Cli::command().try_get_matches_from(words);
    let matches = matches.map_err(|error| Error::new(error.to_string(), "what --help lists"))?;
    let Some((_, matches)) = matches.subcommand() else { return Err(Error::new("nothing", "arguments")) };
    let request = Request::read(matches)?;
    request.check()?;
    let Staged { model, camera, mut options, .. } = request.stage()?;
    // A program has one lamp, and surfaces of one side.
    options.light = LightOptions::default();
    Ok((model, camera, options))
}

/// The arguments with `--machine` instead of a `--target` that begins with a letter: no point does.
pub(super) fn with_machine(arguments: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut arguments: Vec<OsString> = arguments.into_iter().collect();
    if arguments.get(1).is_none_or(|command| command != "advise") {
        return arguments;
    }
    let is_machine = |value: &str| value.starts_with(|first: char| first.is_ascii_alphabetic());
    for k in 2..arguments.len() {
        let Some(word) = arguments[k].to_str() else { continue };
        if word == "--" {
            break;
        }
        let joined = word.strip_prefix("--target=").filter(|value| is_machine(value));
        let follows = arguments.get(k + 1).and_then(|value| value.to_str()).is_some_and(is_machine);
        if let Some(value) = joined {
            arguments[k] = format!("--machine={value}").into();
        } else if word == "--target" && follows {
            arguments[k] = "--machine".into();
        }
    }
    arguments
}

/// Tries policies, and prints what was found.
pub(super) fn run(matches: &ArgMatches) -> Result<u8, Error> {
    let arguments = AdviseArgs::from_arg_matches(matches)
        .map_err(|error| Error::new(error.to_string(), "what --help lists"))?;
    let request = Request::read(matches)?;
    refuse(matches, "advise", &OF_PICTURES, "the pictures are those of --image")?;
    refuse(matches, "advise", &ADVISED_ON, "it is what is advised on")?;
    advise_on(&arguments, &request).map_err(|error| request.relocate(error))?;
    Ok(0)
}

fn advise_on(arguments: &AdviseArgs, request: &Request) -> Result<(), Error> {
    request.check()?;
    let outputs = arguments.image.as_deref().map(|folder| outputs(folder, request)).transpose()?;
    let Staged { model, camera, mut options, .. } = request.stage()?;
    // A program has one lamp, and surfaces of one side.
    options.light = LightOptions::default();
    let AdviseArgs { max_error: budget, machine, thorough, turntable, .. } = *arguments;
    let (advice, wastes) = during(Stage::Try, |progress| {
        let hear = &mut |done, total| progress.set(done, total);
        let advice = advise(&model, &camera, &options, Wish { budget, machine, thorough }, hear)?;
        waste(&model, &camera, &options, &advice, turntable).map(|wastes| (advice, wastes))
    })?;
    if let Some(outputs) = outputs {
        write(&advice, outputs)?;
    }
    let side = model.largest_side();
    print(&if arguments.json {
        format!("{}\n", json(&advice, &wastes, side))
    } else {
        text(&advice, &wastes, side)
    })
}

/// The files of a folder.
fn outputs(folder: &Path, request: &Request) -> Result<[Output; 3], Error> {
    let file = |name: &str| request.writable(&folder.join(name), "--image");
    Ok([file("pick.png")?, file("right.png")?, file("difference.png")?])
}

fn write(advice: &Advice, [pick, right, difference]: [Output; 3]) -> Result<(), Error> {
    let (found, reference) = (&advice.trials[advice.pick].picture, &advice.reference.picture);
    pick.write(found)?;
    right.write(reference)?;
    difference.write(&Comparison::new(found, reference)?.heat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_with_a_letter_is_a_machine() {
        let told = |line: &str| {
            let words = with_machine(line.split(' ').map(OsString::from));
            words.join(std::ffi::OsStr::new(" ")).into_string().expect("text")
        };
        for (line, expected) in [
            ("alberti advise m.obj --target m4f", "alberti advise m.obj --machine m4f"),
            ("alberti advise --target=m7 m.obj", "alberti advise --machine=m7 m.obj"),
            ("alberti advise --target 0,1,2 --target rv32", "alberti advise --target 0,1,2 --machine rv32"),
            ("alberti advise --target -1,0,0", "alberti advise --target -1,0,0"),
            ("alberti render --target m4f", "alberti render --target m4f"),
            ("alberti advise -- --target m4f", "alberti advise -- --target m4f"),
        ] {
            assert_eq!(told(line), expected);
        }
    }
}
