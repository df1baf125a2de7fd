//! A texture at several sizes: each level half of the one before, down to one texel.
//!
//! ```text
//! +---------------+-------+---+-+
//! | level 0       | 1     | 2 |3|   max(1, floor(width / 2^level)) x max(1, floor(height / 2^level))
//! |               |       +---+-+
//! |               |       |
//! |               +-------+
//! |               |
//! +---------------+
//! ```
//!
//! The texels of all levels lie in one slice, level after level. So a chain can be built in the caller's buffer
//! ([`build`]), or before the program is, and be in flash. A [`Mipmap`] is a view of it.

mod alpha;
mod build;
pub(crate) mod mean;
mod squares;
mod strips;

pub use alpha::preserve_coverage;
pub use build::{Piece, Pieces, build, pieces};
pub use mean::Weights;

use core::fmt;

use alberti_math::{each, map2};

use crate::format::Storage;
use crate::texture::MAX_SIZE;
use crate::{AnySize, MipFilter, MipSampler, PowerOfTwo, Size, Texture, TextureError, Wrap};

/// The greatest number of levels: of a side of 2^14 texels.
pub const MAX_LEVELS: usize = 15;

/// The number of levels from `width` x `height` down to one texel.
///
/// ```
/// assert_eq!(alberti_texture::mipmap::level_count(100, 7), 7); // 100, 50, 25, 12, 6, 3, 1
/// ```
#[must_use]
pub const fn level_count(width: u32, height: u32) -> usize {
    let greater = if width > height { width } else { height };
    (u32::BITS - greater.leading_zeros()) as usize
}

/// The number of texels that all levels have together.
///
/// ```
/// use alberti_texture::mipmap::texel_count;
///
/// let buffer = [0u16; texel_count(64, 64)];
/// assert_eq!(buffer.len(), 5461);
/// ```
#[must_use]
pub const fn texel_count(width: u32, height: u32) -> usize {
    let mut sum = 0;
    let mut level = 0;
    while level < level_count(width, height) {
        let [width, height] = size_of_level([width, height], level);
        sum += width as usize * height as usize;
        level += 1;
    }
    sum
}

/// The sides of a level.
pub(crate) const fn size_of_level([width, height]: [u32; 2], level: usize) -> [u32; 2] {
    const fn half(side: u32, level: usize) -> u32 {
        let side = side >> level;
        if side == 0 { 1 } else { side }
    }
    [half(width, level), half(height, level)]
}

/// A view of a texture at several sizes. It owns nothing, so the texels may be in flash:
///
/// ```
/// use alberti_texture::{Mipmap, format::L8};
///
/// static BOARD: Mipmap<'static, L8> = match Mipmap::new(L8, &[0, 255, 255, 0, 188], 2, 2) {
///     Ok(mipmap) => mipmap,
///     Err(_) => panic!("a level of 2 x 2 and one of 1 x 1"),
/// };
/// assert_eq!(BOARD.level(1).texel(0, 0).to_bytes(), [188, 188, 188, 255]);
/// ```
///
/// Several maps of one size are one mip map of `N` ([`together`](Self::together)).
pub struct Mipmap<'a, F: Storage, Z: Size = AnySize, const N: usize = 1> {
    elements: [&'a [F::Element]; N],
    format: F,
    /// The places where levels begin, and behind them the one where the last ends.
    begin: [u32; MAX_LEVELS + 1],
    levels: u8,
    width: u16,
    height: u16,
    size: Z,
}

impl<'a, F: Storage> Mipmap<'a, F> {
    /// The view of the levels of a texture, one after the other: all, or as many as there are texels for. Of
    /// [`Indexed`](crate::format::Indexed) texels these are bytes.
    ///
    /// # Errors
    /// If a side is 0 or greater than 16384, or if these are not the texels of whole levels.
    #[expect(clippy::cast_possible_truncation, reason = "sides are at most 2^14, texels at most 4/3 of 2^28")]
    pub const fn new(
        format: F,
        elements: &'a [F::Element],
        width: u32,
        height: u32,
    ) -> Result<Self, TextureError> {
        if width == 0 || height == 0 {
            return Err(TextureError::ZeroSize { width, height });
        }
        if width > MAX_SIZE || height > MAX_SIZE {
            return Err(TextureError::TooLarge { width, height });
        }
        let mut begin = [0; MAX_LEVELS + 1];
        let mut levels = 0;
        while levels < level_count(width, height)
            && (levels == 0 || (begin[levels] as usize) < elements.len())
        {
            let [width, height] = size_of_level([width, height], levels);
            begin[levels + 1] = begin[levels] + width.div_ceil(F::IN_ELEMENT) * height;
            levels += 1;
        }
        let expected = begin[levels];
        if elements.len() as u64 != expected as u64 {
            return Err(TextureError::Length { found: elements.len(), expected });
        }
        let size = AnySize::of(width, height);
        let (levels, width, height) = (levels as u8, width as u16, height as u16);
        Ok(Self { elements: [elements], format, begin, levels, width, height, size })
    }

    /// The same levels, known to have sides that are powers of two, if they have. They are faster to sample, and show
    /// the same.
    #[must_use]
    pub const fn power_of_two(self) -> Option<Mipmap<'a, F, PowerOfTwo>> {
        let Self { elements, format, begin, levels, width, height, size } = self;
        match size.power_of_two() {
            Some(size) => Some(Mipmap { elements, format, begin, levels, width, height, size }),
            None => None,
        }
    }
}

impl<'a, F: Storage + PartialEq, Z: Size> Mipmap<'a, F, Z> {
    /// Several maps of one size, such as the colours and the normals of a surface, to be read together: the level of
    /// detail, places and weights are found once. `None` where sizes, numbers of levels or formats differ.
    ///
    /// ```
    /// use alberti_texture::format::L8;
    /// use alberti_texture::{Gradient, Mipmap, Repeat, Trilinear};
    ///
    /// let board = Mipmap::new(L8, &[0, 255, 255, 0, 188], 2, 2)?;
    /// let plain = Mipmap::new(L8, &[9, 9, 9, 9, 9], 2, 2)?;
    /// let both = Mipmap::together([board, plain]).expect("one size").sampler(Trilinear, Repeat);
    /// let gradient = Gradient { dx: [0.5, 0.0], dy: [0.0, 0.5] };
    /// let [a, b] = both.sample_each([0.25, 0.25].into(), gradient);
    /// assert_eq!([a, b].map(|color| color.to_bytes()[0]), [255, 9]);
    /// # Ok::<(), alberti_texture::TextureError>(())
    /// ```
    #[must_use]
    pub fn together<const N: usize>(maps: [Self; N]) -> Option<Mipmap<'a, F, Z, N>> {
        let &Self { format, begin, levels, width, height, size, .. } = maps.first()?;
        let alike = |map: &Self| (map.width, map.height, map.levels) == (width, height, levels);
        let mut elements: [&[F::Element]; N] = [&[]; N];
        for (elements, map) in elements.iter_mut().zip(&maps) {
            if !alike(map) || map.format != format {
                return None;
            }
            [*elements] = map.elements;
        }
        Some(Mipmap { elements, format, begin, levels, width, height, size })
    }
}

impl<'a, F: Storage, Z: Size, const N: usize> Mipmap<'a, F, Z, N> {
    /// The number of levels, 1 to [`MAX_LEVELS`].
    #[inline]
    #[must_use]
    pub const fn levels(&self) -> usize {
        self.levels as usize
    }

    /// The number of the last level.
    #[inline(always)]
    pub(crate) fn last(&self) -> i32 {
        i32::from(self.levels) - 1
    }

    /// The sides of level 0.
    #[inline(always)]
    pub(crate) fn size(&self) -> [u32; 2] {
        [self.width.into(), self.height.into()]
    }

    /// A sampler with the same wrap mode on both axes: `mipmap.sampler(Trilinear, Repeat)`.
    #[inline]
    #[must_use]
    pub const fn sampler<M: MipFilter, W: Wrap>(
        &self,
        filter: M,
        wrap: W,
    ) -> MipSampler<'a, F, M, W, W, Z, N> {
        MipSampler::new(*self, filter, (wrap, wrap))
    }

    /// A sampler with one wrap mode from left to right and one from bottom to top.
    #[inline]
    #[must_use]
    pub const fn sampler_per_axis<M: MipFilter, U: Wrap, V: Wrap>(
        &self,
        filter: M,
        u: U,
        v: V,
    ) -> MipSampler<'a, F, M, U, V, Z, N> {
        MipSampler::new(*self, filter, (u, v))
    }

    /// A level, 0 the largest; beyond the last, the last.
    ///
    /// # Cost
    /// Two loads, two shifts and a few comparisons.
    #[inline]
    #[must_use]
    pub fn level(&self, level: usize) -> Texture<'a, F, Z::Level, N> {
        let level = level.min(self.levels().saturating_sub(1));
        let at = |level: usize| self.begin.get(level).copied().unwrap_or_default() as usize;
        let texels = at(level)..at(level + 1);
        let halved = |side: u16| (side >> level).max(1);
        let sides = [self.width, self.height];
        // In line, compilers of several lanes no longer see that layers of a material read the same texels. Programs
        // made for size would keep a loop.
        let sides = if cfg!(target_os = "none") { map2(sides, halved) } else { sides.map(halved) };
        let (none, size) = self.size.level(&[]);
        let planes = each(
            self.elements,
            none,
            #[inline(always)]
            // They are there, as `new` has compared.
            |elements| self.size.level(elements.get(texels.clone()).unwrap_or_default()).0,
        );
        Texture::of_parts(planes, self.format, sides, size)
    }
}

impl<F: Storage, Z: Size, const N: usize> Clone for Mipmap<'_, F, Z, N> {
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: Storage, Z: Size, const N: usize> Copy for Mipmap<'_, F, Z, N> {}

impl<F: Storage, Z: Size, const N: usize> fmt::Debug for Mipmap<'_, F, Z, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mipmap")
            .field("width", &self.width)
            .field("height", &self.height)
            .field("levels", &self.levels)
            .finish_non_exhaustive()
    }
}
