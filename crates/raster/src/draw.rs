//! From a snapped triangle to pixels.
//!
//! Facing, edges, rows, spans, depth, attributes, colour: read [`draw_triangle`] from top to bottom.

use crate::band::Band;
use crate::color::Store;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::edge::{Edge, EdgeInt};
use crate::fragment::FragmentStage;
use crate::gradient::Differentiation;
use crate::interpolation::{Interpolation, Oriented, Row};
use crate::mask::{NARROW, RowMask};
use crate::paint::{Painter, aligned};
use crate::spans::RowSpans;
use crate::triangle::{Bounds, Corners, Cull, Outcome, Vertex, doubled_area, in_order};
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Subpixel, Varying};
use core::marker::PhantomData;
use core::ops::Range;

/// Draws one triangle into a band, with as many samples at a time as there are `lanes`.
///
/// Every sample (pixel centre) inside the snapped triangle is covered, exactly; one on an edge belongs to the triangle
/// whose top or left edge it is, so triangles that share an edge neither leave a gap nor draw twice. The result does
/// not depend on the order of the three vertices, but for what is [`Flat`](alberti_math::Flat), nor on the lanes.
///
/// # Precision
/// Coverage is exact. Depth and varyings are those of the `interpolation`, depth within 6ε of the plane through the
/// three zs for [`Exact`](crate::Exact), relatively and barring underflow, and within their range for all.
///
/// # Cost
/// A triangle that covers no sample is not prepared. With one lane, rows of a box of up to 8 samples are tested sample
/// by sample, and six integer divisions give the ends of the spans of wider ones; edge functions have 32 bits up to 179
/// pixels (8 subpixel bits) or 2,894 (4 bits) in a square box, and 64 above. With several lanes, boxes of up to 32
/// samples that lie within the band's columns and one run are tested, all lanes at once. The pixels are the same.
pub fn draw_triangle<P, L, S, V, F, C, D, K>(
    interpolation: P,
    lanes: L,
    band: &mut Band<'_, C, D>,
    vertices: [&Vertex<S, V>; 3],
    cull: Cull,
    fragment: &F,
    counters: &mut K,
) -> Outcome
where
    P: Interpolation,
    L: Floating,
    S: Subpixel,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
    K: Counters,
{
    let corners = corners(vertices);
    let area = doubled_area(&corners);
    if cull.drops(area) {
        return Outcome::Culled;
    }
    let bounds = Bounds::of(&corners);
    let [limits, rows] = band.limits();
    let Some([columns, rows]) = bounds.within::<S>([limits.clone(), rows]) else {
        return Outcome::Missed;
    };
    let first = vertices[0].varying;
    let (corners, vertices) = in_order(corners, vertices, area);
    let oriented = Oriented { vertices, corners, doubled_area: area.abs(), first };
    let unprepared = Unprepared { interpolation, lanes, oriented: &oriented, fragment: *fragment };
    let samples = Samples { corners: &corners, columns, rows, limits };
    lanes.vectorize(
        #[inline(always)]
        || {
            let fits_i32 = bounds.fits_i32(S::ONE);
            let one = <P::Lanes<L> as Lanes>::COUNT == 1;
            if !one && fits_i32 && samples.suit_masks::<P::Lanes<L>>(P::RUN) {
                fill_masked(band, &samples, &unprepared, counters)
            } else if one && fits_i32 {
                fill::<i32, _, _, _, _, _, _, _, _>(band, &samples, &unprepared, counters)
            } else {
                // Several lanes hold 64-bit edge functions as well as 32-bit ones.
                fill::<i64, _, _, _, _, _, _, _, _>(band, &samples, &unprepared, counters)
            }
        },
    )
}

/// The columns and the rows in which a triangle may cover samples, the rows within the limits, or why there are none:
/// it faces the wrong way or has no area, or its box holds no sample within `limits`. This is what [`draw_triangle`]
/// finds out first.
///
/// # Errors
/// [`Outcome::Culled`] and [`Outcome::Missed`].
#[inline]
pub fn reach<S: Subpixel, V>(
    vertices: [&Vertex<S, V>; 3],
    cull: Cull,
    limits: [Range<i32>; 2],
) -> Result<[Range<i32>; 2], Outcome> {
    let corners = corners(vertices);
    if cull.drops(doubled_area(&corners)) {
        return Err(Outcome::Culled);
    }
    Bounds::of(&corners).within::<S>(limits).ok_or(Outcome::Missed)
}

/// The snapped positions.
#[inline(always)]
fn corners<S: Subpixel, V>([a, b, c]: [&Vertex<S, V>; 3]) -> Corners {
    [a, b, c].map(|v| [v.x.subpixels(), v.y.subpixels()])
}

/// A triangle with which nothing was done yet that only its fragments need.
struct Unprepared<'a, P, L, S: Subpixel, V, F> {
    interpolation: P,
    lanes: L,
    oriented: &'a Oriented<'a, S, V>,
    fragment: F,
}

impl<P: Interpolation, L: Floating, S: Subpixel, V: Varying, F: FragmentStage<V>>
    Unprepared<'_, P, L, S, V, F>
{
    #[inline(always)]
    fn prepare<D: DepthFormat>(&self) -> Painter<P::Lanes<L>, V, P::Triangle<L, V>, F> {
        let Self { interpolation, lanes, oriented, fragment } = *self;
        let triangle = interpolation.prepare::<L, S, D, V>(lanes, oriented);
        let derivatives = F::Derivatives::prepare(oriented);
        Painter { lanes: P::lanes(lanes), triangle, derivatives, fragment, varying: PhantomData }
    }
}

/// The samples in a triangle's box, and which of them may be drawn to.
struct Samples<'a> {
    corners: &'a Corners,
    columns: Range<i32>,
    rows: Range<i32>,
    /// The columns of the band.
    limits: Range<i32>,
}

impl Samples<'_> {
    /// Whether rows are best filled by testing every sample: the box is narrow, within the band, and in one run.
    #[inline(always)]
    fn suit_masks<L: Lanes>(&self, run: i32) -> bool {
        let Range { start, end } = self.columns;
        let one_run = (start ^ (end - 1)) & !(run - 1) == 0;
        end - aligned::<L>(start) <= NARROW && start >= self.limits.start && end <= self.limits.end && one_run
    }

    /// The edges, each opposite the vertex whose weight it is, with their values at the box's first sample.
    #[inline(always)]
    fn edges<I: EdgeInt, S: Subpixel>(&self) -> [Edge<I>; 3] {
        let first_sample = [self.columns.start * S::ONE + S::HALF, self.rows.start * S::ONE + S::HALF];
        let [a, b, c] = *self.corners;
        [
            Edge::new(b, c, first_sample, S::ONE),
            Edge::new(c, a, first_sample, S::ONE),
            Edge::new(a, b, first_sample, S::ONE),
        ]
    }
}

/// Fills the covered samples of a box, row by row. `I` is wide enough for every edge function in it.
#[inline(always)]
fn fill<I, S, P, L, V, F, C, D, K>(
    band: &mut Band<'_, C, D>,
    samples: &Samples<'_>,
    triangle: &Unprepared<'_, P, L, S, V, F>,
    counters: &mut K,
) -> Outcome
where
    I: EdgeInt,
    S: Subpixel,
    L: Floating,
    V: Varying,
    P: Interpolation,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
    K: Counters,
{
    let Samples { columns, rows, limits, .. } = samples;
    let mut edges = samples.edges::<I, S>();
    let mut spans = RowSpans::new(&edges, columns.end - columns.start, rows.end - rows.start);
    // A triangle that covers no sample is not prepared.
    let mut painter = None;
    for row in rows.clone() {
        let covered = spans.next_row().shifted(columns.start);
        if covered.start.max(limits.start) < covered.end.min(limits.end) {
            if painter.is_none() {
                painter = Some(triangle.prepare::<D>());
            }
            if let Some(painter) = &painter {
                let row = Row { row, covered, origin: columns.start, edges: &edges };
                painter.row(band, &row, limits, counters);
            }
        }
        for edge in &mut edges {
            edge.value = edge.value + edge.step_y;
        }
    }
    if painter.is_some() { Outcome::Drawn } else { Outcome::Missed }
}

/// The same for several lanes and a box that [suits masks](Samples::suit_masks): without spans.
#[inline(always)]
fn fill_masked<S, P, L, V, F, C, D, K>(
    band: &mut Band<'_, C, D>,
    samples: &Samples<'_>,
    triangle: &Unprepared<'_, P, L, S, V, F>,
    counters: &mut K,
) -> Outcome
where
    S: Subpixel,
    L: Floating,
    V: Varying,
    P: Interpolation,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
    K: Counters,
{
    let Samples { columns, rows, .. } = samples;
    let left = aligned::<P::Lanes<L>>(columns.start);
    let first = [columns.start, rows.start];
    let mut mask =
        RowMask::new(P::lanes(triangle.lanes), samples.edges::<i32, S>(), first, left, columns.end);
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
    let painter = triangle.prepare::<D>();
    while row < rows.end {
        if bits != 0 {
            let written = painter.masked(band, row, left, bits, &mask);
            counters.span(bits.count_ones(), written);
        }
        row += 1;
        bits = mask.next_row();
    }
    Outcome::Drawn
}
