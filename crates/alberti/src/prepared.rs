//! For a frame that is drawn in bands: from a pass to its triangles on the screen, once, and from these to any band.

use crate::pipeline::{Pass, Walk, draw_from, rasterize};
use crate::stats::Stats;
use crate::vertex::{Slot, VertexStage};
use alberti_math::lanes::{Floating, Machine};
use alberti_math::{Subpixel, for_lanes};
use alberti_projection::Projection;
use alberti_raster::{
    Band, Counters, Cull, DepthFormat, FragmentStage, Interpolation, Outcome, Store, Vertex, reach,
};
use core::marker::PhantomData;
use core::num::NonZeroU16;
use core::ops::Range;

/// Room for one triangle on the screen.
///
/// # Cost
/// Three vertices of 16 bytes and a varying, and 4 bytes: 76 bytes where two numbers are carried.
#[derive(Clone, Copy, Debug)]
pub struct ScreenTriangle<S: Subpixel, V>(Option<Kept<S, V>>);

impl<S: Subpixel, V> ScreenTriangle<S, V> {
    /// Room without a triangle.
    pub const EMPTY: Self = Self(None);
}

#[derive(Clone, Copy, Debug)]
struct Kept<S: Subpixel, V> {
    vertices: [Vertex<S, V>; 3],
    rows: Rows,
}

/// A pass whose triangles have been transformed, clipped and culled for all bands of a frame: see [`prepare`].
///
/// Triangles that did not find room are transformed, clipped and culled again by each [`draw`](Self::draw). `D` is the
/// depth format of its bands, `P` the pass, which cannot change meanwhile.
#[derive(Debug)]
pub struct Prepared<'a, D, S: Subpixel, V, P> {
    pass: &'a P,
    kept: &'a [ScreenTriangle<S, V>],
    /// The first of the mesh's triangles that found no room.
    next: usize,
    depth: PhantomData<D>,
}

/// Does once, for all bands of a frame, what [`draw`](crate::draw) does before the rasterizer for each of them, as far
/// as there is `room` for the triangles on the screen. Returns with them the room that is left, for the next pass.
///
/// Triangles that could never be drawn take no room: those that the pass leaves out for their facing, those outside the
/// view, and those whose box holds no sample of the viewport. A clipped triangle takes room for up to seven. The mesh's
/// triangles are kept in order, up to the first that finds no room; without any, [`Prepared::draw`] is
/// [`draw`](crate::draw). The pixels never depend on the room.
///
/// `D` is the depth format of the bands to come, and follows from them. `slots` are as in [`draw`](crate::draw).
///
/// `counters` hear, once, which triangles are submitted, dropped, clipped, culled, or missed by their box, up to the
/// first that finds no room. The others are counted by each [`Prepared::draw`], as by [`draw`](crate::draw). Together
/// they count, for a band with all rows of the viewport, what `draw` does.
///
/// ```
/// use alberti::{glam::Vec3, *};
///
/// // Two triangles that pass through each other, in a frame of 32 x 24 pixels.
/// let vertices = [-0.9, 0.9].map(|x| [(x, -0.8, 0.5), (-x, -0.8, -0.5), (0.0, 0.8, 0.0)]);
/// let pass = Pass {
///     view: View {
///         to_eye: Frame::at(Point3::new(Vec3::new(0.0, 0.0, 2.0))),
///         projection: Perspective::new(1.0, 32.0 / 24.0, 0.1, 10.0)?,
///         viewport: Viewport::new(0, 0, 32, 24)?,
///     },
///     vertices: vertices.as_flattened(),
///     triangles: &[[0u16, 1, 2], [3, 4, 5]],
///     vertex_stage: |&(x, y, z): &(f32, f32, f32)| (Point3::new(Vec3::new(x, y, z)), z),
///     fragment_stage: |z: f32| Some(Rgba8::from_rgb24(if z < 0.0 { 0xff_c0_40 } else { 0x20_60_a0 })),
///     cull: Cull::None,
///     sides: Sides::GuardBand,
///     interpolation: Exact,
/// };
///
/// let mut room = [ScreenTriangle::<Sub8, _>::EMPTY; 4];
/// let mut slots = [Slot::EMPTY; 6];
/// let (prepared, rest) = prepare(&pass, &mut room, &mut slots, &mut ());
/// assert_eq!((prepared.kept(), prepared.remaining(), rest.len()), (2, 0, 2));
///
/// // Three bands, one after the other in the same eight rows of memory.
/// let mut frame = Vec::new();
/// for first_row in [0, 8, 16] {
///     let (mut color, mut depth) = ([0u16; 32 * 8], [0u16; 32 * 8]);
///     let mut band = Band::<Rgb565Be, D16>::new(32, first_row, &mut color, &mut depth)?;
///     band.clear(Rgba8::BLACK);
///     prepared.draw(&mut band, &mut slots, &mut ());
///     frame.extend(color);
/// }
///
/// // The same as all rows at once.
/// let (mut color, mut depth) = ([0u16; 32 * 24], [0u16; 32 * 24]);
/// let mut band = Band::<Rgb565Be, D16>::new(32, 0, &mut color, &mut depth)?;
/// band.clear(Rgba8::BLACK);
/// draw(&pass, &mut band, &mut slots, &mut ());
/// assert!(frame == color && frame.iter().any(|&pixel| pixel != 0));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Cost
/// What `draw` costs without the rasterizer, and a copy of each triangle that is kept. In return a band costs its
/// fragments, the setup of the triangles that meet it, and a comparison for each of the others.
#[expect(clippy::type_complexity, reason = "two things: what is prepared, and the room that is left")]
pub fn prepare<'a, 'm, D, S, T, I, Vs, Fs, P, Pr, K>(
    pass: &'a Pass<'m, T, I, Vs, Fs, P, Pr>,
    room: &'a mut [ScreenTriangle<S, Vs::Varying>],
    slots: &mut [Slot<S, Vs::Varying>],
    counters: &mut K,
) -> (PreparedPass<'a, 'm, D, S, T, I, Vs, Fs, P, Pr>, &'a mut [ScreenTriangle<S, Vs::Varying>])
where
    D: DepthFormat,
    S: Subpixel,
    I: Copy + Into<u32>,
    Vs: VertexStage<T>,
    Pr: Projection,
    K: Counters,
{
    if slots.is_empty() {
        return prepare(pass, room, &mut [Slot::EMPTY; 16], counters);
    }
    let pixels = pass.view.viewport.pixels();
    let mut walk = Walk::new(pass, D::REVERSED, slots);
    // What is kept and counted of the triangles that wholly found room.
    let (mut kept, mut counted, mut next) = (0, Stats::default(), 0);
    for triangle in pass.triangles {
        let (mut wanted, mut stats) = (kept, counted);
        walk.triangle(*triangle, &mut stats, |vertices, stats| {
            match Rows::of(vertices, pass.cull, &pixels) {
                Ok(rows) => {
                    if let Some(place) = room.get_mut(wanted) {
                        *place = ScreenTriangle(Some(Kept { vertices: vertices.map(|v| *v), rows }));
                    }
                    wanted += 1;
                }
                Err(outcome) => stats.rasterized(outcome),
            }
        });
        if wanted > room.len() {
            break;
        }
        (kept, counted, next) = (wanted, stats, next + 1);
    }
    counted.repeat(counters);
    let (kept, rest) = room.split_at_mut_checked(kept).unwrap_or_default();
    (Prepared { pass, kept, next, depth: PhantomData }, rest)
}

/// What [`prepare`] makes of a [`Pass`].
type PreparedPass<'a, 'm, D, S, T, I, Vs, Fs, P, Pr> =
    Prepared<'a, D, S, <Vs as VertexStage<T>>::Varying, Pass<'m, T, I, Vs, Fs, P, Pr>>;

impl<D, S, T, I, Vs, Fs, P, Pr> PreparedPass<'_, '_, D, S, T, I, Vs, Fs, P, Pr>
where
    D: DepthFormat,
    S: Subpixel,
    I: Copy + Into<u32>,
    Vs: VertexStage<T>,
    Fs: FragmentStage<Vs::Varying>,
    P: Interpolation,
    Pr: Projection,
{
    /// Draws into a band of the frame what [`draw`](crate::draw) would, in the same order and with the same pixels.
    ///
    /// `slots` are for the triangles that found no room; if there are none of these, no slots are touched. Of a kept
    /// triangle, `counters` hear what the rasterizer does with it, if it has rows in the band, and nothing otherwise:
    /// one that is drawn in three bands is submitted once and drawn three times.
    pub fn draw<C, K>(&self, band: &mut Band<'_, C, D>, slots: &mut [Slot<S, Vs::Varying>], counters: &mut K)
    where
        C: Store<Fs::Color>,
        K: Counters,
    {
        if let Some(machine) = Machine::all().next() {
            for_lanes!(machine, lanes => self.draw_by(lanes, band, slots, counters));
        }
    }

    /// [`draw`](Self::draw) with as many samples at a time as there are `lanes`.
    pub fn draw_by<L, C, K>(
        &self,
        lanes: L,
        band: &mut Band<'_, C, D>,
        slots: &mut [Slot<S, Vs::Varying>],
        counters: &mut K,
    ) where
        L: Floating,
        C: Store<Fs::Color>,
        K: Counters,
    {
        let [columns, rows] = self.pass.view.viewport.pixels();
        let top = rows.start;
        let mut visible = band.scissor(columns, rows);
        let [_, rows] = visible.limits();
        let rows = rows.start - top..rows.end - top;
        for ScreenTriangle(triangle) in self.kept {
            if let Some(Kept { vertices, rows: its }) = triangle
                && its.meet(&rows)
            {
                rasterize(lanes, self.pass, &mut visible, vertices.each_ref(), counters);
            }
        }
        if self.remaining() > 0 {
            draw_from(self.next, lanes, self.pass, band, slots, counters);
        }
    }

    /// How many triangles on the screen are kept.
    #[must_use]
    pub fn kept(&self) -> usize {
        self.kept.len()
    }

    /// How many of the mesh's triangles, the last ones, found no room: those that each band has to walk again.
    #[must_use]
    pub fn remaining(&self) -> usize {
        self.pass.triangles.len() - self.next
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
    fn of<S: Subpixel, V>(
        vertices: [&Vertex<S, V>; 3],
        cull: Cull,
        [columns, rows]: &[Range<i32>; 2],
    ) -> Result<Self, Outcome> {
        let [_, covered] = reach(vertices, cull, [columns.clone(), rows.clone()])?;
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
    use alberti_math::{Fixed, Sub4, Sub8};

    #[test]
    fn a_triangle_takes_the_room_that_is_documented() {
        assert_eq!(size_of::<ScreenTriangle<Sub8, Vec2>>(), 76);
        assert_eq!(size_of::<ScreenTriangle<Sub4, ()>>(), 3 * 16 + 4);
    }

    #[test]
    fn rows_are_those_whose_samples_lie_between_the_vertices() {
        let rows = |corners: [[i32; 2]; 3], cull| {
            let vertices = corners.map(|p| {
                let [x, y] = p.map(|c| Fixed::<Sub4>::from_subpixels(c).expect("near the origin"));
                Vertex { x, y, zs: 0.5, q: 1.0, varying: () }
            });
            let rows = Rows::of(vertices.each_ref(), cull, &[0..10, 100..110])?;
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
