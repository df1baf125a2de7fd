//! The continuation of a texture outside of 0 to 1.

mod any;

pub use any::AnyWrap;

use alberti_math::Rgba8;
use alberti_math::lanes::Lanes;
use core::fmt::Debug;

use crate::coordinate::{FRACTION_BITS, ONE, bounded, clamped, modulo_2, near_zero, position};
use crate::sealed::Sealed;

/// The continuation of a texture beyond its sides, along one axis: [`Repeat`], [`Clamp`], [`Mirror`] or [`Border`], and
/// [`AnyWrap`] for one that is picked at run time. Sealed.
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
/// Defined for every `f32`. The coordinate is reduced to the period first and scaled by the size afterwards, and what
/// comes out is that of exact arithmetic. So the texel does not depend on how far from 0 the texture is sampled, as far
/// as the float itself can tell. From 2^23 on, floats are integers and have no fraction.
///
/// | coordinate | `Repeat`, `Mirror` | `Clamp` | `Border` |
/// |---|---|---|---|
/// | NaN | as 0 | as 0 | outside |
/// | +infinity | as 0 | as the last below 1 | outside |
/// | -infinity | as 0 | as 0 | outside |
pub trait Wrap: Sealed + Copy + Debug + 'static {
    /// Whether the texel to the right of the last is always the first.
    const PERIODIC: bool = false;

    /// The texel that stands at the index `i` of a continued row (or column) of `size` texels: less than `size`,
    /// or 0 if `size` is 0. In [`Border`] there is none outside: `u32::MAX`.
    ///
    /// # Cost
    /// A comparison inside of the texture, a division outside, except that `Clamp` and `Border` never divide.
    fn index(self, i: i32, size: u32) -> u32;

    /// The colour outside, where indices are `u32::MAX`.
    #[inline(always)]
    fn border(self) -> Option<Rgba8> {
        None
    }

    /// The coordinate in fixed point, in one period from 0.
    fn reduce(self, u: f32) -> u64;

    /// The texel whose cell holds the reduced coordinate.
    fn cell(self, reduced: u64, size: u32) -> u32;

    /// [`index`](Self::index) of `i` and of `i + 1`, without divisions, for the texels around a reduced coordinate. `i`
    /// is -1 or more and less than the size (in `Mirror`, twice the size; in `Border`, any).
    fn neighbours(self, i: i32, size: u32) -> (u32, u32);

    /// The coordinate in one period about 0: exact. Defined for every number.
    fn in_period<L: Lanes>(self, lanes: L, u: L::Number) -> L::Number;

    /// [`index`](Self::index) of a two's complement `i` for a `size` that is a power of two, from -1 to one beyond the
    /// period; in `Border`, of any.
    fn fold<L: Lanes>(self, lanes: L, i: L::U32, size: u32) -> L::U32;

    /// The texel whose cell holds the coordinate.
    #[inline(always)]
    fn cell_at(self, u: f32, size: u32) -> u32 {
        self.cell(self.reduce(u), size)
    }

    /// The texels to the left and to the right of the coordinate. The third is the way from the centre of the one to
    /// that of the other, in `bits` bits, at most 8.
    #[inline(always)]
    fn between_at(self, u: f32, size: u32, bits: u32) -> [u32; 3] {
        let reduced = self.reduce(u);
        // Of 0 there is nothing to look at again, to which `Clamp` reduces all that are negative.
        let near = if reduced == 0 { None } else { near_zero(u, size, bits) };
        let position = near.unwrap_or_else(|| position(reduced, size, bits));
        let (left, right) = self.neighbours(position >> bits, size);
        [left, right, position.cast_unsigned() & ((1 << bits) - 1)]
    }

    /// [`cell_at`](Self::cell_at) along a side of any length: in 64 bits, one after the other.
    #[inline(always)]
    fn cell_wide<L: Lanes>(self, lanes: L, u: L::Number, size: u32) -> L::U32 {
        let in_memory = lanes.store(u);
        lanes.load_words(&lanes.each(|k| self.cell_at(at(in_memory.as_ref(), k), size)))
    }

    /// [`between_at`](Self::between_at) along a side of any length: in 64 bits, one after the other.
    ///
    /// A distance that rounds to a whole one comes out as 0 from the next texel, which is the same colour.
    #[inline(always)]
    fn between_wide<L: Lanes>(self, lanes: L, u: L::Number, size: u32, bits: u32) -> [L::U32; 3] {
        let in_memory = lanes.store(u);
        let each = lanes.each(|k| self.between_at(at(in_memory.as_ref(), k), size, bits));
        let words = |part: usize| {
            lanes.load_words(&lanes.each(|k| each.as_ref().get(k).map_or(0, |parts: &[u32; 3]| parts[part])))
        };
        [words(0), words(1), words(2)]
    }

    /// [`index`](Self::index) of each two's complement `i`.
    #[inline(always)]
    fn index_wide<L: Lanes>(self, lanes: L, i: L::U32, size: u32) -> L::U32 {
        let each = lanes.store_words(i);
        lanes.load_words(
            &lanes
                .each(|k| self.index(each.as_ref().get(k).copied().unwrap_or_default().cast_signed(), size)),
        )
    }

    /// [`cell_wide`](Self::cell_wide) along a side that is a power of two: all at once.
    #[inline(always)]
    fn cell_masked<L: Lanes>(self, lanes: L, u: L::Number, size: u32) -> L::U32 {
        self.fold(lanes, lanes.floor_scaled_finely(self.in_period(lanes, u), size.trailing_zeros(), 0), size)
    }

    /// Of the texels that [`between_wide`](Self::between_wide) finds, the right one where its share, in 256ths, and
    /// `threshold`, from 0 to 255, add up to one.
    #[inline(always)]
    fn either_wide<L: Lanes>(self, lanes: L, u: L::Number, size: u32, threshold: L::U32) -> L::U32 {
        let [left, right, along] = self.between_wide(lanes, u, size, 8);
        left + (right - left) * lanes.shr(along + threshold, 8)
    }

    /// [`either_wide`](Self::either_wide) along a side that is a power of two: all at once.
    #[inline(always)]
    fn either_masked<L: Lanes>(self, lanes: L, u: L::Number, size: u32, threshold: L::U32) -> L::U32 {
        either(self, lanes, self.in_period(lanes, u), size, threshold)
    }

    /// [`between_wide`](Self::between_wide) along a side that is a power of two: all at once.
    #[inline(always)]
    fn between_masked<L: Lanes>(self, lanes: L, u: L::Number, size: u32, bits: u32) -> [L::U32; 3] {
        // In 512ths of a texel. Half a step more rounds to the nearest, halves up; half a texel to the left lies the
        // centre from which distances count, and a texel more keeps them positive.
        let way = lanes.floor_scaled_finely(self.in_period(lanes, u), size.trailing_zeros(), 9)
            + lanes.word(256 + (256 >> bits));
        let right = lanes.shr_signed(way, 9);
        [
            self.fold(lanes, right - lanes.word(1), size),
            self.fold(lanes, right, size),
            lanes.shr(way, 9 - bits) & lanes.word((1 << bits) - 1),
        ]
    }
}

/// [`Wrap::either_masked`] of a coordinate in the period.
#[inline(always)]
fn either<W: Wrap, L: Lanes>(wrap: W, lanes: L, u: L::Number, size: u32, threshold: L::U32) -> L::U32 {
    // As in `between_masked`: in 512ths, of which half a step more rounds, from the centre half a texel to the left.
    let way = lanes.floor_scaled_finely(u, size.trailing_zeros(), 9);
    wrap.fold(lanes, lanes.shr_signed(way + lanes.shl(threshold, 1) - lanes.word(255), 9), size)
}

/// Element `k`, which there is.
#[inline(always)]
fn at(values: &[f32], k: usize) -> f32 {
    values.get(k).copied().unwrap_or_default()
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

/// A colour of its own outside of the texture; the default is transparent black. Where both axes have a border and are
/// outside, it is that of u.
///
/// Filters blend with it: a bilinear colour fades to the border over the texel's width about a side.
///
/// ```
/// use alberti_texture::{Border, Nearest, Texture, format::{L8, Rgba8}};
///
/// const RED: Rgba8 = Rgba8::new(255, 0, 0, 255);
/// let sampler = Texture::new(L8, &[255], 1, 1)?.sampler(Nearest, Border(RED));
/// assert_eq!(sampler.sample([0.5, 0.5].into()), Rgba8::WHITE);
/// assert_eq!(sampler.sample([1.5, 0.5].into()), RED);
/// # Ok::<(), alberti_texture::TextureError>(())
/// ```
///
/// # Cost
/// Three operations a texel more for each axis than [`Clamp`] on all lanes at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Border(
    /// The colour.
    pub Rgba8,
);

impl Sealed for Repeat {}
impl Sealed for Clamp {}
impl Sealed for Mirror {}
impl Sealed for Border {}

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

impl Wrap for Repeat {
    const PERIODIC: bool = true;

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "less than the size")]
    fn index(self, i: i32, size: u32) -> u32 {
        inside(i, size).unwrap_or_else(|| remainder(i, 1, size) as u32)
    }

    #[inline]
    fn reduce(self, u: f32) -> u64 {
        modulo_2(u) & (ONE - 1)
    }

    #[inline]
    fn cell(self, reduced: u64, size: u32) -> u32 {
        scale(reduced, size)
    }

    #[inline]
    fn neighbours(self, i: i32, size: u32) -> (u32, u32) {
        let next = i.wrapping_add(1).cast_unsigned();
        let first = if next == 0 { size } else { next };
        (first.wrapping_sub(1), if next == size { 0 } else { next })
    }

    #[inline(always)]
    fn in_period<L: Lanes>(self, lanes: L, u: L::Number) -> L::Number {
        lanes.wrap(u, 0)
    }

    #[inline(always)]
    fn fold<L: Lanes>(self, lanes: L, i: L::U32, size: u32) -> L::U32 {
        i & lanes.word(size.wrapping_sub(1))
    }

    #[inline(always)]
    fn cell_masked<L: Lanes>(self, lanes: L, u: L::Number, size: u32) -> L::U32 {
        let cell = lanes.floor_fraction_scaled(u, size.trailing_zeros());
        // In fixed point it is one of the texture already.
        if L::FIXED { cell } else { self.fold(lanes, cell, size) }
    }

    // In fixed point the shifts of a scaling drop what is above the period.
    #[inline(always)]
    fn either_masked<L: Lanes>(self, lanes: L, u: L::Number, size: u32, threshold: L::U32) -> L::U32 {
        let u = if L::FIXED { u } else { self.in_period(lanes, u) };
        either(self, lanes, u, size, threshold)
    }

    // Without the texel more, as the remainder of negative numbers is what is sought.
    #[inline(always)]
    fn between_masked<L: Lanes>(self, lanes: L, u: L::Number, size: u32, bits: u32) -> [L::U32; 3] {
        let way = lanes.floor_scaled_finely(self.in_period(lanes, u), size.trailing_zeros(), 9)
            + lanes.word((256_u32 >> bits).wrapping_sub(256));
        let left = lanes.shr_signed(way, 9);
        let right = self.fold(lanes, left + lanes.word(1), size);
        [self.fold(lanes, left, size), right, lanes.shr(way, 9 - bits) & lanes.word((1 << bits) - 1)]
    }
}

impl Wrap for Clamp {
    #[inline]
    fn index(self, i: i32, size: u32) -> u32 {
        u32::try_from(i).unwrap_or(0).min(size.saturating_sub(1))
    }

    #[inline]
    fn reduce(self, u: f32) -> u64 {
        clamped(u)
    }

    #[inline]
    fn cell(self, reduced: u64, size: u32) -> u32 {
        scale(reduced, size)
    }

    #[inline]
    fn neighbours(self, i: i32, size: u32) -> (u32, u32) {
        let next = i.wrapping_add(1).cast_unsigned();
        (next.saturating_sub(1), next.min(size.wrapping_sub(1)))
    }

    #[inline(always)]
    fn in_period<L: Lanes>(self, lanes: L, u: L::Number) -> L::Number {
        lanes.min(lanes.max(u, lanes.splat(0.0)), lanes.splat(1.0))
    }

    #[inline(always)]
    fn fold<L: Lanes>(self, lanes: L, i: L::U32, size: u32) -> L::U32 {
        // -1 becomes 0, as the least of two words: itself, or the word after it less 1, at least 0.
        let next = i + lanes.word(1);
        lanes.min_words(next - lanes.min_words(next, lanes.word(1)), lanes.word(size.wrapping_sub(1)))
    }
}

impl Wrap for Mirror {
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the lesser of two that add up to twice the size, less 1"
    )]
    fn index(self, i: i32, size: u32) -> u32 {
        inside(i, size).unwrap_or_else(|| {
            let i = remainder(i, 2, size);
            i.min((2 * u64::from(size)).saturating_sub(1).saturating_sub(i)) as u32
        })
    }

    #[inline]
    fn reduce(self, u: f32) -> u64 {
        modulo_2(u)
    }

    #[inline]
    fn cell(self, reduced: u64, size: u32) -> u32 {
        let i = scale(reduced, size);
        i.min(size.wrapping_mul(2).wrapping_sub(1).wrapping_sub(i))
    }

    #[inline]
    fn neighbours(self, i: i32, size: u32) -> (u32, u32) {
        let last = size.wrapping_mul(2).wrapping_sub(1).cast_signed();
        // The lesser of an index and its image is the one in the texture, or -1 for the texel 0.
        let fold = |i: i32| i.min(last.wrapping_sub(i)).max(0).cast_unsigned();
        (fold(i), fold(i.wrapping_add(1)))
    }

    #[inline(always)]
    fn in_period<L: Lanes>(self, lanes: L, u: L::Number) -> L::Number {
        lanes.wrap(u, 1)
    }

    #[inline(always)]
    fn fold<L: Lanes>(self, lanes: L, i: L::U32, size: u32) -> L::U32 {
        let last = lanes.word(size.wrapping_mul(2).wrapping_sub(1));
        let i = i & last;
        lanes.min_words(i, last - i)
    }
}

impl Wrap for Border {
    #[inline]
    fn index(self, i: i32, size: u32) -> u32 {
        if size == 0 { 0 } else { inside(i, size).unwrap_or(u32::MAX) }
    }

    #[inline(always)]
    fn border(self) -> Option<Rgba8> {
        Some(self.0)
    }

    /// In two's complement, clamped to where nothing but the border counts for any size.
    #[inline]
    fn reduce(self, u: f32) -> u64 {
        let u = if u > BORDER_BEGIN { u } else { BORDER_BEGIN };
        bounded(if u < BORDER_END { u } else { BORDER_END })
    }

    #[inline]
    fn cell(self, reduced: u64, size: u32) -> u32 {
        self.index(((reduced.cast_signed() * i64::from(size)) >> FRACTION_BITS) as i32, size)
    }

    #[inline]
    fn neighbours(self, i: i32, size: u32) -> (u32, u32) {
        (self.index(i, size), self.index(i.wrapping_add(1), size))
    }

    #[inline(always)]
    fn in_period<L: Lanes>(self, lanes: L, u: L::Number) -> L::Number {
        lanes.min(lanes.max(u, lanes.splat(BORDER_BEGIN)), lanes.splat(BORDER_END))
    }

    #[inline(always)]
    fn fold<L: Lanes>(self, lanes: L, i: L::U32, size: u32) -> L::U32 {
        // Negative indices are the greatest of words, so the difference is negative inside and 0 outside.
        let size = lanes.word(size);
        let inside = lanes.shr_signed(lanes.min_words(i, size) - size, 31);
        (i & inside) | (lanes.word(u32::MAX) - inside)
    }
}

/// Half a texture, and so at least half a texel, beyond either side.
const BORDER_BEGIN: f32 = -0.5;
const BORDER_END: f32 = 1.5;

#[cfg(test)]
mod tests {
    use super::*;

    /// The walk that sampling takes, against the definition.
    #[test]
    fn neighbours_are_indices() {
        fn check<W: Wrap>(wrap: W, i: i32, size: u32) {
            let expected = (wrap.index(i, size), wrap.index(i + 1, size));
            assert_eq!(wrap.neighbours(i, size), expected, "{wrap:?}, {i} of {size}");
        }
        for size in (1..=70u32).chain([255, 256, 1000, 16383, 16384]) {
            let signed = size.cast_signed();
            for i in -1..signed {
                check(Repeat, i, size);
                check(Clamp, i, size);
            }
            (-1..2 * signed).for_each(|i| check(Mirror, i, size));
            (-signed..2 * signed).for_each(|i| check(Border(Rgba8::from_bits(7)), i, size));
        }
    }
}
