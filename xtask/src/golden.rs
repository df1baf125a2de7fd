//! Writing the golden images anew, after a change that is meant to change pictures.

use crate::command::{self, Outcome, cargo};

/// Runs the golden-image tests with leave to write; `arguments` may name one test.
///
/// A test that writes an image fails on purpose: a run that agrees with itself proves nothing, so no run may both
/// write a reference and pass against it.
pub(crate) fn run(arguments: &[String]) -> Outcome {
    println!(
        "A test that writes its image fails on purpose: look at the pictures, then run `cargo test --workspace`."
    );
    let mut command = cargo();
    command.env("ALBERTI_UPDATE_GOLDEN", "1");
    command
        .args([
            "test",
            "--package",
            "alberti-tests",
            "--test",
            "pipeline",
            "--no-fail-fast",
            "golden::",
            "--",
        ])
        .args(arguments);
    command::run(&mut command).map_err(|message| {
        format!(
            "{message}\nIf the failures above say that images were written, this is expected: \
             `git status tests` lists the new images; `cargo test --workspace` must now pass without change."
        )
    })?;
    println!("Every golden image was up to date; nothing was written.");
    Ok(())
}
