//! `build-cost` on a workspace of two small crates, with real compilers.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The files of the small workspace, named as in this one.
const FILES: [(&str, &str); 5] = [
    ("Cargo.toml", "[workspace]\nresolver = \"3\"\nmembers = [\"crates/raster\", \"crates/app\"]\n"),
    ("crates/raster/Cargo.toml", "[package]\nname = \"alberti-raster\"\nedition = \"2024\"\n"),
    (
        "crates/raster/src/lib.rs",
        "pub fn answer() -> i32 { 42 }\n#[test]\nfn a() { assert_eq!(answer(), 42) }\n",
    ),
    (
        "crates/app/Cargo.toml",
        "[package]\nname = \"alberti-app\"\nedition = \"2024\"\n[[bin]]\nname = \"alberti\"\npath = \"src/main.rs\"\n\
         [dependencies]\nalberti-raster = { path = \"../raster\" }\n",
    ),
    ("crates/app/src/main.rs", "fn main() { println!(\"{}\", alberti_raster::answer()) }\n"),
];

/// A folder with these files, removed with this value.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let folder = Folder(Path::new(env!("CARGO_TARGET_TMPDIR")).join(name));
        for (path, text) in FILES {
            let path = folder.0.join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        folder
    }

    /// What `cargo xtask build-cost` prints for this workspace, and whether it succeeded.
    fn build_cost(&self, arguments: &[&str]) -> (bool, String, String) {
        let mut xtask = Command::new(env!("CARGO_BIN_EXE_xtask"));
        xtask.arg("build-cost").args(arguments).arg("--of").arg(&self.0);
        // These tests may themselves be among what is measured.
        xtask.env_remove("ALBERTI_COMPILATIONS").env_remove("RUSTC_WRAPPER");
        let output = xtask.env("CARGO_TARGET_DIR", self.0.join("target")).output().unwrap();
        let [stdout, stderr] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        (output.status.success(), stdout, stderr)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).unwrap();
    }
}

/// The measured value in the first row that begins so, and its unit.
fn value<'a>(table: &'a str, row: &str) -> (f64, &'a str) {
    let line =
        table.lines().find(|line| line.starts_with(row)).unwrap_or_else(|| panic!("no `{row}`:\n{table}"));
    let mut words = line.rsplit('|').nth(1).unwrap().split_whitespace();
    (words.next().unwrap().parse().unwrap(), words.next().unwrap())
}

#[test]
fn a_small_workspace_is_measured() {
    let folder = Folder::new("small-workspace");
    let source = folder.0.join("crates/raster/src/lib.rs");
    let modified = || fs::metadata(&source).unwrap().modified().unwrap();
    let before = modified();
    let (success, table, errors) = folder.build_cost(&["--check"]);
    assert!(success, "{table}{errors}");
    assert_eq!(value(&table, "| command, release, from nothing").1, "s");
    assert_eq!(value(&table, "| – binary").1, "MB");
    assert!(value(&table, "| command, release, after an edit").0 < 30.0);
    assert!(value(&table, "| `cargo test --workspace` from nothing").0 > 0.0);
    if cfg!(unix) {
        let (all, own) = (value(&table, "| – processor |").0, value(&table, "| – processor, crates").0);
        assert!(0.0 < own && own <= all, "{table}");
        // No Rust compiler is smaller.
        assert!(value(&table, "| – largest compiler").0 > 20.0, "{table}");
    }
    // The edit compiled both crates anew, and left the file as it was.
    let compiled = errors.matches("Compiling alberti-raster").count();
    assert_eq!((compiled, modified()), (3, before), "{errors}");
    let left = fs::read_dir(folder.0.join("target")).unwrap().count();
    assert_eq!(left, 0, "the target folders stay");
}

#[test]
fn one_part_is_measured_alone() {
    let folder = Folder::new("one-part");
    let (success, table, errors) = folder.build_cost(&["edit"]);
    assert!(success, "{table}{errors}");
    value(&table, "| command, release, after an edit");
    assert!(!table.contains("binary") && !table.contains("`cargo test"), "{table}");
}
