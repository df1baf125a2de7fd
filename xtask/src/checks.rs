//! The checks that are one call of cargo each.

use crate::command::{Outcome, cargo, run};
use crate::elf::Program;
use crate::workspace::{self, FINGERPRINT, FIRMWARE};
use std::fs;
use std::process::Command;

/// Checks the formatting of every member, and of the firmware.
pub(crate) fn fmt() -> Outcome {
    run(cargo().args(["fmt", "--all", "--check"]))?;
    // Not `--all`: it follows paths, and would read the crates again.
    let (manifest, [programs, scenes]) = FIRMWARE;
    run(cargo().args([
        "fmt",
        "--check",
        "--manifest-path",
        manifest,
        "--package",
        programs,
        "--package",
        scenes,
        "--package",
        FINGERPRINT,
    ]))
}

/// Runs clippy on every member and target, benchmarks included, and on the firmware's scenes, with warnings as errors.
///
/// Every feature is on: members are compiled together, and the application asks for all, as `tidy` makes sure. It is
/// looked at without its window as well.
pub(crate) fn lint() -> Outcome {
    run(cargo().args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]))?;
    let bare = ["clippy", "--package", "alberti-app", "--no-default-features", "--", "-D", "warnings"];
    run(cargo().args(bare))?;
    run(with_mutants("clippy").args(["--all-targets", "--", "-D", "warnings"]))?;
    let (manifest, [_, scenes]) = FIRMWARE;
    let mut clippy = cargo();
    clippy.args([
        "clippy",
        "--manifest-path",
        manifest,
        "--package",
        scenes,
        "--package",
        FINGERPRINT,
        "--features",
        "std",
        "--all-targets",
    ]);
    clippy.arg("--target-dir").arg(workspace::target_directory());
    run(clippy.args(["--", "-D", "warnings"]))
}

/// Builds the documentation of every library with warnings as errors.
pub(crate) fn docs() -> Outcome {
    // Libraries only: the program of `alberti-app` is named `alberti`, and its pages would land on those of the
    // library `alberti`, about which cargo warns.
    run(cargo().env("RUSTDOCFLAGS", "-D warnings").args(["doc", "--workspace", "--no-deps", "--lib"]))
}

/// Runs the test command of the README.
pub(crate) fn test() -> Outcome {
    run(cargo().args(["test", "--workspace"]))
}

/// Checks the code that only the features `avx512` and `sse2` compile, and the lanes of such machines against one lane.
/// All else is the same code over other lanes, and would take minutes to compile once more.
pub(crate) fn registers() -> Outcome {
    run(cargo()
        .args([
            "clippy",
            "--package",
            "alberti-benches",
            "--all-targets",
            "--features",
            "avx512,alberti/sse2",
        ])
        .args(["--", "-D", "warnings"]))?;
    run(cargo().args(["test", "--package", "alberti-math", "--features", "avx512,sse2", "--lib", "lanes::"]))
}

/// Checks that no operation on lanes is a call: then all functions with lanes were inlined to where the machine's
/// instructions may be used. Of a closure that was not, the picture is right, and takes up to three times as long.
pub(crate) fn lanes() -> Outcome {
    if !cfg!(target_arch = "x86_64") {
        println!("This machine's lanes need no inlining.");
        return Ok(());
    }
    run(cargo().args(["build", "--release", "--package", "alberti-app"]))?;
    let app = workspace::target_directory().join("release/alberti");
    let file = fs::read(&app).map_err(|error| format!("{}: {error}", app.display()))?;
    let symbols = Program::read(&file)?.symbols;
    if symbols.is_empty() {
        return Err(format!("{}: no symbols", app.display()));
    }
    match symbols.iter().filter(|(name, _)| name.contains("__fearless_simd_kernel")).count() {
        0 => Ok(()),
        count => Err(format!(
            "{count} operations on lanes are functions of {}: who calls them lacks `#[inline(always)]`",
            app.display()
        )),
    }
}

/// A sweep by its name: every case there is, or hard ones; without a name the list, and `tests` for the tests that look
/// at more when they are asked to.
pub(crate) fn sweep(words: &[String]) -> Outcome {
    if words.first().is_some_and(|name| name == "tests") {
        return swept_tests();
    }
    let folder = workspace::target_directory().join("sweeps");
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let mut sweep = cargo();
    sweep.args(["run", "--release", "--package", "alberti-sweeps", "--bin", "sweep", "--"]).args(words);
    if !words.is_empty() {
        sweep.arg("--folder").arg(folder);
    }
    run(&mut sweep)?;
    if words.is_empty() {
        println!(
            "tests       the tests that look at every f32, or at ten million triangles, when they are asked to"
        );
    }
    Ok(())
}

/// A command of cargo for the program with all mutants.
pub(crate) fn with_mutants(command: &str) -> Command {
    let mut cargo = cargo();
    cargo.args([command, "--manifest-path", "tests/mutants/Cargo.toml", "--target-dir"]);
    cargo.arg(workspace::target_directory());
    cargo
}

/// The mutants of cargo-mutants, and the tests that notice them.
pub(crate) fn mutants(words: &[String]) -> Outcome {
    let folder = workspace::target_directory().join("mutants");
    run(with_mutants("run").args(["--release", "--"]).args(words).arg("--folder").arg(folder))
}

/// Runs the tests that can look at every single `f32`, or at ten million triangles and samples, instead of at some: on
/// every kind of lanes that the machine has.
fn swept_tests() -> Outcome {
    let sweep = |arguments: &[&str]| run(cargo().env("ALBERTI_SWEEP", "1").arg("test").args(arguments));
    sweep(&["--package", "alberti-texture", "every_257th_float"])?;
    let pipeline = ["--package", "alberti-tests", "--features", "alberti/avx512,alberti/sse2"];
    let modules = [
        "lanes::",
        "small::",
        "gradients::",
        "planes::",
        "policies::",
        "coverage::",
        "attributes::",
        "hostile::",
    ];
    sweep(&[&pipeline[..], &["--test", "pipeline", "--test", "fragments", "--"], &modules].concat())
}
