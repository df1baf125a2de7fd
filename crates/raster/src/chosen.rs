//! Triangles of a policy that has several ways: each goes on by the kernel of its own.

use crate::color::ColorFormat;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::draw::Paint;
use crate::fragment::FragmentStage;
use crate::interpolation::{Chosen, Exact, Interpolation, Planes};
use crate::setup::Waiting;
use crate::target::Target;
use crate::triangle::{Corner, Reach};
use alberti_math::Varying;
use alberti_math::lanes::Floating;

impl<F, P: Interpolation> Paint<F, P> {
    /// The same with another interpolation.
    #[inline(always)]
    fn by<Q>(&self, interpolation: Q) -> Paint<F, Q>
    where
        F: Copy,
    {
        let Self { stage, subpixel, cull, .. } = *self;
        Paint { stage, interpolation, subpixel, cull }
    }

    /// The second part of [`triangle`](Self::triangle), for the first `count` of several triangles in order.
    #[inline]
    pub(crate) fn draw_batch<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        triangles: (&L::Each<Option<Waiting<'_, V>>>, usize),
        counters: &mut K,
    ) where
        L: Floating,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        if const { P::CHOOSES } {
            self.draw_chosen(lanes, target, triangles, counters);
        } else {
            self.draw_alike(lanes, target, triangles, counters);
        }
    }

    /// The same for one triangle, one sample at a time.
    #[inline(always)]
    pub(crate) fn draw_chosen_alone<L, V, C, D, K>(
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
        match self.interpolation.choose(&(corners, reach.area()), self.subpixel.bits()) {
            Chosen::Lines(lines) => self.by(lines).draw_alone(lanes, target, corners, reach, counters),
            Chosen::Planes => self.by(Planes).draw_alone(lanes, target, corners, reach, counters),
            Chosen::Exact => self.by(Exact).draw_alone(lanes, target, corners, reach, counters),
        }
    }

    /// [`draw_batch`](Self::draw_batch) for policies with several ways: triangles that go the same way and follow each
    /// other go on together.
    #[inline(never)]
    pub(crate) fn draw_chosen<L, V, C, D, K>(
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
        let bits = self.subpixel.bits();
        let at = |k: usize| triangles.as_ref().get(k).and_then(Option::as_ref);
        let ways = lanes.each(
            #[inline(always)]
            |k| at(k).map_or(Chosen::Exact, |triangle| self.interpolation.choose(triangle, bits)),
        );
        let mut rest = ways.as_ref().get(..count).unwrap_or_default();
        while let Some((&way, others)) = rest.split_first() {
            let alike = 1 + others.iter().take_while(|&&other| other == way).count();
            let first = count - rest.len();
            let moved;
            let these = if alike == count {
                triangles
            } else {
                moved = lanes.each(|k| if k < alike { at(first + k).copied() } else { None });
                &moved
            };
            match way {
                Chosen::Lines(lines) => self.by(lines).draw_alike(lanes, target, (these, alike), counters),
                Chosen::Planes => self.by(Planes).draw_alike(lanes, target, (these, alike), counters),
                Chosen::Exact => self.by(Exact).draw_alike(lanes, target, (these, alike), counters),
            }
            rest = rest.get(alike..).unwrap_or_default();
        }
    }
}
