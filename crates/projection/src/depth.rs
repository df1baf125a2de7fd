//! The depth of "perspective with depth": zs = α + β/z.

use crate::ViewError;

/// The map from eye depth z in [A, B] to screen depth zs in [0, 1].
///
/// Being linear in 1/z it takes lines to lines and planes to planes, so that zs may be interpolated linearly over a
/// screen triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthMap {
    alpha: f32,
    beta: f32,
}

impl DepthMap {
    /// zs = 0 at the near plane z = A and 1 at the far plane z = B: α = B/(B−A), β = −AB/(B−A).
    ///
    /// # Precision
    /// α and β are correctly rounded but for a double rounding. Depth resolution at z is z²(B−A)/(AB) times the step
    /// of zs, whatever the number format: at B/A = 10^6 an f32 forward map tells 18 depths apart in the far half.
    ///
    /// # Errors
    /// [`ViewError::NearFar`] unless 0 < A < B, both finite, and α and β are finite.
    pub fn forward(near: f32, far: f32) -> Result<Self, ViewError> {
        let (a, b) = checked(near, far)?;
        Self::new(b / (b - a), -(a * b) / (b - a))
    }

    /// zs = 1 at the near plane and 0 at the far plane: α' = −A/(B−A), β' = AB/(B−A), computed directly.
    ///
    /// # Precision
    /// With a floating-point depth buffer the fine steps of small numbers meet the coarse ones of 1/z: the relative
    /// error of z recovered from zs is within 4ε at any B/A up to 10^9. (1 − zs of the forward map would inherit all
    /// of that map's error.)
    ///
    /// # Errors
    /// As [`forward`](Self::forward).
    pub fn reversed(near: f32, far: f32) -> Result<Self, ViewError> {
        let (a, b) = checked(near, far)?;
        Self::new(-a / (b - a), a * b / (b - a))
    }

    fn new(alpha: f64, beta: f64) -> Result<Self, ViewError> {
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, here")]
        let (alpha, beta) = (alpha as f32, beta as f32);
        if !(alpha.is_finite() && beta.is_finite()) || beta == 0.0 {
            return Err(ViewError::NearFar);
        }
        Ok(Self { alpha, beta })
    }

    /// α of zs = α + β/z.
    #[must_use]
    pub const fn alpha(&self) -> f32 {
        self.alpha
    }

    /// β of zs = α + β/z.
    #[must_use]
    pub const fn beta(&self) -> f32 {
        self.beta
    }

    /// The screen depth zs of a point at eye depth `z` in [A, B]; always in [0, 1].
    ///
    /// # Precision
    /// Within (α + 1/2)ε of its own α + β/z, absolutely (α' + 1/2 for the reversed map), and within (3α + 1/2)ε of that
    /// of the planes themselves: 1.5ε and 3ε for B/A >= 4, more as the planes approach each other. Monotone: division
    /// and addition are correctly rounded, so a larger z never gives a smaller zs (larger, for the reversed map).
    #[must_use]
    #[inline]
    pub fn zs(&self, z: f32) -> f32 {
        // Rounding may step over an end of the range by an ulp.
        (self.alpha + self.beta / z).clamp(0.0, 1.0)
    }

    /// The eye depth z = β/(zs − α) of a screen depth.
    ///
    /// # Precision
    /// The subtraction cancels near the far plane of a forward map: the round trip is off by 3e-5 relative at
    /// B/A = 10^3 and 2.9e-2 at 10^6; the reversed map keeps it within 4ε.
    #[must_use]
    #[inline]
    pub fn z(&self, zs: f32) -> f32 {
        self.beta / (zs - self.alpha)
    }
}

/// Both planes in f64, where their product and difference are exact or nearly so.
fn checked(near: f32, far: f32) -> Result<(f64, f64), ViewError> {
    if !(near > 0.0 && far > near && far.is_finite()) {
        return Err(ViewError::NearFar);
    }
    Ok((f64::from(near), f64::from(far)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planes_map_to_the_ends() {
        let forward = DepthMap::forward(2.0, 6.0).expect("valid");
        assert_eq!((forward.alpha(), forward.beta()), (1.5, -3.0));
        assert_eq!((forward.zs(2.0), forward.zs(3.0), forward.zs(6.0)), (0.0, 0.5, 1.0));
        let reversed = DepthMap::reversed(2.0, 6.0).expect("valid");
        assert_eq!((reversed.alpha(), reversed.beta()), (-0.5, 3.0));
        assert_eq!((reversed.zs(2.0), reversed.zs(3.0), reversed.zs(6.0)), (1.0, 0.5, 0.0));
        assert_eq!((forward.z(0.5), reversed.z(0.5)), (3.0, 3.0));
    }

    #[test]
    fn planes_that_make_no_range_are_refused() {
        for (near, far) in [
            (0.0, 1.0),
            (-1.0, 1.0),
            (1.0, 1.0),
            (2.0, 1.0),
            (1.0, f32::INFINITY),
            (f32::NAN, 1.0),
            (1.0, f32::NAN),
        ] {
            assert_eq!(DepthMap::forward(near, far), Err(ViewError::NearFar), "{near} {far}");
            assert_eq!(DepthMap::reversed(near, far), Err(ViewError::NearFar), "{near} {far}");
        }
    }
}
