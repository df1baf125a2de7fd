//! Surfaces that a formula gives, and their tangent frames.
//!
//! Space in: coordinates (u, v). Space out: `Frame<Tangent, Object>`.

use super::tangent::{Tangent, frame, frame_of_derivatives, orthonormal};
use super::unit::narrow;
use alberti_math::{Frame, Object, Point3, Vector3};
use core::f64::consts::{FRAC_PI_2, TAU};
use glam::{DVec3, Vec2};

/// A surface f(u, v).
///
/// A closure is one, if it gives the frame: with derivatives that you work out, by [`frame_of_derivatives`]. One that
/// gives points only becomes one by [`Differences`].
///
/// ```
/// use alberti_math::{Object, Point3, Vector3};
/// use alberti_texture::surface::{Parametric, frame_of_derivatives};
/// use glam::{Vec2, Vec3};
///
/// // The saddle z = u v.
/// let saddle = |uv: Vec2| {
///     let point = Point3::<Object>::new(Vec3::new(uv.x, uv.y, uv.x * uv.y));
///     let (du, dv) = (Vec3::new(1.0, 0.0, uv.y), Vec3::new(0.0, 1.0, uv.x));
///     frame_of_derivatives(point, Vector3::new(du), Vector3::new(dv))
/// };
/// assert_eq!(saddle.tangent_frame(Vec2::ZERO).axes().z_axis, Vec3::Z);
/// ```
pub trait Parametric {
    /// The frame whose origin is f(u, v) and whose axes are ∂f/∂u, ∂f/∂v and ∂f/∂u × ∂f/∂v.
    fn tangent_frame(&self, uv: Vec2) -> Frame<Tangent, Object>;

    /// The same with unit axes at right angles, and with a choice where a derivative is zero: see [`orthonormal`].
    fn orthonormal_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        orthonormal(self.tangent_frame(uv))
    }
}

impl<F: Fn(Vec2) -> Frame<Tangent, Object>> Parametric for F {
    fn tangent_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        self(uv)
    }
}

/// A surface whose derivatives are taken as central differences, (f(u + h) − f(u − h)) / 2h.
///
/// # Precision
/// h²/6·max|∂³f/∂u³| + 1.5ε·max|f|/h (ε = 2^-24), if the closure's components are correctly rounded: the first term is
/// of the curve's bend, the second of rounding. They balance near h = (4.5ε·max|f|/max|∂³f/∂u³|)^(1/3), which is 2^-10
/// for the sphere below, one turn around per unit of u; there, a derivative is within 2.1·10^-5 of its greatest.
///
/// # Cost
/// Five calls of the closure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences<F> {
    /// The point for each (u, v).
    pub surface: F,
    /// h for u and for v.
    pub step: Vec2,
}

impl<F: Fn(Vec2) -> Point3<Object>> Parametric for Differences<F> {
    fn tangent_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        let along = |step: Vec2| {
            let (from, to) = (uv - step, uv + step);
            // The distance of the rounded coordinates; one component is that of the step, the other is zero.
            let between = to.as_dvec2() - from.as_dvec2();
            let ends = [to, from].map(|uv| (self.surface)(uv).coords.as_dvec3());
            Vector3::new(narrow((ends[0] - ends[1]) / (between.x + between.y)))
        };
        let (du, dv) = (along(Vec2::new(self.step.x, 0.0)), along(Vec2::new(0.0, self.step.y)));
        frame_of_derivatives((self.surface)(uv), du, dv)
    }
}

/// The plane origin + u du + v dv.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The point of (0, 0).
    pub origin: Point3<Object>,
    /// From (0, 0) to (1, 0).
    pub du: Vector3<Object>,
    /// From (0, 0) to (0, 1).
    pub dv: Vector3<Object>,
}

impl Parametric for Plane {
    fn tangent_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        let [origin, du, dv] = [self.origin.coords, self.du.coords, self.dv.coords].map(|v| v.as_dvec3());
        let point = origin + du * f64::from(uv.x) + dv * f64::from(uv.y);
        frame_of_derivatives(Point3::new(narrow(point)), self.du, self.dv)
    }
}

/// The sphere about the origin: u goes around the axis y once, towards the east, v from the south pole at 0 to the
/// north pole at 1. u = 0 faces the axis z. The normal points outwards.
///
/// At the poles ∂f/∂u is zero; the orthonormal frame is the limit along the meridian. Beyond them v goes down the other
/// side, where ∂f/∂u points the other way, and the orthonormal frame does not.
///
/// # Precision
/// Each component of the point, of the derivatives and of the orthonormal axes is within
/// 1.01ε·max(|exact|, `f32::MIN_POSITIVE`) of that at these `f32` coordinates (ε = 2^-24). Each of the cross product is
/// as in [`frame_of_derivatives`]. Coordinates of 2^23 turns and more have no fraction, and count as 0; so do
/// infinities and NaN.
///
/// # Cost
/// About 80 operations in `f64`, in software on a core without it. No library function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// The radius: positive.
    pub radius: f32,
}

/// The tube around the axis y: u goes around once, v from y = 0 at 0 to y = `height` at 1. u = 0 faces the axis z. The
/// normal points outwards.
///
/// # Precision
/// As [`Sphere`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// The radius: positive.
    pub radius: f32,
    /// The height: positive.
    pub height: f32,
}

/// The torus about the axis y: u goes around the axis once, v around the tube, from its outermost circle upwards. u = 0
/// faces the axis z. The normal points outwards.
///
/// # Precision
/// As [`Sphere`], for a `major` of at least twice `minor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// The radius of the circle that the tube follows; greater than `minor`.
    pub major: f32,
    /// The radius of the tube; positive.
    pub minor: f32,
}

impl Parametric for Sphere {
    fn tangent_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        let (around, up) = ([uv.x.into(), 1.0], [latitude(uv), 0.5]);
        ring([0.0, self.radius.into()], around, up)
    }

    fn orthonormal_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        frame(self.tangent_frame(uv).origin(), directions(uv.x.into(), latitude(uv)))
    }
}

impl Parametric for Torus {
    fn tangent_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        ring([self.major.into(), self.minor.into()], [uv.x.into(), 1.0], [uv.y.into(), 1.0])
    }

    fn orthonormal_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        frame(self.tangent_frame(uv).origin(), directions(uv.x.into(), uv.y.into()))
    }
}

impl Parametric for Cylinder {
    fn tangent_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        let [x, y, z] = directions(uv.x.into(), 0.0);
        let (radius, height) = (f64::from(self.radius), f64::from(self.height));
        let point = z * radius + y * (height * f64::from(uv.y));
        let (du, dv) = (x * (TAU * radius), y * height);
        frame_of_derivatives(Point3::new(narrow(point)), Vector3::new(narrow(du)), Vector3::new(narrow(dv)))
    }

    fn orthonormal_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        frame(self.tangent_frame(uv).origin(), directions(uv.x.into(), 0.0))
    }
}

/// The sphere's latitude, in turns.
fn latitude(uv: Vec2) -> f64 {
    (f64::from(uv.y) - 0.5) * 0.5
}

/// A circle of radius `minor` about a circle of radius `major`, at angles in turns; with each, the turns per unit of u
/// or v.
fn ring([major, minor]: [f64; 2], [u, per_u]: [f64; 2], [v, per_v]: [f64; 2]) -> Frame<Tangent, Object> {
    let [x, y, z] = directions(u, v);
    // Towards the north, y is as high as z is far from the axis.
    let from_axis = major + minor * y.y;
    let point = DVec3::new(-x.z * from_axis, minor * z.y, x.x * from_axis);
    let (du, dv) = (x * (TAU * per_u * from_axis), y * (TAU * per_v * minor));
    frame_of_derivatives(Point3::new(narrow(point)), Vector3::new(narrow(du)), Vector3::new(narrow(dv)))
}

/// East, north and up at a longitude and a latitude in turns.
fn directions(longitude: f64, latitude: f64) -> [DVec3; 3] {
    let ([cos, sin], [out, up]) = (turn(longitude), turn(latitude));
    [DVec3::new(cos, 0.0, -sin), DVec3::new(-up * sin, out, -up * cos), DVec3::new(out * sin, up, out * cos)]
}

/// The cosine and the sine of an angle in turns: exact at quarters, elsewhere within 2^-50 relatively.
fn turn(t: f64) -> [f64; 2] {
    let t = if t.abs() < 8_388_608.0 { t } else { 0.0 };
    // The nearest quarter, which is subtracted exactly.
    #[expect(clippy::cast_possible_truncation, reason = "below 2^26")]
    let quarter = (4.0 * t + if t < 0.0 { -0.5 } else { 0.5 }) as i64;
    #[expect(clippy::cast_precision_loss, reason = "below 2^26")]
    let angle = (4.0 * t - quarter as f64) * FRAC_PI_2;
    // Taylor's series, whose remainder at an eighth of a turn is below 2^-53.
    let square = angle * angle;
    let series = |first: f64| {
        let (mut sum, mut n) = (1.0, first);
        while n > first - 16.0 {
            sum = 1.0 - sum * square / (n * (n - 1.0));
            n -= 2.0;
        }
        sum
    };
    let (cos, sin) = (series(16.0), angle * series(17.0));
    match quarter & 3 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}
