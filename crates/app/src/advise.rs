//! Advice on a scene: which policies are the cheapest within a budget of error, and what the scene pays for nothing.
//!
//! Errors are measured on the scene itself. The right picture is that of the most precise policies, exact, float,
//! f32-reversed and 8 bits of subpixels, with the scene's own filter and shading. On chips both are in RGB565. Costs on
//! the host are times. Those on chips come from a model of a textured, unlit mesh: so many instructions for each
//! vertex, row, fragment and so on. The scene's own counts of these are its [`Work`].
//!
//! Policies are tried in three steps, as their errors come from different places:
//!
//! 1. each interpolation, each depth format and each grid alone, the others being the most precise;
//! 2. all combinations whose parts were within the budget, in the order of the costs that these promise;
//! 3. of the first few of them that are drawn within the budget, the cheapest is the pick; of those that cost the same
//!    within a fiftieth, the least wrong. On the host they are timed beside each other for that.

use std::cmp::Ordering;

mod candidate;
mod chips;
mod kin;
mod machine;
mod measured;
mod report;
mod texels;
mod waste;
mod work;

pub use candidate::Candidate;
pub use chips::Off;
pub use kin::Kin;
pub(crate) use machine::depth_bytes;
pub use machine::{Cost, LitAt, Machine, baked_on_chip};
pub use measured::Trial;
pub use report::{json, text};
pub use waste::{Waste, waste};
pub use work::{OfKind, Work, work};

use crate::error::Error;
use crate::measure::MaxError;
use crate::options::RenderOptions;
use crate::scene::{Camera, Model};
use measured::Bench;

/// Combinations within the budget of which the cheapest is the pick.
const FINALISTS: usize = 6;
/// Combinations that are drawn at most to find these.
const TRIED: usize = 32;
/// Times that these are taken at most, as others seem cheaper than they.
const ROUNDS: usize = 4;
/// Costs up to so many times the least count as the same: times repeat no better.
const ALIKE: f64 = 1.02;
/// Finalists of a thorough search.
const MORE_FINALISTS: usize = 12;

/// A user's wish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// The budget.
    pub budget: MaxError,
    /// The machine that is to draw.
    pub machine: Machine,
    /// Whether all combinations are tried instead of the promising ones.
    pub thorough: bool,
}

/// The advice on a scene.
#[derive(Clone, Debug)]
pub struct Advice {
    /// The wish.
    pub wish: Wish,
    /// Every policy alone and every combination that was tried, the cheapest first.
    pub trials: Vec<Trial>,
    /// The index of the pick; the most precise policies keep every budget.
    pub pick: usize,
    /// The right picture's.
    pub reference: Trial,
    /// How far costs are off, of a chip.
    pub off: Option<Off>,
}

/// Tries policies on a scene.
///
/// # Errors
/// The scene cannot be drawn, has no texels for a budget of these, or a filter that chips are not advised on.
pub fn advise(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    wish: Wish,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Advice, Error> {
    let bench = Bench::new(model, camera, options, wish)?;
    let within = |trial: &Trial| wish.budget.admits(trial.error);
    let mut alone = if wish.thorough { candidate::combined() } else { candidate::alone() };
    alone.retain(|candidate| bench.has(*candidate));
    let total = (alone.len() + FINALISTS) as u64;
    let mut trials = vec![];
    for (done, candidate) in (0..).zip(&alone) {
        progress(done, total);
        trials.push(bench.try_out(*candidate)?);
    }
    let mut found = 0;
    for candidate in combinations(&bench, &trials, wish)?.into_iter().take(TRIED) {
        if found == FINALISTS {
            break;
        }
        let trial = bench.try_out(candidate)?;
        found += usize::from(within(&trial));
        trials.push(trial);
        progress((alone.len() + found) as u64, total);
    }
    if wish.machine == Machine::Host {
        let most = if wish.thorough { MORE_FINALISTS } else { FINALISTS };
        let mut timed = vec![Candidate::MOST_PRECISE];
        for _ in 0..ROUNDS {
            cheapest_first(&mut trials);
            let cheap = trials.iter().filter(|trial| within(trial)).take(most);
            let new = cheap.map(|trial| trial.candidate).filter(|candidate| !timed.contains(candidate));
            let new: Vec<Candidate> = new.collect();
            if trials.iter().find(|trial| within(trial)).is_none_or(|trial| timed.contains(&trial.candidate))
            {
                break;
            }
            bench.time_together(&new, &mut trials)?;
            timed.extend(new);
        }
    }
    cheapest_first(&mut trials);
    let at = |candidate| trials.iter().position(|trial: &Trial| trial.candidate == candidate);
    let exact = at(Candidate::MOST_PRECISE).unwrap_or_default();
    let pick = pick(&trials, wish.budget).unwrap_or(exact);
    let reference = trials[exact].clone();
    Ok(Advice { wish, trials, pick, reference, off: bench.off() })
}

/// Of those within the budget that cost about as little as the cheapest, the one that is the least wrong.
fn pick(trials: &[Trial], budget: MaxError) -> Option<usize> {
    let within = |trial: &Trial| budget.admits(trial.error);
    let least = trials.iter().find(|trial| within(trial))?.cost.frame;
    let close = |trial: &Trial| within(trial) && trial.cost.frame <= least * ALIKE;
    let all = trials.iter().enumerate().filter(|(_, trial)| close(trial));
    let best =
        all.min_by(|(_, a), (_, b)| by_error(budget, a, b).then(a.cost.frame.total_cmp(&b.cost.frame)));
    best.map(|(index, _)| index)
}

/// The order of errors, the least first; of equal ones, that of the largest differences.
fn by_error(budget: MaxError, a: &Trial, b: &Trial) -> Ordering {
    let errors = match budget {
        MaxError::Db(_) => b.error.total_cmp(&a.error),
        _ => a.error.total_cmp(&b.error),
    };
    errors.then(a.largest.cmp(&b.largest))
}

fn cheapest_first(trials: &mut [Trial]) {
    trials.sort_by(|a, b| a.cost.frame.total_cmp(&b.cost.frame));
}

/// The median times of some ways of drawing on the host, in turns, in milliseconds.
///
/// # Errors
/// Those of [`advise`].
pub fn times(
    model: &Model,
    camera: &Camera,
    options: &RenderOptions,
    candidates: &[Candidate],
) -> Result<Vec<f64>, Error> {
    let wish = Wish { budget: MaxError::Lsb(0.0), machine: Machine::Host, thorough: false };
    Bench::new(model, camera, options, wish)?.medians(candidates)
}

/// Combinations of policies that were within the budget alone, but for those that were tried, the promising first.
fn combinations(bench: &Bench<'_>, trials: &[Trial], wish: Wish) -> Result<Vec<Candidate>, Error> {
    let tried = |candidate| trials.iter().find(|trial| trial.candidate == candidate);
    let within = |trial: &Trial| wish.budget.admits(trial.error);
    let Some(whole) = tried(Candidate::MOST_PRECISE) else { return Ok(vec![]) };
    let mut all = vec![];
    for candidate in candidate::combined() {
        if tried(candidate).is_some() || !bench.has(candidate) {
            continue;
        }
        if let [Some(lines), Some(depth), Some(grid)] = candidate.parts().map(tried)
            && [lines, depth, grid].into_iter().all(within)
        {
            all.push((bench.promise(candidate, [lines, depth, grid], whole)?, candidate));
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(all.into_iter().map(|(_, candidate)| candidate).collect())
}

impl Advice {
    /// Whether no other trial is at once as fast and as right, and better in one of the two.
    #[must_use]
    pub fn is_on_front(&self, trial: &Trial) -> bool {
        !self.trials.iter().any(|other| {
            let error = by_error(self.wish.budget, other, trial);
            let cost = other.cost.frame.total_cmp(&trial.cost.frame);
            error.is_le() && cost.is_le() && (error.is_lt() || cost.is_lt())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing beats the pick, whichever trials cost alike and are alike in error.
    #[test]
    fn the_pick_is_on_the_front() {
        let trial = |error, largest, frame| Trial {
            candidate: Candidate::MOST_PRECISE,
            error,
            largest,
            cost: Cost { frame, flash: 0.0, ram: 0.0 },
            work: Work::default(),
            picture: crate::scene::Image { width: 0, height: 0, texels: vec![] },
        };
        for wish in [MaxError::Lsb(2.0), MaxError::Db(2.0)] {
            for case in 0..3_u32.pow(9) {
                let digit = |k: u32| (case / 3_u32.pow(k)) % 3;
                let mut trials = [0, 3, 6].map(|k| {
                    let (error, frame) = (f64::from(digit(k) + 1), f64::from(digit(k + 2)));
                    trial(error, digit(k + 1).to_le_bytes()[0], 100.0 + 1.5 * frame)
                });
                cheapest_first(&mut trials);
                let Some(pick) = pick(&trials, wish) else {
                    assert!(trials.iter().all(|trial| !wish.admits(trial.error)));
                    continue;
                };
                let (reference, wish) =
                    (trials[0].clone(), Wish { budget: wish, machine: Machine::Host, thorough: false });
                let advice = Advice { wish, trials: trials.to_vec(), pick, reference, off: None };
                assert!(advice.is_on_front(&trials[pick]), "{trials:?}, of these {pick}");
            }
        }
    }
}
