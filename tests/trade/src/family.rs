//! A family of policies.

/// Policies that can take each other's place.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Its name.
    pub name: &'static str,
    /// The title of its chapter.
    pub title: &'static str,
    /// The paragraph that says what to pick when.
    pub advice: &'static str,
    /// The error that its plot shows, and its front goes by.
    pub axis: Axis,
}

/// The error of a plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Of texture coordinates, in texels.
    Texels,
    /// Of the picture, as somebody sees it who flips between the two.
    Flip,
}
