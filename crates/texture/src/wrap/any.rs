//! A wrap mode that is picked at run time.

use alberti_math::Rgba8;
use alberti_math::lanes::Lanes;

use super::{Border, Clamp, Mirror, Repeat, Wrap};
use crate::sealed::Sealed;

/// A [`Wrap`] that is picked at run time: each is the type of its name, bit for bit.
///
/// ```
/// use alberti_texture::{AnyWrap, Nearest, Texture, format::L8};
///
/// let board = Texture::new(L8, &[0, 255], 2, 1)?;
/// let shown = [AnyWrap::Repeat, AnyWrap::Clamp]
///     .map(|wrap| board.sampler(Nearest, wrap).sample([1.25, 0.5].into()).to_bytes()[0]);
/// assert_eq!(shown, [0, 255]);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Cost
/// Where sides are powers of two, a match for each axis and level that is read, on all lanes at once; elsewhere a call
/// for each axis and sample. Two comparisons a texel more than the types, for the border. The code of all four modes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyWrap {
    /// [`Repeat`].
    #[default]
    Repeat,
    /// [`Clamp`].
    Clamp,
    /// [`Mirror`].
    Mirror,
    /// [`Border`] of a colour.
    Border(Rgba8),
}

impl Sealed for AnyWrap {}

/// The call for the mode that it is.
macro_rules! matched {
    ($any:expr, |$wrap:ident| $call:expr) => {
        match $any {
            AnyWrap::Repeat => {
                let $wrap = Repeat;
                $call
            }
            AnyWrap::Clamp => {
                let $wrap = Clamp;
                $call
            }
            AnyWrap::Mirror => {
                let $wrap = Mirror;
                $call
            }
            AnyWrap::Border(color) => {
                let $wrap = Border(color);
                $call
            }
        }
    };
}

impl Wrap for AnyWrap {
    #[inline(never)]
    fn index(self, i: i32, size: u32) -> u32 {
        matched!(self, |wrap| wrap.index(i, size))
    }

    #[inline(always)]
    fn border(self) -> Option<Rgba8> {
        matched!(self, |wrap| wrap.border())
    }

    #[inline]
    fn reduce(self, u: f32) -> u64 {
        matched!(self, |wrap| wrap.reduce(u))
    }

    #[inline]
    fn cell(self, reduced: u64, size: u32) -> u32 {
        matched!(self, |wrap| wrap.cell(reduced, size))
    }

    #[inline]
    fn neighbours(self, i: i32, size: u32) -> (u32, u32) {
        matched!(self, |wrap| wrap.neighbours(i, size))
    }

    #[inline(always)]
    fn in_period<L: Lanes>(self, lanes: L, u: L::Number) -> L::Number {
        matched!(self, |wrap| wrap.in_period(lanes, u))
    }

    #[inline(always)]
    fn fold<L: Lanes>(self, lanes: L, i: L::U32, size: u32) -> L::U32 {
        matched!(self, |wrap| wrap.fold(lanes, i, size))
    }

    // Functions of their own, as four modes on all lanes are much code; a call is little beside 64 bits.

    #[inline(never)]
    fn cell_at(self, u: f32, size: u32) -> u32 {
        matched!(self, |wrap| wrap.cell_at(u, size))
    }

    #[inline(never)]
    fn between_at(self, u: f32, size: u32, bits: u32) -> [u32; 3] {
        matched!(self, |wrap| wrap.between_at(u, size, bits))
    }

    // Matched here, once for all lanes, instead of in the steps.

    #[inline(always)]
    fn cell_masked<L: Lanes>(self, lanes: L, u: L::Number, size: u32) -> L::U32 {
        matched!(self, |wrap| wrap.cell_masked(lanes, u, size))
    }

    #[inline(always)]
    fn between_masked<L: Lanes>(self, lanes: L, u: L::Number, size: u32, bits: u32) -> [L::U32; 3] {
        matched!(self, |wrap| wrap.between_masked(lanes, u, size, bits))
    }
}
