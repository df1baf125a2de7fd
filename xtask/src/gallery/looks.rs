//! Pictures by the app, and a short number of what each looks like: so that a check needs no picture of the size of the
//! gallery's, and no decoder of its formats.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::thread;

use super::Picture;
use crate::command::{Outcome, cargo, run as run_command};
use crate::workspace;

/// The numbers, a line for each picture.
pub(super) const FILE: &str = "docs/gallery/looks.csv";

/// The options of a picture that only its number is made of: the pixels alone, the same on each machine.
const SMALL: [&str; 8] = ["--size", "120x80", "--samples", "1", "--output-format", "ppm", "--output", "-"];

/// The app's program.
pub(super) struct App(PathBuf);

impl App {
    /// Builds it once.
    pub(super) fn build() -> Result<Self, String> {
        run_command(cargo().args(["build", "--release", "--package", "alberti-app"]))?;
        let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
        let program = format!("alberti{}", std::env::consts::EXE_SUFFIX);
        Ok(Self(workspace::root().join(target).join("release").join(program)))
    }

    /// Draws a picture into the folder, and says what it looks like.
    pub(super) fn draw(&self, picture: &Picture<'_>, folder: &Path) -> Result<String, String> {
        let file = picture.file();
        self.run(picture, &["--output".as_ref(), folder.join(&file).as_os_str()])?;
        println!("{file}");
        self.look(picture)
    }

    /// The number of a picture's pixels.
    pub(super) fn look(&self, picture: &Picture<'_>) -> Result<String, String> {
        self.run(picture, &SMALL.map(str::as_ref)).map(|pixels| hash(&pixels))
    }

    fn run(&self, picture: &Picture<'_>, more: &[&std::ffi::OsStr]) -> Result<Vec<u8>, String> {
        let mut app = std::process::Command::new(&self.0);
        app.current_dir(workspace::root()).args(picture.arguments()).args(more);
        let output = app.output().map_err(|error| format!("cannot start {}: {error}", self.0.display()))?;
        if output.status.success() {
            return Ok(output.stdout);
        }
        let told = String::from_utf8_lossy(&output.stderr);
        Err(format!("{}: {}", picture.file(), told.trim_end()))
    }
}

/// FNV-1a of 64 bits.
fn hash(bytes: &[u8]) -> String {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    format!("{:016x}", bytes.iter().fold(0xcbf2_9ce4_8422_2325, step))
}

/// What `work` makes of each, two at a time.
pub(super) fn in_pairs<T: Sync, R: Send>(
    of: &[T],
    work: impl Fn(&T) -> Result<R, String> + Sync,
) -> Result<Vec<R>, String> {
    let mut done = Vec::new();
    for pair in of.chunks(2) {
        let made = thread::scope(|scope| {
            let started: Vec<_> = pair.iter().map(|item| scope.spawn(|| work(item))).collect();
            started
                .into_iter()
                .map(|one| one.join().unwrap_or_else(|_| Err("a thread panicked".into())))
                .collect()
        });
        let made: Vec<Result<R, String>> = made;
        for one in made {
            done.push(one?);
        }
    }
    Ok(done)
}

/// What the pictures look like, by their files.
#[derive(Debug, Default)]
pub(super) struct Looks(BTreeMap<String, String>);

impl Looks {
    /// Those of the pictures in the repository.
    pub(super) fn read() -> Result<Self, String> {
        let text = match fs::read_to_string(workspace::root().join(FILE)) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(format!("cannot read {FILE}: {error}")),
        };
        Ok(Self::parse(&text))
    }

    fn parse(text: &str) -> Self {
        let lines = text.lines().filter_map(|line| line.split_once(','));
        Self(lines.map(|(file, look)| (file.to_string(), look.to_string())).collect())
    }

    fn text(&self) -> String {
        self.0.iter().map(|(file, look)| format!("{file},{look}\n")).collect()
    }

    pub(super) fn of(&self, file: &str) -> Option<&String> {
        self.0.get(file)
    }

    pub(super) fn set(&mut self, file: &str, look: String) {
        self.0.insert(file.to_string(), look);
    }

    /// Forgets all other files.
    pub(super) fn keep(&mut self, files: &[String]) {
        self.0.retain(|file, _| files.contains(file));
    }

    pub(super) fn write(&self) -> Outcome {
        fs::write(workspace::root().join(FILE), self.text())
            .map_err(|error| format!("cannot write {FILE}: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_are_kept_in_a_file() {
        // The known value of \"a\".
        assert_eq!(hash(b"a"), "af63dc4c8601ec8c");
        let mut looks = Looks::parse("b.jpg,1\na.png,2\n");
        looks.set("c.jpg", "3".to_string());
        looks.keep(&["a.png".to_string(), "c.jpg".to_string()]);
        assert_eq!(looks.text(), "a.png,2\nc.jpg,3\n");
        assert_eq!((looks.of("a.png").map(String::as_str), looks.of("b.jpg")), (Some("2"), None));
    }

    #[test]
    fn all_are_worked_on_in_order() {
        assert_eq!(in_pairs(&[1, 2, 3], |k| Ok(k * 2)), Ok(vec![2, 4, 6]));
        assert_eq!(
            in_pairs(&[1, 2, 3], |k| if *k == 2 { Err("two".to_string()) } else { Ok(()) }),
            Err("two".into())
        );
    }
}
