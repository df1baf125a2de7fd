//! `alberti bake`.

use std::path::{Path, PathBuf};

use clap::builder::{Resettable, StyledStr};
use clap::{ArgMatches, Args, Command, FromArgMatches as _};

use super::RenderArgs;
use super::request::{OF_PICTURES, Request, hidden, refuse};
use super::run::print;
use super::staged::Staged;
use super::told::warn;
use crate::bake::{Asked, Format, Report, Wish, bake, bytes, left_out, missing, source};
use crate::error::Error;
use crate::options::values::Size;
use crate::options::{LightOptions, MAX_SIDE, Profile};
use crate::output::file::{STANDARD, Whole};
use crate::output::stage::{Stage, during};
use crate::output::stats::Source;

pub(super) const HELP: &str = "\
Examples:
  alberti bake teapot.obj --out assets               teapot.bin and teapot.rs, and what they take
  alberti bake cow.obj --texture cow.png --out assets --triangles 1000 --texture-size 128
  alberti bake cow.obj --out assets --format indexed4 --dither blue-noise --size 240x240
  alberti bake wet.toml --out assets --filter trilinear --json

docs/bake.md has a program that draws such a file.";

/// The heading of its own options.
const OWN: &str = "Baking";

/// The size of a frame, unless the user gives one: that of many small displays.
const FRAME: Size = Size(320, 240);

/// The command with its own defaults in the help of `render`'s options.
pub(super) fn with_defaults(command: Command) -> Command {
    let of_profile = ["interpolation", "arithmetic", "depth", "subpixel", "color_format"];
    let of_profile = of_profile.map(|id| (id, "the profile's"));
    let own = [("size", "320x240"), ("profile", "mcu"), ("filter", "bilinear; of a built-in scene its own")];
    own.into_iter().chain(of_profile).fold(hidden(command, &OF_PICTURES), |command, (id, default)| {
        command.mut_arg(id, |option| {
            let new = |help: &StyledStr| StyledStr::from(defaulting(&help.to_string(), default));
            let (short, long) = (option.get_help().map(new), option.get_long_help().map(new));
            option.help(Resettable::from(short)).long_help(Resettable::from(long))
        })
    })
}

/// The help of an option with another default.
fn defaulting(help: &str, default: &str) -> String {
    const MARK: &str = "[default: ";
    let parts = help.split_once(MARK).and_then(|(before, rest)| Some((before, rest.split_once(']')?.1)));
    parts.map_or_else(|| help.to_owned(), |(before, after)| format!("{before}{MARK}{default}]{after}"))
}

fn triangles(text: &str) -> Result<u32, String> {
    let most = text.parse().ok().filter(|&most| most > 0);
    most.ok_or_else(|| format!("a whole number from 1 to {}", u32::MAX))
}

fn side(text: &str) -> Result<u32, String> {
    let side = text.parse().ok().filter(|side| (1..=MAX_SIDE).contains(side));
    side.ok_or_else(|| format!("a whole number from 1 to {MAX_SIDE}"))
}

fn meshlet(text: &str) -> Result<usize, String> {
    text.parse()
        .ok()
        .filter(|most| (0..=1024).contains(most))
        .ok_or_else(|| "a whole number from 0 to 1024".to_owned())
}

/// The options of `alberti bake`: those of `render`, and these.
#[derive(Clone, Debug, Args)]
pub struct BakeArgs {
    /// The scene, as `render` takes it. Shading and filter say what is baked, camera, size and policies what a frame
    /// takes: 320x240 and --profile mcu, unless they are given.
    #[command(flatten)]
    pub render: RenderArgs,

    /// Folder for the files, NAME.bin to be read in place and NAME.rs to be compiled; it is made if it is not there.
    #[arg(long, value_name = "FOLDER", required = true, help_heading = OWN)]
    pub out: PathBuf,

    /// Format of textures of colours. Normals have 8 bits a channel, numbers 8, heights 16.
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t, help_heading = OWN)]
    pub format: Format,

    /// Triangles at most: the surface is simplified, and the report says how far it moves.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = triangles, help_heading = OWN)]
    pub triangles: Option<u32>,

    /// Longest side of a texture: larger ones are halved until they fit.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = side, help_heading = OWN)]
    pub texture_size: Option<u32>,

    /// Attributes of vertices: auto for those that the shading uses, none, or some of uv,normal,tangent,color.
    #[arg(long, value_name = "WHICH", default_value = "auto", help_heading = OWN)]
    pub attributes: Asked,

    /// Triangles of a meshlet, which is left out as a whole where it is not seen; 0 for none.
    #[arg(long, value_name = "N", default_value_t = 16, allow_hyphen_values = true, value_parser = meshlet)]
    #[arg(help_heading = OWN)]
    pub meshlets: usize,

    /// Rows of a band, for the report: those of the frame at most.
    #[arg(long, value_name = "ROWS", default_value_t = 16, allow_hyphen_values = true, value_parser = side)]
    #[arg(help_heading = OWN)]
    pub band: u32,

    /// Print one line of JSON instead of the table.
    #[arg(long, help_heading = OWN)]
    pub json: bool,
}

/// Bakes a scene, and prints what it takes.
pub(super) fn run(matches: &ArgMatches) -> Result<(), Error> {
    let arguments = BakeArgs::from_arg_matches(matches)
        .map_err(|error| Error::new(error.to_string(), "what --help lists"))?;
    let mut request = Request::read(matches)?;
    refuse(matches, "bake", &OF_PICTURES, "the files are those of --out")?;
    frame(&mut request);
    bake_into(&arguments, &request).map_err(|error| request.relocate(error))
}

/// The frame of a board, as far as the options leave it open.
pub(super) fn frame(request: &mut Request) {
    let render = &mut request.arguments.render;
    render.size.get_or_insert(FRAME);
    render.profile.get_or_insert(Profile::Mcu);
}

fn bake_into(arguments: &BakeArgs, request: &Request) -> Result<(), Error> {
    request.check()?;
    let folder = &arguments.out;
    let name = name(request);
    let file = |extension: &str| request.whole(&folder.join(format!("{name}.{extension}")), "--out");
    let (binary, module) = (file("bin")?, file("rs")?);

    let Staged { model, camera, mut options, .. } = request.stage()?;
    if model.origin != [0.0; 3] {
        let found = format!("a model around {}", model.origin.map(|x| x.to_string()).join(","));
        warn(&Error::new(found, "one near the origin").hint("places are counted from there").to_string());
    }
    // A program has one lamp, and surfaces of one side.
    options.light = LightOptions::default();
    let BakeArgs { format, triangles, texture_size, attributes, meshlets, band, .. } = *arguments;
    let dither = options.policies.dither;
    let triangles = triangles.map(|most| most as usize);
    let wish = Wish { format, dither, triangles, texture_size, attributes, meshlets };
    // All that has no other place is about the model.
    let own = |error: Error| match &model.source {
        Some(path) if error.place_name().is_none() => error.file(path),
        _ => error,
    };
    let told = |warning: Error| warn(&request.relocate(own(warning)).to_string());
    missing(&model, &options, attributes, request.moment()).into_iter().for_each(told);
    let asset = during(Stage::Bake, |_| bake((&model, &camera), &options, &wish)).map_err(own)?;
    left_out(&model, &asset).into_iter().for_each(told);
    if let Some(most) = triangles.filter(|&most| asset.triangles() > most) {
        let found = format!("{} triangles that cannot be fewer", asset.triangles());
        warn(&Error::new(found, format!("at most {most}")).place("--triangles").to_string());
    }
    let bytes = bytes(&asset);
    let report = during(Stage::Count, |_| Report::new(&asset, &bytes, (&model, &camera, &options), band))?;
    Whole::write_all(&[(&binary, &bytes), (&module, source(&asset, &from(request)).as_bytes())])?;
    let names = [&binary, &module].map(|file: &Whole| file.name().display().to_string());
    print(&if arguments.json {
        let mut json = report.json();
        json["files"] = names.into();
        format!("{json}\n")
    } else {
        format!("{} and {}: {}", names[0], names[1], report.text())
    })
}

/// The name of the files: that of the model or the scene.
pub(super) fn name(request: &Request) -> String {
    let stem = |path: &Path| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    match request.source() {
        // Standard input has no name.
        Source::Model(path) => {
            stem(path).filter(|stem| stem != STANDARD).unwrap_or_else(|| "model".to_owned())
        }
        Source::Scene(name) => name.to_owned(),
    }
}

/// The origin of the files, without the way to it.
fn from(request: &Request) -> String {
    match request.source() {
        Source::Model(path) => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        Source::Scene(name) => format!("the built-in scene `{name}`"),
    }
}
