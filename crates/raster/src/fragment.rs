//! The fragment stage: from interpolated attributes to a colour.

/// Maps the varying of a covered sample that passed the depth test to a colour, or discards it.
///
/// Any closure `Fn(V) -> Option<Color>` is one. What it does not use of the varying is not computed.
pub trait FragmentStage<V> {
    /// The colour it makes: one that the target's format can [store](crate::Store).
    type Color;

    /// The colour, or `None` to leave the pixel and its depth as they are.
    fn shade(&self, varying: V) -> Option<Self::Color>;
}

impl<V, Color, F: Fn(V) -> Option<Color>> FragmentStage<V> for F {
    type Color = Color;

    #[inline]
    fn shade(&self, varying: V) -> Option<Color> {
        self(varying)
    }
}
