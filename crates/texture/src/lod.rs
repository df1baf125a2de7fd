//! The level of detail: how many texels lie between neighbouring pixels, as a power of two.
//!
//! Space in: derivatives of texture coordinates by pixels. Space out: λ, which is 0 where texels are as large as
//! pixels, 1 where they are half as large, and so on; level λ of a [`Mipmap`](crate::Mipmap) has texels as large as
//! pixels.
//!
//! ```text
//! λ = 1/2 log2 max(|∂(u, v)/∂x|², |∂(u, v)/∂y|²)      with u and v in texels, and lengths that are Euclidean
//! ```

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Sub};

use alberti_math::lanes::{Lanes, One};
use glam::{Mat2, Vec2};

use crate::sealed::Sealed;

/// How texture coordinates change from a pixel to the next one, to the right and downwards.
///
/// # Precision
/// Where they come from is the error: [`of_planes`](Self::of_planes) is exact but for rounding,
/// [`between`](Self::between) neighbours is off by half of the second derivative, and
/// [`of_triangle`](Derivatives::of_triangle) takes perspective for none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Derivatives<N = f32> {
    /// ∂u/∂x.
    pub du_dx: N,
    /// ∂v/∂x.
    pub dv_dx: N,
    /// ∂u/∂y.
    pub du_dy: N,
    /// ∂v/∂y.
    pub dv_dy: N,
}

impl<N: Copy + Add<Output = N> + Sub<Output = N> + Mul<Output = N> + Div<Output = N>> Derivatives<N> {
    /// The derivatives of a perspective texture at a pixel: of u = U/Q and v = V/Q, where U = u/z, V = v/z and Q = 1/z
    /// are linear on the screen.
    ///
    /// ```text
    /// ∂u/∂x = (∂U/∂x - u ∂Q/∂x) / Q
    /// ```
    ///
    /// `uv` and `depth` = 1/Q are those of the pixel, `dx` and `dy` the slopes of [U, V, Q].
    ///
    /// # Precision
    /// (2ε·|∂U/∂x| + 3ε·|u ∂Q/∂x|)/Q for the u and 1/Q that are given, ε = 2^-24. Shift u towards 0 by whole periods if
    /// it is large.
    ///
    /// # Cost
    /// Eight multiplications and four subtractions; no division, as attributes with perspective need 1/Q anyway.
    #[inline(always)]
    pub fn of_planes([u, v]: [N; 2], depth: N, dx: [N; 3], dy: [N; 3]) -> Self {
        let slope = |of_numerator: N, value: N, of_q: N| (of_numerator - value * of_q) * depth;
        Self {
            du_dx: slope(dx[0], u, dx[2]),
            dv_dx: slope(dx[1], v, dx[2]),
            du_dy: slope(dy[0], u, dy[2]),
            dv_dy: slope(dy[1], v, dy[2]),
        }
    }

    /// The differences between the coordinates (u, v) of a pixel and those of the pixels to its right and below.
    ///
    /// # Cost
    /// Four subtractions, and the coordinates of two more pixels.
    #[inline(always)]
    pub fn between(here: [N; 2], right: [N; 2], below: [N; 2]) -> Self {
        Self {
            du_dx: right[0] - here[0],
            dv_dx: right[1] - here[1],
            du_dy: below[0] - here[0],
            dv_dy: below[1] - here[1],
        }
    }

    /// The axes of the ellipse that a round pixel covers of a texture of these sides, one in the place of what is
    /// across, the other of what is down: those of the same pixel turned on the screen, by at most 45 degrees, until
    /// they are at right angles in texels ([`Lanes::jacobi_rotation`]). Derivatives at right angles stay as they are.
    ///
    /// With J the derivatives in texels, a = |∂/∂x|², c = |∂/∂y|² and b = ∂/∂x·∂/∂y, the squares of their lengths are
    /// the eigenvalues of J Jᵀ: (a + c)/2 ± √(((a - c)/2)² + b²).
    ///
    /// # Precision
    /// For lengths from 2^-63 to 2^63 texels, A being the longer one: each length within 8ε·A; the angle between them
    /// such that the cosine times both lengths is at most 16ε·A². In fixed point 3·2^-16 of each component of the
    /// texture besides, and 2^-15 for 8ε and 16ε. What is not finite, or too long or short for `f32`, is not turned.
    ///
    /// # Cost
    /// Eight multiplications, four additions and the rotation.
    #[must_use]
    #[inline(always)]
    pub fn axes_lanes<L: Lanes<Number = N>>(self, lanes: L, size: [u32; 2]) -> Self {
        let Self { du_dx, dv_dx, du_dy, dv_dy } = self;
        let [cosine, sine] = lanes.jacobi_rotation([du_dx, dv_dx], [du_dy, dv_dy], size);
        Self {
            du_dx: du_dx * cosine + du_dy * sine,
            dv_dx: dv_dx * cosine + dv_dy * sine,
            du_dy: du_dy * cosine - du_dx * sine,
            dv_dy: dv_dy * cosine - dv_dx * sine,
        }
    }

    /// The logarithms of the lengths of the two, across and down, in texels of a texture of these sides.
    #[inline(always)]
    pub(crate) fn log2_lengths<L: Lanes<Number = N>>(self, lanes: L, size: [u32; 2]) -> [N; 2] {
        [lanes.log2_length(self.du_dx, self.dv_dx, size), lanes.log2_length(self.du_dy, self.dv_dy, size)]
    }

    /// [`lod`](Derivatives::lod) of several pixels: of a texture with the sides `[width, height]`.
    #[inline(always)]
    pub fn lod_lanes<L: Lanes<Number = N>>(self, lanes: L, size: [u32; 2]) -> N {
        let [across, down] = self.log2_lengths(lanes, size);
        lanes.max(across, down)
    }
}

impl Derivatives<f32> {
    /// The derivatives of the affine map that takes a triangle on the screen, in pixels, to its texture coordinates:
    /// one for all pixels of the triangle. `None` if the triangle has no area on the screen, or a corner is not finite.
    ///
    /// # Precision
    /// That of `f32` where depths are equal. With perspective it is one for all that a triangle has, and no bound is
    /// promised.
    ///
    /// # Cost
    /// Once a triangle: ten multiplications, a division.
    #[must_use]
    pub fn of_triangle([a, b, c]: [Vec2; 3], [ta, tb, tc]: [Vec2; 3]) -> Option<Self> {
        let screen = Mat2::from_cols(b - a, c - a);
        let texture = Mat2::from_cols(tb - ta, tc - ta);
        let determinant = screen.determinant();
        let map = texture
            * Mat2::from_cols(
                Vec2::new(screen.y_axis.y, -screen.x_axis.y) / determinant,
                Vec2::new(-screen.y_axis.x, screen.x_axis.x) / determinant,
            );
        map.is_finite().then_some(Self {
            du_dx: map.x_axis.x,
            dv_dx: map.x_axis.y,
            du_dy: map.y_axis.x,
            dv_dy: map.y_axis.y,
        })
    }

    /// λ: log2 of the longer of the two derivatives, in texels of a texture of `width` x `height`.
    ///
    /// ```
    /// use alberti_texture::Derivatives;
    ///
    /// // From pixel to pixel an eighth of the texture across, a 16th down.
    /// let derivatives = Derivatives { du_dx: 0.125, dv_dx: 0.0, du_dy: 0.0, dv_dy: 0.0625 };
    /// // Of 64 x 64 texels these are 8 and 4.
    /// assert_eq!(derivatives.lod(64, 64), 3.0);
    /// ```
    ///
    /// # Precision
    /// Within 2^-11 of the exact value for lengths from 2^-63 to 2^63, and not below (above) the least (greatest) of
    /// those beyond: for all zeros -63.5, for infinities and NaN 64. In fixed point ([`lod_lanes`](Self::lod_lanes))
    /// from 2^-16 to 2^15 texels.
    ///
    /// # Cost
    /// Two logarithms, as [`Lanes::log2_length`] says, and a comparison.
    #[must_use]
    pub fn lod(self, width: u32, height: u32) -> f32 {
        self.lod_lanes(One, [width, height])
    }
}

/// The change of λ before levels are chosen: none, `()`, or [`LodBounds`]. Sealed.
pub trait LodPolicy: Sealed + Copy + Debug + 'static {
    /// The bounded λ, of several samples.
    fn bound_lanes<L: Lanes>(self, lanes: L, lambda: L::Number) -> L::Number;
}

impl Sealed for () {}
impl Sealed for LodBounds {}

impl LodPolicy for () {
    #[inline(always)]
    fn bound_lanes<L: Lanes>(self, _: L, lambda: L::Number) -> L::Number {
        lambda
    }
}

/// A bias of λ, and its limits: min(max(λ + bias, least), greatest).
/// [`MipSampler::bounded`](crate::MipSampler::bounded) takes them.
///
/// ```
/// use alberti_texture::LodBounds;
///
/// let sharper = LodBounds { bias: -0.5, greatest: 4.0, ..LodBounds::default() };
/// assert_eq!([sharper.bound(2.0), sharper.bound(7.0)], [1.5, 4.0]);
/// ```
///
/// # Precision
/// One rounding, that of the sum; in fixed point none, but λ + bias is to be within ±2^15 there.
///
/// # Cost
/// An addition and two comparisons a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LodBounds {
    /// The summand: below 0 for sharper pictures, above for softer ones.
    pub bias: f32,
    /// The least that comes out. Above 0, the levels below it are never read, nor is the filter of magnification used.
    pub least: f32,
    /// The greatest that comes out.
    pub greatest: f32,
}

impl Default for LodBounds {
    /// λ as it is.
    fn default() -> Self {
        Self { bias: 0.0, least: -64.0, greatest: 64.0 }
    }
}

impl LodBounds {
    /// λ with the bias, bounded; the least for NaN.
    #[must_use]
    pub fn bound(self, lambda: f32) -> f32 {
        self.bound_lanes(One, lambda)
    }
}

impl LodPolicy for LodBounds {
    #[inline(always)]
    fn bound_lanes<L: Lanes>(self, lanes: L, lambda: L::Number) -> L::Number {
        let biased = lambda + lanes.splat(self.bias);
        lanes.min(lanes.max(biased, lanes.splat(self.least)), lanes.splat(self.greatest))
    }
}
