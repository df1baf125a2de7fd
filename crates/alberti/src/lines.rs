//! Lines between vertices, and vertices as points: wireframes, graphs, stars.

use crate::geometry::Geometry;
use crate::pipeline::Pass;
use crate::vertex::Slot;
use crate::walk::Walk;
use alberti_math::lanes::One;
use alberti_projection::Projection;
use alberti_raster::{ColorFormat, Counters, DepthFormat, FragmentStage, Interpolation, Target};

impl<'a, M: Geometry, F, P: Interpolation, Pr: Projection> Pass<'a, M, F, P, Pr> {
    /// Draws lines between vertices of the mesh, which pairs of indices name, a pixel wide: those of
    /// [`edges`](Geometry::edges) for a wireframe. What it needs of the pass is all but the faces that are left out.
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
    /// # Cost
    /// That of [`Paint::line`](alberti_raster::Paint::line), and of the vertices, as for triangles.
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
        self.with_walk(target, |walk, paint, target| {
            for line in lines {
                let fate = walk.line(line, |ends| paint.line(target, ends, counters));
                fate.count(counters);
            }
        });
    }

    /// Draws vertices of the mesh as squares of `size` pixels a side, those within the near and the far plane whose
    /// middle is not far outside of the view.
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
            for vertex in vertices {
                let _fate = walk.line([vertex; 2], |[corner, _]| paint.point(target, corner, size, counters));
            }
        });
    }

    /// Calls `draw` with the way to the screen, and the part of the target that shows the view.
    fn with_walk<C: ColorFormat, D: DepthFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        draw: impl FnOnce(&mut Walk<'_, M, Pr>, &alberti_raster::Paint<F, P>, &mut Target<'_, C, D>),
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
