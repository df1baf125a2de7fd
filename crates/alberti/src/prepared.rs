//! Frames that are drawn in bands: from a pass to its triangles on the screen, once, and from these to any band.

use crate::geometry::Geometry;
use crate::pipeline::Pass;
use crate::stats::Stats;
use crate::vertex::Slot;
use crate::walk::Walk;
use alberti_math::lanes::{Floating, Machine, One};
use alberti_math::{Varying, for_lanes};
use alberti_projection::Projection;
use alberti_raster::{
    ColorFormat, Corner, Counters, DepthFormat, FragmentStage, Interpolation, Outcome, Paint, Target,
};
use core::fmt;
use core::num::NonZeroU16;
use core::ops::Range;

/// Room for one triangle on the screen.
///
/// # Cost
/// Three vertices of 16 bytes and a varying, and 4 bytes: 76 bytes where two numbers are carried.
#[derive(Clone, Copy, Debug)]
pub struct ScreenTriangle<V: Varying>(Option<Kept<V>>);

impl<V: Varying> ScreenTriangle<V> {
    /// Room without a triangle.
    pub const EMPTY: Self = Self(None);
}

/// Room for triangles.
pub(crate) type Room<'a, V> = &'a mut [ScreenTriangle<V>];

#[derive(Clone, Copy, Debug)]
struct Kept<V: Varying> {
    corners: [Corner<V>; 3],
    rows: Rows,
}

/// A pass whose triangles have been transformed, clipped and culled for all bands of a frame: see [`Pass::prepare`].
///
/// Triangles that did not find room are transformed, clipped and culled again by each [`draw`](Self::draw).
pub struct Prepared<'p, 'a, M: Geometry, F, P, Pr, D> {
    pass: &'p mut Pass<'a, M, F, P, Pr>,
    kept: &'p [ScreenTriangle<M::Varying>],
    /// The first of the mesh's triangles that found no room.
    next: usize,
    /// Columns and rows of the viewport.
    pixels: [Range<i32>; 2],
    /// Columns and rows of the frame.
    size: [u32; 2],
    depth: D,
}

impl<'p, 'a, M, F, P, Pr, D> Prepared<'p, 'a, M, F, P, Pr, D>
where
    M: Geometry,
    P: Interpolation,
    Pr: Projection,
    D: DepthFormat,
{
    pub(crate) fn new<K: Counters>(
        pass: &'p mut Pass<'a, M, F, P, Pr>,
        size: [u32; 2],
        depth: D,
        room: Room<'p, M::Varying>,
        counters: &mut K,
    ) -> (Self, Room<'p, M::Varying>) {
        let Some(screen) = pass.screen(size, depth) else {
            let next = usize::MAX;
            return (Self { pass, kept: &[], next, pixels: [0..0, 0..0], size, depth }, room);
        };
        let pixels = screen.viewport.pixels();
        let mut cache = [Slot::EMPTY; 16];
        let mesh = pass.mesh();
        let (slots, paint) = pass.halves();
        let mut walk = Walk::new(One, mesh, screen, if slots.is_empty() { &mut cache } else { slots });
        // The triangles that wholly found room, and their counts.
        let (mut kept, mut counted, mut next) = (0, Stats::default(), 0);
        while let Some(indices) = mesh.triangle(next) {
            let (mut wanted, mut stats) = (kept, counted);
            walk.triangle(indices, &mut stats, &mut |corners, stats: &mut Stats| match Rows::of(
                paint, corners, &pixels,
            ) {
                Ok(rows) => {
                    if let Some(place) = room.get_mut(wanted) {
                        *place = ScreenTriangle(Some(Kept { corners: corners.map(|corner| *corner), rows }));
                    }
                    wanted += 1;
                }
                Err(outcome) => stats.rasterized(outcome),
            });
            if wanted > room.len() {
                break;
            }
            (kept, counted, next) = (wanted, stats, next + 1);
        }
        counted.repeat(counters);
        let (kept, rest) = room.split_at_mut_checked(kept).unwrap_or_default();
        (Self { pass, kept, next, pixels, size, depth }, rest)
    }

    /// Draws into a band of the frame the same as [`Pass::draw`] would, in the same order and with the same pixels.
    /// Into a target of another frame's size, or whose depth runs the other way or has other bits, it draws as
    /// [`Pass::draw`].
    pub fn draw<C: ColorFormat>(&mut self, target: &mut Target<'_, C, D>)
    where
        F: FragmentStage<M::Varying>,
    {
        if let Some(machine) = Machine::all().next() {
            for_lanes!(machine, lanes => self.draw_by(lanes, target));
        }
    }

    /// [`draw`](Self::draw) with as many samples at a time as there are `lanes`.
    pub fn draw_by<L: Floating, C: ColorFormat>(&mut self, lanes: L, target: &mut Target<'_, C, D>)
    where
        F: FragmentStage<M::Varying>,
    {
        self.count_by(lanes, target, &mut ());
    }

    /// [`draw_by`](Self::draw_by), of which `counters` hear.
    ///
    /// Of a kept triangle, `counters` hear its fate in the rasterizer, if it has rows in the band. One that is drawn in
    /// three bands is submitted once and drawn three times.
    pub fn count_by<L: Floating, C: ColorFormat, K: Counters>(
        &mut self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        counters: &mut K,
    ) where
        F: FragmentStage<M::Varying>,
    {
        // A target of another frame, or of depths in another unit, gets all triangles anew.
        let (depth, found) = (self.depth, target.depth_format());
        let same_depth = (found.reversed(), found.bits()) == (depth.reversed(), depth.bits());
        if target.size() != self.size || !same_depth {
            self.pass.draw_from(0, lanes, target, counters);
            return;
        }
        let [columns, rows] = self.pixels.clone();
        let top = rows.start;
        let mut visible = target.scissor(columns, rows);
        let [_, rows] = visible.limits();
        let rows = rows.start - top..rows.end - top;
        let mut batch = self.pass.paint().batch(lanes, &mut visible);
        for ScreenTriangle(triangle) in self.kept {
            if let Some(Kept { corners, rows: its }) = triangle
                && its.meet(&rows)
            {
                batch.triangle(corners.each_ref(), counters);
            }
        }
        batch.finish(counters);
        if self.remaining() > 0 {
            self.pass.draw_from(self.next, lanes, target, counters);
        }
    }

    /// The number of triangles on the screen that are kept.
    #[must_use]
    pub fn kept(&self) -> usize {
        self.kept.len()
    }

    /// The number of the mesh's triangles, the last ones, that found no room: those that each band has to walk again.
    #[must_use]
    pub fn remaining(&self) -> usize {
        self.pass.mesh().triangles().saturating_sub(self.next)
    }
}

impl<M: Geometry, F, P, Pr, D: fmt::Debug> fmt::Debug for Prepared<'_, '_, M, F, P, Pr, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Prepared")
            .field("kept", &self.kept.len())
            .field("next", &self.next)
            .field("depth", &self.depth)
            .finish_non_exhaustive()
    }
}

/// Rows of a viewport, counted from its first one: those in which a triangle may cover samples. Never none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Rows {
    first: u16,
    /// One past the last. Not being zero, it leaves a value for a [`ScreenTriangle`] that is empty.
    end: NonZeroU16,
}

impl Rows {
    /// The rows of a triangle in a viewport of these `pixels`, or why it is never drawn there.
    #[inline]
    fn of<F, P: Interpolation, V: Varying>(
        paint: &Paint<F, P>,
        corners: [&Corner<V>; 3],
        [columns, rows]: &[Range<i32>; 2],
    ) -> Result<Self, Outcome> {
        let covered = paint.reach(corners, &[columns.clone(), rows.clone()])?.rows();
        let row = |row: i32| u16::try_from(row - rows.start).ok();
        match (row(covered.start), row(covered.end).and_then(NonZeroU16::new)) {
            (Some(first), Some(end)) => Ok(Self { first, end }),
            _ => Err(Outcome::Missed),
        }
    }

    /// Whether some of `rows`, counted like these, are among these.
    #[inline]
    fn meet(self, rows: &Range<i32>) -> bool {
        i32::from(self.first) < rows.end && i32::from(self.end.get()) > rows.start
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::glam::Vec2;
    use alberti_math::{Fixed, Sub4};
    use alberti_raster::{Cull, Exact, Numbers, Vertex};

    #[test]
    fn a_triangle_takes_the_room_that_is_documented() {
        assert_eq!(size_of::<ScreenTriangle<Vec2>>(), 76);
        assert_eq!(size_of::<ScreenTriangle<()>>(), 3 * 16 + 4);
    }

    #[test]
    fn rows_are_those_whose_samples_lie_between_the_vertices() {
        let rows = |corners: [[i32; 2]; 3], cull| {
            let vertices = corners.map(|p| {
                let [x, y] = p.map(|c| Fixed::from_subpixels(c).expect("near the origin"));
                Corner::new(Numbers::Float, &Vertex { x, y, zs: 0.5, q: 1.0, varying: () })
            });
            let paint = Paint { stage: (), interpolation: Exact, subpixel: Sub4, cull };
            let rows = Rows::of(&paint, vertices.each_ref(), &[0..10, 100..110])?;
            Ok(i32::from(rows.first)..i32::from(rows.end.get()))
        };
        // Row 103's sample is at 103 * 16 + 8.
        let (top, bottom) = (103 * 16 + 8, 105 * 16 + 8);
        assert_eq!(rows([[0, top], [90, bottom], [0, bottom]], Cull::Front), Ok(3..6));
        assert_eq!(rows([[0, top + 1], [90, bottom - 1], [0, bottom - 1]], Cull::None), Ok(4..5));
        assert_eq!(rows([[0, 0], [90, 9000], [0, 9000]], Cull::None), Ok(0..10));
        // Between two rows, above, below, and to the right.
        for (x, top, bottom) in [(0, top + 1, top + 15), (0, 0, 1607), (0, 1753, 9000), (160, top, bottom)] {
            let triangle = [[x, top], [x + 90, bottom], [x, bottom]];
            assert_eq!(rows(triangle, Cull::None), Err(Outcome::Missed), "{triangle:?}");
            assert_eq!(rows(triangle, Cull::Back), Err(Outcome::Culled), "{triangle:?}");
        }
        assert_eq!(rows([[0, 0], [16, 16], [32, 32]], Cull::None), Err(Outcome::Culled));
    }

    #[test]
    fn rows_meet_those_they_share() {
        let rows = Rows { first: 3, end: const { NonZeroU16::new(6).unwrap() } };
        for (range, meet) in
            [(0..3, false), (0..4, true), (4..5, true), (5..9, true), (6..9, false), (-5..3, false)]
        {
            assert_eq!(rows.meet(&range), meet, "{range:?}");
        }
    }
}
