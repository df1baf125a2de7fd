//! The command itself: arguments in, a picture and an exit status out.

use std::ffi::OsString;
use std::io::{self, IsTerminal as _, Write as _};
use std::num::NonZero;
use std::time::Instant;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{ArgMatches, CommandFactory as _};

use super::staged::{OF_PICTURES, Request, Staged, hidden, warn};
use super::{Cli, StatsFormat, advise, bake, compare, explain};
use crate::error::{Error, quote};
use crate::options::RenderOptions;
use crate::output::progress::Progress;
use crate::output::stats::{Report, Times};
use crate::samples::supersampled;
use crate::scene::backdrop::Backdrop;
use crate::show::{Shown, show};

/// The exit status for whatever the user can mend.
pub const FAILURE: u8 = 2;

/// Runs the command with these arguments, the program's name first. Messages go to standard error; the status is
/// 0, [`compare::EXCEEDED`] or [`FAILURE`].
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let mut command = Cli::command()
        .mut_subcommand("explain", |command| hidden(command, &OF_PICTURES))
        .mut_subcommand("bake", bake::with_defaults)
        .mut_subcommand("advise", |command| hidden(hidden(command, &OF_PICTURES), &advise::ADVISED_ON));
    let given: Vec<OsString> = arguments.into_iter().collect();
    let read = advise::with_machine(given.clone());
    let renamed = read != given;
    let matches = match command.try_get_matches_from_mut(read) {
        Ok(matches) => matches,
        Err(error) => return usage(&error, renamed),
    };
    let result = match matches.subcommand() {
        Some(("advise", scene)) => advise::run(scene),
        Some(("bake", scene)) => bake::run(scene).map(|()| 0),
        Some(("compare", pictures)) => compare::run(pictures),
        Some(("explain", pixel)) => explain::run(pixel).map(|()| 0),
        Some((_, render)) => draw(render).map(|()| 0),
        None => print(&command.render_help().to_string()).map(|()| 0),
    };
    match result {
        Ok(status) => status,
        Err(error) => fail(&error),
    }
}

/// Help and version are no errors. All others get one line like any other input, with clap's suggestions. `renamed`
/// says that the machine was given as a target.
fn usage(error: &clap::Error, renamed: bool) -> u8 {
    let expected = match error.kind() {
        ErrorKind::ValueValidation => std::error::Error::source(error).map(ToString::to_string),
        ErrorKind::InvalidValue => error.get(ContextKind::ValidValue).map(one_of),
        _ => None,
    };
    let context = |kind| error.get(kind).map(ToString::to_string);
    // An option without its value's name. A model stands for itself, in brackets.
    let named = |text: &str| match text.split(' ').next().unwrap_or_default() {
        "--machine" if renamed => "--target".to_owned(),
        option if option.starts_with('-') => option.split('[').next().unwrap_or(option).to_owned(),
        _ => text.trim_start_matches('[').trim_end_matches(']').to_owned(),
    };
    let refused = |found: &str, expected: String| {
        let mut error = Error::new(found, expected).hint("see --help");
        if let Some(option) = context(ContextKind::InvalidArg) {
            error = error.place(named(&option));
        }
        fail(&error)
    };
    match error.kind() {
        ErrorKind::MissingRequiredArgument => {
            let missing = context(ContextKind::InvalidArg).unwrap_or_default();
            return fail(&Error::new("nothing", missing).hint("see --help"));
        }
        ErrorKind::ArgumentConflict => {
            let other = context(ContextKind::PriorArg).map(|other| named(&other)).unwrap_or_default();
            let same = context(ContextKind::InvalidArg).is_some_and(|option| named(&option) == other);
            let (found, expected) =
                if same { ("it twice", "once".to_owned()) } else { ("it", format!("no {other} beside it")) };
            return refused(found, expected);
        }
        ErrorKind::UnknownArgument => {
            let similar = context(ContextKind::SuggestedArg).map(|option| format!(", such as {option}"));
            return refused("it", format!("an option{}", similar.unwrap_or_default()));
        }
        _ => {}
    }
    if let (Some(option), Some(value), Some(expected)) =
        (context(ContextKind::InvalidArg), context(ContextKind::InvalidValue), expected)
    {
        return fail(&Error::new(quote(value.as_bytes()), expected).place(named(&option)).hint("see --help"));
    }
    // A closed pipe cannot be told about.
    let _ = error.print();
    if error.use_stderr() { FAILURE } else { 0 }
}

/// Values of which an option takes one, as words.
fn one_of(values: &ContextValue) -> String {
    match values {
        ContextValue::Strings(values) if !values.is_empty() => format!("one of {}", values.join(", ")),
        _ => "a value".to_string(),
    }
}

fn fail(error: &Error) -> u8 {
    let _ = writeln!(io::stderr(), "error: {error}");
    FAILURE
}

fn draw(matches: &ArgMatches) -> Result<(), Error> {
    let request = Request::read(matches)?;
    draw_from(&request).map_err(|error| request.relocate(error))
}

fn draw_from(request: &Request) -> Result<(), Error> {
    request.check()?;
    let output = request.output()?;
    let Staged { model, camera, options, samples, backdrop, load } = request.stage_on_ground()?;
    let start = Instant::now();
    let mut progress = Progress::new("drawing");
    let hear = &mut |done, total| progress.set(done, total);
    let (mut picture, legend) = match request.arguments.show {
        None => (supersampled(&model, &camera, &options, samples, &backdrop, hear)?, None),
        Some(what) => {
            let Shown { picture, legend, warning } = show(what, &model, &camera, &options, hear)?;
            warning.iter().for_each(|warning| warn(&warning.to_string()));
            (picture, Some(legend.text(io::stdout().is_terminal())))
        }
    };
    drop(progress);
    let rendered = start.elapsed();
    if request.arguments.stats.is_some() && options.threads.get() > 1 {
        // A triangle counts once, however many threads drew it.
        let alone = RenderOptions { threads: NonZero::<usize>::MIN, ..options };
        picture.stats = supersampled(&model, &camera, &alone, samples, &backdrop, &mut |_, _| ())?.stats;
    }

    let start = Instant::now();
    if request.arguments.show.is_none() && backdrop == Backdrop::Transparent {
        output.write_with_alpha(&picture.image)?;
    } else {
        output.write(&picture.image)?;
    }
    let times = Times { load, render: rendered, write: start.elapsed() };
    let size = (options.width, options.height);
    let projection = options.projection;
    let report = Report {
        output: output.name(),
        source: request.source(),
        size,
        stats: picture.stats,
        times,
        camera,
        origin: model.origin,
        projection,
    };
    let text = match request.arguments.stats {
        None => format!("{}\n{}", report.summary(), legend.unwrap_or_default()),
        Some(StatsFormat::Text) => format!("{}\n{}", report.summary(), report.text()),
        Some(StatsFormat::Json) => format!("{}\n", report.json()),
    };
    if output.is_standard() {
        // The picture has the other way.
        let _ = io::stderr().write_all(text.as_bytes());
        return Ok(());
    }
    print(&text)
}

/// Standard output that nobody reads any more is no failure: the picture is there.
pub(super) fn print(text: &str) -> Result<(), Error> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::new(format!("that writing fails ({error})"), "to print the result")
                .place("standard output"))
        }
        _ => Ok(()),
    }
}
