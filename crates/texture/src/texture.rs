//! A borrowed rectangle of texels.

use core::{error, fmt};

use alberti_math::Rgba8;

use crate::{Filter, Sampler, TexelFormat, Wrap};

/// A view of texels in rows, the top row of the image first, each row from left to right.
///
/// It owns nothing, so the texels may be in flash:
///
/// ```
/// use alberti_texture::{Texture, format::L8};
///
/// static RAMP: Texture<'static, L8> = match Texture::new(&[0, 85, 170, 255], 4, 1) {
///     Ok(texture) => texture,
///     Err(_) => panic!("four texels for 4 x 1"),
/// };
/// assert_eq!(RAMP.texel(1, 0).to_bytes(), [85, 85, 85, 255]);
/// ```
pub struct Texture<'a, F: TexelFormat> {
    texels: &'a [F::Texel],
    // In 16 bits, so that compilers know that no product or sum of sizes overflows.
    width: u16,
    height: u16,
}

impl<'a, F: TexelFormat> Texture<'a, F> {
    /// The greatest width and height.
    ///
    /// Up to here, coordinates with 38 bits of fraction find the exact texel, and with the size's 14 bits and
    /// a filter's 8 they fit in 64.
    pub const MAX_SIZE: u32 = 1 << 14;

    /// The view of `width * height` texels. Sizes need not be powers of two, nor be equal.
    ///
    /// # Errors
    /// If a side is 0 or greater than [`Self::MAX_SIZE`], or if there are more or fewer texels.
    #[expect(clippy::cast_possible_truncation, reason = "`From` is not const; the sizes are at most 2^14")]
    pub const fn new(texels: &'a [F::Texel], width: u32, height: u32) -> Result<Self, TextureError> {
        if width == 0 || height == 0 {
            return Err(TextureError::ZeroSize { width, height });
        }
        if width > Self::MAX_SIZE || height > Self::MAX_SIZE {
            return Err(TextureError::TooLarge { width, height });
        }
        // At most 2^28. Where `usize` has 16 bits the comparison is still that of the numbers.
        let expected = width * height;
        if texels.len() as u64 != expected as u64 {
            return Err(TextureError::Length { found: texels.len(), expected });
        }
        Ok(Self { texels, width: width as u16, height: height as u16 })
    }

    /// The number of columns, 1 to [`Self::MAX_SIZE`].
    #[inline]
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width as u32
    }

    /// The number of rows, 1 to [`Self::MAX_SIZE`].
    #[inline]
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height as u32
    }

    /// The texels as they are stored.
    #[inline]
    #[must_use]
    pub const fn texels(&self) -> &'a [F::Texel] {
        self.texels
    }

    /// The colour in column `x` of row `y`, row 0 at the top; beyond the sides, that of the nearest texel.
    #[inline]
    #[must_use]
    pub fn texel(&self, x: u32, y: u32) -> Rgba8 {
        let (x, y) = (x.min(self.width().saturating_sub(1)), y.min(self.height().saturating_sub(1)));
        self.fetch(x, y).unwrap_or_default()
    }

    /// A sampler with the same wrap mode on both axes: `texture.sampler::<Nearest, Repeat>()`.
    #[inline]
    #[must_use]
    pub const fn sampler<Fl: Filter, W: Wrap>(&self) -> Sampler<'a, F, Fl, W> {
        Sampler::new(*self)
    }

    /// A sampler with the wrap mode `U` from left to right and `V` from bottom to top.
    #[inline]
    #[must_use]
    pub const fn sampler_per_axis<Fl: Filter, U: Wrap, V: Wrap>(&self) -> Sampler<'a, F, Fl, U, V> {
        Sampler::new(*self)
    }

    /// The colour of a texel; always `Some` inside of the texture.
    #[inline]
    pub(crate) fn fetch(&self, x: u32, y: u32) -> Option<Rgba8> {
        let index = y.wrapping_mul(self.width()).wrapping_add(x);
        self.texels.get(index as usize).copied().map(F::decode)
    }

    /// Four times [`Self::fetch`].
    #[inline]
    pub(crate) fn fetch_four(&self, [p, q, r, s]: [(u32, u32); 4]) -> Option<[Rgba8; 4]> {
        Some([self.fetch(p.0, p.1)?, self.fetch(q.0, q.1)?, self.fetch(r.0, r.1)?, self.fetch(s.0, s.1)?])
    }
}

impl<F: TexelFormat> Clone for Texture<'_, F> {
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: TexelFormat> Copy for Texture<'_, F> {}

impl<F: TexelFormat> fmt::Debug for Texture<'_, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Texture")
            .field("width", &self.width)
            .field("height", &self.height)
            .finish_non_exhaustive()
    }
}

/// Why texels and a size are not a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextureError {
    /// A side is 0.
    ZeroSize {
        /// The width that was given.
        width: u32,
        /// The height that was given.
        height: u32,
    },
    /// A side is greater than [`Texture::MAX_SIZE`].
    TooLarge {
        /// The width that was given.
        width: u32,
        /// The height that was given.
        height: u32,
    },
    /// The number of texels is not width times height.
    Length {
        /// The number of texels that was given.
        found: usize,
        /// Width times height.
        expected: u32,
    },
}

impl fmt::Display for TextureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::ZeroSize { width, height } => {
                write!(f, "a texture of {width} x {height} texels: each side must be at least 1")
            }
            Self::TooLarge { width, height } => {
                write!(f, "a texture of {width} x {height} texels: each side must be at most 16384")
            }
            Self::Length { found, expected } => {
                write!(f, "{found} texels for a texture that takes {expected}")
            }
        }
    }
}

impl error::Error for TextureError {}
