//! The policies of straight lines as one type whose value is chosen at run time, so that the kernels over it are
//! compiled once for all of them. Which one it is gets asked for each run of pixels, not for each pixel; the bits are
//! those of the library's policy.

use alberti::raster::{EdgeInt, KnownRow, Numbers, Run, Subdivision};
use alberti::{Affine, Bounded};

/// A policy that divides rows into runs.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lines {
    Spans(i32),
    Bounded(Bounded),
    Affine,
}

impl Subdivision for Lines {
    const RUN: i32 = 1;

    #[inline(always)]
    fn perspective(&self) -> bool {
        !matches!(self, Self::Affine)
    }

    #[inline(always)]
    fn run<I: EdgeInt, N: Numbers>(&self, row: &KnownRow<'_, I, N>, column: i32) -> Run<N::Ends> {
        match self {
            Self::Spans(length) => row.run(self, column, *length),
            Self::Bounded(bounded) => bounded.run(row, column),
            Self::Affine => Affine.run(row, column),
        }
    }
}
