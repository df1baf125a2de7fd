//! The warnings of a run.

use std::io::{self, Write as _};
use std::sync::{Mutex, PoisonError};

use crate::error::Warnings;
use crate::output::stage::{self, is_silent};

/// Warnings so far.
static TOLD: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Begins a run without warnings.
pub(super) fn forget() {
    TOLD.lock().unwrap_or_else(PoisonError::into_inner).clear();
}

/// Warnings of this run, printed or not.
pub(super) fn told() -> Vec<String> {
    TOLD.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// Tells a warning, once.
pub(super) fn warn(line: &str) {
    let mut told = TOLD.lock().unwrap_or_else(PoisonError::into_inner);
    if told.iter().any(|other| other == line) {
        return;
    }
    told.push(line.to_owned());
    drop(told);
    if is_silent() {
        return;
    }
    // Without standard error there is nobody to tell.
    stage::aside(|| _ = writeln!(io::stderr(), "warning: {line}"));
}

pub(super) fn warn_all(warnings: &Warnings) {
    for line in warnings.lines() {
        warn(&line);
    }
}
