//! Triangles drawn a few at a time.

use crate::bias::biased;
use crate::color::ColorFormat;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::draw::Paint;
use crate::fragment::FragmentStage;
use crate::interpolation::Interpolation;
use crate::setup::Waiting;
use crate::target::Target;
use crate::triangle::{Corner, Outcome, doubled_area};
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Varying, map3};
use core::fmt;
use core::ops::Range;

/// Triangles on their way into a target, as many as there are lanes: so code for wide registers is entered once for
/// several of them. The pixels are those of [`Paint::triangle`], in the same order. One that is dropped without
/// [`finish`](Self::finish) leaves its last triangles out.
#[must_use = "the last triangles are drawn by `finish`"]
pub struct Batch<'a, 't, 'c, L: Lanes, V: Varying, F, P, C: ColorFormat, D: DepthFormat> {
    lanes: L,
    paint: Paint<F, P>,
    target: &'a mut Target<'t, C, D>,
    limits: [Range<i32>; 2],
    triangles: L::Each<Option<Waiting<'c, V>>>,
    /// Those whose corners are not kept, with their areas, and a bit for each.
    copies: L::Each<([Corner<V>; 3], i64)>,
    waiting_copies: u32,
    count: usize,
}

impl<F, P: Interpolation> Paint<F, P> {
    /// An empty batch of triangles for a target.
    #[inline]
    pub fn batch<'a, 't, 'c, L, V, C, D>(
        &self,
        lanes: L,
        target: &'a mut Target<'t, C, D>,
    ) -> Batch<'a, 't, 'c, L, V, F, P, C, D>
    where
        L: Floating,
        V: Varying,
        F: Copy,
        C: ColorFormat,
        D: DepthFormat,
    {
        let limits = target.limits();
        let (triangles, copies) = (lanes.each(|_| None), lanes.each(|_| ([Corner::NONE; 3], 0)));
        Batch { lanes, paint: *self, target, limits, triangles, copies, waiting_copies: 0, count: 0 }
    }
}

impl<'c, L, V, F, P, C, D> Batch<'_, '_, 'c, L, V, F, P, C, D>
where
    L: Floating,
    V: Varying,
    F: FragmentStage<V>,
    P: Interpolation,
    C: ColorFormat,
    D: DepthFormat,
{
    /// Adds a triangle, after which those that are there may be drawn. The counters hear the fate of each once.
    #[inline(always)]
    pub fn triangle(&mut self, corners: [&'c Corner<V>; 3], counters: &mut impl Counters) {
        // Constants in blocks of their own, so that no code is made of the other way.
        if const { D::BIASED } {
            self.passing(corners, counters);
            return;
        }
        if const { <P::Lanes<L> as Lanes>::COUNT == 1 } {
            self.paint.draw_one(self.lanes, self.target, &self.limits, corners, counters);
            return;
        }
        let Some(triangle) = self.paint.facing(corners) else {
            counters.rasterized(Outcome::Culled);
            return;
        };
        if let Some(place) = self.triangles.as_mut().get_mut(self.count) {
            *place = Some(triangle);
        }
        self.added(counters);
    }

    /// The same for a triangle that is known to face the right way.
    #[inline(always)]
    pub fn facing(&mut self, corners: [&'c Corner<V>; 3], counters: &mut impl Counters) {
        if const { !D::BIASED && <P::Lanes<L> as Lanes>::COUNT == 1 } {
            self.paint.draw_facing(self.lanes, self.target, &self.limits, corners, counters);
        } else {
            self.triangle(corners, counters);
        }
    }

    /// The same for a triangle whose corners are not kept.
    #[inline(always)]
    pub fn passing(&mut self, corners: [&Corner<V>; 3], counters: &mut impl Counters) {
        if const { !D::BIASED } {
            return self.copied(corners, counters);
        }
        let fixed = const { <P::Lanes<L> as Lanes>::FIXED };
        // Without a bias for those that are not drawn.
        if self.paint.cull.drops(doubled_area(&map3(corners, |corner| corner.place(fixed)))) {
            return counters.rasterized(Outcome::Culled);
        }
        let grid = (fixed, self.paint.subpixel.bits());
        self.copied(biased(corners, grid, self.target.depth_format()).each_ref(), counters);
    }

    #[inline(always)]
    fn copied(&mut self, corners: [&Corner<V>; 3], counters: &mut impl Counters) {
        if const { <P::Lanes<L> as Lanes>::COUNT == 1 } {
            self.paint.draw_one(self.lanes, self.target, &self.limits, corners, counters);
            return;
        }
        let Some((_, area)) = self.paint.facing(corners) else {
            counters.rasterized(Outcome::Culled);
            return;
        };
        if let Some(copy) = self.copies.as_mut().get_mut(self.count) {
            *copy = (corners.map(|corner| *corner), area);
            self.waiting_copies |= 1 << self.count;
        }
        self.added(counters);
    }

    /// Draws them all, once there is one for each lane.
    #[inline(always)]
    fn added(&mut self, counters: &mut impl Counters) {
        self.count += 1;
        if self.count >= L::COUNT {
            self.draw(counters);
        }
    }

    /// Draws the triangles that are left.
    #[inline]
    pub fn finish(mut self, counters: &mut impl Counters) {
        // With one lane there never are any.
        if const { <P::Lanes<L> as Lanes>::COUNT > 1 } {
            self.draw(counters);
        }
    }

    #[inline]
    fn draw(&mut self, counters: &mut impl Counters) {
        let Self { lanes, paint, target, triangles, copies, waiting_copies: copied, count, .. } = self;
        if *copied == 0 {
            paint.draw_batch(*lanes, target, (triangles, *count), counters);
        } else {
            let all = lanes.each(|k| match copies.as_ref().get(k) {
                Some((corners, area)) if *copied >> k & 1 == 1 => Some((corners.each_ref(), *area)),
                _ => triangles.as_ref().get(k).copied().flatten(),
            });
            paint.draw_batch(*lanes, target, (&all, *count), counters);
        }
        (*count, *copied) = (0, 0);
    }
}

impl<L: Lanes, V: Varying, F, P, C: ColorFormat, D: DepthFormat> fmt::Debug
    for Batch<'_, '_, '_, L, V, F, P, C, D>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Batch")
            .field("limits", &self.limits)
            .field("count", &self.count)
            .finish_non_exhaustive()
    }
}
