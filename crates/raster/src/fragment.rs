//! The fragment stage: from interpolated attributes to a colour.

use crate::color::Color;
use crate::gradient::{Differentiation, Gradient, NoDerivatives};
use alberti_math::Varying;
use alberti_math::lanes::Lanes;

/// Maps the varying of a covered sample that passed the depth test to a colour, or discards it.
///
/// Any closure `Fn(V) -> Option<Color>` that captures references is one, called for one sample after the other. What it
/// does not use of the varying is not computed. Stages are copied to where they are used, so that what they hold may be
/// kept in registers. A stage that is a type may also take all lanes at once.
pub trait FragmentStage<V: Varying>: Copy {
    /// The colour it makes: one that the target's format can [store](crate::Store).
    type Color: Color;
    /// How it learns how fast the varying changes from pixel to pixel: [`NoDerivatives`], unless it needs that.
    type Derivatives: Differentiation;

    /// The colour, or `None` to leave the pixel and its depth as they are; of a varying that does not change between
    /// pixels.
    fn shade(&self, varying: V) -> Option<Self::Color>;

    /// The colours of the samples in `mask`, as words, and those of them that are not discarded. Other samples may get
    /// any color; their varyings are finite, but without a meaning. `gradient` is 0 for [`NoDerivatives`], and without
    /// a meaning beside the mask.
    #[inline(always)]
    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        varyings: &V::Of<L::Number>,
        gradient: &Gradient<V::Of<L::Number>>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        let _ = gradient;
        let in_memory = V::map(varyings, &|numbers: L::Number| lanes.store(numbers));
        let mut bits = lanes.bits(mask);
        let colors = lanes.each(|k| {
            if bits >> k & 1 == 0 {
                return 0;
            }
            let lane = |each: L::Each<f32>| each.as_ref().get(k).copied().unwrap_or_default();
            let color = self.shade(V::from_components(&V::map(&in_memory, &lane)));
            if color.is_none() {
                bits &= !(1 << k);
            }
            color.map_or(0, Color::to_word)
        });
        (lanes.load_words(&colors), lanes.mask(bits))
    }
}

impl<V: Varying, C: Color, F: Fn(V) -> Option<C> + Copy> FragmentStage<V> for F {
    type Color = C;
    type Derivatives = NoDerivatives;

    #[inline(always)]
    fn shade(&self, varying: V) -> Option<C> {
        self(varying)
    }
}
