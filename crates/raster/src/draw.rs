//! From a snapped triangle to pixels.
//!
//! Facing, edges, rows, spans, depth, attributes, colour: read [`draw_triangle`] from top to bottom.

use crate::band::Band;
use crate::color::Store;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::edge::{Edge, EdgeInt};
use crate::fragment::FragmentStage;
use crate::lanes::{Lanes, Native};
use crate::paint::{Painter, Rest};
use crate::spans::SpanWalker;
use crate::triangle::{Bounds, Corners, Cull, Outcome, Vertex, canonical_order, doubled_area};
use alberti_math::{Subpixel, Varying};
use core::ops::Range;

/// Draws one triangle into a band.
///
/// Every sample (pixel centre) inside the snapped triangle is covered, exactly; one on an edge belongs to the triangle
/// whose top or left edge it is, so triangles that share an edge neither leave a gap nor draw twice. The result does
/// not depend on the order of the three vertices.
///
/// # Precision
/// Coverage is exact. Depth is within 6ε of the plane through the three zs, relatively and barring underflow, and within their range;
/// varyings are those of [`Exact`](crate::Exact).
///
/// # Cost
/// Six integer divisions for the edges and three of `f32` for depth; 32-bit edge functions for triangles up to 179 pixels
/// (8 subpixel bits) or 2,894 (4 bits) in a square box, 64-bit ones above, with the same pixels.
pub fn draw_triangle<S, V, F, C, D, K>(
    band: &mut Band<'_, C, D>,
    vertices: [&Vertex<S, V>; 3],
    cull: Cull,
    fragment: &F,
    counters: &mut K,
) -> Outcome
where
    S: Subpixel,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
    K: Counters,
{
    draw_triangle_by::<Native, S, V, F, C, D, K>(band, vertices, cull, fragment, counters)
}

/// [`draw_triangle`] with so many samples at a time: the same pixels, bit for bit.
pub fn draw_triangle_by<L, S, V, F, C, D, K>(
    band: &mut Band<'_, C, D>,
    vertices: [&Vertex<S, V>; 3],
    cull: Cull,
    fragment: &F,
    counters: &mut K,
) -> Outcome
where
    L: Lanes,
    S: Subpixel,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
    K: Counters,
{
    let corners = vertices.map(|v| [v.x.subpixels(), v.y.subpixels()]);
    let area = doubled_area(&corners);
    if cull.drops(area) {
        return Outcome::Culled;
    }
    let bounds = Bounds::of(&corners);
    let [columns, rows] = band.limits();
    let (columns, rows) = (bounds.samples::<S>(0, columns), bounds.samples::<S>(1, rows));
    if columns.is_empty() || rows.is_empty() {
        return Outcome::Missed;
    }
    let order = canonical_order(&corners, area);
    let vertices = order.map(|k| vertices[k]);
    let corners = order.map(|k| corners[k]);
    let painter = Painter::<L, V, F>::new(vertices, area.abs(), fragment);
    if bounds.fits_i32(S::ONE) {
        fill::<i32, S, _, _, _, _, _, _>(band, &corners, columns, rows, &painter, counters);
    } else {
        fill::<i64, S, _, _, _, _, _, _>(band, &corners, columns, rows, &painter, counters);
    }
    Outcome::Drawn
}

/// Fills the covered samples of a box, row by row. `I` is wide enough for every edge function in it.
#[inline]
fn fill<I, S, L, V, F, C, D, K>(
    band: &mut Band<'_, C, D>,
    &[a, b, c]: &Corners,
    columns: Range<i32>,
    rows: Range<i32>,
    painter: &Painter<'_, L, V, F>,
    counters: &mut K,
) where
    I: EdgeInt,
    S: Subpixel,
    L: Lanes,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
    K: Counters,
{
    let first_sample = [columns.start, rows.start].map(|i| i * S::ONE + S::HALF);
    // Each opposite the vertex whose weight it is.
    let mut edges = [(b, c), (c, a), (a, b)].map(|(from, to)| Edge::<I>::new(from, to, first_sample, S::ONE));
    let mut walker = SpanWalker::new(&edges, columns.end - columns.start, rows.end - rows.start);
    let steps = edges.map(|e| e.step_x);
    for row in rows.start..rows.start + walker.rows() {
        let span = walker.span();
        if span.start < span.end {
            let at_start = edges.map(|e| e.value + e.step_x * I::from(span.start));
            let (color, depth) = band.pixels_from(row, columns.start + span.start);
            let covered = (span.end - span.start).unsigned_abs();
            let mut rest = Rest::<C, D> { color, depth };
            let written = painter.span(&mut rest, covered, at_start, steps);
            counters.span(covered, written);
        }
        for edge in &mut edges {
            edge.value = edge.value + edge.step_y;
        }
        walker.next_row();
    }
}
