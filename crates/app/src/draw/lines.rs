//! The policies of straight lines as one type whose value is chosen at run time, so that the kernels over it are
//! compiled once for all of them. Which one it is gets asked for each run of pixels, not for each pixel; the bits are
//! those of the library's policy.

use alberti::lanes::Floating;
use alberti::raster::{
    EdgeInt, FloatingCursor, FloatingLines, Interpolate, Left, LineTriangle, Numbers, Oriented, Row, Run,
    Subdivision,
};
use alberti::{Affine, Bounded, DepthFormat, Interpolation, Spans, Subpixel, Varying};

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

impl Interpolation for Lines {
    type Lanes<L: Floating> = L;
    type Triangle<L: Floating, V: Varying> = LinesTriangle<L, V>;
    const RUN: i32 = <Self as Subdivision>::RUN;

    #[inline(always)]
    fn lanes<L: Floating>(lanes: L) -> L {
        lanes
    }

    #[inline(always)]
    fn prepare<L: Floating, S: Subpixel, D: DepthFormat, V: Varying>(
        self,
        lanes: L,
        triangle: &Oriented<'_, S, V>,
    ) -> LinesTriangle<L, V> {
        LinesTriangle {
            divided: match self {
                Self::Spans4 => Divided::Spans4(Spans.prepare::<L, S, D, V>(lanes, triangle)),
                Self::Spans8 => Divided::Spans8(Spans.prepare::<L, S, D, V>(lanes, triangle)),
                Self::Spans16 => Divided::Spans16(Spans.prepare::<L, S, D, V>(lanes, triangle)),
                Self::Spans32 => Divided::Spans32(Spans.prepare::<L, S, D, V>(lanes, triangle)),
                Self::Bounded(bounded) => Divided::Bounded(bounded.prepare::<L, S, D, V>(lanes, triangle)),
                Self::Affine => Divided::Affine(Affine.prepare::<L, S, D, V>(lanes, triangle)),
            },
            line: Affine.prepare::<L, S, D, V>(lanes, triangle),
        }
    }
}

/// A triangle prepared for [`Lines`].
#[derive(Clone, Copy, Debug)]
pub(super) struct LinesTriangle<L: Floating, V: Varying> {
    divided: Divided<L, V>,
    /// Along a run all policies are the same.
    line: Triangle<Affine, L, V>,
}

type Triangle<P, L, V> = LineTriangle<P, FloatingLines<L, V>>;

#[derive(Clone, Copy, Debug)]
enum Divided<L: Floating, V: Varying> {
    Spans4(Triangle<Spans<4>, L, V>),
    Spans8(Triangle<Spans<8>, L, V>),
    Spans16(Triangle<Spans<16>, L, V>),
    Spans32(Triangle<Spans<32>, L, V>),
    Bounded(Triangle<Bounded, L, V>),
    Affine(Triangle<Affine, L, V>),
}

impl<L: Floating, V: Varying> Interpolate<L, V> for LinesTriangle<L, V> {
    type Row = <Triangle<Affine, L, V> as Interpolate<L, V>>::Row;
    type Cursor = FloatingCursor<L, V>;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, row: &Row<'_, I>) -> Self::Row {
        self.line.row(row)
    }

    #[inline(always)]
    fn start<I: EdgeInt>(
        &self,
        row: &Row<'_, I>,
        known: &mut Self::Row,
        column: i32,
        aligned: i32,
    ) -> (Self::Cursor, i32) {
        match &self.divided {
            Divided::Spans4(triangle) => triangle.start(row, known, column, aligned),
            Divided::Spans8(triangle) => triangle.start(row, known, column, aligned),
            Divided::Spans16(triangle) => triangle.start(row, known, column, aligned),
            Divided::Spans32(triangle) => triangle.start(row, known, column, aligned),
            Divided::Bounded(triangle) => triangle.start(row, known, column, aligned),
            Divided::Affine(triangle) => triangle.start(row, known, column, aligned),
        }
    }

    #[inline(always)]
    fn advance(&self, cursor: Self::Cursor) -> Self::Cursor {
        self.line.advance(cursor)
    }

    #[inline(always)]
    fn depth(&self, cursor: &Self::Cursor, weights: &[L::Number; 3]) -> L::Depth {
        self.line.depth(cursor, weights)
    }

    #[inline(always)]
    fn attributes(&self, cursor: &Self::Cursor, weights: &[L::Number; 3]) -> V::Of<L::Number> {
        self.line.attributes(cursor, weights)
    }
}
