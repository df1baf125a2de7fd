//! Fog: colours that fade into one with the distance.

use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, Varying};
use alberti_raster::{FragmentColor, FragmentStage, Fragments, Gradient};
use alberti_texture::format::Rgb565;
use core::fmt::Debug;

/// Another stage's colour, fading into that of a fog.
///
/// Vertices carry the fog's [`coordinate`](Fog::coordinate) beside what the stage needs. It is linear in space, so that
/// it is interpolated exactly whatever the triangle's size, also where it reaches behind the eye. Its range is ±4000:
/// where a vertex is beyond 4000 depths of a [`LinearFog`], or 4000 over a density, the triangle's fog is another one.
///
/// The stage's colours are of 8 bits a channel, or words of 16 bits, which are RGB565: those of
/// [`Stored`](super::Stored) texels, under [light](super::Lit565) or not. The fog's is such a word then, as
/// [`rgb565`](alberti_raster::color::rgb565) makes it.
///
/// ```
/// use alberti::shaders::fog::{ExponentialFog, Fog, Fogged};
/// use alberti::shaders::Solid;
/// use alberti::{Camera, Mesh, Object, Point3, Rgba8, glam::Vec3};
///
/// let view = Camera::look_at(Vec3::Z * 5.0, Vec3::ZERO, Vec3::Y)?.perspective(1.0, 0.1..100.0)?;
/// let fog = ExponentialFog { density: 0.05 };
/// let to_eye = view.object_to_eye(None);
/// let vertices = [Vec3::ZERO, Vec3::X, Vec3::Y];
/// let mesh = Mesh::new(&vertices, &[[0_u16, 1, 2]], |v: &Vec3| {
///     let position = Point3::<Object>::new(*v);
///     (position, (fog.coordinate(to_eye.to_parent(position).coords.z), ()))
/// });
/// let stage = Fogged { surface: Solid(Rgba8::WHITE), fog, color: Rgba8::from_rgb24(0x80_90_a0) };
/// # let _ = (mesh, stage);
/// # Ok::<(), alberti::ViewError>(())
/// ```
///
/// # Precision
/// The fog's, and half a byte: amounts are 256ths. In RGB565 they are 32nds: each channel is within 1.2 levels, green
/// 1.9, of the mean by the fog's formula.
///
/// # Cost
/// The fog's, and two products, four sums and shifts. In RGB565 a product, and ten sums, shifts and masks: with
/// [`LinearFog`] 30 instructions more a pixel on a Cortex-M4F, 42 on a Cortex-M0+.
#[derive(Clone, Copy, Debug)]
pub struct Fogged<S, F, C = Rgba8> {
    /// The stage.
    pub surface: S,
    /// The law.
    pub fog: F,
    /// The fog's colour, as the stage has them; the surface's alpha is kept.
    pub color: C,
}

/// A law by which a fog grows.
pub trait Fog: Copy + Debug {
    /// The number that a vertex at this distance along the line of sight carries, negative behind the eye.
    fn coordinate(&self, distance: f32) -> f32;

    /// The fog before fragments with these coordinates, in 256ths.
    fn amount<L: Lanes>(&self, lanes: L, coordinate: L::Number) -> L::U32;
}

/// None up to a distance, and nothing else from another on.
///
/// ```text
/// fog = (z − start)/(end − start), from 0 to 1
/// ```
///
/// # Precision
/// To the nearest 256th of the interpolated coordinate.
///
/// # Cost
/// Two comparisons, a product, a conversion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearFog {
    /// The distance at which it begins.
    pub start: f32,
    /// The distance at which there is nothing else.
    pub end: f32,
}

impl Fog for LinearFog {
    fn coordinate(&self, distance: f32) -> f32 {
        let all = (distance - self.start) / (self.end - self.start);
        // A fog without a depth is a wall.
        if all.is_nan() { 0.0 } else { all.clamp(-MOST, MOST) }
    }

    #[inline(always)]
    fn amount<L: Lanes>(&self, lanes: L, coordinate: L::Number) -> L::U32 {
        lanes.of_unit(coordinate, 256)
    }
}

/// The greatest coordinate, within the range of fixed point.
const MOST: f32 = 4000.0;

/// A haze of the same density everywhere.
///
/// ```text
/// fog = 1 − e^(−density · z)
/// ```
///
/// # Precision
/// Within 1.3 256ths of the formula for the interpolated coordinate, from a table.
///
/// # Cost
/// Two loads from a table of 130 bytes, a product, conversions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ExponentialFog {
    /// One over the distance at which 1/e is left.
    pub density: f32,
}

/// A fog that begins softly.
///
/// ```text
/// fog = 1 − e^(−(density · z)²)
/// ```
///
/// # Precision
/// Within 1.3 256ths of the formula for the interpolated coordinate, from a table.
///
/// # Cost
/// That of [`ExponentialFog`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SquaredFog {
    /// One over the distance at which 1/e is left.
    pub density: f32,
}

/// A [`Fog`] that is chosen at run time.
///
/// # Precision
/// That of the fog, whose bits it gives.
///
/// # Cost
/// A match for the samples that are worked on together. The code of all three.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyFog {
    /// None up to a distance, and nothing else from another on.
    Linear(LinearFog),
    /// A haze of the same density everywhere.
    Exponential(ExponentialFog),
    /// One that begins softly.
    Squared(SquaredFog),
}

impl Fog for AnyFog {
    fn coordinate(&self, distance: f32) -> f32 {
        match self {
            Self::Linear(fog) => fog.coordinate(distance),
            Self::Exponential(fog) => fog.coordinate(distance),
            Self::Squared(fog) => fog.coordinate(distance),
        }
    }

    #[inline(always)]
    fn amount<L: Lanes>(&self, lanes: L, coordinate: L::Number) -> L::U32 {
        match self {
            Self::Linear(fog) => fog.amount(lanes, coordinate),
            Self::Exponential(fog) => fog.amount(lanes, coordinate),
            Self::Squared(fog) => fog.amount(lanes, coordinate),
        }
    }
}

/// The cells of tables, and how many of them there are to a unit.
const CELLS: usize = 64;
/// Their number, with eight bits of fraction.
const END: u32 = 64 << 8;
const BITS: [u32; 2] = [3, 4];

macro_rules! tables {
    ($($name:ident: $bits:expr, $table:ident;)*) => {$(
        impl Fog for $name {
            fn coordinate(&self, distance: f32) -> f32 {
                let coordinate = distance * self.density;
                if coordinate.is_nan() { 0.0 } else { coordinate.clamp(-MOST, MOST) }
            }

            #[inline(always)]
            fn amount<L: Lanes>(&self, lanes: L, coordinate: L::Number) -> L::U32 {
                look_up(lanes, &$table, coordinate, $bits)
            }
        }
    )*};
}
tables! {
    ExponentialFog: BITS[0], EXPONENTIAL;
    SquaredFog: BITS[1], SQUARED;
}

/// The amount at a coordinate in units of 2^-`bits` cells, from 0 on, by a straight line through its cell.
#[inline(always)]
fn look_up<L: Lanes>(lanes: L, table: &[u16; CELLS + 1], coordinate: L::Number, bits: u32) -> L::U32 {
    #[expect(clippy::cast_precision_loss, reason = "small")]
    let end = lanes.splat(CELLS as f32 / (1 << bits) as f32);
    let within = lanes.max(lanes.min(coordinate, end), lanes.splat(0.0));
    let at = lanes.floor_scaled(within, bits + 8);
    let at = lanes.min_words(at, lanes.word(END));
    let (cell, along) = (lanes.shr(at, 8), at & lanes.word(255));
    let [low, high] = lanes.gather_pairs(cell, |cell| {
        let at = |k: usize| u32::from(table.get(k.min(CELLS)).copied().unwrap_or_default());
        [at(cell as usize), at(cell as usize + 1)]
    });
    // In 65536ths times 256, rounded to 256ths.
    lanes.shr(lanes.shl(low, 8) + (high - low) * along + lanes.word(1 << 15), 16)
}

/// 1 − e^(−k/8) in 65536ths, the last entry 65535.
const EXPONENTIAL: [u16; CELLS + 1] = {
    // e^(-1/8).
    const STEP: f64 = 0.882_496_902_584_595_4;
    let (mut table, mut left, mut k) = ([0; CELLS + 1], 1.0, 0);
    while k <= CELLS {
        table[k] = parts(1.0 - left);
        left *= STEP;
        k += 1;
    }
    table
};

/// 1 − e^(−(k/16)²) in 65536ths.
const SQUARED: [u16; CELLS + 1] = {
    // e^(-1/256), of which (k + 1)² − k² = 2 k + 1 more make the next.
    const STEP: f64 = 0.996_101_369_470_117_5;
    let (mut table, mut left, mut factor, mut k) = ([0; CELLS + 1], 1.0, STEP, 0);
    while k <= CELLS {
        table[k] = parts(1.0 - left);
        left *= factor;
        factor *= STEP * STEP;
        k += 1;
    }
    table
};

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 65535")]
const fn parts(part: f64) -> u16 {
    let parts = part * 65536.0 + 0.5;
    if parts > 65535.0 { 65535 } else { parts as u16 }
}

impl<S, F: Fog, C: FragmentColor> Fogged<S, F, C> {
    /// Colours behind the fog, of which so much is before them.
    #[inline(always)]
    pub fn on<L: Lanes>(&self, lanes: L, coordinate: L::Number, surface: L::U32) -> L::U32 {
        let (amount, color) = (self.fog.amount(lanes, coordinate), self.color.to_word());
        if const { C::IS_COLOR } {
            return bytes(lanes, surface, color, amount);
        }
        const {
            assert!(
                C::IS_COLOR || size_of::<C>() == 2,
                "the stage's colours are no RGB565: let them be Rgba8 before a fog"
            );
        };
        let (near, far) = (Rgb565::spread(lanes, surface), Rgb565::spread(lanes, lanes.word(color)));
        let amount = lanes.shr(amount + lanes.word(4), 3);
        Rgb565::gathered(lanes, Rgb565::blended(lanes, near, far, amount))
    }
}

/// Colours of bytes, of which the far one has a part of so many 256ths.
#[inline(always)]
fn bytes<L: Lanes>(lanes: L, surface: L::U32, color: u32, amount: L::U32) -> L::U32 {
    let bytes = lanes.word(0x00ff_00ff);
    let red_blue = mixed(lanes, surface & bytes, lanes.word(color & 0x00ff_00ff), amount);
    let near = lanes.shr(surface, 8);
    // Alpha stays: both are the surface's.
    let far = (near & lanes.word(0x00ff_0000)) | lanes.word(color >> 8 & 0xff);
    let green_alpha = mixed(lanes, near & bytes, far, amount);
    red_blue | lanes.shl(green_alpha, 8)
}

/// Two bytes in the halves of a word, of which the far ones have a part of so many 256ths.
#[inline(always)]
fn mixed<L: Lanes>(lanes: L, near: L::U32, far: L::U32, amount: L::U32) -> L::U32 {
    lanes.shr(lanes.mix_halves(near, far, amount) + lanes.word(0x0080_0080), 8) & lanes.word(0x00ff_00ff)
}

impl<V: Varying, C: FragmentColor, S: FragmentStage<V, Color = C>, F: Fog> FragmentStage<(f32, V)>
    for Fogged<S, F, C>
{
    as_surface!((f32, V), |gradient| &gradient.map(|(_, part)| part));

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, (f32, V)>) -> (L::U32, L::Mask) {
        let (lanes, (coordinate, _)) = (fragments.lanes, fragments.varying);
        let (surface, mask) = self.surface.shade(&fragments.part(|(_, varying)| *varying));
        (self.on(lanes, coordinate, surface), mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Solid;
    use alberti_math::Q16;
    use alberti_math::lanes::{One, OneFixed};
    use std::f64::consts::E;

    fn amounts(fog: impl Fog, coordinate: f32) -> [f64; 2] {
        let float = fog.amount(One, coordinate).0;
        let fixed = fog.amount(OneFixed, Q16::from_f32(coordinate)).0;
        [float.into(), fixed.into()]
    }

    #[test]
    fn fogs_are_their_formulas() {
        let (mut worst, mut most) = ([0.0_f64; 3], 0.0_f64);
        for k in 0..40_000_u16 {
            let z = f32::from(k) * 0.0005;
            let x = f64::from(z);
            let line = LinearFog { start: 2.0, end: 7.0 };
            let all = [
                (amounts(line, line.coordinate(z)), ((x - 2.0) / 5.0).clamp(0.0, 1.0)),
                (amounts(ExponentialFog { density: 1.0 }, z), 1.0 - E.powf(-x)),
                (amounts(SquaredFog { density: 1.0 }, z), 1.0 - E.powf(-x * x)),
            ];
            let any = [AnyFog::Linear(line), AnyFog::Exponential(ExponentialFog { density: 1.0 })];
            assert_eq!(all[0].0, amounts(any[0], any[0].coordinate(z)));
            assert_eq!(all[1].0, amounts(any[1], any[1].coordinate(z)));
            assert_eq!(all[2].0, amounts(AnyFog::Squared(SquaredFog { density: 1.0 }), z));
            for (worst, (found, expected)) in worst.iter_mut().zip(all) {
                for found in found {
                    *worst = worst.max((found - 256.0 * expected).abs());
                    most = most.max(found);
                }
            }
        }
        assert!(worst[0] <= 0.51 && worst[1] <= 1.3 && worst[2] <= 1.3, "{worst:?}");
        assert!(worst[1] > 0.5 && worst[2] > 0.5 && most == 256.0, "{worst:?} {most}");
    }

    #[test]
    fn coordinates_are_distances_by_the_density() {
        assert_eq!(ExponentialFog { density: 0.25 }.coordinate(8.0), 2.0);
        assert_eq!(SquaredFog { density: 0.25 }.coordinate(-8.0), -2.0);
        assert_eq!(LinearFog { start: 4.0, end: 8.0 }.coordinate(6.0), 0.5);
        assert_eq!(LinearFog { start: 4.0, end: 4.0 }.coordinate(4.0), 0.0);
        for wild in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30] {
            for coordinate in [
                ExponentialFog { density: wild }.coordinate(0.0),
                SquaredFog { density: 1.0 }.coordinate(wild),
                LinearFog { start: wild, end: 1.0 }.coordinate(1.0),
            ] {
                assert!(coordinate.abs() <= MOST, "{wild}");
            }
        }
    }

    #[test]
    fn a_fog_mixes_its_colour_in_and_keeps_alpha() {
        let fog = LinearFog { start: 0.0, end: 1.0 };
        for byte in 0..=255_u8 {
            for k in 0..=64_u8 {
                let part = f32::from(k) / 64.0;
                let surface = Solid(Rgba8::new(byte, 255 - byte, byte, byte));
                let stage = Fogged { surface, fog, color: Rgba8::new(200, 10, 0, 77) };
                let found = stage.shade_one((part, ())).expect("not discarded").to_bytes();
                for (found, (near, far)) in
                    found.into_iter().zip([(byte, 200), (255 - byte, 10), (byte, 0), (byte, byte)])
                {
                    let expected = f32::from(near) * (1.0 - part) + f32::from(far) * part;
                    assert!((f32::from(found) - expected).abs() <= 0.5, "{byte} {part}: {found} {expected}");
                }
            }
        }
    }

    /// Words of 16 bits against the mean in reals of each channel, by the formula of each fog.
    #[test]
    fn a_fog_mixes_levels_as_nearly_as_it_says() {
        let mut worst = [0.0_f64; 3];
        for k in 0..30_000_u16 {
            let texel = k.wrapping_mul(0x9e37);
            let color = [0xffff, 0, 0x8410, !texel][usize::from(k % 4)];
            let z = f32::from(k % 4099) / 1024.0;
            let x = f64::from(z);
            let line = LinearFog { start: 1.0, end: 3.5 };
            let fogs = [
                (AnyFog::Linear(line), ((x - 1.0) / 2.5).clamp(0.0, 1.0)),
                (AnyFog::Exponential(ExponentialFog { density: 1.0 }), 1.0 - E.powf(-x)),
                (AnyFog::Squared(SquaredFog { density: 1.0 }), 1.0 - E.powf(-x * x)),
            ];
            for (fog, amount) in fogs {
                let stage = Fogged { surface: Solid(texel), fog, color };
                let found = stage.shade_one((fog.coordinate(z), ())).expect("not discarded");
                let bytes = Fogged { surface: Solid(texel.to_le_bytes()), fog, color: color.to_le_bytes() };
                assert_eq!(bytes.shade_one((fog.coordinate(z), ())), Some(found.to_le_bytes()));
                for (channel, (shift, mask)) in [(11, 31), (5, 63), (0, 31)].into_iter().enumerate() {
                    let [near, far, found] =
                        [texel, color, found].map(|word| f64::from(word >> shift & mask));
                    let off = (near * (1.0 - amount) + far * amount - found).abs();
                    worst[channel] = worst[channel].max(off);
                }
            }
        }
        for (worst, bound) in worst.into_iter().zip([1.2, 1.9, 1.2]) {
            assert!(worst <= bound && worst > 0.8 * bound, "{worst} of {bound}");
        }
    }
}
