//! The depth of "perspective with depth": zs = α + β/z.

use crate::ViewError;
use alberti_math::lanes::{Lanes, One};
use alberti_math::map2;

/// The map from eye depth z in [A, B] to screen depth zs in [0, 1], or in a range of your own.
///
/// Being linear in 1/z it takes lines to lines and planes to planes, so that zs may be interpolated linearly over a
/// screen triangle; see [`ScreenWeights`](crate::ScreenWeights). It keeps the order of depths where β < 0 and reverses
/// it where β > 0: of z1 < z2, 1/z1 is the larger. How fine it is, [`resolution`](Self::resolution) tells.
///
/// ```
/// use alberti_projection::DepthMap;
///
/// // α = B/(B-A) = 1.5 and β = -AB/(B-A) = -3.
/// let depth = DepthMap::forward(2.0, 6.0)?;
/// assert_eq!([2.0, 3.0, 6.0].map(|z| depth.zs(z)), [0.0, 0.5, 1.0]);
/// assert_eq!(depth.z(0.5), 3.0);
/// // Without a far plane α = 1 and β = -A.
/// let endless = DepthMap::forward(2.0, f32::INFINITY)?;
/// assert_eq!([2.0, 4.0, 8.0, 1e30].map(|z| endless.zs(z)), [0.0, 0.5, 0.75, 1.0]);
/// # Ok::<(), alberti_projection::ViewError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthMap {
    alpha: f32,
    beta: f32,
    /// The ends of the range, the smaller first.
    range: [f32; 2],
}

impl DepthMap {
    /// zs = 0 at the near plane z = A and 1 at the far plane z = B: α = B/(B−A), β = −AB/(B−A); of B = ∞, α = 1 and
    /// β = −A.
    ///
    /// # Precision
    /// α and β are correctly rounded but for a double rounding: within 1.001ε, relatively (ε = 2^-24).
    ///
    /// # Errors
    /// [`ViewError::NearFar`] unless 0 < A < B, A finite, and α and β are normal `f32`; only α may be 0. A subnormal
    /// one would have lost the precision that is promised, so subnormal near planes are refused, and so are planes
    /// beyond B/A = 2^126: take B = ∞.
    pub const fn forward(near: f32, far: f32) -> Result<Self, ViewError> {
        Self::onto([0.0, 1.0], near, far)
    }

    /// zs = 1 at the near plane and 0 at the far plane: α' = −A/(B−A), β' = AB/(B−A), computed directly; of B = ∞,
    /// α' = 0 and β' = A.
    ///
    /// # Precision
    /// As [`forward`](Self::forward). With a floating-point depth buffer the fine steps of small numbers meet the
    /// coarse ones of 1/z. So the relative error of z recovered from zs is within 4ε at any B/A that is accepted. Of B
    /// = ∞ that holds up to z = 2^126·A, where zs becomes subnormal. (1 − zs of the forward map would inherit all of
    /// that map's error.)
    ///
    /// # Errors
    /// As [`forward`](Self::forward).
    pub const fn reversed(near: f32, far: f32) -> Result<Self, ViewError> {
        Self::onto([1.0, 0.0], near, far)
    }

    /// zs = c at the near plane and d at the far plane: α = (dB − cA)/(B−A), β = (c−d)AB/(B−A); of B = ∞, α = d and
    /// β = (c−d)A. Depth buffers take zs from [0, 1]; other systems want [−1, 1], say.
    ///
    /// # Precision
    /// As [`forward`](Self::forward).
    ///
    /// # Errors
    /// As [`forward`](Self::forward), for α and β of this range, and [`ViewError::DepthRange`] unless c and d are
    /// finite and differ.
    pub const fn onto([c, d]: [f32; 2], near: f32, far: f32) -> Result<Self, ViewError> {
        if !(c.is_finite() && d.is_finite() && c != d) {
            return Err(ViewError::DepthRange);
        }
        if !(near > 0.0 && far > near) {
            return Err(ViewError::NearFar);
        }
        // In f64 a product of two f32 is exact, and a difference exact or nearly so.
        let [from, to, a, b] = [c as f64, d as f64, near as f64, far as f64];
        let (alpha, beta) = if far.is_finite() {
            ((to * b - from * a) / (b - a), (from - to) * (a * b) / (b - a))
        } else {
            (to, (from - to) * a)
        };
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, here")]
        let (alpha, beta) = (alpha as f32, beta as f32);
        if !((alpha.is_normal() || alpha == 0.0) && beta.is_normal()) {
            return Err(ViewError::NearFar);
        }
        Ok(Self { alpha, beta, range: if c < d { [c, d] } else { [d, c] } })
    }

    /// α of zs = α + β/z.
    #[must_use]
    pub const fn alpha(&self) -> f32 {
        self.alpha
    }

    /// β of zs = α + β/z: negative where zs grows with distance.
    #[must_use]
    pub const fn beta(&self) -> f32 {
        self.beta
    }

    /// The smallest and the largest zs.
    #[must_use]
    pub const fn range(&self) -> [f32; 2] {
        self.range
    }

    /// The screen depth zs of a point at eye depth `z` in [A, B]; always within the range.
    ///
    /// # Precision
    /// Within (|β|/A + 1/2)ε of its own α + β/z, absolutely, where |β|/A is α, and |α'| + 1 of the reversed map. Within
    /// (3|β|/A + 1/2)ε of that of the planes themselves. The two are at most 1.84ε and 4.5ε for B/A >= 4, and more as
    /// the planes approach each other. Onto any range, within (|β|/A + m)ε and (|α| + 2|β|/A + m)ε, m the largest |zs|.
    ///
    /// Monotone: division and addition are correctly rounded, so a larger z never gives a smaller zs (larger, for the
    /// reversed map).
    #[must_use]
    #[inline]
    pub fn zs(&self, z: f32) -> f32 {
        self.zs_lanes(One, z)
    }

    /// [`zs`](Self::zs) of several.
    #[must_use]
    #[inline(always)]
    pub fn zs_lanes<L: Lanes>(&self, lanes: L, z: L::Number) -> L::Number {
        let [least, most] = map2(self.range, |end| lanes.splat(end));
        let zs = lanes.splat(self.alpha) + lanes.splat(self.beta) / z;
        // Rounding may step over an end of the range by an ulp.
        let below = lanes.select(lanes.less(most, zs), most, zs);
        lanes.select(lanes.less(zs, least), least, below)
    }

    /// The eye depth z = β/(zs − α) of a screen depth within the range; infinite for that of infinity.
    ///
    /// # Precision
    /// Within 2ε of the quotient of its own α and β, relatively. That does not make z good: zs comes rounded, and the
    /// subtraction cancels near the far plane of a forward map.
    ///
    /// There and back, from z to zs to z, the relative error is within r/(1 − r) + 4ε, with r = (α + 1/2)ε·z/|β|. At
    /// the far plane 3e-5 was measured for B/A = 10^3, 2.9e-2 for 10^6, and for 10^9 z comes back infinite. The
    /// reversed map keeps it within 4ε for any planes, as far as [`reversed`](Self::reversed) says.
    #[must_use]
    #[inline]
    pub fn z(&self, zs: f32) -> f32 {
        // The sign of a zero must not become that of infinity.
        (self.beta / (zs - self.alpha)).abs()
    }
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
        let endless = f32::INFINITY;
        for (near, far) in [
            (0.0, 1.0),
            (-1.0, 1.0),
            (1.0, 1.0),
            (2.0, 1.0),
            (endless, endless),
            (f32::NAN, 1.0),
            (1.0, f32::NAN),
            (0.0, endless),
            (3e38, 3.0000003e38),
            (f32::from_bits(1), 1.0),
            (1e-39, endless),
        ] {
            assert_eq!(DepthMap::forward(near, far), Err(ViewError::NearFar), "{near} {far}");
            assert_eq!(DepthMap::reversed(near, far), Err(ViewError::NearFar), "{near} {far}");
        }
        for range in [[0.0, 0.0], [f32::NAN, 1.0], [0.0, f32::NAN], [f32::NEG_INFINITY, 0.0], [0.0, endless]]
        {
            assert_eq!(DepthMap::onto(range, 1.0, 2.0), Err(ViewError::DepthRange), "{range:?}");
        }
    }

    /// α of the reversed map is −A/(B − A): normal, it has all its bits; beyond B/A = 2^126 it would be subnormal.
    #[test]
    fn planes_so_far_apart_that_a_coefficient_loses_bits_are_refused() {
        let far = 2f32.powi(100);
        let [within, beyond] = [-26, -27].map(|e| DepthMap::reversed(2f32.powi(e), far));
        assert_eq!(within.expect("normal").alpha(), -f32::MIN_POSITIVE);
        assert_eq!(beyond, Err(ViewError::NearFar));
        let barely = DepthMap::reversed(f32::MIN_POSITIVE, f32::INFINITY).expect("normal");
        assert_eq!((barely.alpha(), barely.beta()), (0.0, f32::MIN_POSITIVE));
    }

    #[test]
    fn any_range_has_its_ends_at_the_planes() {
        let map = DepthMap::onto([-1.0, 1.0], 2.0, 6.0).expect("valid");
        assert_eq!((map.alpha(), map.beta(), map.range()), (2.0, -6.0, [-1.0, 1.0]));
        assert_eq!((map.zs(2.0), map.zs(3.0), map.zs(6.0)), (-1.0, 0.0, 1.0));
        let falling = DepthMap::onto([8.0, -4.0], 2.0, 6.0).expect("valid");
        assert_eq!((falling.zs(2.0), falling.zs(3.0), falling.zs(6.0)), (8.0, 2.0, -4.0));
        assert_eq!((falling.z(2.0), falling.range()), (3.0, [-4.0, 8.0]));
    }

    #[test]
    fn infinity_is_the_far_plane_of_an_endless_view() {
        let forward = DepthMap::forward(2.0, f32::INFINITY).expect("valid");
        let reversed = DepthMap::reversed(2.0, f32::INFINITY).expect("valid");
        assert_eq!([forward, reversed].map(|map| (map.alpha(), map.beta())), [(1.0, -2.0), (0.0, 2.0)]);
        assert_eq!([forward, reversed].map(|map| map.zs(8.0)), [0.75, 0.25]);
        assert_eq!([forward.z(0.75), reversed.z(0.25)], [8.0, 8.0]);
        assert_eq!([forward.z(1.0), reversed.z(0.0)], [f32::INFINITY; 2]);
        assert_eq!([forward, reversed].map(|map| map.zs(f32::INFINITY)), [1.0, 0.0]);
    }
}
