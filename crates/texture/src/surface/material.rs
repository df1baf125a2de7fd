//! Reflection of light on surfaces: formulas whose numbers are in material maps, for wetness, shininess or occlusion.
//!
//! Space in: unit vectors in any one space, all from the surface: the normal n, the light's direction l, the eye's v.
//! Space out: shares of the light. Nothing here needs a library function, so that the bits are the same everywhere.

use super::vector::{clamped_lanes, dot_lanes, unit_lanes};
use crate::environment::reflect_lanes;
use alberti_math::lanes::{Lanes, One};
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
    lambert_lanes(One, n.coords.to_array(), l.coords.to_array())
}

/// [`lambert`] for several samples.
///
/// # Precision
/// In fixed point within 1.6·2^-16.
#[must_use]
#[inline(always)]
pub fn lambert_lanes<L: Lanes>(lanes: L, n: [L::Number; 3], l: [L::Number; 3]) -> L::Number {
    lanes.max(dot_lanes(n, l), lanes.splat(0.0))
}

/// The specular share of the light by Phong: (r·v)^shininess, where r = 2(n·l)n − l is l mirrored by the surface. It is
/// 0 where the light is behind the surface, or r·v is not above 0.
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
    phong_lanes(One, n.coords.to_array(), l.coords.to_array(), v.coords.to_array(), shininess)
}

/// [`phong`] for several samples with the same exponent.
///
/// # Precision
/// In fixed point that of [`phong_cosine_lanes`] and of [`power_lanes`].
#[must_use]
#[inline(always)]
pub fn phong_lanes<L: Lanes>(
    lanes: L,
    n: [L::Number; 3],
    l: [L::Number; 3],
    v: [L::Number; 3],
    shininess: u32,
) -> L::Number {
    share(lanes, phong_cosine_lanes(lanes, n, l, v), shininess)
}

/// The cosine that [`phong`] raises to a power, for several samples: r·v between 0 and 1, and 0 where the light is
/// behind the surface. With [`power_each_lanes`] the exponents may differ.
///
/// # Precision
/// Within 12ε (ε = 2^-24); in fixed point within 5·2^-16.
#[must_use]
#[inline(always)]
pub fn phong_cosine_lanes<L: Lanes>(
    lanes: L,
    n: [L::Number; 3],
    l: [L::Number; 3],
    v: [L::Number; 3],
) -> L::Number {
    let cosine = dot_lanes(n, l);
    let along = dot_lanes(reflect_lanes(lanes, n, l), v);
    let zero = lanes.splat(0.0);
    lanes.select(lanes.less(zero, cosine), clamped_lanes(lanes, along), zero)
}

/// The specular share of the light by Blinn: (n·h)^shininess, where h is halfway between l and v. It is 0 where the
/// light is behind the surface or opposite to the eye, or n·h is not above 0.
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
    blinn_phong_lanes(One, n.coords.to_array(), l.coords.to_array(), v.coords.to_array(), shininess)
}

/// [`blinn_phong`] for several samples with the same exponent.
///
/// # Precision
/// In fixed point that of [`blinn_phong_cosine_lanes`] and of [`power_lanes`].
#[must_use]
#[inline(always)]
pub fn blinn_phong_lanes<L: Lanes>(
    lanes: L,
    n: [L::Number; 3],
    l: [L::Number; 3],
    v: [L::Number; 3],
    shininess: u32,
) -> L::Number {
    share(lanes, blinn_phong_cosine_lanes(lanes, n, l, v), shininess)
}

/// The cosine that [`blinn_phong`] raises to a power, for several samples: n·h, at most 1, and 0 where the light is
/// behind, or opposite to the eye. With [`power_each_lanes`] the exponents may differ.
///
/// # Precision
/// Within 7ε (ε = 2^-24) where |l + v| is at least 1; in fixed point within 4·2^-16 there.
#[must_use]
#[inline(always)]
pub fn blinn_phong_cosine_lanes<L: Lanes>(
    lanes: L,
    n: [L::Number; 3],
    l: [L::Number; 3],
    v: [L::Number; 3],
) -> L::Number {
    let halfway = [l[0] + v[0], l[1] + v[1], l[2] + v[2]];
    let zero = lanes.splat(0.0);
    // The square decides: what it loses below is no more than rounding of unit vectors.
    let seen = lanes.less(zero, dot_lanes(n, l)) & lanes.less(zero, dot_lanes(halfway, halfway));
    lanes.select(seen, clamped_lanes(lanes, dot_lanes(n, unit_lanes(lanes, halfway))), zero)
}

/// cosine^`exponent`, and 0 where the cosine is, also for an exponent of 0.
#[inline(always)]
fn share<L: Lanes>(lanes: L, cosine: L::Number, exponent: u32) -> L::Number {
    let zero = lanes.splat(0.0);
    lanes.select(lanes.less(zero, cosine), power_lanes(lanes, cosine, exponent), zero)
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
    power_lanes(One, x, exponent)
}

/// [`power`] of several numbers.
///
/// # Precision
/// In fixed point within `exponent`·2^-17 for numbers from 0 to 1.
#[must_use]
#[inline(always)]
pub fn power_lanes<L: Lanes>(lanes: L, x: L::Number, exponent: u32) -> L::Number {
    let (mut result, mut square, mut left) = (lanes.splat(1.0), x, exponent);
    while left > 1 {
        if left & 1 == 1 {
            result = result * square;
        }
        square = square * square;
        left >>= 1;
    }
    if left == 1 { result * square } else { result }
}

/// [`power`] of several numbers, with an exponent for each, none of which is above `greatest`: bits above its highest
/// count as 0. The same bits as [`power_lanes`] has.
///
/// # Precision
/// That of [`power_lanes`].
///
/// # Cost
/// Two multiplications, a comparison and a selection for each bit of `greatest`.
#[must_use]
#[inline(always)]
pub fn power_each_lanes<L: Lanes>(lanes: L, x: L::Number, exponents: L::U32, greatest: u32) -> L::Number {
    let (mut result, mut square, mut left) = (lanes.splat(1.0), x, greatest);
    let mut bits = exponents;
    while left > 0 {
        let set = lanes.less(lanes.splat(0.0), lanes.to_numbers(bits & lanes.word(1)));
        result = lanes.select(set, result * square, result);
        (bits, left) = (lanes.shr(bits, 1), left >> 1);
        if left > 0 {
            square = square * square;
        }
    }
    result
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
pub fn shininess(m: f32, range: [u32; 2]) -> u32 {
    shininess_lanes(One, m, range).0
}

/// [`shininess`] for several samples.
///
/// # Precision
/// Within 0.51, in fixed point for exponents up to 32766.
#[must_use]
#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "exact up to 2^24")]
pub fn shininess_lanes<L: Lanes>(lanes: L, m: L::Number, [least, greatest]: [u32; 2]) -> L::U32 {
    let m = clamped_lanes(lanes, m);
    let [least, greatest] = [least, greatest].map(|end| lanes.splat(end as f32));
    lanes.floor_scaled((lanes.splat(1.0) - m) * least + m * greatest + lanes.splat(0.5), 0)
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
    ambient_occlusion_lanes(One, ao, strength)
}

/// [`ambient_occlusion`] for several samples.
///
/// # Precision
/// In fixed point within 2^-16.
#[must_use]
#[inline(always)]
pub fn ambient_occlusion_lanes<L: Lanes>(lanes: L, ao: L::Number, strength: f32) -> L::Number {
    let (one, strength) = (lanes.splat(1.0), clamped_lanes(lanes, lanes.splat(strength)));
    one + strength * (clamped_lanes(lanes, ao) - one)
}

/// The properties of a material that change when it gets wet: the diffuse colour, and the gloss, from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wettable {
    /// The share of each colour that is scattered.
    pub diffuse: Vec3,
    /// The sharpness of the highlight, from 0 to 1; [`shininess`] makes an exponent of it.
    pub gloss: f32,
}

impl Wettable {
    /// The material with this much water on it, from 0 to 1. Light that entered the water is reflected back into the
    /// surface, which absorbs more of it, so rough and porous materials get darker. The water's surface is smoother
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
        let (diffuse, gloss) = wet_lanes(One, self.diffuse.to_array(), self.gloss, wetness);
        Self { diffuse: Vec3::from(diffuse), gloss }
    }
}

/// [`Wettable::wet`] for several samples: the diffuse colours and the gloss, wet.
///
/// # Precision
/// In fixed point each component is within 1.5·2^-16 for a gloss up to 1.
#[must_use]
#[inline(always)]
pub fn wet_lanes<L: Lanes>(
    lanes: L,
    diffuse: [L::Number; 3],
    gloss: L::Number,
    wetness: L::Number,
) -> ([L::Number; 3], L::Number) {
    let (one, wetness) = (lanes.splat(1.0), clamped_lanes(lanes, wetness));
    let left = one - lanes.splat(0.7) * wetness;
    let gloss = gloss * (one + lanes.splat(1.5) * wetness);
    ([diffuse[0] * left, diffuse[1] * left, diffuse[2] * left], lanes.min(gloss, one))
}
