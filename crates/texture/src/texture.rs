//! A borrowed rectangle of texels.

use core::marker::PhantomData;
use core::num::Wrapping;
use core::{error, fmt};

use alberti_math::Rgba8;
use alberti_math::lanes::{Lanes, One};

use crate::format::{Indexed, Storage};
use crate::{AnySize, Filter, Known, PowerOfTwo, Sampler, Size, TexelFormat, Wrap};

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
pub struct Texture<'a, F: Storage, Z: Size = AnySize> {
    texels: Z::Texels<'a, F::Element>,
    palette: F::Palette<'a>,
    // In 16 bits, so that compilers know that no product or sum of sizes overflows.
    width: u16,
    height: u16,
    size: PhantomData<Z>,
}

impl<'a, F: TexelFormat> Texture<'a, F, AnySize> {
    /// The view of `width * height` texels. Sizes need not be powers of two, nor be equal.
    ///
    /// # Errors
    /// If a side is 0 or greater than [`Self::MAX_SIZE`], or if there are more or fewer texels.
    pub const fn new(texels: &'a [F::Texel], width: u32, height: u32) -> Result<Self, TextureError> {
        Self::stored(texels, (), width, height, 1)
    }
}

impl<'a, const BITS: u32> Texture<'a, Indexed<BITS>, AnySize> {
    /// The view of texels that are places in a palette, the first 0: see [`Indexed`] for their order.
    ///
    /// # Errors
    /// If a side is 0 or greater than [`Self::MAX_SIZE`], or if there are more or fewer bytes than the rows take. The
    /// palette may be shorter than the indices reach: what is beyond is transparent black.
    pub const fn indexed(
        bytes: &'a [u8],
        palette: &'a [Rgba8],
        width: u32,
        height: u32,
    ) -> Result<Self, TextureError> {
        Self::stored(bytes, palette, width, height, Indexed::<BITS>::IN_BYTE)
    }
}

impl<'a, F: Storage> Texture<'a, F, AnySize> {
    /// The greatest width and height.
    ///
    /// Up to here, coordinates with 38 bits of fraction find the exact texel, and with the size's 14 bits and
    /// a filter's 8 they fit in 64.
    pub const MAX_SIZE: u32 = 1 << 14;

    /// The view of elements that hold so many texels each.
    #[expect(clippy::cast_possible_truncation, reason = "`From` is not const; the sizes are at most 2^14")]
    const fn stored(
        texels: &'a [F::Element],
        palette: F::Palette<'a>,
        width: u32,
        height: u32,
        in_element: u32,
    ) -> Result<Self, TextureError> {
        if width == 0 || height == 0 {
            return Err(TextureError::ZeroSize { width, height });
        }
        if width > Self::MAX_SIZE || height > Self::MAX_SIZE {
            return Err(TextureError::TooLarge { width, height });
        }
        // At most 2^28. Where `usize` has 16 bits the comparison is still that of the numbers.
        let expected = width.div_ceil(in_element) * height;
        if texels.len() as u64 != expected as u64 {
            return Err(TextureError::Length { found: texels.len(), expected });
        }
        Ok(Self { texels, palette, width: width as u16, height: height as u16, size: PhantomData })
    }

    /// The same texture, known to have sides that are powers of two, if they are. It is faster to sample, and shows the
    /// same.
    #[must_use]
    pub const fn power_of_two(self) -> Option<Texture<'a, F, PowerOfTwo>> {
        let Self { texels, palette, width, height, .. } = self;
        if width.is_power_of_two() && height.is_power_of_two() {
            Some(Texture { texels, palette, width, height, size: PhantomData })
        } else {
            None
        }
    }
}

impl<'a, F: TexelFormat> Texture<'a, F, AnySize> {
    /// The same texture, known to have these sides, powers of two, if it has: for textures that are part of a program.
    /// It is the fastest to sample, and shows the same.
    ///
    /// ```
    /// use alberti_texture::{Known, Texture, format::L8};
    ///
    /// static RAMP: Texture<'static, L8, Known<4, 1>> = match Texture::new(&[0, 85, 170, 255], 4, 1) {
    ///     Ok(texture) => texture.known().expect("4 x 1"),
    ///     Err(_) => panic!("four texels for 4 x 1"),
    /// };
    /// assert_eq!(RAMP.width(), 4);
    /// ```
    #[must_use]
    pub const fn known<const WIDTH: usize, const HEIGHT: usize>(
        self,
    ) -> Option<Texture<'a, F, Known<WIDTH, HEIGHT>>> {
        let Self { texels, width, height, .. } = self;
        let texels = if width as usize == WIDTH && height as usize == HEIGHT {
            texels.as_chunks::<WIDTH>().0.first_chunk()
        } else {
            None
        };
        match texels {
            Some(texels) => Some(Texture { texels, palette: (), width, height, size: PhantomData }),
            None => None,
        }
    }
}

impl<'a, F: Storage, Z: Size> Texture<'a, F, Z> {
    /// The view of what is known to be a texture's.
    #[inline]
    pub(crate) const fn of_parts(
        texels: Z::Texels<'a, F::Element>,
        palette: F::Palette<'a>,
        [width, height]: [u16; 2],
    ) -> Self {
        Self { texels, palette, width, height, size: PhantomData }
    }

    /// The number of columns, 1 to [`Self::MAX_SIZE`].
    #[inline]
    #[must_use]
    pub const fn width(&self) -> u32 {
        match Z::SIDES {
            Some([width, _]) => width,
            None => self.width as u32,
        }
    }

    /// The number of rows, 1 to [`Self::MAX_SIZE`].
    #[inline]
    #[must_use]
    pub const fn height(&self) -> u32 {
        match Z::SIDES {
            Some([_, height]) => height,
            None => self.height as u32,
        }
    }

    /// The texels as they are stored.
    #[inline]
    #[must_use]
    pub fn texels(&self) -> &'a [F::Element] {
        Z::flattened(self.texels)
    }

    /// What stands beside the texels.
    #[inline]
    #[must_use]
    pub const fn palette(&self) -> F::Palette<'a> {
        self.palette
    }

    /// The colour in column `x` of row `y`, row 0 at the top; beyond the sides, that of the nearest texel.
    #[inline]
    #[must_use]
    pub fn texel(&self, x: u32, y: u32) -> Rgba8 {
        let (x, y) = (x.min(self.width().saturating_sub(1)), y.min(self.height().saturating_sub(1)));
        Rgba8::from_bits(self.fetch(One, Wrapping(y), Wrapping(x)).0)
    }

    /// A sampler with the same wrap mode on both axes: `texture.sampler::<Nearest, Repeat>()`.
    #[inline]
    #[must_use]
    pub const fn sampler<Fl: Filter, W: Wrap>(&self) -> Sampler<'a, F, Fl, W, W, Z> {
        Sampler::new(*self)
    }

    /// A sampler with the wrap mode `U` from left to right and `V` from bottom to top.
    #[inline]
    #[must_use]
    pub const fn sampler_per_axis<Fl: Filter, U: Wrap, V: Wrap>(&self) -> Sampler<'a, F, Fl, U, V, Z> {
        Sampler::new(*self)
    }

    /// The colours of texels as words; anything for those that do not lie in the texture.
    #[inline(always)]
    pub(crate) fn fetch<L: Lanes>(&self, lanes: L, row: L::U32, column: L::U32) -> L::U32 {
        F::fetch(lanes, self, row, column)
    }

    /// The texels as counts of 65535ths; anything up to that for those that do not lie in the texture.
    #[inline(always)]
    pub(crate) fn fetch_scalars<L: Lanes>(&self, lanes: L, row: L::U32, column: L::U32) -> L::U32 {
        F::fetch_scalars(lanes, self, row, column)
    }
}

impl<F: TexelFormat, Z: Size> Texture<'_, F, Z> {
    /// What `word` makes of texels; of any, or none, for those that do not lie in the texture.
    #[inline(always)]
    pub(crate) fn words<L: Lanes>(
        &self,
        lanes: L,
        row: L::U32,
        column: L::U32,
        word: impl Fn(Option<&F::Texel>) -> u32,
    ) -> L::U32 {
        // There always is one, as `new` compares the size with the length.
        Z::words(lanes, self.texels, [row, column], self.width(), word)
    }
}

impl<F: Storage, Z: Size> Clone for Texture<'_, F, Z> {
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: Storage, Z: Size> Copy for Texture<'_, F, Z> {}

impl<F: Storage, Z: Size> fmt::Debug for Texture<'_, F, Z> {
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
    /// The number of texels is not width times height; for [`Indexed`], that of bytes.
    Length {
        /// How many were given.
        found: usize,
        /// What the width and the height take.
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
