//! Help: a page for each command, with examples first and the common options, and one for each group of options.

use std::borrow::Cow;
use std::ffi::OsString;

use clap::builder::{Resettable, StyledStr};
use clap::{Arg, Command};

use super::manual;
use super::words::{before_files, nearest};
use crate::error::Error;

/// The options of `render` that its page has. All others are in the topics.
const COMMON: [&str; 12] = [
    "model",
    "output",
    "size",
    "scene",
    "background",
    "color_map",
    "eye",
    "view",
    "ground",
    "shading",
    "quiet",
    "stats",
];

/// The topic of options without a heading.
const GENERAL: &str = "output";

/// The topic of all options.
const ALL: &str = "all";

/// The topic of scene files, and their part of the manual.
const SCENE_FILES: (&str, &str) = ("scene-files", "Scene files");

/// The first page.
const FIRST: &str = "\
Usage: alberti MODEL.obj|SCENE.toml [OPTIONS]
       alberti COMMAND ...

Examples:
  alberti teapot.obj                a model, all of it in view, into alberti.png
  alberti cow.obj -s 1920x1080      a larger picture
  alberti cow.obj -o cow.webp       another file, whose name says the format
  alberti wet.toml --shading phong  a scene file, drawn with other light
  alberti --scene floor             a built-in scene
  alberti compare a.png b.png       the difference of two pictures

Commands:
{subcommands}

Help:
  alberti render --help             the common options
  alberti help COMMAND              another command
  alberti help TOPIC                options of one kind, where TOPIC is one of
                                    {topics}
  alberti help all                  all options
  alberti help scene-files          what a scene file can say
";

/// The examples of the first page: lines to type, each with what it makes.
pub(super) fn examples() -> impl Iterator<Item = (&'static str, &'static str)> {
    let (_, rest) = FIRST.split_once("Examples:\n").unwrap_or_default();
    let examples = rest.split("\n\n").next().unwrap_or_default();
    examples
        .lines()
        .filter_map(|line| line.trim().split_once("  "))
        .map(|(line, meaning)| (line, meaning.trim()))
}

/// The help that these words ask for, if they do.
///
/// # Errors
/// There is no such topic.
pub(super) fn asked(given: &[OsString], command: &Command) -> Option<Result<String, Error>> {
    let words: Vec<_> = before_files(given).map(|word| word.to_string_lossy()).collect();
    let lower = |word: Option<&Cow<'_, str>>| word.map(|word| word.to_lowercase());
    let named = |word: &&str| command.find_subcommand(word).is_some();
    let first = words.first().map(|word| &**word);
    if given.len() <= 1 {
        return Some(Ok(first_page(command)));
    }
    let first = first?;
    if first == "help" {
        let topic = lower(words.get(1)).filter(|word| word != "--help" && word != "-h");
        let Some(topic) = topic else { return Some(Ok(first_page(command))) };
        let more = lower(words.get(2));
        let last = if named(&&*topic) { 2 } else { 1 };
        if let Some(word) = words.get(last + 1) {
            let error = Error::new("one word too many", "one command or topic").place(&**word);
            return Some(Err(error.hint(format!("see alberti help {}", words[1..=last].join(" ")))));
        }
        return Some(if last == 2 {
            of_command(command, &topic, more.as_deref())
        } else {
            of_topic(command, &topic)
        });
    }
    let at = words.iter().position(|word| word == "--help" || word == "-h")?;
    let more = lower(words.get(at + 1)).filter(|word| is_topic(command, word));
    match (Some(first).filter(named), more.as_deref()) {
        (Some(name), more) => Some(of_command(command, name, more)),
        (None, Some(topic)) => Some(of_topic(command, topic)),
        (None, None) if at == 0 => Some(Ok(first_page(command))),
        (None, None) => Some(of_command(command, "render", None)),
    }
}

/// All words that help is there for: commands and topics.
pub(super) fn all_topics(command: &Command) -> Vec<String> {
    let commands = command.get_subcommands().map(|command| command.get_name().to_owned());
    let topics = topics(command).into_iter().chain([ALL.to_owned(), SCENE_FILES.0.to_owned()]);
    commands.chain(topics).collect()
}

fn first_page(command: &Command) -> String {
    let topics = topics(command).join(", ");
    let about = command.get_about().map(StyledStr::to_string).unwrap_or_default();
    let template = "{subcommands}";
    let subcommands = command.clone().help_template(template).render_help().to_string();
    let page = FIRST.replace("{topics}", &topics).replace("{subcommands}", subcommands.trim_end());
    format!("{about}.\n\n{page}")
}

/// The page of a command, or with a topic its options of that kind.
fn of_command(command: &Command, name: &str, topic: Option<&str>) -> Result<String, Error> {
    let own = |argument: &Arg| own(command, name, argument);
    let Some(mut page) = command.find_subcommand(name).cloned() else { return Ok(String::new()) };
    page = page.bin_name(format!("alberti {name}"));
    if page.get_arguments().all(own) && name != "render" {
        let template = "{about-with-newline}\n{usage-heading} {usage}{after-help}\n\n{all-args}";
        return Ok(text(page.help_template(template).render_long_help()));
    }
    match topic {
        Some(ALL) => {
            let template = "{about-with-newline}\n{usage-heading} {usage}{after-help}\n\n{all-args}";
            Ok(text(page.help_template(template).render_long_help()))
        }
        Some(topic) if is_topic(command, topic) => {
            let has = page.get_arguments().any(|argument| is_shown(argument, topic));
            if has { Ok(options(page, topic)) } else { Err(no_options(name, topic)) }
        }
        Some(topic) => Err(no_options(name, topic)),
        None => {
            let common = |argument: &Arg| match name {
                "render" => COMMON.contains(&argument.get_id().as_str()),
                _ => own(argument) || argument.get_id() == "model",
            };
            // With options, of which the page may have none.
            let usage = page.render_usage().to_string();
            let page = page.override_usage(usage.trim_start_matches("Usage: ").to_owned());
            let page = page.mut_args(|argument| {
                let hidden = argument.is_hide_set() || !common(&argument);
                let takes_values = argument.get_action().takes_values();
                let long = argument.get_help().cloned();
                argument.hide(hidden).hide_possible_values(takes_values).long_help(Resettable::from(long))
            });
            let template = "{about-with-newline}\n{usage-heading} {usage}{after-help}\n\n{all-args}";
            let page = text(page.help_template(template).render_help());
            Ok(format!("{page}{}", pointers(command, name)))
        }
    }
}

/// Whether an option belongs to a command alone.
pub(super) fn own(command: &Command, name: &str, argument: &Arg) -> bool {
    let shared = command.find_subcommand("render");
    let shared = shared.is_some_and(|render| render.get_arguments().any(|of| is_same(of, argument)));
    name == "render" || !shared
}

/// Whether two commands have an option in common, which stands in the same topic.
fn is_same(of: &Arg, other: &Arg) -> bool {
    of.get_id() == other.get_id() && of.get_help_heading() == other.get_help_heading()
}

/// The options of other pages, by name.
fn pointers(command: &Command, name: &str) -> String {
    let Some(render) = command.find_subcommand(name) else { return String::new() };
    let mut text = String::new();
    for topic in topics(command) {
        let of_topic = render.get_arguments().filter(|argument| {
            is_shown(argument, &topic) && (name == "render" || !own(command, name, argument))
        });
        let mut line = format!("  {topic:<11}");
        for option in of_topic.filter_map(Arg::get_long) {
            if line.len() + option.len() + 3 > 80 {
                text.push_str(&format!("{}\n", line.trim_end()));
                line = " ".repeat(13);
            }
            line.push_str(&format!("--{option} "));
        }
        if !line.trim_end().ends_with(&topic) {
            text.push_str(&format!("{}\n", line.trim_end()));
        }
    }
    if text.is_empty() {
        return text;
    }
    format!("\nMore options, by alberti help {name} TOPIC:\n{text}  all        everything\n")
}

fn of_topic(command: &Command, topic: &str) -> Result<String, Error> {
    match command.find_subcommand("render").cloned() {
        _ if topic == ALL => of_command(command, "render", Some(ALL)),
        _ if topic == SCENE_FILES.0 => Ok(manual::section(SCENE_FILES.1)),
        Some(render) if is_topic(command, topic) => {
            let page = options(render, topic);
            let more = if topic == "scene" { "\nOf scene files: alberti help scene-files\n" } else { "" };
            Ok(page + more)
        }
        _ => Err(no_topic(command, topic)),
    }
}

/// Whether an option of a command is in a topic's page.
fn is_shown(argument: &Arg, topic: &str) -> bool {
    topic_of(argument) == topic && !argument.is_hide_set() && !argument.is_positional()
}

/// The options of a topic, with all that is said of them.
fn options(page: Command, topic: &str) -> String {
    let page = page.mut_args(|argument| {
        let hidden = !is_shown(&argument, topic);
        argument.hide(hidden)
    });
    let mut page = page.disable_help_flag(true).help_template("{all-args}");
    text(page.render_long_help())
}

fn no_options(name: &str, topic: &str) -> Error {
    let error = Error::new(format!("no such options of `{name}`"), "a topic of its page").place(topic);
    error.hint(format!("see alberti help {name}"))
}

fn no_topic(command: &Command, topic: &str) -> Error {
    let topics = topics(command);
    let topics = || topics.iter().map(String::as_str).chain([SCENE_FILES.0]);
    let known = || command.get_subcommands().map(Command::get_name).chain(topics());
    let error = Error::new(
        "no such command or topic",
        format!("one of {}", known().chain([ALL]).collect::<Vec<_>>().join(", ")),
    );
    let error = error.place(topic);
    let option = topic.trim_start_matches('-');
    let options = command.find_subcommand("render").into_iter().flat_map(Command::get_arguments);
    match options.filter(|argument| argument.get_long() == Some(option)).map(topic_of).next() {
        Some(of) => error.hint(format!("--{option} is in alberti help {of}")),
        None => match nearest(topic, known()) {
            Some(name) => error.hint(format!("did you mean {name}?")),
            None => error,
        },
    }
}

fn is_topic(command: &Command, word: &str) -> bool {
    word == ALL || topics(command).iter().any(|topic| topic == word)
}

/// The groups of the options of `render`, in their order.
fn topics(command: &Command) -> Vec<String> {
    let render = command.find_subcommand("render");
    let mut topics = vec![GENERAL.to_owned()];
    for topic in render.into_iter().flat_map(Command::get_arguments).map(topic_of) {
        if !topics.contains(&topic) {
            topics.push(topic);
        }
    }
    topics
}

fn topic_of(argument: &Arg) -> String {
    argument.get_help_heading().map_or_else(|| GENERAL.to_owned(), str::to_lowercase)
}

/// Plain text, without empty lines at its end.
fn text(page: StyledStr) -> String {
    // Both options print the same here.
    let page =
        page.to_string().replace(" (see more with '--help')", "").replace(" (see a summary with '-h')", "");
    format!("{}\n", page.trim_end())
}
