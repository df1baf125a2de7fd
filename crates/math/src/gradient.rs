//! Derivatives of attributes from a pixel to the next, and the level of detail of a texture that follows.
//!
//! Space in: derivatives of texture coordinates by pixels. Space out: λ, which is 0 where texels are as large as
//! pixels, 1 where they are half as large, and so on. Level λ of a mip map has texels as large as pixels.
//!
//! ```text
//! λ = 1/2 log2 max(|∂(u, v)/∂x|², |∂(u, v)/∂y|²)      with u and v in texels, and lengths that are Euclidean
//! ```

use core::ops::{Add, Div, Mul, Sub};

use crate::lanes::{Lanes, One};
use glam::{Mat2, Vec2};

/// The derivatives of attributes by the column and by the row of a pixel.
///
/// Those of texture coordinates (u, v) are a `Gradient<[f32; 2]>`, or one of several numbers side by side.
///
/// # Precision
/// The error is that of their source: [`of_planes`](Self::of_planes) is exact but for rounding,
/// [`between`](Self::between) neighbours is off by half of the second derivative, and
/// [`of_triangle`](Self::of_triangle) takes perspective for none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gradient<T> {
    /// To the right.
    pub dx: T,
    /// Downwards.
    pub dy: T,
}

impl<T> Gradient<T> {
    /// The same part of both.
    #[inline(always)]
    pub fn map<U>(self, f: impl Fn(T) -> U) -> Gradient<U> {
        Gradient { dx: f(self.dx), dy: f(self.dy) }
    }
}

impl<N: Copy + Add<Output = N> + Sub<Output = N> + Mul<Output = N> + Div<Output = N>> Gradient<[N; 2]> {
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
        let slopes = |[du, dv, dq]: [N; 3]| [(du - u * dq) * depth, (dv - v * dq) * depth];
        Self { dx: slopes(dx), dy: slopes(dy) }
    }

    /// The differences between the coordinates (u, v) of a pixel and those of the pixels to its right and below.
    ///
    /// # Cost
    /// Four subtractions, and the coordinates of two more pixels.
    #[inline(always)]
    pub fn between(here: [N; 2], right: [N; 2], below: [N; 2]) -> Self {
        let from_here = |there: [N; 2]| [there[0] - here[0], there[1] - here[1]];
        Self { dx: from_here(right), dy: from_here(below) }
    }

    /// The axes of the ellipse that a round pixel covers of a texture of these sides, one in the place of `dx`, the
    /// other of `dy`. They are the derivatives of the same pixel turned on the screen, by at most 45 degrees, until
    /// they are at right angles in texels ([`Lanes::jacobi_rotation`]). Derivatives at right angles stay as they are.
    ///
    /// With J the derivatives in texels, a = |∂/∂x|², c = |∂/∂y|² and b = ∂/∂x·∂/∂y, the squares of the axes' lengths
    /// are the eigenvalues of J Jᵀ: (a + c)/2 ± √(((a - c)/2)² + b²).
    ///
    /// # Precision
    /// For lengths from 2^-63 to 2^63 texels, A being the longer one, each length is within 8ε·A. The angle between the
    /// axes is such that its cosine times both lengths is at most 16ε·A². In fixed point 3·2^-16 of each component of
    /// the texture comes in addition, and 2^-15 takes the place of 8ε and of 16ε. Derivatives that are not finite, or
    /// too long or short for `f32`, are not turned.
    ///
    /// # Cost
    /// Eight multiplications, four additions and the rotation.
    #[must_use]
    #[inline(always)]
    pub fn axes_lanes<L: Lanes<Number = N>>(self, lanes: L, size: [u32; 2]) -> Self {
        let Self { dx, dy } = self;
        let [cosine, sine] = lanes.jacobi_rotation(dx, dy, size);
        Self {
            dx: [dx[0] * cosine + dy[0] * sine, dx[1] * cosine + dy[1] * sine],
            dy: [dy[0] * cosine - dx[0] * sine, dy[1] * cosine - dx[1] * sine],
        }
    }

    /// The logarithms of the lengths of the two, across and down, in texels of a texture of these sides.
    ///
    /// # Precision
    /// That of [`Lanes::log2_length`].
    #[must_use]
    #[inline(always)]
    pub fn log2_lengths_lanes<L: Lanes<Number = N>>(self, lanes: L, size: [u32; 2]) -> [N; 2] {
        let Self { dx: [du_dx, dv_dx], dy: [du_dy, dv_dy] } = self;
        [lanes.log2_length(du_dx, dv_dx, size), lanes.log2_length(du_dy, dv_dy, size)]
    }

    /// [`lod`](Gradient::lod) of several pixels: of a texture with the sides `[width, height]`.
    #[inline(always)]
    pub fn lod_lanes<L: Lanes<Number = N>>(self, lanes: L, size: [u32; 2]) -> N {
        lanes.log2_longer([self.dx, self.dy], size)
    }
}

impl Gradient<[f32; 2]> {
    /// The derivatives of the affine map that takes a triangle on the screen, in pixels, to its texture coordinates:
    /// one for all pixels of the triangle. `None` if the triangle has no area on the screen, or a corner is not finite.
    ///
    /// # Precision
    /// That of `f32` where depths are equal. With perspective one gradient stands for all of a triangle, and no bound
    /// is promised.
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
        map.is_finite().then_some(Self { dx: [map.x_axis.x, map.x_axis.y], dy: [map.y_axis.x, map.y_axis.y] })
    }

    /// λ: log2 of the longer of the two derivatives, in texels of a texture of `width` x `height`.
    ///
    /// ```
    /// use alberti_math::Gradient;
    ///
    /// // From pixel to pixel an eighth of the texture across, a 16th down.
    /// let gradient = Gradient { dx: [0.125, 0.0], dy: [0.0, 0.0625] };
    /// // Of 64 x 64 texels these are 8 and 4.
    /// assert_eq!(gradient.lod(64, 64), 3.0);
    /// ```
    ///
    /// # Precision
    /// Within 2^-11 of the exact value for lengths from 2^-63 to 2^63. Shorter lengths give at least -63.5, the value
    /// of zeros; longer ones at most 64, that of infinities and NaN. In fixed point ([`lod_lanes`](Self::lod_lanes))
    /// the lengths are from 2^-16 to 2^15 texels.
    ///
    /// # Cost
    /// One logarithm of the greater of two squares, as [`Lanes::log2_longer`] says.
    #[must_use]
    pub fn lod(self, width: u32, height: u32) -> f32 {
        self.lod_lanes(One, [width, height])
    }
}
