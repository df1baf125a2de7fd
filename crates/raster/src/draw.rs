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
use crate::lanes::{Lanes, Native};
use crate::spans::SpanWalker;
use crate::triangle::{Bounds, Corners, Cull, Outcome, Vertex, canonical_order, doubled_area};
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
    let surface = Surface::<L, V>::new(vertices, area.abs());
    if bounds.fits_i32(S::ONE) {
        fill::<i32, L, S, _, _, _, _, _>(band, &corners, columns, rows, &surface, fragment, counters);
    } else {
        fill::<i64, L, S, _, _, _, _, _>(band, &corners, columns, rows, &surface, fragment, counters);
    }
    Outcome::Drawn
}

/// What is interpolated over a triangle, from the edge functions at a sample.
struct Surface<L: Lanes, V: Varying> {
    /// zs over the doubled area, so that weights need not be normalised.
    zs: [L; 3],
    nearest_farthest: [L; 2],
    attributes: Exact<L, V>,
}

impl<L: Lanes, V: Varying> Surface<L, V> {
    #[inline(always)]
    fn new<S: Subpixel>([a, b, c]: [&Vertex<S, V>; 3], doubled_area: i64) -> Self {
        let area = doubled_area.to_f32();
        let [lo, hi] = hull3([a.zs, b.zs, c.zs]);
        Self {
            zs: [L::splat(a.zs / area), L::splat(b.zs / area), L::splat(c.zs / area)],
            nearest_farthest: [L::splat(lo), L::splat(hi)],
            attributes: Exact::new([a.q, b.q, c.q], [a.varying, b.varying, c.varying]),
        }
    }

    /// The screen depth: linear on the screen, kept within that of the vertices.
    #[inline(always)]
    fn depth(&self, edges: [L; 3]) -> L {
        let [lo, hi] = self.nearest_farthest;
        (edges[0] * self.zs[0] + edges[1] * self.zs[1] + edges[2] * self.zs[2]).max(lo).min(hi)
    }
}

/// Fills the covered samples of a box, row by row. `I` is wide enough for every edge function in it.
#[inline]
fn fill<I, L, S, V, F, C, D, K>(
    band: &mut Band<'_, C, D>,
    &[a, b, c]: &Corners,
    columns: Range<i32>,
    rows: Range<i32>,
    surface: &Surface<L, V>,
    fragment: &F,
    counters: &mut K,
) where
    I: EdgeInt,
    L: Lanes,
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
    let mut walker = SpanWalker::new(&edges, columns.end - columns.start, rows.end - rows.start);
    let steps = edges.map(|e| e.step_x);
    for row in rows.start..rows.start + walker.rows() {
        let span = walker.span();
        if span.start < span.end {
            let at_start = edges.map(|e| e.value + e.step_x * I::from(span.start));
            let (color, depth) = band.pixels_from(row, columns.start + span.start);
            let covered = (span.end - span.start).unsigned_abs();
            let written =
                fill_span::<I, L, V, F, C, D>(color, depth, covered, at_start, steps, surface, fragment);
            counters.span(covered, written);
        }
        for edge in &mut edges {
            edge.value = edge.value + edge.step_y;
        }
        walker.next_row();
    }
}

/// Fills the first `covered` samples of a row's rest and counts those written. `edges` are the edge functions at the
/// first. The last lanes may look at pixels beyond the span, which they leave alone.
#[inline(always)]
fn fill_span<I, L, V, F, C, D>(
    color: &mut [C::Pixel],
    depth: &mut [D::Stored],
    covered: u32,
    edges: [I; 3],
    steps: [I; 3],
    surface: &Surface<L, V>,
    fragment: &F,
) -> u32
where
    I: EdgeInt,
    L: Lanes,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
{
    let mut e0 = L::edge::<I>(edges[0], steps[0]);
    let mut e1 = L::edge::<I>(edges[1], steps[1]);
    let mut e2 = L::edge::<I>(edges[2], steps[2]);
    let (mut at, mut left, mut written) = (0, covered as usize, 0);
    loop {
        let weights = [L::weight::<I>(e0), L::weight::<I>(e1), L::weight::<I>(e2)];
        let lanes = if left < L::COUNT { (1 << left) - 1 } else { (1 << L::COUNT) - 1 };
        let end = at + L::COUNT;
        written += match (color.get_mut(at..end), depth.get_mut(at..end)) {
            (Some(color), Some(depth)) => {
                fill_lanes::<L, V, F, C, D>(color, depth, lanes, weights, surface, fragment)
            }
            _ => {
                let (color, depth) = (color.get_mut(at..), depth.get_mut(at..));
                let rest = (color.unwrap_or_default(), depth.unwrap_or_default());
                fill_end::<L, V, F, C, D>(rest, lanes, weights, surface, fragment)
            }
        };
        if left <= L::COUNT {
            return written;
        }
        left -= L::COUNT;
        at = end;
        e0 = L::advance::<I>(e0, steps[0]);
        e1 = L::advance::<I>(e1, steps[1]);
        e2 = L::advance::<I>(e2, steps[2]);
    }
}

/// Fills the last samples of a band that has fewer pixels left than there are lanes.
#[cold]
#[inline(never)]
fn fill_end<L, V, F, C, D>(
    (color, depth): (&mut [C::Pixel], &mut [D::Stored]),
    lanes: u32,
    weights: [L; 3],
    surface: &Surface<L, V>,
    fragment: &F,
) -> u32
where
    L: Lanes,
    V: Varying,
    F: FragmentStage<V>,
    C: Store<F::Color>,
    D: DepthFormat,
{
    let (Some(&first_color), Some(&first_depth)) = (color.first(), depth.first()) else { return 0 };
    let (mut wide_color, mut wide_depth) = ([first_color; 4], [first_depth; 4]);
    for (wide, &pixel) in wide_color.iter_mut().zip(&*color) {
        *wide = pixel;
    }
    for (wide, &stored) in wide_depth.iter_mut().zip(&*depth) {
        *wide = stored;
    }
    let written =
        fill_lanes::<L, V, F, C, D>(&mut wide_color, &mut wide_depth, lanes, weights, surface, fragment);
    for (pixel, wide) in color.iter_mut().zip(wide_color) {
        *pixel = wide;
    }
    for (stored, wide) in depth.iter_mut().zip(wide_depth) {
        *stored = wide;
    }
    written
}

/// Fills those samples whose bits are set in `lanes`. `weights` are the edge functions.
#[inline(always)]
fn fill_lanes<L, V, F, C, D>(
    color: &mut [C::Pixel],
    depth: &mut [D::Stored],
    lanes: u32,
    weights: [L; 3],
    surface: &Surface<L, V>,
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
    // One sample after the other instead of in a loop, so that each takes its lane from a register.
    let mut seen = sees::<0, L, D>(zs, depth);
    if L::COUNT == 4 {
        seen |= sees::<1, L, D>(zs, depth) | sees::<2, L, D>(zs, depth) | sees::<3, L, D>(zs, depth);
    }
    seen &= lanes;
    if seen == 0 {
        return 0;
    }
    let varyings = surface.attributes.at(weights);
    let mut written = u32::from(shade_lane::<0, L, V, F, C, D>(seen, zs, &varyings, color, depth, fragment));
    if L::COUNT == 4 {
        written += u32::from(shade_lane::<1, L, V, F, C, D>(seen, zs, &varyings, color, depth, fragment));
        written += u32::from(shade_lane::<2, L, V, F, C, D>(seen, zs, &varyings, color, depth, fragment));
        written += u32::from(shade_lane::<3, L, V, F, C, D>(seen, zs, &varyings, color, depth, fragment));
    }
    written
}

/// Bit `K` if there is a sample `K` and it is seen in front of what is stored.
#[inline(always)]
fn sees<const K: usize, L: Lanes, D: DepthFormat>(zs: L, depth: &[D::Stored]) -> u32 {
    u32::from(depth.get(K).is_some_and(|&old| D::nearer(D::encode(zs.lane(K)), old))) << K
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
