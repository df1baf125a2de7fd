//! From a snapped triangle to pixels.
//!
//! Facing, edges, rows, spans, depth, attributes, colour: read [`draw_triangle`] from top to bottom.

use crate::band::Band;
use crate::color::Store;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::edge::{Edge, EdgeInt};
use crate::exact::{Exact, within};
use crate::fragment::FragmentStage;
use crate::lanes::Lanes;
use crate::spans::SpanWalker;
use crate::triangle::{Bounds, Corners, Cull, Outcome, Vertex, canonical_order, doubled_area};
use alberti_math::glam::Vec4;
use alberti_math::{Subpixel, Varying, hull3};
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
struct Surface<V: Varying> {
    /// zs over the doubled area, so that weights need not be normalised.
    zs: [f32; 3],
    nearest_farthest: [f32; 2],
    attributes: Exact<V>,
}

impl<V: Varying> Surface<V> {
    #[inline]
    fn new<S: Subpixel>(v: [&Vertex<S, V>; 3], doubled_area: i64) -> Self {
        let area = i64::to_f32(doubled_area.stepped());
        let zs = v.map(|v| v.zs);
        Self {
            zs: zs.map(|zs| zs / area),
            nearest_farthest: hull3(zs),
            attributes: Exact::new(v.map(|v| v.q), v.map(|v| v.varying)),
        }
    }

    /// The screen depth: linear on the screen, kept within that of the vertices.
    #[inline(always)]
    fn depth<L: Lanes>(&self, edges: [L; 3]) -> L {
        let [a, b, c] = self.zs;
        let [lo, hi] = self.nearest_farthest;
        within(edges[0] * L::splat(a) + edges[1] * L::splat(b) + edges[2] * L::splat(c), lo, hi)
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
    let steps = edges.map(|e| e.step_x.stepped());
    for row in rows {
        let span = walker.span();
        if span.start < span.end {
            let at_start = edges.map(|e| (e.value + e.step_x * I::from(span.start)).stepped());
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
    edges: [I::Stepped; 3],
    steps: [I::Stepped; 3],
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
    let (color, last_color) = color.split_at_mut(color.len() - color.len() % Vec4::COUNT);
    let (depth, last_depth) = depth.split_at_mut(color.len());
    let stride = |step| step + step + step + step;
    let strides = [stride(steps[0]), stride(steps[1]), stride(steps[2])];
    let [mut e0, mut e1, mut e2] = [
        Vec4::edge::<I>(edges[0], steps[0]),
        Vec4::edge::<I>(edges[1], steps[1]),
        Vec4::edge::<I>(edges[2], steps[2]),
    ];
    let mut written = 0;
    for (color, depth) in color.chunks_exact_mut(Vec4::COUNT).zip(depth.chunks_exact_mut(Vec4::COUNT)) {
        let weights = [Vec4::weight::<I>(e0), Vec4::weight::<I>(e1), Vec4::weight::<I>(e2)];
        written += fill_lanes::<Vec4, V, F, C, D>(color, depth, weights, surface, fragment);
        e0 = Vec4::advance::<I>(e0, strides[0]);
        e1 = Vec4::advance::<I>(e1, strides[1]);
        e2 = Vec4::advance::<I>(e2, strides[2]);
    }
    let [mut e0, mut e1, mut e2] = [e0[0], e1[0], e2[0]];
    for (color, depth) in last_color.chunks_exact_mut(1).zip(last_depth.chunks_exact_mut(1)) {
        let weights = [I::to_f32(e0), I::to_f32(e1), I::to_f32(e2)];
        written += fill_lanes::<f32, V, F, C, D>(color, depth, weights, surface, fragment);
        e0 = e0 + steps[0];
        e1 = e1 + steps[1];
        e2 = e2 + steps[2];
    }
    written
}

/// Fills as many covered samples as there are lanes. `weights` are the edge functions.
#[inline(always)]
fn fill_lanes<L, V, F, C, D>(
    color: &mut [C::Pixel],
    depth: &mut [D::Stored],
    weights: [L; 3],
    surface: &Surface<V>,
    fragment: &F,
) -> u32
where
    L: Lanes,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
{
    let zs = surface.depth(weights);
    let mut seen = 0u32;
    for (k, &old) in depth.iter().enumerate() {
        seen |= u32::from(D::nearer(D::encode(zs.lane(k)), old)) << k;
    }
    if seen == 0 {
        return 0;
    }
    let varyings = surface.attributes.at::<L>(weights);
    let mut written = 0;
    // One after the other instead of in a loop, so that each takes its lane from registers.
    written += u32::from(shade_lane::<0, L, V, F, C, D>(seen, zs, &varyings, color, depth, fragment));
    if L::COUNT == 4 {
        written += u32::from(shade_lane::<1, L, V, F, C, D>(seen, zs, &varyings, color, depth, fragment));
        written += u32::from(shade_lane::<2, L, V, F, C, D>(seen, zs, &varyings, color, depth, fragment));
        written += u32::from(shade_lane::<3, L, V, F, C, D>(seen, zs, &varyings, color, depth, fragment));
    }
    written
}

/// Shades sample `K` if it is seen, and says whether it was written.
#[inline(always)]
fn shade_lane<const K: usize, L, V, F, C, D>(
    seen: u32,
    zs: L,
    varyings: &V::Of<L>,
    color: &mut [C::Pixel],
    depth: &mut [D::Stored],
    fragment: &F,
) -> bool
where
    L: Lanes,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
{
    if seen >> K & 1 == 0 {
        return false;
    }
    let varying = V::from_components(&V::map(varyings, &|lanes: L| lanes.lane(K)));
    let (Some(shaded), Some(pixel), Some(stored)) =
        (fragment.shade(varying), color.get_mut(K), depth.get_mut(K))
    else {
        return false;
    };
    *stored = D::encode(zs.lane(K));
    *pixel = C::pixel(shaded);
    true
}
