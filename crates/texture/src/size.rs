//! What is known of a texture's sides when its sampling is compiled.

use alberti_math::lanes::Lanes;
use core::fmt::Debug;

use crate::Wrap;
use crate::coordinate::FRACTION_BITS;

/// [`AnySize`], [`PowerOfTwo`] or [`Known`]. Other crates cannot add to them.
///
/// All find the same texels and weights where they apply (in fixed point [`AnySize`] goes through `f32`, which rounds
/// beyond 256); the second is faster than the first, and works on many
/// samples at once, and the third is faster again.
pub trait Size: Scale + Copy + Debug + 'static {
    /// Columns and rows, where they are known.
    const SIDES: Option<[u32; 2]> = None;
}

/// Sides of any length. Coordinates are scaled in 64-bit integers, one sample after the other.
///
/// # Cost
/// About 28 instructions a texel on x86-64.
#[derive(Clone, Copy, Debug)]
pub enum AnySize {}

/// Sides whose lengths are powers of two. Scaling by them is exact in `f32`, and the remainder is a mask: of NaN, which
/// becomes a multiple of 2^31, and so of an infinity less itself, it is 0.
///
/// # Cost
/// Six operations an axis on all lanes at once, and for each texel an index, a comparison, and a load.
#[derive(Clone, Copy, Debug)]
pub enum PowerOfTwo {}

/// Sides that are known when the program is compiled, powers of two: as [`PowerOfTwo`], with shifts and masks by
/// constants, and so without a comparison of indices with the number of texels.
///
/// # Cost
/// In fixed point on a Cortex-M4F five instructions a texel, the load included.
#[derive(Clone, Copy, Debug)]
pub enum Known<const WIDTH: usize, const HEIGHT: usize> {}

/// [`AnySize`] or [`PowerOfTwo`]: what the levels of a [`Mipmap`](crate::Mipmap) can have.
pub trait LevelSize: Size {
    /// Texels of any number.
    #[doc(hidden)]
    fn slice<T>(texels: &[T]) -> Self::Texels<'_, T>;
}

/// The working part of [`Size`]; not nameable outside, so that it can still change.
pub trait Scale {
    /// The texel whose cell holds the coordinate, along a side of `size` texels.
    fn cell<L: Lanes, W: Wrap>(lanes: L, u: L::Number, size: u32) -> L::U32;

    /// The texels to the left and to the right of the coordinate, and the 256ths from the centre of the one to that of
    /// the other.
    ///
    /// A distance that rounds to 256 comes out as 0 from the next texel, which is the same colour.
    fn between<L: Lanes, W: Wrap>(lanes: L, u: L::Number, size: u32) -> [L::U32; 3];

    /// [`Wrap::index`] of a two's complement `i`, from -1 to one beyond the period.
    fn wrapped<L: Lanes, W: Wrap>(lanes: L, i: L::U32, size: u32) -> L::U32;

    /// Texels in rows, as many as that is.
    type Texels<'a, T: 'a>: Copy;

    /// All texels, row by row.
    fn flattened<'a, T: 'a>(texels: Self::Texels<'a, T>) -> &'a [T];

    /// What `word` makes of the texels in rows of `width`; there always is one, as long as rows and columns are less
    /// than the sides.
    fn words<L: Lanes, T>(
        lanes: L,
        texels: Self::Texels<'_, T>,
        at: [L::U32; 2],
        width: u32,
        word: impl Fn(Option<&T>) -> u32,
    ) -> L::U32;
}

/// The texels of these indices.
#[inline(always)]
fn indexed<L: Lanes, T>(lanes: L, texels: &[T], indices: L::U32, word: impl Fn(Option<&T>) -> u32) -> L::U32 {
    let indices = lanes.store_words(indices);
    lanes.load_words(
        &lanes.each(|k| word(texels.get(indices.as_ref().get(k).copied().unwrap_or_default() as usize))),
    )
}

impl Size for AnySize {}

impl LevelSize for AnySize {
    #[inline(always)]
    fn slice<T>(texels: &[T]) -> &[T] {
        texels
    }
}

impl Scale for AnySize {
    #[inline(always)]
    fn cell<L: Lanes, W: Wrap>(lanes: L, u: L::Number, size: u32) -> L::U32 {
        let in_memory = lanes.store(u);
        lanes.load_words(&lanes.each(|k| W::cell(W::reduce(at(in_memory.as_ref(), k)), size)))
    }

    #[inline(always)]
    fn between<L: Lanes, W: Wrap>(lanes: L, u: L::Number, size: u32) -> [L::U32; 3] {
        let in_memory = lanes.store(u);
        let each = lanes.each(|k| {
            let position = position(W::reduce(at(in_memory.as_ref(), k)), size);
            let (left, right) = W::neighbours(position >> 8, size);
            [left, right, position.cast_unsigned() & 255]
        });
        let words = |part: usize| {
            lanes.load_words(&lanes.each(|k| each.as_ref().get(k).map_or(0, |parts: &[u32; 3]| parts[part])))
        };
        [words(0), words(1), words(2)]
    }

    #[inline(always)]
    fn wrapped<L: Lanes, W: Wrap>(lanes: L, i: L::U32, size: u32) -> L::U32 {
        let each = lanes.store_words(i);
        lanes.load_words(
            &lanes.each(|k| W::index(each.as_ref().get(k).copied().unwrap_or_default().cast_signed(), size)),
        )
    }

    type Texels<'a, T: 'a> = &'a [T];

    #[inline(always)]
    fn flattened<'a, T: 'a>(texels: &'a [T]) -> &'a [T] {
        texels
    }

    #[inline(always)]
    fn words<L: Lanes, T>(
        lanes: L,
        texels: &[T],
        [row, column]: [L::U32; 2],
        width: u32,
        word: impl Fn(Option<&T>) -> u32,
    ) -> L::U32 {
        indexed(lanes, texels, row * lanes.word(width) + column, word)
    }
}

impl Size for PowerOfTwo {}

impl LevelSize for PowerOfTwo {
    #[inline(always)]
    fn slice<T>(texels: &[T]) -> &[T] {
        texels
    }
}

impl<const WIDTH: usize, const HEIGHT: usize> Size for Known<WIDTH, HEIGHT> {
    #[expect(clippy::cast_possible_truncation, reason = "there is no texture with larger sides")]
    const SIDES: Option<[u32; 2]> = {
        assert!(WIDTH.is_power_of_two() && HEIGHT.is_power_of_two(), "Known: sides must be powers of two");
        Some([WIDTH as u32, HEIGHT as u32])
    };
}

macro_rules! powers_of_two {
    ($(($($parameters:tt)*) $size:ty { $($texels:item)* })*) => {$(
        impl<$($parameters)*> Scale for $size {
            $($texels)*

            #[inline(always)]
            fn cell<L: Lanes, W: Wrap>(lanes: L, u: L::Number, size: u32) -> L::U32 {
                W::fold(lanes, lanes.floor_scaled(W::in_period(lanes, u), size.trailing_zeros()), size)
            }

            #[inline(always)]
            fn between<L: Lanes, W: Wrap>(lanes: L, u: L::Number, size: u32) -> [L::U32; 3] {
                let nearest = lanes.round_scaled(W::in_period(lanes, u), size.trailing_zeros() + 8);
                // Half a texel to the left lies the centre from which distances count; one more keeps it positive.
                let position = nearest + lanes.word(128);
                let right = lanes.shr_signed(position, 8);
                [W::fold(lanes, right - lanes.word(1), size), W::fold(lanes, right, size), position & lanes.word(255)]
            }

            #[inline(always)]
            fn wrapped<L: Lanes, W: Wrap>(lanes: L, i: L::U32, size: u32) -> L::U32 {
                W::fold(lanes, i, size)
            }
        }
    )*};
}
powers_of_two! {
    () PowerOfTwo {
        type Texels<'a, T: 'a> = &'a [T];

        #[inline(always)]
        fn flattened<'a, T: 'a>(texels: &'a [T]) -> &'a [T] {
            texels
        }

        #[inline(always)]
        fn words<L: Lanes, T>(
            lanes: L,
            texels: &[T],
            [row, column]: [L::U32; 2],
            width: u32,
            word: impl Fn(Option<&T>) -> u32,
        ) -> L::U32 {
            indexed(lanes, texels, lanes.shl(row, width.trailing_zeros()) + column, word)
        }
    }
    (const WIDTH: usize, const HEIGHT: usize) Known<WIDTH, HEIGHT> {
        type Texels<'a, T: 'a> = &'a [[T; WIDTH]; HEIGHT];

        #[inline(always)]
        fn flattened<'a, T: 'a>(texels: &'a [[T; WIDTH]; HEIGHT]) -> &'a [T] {
            texels.as_flattened()
        }

        #[inline(always)]
        fn words<L: Lanes, T>(
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
}

/// Element `k`, which there is.
#[inline(always)]
fn at(values: &[f32], k: usize) -> f32 {
    values.get(k).copied().unwrap_or_default()
}

/// The 256ths from the centre of the leftmost texel to a reduced coordinate, rounded to nearest, halves up.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "of 53 bits and a sign, the shift leaves 24")]
fn position(reduced: u64, size: u32) -> i32 {
    const SHIFT: u32 = FRACTION_BITS - 8;
    // Half a unit to round to nearest, less half a texel. In 39 + 14 bits and a sign.
    const OFFSET: i64 = (1 << (SHIFT - 1)) - (128 << SHIFT);

    // In `Border` it may be negative.
    let scaled = reduced.cast_signed() * i64::from(size) + OFFSET;
    (scaled >> SHIFT) as i32
}
