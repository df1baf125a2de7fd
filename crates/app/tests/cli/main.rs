//! The `alberti` command from outside: what it prints, how it ends, and which files it leaves.

mod advise;
mod afterwards;
mod aov;
mod bake;
mod compare;
mod errors;
mod explain;
mod film;
mod info;
mod light;
mod materials;
mod models;
mod nothing;
mod picture;
mod policies;
mod projection;
mod scenes;
mod show;
mod stress;
mod success;
mod usage;
mod watch;

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A triangle with everything.
const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n";

/// A folder to run the command in, deleted at the end.
struct Folder(tempfile::TempDir);

/// What a run of the command left behind.
#[derive(Debug)]
struct Run {
    status: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Folder {
    /// A folder with these files.
    fn with(files: &[(&str, &[u8])]) -> Self {
        let folder = Self(tempfile::tempdir().expect("a folder for the test"));
        for (name, bytes) in files {
            fs::write(folder.path(name), bytes).expect("a file for the test");
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs `alberti render` with these arguments in the folder.
    fn render<S: AsRef<OsStr>>(&self, arguments: &[S]) -> Run {
        alberti(self.0.path(), &[OsStr::new("render")], arguments)
    }

    /// The names of the files in the folder, sorted.
    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("the folder");
        let mut names: Vec<_> =
            entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Runs a command that has to fail: status 2, one line that contains `parts`, no new file.
    fn fails<S: AsRef<OsStr>>(&self, arguments: &[S], parts: &[&str]) {
        let before = self.names();
        let run = self.render(arguments);
        assert_eq!(run.status, Some(2), "{run:?}");
        assert_eq!(run.stdout, "", "{run:?}");
        assert!(run.stderr.starts_with("error: ") && run.stderr.ends_with('\n'), "{run:?}");
        assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
        for part in ["found ", ", expected "].iter().chain(parts) {
            assert!(run.stderr.contains(part), "{part:?} is not in {}", run.stderr);
        }
        assert_eq!(self.names(), before);
    }

    /// Runs a command that has to succeed.
    fn succeeds<S: AsRef<OsStr>>(&self, arguments: &[S]) -> Run {
        let run = self.render(arguments);
        assert_eq!(run.status, Some(0), "{run:?}");
        run
    }
}

fn alberti<S: AsRef<OsStr>>(folder: &Path, first: &[&OsStr], arguments: &[S]) -> Run {
    let output = Command::new(env!("CARGO_BIN_EXE_alberti"))
        .current_dir(folder)
        .args(first)
        .args(arguments)
        .output()
        .expect("the command");
    Run {
        status: output.status.code(),
        stdout: String::from_utf8(output.stdout).expect("text"),
        stderr: String::from_utf8(output.stderr).expect("text"),
    }
}
