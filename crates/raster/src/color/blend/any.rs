//! A blend that is chosen at run time.

use super::{Additive, Blend, Constant, Multiply, Over, Premultiplied};
use alberti_math::lanes::Lanes;

/// A blend that is chosen at run time; the pixels are those of the blend itself.
///
/// # Precision
/// That of the blend, whose bits it gives.
///
/// # Cost
/// A match for the samples that are worked on together. The code of all six.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyBlend {
    /// None: the source.
    #[default]
    Replace,
    /// [`Over`].
    Over,
    /// [`Constant`].
    Constant(u8),
    /// [`Premultiplied`].
    Premultiplied,
    /// [`Additive`].
    Additive,
    /// [`Multiply`].
    Multiply,
}

/// The same of any blend.
macro_rules! any {
    ($self:ident, $blend:ident => $do:expr, $replaced:expr) => {
        match $self {
            Self::Replace => $replaced,
            Self::Over => {
                let $blend = Over;
                $do
            }
            Self::Constant(alpha) => {
                let $blend = Constant(alpha);
                $do
            }
            Self::Premultiplied => {
                let $blend = Premultiplied;
                $do
            }
            Self::Additive => {
                let $blend = Additive;
                $do
            }
            Self::Multiply => {
                let $blend = Multiply;
                $do
            }
        }
    };
}

impl Blend for AnyBlend {
    #[inline]
    fn channel(self, new: u32, old: u32, alpha: u32, one: u32) -> u32 {
        any!(self, blend => blend.channel(new, old, alpha, one), new)
    }

    #[inline]
    fn alpha(self, new: u32, old: u32) -> u32 {
        any!(self, blend => blend.alpha(new, old), new)
    }

    #[inline(always)]
    fn mix<L: Lanes>(self, lanes: L, new: L::U32, old: L::U32) -> L::U32 {
        any!(self, blend => blend.mix(lanes, new, old), new)
    }

    #[inline(always)]
    fn is_over(self) -> bool {
        matches!(self, Self::Over)
    }

    #[inline(always)]
    fn share<L: Lanes>(self, lanes: L, alpha: L::U32) -> Option<L::U32> {
        any!(self, blend => blend.share(lanes, alpha), None)
    }
}
