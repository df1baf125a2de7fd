//! Shards make the whole, and a bound that is too small is found.

use super::*;
use crate::axes;
use crate::measured::Sample;

/// The axes of these names, with their bounds times a factor.
pub(crate) fn sweep_of(names: &[&str], factor: f64) -> Sweep {
    let mut axes: Vec<Axis> = axes::all().into_iter().filter(|axis| names.contains(&axis.name)).collect();
    assert_eq!(axes.len(), names.len());
    for axis in &mut axes {
        axis.series = std::mem::take(&mut axis.series)
            .into_iter()
            .map(|Series { policy, refuses, measure }| {
                let measure = Box::new(move |point: f64, rng: &mut Rng, note: &mut Note| {
                    let sample = measure(point, rng, note);
                    Sample { bound: sample.bound * factor, ..sample }
                });
                Series { policy, refuses, measure }
            })
            .collect();
    }
    Sweep { axes, seed: 7, effort: Effort { name: "small", blocks: 3, samples: 12, steps: 3 } }
}

#[test]
fn names_are_unique_and_axes_have_points() {
    let sweep = sweep_of(&[], 1.0);
    let sweep = Sweep { axes: axes::all(), ..sweep };
    let mut names: Vec<String> = sweep.rows().map(|row| row.name()).collect();
    let count = names.len();
    names.sort();
    names.dedup();
    assert!(names.len() == count && count > 500, "{count}");
    assert!(sweep.axes.iter().all(|axis| axis.points.is_sorted_by(|a, b| a.0 < b.0)));
}

#[test]
fn shards_of_any_number_and_in_any_order_make_the_whole() {
    let sweep = sweep_of(&["ratios", "angles"], 1.0);
    let whole = sweep.shard(Shard::WHOLE);
    assert!(whole.iter().all(|row| row.samples + row.refused >= 36));
    for of in [2, 5] {
        let mut parts: Vec<Results> = (1..=of).map(|number| sweep.shard(Shard { number, of })).collect();
        let in_order = parts.iter().fold(sweep.nothing(), merge);
        parts.reverse();
        let reversed = parts.iter().fold(sweep.nothing(), merge);
        assert!(in_order == whole && reversed == whole, "{of} shards");
    }
    assert!(sweep.all(4, 2) == whole);
    let other = Sweep { seed: 8, ..sweep_of(&["ratios", "angles"], 1.0) };
    assert!(other.shard(Shard::WHOLE) != whole);
}

/// Straight lines come up to their bounds, and so do snapped vertices.
#[test]
fn a_bound_that_is_half_of_the_stated_one_is_violated() {
    let sweep = sweep_of(&["ratios", "angles"], 1.0);
    let whole = sweep.shard(Shard::WHOLE);
    assert_eq!(sweep.violations(&whole).len(), 0);
    let halved = sweep_of(&["ratios", "angles"], 0.5);
    let results = halved.shard(Shard::WHOLE);
    let found: Vec<String> = halved.violations(&results).iter().map(|(row, _)| row.name()).collect();
    for name in ["ratios/Spans16/1000", "ratios/Affine/1000", "angles/snapped to 1/256 pixel/90"] {
        assert!(found.iter().any(|row| row == name), "{name} is not in {found:?}");
    }
}

#[test]
fn a_sample_is_found_again_by_its_identity() {
    let sweep = sweep_of(&["repeats"], 1.0);
    let results = sweep.shard(Shard::WHOLE);
    let (row, measured) = sweep
        .rows()
        .zip(&results)
        .find(|(row, _)| row.series.policy == "Spans16" && row.point.1 == "2^10")
        .expect("a row");
    let text = sweep.replay(&row.name(), measured.share.place).expect("a sample");
    assert!(text.contains(&format!("{:.4} of the bound", measured.share.figure)), "{text}");
    assert!(text.contains("pixel: [") && sweep.replay("no/such/row", measured.share.place).is_none());
}

/// Nothing but refusals where a constructor must refuse, and none where it must not.
#[test]
fn constructors_refuse_at_the_ends() {
    let sweep = sweep_of(&["angles", "targets", "offsets", "gaps"], 1.0);
    let results = sweep.shard(Shard::WHOLE);
    for (row, measured) in sweep.rows().zip(&results) {
        let refuses = matches!(
            (row.axis.name, row.series.policy.as_str(), row.point.1.as_str()),
            ("angles", _, "0" | "180")
                | ("targets", _, "32768")
                | ("offsets", _, "32769")
                | ("gaps", _, "1")
                | ("gaps", "F32Reversed", "1e40")
        );
        assert_eq!(measured.samples == 0, refuses, "{}: {measured:?}", row.name());
        assert_eq!(measured.refused > 0, refuses, "{}: {measured:?}", row.name());
    }
}
