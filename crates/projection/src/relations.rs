//! Lines go to lines and planes to planes: the same point of a segment or a triangle, by weights in eye space and by
//! weights on the screen.
//!
//! ```text
//!   eye   .--------.---------------------.    p = (1-t) p1 + t p2          t = 1/4
//!         z1 = 1                    z2 = 3
//!
//!   screen       .--------.--------.          ps = (1-τ) ps1 + τ ps2       τ = 1/2
//! ```
//!
//! Nearer parts take more room on the screen, so the middle of the screen's segment is not that of the segment in
//! space. Weights are those of the end points or vertices: [1−t, t] of a segment, [u, v, s] of a triangle.

use crate::DepthMap;

/// Weights in eye space, or in the world, where affine frames keep them: a point is Σ `w[i]`·`p[i]`.
///
/// The other kind are [`ScreenWeights`]; one is not taken for the other:
///
/// ```compile_fail,E0308
/// use alberti_projection::{EyeWeights, ScreenWeights};
///
/// let middle_of_the_screen = ScreenWeights([0.5, 0.5]);
/// let depth = EyeWeights::z(middle_of_the_screen, [1.0, 3.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeWeights<const N: usize>(
    /// One for each vertex; they sum to 1.
    pub [f32; N],
);

/// Weights on the screen, of the projected vertices: a point is Σ `w[i]`·`ps[i]`. A rasterizer has these.
///
/// ```
/// use alberti_projection::{EyeWeights, ScreenWeights};
///
/// // From depth 1 to depth 3 the middle of the screen shows the point a quarter of the way.
/// let z = [1.0, 3.0];
/// assert_eq!(ScreenWeights([0.5, 0.5]).to_eye(z), EyeWeights([0.75, 0.25]));
/// assert_eq!(EyeWeights([0.75, 0.25]).to_screen(z), ScreenWeights([0.5, 0.5]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenWeights<const N: usize>(
    /// One for each vertex; they sum to 1.
    pub [f32; N],
);

impl EyeWeights<2> {
    /// [1−t, t]: the point at parameter `t` from the first end to the second.
    ///
    /// # Precision
    /// Each within ε (ε = 2^-24) of itself, as `t` is taken for exact. A `t` that is rounded already holds 1−t only to
    /// ε/2 absolutely: near the second end give both weights, each by its own formula.
    #[must_use]
    pub fn at(t: f32) -> Self {
        Self([1.0 - t, t])
    }
}

impl ScreenWeights<2> {
    /// [1−τ, τ]: the point at parameter `tau` from the first projected end to the second.
    ///
    /// # Precision
    /// As [`EyeWeights::at`].
    #[must_use]
    pub fn at(tau: f32) -> Self {
        Self([1.0 - tau, tau])
    }
}

impl<const N: usize> EyeWeights<N> {
    /// The weights on the screen of the point with these weights in eye space: w'ᵢ = wᵢzᵢ / Σ wⱼzⱼ, `z` being the
    /// vertices' depths in eye space. (Relations 2 and 3 of a segment, 6 to 8 of a triangle.)
    ///
    /// # Precision
    /// Each weight has its own formula and is within 1.001ε of its exact value, relatively (below 2^-126 within
    /// 2^-150). That is for weights that are not negative and positive depths, of any sizes and ratios that are finite.
    /// From a parameter alone, [`at`](EyeWeights::at), it is within 2.001ε. Weights of both signs may cancel in the
    /// sum.
    ///
    /// # Cost
    /// In `f64`, in which no product rounds, overflows or vanishes: N products, N divisions.
    #[must_use]
    pub fn to_screen(self, z: [f32; N]) -> ScreenWeights<N> {
        ScreenWeights(shares(self.terms(z)))
    }

    /// The depth in eye space, z = Σ wᵢzᵢ.
    ///
    /// # Precision
    /// Within 1.001ε, relatively, as [`to_screen`](Self::to_screen).
    #[must_use]
    pub fn z(self, z: [f32; N]) -> f32 {
        narrow(self.terms(z).iter().sum())
    }

    /// wᵢzᵢ.
    fn terms(self, z: [f32; N]) -> [f64; N] {
        each(self.0, z, |w, z| w * z)
    }
}

impl<const N: usize> ScreenWeights<N> {
    /// The weights in eye space of the point with these weights on the screen: wᵢ = (w'ᵢ/zᵢ) / Σ (w'ⱼ/zⱼ). (Relations 4
    /// and 5 of a segment, as t = τz₁ / (τz₁ + (1−τ)z₂) after multiplying by z₁z₂, and the inverses of 6 to 8 of a
    /// triangle.) With q = 1/z these are the weights times q, over their sum: what the rasterizer and
    /// [`clip_sides`](crate::clip_sides) work with.
    ///
    /// # Precision
    /// As [`EyeWeights::to_screen`].
    ///
    /// # Cost
    /// In `f64`: 2N divisions.
    #[must_use]
    pub fn to_eye(self, z: [f32; N]) -> EyeWeights<N> {
        EyeWeights(shares(self.terms(z)))
    }

    /// 1/z of the point, which is linear on the screen: q = Σ w'ᵢ/zᵢ = 1 / Σ wⱼzⱼ. (Relation 9.)
    ///
    /// # Precision
    /// Within 1.001ε (ε = 2^-24), relatively, as [`EyeWeights::to_screen`].
    #[must_use]
    pub fn q(self, z: [f32; N]) -> f32 {
        narrow(self.terms(z).iter().sum())
    }

    /// The eye depth of the point from the vertices' screen depths: z = β / (Σ w'ᵢzsᵢ − α). (Relation 10.)
    ///
    /// Computed as β / Σ w'ᵢ(zsᵢ − α), whose terms have one sign.
    ///
    /// # Precision
    /// Within 1.001ε of the exact value of the latter for the map's own α and β, relatively. The vertices' zs come
    /// rounded, and bring their errors along, as in [`DepthMap::z`], which takes the zs of one point. Of zs that a
    /// reversed map gave, it is within 4ε of the z of the point itself, as far as [`DepthMap::reversed`] says.
    #[must_use]
    pub fn z_of_depths(self, zs: [f32; N], map: &DepthMap) -> f32 {
        let from_alpha = each(self.0, zs, |w, zs| w * (zs - f64::from(map.alpha())));
        narrow((f64::from(map.beta()) / from_alpha.iter().sum::<f64>()).abs())
    }

    /// w'ᵢ/zᵢ.
    fn terms(self, z: [f32; N]) -> [f64; N] {
        each(self.0, z, |w, z| w / z)
    }
}

/// `f` of each weight and the number of its vertex.
fn each<const N: usize>(weights: [f32; N], of: [f32; N], f: impl Fn(f64, f64) -> f64) -> [f64; N] {
    let mut terms = weights.map(f64::from);
    for (term, of) in terms.iter_mut().zip(of) {
        *term = f(*term, f64::from(of));
    }
    terms
}

/// Each term's part of their sum.
fn shares<const N: usize>(terms: [f64; N]) -> [f32; N] {
    let sum: f64 = terms.iter().sum();
    terms.map(|term| narrow(term / sum))
}

#[expect(clippy::cast_possible_truncation, reason = "the one rounding that counts")]
fn narrow(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Powers of two, so that all of it is exact.
    #[test]
    fn a_triangle_in_perspective() {
        let (z, eye) = ([1.0, 2.0, 4.0], EyeWeights([0.25, 0.125, 0.625]));
        // u z1 + v z2 + s z3 = 3.
        assert_eq!(eye.z(z), 3.0);
        let screen = eye.to_screen(z);
        assert_eq!(screen.0, [0.25f32 / 3.0, 0.25 / 3.0, 2.5 / 3.0]);
        let weights = ScreenWeights([0.5, 0.25, 0.25]);
        // 1/2 + 1/8 + 1/16 = 11/16.
        assert_eq!(weights.q(z), 0.6875);
        assert_eq!(weights.to_eye(z).0, [8.0f32 / 11.0, 2.0 / 11.0, 1.0 / 11.0]);
        let map = DepthMap::reversed(1.0, f32::INFINITY).expect("valid");
        assert_eq!(weights.z_of_depths(z.map(|z| map.zs(z)), &map), 16.0 / 11.0);
    }

    /// With w = z/d in place of z, whatever the distance d of the image plane.
    #[test]
    fn the_distance_of_the_image_plane_falls_out() {
        let (z, weights) = ([1.0, 2.0, 4.0], ScreenWeights([0.5, 0.25, 0.25]));
        for d in [0.25, 2.0, 1024.0] {
            assert_eq!(weights.to_eye(z.map(|z| z / d)), weights.to_eye(z), "{d}");
        }
    }

    /// In space at t, on the screen at τ = t z2/((1-t) z1 + t z2): of depths 1 and 3, where these are short fractions.
    #[test]
    fn the_middle_in_space_is_three_quarters_of_the_way_on_the_screen() {
        let z = [1.0, 3.0];
        for (t, tau) in [(0.5, 0.75), (0.25, 0.5), (0.1f32, 0.25)] {
            let (eye, screen) = (EyeWeights::at(t), ScreenWeights::at(tau));
            for (found, exact) in [(eye.to_screen(z).0, screen.0), (screen.to_eye(z).0, eye.0)] {
                for (found, exact) in found.into_iter().zip(exact) {
                    assert!((found - exact).abs() <= 2e-7, "{t} {tau}: {found} for {exact}");
                }
            }
        }
        // Depths the other way round: from the far end to the near one.
        assert_eq!(EyeWeights::at(0.5).to_screen([3.0, 1.0]).0, [0.75, 0.25]);
        assert_eq!(ScreenWeights::at(0.5).to_eye([3.0, 1.0]).0, [0.25, 0.75]);
    }

    #[test]
    fn ends_stay_ends_whatever_the_depths() {
        for z in [[1.0, 1e9], [f32::MAX / 16.0, f32::from_bits(1)]] {
            assert_eq!(EyeWeights::at(0.0).to_screen(z).0, [1.0, 0.0]);
            assert_eq!(EyeWeights::at(1.0).to_screen(z).0, [0.0, 1.0]);
            assert_eq!(ScreenWeights::at(0.0).to_eye(z).0, [1.0, 0.0]);
            assert_eq!(ScreenWeights::at(1.0).to_eye(z).0, [0.0, 1.0]);
        }
    }

    /// A thousandth of the way in space is nearly all the way on the screen, or nearly nothing: a taken-for-granted
    /// direction shows.
    #[test]
    fn the_screen_gives_room_to_what_is_near() {
        let near_to_far = [1.0, 1e6];
        assert!(EyeWeights::at(0.001).to_screen(near_to_far).0[1] > 0.99);
        assert!(ScreenWeights::at(0.99).to_eye(near_to_far).0[1] < 0.001);
    }
}
