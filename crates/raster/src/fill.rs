//! From a triangle's edges to its rows, spans and fragments.

use crate::color::ColorFormat;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::differentiation::{Differentiate, Quotients};
use crate::edge::{Edge, EdgeInt};
use crate::fragment::FragmentStage;
use crate::interpolation::{Interpolate, Interpolation, Oriented, QuotientsOf, Row};
use crate::mask::RowMask;
use crate::paint::{Painter, aligned};
use crate::sample_box::SampleBox;
use crate::spans::RowSpans;
use crate::target::Target;
use crate::triangle::Outcome;
use crate::weights::Weights;
use alberti_math::Varying;
use alberti_math::lanes::{Floating, Lanes};
use core::marker::PhantomData;
use core::ops::Range;

/// A triangle before the preparation that only its fragments need.
pub(crate) struct Setup<'a, P, L, V: Varying, F> {
    pub(crate) interpolation: P,
    pub(crate) lanes: L,
    pub(crate) oriented: &'a Oriented<'a, V>,
    pub(crate) stage: F,
}

impl<P: Interpolation, L: Floating, V: Varying, F: FragmentStage<V>> Setup<'_, P, L, V, F> {
    #[inline(always)]
    pub(crate) fn prepare(&self) -> Painter<P::Lanes<L>, V, P::Triangle<L, V>, F> {
        let Self { interpolation, lanes, oriented, stage } = *self;
        let (policy, numbers) = (stage.derivatives(), interpolation.lanes(lanes));
        const {
            assert!(
                !F::SETTLES || <F::Derivatives as Differentiate>::EVERYWHERE,
                "see FragmentStage::SETTLES"
            );
        };
        let area = QuotientsOf::<P, L, V>::area(oriented.doubled_area);
        // Compilers keep the planes where the painter is to be if they come last, and in registers if they come first.
        if const { F::SETTLES } {
            let derivatives = policy.prepare::<_, V, QuotientsOf<P, L, V>>(numbers, oriented, area);
            let gradient = policy.everywhere::<_, V, QuotientsOf<P, L, V>>(&derivatives);
            let stage = gradient.map_or(stage, |gradient| stage.settled(numbers, &gradient));
            let triangle = interpolation.prepare(lanes, oriented, area);
            Painter { lanes: numbers, triangle, derivatives, stage, varying: PhantomData }
        } else {
            let triangle = interpolation.prepare(lanes, oriented, area);
            let derivatives = policy.prepare::<_, V, QuotientsOf<P, L, V>>(numbers, oriented, area);
            Painter { lanes: numbers, triangle, derivatives, stage, varying: PhantomData }
        }
    }
}

/// Fills the covered samples of a box, row by row. `I` is wide enough for every edge function in it.
#[inline(always)]
pub(crate) fn fill<I, P, L, V, F, C, D, K>(
    target: &mut Target<'_, C, D>,
    samples: &SampleBox<'_>,
    setup: &Setup<'_, P, L, V, F>,
    counters: &mut K,
) -> Outcome
where
    I: EdgeInt,
    L: Floating,
    V: Varying,
    P: Interpolation,
    F: FragmentStage<V>,
    C: ColorFormat,
    D: DepthFormat,
    K: Counters,
{
    let SampleBox { columns, rows, limits, .. } = samples;
    let mut edges = samples.edges::<I>();
    let mut spans =
        RowSpans::new(&edges, columns.end - columns.start, [samples.above(), rows.end - rows.start]);
    let weights = Weights::new(setup.interpolation.lanes(setup.lanes), &edges, setup.oriented.doubled_area);
    // A triangle that covers no sample is not prepared.
    let (mut painter, mut stage) = (None, None);
    for row in rows.clone() {
        let covered = spans.next_row().shifted(columns.start);
        if covered.start.max(limits.start) < covered.end.min(limits.end) {
            let painter = painter.get_or_insert_with(
                #[inline(always)]
                || setup.prepare(),
            );
            if const { F::BY_ROWS } {
                let stage = *stage.get_or_insert(painter.stage);
                painter.stage = stage.in_row(row);
            }
            let row = Row { row, covered, origin: columns.start, edges: &edges };
            painter.row(target, &row, limits, &weights, counters);
        }
        for edge in &mut edges {
            edge.value = edge.value + edge.step_y;
        }
    }
    if painter.is_some() { Outcome::Drawn } else { Outcome::Missed }
}

/// The same for several lanes and a box that is [filled by masks](Way::Masks): without spans.
#[inline(always)]
pub(crate) fn fill_masked<L, V, T, F, C, D, K>(
    lanes: L,
    target: &mut Target<'_, C, D>,
    [columns, rows]: [Range<i32>; 2],
    edges: [Edge<i32>; 3],
    prepare: impl FnOnce() -> Painter<L, V, T, F>,
    counters: &mut K,
) -> Outcome
where
    L: Lanes,
    V: Varying,
    T: Interpolate<L, V>,
    F: FragmentStage<V>,
    C: ColorFormat,
    D: DepthFormat,
    K: Counters,
{
    let left = aligned::<L>(columns.start);
    let mut mask = RowMask::new(lanes, edges, columns, rows.start);
    let mut row = rows.start;
    let mut bits = mask.bits();
    // A triangle that covers no sample is not prepared.
    while bits == 0 {
        row += 1;
        if row >= rows.end {
            return Outcome::Missed;
        }
        bits = mask.next_row();
    }
    let mut painter = prepare();
    let stage = painter.stage;
    if const { Painter::<L, V, T, F>::EVERYWHERE } {
        bits = mask.inside();
    }
    let formats = (target.color_format(), target.depth_format());
    let mut pixels = target.rows_from(row, left);
    while row < rows.end {
        if bits != 0 {
            if const { F::BY_ROWS } {
                painter.stage = stage.in_row(row);
            }
            painter.masked(formats, pixels.row(), [left, row], bits, &mask, counters);
        }
        row += 1;
        pixels.down();
        if const { Painter::<L, V, T, F>::EVERYWHERE } {
            mask.down();
            bits = mask.inside();
        } else {
            bits = mask.next_row();
        }
    }
    Outcome::Drawn
}
