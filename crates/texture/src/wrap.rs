//! What a texture is outside of 0 to 1.

use alberti_math::lanes::Lanes;
use core::fmt::Debug;

use crate::coordinate::{FRACTION_BITS, ONE, bounded, clamped, modulo_2};

/// The continuation of a texture beyond its sides, along one axis: [`Repeat`], [`Clamp`], [`Mirror`] or [`Border`].
/// Other crates cannot add to them.
///
/// ```text
///            -1        0         1         2        3
///   Repeat    | A B C D | A B C D | A B C D | A B C D |
///   Mirror    | D C B A | A B C D | D C B A | A B C D |
///   Clamp     | A A A A | A B C D | D D D D | D D D D |
///   Border    |         | A B C D |         |         |      a colour of its own outside
/// ```
///
/// # Precision
/// Defined for every `f32`. The coordinate is reduced to the period first and scaled by the size afterwards, and
/// both are exact, so the texel does not depend on how far from 0 the texture is sampled, as far as the float itself
/// can tell: from 2^23 on, floats are integers and have no fraction.
///
/// | coordinate | `Repeat`, `Mirror` | `Clamp` | `Border` |
/// |---|---|---|---|
/// | NaN | as 0 | as 0 | outside |
/// | +infinity | as 0 | as the last below 1 | outside |
/// | -infinity | as 0 | as 0 | outside |
pub trait Wrap: Axis + Copy + Debug + Default + 'static {
    /// The texel that stands at the index `i` of a continued row (or column) of `size` texels: less than `size`,
    /// or 0 if `size` is 0. In [`Border`] there is none outside: `u32::MAX`.
    ///
    /// # Cost
    /// A comparison inside of the texture, a division outside, except that `Clamp` and `Border` never divide.
    fn index(i: i32, size: u32) -> u32;
}

/// The part of [`Wrap`] that works on fixed-point coordinates; not nameable outside, so that it can still change.
pub trait Axis {
    /// The colour, as a word, that is outside: where indices are `u32::MAX`.
    const BORDER: Option<u32> = None;

    /// The coordinate in fixed point, in one period from 0.
    fn reduce(u: f32) -> u64;

    /// The texel whose cell holds the reduced coordinate.
    fn cell(reduced: u64, size: u32) -> u32;

    /// [`Wrap::index`] of `i` and of `i + 1`, without divisions, for the texels around a reduced coordinate: `i` is
    /// -1 or more and less than the size (in `Mirror`, twice the size; in `Border`, any).
    fn neighbours(i: i32, size: u32) -> (u32, u32);

    /// The coordinate in one period about 0: exact. Defined for every number.
    fn in_period<L: Lanes>(lanes: L, u: L::Number) -> L::Number;

    /// [`Wrap::index`] of a two's complement `i` for a `size` that is a power of two, from -1 to one beyond the period;
    /// in `Border`, of any.
    fn fold<L: Lanes>(lanes: L, i: L::U32, size: u32) -> L::U32;
}

/// The texture again and again: only the fraction of the coordinate counts, 1 is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Repeat;

/// The texels at the border, for ever.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Clamp;

/// The texture and its mirror image in turn; neighbouring copies share the colour at their border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Mirror;

/// A colour of its own outside of the texture: `COLOR`, as [`Rgba8::to_bits`](crate::format::Rgba8::to_bits) makes it,
/// transparent black if none is named. Where both axes have a border and are outside, it is that of u.
///
/// Filters blend with it: a bilinear colour fades to the border over the texel's width about a side.
///
/// ```
/// use alberti_texture::{Border, Nearest, Texture, format::{L8, Rgba8}};
///
/// const RED: u32 = Rgba8::new(255, 0, 0, 255).to_bits();
/// let texture = Texture::<L8>::new(&[255], 1, 1)?;
/// let sampler = texture.sampler::<Nearest, Border<RED>>();
/// assert_eq!(sampler.sample([0.5, 0.5].into()), Rgba8::WHITE);
/// assert_eq!(sampler.sample([1.5, 0.5].into()).to_bits(), RED);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Cost
/// Three operations a texel more for each axis than [`Clamp`] on all lanes at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Border<const COLOR: u32 = 0>;

/// floor(coordinate * size).
#[inline]
fn scale(reduced: u64, size: u32) -> u32 {
    // Of 39 + 14 bits, the shift leaves 15.
    ((reduced * u64::from(size)) >> FRACTION_BITS) as u32
}

/// `Some(i)` inside of the texture.
#[inline]
fn inside(i: i32, size: u32) -> Option<u32> {
    // Negative indices are 2^31 and more as unsigned. Sizes of textures are known to be less, and one comparison stays.
    let i = i.cast_unsigned();
    (i < size.min(1 << 31)).then_some(i)
}

/// The least non-negative remainder of `i` modulo `copies * size`, or 0 if that is 0.
#[inline]
fn remainder(i: i32, copies: u32, size: u32) -> u64 {
    // `max` leaves no case of a division by zero.
    let period = (i64::from(copies) * i64::from(size)).max(1);
    i64::from(i).rem_euclid(period).unsigned_abs()
}

impl Axis for Repeat {
    #[inline]
    fn reduce(u: f32) -> u64 {
        modulo_2(u) & (ONE - 1)
    }

    #[inline]
    fn cell(reduced: u64, size: u32) -> u32 {
        scale(reduced, size)
    }

    #[inline]
    fn neighbours(i: i32, size: u32) -> (u32, u32) {
        let next = i.wrapping_add(1).cast_unsigned();
        let first = if next == 0 { size } else { next };
        (first.wrapping_sub(1), if next == size { 0 } else { next })
    }

    #[inline(always)]
    fn in_period<L: Lanes>(lanes: L, u: L::Number) -> L::Number {
        lanes.wrap(u, 0)
    }

    #[inline(always)]
    fn fold<L: Lanes>(lanes: L, i: L::U32, size: u32) -> L::U32 {
        i & lanes.word(size.wrapping_sub(1))
    }
}

impl Wrap for Repeat {
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "less than the size")]
    fn index(i: i32, size: u32) -> u32 {
        inside(i, size).unwrap_or_else(|| remainder(i, 1, size) as u32)
    }
}

impl Axis for Clamp {
    #[inline]
    fn reduce(u: f32) -> u64 {
        clamped(u)
    }

    #[inline]
    fn cell(reduced: u64, size: u32) -> u32 {
        scale(reduced, size)
    }

    #[inline]
    fn neighbours(i: i32, size: u32) -> (u32, u32) {
        let next = i.wrapping_add(1).cast_unsigned();
        (next.saturating_sub(1), next.min(size.wrapping_sub(1)))
    }

    #[inline(always)]
    fn in_period<L: Lanes>(lanes: L, u: L::Number) -> L::Number {
        lanes.min(lanes.max(u, lanes.splat(0.0)), lanes.splat(1.0))
    }

    #[inline(always)]
    fn fold<L: Lanes>(lanes: L, i: L::U32, size: u32) -> L::U32 {
        // -1 becomes 0, as the least of two words: itself, or the word after it less 1, at least 0.
        let next = i + lanes.word(1);
        lanes.min_words(next - lanes.min_words(next, lanes.word(1)), lanes.word(size.wrapping_sub(1)))
    }
}

impl Wrap for Clamp {
    #[inline]
    fn index(i: i32, size: u32) -> u32 {
        u32::try_from(i).unwrap_or(0).min(size.saturating_sub(1))
    }
}

impl Axis for Mirror {
    #[inline]
    fn reduce(u: f32) -> u64 {
        modulo_2(u)
    }

    #[inline]
    fn cell(reduced: u64, size: u32) -> u32 {
        let i = scale(reduced, size);
        i.min(size.wrapping_mul(2).wrapping_sub(1).wrapping_sub(i))
    }

    #[inline]
    fn neighbours(i: i32, size: u32) -> (u32, u32) {
        let last = size.wrapping_mul(2).wrapping_sub(1).cast_signed();
        // The lesser of an index and its image is the one in the texture, or -1 for the texel 0.
        let fold = |i: i32| i.min(last.wrapping_sub(i)).max(0).cast_unsigned();
        (fold(i), fold(i.wrapping_add(1)))
    }

    #[inline(always)]
    fn in_period<L: Lanes>(lanes: L, u: L::Number) -> L::Number {
        lanes.wrap(u, 1)
    }

    #[inline(always)]
    fn fold<L: Lanes>(lanes: L, i: L::U32, size: u32) -> L::U32 {
        let last = lanes.word(size.wrapping_mul(2).wrapping_sub(1));
        let i = i & last;
        lanes.min_words(i, last - i)
    }
}

impl Wrap for Mirror {
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the lesser of two that add up to twice the size, less 1"
    )]
    fn index(i: i32, size: u32) -> u32 {
        inside(i, size).unwrap_or_else(|| {
            let i = remainder(i, 2, size);
            i.min((2 * u64::from(size)).saturating_sub(1).saturating_sub(i)) as u32
        })
    }
}

impl<const COLOR: u32> Axis for Border<COLOR> {
    const BORDER: Option<u32> = Some(COLOR);

    /// In two's complement, clamped to where nothing but the border counts for any size.
    #[inline]
    fn reduce(u: f32) -> u64 {
        let u = if u > BORDER_BEGIN { u } else { BORDER_BEGIN };
        bounded(if u < BORDER_END { u } else { BORDER_END })
    }

    #[inline]
    fn cell(reduced: u64, size: u32) -> u32 {
        Self::index(((reduced.cast_signed() * i64::from(size)) >> FRACTION_BITS) as i32, size)
    }

    #[inline]
    fn neighbours(i: i32, size: u32) -> (u32, u32) {
        (Self::index(i, size), Self::index(i.wrapping_add(1), size))
    }

    #[inline(always)]
    fn in_period<L: Lanes>(lanes: L, u: L::Number) -> L::Number {
        lanes.min(lanes.max(u, lanes.splat(BORDER_BEGIN)), lanes.splat(BORDER_END))
    }

    #[inline(always)]
    fn fold<L: Lanes>(lanes: L, i: L::U32, size: u32) -> L::U32 {
        // Negative indices are the greatest of words, so the difference is negative inside and 0 outside.
        let size = lanes.word(size);
        let inside = lanes.shr_signed(lanes.min_words(i, size) - size, 31);
        (i & inside) | (lanes.word(u32::MAX) - inside)
    }
}

/// Half a texture, and so at least half a texel, beyond either side.
const BORDER_BEGIN: f32 = -0.5;
const BORDER_END: f32 = 1.5;

impl<const COLOR: u32> Wrap for Border<COLOR> {
    #[inline]
    fn index(i: i32, size: u32) -> u32 {
        if size == 0 { 0 } else { inside(i, size).unwrap_or(u32::MAX) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The walk that sampling takes, against the definition.
    #[test]
    fn neighbours_are_indices() {
        fn check<W: Wrap>(i: i32, size: u32) {
            let expected = (W::index(i, size), W::index(i + 1, size));
            assert_eq!(W::neighbours(i, size), expected, "{:?}, {i} of {size}", W::default());
        }
        for size in (1..=70u32).chain([255, 256, 1000, 16383, 16384]) {
            let signed = size.cast_signed();
            for i in -1..signed {
                check::<Repeat>(i, size);
                check::<Clamp>(i, size);
            }
            (-1..2 * signed).for_each(|i| check::<Mirror>(i, size));
            (-signed..2 * signed).for_each(|i| check::<Border<7>>(i, size));
        }
    }
}
