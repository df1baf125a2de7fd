//! Programs of the registry that chores run. They are installed beside what is built, where they are not here.

use std::path::PathBuf;
use std::process::Command;

use crate::command::{cargo, output, run};
use crate::workspace;

/// The program of a package in just this version. More arguments are for `cargo install`.
pub(crate) fn find(package: &str, version: &str, more: &[&str]) -> Result<PathBuf, String> {
    let is_it = |path: &PathBuf| {
        let told = output(Command::new(path).arg("--version"));
        told.is_ok_and(|told| told.split_whitespace().any(|word| word.trim_start_matches('v') == version))
    };
    let root = workspace::target_directory().join("tools");
    let installed = root.join("bin").join(package);
    if let Some(path) = [package.into(), installed.clone()].into_iter().find(is_it) {
        return Ok(path);
    }
    run(cargo()
        .args(["install", "--locked", package, "--version", version])
        .args(more)
        .arg("--root")
        .arg(root))?;
    Ok(installed)
}
