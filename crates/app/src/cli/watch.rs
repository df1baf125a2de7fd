//! `alberti watch`: a picture that follows its files.

use std::io::{self, Write as _};
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use clap::ArgMatches;

use super::request::Request;
use super::run::{draw, fail};
use crate::error::{Error, counted};
use crate::load::{input, obj, scene_file, seen};
use crate::output::file::STANDARD;
use crate::output::stage::is_silent;

pub(super) const HELP: &str = "\
Examples:
  alberti watch wet.toml -o wet.png       draws again whenever wet.toml, a model or an image changes
  alberti watch cow.obj --shading phong -s 400x300 -q";

/// The time between two looks at the files.
const POLL: Duration = Duration::from_millis(150);

/// The time for which files have to stay as they are before they are read: an editor may write several.
const QUIET: Duration = Duration::from_millis(100);

/// Draws until a signal ends the process.
///
/// # Errors
/// The command line alone cannot be used. All other errors are told, and may be mended while this goes on.
pub(super) fn run(matches: &ArgMatches) -> Result<(), Error> {
    let model = checked(matches)?;
    loop {
        seen::begin();
        seen::see(&model);
        if let Err(error) = draw(matches) {
            fail(&error);
        }
        if !is_silent() {
            let files = counted(seen::now().len(), "file", "files");
            // Without standard error there is nobody to tell.
            _ = writeln!(io::stderr(), "watching {files}; Ctrl-C ends it");
        }
        while !seen::changed() {
            sleep(POLL);
        }
        let mut before = seen::now();
        loop {
            sleep(QUIET);
            let after = seen::now();
            if after == before {
                break;
            }
            before = after;
        }
    }
}

/// The file to watch.
fn checked(matches: &ArgMatches) -> Result<std::path::PathBuf, Error> {
    let given = Request::given(matches)?;
    let Some(model) = given.arguments.model.clone() else {
        let error = Error::new("nothing", "a model or a scene file to watch");
        return Err(error.hint("built-in scenes do not change"));
    };
    if model == Path::new(input::STDIN) {
        return Err(Error::new("standard input", "a file to watch").hint("it is read but once"));
    }
    let output = given.arguments.render.output.as_deref();
    if output == Some(Path::new(STANDARD)) {
        let error = Error::new("standard output", "a file that is drawn anew").place("-o");
        return Err(error.hint("name a file"));
    }
    if !scene_file::is_scene(&model) {
        input::check(&model, obj::KIND)?;
        given.check()?;
        given.output()?;
    } else {
        input::check(&model, scene_file::KIND)?;
        if output.is_some() {
            given.output()?;
        }
    }
    Ok(model)
}
