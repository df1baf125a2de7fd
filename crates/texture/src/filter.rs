//! From texels to the colour at a point: nearest and bilinear.
//!
//! Space in: texture coordinates, u to the right, v up. Space out: the colours as they are stored.

use core::fmt::Debug;

use alberti_math::lanes::Lanes;

use crate::blend::{Quad, bilinear, bilinear_scalar, spread, sums};
use crate::format::Storage;
use crate::{Size, Texture, Wrap};

/// The way of reading a colour between texels: [`Nearest`] or [`Bilinear`]. Other crates cannot add to them.
pub trait Filter: Kernel + Copy + Debug + Default + 'static {}

/// The working part of [`Filter`]; not nameable outside, so that it can still change.
pub trait Kernel {
    /// The colours of the texture at `u` and `v`, as words.
    fn sample<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        u: L::Number,
        v: L::Number,
    ) -> L::U32;

    /// Red, green, blue and alpha times 2^16, before they are rounded.
    fn sums<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        u: L::Number,
        v: L::Number,
    ) -> [L::U32; 4];

    /// The texture as a map of numbers, which count 65535ths.
    fn scalars<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        u: L::Number,
        v: L::Number,
    ) -> L::U32;
}

/// The texel whose cell holds the point: column floor(u * width), row height - 1 - floor(v * height).
///
/// # Precision
/// Exact: the floor is that of the product as a real number, for every `f32` and every size, power of two or not.
/// A point on the border of two cells belongs to the one to the right or above.
///
/// # Cost
/// With [`PowerOfTwo`](crate::PowerOfTwo), six operations of `f32` an axis for [`Repeat`](crate::Repeat), on all lanes
/// at once, and the load. With [`AnySize`](crate::AnySize) about 28 instructions on x86-64 for each sample, no division
/// and no call; there, coordinates of 2^13 and more take a slower way to the same answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Nearest;

/// The mean of the four texels whose centres surround the point, by its distances from them.
///
/// ```text
/// high_left +-----------+ high_right    x = u * width - 0.5    i = floor(x)    s = x - i
///           |   :       |               y = v * height - 0.5   j = floor(y)    t = y - j
///           |...P       | t
///  low_left +-----------+ low_right     low_left is texel (i, j) counted from the bottom left
///             s
/// ```
///
/// The weights have 8 bits: with `a` and `b` as 256 s and 256 t rounded to the nearest integer (halves up), each
/// channel is
///
/// ```text
/// ((256-a)(256-b) low_left + a(256-b) low_right + (256-a)b high_left + ab high_right + 2^15) >> 16
/// ```
///
/// Neighbours beyond the sides are those of [`Wrap::index`]. All channels are filtered as they are stored:
/// colours by their sRGB bytes, not by the light that these stand for, and without regard to alpha.
///
/// # Precision
/// `a` and `b` are correctly rounded from the coordinate (as reduced by [`Wrap`]); the weights sum to 2^16 exactly
/// and there is one rounding at the end. So a colour is never outside of the range of its four texels, equal texels
/// give that colour, a texel's centre gives the texel, and the error against filtering in real numbers is below
/// 1.5 of 255: 0.5 of rounding and less than 1 from the weights.
///
/// # Cost
/// About four times that of [`Nearest`]: four texels, and eight multiplications of 32 bits for the mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bilinear;

impl Filter for Nearest {}

impl Kernel for Nearest {
    #[inline(always)]
    fn sample<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        u: L::Number,
        v: L::Number,
    ) -> L::U32 {
        let at = cell::<L, F, Z, U, V>(lanes, texture, u, v);
        texel::<L, F, Z, U, V>(lanes, texture, at)
    }

    #[inline(always)]
    fn sums<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        u: L::Number,
        v: L::Number,
    ) -> [L::U32; 4] {
        spread(lanes, Self::sample::<L, F, Z, U, V>(lanes, texture, u, v))
    }

    #[inline(always)]
    fn scalars<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        u: L::Number,
        v: L::Number,
    ) -> L::U32 {
        let at = cell::<L, F, Z, U, V>(lanes, texture, u, v);
        scalar::<L, F, Z, U, V>(lanes, texture, at)
    }
}

/// The column and the row, counted from the bottom, of the texel whose cell holds a point.
#[inline(always)]
pub(crate) fn cell<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    u: L::Number,
    v: L::Number,
) -> [L::U32; 2] {
    [Z::cell::<L, U>(lanes, u, texture.width()), Z::cell::<L, V>(lanes, v, texture.height())]
}

impl Filter for Bilinear {}

impl Kernel for Bilinear {
    #[inline(always)]
    fn sample<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        u: L::Number,
        v: L::Number,
    ) -> L::U32 {
        let [[left, right, along], [low, high, up]] = surrounding::<L, F, Z, U, V>(lanes, texture, u, v);
        let quad = Quad::about(
            [left, right],
            [low, high],
            #[inline(always)]
            |at| texel::<L, F, Z, U, V>(lanes, texture, at),
        );
        bilinear(lanes, quad, along, up)
    }

    #[inline(always)]
    fn sums<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        u: L::Number,
        v: L::Number,
    ) -> [L::U32; 4] {
        let [[left, right, along], [low, high, up]] = surrounding::<L, F, Z, U, V>(lanes, texture, u, v);
        let quad = Quad::about(
            [left, right],
            [low, high],
            #[inline(always)]
            |at| texel::<L, F, Z, U, V>(lanes, texture, at),
        );
        sums(lanes, quad, along, up)
    }

    #[inline(always)]
    fn scalars<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        lanes: L,
        texture: &Texture<'_, F, Z>,
        u: L::Number,
        v: L::Number,
    ) -> L::U32 {
        let [[left, right, along], [low, high, up]] = surrounding::<L, F, Z, U, V>(lanes, texture, u, v);
        let quad = Quad::about(
            [left, right],
            [low, high],
            #[inline(always)]
            |at| scalar::<L, F, Z, U, V>(lanes, texture, at),
        );
        bilinear_scalar(lanes, quad, along, up)
    }
}

/// The two columns about a point, and its 256ths of the way from the one to the other; the same of rows.
#[inline(always)]
fn surrounding<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    u: L::Number,
    v: L::Number,
) -> [[L::U32; 3]; 2] {
    [Z::between::<L, U>(lanes, u, texture.width()), Z::between::<L, V>(lanes, v, texture.height())]
}

/// The colour in a column and in a row that is counted from the bottom, or that of the border.
#[inline(always)]
fn texel<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    at: [L::U32; 2],
) -> L::U32 {
    bordered::<L, F, Z, U, V>(
        lanes,
        texture,
        at,
        [U::BORDER, V::BORDER],
        #[inline(always)]
        |row, column| texture.fetch(lanes, row, column),
    )
}

/// The number in a column and in a row that is counted from the bottom, or that of the border, as a count of 65535ths.
#[inline(always)]
pub(crate) fn scalar<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    at: [L::U32; 2],
) -> L::U32 {
    let borders = [U::BORDER, V::BORDER].map(|border| border.map(|color| (color & 255) * 257));
    bordered::<L, F, Z, U, V>(
        lanes,
        texture,
        at,
        borders,
        #[inline(always)]
        |row, column| texture.fetch_scalars(lanes, row, column),
    )
}

/// What `fetch` finds in a row, counted from the top, and a column; where there is no column the first of `borders`,
/// where there is no row the second.
#[inline(always)]
pub(crate) fn bordered<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    [column, from_bottom]: [L::U32; 2],
    borders: [Option<u32>; 2],
    fetch: impl FnOnce(L::U32, L::U32) -> L::U32,
) -> L::U32 {
    // Rows from the bottom are less than the height.
    let from_top = |from_bottom| lanes.word(texture.height().wrapping_sub(1)) - from_bottom;
    if U::BORDER.is_none() && V::BORDER.is_none() {
        return fetch(from_top(from_bottom), column);
    }
    let all = lanes.word(u32::MAX);
    // Indices outside are all ones, and no others are negative.
    let inside = |index, border: Option<u32>| match border {
        Some(_) => all - lanes.shr_signed(index, 31),
        None => all,
    };
    let [in_column, in_row] = [inside(column, U::BORDER), inside(from_bottom, V::BORDER)];
    // Any texel, or none, outside.
    let found = fetch(from_top(from_bottom), column);
    let choose = |inside, a: L::U32, b: Option<u32>| match b {
        Some(b) => (a & inside) | (lanes.word(b) & (all - inside)),
        None => a,
    };
    choose(in_column, choose(in_row, found, borders[1]), borders[0])
}
