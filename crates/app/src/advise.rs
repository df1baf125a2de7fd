//! Advice on a scene: which policies are the cheapest within a budget of error, and what the scene pays for nothing.
//!
//! All is measured on the scene itself. The right picture is that of the most precise policies, exact, float,
//! f32-reversed and 8 bits of subpixels, with the scene's own filter, shading and colour format. Policies are tried in
//! three steps, as their errors come from different places:
//!
//! 1. each interpolation, each depth format and each grid alone, the others being the most precise;
//! 2. all combinations whose parts were within the budget, in the order of the times that these promise;
//! 3. the first few of them that are drawn within the budget are timed beside each other, and the fastest is the pick.

mod candidate;
mod measured;
mod report;
mod waste;
mod work;

pub use candidate::Candidate;
pub use measured::Trial;
pub use report::{json, text};
pub use waste::{Waste, waste};
pub use work::{Work, work};

use crate::error::Error;
use crate::measure::MaxError;
use crate::options::RenderOptions;
use crate::scene::{Camera, Model};
use measured::Bench;

/// Combinations within the budget that are timed beside each other.
const FINALISTS: usize = 4;
/// Combinations that are drawn at most to find these.
const TRIED: usize = 24;

/// The advice on a scene.
#[derive(Clone, Debug)]
pub struct Advice {
    /// The budget.
    pub budget: MaxError,
    /// Every policy alone and every combination that was tried, the cheapest first.
    pub trials: Vec<Trial>,
    /// The index of the pick; the most precise policies keep every budget.
    pub pick: usize,
    /// The right picture's.
    pub reference: Trial,
}

/// Tries policies on a scene.
///
/// # Errors
/// The scene cannot be drawn.
pub fn advise(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    budget: MaxError,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Advice, Error> {
    let bench = Bench::new(model, camera, options, budget)?;
    let alone = candidate::alone();
    let total = (alone.len() + FINALISTS) as u64;
    let mut trials = vec![];
    for (done, candidate) in (0..).zip(&alone) {
        progress(done, total);
        trials.push(bench.try_out(*candidate)?);
    }
    let combinations = combinations(&trials, budget);
    let mut finalists: Vec<Trial> =
        trials.iter().filter(|trial| budget.admits(trial.error)).cloned().collect();
    let mut found = 0;
    for candidate in combinations.into_iter().take(TRIED) {
        if found == FINALISTS {
            break;
        }
        let trial = bench.try_out(candidate)?;
        if budget.admits(trial.error) {
            found += 1;
            finalists.push(trial.clone());
        }
        trials.push(trial);
        progress((alone.len() + found) as u64, total);
    }
    finalists.sort_by(|a, b| a.time.total_cmp(&b.time));
    finalists.truncate(FINALISTS);
    bench.time_together(&mut finalists)?;
    for finalist in &finalists {
        if let Some(trial) = trials.iter_mut().find(|trial| trial.candidate == finalist.candidate) {
            trial.time = finalist.time;
        }
    }
    let pick = finalists.iter().min_by(|a, b| a.time.total_cmp(&b.time)).map(|trial| trial.candidate);
    trials.sort_by(|a, b| a.time.total_cmp(&b.time));
    let at = |candidate| trials.iter().position(|trial: &Trial| trial.candidate == candidate);
    let exact = at(Candidate::MOST_PRECISE).unwrap_or_default();
    let pick = pick.and_then(at).unwrap_or(exact);
    let reference = trials[exact].clone();
    Ok(Advice { budget, trials, pick, reference })
}

/// Combinations of policies that were within the budget alone, but for those that were tried, the promising first. What
/// they promise is the product of the parts' shares of the most precise policies' time.
fn combinations(trials: &[Trial], budget: MaxError) -> Vec<Candidate> {
    let within = |trial: &&Trial| budget.admits(trial.error);
    let Some(reference) = trials.iter().find(|trial| trial.candidate == Candidate::MOST_PRECISE) else {
        return vec![];
    };
    let share = |trial: &Trial| trial.time / reference.time;
    let mut all = vec![];
    for lines in trials.iter().filter(within).filter(|trial| trial.candidate.is_interpolation()) {
        for depth in trials.iter().filter(within).filter(|trial| trial.candidate.is_depth()) {
            for grid in trials.iter().filter(within).filter(|trial| trial.candidate.is_grid()) {
                let candidate = Candidate {
                    depth: depth.candidate.depth,
                    subpixel: grid.candidate.subpixel,
                    ..lines.candidate
                };
                if trials.iter().all(|trial| trial.candidate != candidate) {
                    all.push((share(lines) * share(depth) * share(grid), candidate));
                }
            }
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.into_iter().map(|(_, candidate)| candidate).collect()
}

impl Advice {
    /// Whether no other trial is at once as fast and as right, and better in one of the two.
    #[must_use]
    pub fn is_on_front(&self, trial: &Trial) -> bool {
        let worse = |a: f64, b: f64| match self.budget {
            MaxError::Db(_) => a < b,
            _ => a > b,
        };
        !self.trials.iter().any(|other| {
            let (faster, as_right) = (other.time < trial.time, !worse(other.error, trial.error));
            let (as_fast, better) = (other.time <= trial.time, worse(trial.error, other.error));
            (faster && as_right) || (as_fast && better)
        })
    }
}
