//! The results of a row: counts, which are summed, and worst cases, of which the greatest stays.

use std::cmp::Ordering;

/// The identity of a sample in its row: with the seed it makes the sample again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The block of the row.
    pub block: u64,
    /// The number of the sample in the block, climbed ones counted on.
    pub index: u64,
}

/// One answer, judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The error in the axis's unit; NaN is the worst of all.
    pub error: f64,
    /// The bound that is stated for this sample; infinite where none is.
    pub bound: f64,
    /// Whether a constructor refused, so that there is no answer.
    pub refused: bool,
}

impl Sample {
    /// An error beside its bound.
    #[must_use]
    pub fn new(error: f64, bound: f64) -> Self {
        Self { error: if error.is_nan() { f64::INFINITY } else { error.abs() }, bound, refused: false }
    }

    /// No answer.
    pub const REFUSED: Self = Self { error: 0.0, bound: f64::INFINITY, refused: true };

    /// The part of the bound that the error takes. Of a bound of 0 an error takes all there is.
    #[must_use]
    pub fn share(&self) -> f64 {
        if self.error == 0.0 || (self.bound.is_infinite() && self.error.is_finite()) {
            0.0
        } else if self.bound > 0.0 && self.error.is_finite() {
            self.error / self.bound
        } else {
            f64::INFINITY
        }
    }
}

/// The sample for which a figure is the greatest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// The figure; -1 where there is no sample.
    pub figure: f64,
    /// The sample's error.
    pub error: f64,
    /// Its bound.
    pub bound: f64,
    /// Its identity.
    pub place: Place,
}

impl Worst {
    const NONE: Self = Self { figure: -1.0, error: 0.0, bound: 0.0, place: Place { block: 0, index: 0 } };

    /// The worse of two; of equal ones that of the lesser identity, so that their order does not count.
    fn of(self, other: Self) -> Self {
        match self.figure.total_cmp(&other.figure).then(other.place.cmp(&self.place)) {
            Ordering::Less => other,
            _ => self,
        }
    }
}

/// Everything that is known of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The samples that were judged.
    pub samples: u64,
    /// The samples that a constructor refused.
    pub refused: u64,
    /// The greatest share of the bound.
    pub share: Worst,
    /// The greatest error.
    pub error: Worst,
}

impl Default for Measured {
    fn default() -> Self {
        Self { samples: 0, refused: 0, share: Worst::NONE, error: Worst::NONE }
    }
}

impl Measured {
    /// Takes a sample.
    pub fn add(&mut self, sample: Sample, place: Place) {
        if sample.refused {
            self.refused += 1;
            return;
        }
        self.samples += 1;
        let Sample { error, bound, .. } = sample;
        let worst = |figure: f64| Worst { figure, error, bound, place };
        self.share = self.share.of(worst(sample.share()));
        self.error = self.error.of(worst(error));
    }

    /// The results of both.
    #[must_use]
    pub fn merge(self, other: Self) -> Self {
        Self {
            samples: self.samples + other.samples,
            refused: self.refused + other.refused,
            share: self.share.of(other.share),
            error: self.error.of(other.error),
        }
    }

    /// Whether a sample was beyond its bound.
    #[must_use]
    pub fn violates(&self) -> bool {
        self.share.figure > 1.0
    }

    /// Whether no bound is stated for the worst sample.
    #[must_use]
    pub fn is_unbounded(&self) -> bool {
        self.samples > 0 && self.error.bound.is_infinite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(samples: &[(f64, f64, u64)]) -> Measured {
        let mut all = Measured::default();
        for &(error, bound, index) in samples {
            let sample = if bound < 0.0 { Sample::REFUSED } else { Sample::new(error, bound) };
            all.add(sample, Place { block: index % 2, index });
        }
        all
    }

    #[test]
    fn merging_does_not_depend_on_order_or_grouping() {
        let parts = [
            measured(&[(1.0, 2.0, 0), (3.0, 4.0, 1)]),
            measured(&[(3.0, 4.0, 2), (0.1, f64::INFINITY, 3)]),
            measured(&[(0.0, -1.0, 4), (3.0, 4.0, 5)]),
            Measured::default(),
        ];
        let [a, b, c, d] = parts;
        let whole = a.merge(b).merge(c).merge(d);
        assert_eq!((whole.samples, whole.refused, whole.share.figure), (5, 1, 0.75));
        // Three samples are equally bad: block 0 comes first.
        assert_eq!(whole.share.place, Place { block: 0, index: 2 });
        for other in
            [d.merge(c).merge(b.merge(a)), a.merge(b.merge(c.merge(d))), c.merge(a).merge(d.merge(b))]
        {
            assert_eq!(other, whole);
        }
    }

    #[test]
    fn an_error_is_held_against_its_bound() {
        assert!(measured(&[(2.1, 2.0, 0)]).violates() && !measured(&[(2.0, 2.0, 0)]).violates());
        assert!(measured(&[(1e-9, 0.0, 0)]).violates() && !measured(&[(0.0, 0.0, 0)]).violates());
        assert!(measured(&[(f64::NAN, 1.0, 0)]).violates());
        assert!(measured(&[(f64::INFINITY, f64::INFINITY, 0)]).violates());
        assert!(!measured(&[(1e9, f64::INFINITY, 0)]).violates());
    }
}
