//! From texels to the colour at a point: nearest and bilinear.
//!
//! Space in: texture coordinates, u to the right, v up. Space out: the colours as they are stored.

use core::fmt::Debug;

use alberti_math::lanes::Lanes;
use alberti_math::{Rgba8, each, each_pair, map2};

use crate::blend::{Quad, bilinear, bilinear_scalar, spread, sums};
use crate::format::Storage;
use crate::sealed::Sealed;
use crate::{Size, Texture, Wrap};

/// The way of reading a colour between texels: [`Nearest`] or [`Bilinear`], and [`AnyFilter`] for one that is picked at
/// run time. Sealed.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a filter of one texture",
    note = "`Nearest`, `Bilinear` and `AnyFilter` are; filters of mip maps belong to `Mipmap::sampler`"
)]
pub trait Filter: Sealed + Copy + Debug + 'static {
    /// The colours of each plane of the texture at (u, v), as words, with a wrap mode for u and one for v.
    fn sample<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> [L::U32; N];

    /// Red, green, blue and alpha times 2^16, before they are rounded.
    fn sums<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> [[L::U32; 4]; N];

    /// The texture as a map of numbers, which count 65535ths.
    fn scalars<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z>,
        wrap: (U, V),
        uv: [L::Number; 2],
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
/// at once, and the load. With sides of other lengths about 28 instructions on x86-64 for each sample, no division and
/// no call. There, coordinates of 2^13 and more take a slower way to the same answer.
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
/// `a` and `b` are correctly rounded from the coordinate (as reduced by [`Wrap`]); the weights sum to 2^16 exactly and
/// there is one rounding at the end. So a colour is never outside of the range of its four texels, equal texels give
/// that colour, and a texel's centre gives the texel. The error against filtering in real numbers is below 1.5 of 255:
/// 0.5 of rounding and less than 1 from the weights.
///
/// # Cost
/// About four times that of [`Nearest`]: four texels, and eight multiplications of 32 bits for the mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bilinear;

/// A [`Filter`] that is picked at run time: each is the type of its name, bit for bit.
///
/// # Cost
/// A match for each level that is read, and the code of both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyFilter {
    /// [`Nearest`].
    #[default]
    Nearest,
    /// [`Bilinear`].
    Bilinear,
}

impl Sealed for Nearest {}
impl Sealed for Bilinear {}
impl Sealed for AnyFilter {}

impl Filter for Nearest {
    #[inline(always)]
    fn sample<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> [L::U32; N] {
        let at = texture.cells(lanes, uv, wrap);
        texture.each_plane(
            lanes.word(0),
            #[inline(always)]
            |plane| texel(lanes, &plane, wrap, at),
        )
    }

    #[inline(always)]
    fn sums<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> [[L::U32; 4]; N] {
        each(
            self.sample(lanes, texture, wrap, uv),
            [lanes.word(0); 4],
            #[inline(always)]
            |color| spread(lanes, color),
        )
    }

    #[inline(always)]
    fn scalars<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> L::U32 {
        let at = texture.cells(lanes, uv, wrap);
        scalar(lanes, texture, wrap, at)
    }
}

impl Filter for Bilinear {
    #[inline(always)]
    fn sample<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> [L::U32; N] {
        let (quads, [along, up]) = quads(lanes, texture, wrap, uv);
        each(
            quads,
            lanes.word(0),
            #[inline(always)]
            |quad| bilinear(lanes, quad, along, up),
        )
    }

    #[inline(always)]
    fn sums<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> [[L::U32; 4]; N] {
        let (quads, [along, up]) = quads(lanes, texture, wrap, uv);
        each(
            quads,
            [lanes.word(0); 4],
            #[inline(always)]
            |quad| sums(lanes, quad, along, up),
        )
    }

    #[inline(always)]
    fn scalars<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> L::U32 {
        let [[left, right, along], [low, high, up]] = texture.between(lanes, uv, wrap);
        bilinear_scalar(lanes, scalars(lanes, texture, wrap, [left, right], [low, high]), along, up)
    }
}

impl Filter for AnyFilter {
    #[inline(always)]
    fn sample<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> [L::U32; N] {
        match self {
            Self::Nearest => Nearest.sample(lanes, texture, wrap, uv),
            Self::Bilinear => Bilinear.sample(lanes, texture, wrap, uv),
        }
    }

    #[inline(always)]
    fn sums<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z, N>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> [[L::U32; 4]; N] {
        match self {
            Self::Nearest => Nearest.sums(lanes, texture, wrap, uv),
            Self::Bilinear => Bilinear.sums(lanes, texture, wrap, uv),
        }
    }

    #[inline(always)]
    fn scalars<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
        self,
        lanes: L,
        texture: &Texture<'_, F, Z>,
        wrap: (U, V),
        uv: [L::Number; 2],
    ) -> L::U32 {
        match self {
            Self::Nearest => Nearest.scalars(lanes, texture, wrap, uv),
            Self::Bilinear => Bilinear.scalars(lanes, texture, wrap, uv),
        }
    }
}

/// The colour in a column and in a row that is counted from the bottom, or that of the border.
#[inline(always)]
fn texel<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    wrap: (U, V),
    at: [L::U32; 2],
) -> L::U32 {
    bordered(
        lanes,
        texture.height(),
        at,
        map2([wrap.0.border(), wrap.1.border()], |border| border.map(Rgba8::to_bits)),
        #[inline(always)]
        |row, column| texture.fetch(lanes, row, column),
    )
}

/// The texels of each plane about a place, and the 256ths from the left to the right and from the lower to the upper.
#[inline(always)]
fn quads<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
    lanes: L,
    texture: &Texture<'_, F, Z, N>,
    wrap: (U, V),
    uv: [L::Number; 2],
) -> ([Quad<L>; N], [L::U32; 2]) {
    let [[left, right, along], [low, high, up]] = texture.between(lanes, uv, wrap);
    let [low, high] = map2(
        [low, high],
        #[inline(always)]
        |row| texels(lanes, texture, wrap, [left, right], row),
    );
    let nothing = Quad::of([[lanes.word(0); 2]; 2]);
    let quads = each_pair(
        low,
        high,
        nothing,
        #[inline(always)]
        |low, high| Quad::of([low, high]),
    );
    (quads, [along, up])
}

/// The colours of each plane in two columns, the second of which mostly follows the first, and in a row.
#[inline(always)]
fn texels<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap, const N: usize>(
    lanes: L,
    texture: &Texture<'_, F, Z, N>,
    wrap: (U, V),
    columns: [L::U32; 2],
    from_bottom: L::U32,
) -> [[L::U32; 2]; N] {
    let borders = map2([wrap.0.border(), wrap.1.border()], |border| border.map(Rgba8::to_bits));
    let row = lanes.word(texture.height().wrapping_sub(1)) - from_bottom;
    let [at_left, at_right] = map2(columns, |column| [column, from_bottom]);
    each(
        texture.fetch_pairs(lanes, row, columns),
        [lanes.word(0); 2],
        #[inline(always)]
        |[left, right]| {
            [with_borders(lanes, at_left, borders, left), with_borders(lanes, at_right, borders, right)]
        },
    )
}

/// The numbers in two columns and in two rows that are counted from the bottom, as counts of 65535ths.
#[inline(always)]
pub(crate) fn scalars<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    wrap: (U, V),
    columns: [L::U32; 2],
    rows: [L::U32; 2],
) -> Quad<L> {
    Quad::of(map2(
        rows,
        #[inline(always)]
        |row| {
            map2(
                columns,
                #[inline(always)]
                |column| scalar(lanes, texture, wrap, [column, row]),
            )
        },
    ))
}

/// The number in a column and in a row that is counted from the bottom, or that of the border, as a count of 65535ths.
#[inline(always)]
fn scalar<L: Lanes, F: Storage, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    wrap: (U, V),
    at: [L::U32; 2],
) -> L::U32 {
    bordered(
        lanes,
        texture.height(),
        at,
        map2([wrap.0.border(), wrap.1.border()], |border| border.map(|color| (color.to_bits() & 255) * 257)),
        #[inline(always)]
        |row, column| texture.fetch_scalars(lanes, row, column),
    )
}

/// The words that `fetch` finds in a row, counted from the top, and a column, [`with_borders`].
#[inline(always)]
pub(crate) fn bordered<L: Lanes>(
    lanes: L,
    height: u32,
    [column, from_bottom]: [L::U32; 2],
    borders: [Option<u32>; 2],
    fetch: impl FnOnce(L::U32, L::U32) -> L::U32,
) -> L::U32 {
    // Rows from the bottom are less than the height. Any texel, or none, outside.
    let found = fetch(lanes.word(height.wrapping_sub(1)) - from_bottom, column);
    with_borders(lanes, [column, from_bottom], borders, found)
}

/// The words found in columns and rows; where there is no column, the first of `borders`; where there is no row, the
/// second.
#[inline(always)]
fn with_borders<L: Lanes>(
    lanes: L,
    [column, from_bottom]: [L::U32; 2],
    borders: [Option<u32>; 2],
    found: L::U32,
) -> L::U32 {
    if borders == [None; 2] {
        return found;
    }
    let [by_column, by_row] = borders;
    or_border(lanes, column, or_border(lanes, from_bottom, found, by_row), by_column)
}

/// The words found, or the border where an index is outside: all ones, while no others are negative.
#[inline(always)]
fn or_border<L: Lanes>(lanes: L, index: L::U32, found: L::U32, border: Option<u32>) -> L::U32 {
    let Some(border) = border else { return found };
    let all = lanes.word(u32::MAX);
    let inside = all - lanes.shr_signed(index, 31);
    (found & inside) | (lanes.word(border) & (all - inside))
}
