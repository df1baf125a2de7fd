//! The runs of straight lines: where each pixel's begins, and how long it is; or how many there are.
//!
//! A policy of derivatives hears of each run, so one whose "derivatives" are the run's first column and its columns
//! tells a stage. The runs are those of the picture, as the vertices carry the same, and as no bit depends on the
//! number of lanes: here it is one.

use super::erased::Attributes;
use super::tapped::{Tap, WHOLE, Word};
use super::{Canvas, Drawing, memory};
use crate::options::Arithmetic;
use alberti::lanes::{Lanes, One};
use alberti::raster::{
    Counters, Differentiate, Differentiation, EdgeInt, FixedPoint, FragmentStage, Fragments, Gradient,
    Oriented, Row, Samples, Span,
};
use alberti::{Lines, Q16, Rgba8, Varying};
use std::cell::Cell;

/// The policy: by column the first column of the run, by row its columns. Both are 0 for small triangles in fixed
/// point, which have one run in all. A sample that is divided on its own is a run.
#[derive(Clone, Copy, Debug, Default)]
struct OfRun;

impl Differentiation for OfRun {
    type With<D: Differentiation> = Self;
}

impl Differentiate for OfRun {
    type Triangle<V: Varying> = ();
    type Run<L: Lanes, V: Varying> = Span;

    fn of_slopes<V: Varying>(slopes: &V::Of<[Q16; 2]>) -> Gradient<V::Of<Q16>> {
        let zeros = V::map(slopes, &|_: [Q16; 2]| Q16::ZERO);
        Gradient { dx: zeros, dy: zeros }
    }

    fn prepare<V: Varying>(self, _: &Oriented<'_, V>) {}

    fn run<L: Lanes, V: Varying, I: EdgeInt>(self, _: L, (): &(), _: &Row<'_, I>, run: Span) -> Span {
        run
    }

    #[expect(clippy::cast_precision_loss, reason = "columns are at most 2^14")]
    fn at<L: Lanes, V: Varying>(
        self,
        lanes: L,
        (): &(),
        run: &Span,
        at: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>> {
        let all = |columns: i32| V::map(at.values, &|_| lanes.splat(columns as f32));
        // Of the policies with runs, only triangles that a budget leaves to exact samples have a reciprocal.
        let alone = Span { start: at.column, end: at.column + 1 };
        let run = if at.reciprocal.is_some() { &alone } else { run };
        Gradient { dx: all(run.start), dy: all(run.end - run.start) }
    }
}

/// Counts of runs.
#[derive(Debug, Default)]
struct Runs {
    all: Cell<u64>,
    /// Those of one sample.
    single: Cell<u64>,
    /// The row and the first column of the last one, and the column that was last.
    last: Cell<Option<([i32; 2], i32)>>,
}

impl Runs {
    /// Hears of the next fragment: of those of a run, each is beside the one before.
    fn hear(&self, [column, row]: [i32; 2], start: u32, length: u32) {
        let this = [row, start.cast_signed()];
        let goes_on = self.last.get().is_some_and(|(run, last)| run == this && last + 1 == column);
        self.last.set(Some((this, column)));
        if length > 0 && !goes_on {
            self.all.update(|count| count + 1);
            self.single.update(|count| count + u64::from(length == 1));
        }
    }
}

/// The stage: it writes the run of each fragment down, or counts them.
#[derive(Clone, Copy)]
enum RunsOnly<'a> {
    WriteDown(&'a Tap),
    Count(&'a Runs),
}

impl FragmentStage<Attributes> for RunsOnly<'_> {
    type Color = Rgba8;
    type Derivatives = OfRun;

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Attributes>) -> (L::U32, L::Mask) {
        let &Fragments { lanes, gradient, mask, place: [first, row], .. } = fragments;
        let Gradient { dx: start, dy: length } =
            gradient.map(|(_, framed)| lanes.store_words(lanes.floor_scaled(framed.uv[0], 0)));
        let found = start.as_ref().iter().zip(length.as_ref()).zip(first..);
        for (k, ((&start, &length), column)) in found.enumerate() {
            if lanes.bits(mask) >> k & 1 == 0 {
                continue;
            }
            match self {
                RunsOnly::WriteDown(tap) => {
                    tap.write([column, row], Word::RunStart, start);
                    tap.write([column, row], Word::RunLength, if length == 0 { WHOLE } else { length });
                }
                RunsOnly::Count(runs) => runs.hear([column, row], start, length),
            }
        }
        (lanes.word(0), mask)
    }
}

/// The rows of triangles on which they cover samples.
#[derive(Clone, Copy, Debug, Default)]
struct Rows(u64);

impl Counters for Rows {
    fn span(&mut self, covered: u32, _: u32) {
        self.0 += u64::from(covered > 0);
    }

    fn add(&mut self, Self(others): Self) {
        self.0 += others;
    }
}

/// Counts of a drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counted {
    /// The pairs of a triangle on the screen and a row of which it covers a sample.
    pub(crate) rows: u64,
    /// The runs that these fall into, of which some sample was not hidden.
    pub(crate) runs: u64,
    /// Those of one sample.
    pub(crate) single: u64,
}

impl Drawing<'_> {
    /// Draws the whole model into a cleared target, and writes down the runs that its pixels are in, under policies
    /// that have some.
    pub(crate) fn tap_runs(&self, tap: &Tap, target: &mut Canvas<'_>) {
        if let Some(lines) = self.lines() {
            self.by_runs(lines, RunsOnly::WriteDown(tap), target);
        }
    }

    /// Draws the whole model into a cleared target, and counts rows and runs; under policies without runs, rows alone.
    pub(crate) fn count_runs(&self, target: &mut Canvas<'_>) -> Counted {
        let runs = Runs::default();
        let lines = self.lines();
        let rows = self.by_runs(lines.unwrap_or(Lines::affine()), RunsOnly::Count(&runs), target);
        let (all, single) = (runs.all.get(), runs.single.get());
        if lines.is_some() {
            Counted { rows, runs: all, single }
        } else {
            Counted { rows, runs: 0, single: 0 }
        }
    }

    /// Draws with one lane, and counts rows.
    fn by_runs(&self, lines: Lines, stage: RunsOnly<'_>, target: &mut Canvas<'_>) -> u64 {
        let mut rows = Rows::default();
        self.each_chunk(false, |_, mesh| {
            let (_, mut slots) = memory(mesh);
            let pass = self.pass(mesh, stage, &mut slots);
            match self.options.policies.arithmetic {
                Arithmetic::Float => pass.interpolation(lines).count_by(One, target, &mut rows),
                Arithmetic::Fixed => pass.interpolation(FixedPoint(lines)).count_by(One, target, &mut rows),
            }
        });
        rows.0
    }
}
