//! Normal maps: a direction in each texel, instead of a colour.
//!
//! Space in: texels as words, as [`Rgba8::to_bits`] makes them and samplers return them. Space out: unit vectors, in
//! the tangent frame or in object space, whichever the map was made for. One in object space fits one object; one in
//! the tangent frame fits all.
//!
//! Everything is written over lanes; the functions on one texel are those on one lane, so they give the same bits.

use super::tangent::Tangent;
use super::vector::{dot_lanes, has_range, over_length, unit_lanes};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Frame, Rgba8, Space, Vector3};
use glam::Vec3;

/// The number that a byte of a normal map stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum NormalEncoding {
    /// A byte c stands for 2c/255 − 1, as in glTF and as GPUs read `unorm` textures: -1 and 1 are exact, 0 does not
    /// exist. So the usual flat blue (128, 128, 255) is tilted by 0.32° towards the corner.
    #[default]
    Unorm,
    /// A byte c stands for (c − 128)/127, and 0 for -1 as 1 does: 128 is exactly 0, and (128, 128, 255) is exactly
    /// flat. It is `snorm` with the highest bit turned. (128, 128, 128), which has no direction, is flat.
    Centred,
}

impl NormalEncoding {
    /// The numerator that stands for 1: 127 or more, at most 255.
    #[inline(always)]
    const fn one(self) -> f32 {
        match self {
            Self::Unorm => 255.0,
            Self::Centred => 127.0,
        }
    }

    /// The number that a byte stands for, times [`one`](Self::one): an integer between that and its opposite.
    #[inline(always)]
    fn numerator<L: Lanes>(self, lanes: L, byte: L::U32) -> L::Number {
        let number = lanes.to_numbers(byte);
        match self {
            Self::Unorm => number + number - lanes.splat(255.0),
            Self::Centred => lanes.max(number - lanes.splat(128.0), lanes.splat(-127.0)),
        }
    }
}

/// The direction that red, green and blue stand for, as a unit vector of the space that the map was made for.
///
/// # Precision
/// For all 2^24 texels, each component is within 2ε of itself (ε = 2^-24), and the length within 2ε of 1. The
/// direction, as all components share the error of the length, is within 1.1ε radians.
///
/// # Cost
/// A square root and three divisions.
///
/// ```
/// use alberti_math::{Object, Rgba8, Vector3};
/// use alberti_texture::surface::{NormalEncoding::{Centred, Unorm}, Tangent, normal};
/// use glam::Vec3;
///
/// let flat = Rgba8::new(128, 128, 255, 255);
/// let tangent: Vector3<Tangent> = normal(Centred, flat);
/// assert_eq!(tangent.coords, Vec3::Z);
/// let tilted: Vector3<Tangent> = normal(Unorm, flat);
/// assert!(tilted.coords.x > 0.0039);
/// // In object space, any direction is one.
/// let object: Vector3<Object> = normal(Centred, Rgba8::new(1, 128, 128, 255));
/// assert_eq!(object.coords, Vec3::NEG_X);
/// ```
#[must_use]
#[inline]
pub fn normal<S: Space>(encoding: NormalEncoding, texel: Rgba8) -> Vector3<S> {
    Vector3::new(Vec3::from(normal_lanes(encoding, One, core::num::Wrapping(texel.to_bits()))))
}

/// [`normal`] of several texels.
///
/// # Precision
/// In fixed point each component is within 1.1·2^-16.
#[must_use]
#[inline(always)]
pub fn normal_lanes<L: Lanes>(encoding: NormalEncoding, lanes: L, texels: L::U32) -> [L::Number; 3] {
    let quarter = |bits| quarter(encoding, lanes, texels, bits);
    over_length(lanes, [quarter(0), quarter(8), quarter(16)])
}

/// A quarter of a channel's numerator. Squares of quarters of integers up to 255 are exact, and so is the sum of three,
/// in fixed point also.
#[inline(always)]
fn quarter<L: Lanes>(encoding: NormalEncoding, lanes: L, texels: L::U32, bits: u32) -> L::Number {
    encoding.numerator(lanes, lanes.shr(texels, bits) & lanes.word(255)) * lanes.splat(0.25)
}

/// The direction of a tangent-space map that stores x and y only, in red and green. z is √(1 − x² − y²), for a length
/// of 1. It is 0 where x and y alone are longer, whose direction is kept.
///
/// Near the horizon, where z is small, the steps of x and y are steps of z too. For bytes they are of up to 6.1°, and
/// of 0.7° where z is above one half.
///
/// # Precision
/// Within 2ε of each component (ε = 2^-24), and of length 1, for all 2^16 pairs of bytes.
///
/// # Cost
/// Two square roots and three divisions.
#[must_use]
#[inline]
pub fn normal_of_two(encoding: NormalEncoding, texel: Rgba8) -> Vector3<Tangent> {
    Vector3::new(Vec3::from(normal_of_two_lanes(encoding, One, core::num::Wrapping(texel.to_bits()))))
}

/// [`normal_of_two`] of several texels.
///
/// # Precision
/// In fixed point each component is within 1.1·2^-16.
#[must_use]
#[inline(always)]
pub fn normal_of_two_lanes<L: Lanes>(encoding: NormalEncoding, lanes: L, texels: L::U32) -> [L::Number; 3] {
    let (x, y) = (quarter(encoding, lanes, texels, 0), quarter(encoding, lanes, texels, 8));
    let (whole, across) = (lanes.splat(encoding.one() * encoding.one() / 16.0), x * x + y * y);
    let z = lanes.sqrt(lanes.max(whole - across, lanes.splat(0.0)));
    let length = lanes.sqrt(lanes.max(whole, across));
    [x / length, y / length, z / length]
}

/// The normal of a surface whose slopes are `strength` times those that this normal has: 0 is flat, 1 as it is,
/// negative turns hills into valleys.
///
/// The slopes are −x/z and −y/z, so x and y are multiplied, and the vector made unit again. A `strength` beyond ±65536
/// counts as that, and NaN and what is between ±2^-50 as 0.
///
/// # Precision
/// For a unit vector whose z is 0 or beyond ±2^-50, each component is within 5ε of itself (ε = 2^-24) and 2^-98, and
/// the length within 4ε of 1.
///
/// # Cost
/// A square root and three divisions.
#[must_use]
#[inline]
pub fn strengthened(normal: Vector3<Tangent>, strength: f32) -> Vector3<Tangent> {
    Vector3::new(Vec3::from(strengthened_lanes(One, normal.coords.to_array(), strength)))
}

/// [`strengthened`] for several normals.
///
/// # Precision
/// In fixed point each component is within (3 + 1.5/r)·2^-16, where r is the length of the vector before it is made
/// unit again. There, a `strength` beyond ±16384 counts as that.
#[must_use]
#[inline(always)]
pub fn strengthened_lanes<L: Lanes>(lanes: L, [x, y, z]: [L::Number; 3], strength: f32) -> [L::Number; 3] {
    // Squares of less have too few bits.
    const LEAST: f32 = 1.0 / 1_125_899_906_842_624.0;
    let strength = if strength.abs() >= LEAST { strength.clamp(-65536.0, 65536.0) } else { 0.0 };
    let strength = lanes.splat(if has_range(lanes) { strength } else { strength.clamp(-16384.0, 16384.0) });
    unit_lanes(lanes, [x * strength, y * strength, z])
}

/// A normal of the tangent frame as a unit vector of the frame's parent.
///
/// The frame is one with unit axes; those that are interpolated between vertices need not be made unit or perpendicular
/// again, as maps that were made for MikkTSpace expect.
///
/// # Precision
/// Within 6ε radians (ε = 2^-24) for axes at right angles, and the length within 3.1ε of 1, if the transformed vector
/// is between 2^-60 and 2^60 long. (0, 0, 1) where it is zero.
///
/// # Cost
/// Nine multiplications, a square root and three divisions.
#[must_use]
#[inline]
pub fn normal_to_parent<P: Space>(frame: &Frame<Tangent, P>, normal: Vector3<Tangent>) -> Vector3<P> {
    let axes = frame.axes();
    let axes = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis.to_array());
    Vector3::new(Vec3::from(to_parent_lanes(One, axes, normal.coords.to_array())))
}

/// [`normal_to_parent`] for several normals, and a frame for each, by its x, y and z axis.
///
/// # Precision
/// In fixed point each component is within 4·2^-16 for axes at right angles.
#[must_use]
#[inline(always)]
pub fn to_parent_lanes<L: Lanes>(
    lanes: L,
    [x_axis, y_axis, z_axis]: [[L::Number; 3]; 3],
    normal: [L::Number; 3],
) -> [L::Number; 3] {
    let x = dot_lanes([x_axis[0], y_axis[0], z_axis[0]], normal);
    let y = dot_lanes([x_axis[1], y_axis[1], z_axis[1]], normal);
    unit_lanes(lanes, [x, y, dot_lanes([x_axis[2], y_axis[2], z_axis[2]], normal)])
}
