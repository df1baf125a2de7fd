//! The page of measured errors.

use crate::command::{Outcome, cargo, output};
use crate::workspace;

/// The page that the chore writes.
const PAGE: &str = "docs/accuracy.md";

/// What stands above the tables.
const HEADING: &str = "\
# Accuracy: how far each function is from exact

Every row is one public function over one region of its inputs, judged against exact rationals (or, where roots and
angles come in, against `f64`). ε is 2^-24, half the distance from 1 to the next `f32`; a ULP is the distance between
neighbouring `f32` at the exact answer, so that a small error is many ULPs of an answer next to 0. What the errors are
relative to stands above each table. The bound is the one that the function's documentation states, and ∞ where it
states none: such a row shows why. `cargo test -p alberti-accuracy` enforces every bound, on other samples in each run
that sets `ALBERTI_SEED`.

This page is made by

    cargo xtask accuracy

from 20,000 samples a row, the same ones in every run.
";

/// Writes the page anew.
pub(crate) fn run() -> Outcome {
    let package = ["--package", "alberti-accuracy", "--example", "tables"];
    let tables = output(cargo().args(["run", "--quiet", "--release"]).args(package))?;
    let path = workspace::root().join(PAGE);
    std::fs::write(&path, format!("{HEADING}{tables}"))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    println!("Wrote {PAGE}.");
    Ok(())
}
