//! One error for all that can be refused.

use crate::baked::BakedError;
use alberti_projection::ViewError;
use alberti_raster::TargetError;
use alberti_texture::TextureError;
use core::fmt;

/// An error of all constructors that drawing needs, so that a function without an allocator can return any of them by
/// `?`.
///
/// ```
/// use alberti::{glam::Vec3, texture::{Texture, format::L8}, *};
///
/// fn setup(texels: &[u8]) -> Result<(View, Texture<'_, L8>), Error> {
///     let view = Camera::look_at(Vec3::Z, Vec3::ZERO, Vec3::Y)?.perspective(1.0, 0.1..10.0)?;
///     Ok((view, Texture::new(L8, texels, 2, 2)?))
/// }
/// assert!(setup(&[0, 255, 255, 0]).is_ok());
/// let refused = setup(&[0, 255, 255]).unwrap_err();
/// assert_eq!(refused.to_string(), "3 texels for a texture that takes 4");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Error {
    /// Of a camera, a lens, a projector or a viewport.
    View(ViewError),
    /// Of a target or bands.
    Target(TargetError),
    /// Of a texture or a mip map.
    Texture(TextureError),
    /// Of a baked file.
    Baked(BakedError),
}

macro_rules! from {
    ($($kind:ident: $of:ident;)*) => {$(
        impl From<$of> for Error {
            fn from(error: $of) -> Self {
                Self::$kind(error)
            }
        }
    )*};
}
from! {
    View: ViewError;
    Target: TargetError;
    Texture: TextureError;
    Baked: BakedError;
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::View(error) => error.fmt(f),
            Self::Target(error) => error.fmt(f),
            Self::Texture(error) => error.fmt(f),
            Self::Baked(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for Error {}
