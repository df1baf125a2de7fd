//! Runs of straight lines: where they begin and end, and that they are as long as the budget allows.

use crate::quad::{TEXELS, met, middle, probed};
use alberti_app::options::Arithmetic;
use alberti_app::probe::{Probes, Run};
use std::ops::Range;

/// The columns of the run that a pixel is in.
fn run(probes: &Probes, index: usize) -> Option<Range<u32>> {
    match probes.seen(index)?.run {
        Some(Run::Columns { start, length }) => Some(start..start + length),
        other => panic!("{other:?}"),
    }
}

/// The pixels of each row that a triangle covers: the indices of the first and of the last.
fn rows(probes: &Probes) -> Vec<[usize; 2]> {
    let width = probes.size()[0] as usize;
    let mut rows: Vec<[usize; 2]> = Vec::new();
    let of = |index: usize| probes.seen(index).map(|seen| (seen.triangle, index / width));
    for index in (0..probes.pixels()).filter(|&index| of(index).is_some()) {
        match rows.last_mut() {
            Some([_, last]) if *last + 1 == index && of(*last) == of(index) => *last = index,
            _ => rows.push([index, index]),
        }
    }
    rows
}

#[test]
fn spans_lie_at_multiples_of_their_length() {
    for (policy, length) in [("spans:4", 4), ("spans:16", 16), ("affine", 64)] {
        for arithmetic in [Arithmetic::Float, Arithmetic::Fixed] {
            let probes = probed(policy, arithmetic);
            let width = probes.size()[0];
            let mut whole = 0;
            for [first, last] in rows(&probes) {
                for index in first..=last {
                    let column = index as u32 % width;
                    let cell = column / length * length;
                    let expected =
                        cell.max(first as u32 % width)..(cell + length).min(last as u32 % width + 1);
                    whole += u32::from(expected.len() == length as usize);
                    assert_eq!(run(&probes, index), Some(expected), "{policy} {arithmetic:?} {index}");
                }
            }
            assert!(whole > 1000, "{policy}: {whole}");
        }
    }
}

#[test]
fn a_division_at_each_pixel_has_no_runs() {
    for policy in ["exact", "plane"] {
        let probes = probed(policy, Arithmetic::Float);
        let seen: Vec<_> = (0..probes.pixels()).filter_map(|index| probes.seen(index)).collect();
        assert!(seen.len() > 1000 && seen.iter().all(|seen| seen.run.is_none()), "{}", seen.len());
    }
}

/// The bound on the miss of a straight line, |Δu| |Δq| / (max q + 3 min q), between the middles of two pixels, by rays.
fn bound(from: usize, to: usize) -> f64 {
    let [a, b] = [from, to].map(|index| met(middle(index)));
    let [qa, qb] = [1.0 / a[2], 1.0 / b[2]];
    let apart = (qa - qb).abs() / (qa.max(qb) + 3.0 * qa.min(qb));
    apart * (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// The miss itself, at the pixels of a run.
fn miss(from: usize, to: usize) -> f64 {
    let [a, b] = [from, to].map(|index| met(middle(index)));
    let at = |index: usize| {
        let part = (index - from) as f64 / (to - from).max(1) as f64;
        let right = met(middle(index));
        (0..2).map(|k| (a[k] + (b[k] - a[k]) * part - right[k]).abs()).fold(0.0, f64::max)
    };
    (from..=to).map(at).fold(0.0, f64::max)
}

#[test]
fn bounded_runs_miss_no_more_than_the_budget_and_none_could_be_twice_as_long() {
    for texels in [0.5, 2.0] {
        let budget = texels / f64::from(TEXELS[0]);
        let probes = probed(&format!("bounded:{texels}"), Arithmetic::Fixed);
        let width = probes.size()[0] as usize;
        let (mut tried, mut lengths) = (0, Vec::new());
        for [first, last] in rows(&probes) {
            let row = first - first % width;
            let mut index = first;
            while index <= last {
                let columns = run(&probes, index).expect("a run");
                assert_eq!(row + columns.start as usize, index, "runs follow each other");
                // A line goes to the next run's first sample, or to the row's last.
                let next = row + columns.end as usize;
                assert!((index..next).all(|k| run(&probes, k) == Some(columns.clone())));
                assert!(miss(index, next.min(last)) <= budget * 1.01 + 1e-6, "{texels} {columns:?}");
                lengths.push(columns.len());
                // The least multiple of a power of two that holds it, and the one of twice the length.
                let cell = (columns.start ^ (columns.end - 1)).checked_ilog2().map_or(1, |log| 2 << log);
                let from = ((columns.start / (2 * cell) * 2 * cell) as usize + row).max(first);
                let to = (columns.start / (2 * cell) * 2 * cell + 2 * cell) as usize + row;
                let longer = (from, to.min(last)) != (index, next.min(last));
                if cell < 64 && longer {
                    // The budget has room for the steps of fixed point, too.
                    let steps = (2 * cell + 4) as f64 / 65536.0;
                    assert!(
                        bound(from, to.min(last)) + steps > budget * 0.99,
                        "{texels} {columns:?} of {cell}"
                    );
                    tried += 1;
                }
                index = next;
            }
            assert_eq!(index, last + 1, "the last run ends with the row");
        }
        lengths.sort_unstable();
        lengths.dedup();
        assert!(tried > 30 && lengths.len() > 3, "{tried} {lengths:?}");
    }
}
