//! The journey of a triangle: [`draw`] for the plain case, [`Pass`] for all choices.
//!
//! A pass connects the two halves of the pipeline. The geometry half takes a mesh, a view and the grid of snapped
//! positions, and makes triangles on the screen. The paint half takes these, a fragment stage and an interpolation,
//! and makes pixels of a [`Target`].

use crate::geometry::Geometry;
use crate::integers::IntegerScreen;
use crate::prepared::{Prepared, Room, sampled};
use crate::profile::Profile;
use crate::screen::{Screen, Sides};
use crate::stats::Stats;
use crate::vertex::Slot;
use crate::view::View;
use crate::walk::Walk;
use alberti_math::lanes::{Floating, Machine, One};
use alberti_math::{Frame, Object, Sub8, Subpixel, World, for_lanes};
use alberti_projection::{Perspective, Projection, Viewport};
use alberti_raster::{
    Bands, ColorFormat, Corner, Counters, Cull, DepthFormat, Exact, FragmentStage, Interpolation, Numbers,
    Paint, Target,
};
use core::fmt;

/// Draws a mesh into a target, triangles in order: back faces are left out, everything else is exact. A [`Pass`] has
/// more to choose. The target is to be [cleared](Target::clear) before the first mesh: depths of 0 are the nearest.
pub fn draw<C, D, Pr, M, F>(target: &mut Target<'_, C, D>, view: &View<Pr>, mesh: &M, stage: F)
where
    C: ColorFormat,
    D: DepthFormat,
    Pr: Projection,
    M: Geometry,
    F: FragmentStage<M::Varying>,
{
    Pass::new(view, mesh, stage).draw(target);
}

/// One mesh drawn in one way: [`new`](Self::new) and [`draw`](Self::draw), with as many choices between the two as
/// differ from the defaults.
///
/// Vertices that are not finite, or larger than `f32::MAX`/16 in eye space, drop their triangles, and so do those that
/// carry NaN or an infinity. The pixels do not depend on the slots, on counting, or on the division of the frame into
/// bands; nor, but for [`Flat`](alberti_math::Flat) components, on the vertex that comes first.
pub struct Pass<'a, M: Geometry, F, P = Exact, Pr = Perspective> {
    view: &'a View<Pr>,
    mesh: &'a M,
    frame: Option<Frame<Object, World>>,
    viewport: Option<Viewport>,
    sides: Sides,
    slots: &'a mut [Slot<M::Varying>],
    paint: Paint<F, P>,
}

impl<'a, M: Geometry, F, Pr: Projection> Pass<'a, M, F, Exact, Pr> {
    /// The mesh, where it was made, in a view of the whole target, coloured by `stage`; without back faces, exact, and
    /// snapped to 1/256 pixel.
    #[inline]
    pub fn new(view: &'a View<Pr>, mesh: &'a M, stage: F) -> Self {
        let paint = Paint { stage, interpolation: Exact, subpixel: Sub8, cull: Cull::Back };
        Self { view, mesh, frame: None, viewport: None, sides: Sides::GuardBand, slots: &mut [], paint }
    }
}

impl<'a, M: Geometry, F, P: Interpolation, Pr: Projection> Pass<'a, M, F, P, Pr> {
    /// The object's place in the world, its axes and its scale.
    ///
    /// ```
    /// use alberti::glam::{Mat3, Vec3};
    /// use alberti::{Frame, Point3};
    ///
    /// // Turned about y, twice as large, and moved.
    /// let frame = Frame::from_mat3(Mat3::from_rotation_y(0.5) * 2.0, Point3::new(Vec3::new(1.0, 0.0, -3.0)));
    /// # use alberti::shaders::Solid;
    /// # use alberti::{Camera, Mesh, Pass, Rgba8};
    /// # let view = Camera::look_at(Vec3::Z, Vec3::ZERO, Vec3::Y)?.perspective(1.0, 0.1..10.0)?;
    /// # let (vertices, triangles): ([Vec3; 3], [[u16; 3]; 1]) = ([Vec3::ZERO; 3], [[0, 1, 2]]);
    /// # let mesh = Mesh::new(&vertices, &triangles, |&v| (v, ()));
    /// let pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE)).at(frame);
    /// # Ok::<(), alberti::ViewError>(())
    /// ```
    #[must_use]
    #[inline]
    pub fn at(self, frame: Frame<Object, World>) -> Self {
        Self { frame: Some(frame), ..self }
    }

    /// The rectangle of the frame in which the view appears, instead of all of it. It may reach out of the frame, where
    /// nothing is drawn.
    #[must_use]
    #[inline]
    pub fn viewport(self, viewport: Viewport) -> Self {
        Self { viewport: Some(viewport), ..self }
    }

    /// The faces that are left out, instead of the back ones.
    #[must_use]
    #[inline]
    pub fn cull(mut self, cull: Cull) -> Self {
        self.paint.cull = cull;
        self
    }

    /// The clip at the sides of the view, instead of that at the guard band.
    #[must_use]
    #[inline]
    pub fn sides(self, sides: Sides) -> Self {
        Self { sides, ..self }
    }

    /// The interpolation and the subpixels of a [`Profile`]; the formats are the target's.
    #[must_use]
    #[inline]
    pub fn with<Q: Interpolation, C, D>(self, profile: Profile<Q, C, D>) -> Pass<'a, M, F, Q, Pr> {
        self.interpolation(profile.interpolation).subpixel(profile.subpixel)
    }

    /// The way of the attributes from the vertices to the pixels, instead of [`Exact`].
    #[must_use]
    #[inline]
    pub fn interpolation<Q: Interpolation>(self, interpolation: Q) -> Pass<'a, M, F, Q, Pr> {
        let Self { view, mesh, frame, viewport, sides, slots, paint } = self;
        let Paint { stage, subpixel, cull, .. } = paint;
        let paint = Paint { stage, interpolation, subpixel, cull };
        Pass { view, mesh, frame, viewport, sides, slots, paint }
    }

    /// The grid to which vertices are snapped, instead of [`Sub8`].
    #[must_use]
    #[inline]
    pub fn subpixel(mut self, subpixel: Subpixel) -> Self {
        self.paint.subpixel = subpixel;
        self
    }

    /// Room for transformed vertices: with as many slots as vertices each is transformed once; with fewer they are a
    /// cache. Without any, a cache on the stack is used: of 16, or with several lanes of 256.
    #[must_use]
    #[inline]
    pub fn slots(self, slots: &'a mut [Slot<M::Varying>]) -> Self {
        Self { slots, ..self }
    }

    /// Draws into a target, triangles in order.
    ///
    /// With the feature `simd` it works on eight samples at a time, or sixteen in long rows; in WebAssembly on four. It
    /// takes the widest vector registers that the machine turns out to have (with `std`) or is known to have. The
    /// pixels are those of [`draw_by`](Self::draw_by) one sample at a time.
    pub fn draw<C: ColorFormat, D: DepthFormat>(&mut self, target: &mut Target<'_, C, D>)
    where
        F: FragmentStage<M::Varying>,
    {
        self.draw_widest(target, &mut ());
    }

    /// [`draw`](Self::draw), and counts of the events on the way.
    pub fn draw_counted<C: ColorFormat, D: DepthFormat>(&mut self, target: &mut Target<'_, C, D>) -> Stats
    where
        F: FragmentStage<M::Varying>,
    {
        let mut stats = Stats::default();
        self.draw_widest(target, &mut stats);
        stats
    }

    fn draw_widest<C: ColorFormat, D: DepthFormat, K: Counters>(
        &mut self,
        target: &mut Target<'_, C, D>,
        counters: &mut K,
    ) where
        F: FragmentStage<M::Varying>,
    {
        // The first is the widest, and there always is one.
        if let Some(machine) = Machine::all().next() {
            for_lanes!(machine, lanes => self.count_by(lanes, target, counters));
        }
    }

    /// [`draw`](Self::draw) with as many samples at a time as there are `lanes`.
    pub fn draw_by<L: Floating, C: ColorFormat, D: DepthFormat>(
        &mut self,
        lanes: L,
        target: &mut Target<'_, C, D>,
    ) where
        F: FragmentStage<M::Varying>,
    {
        self.count_by(lanes, target, &mut ());
    }

    /// [`draw_by`](Self::draw_by), of which `counters` hear. There `()` costs nothing.
    pub fn count_by<L: Floating, C: ColorFormat, D: DepthFormat, K: Counters>(
        &mut self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        counters: &mut K,
    ) where
        F: FragmentStage<M::Varying>,
    {
        let Some(screen) = self.screen(target.size(), target.depth_format()) else { return };
        let (mesh, paint) = (self.mesh, &self.paint);
        let (mut few, mut more);
        let slots = if !self.slots.is_empty() {
            &mut *self.slots
        } else if const { L::COUNT == 1 } {
            few = [Slot::EMPTY; 16];
            &mut few[..]
        } else {
            more = [Slot::EMPTY; 256];
            &mut more[..]
        };
        let [columns, rows] = screen.viewport.pixels();
        let mut visible = target.scissor(columns, rows);
        let mut batch = paint.batch(lanes, &mut visible);
        let mut walk = Walk::new(lanes, mesh, &screen, slots);
        for part in walk.seen(paint.cull, 0..usize::MAX) {
            walk.ready(&part);
            walk.triangles::<false, _>(part, counters, &mut batch);
        }
        batch.finish(counters);
    }

    /// Does once, for all bands of a frame, the geometry half of [`draw`](Self::draw), and lists the triangles to be
    /// drawn, as far as there is `room`. Returns with the list the room that is left, for the next pass.
    ///
    /// Triangles that could never be drawn take no room: those of the facing that is left out, those outside the view,
    /// and those whose box holds no sample. The mesh's triangles are listed in order, up to the first that finds no
    /// room; without any, [`Prepared::draw`] is [`draw`](Self::draw). The pixels never depend on the room.
    ///
    /// ```
    /// use alberti::{glam::Vec3, *};
    ///
    /// // Two triangles that pass through each other, in a frame of 32 x 24 pixels.
    /// let vertices = [-0.9, 0.9].map(|x| [(x, -0.8, 0.5), (-x, -0.8, -0.5), (0.0, 0.8, 0.0)]);
    /// let mesh = Mesh::new(vertices.as_flattened(), &[[0u16, 1, 2], [3, 4, 5]], |&(x, y, z)| {
    ///     (Vec3::new(x, y, z), z)
    /// });
    /// let stage = |z: f32| Some(Rgba8::from_rgb24(if z < 0.0 { 0xff_c0_40 } else { 0x20_60_a0 }));
    /// let view = Camera::look_at(Vec3::Z * 2.0, Vec3::ZERO, Vec3::Y)?.perspective(1.0, 0.1..10.0)?;
    /// let mut slots = [Slot::EMPTY; 6];
    /// let mut pass = Pass::new(&view, &mesh, stage).cull(Cull::None).slots(&mut slots);
    ///
    /// let (mut color, mut depth) = ([0; 32 * 8], [0; 32 * 8]);
    /// let mut bands = Bands::new(Rgb565Be, D16, 32, 24, &mut color, &mut depth)?;
    /// let mut room = [PreparedTriangle::EMPTY; 4];
    /// let (mut prepared, rest) = pass.prepare(&bands, &mut room);
    /// assert_eq!((prepared.listed(), prepared.remaining(), rest.len()), (2, 0, 2));
    ///
    /// // Three bands, one after the other in the same eight rows of memory.
    /// let mut frame = Vec::new();
    /// bands.draw(Rgba8::BLACK, |band| {
    ///     prepared.draw(band);
    ///     frame.extend_from_slice(band.pixels());
    /// });
    ///
    /// // The same into memory for a whole frame of colours, but for no more depths.
    /// let mut whole = [0; 32 * 24];
    /// let mut bands = Bands::new(Rgb565Be, D16, 32, 24, &mut whole, &mut depth)?;
    /// bands.draw(Rgba8::BLACK, |band| prepared.draw(band));
    ///
    /// // The same as all rows at once.
    /// let (mut color, mut depth) = ([0; 32 * 24], [0; 32 * 24]);
    /// let mut target = Target::new(Rgb565Be, D16, 32, 24, &mut color, &mut depth)?;
    /// target.clear(Rgba8::BLACK);
    /// pass.draw(&mut target);
    /// assert!(frame == color && whole == color && frame.iter().any(|&pixel| pixel != 0));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Cost
    /// That of `draw` without the rasterizer, which a frame of one band does not get back. In return a band costs its
    /// fragments, the setup of the triangles that are in it, and a comparison for each of the others. With fewer
    /// [`slots`](Self::slots) than vertices, it also costs the vertices of those that are in it; clipped triangles are
    /// clipped again.
    pub fn prepare<'p, C: ColorFormat, D: DepthFormat>(
        &'p mut self,
        bands: &Bands<'_, C, D>,
        room: Room<'p>,
    ) -> (Prepared<'p, 'a, M, F, P, Pr, D>, Room<'p>) {
        Prepared::new(self, bands.size(), bands.depth_format(), (room, false), sampled, &mut ())
    }

    /// [`prepare`](Self::prepare) for frames of this size, whose bands have this depth format.
    ///
    /// `counters` hear, once, which triangles are submitted, dropped, clipped, and not listed for facing the wrong way
    /// or missing all samples, up to the first that finds no room. The others are counted by each
    /// [`Prepared::count_by`]. Together they count, for a band with all rows of the viewport, the same as
    /// [`draw_by`](Self::draw_by).
    pub fn count_prepare<'p, D: DepthFormat>(
        &'p mut self,
        size: [u32; 2],
        depth: D,
        room: Room<'p>,
        counters: &mut impl Counters,
    ) -> (Prepared<'p, 'a, M, F, P, Pr, D>, Room<'p>) {
        Prepared::new(self, size, depth, (room, false), sampled, counters)
    }

    /// [`count_prepare`](Self::count_prepare) that lists triangles between samples too, so that
    /// [`Prepared::cover`] and [`Prepared::draw_fringe`] need no others. Those take room as well.
    pub fn prepare_smooth<'p, D: DepthFormat>(
        &'p mut self,
        size: [u32; 2],
        depth: D,
        room: Room<'p>,
        counters: &mut impl Counters,
    ) -> (Prepared<'p, 'a, M, F, P, Pr, D>, Room<'p>) {
        Prepared::new(self, size, depth, (room, true), Paint::touched, counters)
    }

    /// The triangles on the screen that one of the mesh's is drawn as, in a frame of this size with depths of this
    /// format. `sink` gets it alone, the parts that clipping has left, or none of one outside the view. Which way they
    /// face is not asked.
    pub fn on_screen<D: DepthFormat>(
        &self,
        size: [u32; 2],
        depth: D,
        triangle: usize,
        sink: impl FnMut([&Corner<M::Varying>; 3]),
    ) {
        let (Some(screen), Some(indices)) = (self.screen(size, depth), self.mesh.triangle(triangle)) else {
            return;
        };
        let mut slots = [Slot::EMPTY; 16];
        let _fate = Walk::new(One, self.mesh, &screen, &mut slots).triangle(indices, sink);
    }

    /// The way to the screen of a frame of this size; `None` if it has no pixels.
    #[inline]
    pub(crate) fn screen(&self, [width, height]: [u32; 2], depth: impl DepthFormat) -> Option<Screen<Pr>> {
        let viewport = match self.viewport {
            Some(viewport) => viewport,
            None => Viewport::new(0, 0, width, height).ok()?,
        };
        let (projection, guard) = (self.view.projection(&viewport), viewport.guard());
        let to_eye = self.view.object_to_eye(self.frame.as_ref());
        let (subpixel, numbers) = (self.paint.subpixel, self.paint.numbers(depth));
        // A constant block, so that other meshes have none of this in their programs.
        let integers = match numbers {
            Numbers::Fixed { depth_bits } if const { M::INTEGERS } => IntegerScreen::new(
                (&to_eye, self.mesh.unit()),
                &projection,
                (&viewport, subpixel, self.sides),
                (depth_bits, depth.reversed()),
            ),
            _ => None,
        };
        Some(Screen {
            to_eye,
            projection,
            viewport,
            depth: projection.depth_map(depth.reversed()),
            guard,
            within: Screen::depths_within(&projection, guard),
            sides: self.sides,
            subpixel,
            numbers,
            integers,
        })
    }

    /// The mesh.
    pub(crate) fn mesh(&self) -> &'a M {
        self.mesh
    }

    /// The slots of the geometry half, and the paint half.
    #[inline]
    pub(crate) fn halves(&mut self) -> (&mut &'a mut [Slot<M::Varying>], &Paint<F, P>) {
        (&mut self.slots, &self.paint)
    }
}

impl<M: Geometry, F, P: fmt::Debug, Pr: fmt::Debug> fmt::Debug for Pass<'_, M, F, P, Pr> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Pass")
            .field("view", &self.view)
            .field("viewport", &self.viewport)
            .field("sides", &self.sides)
            .field("slots", &self.slots.len())
            .field("cull", &self.paint.cull)
            .field("interpolation", &self.paint.interpolation)
            .field("subpixel", &self.paint.subpixel)
            .finish_non_exhaustive()
    }
}
