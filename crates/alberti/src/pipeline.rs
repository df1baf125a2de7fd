//! The journey of a triangle: the view pipeline's steps, in the order in which they are taught.

use crate::vertex::{Slot, Transformed, VertexStage, outside};
use alberti_math::glam::Vec3;
use alberti_math::lanes::{Floating, Machine};
use alberti_math::{Eye, Frame, Object, Subpixel, Varying, flatten, for_lanes};
use alberti_projection::{
    EyeVertex, Perspective, ProjectedVertex, Projection, SideBounds, Viewport, clip_near_far, clip_sides,
};
use alberti_raster::{
    Band, Counters, Cull, DepthFormat, Exact, FragmentStage, Interpolation, Store, Vertex, draw_triangle,
};
use core::cmp::Ordering;

/// From where, through what pyramid or box, and to which rectangle of the target a mesh is seen.
#[derive(Clone, Copy, Debug)]
pub struct View<Pr = Perspective> {
    /// Step 1: from object to eye coordinates. The camera's frame inverted, times the model's frame.
    pub to_eye: Frame<Object, Eye>,
    /// Steps 2 to 4.
    pub projection: Pr,
    /// Step 6.
    pub viewport: Viewport,
}

/// Which clip the sides of the view get.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sides {
    /// Only what reaches beyond the fixed-point range is cut; the rest is left to the rows and columns that are
    /// drawn. Faster, and edges are not moved.
    #[default]
    GuardBand,
    /// The four sides of the cube, -1 <= xs <= 1 and -1 <= ys <= 1.
    Cube,
}

/// One mesh drawn in one way.
#[derive(Clone, Copy, Debug)]
pub struct Pass<'a, T, I, Vs, Fs, P = Exact, Pr = Perspective> {
    /// The view.
    pub view: View<Pr>,
    /// The mesh's vertices, of any type that the vertex stage understands.
    pub vertices: &'a [T],
    /// Three indices a triangle, counter-clockwise seen from the front. One that is out of range drops the triangle.
    pub triangles: &'a [[I; 3]],
    /// From mesh vertex to object-space position and varying.
    pub vertex_stage: Vs,
    /// From varying to colour.
    pub fragment_stage: Fs,
    /// Which faces are left out.
    pub cull: Cull,
    /// Which clip the sides get.
    pub sides: Sides,
    /// How what the vertices carry comes to the samples.
    pub interpolation: P,
}

/// Draws a mesh into a band, triangles in order.
///
/// `slots` keeps transformed vertices, and its element type says how finely positions are snapped: with as many slots
/// as vertices each vertex is transformed once; with fewer they are a cache; with none, a cache of 16 on the stack is
/// used. Vertices that are not finite, or larger than `f32::MAX`/16 in eye space, drop their triangles.
///
/// The pixels do not depend on the slots, on the counters, on which of a triangle's vertices comes first (but for what
/// is [`Flat`](alberti_math::Flat)), or on how the frame is divided into bands. To share the vertex work between bands,
/// see [`prepare`](crate::prepare).
///
/// With the feature `simd` it works on eight samples at a time, in the widest vector registers that the machine turns
/// out to have (with `std`) or is known to have; the pixels are those of [`draw_by`] one sample at a time.
pub fn draw<S, T, I, Vs, Fs, P, Pr, C, D, K>(
    pass: &Pass<'_, T, I, Vs, Fs, P, Pr>,
    band: &mut Band<'_, C, D>,
    slots: &mut [Slot<S, Vs::Varying>],
    counters: &mut K,
) where
    S: Subpixel,
    I: Copy + Into<u32>,
    Vs: VertexStage<T>,
    Fs: FragmentStage<Vs::Varying>,
    P: Interpolation,
    Pr: Projection,
    C: Store<Fs::Color>,
    D: DepthFormat,
    K: Counters,
{
    // The first is the widest, and there always is one.
    if let Some(machine) = Machine::all().next() {
        for_lanes!(machine, lanes => draw_by(lanes, pass, band, slots, counters));
    }
}

/// [`draw`] with as many samples at a time as there are `lanes`.
pub fn draw_by<L, S, T, I, Vs, Fs, P, Pr, C, D, K>(
    lanes: L,
    pass: &Pass<'_, T, I, Vs, Fs, P, Pr>,
    band: &mut Band<'_, C, D>,
    slots: &mut [Slot<S, Vs::Varying>],
    counters: &mut K,
) where
    L: Floating,
    S: Subpixel,
    I: Copy + Into<u32>,
    Vs: VertexStage<T>,
    Fs: FragmentStage<Vs::Varying>,
    P: Interpolation,
    Pr: Projection,
    C: Store<Fs::Color>,
    D: DepthFormat,
    K: Counters,
{
    draw_from(0, lanes, pass, band, slots, counters);
}

/// Draws the pass's triangles from number `first` on.
pub(crate) fn draw_from<L, S, T, I, Vs, Fs, P, Pr, C, D, K>(
    first: usize,
    lanes: L,
    pass: &Pass<'_, T, I, Vs, Fs, P, Pr>,
    band: &mut Band<'_, C, D>,
    slots: &mut [Slot<S, Vs::Varying>],
    counters: &mut K,
) where
    L: Floating,
    S: Subpixel,
    I: Copy + Into<u32>,
    Vs: VertexStage<T>,
    Fs: FragmentStage<Vs::Varying>,
    P: Interpolation,
    Pr: Projection,
    C: Store<Fs::Color>,
    D: DepthFormat,
    K: Counters,
{
    if slots.is_empty() {
        draw_from(first, lanes, pass, band, &mut [Slot::<S, Vs::Varying>::EMPTY; 16], counters);
        return;
    }
    let [columns, rows] = pass.view.viewport.pixels();
    let mut band = band.scissor(columns, rows);
    let mut walk = Walk::new(pass, D::REVERSED, slots);
    for triangle in pass.triangles.get(first..).unwrap_or_default() {
        walk.triangle(*triangle, counters, |vertices, counters| {
            rasterize(lanes, pass, &mut band, vertices, counters);
        });
    }
}

/// Step 7: the rasterizer.
#[inline(always)]
pub(crate) fn rasterize<L, S, T, I, Vs, Fs, P, Pr, C, D, K>(
    lanes: L,
    pass: &Pass<'_, T, I, Vs, Fs, P, Pr>,
    band: &mut Band<'_, C, D>,
    vertices: [&Vertex<S, Vs::Varying>; 3],
    counters: &mut K,
) where
    L: Floating,
    S: Subpixel,
    Vs: VertexStage<T>,
    Fs: FragmentStage<Vs::Varying>,
    P: Interpolation,
    C: Store<Fs::Color>,
    D: DepthFormat,
    K: Counters,
{
    let Pass { interpolation, cull, fragment_stage, .. } = pass;
    let outcome = draw_triangle(*interpolation, lanes, band, vertices, *cull, fragment_stage, counters);
    counters.rasterized(outcome);
}

/// The way of a pass's triangles to the screen: steps 1 to 6.
pub(crate) struct Walk<'a, 'm, S: Subpixel, T, I, Vs: VertexStage<T>, Fs, P, Pr: Projection> {
    pass: &'a Pass<'m, T, I, Vs, Fs, P, Pr>,
    slots: &'a mut [Slot<S, Vs::Varying>],
    depth: Pr::Depth,
    guard: SideBounds,
}

impl<'a, 'm, S, T, I, Vs, Fs, P, Pr> Walk<'a, 'm, S, T, I, Vs, Fs, P, Pr>
where
    S: Subpixel,
    I: Copy + Into<u32>,
    Vs: VertexStage<T>,
    Pr: Projection,
{
    /// `slots`, at least one, lose what they held. `reversed` says whether zs falls with distance.
    #[inline]
    pub(crate) fn new(
        pass: &'a Pass<'m, T, I, Vs, Fs, P, Pr>,
        reversed: bool,
        slots: &'a mut [Slot<S, Vs::Varying>],
    ) -> Self {
        slots.fill(Slot::EMPTY);
        let View { projection, viewport, .. } = &pass.view;
        Self { pass, slots, depth: projection.depth_map(reversed), guard: viewport.guard() }
    }

    /// Hands `sink` what is seen of a triangle on the screen: nothing, the triangle, or the fan that clipping leaves.
    #[inline(always)]
    pub(crate) fn triangle<K: Counters>(
        &mut self,
        triangle: [I; 3],
        counters: &mut K,
        mut sink: impl FnMut([&Vertex<S, Vs::Varying>; 3], &mut K),
    ) {
        let Self { pass, slots, depth, guard } = self;
        counters.submitted();
        // Steps 1, 2, 4 and 6 for each vertex, where it allows them.
        let indices = triangle.map(|i| usize::try_from(i.into()).unwrap_or(usize::MAX));
        let Some(vertices) = vertices(pass, indices) else {
            counters.dropped();
            return;
        };
        let transform = |vertex: &T| {
            let (point, varying) = pass.vertex_stage.shade(vertex);
            Transformed::new(&pass.view, depth, *guard, point, varying)
        };
        let places = [
            Slot::fill(slots, indices[0], || transform(vertices[0])),
            Slot::fill(slots, indices[1], || transform(vertices[1])),
            Slot::fill(slots, indices[2], || transform(vertices[2])),
        ];
        let kept = |k: usize| Slot::at(slots, places[k], indices[k]);
        let afresh;
        let corners = if let (Some(a), Some(b), Some(c)) = (kept(0), kept(1), kept(2)) {
            [a, b, c]
        } else {
            // Two of the three share a slot.
            afresh = vertices.map(transform);
            afresh.each_ref()
        };
        let all = corners[0].outside | corners[1].outside | corners[2].outside;
        let common = corners[0].outside & corners[1].outside & corners[2].outside;
        if all & outside::NOWHERE != 0 || common & (outside::NEAR | outside::FAR | outside::SIDES) != 0 {
            counters.dropped();
            return;
        }
        let sides = if pass.sides == Sides::Cube { outside::SIDES } else { 0 };
        if all & (outside::NEAR | outside::FAR | outside::GUARD | sides) == 0 {
            sink([&corners[0].screen, &corners[1].screen, &corners[2].screen], counters);
        } else {
            counters.clipped();
            clip(&pass.view, pass.sides, depth, corners, |vertices| sink(vertices, counters));
        }
    }
}

/// The triangle's vertices; `None` for an index out of range.
#[inline]
fn vertices<'a, T, I, Vs, Fs, P, Pr>(
    pass: &Pass<'a, T, I, Vs, Fs, P, Pr>,
    indices: [usize; 3],
) -> Option<[&'a T; 3]> {
    let vertex = |index: usize| pass.vertices.get(index);
    Some([vertex(indices[0])?, vertex(indices[1])?, vertex(indices[2])?])
}

/// Steps 3 to 6 for a triangle that crosses a plane.
#[cold]
#[inline(never)]
fn clip<S: Subpixel, V: Varying, Pr: Projection>(
    View { projection, viewport, .. }: &View<Pr>,
    sides: Sides,
    depth: &Pr::Depth,
    corners: [&Transformed<S, V>; 3],
    mut sink: impl FnMut([&Vertex<S, V>; 3]),
) {
    let first = corners[0].screen.varying;
    let triangle = canonical(corners.map(|c| {
        let varying = flatten(first, c.screen.varying);
        EyeVertex { position: c.position, varying }
    }));
    // 3. What lies between the near and the far plane.
    let between = clip_near_far(triangle, projection.near(), projection.far());
    // 4. Perspective with depth.
    let projected = between.map(|v| projection.project(depth, &v));
    if !projected.vertices().iter().all(finite) {
        return;
    }
    // 5. The sides.
    let bounds = match sides {
        Sides::GuardBand => viewport.guard(),
        Sides::Cube => SideBounds::CUBE,
    };
    let inside = clip_sides(projected, bounds);
    // 6. Window-viewport, for the triangles of the fan.
    for fan in inside.fan() {
        let snapped = fan.map(|v| {
            let [x, y] = viewport.to_screen(v.x, v.y)?;
            Some(Vertex::<S, _> { x, y, zs: v.zs, q: v.q, varying: v.varying })
        });
        if let [Some(a), Some(b), Some(c)] = &snapped {
            sink([a, b, c]);
        }
    }
}

/// Whether a projected vertex has a place: dividing by a tiny z may overflow.
fn finite<V>(v: &ProjectedVertex<V>) -> bool {
    v.x.abs() <= f32::MAX / 4.0 && v.y.abs() <= f32::MAX / 4.0 && v.q.is_finite()
}

/// The same cyclic order for the same triangle, whichever vertex it is given from: clipping and the fan start there.
fn canonical<V: Varying>([a, b, c]: [EyeVertex<V>; 3]) -> [EyeVertex<V>; 3] {
    let before =
        |v: &EyeVertex<V>, w: &EyeVertex<V>| order(v.position.coords, w.position.coords) == Ordering::Less;
    if before(&b, &a) && !before(&c, &b) {
        [b, c, a]
    } else if before(&c, &a) {
        [c, a, b]
    } else {
        [a, b, c]
    }
}

fn order(v: Vec3, w: Vec3) -> Ordering {
    v.z.total_cmp(&w.z).then(v.y.total_cmp(&w.y)).then(v.x.total_cmp(&w.x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::Point3;

    #[test]
    fn any_rotation_becomes_the_same_one() {
        let v = |x, y, z| EyeVertex { position: Point3::new(Vec3::new(x, y, z)), varying: x };
        for [a, b, c] in [
            [v(0.0, 0.0, 1.0), v(1.0, 0.0, 2.0), v(0.0, 1.0, 3.0)],
            [v(0.0, 0.0, 1.0), v(1.0, 0.0, 1.0), v(0.0, 1.0, 1.0)],
            [v(0.0, 0.0, 3.0), v(1.0, 0.0, 1.0), v(0.0, 1.0, 2.0)],
        ] {
            assert_eq!(canonical([a, b, c]), canonical([b, c, a]));
            assert_eq!(canonical([a, b, c]), canonical([c, a, b]));
        }
    }
}
