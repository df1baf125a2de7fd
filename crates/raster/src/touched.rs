//! The part of a frame that drawings have touched.

use crate::counters::Counters;
use crate::triangle::Outcome;
use core::ops::Range;

/// The rectangle about all samples of the target in the boxes of what was drawn: triangles, lines, points and fringes.
/// That much has to be sent to a display that shows the frame before.
///
/// It is a counter, for [`Pass::count_by`](https://docs.rs/alberti/latest/alberti/struct.Pass.html#method.count_by).
/// A frame touches the pixels that it clears as well: join its rectangle with that of the frame before.
///
/// ```
/// use alberti_raster::Touched;
///
/// let (before, now) = (Touched::new(10..20, 5..9), Touched::new(12..24, 4..8));
/// let send = before.with(&now);
/// assert_eq!((send.columns(), send.rows()), (10..24, 4..9));
/// ```
///
/// # Cost
/// A triangle: four comparisons.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Touched {
    columns: Range<i32>,
    rows: Range<i32>,
}

impl Touched {
    /// These columns and rows; nothing, if there are none of either.
    #[must_use]
    pub const fn new(columns: Range<i32>, rows: Range<i32>) -> Self {
        let empty = columns.start >= columns.end || rows.start >= rows.end;
        if empty { Self { columns: 0..0, rows: 0..0 } } else { Self { columns, rows } }
    }

    /// Whether nothing was touched.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// The columns.
    #[must_use]
    pub fn columns(&self) -> Range<i32> {
        self.columns.clone()
    }

    /// The rows.
    #[must_use]
    pub fn rows(&self) -> Range<i32> {
        self.rows.clone()
    }

    /// The rectangle about both.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        match (self.is_empty(), other.is_empty()) {
            (true, _) => other.clone(),
            (_, true) => self.clone(),
            _ => Self { columns: about(&self.columns, &other.columns), rows: about(&self.rows, &other.rows) },
        }
    }

    /// The rectangle about this one whose columns begin and end at multiples of `columns`: for pixels that share bytes,
    /// 2 of [`Rgb444`](crate::color::Rgb444) and [`Grey4`](crate::color::Grey4), 4 of [`Grey2`](crate::color::Grey2),
    /// 8 of [`Grey1`](crate::color::Grey1). It lies in frames whose width is such a multiple.
    #[must_use]
    pub fn aligned(&self, columns: i32) -> Self {
        let each = columns.max(1);
        let below = |column: i32| column.saturating_sub(column.rem_euclid(each));
        let Range { start, end } = self.columns;
        Self { columns: below(start)..below(end.saturating_add(each - 1)), rows: self.rows() }
    }
}

#[inline]
fn about(a: &Range<i32>, b: &Range<i32>) -> Range<i32> {
    a.start.min(b.start)..a.end.max(b.end)
}

impl Counters for Touched {
    #[inline]
    fn touched(&mut self, outcome: Outcome, area: impl FnOnce() -> [Range<i32>; 2]) {
        if outcome == Outcome::Drawn {
            let [columns, rows] = area();
            *self = self.with(&Self { columns, rows });
        }
    }

    fn add(&mut self, other: Self) {
        *self = self.with(&other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn aligned_columns_are_the_nearest_multiples_about() {
        for each in 1..9 {
            for (start, end) in (-20..20).flat_map(|start| (start + 1..21).map(move |end| (start, end))) {
                let aligned = Touched::new(start..end, 3..5).aligned(each).columns();
                let multiple = |column: &i32| column % each == 0;
                let expected =
                    (-30..=start).rev().find(multiple).zip((end..30).find(multiple)).map(|(a, b)| a..b);
                assert_eq!(Some(aligned), expected, "{start}..{end} by {each}");
            }
            assert!(Touched::default().aligned(each).is_empty());
        }
        let _ = Touched::new(i32::MIN..i32::MAX, 0..1).aligned(7);
    }
}
