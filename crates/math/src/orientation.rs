//! The side of a line, and the zone of a triangle, in which a point of the plane lies: exactly.

use crate::exact::{det2, nearest, replaced};
use crate::space::{Point2, Space};
use core::cmp::Ordering;

/// The signed area of the triangle `a b c`: positive when its vertices run counter-clockwise (with y up).
///
/// Half the determinant whose columns are (a, 1), (b, 1), (c, 1), computed from the differences to `a`.
///
/// # Precision
/// Within 1.05ε·max(|area|, `f32::MIN_POSITIVE`) of the exact area, whatever the triangle's shape and place (ε =
/// 2^-24). Infinite where the area is beyond `f32::MAX`, NaN where a coordinate is not finite. An area that is not
/// zero can round to zero; [`orientation`] tells the difference.
///
/// # Cost
/// Ten operations in `f64`, some hundreds where the area is below a millionth of the products that it is the
/// difference of. A core without `f64` does them in software: the rasterizer uses integers instead.
#[must_use]
pub fn signed_area<S: Space>(a: Point2<S>, b: Point2<S>, c: Point2<S>) -> f32 {
    nearest(doubled_area([a, b, c].map(|v| v.coords.to_array())) / 2.0)
}

/// The orientation of the triangle `a b c`: its signed area compared with zero. `Greater` where the vertices run
/// counter-clockwise (with y up), `Equal` where they are on one line, `Less` where they run clockwise. `None` where a
/// coordinate is NaN or infinite.
///
/// In other words, the side of the line from `a` to `b` on which the point `c` lies: `Greater` is left.
///
/// # Precision
/// Exact for all finite coordinates.
///
/// # Cost
/// As [`signed_area`].
///
/// ```
/// use alberti_math::{Point2, World, glam::Vec2, orientation};
/// use core::cmp::Ordering;
///
/// let at = |x, y| Point2::<World>::new(Vec2::new(x, y));
/// assert_eq!(orientation(at(0.0, 0.0), at(3.0, 1.0), at(6.0, 2.0)), Some(Ordering::Equal));
/// assert_eq!(orientation(at(0.0, 0.0), at(3.0, 1.0), at(6.0, 2.0000002)), Some(Ordering::Greater));
/// ```
#[must_use]
pub fn orientation<S: Space>(a: Point2<S>, b: Point2<S>, c: Point2<S>) -> Option<Ordering> {
    doubled_area([a, b, c].map(|v| v.coords.to_array())).partial_cmp(&0.0)
}

/// A part of the plane as a triangle divides it, by the signs of the barycentric coordinates.
///
/// Its three lines bound seven zones: the triangle, and outside of it three zones beyond an edge, where one coordinate
/// is negative, and three beyond a vertex, where two are. Points on the triangle's border are told apart; of the
/// others, those on a line belong to the zone beyond the edge.
///
/// ```text
///      beyond   \ /
///     vertex 2   2
///               / \
///    beyond    /   \    beyond
///    edge 1   /  in \   edge 0
///            / side  \
///     ------0---------1------
///   beyond /  beyond   \ beyond
/// vertex 0/   edge 2    \vertex 1
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Zone {
    /// All coordinates are positive.
    Inside,
    /// On the edge opposite to this vertex, between its ends: this coordinate is 0, the others are positive.
    OnEdge(usize),
    /// At this vertex: this coordinate is 1, the others are 0.
    OnVertex(usize),
    /// Outside the edge opposite to this vertex: this coordinate is negative, and no other.
    BeyondEdge(usize),
    /// Outside both edges that meet at this vertex: the other two coordinates are negative.
    BeyondVertex(usize),
}

impl Zone {
    /// The zone in which `p` lies with respect to a triangle, given in either direction; `None` where the triangle has
    /// no area, or where a coordinate is NaN or infinite.
    ///
    /// # Precision
    /// Exact for all finite coordinates.
    ///
    /// # Cost
    /// Four times [`signed_area`].
    ///
    /// ```
    /// use alberti_math::{Point2, World, Zone, glam::Vec2};
    ///
    /// let at = |x, y| Point2::<World>::new(Vec2::new(x, y));
    /// let triangle = [at(0.0, 0.0), at(4.0, 0.0), at(0.0, 4.0)];
    /// assert_eq!(Zone::of(at(1.0, 1.0), triangle), Some(Zone::Inside));
    /// assert_eq!(Zone::of(at(2.0, 2.0), triangle), Some(Zone::OnEdge(0)));
    /// assert_eq!(Zone::of(at(-1.0, -1.0), triangle), Some(Zone::BeyondVertex(0)));
    /// ```
    #[must_use]
    pub fn of<S: Space>(p: Point2<S>, triangle: [Point2<S>; 3]) -> Option<Self> {
        let p = p.coords.to_array();
        let corners = triangle.map(|v| v.coords.to_array());
        let whole = doubled_area(corners).partial_cmp(&0.0)?;
        let mut signs = [Ordering::Equal; 3];
        for (k, sign) in signs.iter_mut().enumerate() {
            let part = doubled_area(replaced(corners, k, p)).partial_cmp(&0.0)?;
            *sign = if whole.is_lt() { part.reverse() } else { part };
        }
        if whole.is_eq() {
            return None;
        }
        let count = |sign| signs.iter().filter(|s| **s == sign).count();
        let first = |wanted: fn(Ordering) -> bool| signs.iter().position(|s| wanted(*s));
        Some(match (count(Ordering::Less), count(Ordering::Equal)) {
            (0, 0) => Self::Inside,
            (0, 1) => Self::OnEdge(first(Ordering::is_eq)?),
            (0, _) => Self::OnVertex(first(Ordering::is_gt)?),
            (1, _) => Self::BeyondEdge(first(Ordering::is_lt)?),
            (_, _) => Self::BeyondVertex(first(Ordering::is_gt)?),
        })
    }
}

/// Twice the signed area: its sign exact, its value within 2^-30 relatively; NaN where a coordinate is not finite.
pub(crate) fn doubled_area([a, b, c]: [[f32; 2]; 3]) -> f64 {
    det2([[a, b], [a, c]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::World;
    use glam::Vec2;

    fn p(x: f32, y: f32) -> Point2<World> {
        Point2::new(Vec2::new(x, y))
    }

    #[test]
    fn counter_clockwise_is_positive() {
        assert_eq!(signed_area(p(0.0, 0.0), p(4.0, 0.0), p(0.0, 3.0)), 6.0);
        assert_eq!(signed_area(p(0.0, 0.0), p(0.0, 3.0), p(4.0, 0.0)), -6.0);
        assert_eq!(orientation(p(0.0, 0.0), p(4.0, 0.0), p(0.0, 3.0)), Some(Ordering::Greater));
        assert_eq!(signed_area(p(0.0, 0.0), p(0.0, 1e30), p(1e30, 0.0)), f32::NEG_INFINITY);
        assert!(signed_area(p(0.0, 0.0), p(0.0, f32::INFINITY), p(1e30, 0.0)).is_nan());
        assert_eq!(orientation(p(0.0, 0.0), p(f32::INFINITY, 0.0), p(0.0, 3.0)), None);
    }

    /// The answers of the drawing beside [`Zone`], and of the lines between its zones.
    #[test]
    fn every_zone_is_where_it_is_drawn() {
        let triangle = [p(0.0, 0.0), p(4.0, 0.0), p(0.0, 4.0)];
        let flipped = [triangle[0], triangle[2], triangle[1]];
        let exchanged = [0, 2, 1];
        for (point, zone) in [
            (p(1.0, 1.0), Zone::Inside),
            (p(3.0, 3.0), Zone::BeyondEdge(0)),
            (p(-1.0, 2.0), Zone::BeyondEdge(1)),
            (p(2.0, -1.0), Zone::BeyondEdge(2)),
            (p(-1.0, -1.0), Zone::BeyondVertex(0)),
            (p(6.0, -1.0), Zone::BeyondVertex(1)),
            (p(-1.0, 6.0), Zone::BeyondVertex(2)),
            (p(1.0, 3.0), Zone::OnEdge(0)),
            (p(0.0, 3.0), Zone::OnEdge(1)),
            (p(3.0, 0.0), Zone::OnEdge(2)),
            (triangle[0], Zone::OnVertex(0)),
            (triangle[1], Zone::OnVertex(1)),
            (triangle[2], Zone::OnVertex(2)),
            (p(-1.0, 0.0), Zone::BeyondEdge(1)),
            (p(0.0, -1.0), Zone::BeyondEdge(2)),
            (p(5.0, 0.0), Zone::BeyondEdge(0)),
        ] {
            assert_eq!(Zone::of(point, triangle), Some(zone));
            let mirrored = match zone {
                Zone::Inside => zone,
                Zone::OnEdge(k) => Zone::OnEdge(exchanged[k]),
                Zone::OnVertex(k) => Zone::OnVertex(exchanged[k]),
                Zone::BeyondEdge(k) => Zone::BeyondEdge(exchanged[k]),
                Zone::BeyondVertex(k) => Zone::BeyondVertex(exchanged[k]),
            };
            assert_eq!(Zone::of(point, flipped), Some(mirrored));
        }
        assert_eq!(Zone::of(p(1.0, 1.0), [p(0.0, 0.0), p(1.0, 1.0), p(2.0, 2.0)]), None);
        assert_eq!(Zone::of(p(1.0, f32::NAN), triangle), None);
    }
}
