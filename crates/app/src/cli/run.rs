//! The command itself: arguments in, a picture and an exit status out.

use std::ffi::OsString;
use std::io::{self, IsTerminal as _, Write as _};
use std::num::NonZero;
use std::path::Path;
use std::sync::Arc;

use clap::builder::PossibleValuesParser;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, ArgMatches, Command, CommandFactory as _, ValueEnum as _, ValueHint};

use super::request::{OF_PICTURES, Request, hidden};
use super::staged::Staged;
use super::told::{forget, warn};
use super::{Cli, StatsFormat, advise, bake, compare, explain, help, info, turntable, watch, words};
use crate::aov::layers;
use crate::draw::{Chains, bytes_of};
use crate::error::{Error, quote};
use crate::memory;
use crate::options::{RenderOptions, Samples};
use crate::output::aov::Beside;
use crate::output::file::Output;
use crate::output::stage::{self, Stage, during, is_silent, silence};
use crate::output::stats::Report;
use crate::samples::supersampled_with;
use crate::scene::backdrop::Backdrop;
use crate::scene::ground::Shadows;
use crate::scene::scenes;
use crate::show::{Shown, show};

/// The exit status for whatever the user can mend.
pub const FAILURE: u8 = 2;

/// Runs the command with these arguments, the program's name first. Messages go to standard error; the status is
/// 0, [`compare::EXCEEDED`] or [`FAILURE`].
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    attempt(arguments).unwrap_or_else(|error| fail(&error))
}

/// [`run`] with the error of a failure, which is not told.
///
/// # Errors
/// Whatever the user can mend.
pub fn attempt(arguments: impl IntoIterator<Item = OsString>) -> Result<u8, Error> {
    let mut command = command();
    let given: Vec<OsString> = arguments.into_iter().collect();
    if words::list_scenes(&given) {
        return print(&scenes::list()).map(|()| 0);
    }
    if let Some(page) = help::asked(&given, &command) {
        return page.and_then(|page| print(&page)).map(|()| 0);
    }
    let given = words::with_command(given, &command)?;
    let read = advise::with_machine(given.clone());
    let renamed = read != given;
    let matches = match command.try_get_matches_from_mut(read) {
        Ok(matches) => matches,
        Err(error) if error.kind() == ErrorKind::InvalidUtf8 => return Err(not_unicode(&given)),
        Err(error) => return usage(&error, renamed, &given),
    };
    silence(matches.subcommand().is_some_and(|(_, options)| is_quiet(options)));
    match matches.subcommand() {
        Some(("advise", scene)) => advise::run(scene),
        Some(("bake", scene)) => bake::run(scene).map(|()| 0),
        Some(("compare", pictures)) => compare::run(pictures),
        Some(("completions", words)) => completions(words).map(|()| 0),
        Some(("man", _)) => man().map(|()| 0),
        Some(("info", model)) => info::run(model).map(|()| 0),
        #[cfg(feature = "window")]
        Some(("view", render)) => super::view::run(render, &given).map(|()| 0),
        Some(("watch", render)) => watch::run(render).map(|()| 0),
        Some(("explain", pixel)) => explain::run(pixel).map(|()| 0),
        Some(("turntable", film)) => turntable::run(film).map(|()| 0),
        Some(("assemble", pictures)) => turntable::assemble(pictures).map(|()| 0),
        Some((_, render)) => draw(render).map(|()| 0),
        // Words without a command ask for help.
        None => Ok(0),
    }
}

/// The command as it is read and explained.
pub(super) fn command() -> Command {
    Cli::command().args_override_self(true).mut_subcommands(|command| {
        let command = command.mut_args(|argument| {
            let takes_values = argument.get_action().takes_values() && !argument.is_positional();
            in_any_case(argument).allow_negative_numbers(takes_values)
        });
        match command.get_name() {
            "explain" => hidden(command, &OF_PICTURES),
            "turntable" => turntable::without_pictures(command),
            "info" | "bake" => bake::with_defaults(command),
            "advise" => hidden(hidden(command, &OF_PICTURES), &advise::ADVISED_ON),
            _ => command,
        }
    })
}

/// A choice of words, whatever their case.
fn in_any_case(argument: Arg) -> Arg {
    let is_choice = argument.get_action().takes_values() && !argument.get_possible_values().is_empty();
    argument.ignore_case(is_choice)
}

/// Whether a command that can be quiet is to be.
fn is_quiet(options: &ArgMatches) -> bool {
    options.try_get_one::<bool>("quiet").ok().flatten().is_some_and(|&quiet| quiet)
}

/// Help and version are no errors. All others get one line like any other input, with clap's suggestions. `renamed`
/// says that the machine was given as a target.
fn usage(error: &clap::Error, renamed: bool, words: &[OsString]) -> Result<u8, Error> {
    let expected = match error.kind() {
        ErrorKind::ValueValidation => std::error::Error::source(error).map(ToString::to_string),
        ErrorKind::InvalidValue => error.get(ContextKind::ValidValue).map(one_of),
        _ => None,
    };
    let context = |kind| error.get(kind).map(ToString::to_string);
    // An option without its value's name. A model stands for itself, in brackets.
    let named = |text: &str| match text.split(' ').next().unwrap_or_default() {
        "--machine" if renamed => "--target".to_owned(),
        "[MODEL.obj" => "a model".to_owned(),
        option if option.starts_with('-') => option.split('[').next().unwrap_or(option).to_owned(),
        _ => text.trim_start_matches('[').trim_end_matches(']').to_owned(),
    };
    let option = context(ContextKind::InvalidArg).map(|option| named(&option));
    let given = context(ContextKind::InvalidValue);
    let value = given.as_ref().map(|value| quote(value.as_bytes()));
    let or_nothing = |value: Option<String>| value.unwrap_or_else(|| "nothing".to_owned());
    let (found, expected) = match error.kind() {
        ErrorKind::DisplayHelp
        | ErrorKind::DisplayVersion
        | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            // A closed pipe cannot be told about.
            let _ = error.print();
            return Ok(if error.use_stderr() { FAILURE } else { 0 });
        }
        ErrorKind::MissingRequiredArgument => {
            let missing = context(ContextKind::InvalidArg).unwrap_or_default();
            let expected = match missing.as_str() {
                "<SHELL>" => format!("a shell as well, one of {}", shells()),
                _ => format!("{missing} as well"),
            };
            return Err(Error::new("too few words", expected).hint("see --help"));
        }
        ErrorKind::ArgumentConflict => {
            let other = context(ContextKind::PriorArg).map(|other| named(&other)).unwrap_or_default();
            (format!("it beside {other}"), "one of the two".to_owned())
        }
        ErrorKind::UnknownArgument if option.as_ref().is_some_and(|word| word.parse::<f64>().is_ok()) => (
            "a number on its own".to_owned(),
            "an option, or numbers that belong together with commas, as 0,1.5,-3".to_owned(),
        ),
        ErrorKind::UnknownArgument
            if words.get(1).is_some_and(|word| word == "assemble")
                && option.as_ref().is_some_and(|option| !option.starts_with('-')) =>
        {
            let expected = "one name for all pictures, such as frames/%04d.png";
            ("the names of several pictures".to_owned(), expected.to_owned())
        }
        ErrorKind::UnknownArgument if option.as_ref().is_some_and(|option| !option.starts_with('-')) => {
            let another = option.as_deref().unwrap_or_default();
            let has_picture = words
                .get(1)
                .is_some_and(|word| ["render", "watch", "view"].map(OsString::from).contains(word));
            let expected = if has_picture && Output::is_format_of(Path::new(another)) {
                format!("-o {another} for the picture")
            } else if another.to_ascii_lowercase().ends_with(".obj") {
                "no other file: a scene file has several models".to_owned()
            } else {
                "no other file or word".to_owned()
            };
            ("one file too many".to_owned(), expected)
        }
        ErrorKind::UnknownArgument => {
            let such = |option: &str| format!("one, such as {option}");
            let meant = option.as_deref().and_then(words::of_others).map(such);
            let owner = option.as_deref().and_then(owner).map(|name| format!("it with alberti {name} alone"));
            let similar = || context(ContextKind::SuggestedArg).map(|option| such(&option));
            let expected = meant.or(owner).or_else(similar);
            ("no such option".to_owned(), expected.unwrap_or_else(|| "one that --help all lists".to_owned()))
        }
        ErrorKind::InvalidValue
            if context(ContextKind::InvalidValue).is_some_and(|value| value.is_empty()) =>
        {
            ("nothing".to_owned(), expected.unwrap_or_else(|| "a value".to_owned()))
        }
        ErrorKind::ValueValidation | ErrorKind::InvalidValue => {
            (or_nothing(value), expected.unwrap_or_else(|| "a value".to_owned()))
        }
        ErrorKind::TooManyValues => (or_nothing(value), "no value".to_owned()),
        _ => ("words that are not understood".to_owned(), "those of --help".to_owned()),
    };
    let is_file = given.is_some_and(|value| Path::new(&value).is_file());
    let truth = match option.as_deref() {
        Some("true" | "yes" | "on") => Some("true"),
        Some("false" | "no" | "off") => Some("false"),
        _ => None,
    };
    let hint = match option.as_deref() {
        _ if truth.is_some() => {
            format!("a truth is joined to its option, as in --ground={}", truth.unwrap_or_default())
        }
        Some(option @ ("--stats" | "--two-sided")) if is_file => {
            format!("the file is taken for the value of {option}: put it first")
        }
        _ => match meant(error) {
            Some(word) => format!("did you mean {word}?"),
            None => "see --help".to_owned(),
        },
    };
    let error = Error::new(found, expected).hint(hint);
    Err(match option {
        Some(option) => error.place(option),
        None => error,
    })
}

/// The error of a word that is no text, and no file either.
fn not_unicode(words: &[OsString]) -> Error {
    let at = words.iter().position(|word| word.to_str().is_none()).unwrap_or_default();
    let before = at.checked_sub(1).and_then(|before| words[before].to_str());
    let option = before.filter(|word| word.starts_with('-')).map(str::to_owned);
    let place = option
        .unwrap_or_else(|| words[at].to_string_lossy().split('=').next().unwrap_or_default().to_owned());
    Error::new("text that is not Unicode", "Unicode").place(place).hint("see --help")
}

/// The value that is most like a wrong one.
fn meant(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidValue) else { return None };
    let Some(ContextValue::Strings(values)) = error.get(ContextKind::ValidValue) else { return None };
    words::nearest(word, values.iter().map(String::as_str)).map(str::to_owned)
}

/// The command that alone has an option of that name.
fn owner(option: &str) -> Option<String> {
    let name = option.strip_prefix("--")?;
    let command = command();
    let has = |command: &&Command| command.get_arguments().any(|argument| argument.get_long() == Some(name));
    let mut owners = command.get_subcommands().filter(has).map(|command| command.get_name().to_owned());
    owners.next().filter(|_| owners.next().is_none())
}

/// Values of which an option takes one, as words.
fn one_of(values: &ContextValue) -> String {
    match values {
        ContextValue::Strings(values) if !values.is_empty() => format!("one of {}", values.join(", ")),
        _ => "a value".to_string(),
    }
}

pub(super) fn fail(error: &Error) -> u8 {
    let _ = writeln!(io::stderr(), "error: {error}");
    FAILURE
}

pub(super) fn draw(matches: &ArgMatches) -> Result<(), Error> {
    let request = Request::read(matches)?;
    draw_from(&request).map_err(|error| request.relocate(error))
}

fn draw_from(request: &Request) -> Result<(), Error> {
    forget();
    request.check()?;
    stage::begin();
    let output = request.output()?;
    if output.is_standard() && io::stdout().is_terminal() {
        let error = Error::new("a terminal", "a file or a pipe for the picture").place("standard output");
        return Err(error.hint("name a file with -o"));
    }
    let beside = request.beside(&output)?;
    request.hold_picture()?;
    let mut staged = request.stage_picture()?;
    // Before the work, since textures and materials are known.
    output.check_unread()?;
    beside.as_ref().map_or(Ok(()), Beside::check_unread)?;
    // Numbers are those of the model, without a ground.
    let seen = staged.camera;
    let numbers = || during(Stage::Numbers, |_| layers(&staged.model, &seen, &staged.options));
    let layers = beside.as_ref().map(|_| numbers()).transpose()?;
    let triangles = staged.model.parts.iter().map(|part| part.triangles.len()).sum();
    request.add_ground(&mut staged, Shadows::Made);
    let Staged { model, camera, options, samples, backdrop, .. } = staged;
    memory::need(bytes_of(&model), "the drawing of a model").map_err(|error| error.place("--memory"))?;
    // The mip maps are those of the picture and of its counts.
    let plain = request.arguments.show.is_none();
    let chains = Arc::new(if plain { Chains::new(&model, &options)? } else { Chains::default() });
    let drawn = |options: &RenderOptions, hear: &mut dyn FnMut(u64, u64)| {
        supersampled_with(&chains, (&model, &camera), options, samples, &backdrop, hear)
    };
    let (mut picture, legend) = during(Stage::Draw, |progress| {
        let hear = &mut |done, total| progress.set(done, total);
        Ok(match request.arguments.show {
            None => (drawn(&options, hear)?, None),
            Some(what) => {
                let Shown { picture, legend, warning } = show(what, &model, &camera, &options, hear)?;
                warning.iter().for_each(|warning| warn(&warning.to_string()));
                (picture, Some(legend.text(io::stdout().is_terminal())))
            }
        })
    })?;
    request.warn_of_nothing(&picture.stats, (&seen, options.cull));
    if request.arguments.stats.is_some() && options.threads.get() > 1 {
        // A triangle counts once, however many threads drew it.
        let alone = RenderOptions { threads: NonZero::<usize>::MIN, ..options };
        picture.stats = during(Stage::Count, |_| drawn(&alone, &mut |_, _| ()))?.stats;
    }

    let seen_through = request.arguments.show.is_none() && backdrop == Backdrop::Transparent;
    during(Stage::Encode, |_| {
        let others = match beside.as_ref().zip(layers.as_ref()) {
            Some((beside, layers)) => beside.encoded(layers, &picture.image, &seen)?,
            None => Vec::new(),
        };
        output.write_beside(&output.encoded(&picture.image, seen_through)?, &others)
    })?;
    let size = (options.width, options.height);
    let projection = options.projection;
    let report = Report {
        output: output.name(),
        source: request.source(),
        size,
        samples: if request.arguments.show.is_some() { Samples::One } else { samples },
        triangles,
        stats: picture.stats,
        times: stage::times(),
        camera,
        origin: model.origin,
        projection,
        wishes: request.arguments.camera,
    };
    let summary = || {
        let files = beside.as_ref().map(|beside| beside.summary(&seen)).unwrap_or_default();
        format!("{}\n{files}", report.summary())
    };
    let text = match request.arguments.stats {
        None if is_silent() => String::new(),
        None => format!("{}{}", summary(), legend.unwrap_or_default()),
        Some(StatsFormat::Text) if is_silent() => report.text(),
        Some(StatsFormat::Text) => format!("{}{}", summary(), report.text()),
        Some(StatsFormat::Json) => format!("{}\n", report.json()),
    };
    if output.is_standard() {
        // The picture has the other way.
        let _ = io::stderr().write_all(text.as_bytes());
        return Ok(());
    }
    print(&text)
}

fn completions(words: &ArgMatches) -> Result<(), Error> {
    let mut script = Vec::new();
    if let Some(&shell) = words.get_one::<clap_complete::Shell>("shell") {
        let command = offered(with_suggestions(with_options(command())));
        clap_complete::generate(shell, &mut { command }, "alberti", &mut script);
    }
    print(&String::from_utf8_lossy(&script))
}

/// The shells that there are completions for.
fn shells() -> String {
    let names: Vec<_> =
        clap_complete::Shell::value_variants().iter().map(|shell| shell.to_string()).collect();
    names.join(", ")
}

/// Values to choose from, of options that take others as well.
const SUGGESTED: [(&str, &[&str]); 8] = [
    ("filter", &["nearest", "bilinear", "trilinear", "anisotropic:4", "anisotropic:16"]),
    ("normals", &["smooth", "flat", "crease", "crease:30"]),
    ("interpolation", &["exact", "plane", "spans:8", "spans:16", "bounded:0.0625", "affine"]),
    ("background", &["transparent", "white", "black", "gray"]),
    ("aov", &["depth", "normal", "uv", "id", "lod", "depth,normal,uv,id,lod"]),
    ("fog", &["none", "linear:1,10", "exp:0.1", "exp2:0.1"]),
    ("light", &["lamp", "-35,50"]),
    ("size", &["640x480", "1280x720", "1920x1080"]),
];

/// The command with values that a shell may suggest.
fn with_suggestions(command: Command) -> Command {
    let topics = PossibleValuesParser::new(help::all_topics(&command));
    // As files, folders get their slash, and spaces are escaped.
    let hinted = |argument: Arg| match argument.get_value_hint() {
        ValueHint::AnyPath => argument.value_hint(ValueHint::FilePath),
        _ => argument,
    };
    let suggested = |argument: Arg| match SUGGESTED.iter().find(|(id, _)| argument.get_id() == id) {
        Some((_, values)) => argument.value_parser(PossibleValuesParser::new(*values)),
        None => hinted(argument),
    };
    let command = command.mut_args(suggested).mut_subcommands(|command| command.mut_args(suggested));
    command.mut_subcommand("help", |help| help.mut_arg("topic", |topic| topic.value_parser(topics)))
}

/// The command without what is hidden.
fn offered(command: Command) -> Command {
    let page = |command: &Command| {
        let shown = command.get_arguments().filter(|argument| !argument.is_hide_set());
        let about = command.get_about().cloned().unwrap_or_default();
        let page = Command::new(command.get_name().to_owned()).about(about).args(shown);
        page.disable_help_subcommand(true)
    };
    let pages: Vec<_> = command.get_subcommands().map(page).collect();
    page(&command).subcommands(pages)
}

/// The command with the options of `render`, whose word may be left out.
fn with_options(command: Command) -> Command {
    let render = command.find_subcommand("render").cloned().unwrap_or_default();
    command.args(render.get_arguments())
}

/// The uses of the command, as the manual page has them.
const SYNOPSIS: &str = "\
.SH SYNOPSIS
\\fBalberti\\fR [\\fBrender\\fR] [\\fIMODEL.obj\\fR | \\fISCENE.toml\\fR] [\\fIOPTIONS\\fR]
.br
\\fBalberti\\fR \\fICOMMAND\\fR ...
.br
\\fBalberti help\\fR [\\fICOMMAND\\fR | \\fITOPIC\\fR]
";

/// The end of the manual page.
const STATUSES: &str = "\
.SH EXIT STATUS
.TP
0
What was asked for is done.
.TP
1
A comparison is beyond its limit.
.TP
2
An error, told in one line; no file is changed by halves.
";

/// The manual page: all options of `render`, and of the other commands what they have of their own.
fn man() -> Result<(), Error> {
    let all = with_options(command());
    let plain = |argument: &&Arg| !["help", "version"].contains(&argument.get_id().as_str());
    let options = |page: Command| {
        let mut text = Vec::new();
        // Writing to memory does not fail.
        let _ = clap_mangen::Man::new(page).render_options_section(&mut text);
        String::from_utf8_lossy(&text).into_owned()
    };
    let alone = Command::new("alberti")
        .version(env!("CARGO_PKG_VERSION"))
        .about(all.get_about().cloned().unwrap_or_default())
        .args(all.get_arguments().filter(plain));
    let mut text = Vec::new();
    let page = clap_mangen::Man::new(alone.clone());
    let _ = page.render_title(&mut text).and_then(|()| page.render_name_section(&mut text));
    let mut text = String::from_utf8_lossy(&text).into_owned();
    text.push_str(SYNOPSIS);
    text.push_str(".SH EXAMPLES\n");
    for (line, meaning) in help::examples() {
        text.push_str(&format!(".TP\n{}\n{meaning}.\n", line.replace('-', "\\-")));
    }
    text.push_str(&options(alone));
    for page in all.get_subcommands().filter(|page| page.get_name() != "render") {
        let name = page.get_name().to_owned();
        let about = page.get_about().cloned().unwrap_or_default();
        text.push_str(&format!(".SH ALBERTI {}\n{about}.\n", name.to_uppercase()));
        let taken = page.get_arguments().filter(|of| plain(of) && !of.is_hide_set());
        let (own, shared): (Vec<&Arg>, Vec<&Arg>) = taken.partition(|of| help::own(&all, &name, of));
        let named: Vec<_> =
            shared.iter().filter_map(|of| of.get_long()).map(|of| format!("\\-\\-{of}")).collect();
        text.push_str(&match named.as_slice() {
            [] => String::new(),
            few @ [_, ..] if few.len() < 8 => {
                format!("Of the options of render it takes {}.\n", few.join(", "))
            }
            _ => "It takes options of render as well.\n".to_owned(),
        });
        let listed = options(Command::new(name).args(own).disable_help_flag(true));
        text.push_str(&listed.replace(".SH OPTIONS\n", "").replace(".SH ", ".SS "));
    }
    text.push_str(STATUSES);
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
