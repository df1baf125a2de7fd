//! Files by the names that models give them, which were often written on another machine.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

/// A file that a name means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Found {
    pub(crate) path: PathBuf,
    /// Whether it has another name: in other letters, or without the folders before it.
    pub(crate) renamed: bool,
}

/// The name without quotes around it.
fn unquoted(name: &str) -> &str {
    let name = name.trim();
    let within = |quote: char| name.strip_prefix(quote).and_then(|rest| rest.strip_suffix(quote));
    within('"').or_else(|| within('\'')).unwrap_or(name).trim()
}

/// The name of a file at the end of a line, without quotes around it, and without a comment behind it unless there is
/// a file that is called so.
pub(crate) fn file_name<'a>(folder: &Path, rest: &'a str) -> &'a str {
    let whole = unquoted(rest);
    let is_comment = |at: &usize| rest[..*at].chars().next_back().is_none_or(char::is_whitespace);
    match rest.match_indices('#').map(|(at, _)| at).find(is_comment) {
        Some(at) if existing(folder, whole).is_none() => unquoted(&rest[..at]),
        _ => whole,
    }
}

/// The image of that name in the folder: as any file, or in a folder there, or in another format.
pub(crate) fn existing_image(folder: &Path, name: &str) -> Option<Found> {
    existing(folder, name).or_else(|| {
        let slashed = name.replace('\\', "/");
        let base = slashed.rsplit('/').next().filter(|base| !base.is_empty())?;
        Some(Found { path: elsewhere(folder, base)?, renamed: true })
    })
}

/// The file of that name in the folder. Files written on Windows may have `\` between folders. What is not there may be
/// there with other capitals, or beside the file that names it, without the folders of another machine.
pub(crate) fn existing(folder: &Path, name: &str) -> Option<Found> {
    if name.is_empty() {
        return None;
    }
    let slashed = name.replace('\\', "/");
    for name in [name, slashed.as_str()] {
        let path = folder.join(name);
        if path.exists() {
            return Some(Found { path, renamed: false });
        }
    }
    let base = slashed.rsplit('/').next().filter(|base| !base.is_empty())?;
    let relative = !slashed.starts_with('/') && slashed.as_bytes().get(1) != Some(&b':');
    let found = relative.then(|| without_case(folder, &slashed)).flatten();
    let found = found.or_else(|| Some(folder.join(base)).filter(|path| path.exists()));
    let path = found.or_else(|| without_case(folder, base))?;
    // Bytes that are no text have been replaced in the name, and that is no other name.
    let renamed = path.to_string_lossy() != folder.join(slashed).to_string_lossy();
    Some(Found { path, renamed })
}

/// Extensions of images that are read, and of others that textures have.
const READ: [&str; 11] = ["png", "jpg", "jpeg", "bmp", "tga", "webp", "qoi", "ppm", "pgm", "pnm", "gif"];
const OTHERS: [&str; 5] = ["tif", "tiff", "dds", "psd", "exr"];

/// The file of this name in a folder of the folder, or the image of this name in another format, here or there.
fn elsewhere(folder: &Path, base: &str) -> Option<PathBuf> {
    let folders = names_in(folder).into_iter().map(|name| folder.join(name)).filter(|path| path.is_dir());
    let places: Vec<_> = std::iter::once(folder.to_owned()).chain(folders).collect();
    let named = places[1..].iter().find_map(|place| without_case(place, base));
    named.or_else(|| {
        let stem = stem(base, &[&READ[..], &OTHERS].concat())?;
        places.iter().find_map(|place| {
            let other = names_in(place).into_iter().find(|name| {
                let name = name.to_string_lossy();
                self::stem(&name, &READ).as_ref() == Some(&stem)
            })?;
            Some(place.join(other))
        })
    })
}

/// The name of an image in small letters, without its extension, which is one of these.
fn stem(name: &str, extensions: &[&str]) -> Option<String> {
    let (stem, extension) = name.rsplit_once('.')?;
    extensions.iter().any(|known| extension.eq_ignore_ascii_case(known)).then(|| stem.to_lowercase())
}

/// The names in a folder, in order: that of the system is none.
fn names_in(folder: &Path) -> Vec<OsString> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = fs::read_dir(here).into_iter().flatten();
    let mut names: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.file_name())).collect();
    names.sort();
    names
}

/// The file whose name is this but for capitals, and for bytes that are no text, folder by folder.
fn without_case(folder: &Path, name: &str) -> Option<PathBuf> {
    let mut path = folder.to_owned();
    for part in name.split('/').filter(|part| !part.is_empty() && *part != ".") {
        let next = path.join(part);
        if part == ".." || next.exists() {
            path = next;
            continue;
        }
        let lower = part.to_lowercase();
        let is_it = |name: &OsString| name.to_string_lossy().to_lowercase() == lower;
        path = path.join(names_in(&path).into_iter().find(is_it)?);
    }
    path.exists().then_some(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_other_machines_are_found() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join("Maps")).expect("a folder");
        for name in ["wood.png", "Maps/Stone.PNG"] {
            fs::write(folder.path().join(name), "x").expect("a file");
        }
        for (name, found, renamed) in [
            ("wood.png", "wood.png", false),
            ("Maps\\Stone.PNG", "Maps/Stone.PNG", false),
            ("./wood.png", "./wood.png", false),
            ("WOOD.png", "wood.png", true),
            ("maps\\stone.png", "Maps/Stone.PNG", true),
            ("C:\\Users\\x\\wood.png", "wood.png", true),
            ("C:/Users/x/Wood.PNG", "wood.png", true),
            ("/home/x/wood.png", "wood.png", true),
            ("textures/wood.png", "wood.png", true),
            ("..\\nowhere\\wood.png", "wood.png", true),
            ("stone.png", "Maps/Stone.PNG", true),
            ("C:\\x\\STONE.png", "Maps/Stone.PNG", true),
            ("wood.jpg", "wood.png", true),
            ("stone.tif", "Maps/Stone.PNG", true),
        ] {
            let expected = Found { path: folder.path().join(found), renamed };
            assert_eq!(existing_image(folder.path(), name), Some(expected), "{name}");
        }
        for name in ["", "stone.mtl", "wood", "wood.png.jpg", "C:\\x\\other.png", "maps\\other.png"] {
            assert_eq!(existing_image(folder.path(), name), None, "{name}");
        }
        // A library in a folder is that of another model.
        fs::write(folder.path().join("Maps/m.mtl"), "x").expect("a file");
        assert_eq!(existing(folder.path(), "m.mtl"), None);
        fs::write(folder.path().join("Wood #1.png"), "x").expect("a file");
        for (rest, name) in [
            ("wood.png # oak", "wood.png"),
            ("\"wood.png\"\t#oak", "wood.png"),
            ("Wood #1.png", "Wood #1.png"),
            ("\"Wood #1.png\"", "Wood #1.png"),
            ("Wood #2.png", "Wood"),
            ("a#b.png", "a#b.png"),
            ("# none", ""),
        ] {
            assert_eq!(file_name(folder.path(), rest), name);
        }
        for (name, bare) in
            [("\"a b.png\"", "a b.png"), ("'a'", "a"), ("a", "a"), ("\"a", "\"a"), ("\"", "\"")]
        {
            assert_eq!(unquoted(name), bare);
        }
    }
}
