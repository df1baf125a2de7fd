//! Signed area and barycentric coordinates in the plane.

use crate::space::{Point2, Space};
use crate::varying::{Varying, combine};

/// The signed area of the triangle `a b c`: positive when its vertices run counter-clockwise (with y up).
///
/// Half the determinant whose columns are (a, 1), (b, 1), (c, 1), computed from the differences to `a`.
///
/// # Precision
/// Within 4ε·|ab|·|ac| of the exact area, so the sign of a sliver is not to be trusted; the rasterizer decides in
/// integers for that reason.
#[must_use]
pub fn signed_area<S: Space>(a: Point2<S>, b: Point2<S>, c: Point2<S>) -> f32 {
    (b - a).coords.perp_dot((c - a).coords) / 2.0
}

/// The barycentric coordinates [α, β, γ] of `p` with respect to the triangle `a b c`: p = α a + β b + γ c,
/// α + β + γ = 1. `None` when the triangle has no area, or the result is not finite.
///
/// By Cramer's rule they are ratios of areas: α = ⟨p, b, c⟩ / ⟨a, b, c⟩, and so on. All are in [0, 1] inside the
/// triangle; one is 0 on an edge; at a vertex one is 1 and two are 0.
///
/// # Precision
/// Each coordinate comes from its own area rather than from 1 minus the others; its absolute error is within
/// 12ε·L²/|area|, L being the longest distance between the four points.
#[must_use]
pub fn triangle_weights<S: Space>(p: Point2<S>, [a, b, c]: [Point2<S>; 3]) -> Option<[f32; 3]> {
    let whole = signed_area(a, b, c);
    let weights = [signed_area(p, b, c), signed_area(a, p, c), signed_area(a, b, p)].map(|part| part / whole);
    (whole != 0.0 && weights.iter().all(|w| w.is_finite())).then_some(weights)
}

/// The affine combination `α a + β b + γ c` of any attribute, colours for example.
///
/// # Precision
/// Within 3ε·(|α a| + |β b| + |γ c|) of the exact combination.
#[must_use]
pub fn interpolate<V: Varying>([alpha, beta, gamma]: [f32; 3], values: [V; 3]) -> V {
    combine(values, &|[a, b, c]| alpha * a + beta * b + gamma * c)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Cube;
    use glam::{Vec2, Vec3};

    fn p(x: f32, y: f32) -> Point2<Cube> {
        Point2::new(Vec2::new(x, y))
    }

    #[test]
    fn counter_clockwise_is_positive() {
        assert_eq!(signed_area(p(0.0, 0.0), p(4.0, 0.0), p(0.0, 3.0)), 6.0);
        assert_eq!(signed_area(p(0.0, 0.0), p(0.0, 3.0), p(4.0, 0.0)), -6.0);
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
}
