//! Buffers that make no target.

use core::fmt;

/// The reason why buffers do not make a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum TargetError {
    /// No pixels, or more than 16384 columns or rows, or rows beyond the frame's last one.
    Size,
    /// The buffers of a band do not hold whole rows.
    Rows {
        /// Pixels in the band.
        pixels: usize,
        /// Pixels a row.
        width: u32,
    },
    /// The colour buffer holds another number of pixels than the frame, or fewer than a window reaches over.
    Color {
        /// Pixels in the colour buffer.
        found: usize,
        /// Pixels of the frame, or from a window's first to its last.
        expected: usize,
    },
    /// The rows of a window overlap.
    Stride {
        /// Pixels from a row to the next.
        stride: usize,
        /// Pixels a row.
        width: u32,
    },
    /// The depth buffer holds another number of pixels than the rows that are drawn.
    Depth {
        /// Pixels in the depth buffer.
        found: usize,
        /// Pixels in the rows that are drawn.
        expected: usize,
    },
    /// The buffer of a [`Silhouette`](crate::Silhouette) holds fewer words than there are pixels to be drawn to.
    Coverage {
        /// Words in the buffer.
        found: usize,
        /// Pixels within the target's limits.
        expected: usize,
    },
}

impl fmt::Display for TargetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size => f.write_str("a target needs 1 to 16384 columns and rows, within its frame"),
            Self::Rows { pixels, width } => {
                write!(f, "a band's {pixels} pixels do not make the frame's rows of {width}")
            }
            Self::Color { found, expected } => {
                write!(f, "the colour buffer holds {found} pixels, the frame or window takes {expected}")
            }
            Self::Stride { stride, width } => {
                write!(f, "rows that begin {stride} pixels apart are no room for {width}")
            }
            Self::Depth { found, expected } => {
                write!(f, "the depth buffer holds {found} pixels, the rows that are drawn {expected}")
            }
            Self::Coverage { found, expected } => {
                write!(f, "the coverage buffer holds {found} words, the pixels that are drawn are {expected}")
            }
        }
    }
}

impl core::error::Error for TargetError {}
