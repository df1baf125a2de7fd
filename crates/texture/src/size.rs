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
#[derive(Clone, Copy, Debug)]
pub enum AnySize {}

/// Sides whose lengths are powers of two. Scaling by them is exact in `f32`, and the remainder is a mask: of NaN, which
/// becomes a multiple of 2^31, and so of an infinity less itself, it is 0.
#[derive(Clone, Copy, Debug)]
pub enum PowerOfTwo {}

/// Sides that are known when the program is compiled, powers of two: as [`PowerOfTwo`], with shifts and masks by
/// constants.
#[derive(Clone, Copy, Debug)]
pub enum Known<const WIDTH: u32, const HEIGHT: u32> {}

/// The working part of [`Size`]; not nameable outside, so that it can still change.
pub trait Scale {
    /// The texel whose cell holds the coordinate, along a side of `size` texels.
    fn cell<L: Lanes, W: Wrap>(lanes: L, u: L::Number, size: u32) -> L::U32;

    /// The texels to the left and to the right of the coordinate, and the 256ths from the centre of the one to that of
    /// the other.
    ///
    /// A distance that rounds to 256 comes out as 0 from the next texel, which is the same colour.
    fn between<L: Lanes, W: Wrap>(lanes: L, u: L::Number, size: u32) -> [L::U32; 3];

    /// `row * width + column`.
    fn index<L: Lanes>(lanes: L, row: L::U32, column: L::U32, width: u32) -> L::U32;
}

impl Size for AnySize {}

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
    fn index<L: Lanes>(lanes: L, row: L::U32, column: L::U32, width: u32) -> L::U32 {
        row * lanes.word(width) + column
    }
}

impl Size for PowerOfTwo {}

impl<const WIDTH: u32, const HEIGHT: u32> Size for Known<WIDTH, HEIGHT> {
    const SIDES: Option<[u32; 2]> = {
        assert!(WIDTH.is_power_of_two() && HEIGHT.is_power_of_two(), "Known: sides must be powers of two");
        Some([WIDTH, HEIGHT])
    };
}

macro_rules! powers_of_two {
    ($(($($parameters:tt)*) $size:ty;)*) => {$(
        impl<$($parameters)*> Scale for $size {
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
            fn index<L: Lanes>(lanes: L, row: L::U32, column: L::U32, width: u32) -> L::U32 {
                lanes.shl(row, width.trailing_zeros()) + column
            }
        }
    )*};
}
powers_of_two! {
    () PowerOfTwo;
    (const WIDTH: u32, const HEIGHT: u32) Known<WIDTH, HEIGHT>;
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

    let scaled = (reduced * u64::from(size)).cast_signed() + OFFSET;
    (scaled >> SHIFT) as i32
}
