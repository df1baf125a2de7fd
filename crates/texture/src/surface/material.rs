//! What a surface does with light: formulas that material maps, for wetness, shininess or occlusion, are numbers of.
//!
//! Space in: unit vectors in any one space, all from the surface: the normal n, the light's direction l, the eye's v.
//! Space out: shares of the light. Nothing here needs a library function, so that the bits are the same everywhere.

use super::normal::unit_lanes;
use alberti_math::lanes::One;
use alberti_math::{Space, Vector3};
use glam::Vec3;

/// The diffuse share of the light: n·l, and 0 from behind.
///
/// Source: Lambert, "Photometria", 1760.
///
/// # Precision
/// Within 3ε of the product of the given vectors (ε = 2^-24). 0 for NaN.
#[must_use]
#[inline]
pub fn lambert<S: Space>(n: Vector3<S>, l: Vector3<S>) -> f32 {
    let cosine = dot(n, l);
    if cosine > 0.0 { cosine } else { 0.0 }
}

/// The specular share of the light by Phong: (r·v)^shininess, where r = 2(n·l)n − l is l mirrored by the surface; 0
/// where the light or the eye is behind.
///
/// Source: Phong, "Illumination for computer generated pictures", CACM 18 (1975).
///
/// # Precision
/// r·v is within 12ε (ε = 2^-24), and the power as [`power`] of that: near the highlight within 13ε·`shininess` of the
/// exact share.
///
/// # Cost
/// 18 multiplications and additions, and [`power`].
#[must_use]
#[inline]
pub fn phong<S: Space>(n: Vector3<S>, l: Vector3<S>, v: Vector3<S>, shininess: u32) -> f32 {
    let cosine = dot(n, l);
    let mirrored = n * (2.0 * cosine) - l;
    let along = dot(mirrored, v);
    if cosine > 0.0 && along > 0.0 { power(along.min(1.0), shininess) } else { 0.0 }
}

/// The specular share of the light by Blinn: (n·h)^shininess, where h is halfway between l and v; 0 where the light is
/// behind, or opposite to the eye.
///
/// The highlight of an exponent is about that of a quarter of it in [`phong`].
///
/// Source: Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977.
///
/// # Precision
/// n·h is within 7ε (ε = 2^-24) where |l + v| is at least 1, and the power as [`power`] of that: near the highlight
/// within 8ε·`shininess` of the exact share.
///
/// # Cost
/// 16 multiplications and additions, a square root, three divisions, and [`power`].
#[must_use]
#[inline]
pub fn blinn_phong<S: Space>(n: Vector3<S>, l: Vector3<S>, v: Vector3<S>, shininess: u32) -> f32 {
    let halfway = (l + v).coords;
    let cosine = dot(n, Vector3::new(Vec3::from(unit_lanes(One, halfway.to_array()))));
    let seen = dot(n, l) > 0.0 && halfway != Vec3::ZERO && cosine > 0.0;
    if seen { power(cosine.min(1.0), shininess) } else { 0.0 }
}

/// x^`exponent`, by squaring.
///
/// # Precision
/// Within 1.01·(`exponent` − 1)ε, relatively (ε = 2^-24), for exponents up to 2^16, where neither the result nor a
/// power on the way to it is below `f32::MIN_POSITIVE`; there within that. x^0 is 1, and x^1 is x.
///
/// # Cost
/// At most two multiplications for each bit of the exponent.
#[must_use]
#[inline]
pub fn power(x: f32, exponent: u32) -> f32 {
    let (mut result, mut square, mut left) = (1.0, x, exponent);
    while left > 1 {
        if left & 1 == 1 {
            result *= square;
        }
        square *= square;
        left >>= 1;
    }
    if left == 1 { result * square } else { result }
}

/// The exponent that a shininess map's number m from 0 to 1 stands for: from `least` at 0 to `greatest` at 1, to the
/// nearest. Numbers beyond count as 0 or 1, NaN as 0.
///
/// The exponent is linear in the map, as in MTL files, where `map_Ns` scales `Ns`; for `greatest` up to 2^16.
///
/// # Precision
/// Within 0.51 of the exact exponent.
#[must_use]
#[inline]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturation is wanted")]
#[expect(clippy::cast_precision_loss, reason = "exact up to 2^24")]
pub fn shininess(m: f32, [least, greatest]: [u32; 2]) -> u32 {
    let m = clamped(m);
    ((1.0 - m) * least as f32 + m * greatest as f32 + 0.5) as u32
}

/// The share of the ambient light that reaches a place whose occlusion map has the number `ao`, 1 where nothing is in
/// the way: 1 + strength·(ao − 1). It is for ambient light only; that of lamps has shadows instead. Numbers beyond 0 to
/// 1 count as 0 or 1, NaN as 0.
///
/// Source: glTF 2.0, `occlusionTexture.strength`.
///
/// # Precision
/// Within 3ε (ε = 2^-24).
#[must_use]
#[inline]
pub fn ambient_occlusion(ao: f32, strength: f32) -> f32 {
    1.0 + clamped(strength) * (clamped(ao) - 1.0)
}

/// What of a material changes when it gets wet: the diffuse colour, and how glossy it is, from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wettable {
    /// The share of each colour that is scattered.
    pub diffuse: Vec3,
    /// How sharp the highlight is, from 0 to 1; [`shininess`] makes an exponent of it.
    pub gloss: f32,
}

impl Wettable {
    /// The material with this much water on it, from 0 to 1: light that entered the water is reflected back into the
    /// surface, which absorbs more of it, so rough and porous materials get darker; and the water's surface is smoother
    /// than theirs, so the highlight gets sharper.
    ///
    /// ```text
    /// diffuse' = diffuse (1 − 0.7 wetness)         gloss' = min(gloss (1 + 1.5 wetness), 1)
    /// ```
    ///
    /// The factors are fitted by eye. Metals and polished surfaces hardly darken: mask them. A wetness beyond 0 to 1
    /// counts as 0 or 1, NaN as 0.
    ///
    /// Source: Lagarde, "Water drop 2b: dynamic rain and its effects", 2013. Why wet things are dark: Lekner and Dorf,
    /// "Why some things are darker when wet", Applied Optics 27 (1988).
    ///
    /// # Precision
    /// Each component is within 5ε of itself (ε = 2^-24).
    ///
    /// ```
    /// use alberti_texture::surface::{Wettable, shininess};
    /// use glam::Vec3;
    ///
    /// let road = Wettable { diffuse: Vec3::splat(0.4), gloss: 0.25 };
    /// assert!(road.wet(1.0).diffuse.x < 0.1201);
    /// // The highlight's exponent, 26 when dry.
    /// assert_eq!(shininess(road.wet(1.0).gloss, [1, 101]), 64);
    /// ```
    #[must_use]
    pub fn wet(self, wetness: f32) -> Self {
        let wetness = clamped(wetness);
        let gloss = self.gloss * (1.0 + 1.5 * wetness);
        Self { diffuse: self.diffuse * (1.0 - 0.7 * wetness), gloss: if gloss < 1.0 { gloss } else { 1.0 } }
    }
}

/// Between 0 and 1; 0 for NaN.
fn clamped(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

/// Written out, so that the order of the operations is the same on every target.
fn dot<S: Space>(a: Vector3<S>, b: Vector3<S>) -> f32 {
    let (a, b) = (a.coords, b.coords);
    a.x * b.x + a.y * b.y + a.z * b.z
}
