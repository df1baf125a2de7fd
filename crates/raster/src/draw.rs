//! From a snapped triangle to pixels.
//!
//! Facing, edges, rows, spans, depth, attributes, colour: read [`Paint::triangle`] from top to bottom.

use crate::bias::biased;
use crate::color::ColorFormat;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::differentiation::Differentiate;
use crate::edge::{Edge, EdgeInt};
use crate::fragment::FragmentStage;
use crate::interpolation::{Interpolate, Interpolation, Oriented, Row};
use crate::mask::RowMask;
use crate::paint::{Painter, aligned};
use crate::sample_box::SampleBox;
use crate::setup::{Setups, Waiting, Way};
use crate::spans::RowSpans;
use crate::target::Target;
use crate::triangle::{Bounds, Corner, Cull, Numbers, Outcome, Reach, Vertex, doubled_area};
use crate::weights::Weights;
use alberti_math::lanes::{Floating, Lanes, One};
use alberti_math::{Subpixel, Varying, map3};
use core::marker::PhantomData;
use core::ops::Range;

/// The way from triangles on the screen to pixels: the half of the pipeline that knows no matrix and no mesh.
#[derive(Clone, Copy, Debug)]
pub struct Paint<F, P> {
    /// From varying to colour.
    pub stage: F,
    /// From the vertices to the samples between them.
    pub interpolation: P,
    /// The grid of the vertices' positions.
    pub subpixel: Subpixel,
    /// The faces that are left out.
    pub cull: Cull,
}

impl<F, P: Interpolation> Paint<F, P> {
    /// Draws one triangle into a target, with as many samples at a time as there are `lanes`.
    ///
    /// Every sample (pixel centre) inside the snapped triangle is covered, exactly. A sample on an edge belongs to the
    /// triangle whose top or left edge it is. So triangles that share an edge neither leave a gap nor draw twice. The
    /// result does not depend on the order of the three vertices, but for [`Flat`](alberti_math::Flat) components, nor
    /// on the lanes. The counters hear its fate.
    ///
    /// # Precision
    /// Coverage is exact. Depth and varyings are those of the interpolation. For [`Exact`](crate::Exact), depth is
    /// within 6ε of the plane through the three zs (ε = 2^-24), relatively, from 2^-77 on. For all policies it
    /// is within the range of the three zs. [Large triangles](crate::Interpolation#large-triangles) add 4ε of the
    /// greatest, as theirs are the planes before snapping.
    ///
    /// # Cost
    /// A triangle that covers no sample is not prepared. Many triangles are drawn faster by a
    /// [`Batch`](crate::Batch).
    ///
    /// With one lane, rows of a box of up to 8 samples are tested sample by sample, and six integer divisions give the
    /// ends of the spans of wider ones. Edge functions then have 32 bits up to 179 pixels (8 subpixel bits) or 2,894 (4
    /// bits) in a square box, and 64 above; in fixed point always 64.
    ///
    /// With several lanes, boxes of up to 32 samples that lie within the target's columns and one run are tested, all
    /// lanes at once. The pixels are the same.
    pub fn triangle<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        vertices: [&Vertex<V>; 3],
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let numbers = self.numbers(target.depth_format());
        let mut corners = vertices.map(|vertex| Corner::new(numbers, vertex));
        if const { D::BIASED } {
            let grid = (numbers.are_fixed(), self.subpixel.bits());
            corners = biased(corners.each_ref(), grid, target.depth_format());
        }
        if const { <P::Lanes<L> as Lanes>::COUNT == 1 } {
            let limits = target.limits();
            self.draw_one(lanes, target, &limits, corners.each_ref(), counters);
        } else {
            self.draw_in_batch(lanes, target, corners.each_ref(), counters);
        }
    }

    /// [`triangle`](Self::triangle) for policies that work on one sample at a time. `limits` are the target's.
    #[inline(always)]
    pub(crate) fn draw_one<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        limits: &[Range<i32>; 2],
        corners: [&Corner<V>; 3],
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        if const { P::HAS_SMALL }
            && self.cull.drops(doubled_area(&map3(corners, |corner| corner.place(true))))
        {
            counters.rasterized(Outcome::Culled);
        } else {
            self.draw_facing(lanes, target, limits, corners, counters);
        }
    }

    /// [`draw_one`](Self::draw_one) for a triangle that is known to face the right way.
    #[inline(always)]
    pub(crate) fn draw_facing<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        limits: &[Range<i32>; 2],
        corners: [&Corner<V>; 3],
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        if const { P::HAS_SMALL } {
            let [a, b, c] = corners;
            self.draw_seen(lanes, target, a, b, c, counters);
            return;
        }
        match self.reach(corners, limits) {
            Ok(reach) if const { P::CHOOSES } => {
                self.draw_chosen_alone(lanes, target, corners, &reach, counters);
            }
            Ok(reach) => self.draw_alone(lanes, target, corners, &reach, counters),
            Err(outcome) => counters.rasterized(outcome),
        }
    }

    /// [`draw_one`](Self::draw_one) for a triangle that faces the right way, by a policy that has a way for small ones.
    /// Its corners are in registers, as those of an array are not.
    #[inline(never)]
    fn draw_seen<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        a: &Corner<V>,
        b: &Corner<V>,
        c: &Corner<V>,
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        if !self.interpolation.draw_small::<false, _, _, _, _, _>(self, target, [a, b, c], counters) {
            self.draw_large(lanes, target, [a, b, c], counters);
        }
    }

    /// The same for one that is not a coarse small one. A call, as such are rare on the grid of `Sub4`.
    #[inline(never)]
    fn draw_large<L, V, C, D, K>(
        self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        corners: [&Corner<V>; 3],
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        if self.interpolation.draw_small::<true, _, _, _, _, _>(&self, target, corners, counters) {
            return;
        }
        match self.reach(corners, &target.limits()) {
            Ok(reach) => self.draw_alone(lanes, target, corners, &reach, counters),
            Err(outcome) => counters.rasterized(outcome),
        }
    }

    /// The numbers of the interpolation, for corners in a target with this depth format.
    #[must_use]
    #[inline(always)]
    pub fn numbers(&self, depth: impl DepthFormat) -> Numbers {
        self.interpolation.numbers(depth)
    }

    /// The facing and the box of a triangle, with its samples among the columns and rows of `limits`: the first part of
    /// [`triangle`](Self::triangle).
    ///
    /// # Errors
    /// [`Outcome::Culled`] if it faces the wrong way or has no area, [`Outcome::Missed`] if its box holds no sample
    /// within `limits`.
    #[inline(always)]
    pub fn reach<V: Varying>(
        &self,
        corners: [&Corner<V>; 3],
        limits: &[Range<i32>; 2],
    ) -> Result<Reach, Outcome> {
        let fixed = const { <P::Lanes<One> as Lanes>::FIXED };
        Reach::new(corners, (self.subpixel.bits(), fixed), self.cull, limits)
    }

    /// [`triangle`](Self::triangle) for policies that work on several samples at a time: by the kernel of batches.
    #[inline]
    pub(crate) fn draw_in_batch<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        corners: [&Corner<V>; 3],
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let Some(triangle) = self.facing(corners) else {
            counters.rasterized(Outcome::Culled);
            return;
        };
        let only = lanes.each(|k| (k == 0).then_some(triangle));
        self.draw_batch(lanes, target, (&only, 1), counters);
    }

    /// The triangle with its area, if it is not culled.
    #[inline(always)]
    pub(crate) fn facing<'c, V: Varying>(&self, corners: [&'c Corner<V>; 3]) -> Option<Waiting<'c, V>> {
        let area = doubled_area(&map3(corners, |corner| corner.place(false)));
        (!self.cull.drops(area)).then_some((corners, area))
    }

    /// The second part, for the first `count` of several triangles in order, which all go one way. The counters hear
    /// the fate of each. Not inlined, as one copy of this kernel is enough.
    #[inline(never)]
    pub(crate) fn draw_alike<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        (triangles, count): (&L::Each<Option<Waiting<'_, V>>>, usize),
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let Self { stage, interpolation, subpixel, .. } = *self;
        let (bits, limits) = (subpixel.bits(), target.limits());
        lanes.vectorize(
            #[inline(always)]
            || {
                let setups = Setups::new(lanes, triangles, bits, &limits, interpolation.run());
                for (k, triangle) in triangles.as_ref().iter().enumerate().take(count) {
                    let Some(triangle @ (vertices, area)) = triangle else { break };
                    let outcome = match setups.way(k) {
                        Way::Missed => Outcome::Missed,
                        Way::Masks => fill_masked(
                            interpolation.lanes(lanes),
                            target,
                            setups.columns_and_rows(k),
                            setups.edges(k),
                            #[inline(always)]
                            || {
                                let oriented = setups.oriented(k, triangle, bits);
                                Setup { interpolation, lanes, oriented: &oriented, stage }.prepare()
                            },
                            counters,
                        ),
                        // Integers of 64 bits, as several lanes have the functions in parts of `f32`.
                        Way::Spans => {
                            let mut oriented = Oriented::new(*vertices, *area, bits, false);
                            let unsnapped = oriented.unsnapped(Bounds::of(&oriented.corners).is_large(bits));
                            oriented.replace(&unsnapped);
                            let ranges = setups.columns_and_rows(k);
                            let samples = SampleBox::new(&oriented, ranges, limits[0].clone());
                            if const { P::WIDE && F::WIDE } {
                                let lanes = lanes.wide();
                                let setup = Setup { interpolation, lanes, oriented: &oriented, stage };
                                fill::<i64, _, _, _, _, _, _, _>(target, &samples, &setup, counters)
                            } else {
                                let setup = Setup { interpolation, lanes, oriented: &oriented, stage };
                                fill::<i64, _, _, _, _, _, _, _>(target, &samples, &setup, counters)
                            }
                        }
                    };
                    counters.touched(outcome, || {
                        let [columns, rows] = setups.columns_and_rows(k);
                        [within(&columns, &limits[0]), rows]
                    });
                    counters.rasterized(outcome);
                }
            },
        );
    }

    /// The second part, for one triangle. Not inlined: most triangles do not come here.
    #[inline(never)]
    pub(crate) fn draw_alone<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        corners: [&Corner<V>; 3],
        reach: &Reach,
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        self.draw(lanes, target, corners, reach, counters);
    }

    /// The second part, for policies that work on one sample at a time.
    #[inline(always)]
    fn draw<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        vertices: [&Corner<V>; 3],
        reach: &Reach,
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let Self { stage, interpolation, subpixel, .. } = *self;
        let [limits, _] = target.limits();
        let fixed = const { <P::Lanes<L> as Lanes>::FIXED };
        let unsnapped;
        let mut oriented = Oriented::new(vertices, reach.area(), subpixel.bits(), fixed);
        if const { !<P::Lanes<L> as Lanes>::FIXED } {
            unsnapped = oriented.unsnapped(reach.is_large());
            oriented.replace(&unsnapped);
        }
        let setup = Setup { interpolation, lanes, oriented: &oriented, stage };
        let samples = SampleBox::new(&oriented, [reach.columns(), reach.rows()], limits);
        // Policies with a way for small triangles have 64 bits alone, for less code: docs/kernel.md.
        let outcome = if const { !P::HAS_SMALL } && reach.fits_i32() {
            fill::<i32, _, _, _, _, _, _, _>(target, &samples, &setup, counters)
        } else {
            fill::<i64, _, _, _, _, _, _, _>(target, &samples, &setup, counters)
        };
        counters.touched(outcome, || [within(&samples.columns, &samples.limits), samples.rows.clone()]);
        counters.rasterized(outcome);
    }
}

/// The columns of a box that are among the limits.
#[inline]
fn within(columns: &Range<i32>, limits: &Range<i32>) -> Range<i32> {
    columns.start.max(limits.start)..columns.end.min(limits.end)
}

/// A triangle before the preparation that only its fragments need.
struct Setup<'a, P, L, V: Varying, F> {
    interpolation: P,
    lanes: L,
    oriented: &'a Oriented<'a, V>,
    stage: F,
}

impl<P: Interpolation, L: Floating, V: Varying, F: FragmentStage<V>> Setup<'_, P, L, V, F> {
    #[inline(always)]
    fn prepare(&self) -> Painter<P::Lanes<L>, V, P::Triangle<L, V>, F> {
        let Self { interpolation, lanes, oriented, stage } = *self;
        let triangle = interpolation.prepare(lanes, oriented);
        let (policy, lanes) = (stage.derivatives(), interpolation.lanes(lanes));
        const {
            assert!(
                !F::SETTLES || <F::Derivatives as Differentiate>::EVERYWHERE,
                "see FragmentStage::SETTLES"
            );
        };
        let derivatives = policy.prepare(oriented);
        let stage = match policy.everywhere(lanes, &derivatives) {
            Some(gradient) if const { F::SETTLES } => stage.settled(lanes, &gradient),
            _ => stage,
        };
        Painter { lanes, triangle, derivatives, stage, varying: PhantomData }
    }
}

/// Fills the covered samples of a box, row by row. `I` is wide enough for every edge function in it.
#[inline(always)]
fn fill<I, P, L, V, F, C, D, K>(
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
    let (mut painter, mut stage) = (None, None::<F>);
    for row in rows.clone() {
        let covered = spans.next_row().shifted(columns.start);
        if covered.start.max(limits.start) < covered.end.min(limits.end) {
            if painter.is_none() {
                painter = Some(setup.prepare());
                if const { F::BY_ROWS } {
                    stage = painter.as_ref().map(|painter| painter.stage);
                }
            }
            if const { F::BY_ROWS }
                && let (Some(painter), Some(stage)) = (&mut painter, stage)
            {
                painter.stage = stage.in_row(row);
            }
            if let Some(painter) = &painter {
                let row = Row { row, covered, origin: columns.start, edges: &edges };
                painter.row(target, &row, limits, &weights, counters);
            }
        }
        for edge in &mut edges {
            edge.value = edge.value + edge.step_y;
        }
    }
    if painter.is_some() { Outcome::Drawn } else { Outcome::Missed }
}

/// The same for several lanes and a box that is [filled by masks](Way::Masks): without spans.
#[inline(always)]
fn fill_masked<L, V, T, F, C, D, K>(
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
