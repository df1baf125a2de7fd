//! What the repository consists of. Every chore reads these lists, so a new crate is entered once.

use std::path::{Path, PathBuf};

/// A library crate: `no_std`, no allocation, `unsafe` forbidden.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Library {
    pub(crate) package: &'static str,
    /// The folder below `crates/`.
    pub(crate) folder: &'static str,
    /// The crates of this workspace that it may depend on.
    pub(crate) may_use: &'static [&'static str],
    /// Features named after the crates in whose terms they have the library's values; these are optional dependencies.
    pub(crate) terms: &'static [&'static str],
}

/// The crates that run on a microcontroller, each after the crates that it uses.
pub(crate) const LIBRARIES: &[Library] = &[
    Library {
        package: "alberti-math",
        folder: "math",
        may_use: &[],
        terms: &["arbitrary", "bytemuck", "defmt", "mint", "serde"],
    },
    Library {
        package: "alberti-projection",
        folder: "projection",
        may_use: &["alberti-math"],
        terms: &["arbitrary", "defmt", "serde"],
    },
    Library {
        package: "alberti-raster",
        folder: "raster",
        may_use: &["alberti-math"],
        terms: &["arbitrary", "bytemuck", "defmt", "embedded-graphics", "serde"],
    },
    Library {
        package: "alberti-texture",
        folder: "texture",
        may_use: &["alberti-math"],
        terms: &["arbitrary", "defmt", "serde"],
    },
    Library {
        package: "alberti",
        folder: "alberti",
        may_use: &["alberti-math", "alberti-projection", "alberti-raster", "alberti-texture"],
        terms: &["arbitrary", "bytemuck", "defmt", "embedded-graphics", "mint", "serde"],
    },
];

/// The one of these features that needs std, as fuzzers do.
pub(crate) const NEEDS_STD: &str = "arbitrary";

/// What any library may depend on besides the crates of this workspace.
pub(crate) const EXTERNAL: &[&str] = &["fearless_simd", "glam", "libm"];

/// What one library may depend on besides, behind a feature that is off unless asked for, as (package, dependency).
pub(crate) const OPTIONAL: &[(&str, &str)] =
    &[("alberti-texture", "bevy_mikktspace"), ("alberti", "rayon-core")];

/// The published crates that need an operating system, as (package, folder below `crates/`).
pub(crate) const APPLICATIONS: &[(&str, &str)] = &[("alberti-app", "app")];

/// The package of the tests across crates, which asks the facade for what the application has no use for.
pub(crate) const TESTS: &str = "alberti-tests";

/// The manifest of the workspace of programs for microcontrollers, and its packages: the programs, and the scenes that
/// the host draws too.
pub(crate) const FIRMWARE: (&str, [&str; 2]) =
    ("tests/firmware/Cargo.toml", ["alberti-firmware", "alberti-firmware-scenes"]);

/// The package of that workspace whose scenes are hashed on all machines.
pub(crate) const FINGERPRINT: &str = "alberti-fingerprint";

/// Every package that would be published, each after the packages that it uses.
pub(crate) fn published() -> impl Iterator<Item = &'static str> {
    let libraries = LIBRARIES.iter().map(|library| library.package);
    libraries.chain(APPLICATIONS.iter().map(|&(package, _)| package))
}

/// The folders that `crates/` holds.
pub(crate) fn crate_folders() -> impl Iterator<Item = &'static str> {
    let libraries = LIBRARIES.iter().map(|library| library.folder);
    libraries.chain(APPLICATIONS.iter().map(|&(_, folder)| folder))
}

/// The root of the repository.
pub(crate) fn root() -> PathBuf {
    // What `cargo run` says now, not what it said when this program was compiled: checkouts that share a target
    // directory share the program, and would otherwise check the tree of whichever built it.
    let xtask = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    Path::new(&xtask).parent().expect("xtask is a folder of the repository").to_path_buf()
}

/// Cargo's target directory, where `CARGO_TARGET_DIR` is not set as well.
pub(crate) fn target_directory() -> PathBuf {
    // `join` with an absolute path is that path; a relative one counts from the root, where `command::cargo` runs.
    root().join(std::env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_uses_only_libraries_above_it() {
        for (index, library) in LIBRARIES.iter().enumerate() {
            for used in library.may_use {
                assert!(LIBRARIES[..index].iter().any(|above| above.package == *used), "{}", library.package);
            }
        }
    }
}
