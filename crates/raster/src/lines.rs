//! Interpolation by straight lines along runs of a row's samples: the policies say how long a run is and whether its
//! ends are corrected for perspective, the numbers are `f32` or fixed point.
//!
//! ```text
//!   u |        .*          * right, at the ends of runs: u = Σ Ei qi ui / Σ Ei qi
//!     |    .'  |           . the line between
//!     |  *'    |
//!     +--+-----+-------> column
//!      first  last
//! ```

use crate::edge::EdgeInt;
use crate::interpolation::{Interpolate, Row};
use crate::spans::Span;
use alberti_math::Varying;
use alberti_math::lanes::Lanes;
use core::fmt::Debug;

/// A policy that divides rows into runs.
pub trait Subdivision: Copy + Debug + 'static {
    /// The length of all runs, or 1 if there is none such, see [`Interpolation::RUN`](crate::Interpolation::RUN).
    const RUN: i32;

    /// Whether what is hyperbolic is so at the ends of runs, or linear on the screen like the rest.
    fn perspective(&self) -> bool;

    /// The columns of the run of a row that a covered column is in, and what is known at its ends.
    fn run<I: EdgeInt, N: Numbers>(&self, row: &KnownRow<'_, I, N>, column: i32) -> Run<N::Ends>;
}

/// What the run before has left: what is known at its last column, which is this one's first.
pub type Left<E> = Option<E>;

/// A row, what is known of it, and what the run before has left, if it was drawn.
#[derive(Debug)]
pub struct KnownRow<'a, I, N: Numbers> {
    numbers: &'a N,
    row: &'a Row<'a, I>,
    known: &'a N::Row,
    left: &'a Left<N::Ends>,
}

impl<I: EdgeInt, N: Numbers> KnownRow<'_, I, N> {
    /// The run of `length` columns, a power of two, that a covered column is in.
    #[inline(always)]
    pub fn run<P: Subdivision>(&self, policy: &P, column: i32, length: i32) -> Run<N::Ends> {
        let Self { numbers, row, known, left } = self;
        let after = (column | (length - 1)) + 1;
        let last = after.min(row.covered.end - 1);
        let first = row.covered.start.max(column & !(length - 1));
        let ends = match left {
            // What the run before has left is that of this column.
            Some(ends) if first == column => numbers.extend(policy, row, known, ends, last),
            _ => {
                let ends = numbers.begin(policy, row, known, first);
                if last == first { ends } else { numbers.extend(policy, row, known, &ends, last) }
            }
        };
        Run { columns: [first, last], ends, next: after.min(row.covered.end), length }
    }
}

/// A run of a row's samples.
#[derive(Clone, Copy, Debug)]
pub struct Run<E> {
    /// The columns of its first sample and of the next run's first, or the row's last.
    pub columns: [i32; 2],
    /// What is known there.
    pub ends: E,
    /// The column that follows it.
    pub next: i32,
    /// So many columns, a power of two, are between the ends of a run that is whole.
    pub length: i32,
}

/// What is linear or hyperbolic over a triangle, in some kind of numbers.
pub trait Numbers {
    /// What is known of a row.
    type Row: Copy;
    /// What is known at both ends of a run.
    type Ends: Copy;

    /// Begins a row.
    fn row<I: EdgeInt, P: Subdivision>(&self, policy: &P, row: &Row<'_, I>) -> Self::Row;

    /// The run of one sample, a covered column of a row.
    fn begin<I: EdgeInt, P: Subdivision>(
        &self,
        policy: &P,
        row: &Row<'_, I>,
        known: &Self::Row,
        column: i32,
    ) -> Self::Ends;

    /// The run from the end of another to another covered column of the same row.
    fn extend<I: EdgeInt, P: Subdivision>(
        &self,
        policy: &P,
        row: &Row<'_, I>,
        known: &Self::Row,
        ends: &Self::Ends,
        column: i32,
    ) -> Self::Ends;

    /// Whether a straight line between the ends, which are at these columns, misses no component by more than the
    /// budget.
    fn within(&self, known: &Self::Row, ends: &Self::Ends, columns: [i32; 2], budget: f32) -> bool;
}

/// The same for several lanes, with what is needed at each sample.
pub trait Lines<L: Lanes, V: Varying>: Numbers {
    /// What is known of a group of samples.
    type Cursor: Copy;

    /// The line along a run, at the samples from the column `aligned` on, of which `column` is the first to be drawn.
    fn line(&self, row: &Self::Row, run: &Run<Self::Ends>, column: i32, aligned: i32) -> Self::Cursor;

    /// The samples after those.
    fn advance(&self, cursor: Self::Cursor) -> Self::Cursor;

    /// The screen depth at each.
    fn depth(&self, cursor: &Self::Cursor) -> L::Depth;

    /// The attributes at each.
    fn attributes(&self, cursor: &Self::Cursor) -> V::Of<L::Number>;
}

/// A triangle prepared for straight lines, divided by the policy `P`, in the numbers `N`.
#[derive(Clone, Copy, Debug)]
pub struct LineTriangle<P, N> {
    pub(crate) policy: P,
    pub(crate) numbers: N,
}

impl<P: Subdivision, L: Lanes, V: Varying, N: Lines<L, V>> Interpolate<L, V> for LineTriangle<P, N> {
    type Row = (N::Row, Left<N::Ends>);
    type Cursor = N::Cursor;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, row: &Row<'_, I>) -> Self::Row {
        (self.numbers.row(&self.policy, row), None)
    }

    #[inline(always)]
    fn start<I: EdgeInt>(
        &self,
        row: &Row<'_, I>,
        (known, left): &mut Self::Row,
        column: i32,
        aligned: i32,
    ) -> (N::Cursor, Span) {
        let run = self.policy.run(&KnownRow { numbers: &self.numbers, row, known, left }, column);
        *left = Some(run.ends);
        let columns = Span { start: run.columns[0], end: run.next };
        (self.numbers.line(known, &run, column, aligned), columns)
    }

    #[inline(always)]
    fn advance(&self, cursor: N::Cursor) -> N::Cursor {
        self.numbers.advance(cursor)
    }

    #[inline(always)]
    fn depth(&self, cursor: &N::Cursor, _: &[L::Number; 3]) -> L::Depth {
        self.numbers.depth(cursor)
    }

    #[inline(always)]
    fn attributes(&self, cursor: &N::Cursor, _: &[L::Number; 3]) -> V::Of<L::Number> {
        self.numbers.attributes(cursor)
    }
}

/// The columns of the longest run.
pub(crate) const LONGEST: i32 = 64;

/// Exact at a row's first and last sample and at every column that is a multiple of `N`, a power of two up to 64;
/// linear between two of those.
///
/// # Precision
/// With r >= 1 the ratio of q at two such columns, and Δu the difference of u there: |Δu|·(√r − 1)/(√r + 1) +
/// 6ε·max|ui|. The first term is what the straight line misses, and is reached; the second is rounding.
///
/// # Cost
/// A fragment: a product, a sum, a minimum and a maximum for each component; no division. Every `N` columns: two `f64`
/// divisions, and about eight operations a component.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spans<const N: i32>;

impl<const N: i32> Subdivision for Spans<N> {
    const RUN: i32 = {
        assert!(N.count_ones() == 1 && 0 < N && N <= LONGEST, "Spans<N>: N must be a power of two up to 64");
        N
    };

    #[inline(always)]
    fn perspective(&self) -> bool {
        true
    }

    #[inline(always)]
    fn run<I: EdgeInt, M: Numbers>(&self, row: &KnownRow<'_, I, M>, column: i32) -> Run<M::Ends> {
        row.run(self, column, N)
    }
}

/// Straight lines as long as no component is missed by more than a budget: the runs are the longest of 1, 2, 4 to 64
/// columns, at multiples of their length, for which that is so.
///
/// # Precision
/// The budget, and what is said of rounding at [`Spans`]; never more. The reason: a line misses what is hyperbolic by
/// at most
/// |Δu|·(√r − 1)/(√r + 1) = |Δu|·tanh(ln r/4), and that is not above |Δu|·|Δq|/(max q + 3 min q), which is compared.
///
/// # Cost
/// That of [`Spans`] for each run that is looked at, of which some are too long; and a comparison a component.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    /// The greatest error of a component, in its own units.
    pub budget: f32,
}

impl Bounded {
    /// An error of so many texels in the coordinates of a texture with sides of up to `side` texels.
    #[must_use]
    pub fn texels(texels: f32, side: u16) -> Self {
        Self { budget: texels / f32::from(side.max(1)) }
    }
}

impl Subdivision for Bounded {
    const RUN: i32 = 1;

    #[inline(always)]
    fn perspective(&self) -> bool {
        true
    }

    #[inline(always)]
    fn run<I: EdgeInt, M: Numbers>(&self, row: &KnownRow<'_, I, M>, column: i32) -> Run<M::Ends> {
        // What begins where another run has ended is not part of a longer one that began before: that was too long.
        let mut length = match row.left {
            Some(_) => 1 << column.trailing_zeros().min(LONGEST.trailing_zeros()),
            None => LONGEST,
        };
        loop {
            let run = row.run(self, column, length);
            // A run of one sample has nothing between its ends.
            if length == 1 || row.numbers.within(row.known, &run.ends, run.columns, self.budget) {
                return run;
            }
            length >>= 1;
        }
    }
}

/// Without correction: what the vertices carry is linear on the screen.
///
/// # Precision
/// Right only where the three vertices are equally far; with r their greatest ratio of q, off by up to
/// |Δu|·(√r − 1)/(√r + 1), Δu being the difference between two vertices. Against the linear function itself: 6ε·max|ui|
/// for depth and components. The result never leaves the range of the three values, so a constant stays constant.
///
/// # Cost
/// A fragment: a product, a sum, a minimum and a maximum for each component; no division. Every 64 columns one `f64`
/// division, and about eight operations a component.
#[derive(Clone, Copy, Debug, Default)]
pub struct Affine;

impl Subdivision for Affine {
    const RUN: i32 = LONGEST;

    #[inline(always)]
    fn perspective(&self) -> bool {
        false
    }

    #[inline(always)]
    fn run<I: EdgeInt, M: Numbers>(&self, row: &KnownRow<'_, I, M>, column: i32) -> Run<M::Ends> {
        row.run(self, column, LONGEST)
    }
}
