//! Derivatives in integers of 32 bits, for machines without floating point.

use crate::differentiation::Words;
use crate::edge::EdgeInt;
use crate::interpolation::{Oriented, Row, relative};
use crate::spans::Span;
use alberti_math::{Mode, Q16, Varying, high, map2, map3, reciprocal};

/// Bits of what is multiplied: distances, differences of a component between vertices, and factors of these.
const BITS: u32 = 14;
/// Bits of shares.
const SHARE: u32 = 15;

/// The quotients of a triangle, in integers.
///
/// With λ the barycentric coordinates, whose derivatives are distances over twice the area, and g = q/T,
///
/// ```text
/// u  = Σ pi ui                pi = λi gi, which add up to 1
/// ∂u = Σ gi (ui − u) ∂λi      ∂λa = −∂λb − ∂λc
/// ```
///
/// # Precision
/// Errors are in units of 2^-13 of N, see [`Differentiation`](super::Differentiation); of two numbers the second holds
/// at the centroid. Shares are within 2.3 of 2^-15, so that u is off by 3.3. Of this two g take a difference. With
/// their own rounding, that of the two u and that of the sum, what stands before a ∂λ is off by 9.1, and 11.1. There
/// are two of these. Distances, the sum over both and one over the area add 5.5, and 7.3. That is less than 32, or
/// N/256.
///
/// Beside these, λ and the multiples of q have T off by up to six units of 2^-29 of the greatest q, and u by
/// 8 r 2^-29 Δu. As a part of N that is up to 12 r 2^-29 from T, and 16 r 2^-29 from u: less than r 2^-24.
#[derive(Clone, Copy)]
pub(super) struct FixedQuotients<V: Varying> {
    /// The increments of the edge functions of the second and the third vertex by column and by row, in `BITS` bits.
    by: [[i32; 2]; 2],
    /// 2^63 over twice the area, where that is shifted until it has 32 bits.
    per_area: u32,
    /// The leading zeros of twice the area in 64 bits.
    zeros: u32,
    /// The bits that a product of a component and a distance over the area has too many of, but for its zeros.
    shift: i32,
    /// Multiples of q, the greatest of them from 2^29 to 2^30 if that is a normal number.
    q: [u32; 3],
    /// Of each component the differences of the second and the third vertex from the first, in `BITS` bits, and the
    /// leading zeros of the greater one.
    differences: V::Of<[i32; 3]>,
}

/// A place at which derivatives are asked for.
#[derive(Clone, Copy)]
struct Place {
    /// The shares of the second and the third vertex.
    p: [i32; 2],
    /// Multiples of g at the three vertices.
    g: [i32; 3],
    /// One over the area, times the factor of these multiples but for a power of two.
    per_area: i32,
    /// The bits of that power.
    shift: i32,
}

impl<V: Varying> FixedQuotients<V> {
    /// The quotients, with so many of Newton's steps for one over the area.
    #[inline(always)]
    pub(super) fn new<const STEPS: u32>(triangle: &Oriented<'_, V>) -> Self {
        let [a, b, c] = triangle.corners;
        let by = [[c[1] - a[1], a[1] - b[1]], [a[0] - c[0], b[0] - a[0]]];
        let [[t, u], [v, w]] = by.map(|along| map2(along, i32::unsigned_abs));
        let zeros_by = (t | u | v | w).leading_zeros();
        let area = triangle.doubled_area.cast_unsigned();
        let zeros = area.leading_zeros();
        let q = map3(triangle.vertices, |vertex| vertex.q);
        let greatest = q[0].max(q[1]).max(q[2]) >> 23;
        Self {
            by: by.map(|along| map2(along, |distance| kept(distance, zeros_by))),
            per_area: reciprocal::<STEPS>((area << (zeros & 63) >> 32) as u32),
            zeros,
            shift: (27 + zeros_by).cast_signed() - (zeros + triangle.bits).cast_signed(),
            q: map3(q, |q| relative(q, greatest).cast_unsigned() >> 1),
            differences: V::map_by_mode(&triangle.words(), &|mode, [a, b, c, _]: [u32; 4]| {
                if mode == Mode::Flat {
                    return [0; 3];
                }
                // Below 2^29.
                let more = map2([b, c], |other| other.wrapping_sub(a).cast_signed());
                let zeros = (more[0].unsigned_abs() | more[1].unsigned_abs() | 1).leading_zeros();
                [kept(more[0], zeros), kept(more[1], zeros), zeros.cast_signed()]
            }),
        }
    }

    #[inline(always)]
    pub(super) fn to_words(self) -> Words<V> {
        let [[a, b], [c, d]] = self.by.map(|along| along.map(i32::cast_unsigned));
        let [p, q, r] = self.q;
        Words {
            shape: [a, b, c, d, self.per_area, self.zeros, self.shift.cast_unsigned(), p, q, r],
            components: V::map(&self.differences, &|component: [i32; 3]| component.map(i32::cast_unsigned)),
        }
    }

    #[inline(always)]
    pub(super) fn of_words(words: &Words<V>) -> Self {
        let [a, b, c, d, per_area, zeros, shift, p, q, r] = words.shape;
        Self {
            by: [[a, b], [c, d]].map(|along| along.map(u32::cast_signed)),
            per_area,
            zeros,
            shift: shift.cast_signed(),
            q: [p, q, r],
            differences: V::map(&words.components, &|component: [u32; 3]| component.map(u32::cast_signed)),
        }
    }

    /// The derivatives at the centroid.
    #[inline(always)]
    pub(super) fn in_centroid(&self) -> V::Of<[Q16; 2]> {
        // All λ are a third. So T is a third of this, and g are three times the shares.
        let t = self.q[0] + self.q[1] + self.q[2];
        let (zeros, per_t) = normalized_reciprocal(t);
        let g = map3(self.q, |q| share(q << zeros, per_t));
        self.at(&Place {
            p: [g[1], g[2]],
            g: map3(g, |g| cut(g, SHARE - BITS)),
            per_area: half_word(self.per_area - (self.per_area >> 2)),
            shift: -2,
        })
    }

    /// The derivatives in the middle of a run of a row.
    #[inline(always)]
    pub(super) fn in_middle<I: EdgeInt>(&self, row: &Row<'_, I>, run: Span) -> V::Of<[Q16; 2]> {
        let column = run.start + ((run.end - run.start) >> 1);
        let [_, b, c] = row.at(column);
        // λ in units of 2^-31: the last two are rounded down, so that the first is not negative.
        let [b, c] = map2([b, c], |e: I| {
            high((e.to_i64().cast_unsigned() << (self.zeros & 63) >> 32) as u32, self.per_area)
        });
        let a = (1_u32 << 31).wrapping_sub(b).wrapping_sub(c);
        let [qa, qb, qc] = map3(self.q, |q| q << 1);
        let parts = [high(a, qa), high(b, qb), high(c, qc)];
        let t = parts[0].wrapping_add(parts[1]).wrapping_add(parts[2]).max(1);
        let (zeros, per_t) = normalized_reciprocal(t);
        let g = map3(self.q, |q| (q >> 14) * (per_t >> 16));
        let dropped = (32 - (g[0] | g[1] | g[2]).leading_zeros()).saturating_sub(BITS);
        self.at(&Place {
            p: [share(parts[1] << zeros, per_t), share(parts[2] << zeros, per_t)],
            g: map3(g, |g| (g >> dropped).cast_signed()),
            per_area: half_word(self.per_area),
            shift: 19 - (zeros + dropped).cast_signed(),
        })
    }

    /// The derivatives at a place, by column and by row.
    #[inline(always)]
    fn at(&self, place: &Place) -> V::Of<[Q16; 2]> {
        V::map_by_mode(&self.differences, &|mode, [b, c, zeros]: [i32; 3]| {
            let (more, per_area, shift) = match mode {
                Mode::Hyperbolic => {
                    // Differences from u that have opposite signs are together those of two vertices, below 2^15.
                    let u = cut(place.p[0] * b + place.p[1] * c, SHARE);
                    let more = |g: i32, value: i32| cut(g * (value - u) + place.g[0] * u, BITS);
                    ([more(place.g[1], b), more(place.g[2], c)], place.per_area, place.shift)
                }
                Mode::Linear => ([b, c], half_word(self.per_area), 0),
                Mode::Flat => return [Q16::ZERO; 2],
            };
            map2(self.by, |[by_b, by_c]| {
                let along = cut(more[0] * by_b + more[1] * by_c, 15);
                Q16::from_bits(shifted(along * per_area, self.shift + shift + zeros))
            })
        })
    }
}

/// `BITS` bits of a number below 2^29, the greatest of several of which has so many leading zeros.
#[inline(always)]
fn kept(x: i32, zeros: u32) -> i32 {
    cut(x << (zeros.wrapping_sub(2) & 31), 30 - BITS)
}

/// The leading zeros of a number that is not 0, and 2^63 over what it is without them.
#[inline(always)]
fn normalized_reciprocal(t: u32) -> (u32, u32) {
    let zeros = t.leading_zeros();
    (zeros, reciprocal::<1>(t << (zeros & 31)))
}

/// The share of a part of T, which is without T's leading zeros, where `per_t` is one over T.
#[inline(always)]
fn share(part: u32, per_t: u32) -> i32 {
    (((part >> 16) * (per_t >> 16) + (1 << 15)) >> 16).cast_signed()
}

/// A word over 2^17, to the nearest.
#[inline(always)]
fn half_word(x: u32) -> i32 {
    (((x >> 1) + (1 << 15)) >> 16).cast_signed()
}

/// A number without its last bits, to the nearest.
#[inline(always)]
fn cut(x: i32, bits: u32) -> i32 {
    (x + (1 << bits >> 1)) >> bits
}

/// A number up to 2^30 without its last bits, to the nearest; if they are fewer than none, with as many more, or the
/// greatest of its sign.
#[inline(always)]
fn shifted(x: i32, bits: i32) -> i32 {
    let (fewer, more) = (bits.cast_unsigned(), bits.wrapping_neg().cast_unsigned());
    if fewer <= 30 {
        cut(x, fewer)
    } else if bits > 0 || x == 0 {
        0
    } else {
        let fits = more < 31 && (x << more) >> more == x;
        if fits { x << more } else { (x >> 31) ^ i32::MAX }
    }
}
