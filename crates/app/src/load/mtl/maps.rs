//! The lines of an MTL file that name images.

use std::path::Path;

use super::entry::UNPLACED;
use super::{Entry, Ignored};
use crate::error::{Error, quote};
use crate::load::paths::{existing_image, file_name};
use crate::load::statements::{Statement, keyword, number};
use crate::options::{MapFile, Origin, Wrap};
use crate::scene::EnvironmentKind;

/// Puts the image that a line names into the material, and returns what there is to warn of. `lower` is the line's
/// first word in small letters, `origin` the line.
pub(super) fn read(
    entry: &mut Entry,
    lower: &[u8],
    line: &Statement<'_>,
    origin: Origin,
    ignored: &mut Ignored,
) -> Vec<Error> {
    let word = line.keyword();
    let (name, mut options) = options(line.rest);
    let folder = origin.file.parent().unwrap_or(Path::new(""));
    let mut name = file_name(folder, &String::from_utf8_lossy(name)).to_owned();
    if let Some((option, rest)) = unknown_option(folder, &name) {
        options.unknown = Some(option.to_owned());
        name = rest.to_owned();
    }
    if name.is_empty() {
        let (found, expected) = (format!("`{word}` without a file"), format!("`{word} FILE`"));
        return vec![Error::new(found, expected).hint("the line is left out")];
    }
    let mut warnings = Vec::new();
    let found = existing_image(folder, &name);
    if let Some(found) = found.as_ref().filter(|found| found.renamed) {
        let shown = found.path.strip_prefix(folder).unwrap_or(&found.path).display().to_string();
        let error = Error::new(format!("no file {}", quote(name.as_bytes())), "the name of an image");
        let key = if lower == b"map_kd" { "color-map" } else { "" };
        warnings.push(error.hint(format!("{} is used", quote(shown.as_bytes()))).about(key));
    }
    // Of directions there is no range.
    let directions = matches!(lower, b"norm" | b"map_norm" | b"refl" | b"map_refl");
    let map = Some(MapFile {
        path: found.map_or_else(|| folder.join(&name), |found| found.path),
        origin: Some(Origin { text: name, ..origin }),
        filter: None,
        wrap: options.clamp.then_some(Wrap::Clamp),
        range: options.range.filter(|range| !directions && *range != [0.0, 1.0]),
    });
    let line_number = line.line;
    let material = &mut entry.material;
    let left_out = lower == b"disp" && material.height_map.is_some();
    match lower {
        b"map_kd" => material.color_map = map,
        b"map_ks" => material.specular_map = map,
        b"map_ns" => material.shininess_map = map,
        b"map_ke" => material.emissive_map = map,
        b"map_d" => entry.alpha_map = map,
        b"map_pr" => entry.roughness_map = map,
        b"map_pm" => entry.metallic_map = map,
        b"norm" | b"map_norm" => {
            material.normal_map = map;
            material.normal_strength = options.multiplier.map(|x| x.clamp(0.0, 100.0).into());
        }
        b"refl" | b"map_refl" => {
            if let Some(kind) = options.kind.filter(|kind| *kind != b"sphere") {
                let found = format!("`{word}` of type {}", quote(kind));
                warnings.push(Error::new(found, "`-type sphere`").hint("the line is left out"));
                return warnings;
            }
            material.environment = map;
            material.environment_kind = Some(EnvironmentKind::Sphere);
        }
        b"disp" if left_out => {
            ignored.add(&format!("`{word}` beside `bump`"), line_number);
        }
        _ => {
            material.height_map = map;
            let gain = options.range.map(|[_, gain]| gain);
            material.height_scale = options.multiplier.map(|by| by * gain.unwrap_or(1.0)).or(gain);
        }
    }
    for (option, word, expected) in &options.broken {
        let found = format!("{} after `{option}`", quote(word));
        warnings.push(Error::new(found, *expected).hint("the option is left out"));
    }
    let bumpy = matches!(lower, b"bump" | b"map_bump" | b"disp" | b"norm" | b"map_norm");
    if options.multiplier.is_some() && !bumpy {
        ignored.add(&format!("`-bm` of `{word}`"), line_number);
    }
    if options.range.is_some() && directions {
        ignored.add(&format!("`-mm` of `{word}`"), line_number);
    }
    if let Some(option) = &options.unknown {
        let error =
            Error::new(format!("{} before the file", quote(option.as_bytes())), "an option of textures");
        warnings.push(error.hint("it is left out"));
    }
    for option in &options.skipped {
        ignored.add(&format!("`{}` of textures", String::from_utf8_lossy(option)), line_number);
    }
    if !left_out {
        let kind = place(entry, lower, options.placed());
        kind.into_iter().for_each(|kind| ignored.add(&kind.replace("MAP", word.as_ref()), line_number));
    }
    warnings
}

/// Places the material's maps as one of them is: that of `Kd`, or without one the first. Returns what is left out.
fn place(entry: &mut Entry, lower: &[u8], placed: [[f32; 2]; 2]) -> Option<&'static str> {
    // Surroundings do not lie on the surface.
    if matches!(lower, b"refl" | b"map_refl") {
        return (placed != UNPLACED).then_some("`-s` or `-o` of `MAP`");
    }
    let before = entry.placed.unwrap_or(placed);
    if lower == b"map_kd" || entry.placed.is_none() {
        entry.placed = Some(placed);
    }
    let (said, kind) = match lower {
        b"map_kd" => (before, "`-s` or `-o` of the map before `MAP`, another than of that"),
        _ => (placed, "`-s` or `-o` of `MAP`, another than of the texture"),
    };
    (before != placed && said != UNPLACED).then_some(kind)
}

/// The options before the file's name.
#[derive(Default)]
struct Options<'a> {
    clamp: bool,
    /// `-bm`.
    multiplier: Option<f32>,
    /// `-mm`.
    range: Option<[f32; 2]>,
    /// Options whose words are no numbers, with the first word and what it should be.
    broken: Vec<(&'static str, &'a [u8], &'static str)>,
    /// `-type`.
    kind: Option<&'a [u8]>,
    /// `-s` and `-o`.
    scale: Option<[f32; 2]>,
    offset: Option<[f32; 2]>,
    /// One that the format has not.
    unknown: Option<String>,
    /// Others.
    skipped: Vec<&'a [u8]>,
}

impl Options<'_> {
    /// The factors of coordinates, and the terms added then.
    fn placed(&self) -> [[f32; 2]; 2] {
        let [scale, offset] = UNPLACED;
        [self.scale.unwrap_or(scale), self.offset.unwrap_or(offset)]
    }
}

/// An option that the format has not and its words, before a file that is there.
fn unknown_option<'n>(folder: &Path, name: &'n str) -> Option<(&'n str, &'n str)> {
    if !name.starts_with('-') || existing_image(folder, name).is_some() {
        return None;
    }
    let ends = name.char_indices().filter(|(_, c)| c.is_whitespace()).map(|(at, _)| at);
    let split = |at: usize| (name[..at].trim(), name[at..].trim());
    ends.map(split).find(|(_, rest)| existing_image(folder, rest).is_some())
}

/// The file's name after the options of a texture line, and those. Names may hold spaces.
fn options(rest: &[u8]) -> (&[u8], Options<'_>) {
    let mut rest = rest;
    let mut options = Options::default();
    while rest.first() == Some(&b'-') {
        let (option, mut after) = keyword(rest);
        let (least, most) = match option.to_ascii_lowercase().as_slice() {
            b"-blendu" | b"-blendv" | b"-cc" | b"-clamp" | b"-imfchan" | b"-type" => (1, 1),
            b"-texres" | b"-boost" | b"-bm" => (1, 1),
            b"-mm" => (2, 2),
            b"-o" | b"-s" | b"-t" => (1, 3),
            // A file whose name begins with a hyphen.
            _ => break,
        };
        let first = keyword(after).0;
        let mut numbers = [None; 3];
        for (n, slot) in numbers.iter_mut().enumerate().take(most) {
            let (argument, next) = keyword(after);
            if n >= least && number(argument).is_none() {
                break;
            }
            *slot = number(argument);
            after = next;
        }
        let pair = |missing: f32| [0, 1].map(|k: usize| numbers[k].unwrap_or(missing));
        match option.to_ascii_lowercase().as_slice() {
            b"-clamp" => options.clamp = first.eq_ignore_ascii_case(b"on"),
            b"-bm" => {
                options.multiplier = number(first);
                options.broken.extend(numbers[0].is_none().then_some(("-bm", first, "a finite number")));
            }
            b"-mm" => {
                options.range = numbers[0].zip(numbers[1]).map(|(base, gain)| [base, gain]);
                let broken = options.range.is_none().then_some(("-mm", first, "two finite numbers"));
                options.broken.extend(broken);
            }
            b"-type" => options.kind = Some(first),
            b"-s" => options.scale = Some(pair(1.0)),
            b"-o" => options.offset = Some(pair(0.0)),
            // The defaults.
            b"-blendu" | b"-blendv" if first.eq_ignore_ascii_case(b"on") => {}
            _ => options.skipped.push(option),
        }
        rest = after;
    }
    (rest, options)
}
