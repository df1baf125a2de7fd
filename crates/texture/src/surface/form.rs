//! Grids and subdivisions as values that files and fuzzers give: checked, and found again as they were.

#[cfg(feature = "arbitrary")]
use arbitrary::{Arbitrary, Unstructured};

use super::displacement::{Grid, Subdivision};
use core::fmt;

/// A number of cells or parts that is too small or too large.
#[derive(Clone, Copy, Debug)]
pub(super) struct OutOfRange(u32);

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} pieces of a side, expected 1 to {}", self.0, Grid::MAX_CELLS)
    }
}

fn checked(count: u32) -> Result<u32, OutOfRange> {
    if (1..=Grid::MAX_CELLS).contains(&count) { Ok(count) } else { Err(OutOfRange(count)) }
}

/// A [`Grid`].
#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Cells {
    columns: u32,
    rows: u32,
    /// Whether vertices are the middles of texels.
    of_texels: bool,
}

impl From<Grid> for Cells {
    fn from(Grid { columns, rows, margin }: Grid) -> Self {
        Self { columns, rows, of_texels: margin > 0 }
    }
}

impl TryFrom<Cells> for Grid {
    type Error = OutOfRange;

    fn try_from(Cells { columns, rows, of_texels }: Cells) -> Result<Self, OutOfRange> {
        Ok(Self { columns: checked(columns)?, rows: checked(rows)?, margin: of_texels.into() })
    }
}

/// A [`Subdivision`].
#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Parts {
    parts: u32,
}

impl From<Subdivision> for Parts {
    fn from(subdivision: Subdivision) -> Self {
        Self { parts: subdivision.parts() }
    }
}

impl TryFrom<Parts> for Subdivision {
    type Error = OutOfRange;

    fn try_from(Parts { parts }: Parts) -> Result<Self, OutOfRange> {
        checked(parts).map(Self::new)
    }
}

#[cfg(feature = "arbitrary")]
impl<'a> Arbitrary<'a> for Grid {
    fn arbitrary(bytes: &mut Unstructured<'a>) -> arbitrary::Result<Self> {
        let mut side = || bytes.int_in_range(1..=Self::MAX_CELLS);
        let (columns, rows) = (side()?, side()?);
        Ok(Self { columns, rows, margin: bool::arbitrary(bytes)?.into() })
    }
}

#[cfg(feature = "arbitrary")]
impl<'a> Arbitrary<'a> for Subdivision {
    fn arbitrary(bytes: &mut Unstructured<'a>) -> arbitrary::Result<Self> {
        bytes.int_in_range(1..=Self::MAX_PARTS).map(Self::new)
    }
}
