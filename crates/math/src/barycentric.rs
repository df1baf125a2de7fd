//! Barycentric coordinates: points as affine combinations of the ends of a segment, or of the vertices of a triangle or
//! tetrahedron, and attributes interpolated with them.
//!
//! In the plane and in space points have glam's vectors for coordinates; in R^n they are `Point<[f32; N], S>`.

use crate::exact::{det3, minus, ratios, replaced};
use crate::orientation::doubled_area;
use crate::space::{Point, Point2, Point3, Space};
use crate::varying::{Varying, combine};

/// The parameter t of `p` on the line through `a` and `b`: p = (1 − t) a + t b, so that t is in [0, 1] on the segment.
/// `None` when `a` is `b`, or the result or the segment is not finite.
///
/// t = (p_k − a_k) / (b_k − a_k), of the component k in which the segment is longest, for which cancellation does least
/// harm. `p` is taken to be on the line; its other components are not looked at. For a `p` beside it there is
/// [`segment_weights`].
///
/// # Precision
/// Within 1.05ε·max(|t|, `f32::MIN_POSITIVE`) of the exact quotient (ε = 2^-24). 1 − t has no such bound near t = 1:
/// the weight of `a` is the parameter on the segment given the other way round.
///
/// # Cost
/// At most 2 N subtractions and one division, in `f64`.
#[must_use]
pub fn segment_parameter<V: Into<[f32; N]> + Copy, S: Space, const N: usize>(
    p: Point<V, S>,
    [a, b]: [Point<V, S>; 2],
) -> Option<f32> {
    let [p, a, b] = [p, a, b].map(|point| point.coords.into());
    let (mut along, mut length, mut finite) = (0.0, 0.0f64, true);
    for k in 0..N {
        let component = minus(b[k], a[k]);
        finite &= component.is_finite();
        if component.abs() > length.abs() {
            (along, length) = (minus(p[k], a[k]), component);
        }
    }
    let [t] = ratios([along], length)?;
    finite.then_some(t)
}

/// The barycentric coordinates [α, β] of the foot of `p` on the line through `a` and `b`. The foot α a + β b, with
/// α + β = 1, is the point of the line that is nearest to `p`. `None` when `a` is `b`, or the result is not finite.
///
/// β = (p − a)·(b − a) / |b − a|², in any dimension; α is the same from the other end. For a `p` on the line they are
/// its coordinates, as from [`segment_parameter`].
///
/// # Precision
/// α is within 1.05ε·max(|pb|/|ab|, `f32::MIN_POSITIVE`), β within 1.05ε·max(|pa|/|ab|, `f32::MIN_POSITIVE`): for a
/// point on the line these are relative errors. In up to 2^16 dimensions.
///
/// # Cost
/// 9 N operations and two divisions, in `f64`: on a core without it, in software.
#[must_use]
pub fn segment_weights<V: Into<[f32; N]> + Copy, S: Space, const N: usize>(
    p: Point<V, S>,
    [a, b]: [Point<V, S>; 2],
) -> Option<[f32; 2]> {
    let [p, a, b] = [p, a, b].map(|point| point.coords.into());
    let mut parts = [0.0; 2];
    let mut whole = 0.0;
    for k in 0..N {
        let along = minus(b[k], a[k]);
        whole += along * along;
        parts[0] += minus(b[k], p[k]) * along;
        parts[1] += minus(p[k], a[k]) * along;
    }
    ratios(parts, whole)
}

/// The barycentric coordinates [α, β, γ] of `p` with respect to the triangle `a b c`: p = α a + β b + γ c,
/// α + β + γ = 1. `None` when the triangle has no area, or the result is not finite.
///
/// By Cramer's rule they are ratios of areas: α = ⟨p, b, c⟩ / ⟨a, b, c⟩, and so on. All are in [0, 1] inside the
/// triangle; one is 0 on an edge; at a vertex one is 1 and two are 0. [`Zone`](crate::Zone) tells the signs, without
/// dividing.
///
/// In more than two dimensions the areas are those of the shadows on all coordinate planes:
/// α = Σ ⟨p, b, c⟩ᵢⱼ ⟨a, b, c⟩ᵢⱼ / Σ ⟨a, b, c⟩ᵢⱼ². That is the quotient of the normal equations of the orthogonal
/// projection (Lagrange's identity), without their loss of precision in slivers. The coordinates are those of the foot
/// of `p` in the triangle's plane.
///
/// # Precision
/// In the plane, within 1.05ε·max(|α|, `f32::MIN_POSITIVE`) of the exact α, whatever the triangle's shape and place;
/// likewise β and γ. Zeros and signs are exact, but for what rounds to zero. In more dimensions within
/// 1.05ε·max(|pbc|/|abc|, `f32::MIN_POSITIVE`), |pbc| being the triangle's area: for a point in the triangle's plane
/// that is the same. In up to 2^8 dimensions.
///
/// # Cost
/// Four times [`signed_area`](crate::signed_area) and three divisions for each of the N (N − 1) / 2 coordinate planes,
/// in `f64`: on a core without it, in software. The rasterizer has integers for the purpose.
#[must_use]
pub fn triangle_weights<V: Into<[f32; N]> + Copy, S: Space, const N: usize>(
    p: Point<V, S>,
    triangle: [Point<V, S>; 3],
) -> Option<[f32; 3]> {
    let p = p.coords.into();
    let corners = triangle.map(|v| v.coords.into());
    let mut parts = [0.0; 3];
    let mut whole = 0.0;
    for i in 0..N {
        for j in i + 1..N {
            let shadow = |corners: [[f32; N]; 3]| doubled_area(corners.map(|v| [v[i], v[j]]));
            let area = shadow(corners);
            whole += area * area;
            for (k, part) in parts.iter_mut().enumerate() {
                *part += shadow(replaced(corners, k, p)) * area;
            }
        }
    }
    ratios(parts, whole)
}

/// The barycentric coordinates [α, β, γ, δ] of `p` with respect to the tetrahedron `a b c d`. They satisfy
/// p = α a + β b + γ c + δ d and α + β + γ + δ = 1. `None` when the tetrahedron has no volume, or the result is not
/// finite.
///
/// By Cramer's rule they are ratios of signed volumes: that of the tetrahedron with `p` for one vertex, and of the
/// whole.
///
/// # Precision
/// Each is within 1.05ε·max(|α|, `f32::MIN_POSITIVE`) of the exact one, whatever the tetrahedron's shape and place.
/// Zeros and signs are exact, but for what rounds to zero.
///
/// # Cost
/// Five determinants of 35 operations in `f64`, in software on a core without it; thousands of operations for one of
/// which more than 20 bits cancel.
#[must_use]
pub fn tetrahedron_weights<S: Space>(p: Point3<S>, tetrahedron: [Point3<S>; 4]) -> Option<[f32; 4]> {
    let volume = |[a, b, c, d]: [[f32; 3]; 4]| det3([[a, b], [a, c], [a, d]]);
    let p = p.coords.to_array();
    let corners = tetrahedron.map(|v| v.coords.to_array());
    ratios([0, 1, 2, 3].map(|k| volume(replaced(corners, k, p))), volume(corners))
}

/// The affine combination `α a + β b + γ c` of any attribute, colours or points for example.
///
/// # Precision
/// Each component is within 3ε·max(|α a| + |β b| + |γ c|, `f32::MIN_POSITIVE`) of the exact combination,
/// barring overflow.
///
/// # Cost
/// Three multiplications and two additions for each component, in `f32`.
#[must_use]
pub fn interpolate<V: Varying>([alpha, beta, gamma]: [f32; 3], values: [V; 3]) -> V {
    combine(values, &|[a, b, c]| alpha * a + beta * b + gamma * c)
}

/// The value at `p` of the attribute that is affine on a triangle and has these values at its vertices; `None` where
/// [`triangle_weights`] is.
///
/// With the vertices of another triangle for values, in the plane or in space, this is the affine map from one triangle
/// to the other. There is just one: `p` and its image have the same barycentric coordinates. With colours for values it
/// is the triangle's colour at `p`.
///
/// # Precision
/// In the plane, each component is within 4.1ε·(|α a| + |β b| + |γ c| + m) of the exact value, barring overflow, where
/// m is `f32::MIN_POSITIVE`·max(1, |a|, |b|, |c|).
///
/// # Cost
/// That of [`triangle_weights`] and [`interpolate`]. To map many points, compose frames instead:
/// `Frame2::of_triangle(to) * Frame2::of_triangle(from).inverse()?`, whose error grows with how flat `from` is.
///
/// ```
/// use alberti_math::{Point2, Point3, World, Object, glam::{Vec2, Vec3}, map_triangle};
///
/// let at = |x, y| Point2::<Object>::new(Vec2::new(x, y));
/// let to = [Vec3::ZERO, Vec3::X * 8.0, Vec3::Z * 4.0].map(Point3::<World>::new);
/// let image = map_triangle(at(0.5, 0.25), [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)], to);
/// assert_eq!(image, Some(Point3::new(Vec3::new(4.0, 0.0, 1.0))));
/// ```
#[must_use]
pub fn map_triangle<V: Into<[f32; N]> + Copy, S: Space, W: Varying, const N: usize>(
    p: Point<V, S>,
    from: [Point<V, S>; 3],
    to: [W; 3],
) -> Option<W> {
    Some(interpolate(triangle_weights(p, from)?, to))
}

/// The coefficients [a, b, c] of the plane f(x, y) = a x + b y + c that has these values at three points. `None` when
/// the points are on one line, or a coefficient is not finite.
///
/// By Cramer's rule each is a quotient of determinants, the denominator being twice the triangle's signed area:
/// x₀ (y₁ − y₂) + x₁ (y₂ − y₀) + x₂ (y₀ − y₁). f is the same function as the values interpolated with barycentric
/// coordinates.
///
/// # Precision
/// a, b and c are within 1.05ε·max(|exact|, `f32::MIN_POSITIVE`), whatever the triangle's shape and place. But f itself
/// is then only known within 4.1ε·(|a x| + |b y| + |c|), which is far more than it varies over a small triangle far
/// from the origin. Barycentric coordinates have no such weakness.
///
/// # Cost
/// Three times [`signed_area`](crate::signed_area) and a determinant of 35 operations, in `f64`; thousands of
/// operations for one of which more than 20 bits cancel.
#[must_use]
pub fn plane_coefficients<S: Space>(points: [Point2<S>; 3], values: [f32; 3]) -> Option<[f32; 3]> {
    let [x, y] = [points.map(|p| p.coords.x), points.map(|p| p.coords.y)];
    let area = |x: [f32; 3], y: [f32; 3]| doubled_area([[x[0], y[0]], [x[1], y[1]], [x[2], y[2]]]);
    let origin = [0.0; 3];
    let at_origin = det3([0, 1, 2].map(|k| [origin, [x[k], y[k], values[k]]]));
    ratios([area(values, y), area(x, values), at_origin], area(x, y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Cube;
    use glam::{Vec2, Vec3};

    fn p(x: f32, y: f32) -> Point2<Cube> {
        Point2::new(Vec2::new(x, y))
    }

    /// With vertices and points on small integers and an area of a power of two, every operation is exact.
    #[test]
    fn weights_are_exact_where_the_arithmetic_is() {
        let triangle = [p(0.0, 0.0), p(8.0, 0.0), p(0.0, 8.0)];
        for x in -8..=16i8 {
            for y in -8..=16i8 {
                let (x, y) = (f32::from(x), f32::from(y));
                let expected = [(8.0 - x - y) / 8.0, x / 8.0, y / 8.0];
                assert_eq!(triangle_weights(p(x, y), triangle), Some(expected));
            }
        }
    }

    #[test]
    fn colours_mix_at_the_centroid() {
        let thirds =
            triangle_weights(p(1.0, 1.0), [p(0.0, 0.0), p(3.0, 0.0), p(0.0, 3.0)]).expect("has area");
        let mixed = interpolate(thirds, [Vec3::X, Vec3::Y, Vec3::Z]);
        assert!((mixed - Vec3::splat(1.0 / 3.0)).abs().max_element() < 1e-7);
    }

    #[test]
    fn no_area_no_weights() {
        assert_eq!(triangle_weights(p(1.0, 1.0), [p(0.0, 0.0), p(1.0, 1.0), p(2.0, 2.0)]), None);
        assert_eq!(triangle_weights(p(f32::NAN, 1.0), [p(0.0, 0.0), p(1.0, 0.0), p(0.0, 2.0)]), None);
    }

    #[test]
    fn a_segment_that_is_not_finite_has_no_parameter() {
        let at = |x, y| Point2::<Cube>::new(Vec2::new(x, y));
        assert_eq!(segment_parameter(at(0.5, 0.0), [at(0.0, 0.0), at(1.0, f32::NAN)]), None);
        assert_eq!(segment_parameter(at(0.5, 0.0), [at(0.0, f32::INFINITY), at(1.0, 0.0)]), None);
        assert_eq!(segment_parameter(at(f32::NAN, 0.0), [at(0.0, 0.0), at(1.0, 0.0)]), None);
        // Differences beyond f32 are none of its concern.
        assert_eq!(segment_parameter(at(3e38, 0.0), [at(-3e38, 0.0), at(0.0, 0.0)]), Some(2.0));
    }

    /// A line with direction (1, -2, 4), and a point beside it: its foot is exact, and so is all of the arithmetic.
    #[test]
    fn a_segment_is_measured_along_itself() {
        let [a, b] = [Vec3::new(1.0, 2.0, 3.0), Vec3::new(3.0, -2.0, 11.0)].map(Point3::<Cube>::new);
        let at = |t: f32| Point3::new(a.coords + (b.coords - a.coords) * t);
        for t in [-2.0, 0.0, 0.25, 1.0, 1.5] {
            assert_eq!(segment_parameter(at(t), [a, b]), Some(t));
            assert_eq!(segment_weights(at(t), [a, b]), Some([1.0 - t, t]));
        }
        let beside = Point3::new(at(0.25).coords + Vec3::new(2.0, 1.0, 0.0));
        assert_eq!(segment_weights(beside, [a, b]), Some([0.75, 0.25]));
        assert_eq!((segment_parameter(at(0.5), [a, a]), segment_weights(at(0.5), [a, a])), (None, None));
        let ends = [-3e38, 3e38].map(|x| Point::<[f32; 1], Cube>::new([x]));
        assert_eq!(segment_parameter(ends[0], ends), Some(0.0));
        assert_eq!(segment_weights(ends[0], ends), Some([1.0, 0.0]));
    }

    /// In the plane x + y + z = 4 of a triangle with one vertex on each axis, and above it.
    #[test]
    fn a_triangle_in_more_dimensions_is_projected_on() {
        let triangle = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| Point3::<Cube>::new(axis * 4.0));
        let inside = Vec3::new(1.0, 2.0, 1.0);
        assert_eq!(triangle_weights(Point3::new(inside), triangle), Some([0.25, 0.5, 0.25]));
        assert_eq!(triangle_weights(Point3::new(inside + 8.0), triangle), Some([0.25, 0.5, 0.25]));
        let in_r4 =
            [[4.0, 0.0, 0.0, 9.0], [0.0, 4.0, 0.0, 9.0], [0.0, 0.0, 4.0, 9.0]].map(Point::<_, Cube>::new);
        assert_eq!(triangle_weights(Point::new([1.0, 2.0, 1.0, -7.0]), in_r4), Some([0.25, 0.5, 0.25]));
        assert_eq!(
            triangle_weights(Point::new([1.0]), [[0.0], [1.0], [3.0]].map(Point::<_, Cube>::new)),
            None
        );
    }

    #[test]
    fn a_tetrahedron_is_divided_by_volumes() {
        let corners = [Vec3::ZERO, Vec3::X * 8.0, Vec3::Y * 8.0, Vec3::Z * 8.0].map(Point3::<Cube>::new);
        let weights = tetrahedron_weights(Point3::new(Vec3::new(1.0, 2.0, 4.0)), corners);
        assert_eq!(weights, Some([0.125, 0.125, 0.25, 0.5]));
        let [a, b, c, _] = corners;
        let flat = [a, b, c, Point3::new(Vec3::new(5.0, 1.0, 0.0))];
        assert_eq!(tetrahedron_weights(Point3::new(Vec3::ONE), flat), None);
    }

    /// f = 2 x - 3 y + 5.
    #[test]
    fn a_plane_goes_through_its_samples() {
        let points = [p(1.0, 1.0), p(4.0, 2.0), p(3.0, 7.0)];
        let values = points.map(|p| 2.0 * p.coords.x - 3.0 * p.coords.y + 5.0);
        assert_eq!(plane_coefficients(points, values), Some([2.0, -3.0, 5.0]));
        assert_eq!(plane_coefficients([points[0]; 3], values), None);
    }
}
