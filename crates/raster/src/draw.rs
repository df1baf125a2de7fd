//! From a snapped triangle to pixels.
//!
//! Facing, edges, rows, spans, depth, attributes, colour: read [`draw_triangle`] from top to bottom.

use crate::band::Band;
use crate::color::Store;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::edge::{Edge, EdgeInt};
use crate::exact::Exact;
use crate::fragment::FragmentStage;
use crate::spans::SpanWalker;
use crate::triangle::{Bounds, Corners, Cull, Outcome, Vertex, canonical_order, doubled_area};
use alberti_math::{Subpixel, Varying, blend3, hull3};
use core::ops::Range;

/// Draws one triangle into a band.
///
/// Every sample (pixel centre) inside the snapped triangle is covered, exactly; one on an edge belongs to the triangle
/// whose top or left edge it is, so triangles that share an edge neither leave a gap nor draw twice. The result does
/// not depend on the order of the three vertices.
///
/// # Precision
/// Coverage is exact. Depth is within 6ε of the plane through the three zs, relatively, and within their range;
/// varyings are those of [`Exact`].
///
/// # Cost
/// Without a division up to the fragments but three for depth; 32-bit edge functions for triangles up to 181 pixels
/// (8 subpixel bits) or 2,896 (4 bits) in a square box, 64-bit ones above, with the same pixels.
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
    let surface = Surface::new(vertices, area.abs());
    if bounds.fits_i32(S::ONE) {
        fill::<i32, S, _, _, _, _, _>(band, &corners, columns, rows, &surface, fragment, counters);
    } else {
        fill::<i64, S, _, _, _, _, _>(band, &corners, columns, rows, &surface, fragment, counters);
    }
    Outcome::Drawn
}

/// What is interpolated over a triangle, from the edge functions at a sample.
struct Surface<V> {
    /// zs over the doubled area, so that weights need not be normalised.
    zs: [f32; 3],
    nearest_farthest: [f32; 2],
    attributes: Exact<V>,
}

impl<V: Varying> Surface<V> {
    #[inline]
    fn new<S: Subpixel>(v: [&Vertex<S, V>; 3], doubled_area: i64) -> Self {
        let area = doubled_area.to_f32();
        let zs = v.map(|v| v.zs);
        Self {
            zs: zs.map(|zs| zs / area),
            nearest_farthest: hull3(zs),
            attributes: Exact::new(v.map(|v| v.q), v.map(|v| v.varying)),
        }
    }

    /// The screen depth: linear on the screen, kept within that of the vertices.
    #[inline]
    fn depth(&self, edges: [f32; 3]) -> f32 {
        blend3(edges, 1.0, self.zs, self.nearest_farthest)
    }
}

/// Fills the covered samples of a box, row by row. `I` is wide enough for every edge function in it.
#[inline]
fn fill<I, S, V, F, C, D, K>(
    band: &mut Band<'_, C, D>,
    &[a, b, c]: &Corners,
    columns: Range<i32>,
    rows: Range<i32>,
    surface: &Surface<V>,
    fragment: &F,
    counters: &mut K,
) where
    I: EdgeInt,
    S: Subpixel,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
    K: Counters,
{
    let first_sample = [columns.start, rows.start].map(|i| i * S::ONE + S::HALF);
    // Each opposite the vertex whose weight it is.
    let mut edges = [(b, c), (c, a), (a, b)].map(|(from, to)| Edge::<I>::new(from, to, first_sample, S::ONE));
    let mut walker = SpanWalker::new(&edges, columns.end - columns.start);
    for row in rows {
        let span = walker.span();
        if span.start < span.end {
            let at_start = edges.map(|e| e.value + e.step_x * I::from(span.start));
            let steps = edges.map(|e| e.step_x);
            let (color, depth) = band.span(row, columns.start + span.start, columns.start + span.end);
            let written = fill_span::<I, V, F, C, D>(color, depth, at_start, steps, surface, fragment);
            counters.span((span.end - span.start).unsigned_abs(), written);
        }
        for edge in &mut edges {
            edge.value = edge.value + edge.step_y;
        }
        walker.next_row();
    }
}

/// Fills a run of covered samples and counts those written. `edges` are the edge functions at the first.
#[inline]
fn fill_span<I, V, F, C, D>(
    color: &mut [C::Pixel],
    depth: &mut [D::Stored],
    mut edges: [I; 3],
    steps: [I; 3],
    surface: &Surface<V>,
    fragment: &F,
) -> u32
where
    I: EdgeInt,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
{
    let mut written = 0;
    for (pixel, stored) in color.iter_mut().zip(depth) {
        let weights = edges.map(I::to_f32);
        let new = D::encode(surface.depth(weights));
        if D::nearer(new, *stored)
            && let Some(shaded) = fragment.shade(surface.attributes.at(weights))
        {
            *stored = new;
            *pixel = C::pixel(shaded);
            written += 1;
        }
        edges = [edges[0] + steps[0], edges[1] + steps[1], edges[2] + steps[2]];
    }
    written
}
