//! The figures, and the mutants that no test has killed.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::LIBRARIES;
use crate::list::Mutant;
use crate::run::Verdict;

pub(crate) fn report(
    mutants: &[Mutant],
    left_out: &BTreeMap<usize, String>,
    verdicts: &BTreeMap<usize, Verdict>,
) -> String {
    let mut text = String::new();
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    left_out.values().for_each(|reason| *reasons.entry(reason).or_default() += 1);
    let mut reasons: Vec<_> = reasons.into_iter().collect();
    reasons.sort_by_key(|&(_, count)| std::cmp::Reverse(count));
    for (reason, count) in reasons {
        _ = writeln!(text, "left out: {count}: {reason}");
    }
    for (&number, verdict) in verdicts {
        match verdict {
            Verdict::Killed(_) => {}
            _ => _ = writeln!(text, "{verdict:?}: {}", mutants[number].name),
        }
    }
    for library in LIBRARIES.into_iter().chain([""]) {
        let of_library = |number: &usize| mutants[*number].file.starts_with(format!("crates/{library}"));
        let mut counts = [0_u32; 4];
        for (_, verdict) in verdicts.iter().filter(|(number, _)| of_library(number)) {
            counts[match verdict {
                Verdict::Killed(_) => 0,
                Verdict::Survived => 1,
                Verdict::Unsettled => 2,
                Verdict::Unreached => 3,
            }] += 1;
        }
        let all: u32 = counts.iter().sum();
        let [killed, survived, unsettled, unreached] = counts;
        let share = f64::from(killed) / f64::from(all.max(1));
        // Twice the standard error, if these stand for more.
        let error = 2.0 * (share * (1.0 - share) / f64::from(all.max(1))).sqrt();
        let name = if library.is_empty() { "all" } else { library };
        _ = writeln!(
            text,
            "{name}: {:.1} % of {all} killed (± {:.1}); {survived} survived, {unsettled} unsettled, {unreached} unreached",
            100.0 * share,
            100.0 * error
        );
    }
    text
}
