//! The textures of the gallery's scenes, which are made by code: nothing to license, and nothing to lose.
//!
//! The same bytes come out on every machine: integers, basic operations and square roots, and the PNG encoder that
//! `Cargo.lock` names.
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pictures are small, and nothing here is input"
)]

mod bricks;
mod cobbles;
mod field;
mod globes;
mod noise;
mod patterns;
mod picture;
mod sky;

use std::fs;
use std::time::Instant;

use crate::command::Outcome;
use crate::workspace;
use picture::Picture;

/// Where they are written.
const FOLDER: &str = "crates/app/scenes/textures";

/// What all of them may take together.
const MOST_BYTES: usize = 3_500_000;

/// Writes all textures, or with `--check` compares the files with what would be written.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    match arguments {
        [] => write(),
        [flag] if flag == "--check" => check(),
        _ => Err(format!("expected nothing or `--check`, found `{}`", arguments.join(" "))),
    }
}

/// Fails where a file is not what the code makes, is missing, or is made by none.
pub(crate) fn check() -> Outcome {
    let folder = workspace::root().join(FOLDER);
    let files = files()?;
    let mut wrong: Vec<&str> = Vec::new();
    for (name, bytes) in &files {
        if fs::read(folder.join(name)).ok().as_ref() != Some(bytes) {
            wrong.push(name);
        }
    }
    let strays: Vec<String> =
        names_in(&folder)?.into_iter().filter(|name| !files.iter().any(|(known, _)| known == name)).collect();
    wrong.extend(strays.iter().map(String::as_str));
    if wrong.is_empty() {
        println!("assets: {} textures are what the code makes", files.len());
        return Ok(());
    }
    Err(format!(
        "not what the code makes in {FOLDER}: {}; `cargo xtask assets` writes them",
        wrong.join(", ")
    ))
}

fn write() -> Outcome {
    let folder = workspace::root().join(FOLDER);
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let files = files()?;
    for stray in names_in(&folder)?.iter().filter(|name| !files.iter().any(|(known, _)| known == *name)) {
        fs::remove_file(folder.join(stray)).map_err(|error| format!("cannot remove {stray}: {error}"))?;
        println!("removed {stray}");
    }
    for (name, bytes) in &files {
        let path = folder.join(name);
        fs::write(&path, bytes).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        println!("{:>8} bytes  {FOLDER}/{name}", bytes.len());
    }
    Ok(())
}

/// A family of pictures that are made together, each under its name.
type Maps = fn() -> Vec<(&'static str, Picture)>;

/// All files, as (name, content).
fn files() -> Result<Vec<(String, Vec<u8>)>, String> {
    let families: [(&str, Maps); 5] = [
        ("cobbles", cobbles::maps),
        ("bricks", bricks::maps),
        ("patterns", patterns::maps),
        ("globes", globes::maps),
        ("sky", sky::maps),
    ];
    let mut files = Vec::new();
    for (family, maps) in families {
        let start = Instant::now();
        for (name, picture) in maps() {
            let bytes = picture.png().map_err(|error| format!("{name}: {error}"))?;
            files.push((format!("{name}.png"), bytes));
        }
        println!("assets: {family} in {:.1} s", start.elapsed().as_secs_f32());
    }
    let sum: usize = files.iter().map(|(_, bytes)| bytes.len()).sum();
    println!("assets: {sum} bytes in {} textures", files.len());
    if sum > MOST_BYTES {
        return Err(format!("{sum} bytes of textures; {MOST_BYTES} are the most"));
    }
    Ok(files)
}

/// The files in a folder; none if there is no folder.
fn names_in(folder: &std::path::Path) -> Result<Vec<String>, String> {
    let Ok(entries) = fs::read_dir(folder) else { return Ok(Vec::new()) };
    entries
        .map(|entry| entry.map(|entry| entry.file_name().to_string_lossy().into_owned()))
        .collect::<Result<_, _>>()
        .map_err(|error| format!("cannot list {}: {error}", folder.display()))
}
