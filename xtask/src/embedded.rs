//! Compilers for targets without an operating system.
//!
//! There are two ways to get one, and every chore that builds for a microcontroller takes the first that is there:
//!
//! 1. The target's standard library is installed beside the active rustc (`rustup target add`).
//! 2. Debian ships a rustc together with the source that matches it. The active toolchain's cargo drives that rustc
//!    and builds `core` from that source (`-Z build-std`). The active rustc cannot take its place: `core` builds only
//!    with the compiler of its own version.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{cargo, output};
use crate::workspace;

/// Debian's rustc (package `rustc-web`).
pub(crate) const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
/// The library source that matches it (package `rust-web-src`).
const DEBIAN_SOURCE: &str = "/usr/lib/rustlib/src/rust/library/core";

/// A target, and the processor and the feature that code is made for where these are not the target's least.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) triple: &'static str,
    pub(crate) processor: Option<&'static str>,
    pub(crate) feature: Option<&'static str>,
}

impl Target {
    pub(crate) const fn of(triple: &'static str) -> Self {
        Self { triple, processor: None, feature: None }
    }
}

/// A way to build for one target.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Toolchain {
    /// The active rustc has the target's library.
    Installed,
    /// Debian's rustc builds `core` from source; `linker` is the active toolchain's `rust-lld`.
    BuildStd { linker: PathBuf },
}

impl Toolchain {
    /// Finds the way to build for `target`, or says how to make one.
    pub(crate) fn find(target: Target) -> Result<Toolchain, String> {
        let target = target.triple;
        let sysroot =
            output(Command::new("rustc").current_dir(workspace::root()).args(["--print", "sysroot"]))?;
        let version = output(Command::new("rustc").current_dir(workspace::root()).arg("-vV"))?;
        let rustlib = Path::new(sysroot.trim_end()).join("lib/rustlib");
        let host = host(&version).ok_or("`rustc -vV` names no host")?;
        let linker = rustlib.join(host).join("bin/rust-lld");
        choose(
            rustlib.join(target).join("lib").exists(),
            Path::new(DEBIAN_RUSTC).exists() && Path::new(DEBIAN_SOURCE).exists(),
            linker,
        )
        .ok_or_else(|| missing(target))
    }

    /// A cargo that runs `subcommand` for `target`.
    pub(crate) fn cargo(&self, subcommand: &str, target: Target) -> Command {
        self.cargo_in(&self.directory(target), subcommand, target)
    }

    /// The same with a target directory of the caller's.
    pub(crate) fn cargo_in(&self, directory: &Path, subcommand: &str, target: Target) -> Command {
        let mut command = cargo();
        command.args([subcommand, "--target", target.triple]);
        let processor = target.processor.map(|processor| format!("-C target-cpu={processor}"));
        let feature = target.feature.map(|feature| format!("-C target-feature=+{feature}"));
        if processor.is_some() || feature.is_some() {
            command.env("RUSTFLAGS", processor.into_iter().chain(feature).collect::<Vec<_>>().join(" "));
        }
        if let Toolchain::BuildStd { linker } = self {
            command
                .env("RUSTC", DEBIAN_RUSTC)
                .env("RUSTC_BOOTSTRAP", "1")
                .env(linker_variable(target.triple), linker);
            // Cargo lets this program find the active toolchain's libraries; Debian's rustc must find its own.
            command.env_remove("LD_LIBRARY_PATH");
            command.args(["-Z", "build-std=core"]);
        }
        command.arg("--target-dir").arg(directory);
        command
    }

    /// Cargo's target directory in builds for `target`, for packages outside this workspace too. Each processor
    /// and each feature has its own, since programs for two of them have the same names.
    pub(crate) fn directory(&self, target: Target) -> PathBuf {
        let directory = workspace::target_directory();
        let own = target.processor.or(target.feature);
        match (self, own) {
            (Toolchain::Installed, None) => directory,
            (Toolchain::Installed, Some(own)) => directory.join(own),
            // One of its own, or each build would throw away what the other compiler has built; and one for each
            // target, so that none waits for another.
            (Toolchain::BuildStd { .. }, _) => directory.join("build-std").join(own.unwrap_or(target.triple)),
        }
    }
}

/// What is chosen where; the installed target wins because it is what most users have.
fn choose(installed: bool, debian: bool, linker: PathBuf) -> Option<Toolchain> {
    match (installed, debian) {
        (true, _) => Some(Toolchain::Installed),
        (false, true) => Some(Toolchain::BuildStd { linker }),
        (false, false) => None,
    }
}

fn missing(target: &str) -> String {
    format!(
        "no compiler for {target}. Either `rustup target add {target}`, \
         or on Debian `apt-get install rustc-web rust-web-src`; then run this again"
    )
}

/// The variable in which cargo looks for the linker of `target`.
fn linker_variable(target: &str) -> String {
    format!("CARGO_TARGET_{}_LINKER", target.to_uppercase().replace(['-', '.'], "_"))
}

/// The host in the output of `rustc -vV`.
pub(crate) fn host(version: &str) -> Option<&str> {
    version.lines().find_map(|line| line.strip_prefix("host: "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_installed_target_wins() {
        let linker = PathBuf::from("rust-lld");
        assert_eq!(choose(true, true, linker.clone()), Some(Toolchain::Installed));
        assert_eq!(choose(false, true, linker.clone()), Some(Toolchain::BuildStd { linker: linker.clone() }));
        assert_eq!(choose(false, false, linker), None);
    }

    #[test]
    fn the_message_names_both_ways() {
        let message = missing("thumbv6m-none-eabi");
        assert!(message.contains("rustup target add thumbv6m-none-eabi"));
        assert!(message.contains("rustc-web rust-web-src"));
    }

    #[test]
    fn names_of_targets() {
        assert_eq!(
            linker_variable("thumbv8m.main-none-eabihf"),
            "CARGO_TARGET_THUMBV8M_MAIN_NONE_EABIHF_LINKER"
        );
        assert_eq!(
            host("rustc 1.89.0\nbinary: rustc\nhost: x86_64-unknown-linux-gnu\n"),
            Some("x86_64-unknown-linux-gnu")
        );
    }
}
