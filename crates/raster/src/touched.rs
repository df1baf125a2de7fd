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
    pub fn new(columns: Range<i32>, rows: Range<i32>) -> Self {
        if columns.is_empty() || rows.is_empty() { Self::default() } else { Self { columns, rows } }
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
