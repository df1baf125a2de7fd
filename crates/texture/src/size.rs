//! Knowledge of a texture's sides when its sampling is compiled.

use alberti_math::lanes::Lanes;
use alberti_math::{each, map2};
use core::fmt::Debug;

use crate::Wrap;
use crate::sealed::Sealed;

/// The sides of a texture, as far as they are known when compiling: [`AnySize`], [`PowerOfTwo`] or [`Known`]. Sealed.
///
/// All find the same texels and weights where they apply. The second is faster than the first by a match, the third
/// faster again.
pub trait Size: Sealed + Copy + Debug + 'static {
    /// Columns and rows, where they are known.
    const SIDES: Option<[u32; 2]> = None;

    /// Texels in rows, as many as that is.
    type Texels<'a, T: 'a>: Copy;

    /// The same of a level of a [`Mipmap`](crate::Mipmap), whose sides are halves of these.
    type Level: Size;

    /// A level's texels, and its sides as far as they are known.
    fn level<T>(self, texels: &[T]) -> (<Self::Level as Size>::Texels<'_, T>, Self::Level);

    /// All texels, row by row.
    fn flattened<'a, T: 'a>(self, texels: Self::Texels<'a, T>) -> &'a [T];

    /// The column and the row, counted from the bottom, whose cells hold the coordinates (u, v).
    #[inline(always)]
    fn cells<L: Lanes, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        [u, v]: [L::Number; 2],
        [width, height]: [u32; 2],
        wrap: (U, V),
    ) -> [L::U32; 2] {
        [wrap.0.cell_masked(lanes, u, width), wrap.1.cell_masked(lanes, v, height)]
    }

    /// The columns to either side of u, and the way from the centre of the one to that of the other in `bits` bits, at
    /// most 8. Then the same of rows and v.
    #[inline(always)]
    fn between<L: Lanes, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        [u, v]: [L::Number; 2],
        [width, height]: [u32; 2],
        wrap: (U, V),
        bits: u32,
    ) -> [[L::U32; 3]; 2] {
        [wrap.0.between_masked(lanes, u, width, bits), wrap.1.between_masked(lanes, v, height, bits)]
    }

    /// Of the columns of [`between`](Self::between), the right one where its share, in 256ths, and the first of
    /// `thresholds`, from 0 to 255, add up to one. Then the same of rows and v.
    #[inline(always)]
    fn either<L: Lanes, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        [u, v]: [L::Number; 2],
        [width, height]: [u32; 2],
        wrap: (U, V),
        thresholds: [L::U32; 2],
    ) -> [L::U32; 2] {
        [
            wrap.0.either_masked(lanes, u, width, thresholds[0]),
            wrap.1.either_masked(lanes, v, height, thresholds[1]),
        ]
    }

    /// [`Wrap::index`] of a two's complement column and row, from -1 to one beyond the period.
    #[inline(always)]
    fn indices<L: Lanes, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        [column, row]: [L::U32; 2],
        [width, height]: [u32; 2],
        wrap: (U, V),
    ) -> [L::U32; 2] {
        [wrap.0.fold(lanes, column, width), wrap.1.fold(lanes, row, height)]
    }

    /// The words that `word` makes of texels in a row and a column each, in rows of `width`. There always is one, as
    /// long as rows and columns are less than the sides.
    fn words<L: Lanes, T>(
        self,
        lanes: L,
        texels: Self::Texels<'_, T>,
        at: [L::U32; 2],
        width: u32,
        word: impl Fn(Option<&T>) -> u32,
    ) -> L::U32;

    /// [`words`](Self::words) where a sample reads no other texel.
    #[inline(always)]
    fn lone_words<L: Lanes, T>(
        self,
        lanes: L,
        texels: Self::Texels<'_, T>,
        at: [L::U32; 2],
        width: u32,
        word: impl Fn(Option<&T>) -> u32,
    ) -> L::U32 {
        self.words(lanes, texels, at, width, word)
    }

    /// The index of a row's first texel, in rows of `width`.
    #[inline(always)]
    fn row_start<L: Lanes>(self, lanes: L, row: L::U32, width: u32) -> L::U32 {
        lanes.shl(row, width.trailing_zeros())
    }

    /// [`words`](Self::words) of several textures in a row and two columns each, of which the second mostly follows the
    /// first.
    #[inline(always)]
    fn word_pairs<L: Lanes, T, const N: usize>(
        self,
        lanes: L,
        planes: [Self::Texels<'_, T>; N],
        (row, [left, right]): (L::U32, [L::U32; 2]),
        width: u32,
        word: impl Fn(Option<&T>) -> u32,
    ) -> [[L::U32; 2]; N] {
        let nothing = [lanes.word(0); 2];
        // In order, texels lie side by side: not so at the sides of the texture, nor beyond a border, where one of the
        // two is no column and the greatest of words.
        let follows = lanes.equal_words(lanes.min_words(left, right) + lanes.word(1), right);
        let in_order = lanes.bits(follows) == (1 << L::COUNT) - 1;
        if const { L::COUNT == 1 } || !in_order {
            return each(
                planes,
                nothing,
                #[inline(always)]
                |texels| {
                    map2(
                        [left, right],
                        #[inline(always)]
                        |column| {
                            self.words(
                                lanes,
                                texels,
                                [row, column],
                                width,
                                #[expect(
                                    clippy::redundant_closure,
                                    reason = "a reference to one is a call in programs made for size"
                                )]
                                #[inline(always)]
                                |texel| word(texel),
                            )
                        },
                    )
                },
            );
        }
        let indices = self.row_start(lanes, row, width) + left;
        each(
            planes,
            nothing,
            #[inline(always)]
            |texels| {
                let texels = self.flattened(texels);
                // Every index is that or less: the minimum is what compilers see it by, without a branch.
                if texels.len() < 2 {
                    return nothing;
                }
                let last = texels.len() - 2;
                lanes.gather_pairs(
                    indices,
                    #[inline(always)]
                    |index| {
                        let index = (index as usize).min(last);
                        let pair = texels.get(index..index + 2).and_then(<[T]>::first_chunk);
                        let [left, right] =
                            pair.map_or([None; 2], |[left, right]: &[T; 2]| [Some(left), Some(right)]);
                        [word(left), word(right)]
                    },
                )
            },
        )
    }
}

/// Sides of any length, the way chosen at run time: as in [`PowerOfTwo`] where both are powers of two. Elsewhere
/// coordinates are scaled in integers of 64 bits, one sample after the other.
///
/// # Precision
/// Both ways find the same texels and weights for every `f32`. In fixed point the first is exact; the second goes
/// through `f32`, which rounds coordinates beyond 256.
///
/// # Cost
/// A match for each level that is read, and that of [`PowerOfTwo`], or about 28 instructions a texel on x86-64. The
/// code of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AnySize {
    /// Whether both sides are powers of two.
    by_masks: bool,
}

/// Sides whose lengths are powers of two. Scaling by them is exact in `f32`, and the remainder is a mask. NaN, and so
/// an infinity less itself, becomes a multiple of 2^31, whose remainder is 0.
///
/// # Cost
/// Six operations an axis on all lanes at once, and for each texel an index, a comparison, and a load.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PowerOfTwo;

/// Sides that are known when the program is compiled, powers of two. They are as [`PowerOfTwo`], with shifts and masks
/// by constants, and so without a comparison of indices with the number of texels.
///
/// # Cost
/// In fixed point on a Cortex-M4F five instructions a texel, the load included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Known<const WIDTH: usize, const HEIGHT: usize>;

impl Sealed for AnySize {}
impl Sealed for PowerOfTwo {}
impl<const WIDTH: usize, const HEIGHT: usize> Sealed for Known<WIDTH, HEIGHT> {}

impl AnySize {
    /// The way for these sides.
    #[inline]
    pub(crate) const fn of(width: u32, height: u32) -> Self {
        Self { by_masks: width.is_power_of_two() && height.is_power_of_two() }
    }

    /// The other type, if that is the way.
    #[inline]
    pub(crate) const fn power_of_two(self) -> Option<PowerOfTwo> {
        if self.by_masks { Some(PowerOfTwo) } else { None }
    }
}

impl Size for AnySize {
    type Texels<'a, T: 'a> = &'a [T];
    type Level = Self;

    #[inline(always)]
    fn level<T>(self, texels: &[T]) -> (&[T], Self) {
        (texels, self)
    }

    #[inline(always)]
    fn flattened<'a, T: 'a>(self, texels: &'a [T]) -> &'a [T] {
        texels
    }

    #[inline(always)]
    fn cells<L: Lanes, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        [u, v]: [L::Number; 2],
        [width, height]: [u32; 2],
        wrap: (U, V),
    ) -> [L::U32; 2] {
        if self.by_masks {
            PowerOfTwo.cells(lanes, [u, v], [width, height], wrap)
        } else {
            [wrap.0.cell_wide(lanes, u, width), wrap.1.cell_wide(lanes, v, height)]
        }
    }

    #[inline(always)]
    fn between<L: Lanes, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        [u, v]: [L::Number; 2],
        [width, height]: [u32; 2],
        wrap: (U, V),
        bits: u32,
    ) -> [[L::U32; 3]; 2] {
        if self.by_masks {
            PowerOfTwo.between(lanes, [u, v], [width, height], wrap, bits)
        } else {
            [wrap.0.between_wide(lanes, u, width, bits), wrap.1.between_wide(lanes, v, height, bits)]
        }
    }

    #[inline(always)]
    fn either<L: Lanes, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        [u, v]: [L::Number; 2],
        [width, height]: [u32; 2],
        wrap: (U, V),
        thresholds: [L::U32; 2],
    ) -> [L::U32; 2] {
        if self.by_masks {
            PowerOfTwo.either(lanes, [u, v], [width, height], wrap, thresholds)
        } else {
            [
                wrap.0.either_wide(lanes, u, width, thresholds[0]),
                wrap.1.either_wide(lanes, v, height, thresholds[1]),
            ]
        }
    }

    #[inline(always)]
    fn indices<L: Lanes, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        [column, row]: [L::U32; 2],
        [width, height]: [u32; 2],
        wrap: (U, V),
    ) -> [L::U32; 2] {
        if self.by_masks {
            PowerOfTwo.indices(lanes, [column, row], [width, height], wrap)
        } else {
            [wrap.0.index_wide(lanes, column, width), wrap.1.index_wide(lanes, row, height)]
        }
    }

    #[inline(always)]
    fn row_start<L: Lanes>(self, lanes: L, row: L::U32, width: u32) -> L::U32 {
        row * lanes.word(width)
    }

    #[inline(always)]
    fn words<L: Lanes, T>(
        self,
        lanes: L,
        texels: &[T],
        [row, column]: [L::U32; 2],
        width: u32,
        word: impl Fn(Option<&T>) -> u32,
    ) -> L::U32 {
        let indices = self.row_start(lanes, row, width) + column;
        lanes.gather(
            indices,
            #[inline(always)]
            |index| word(texels.get(index as usize)),
        )
    }
}

impl Size for PowerOfTwo {
    type Texels<'a, T: 'a> = &'a [T];
    type Level = Self;

    #[inline(always)]
    fn level<T>(self, texels: &[T]) -> (&[T], Self) {
        (texels, self)
    }

    #[inline(always)]
    fn flattened<'a, T: 'a>(self, texels: &'a [T]) -> &'a [T] {
        texels
    }

    #[inline(always)]
    fn words<L: Lanes, T>(
        self,
        lanes: L,
        texels: &[T],
        [row, column]: [L::U32; 2],
        width: u32,
        word: impl Fn(Option<&T>) -> u32,
    ) -> L::U32 {
        // A power of two less one: no index is changed, and compilers see that none is too large.
        let last = texels.len().wrapping_sub(1);
        let indices = self.row_start(lanes, row, width) + column;
        lanes.gather(
            indices,
            #[inline(always)]
            |index| word(texels.get(index as usize & last)),
        )
    }

    #[inline(always)]
    fn lone_words<L: Lanes, T>(
        self,
        lanes: L,
        texels: &[T],
        at: [L::U32; 2],
        width: u32,
        word: impl Fn(Option<&T>) -> u32,
    ) -> L::U32 {
        if L::FIXED {
            // By a comparison, as a mask would be one more number.
            let [row, column] = at;
            let indices = self.row_start(lanes, row, width) + column;
            lanes.gather(
                indices,
                #[inline(always)]
                |index| word(texels.get(index as usize)),
            )
        } else {
            self.words(lanes, texels, at, width, word)
        }
    }
}

impl<const WIDTH: usize, const HEIGHT: usize> Size for Known<WIDTH, HEIGHT> {
    #[expect(clippy::cast_possible_truncation, reason = "there is no texture with larger sides")]
    const SIDES: Option<[u32; 2]> = {
        assert!(WIDTH.is_power_of_two() && HEIGHT.is_power_of_two(), "Known: sides must be powers of two");
        Some([WIDTH as u32, HEIGHT as u32])
    };

    type Texels<'a, T: 'a> = &'a [[T; WIDTH]; HEIGHT];
    type Level = PowerOfTwo;

    #[inline(always)]
    fn level<T>(self, texels: &[T]) -> (&[T], PowerOfTwo) {
        (texels, PowerOfTwo)
    }

    #[inline(always)]
    fn flattened<'a, T: 'a>(self, texels: &'a [[T; WIDTH]; HEIGHT]) -> &'a [T] {
        texels.as_flattened()
    }

    #[inline(always)]
    fn words<L: Lanes, T>(
        self,
        lanes: L,
        texels: &[[T; WIDTH]; HEIGHT],
        [row, column]: [L::U32; 2],
        _: u32,
        word: impl Fn(Option<&T>) -> u32,
    ) -> L::U32 {
        let (rows, columns) = (lanes.store_words(row), lanes.store_words(column));
        let at = |words: &[u32], k: usize| words.get(k).copied().unwrap_or_default() as usize;
        lanes.load_words(&lanes.each(|k| {
            let row = texels.get(at(rows.as_ref(), k));
            word(row.and_then(|row| row.get(at(columns.as_ref(), k))))
        }))
    }
}
