//! The advice as a table for people, or as one line of JSON.

use super::{Advice, Trial, Waste};
use crate::measure::MaxError;
use serde::Serialize;
use std::fmt::Write as _;

/// Rows of the table that are shown beside the front.
const ROWS: usize = 16;

/// The advice as text. `side` is that of the largest texture.
#[must_use]
pub fn text(advice: &Advice, wastes: &[Waste], side: u16) -> String {
    let Advice { budget, trials, pick, reference } = advice;
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "Cheapest within {budget}, of {} ways to draw the scene. Times are of one thread, whole frames; errors are\n\
         against exact, float, f32-reversed, 8 bits. A star: no other way is as fast and as right.\n",
        trials.len()
    );
    let _ =
        writeln!(text, "{:>9}  {:>6}  {:>10}  {:>7}     policies", "ms", "time", unit(*budget), "largest");
    for (k, trial) in trials.iter().enumerate().filter(|(k, trial)| {
        *k < ROWS || *k == *pick || advice.is_on_front(trial) || trial.candidate == reference.candidate
    }) {
        let star = if advice.is_on_front(trial) { '*' } else { ' ' };
        let mark = if k == *pick { ">" } else { " " };
        let within = if budget.admits(trial.error) { ' ' } else { '!' };
        let _ = writeln!(
            text,
            "{mark}{:>8.2}  {:>6.2}  {:>9}{within}  {:>7}  {star}  {}",
            trial.time,
            trial.time / reference.time,
            figure(*budget, trial.error),
            trial.largest,
            trial.candidate.command_line(),
        );
    }
    text.push_str("\n  >: the pick.  !: beyond the budget.  largest: the worst byte of any pixel.\n");
    let pick: &Trial = &trials[*pick];
    let _ = write!(
        text,
        "\nThe pick takes {:.2} of the time of the most precise policies. On the command line:\n\n    {}\n\nIn a program:\n\n",
        pick.time / reference.time,
        pick.candidate.command_line()
    );
    for line in pick.candidate.rust(side).lines() {
        let _ = writeln!(text, "    {line}");
    }
    if !wastes.is_empty() {
        text.push_str("\nPaid for nothing, or nearly:\n\n");
        for waste in wastes {
            let _ = writeln!(text, "  * {}", waste.line);
        }
    }
    text
}

fn unit(budget: MaxError) -> &'static str {
    match budget {
        MaxError::Lsb(_) => "99.9 % lsb",
        MaxError::Flip(_) => "FLIP",
        MaxError::Db(_) => "PSNR, dB",
        MaxError::Texel(_) => "texels",
    }
}

fn figure(budget: MaxError, error: f64) -> String {
    match budget {
        MaxError::Lsb(_) => format!("{error:.0}"),
        MaxError::Flip(_) => format!("{error:.5}"),
        MaxError::Db(_) if error.is_infinite() => "equal".to_owned(),
        MaxError::Db(_) => format!("{error:.2}"),
        MaxError::Texel(_) => format!("{error:.4}"),
    }
}

/// A row of JSON.
#[derive(Serialize)]
struct Row {
    options: String,
    ms: f64,
    /// As a share of the most precise policies' time.
    time: f64,
    /// In the budget's unit; `null` for an infinite PSNR.
    error: Option<f64>,
    largest: u8,
    within: bool,
    front: bool,
}

/// All of it.
#[derive(Serialize)]
struct Document {
    max_error: String,
    pick: Row,
    rust: String,
    trials: Vec<Row>,
    waste: Vec<String>,
}

/// The advice as one JSON object on one line.
#[must_use]
pub fn json(advice: &Advice, wastes: &[Waste], side: u16) -> String {
    let row = |trial: &Trial| Row {
        options: trial.candidate.command_line(),
        ms: trial.time,
        time: trial.time / advice.reference.time,
        error: Some(trial.error).filter(|error| error.is_finite()),
        largest: trial.largest,
        within: advice.budget.admits(trial.error),
        front: advice.is_on_front(trial),
    };
    let pick = &advice.trials[advice.pick];
    let document = Document {
        max_error: advice.budget.to_string(),
        pick: row(pick),
        rust: pick.candidate.rust(side),
        trials: advice.trials.iter().map(row).collect(),
        waste: wastes.iter().map(|waste| waste.line.clone()).collect(),
    };
    // Strings and finite numbers cannot be refused.
    serde_json::to_string(&document).unwrap_or_default()
}
