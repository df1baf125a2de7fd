//! The functions of docs/accuracy.md, by their own rows of inputs and bounds.

use super::ensure;
use crate::Found;
use alberti_accuracy::tables;
use alberti_oracle::climb::climb;

/// One row, random and uphill: row after row, then again with other numbers.
///
/// # Errors
/// A row beyond its bound.
pub fn block(block: u64, seed: u64) -> Result<Found, String> {
    let rows: Vec<_> = tables().into_iter().flat_map(|table| table.rows).collect();
    let bounded: Vec<_> = rows.into_iter().filter(|row| row.bound.is_finite()).collect();
    let row = &bounded[block as usize % bounded.len()];
    let (samples, steps) = (1_000, 1_000);
    let share = |eps: f64| if row.bound > 0.0 { eps / row.bound } else { eps * f64::INFINITY };
    let found = climb(seed ^ row.stream() ^ block, samples, steps, |rng| {
        let eps = (row.measure)(rng).eps;
        if eps == 0.0 { 0.0 } else { share(eps) }
    });
    ensure!(found.most <= 1.0, "{row:?}: {} of the bound", found.most);
    Ok(Found { cases: samples + 4 * steps, worst: found.most })
}
