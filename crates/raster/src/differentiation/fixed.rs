//! Derivatives in integers of 32 bits, for machines without floating point.
//!
//! With λ the barycentric coordinates, d their changes by a pixel times twice the area A, and p the shares of the
//! vertices,
//!
//! ```text
//! u  = Σ pi ui           pi = λi qi / T, which add up to 1             T = Σ λi qi
//! ∂u = ∂pb (ub − ua) + ∂pc (uc − ua)
//! ∂pb = ((qb − (qb − qa) pb) db − (qc − qa) pb dc) / (T A)             ∂pc likewise
//! ```
//!
//! # Precision
//! Errors are in units of 2^-13 of N, see [`Differentiation`](super::Differentiation). Distances rounded down are worth
//! 2, as where one changes ∂u does by up to 2^-13 N; multiples of q 1.5. Shares are up to 1.2 too small, which is 2.3
//! of both. One over T A is within 1.5, and the two shares times it are 1 too small. Of the four factors of distances 2
//! come from rounding, of the two ∂p 4, and of the two differences of components 4. That is 18.3, less than 32.
//!
//! Beside these, λ and the multiples of q have T off by up to seven units of 2^-29 of the greatest q, and u by
//! 9 r 2^-29 Δu. As parts of N they are 7 r 2^-29 and 9 r 2^-29, to the first order, and less than r 2^-24 up to r of
//! 2^25. At the centroid, where r is at most 3, λ are exact.
//!
//! All sums fit 32 bits. N is the most that ∂u is, and comes to lie below 2^30. A ∂p is the ∂u of a component that is 1
//! at its vertex, and 0 at the others.
#![expect(missing_debug_implementations, reason = "states of drawing, which have no name outside")]

use super::{Quotients, Samples, of_pairs};
use crate::edge::EdgeInt;
use crate::interpolation::{Area, Oriented, Row};
use crate::spans::Span;
use crate::triangle::Corners;
use alberti_math::lanes::OneFixed;
use alberti_math::{Gradient, LOW_WORDS_ONLY, Mode, Q16, Varying, high, map2, map3, reciprocal_of_half};

/// Bits of distances.
const DISTANCE: u32 = 14;
/// Bits of factors: of q, shares, and differences of a component between vertices.
const FACTOR: u32 = 15;

/// The quotients of a triangle, in integers.
#[derive(Clone, Copy)]
pub struct FixedQuotients<V: Varying> {
    area: Area,
    /// Multiples of q, the greatest of them from 2^29 to 2^30.
    q: [u32; 3],
    distances: Distances,
    /// Of each component the differences of the second and the third vertex from the first.
    differences: V::Of<[i32; 2]>,
}

impl<V: Varying> Quotients<OneFixed, V> for FixedQuotients<V> {
    type Area = Area;
    type Run = V::Of<[Q16; 2]>;

    #[inline(always)]
    fn area(doubled: i64) -> Area {
        Area::new(doubled)
    }

    #[inline(always)]
    fn new(triangle: &Oriented<'_, V>, area: Area) -> Self {
        Self {
            area,
            q: multiples(map3(triangle.vertices, |vertex| vertex.q)),
            distances: Distances::new(&triangle.corners, triangle.bits, &area),
            differences: differences(triangle),
        }
    }

    /// Not inlined, as it is long: compilers would find parts of it before the first row, and keep them in memory.
    #[inline(never)]
    fn in_centroid(_: OneFixed, triangle: &Oriented<'_, V>, area: Area) -> V::Of<[Q16; 2]> {
        let Oriented { vertices, corners, bits, .. } = triangle;
        let hyperbolic = Shares::in_centroid(map3(*vertices, |vertex| vertex.q), corners, *bits, &area);
        let linear = || Distances::new(corners, *bits, &area).of_weights(&area);
        derivatives::<V>(&differences(triangle), &hyperbolic, linear)
    }

    #[inline(always)]
    fn in_middle<I: EdgeInt>(&self, _: OneFixed, row: &Row<'_, I>, run: Span) -> V::Of<[Q16; 2]> {
        let column = run.start + ((run.end - run.start) >> 1);
        let [_, b, c] = row.at(column);
        let Area { dropped, normalizing, quotient } = self.area;
        // λ in units of 2^-31: the last two are rounded down, so that the first is not negative.
        let [b, c] = map2([b, c], |e: I| high(e.without_last(dropped) << (normalizing & 31), quotient));
        let a = (1_u32 << 31).wrapping_sub(b).wrapping_sub(c);
        let [qa, qb, qc] = map3(self.q, |q| q << 1);
        let [a, b, c] = [high(a, qa), high(b, qb), high(c, qc)];
        let t = a.wrapping_add(b).wrapping_add(c).max(1);
        let place = Place { parts: [b, c], t, zeros: t.leading_zeros(), per_area: quotient >> 16, bits: 0 };
        derivatives::<V>(&self.differences, &Shares::new(self.q, &place, || self.distances), || {
            self.distances.of_weights(&self.area)
        })
    }

    #[inline(always)]
    fn run<I: EdgeInt>(&self, lanes: OneFixed, row: &Row<'_, I>, run: Span) -> V::Of<[Q16; 2]> {
        self.in_middle(lanes, row, run)
    }

    #[inline(always)]
    fn at(&self, _: OneFixed, run: &V::Of<[Q16; 2]>, _: &Samples<'_, OneFixed, V>) -> Gradient<V::Of<Q16>> {
        of_pairs::<V, _>(run)
    }
}

/// The increments of the edge functions of the second and the third vertex, by column and by row, in `DISTANCE` bits.
#[derive(Clone, Copy)]
struct Distances {
    by: [[i32; 2]; 2],
    /// The bits that they have too many of over the area and by pixel, once that has 32.
    shift: i32,
}

impl Distances {
    #[inline(always)]
    fn new(&[a, b, c]: &Corners, bits: u32, area: &Area) -> Self {
        let by = [[c[1] - a[1], a[1] - b[1]], [a[0] - c[0], b[0] - a[0]]];
        let [[p, q], [r, s]] = by.map(|along| map2(along, magnitude));
        let zeros = (p | q | r | s).leading_zeros();
        // Below 2^30 each.
        let shifted = |distance: i32| distance << (zeros.wrapping_sub(2) & 31);
        Self {
            by: by.map(|along| map2(along, |distance| shifted(distance) >> (30 - DISTANCE))),
            shift: (zeros + area.dropped).cast_signed() - (area.normalizing + bits).cast_signed(),
        }
    }

    /// The derivatives of shares that are weights, as where all q are the same.
    #[inline(always)]
    fn of_weights(&self, area: &Area) -> Shares {
        let per_area = (area.quotient >> (32 - FACTOR)).cast_signed();
        let by = self.by.map(|along| map2(along, |distance| (distance * per_area) >> DISTANCE));
        Shares { by, shift: self.shift - 1 }
    }
}

/// A place, by its parts of T: a weight times a multiple of q each.
#[derive(Clone, Copy)]
struct Place {
    /// Those of the second and the third vertex.
    parts: [u32; 2],
    /// The sum of all three.
    t: u32,
    /// Its leading zeros.
    zeros: u32,
    /// One over the area, in 16 bits, times what the parts are too great by.
    per_area: u32,
    /// The bits of that which go.
    bits: i32,
}

/// The derivatives of the shares of the second and the third vertex, by column and by row.
#[derive(Clone, Copy)]
struct Shares {
    by: [[i32; 2]; 2],
    /// The bits that their products with a component have too many of.
    shift: i32,
}

impl Shares {
    /// Those at a place.
    #[inline(always)]
    fn new(q: [u32; 3], place: &Place, distances: impl FnOnce() -> Distances) -> Self {
        let Place { parts, t, zeros, per_area, bits } = *place;
        let shifted = |part: u32| part << (zeros & 31);
        let per_t = reciprocal_of_half(shifted(t) >> 16) >> 1;
        let per_both = per_t * per_area;
        let normalizing = zeros_of_two(per_both);
        let per_both = (per_both << normalizing >> (32 - FACTOR)).cast_signed();
        let [b, c] = map2(parts, |part| {
            let share = ((shifted(part) >> (32 - FACTOR)) * per_t) >> FACTOR;
            (share.cast_signed() * per_both) >> FACTOR
        });
        let [qa, qb, qc] = map3(q, |q| (q >> (30 - FACTOR)).cast_signed());
        let [more_b, more_c] = [qb - qa, qc - qa];
        let factors = [[qb * per_both - more_b * b, -more_c * b], [-more_b * c, qc * per_both - more_c * c]]
            .map(|share| map2(share, |factor| factor >> DISTANCE));
        // Found as late as this, as small cores have few registers.
        let Distances { by, shift } = distances();
        Self {
            by: by.map(|[b, c]| map2(factors, |[of_b, of_c]| (b * of_b + c * of_c) >> FACTOR)),
            shift: shift + normalizing.cast_signed() - zeros.cast_signed() - bits,
        }
    }

    /// Those at the centroid. Not inlined, for the registers of small cores.
    #[inline(never)]
    fn in_centroid(q: [u32; 3], corners: &Corners, bits: u32, area: &Area) -> Self {
        let q = multiples(q);
        let t = q[0] + q[1] + q[2];
        // All λ are a third; so parts are three times as great as they were, and a quarter of three goes with the area.
        let per_area = ((area.quotient >> 16) * 3) >> 2;
        let place = Place { parts: [q[1], q[2]], t, zeros: zeros_of_two(t), per_area, bits: 2 };
        Self::new(q, &place, || Distances::new(corners, bits, area))
    }
}

/// Of each component the differences of the second and the third vertex from the first. They are below 2^29.
#[inline(always)]
fn differences<V: Varying>(triangle: &Oriented<'_, V>) -> V::Of<[i32; 2]> {
    V::map(&triangle.words(), &|[a, b, c, _]: [u32; 4]| {
        map2([b, c], |other| other.wrapping_sub(a).cast_signed())
    })
}

/// The derivatives of components with these differences.
#[inline(always)]
fn derivatives<V: Varying>(
    differences: &V::Of<[i32; 2]>,
    hyperbolic: &Shares,
    linear: impl Fn() -> Shares,
) -> V::Of<[Q16; 2]> {
    V::map_by_mode(differences, &|mode, more: [i32; 2]| {
        let Shares { by, shift } = match mode {
            Mode::Hyperbolic => *hyperbolic,
            Mode::Linear => linear(),
            Mode::Flat => return [Q16::ZERO; 2],
        };
        // Below 2^30 each.
        let zeros = zeros_in_fours((magnitude(more[0]) | magnitude(more[1])) << 2);
        let [b, c] = map2(more, |more| cut(more << (zeros & 31), 30 - FACTOR));
        let shift = shift + zeros.cast_signed();
        map2(by, |[of_b, of_c]| Q16::from_bits(without(b * of_b + c * of_c, shift)))
    })
}

/// Multiples of three numbers, positive `f32`, rounded down: the greatest comes to lie from 2^29 to 2^30.
#[inline(always)]
fn multiples(q: [u32; 3]) -> [u32; 3] {
    // Positive floats are ordered as their words are.
    let greatest = q[0].max(q[1]).max(q[2]) >> 23;
    if greatest < 32 {
        return small_multiples(q);
    }
    // Subnormal ones, which have no highest bit, are nothing beside the greatest.
    map3(q, |q| ((q << 8 | 1 << 31) >> (greatest - (q >> 23)).min(31)) >> 2)
}

/// The same of numbers below 2^-95, which may be subnormal.
#[cold]
#[inline(never)]
fn small_multiples(q: [u32; 3]) -> [u32; 3] {
    // In units of 2^-149, below 2^55.
    let words = map3(q, |q| {
        let (exponent, fraction) = (q >> 23, u64::from(q & 0x7f_ffff));
        if exponent == 0 { fraction } else { (fraction | 1 << 23) << ((exponent - 1) & 31) }
    });
    let zeros = (words[0] | words[1] | words[2]).leading_zeros() & 63;
    map3(words, |q| ((q << zeros) >> 34) as u32)
}

/// A number without its sign, or one less.
#[inline(always)]
fn magnitude(x: i32) -> u32 {
    (x ^ (x >> 31)).cast_unsigned()
}

/// The leading zeros of a number, or up to three fewer: a multiple of four up to 28. Cores that have no instruction for
/// it take three steps, where all of them are a call.
#[inline(always)]
fn zeros_in_fours(x: u32) -> u32 {
    if LOW_WORDS_ONLY { by_steps(x) } else { (x | 1).leading_zeros() & !3 }
}

#[inline(always)]
fn by_steps(mut x: u32) -> u32 {
    let mut zeros = 0;
    for step in [16, 8, 4] {
        if x >> (32 - step) == 0 {
            (x, zeros) = (x << step, zeros + step);
        }
    }
    zeros
}

/// The leading zeros of a number that has at most two.
#[inline(always)]
fn zeros_of_two(x: u32) -> u32 {
    if LOW_WORDS_ONLY { (!x >> 31) + u32::from(x >> 30 == 0) } else { x.leading_zeros() }
}

/// A number without its last bits, to the nearest.
#[inline(always)]
fn cut(x: i32, bits: u32) -> i32 {
    (x + (1 << bits >> 1)) >> bits
}

/// The same of a number up to 2^30; if they are fewer than none, with as many more, or the greatest of its sign.
#[inline(always)]
fn without(x: i32, bits: i32) -> i32 {
    if (0..=30).contains(&bits) { cut(x, bits.cast_unsigned()) } else { beyond(x, bits) }
}

#[cold]
#[inline(never)]
fn beyond(x: i32, bits: i32) -> i32 {
    if bits > 0 || x == 0 {
        return 0;
    }
    let more = bits.wrapping_neg().cast_unsigned();
    let fits = more < 31 && (x << more) >> more == x;
    if fits { x << more } else { (x >> 31) ^ i32::MAX }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_are_the_same_on_all_cores() {
        for x in (0..32).flat_map(|k| [(1_u32 << k) - 1, 1 << k, (1 << k) + 1]).chain([u32::MAX]) {
            assert_eq!(by_steps(x), (x | 1).leading_zeros() & !3, "{x}");
        }
        for x in [1 << 29, (1 << 30) - 1, 1 << 30, (1 << 31) - 1, 1 << 31, u32::MAX] {
            assert_eq!((!x >> 31) + u32::from(x >> 30 == 0), x.leading_zeros(), "{x}");
        }
    }

    #[test]
    fn multiples_are_those_of_the_numbers() {
        let tiny = [1, 3, 0x7f_ffff, 0x80_0000, 0x80_0001, 31 << 23, 0x0fff_ffff];
        let usual = [32 << 23, 0x3f80_0000, 0x3f80_0001, 0x7f00_0000, 0x7f7f_ffff];
        let all = || tiny.into_iter().chain(usual);
        for (a, b, c) in all().flat_map(|a| all().flat_map(move |b| all().map(move |c| (a, b, c)))) {
            let found = multiples([a, b, c]).map(f64::from);
            let exact = [a, b, c].map(|word: u32| f64::from(f32::from_bits(word)));
            let greatest = (0..3).fold(0, |k, other| if exact[other] > exact[k] { other } else { k });
            assert!((f64::from(1 << 29)..f64::from(1 << 30)).contains(&found[greatest]));
            // Powers of two apart from the numbers, rounded down.
            let scale = f64::from(1 << 29) / exact[greatest].log2().floor().exp2();
            for (found, exact) in found.into_iter().zip(exact) {
                assert_eq!(found, (exact * scale).floor(), "{a:x} {b:x} {c:x}");
            }
        }
    }
}
