//! Command lines of `render`, as they are made of words, and as a shell takes them.

use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

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

/// The command line of `render` with these words, but for those that what is chosen replaces by other options.
pub(super) fn words_of(words: &[OsString], chosen: &Chosen, [width, height]: [u32; 2]) -> Vec<OsString> {
    let end = end_of_options(words);
    let mut all: Vec<OsString> = ["alberti", "render"].map(OsString::from).to_vec();
    all.extend(without(&words[..end], &chosen.replaced(&words[..end])));
    all.extend(chosen.options.iter().map(|(option, value)| format!("{option}={value}").into()));
    all.extend(chosen.camera.iter().flat_map(|camera| camera.split_whitespace()).map(OsString::from));
    all.extend(chosen.time.map(|time| format!("--time={time}").into()));
    all.extend(["--size".to_owned(), format!("{width}x{height}")].map(OsString::from));
    all.extend_from_slice(&words[end..]);
    all
}

/// All options that say how a camera stands, but for its planes.
const PLACES: [&str; 11] = [
    "--eye",
    "--target",
    "--up",
    "--azimuth",
    "--elevation",
    "--view",
    "--roll",
    "--zoom",
    "--fov",
    "--projection",
    "--view-height",
];

impl Chosen {
    /// The options of a command line that would contradict what is chosen.
    fn replaced(&self, words: &[OsString]) -> Vec<&'static str> {
        let mut replaced = vec!["--size"];
        if self.camera.is_some() {
            return [&replaced[..], &PLACES].concat();
        }
        if self.options.iter().any(|(option, _)| *option == "--view") {
            replaced.extend(["--view", "--azimuth", "--elevation"]);
            if words.iter().any(|word| is_option(word, "--eye")) {
                // The planes are as far from that eye.
                replaced.extend(["--eye", "--near", "--far"]);
            }
        }
        if self.options.contains(&("--projection", "perspective")) {
            replaced.push("--view-height");
        }
        replaced
    }
}

/// Words without these options and their values.
fn without(words: &[OsString], options: &[&str]) -> Vec<OsString> {
    let mut kept = Vec::with_capacity(words.len());
    let mut words = words.iter();
    while let Some(word) = words.next() {
        match options.iter().find(|option| is_option(word, option)) {
            Some(option) if word == *option => _ = words.next(),
            Some(_) => {}
            None => kept.push(word.clone()),
        }
    }
    kept
}

/// Whether a word is an option, by itself or with its value.
fn is_option(word: &OsStr, option: &str) -> bool {
    let rest = word.to_str().and_then(|word| word.strip_prefix(option));
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('='))
}

/// # Errors
/// They are no command line of `render`.
pub(super) fn matches_of(words: Vec<OsString>) -> Result<ArgMatches, Error> {
    let matches = command().try_get_matches_from(words);
    let matches = matches.map_err(|error| Error::new(error.to_string(), "what --help lists"))?;
    let render = matches.subcommand_matches("render").cloned();
    render.ok_or_else(|| Error::new("no command", "render"))
}

/// The first of the pictures `STEM-1.png`, `STEM-2.png` and so on that is not there.
pub(super) fn unused(stem: &str, extension: &str) -> PathBuf {
    let mut names = (1_u32..).map(|k| PathBuf::from(format!("{stem}-{k}.{extension}")));
    names.find(|name| !name.exists()).unwrap_or_default()
}
