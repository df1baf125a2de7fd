//! `alberti compare`: two pictures in, measures and an exit status out.

use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::PathBuf;

use clap::{ArgMatches, Args, FromArgMatches as _};
use serde::Serialize;

use super::run::print;
use super::told::warn;
use crate::error::Error;
use crate::image_file::{self, MAX_TEXELS};
use crate::load::{input, seen};
use crate::measure::{Comparison, MaxError, Measures, OUTLIER};
use crate::memory;
use crate::output::file::Output;
use crate::output::stage::{Stage, during};

/// The exit status for pictures that differ by more than `--max-error`.
pub const EXCEEDED: u8 = 1;

/// The text after the options.
pub(super) const HELP: &str = "\
Examples:
  alberti compare exact.png affine.png
  alberti compare exact.png affine.png --heat difference.png
  alberti compare old.png new.png --max-error 0.01flip  the mean FLIP at most 0.01
  alberti compare old.png new.png --json | jq .flip

Measures:
  largest          the worst channel of the worst pixel, in steps of a byte (lsb), 0 to 255
  99.9 percentile  the same, but for the worst thousandth of the pixels
  outliers         pixels that are off by more than 8 lsb
  MSE, PSNR        mean squared difference of red, green and blue, and its ratio to 255^2 in dB
  FLIP             what somebody sees who flips between the two, 0 to 1: the mean of LDR-FLIP
                   (Andersson et al. 2020) at 67 pixels per degree, a monitor at arm's length

  Alpha is a fourth channel of the first three, and none of the others: nothing is composited.
  Pictures of 16 bits a channel are rounded to 8 first.

Exit status:
  0  the pictures were compared, and keep --max-error if it is given
  1  they differ by more; a line on standard error says which measure exceeds which limit
  2  they could not be compared";

/// The options of `alberti compare`.
#[derive(Clone, Debug, Args)]
pub struct CompareArgs {
    /// A picture: PNG, JPEG, BMP, TGA, GIF, WebP, QOI or PPM, of a film the first frame; - is standard input.
    #[arg(value_name = "A.png")]
    pub first: PathBuf,

    /// Another of the same size.
    #[arg(value_name = "B.png")]
    pub second: PathBuf,

    /// Write a picture of the FLIP of each pixel in false colours, from black where the pictures are equal through
    /// purple and orange to nearly white at 1. Colours follow the square root, so that small errors show.
    #[arg(long, value_name = "OUT.png")]
    pub heat: Option<PathBuf>,

    /// Limit of the error, a number with its unit: lsb (99.9 % percentile, at most), flip (mean, at most) or db (PSNR,
    /// at least).
    #[arg(long, value_name = "2lsb|0.01flip|40db", allow_hyphen_values = true)]
    pub max_error: Option<MaxError>,

    /// Print one line of JSON instead of the table. A PSNR of equal colours, which is infinite, is null.
    #[arg(long)]
    pub json: bool,

    /// Print errors alone: no table, nor which limit is exceeded. The exit status says that.
    #[arg(short, long)]
    pub quiet: bool,
}

/// One line of JSON, in this order.
#[derive(Serialize)]
struct Line {
    a: String,
    b: String,
    width: u32,
    height: u32,
    /// In steps of a byte.
    largest: u8,
    /// Column and row.
    largest_at: Option<[u32; 2]>,
    /// In steps of a byte.
    percentile_99_9: u8,
    /// In pixels.
    outliers: usize,
    mse: f64,
    /// In dB. Infinity is no number of JSON.
    psnr: Option<f64>,
    flip: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_error: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    within: Option<bool>,
}

/// Compares, reports, and tells the exit status.
pub(super) fn run(matches: &ArgMatches) -> Result<u8, Error> {
    let arguments = CompareArgs::from_arg_matches(matches)
        .map_err(|error| Error::new(error.to_string(), "what --help lists"))?;
    if let Some(MaxError::Texel(_)) = arguments.max_error {
        let error = Error::new("a limit in texels", "one in lsb, flip or db").place("--max-error");
        return Err(error.hint("two pictures do not tell texels: `alberti advise` knows them from the scene"));
    }
    let standard = |path: &PathBuf| path.as_os_str() == input::STDIN;
    if standard(&arguments.first) && standard(&arguments.second) {
        let error = Error::new("standard input for both", "a file as one of the two").place("-");
        return Err(error.hint("it is read but once"));
    }
    let output = output(&arguments)?;
    let is_piped = output.as_ref().is_some_and(Output::is_standard);
    memory::begin(None);
    let read = |path: &PathBuf| {
        let (image, is_film) = during(Stage::Maps, |_| image_file::load_frame(path, MAX_TEXELS))?;
        if is_film {
            let warning = Error::new("a film", "a picture").file(input::shown(path));
            warn(&warning.hint("its first frame is compared").to_string());
        }
        Ok::<_, Error>(image)
    };
    let (first, second) = (read(&arguments.first)?, read(&arguments.second)?);
    if (first.width, first.height) != (second.width, second.height) {
        let found = format!("{}x{} pixels", second.width, second.height);
        let expected = format!("{}x{} as in {}", first.width, first.height, arguments.first.display());
        let error = Error::new(found, expected).file(&arguments.second);
        return Err(error.hint("only pictures of one size can be compared"));
    }
    let comparison = during(Stage::Compare, |_| Comparison::new(&first, &second))?;
    drop((first, second));
    if let Some(output) = output {
        during(Stage::Encode, |_| output.write(&comparison.heat())).map_err(|error| error.hint(ANOTHER))?;
    }
    let measures = &comparison.measures;
    let excess = arguments.max_error.and_then(|limit| limit.excess(measures));
    let told = if arguments.json {
        json(&arguments, measures, excess.is_none())
    } else if arguments.quiet {
        String::new()
    } else {
        text(&arguments, measures)
    };
    if is_piped {
        // The picture has the other way.
        let _ = io::stderr().write_all(told.as_bytes());
    } else {
        print(&told)?;
    }
    let Some(excess) = excess else { return Ok(0) };
    if arguments.quiet {
        return Ok(EXCEEDED);
    }
    // Without standard error there is the status.
    let _ = writeln!(io::stderr(), "exceeded: {excess}");
    Ok(EXCEEDED)
}

const ANOTHER: &str = "choose another with --heat";

/// The picture to write. It is none of those that are read.
fn output(arguments: &CompareArgs) -> Result<Option<Output>, Error> {
    let Some(named) = &arguments.heat else { return Ok(None) };
    let output = Output::new(named, None).map_err(|error| error.hint(ANOTHER))?;
    if output.is(&arguments.first) || output.is(&arguments.second) {
        return Err(seen::refused(output.name(), "--heat"));
    }
    Ok(Some(output))
}

fn text(arguments: &CompareArgs, measures: &Measures) -> String {
    let [width, height] = measures.size;
    let place = match measures.largest_at {
        Some([x, y]) => format!("worst pixel, first at {x},{y}"),
        None => "equal".to_owned(),
    };
    let percentile = "all but the worst thousandth".to_owned();
    let outliers = format!("off by more than {OUTLIER} lsb, of {}", measures.pixels());
    let rows = [
        ("largest", measures.largest.to_string(), "lsb", place),
        ("99.9 percentile", measures.most.to_string(), "lsb", percentile),
        ("outliers", measures.outliers.to_string(), "pixels", outliers),
        ("MSE", format!("{:.4}", measures.mse), "lsb^2", "energy, 0 is equal".to_owned()),
        ("PSNR", decibels(measures.psnr()), "dB", "fidelity, more is better".to_owned()),
        ("FLIP", format!("{:.6}", measures.flip), "mean", "visibility, 0 is equal, 1 the most".to_owned()),
    ];
    let [first, second] = [&arguments.first, &arguments.second].map(|path| input::shown(path).display());
    let mut text = format!("{first} and {second}: {width}x{height} pixels\n");
    for (name, figure, unit, meaning) in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:<16}{figure:>12} {unit:<7} {meaning}");
    }
    if let Some(heat) = &arguments.heat {
        let _ = writeln!(text, "FLIP of each pixel in {}", heat.display());
    }
    text
}

fn decibels(psnr: f64) -> String {
    if psnr.is_finite() { format!("{psnr:.3}") } else { "infinite".to_owned() }
}

fn json(arguments: &CompareArgs, measures: &Measures, within: bool) -> String {
    let [width, height] = measures.size;
    let line = Line {
        a: arguments.first.display().to_string(),
        b: arguments.second.display().to_string(),
        width,
        height,
        largest: measures.largest,
        largest_at: measures.largest_at,
        percentile_99_9: measures.most,
        outliers: measures.outliers,
        mse: measures.mse,
        psnr: Some(measures.psnr()).filter(|psnr| psnr.is_finite()),
        flip: measures.flip,
        max_error: arguments.max_error.map(|limit| limit.to_string()),
        within: arguments.max_error.map(|_| within),
    };
    // Strings and finite numbers cannot be refused.
    let line = serde_json::to_string(&line).unwrap_or_default();
    format!("{line}\n")
}
