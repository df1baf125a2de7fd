//! `alberti explain`.

use std::fmt;
use std::str::FromStr;

use clap::{ArgMatches, Args, FromArgMatches as _};

use super::RenderArgs;
use super::request::{OF_PICTURES, Request, ground_left_out, refuse};
use super::run::print;
use super::staged::Staged;
use super::told::warn;
use crate::error::Error;
use crate::explain::explain;
use crate::output::stage::{Stage, during};

pub(super) const EXAMPLES: &str = "\
Examples:
  alberti explain --scene floor --pixel 320,400      a pixel of a built-in scene
  alberti explain teapot.obj --pixel 300,200 --interpolation affine
  alberti explain wet.toml --pixel 100,380 --profile mcu
  alberti explain cow.obj --texture cow.png --filter trilinear --pixel 320,240 --json";

/// The options of `alberti explain`.
#[derive(Clone, Debug, Args)]
pub struct ExplainArgs {
    /// Column and row of the pixel, from 0,0 in the upper left corner.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, required = true)]
    pub pixel: Pixel,

    /// Print one line of JSON.
    #[arg(long)]
    pub json: bool,

    /// Those of `alberti render`.
    #[command(flatten)]
    pub render: RenderArgs,
}

/// A column and a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pixel(pub [u32; 2]);

impl FromStr for Pixel {
    type Err = NoPixel;

    fn from_str(text: &str) -> Result<Self, NoPixel> {
        let number = |text: &str| text.trim().parse().map_err(|_| NoPixel);
        let (x, y) = text.split_once(',').ok_or(NoPixel)?;
        Ok(Self([number(x)?, number(y)?]))
    }
}

/// The error of a text that is no pixel: it says what is expected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoPixel;

impl std::error::Error for NoPixel {}

impl fmt::Display for NoPixel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a column and a row from 0 on, such as 320,240")
    }
}

/// # Errors
/// Options that cannot be used, and those of [`explain`].
pub(super) fn run(matches: &ArgMatches) -> Result<(), Error> {
    let request = Request::read(matches)?;
    run_for(&request, matches).map_err(|error| request.relocate(error))
}

fn run_for(request: &Request, matches: &ArgMatches) -> Result<(), Error> {
    let refused = |error: clap::Error| Error::new(error.to_string(), "what --help lists");
    let ExplainArgs { pixel: Pixel(pixel), json, .. } =
        ExplainArgs::from_arg_matches(matches).map_err(refused)?;
    refuse(matches, "explain", &OF_PICTURES, "no picture is written")?;
    request.check()?;
    if request.arguments.render.ground == Some(true) {
        warn(&request.relocate(ground_left_out("explain")).to_string());
    }
    let Staged { model, camera, options, .. } = request.stage()?;
    let journey = during(Stage::Explain, |_| explain(&model, &camera, &options, pixel))?;
    print(&if json { format!("{}\n", journey.json()) } else { journey.text() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_two_numbers() {
        assert_eq!("3,40".parse(), Ok(Pixel([3, 40])));
        assert_eq!("0, 0".parse(), Ok(Pixel([0, 0])));
        for text in ["", "3", "3,", "-1,2", "1,2,3", "1.5,2", "x,y", "4294967296,0"] {
            assert_eq!(text.parse::<Pixel>(), Err(NoPixel), "{text}");
        }
    }
}
