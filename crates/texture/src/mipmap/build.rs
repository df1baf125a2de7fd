//! Filling the smaller levels.

use core::mem::{swap, take};
use core::ops::Range;

use super::mean::Weights;
use super::{MAX_LEVELS, level_count, size_of_level, texel_count};
use crate::format::TexelFormat;
use crate::{Texture, TextureError};

/// Fills all levels from level 0, which is at the beginning of `texels`.
///
/// A texel is the mean of the part of level 0 that it covers. Texels of level 0 count by the share of them that is
/// covered, also where sides are not powers of two:
///
/// ```text
///  5 texels   |   |   |   |   |   |      the first of two counts 1, 1 and 1/2
///  2 texels   |         |         |
/// ```
///
/// ```
/// use alberti_texture::{Mipmap, format::L8, mipmap};
///
/// let mut texels = [0; mipmap::texel_count(2, 2)];
/// texels[..4].copy_from_slice(&[0, 255, 255, 0]);
/// mipmap::build(L8, &mut texels, 2, 2)?;
/// let board = Mipmap::new(L8, &texels, 2, 2)?;
/// // Half of the light is far above half of the byte.
/// assert_eq!(board.level(1).texels(), [188]);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Precision
/// That of the format's [`Content`](crate::format::Content), for every level, as none is made from a rounded one.
///
/// # Cost
/// Levels from the first on that halve the one before are filled in one pass over level 0, up to twelve of them, and of
/// the others each six. So level 0 is read once where sides are powers of two up to 4096, of 1000 x 1000 twice. No
/// memory beside the stack, of which it takes up to 9 KB, or 1 KB if all levels halve.
///
/// # Errors
/// If a side is 0 or greater than 16384, or if there are not [`texel_count`] texels.
pub fn build<F: TexelFormat>(
    format: F,
    texels: &mut [F::Texel],
    width: u32,
    height: u32,
) -> Result<(), TextureError> {
    pieces(format, texels, width, height)?.for_each(Piece::build);
    Ok(())
}

/// The work of [`build`] in pieces, which threads may share: each fills some levels, and reads level 0. There is one
/// where sides are powers of two up to 4096, and otherwise one more for every six levels. The first has most to do, and
/// pieces may be [split](Piece::split).
///
/// # Errors
/// Those of [`build`].
pub fn pieces<F: TexelFormat>(
    format: F,
    texels: &mut [F::Texel],
    width: u32,
    height: u32,
) -> Result<Pieces<'_, F>, TextureError> {
    let area = width.saturating_mul(height) as usize;
    // For its errors.
    Texture::new(format, texels.get(..area).unwrap_or(texels), width, height)?;
    let (found, expected) = (texels.len(), texel_count(width, height));
    #[expect(clippy::cast_possible_truncation, reason = "at most 4/3 of 2^28")]
    let wrong = TextureError::Length { found, expected: expected as u32 };
    if found != expected {
        return Err(wrong);
    }
    let (largest, rest) = texels.split_at_mut_checked(area).ok_or(wrong)?;
    Ok(Pieces { format, largest, rest, size: [width, height], first: 1 })
}

/// The pieces of [`pieces`].
#[derive(Debug)]
pub struct Pieces<'a, F: TexelFormat> {
    format: F,
    /// Level 0.
    largest: &'a [F::Texel],
    /// The levels that are in no piece yet, and the first of them.
    rest: &'a mut [F::Texel],
    size: [u32; 2],
    first: usize,
}

impl<'a, F: TexelFormat> Iterator for Pieces<'a, F> {
    type Item = Piece<'a, F>;

    fn next(&mut self) -> Option<Piece<'a, F>> {
        let Self { format, largest, size, first, .. } = *self;
        let smallest = level_count(size[0], size[1]) - 1;
        if first > smallest {
            return None;
        }
        let halves =
            |&level: &usize| size_of_level(size, level).iter().all(|side| *side == 1 || side % 2 == 0);
        let halved = (0..smallest).take_while(halves).count();
        let squares = first == 1 && halved > 0;
        let last = if squares { halved.min(2 * SHARED) } else { smallest.min(first + SHARED - 1) };
        let mut piece = Piece { format, largest, size, levels: Default::default(), first, last, squares };
        for (own, level) in piece.levels.iter_mut().zip(0..=last).skip(first) {
            let [columns, rows] = size_of_level(size, level);
            let (texels, rest) = take(&mut self.rest).split_at_mut_checked((columns * rows) as usize)?;
            let [wide, high] = [[size[0], columns], [size[1], rows]].map(|sides| lowest(sides)[0]);
            *own = Level { texels, top: 0, size: [columns, rows], weights: Weights::new(wide * high) };
            self.rest = rest;
        }
        self.first = last + 1;
        Some(piece)
    }
}

/// The most levels of a piece. It may be twice as many that halve the ones before.
pub(super) const SHARED: usize = 6;

/// Levels that are filled in one pass over level 0.
#[derive(Debug)]
pub struct Piece<'a, F: TexelFormat> {
    pub(super) format: F,
    /// Level 0, and its size.
    pub(super) largest: &'a [F::Texel],
    pub(super) size: [u32; 2],
    pub(super) levels: [Level<'a, F::Texel>; MAX_LEVELS],
    /// The numbers of its levels.
    pub(super) first: usize,
    pub(super) last: usize,
    /// Whether each level halves the one before, the first level 0.
    squares: bool,
}

/// Some rows of a level.
#[derive(Debug)]
pub(super) struct Level<'a, T> {
    pub(super) texels: &'a mut [T],
    /// The first of the rows.
    pub(super) top: u32,
    /// That of the whole level.
    pub(super) size: [u32; 2],
    /// All parts that a texel covers, of which a texel of level 0 has a whole number.
    pub(super) weights: Weights,
}

impl<T> Default for Level<'_, T> {
    fn default() -> Self {
        Self { texels: &mut [], top: 0, size: [1; 2], weights: Weights::new(1) }
    }
}

impl<T> Level<'_, T> {
    /// The numbers of the rows.
    #[expect(clippy::cast_possible_truncation, reason = "at most 2^14 rows")]
    pub(super) const fn rows(&self) -> Range<u32> {
        self.top..self.top + (self.texels.len() / self.size[0] as usize) as u32
    }

    pub(super) fn row(&mut self, y: u32) -> Option<&mut [T]> {
        let begin = (y.wrapping_sub(self.top).wrapping_mul(self.size[0])) as usize;
        self.texels.get_mut(begin..begin + self.size[0] as usize)
    }

    #[inline]
    pub(super) fn texel(&mut self, [x, y]: [u32; 2]) -> Option<&mut T> {
        let place = y.wrapping_sub(self.top).wrapping_mul(self.size[0]).wrapping_add(x);
        self.texels.get_mut(place as usize)
    }
}

impl<F: TexelFormat> Piece<'_, F> {
    /// Takes off the lower half of the rows, if the last level has more than one. Of more than six levels with one row
    /// in the last it takes off all but the six.
    pub fn split(&mut self) -> Option<Self> {
        let Self { format, largest, size, first, last, squares, .. } = *self;
        let Range { start, end } = self.levels.get(last)?.rows();
        let middle = start + (end - start) / 2;
        if middle == start {
            let next = first + SHARED;
            if next > last {
                return None;
            }
            let mut smaller =
                Self { format, largest, size, levels: Default::default(), first: next, last, squares: false };
            for (own, taken) in self.levels.iter_mut().zip(&mut smaller.levels).skip(next) {
                swap(own, taken);
            }
            self.last = next - 1;
            return Some(smaller);
        }
        let [_, all] = size_of_level(size, last);
        let mut lower = Self { format, largest, size, levels: Default::default(), first, last, squares };
        for (own, below) in self.levels.iter_mut().zip(&mut lower.levels).take(last + 1).skip(first) {
            let top = first_of(middle, [own.size[1], all]);
            let count = (top - own.top) * own.size[0];
            let (above, texels) = take(&mut own.texels).split_at_mut_checked(count as usize)?;
            own.texels = above;
            *below = Level { texels, top, size: own.size, weights: own.weights };
        }
        Some(lower)
    }

    /// Fills the levels.
    pub fn build(mut self) {
        let Some(last) = self.levels.get(self.last) else { return };
        let (rows, columns) = (last.rows(), last.size[0]);
        if self.squares {
            for y in rows {
                (0..columns).for_each(|x| _ = self.sums(self.last, [x, y]));
            }
            return;
        }
        // Rows of a strip are far from each other in memory: not too many of them before the strip beside it.
        for top in rows.clone().step_by(BAND as usize) {
            (0..columns).for_each(|x| self.fill_strip(x, top..rows.end.min(top + BAND)));
        }
    }
}

/// Rows of the last level before the next strip.
const BAND: u32 = 4;

/// A fraction in lowest terms.
pub(super) fn lowest([above, below]: [u32; 2]) -> [u32; 2] {
    let (mut greatest, mut rest) = (above, below);
    while rest > 0 {
        (greatest, rest) = (rest, greatest % rest);
    }
    [above, below].map(|side| side / greatest.max(1))
}

/// The first of so many texels in the i-th share of them, of so many shares.
pub(super) const fn first_of(i: u32, [texels, shares]: [u32; 2]) -> u32 {
    i * texels / shares
}
