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
//! Each weight has its own formula, and exchanging i and j exchanges a and b bit for bit (both signs of the quotient
//! flip, and a sum does not care about order). So two triangles that share an edge get the same new vertex whichever
//! way round each of them walks it, and no crack opens. The coordinate that the plane fixes is set, not computed.

use alberti_math::{Eye, Point3, Varying, blend2};

/// The most vertices a clipped triangle can have: each of six planes adds at most one.
pub const MAX_POLYGON: usize = 9;

/// A vertex before the division by depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeVertex<V> {
    /// Eye space, scaled by the pyramid's scale where the sides matter.
    pub position: Point3<Eye>,
    /// What the vertex carries.
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
    /// What the vertex carries, as given at the vertex (not multiplied by q).
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
        let first = self.vertices[0];
        self.vertices().windows(2).skip(1).map(move |pair| [first, pair[0], pair[1]])
    }

    /// Keeps the side where `distance` is not negative. `cut` makes the vertex at weights (a, b) between two.
    fn clip(&self, distance: impl Fn(&T) -> f32, cut: impl Fn([f32; 2], [&T; 2]) -> T) -> Self {
        let kept = self.vertices();
        let mut out = Self { len: 0, ..*self };
        let Some(mut previous) = kept.last() else { return out };
        let mut d_previous = distance(previous);
        for current in kept {
            let d = distance(current);
            if (d >= 0.0) != (d_previous >= 0.0) {
                let span = d - d_previous;
                out.push(cut([d / span, -d_previous / span], [previous, current]));
            }
            if d >= 0.0 {
                out.push(*current);
            }
            (previous, d_previous) = (current, d);
        }
        out
    }

    /// Rounding could give a convex polygon a dent too small to see and so a tenth vertex; it is left away.
    fn push(&mut self, vertex: T) {
        if let Some(slot) = self.vertices.get_mut(self.len) {
            *slot = vertex;
            self.len += 1;
        }
    }
}

/// Step 3: what lies between the planes z = `near` and z = `far`, of a triangle in eye space.
///
/// A triangle wholly inside comes back with the same bits; clipping twice is clipping once.
///
/// # Precision
/// At each cut, new positions and varyings are within 4ε of the larger of the two ends, or of 2^-126 if both are
/// smaller (measured in `docs/accuracy.md`), and never outside their range; z is exactly that of the plane. Coordinates
/// up to `f32::MAX` / 16 neither overflow nor become NaN.
///
/// # Cost
/// A subtraction and a comparison for each vertex and plane; a crossing costs two divisions and a blend.
#[must_use]
pub fn clip_near_far<V: Varying>(triangle: [EyeVertex<V>; 3], near: f32, far: f32) -> Polygon<EyeVertex<V>> {
    let cut_at = |plane: f32| {
        move |weights: [f32; 2], [i, j]: [&EyeVertex<V>; 2]| {
            let mut position = blend2(weights, [i.position.coords, j.position.coords]);
            position.z = plane;
            EyeVertex { position: Point3::new(position), varying: blend2(weights, [i.varying, j.varying]) }
        }
    };
    Polygon::triangle(triangle)
        .clip(|v| v.position.coords.z - near, cut_at(near))
        .clip(|v| far - v.position.coords.z, cut_at(far))
}

/// Step 5: what lies within |xs| <= `bounds.x` and |ys| <= `bounds.y`, of a polygon after the division.
///
/// xs, ys, zs and q are linear on the screen. The varyings are not: at the screen parameter τ they take the eye-space
/// parameter t = τ z1 / (τ z1 + (1−τ) z2), whose weights are τ's times q, divided by their sum: the relation of
/// [`ScreenWeights::to_eye`](crate::ScreenWeights::to_eye), from the q that the vertices have.
///
/// # Precision
/// At each cut, xs, ys, zs and q are within 4ε of the larger of the two ends, or of 2^-126 if both are smaller,
/// varyings within 7ε (measured in `docs/accuracy.md`); xs or ys is exactly that of the plane.
#[must_use]
pub fn clip_sides<V: Varying>(
    polygon: Polygon<ProjectedVertex<V>>,
    bounds: SideBounds,
) -> Polygon<ProjectedVertex<V>> {
    let SideBounds { x, y } = bounds;
    let at_x = |x| move |w: [f32; 2], v: [&ProjectedVertex<V>; 2]| ProjectedVertex { x, ..on_screen(w, v) };
    let at_y = |y| move |w: [f32; 2], v: [&ProjectedVertex<V>; 2]| ProjectedVertex { y, ..on_screen(w, v) };
    polygon
        .clip(|v| v.x + x, at_x(-x))
        .clip(|v| x - v.x, at_x(x))
        .clip(|v| v.y + y, at_y(-y))
        .clip(|v| y - v.y, at_y(y))
}

/// The point at screen weights (a, b) between two projected vertices.
fn on_screen<V: Varying>(weights: [f32; 2], [i, j]: [&ProjectedVertex<V>; 2]) -> ProjectedVertex<V> {
    let linear = |f: fn(&ProjectedVertex<V>) -> f32| blend2(weights, [f(i), f(j)]);
    let [a, b] = [weights[0] * i.q, weights[1] * j.q];
    let sum = a + b;
    ProjectedVertex {
        x: linear(|v| v.x),
        y: linear(|v| v.y),
        zs: linear(|v| v.zs),
        q: linear(|v| v.q),
        varying: blend2([a / sum, b / sum], [i.varying, j.varying]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
