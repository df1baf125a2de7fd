//! The supply: dependencies by the rules of deny.toml, the oldest compiler that the manifests name, and what users of
//! the last version rely on.
//!
//! Each takes a tool that not everybody has. What cannot be checked is said aloud, with what to install.

use std::process::{Command, Stdio};

use crate::command::{Outcome, cargo, output, run};
use crate::workspace;

/// Checks all.
pub(crate) fn check() -> Outcome {
    denied()?;
    oldest()?;
    semver(&[])
}

/// Compares the libraries' interfaces with those of a commit, or of the last tag of a version. A change that breaks
/// users fails, unless the version says so.
pub(crate) fn semver(arguments: &[String]) -> Outcome {
    let mut git = Command::new("git");
    git.current_dir(workspace::root()).args(["describe", "--tags", "--abbrev=0", "--match", "v[0-9]*"]);
    let baseline = match arguments {
        [] => output(git.stderr(Stdio::null())).ok().map(|tag| tag.trim().to_owned()),
        [commit] => Some(commit.clone()),
        _ => return Err("expected one commit, or nothing for the last version".into()),
    };
    let Some(baseline) = baseline else {
        println!(
            "no version has a tag yet, so no interface has to stay; `cargo xtask semver COMMIT` compares"
        );
        return Ok(());
    };
    if !works(cargo().args(["semver-checks", "--version"])) {
        println!(
            "NOT CHECKED: interfaces since {baseline}. `cargo install --locked cargo-semver-checks`, then run this again"
        );
        return Ok(());
    }
    let mut compare = cargo();
    compare.args(["semver-checks", "--baseline-rev", &baseline]);
    let libraries = workspace::LIBRARIES.iter().map(|library| library.package);
    run(compare.args(libraries.flat_map(|package| ["--package", package])))
}

/// Licences, sources and duplicates.
fn denied() -> Outcome {
    if !works(cargo().args(["deny", "--version"])) {
        println!(
            "NOT CHECKED: the rules of deny.toml. `cargo install --locked cargo-deny`, then run this again"
        );
        return Ok(());
    }
    // Advisories take a copy of their data, which is elsewhere.
    run(cargo().args(["deny", "--log-level", "error", "check", "licenses", "bans", "sources"]))
}

/// What is published, and its tests, by the compiler of `rust-version`.
fn oldest() -> Outcome {
    let manifest = std::fs::read_to_string(workspace::root().join("Cargo.toml"));
    let manifest = manifest.map_err(|error| format!("cannot read Cargo.toml: {error}"))?;
    let version = rust_version(&manifest).ok_or("Cargo.toml names no rust-version")?;
    let toolchain = format!("{version}.0");
    let mut rustc = Command::new("rustup");
    if !works(rustc.args(["run", &toolchain, "rustc", "--version"])) {
        println!(
            "NOT CHECKED: that Rust {version} is enough. `rustup toolchain install {toolchain} --profile minimal`, \
             then run this again"
        );
        return Ok(());
    }
    let told = output(Command::new("rustup").args(["run", &toolchain, "rustc", "--version"]))?;
    println!("the oldest compiler: {}", told.trim_end());
    let mut check = Command::new("rustup");
    check.current_dir(workspace::root()).args([
        "run",
        &toolchain,
        "cargo",
        "check",
        "--all-targets",
        "--all-features",
    ]);
    // Those of this program are for another compiler.
    ["CARGO", "RUSTC", "RUSTUP_TOOLCHAIN", "LD_LIBRARY_PATH"]
        .iter()
        .for_each(|name| _ = check.env_remove(name));
    check.args(workspace::published().flat_map(|package| ["--package", package]));
    run(check.arg("--target-dir").arg(workspace::target_directory().join("oldest")))
}

/// Whether a command can be run here.
fn works(command: &mut Command) -> bool {
    command.stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|status| status.success())
}

/// The first `rust-version` of a manifest, without quotes.
fn rust_version(manifest: &str) -> Option<&str> {
    let line = manifest.lines().find_map(|line| line.strip_prefix("rust-version = \""))?;
    line.split('"').next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_compiler_is_that_of_the_manifest() {
        assert_eq!(rust_version("[workspace.package]\nrust-version = \"1.2\"\n"), Some("1.2"));
        assert_eq!(rust_version("version = \"1.2\"\n"), None);
        assert!(!works(&mut Command::new("no-such-program-here")));
    }
}
