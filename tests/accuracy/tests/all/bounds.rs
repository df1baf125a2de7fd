//! Every row of the tables keeps the bound that the documentation states.

use alberti_accuracy::{run, tables};
use alberti_oracle::climb::climb;
use alberti_oracle::rng::{Rng, run_seed};

/// Fewer than the tables have, so that the test takes seconds; another seed looks at others.
const SAMPLES: usize = 1_000;
/// Steps from each of the worst.
const STEPS: u64 = 150;

#[test]
fn every_function_keeps_its_bound() {
    let seed = run_seed();
    let rows: Vec<_> = tables().into_iter().flat_map(|table| table.rows).collect();
    let mut broken = Vec::new();
    for row in &rows {
        let [eps, _] = run(row, SAMPLES, &mut Rng::stream(seed, row.stream()));
        println!("{row:?}: max {:.3}ε, 99.9 % {:.3}ε, median {:.3}ε", eps.max, eps.high, eps.median);
        let climbed = climb(seed ^ row.stream(), SAMPLES as u64, STEPS, |rng| (row.measure)(rng).eps);
        println!("    climbed to {:.3}ε from {:.3}ε", climbed.most, climbed.random);
        let most = eps.max.max(climbed.most);
        if most > row.bound {
            broken.push(format!("{row:?}: {most:.3}ε"));
        }
    }
    assert!(broken.is_empty(), "beyond the bound:\n{}", broken.join("\n"));
    assert!(rows.iter().filter(|row| row.bound.is_finite()).count() * 10 >= rows.len() * 8);
}
