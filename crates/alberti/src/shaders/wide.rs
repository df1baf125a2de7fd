//! Arithmetic on the colours and the vectors of several fragments, for fragment stages that shade all lanes at once.
//!
//! A colour is a word, red in its lowest byte ([`Rgba8::to_bits`]); a channel is a word from 0 to 255.
//!
//! ```
//! use alberti::lanes::Lanes;
//! use alberti::shaders::wide;
//! use alberti::{FragmentStage, Fragments, NoDerivatives, Rgba8};
//!
//! /// White, darker with the distance.
//! #[derive(Clone, Copy)]
//! struct Fog;
//!
//! impl FragmentStage<f32> for Fog {
//!     type Color = Rgba8;
//!     type Derivatives = NoDerivatives;
//!
//!     fn shade<L: Lanes>(&self, fragments: &Fragments<L, f32>) -> (L::U32, L::Mask) {
//!         let Fragments { lanes, varying: distance, mask, .. } = *fragments;
//!         let one = lanes.splat(1.0);
//!         (wide::lit(lanes, lanes.word(Rgba8::WHITE.to_bits()), one / (one + distance)), mask)
//!     }
//! }
//! assert_eq!(Fog.shade_one(0.25), Some(Rgba8::from_rgb24(0xcc_cc_cc)));
//! ```
//!
//! One that reads a texture, which may be a mip map:
//!
//! ```
//! use alberti::glam::Vec2;
//! use alberti::lanes::Lanes;
//! use alberti::shaders::{Map, wide};
//! use alberti::{FragmentStage, Fragments, Rgba8};
//!
//! /// A texture, darker the farther away it is: vertices carry a distance and texture coordinates.
//! #[derive(Clone, Copy)]
//! struct Dim<M>(M);
//!
//! impl<M: Map> FragmentStage<(f32, Vec2)> for Dim<M> {
//!     type Color = Rgba8;
//!     type Derivatives = M::Derivatives;
//!
//!     fn shade<L: Lanes>(&self, fragments: &Fragments<L, (f32, Vec2)>) -> (L::U32, L::Mask) {
//!         let Fragments { lanes, varying: (distance, uv), gradient, mask, .. } = *fragments;
//!         let texels = self.0.read(lanes, uv, &gradient.map(|(_, uv)| uv));
//!         let one = lanes.splat(1.0);
//!         (wide::lit(lanes, texels, one / (one + distance)), mask)
//!     }
//! }
//! assert_eq!(Dim(Rgba8::WHITE).shade_one((0.25, Vec2::ZERO)), Some(Rgba8::from_rgb24(0xcc_cc_cc)));
//! ```
//!
//! A varying of several fields is a struct made by [`varying!`](crate::varying). A stage that discards returns fewer
//! samples than it was asked for:
//!
//! ```
//! use alberti::glam::Vec2;
//! use alberti::lanes::Lanes;
//! use alberti::{FragmentStage, Fragments, NoDerivatives, Rgba8, varying};
//!
//! #[derive(Clone, Copy)]
//! struct Ground {
//!     place: Vec2,
//!     distance: f32,
//! }
//!
//! varying!(Ground { place: Vec2, distance: f32 });
//!
//! /// White and black stripes, a unit wide, as far as 10 units.
//! #[derive(Clone, Copy)]
//! struct Stripes;
//!
//! impl FragmentStage<Ground> for Stripes {
//!     type Color = Rgba8;
//!     type Derivatives = NoDerivatives;
//!
//!     fn shade<L: Lanes>(&self, fragments: &Fragments<L, Ground>) -> (L::U32, L::Mask) {
//!         let Fragments { lanes, varying, mask, .. } = *fragments;
//!         let [x, _] = varying.place;
//!         let odd = lanes.less_words(lanes.word(0), lanes.floor_scaled(x, 0) & lanes.word(1));
//!         let [black, white] = [Rgba8::BLACK, Rgba8::WHITE].map(|color| lanes.word(color.to_bits()));
//!         let near = lanes.less(varying.distance, lanes.splat(10.0));
//!         (lanes.select_words(odd, white, black), mask & near)
//!     }
//! }
//! let at = |x, distance| Stripes.shade_one(Ground { place: Vec2::new(x, 0.0), distance });
//! assert_eq!([at(0.5, 1.0), at(-0.5, 1.0), at(0.5, 11.0)], [Some(Rgba8::BLACK), Some(Rgba8::WHITE), None]);
//! ```
//!
//! | for | of [`Lanes`] |
//! |---|---|
//! | numbers | `splat`, `ramp`, `+ - * /`, negation, `min`, `max`, `sqrt`, `less`, `select` |
//! | words | `word`, `+ - * & \| ^`, `shl`, `shr`, `min_words`, `less_words`, `select_words` |
//! | from numbers to words and back | `floor_scaled`, `round_scaled`, `nearest_byte`, `to_numbers` |
//! | masks | `& \| !`, `mask`, `bits` |
//!
//! Greater is `less` with its arguments the other way round. A vector is an array of numbers: [`dot_lanes`],
//! [`unit_lanes`], [`absolute_lanes`] and [`clamped_lanes`] are for them, and one that is the same for all fragments is
//! `v.to_array().map(|x| lanes.splat(x))`.
//!
//! Functions with lanes, and closures that do more than that, are `#[inline(always)]`. Others are compiled for every
//! machine, where each operation on lanes is a call: such a stage takes up to three times as long.

use alberti_math::Rgba8;
use alberti_math::lanes::Lanes;
pub use alberti_texture::surface::{absolute_lanes, clamped_lanes, dot_lanes, unit_lanes};

/// A product of two bytes over 255, to the nearest.
///
/// # Cost
/// Two additions and two shifts.
#[inline(always)]
pub fn per_255<L: Lanes>(lanes: L, product: L::U32) -> L::U32 {
    // x / 255 to the nearest is (x + 128) * 257 >> 16.
    let x = product + lanes.word(128);
    lanes.shr(x + lanes.shr(x, 8), 8)
}

/// The channels of colours: red, green, blue, alpha.
#[inline(always)]
pub fn unpack<L: Lanes>(lanes: L, color: L::U32) -> [L::U32; 4] {
    let byte = lanes.word(255);
    [color & byte, lanes.shr(color, 8) & byte, lanes.shr(color, 16) & byte, lanes.shr(color, 24)]
}

/// The colours of these channels, which are at most 255.
#[inline(always)]
pub fn pack<L: Lanes>(lanes: L, [r, g, b, a]: [L::U32; 4]) -> L::U32 {
    (r | lanes.shl(g, 8)) | (lanes.shl(b, 16) | lanes.shl(a, 24))
}

/// Colours times a constant one, channel by channel, to the nearest byte; alpha is kept.
#[inline(always)]
pub fn times<L: Lanes>(lanes: L, colors: L::U32, tint: Rgba8) -> L::U32 {
    let ([r, g, b, a], [tint_r, tint_g, tint_b, _]) = (unpack(lanes, colors), tint.to_bytes());
    let times = |channel: L::U32, tint: u8| per_255(lanes, channel * lanes.word(tint.into()));
    pack(lanes, [times(r, tint_r), times(g, tint_g), times(b, tint_b), a])
}

/// Colours times a light, to the nearest byte and at most 255; alpha is kept.
#[inline(always)]
pub fn lit<L: Lanes>(lanes: L, colors: L::U32, light: L::Number) -> L::U32 {
    let [r, g, b, a] = unpack(lanes, colors);
    let lit = |channel: L::U32| lanes.nearest_byte(lanes.to_numbers(channel) * light);
    pack(lanes, [lit(r), lit(g), lit(b), a])
}
