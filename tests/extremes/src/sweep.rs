//! A sweep: all rows of all axes, in blocks of samples that are divided among shards.

use crate::axis::{Axis, Note, Series};
use crate::measured::{Measured, Place};
use crate::shard::Shard;
use alberti_oracle::climb::climb;
use alberti_oracle::rng::Rng;
use std::sync::atomic::{AtomicU64, Ordering};

/// The number of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// The name, for files.
    pub name: &'static str,
    /// The blocks of a row, each of which begins anew.
    pub blocks: u64,
    /// Random samples of a block.
    pub samples: u64,
    /// Steps of a climb from each of the worst of them.
    pub steps: u64,
}

impl Effort {
    /// Seconds, for a check.
    pub const SMALL: Self = Self { name: "small", blocks: 2, samples: 60, steps: 10 };
    /// Minutes, for the page.
    pub const FULL: Self = Self { name: "full", blocks: 4, samples: 10_000, steps: 4000 };

    /// The effort of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        [Self::SMALL, Self::FULL].into_iter().find(|effort| effort.name == name)
    }
}

/// A policy at a point of an axis.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// The axis.
    pub axis: &'a Axis,
    /// The policy.
    pub series: &'a Series,
    /// The point: its value and name.
    pub point: &'a (f64, String),
}

impl Row<'_> {
    /// The name, as the command line takes it.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}/{}/{}", self.axis.name, self.series.policy, self.point.1)
    }

    /// The seed of a block: of the row's name, so that its figures stay whatever rows come and go.
    fn seed(&self, seed: u64, block: u64) -> u64 {
        Rng::stream(seed, hash(&self.name()) ^ block).u64()
    }

    /// Measures a block. `seen` hears of each sample, in order.
    fn block(
        &self,
        (seed, effort): (u64, Effort),
        block: u64,
        note: &mut Note,
        mut seen: impl FnMut(Place, &crate::measured::Sample, &Note),
    ) -> Measured {
        let mut found = Measured::default();
        let mut place = Place { block, index: 0 };
        let samples = (effort.samples / self.axis.dear).max(1);
        climb(self.seed(seed, block), samples, effort.steps / self.axis.dear, |rng| {
            let sample = (self.series.measure)(self.point.0, rng, note);
            seen(place, &sample, note);
            found.add(sample, place);
            place.index += 1;
            // Uphill to the greatest share and, in every other block, to the greatest error.
            if block.is_multiple_of(2) { sample.share() } else { sample.error }
        });
        found
    }
}

/// Axes, a seed and an effort, from which all else follows.
#[derive(Debug)]
pub struct Sweep {
    /// The axes.
    pub axes: Vec<Axis>,
    /// The seed.
    pub seed: u64,
    /// The effort.
    pub effort: Effort,
}

/// The results of all rows, in order; of rows that were not measured, nothing.
pub type Results = Vec<Measured>;

impl Sweep {
    /// All rows, in order.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.axes.iter().flat_map(|axis| {
            axis.series
                .iter()
                .flat_map(move |series| axis.points.iter().map(move |point| Row { axis, series, point }))
        })
    }

    /// A number for the list of rows and their blocks: parts of different lists do not fit together.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let Effort { blocks, samples, steps, .. } = self.effort;
        let rows = self.rows().fold(0, |all: u64, row| all.rotate_left(5) ^ hash(&row.name()));
        rows ^ hash(&format!("{blocks} {samples} {steps}"))
    }

    /// The results of a shard: of the blocks that fall to it, as by lot, so that no shard has all the dear ones.
    #[must_use]
    pub fn shard(&self, shard: Shard) -> Results {
        let blocks = self.effort.blocks;
        let mine = |unit: u64| Rng::new(unit).u64() % shard.of == shard.number - 1;
        let row = |(number, row): (usize, Row<'_>)| {
            (0..blocks)
                .filter(|block| mine(number as u64 * blocks + block))
                .map(|block| row.block((self.seed, self.effort), block, &mut Note::default(), |_, _, _| ()))
                .fold(Measured::default(), Measured::merge)
        };
        self.rows().enumerate().map(row).collect()
    }

    /// The results of all of so many shards, measured by so many threads.
    #[must_use]
    pub fn all(&self, shards: u64, threads: usize) -> Results {
        let next = AtomicU64::new(1);
        let work = || {
            let mut found = self.nothing();
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                if number > shards {
                    return found;
                }
                found = merge(found, &self.shard(Shard { number, of: shards }));
            }
        };
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads.max(1)).map(|_| scope.spawn(work)).collect();
            let joined = workers.into_iter().map(|worker| worker.join().expect("a worker has panicked"));
            joined.fold(self.nothing(), |all, part| merge(all, &part))
        })
    }

    /// The results of no shard.
    #[must_use]
    pub fn nothing(&self) -> Results {
        self.rows().map(|_| Measured::default()).collect()
    }

    /// The rows in which a bound is violated.
    #[must_use]
    pub fn violations<'a>(&'a self, results: &'a Results) -> Vec<(Row<'a>, &'a Measured)> {
        self.rows().zip(results).filter(|(_, measured)| measured.violates()).collect()
    }

    /// The case behind a sample, in words, found by measuring its block again.
    #[must_use]
    pub fn replay(&self, row: &str, wanted: Place) -> Option<String> {
        let row = self.rows().find(|each| each.name() == row)?;
        let (mut note, mut found) = (Note { wanted: true, ..Note::default() }, None);
        row.block((self.seed, self.effort), wanted.block, &mut note, |place, sample, note| {
            if place == wanted {
                found = Some(format!("{}\n{sample:?}, {:.4} of the bound", note.text, sample.share()));
            }
        });
        found
    }
}

/// The results of two parts of the same sweep.
#[must_use]
pub fn merge(a: Results, b: &Results) -> Results {
    a.into_iter().zip(b).map(|(a, b)| a.merge(*b)).collect()
}

/// FNV-1a.
fn hash(text: &str) -> u64 {
    text.bytes()
        .fold(0xCBF2_9CE4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3))
}

#[cfg(test)]
mod tests;
