//! Smooth silhouettes over a known background: the edges of a mesh, and the pixels beside those it has drawn.

use crate::geometry::Geometry;
use crate::pipeline::Pass;
use crate::screen::Screen;
use crate::vertex::Slot;
use crate::walk::Walk;
use alberti_math::for_lanes;
use alberti_math::lanes::Machine;
use alberti_projection::Projection;
use alberti_raster::{
    ColorFormat, Corner, Counters, Coverage, DepthFormat, FragmentStage, Interpolation, NoDepth, Paint,
    Silhouette, Target,
};

impl<'a, M: Geometry, F, P: Interpolation, Pr: Projection> Pass<'a, M, F, P, Pr> {
    /// Adds the edges of the mesh to a silhouette, those of the faces that the pass draws. Of a closed mesh these are
    /// one side only, as they are by default.
    ///
    /// All meshes that are to have smooth edges are drawn first. Then all cover one silhouette. When it is summed, each
    /// draws its [fringe](Self::draw_fringe), and the target is mixed with its background. Each band does that for
    /// itself, with the words of one band. What [`prepare_smooth`](Self::prepare_smooth) lists saves it most of the
    /// work.
    ///
    /// ```
    /// use alberti::raster::color::Average;
    /// use alberti::{glam::Vec3, shaders::Solid, *};
    ///
    /// let vertices = [Vec3::new(-1.0, -0.8, 0.0), Vec3::new(1.0, -0.8, 0.0), Vec3::new(0.0, 0.8, 0.0)];
    /// let mesh = Mesh::new(&vertices, &[[0u16, 1, 2]], |&v| (v, ()));
    /// let view = Camera::look_at(Vec3::Z * 3.0, Vec3::ZERO, Vec3::Y)?.perspective(1.0, 0.1..10.0)?;
    /// let (mut color, mut depth, mut cells) = ([0; 64 * 8], [0; 64 * 8], [0; 64 * 8]);
    /// let mut bands = Bands::new(Rgb565Le, D16, 64, 48, &mut color, &mut depth)?;
    /// let mut smooth = 0;
    /// while let Some(mut band) = bands.next_band() {
    ///     band.clear(Rgba8::BLACK);
    ///     let mut pass = Pass::new(&view, &mesh, Solid(Rgba8::WHITE));
    ///     pass.draw(&mut band);
    ///     let mut silhouette = Silhouette::new(&band, &mut cells)?;
    ///     pass.cover(&mut silhouette);
    ///     let coverage = silhouette.coverage();
    ///     pass.draw_fringe(&mut band, &coverage);
    ///     coverage.resolve(&mut band, Average::Light, |_| Rgba8::BLACK);
    ///     smooth += band.pixels().iter().filter(|&&pixel| pixel != 0 && pixel != 0xffff).count();
    /// }
    /// assert!(smooth > 60);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Precision
    /// That of [`Silhouette`]: areas of the snapped triangles that are drawn.
    ///
    /// # Cost
    /// That of the vertices, as for triangles, and of [`Silhouette`], as is that of the fringe.
    pub fn cover(&mut self, silhouette: &mut Silhouette<'_>) {
        let Some(screen) = self.screen(silhouette.size(), NoDepth) else { return };
        let [columns, rows] = screen.viewport.pixels();
        let mut visible = silhouette.scissor(columns, rows);
        let mut edges = self.halves().1.edges(&mut visible);
        self.each_on_screen(screen, |_, corners| edges.triangle(corners));
        edges.finish();
    }

    /// Draws the pixels on edges of the mesh that are covered in part, but not at their centre. They have the
    /// attributes and the depth of the edge, see [`Paint::fringe`]. It is for after all meshes are drawn.
    pub fn draw_fringe<C: ColorFormat, D: DepthFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        coverage: &Coverage<'_>,
    ) where
        F: FragmentStage<M::Varying>,
    {
        self.count_fringe(target, coverage, &mut ());
    }

    /// [`draw_fringe`](Self::draw_fringe), of whose pixels `counters` hear, each as of a triangle.
    pub fn count_fringe<C: ColorFormat, D: DepthFormat>(
        &mut self,
        target: &mut Target<'_, C, D>,
        coverage: &Coverage<'_>,
        counters: &mut impl Counters,
    ) where
        F: FragmentStage<M::Varying>,
    {
        let Some(screen) = self.screen(target.size(), target.depth_format()) else { return };
        let [columns, rows] = screen.viewport.pixels();
        let mut visible = target.scissor(columns, rows);
        self.each_on_screen(screen, |paint, corners| {
            paint.fringe(&mut visible, coverage, corners, counters);
        });
    }

    /// Hands `sink` all triangles on the screen, in order, of which something may be seen.
    fn each_on_screen(
        &mut self,
        screen: Screen<Pr>,
        mut sink: impl FnMut(&Paint<F, P>, [&Corner<M::Varying>; 3]),
    ) {
        let Some(machine) = Machine::all().next() else { return };
        let mesh = self.mesh();
        let (slots, paint) = self.halves();
        let mut few = [Slot::EMPTY; 16];
        let slots = if slots.is_empty() { &mut few[..] } else { &mut **slots };
        let mut walk = for_lanes!(machine, lanes => Walk::new(lanes, mesh, &screen, slots));
        for part in walk.seen(paint.cull, 0..usize::MAX) {
            walk.ready(&part);
            walk.each(part, |corners| sink(paint, corners));
        }
    }
}
