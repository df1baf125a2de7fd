//! Directions in two bytes: places on an octahedron, unfolded to a square.

use crate::{Q16, floor_i32};
use glam::Vec3;

/// The greatest coordinate.
const GREATEST: i8 = 127;

/// A direction in two bytes, for normals and tangents that lie in flash.
///
/// The octahedron |x| + |y| + |z| = 127 is seen along z; its lower half is turned out around the edges, so that both
/// halves fill the square.
///
/// ```text
///  +-------+-------+      in the inner square z >= 0 and (x, y) are as they are;
///  |     / | \     |      outside z < 0, and (x, y) are mirrored on the square's side
///  |   /   |   \   |
///  +-------+-------+
///  |   \   |   /   |
///  |     \ | /     |
///  +-------+-------+
/// ```
///
/// ```
/// use alberti_math::{Octahedral, glam::Vec3};
///
/// let up = Octahedral::nearest(Vec3::Y);
/// assert_eq!((up.0, up.to_vec3()), ([0, 127], Vec3::Y));
/// ```
///
/// # Precision
/// [`nearest`](Self::nearest) gives the nearest of all directions around the place on the octahedron: within 0.64
/// degrees of the one that was given, 0.33 on average.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Octahedral(
    /// The place on the square, from -127 to 127 on each axis; -128 counts as -127.
    pub [i8; 2],
);

impl Octahedral {
    /// The nearest to a direction of any length. What has none is (0, 0, 1).
    #[must_use]
    pub fn nearest(direction: Vec3) -> Self {
        // Squares of the longest component neither vanish nor overflow then.
        let scaled = direction / direction.abs().max_element();
        let Some(unit) = scaled.try_normalize() else { return Self([0; 2]) };
        let [x, y, z] = (unit / (unit.x.abs() + unit.y.abs() + unit.z.abs())).to_array();
        let turned_out = [(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)];
        let place = if z < 0.0 { turned_out } else { [x, y] };
        #[expect(clippy::cast_possible_truncation, reason = "at most 127")]
        let floor = place.map(|c| floor_i32(c * f32::from(GREATEST)) as i8);
        let around = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[right, up]| {
            let at = |c: i8, more: i8| c.saturating_add(more).clamp(-GREATEST, GREATEST);
            Self([at(floor[0], right), at(floor[1], up)])
        });
        // By the distance: cosines of small angles are all 1.
        let distance = |candidate: &Self| candidate.to_vec3().distance_squared(unit);
        let nearer = |a: Self, b: Self| if distance(&b) < distance(&a) { b } else { a };
        around.into_iter().fold(around[0], nearer)
    }

    /// The unit vector.
    ///
    /// # Precision
    /// Each component is within 2^-14 of the exact one.
    ///
    /// # Cost
    /// A square root and a division of integers.
    #[must_use]
    #[inline]
    pub fn components(self) -> [Q16; 3] {
        let [x, y] = self.0.map(|c| i32::from(c.max(-GREATEST)));
        let z = i32::from(GREATEST) - x.abs() - y.abs();
        // Below the square's inner half, x and y by what |x| + |y| is too much, towards 0.
        let over = (-z).max(0);
        let inward = |c: i32, other: i32| {
            let size = i32::from(GREATEST) - other.abs();
            if over == 0 {
                c
            } else if c < 0 {
                -size
            } else {
                size
            }
        };
        let vector = [inward(x, y), inward(y, x), z];
        let squared: i32 = vector.iter().map(|c| c * c).sum();
        // The length in 2^-8, from 73 to 127, and its reciprocal in 2^-23.
        let length = (squared.cast_unsigned() << 16).isqrt();
        let reciprocal = ((1_u32 << 31) / length.max(1)).cast_signed();
        vector.map(|c| Q16::from_bits((c * reciprocal + (1 << 6)) >> 7))
    }

    /// The same in floats.
    #[must_use]
    #[inline]
    pub fn to_vec3(self) -> Vec3 {
        Vec3::from_array(self.components().map(Q16::to_f32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit vector of two bytes in 64 bits, by the definition (Cigolle et al. 2014).
    fn exact([x, y]: [i8; 2]) -> [f64; 3] {
        let [x, y] = [x, y].map(|c| f64::from(c) / 127.0);
        let z = 1.0 - x.abs() - y.abs();
        let sign = |c: f64| if c < 0.0 { -1.0 } else { 1.0 };
        let [x, y] = if z < 0.0 { [(1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y)] } else { [x, y] };
        let length = (x * x + y * y + z * z).sqrt();
        [x, y, z].map(|c| c / length)
    }

    #[test]
    fn all_are_unit_vectors_as_they_say() {
        let mut worst = 0.0_f64;
        for x in -127..=127_i8 {
            for y in -127..=127_i8 {
                let found = Octahedral([x, y]).components().map(|c| f64::from(c.to_bits()) / 65536.0);
                let right = exact([x, y]);
                let off = found.iter().zip(right).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                worst = worst.max(off);
            }
        }
        assert!(worst <= 1.0 / 16384.0 && worst > 1.0 / 131_072.0, "{worst}");
        // The byte that no direction is stored as.
        assert_eq!(Octahedral([-128, -128]).components(), Octahedral([-127, -127]).components());
    }

    #[test]
    fn directions_are_as_near_as_they_say() {
        let (mut worst, mut sum, mut count) = (0.0_f64, 0.0, 0.0);
        for k in 0..400_000_u32 {
            // Evenly over the sphere: a spiral with the golden angle.
            let height = (f64::from(k) + 0.5) / 200_000.0 - 1.0;
            let turn = f64::from(k) * 2.399_963_229_728_653;
            let radius = (1.0 - height * height).sqrt();
            let given = [radius * turn.cos(), radius * turn.sin(), height];
            #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
            let direction = Vec3::from_array(given.map(|c| (c * 3.0) as f32));
            let found = exact(Octahedral::nearest(direction).0);
            let chord = found.iter().zip(given).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
            let degrees = (2.0 * (chord / 2.0).asin()).to_degrees();
            (worst, sum, count) = (worst.max(degrees), sum + degrees, count + 1.0);
        }
        assert!(worst <= 0.64 && worst > 0.5, "{worst}");
        assert!(sum / count <= 0.33 && sum / count > 0.2, "{}", sum / count);
    }

    #[test]
    fn axes_are_exact_and_nothing_looks_forward() {
        for axis in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z] {
            for length in [5.0, 1e30, 1e-40] {
                let found = Octahedral::nearest(axis * length).to_vec3();
                assert!(found.distance(axis) < 1.0 / 16384.0, "{axis} {length}");
            }
        }
        for none in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
            assert_eq!(Octahedral::nearest(none).to_vec3(), Vec3::Z);
        }
    }
}
