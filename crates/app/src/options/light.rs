//! The light of a picture, as far as it is not that of a scene.

/// Policies of light. The default is that of a program that does without: one side, as the library has it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightOptions {
    /// Whether surfaces that are seen from behind are lit as if they faced the viewer.
    pub two_sided: bool,
}
