//! The advice as a table for people, or as one line of JSON.

use super::{Advice, Cost, Off, Trial, Waste, Wish};
use crate::measure::MaxError;
use serde::Serialize;
use std::fmt::Write as _;

/// Rows of the table that are shown beside the front.
const ROWS: usize = 16;

/// The advice as text. `side` is that of the largest texture.
#[must_use]
pub fn text(advice: &Advice, wastes: &[Waste], side: u16) -> String {
    let Advice { wish: Wish { budget, machine, .. }, trials, pick, reference, .. } = advice;
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "Cheapest within {budget}, of {} ways to draw the scene. {}",
        trials.len(),
        costs(advice)
    );
    text.push_str("Errors are against exact, float, f32-reversed, 8 bits");
    text.push_str(if machine.is_chip() { ",\nboth in RGB565, of which a step is 4 or 8 bytes" } else { "" });
    text.push_str(". A star: no other way is as cheap and as right.\n\n");
    let (cost, ratio) = if machine.is_chip() { ("M instr.", "ratio") } else { ("ms", "time") };
    let _ = write!(text, "{cost:>9}  {ratio:>6}  {:>10}  {:>7}", unit(*budget), "largest");
    text.push_str(if machine.is_chip() { "  flash KB   RAM KB     policies\n" } else { "     policies\n" });
    let is_shown = |k: usize, trial: &Trial| {
        k < ROWS || k == *pick || advice.is_on_front(trial) || trial.candidate == reference.candidate
    };
    let digits = if machine.is_chip() || reference.cost.frame >= 1.0 { 2 } else { 3 };
    for (k, trial) in trials.iter().enumerate().filter(|(k, trial)| is_shown(*k, trial)) {
        let star = if advice.is_on_front(trial) { '*' } else { ' ' };
        let mark = if k == *pick { ">" } else { " " };
        let within = if budget.admits(trial.error) { ' ' } else { '!' };
        let Cost { frame, flash, ram } = trial.cost;
        let shown = if machine.is_chip() { frame / 1e6 } else { frame };
        let _ = write!(
            text,
            "{mark}{shown:>8.digits$}  {:>6.2}  {:>9}{within}  {:>7}",
            frame / reference.cost.frame,
            figure(*budget, trial.error),
            trial.largest,
        );
        if machine.is_chip() {
            let _ = write!(text, "  {:>8.1}  {:>7.1}", flash / 1024.0, ram / 1024.0);
        }
        let _ = writeln!(text, "  {star}  {}", trial.candidate.command_line());
    }
    let left_out = trials.iter().enumerate().filter(|(k, trial)| !is_shown(*k, trial)).count();
    if left_out > 0 {
        let _ = writeln!(text, "\n  {left_out} more that are dearer: --json has them.");
    }
    text.push_str("\n  >: the pick.  !: beyond the budget.  largest: the worst byte of any pixel.\n");
    if trials.iter().any(|trial| trial.error.is_infinite() && matches!(budget, MaxError::Texel(_))) {
        text.push_str("  other: more than one pixel in a thousand shows another part or the background.\n");
    }
    let index = *pick;
    let pick: &Trial = &trials[index];
    let of = if machine.is_chip() { "instructions" } else { "time" };
    let _ = write!(
        text,
        "\nThe pick takes {:.2} of the {of} of the most precise policies.",
        pick.cost.frame / reference.cost.frame
    );
    if trials.iter().position(|trial| budget.admits(trial.error)) != Some(index) {
        text.push_str(" Of those that cost as little within a fiftieth, it is the least wrong.");
    }
    if trials.iter().all(|trial| trial.candidate == reference.candidate || !budget.admits(trial.error)) {
        text.push_str(" Nothing else keeps the budget.");
    }
    let _ =
        write!(text, " On the command line:\n\n    {}\n\nIn a program:\n\n", pick.candidate.command_line());
    for line in pick.candidate.rust(*machine, side).lines() {
        let _ = writeln!(text, "    {line}");
    }
    if !wastes.is_empty() {
        text.push_str("\nPaid for nothing by the most precise policies, or nearly:\n\n");
        for waste in wastes {
            let _ = writeln!(text, "  * {}", waste.line);
        }
    }
    text
}

/// The meaning of costs, in one or more lines.
fn costs(advice: &Advice) -> String {
    let Some(Off { median, most, worst, .. }) = advice.off else {
        return "Times are of one thread,\n\
                whole frames, by this command: plain surfaces in floats by code of their own, as a program\n\
                has it that names its types; fixed point, materials and projectors by one stage for all,\n\
                which adds the same to each."
            .to_owned();
    };
    let name = advice.wish.machine.name();
    format!(
        "Instructions are a model's for {name}:\n\
         a textured, unlit mesh in RGB565 with this scene's own counts. Shading is not in it: it adds\n\
         the same to all but depth `none`, which shades what is hidden too. On five scenes that were\n\
         also run the model was off by {median:.1} % (median), at most {most:.0} % in nine of ten cases,\n\
         {worst:.0} % in the worst. Flash is code; RAM is both buffers, a slot for each vertex, and the stack."
    )
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
        MaxError::Texel(_) if error.is_infinite() => "other".to_owned(),
        MaxError::Texel(_) => format!("{error:.4}"),
    }
}

/// A row of JSON.
#[derive(Serialize)]
struct Row {
    options: String,
    /// On the host.
    #[serde(skip_serializing_if = "Option::is_none")]
    ms: Option<f64>,
    /// On chips, and so are bytes of code.
    #[serde(skip_serializing_if = "Option::is_none")]
    instructions: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    flash: Option<f64>,
    ram: f64,
    /// As a share of the most precise policies' time or instructions.
    time: f64,
    /// In the budget's unit; `null` for an infinite PSNR, or where something else is seen.
    error: Option<f64>,
    largest: u8,
    within: bool,
    front: bool,
}

/// All of it.
#[derive(Serialize)]
struct Document {
    max_error: String,
    target: &'static str,
    pick: Row,
    rust: String,
    trials: Vec<Row>,
    waste: Vec<String>,
}

/// The advice as one JSON object on one line. docs/advice.md has the meaning of its keys.
#[must_use]
pub fn json(advice: &Advice, wastes: &[Waste], side: u16) -> String {
    let Wish { budget, machine, .. } = advice.wish;
    let chip = machine.is_chip();
    let row = |trial: &Trial| Row {
        options: trial.candidate.command_line(),
        ms: (!chip).then_some(trial.cost.frame),
        instructions: chip.then_some(trial.cost.frame),
        flash: chip.then_some(trial.cost.flash),
        ram: trial.cost.ram,
        time: trial.cost.frame / advice.reference.cost.frame,
        error: Some(trial.error).filter(|error| error.is_finite()),
        largest: trial.largest,
        within: budget.admits(trial.error),
        front: advice.is_on_front(trial),
    };
    let pick = &advice.trials[advice.pick];
    let document = Document {
        max_error: budget.to_string(),
        target: machine.name(),
        pick: row(pick),
        rust: pick.candidate.rust(machine, side),
        trials: advice.trials.iter().map(row).collect(),
        waste: wastes.iter().map(|waste| waste.line.clone()).collect(),
    };
    // Strings and finite numbers cannot be refused.
    serde_json::to_string(&document).unwrap_or_default()
}
