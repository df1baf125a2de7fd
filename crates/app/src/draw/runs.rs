//! The runs of straight lines: where each pixel's begins, and how long it is.
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
    Differentiate, Differentiation, EdgeInt, FixedPoint, FragmentStage, Fragments, Gradient, Oriented, Row,
    Samples, Span,
};
use alberti::{Q16, Rgba8, Varying};

/// The policy: by column the first column of the run, by row its columns. Both are 0 for small triangles in fixed
/// point, which have one run in all.
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
        Gradient { dx: all(run.start), dy: all(run.end - run.start) }
    }
}

/// The stage: it writes the run of each fragment down.
#[derive(Clone, Copy)]
struct RunsOnly<'a>(&'a Tap);

impl FragmentStage<Attributes> for RunsOnly<'_> {
    type Color = Rgba8;
    type Derivatives = OfRun;

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Attributes>) -> (L::U32, L::Mask) {
        let &Fragments { lanes, gradient, mask, place: [first, row], .. } = fragments;
        let Gradient { dx: start, dy: length } =
            gradient.map(|(_, framed)| lanes.store_words(lanes.floor_scaled(framed.uv[0], 0)));
        let found = start.as_ref().iter().zip(length.as_ref()).zip(first..);
        for (k, ((&start, &length), column)) in found.enumerate() {
            if lanes.bits(mask) >> k & 1 != 0 {
                self.0.write([column, row], Word::RunStart, start);
                self.0.write([column, row], Word::RunLength, if length == 0 { WHOLE } else { length });
            }
        }
        (lanes.word(0), mask)
    }
}

impl Drawing<'_> {
    /// Draws the whole model into a cleared target, and writes down the runs that its pixels are in, under policies
    /// that have some.
    pub(crate) fn tap_runs(&self, tap: &Tap, target: &mut Canvas<'_>) {
        let Some(lines) = self.lines() else { return };
        self.each_chunk(false, |_, mesh| {
            let (_, mut slots) = memory(mesh);
            let pass = self.pass(mesh, RunsOnly(tap), &mut slots);
            match self.options.policies.arithmetic {
                Arithmetic::Float => pass.interpolation(lines).draw_by(One, target),
                Arithmetic::Fixed => pass.interpolation(FixedPoint(lines)).draw_by(One, target),
            }
        });
    }
}
