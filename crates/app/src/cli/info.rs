//! `alberti info`: a model or a scene in numbers.

use clap::{ArgMatches, Args, FromArgMatches as _};

use super::RenderArgs;
use super::bake::frame;
use super::request::{OF_PICTURES, Request, refuse};
use super::run::print;
use super::staged::Staged;
use super::told::told;
use crate::bake::{Asked, Asset, Report, Wish, bake, bytes, left_out, missing};
use crate::error::Error;
use crate::info::Info;
use crate::load::input;
use crate::options::{LightOptions, RenderOptions};
use crate::output::stage::{Stage, during};
use crate::output::stats::Source;
use crate::scene::{Camera, Model};

pub(super) const HELP: &str = "\
Examples:
  alberti info teapot.obj
  gunzip -c scan.obj.gz | alberti info -
  alberti info wet.toml --size 240x240 --profile tiny     what a frame takes with these
  alberti info cow.obj --json | jq .triangles             the manual has its keys";

/// The rows of a band of the report, as those of `alberti bake` without options.
const BAND: u32 = 16;

/// The options of `alberti info`: those of `render`, and these.
#[derive(Clone, Debug, Args)]
pub struct InfoArgs {
    /// Print one line of JSON.
    #[arg(long)]
    pub json: bool,

    /// The scene, as `render` takes it.
    #[command(flatten)]
    pub render: RenderArgs,
}

/// Loads a model or a scene, and prints what there is to say of it.
pub(super) fn run(matches: &ArgMatches) -> Result<(), Error> {
    let mut request = Request::read(matches)?;
    refuse(matches, "info", &OF_PICTURES, "no picture is written")?;
    frame(&mut request);
    let json = InfoArgs::from_arg_matches(matches).is_ok_and(|arguments| arguments.json);
    report(&request, json).map_err(|error| request.relocate(error))
}

fn report(request: &Request, json: bool) -> Result<(), Error> {
    request.check()?;
    let Staged { model, camera, mut options, .. } = request.stage()?;
    // A program has one lamp, and surfaces of one side.
    options.light = LightOptions::default();
    let wish = Wish { dither: options.policies.dither, ..Wish::default() };
    let asset = during(Stage::Bake, |_| bake((&model, &camera), &options, &wish));
    let (costs, left_out) = match &asset {
        Ok(asset) => priced(asset, (&model, &camera, &options), request),
        Err(error) => (Err(error.clone()), vec![]),
    };
    let source = match request.source() {
        Source::Model(path) => input::shown(path).display().to_string(),
        Source::Scene(name) => format!("built-in scene {name}"),
    };
    let info = Info { source: &source, model: &model, costs, left_out, warnings: told() };
    print(&if json { format!("{}\n", info.json()) } else { info.text() })
}

/// The report on an asset, and the things of the model that it has not.
fn priced<'a>(
    asset: &'a Asset,
    (model, camera, options): (&Model, &Camera, &RenderOptions),
    request: &Request,
) -> (Result<Report<'a>, Error>, Vec<String>) {
    let file = bytes(asset);
    let report = during(Stage::Count, |_| Report::new(asset, &file, (model, camera, options), BAND));
    let lost =
        missing(model, options, Asked::Auto, request.moment()).into_iter().chain(left_out(model, asset));
    (report, lost.map(|error| request.relocate(error).to_string()).collect())
}
