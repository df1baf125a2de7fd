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
/// The program's library, the words that its budget begins with, and a budget that it exceeds.
const LIBRARY: &str = "../src/lib.rs";
const BUDGET: &str = "Room::must_fit(";
const SMALL: u32 = 1000;
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
    reader.here = room.join("turntable/emulator");
    reader.overspend()?;
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

/// Fails unless the compiler's message has the bytes that the renderer takes, and those that are too many.
fn told(message: &str) -> Outcome {
    let number = |words: &str| {
        let (_, rest) = message.split_once(words)?;
        rest.split_once(' ')?.0.parse::<u32>().ok()
    };
    let taken = number("the renderer's memory takes ");
    let beyond = taken.and_then(|taken| number(&format!("takes {taken} bytes, ")));
    let sum = beyond.filter(|beyond| message.contains(&format!("{beyond} more than {SMALL}")));
    match (taken, sum.map(|beyond| beyond + SMALL)) {
        (Some(taken), Some(sum)) if taken == sum => Ok(()),
        _ => {
            Err(format!("the compiler does not say how far a budget of {SMALL} bytes is exceeded: {message}"))
        }
    }
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
            // In the folder of this repository's builds, where the gallery's is already.
            command::run(cargo().args(["build", "--release", "--quiet", "--bin", "alberti"]))?;
            let mut bake = Command::new(workspace::target_directory().join("release/alberti"));
            return command::run(bake.arg("bake").args(arguments.split_whitespace()).current_dir(&self.here));
        }
        if line == BUILD {
            return self.build();
        }
        command::run(Command::new("sh").args(["-c", line]).current_dir(&self.here))
    }

    /// Gives the program too small a budget, and reads what the compiler says of it.
    fn overspend(&self) -> Outcome {
        let library = self.here.join(LIBRARY);
        let failed = |error| format!("cannot change {}: {error}", library.display());
        let text = fs::read_to_string(&library).map_err(failed)?;
        let (before, rest) = text.split_once(BUDGET).ok_or_else(|| format!("no `{BUDGET}` in {LIBRARY}"))?;
        let (_, after) = rest.split_once(')').ok_or_else(|| format!("no end of `{BUDGET}` in {LIBRARY}"))?;
        fs::write(&library, format!("{before}{BUDGET}{SMALL}){after}")).map_err(failed)?;
        let outcome = command::output(&mut self.building()?);
        fs::write(&library, text).map_err(failed)?;
        match outcome {
            Ok(_) => Err(format!("a budget of {SMALL} bytes was kept")),
            Err(message) => told(&message),
        }
    }

    /// Builds the program here for its target, and runs it if that is an emulator's.
    fn build(&self) -> Outcome {
        command::run(&mut self.building()?)
    }

    fn building(&self) -> Result<Command, String> {
        let lock = self.here.join("../Cargo.lock");
        fs::copy(workspace::root().join(LOCK), &lock)
            .map_err(|error| format!("cannot write {}: {error}", lock.display()))?;
        let target = self.target()?;
        let directory = workspace::target_directory().join("boards");
        // Nothing is flashed: there is no board.
        let subcommand = if self.here.ends_with("emulator") { "run" } else { "build" };
        let mut build = Toolchain::find(target)?.cargo_in(&directory, subcommand, target);
        build.arg("--release").current_dir(&self.here);
        Ok(build)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_message_with_its_numbers_is_taken() {
        let message = |taken, beyond| {
            format!(
                "error[E0080]: evaluation panicked: the renderer's memory takes {taken} bytes, {beyond} more than 1000\n"
            )
        };
        assert_eq!(told(&message(3000, 2000)), Ok(()));
        for wrong in [message(3000, 2001), "evaluation panicked: the renderer's memory takes 1 byte".into()] {
            assert!(told(&wrong).unwrap_err().contains(&wrong));
        }
    }
}
