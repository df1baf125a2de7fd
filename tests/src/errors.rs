//! The distribution of a measured error, for bounds that are asserted and figures that are printed.

use std::fmt;

/// Errors in units of ε = 2^-24, counted in bins.
#[derive(Clone, Debug)]
pub struct Errors {
    bins: Vec<u64>,
    max: f64,
    count: u64,
}

/// Bins to one ε.
const FINENESS: f64 = 100.0;
/// The last bin takes everything from here on.
const TOP: usize = 3_200;

impl Default for Errors {
    fn default() -> Self {
        Self { bins: vec![0; TOP + 1], max: 0.0, count: 0 }
    }
}

impl Errors {
    /// Takes an error of either sign. NaN counts as infinite.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the cast saturates")]
    pub fn add(&mut self, eps: f64) {
        let size = if eps.is_nan() { f64::INFINITY } else { eps.abs() };
        self.max = self.max.max(size);
        self.count += 1;
        self.bins[((size * FINENESS) as usize).min(TOP)] += 1;
    }

    /// How many were taken.
    #[must_use]
    pub const fn count(&self) -> u64 {
        self.count
    }

    /// The largest.
    #[must_use]
    pub const fn max(&self) -> f64 {
        self.max
    }

    /// What this share of all errors does not exceed, to a bin's width.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    pub fn quantile(&self, share: f64) -> f64 {
        let mut below = 0;
        for (bin, n) in self.bins.iter().enumerate().take(TOP) {
            below += n;
            if below as f64 >= share * self.count as f64 {
                return (bin + 1) as f64 / FINENESS;
            }
        }
        self.max
    }
}

impl fmt::Display for Errors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (high, median) = (self.quantile(0.999), self.quantile(0.5));
        write!(f, "max {:.3}ε, p99.9 {high:.2}ε, median {median:.2}ε of {}", self.max, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_and_the_maximum() {
        let mut errors = Errors::default();
        for hundredth in 0..1000u16 {
            errors.add(-f64::from(hundredth) / 100.0 - 0.001);
        }
        assert_eq!((errors.count(), errors.max()), (1000, 9.991));
        assert!((errors.quantile(0.5) - 5.0).abs() < 0.02, "{errors}");
        assert!((errors.quantile(0.999) - 9.99).abs() < 0.02, "{errors}");
        errors.add(f64::NAN);
        assert_eq!((errors.max(), errors.quantile(1.0)), (f64::INFINITY, f64::INFINITY));
    }
}
