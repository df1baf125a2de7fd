//! Clipping of convex polygons in eye space, in f64.

use crate::vec3::Vec3;
use crate::view::View;

/// A corner of a clipped triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    /// In eye space.
    pub(crate) eye: Vec3,
    /// The weights of the three vertices of the triangle at this point.
    pub(crate) weights: Vec3,
}

/// The corners of a whole triangle.
pub(crate) fn corners(eye: [Vec3; 3]) -> Vec<Corner> {
    let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    (0..3).map(|i| Corner { eye: eye[i], weights: units[i] }).collect()
}

/// The part between the near and the far plane.
pub(crate) fn clip_depth(polygon: &[Corner], view: &View) -> Vec<Corner> {
    let mut between = clip(polygon, |p| p[2] - view.near);
    // Rounding must not put a corner in front of the near plane, however near the eye that plane is.
    for corner in &mut between {
        corner.eye[2] = corner.eye[2].max(view.near);
    }
    clip(&between, |p| view.far - p[2])
}

/// The part that projects into the square of pixel positions up to `limit` in magnitude.
pub(crate) fn clip_guard(polygon: Vec<Corner>, view: &View, limit: f64) -> Vec<Corner> {
    let sides: [&dyn Fn(Vec3) -> f64; 4] = [
        &|p| view.offset_from([-limit; 2], p)[0],
        &|p| -view.offset_from([limit; 2], p)[0],
        &|p| view.offset_from([-limit; 2], p)[1],
        &|p| -view.offset_from([limit; 2], p)[1],
    ];
    sides.iter().fold(polygon, |polygon, side| clip(&polygon, side))
}

/// The part where `distance` is not negative: Sutherland and Hodgman, with the symmetric form of the crossing, so that
/// both triangles at an edge cut it at the same point.
fn clip(polygon: &[Corner], distance: impl Fn(Vec3) -> f64) -> Vec<Corner> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, a) in polygon.iter().enumerate() {
        let b = &polygon[(i + 1) % polygon.len()];
        let (da, db) = (distance(a.eye), distance(b.eye));
        if da >= 0.0 {
            kept.push(*a);
        }
        if (da >= 0.0) != (db >= 0.0) {
            let mix = |x: Vec3, y: Vec3| std::array::from_fn(|k| (db * x[k] - da * y[k]) / (db - da));
            kept.push(Corner { eye: mix(a.eye, b.eye), weights: mix(a.weights, b.weights) });
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3::blend;

    const TRIANGLE: [Vec3; 3] = [[0.0, 0.0, -2.0], [4.0, 0.0, 6.0], [0.0, 4.0, 6.0]];

    #[test]
    fn a_triangle_across_a_plane_becomes_a_quad() {
        let quad = clip(&corners(TRIANGLE), |p| p[2] - 2.0);
        assert_eq!(quad.len(), 4);
        for corner in &quad {
            assert!(corner.eye[2] >= 2.0 - 1e-12);
            let there = blend(corner.weights, TRIANGLE);
            assert!((0..3).all(|i| (there[i] - corner.eye[i]).abs() < 1e-12));
        }
    }

    #[test]
    fn inside_is_kept_as_it_is_and_outside_vanishes() {
        let all = clip(&corners(TRIANGLE), |p| p[2] + 3.0);
        assert_eq!(all.len(), 3);
        assert!(all.iter().zip(TRIANGLE).all(|(c, v)| c.eye == v));
        assert!(clip(&corners(TRIANGLE), |p| p[2] - 7.0).is_empty());
        assert!(clip(&[], |p| p[2]).is_empty());
    }

    #[test]
    fn both_directions_of_an_edge_are_cut_at_the_same_bits() {
        let [a, b, c] = [[0.1, 0.7, -2.3], [4.3, 0.2, 6.9], [0.5, 4.1, 3.3]];
        let cut = |tri| -> Vec<Vec3> {
            clip(&corners(tri), |p| p[2] - 0.3)
                .into_iter()
                .map(|c| c.eye)
                .filter(|p| (p[2] - 0.3).abs() < 1e-9)
                .collect()
        };
        let (there, mut back) = (cut([a, b, c]), cut([a, c, b]));
        back.reverse();
        assert_eq!(there.len(), 2);
        assert_eq!(there, back);
    }
}
