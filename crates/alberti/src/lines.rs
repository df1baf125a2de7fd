//! Lines between vertices, and vertices as points: wireframes, graphs, stars.

use crate::geometry::Geometry;
use crate::pipeline::Pass;
use crate::prepared::Prepared;
use crate::vertex::Slot;
use crate::walk::Walk;
use alberti_math::lanes::One;
use alberti_projection::Projection;
use alberti_raster::{ColorFormat, Counters, DepthFormat, FragmentStage, Interpolation, Paint, Target};

impl<'a, M: Geometry, F, P: Interpolation, Pr: Projection> Pass<'a, M, F, P, Pr> {
    /// Draws lines between vertices of the mesh, which pairs of indices name, a pixel wide: those of
    /// [`edges`](Geometry::edges) for a wireframe, or each once of [`unique_edges`](Geometry::unique_edges). What it
    /// needs of the pass is all but the faces that are left out.
    ///
    /// Lines are cut at the planes as triangles are, in the same points. For a wireframe on a surface draw the surface
    /// first, and the lines in a target with a bias: `target.with_depth(Biased { .. })`.
    ///
    /// ```
    /// use alberti::{glam::Vec3, shaders::Solid, *};
    ///
    /// let vertices = [Vec3::new(-1.0, -0.8, 0.0), Vec3::new(1.0, -0.8, 0.0), Vec3::new(0.0, 0.8, 0.0)];
    /// let mesh = Mesh::new(&vertices, &[[0u16, 1, 2]], |&v| (v, ()));
    /// let view = Camera::look_at(Vec3::Z * 3.0, Vec3::ZERO, Vec3::Y)?.perspective(1.0, 0.1..10.0)?;
    /// let (mut color, mut depth) = ([0; 64 * 48], [(); 64 * 48]);
    /// let mut target = Target::new(Rgba8888, NoDepth, 64, 48, &mut color, &mut depth)?;
    /// let mut pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE));
    /// pass.draw_lines(&mut target, mesh.edges());
    /// pass.draw_points(&mut target, 0..3, 3);
    /// assert!(color.iter().filter(|pixel| **pixel != 0).count() > 80);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Precision
    /// Pixels are exactly those of the diamond-exit rule; depth and attributes have the bounds of
    /// [`Paint::line`].
    ///
    /// # Cost
    /// That of [`Paint::line`], and of the vertices, as for triangles. A line that is not in the target costs its
    /// vertices and a few comparisons. Bands that draw from a [`Prepared`] do not transform vertices again.
    pub fn draw_lines<C: ColorFormat, D: DepthFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        lines: impl IntoIterator<Item = [usize; 2]>,
    ) where
        F: FragmentStage<M::Varying>,
    {
        self.count_lines(target, lines, &mut ());
    }

    /// [`draw_lines`](Self::draw_lines), of which `counters` hear.
    pub fn count_lines<C: ColorFormat, D: DepthFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        lines: impl IntoIterator<Item = [usize; 2]>,
        counters: &mut impl Counters,
    ) where
        F: FragmentStage<M::Varying>,
    {
        self.with_walk(target, |walk, paint, target| draw_lines(walk, paint, target, lines, counters));
    }

    /// Draws vertices of the mesh as squares of `size` pixels a side, those within the near and the far plane whose
    /// middle is not far outside of the view.
    ///
    /// # Precision
    /// That of [`Paint::point`]: all is exact.
    ///
    /// # Cost
    /// That of [`Paint::point`], and of the vertices. A point that is not in the target costs its vertex and a few
    /// comparisons.
    pub fn draw_points<C: ColorFormat, D: DepthFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        vertices: impl IntoIterator<Item = usize>,
        size: u16,
    ) where
        F: FragmentStage<M::Varying>,
    {
        self.count_points(target, vertices, size, &mut ());
    }

    /// [`draw_points`](Self::draw_points), of whose pixels `counters` hear.
    pub fn count_points<C: ColorFormat, D: DepthFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        vertices: impl IntoIterator<Item = usize>,
        size: u16,
        counters: &mut impl Counters,
    ) where
        F: FragmentStage<M::Varying>,
    {
        self.with_walk(target, |walk, paint, target| {
            draw_points(walk, paint, target, (vertices, size), counters);
        });
    }

    /// Calls `draw` with the way to the screen, and the part of the target that shows the view.
    fn with_walk<C: ColorFormat, D: DepthFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        draw: impl FnOnce(&mut Walk<'_, M, Pr>, &Paint<F, P>, &mut Target<'_, C, D>),
    ) {
        let Some(screen) = self.screen(target.size(), target.depth_format()) else { return };
        let mesh = self.mesh();
        let (slots, paint) = self.halves();
        let mut few = [Slot::EMPTY; 16];
        let slots = if slots.is_empty() { &mut few[..] } else { &mut **slots };
        let [columns, rows] = screen.viewport.pixels();
        let mut visible = target.scissor(columns, rows);
        draw(&mut Walk::new(One, mesh, &screen, slots), paint, &mut visible);
    }
}

impl<M, F, P, Pr, D> Prepared<'_, '_, M, F, P, Pr, D>
where
    M: Geometry,
    P: Interpolation,
    Pr: Projection,
    D: DepthFormat,
{
    /// Draws lines into a band of the frame: [`Pass::draw_lines`] with the same pixels, from vertices that have been
    /// transformed once for all bands. It needs no room in the list of triangles.
    ///
    /// ```
    /// use alberti::{glam::Vec3, shaders::Solid, *};
    ///
    /// let vertices = [Vec3::new(-1.0, -0.8, 0.0), Vec3::new(1.0, -0.8, 0.0), Vec3::new(0.0, 0.8, 0.0)];
    /// let mesh = Mesh::new(&vertices, &[[0u16, 1, 2]], |&v| (v, ()));
    /// let view = Camera::look_at(Vec3::Z * 3.0, Vec3::ZERO, Vec3::Y)?.perspective(1.0, 0.1..10.0)?;
    /// let mut slots = [Slot::EMPTY; 3];
    /// let mut pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE)).slots(&mut slots);
    ///
    /// let (mut color, mut depth) = ([0; 64 * 48], [0; 64 * 8]);
    /// let mut bands = Bands::new(Rgba8888, D16, 64, 48, &mut color, &mut depth)?;
    /// let (mut prepared, _) = pass.prepare(&bands, &mut []);
    /// bands.draw(Rgba8::BLACK, |band| prepared.draw_lines(band, mesh.edges()));
    /// assert!(color.iter().filter(|&&pixel| pixel == u32::MAX).count() > 70);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Cost
    /// For each line in the band that of [`Paint::line`]; for each other two slots that are read, and two to four
    /// comparisons. Lines that cross the near, the far plane or the guard band are cut in each band anew. With fewer
    /// [`slots`](Pass::slots) than vertices, vertices are transformed in each band.
    pub fn draw_lines<C: ColorFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        lines: impl IntoIterator<Item = [usize; 2]>,
    ) where
        F: FragmentStage<M::Varying>,
    {
        self.count_lines(target, lines, &mut ());
    }

    /// [`draw_lines`](Self::draw_lines), of which `counters` hear: in each band of all lines.
    pub fn count_lines<C: ColorFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        lines: impl IntoIterator<Item = [usize; 2]>,
        counters: &mut impl Counters,
    ) where
        F: FragmentStage<M::Varying>,
    {
        if !self.has_depths_of(target) {
            return self.anew(|pass| pass.count_lines(target, lines, counters));
        }
        self.with_walk(target, |walk, paint, target| draw_lines(walk, paint, target, lines, counters));
    }

    /// Draws points into a band of the frame: [`Pass::draw_points`] as [`draw_lines`](Self::draw_lines).
    ///
    /// # Cost
    /// For each point in the band that of [`Paint::point`]; for each other a slot that is read, and a few comparisons.
    pub fn draw_points<C: ColorFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        vertices: impl IntoIterator<Item = usize>,
        size: u16,
    ) where
        F: FragmentStage<M::Varying>,
    {
        self.count_points(target, vertices, size, &mut ());
    }

    /// [`draw_points`](Self::draw_points), of whose pixels `counters` hear.
    pub fn count_points<C: ColorFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        vertices: impl IntoIterator<Item = usize>,
        size: u16,
        counters: &mut impl Counters,
    ) where
        F: FragmentStage<M::Varying>,
    {
        if !self.has_depths_of(target) {
            return self.anew(|pass| pass.count_points(target, vertices, size, counters));
        }
        self.with_walk(target, |walk, paint, target| {
            draw_points(walk, paint, target, (vertices, size), counters);
        });
    }

    /// Calls `draw` with the way to the screen, and the part of the band that shows the view, if there is any.
    fn with_walk<C: ColorFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        draw: impl FnOnce(&mut Walk<'_, M, Pr>, &Paint<F, P>, &mut Target<'_, C, D>),
    ) {
        let Some((mut walk, paint)) = self.any_walk() else { return };
        let [columns, rows] = walk.pixels();
        let mut visible = target.scissor(columns, rows);
        if !visible.limits()[1].is_empty() {
            draw(&mut walk, paint, &mut visible);
        }
    }
}

/// Draws lines between vertices of a walk.
fn draw_lines<M: Geometry, F, P: Interpolation, Pr: Projection>(
    walk: &mut Walk<'_, M, Pr>,
    paint: &Paint<F, P>,
    target: &mut Target<'_, impl ColorFormat, impl DepthFormat>,
    lines: impl IntoIterator<Item = [usize; 2]>,
    counters: &mut impl Counters,
) where
    F: FragmentStage<M::Varying>,
{
    // A closure, since iterators of several levels are faster from within.
    lines.into_iter().for_each(|line| {
        let fate = walk.line(line, |ends| paint.line(target, ends, counters));
        fate.count(counters);
    });
}

/// Draws vertices of a walk as points.
fn draw_points<M: Geometry, F, P: Interpolation, Pr: Projection>(
    walk: &mut Walk<'_, M, Pr>,
    paint: &Paint<F, P>,
    target: &mut Target<'_, impl ColorFormat, impl DepthFormat>,
    (vertices, size): (impl IntoIterator<Item = usize>, u16),
    counters: &mut impl Counters,
) where
    F: FragmentStage<M::Varying>,
{
    vertices.into_iter().for_each(|vertex| {
        let _fate = walk.line([vertex; 2], |[corner, _]| paint.point(target, corner, size, counters));
    });
}
