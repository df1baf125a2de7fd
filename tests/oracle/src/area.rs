//! The part of a pixel's square that a triangle covers, exactly: what clipping at its four sides leaves, in rationals.

use crate::coverage::Triangle;
use crate::rational::{Rational, from_int};
use num_traits::Signed;

/// A point of the screen, in subpixels.
type Point = [Rational; 2];

/// The covered part of the pixel with this column and row, from 0 to 1, on a grid with so many bits of subpixels.
///
/// ```
/// use alberti_oracle::area::covered;
/// use alberti_oracle::rational::to_f64;
///
/// let triangle = [[0, 0], [32, 0], [0, 32]];
/// let parts = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|pixel| to_f64(&covered(triangle, 4, pixel)));
/// assert_eq!(parts, [1.0, 0.5, 0.5, 0.0]);
/// ```
#[must_use]
pub fn covered(triangle: Triangle, bits: u32, pixel: [i64; 2]) -> Rational {
    let mut polygon: Vec<Point> = triangle.map(|corner| corner.map(|c| from_int(c.into()))).to_vec();
    for axis in 0..2 {
        let [low, high] = [pixel[axis], pixel[axis] + 1].map(|c| from_int(i128::from(c) << bits));
        polygon = clip(&polygon, |p| &p[axis] - &low);
        polygon = clip(&polygon, |p| &high - &p[axis]);
    }
    let twice: Rational = sides(&polygon).map(|(a, b)| &a[0] * &b[1] - &a[1] * &b[0]).sum();
    twice.abs() / from_int(2 << (2 * bits))
}

fn sides(polygon: &[Point]) -> impl Iterator<Item = (&Point, &Point)> {
    polygon.iter().zip(polygon.iter().cycle().skip(1))
}

/// What of a polygon is where the distance is not negative.
fn clip(polygon: &[Point], distance: impl Fn(&Point) -> Rational) -> Vec<Point> {
    let mut kept = vec![];
    for (a, b) in sides(polygon) {
        let [from, to] = [a, b].map(&distance);
        if !from.is_negative() {
            kept.push(a.clone());
        }
        if (&from * &to).is_negative() {
            let at = &from / (&from - &to);
            kept.push([0, 1].map(|axis: usize| &a[axis] + (&b[axis] - &a[axis]) * &at));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coverage::area2;
    use crate::rng::{Rng, run_seed};
    use num_traits::Zero;

    #[test]
    fn the_parts_of_all_pixels_are_the_triangle() {
        let mut rng = Rng::new(run_seed());
        for bits in [4, 8] {
            for _ in 0..40 {
                let mut corner = || [rng.range(-40, 120) << (bits - 4), rng.range(-9, 90) << (bits - 4)];
                let triangle = [corner(), corner(), corner()];
                let pixels = (-3..8).flat_map(|row| (-3..8).map(move |column| [column, row]));
                let sum: Rational = pixels.map(|pixel| covered(triangle, bits, pixel)).sum();
                assert_eq!(sum, from_int(area2(triangle).abs()) / from_int(2 << (2 * bits)), "{triangle:?}");
            }
        }
    }

    #[test]
    fn nothing_is_covered_by_nothing() {
        for triangle in [[[3, 3]; 3], [[0, 0], [16, 16], [32, 32]], [[16, 0], [32, 0], [16, 16]]] {
            assert!(covered(triangle, 4, [0, 0]).is_zero());
        }
    }
}
