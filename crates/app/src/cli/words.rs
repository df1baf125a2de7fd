//! The words of the command line before they are read: a file or an option may come where a command is expected.

use std::ffi::OsString;
use std::path::Path;

use clap::Command;

use crate::error::{Error, quote};
use crate::scene::scenes;

/// The command that is meant where none is named.
const IMPLIED: &str = "render";

/// Whether the built-in scenes are asked for.
pub(super) fn list_scenes(words: &[OsString]) -> bool {
    before_files(words).any(|word| word == "--list-scenes")
}

/// The words after the program's name, as far as options are read.
pub(super) fn before_files(words: &[OsString]) -> impl Iterator<Item = &OsString> {
    words.iter().skip(1).take_while(|word| *word != "--")
}

/// The words with `render` before a first one that is a file or an option.
///
/// # Errors
/// It is neither of them, and no command.
pub(super) fn with_command(mut words: Vec<OsString>, command: &Command) -> Result<Vec<OsString>, Error> {
    let Some(first) = words.get(1).cloned() else { return Ok(words) };
    let text = first.to_string_lossy();
    if ["-V", "--version"].contains(&&*text) || command.find_subcommand(&first).is_some() {
        return Ok(words);
    }
    let path = Path::new(&first);
    let named_as_file = path.extension().is_some() || path.components().nth(1).is_some() || path.exists();
    if named_as_file || text.starts_with('-') {
        words.insert(1, IMPLIED.into());
        return Ok(words);
    }
    let commands = command.get_subcommands().map(Command::get_name);
    let hint = match nearest(&text, commands) {
        None if &*text == "view" => "this program is built without a window".to_owned(),
        Some(command) => format!("did you mean {command}?"),
        None if scenes::NAMES.contains(&&*text) => format!("did you mean --scene {text}?"),
        None => "see --help".to_owned(),
    };
    let place = if text.is_empty() { quote(b"") } else { text.into_owned() };
    Err(Error::new("no such command and no file", "one of the two").place(place).hint(hint))
}

/// The option for what others call so.
pub(super) fn of_others(option: &str) -> Option<&'static str> {
    Some(match option {
        "--out" | "--outfile" => "--output",
        "--width" | "--height" | "--resolution" | "-w" => "--size WIDTHxHEIGHT",
        "--msaa" | "--aa" | "--antialias" | "--antialiasing" | "--supersample" => "--samples",
        "--camera" | "--position" | "--from" => "--eye",
        "--look-at" | "--lookat" | "--to" | "--center" => "--target",
        "--rotate" | "--angle" | "--yaw" => "--azimuth",
        "--pitch" => "--elevation",
        "--bg" | "--background-color" => "--background",
        "--transparent" | "--alpha" => "--background transparent",
        "--colour" => "--diffuse",
        "--ao-map" => "--ao",
        "--color-map" | "--map" => "--texture",
        "--bump-map" | "--bump" | "--bumpmap" => "--height-map",
        "--normal" | "--normalmap" => "--normal-map",
        "--shadow" | "--shadows" => "--ground",
        "--flat" => "--normals flat",
        "--smooth" => "--normals smooth",
        "--focal-length" => "--fov",
        "--distance" | "--scale" => "--zoom",
        "--exposure" | "--gamma" | "--intensity" | "--gain" => "--brightness",
        "--duration" | "--seconds" | "--length" => "--frames",
        "--format" => "--output-format",
        "--ortho" | "--orthographic" => "--projection parallel",
        "--spp" => "--samples",
        "--silent" => "--quiet",
        "--verbose" => "--stats",
        _ => return None,
    })
}

/// The name that is most like a word, if one is at all.
pub(crate) fn nearest<'a>(word: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let (distance, name) = names.map(|name| (strsim::damerau_levenshtein(word, name), name)).min()?;
    (3 * distance <= word.chars().count().max(name.len())).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_or_an_option_is_rendered() {
        let command = super::super::run::command();
        let told = |line: &str| {
            let words = line.split(' ').map(OsString::from).collect();
            let words = with_command(words, &command).map_err(|error| error.to_string())?;
            Ok(words.join(std::ffi::OsStr::new(" ")).into_string().expect("text"))
        };
        for (line, expected) in [
            ("alberti", "alberti"),
            ("alberti m.obj -q", "alberti render m.obj -q"),
            ("alberti no/m", "alberti render no/m"),
            ("alberti --scene floor", "alberti render --scene floor"),
            ("alberti -", "alberti render -"),
            ("alberti bake m.obj", "alberti bake m.obj"),
            ("alberti --version", "alberti --version"),
        ] {
            assert_eq!(told(line), Ok(expected.to_owned()));
        }
        for (line, expected) in [
            (
                "alberti rednr m.obj",
                "rednr: found no such command and no file, expected one of the two; did you mean render?",
            ),
            #[cfg(not(feature = "window"))]
            (
                "alberti view",
                "view: found no such command and no file, expected one of the two; this program is built without a window",
            ),
            (
                "alberti floor",
                "floor: found no such command and no file, expected one of the two; did you mean --scene floor?",
            ),
            (
                "alberti teapot",
                "teapot: found no such command and no file, expected one of the two; see --help",
            ),
            ("alberti ", "\"\": found no such command and no file, expected one of the two; see --help"),
        ] {
            assert_eq!(told(line), Err(expected.to_owned()));
        }
    }
}
