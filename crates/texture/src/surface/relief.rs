//! Heights on a surface, and bump maps: the normal that the heights would have, on a surface that stays where it is.
//!
//! Space in: coordinates (u, v). Space out: heights in object units, normals in the tangent frame.

use super::tangent::Tangent;
use super::unit::{narrow, unit};
use crate::{Filter, Sampler, Size, TexelFormat, Texture, Wrap};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Frame, Object, Vector3};
use glam::{Vec2, Vec3};

/// A height for each (u, v), from 0 to 1.
///
/// A closure is one, and so is a [`Sampler`], of which it is the red channel, in steps of 1/255: as a filter gives no
/// finer ones, the differences of a magnified map have steps too, and [`bilinear_height`] is for those.
pub trait HeightMap {
    /// The height at (u, v).
    fn height(&self, uv: Vec2) -> f32;
}

impl<F: Fn(Vec2) -> f32> HeightMap for F {
    #[inline]
    fn height(&self, uv: Vec2) -> f32 {
        self(uv)
    }
}

impl<F: TexelFormat, Fl: Filter, U: Wrap, V: Wrap, Z: Size> HeightMap for Sampler<'_, F, Fl, U, V, Z> {
    #[inline]
    fn height(&self, uv: Vec2) -> f32 {
        let [red, ..] = self.sample(uv).to_bytes();
        f32::from(red) / 255.0
    }
}

/// A height map as it lies on a surface: what 0 and 1 stand for, and how large one unit of u and v is, all in the units
/// of object space.
///
/// Bump, parallax and displacement maps are this, used in three ways: for the normal, for where to look the colour up,
/// and for where the vertices go.
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
    /// What 0 stands for: how far along the normal.
    pub low: f32,
    /// What 1 stands for.
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
        self.low + (self.high - self.low) * self.map.height(uv)
    }

    /// How steeply the surface rises along u and v, by central differences over `step` to either side, which usually is
    /// one texel: (h(u + s) − h(u − s)) / 2s, in object units.
    ///
    /// # Precision
    /// Within |high − low|/extent·(s²/6·max|∂³h/∂u³| + ε/s) + 4ε·|slope| (ε = 2^-24), if the map's numbers are
    /// correctly rounded. Bytes are not: theirs is 1/(510 s) instead of ε/s.
    ///
    /// # Cost
    /// Four heights and two divisions.
    pub fn slope(&self, uv: Vec2, step: Vec2) -> Vec2 {
        let along = |step: Vec2| {
            let (from, to) = (uv - step, uv + step);
            // What the coordinates were rounded to; one component is the step, the other is zero.
            let between = to - from;
            (self.map.height(to) - self.map.height(from)) / (between.x + between.y)
        };
        let steepness = Vec2::new(along(Vec2::new(step.x, 0.0)), along(Vec2::new(0.0, step.y)));
        steepness * (self.high - self.low) / self.extent
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
    let square = slope.x * slope.x + slope.y * slope.y + 1.0;
    // 2^120.
    if square.is_nan() || square > 1.329_227_9e36 {
        return Vector3::new(Vec3::Z);
    }
    let length = One.sqrt(square);
    Vector3::new(Vec3::new(-slope.x / length, -slope.y / length, 1.0 / length))
}

/// The normal of heights on any surface, whose ∂f/∂u and ∂f/∂v are of any length and at any angle, as a unit vector:
/// the frame is that of [`Parametric::tangent_frame`](super::Parametric::tangent_frame), the gradient ∂h/∂u and ∂h/∂v,
/// in object units per unit of u and v.
///
/// With n the unit normal, the surface f + h n has the derivatives ∂f/∂u + ∂h/∂u n and ∂f/∂v + ∂h/∂v n, but for what h
/// makes of the change of n, which is small where h is small against the radii of curvature. Their cross product is
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

/// The height of a texture's red channel at (u, v), from 0 to 1, and its gradient there, ∂h/∂u and ∂h/∂v: those of the
/// bilinear surface through the four texel centres around the point, without the steps of 8 bits that
/// [`Bilinear`](crate::Bilinear) rounds to.
///
/// The height is continuous, the gradient jumps from one square of texel centres to the next.
///
/// # Precision
/// The height is within 6ε (ε = 2^-24), the gradient within 6ε·width, or ·height, of those at the given coordinates,
/// for
/// |u·width| and |v·height| below 2^31. Beyond, and for what is not finite, they are those at some other place.
///
/// # Cost
/// Four texels and about 30 operations, six of them in `f64`, in software on a core without it.
#[must_use]
pub fn bilinear_height<F: TexelFormat, Z: Size, U: Wrap, V: Wrap>(
    texture: &Texture<'_, F, Z>,
    uv: Vec2,
) -> (f32, Vec2) {
    let (width, height) = (texture.width(), texture.height());
    let ((i, s), (j, t)) = (cell(uv.x, width), cell(uv.y, height));
    let at = |i: i32, j: i32| {
        let row = height.saturating_sub(1).saturating_sub(V::index(j, height));
        let [red, ..] = texture.texel(U::index(i, width), row).to_bytes();
        f32::from(red)
    };
    let (right, up) = (i.saturating_add(1), j.saturating_add(1));
    let [low_left, low_right, high_left, high_right] = [at(i, j), at(right, j), at(i, up), at(right, up)];
    let (low, high) = (low_right - low_left, high_right - high_left);
    let (left, rise) = (high_left - low_left, high - low);
    #[expect(clippy::cast_precision_loss, reason = "at most 2^14")]
    let size = Vec2::new(width as f32, height as f32);
    let value = (1.0 - t) * (low_left + s * low) + t * (high_left + s * high);
    (value / 255.0, Vec2::new(low + t * rise, left + s * rise) * size / 255.0)
}

/// The texel centre below a coordinate, and how far above it that is, from 0 to 1.
#[expect(clippy::cast_possible_truncation, reason = "saturation, or rounding")]
fn cell(u: f32, size: u32) -> (i32, f32) {
    let x = f64::from(u) * f64::from(size) - 0.5;
    let towards_zero = x as i32;
    let below = if f64::from(towards_zero) > x { towards_zero.saturating_sub(1) } else { towards_zero };
    let above = (x - f64::from(below)) as f32;
    // Beyond the integers there is no fraction.
    (below, if (0.0..=1.0).contains(&above) { above } else { 0.0 })
}
