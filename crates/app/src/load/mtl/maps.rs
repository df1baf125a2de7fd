//! The lines of an MTL file that name images.

use std::path::Path;

use crate::error::{Error, quote};
use crate::load::libraries::existing;
use crate::load::statements::{Statement, keyword, number};
use crate::options::{MapFile, Material, Origin, Wrap};
use crate::scene::EnvironmentKind;

/// Puts the image that a line names into the material, and returns what there is to warn of. `lower` is the line's
/// first word in small letters, `origin` the line.
pub(super) fn read(
    material: &mut Material,
    lower: &[u8],
    line: &Statement<'_>,
    origin: Origin,
) -> Option<Error> {
    let word = line.keyword();
    let (name, options) = options(line.rest);
    let name = String::from_utf8_lossy(name).trim().to_owned();
    if name.is_empty() {
        let (found, expected) = (format!("`{word}` without a file"), format!("`{word} FILE`"));
        return Some(Error::new(found, expected).hint("the line is left out"));
    }
    let folder = origin.file.parent().unwrap_or(Path::new(""));
    let map = Some(MapFile {
        path: existing(folder, &name).unwrap_or_else(|| folder.join(&name)),
        origin: Some(Origin { text: name, ..origin }),
        filter: None,
        wrap: options.clamp.then_some(Wrap::Clamp),
    });
    let mut skipped = options.skipped;
    match lower {
        b"map_kd" => material.color_map = map,
        b"map_ks" => material.specular_map = map,
        b"map_ns" => material.shininess_map = map,
        b"map_ke" => material.emissive_map = map,
        b"norm" => {
            material.normal_map = map;
            material.normal_strength = options.multiplier.map(|x| x.clamp(0.0, 100.0).into());
        }
        b"refl" => {
            if let Some(kind) = options.kind.filter(|kind| *kind != b"sphere") {
                let found = format!("`{word}` of type {}", quote(kind));
                return Some(Error::new(found, "`-type sphere`").hint("the line is left out"));
            }
            material.environment = map;
            material.environment_kind = Some(EnvironmentKind::Sphere);
        }
        _ => {
            material.height_map = map;
            material.height_scale = options.multiplier;
        }
    }
    if let Some(found) = options.broken {
        let found = format!("{} after `-bm`", quote(found));
        return Some(Error::new(found, "a finite number").hint("the option is left out"));
    }
    skipped |= options.multiplier.is_some() && !matches!(lower, b"bump" | b"map_bump" | b"norm");
    skipped.then(|| {
        let (found, expected) = (format!("`{word}` with options"), format!("`{word} FILE`"));
        Error::new(found, expected).hint("the options are left out")
    })
}

/// The options before the file's name.
#[derive(Default)]
struct Options<'a> {
    clamp: bool,
    /// `-bm`.
    multiplier: Option<f32>,
    /// The word after `-bm`, if it is no number.
    broken: Option<&'a [u8]>,
    /// `-type`.
    kind: Option<&'a [u8]>,
    /// Whether there are others.
    skipped: bool,
}

/// The file's name after the options of a texture line, and those. Names may hold spaces.
fn options(rest: &[u8]) -> (&[u8], Options<'_>) {
    let mut rest = rest;
    let mut options = Options::default();
    while rest.first() == Some(&b'-') {
        let (option, mut after) = keyword(rest);
        let (least, most) = match option {
            b"-blendu" | b"-blendv" | b"-cc" | b"-clamp" | b"-imfchan" | b"-type" => (1, 1),
            b"-texres" | b"-boost" | b"-bm" => (1, 1),
            b"-mm" => (2, 2),
            b"-o" | b"-s" | b"-t" => (1, 3),
            // A file whose name begins with a hyphen.
            _ => break,
        };
        let first = keyword(after).0;
        for n in 0..most {
            let (argument, next) = keyword(after);
            if n >= least && number(argument).is_none() {
                break;
            }
            after = next;
        }
        match option {
            b"-clamp" => options.clamp = first.eq_ignore_ascii_case(b"on"),
            b"-bm" => {
                options.multiplier = number(first);
                options.broken = options.multiplier.is_none().then_some(first);
            }
            b"-type" => options.kind = Some(first),
            _ => options.skipped = true,
        }
        rest = after;
    }
    (rest, options)
}
