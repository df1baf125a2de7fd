//! Pictures, and how two of them differ.

/// A rendered picture, top row first.
#[derive(Clone, Debug)]
pub struct Image {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue, and an alpha of 255.
    pub pixels: Vec<[u8; 4]>,
    /// The distance along the line of sight, infinite for the background.
    pub depth: Vec<f64>,
    /// Whether any triangle was drawn there.
    pub covered: Vec<bool>,
}

/// How much two pictures differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Pixels with a channel that differs by more than the tolerance.
    pub differing: usize,
    /// The largest difference of any channel of any pixel, whatever the tolerance.
    pub max: u8,
}

/// Compares two pictures channel by channel.
///
/// # Panics
/// When the pictures differ in size.
#[must_use]
pub fn compare(a: &[[u8; 4]], b: &[[u8; 4]], tolerance: u8) -> Difference {
    compare_where(a, b, tolerance, |_| true)
}

/// [`compare`] at the pixels whose index `chosen` accepts, such as those that both pictures cover.
///
/// # Panics
/// When the pictures differ in size.
#[must_use]
pub fn compare_where(
    a: &[[u8; 4]],
    b: &[[u8; 4]],
    tolerance: u8,
    chosen: impl Fn(usize) -> bool,
) -> Difference {
    assert_eq!(a.len(), b.len(), "pictures of different sizes");
    let mut difference = Difference { differing: 0, max: 0 };
    for (_, (a, b)) in a.iter().zip(b).enumerate().filter(|(i, _)| chosen(*i)) {
        let pixel = (0..4).map(|c| a[c].abs_diff(b[c])).max().unwrap_or(0);
        difference.max = difference.max.max(pixel);
        difference.differing += usize::from(pixel > tolerance);
    }
    difference
}

/// The pixels that one picture covers and the other does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CoverageDifference {
    /// Covered by the first one only.
    pub only_first: usize,
    /// Covered by the second one only.
    pub only_second: usize,
    /// Covered by both.
    pub both: usize,
}

impl CoverageDifference {
    /// The pixels on which the pictures disagree.
    #[must_use]
    pub fn differing(&self) -> usize {
        self.only_first + self.only_second
    }
}

/// Compares which pixels are covered.
///
/// # Panics
/// When the pictures differ in size.
#[must_use]
pub fn compare_coverage(a: &[bool], b: &[bool]) -> CoverageDifference {
    assert_eq!(a.len(), b.len(), "pictures of different sizes");
    let count = |wanted: (bool, bool)| a.iter().zip(b).filter(|&(&a, &b)| (a, b) == wanted).count();
    CoverageDifference {
        only_first: count((true, false)),
        only_second: count((false, true)),
        both: count((true, true)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_count_pixels_beyond_the_tolerance() {
        let a = [[10, 20, 30, 255], [0, 0, 0, 255], [9, 9, 9, 255]];
        let b = [[12, 20, 29, 255], [0, 0, 5, 255], [9, 9, 9, 255]];
        let with = |tolerance| compare(&a, &b, tolerance);
        assert_eq!(with(0), Difference { differing: 2, max: 5 });
        assert_eq!(with(2), Difference { differing: 1, max: 5 });
        assert_eq!(with(5), Difference { differing: 0, max: 5 });
        let first = compare_where(&a, &b, 0, |i| i == 0);
        assert_eq!(first, Difference { differing: 1, max: 2 });
    }

    #[test]
    fn coverage_differences_tell_the_sides_apart() {
        let difference = compare_coverage(&[true, true, false, false], &[true, false, true, true]);
        assert_eq!(difference, CoverageDifference { only_first: 1, only_second: 2, both: 1 });
        assert_eq!(difference.differing(), 3);
    }
}
