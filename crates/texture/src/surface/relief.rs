//! Heights on a surface, and bump maps: the normal that the heights would have, on a surface that stays where it is.
//!
//! Space in: coordinates (u, v). Space out: heights in object units, normals in the tangent frame.

use super::height::{HeightMap, differences};
use super::normal::to_parent_lanes;
use super::tangent::Tangent;
use super::unit::{narrow, unit};
use super::vector::{absolute_lanes, has_range, over_length};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Frame, Object, Vector3};
use glam::{Vec2, Vec3};

/// A height map as it lies on a surface: the heights for 0 and 1, and the lengths of one unit of u and v. All are in
/// the units of object space.
///
/// Bump, parallax and displacement maps are this, used in three ways: for the normal, for the place of the colour, and
/// for the places of the vertices.
///
/// ```
/// use alberti_texture::surface::Relief;
/// use glam::{Vec2, Vec3};
///
/// // A ramp, rising by 1 over a length of 2.
/// let ramp = Relief { map: |uv: Vec2| uv.x, low: -0.5, high: 0.5, extent: Vec2::new(2.0, 2.0) };
/// assert_eq!(ramp.height(Vec2::new(0.5, 0.0)), 0.0);
/// let normal = ramp.normal(Vec2::ZERO, Vec2::splat(0.25)).coords;
/// assert_eq!(normal, Vec3::new(-0.5, 0.0, 1.0) / 1.25f32.sqrt());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relief<H> {
    /// The heights, from 0 to 1.
    pub map: H,
    /// The height along the normal that 0 stands for.
    pub low: f32,
    /// The height that 1 stands for.
    pub high: f32,
    /// The lengths on the surface of one unit of u and of v: those of ∂f/∂u and ∂f/∂v. Not zero.
    pub extent: Vec2,
}

impl<H: HeightMap> Relief<H> {
    /// The height along the normal: low + (high − low) h.
    ///
    /// # Precision
    /// Within 4ε·max(|low|, |high|) of that of the map's number (ε = 2^-24).
    #[inline]
    pub fn height(&self, uv: Vec2) -> f32 {
        self.height_lanes(One, uv.to_array())
    }

    /// [`height`](Self::height) at several places.
    ///
    /// # Precision
    /// In fixed point within 1.6·2^-16, and (|low| + |high|)·2^-16 of the map's number.
    #[inline(always)]
    pub fn height_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2]) -> L::Number {
        lanes.splat(self.low) + self.range(lanes) * self.map.height_lanes(lanes, uv)
    }

    /// From the least to the greatest height.
    #[inline(always)]
    fn range<L: Lanes>(&self, lanes: L) -> L::Number {
        lanes.splat(self.high) - lanes.splat(self.low)
    }

    /// The slopes of the surface along u and v, in object units: the central differences (h(u + s) − h(u − s)) / 2s.
    /// The `step` s to either side usually is one texel.
    ///
    /// # Precision
    /// Within |high − low|/extent·(s²/6·max|∂³h/∂u³| + ε/s) + 4ε·|slope| (ε = 2^-24), if the map's numbers are
    /// correctly rounded. Bytes are not: theirs is 1/(510 s) instead of ε/s.
    ///
    /// # Cost
    /// Four heights and two divisions.
    pub fn slope(&self, uv: Vec2, step: Vec2) -> Vec2 {
        Vec2::from(self.slope_lanes(One, uv.to_array(), step))
    }

    /// [`slope`](Self::slope) at several places.
    ///
    /// # Precision
    /// In fixed point within |high − low|/extent·(s²/6·max|∂³h/∂u³| + 2^-16/s) + 2^-14, if steps and extents are exact.
    #[inline(always)]
    pub fn slope_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2], step: Vec2) -> [L::Number; 2] {
        let [along_u, along_v] = differences(lanes, &self.map, uv, step);
        let (width, height) = (lanes.splat(self.extent.x), lanes.splat(self.extent.y));
        [along_u * self.range(lanes) / width, along_v * self.range(lanes) / height]
    }

    /// The normal of the heights: that of a bump map, by central differences.
    ///
    /// # Precision
    /// That of [`slope`](Self::slope), and 2ε radians (ε = 2^-24).
    ///
    /// # Cost
    /// Four heights, five divisions and a square root.
    pub fn normal(&self, uv: Vec2, step: Vec2) -> Vector3<Tangent> {
        normal_of_slope(self.slope(uv, step))
    }

    /// [`normal`](Self::normal) at several places.
    #[must_use]
    #[inline(always)]
    pub fn normal_lanes<L: Lanes>(&self, lanes: L, uv: [L::Number; 2], step: Vec2) -> [L::Number; 3] {
        normal_of_slope_lanes(lanes, self.slope_lanes(lanes, uv, step))
    }
}

/// The unit normal of a surface that rises by these slopes along u and v, which are at right angles: (−∂h/∂u, −∂h/∂v,
/// 1), made unit. (0, 0, 1) where a slope is not finite, or above 2^60.
///
/// # Precision
/// Each component is within 4ε of itself (ε = 2^-24), or within 2^-126, and the length within 3.1ε of 1.
///
/// # Cost
/// A square root and three divisions.
#[must_use]
#[inline]
pub fn normal_of_slope(slope: Vec2) -> Vector3<Tangent> {
    Vector3::new(Vec3::from(normal_of_slope_lanes(One, slope.to_array())))
}

/// [`normal_of_slope`] of several slopes.
///
/// # Precision
/// In fixed point each component is within 3·2^-16, for any slopes.
#[must_use]
#[inline(always)]
pub fn normal_of_slope_lanes<L: Lanes>(lanes: L, slope: [L::Number; 2]) -> [L::Number; 3] {
    over_length(lanes, raised(lanes, slope))
}

/// The normal of heights that rise by these slopes along the x and y axis of a frame, as a unit vector of the frame's
/// parent. It is −∂h/∂u x − ∂h/∂v y + z, made unit. The frame is one with unit axes, as for [`to_parent_lanes`]; for
/// axes at right angles, the result is that of [`bump`]. The frame's z where a slope is not finite, or above 2^60.
///
/// # Precision
/// Within 8ε radians (ε = 2^-24) for axes at right angles; in fixed point each component is within 6·2^-16.
///
/// # Cost
/// That of [`to_parent_lanes`], and some comparisons.
#[must_use]
#[inline(always)]
pub fn bump_lanes<L: Lanes>(lanes: L, axes: [[L::Number; 3]; 3], slope: [L::Number; 2]) -> [L::Number; 3] {
    to_parent_lanes(lanes, axes, raised(lanes, slope))
}

/// A vector along (−a, −b, 1), whose components have squares.
#[inline(always)]
fn raised<L: Lanes>(lanes: L, [a, b]: [L::Number; 2]) -> [L::Number; 3] {
    let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
    if has_range(lanes) {
        // 2^120; and not so for NaN.
        let finite = lanes.less(a * a + b * b + one, lanes.splat(1.329_227_9e36));
        return [lanes.select(finite, zero - a, zero), lanes.select(finite, zero - b, zero), one];
    }
    let greatest = lanes.max(lanes.max(absolute_lanes(lanes, a), absolute_lanes(lanes, b)), one);
    [(zero - a) / greatest, (zero - b) / greatest, one / greatest]
}

/// The normal of heights on any surface, whose ∂f/∂u and ∂f/∂v are of any length and at any angle, as a unit vector.
/// The frame is that of [`Parametric::tangent_frame`](super::Parametric::tangent_frame), the gradient ∂h/∂u and ∂h/∂v,
/// in object units per unit of u and v.
///
/// With n the unit normal, the surface f + h n has the derivatives ∂f/∂u + ∂h/∂u n and ∂f/∂v + ∂h/∂v n, but for h times
/// the change of n. That is small where h is small against the radii of curvature. The cross product of the derivatives
/// is
///
/// ```text
/// ∂f/∂u × ∂f/∂v + ∂h/∂u (n × ∂f/∂v) + ∂h/∂v (∂f/∂u × n)
/// ```
///
/// The frame's z where the result has no direction, (0, 0, 1) where that has none either.
///
/// Source: Blinn, "Simulation of wrinkled surfaces", SIGGRAPH 1978.
///
/// # Precision
/// Within 2ε radians of that vector of the frame's axes (ε = 2^-24), if its length is at least 2^-20 of the sum of the
/// terms' lengths.
///
/// # Cost
/// Some 80 operations in `f64`, in software on a core without it, and two square roots.
#[must_use]
pub fn bump(frame: &Frame<Tangent, Object>, gradient: Vec2) -> Vector3<Object> {
    let axes = frame.axes();
    let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis.as_dvec3());
    let Some(n) = unit(z) else { return Vector3::new(Vec3::Z) };
    let bent = z + n.cross(y) * f64::from(gradient.x) + x.cross(n) * f64::from(gradient.y);
    Vector3::new(narrow(unit(bent).unwrap_or(n)))
}
