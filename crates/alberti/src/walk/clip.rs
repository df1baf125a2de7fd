//! Steps 3 to 6 for triangles that cross a plane: from three vertices to the fan that is left of them on the screen.

use super::Passing;
use crate::geometry::Geometry;
use crate::screen::{Screen, Sides};
use crate::vertex::{Slot, outside};
use alberti_math::glam::Vec3;
use alberti_math::lanes::One;
use alberti_math::{Eye, Fixed, Linear, Mode, Point3, Varying, map2, map3};
use alberti_projection::{EyeVertex, Polygon, ProjectedVertex, Projection, SideBounds};
use alberti_raster::{Corner, Vertex};
use core::cell::Cell;
use core::cmp::Ordering;

/// The parts of a triangle that crosses a plane.
#[cold]
#[inline(never)]
pub(super) fn clip<M: Geometry, Pr: Projection, K>(
    mesh: &M,
    screen: &Screen<Pr>,
    indices: [usize; 3],
    slots: [&Slot<M::Varying>; 3],
    sink: Passing<'_, M::Varying, K>,
    counters: &mut K,
) {
    // One of the two is all that is compiled.
    if has_linear::<M::Varying>() {
        clip_by::<(Vec3, Linear<Vec3>), _, _, _>(mesh, screen, indices, slots, sink, counters);
    } else {
        clip_by::<Vec3, _, _, _>(mesh, screen, indices, slots, sink, counters);
    }
}

#[inline(always)]
fn clip_by<W: Weights, M: Geometry, Pr: Projection, K>(
    mesh: &M,
    screen: &Screen<Pr>,
    indices: [usize; 3],
    slots: [&Slot<M::Varying>; 3],
    sink: Passing<'_, M::Varying, K>,
    counters: &mut K,
) {
    // Slots do without these, since few triangles are clipped.
    let [Some(a), Some(b), Some(c)] = indices.map(|index| before_the_eye(mesh, screen, index)) else {
        return;
    };
    let (positions, varyings) = ([a.0, b.0, c.0], [a.1, b.1, c.1]);
    let rotation = first_of(positions);
    let (carried, slots) = (rotated(varyings, rotation), rotated(slots, rotation));
    let mut polygon = in_terms_of_itself::<W>(rotated(positions, rotation));
    cut(screen, &mut polygon);
    // The triangle's own vertices stay where its neighbours have them, to the last bit of integers too.
    let own = if const { M::INTEGERS } { map3(slots, kept) } else { [None; 3] };
    let place = |vertex: &ProjectedVertex<W>| {
        own_of(own, vertex.varying).map_or_else(
            || screen.snapped([vertex.x, vertex.y]).map(Fixed::subpixels),
            |own| own.screen.place(screen.numbers.are_fixed()),
        )
    };
    let number = unfolded(&polygon.map(|vertex| place(&vertex)));
    for fan in polygon.fan_around(number) {
        let corners = fan.map(|vertex| {
            let corner = on_the_screen(screen, &vertex, varyings[0], &carried);
            own_of(own, vertex.varying).map_or(corner, |own| own.screen.with_components_of(&corner))
        });
        let [a, b, c] = &corners;
        sink([a, b, c], counters);
    }
}

/// The part of a line within all planes: of the triangle between its ends that has no area, the two corners that are
/// the farthest along it. None of a point.
#[cold]
#[inline(never)]
pub(super) fn clip_line<M: Geometry, Pr: Projection>(
    mesh: &M,
    screen: &Screen<Pr>,
    [i, j]: [usize; 2],
) -> Option<[Corner<M::Varying>; 2]> {
    if i == j {
        return None;
    }
    let [(a, first), (b, second)] = [before_the_eye(mesh, screen, i)?, before_the_eye(mesh, screen, j)?];
    let varyings = [first, second, second];
    if has_linear::<M::Varying>() {
        ends::<(Vec3, Linear<Vec3>), _, _>(screen, [a, b, b], varyings)
    } else {
        ends::<Vec3, _, _>(screen, [a, b, b], varyings)
    }
}

fn ends<W: Weights, V: Varying, Pr: Projection>(
    screen: &Screen<Pr>,
    positions: [Point3<Eye>; 3],
    varyings: [V; 3],
) -> Option<[Corner<V>; 2]> {
    let mut polygon = in_terms_of_itself::<W>(positions);
    cut(screen, &mut polygon);
    let weight = |vertex: &ProjectedVertex<W>| vertex.varying.in_space().x;
    let vertices = || polygon.vertices().iter();
    let first = vertices().reduce(|a, b| if weight(b) > weight(a) { b } else { a })?;
    let last = vertices().reduce(|a, b| if weight(b) < weight(a) { b } else { a })?;
    Some([first, last].map(|vertex| on_the_screen(screen, vertex, varyings[0], &varyings)))
}

/// A slot whose place on the screen has a meaning.
fn kept<V: Varying>(slot: &Slot<V>) -> Option<&Slot<V>> {
    (slot.outside & (outside::NEAR | outside::FAR | outside::GUARD) == 0).then_some(slot)
}

/// The item of the vertex that has all the weight.
fn own_of<T>([a, b, c]: [Option<T>; 3], weights: impl Weights) -> Option<T> {
    match weights.in_space().to_array() {
        [1.0, ..] => a,
        [_, 1.0, _] => b,
        [.., 1.0] => c,
        _ => None,
    }
}

/// The number of a vertex around which no triangle of the fan is turned over; 0 if there is none. Snapping may move a
/// vertex a little into the polygon where it is almost in line with the next ones. A fan that passes over it would draw
/// samples twice.
#[inline(never)]
fn unfolded(places: &Polygon<[i32; 2]>) -> usize {
    let folded = |number: &usize| {
        // A bit for either way round.
        let turns = places.fan_around(*number).map(|[a, b, c]| {
            let side = |p: [i32; 2]| map2([0, 1], |k: usize| i64::from(p[k] - a[k]));
            let [[ux, uy], [vx, vy]] = [side(b), side(c)];
            let area = ux * vy - uy * vx;
            u32::from(area > 0) | u32::from(area < 0) << 1
        });
        turns.fold(0, |all, turn| all | turn) == 3
    };
    (0..places.vertices().len()).find(|number| !folded(number)).unwrap_or(0)
}

/// A vertex in scaled eye space.
#[inline(never)]
fn before_the_eye<M: Geometry, Pr: Projection>(
    mesh: &M,
    screen: &Screen<Pr>,
    index: usize,
) -> Option<(Point3<Eye>, M::Varying)> {
    let (point, varying) = mesh.vertex(index)?;
    Some((Point3::new(screen.eye(One, point.coords.to_array()).into()), varying))
}

/// The corner where the three varyings have weights. It is within the guard band.
#[inline(never)]
fn on_the_screen<V: Varying, Pr: Projection>(
    screen: &Screen<Pr>,
    &ProjectedVertex { x, y, zs, q, varying }: &ProjectedVertex<impl Weights>,
    first: V,
    carried: &[V; 3],
) -> Corner<V> {
    let [x, y] = screen.snapped([x, y]);
    let varying = weighted(first, carried, varying);
    Corner::new(screen.numbers, &Vertex { x, y, zs, q, varying })
}

impl<Pr: Projection> Screen<Pr> {
    /// Step 6: window-viewport, of a place within the guard band.
    fn snapped(&self, window: [f32; 2]) -> [Fixed; 2] {
        self.viewport.to_screen_lanes(One, self.subpixel, window).map(|bits| Fixed::from_bits(bits.0))
    }
}

/// The weights of a triangle's three vertices at a point of it.
trait Weights: Varying {
    /// The vertex that has these alone.
    fn new(weights: Vec3) -> Self;
    /// Those in space.
    fn in_space(self) -> Vec3;
    /// Those of components that are linear on the screen.
    fn on_screen(self) -> Vec3;
}

/// Where nothing is linear on the screen.
impl Weights for Vec3 {
    fn new(weights: Vec3) -> Self {
        weights
    }

    fn in_space(self) -> Vec3 {
        self
    }

    fn on_screen(self) -> Vec3 {
        self
    }
}

impl Weights for (Vec3, Linear<Vec3>) {
    fn new(weights: Vec3) -> Self {
        (weights, Linear(weights))
    }

    fn in_space(self) -> Vec3 {
        self.0
    }

    fn on_screen(self) -> Vec3 {
        self.1.0
    }
}

/// Whether a component is linear on the screen, which compilers know.
#[inline(always)]
fn has_linear<V: Varying>() -> bool {
    let found = Cell::new(false);
    let _ = V::map_by_mode(&V::ZEROS, &|mode, _| found.set(found.get() | (mode == Mode::Linear)));
    found.get()
}

/// A triangle in eye space, in terms of its own vertices. Not inlined, as it is the same for all meshes.
#[inline(never)]
fn in_terms_of_itself<W: Weights>([a, b, c]: [Point3<Eye>; 3]) -> Polygon<ProjectedVertex<W>> {
    Polygon::in_eye_space([
        EyeVertex { position: a, varying: W::new(Vec3::X) },
        EyeVertex { position: b, varying: W::new(Vec3::Y) },
        EyeVertex { position: c, varying: W::new(Vec3::Z) },
    ])
}

/// Clips a triangle [`in_terms_of_itself`]: once in a program, whatever its vertices carry.
///
/// Two triangles that share an edge have the same new vertices on it, bit for bit, whatever their third vertex is. Its
/// weight is 0 there, and stays so, since a cut is between two vertices of the polygon.
#[inline(never)]
fn cut<W: Weights, Pr: Projection>(screen: &Screen<Pr>, polygon: &mut Polygon<ProjectedVertex<W>>) {
    let Screen { projection, depth, sides, guard, .. } = screen;
    let bounds = match sides {
        Sides::GuardBand => *guard,
        Sides::Cube => SideBounds::CUBE,
    };
    polygon.clip_and_project(projection, depth, bounds);
}

/// The varying at a point with these weights. Those that are 0 have no part in it, not even in its range; flat
/// components are those of `first`.
fn weighted<V: Varying>(first: V, &[a, b, c]: &[V; 3], weights: impl Weights) -> V {
    let mean = |mode, [a, b, c, first]: [f32; 4]| {
        if mode == Mode::Flat {
            return first;
        }
        let weights = if mode == Mode::Linear { weights.on_screen() } else { weights.in_space() };
        let values = [a, b, c];
        let [mut least, mut greatest] = [f32::MAX, f32::MIN];
        for (value, weight) in values.into_iter().zip(weights.to_array()) {
            if weight > 0.0 {
                least = if value < least { value } else { least };
                greatest = if value > greatest { value } else { greatest };
            }
        }
        let sum = weights.x * a + weights.y * b + weights.z * c;
        let sum = if sum > least { sum } else { least };
        if sum < greatest { sum } else { greatest }
    };
    V::from_components(&V::map_by_mode(&V::gather([a, b, c, first]), &mean))
}

/// The vertex at which clipping and the fan start: the same for the same triangle, whichever vertex it is given from.
fn first_of([a, b, c]: [Point3<Eye>; 3]) -> usize {
    if before(b, a) && !before(c, b) {
        1
    } else if before(c, a) {
        2
    } else {
        0
    }
}

/// The three from number `first` on.
fn rotated<T>([a, b, c]: [T; 3], first: usize) -> [T; 3] {
    match first {
        0 => [a, b, c],
        1 => [b, c, a],
        _ => [c, a, b],
    }
}

/// Any order that all points have.
#[inline(never)]
fn before(v: Point3<Eye>, w: Point3<Eye>) -> bool {
    let (v, w) = (v.coords, w.coords);
    v.z.total_cmp(&w.z).then(v.y.total_cmp(&w.y)).then(v.x.total_cmp(&w.x)) == Ordering::Less
}

#[cfg(test)]
mod tests;
