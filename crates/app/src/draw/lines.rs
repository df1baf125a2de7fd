//! The policies of straight lines as one type whose value is chosen at run time, so that the kernels over it are
//! compiled once for all of them. Which one it is gets asked for each run of pixels, not for each pixel; the bits are
//! those of the library's policy.

use alberti::raster::{EdgeInt, Left, Numbers, Row, Run, Subdivision};
use alberti::{Affine, Bounded, Spans};

/// A policy that divides rows into runs.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lines {
    Spans4,
    Spans8,
    Spans16,
    Spans32,
    Bounded(Bounded),
    Affine,
}

impl Subdivision for Lines {
    const RUN: i32 = 1;

    #[inline(always)]
    fn run<I: EdgeInt, N: Numbers>(
        &self,
        numbers: &N,
        row: &Row<'_, I>,
        column: i32,
        left: &Left<N::Ends>,
    ) -> Run<N::Ends> {
        match self {
            Self::Spans4 => Spans::<4>.run(numbers, row, column, left),
            Self::Spans8 => Spans::<8>.run(numbers, row, column, left),
            Self::Spans16 => Spans::<16>.run(numbers, row, column, left),
            Self::Spans32 => Spans::<32>.run(numbers, row, column, left),
            Self::Bounded(bounded) => bounded.run(numbers, row, column, left),
            Self::Affine => Affine.run(numbers, row, column, left),
        }
    }
}
