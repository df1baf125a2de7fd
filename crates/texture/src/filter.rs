//! From texels to the colour at a point: nearest and bilinear.
//!
//! Space in: texture coordinates, u to the right, v up. Space out: the colours as they are stored.

use core::fmt::Debug;

use alberti_math::Rgba8;
use glam::Vec2;

use crate::blend::{Quad, bilinear};
use crate::coordinate::FRACTION_BITS;
use crate::{TexelFormat, Texture, Wrap};

/// The way of reading a colour between texels: [`Nearest`] or [`Bilinear`]. Other crates cannot add to them.
pub trait Filter: Kernel + Copy + Debug + Default + 'static {}

/// The working part of [`Filter`]; not nameable outside, so that it can still change.
pub trait Kernel {
    /// The colour of the texture at `uv`.
    fn sample<F: TexelFormat, U: Wrap, V: Wrap>(texture: &Texture<'_, F>, uv: Vec2) -> Rgba8;
}

/// The texel whose cell holds the point: column floor(u * width), row height - 1 - floor(v * height).
///
/// # Precision
/// Exact: the floor is that of the product as a real number, for every `f32` and every size, power of two or not.
/// A point on the border of two cells belongs to the one to the right or above. The exception is in [`Wrap`].
///
/// # Cost
/// About 28 instructions with [`Repeat`](crate::Repeat) on x86-64, no division and no call. Coordinates of 2^13
/// and more take a slower way to the same answer.
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
/// About five times that of [`Nearest`]: four texels, and four multiplications of 64 bits for the mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bilinear;

impl Filter for Nearest {}

impl Kernel for Nearest {
    #[inline]
    fn sample<F: TexelFormat, U: Wrap, V: Wrap>(texture: &Texture<'_, F>, uv: Vec2) -> Rgba8 {
        let column = U::cell(U::reduce(uv.x), texture.width());
        let from_bottom = V::cell(V::reduce(uv.y), texture.height());
        texture.fetch(column, row(texture, from_bottom)).unwrap_or_else(no_texel)
    }
}

impl Filter for Bilinear {}

impl Kernel for Bilinear {
    #[inline]
    fn sample<F: TexelFormat, U: Wrap, V: Wrap>(texture: &Texture<'_, F>, uv: Vec2) -> Rgba8 {
        let (i, a) = position(U::reduce(uv.x), texture.width());
        let (j, b) = position(V::reduce(uv.y), texture.height());
        let (left, right) = U::neighbours(i, texture.width());
        let (low, high) = V::neighbours(j, texture.height());
        let (low, high) = (row(texture, low), row(texture, high));
        match texture.fetch_four([(left, low), (right, low), (left, high), (right, high)]) {
            Some([low_left, low_right, high_left, high_right]) => {
                bilinear(Quad { low_left, low_right, high_left, high_right }, a, b)
            }
            None => no_texel(),
        }
    }
}

/// The row, counted from the top, of one that is counted from the bottom.
#[inline]
fn row<F: TexelFormat>(texture: &Texture<'_, F>, from_bottom: u32) -> u32 {
    // `from_bottom` is less than the height.
    texture.height().wrapping_sub(from_bottom).wrapping_sub(1)
}

/// Not reached, as [`Texture::new`] compares the size with the length. A call keeps the way to the texel straight.
#[cold]
#[inline(never)]
fn no_texel() -> Rgba8 {
    Rgba8::from_bits(0)
}

/// The texel to the left of (or below) a coordinate, from -1 to twice the size less 1, and the 256ths from its centre
/// to the next.
///
/// A distance that rounds to 256 comes out as 0 from the next texel, which is the same colour.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "of 53 bits and a sign, the shift leaves 24")]
fn position(reduced: u64, size: u32) -> (i32, u64) {
    const SHIFT: u32 = FRACTION_BITS - 8;
    // Half a unit to round to nearest, less half a texel. In 39 + 14 bits and a sign.
    const OFFSET: i64 = (1 << (SHIFT - 1)) - (128 << SHIFT);

    let scaled = (reduced * u64::from(size)).cast_signed() + OFFSET;
    let position = (scaled >> SHIFT) as i32;
    (position >> 8, u64::from(position.cast_unsigned() & 255))
}
