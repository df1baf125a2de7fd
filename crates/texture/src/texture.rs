//! A borrowed rectangle of texels.

use core::num::Wrapping;
use core::{error, fmt};

use alberti_math::lanes::{Lanes, One};
use alberti_math::{Rgba8, each};

use crate::format::Storage;
use crate::{AnySize, Filter, Known, PowerOfTwo, Sampler, Size, TexelFormat, Wrap};

/// The greatest width and height.
pub(crate) const MAX_SIZE: u32 = 1 << 14;

/// A view of texels in rows, the top row of the image first, each row from left to right.
///
/// It owns nothing, so the texels may be in flash:
///
/// ```
/// use alberti_texture::{Texture, format::L8};
///
/// static RAMP: Texture<'static, L8> = match Texture::new(L8, &[0, 85, 170, 255], 4, 1) {
///     Ok(texture) => texture,
///     Err(_) => panic!("four texels for 4 x 1"),
/// };
/// assert_eq!(RAMP.texel(1, 0).to_bytes(), [85, 85, 85, 255]);
/// ```
///
/// As a level of a [`Mipmap`](crate::Mipmap) of several maps it has as many planes of texels.
pub struct Texture<'a, F: Storage, Z: Size = AnySize, const N: usize = 1> {
    planes: [Z::Texels<'a, F::Element>; N],
    format: F,
    // In 16 bits, so that compilers know that no product or sum of sizes overflows.
    width: u16,
    height: u16,
    size: Z,
}

impl<'a, F: Storage> Texture<'a, F, AnySize> {
    /// The greatest width and height.
    ///
    /// Up to here, coordinates with 38 bits of fraction find the exact texel, and with the size's 14 bits and
    /// a filter's 8 they fit in 64.
    pub const MAX_SIZE: u32 = MAX_SIZE;

    /// The view of `width * height` texels of a format. Sizes need not be powers of two, nor be equal.
    ///
    /// Of [`Indexed`](crate::format::Indexed) texels these are the bytes, as many as the rows take.
    ///
    /// # Errors
    /// If a side is 0 or greater than 16384, or if there are more or fewer texels.
    #[expect(clippy::cast_possible_truncation, reason = "`From` is not const; the sizes are at most 2^14")]
    pub const fn new(
        format: F,
        texels: &'a [F::Element],
        width: u32,
        height: u32,
    ) -> Result<Self, TextureError> {
        if width == 0 || height == 0 {
            return Err(TextureError::ZeroSize { width, height });
        }
        if width > MAX_SIZE || height > MAX_SIZE {
            return Err(TextureError::TooLarge { width, height });
        }
        // At most 2^28. Where `usize` has 16 bits the comparison is still that of the numbers.
        let expected = width.div_ceil(F::IN_ELEMENT) * height;
        if texels.len() as u64 != expected as u64 {
            return Err(TextureError::Length { found: texels.len(), expected });
        }
        let size = AnySize::of(width, height);
        Ok(Self { planes: [texels], format, width: width as u16, height: height as u16, size })
    }

    /// The same texture, known to have sides that are powers of two, if they are. It is faster to sample, and shows the
    /// same.
    #[must_use]
    pub const fn power_of_two(self) -> Option<Texture<'a, F, PowerOfTwo>> {
        let Self { planes, format, width, height, size } = self;
        match size.power_of_two() {
            Some(size) => Some(Texture { planes, format, width, height, size }),
            None => None,
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
    /// static RAMP: Texture<'static, L8, Known<4, 1>> = match Texture::new(L8, &[0, 85, 170, 255], 4, 1) {
    ///     Ok(texture) => texture.known().expect("4 x 1"),
    ///     Err(_) => panic!("four texels for 4 x 1"),
    /// };
    /// assert_eq!(RAMP.width(), 4);
    /// ```
    #[must_use]
    pub const fn known<const WIDTH: usize, const HEIGHT: usize>(
        self,
    ) -> Option<Texture<'a, F, Known<WIDTH, HEIGHT>>> {
        let Self { planes: [texels], format, width, height, .. } = self;
        let texels = if width as usize == WIDTH && height as usize == HEIGHT {
            texels.as_chunks::<WIDTH>().0.first_chunk()
        } else {
            None
        };
        match texels {
            Some(texels) => Some(Texture { planes: [texels], format, width, height, size: Known }),
            None => None,
        }
    }
}

impl<'a, F: Storage, Z: Size, const N: usize> Texture<'a, F, Z, N> {
    /// The view of parts that are known to be a texture's.
    #[inline]
    pub(crate) const fn of_parts(
        planes: [Z::Texels<'a, F::Element>; N],
        format: F,
        [width, height]: [u16; 2],
        size: Z,
    ) -> Self {
        Self { planes, format, width, height, size }
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

    /// The format of the texels, with the palette that it may have.
    #[inline]
    #[must_use]
    pub const fn format(&self) -> F {
        self.format
    }

    /// Columns and rows.
    #[inline(always)]
    pub(crate) const fn sides(&self) -> [u32; 2] {
        [self.width(), self.height()]
    }

    /// The column and the row of the texels that [`Nearest`](crate::Nearest) reads at (u, v), rows counted from the
    /// bottom: those whose cells hold the place.
    #[inline(always)]
    pub fn cells<L: Lanes, U: Wrap, V: Wrap>(
        &self,
        lanes: L,
        uv: [L::Number; 2],
        wrap: (U, V),
    ) -> [L::U32; 2] {
        self.size.cells(lanes, uv, self.sides(), wrap)
    }

    /// The columns of the texels that [`Bilinear`](crate::Bilinear) reads at (u, v), to the left and to the right, and
    /// the 256ths from the one to the other. Then the same of rows, counted from the bottom.
    #[inline(always)]
    pub fn between<L: Lanes, U: Wrap, V: Wrap>(
        &self,
        lanes: L,
        uv: [L::Number; 2],
        wrap: (U, V),
    ) -> [[L::U32; 3]; 2] {
        self.between_by(lanes, uv, wrap, 8)
    }

    /// [`between`](Self::between) by ways from 0 to 1 in so many bits, up to 8.
    #[inline(always)]
    pub(crate) fn between_by<L: Lanes, U: Wrap, V: Wrap>(
        &self,
        lanes: L,
        uv: [L::Number; 2],
        wrap: (U, V),
        bits: u32,
    ) -> [[L::U32; 3]; 2] {
        self.size.between(lanes, uv, self.sides(), wrap, bits)
    }

    /// The column and the row, counted from the bottom, of one of the texels that [`between`](Self::between) finds.
    /// It is the right one where its share, in 256ths, and the first of `thresholds`, from 0 to 255, add up to one. It
    /// is the upper one by the second.
    #[inline(always)]
    pub(crate) fn either<L: Lanes, U: Wrap, V: Wrap>(
        &self,
        lanes: L,
        uv: [L::Number; 2],
        wrap: (U, V),
        thresholds: [L::U32; 2],
    ) -> [L::U32; 2] {
        self.size.either(lanes, uv, self.sides(), wrap, thresholds)
    }

    /// [`Size::indices`].
    #[inline(always)]
    pub(crate) fn indices<L: Lanes, U: Wrap, V: Wrap>(
        &self,
        lanes: L,
        at: [L::U32; 2],
        wrap: (U, V),
    ) -> [L::U32; 2] {
        self.size.indices(lanes, at, self.sides(), wrap)
    }

    /// The colours of each plane's texels in two columns, as words; anything for those that do not lie in the texture.
    #[inline(always)]
    pub(crate) fn fetch_pairs<L: Lanes>(
        &self,
        lanes: L,
        row: L::U32,
        columns: [L::U32; 2],
    ) -> [[L::U32; 2]; N] {
        self.format.fetch_pairs(lanes, self, row, columns)
    }

    /// The results of `f` for each plane, in the places of `nothing`.
    #[inline(always)]
    pub(crate) fn each_plane<T: Copy>(&self, nothing: T, f: impl Fn(Texture<'a, F, Z>) -> T) -> [T; N] {
        let Self { planes, format, width, height, size } = *self;
        each(
            planes,
            nothing,
            #[inline(always)]
            |texels| f(Texture { planes: [texels], format, width, height, size }),
        )
    }
}

impl<'a, F: Storage, Z: Size> Texture<'a, F, Z> {
    /// The texels as they are stored.
    #[inline]
    #[must_use]
    pub fn texels(&self) -> &'a [F::Element] {
        let [texels] = self.planes;
        self.size.flattened(texels)
    }

    /// The colour in column `x` of row `y`, row 0 at the top; beyond the sides, that of the nearest texel.
    #[inline]
    #[must_use]
    pub fn texel(&self, x: u32, y: u32) -> Rgba8 {
        let (x, y) = (x.min(self.width().saturating_sub(1)), y.min(self.height().saturating_sub(1)));
        Rgba8::from_bits(self.fetch(One, Wrapping(y), Wrapping(x)).0)
    }

    /// A sampler with the same wrap mode on both axes: `texture.sampler(Nearest, Repeat)`.
    #[inline]
    #[must_use]
    pub const fn sampler<Fl: Filter, W: Wrap>(&self, filter: Fl, wrap: W) -> Sampler<'a, F, Fl, W, W, Z> {
        Sampler::new(*self, filter, (wrap, wrap))
    }

    /// A sampler with one wrap mode from left to right and one from bottom to top.
    #[inline]
    #[must_use]
    pub const fn sampler_per_axis<Fl: Filter, U: Wrap, V: Wrap>(
        &self,
        filter: Fl,
        u: U,
        v: V,
    ) -> Sampler<'a, F, Fl, U, V, Z> {
        Sampler::new(*self, filter, (u, v))
    }

    /// The colours of texels as words; anything for those that do not lie in the texture.
    #[inline(always)]
    pub(crate) fn fetch<L: Lanes>(&self, lanes: L, row: L::U32, column: L::U32) -> L::U32 {
        self.format.fetch(lanes, self, row, column)
    }

    /// The texels as counts of 65535ths; anything up to that for those that do not lie in the texture.
    #[inline(always)]
    pub(crate) fn fetch_scalars<L: Lanes>(&self, lanes: L, row: L::U32, column: L::U32) -> L::U32 {
        self.format.fetch_scalars(lanes, self, row, column)
    }
}

impl<F: TexelFormat, Z: Size, const N: usize> Texture<'_, F, Z, N> {
    /// The words that `word` makes of texels in two columns of each plane; of any, or none, for those that do not lie
    /// in the texture.
    #[inline(always)]
    pub(crate) fn word_pairs<L: Lanes>(
        &self,
        lanes: L,
        row: L::U32,
        columns: [L::U32; 2],
        word: impl Fn(Option<&F::Texel>) -> u32,
    ) -> [[L::U32; 2]; N] {
        // There always is one, as `new` compares the size with the length.
        self.size.word_pairs(lanes, self.planes, (row, columns), self.width(), word)
    }
}

impl<F: TexelFormat, Z: Size> Texture<'_, F, Z> {
    /// [`word_pairs`](Self::word_pairs) of a texel each.
    #[inline(always)]
    pub(crate) fn words<L: Lanes>(
        &self,
        lanes: L,
        row: L::U32,
        column: L::U32,
        word: impl Fn(Option<&F::Texel>) -> u32,
    ) -> L::U32 {
        let [texels] = self.planes;
        self.size.words(lanes, texels, [row, column], self.width(), word)
    }

    /// [`words`](Self::words) where a sample reads no other texel.
    #[inline(always)]
    pub(crate) fn lone_words<L: Lanes>(
        &self,
        lanes: L,
        row: L::U32,
        column: L::U32,
        word: impl Fn(Option<&F::Texel>) -> u32,
    ) -> L::U32 {
        let [texels] = self.planes;
        self.size.lone_words(lanes, texels, [row, column], self.width(), word)
    }
}

impl<F: Storage, Z: Size, const N: usize> Clone for Texture<'_, F, Z, N> {
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: Storage, Z: Size, const N: usize> Copy for Texture<'_, F, Z, N> {}

impl<F: Storage, Z: Size, const N: usize> fmt::Debug for Texture<'_, F, Z, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Texture")
            .field("width", &self.width)
            .field("height", &self.height)
            .finish_non_exhaustive()
    }
}

/// The reason why texels and a size are not a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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
    /// The number of texels is not width times height; for [`Indexed`](crate::format::Indexed), that of bytes.
    Length {
        /// The number that was given.
        found: usize,
        /// The number that the width and the height take.
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
