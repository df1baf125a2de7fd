//! Errors of the parameters of a view.

use core::fmt;

/// The error in the parameters of a camera, a projection or a viewport.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ViewError {
    /// A parameter is NaN or infinite.
    NotFinite,
    /// The eye is at the target, or so close that no direction can be told.
    EyeAtTarget,
    /// The up vector is zero or parallel to the direction of view.
    UpAlongView,
    /// The opening angle is not strictly between 0 and π, or its cotangent is too large for an `f32`.
    Angle,
    /// The aspect ratio is not positive.
    Aspect,
    /// The height of a parallel view is not positive, or the scale that it makes is too large or small for an `f32`.
    Height,
    /// Not near < far, in perspective not 0 < near < far, or the two are too close to tell apart or too far away.
    NearFar,
    /// The viewport is empty, or reaches too far from the frame's origin for the guard band.
    Viewport,
    /// The ends of the range of screen depths are equal or not finite.
    DepthRange,
    /// A matrix is not that of an observer, or of a pyramid around the direction of view.
    Matrix,
}

impl fmt::Display for ViewError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "a parameter is NaN or infinite",
            Self::EyeAtTarget => "the eye is at the target: no direction of view",
            Self::UpAlongView => "the up vector is zero or parallel to the direction of view",
            Self::Angle => "the opening angle must lie between 0 and 180 degrees, and its scale be a normal f32",
            Self::Aspect => "the aspect ratio must be positive",
            Self::Height => "the height of the view must be positive, and its scale a normal f32",
            Self::NearFar => "the planes must satisfy near < far (in perspective, 0 < near), as numbers that f32 tells apart",
            Self::Viewport => "the viewport is empty or reaches more than 16384 pixels from the origin",
            Self::DepthRange => "the ends of the range of screen depths must be finite and differ",
            Self::Matrix => "the matrix must be a rotation and a translation, or a perspective around the direction of view",
        })
    }
}

impl core::error::Error for ViewError {}
