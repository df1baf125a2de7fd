//! Following `docs/firmware.md` word for word: its files are written, its lines typed, its picture looked at.

mod ball;
mod page;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{self, Outcome, cargo};
use crate::embedded::{Target, Toolchain};
use crate::workspace;
use page::Step;

const PAGE: &str = "docs/firmware.md";
/// The versions of dependencies that the boards are built with.
const LOCK: &str = "crates/alberti/examples/boards/Cargo.lock";
/// The line that bakes the reader's model, and the one that builds a program, and runs it.
const BAKE: &str = "cargo run --release -- bake ";
const BUILD: &str = "cargo run --release";
/// Lines that only a machine of one's own takes: they install tools.
const INSTALL: [&str; 2] = ["rustup ", "sudo "];

/// Where the reader is.
struct Reader {
    here: PathBuf,
}

/// Follows the page in a folder that is not in this repository, with a ball for the reader's model.
pub(crate) fn run() -> Outcome {
    let page = workspace::root().join(PAGE);
    let page =
        fs::read_to_string(&page).map_err(|error| format!("cannot read {}: {error}", page.display()))?;
    let steps = page::steps(&page).map_err(|message| format!("{PAGE}, {message}"))?;
    page::must_type(&steps, &[BAKE, BUILD, "cargo new ", "cp "])
        .map_err(|message| format!("{PAGE}: {message}"))?;

    let room = std::env::temp_dir().join("alberti-guide");
    let clone = room.join("alberti");
    if room.exists() {
        fs::remove_dir_all(&room).map_err(|error| format!("cannot remove {}: {error}", room.display()))?;
    }
    imitate(&clone)?;
    ball::write(&clone)?;
    let mut reader = Reader { here: clone };
    for step in &steps {
        match step {
            Step::Written { path, text } => reader.write(path, text)?,
            Step::Typed(lines) => lines.iter().try_for_each(|line| reader.follow(line))?,
        }
    }
    let picture = room.join("turntable/emulator/frame.ppm");
    let bytes = fs::read(&picture).map_err(|error| format!("cannot read {}: {error}", picture.display()))?;
    ball::compare(&bytes).map_err(|message| format!("{}: {message}", picture.display()))?;
    println!("{PAGE} was followed in {}; its picture is that of rays", room.display());
    Ok(())
}

/// Makes a folder that looks like a clone of this repository, by links to what is in it.
fn imitate(clone: &Path) -> Outcome {
    let failed = |error: std::io::Error| format!("cannot make {}: {error}", clone.display());
    fs::create_dir_all(clone).map_err(failed)?;
    for entry in fs::read_dir(workspace::root()).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if entry.file_name() != ".git" && entry.file_name() != "target" {
            link(&entry.path(), &clone.join(entry.file_name())).map_err(failed)?;
        }
    }
    Ok(())
}

#[cfg(unix)]
fn link(from: &Path, to: &Path) -> std::io::Result<()> {
    std::os::unix::fs::symlink(from, to)
}

#[cfg(not(unix))]
fn link(_: &Path, _: &Path) -> std::io::Result<()> {
    Err(std::io::Error::other("links to folders need Unix"))
}

impl Reader {
    fn write(&self, path: &str, text: &str) -> Outcome {
        let path = self.here.join(path);
        fs::write(&path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
    }

    fn follow(&mut self, line: &str) -> Outcome {
        if INSTALL.iter().any(|word| line.starts_with(word)) {
            return Ok(());
        }
        if let Some(folder) = line.strip_prefix("cd ") {
            self.here = self.here.join(folder);
            return Ok(());
        }
        if let Some(arguments) = line.strip_prefix(BAKE) {
            // The program of the tests, which is there already: it bakes the same.
            let mut bake = cargo();
            bake.args(["build", "--quiet", "--workspace", "--bin", "alberti"]);
            command::run(&mut bake)?;
            let mut bake = Command::new(workspace::target_directory().join("debug/alberti"));
            return command::run(bake.arg("bake").args(arguments.split_whitespace()).current_dir(&self.here));
        }
        if line == BUILD {
            return self.build();
        }
        command::run(Command::new("sh").args(["-c", line]).current_dir(&self.here))
    }

    /// Builds the program here for its target, and runs it if that is an emulator's.
    fn build(&self) -> Outcome {
        let lock = self.here.join("../Cargo.lock");
        fs::copy(workspace::root().join(LOCK), &lock)
            .map_err(|error| format!("cannot write {}: {error}", lock.display()))?;
        let target = self.target()?;
        let directory = workspace::target_directory().join("boards");
        // Nothing is flashed: there is no board.
        let subcommand = if self.here.ends_with("emulator") { "run" } else { "build" };
        let mut build = Toolchain::find(target)?.cargo_in(&directory, subcommand, target);
        command::run(build.arg("--release").current_dir(&self.here))
    }

    /// The target that the folder's configuration names.
    fn target(&self) -> Result<Target, String> {
        let file = self.here.join(".cargo/config.toml");
        let text =
            fs::read_to_string(&file).map_err(|error| format!("cannot read {}: {error}", file.display()))?;
        let known = ["thumbv6m-none-eabi", "thumbv7em-none-eabihf"];
        let named = known.into_iter().find(|triple| text.contains(&format!("target = \"{triple}\"")));
        named.map(Target::of).ok_or_else(|| format!("{}: no target of {}", file.display(), known.join(", ")))
    }
}
