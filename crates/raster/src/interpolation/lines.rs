//! Interpolation by straight lines along runs of a row's samples. The policies say how long a run is and whether its
//! ends are corrected for perspective; the numbers are `f32` or fixed point.
//!
//! ```text
//!   u |        .*          * right, at the ends of runs: u = Σ Ei qi ui / Σ Ei qi
//!     |    .'  |           . the line between
//!     |  *'    |
//!     +--+-----+-------> column
//!      first  last
//! ```

#[cfg(any(feature = "serde", feature = "arbitrary"))]
mod form;

use crate::differentiation::Quotients;
use crate::edge::EdgeInt;
use crate::interpolation::{Interpolate, Row};
use crate::spans::Span;
use alberti_math::Varying;
use alberti_math::lanes::Lanes;
use core::fmt::Debug;

/// A division of rows into runs of samples: [`Spans16`], [`Affine`], or [`Lines`] for any other.
///
/// Runs lie at multiples of their length, and end with the row.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a policy of straight lines",
    label = "`FixedPoint` takes `Spans16`, `Affine` or `Lines`"
)]
pub trait Runs: Copy + Debug + Send + Sync + 'static {
    /// The columns of the longest run, a power of two up to [`Lines::LONGEST`].
    fn length(self) -> i32;

    /// The greatest miss of a component along a run, where runs are to be as long as that allows.
    fn budget(self) -> Option<f32>;

    /// The course of hyperbolic components over a triangle.
    fn course(self) -> Course;

    /// Whether hyperbolic components are so at the ends of runs, or linear on the screen like the rest.
    #[inline(always)]
    fn perspective(self) -> bool {
        self.course() == Course::Perspective
    }

    /// The numbers that these are, if they are.
    #[inline(always)]
    fn lines(self) -> Option<Lines> {
        None
    }

    /// The same with the runs of one triangle, which `choose` finds, where there is a budget.
    #[inline(always)]
    fn of_triangle(self, choose: impl FnOnce(f32) -> Option<Lines>) -> Self {
        let _ = choose;
        self
    }
}

/// Straight lines along 16 columns: exact at a row's first and last sample and at every 16th column; linear between two
/// of those.
///
/// # Precision
/// With r >= 1 the ratio of q at two such columns, Δu the difference of u there, and ε = 2^-24:
/// |Δu|·(√r − 1)/(√r + 1) + 15ε·max|ui|. The first term is the miss of the straight line, and is reached; the second is
/// rounding. Components that are linear on the screen are within 12ε of their greatest value, and so is depth. The
/// result never leaves the range of the three values. For |ui| above 2^120 that is all that holds.
///
/// The reason: both ends are within 9ε, as in [`Exact`](crate::Exact). Lines start in the middle, from which a
/// component changes by at most max|ui|. So each of six roundings adds ε: of the middle, of the difference, of one
/// over the columns, of two products and of the last sum.
///
/// # Cost
/// A fragment: a product, a sum, a minimum and a maximum for each component; no division. Every 16 columns: two
/// divisions, and about ten operations a component. All of it is `f32`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spans16;

/// Straight lines without correction: varyings are linear on the screen.
///
/// # Precision
/// Right only where the three vertices are equally far; with r their greatest ratio of q, off by up to
/// |Δu|·(√r − 1)/(√r + 1), Δu being the difference between two vertices. Against the linear function itself: 12ε·max|ui|
/// for depth and components, with ε = 2^-24. The result never leaves the range of the three values, so a constant stays
/// constant.
///
/// The reason: runs start in their middle, from which no edge function changes by more than it is there. Three
/// roundings are those of a value over the area. In the middle there are four: of an edge function, a product and two
/// sums. The step has three, a product and two sums. The product with the columns and the last sum are the others.
///
/// # Cost
/// A fragment: a product, a sum, a minimum and a maximum for each component; no division. Every 64 columns five
/// operations a component; a triangle one division, and eight a component. All of it is `f32`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Affine;

/// Straight lines whose length is a number: [`spans`](Self::spans), [`bounded`](Self::bounded) or
/// [`affine`](Self::affine).
///
/// # Cost
/// That of [`Spans16`], and a few comparisons a run. A component has a product and a sum more a fragment, for
/// parabolas. With a budget, that of the way that a triangle goes, see [`bounded`](Self::bounded).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "form::Form", into = "form::Form"))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Lines {
    length: i32,
    budget: Option<f32>,
    course: Course,
}

/// The course of hyperbolic components over a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Course {
    /// Linear on the screen.
    Screen,
    /// The same, and along each row a parabola: what perspective adds if q is the mean of its least and greatest.
    Parabola,
    /// Hyperbolic at the ends of runs, and straight between.
    Perspective,
}

impl Lines {
    /// The columns of the longest run.
    pub const LONGEST: i32 = 64;

    /// [`Affine`].
    #[must_use]
    pub const fn affine() -> Self {
        Self { length: Self::LONGEST, budget: None, course: Course::Screen }
    }

    /// [`Spans16`] with `length` columns instead of 16; `None` unless that is a power of two up to 64.
    #[must_use]
    pub const fn spans(length: i32) -> Option<Self> {
        if 0 < length && length <= Self::LONGEST && length.count_ones() == 1 {
            Some(Self { length, budget: None, course: Course::Perspective })
        } else {
            None
        }
    }

    /// The cheapest ways that miss no component by more than a `budget`, in the component's own units. Each triangle is
    /// drawn in the first of these that keeps it, which is decided once, from its three corners.
    ///
    /// 1. A plane and a parabola, along whole rows.
    /// 2. Straight lines along 64 columns, whose ends are hyperbolic.
    /// 3. [`Planes`](crate::Planes), whose rounding is to keep the budget.
    /// 4. [`Exact`](crate::Exact).
    ///
    /// The first and the third are for boxes of more than 32 columns, the first where q differs by up to an eighth. The
    /// second is for boxes of 64.
    ///
    /// In [`FixedPoint`](crate::FixedPoint) there are two ways: straight lines without correction, and runs with it.
    /// These are the longest of 1, 2, 4 to 64 columns, at multiples of their length, that keep the budget.
    ///
    /// # Precision
    /// The budget, and for rounding 19ε·max|ui| with ε = 2^-24; never more. With D the greatest difference of two ui
    /// and r the ratio of q, the first way misses by at most D/5·((r − 1)/(r + 1))². Its rounding is the greatest, 19ε.
    /// The second is that of [`Spans16`], with a bound for all of the triangle's runs; the third misses by its rounding
    /// alone, (15 r + 5)ε·max|ui|.
    ///
    /// In fixed point a line misses a hyperbolic component by at most |Δu|·(√r − 1)/(√r + 1) = |Δu|·tanh(ln r/4). That
    /// is not above |Δu|·|Δq|/(max q + 3 min q), which is compared.
    ///
    /// # Cost
    /// A fragment: without perspective two products and two sums a component, a minimum and a maximum, and no division;
    /// otherwise that of the others. A triangle in a box of more than 32 columns: up to some 200 operations for its
    /// way. Derivatives [by runs](crate::PerRun) are those of whole rows, but in the second and the third way.
    #[must_use]
    pub const fn bounded(budget: f32) -> Self {
        Self { length: Self::LONGEST, budget: Some(budget), course: Course::Perspective }
    }

    /// Planes and parabolas, along whole rows.
    pub(super) const PARABOLA: Self = Self { length: 1 << 30, course: Course::Parabola, ..Self::affine() };

    /// The longest runs, with perspective at their ends.
    pub(super) const LONG: Self = Self { course: Course::Perspective, ..Self::affine() };

    /// The budget, if there is one.
    #[inline(always)]
    pub(super) const fn kept(self) -> Option<f32> {
        self.budget
    }

    /// [`Affine`] by runs of `length` columns, a power of two.
    #[inline(always)]
    pub(super) const fn on_screen(length: i32) -> Self {
        Self { length, ..Self::affine() }
    }

    /// The same with a budget of so many texels, in the coordinates of a texture with sides of up to `side` texels.
    #[must_use]
    pub fn bounded_texels(texels: f32, side: u16) -> Self {
        Self::bounded(texels / f32::from(side.max(1)))
    }
}

impl Runs for Spans16 {
    #[inline(always)]
    fn length(self) -> i32 {
        16
    }

    #[inline(always)]
    fn budget(self) -> Option<f32> {
        None
    }

    #[inline(always)]
    fn course(self) -> Course {
        Course::Perspective
    }
}

impl Runs for Affine {
    #[inline(always)]
    fn length(self) -> i32 {
        Lines::LONGEST
    }

    #[inline(always)]
    fn budget(self) -> Option<f32> {
        None
    }

    #[inline(always)]
    fn course(self) -> Course {
        Course::Screen
    }
}

impl Runs for Lines {
    #[inline(always)]
    fn length(self) -> i32 {
        self.length
    }

    #[inline(always)]
    fn budget(self) -> Option<f32> {
        self.budget
    }

    #[inline(always)]
    fn course(self) -> Course {
        self.course
    }

    #[inline(always)]
    fn lines(self) -> Option<Lines> {
        Some(self)
    }

    #[inline(always)]
    fn of_triangle(self, choose: impl FnOnce(f32) -> Option<Lines>) -> Self {
        self.budget.and_then(choose).unwrap_or(self)
    }
}

/// A run of a row's samples.
#[derive(Clone, Copy, Debug)]
pub struct Run<E> {
    /// The columns of its first sample and of the next run's first, or the row's last.
    pub(crate) columns: [i32; 2],
    /// The values there.
    pub(crate) ends: E,
    /// The column that follows it.
    pub(crate) next: i32,
    /// The columns between the ends of a run that is whole, a power of two.
    pub(crate) length: i32,
}

/// A triangle's linear and hyperbolic components in some kind of numbers, and the straight lines between their values.
///
/// `perspective` and `course` are those of the policy, constants where they are known when compiling.
pub trait LineNumbers<L: Lanes, V: Varying> {
    /// The values at a row's first sample.
    type Row: Copy;
    /// The values at both ends of a run.
    type Ends: Copy;
    /// The values at a group of samples.
    type Cursor: Copy;
    /// The quotients that the components are.
    type Quotients: Quotients<L, V>;

    /// Begins a row.
    fn row<I: EdgeInt>(&self, perspective: bool, row: &Row<'_, I>) -> Self::Row;

    /// The run of one sample, a covered column of a row.
    fn begin<I: EdgeInt>(
        &self,
        perspective: bool,
        row: &Row<'_, I>,
        known: &Self::Row,
        column: i32,
    ) -> Self::Ends;

    /// The run from the end of another to another covered column of the same row.
    fn extend<I: EdgeInt>(
        &self,
        perspective: bool,
        row: &Row<'_, I>,
        known: &Self::Row,
        ends: &Self::Ends,
        column: i32,
    ) -> Self::Ends;

    /// Whether runs are found one by one where there is a budget.
    const SEARCHES: bool = false;

    /// Whether the budget leaves anything to a straight line along so many columns.
    #[inline(always)]
    fn has_room(&self, columns: i32) -> bool {
        let _ = columns;
        true
    }

    /// Whether a straight line between the ends, which are at these columns, misses no component by more than the
    /// budget.
    #[inline(always)]
    fn within(&self, known: &Self::Row, ends: &Self::Ends, columns: [i32; 2]) -> bool {
        let _ = (known, ends, columns);
        true
    }

    /// The line along a run of a row. Of the two columns the first is the first to be drawn, and the second that of the
    /// first of the samples.
    fn line<I: EdgeInt>(
        &self,
        course: Course,
        row: &Row<'_, I>,
        known: &Self::Row,
        run: &Run<Self::Ends>,
        columns: [i32; 2],
    ) -> Self::Cursor;

    /// The samples after those.
    fn advance(&self, cursor: Self::Cursor) -> Self::Cursor;

    /// The screen depth at each.
    fn depth(&self, cursor: &Self::Cursor) -> L::Depth;

    /// The attributes at each.
    fn attributes(&self, cursor: &Self::Cursor) -> V::Of<L::Number>;
}

/// A triangle prepared for straight lines, in the numbers `N`, along the runs of the policy `R`.
#[derive(Clone, Copy, Debug)]
pub struct LineTriangle<R, N> {
    pub(crate) runs: R,
    pub(crate) numbers: N,
}

impl<R: Runs, N> LineTriangle<R, N> {
    /// The run of up to `length` columns, a power of two, that a covered column is in: its first column, its last, and
    /// the one after it.
    #[inline(always)]
    fn columns<I: EdgeInt>(row: &Row<'_, I>, [column, length]: [i32; 2]) -> [i32; 3] {
        let after = (column | (length - 1)) + 1;
        let first = row.covered.start.max(column & !(length - 1));
        [first, after.min(row.covered.end - 1), after.min(row.covered.end)]
    }

    /// The run of `length` columns, a power of two, that a covered column is in. `left` are the ends of the run before,
    /// if it was drawn: its last column is this one's first.
    #[inline(always)]
    fn run<I: EdgeInt, L: Lanes, V: Varying>(
        &self,
        perspective: bool,
        row: &Row<'_, I>,
        known: &N::Row,
        left: Option<N::Ends>,
        [column, length]: [i32; 2],
    ) -> Run<N::Ends>
    where
        N: LineNumbers<L, V>,
    {
        let numbers = &self.numbers;
        let [first, last, next] = Self::columns(row, [column, length]);
        let ends = match left {
            Some(ends) if first == column => numbers.extend(perspective, row, known, &ends, last),
            _ => {
                let ends = numbers.begin(perspective, row, known, first);
                if last == first { ends } else { numbers.extend(perspective, row, known, &ends, last) }
            }
        };
        Run { columns: [first, last], ends, next, length }
    }

    /// The longest run that a covered column is in and that keeps the budget, of those that do not begin before the
    /// last one's end.
    #[inline(always)]
    fn search<I: EdgeInt, L: Lanes, V: Varying>(
        &self,
        row: &Row<'_, I>,
        known: &N::Row,
        left: Option<N::Ends>,
        column: i32,
    ) -> Run<N::Ends>
    where
        N: LineNumbers<L, V>,
    {
        let mut length = self.runs.length();
        // A run that begins where another has ended is not part of a longer one that began before: that was too long.
        if left.is_some() {
            length = length.min(1 << column.trailing_zeros().min(Lines::LONGEST.trailing_zeros()));
        }
        loop {
            // Ends are not looked for where nothing is left for a line between them.
            let [first, last, _] = Self::columns(row, [column, length]);
            if length == 1 || self.numbers.has_room(last - first) {
                let run = self.run(true, row, known, left, [column, length]);
                // A run of one sample has nothing between its ends.
                if length == 1 || self.numbers.within(known, &run.ends, run.columns) {
                    return run;
                }
            }
            length >>= 1;
        }
    }

    /// The run that a covered column is in, with its line.
    #[inline(always)]
    fn begin<I: EdgeInt, L: Lanes, V: Varying>(
        &self,
        course: Course,
        row: &Row<'_, I>,
        (known, left): &mut (N::Row, Option<N::Ends>),
        [column, aligned]: [i32; 2],
    ) -> (N::Cursor, Span)
    where
        N: LineNumbers<L, V>,
    {
        let perspective = course == Course::Perspective;
        let run = if course == Course::Parabola {
            let [first, last] = [row.covered.start, row.covered.end - 1];
            // Without perspective ends are nothing.
            let ends = self.numbers.begin(false, row, known, first);
            Run { columns: [first, last], ends, next: row.covered.end, length: 0 }
        } else if const { N::SEARCHES } && perspective && self.runs.budget().is_some() {
            self.search(row, known, *left, column)
        } else {
            self.run(perspective, row, known, *left, [column, self.runs.length()])
        };
        *left = Some(run.ends);
        let columns = Span { start: run.columns[0], end: run.next };
        (self.numbers.line(course, row, known, &run, [column, aligned]), columns)
    }
}

impl<R: Runs, L: Lanes, V: Varying, N: LineNumbers<L, V>> Interpolate<L, V> for LineTriangle<R, N> {
    type Row = (N::Row, Option<N::Ends>);
    type Cursor = N::Cursor;
    type Quotients = N::Quotients;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, row: &Row<'_, I>) -> Self::Row {
        (self.numbers.row(self.runs.perspective(), row), None)
    }

    #[inline(always)]
    fn start<I: EdgeInt>(
        &self,
        row: &Row<'_, I>,
        known: &mut Self::Row,
        column: i32,
        aligned: i32,
    ) -> (N::Cursor, Span) {
        // Each as a constant, so that lines on the screen wait for nothing that only the others need.
        match self.runs.course() {
            Course::Perspective => self.begin(Course::Perspective, row, known, [column, aligned]),
            course => self.begin(course, row, known, [column, aligned]),
        }
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
