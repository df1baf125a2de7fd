//! The runs of straight lines: where each pixel's begins, and how long it is; or how many there are.
//!
//! A policy of derivatives hears of each run, so one whose "derivatives" are the run's first column and its columns
//! tells a stage. The runs are those of the picture, as the vertices carry the same, and as no bit depends on the
//! number of lanes: here it is one.

use super::clothed::Triangles;
use super::erased::Attributes;
use super::tapped::{Tap, WHOLE, Word};
use super::{Canvas, Drawing, memory};
use crate::options::Arithmetic;
use alberti::lanes::{Lanes, One};
use alberti::raster::{
    Counters, Differentiate, Differentiation, EdgeInt, FixedPoint, FragmentStage, Fragments, Gradient,
    Oriented, Outcome, Quotients, Row, Samples, Span,
};
use alberti::{Lines, Q16, Rgba8, Varying};
use std::cell::Cell;

/// The policy: by column the first column of the run, by row its columns, and [`WIDE`] more where edges take 64 bits.
/// Both are 0 for small triangles in fixed point, which have one run in all. A sample that is divided on its own is a
/// run.
#[derive(Clone, Copy, Debug, Default)]
struct OfRun;

/// More than there are columns in a run, and as much as fixed point has room for beside them.
const WIDE: u16 = 1 << 14;

impl Differentiation for OfRun {
    type With<D: Differentiation> = Self;
}

impl Differentiate for OfRun {
    type Triangle<L: Lanes, V: Varying, Q: Quotients<L, V>> = ();
    type Run<L: Lanes, V: Varying, Q: Quotients<L, V>> = (Span, u16);

    fn of_slopes<V: Varying>(slopes: &V::Of<[Q16; 2]>) -> Gradient<V::Of<Q16>> {
        let zeros = V::map(slopes, &|_: [Q16; 2]| Q16::ZERO);
        Gradient { dx: zeros, dy: zeros }
    }

    fn prepare<L: Lanes, V: Varying, Q: Quotients<L, V>>(self, _: L, _: &Oriented<'_, V>, _: Q::Area) {}

    fn run<L: Lanes, V: Varying, Q: Quotients<L, V>, I: EdgeInt>(
        self,
        _: L,
        (): &(),
        _: &Row<'_, I>,
        run: Span,
    ) -> (Span, u16) {
        (run, if size_of::<I>() > 4 { WIDE } else { 0 })
    }

    #[expect(clippy::cast_precision_loss, reason = "columns are at most 2^14")]
    fn at<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        lanes: L,
        (): &(),
        (run, wide): &(Span, u16),
        at: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>> {
        let all = |columns: i32| V::map(at.values, &|_| lanes.splat(columns as f32));
        // Of the policies with runs, only triangles that a budget leaves to exact samples have a reciprocal.
        let alone = Span { start: at.column, end: at.column + 1 };
        let run = if at.reciprocal.is_some() { &alone } else { run };
        Gradient { dx: all(run.start), dy: all(run.end - run.start + i32::from(*wide)) }
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
    /// The kind of triangle that the last fragment was of.
    kind: Cell<Kind>,
}

impl Runs {
    /// Hears of the next fragment: of those of a run, each is beside the one before.
    fn hear(&self, [column, row]: [i32; 2], start: u32, length: u32, kind: Kind) {
        self.kind.set(kind);
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
        let &Fragments { lanes, gradient, mask, place, .. } = fragments;
        self.take(lanes, gradient.map(|(_, framed)| framed.uv[0]), mask, place)
    }
}

impl RunsOnly<'_> {
    /// Takes the runs of some fragments.
    fn take<L: Lanes>(
        &self,
        lanes: L,
        run: Gradient<L::Number>,
        mask: L::Mask,
        [first, row]: [i32; 2],
    ) -> (L::U32, L::Mask) {
        let Gradient { dx: start, dy: length } =
            run.map(|number| lanes.store_words(lanes.floor_scaled(number, 0)));
        let found = start.as_ref().iter().zip(length.as_ref()).zip(first..);
        for (k, ((&start, &length), column)) in found.enumerate() {
            if lanes.bits(mask) >> k & 1 == 0 {
                continue;
            }
            let is_wide = length & u32::from(WIDE) > 0;
            let length = length & !u32::from(WIDE);
            match self {
                RunsOnly::WriteDown(tap) => {
                    tap.write([column, row], Word::RunStart, start);
                    tap.write([column, row], Word::RunLength, if length == 0 { WHOLE } else { length });
                }
                RunsOnly::Count(runs) => {
                    let kind = match length {
                        0 => Kind::Small,
                        _ if is_wide => Kind::Wide,
                        _ => Kind::Narrow,
                    };
                    runs.hear([column, row], start, length, kind);
                }
            }
        }
        (lanes.word(0), mask)
    }
}

/// The ways in which a triangle is rasterized.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Kind {
    /// Of some pixels, in fixed point, by planes of its own.
    #[default]
    Small,
    /// Row by row, with edge functions of 32 bits.
    Narrow,
    /// With edge functions of 64 bits.
    Wide,
}

/// The triangles of one kind that cover samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct OfKind {
    pub(crate) triangles: u64,
    /// The pairs of a triangle on the screen and a row of which it covers a sample.
    pub(crate) rows: u64,
    /// The covered samples.
    pub(crate) samples: u64,
}

/// Counts of the rasterizer, by kinds. The stage has told the kind of a row when it comes.
struct Rows<'a> {
    kind: &'a Cell<Kind>,
    kinds: [OfKind; 3],
    /// Whether the next row is a triangle's first.
    first: bool,
}

impl<'a> Rows<'a> {
    fn new(runs: &'a Runs) -> Self {
        Self { kind: &runs.kind, kinds: Default::default(), first: true }
    }
}

impl Counters for Rows<'_> {
    fn rasterized(&mut self, _: Outcome) {
        self.first = true;
    }

    fn span(&mut self, covered: u32, _: u32) {
        if covered > 0 {
            let kind = &mut self.kinds[self.kind.get() as usize];
            kind.triangles += u64::from(std::mem::take(&mut self.first));
            kind.rows += 1;
            kind.samples += u64::from(covered);
        }
    }

    fn add(&mut self, others: Self) {
        for (kind, OfKind { triangles, rows, samples }) in self.kinds.iter_mut().zip(others.kinds) {
            kind.triangles += triangles;
            kind.rows += rows;
            kind.samples += samples;
        }
    }
}

/// Counts of a drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counted {
    /// Triangles in all, small, narrow, wide.
    pub(crate) kinds: [OfKind; 3],
    /// The runs that their rows fall into, of which some sample was not hidden.
    pub(crate) runs: u64,
    /// Those of one sample.
    pub(crate) single: u64,
}

impl Drawing<'_> {
    /// Draws the whole model into a cleared target, and writes down the runs that its pixels are in, under policies
    /// that have some.
    pub(crate) fn tap_runs(&self, tap: &Tap, target: &mut Canvas<'_>) {
        if let Some(lines) = self.lines() {
            self.each_chunk(false, |_, mesh| {
                // The rows are not asked for: counters of another type would be kernels of their own.
                let runs = Runs::default();
                self.by_runs(mesh, lines, RunsOnly::WriteDown(tap), target, &mut Rows::new(&runs));
            });
        }
    }

    /// Draws the whole model into a cleared target, and counts rows and runs; under policies without runs, rows alone.
    pub(crate) fn count_runs(&self, target: &mut Canvas<'_>) -> Counted {
        let runs = Runs::default();
        let lines = self.lines();
        let mut rows = Rows::new(&runs);
        let stage = RunsOnly::Count(&runs);
        self.each_chunk(false, |_, mesh| {
            // Other attributes than texture coordinates would have a say in which triangles are small.
            let bare = Triangles { bare: true, ..*mesh };
            self.by_runs(&bare, lines.unwrap_or(Lines::affine()), stage, target, &mut rows);
        });
        let (all, single) = (runs.all.get(), runs.single.get());
        if lines.is_some() {
            Counted { kinds: rows.kinds, runs: all, single }
        } else {
            Counted { kinds: rows.kinds, runs: 0, single: 0 }
        }
    }

    /// Draws some triangles with one lane.
    fn by_runs(
        &self,
        mesh: &Triangles<'_, '_>,
        lines: Lines,
        stage: RunsOnly<'_>,
        target: &mut Canvas<'_>,
        counters: &mut Rows<'_>,
    ) {
        let (_, mut slots) = memory(mesh);
        let pass = self.pass(mesh, stage, &mut slots);
        match self.options.policies.arithmetic {
            Arithmetic::Float => pass.interpolation(lines).count_by(One, target, counters),
            Arithmetic::Fixed => pass.interpolation(FixedPoint(lines)).count_by(One, target, counters),
        }
    }
}
