//! Step 3, the clip against near and far, and step 5, the clip against the sides.
//!
//! ```text
//!     Vi  inside: di >= 0            a = dj / (dj - di)        V = a Vi + b Vj
//!      \
//!   ----V-------- plane
//!        \
//!         Vj  outside: dj < 0        b = -di / (dj - di)
//! ```
//!
//! Each weight has its own formula. Exchanging i and j exchanges a and b bit for bit, as both signs of the quotient
//! flip, and a sum does not care about order. So two triangles that share an edge get the same new vertex whichever way
//! round each of them walks it, and no crack opens. The coordinate that the plane fixes is set, not computed.

use crate::Projection;
use alberti_math::{Eye, Mode, Point3, Varying, blend2, blend2_by_mode};
use core::hint::black_box;

/// The most vertices a clipped triangle can have: each of six planes adds at most one.
pub const MAX_POLYGON: usize = 9;

/// A vertex before the division by depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeVertex<V> {
    /// Eye space, scaled by the pyramid's scale where the sides matter.
    pub position: Point3<Eye>,
    /// The attributes.
    pub varying: V,
}

/// A vertex after perspective with depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectedVertex<V> {
    /// xs; the window is [-1, 1].
    pub x: f32,
    /// ys, upwards; the window is [-1, 1].
    pub y: f32,
    /// Screen depth zs in [0, 1].
    pub zs: f32,
    /// 1/ze, greater than 0.
    pub q: f32,
    /// The attributes, as given at the vertex (not multiplied by q).
    pub varying: V,
}

/// The largest |xs| and |ys| that stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideBounds {
    /// Largest |xs|.
    pub x: f32,
    /// Largest |ys|.
    pub y: f32,
}

impl SideBounds {
    /// The cube's four sides: the window itself.
    pub const CUBE: Self = Self { x: 1.0, y: 1.0 };
}

/// A convex polygon of at most [`MAX_POLYGON`] vertices, in a fixed array.
#[derive(Clone, Copy, Debug)]
pub struct Polygon<T> {
    vertices: [T; MAX_POLYGON],
    len: usize,
}

impl<T: Copy> Polygon<T> {
    /// The triangle with these vertices.
    #[must_use]
    pub fn triangle([a, b, c]: [T; 3]) -> Self {
        let mut vertices = [a; MAX_POLYGON];
        vertices[1] = b;
        vertices[2] = c;
        Self { vertices, len: 3 }
    }

    /// The vertices in order, none if nothing is left.
    #[must_use]
    pub fn vertices(&self) -> &[T] {
        self.vertices.get(..self.len).unwrap_or(&[])
    }

    /// The polygon with every vertex mapped.
    #[must_use]
    pub fn map<U: Copy>(&self, f: impl FnMut(T) -> U) -> Polygon<U> {
        Polygon { vertices: self.vertices.map(f), len: self.len }
    }

    /// The triangles of the fan around the first vertex.
    pub fn fan(&self) -> impl Iterator<Item = [T; 3]> {
        self.fan_around(0)
    }

    /// The triangles of the fan around the vertex of this number; around the first, if there is no such vertex.
    pub fn fan_around(&self, number: usize) -> impl Iterator<Item = [T; 3]> {
        let vertices = self.vertices();
        let count = vertices.len();
        let number = if number < count { number } else { 0 };
        let at = move |k: usize| vertices.get(if k < count { k } else { k - count }).copied();
        (number + 1..(number + count).saturating_sub(1))
            .filter_map(move |k| Some([at(number)?, at(k)?, at(k + 1)?]))
    }
}

/// The axis that a plane is at right angles to.
#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
    Z,
}

/// A plane at right angles to an axis, and the side of it that stays.
#[derive(Clone, Copy)]
struct ClipPlane {
    axis: Axis,
    at: f32,
    /// 1 where greater coordinates stay, -1 where lesser ones do.
    inner: f32,
}

impl ClipPlane {
    /// The distance inwards, correctly rounded.
    fn distance<V: Varying>(&self, vertex: &ProjectedVertex<V>) -> f32 {
        let along = match self.axis {
            Axis::X => vertex.x,
            Axis::Y => vertex.y,
            Axis::Z => vertex.zs,
        };
        // Products with 1 are exact.
        along * self.inner - self.at * self.inner
    }

    /// Puts a vertex on the plane.
    fn hold<V: Varying>(&self, vertex: &mut ProjectedVertex<V>) {
        let along = match self.axis {
            Axis::X => &mut vertex.x,
            Axis::Y => &mut vertex.y,
            Axis::Z => &mut vertex.zs,
        };
        *along = self.at;
    }
}

impl<V: Varying> ProjectedVertex<V> {
    /// The vertex at weights (a, b) between two. Varyings have the weights of eye space, but for linear components.
    fn between(weights: [f32; 2], [i, j]: [&Self; 2], space: Space) -> Self {
        let number = |of: [f32; 2]| blend2(weights, of);
        let [x, y] = [number([i.x, j.x]), number([i.y, j.y])];
        let [zs, q] = [number([i.zs, j.zs]), number([i.q, j.q])];
        let in_space = match space {
            Space::Eye => weights,
            Space::Screen => {
                let [a, b] = [weights[0] * i.q, weights[1] * j.q];
                let sum = a + b;
                [a / sum, b / sum]
            }
        };
        let weights = |mode| if mode == Mode::Linear { weights } else { in_space };
        ProjectedVertex { x, y, zs, q, varying: blend2_by_mode(weights, [i.varying, j.varying]) }
    }
}

/// Where edges are cut: before the division, where a vertex has ze in the place of zs and no q, or after it.
#[derive(Clone, Copy)]
enum Space {
    Eye,
    Screen,
}

impl<V: Varying> Polygon<ProjectedVertex<V>> {
    /// Keeps the part on the inner sides of planes, one after the other, in the same memory. Not inlined: both spaces
    /// share it.
    #[inline(never)]
    fn clip(&mut self, planes: &[ClipPlane], space: Space) {
        for plane in planes {
            // The vertices to come lie at the end, and those that stay at the beginning: of a convex polygon there is
            // one more at most.
            let count = self.vertices().len();
            let first = MAX_POLYGON - count;
            // One by one and in parts: moving memory is a function of 700 bytes on small cores.
            for k in (0..count).rev() {
                black_box(());
                let Some(&ProjectedVertex { x, y, zs, q, varying }) = self.vertices.get(k) else { return };
                if let Some(slot) = self.vertices.get_mut(first + k) {
                    (slot.x, slot.y, slot.zs, slot.q) = (x, y, zs, q);
                    slot.varying = varying;
                }
            }
            self.len = 0;
            let Some(mut previous) = self.vertices.last().copied().filter(|_| count > 0) else { return };
            let mut d_previous = plane.distance(&previous);
            for k in first..MAX_POLYGON {
                let Some(&current) = self.vertices.get(k) else { return };
                let d = plane.distance(&current);
                if (d >= 0.0) != (d_previous >= 0.0) {
                    let span = d - d_previous;
                    let weights = [d / span, -d_previous / span];
                    let mut new = ProjectedVertex::between(weights, [&previous, &current], space);
                    plane.hold(&mut new);
                    self.push(new, k);
                }
                if d >= 0.0 {
                    self.push(current, k);
                }
                (previous, d_previous) = (current, d);
            }
        }
    }

    /// Adds a vertex while those behind number `seen` are still to come. Rounding could give a convex polygon a dent
    /// too small to see and so a vertex for which there is no room; it is left away.
    fn push(&mut self, vertex: ProjectedVertex<V>, seen: usize) {
        if let Some(slot) = self.vertices.get_mut(self.len)
            && self.len <= seen
        {
            *slot = vertex;
            self.len += 1;
        }
    }

    /// Step 3 of a polygon before the division, whose vertices have z in the place of zs.
    fn clip_near_far(&mut self, near: f32, far: f32) {
        let plane = |at, inner| ClipPlane { axis: Axis::Z, at, inner };
        self.clip(&[plane(near, 1.0), plane(far, -1.0)], Space::Eye);
    }

    /// Step 5.
    fn clip_sides(&mut self, SideBounds { x, y }: SideBounds) {
        let plane = |axis, at, inner| ClipPlane { axis, at, inner };
        self.clip(
            &[
                plane(Axis::X, -x, 1.0),
                plane(Axis::X, x, -1.0),
                plane(Axis::Y, -y, 1.0),
                plane(Axis::Y, y, -1.0),
            ],
            Space::Screen,
        );
    }

    /// A triangle in eye space, for [`clip_and_project`](Self::clip_and_project): its vertices have z in the place of
    /// zs.
    #[must_use]
    pub fn in_eye_space(triangle: [EyeVertex<V>; 3]) -> Self {
        Self::triangle(triangle.map(before_the_division))
    }

    /// Steps 3 to 5 in the memory of one polygon: what [`clip_near_far`], [`Projection::project`] and [`clip_sides`]
    /// make of a triangle [in eye space](Self::in_eye_space), scaled by the pyramid's scale.
    ///
    /// Nothing is left where a vertex has no place on the screen, as a division by a tiny z may overflow.
    pub fn clip_and_project<P: Projection>(&mut self, projection: &P, depth: &P::Depth, bounds: SideBounds) {
        self.clip_near_far(projection.near(), projection.far());
        for vertex in self.vertices.iter_mut().take(self.len) {
            *vertex = projection.project(depth, &in_eye_space(vertex));
        }
        if !self.vertices().iter().all(ProjectedVertex::has_a_place) {
            self.len = 0;
        }
        self.clip_sides(bounds);
    }
}

impl<V> ProjectedVertex<V> {
    /// Whether its numbers leave room to be clipped.
    fn has_a_place(&self) -> bool {
        self.x.abs() <= f32::MAX / 4.0 && self.y.abs() <= f32::MAX / 4.0 && self.q.is_finite()
    }
}

/// A vertex in eye space, with z in the place of zs.
fn before_the_division<V>(EyeVertex { position, varying }: EyeVertex<V>) -> ProjectedVertex<V> {
    let [x, y, zs] = position.coords.to_array();
    ProjectedVertex { x, y, zs, q: 0.0, varying }
}

/// The same back.
fn in_eye_space<V: Copy>(&ProjectedVertex { x, y, zs, varying, .. }: &ProjectedVertex<V>) -> EyeVertex<V> {
    EyeVertex { position: Point3::new([x, y, zs].into()), varying }
}

/// Step 3: the part of a triangle in eye space between the planes z = `near` and z = `far`.
///
/// A triangle wholly inside comes back with the same bits; clipping twice is clipping once.
///
/// # Precision
/// At each cut, new positions and varyings are within 4ε (ε = 2^-24) of the larger of the two ends, or of 2^-126 if
/// both are smaller (measured in `docs/accuracy.md`). They are never outside the range of the ends; z is exactly that
/// of the plane. Coordinates up to `f32::MAX` / 16 neither overflow nor become NaN.
///
/// # Cost
/// A subtraction and a comparison for each vertex and plane; a crossing costs two divisions and a blend.
#[must_use]
pub fn clip_near_far<V: Varying>(triangle: [EyeVertex<V>; 3], near: f32, far: f32) -> Polygon<EyeVertex<V>> {
    let mut polygon = Polygon::triangle(triangle.map(before_the_division));
    polygon.clip_near_far(near, far);
    polygon.map(|v| in_eye_space(&v))
}

/// Step 5: the part of a polygon, after the division, within |xs| <= `bounds.x` and |ys| <= `bounds.y`.
///
/// xs, ys, zs and q are linear on the screen. The varyings are not: at the screen parameter τ they take the eye-space
/// parameter t = τ z1 / (τ z1 + (1−τ) z2). Its weights are τ's times q, divided by their sum: the relation of
/// [`ScreenWeights::to_eye`](crate::ScreenWeights::to_eye), from the q that the vertices have. Components that are
/// [`Linear`](alberti_math::Linear) on the screen keep τ's.
///
/// # Precision
/// At each cut, xs, ys, zs and q are within 4ε (ε = 2^-24) of the larger of the two ends, or of 2^-126 if both are
/// smaller. Varyings are so within 7ε (measured in `docs/accuracy.md`, as are the others). xs or ys is exactly that of
/// the plane.
#[must_use]
pub fn clip_sides<V: Varying>(
    mut polygon: Polygon<ProjectedVertex<V>>,
    bounds: SideBounds,
) -> Polygon<ProjectedVertex<V>> {
    polygon.clip_sides(bounds);
    polygon
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::Linear;
    use alberti_math::glam::Vec3;
    use std::vec::Vec;

    fn eye(x: f32, y: f32, z: f32) -> EyeVertex<f32> {
        EyeVertex { position: Point3::new(Vec3::new(x, y, z)), varying: x }
    }

    fn projected(x: f32, y: f32, z: f32) -> ProjectedVertex<f32> {
        ProjectedVertex { x, y, zs: 1.0 - 1.0 / z, q: 1.0 / z, varying: z }
    }

    #[test]
    fn inside_nothing_changes_and_outside_nothing_is_left() {
        let inside = [eye(0.1, 0.2, 1.0), eye(1.0, -1.0, 2.0), eye(-1.0, 3.0, 4.0)];
        assert_eq!(clip_near_far(inside, 1.0, 4.0).vertices(), inside);
        assert!(clip_near_far(inside, 5.0, 9.0).vertices().is_empty());
        assert!(clip_near_far(inside, 0.1, 0.9).vertices().is_empty());
        assert_eq!(clip_near_far(inside, 5.0, 9.0).fan().count(), 0);
    }

    /// As many vertices as there is room for, within all planes, and with one beyond: that would be ten.
    #[test]
    fn nine_vertices_stay() {
        let around = |radius: f32| {
            let mut turned = [radius, 0.0];
            let vertices = [(); MAX_POLYGON].map(|()| {
                let [x, y] = turned;
                let [cos, sin] = [0.766_044_44_f32, 0.642_787_6];
                turned = [cos * x - sin * y, sin * x + cos * y];
                ProjectedVertex { x, y, zs: 0.5, q: 1.0, varying: x }
            });
            Polygon { vertices, len: MAX_POLYGON }
        };
        let inside = around(0.9);
        assert_eq!(clip_sides(inside, SideBounds::CUBE).vertices(), inside.vertices());
        let clipped = clip_sides(around(1.01), SideBounds::CUBE);
        assert_eq!(clipped.vertices().len(), MAX_POLYGON);
        assert!(clipped.vertices().iter().all(|v| v.x.abs() <= 1.0 && v.y.abs() <= 1.0));
    }

    #[test]
    fn a_fan_is_around_any_vertex() {
        let four = Polygon { vertices: [0, 1, 2, 3, 9, 9, 9, 9, 9], len: 4 };
        let around = |number| four.fan_around(number).collect::<Vec<_>>();
        assert_eq!(around(0), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(around(1), [[1, 2, 3], [1, 3, 0]]);
        assert_eq!(around(3), [[3, 0, 1], [3, 1, 2]]);
        assert_eq!(around(4), around(0));
        assert_eq!(Polygon { len: 0, ..four }.fan_around(0).count(), 0);
    }

    #[test]
    fn one_vertex_behind_the_eye_leaves_a_quadrilateral_on_the_plane() {
        let crossing = [eye(0.0, 0.0, -2.0), eye(4.0, 0.0, 2.0), eye(0.0, 4.0, 2.0)];
        let clipped = clip_near_far(crossing, 1.0, 9.0);
        let z: Vec<f32> = clipped.vertices().iter().map(|v| v.position.coords.z).collect();
        assert_eq!(z, [1.0, 1.0, 2.0, 2.0]);
        assert_eq!(clipped.vertices()[1].position.coords, Vec3::new(3.0, 0.0, 1.0));
        assert_eq!(clipped.vertices()[1].varying, 3.0);
        assert_eq!(clipped.fan().count(), 2);
    }

    #[test]
    fn sides_carry_varyings_hyperbolically() {
        // Along an edge from depth 1 to depth 3, the screen's middle is a quarter of the way in space: the varying,
        // which is the depth itself, must be 1/q there.
        let triangle = [projected(-1.0, 0.0, 1.0), projected(3.0, 0.0, 3.0), projected(-1.0, 0.5, 1.0)];
        let clipped = clip_sides(Polygon::triangle(triangle), SideBounds::CUBE);
        let cut =
            clipped.vertices().iter().find(|v| v.x == 1.0 && v.y == 0.0).expect("the lower edge is cut");
        assert!((cut.varying - 1.5).abs() < 1e-6 && (cut.q - 1.0 / 1.5).abs() < 1e-6, "{cut:?}");
    }

    #[test]
    fn linear_components_stay_linear_on_the_screen() {
        let triangle = [(-1.0, 0.0, 1.0), (3.0, 0.0, 3.0), (-1.0, 0.5, 1.0)].map(|(x, y, z)| {
            let ProjectedVertex { zs, q, .. } = projected(x, y, z);
            ProjectedVertex { x, y, zs, q, varying: (z, Linear(z)) }
        });
        let clipped = clip_sides(Polygon::triangle(triangle), SideBounds::CUBE);
        let cut = clipped.vertices().iter().find(|v| v.x == 1.0 && v.y == 0.0).expect("a cut edge");
        let (hyperbolic, Linear(linear)) = cut.varying;
        assert!((hyperbolic - 1.5).abs() < 1e-6 && (linear - 2.0).abs() < 1e-6, "{cut:?}");
    }

    #[test]
    fn a_triangle_over_every_plane_stays_within_the_bounds() {
        let big = [eye(-1.6, -0.9, 0.5), eye(3.4, -1.6, 2.0), eye(0.4, 7.6, 4.0)];
        let polygon = clip_near_far(big, 1.0, 3.0).map(|v| {
            let p = v.position.coords;
            projected(p.x / p.z, p.y / p.z, p.z)
        });
        let clipped = clip_sides(polygon, SideBounds::CUBE);
        assert!(clipped.vertices().len() > 4, "{clipped:?}");
        assert!(clipped.vertices().iter().all(|v| v.x.abs() <= 1.0 && v.y.abs() <= 1.0));
        let again = clip_sides(clipped, SideBounds::CUBE);
        assert_eq!(again.vertices(), clipped.vertices());
    }
}
