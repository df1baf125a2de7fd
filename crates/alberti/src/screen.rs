//! Steps 1, 2, 4 and 6 for vertices in floats: from object space to places on the screen, and to which planes are
//! beyond.

use crate::integers::IntegerScreen;
use crate::vertex::outside;
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Eye, Frame, Object, Subpixel, map2, map3};
use alberti_projection::{Projection, SideBounds, Viewport};
use alberti_raster::Numbers;

/// The clip at the sides of the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Sides {
    /// Triangles are only cut where they reach beyond the fixed-point range; the rest is left to the rows and columns
    /// that are drawn. Faster, and edges are not moved.
    #[default]
    GuardBand,
    /// The four sides of the cube, -1 <= xs <= 1 and -1 <= ys <= 1.
    Cube,
}

/// The numbers that lead from object space to the screen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screen<Pr: Projection> {
    pub(crate) to_eye: Frame<Object, Eye>,
    pub(crate) projection: Pr,
    pub(crate) viewport: Viewport,
    pub(crate) depth: Pr::Depth,
    pub(crate) guard: SideBounds,
    /// The result of [`depths_within`](Self::depths_within).
    pub(crate) within: [f32; 2],
    pub(crate) sides: Sides,
    pub(crate) subpixel: Subpixel,
    pub(crate) numbers: Numbers,
    /// The way of a mesh of integers, where the numbers are integers too.
    pub(crate) integers: Option<IntegerScreen>,
}

/// Coordinates above this may overflow when they are subtracted or multiplied.
const LARGEST: f32 = f32::MAX / 16.0;

/// The places of several vertices in memory: their bits of [`outside`], x and y as bits of
/// [`Fixed`](alberti_math::Fixed); zs and q.
type Places<L> = ([<L as Lanes>::Each<u32>; 3], [<L as Lanes>::Each<f32>; 2]);

impl<Pr: Projection> Screen<Pr> {
    /// Steps 1 and 2, for several points.
    #[inline(always)]
    pub(crate) fn eye<L: Lanes>(&self, lanes: L, point: [L::Number; 3]) -> [L::Number; 3] {
        self.projection.scale_lanes(lanes, self.to_eye.to_parent_lanes(lanes, point))
    }

    /// Steps 1, 2, 4 and 6 for several points; where they are not within the planes, 4 and 6 have no meaning.
    #[inline(always)]
    pub(crate) fn place<L: Floating>(&self, lanes: L, points: &[L::Each<f32>; 3]) -> Places<L> {
        let Self { projection, viewport, depth, subpixel, .. } = self;
        lanes.vectorize(
            #[inline(always)]
            || {
                let [x, y, z] = points;
                let p = self.eye(lanes, [lanes.load(x), lanes.load(y), lanes.load(z)]);
                let side = projection.side_lanes(lanes, p[2]);
                let [x, y, zs, q] = projection.project_lanes(lanes, depth, p);
                let [column, row] = viewport.to_screen_lanes(lanes, *subpixel, [x, y]);
                // Most vertices lie within all planes.
                let outside = if lanes.bits(self.inside(lanes, p, side)) == all::<L>() {
                    lanes.word(0)
                } else {
                    self.outside(lanes, p, side, [x, y])
                };
                let words = map3([outside, column, row], |words| lanes.store_words(words));
                (words, [lanes.store(zs), lanes.store(q)])
            },
        )
    }

    /// The points that are certainly within all planes, and within the guard band.
    #[inline(always)]
    fn inside<L: Lanes>(&self, lanes: L, [x, y, z]: [L::Number; 3], side: L::Number) -> L::Mask {
        let [near, far] = map2(self.within, |end| lanes.splat(end));
        let within = |x| lanes.less(x, side) & lanes.less(-side, x);
        let beside = within(x) & within(y);
        beside & lanes.less(near, z) & lanes.less(z, far)
    }

    /// The bits of [`outside`] of points whose places on the cube are given too.
    #[inline(always)]
    fn outside<L: Lanes>(
        &self,
        lanes: L,
        [x, y, z]: [L::Number; 3],
        side: L::Number,
        [xs, ys]: [L::Number; 2],
    ) -> L::U32 {
        let Self { projection, guard, .. } = self;
        let nowhere = !(within(lanes, x, LARGEST) & within(lanes, y, LARGEST) & within(lanes, z, LARGEST));
        let sides = bit(lanes, lanes.less(x, -side), outside::LEFT)
            | bit(lanes, lanes.less(side, x), outside::RIGHT)
            | bit(lanes, lanes.less(y, -side), outside::BELOW)
            | bit(lanes, lanes.less(side, y), outside::ABOVE);
        let planes = bit(lanes, lanes.less(z, lanes.splat(projection.near())), outside::NEAR)
            | bit(lanes, lanes.less(lanes.splat(projection.far()), z), outside::FAR);
        let beyond = !(within(lanes, xs, guard.x) & within(lanes, ys, guard.y));
        let ends = bit(lanes, nowhere, outside::NOWHERE) | bit(lanes, beyond, outside::GUARD);
        sides | planes | ends
    }

    /// The depths between which a vertex between the sides is certainly within the guard band and finite: none in
    /// viewports that reach beyond it.
    pub(crate) fn depths_within(projection: &Pr, guard: SideBounds) -> [f32; 2] {
        let sides = guard.x >= 1.0 && guard.y >= 1.0;
        if sides { [projection.near(), projection.far().min(LARGEST)] } else { [f32::INFINITY; 2] }
    }
}

/// A bit for each lane.
#[inline(always)]
fn all<L: Lanes>() -> u32 {
    (1 << L::COUNT) - 1
}

/// A bit where the mask is set.
#[inline(always)]
fn bit<L: Lanes>(lanes: L, mask: L::Mask, bit: u32) -> L::U32 {
    lanes.select_words(mask, lanes.word(bit), lanes.word(0))
}

/// Whether |x| <= `most`; not so for NaN.
#[inline(always)]
fn within<L: Lanes>(lanes: L, x: L::Number, most: f32) -> L::Mask {
    lanes.less(lanes.max(x, -x), lanes.splat(most.next_up()))
}
