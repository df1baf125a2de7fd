//! Frames that are drawn in bands: from a pass to its triangles on the screen, once, and from these to any band.

use crate::geometry::Geometry;
use crate::pipeline::Pass;
use crate::screen::Screen;
use crate::walk::{Fate, Walk};
use alberti_math::lanes::{Floating, Machine};
use alberti_math::{Varying, for_lanes};
use alberti_projection::Projection;
use alberti_raster::{
    ColorFormat, Corner, Counters, Coverage, DepthFormat, FragmentStage, Interpolation, Outcome, Paint,
    Silhouette, Target,
};
use core::fmt;
use core::mem::take;
use core::ops::Range;

/// Room for one triangle of a prepared pass, in four bytes: its number in the mesh, and the rows of its samples.
#[derive(Clone, Copy, Debug)]
pub struct PreparedTriangle(u32);

impl PreparedTriangle {
    /// The number of a mesh's first triangles that can be listed.
    #[cfg(feature = "threads")]
    pub(crate) const MOST: usize = 1 << NUMBER;

    /// Room without a triangle.
    pub const EMPTY: Self = Self(0);

    #[inline]
    fn new(number: usize, Slices { first, last }: Slices) -> Option<Self> {
        let number = u32::try_from(number).ok().filter(|number| number >> NUMBER == 0)?;
        Some(Self(u32::from(first) << FIRST | u32::from(last) << NUMBER | number))
    }

    #[inline(always)]
    fn number(self) -> usize {
        (self.0 & ((1 << NUMBER) - 1)) as usize
    }

    /// A question for triangles, whether they have some of these slices: two comparisons of whole words.
    #[inline(always)]
    pub(crate) fn meets(Slices { first, last }: Slices) -> impl Fn(&&Self) -> bool {
        let below = (u64::from(last) + 1) << FIRST;
        let most = u32::try_from(below - 1).unwrap_or(u32::MAX);
        let least = u32::from(first) << FIRST;
        move |triangle| triangle.0 <= most && triangle.0 << SLICE >= least
    }
}

/// Bits of a triangle's number.
const NUMBER: u32 = 20;
/// Bits of a slice's number.
const SLICE: u32 = 6;
/// The place of the first slice's number; the last one's is between it and the triangle's.
const FIRST: u32 = NUMBER + SLICE;

/// Room for triangles.
pub(crate) type Room<'a> = &'a mut [PreparedTriangle];

/// The way of vertices to the screen, and how what is between them is painted.
type Way<'a, M, F, P, Pr> = (Walk<'a, M, Pr>, &'a Paint<F, P>);

/// A pass whose triangles have been transformed, clipped and culled for all bands of a frame: see [`Pass::prepare`].
///
/// Triangles that did not find room, and those after the first 2^20, are transformed, clipped and culled again by each
/// [`draw`](Self::draw).
pub struct Prepared<'p, 'a, M: Geometry, F, P, Pr: Projection, D> {
    pass: &'p mut Pass<'a, M, F, P, Pr>,
    /// The way to the screen; `None` if the frame has no pixels.
    screen: Option<Screen<Pr>>,
    /// The number of vertices that have slots of their own, in which they stay.
    filled: usize,
    listed: &'p [PreparedTriangle],
    /// The first of the mesh's triangles that found no room.
    next: usize,
    depth: D,
    /// Whether triangles between samples are listed too.
    smooth: bool,
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
        (room, smooth): (Room<'p>, bool),
        rows_of: impl RowsOf<M, F, P> + Copy,
        counters: &mut K,
    ) -> (Self, Room<'p>) {
        let screen = pass.screen(size, depth);
        let (Some(way), Some(machine)) = (&screen, Machine::all().next()) else {
            let none = Self { pass, screen, filled: 0, listed: &[], next: usize::MAX, depth, smooth };
            return (none, room);
        };
        let pixels = way.viewport.pixels();
        let mesh = pass.mesh();
        let (slots, paint) = pass.halves();
        let mut walk = for_lanes!(machine, lanes => Walk::new(lanes, mesh, way, slots));
        let (listed, next) = list(&mut walk, paint, (&pixels, rows_of), 0..usize::MAX, room, counters);
        let filled = walk.filled();
        let (listed, rest) = room.split_at_mut_checked(listed).unwrap_or_default();
        (Self { pass, screen, filled, listed, next, depth, smooth }, rest)
    }

    /// Draws into a band of the frame the same as [`Pass::draw`] would, in the same order and with the same pixels.
    /// A target of another size gets the same, cut off where it ends. Into one whose depth runs the other way or has
    /// other bits it draws as [`Pass::draw`] without slots.
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
    /// Of a listed triangle, `counters` hear the fate of its parts in the rasterizer, if it has rows near the band. One
    /// that is drawn in three bands is submitted once and drawn three times.
    pub fn count_by<L: Floating, C: ColorFormat, K: Counters>(
        &mut self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        counters: &mut K,
    ) where
        F: FragmentStage<M::Varying>,
    {
        let mesh = self.pass.mesh();
        // A target of depths in another unit gets all triangles anew.
        if !self.has_depths_of(target) {
            return self.anew(|pass| pass.count_by(lanes, target, counters));
        }
        let Some(screen) = &self.screen else { return };
        let (slots, paint) = self.pass.halves();
        let walk = Walk::again(mesh, screen, slots, self.filled);
        let listed = |its| self.listed.iter().filter(PreparedTriangle::meets(its));
        draw_listed(lanes, (listed, self.next), walk, paint, target, counters);
    }

    /// Adds the edges of the listed triangles to a band's silhouette: [`Pass::cover`] without the geometry half.
    ///
    /// Lists of [`Pass::prepare_smooth`] have all that takes. With another it does all of it anew.
    pub fn cover(&mut self, silhouette: &mut Silhouette<'_>) {
        if !self.smooth {
            return self.anew(|pass| pass.cover(silhouette));
        }
        let Some([columns, rows]) = self.screen.as_ref().map(|screen| screen.viewport.pixels()) else {
            return;
        };
        let mut visible = silhouette.scissor(columns, rows);
        let (limits, mut edges) = (visible.limits(), self.pass.halves().1.edges(&mut visible));
        self.each(limits, |_, corners| edges.triangle(corners));
        edges.finish();
    }

    /// Draws the pixels on edges that are covered in part, but not at their centre: [`Pass::draw_fringe`] as
    /// [`cover`](Self::cover).
    pub fn draw_fringe<C: ColorFormat>(&mut self, target: &mut Target<'_, C, D>, coverage: &Coverage<'_>)
    where
        F: FragmentStage<M::Varying>,
    {
        self.count_fringe(target, coverage, &mut ());
    }

    /// [`draw_fringe`](Self::draw_fringe), of whose pixels `counters` hear, each as of a triangle.
    pub fn count_fringe<C: ColorFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        coverage: &Coverage<'_>,
        counters: &mut impl Counters,
    ) where
        F: FragmentStage<M::Varying>,
    {
        if !self.has_depths_of(target) || !self.smooth {
            return self.anew(|pass| pass.count_fringe(target, coverage, counters));
        }
        let Some([columns, rows]) = self.screen.as_ref().map(|screen| screen.viewport.pixels()) else {
            return;
        };
        let mut visible = target.scissor(columns, rows);
        self.each(visible.limits(), |paint, corners| paint.fringe(&mut visible, coverage, corners, counters));
    }

    /// Hands `sink` the listed triangles that may be in these columns and rows, and those that found no room.
    fn each(
        &mut self,
        [_, rows]: [Range<i32>; 2],
        mut sink: impl FnMut(&Paint<F, P>, [&Corner<M::Varying>; 3]),
    ) {
        let (Some(screen), false) = (&self.screen, rows.is_empty()) else { return };
        let [_, all] = screen.viewport.pixels();
        let its = Slices::of(&rows, all.start, slice_shift(&all));
        let mesh = self.pass.mesh();
        let (slots, paint) = self.pass.halves();
        let mut walk = Walk::again(mesh, screen, slots, self.filled);
        let remaining = walk.seen(paint.cull, self.next..mesh.triangles()).flatten();
        let listed = self.listed.iter().filter(PreparedTriangle::meets(its));
        walk.each(listed.map(|triangle| triangle.number()).chain(remaining), |corners| sink(paint, corners));
    }

    /// The way of any of the mesh's vertices to the screen; none if the frame has no pixels.
    pub(crate) fn any_walk(&mut self) -> Option<Way<'_, M, F, P, Pr>> {
        let (mesh, screen) = (self.pass.mesh(), self.screen.as_ref()?);
        let (slots, paint) = self.pass.halves();
        Some((Walk::again_any(mesh, screen, slots, self.filled), paint))
    }

    /// Whether the target has depths in the same unit: of most formats that is known when the program is built.
    pub(crate) fn has_depths_of<C: ColorFormat>(&self, target: &Target<'_, C, D>) -> bool {
        let (depth, found) = (self.depth, target.depth_format());
        (found.reversed(), found.bits()) == (depth.reversed(), depth.bits())
    }

    /// The pass without its slots, which stay.
    pub(crate) fn anew(&mut self, draw: impl FnOnce(&mut Pass<'a, M, F, P, Pr>)) {
        let slots = take(self.pass.halves().0);
        draw(self.pass);
        *self.pass.halves().0 = slots;
    }

    /// The number of the mesh's triangles that are listed.
    #[must_use]
    pub fn listed(&self) -> usize {
        self.listed.len()
    }

    /// The number of the mesh's triangles, the last ones, that found no room: those that each band has to walk again.
    #[must_use]
    pub fn remaining(&self) -> usize {
        self.pass.mesh().triangles().saturating_sub(self.next)
    }
}

impl<M: Geometry, F, P, Pr: Projection, D: fmt::Debug> fmt::Debug for Prepared<'_, '_, M, F, P, Pr, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Prepared")
            .field("listed", &self.listed.len())
            .field("next", &self.next)
            .field("depth", &self.depth)
            .finish_non_exhaustive()
    }
}

/// Lists those of a mesh's triangles with these numbers that have rows in a viewport of these pixels. Returns how many,
/// and the first number that found no room, or is past the last.
#[inline(always)]
pub(crate) fn list<M: Geometry, F, P: Interpolation, Pr: Projection>(
    walk: &mut Walk<'_, M, Pr>,
    paint: &Paint<F, P>,
    (pixels, rows_of): (&[Range<i32>; 2], impl RowsOf<M, F, P> + Copy),
    numbers: Range<usize>,
    room: &mut [PreparedTriangle],
    counters: &mut impl Counters,
) -> (usize, usize) {
    let (mesh, shift) = (walk.mesh(), slice_shift(&pixels[1]));
    let (mut listed, end) = (0, numbers.end);
    for part in walk.seen(paint.cull, numbers) {
        walk.ready(&part);
        for number in part {
            let Some(indices) = mesh.triangle(number) else { break };
            // The rows of its samples; most triangles are whole.
            let (rows, fate) = match walk.whole(indices) {
                Some(corners) => match rows_of(paint, corners, pixels) {
                    Ok(rows) => (rows, Fate::Whole),
                    Err(outcome) => {
                        counters.rasterized(outcome);
                        Fate::Whole.count(counters);
                        continue;
                    }
                },
                None => match rows_of_parts(walk, paint, (pixels, rows_of), indices, counters) {
                    Some(found) => found,
                    None => continue,
                },
            };
            let slices = Slices::of(&rows, pixels[1].start, shift);
            let (Some(triangle), Some(place)) = (PreparedTriangle::new(number, slices), room.get_mut(listed))
            else {
                return (listed, number);
            };
            *place = triangle;
            listed += 1;
            fate.count(counters);
        }
    }
    (listed, end)
}

/// The rows of a triangle, among those of a viewport: of its samples, or of its area.
///
/// A closure, so that what is not asked for is in no program.
pub(crate) trait RowsOf<M: Geometry, F, P>:
    Fn(&Paint<F, P>, [&Corner<M::Varying>; 3], &[Range<i32>; 2]) -> Result<Range<i32>, Outcome>
{
}

impl<M: Geometry, F, P, T> RowsOf<M, F, P> for T where
    T: Fn(&Paint<F, P>, [&Corner<M::Varying>; 3], &[Range<i32>; 2]) -> Result<Range<i32>, Outcome>
{
}

/// Those of its samples.
#[inline(always)]
pub(crate) fn sampled<F, P: Interpolation, V: Varying>(
    paint: &Paint<F, P>,
    corners: [&Corner<V>; 3],
    pixels: &[Range<i32>; 2],
) -> Result<Range<i32>, Outcome> {
    Ok(paint.reach(corners, pixels)?.rows())
}

/// The rows of all parts of a triangle that may be clipped, and its fate; or none, and then the counters have heard.
#[inline(never)]
fn rows_of_parts<M: Geometry, F, P: Interpolation, Pr: Projection, K: Counters>(
    walk: &mut Walk<'_, M, Pr>,
    paint: &Paint<F, P>,
    (pixels, rows_of): (&[Range<i32>; 2], impl RowsOf<M, F, P>),
    indices: [usize; 3],
    counters: &mut K,
) -> Option<(Range<i32>, Fate)> {
    // Beside the rows, how many parts are never drawn.
    let (mut rows, mut culled, mut missed) = (None, 0, 0);
    let fate = walk.triangle(indices, |corners| match rows_of(paint, corners, pixels) {
        Ok(its) => rows = Some(union(rows.take(), its)),
        Err(Outcome::Culled) => culled += 1,
        Err(_) => missed += 1,
    });
    if rows.is_none() {
        (0..culled).for_each(|_| counters.rasterized(Outcome::Culled));
        (0..missed).for_each(|_| counters.rasterized(Outcome::Missed));
        fate.count(counters);
    }
    rows.map(|rows| (rows, fate))
}

/// Draws the triangles that are listed for a target's slices, and those of the mesh from number `next` on.
#[inline(always)]
pub(crate) fn draw_listed<'l, L, I, M, F, P, Pr, C, D, K>(
    lanes: L,
    (listed, next): (impl FnOnce(Slices) -> I, usize),
    mut walk: Walk<'_, M, Pr>,
    paint: &Paint<F, P>,
    target: &mut Target<'_, C, D>,
    counters: &mut K,
) where
    L: Floating,
    I: Iterator<Item = &'l PreparedTriangle>,
    M: Geometry,
    F: FragmentStage<M::Varying>,
    P: Interpolation,
    Pr: Projection,
    C: ColorFormat,
    D: DepthFormat,
    K: Counters,
{
    let [columns, rows] = walk.pixels();
    let (top, shift) = (rows.start, slice_shift(&rows));
    let mut visible = target.scissor(columns, rows);
    let [_, rows] = visible.limits();
    if rows.is_empty() {
        return;
    }
    let listed = listed(Slices::of(&rows, top, shift));
    let mut batch = paint.batch(lanes, &mut visible);
    walk.triangles::<true, _>(listed.map(|triangle| triangle.number()), counters, &mut batch);
    let remaining = next..walk.mesh().triangles();
    if !remaining.is_empty() {
        walk.rest(paint.cull, remaining, counters, &mut batch);
    }
    batch.finish(counters);
}

/// Slices of a viewport's rows, counted from its first one. There are at most 64, of 2^s rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slices {
    first: u8,
    last: u8,
}

/// The least s for which slices of 2^s rows are at most 64.
#[inline]
fn slice_shift(rows: &Range<i32>) -> u32 {
    let last = rows.end.wrapping_sub(rows.start).wrapping_sub(1).max(1).cast_unsigned();
    (last.ilog2() + 1).saturating_sub(SLICE)
}

impl Slices {
    /// Those of no rows.
    #[cfg(feature = "threads")]
    pub(crate) const NONE: Self = Self { first: u8::MAX, last: 0 };

    /// Those of all these triangles, and those between.
    #[cfg(feature = "threads")]
    pub(crate) fn of_all(listed: &[PreparedTriangle]) -> Self {
        const MASK: u32 = (1 << SLICE) - 1;
        listed.iter().fold(Self::NONE, |Self { first, last }, PreparedTriangle(word)| {
            #[expect(clippy::cast_possible_truncation, reason = "six bits")]
            let its = [word >> FIRST, word >> NUMBER & MASK].map(|slice| slice as u8);
            Self { first: first.min(its[0]), last: last.max(its[1]) }
        })
    }

    /// Whether both have one in common.
    #[cfg(feature = "threads")]
    pub(crate) fn meet(self, other: Self) -> bool {
        self.first <= other.last && other.first <= self.last
    }

    /// The slices of some rows, at least one, of a viewport that begins at `top`.
    #[inline]
    fn of(rows: &Range<i32>, top: i32, shift: u32) -> Self {
        let [first, last] = [rows.start, rows.end.wrapping_sub(1)].map(|row| {
            let slice = row.wrapping_sub(top).cast_unsigned() >> shift;
            slice.min((1 << SLICE) - 1) as u8
        });
        Self { first, last }
    }
}

/// The rows of both, and those between.
#[inline]
fn union(one: Option<Range<i32>>, other: Range<i32>) -> Range<i32> {
    match one {
        Some(one) => one.start.min(other.start)..one.end.max(other.end),
        None => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_are_64_at_most_and_hold_their_rows() {
        for rows in (1..300).chain([320, 1023, 1024, 1025, 32_767]) {
            let (top, shift) = (-100, slice_shift(&(-100..rows - 100)));
            assert!(shift == 0 || (rows - 1) >> (shift - 1) > 63, "{rows} rows in slices of 2^{shift}");
            for row in 0..rows {
                let its = Slices::of(&(top + row..top + row + 1), top, shift);
                assert_eq!([its.first, its.last].map(i32::from), [row >> shift; 2], "row {row} of {rows}");
                assert!(i32::from(its.last) < 64, "row {row} of {rows}");
            }
        }
    }

    #[test]
    fn a_listed_triangle_has_its_number_and_meets_its_slices() {
        assert_eq!(size_of::<PreparedTriangle>(), 4);
        let greatest = (1 << NUMBER) - 1;
        for (number, first, last) in [(0, 0, 0), (1, 63, 63), (greatest, 0, 63), (77_777, 5, 6)] {
            let listed = PreparedTriangle::new(number, Slices { first, last }).expect("a number of 20 bits");
            assert_eq!(listed.number(), number);
            for a in 0..64 {
                for b in a..64 {
                    let shared = (first..=last).any(|slice| (a..=b).contains(&slice));
                    let meets = PreparedTriangle::meets(Slices { first: a, last: b })(&&listed);
                    assert_eq!(meets, shared, "{first} to {last}, {a} to {b}");
                }
            }
        }
        assert!(PreparedTriangle::new(greatest + 1, Slices { first: 0, last: 0 }).is_none());
    }
}
