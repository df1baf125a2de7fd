//! From a snapped triangle to pixels.
//!
//! Facing, edges, rows, spans, depth, attributes, colour: read [`Paint::triangle`] from top to bottom.

use crate::bias::biased;
use crate::color::ColorFormat;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::fill::{Setup, fill, fill_masked};
use crate::fragment::FragmentStage;
use crate::interpolation::{Interpolation, Oriented};
use crate::sample_box::SampleBox;
use crate::setup::{Setups, Waiting, Way};
use crate::small::{Coarse, Either, Fine};
use crate::target::Target;
use crate::triangle::{Bounds, Corner, Cull, Numbers, Outcome, Reach, Vertex, doubled_area};
use alberti_math::lanes::{Floating, Lanes, One};
use alberti_math::{Sub8, Subpixel, Varying, map3};
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
        let drawn = if cfg!(feature = "small-code") {
            let grid = Either { fine: self.subpixel == Sub8 };
            self.interpolation.draw_small(grid, self, target, [a, b, c], counters)
        } else {
            self.interpolation.draw_small(Coarse, self, target, [a, b, c], counters)
        };
        if !drawn {
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
        if !cfg!(feature = "small-code")
            && self.interpolation.draw_small(Fine, &self, target, corners, counters)
        {
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

#[cfg(test)]
mod tests;
