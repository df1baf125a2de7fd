//! Percentiles of errors in any unit.

use std::cmp::Ordering;

/// The percentile of `errors` by nearest rank: the least of them that `thousandths` of a thousand do not exceed.
///
/// Of n errors in ascending order it is the one at rank ceil(n · `thousandths` / 1000), from 1, and never a value
/// between two. So with less than a thousand errors the 99.9 % percentile is the largest. Rank 0 counts as 1, more than
/// n as n. NaN is above every number: an error that could not be found is no small one. Without errors there is none.
pub fn percentile<T: Copy + PartialOrd>(errors: &[T], thousandths: u32) -> Option<T> {
    let last = errors.len().checked_sub(1)?;
    let rank = (errors.len() as u128 * u128::from(thousandths)).div_ceil(1000);
    let index = usize::try_from(rank.saturating_sub(1)).unwrap_or(last).min(last);
    let mut errors = errors.to_vec();
    let (_, found, _) = errors.select_nth_unstable_by(index, |a, b| ascending(*a, *b));
    Some(*found)
}

fn ascending<T: Copy + PartialOrd>(a: T, b: T) -> Ordering {
    let is_nan = |x: T| x.partial_cmp(&x).is_none();
    a.partial_cmp(&b).unwrap_or_else(|| is_nan(a).cmp(&is_nan(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers 1 to n in an order that is neither.
    fn shuffled(n: u32) -> Vec<u32> {
        (0..n).map(|i| (i * 7919) % n + 1).collect()
    }

    #[test]
    fn ranks_are_counted_from_below() {
        // ceil(0.999 n), by hand.
        for (n, rank) in [(1, 1), (2, 2), (999, 999), (1000, 999), (1001, 1000), (2000, 1998), (2001, 1999)] {
            assert_eq!(percentile(&shuffled(n), 999), Some(rank), "{n}");
        }
        assert_eq!([0, 1, 250, 251, 500, 1000, 2000].map(|p| percentile(&[40, 10, 30, 20], p)), {
            [10, 10, 10, 20, 20, 40, 40].map(Some)
        });
        assert_eq!(percentile::<f64>(&[], 999), None);
    }

    #[test]
    fn nan_is_the_largest_error() {
        let errors = [f32::NAN, 0.5, -f32::NAN, f32::INFINITY, 0.25];
        assert_eq!([1, 400, 600].map(|p| percentile(&errors, p).unwrap()), [0.25, 0.5, f32::INFINITY]);
        assert!([601, 1000].iter().all(|&p| percentile(&errors, p).unwrap().is_nan()));
        assert_eq!(percentile(&[0.75_f64; 3], 999), Some(0.75));
    }
}
