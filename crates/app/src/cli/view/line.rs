//! Command lines of `render`, as they are made of words, and as a shell takes them.

use std::ffi::{OsStr, OsString};

use clap::ArgMatches;

use crate::cli::run::command;
use crate::error::Error;

/// A word as a shell takes it.
pub(super) fn typed(word: &OsStr) -> String {
    let text = word.to_string_lossy();
    let is_plain = |c: char| c.is_alphanumeric() || "-_./:=,+@%#".contains(c);
    if !text.is_empty() && !text.starts_with('#') && text.chars().all(is_plain) {
        return text.into_owned();
    }
    format!("'{}'", text.replace('\'', "'\\''"))
}

/// The place before the `--` behind which there are files alone.
pub(super) fn end_of_options(words: &[OsString]) -> usize {
    words.iter().position(|word| word == "--").unwrap_or(words.len())
}

/// Words that are chosen beside those of the command line.
#[derive(Default)]
pub(super) struct Chosen {
    pub(super) options: Vec<(&'static str, &'static str)>,
    pub(super) camera: Option<String>,
    pub(super) time: Option<f64>,
}

/// The command line of `render` with these words.
pub(super) fn words_of(words: &[OsString], chosen: &Chosen, [width, height]: [u32; 2]) -> Vec<OsString> {
    let end = end_of_options(words);
    let mut all: Vec<OsString> = ["alberti", "render"].map(OsString::from).to_vec();
    all.extend_from_slice(&words[..end]);
    all.extend(chosen.options.iter().map(|(option, value)| format!("{option}={value}").into()));
    all.extend(chosen.camera.iter().flat_map(|camera| camera.split_whitespace()).map(OsString::from));
    all.extend(chosen.time.map(|time| format!("--time={time}").into()));
    all.extend(["--size".to_owned(), format!("{width}x{height}")].map(OsString::from));
    all.extend_from_slice(&words[end..]);
    all
}

/// # Errors
/// They are no command line of `render`.
pub(super) fn matches_of(words: Vec<OsString>) -> Result<ArgMatches, Error> {
    let matches = command().try_get_matches_from(words);
    let matches = matches.map_err(|error| Error::new(error.to_string(), "what --help lists"))?;
    let render = matches.subcommand_matches("render").cloned();
    render.ok_or_else(|| Error::new("no command", "render"))
}
