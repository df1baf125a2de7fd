//! The space in which light is added up: the bytes of colours as they are, or amounts of light.
//!
//! ```text
//! texels, colours                  lights              tone mapping                pixels
//! sRGB bytes -> amounts of light -> Lighting -> amounts without a limit -> 0 to 1 -> sRGB bytes
//! ```

use super::light::Light;
use super::reflectance::Reflectance;
use super::surface::{Layer, OnSurface, Surface};
use super::{Gouraud, Material};
use crate::shaders::wide::unpack;
use alberti_math::glam::{Vec2, Vec3};
use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, srgb};
use alberti_raster::{FragmentStage, Fragments};
use core::fmt::Debug;

/// The space in which the light of a surface is computed.
pub trait LightSpace: Copy + Debug {
    /// Whether colours are amounts of light there, or else bytes over 255.
    fn is_linear(self) -> bool;
}

/// Amounts of light: twice the number is twice the light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearLight;

impl LightSpace for LinearLight {
    #[inline(always)]
    fn is_linear(self) -> bool {
        true
    }
}

/// A [`LightSpace`] that is picked at run time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyLightSpace {
    /// Bytes over 255, as a surface has them without [`InSpace`].
    #[default]
    Srgb,
    /// Amounts of light.
    Linear,
}

impl LightSpace for AnyLightSpace {
    #[inline(always)]
    fn is_linear(self) -> bool {
        self == Self::Linear
    }
}

/// A [`Material`] or a [`Gouraud`] surface in a space of light.
///
/// In [`LinearLight`] the colours of all layers, which are sRGB, become amounts of light. Lights are such amounts
/// already, as are ambient light and what vertices carry of either. The sum is tone-mapped and becomes sRGB again.
/// Numbers such as the strength of a reflection stay.
///
/// Tone mapping leaves colours whose brightest channel p is at most 0.8. Of others that becomes
///
/// ```text
/// p' = 1 - 0.04/(p - 0.6)        the other channels: mix(c p'/p, p', 1 - 1/(1 + 0.15 (p - p')))
/// ```
///
/// so that highlights come near to white without reaching it, and keep their hue until they are far brighter.
///
/// ```
/// use alberti::shaders::material::{
///     Color, Directional, InSpace, Lambert, Lighting, LinearLight, Material, Placed, Viewer,
/// };
/// use alberti::{FragmentStage, Rgba8, Vector3, glam::{Vec2, Vec3}};
///
/// let gray = Material {
///     layers: Color(Rgba8::from_rgb24(0xc0_c0_c0)),
///     lighting: Lighting {
///         viewer: Viewer::towards(Vector3::new(Vec3::Z)),
///         ambient: Vec3::ZERO,
///         lights: Directional::new(Vector3::new(Vec3::Z), Vec3::splat(0.5)),
///         reflectance: Lambert,
///     },
/// };
/// let place = Placed { position: Vec3::ZERO, normal: Vec3::Z, uv: Vec2::ZERO };
/// // Half of the byte, or half of the light.
/// assert_eq!(gray.shade_one(place), Some(Rgba8::from_rgb24(0x60_60_60)));
/// let gray = InSpace { surface: gray, space: LinearLight };
/// assert_eq!(gray.shade_one(place), Some(Rgba8::from_rgb24(0x8c_8c_8c)));
/// ```
///
/// Source: IEC 61966-2-1; Khronos PBR Neutral tone mapper (2024), without its offset for the light that surfaces
/// mirror.
///
/// # Precision
/// Where [`Material`] has ½ + x of a byte, it is ½ + 1/64 + S/32 + 13 x. Texels become light within 2^-17 of the
/// greatest. Light becomes bytes within 0.011 before they are rounded, and near black a byte is 1/3295 of the light.
/// Amounts above 2^14 count as that. In fixed point colours are within 2 bytes of that in floats, for S up to 4.
///
/// # Cost
/// A load from a table of 512 bytes and a division for each channel of a layer. A fragment: six roots, six divisions
/// and some 50 operations. With one light and a trilinear texture that is 1.4 times as long as without, by lanes of
/// AVX2 (`lights, in light` in `benches/benches/surface.rs`).
#[derive(Clone, Copy, Debug)]
pub struct InSpace<S, P> {
    /// The surface.
    pub surface: S,
    /// The [`LightSpace`].
    pub space: P,
}

impl<M, Ls: Light, R, P: LightSpace> InSpace<Material<M, Ls, R>, P> {
    /// The surface at fragments after all layers, in this space.
    #[inline(always)]
    pub fn surface<L: Lanes, V: OnSurface>(&self, fragments: &Fragments<L, V>) -> Surface<L>
    where
        M: Layer<V>,
    {
        self.surface.surface_in(fragments, self.space.is_linear())
    }
}

impl<V, M, Ls, R, P> FragmentStage<V> for InSpace<Material<M, Ls, R>, P>
where
    V: OnSurface,
    M: Layer<V>,
    Ls: Light,
    R: Reflectance,
    P: LightSpace,
{
    type Color = Rgba8;
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, V>) -> (L::U32, L::Mask) {
        (self.surface.lighting.color(fragments.lanes, &self.surface(fragments)), fragments.mask)
    }
}

impl<M: Layer<Vec2>, P: LightSpace> InSpace<Gouraud<M>, P> {
    /// The surface at fragments after all layers, in this space.
    #[inline(always)]
    pub fn surface<L: Lanes>(&self, fragments: &Fragments<L, (Vec3, (Vec3, Vec2))>) -> Surface<L> {
        self.surface.surface_in(fragments, self.space.is_linear())
    }
}

impl<M: Layer<Vec2>, P: LightSpace> FragmentStage<(Vec3, (Vec3, Vec2))> for InSpace<Gouraud<M>, P> {
    type Color = Rgba8;
    type Derivatives = M::Derivatives;

    #[inline(always)]
    fn shade<L: Lanes>(&self, fragments: &Fragments<L, (Vec3, (Vec3, Vec2))>) -> (L::U32, L::Mask) {
        let Fragments { lanes, varying: (scattered, (mirrored, _)), mask, .. } = *fragments;
        (self.surface(fragments).seen(lanes, scattered, mirrored), mask)
    }
}

/// The amounts of light of words' three colours, from 0 to 1: a function of its own, since each layer has one.
#[inline(never)]
pub(super) fn decoded<L: Lanes>(lanes: L, words: L::U32) -> [L::Number; 3] {
    lanes.vectorize(
        #[inline(always)]
        || decode(lanes, words),
    )
}

/// The channels of sRGB, times 255, of amounts of light as the screen shows them.
#[inline(never)]
pub(super) fn shown<L: Lanes>(lanes: L, light: [L::Number; 3]) -> [L::Number; 3] {
    lanes.vectorize(
        #[inline(always)]
        || {
            let [r, g, b] = mapped(lanes, light);
            [encoded(lanes, r), encoded(lanes, g), encoded(lanes, b)]
        },
    )
}

#[inline(always)]
fn decode<L: Lanes>(lanes: L, words: L::U32) -> [L::Number; 3] {
    let [r, g, b, _] = unpack(lanes, words);
    [light(lanes, r), light(lanes, g), light(lanes, b)]
}

/// The amount of light of a channel.
#[inline(always)]
fn light<L: Lanes>(lanes: L, byte: L::U32) -> L::Number {
    let light = lanes.gather(
        byte,
        #[inline(always)]
        |byte| {
            let [byte, ..] = byte.to_le_bytes();
            srgb::to_light(byte).into()
        },
    );
    // In two halves, since 65535 is more than fixed point holds.
    let (high, low) = (lanes.to_numbers(lanes.shr(light, 8)), lanes.to_numbers(light & lanes.word(255)));
    (high + low * lanes.splat(1.0 / 256.0)) / lanes.splat(65535.0 / 256.0)
}

/// Amounts of light as the screen shows them: each at most 1.
#[inline(always)]
fn mapped<L: Lanes>(lanes: L, light: [L::Number; 3]) -> [L::Number; 3] {
    let (one, start) = (lanes.splat(1.0), lanes.splat(START));
    let most = lanes.splat(MOST);
    let [r, g, b] = light;
    let [r, g, b] = [lanes.min(most, r), lanes.min(most, g), lanes.min(most, b)];
    let peak = lanes.max(lanes.max(r, lanes.max(g, b)), start);
    let rest = one - start;
    let compressed = one - rest * rest / (peak - (start - rest));
    // The share of white.
    let white = one - one / (one + lanes.splat(DESATURATION) * (peak - compressed));
    let bright = lanes.less(start, peak);
    // A closure would be a function without lanes' instructions.
    macro_rules! mapped {
        ($channel:ident) => {{
            let own = $channel / peak * compressed;
            lanes.select(bright, own + (compressed - own) * white, $channel)
        }};
    }
    [mapped!(r), mapped!(g), mapped!(b)]
}

/// The channels of sRGB, times 255, of amounts of light from 0 to 1.
#[inline(always)]
fn encoded<L: Lanes>(lanes: L, light: L::Number) -> L::Number {
    // Negative numbers, which have no root, are not chosen.
    let quarter = lanes.sqrt(lanes.sqrt(light));
    let [a, b, c, d, e] = ENCODED;
    let curve = lanes.splat(c) + quarter * (lanes.splat(d) + quarter * lanes.splat(e));
    let curve = lanes.splat(a) + quarter * (lanes.splat(b) + quarter * curve);
    let line = lanes.splat(12.92) * light;
    lanes.select(lanes.less(lanes.splat(0.003_130_8), light), curve, line) * lanes.splat(255.0)
}

/// The brightest channel up to which tone mapping changes nothing.
const START: f32 = 0.8;
/// The rate at which brighter colours turn white.
const DESATURATION: f32 = 0.15;
/// The greatest amount of light that is told apart.
const MOST: f32 = 16384.0;

/// 1.055 x^(1/2.4) - 0.055 as a polynomial in x^(1/4), with the least error that five coefficients reach from 0.0031308
/// to 1: 0.0088/255.
const ENCODED: [f32; 5] = [-0.064_611_54, 0.196_135_86, 1.122_681_6, -0.335_501_57, 0.081_329_98];
