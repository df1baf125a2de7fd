//! Values of large triangles from where their vertices were before snapping.
//!
//! ```text
//!         T *                     T: a vertex, P: the subpixel to which it was snapped, s = T − P
//!           |\  s                 f: a function that is linear on the screen, known at the three T
//!           | * P
//!           |    `  .             f(P) = f(T) − ∇f·s = f(T) + Σ Di (fi − f(T))     over the other two vertices i
//!           *----------*          Di = s × ei / area                               ei: the edge opposite to i
//! ```
//!
//! The triangle of the P, with the f(P), lies in the plane of the other. So all that follows goes on with subpixels.
//! Components that are linear on the screen, zs and q are such functions. Of hyperbolic ones it is q u, so that the
//! shares of u are Di' = Di qi/q(P).
//!
//! Small triangles keep what their vertices have: that is off by less than the change along half a subpixel, and would
//! take as long as the rest of their setup.
//!
//! # Precision
//! A triangle is moved if it is [high](HEIGHT) everywhere: if area >= 32 |ei| qi/min q for each i, |e| being |x| + |y|.
//! As s is at most 1/2 on each axis, for any direction of it:
//!
//! 1. |Di| <= |ei|/(2 area) <= min q/(64 qi). And qi >= min q: so |Di| <= 1/64.
//! 2. |Di||qi − q(T)| <= max(|Di| qi, |Di| q(T)) <= q(T)/64. So q(P) is within q(T)/32 of q(T), and positive.
//! 3. |Di'| <= min q/(64 q(P)) <= 1/62.
//! 4. With M = max|u|, |ui − u(T)| <= 2M, and so |u(P)| <= (1 + 4/62)M.
//!
//! Then roundings, in ε = 2^-24. Products of two do not count. So those of the decision do not, which is within 6ε of
//! what it compares.
//!
//! 5. Cross products are of integers, exact. Di has the rounding of one, of the area, of its reciprocal and of the
//!    product, and 0.03 for two bits of the area: 4.03 of Di.
//! 6. A term Di (fi − f(T)) adds a difference, a product, and the sum of both terms: 7.03 of it. By 2 and 3 both terms
//!    of q together are at most 2/62 q(P). The last sum adds one: q(P) is off by 1.23 of it.
//! 7. Di' adds a quotient, a product, and what q(P) is off: 7.26 of it. A term of u adds three: 10.26·4/62 M. The
//!    last sum adds (1 + 4/62)M: u(P) is off by 1.73 M.
//! 8. What q(P) is off changes the weights of the corners. That changes the mean of the u(P) by 1.23 times half of
//!    their range, at most: 1.31 M.
//!
//! By 7 and 8 the triangle of the P is within 3.04ε·M of the plane. From there any policy goes on, with (1 + 4/62)M in
//! place of M. `Exact` adds 9(1 + 4/62)ε·M: it is within 13ε·M.
//!
//! zs and linear components have the Di. With M the greatest zs, zs(P) is off by 7.03·2/64 M and (1 + 1/32)M, together
//! 1.26 M. `Exact` adds 6ε of Σ Ei|zsi|/Σ Ei, which exceeds zs by 2/32 M at most, as zs(P) >= −1/32 M. So it is within
//! 6ε of zs and 2ε·M. A linear component is off by 7.03·4/64 M and (1 + 4/64)M, and so within 13ε·M, too.

use crate::interpolation::Oriented;
use crate::triangle::Corner;
use alberti_math::{Fixed, Mode, Varying, map2, map3};

/// Pixels of the box, one way or the other, from which on a triangle is large.
pub(crate) const LARGE: i32 = 65;

/// The least height of a vertex over the opposite edge, area/(|x| + |y|) in subpixels, where q is the least of the
/// three. Where it is greater, as many times as much. With less a triangle keeps what its vertices have.
const HEIGHT: i32 = 32;

/// The Di of the two other vertices, or the Di'.
type Shares = [f32; 2];

impl<'a, V: Varying> Oriented<'a, V> {
    /// Takes these corners, if there are any.
    #[inline(always)]
    pub(crate) fn replace(&mut self, corners: &'a Option<[Corner<V>; 3]>) {
        if let Some([a, b, c]) = corners {
            self.vertices = [a, b, c];
        }
    }

    /// The corners with the values at their subpixels, if it is large.
    #[inline(always)]
    pub(crate) fn unsnapped(&self, is_large: bool) -> Option<[Corner<V>; 3]> {
        if is_large { self.at_subpixels() } else { None }
    }

    /// The same for one that is, handed on as a copy: others stay in registers. Not inlined, as one copy is enough.
    #[inline(never)]
    fn at_subpixels(self) -> Option<[Corner<V>; 3]> {
        let [a, b, c] = self.shares()?;
        Some([
            self.at_subpixel(Turn::First, a),
            self.at_subpixel(Turn::Second, b),
            self.at_subpixel(Turn::Third, c),
        ])
    }

    /// The shares of each vertex. None if nothing was moved, or if it is not high enough.
    #[inline(always)]
    fn shares(&self) -> Option<[Shares; 3]> {
        let places = map3(self.vertices, Corner::unsnapped);
        let moved = map3(places, |place| map2(place, |at| i64::from(at.moved())));
        if moved == [[0; 2]; 3] {
            return None;
        }
        // In 256ths of subpixels, 33 bits.
        let [a, b, c] = map3(places, |place| map2(place, |at: Fixed| i64::from(at.to_bits().cast_signed())));
        let edge = |[x, y]: [i64; 2], [to_x, to_y]: [i64; 2]| [to_x - x, to_y - y];
        let [ea, eb, ec] = [edge(b, c), edge(c, a), edge(a, b)];
        // The area has up to 65 bits, its difference from the one after snapping 42. Two bits do not count: where the
        // triangle is high and large the area is above 2^31.
        let change = cross(eb, ec).wrapping_sub(self.doubled_area << 16);
        let area = 4.0 * number((self.doubled_area << 14) + (change >> 2));

        let [qa, qb, qc] = map3(self.vertices, Corner::q);
        let per_least = 1.0 / qa.min(qb).min(qc);
        let is_high = |[x, y]: [i64; 2], q: f32| {
            number((x.abs() + y.abs()) * HEIGHT_IN_PARTS) * (q * per_least) <= area
        };
        if !(is_high(ea, qa) && is_high(eb, qb) && is_high(ec, qc)) {
            return None;
        }

        let per_area = 1.0 / area;
        let of = |s, next, last| [number(cross(s, next)) * per_area, number(cross(s, last)) * per_area];
        Some([of(moved[0], eb, ec), of(moved[1], ec, ea), of(moved[2], ea, eb)])
    }

    /// A corner with the values at its subpixel.
    #[inline(never)]
    fn at_subpixel(&self, turn: Turn, shares: Shares) -> Corner<V> {
        let [vertex, next, last] = turn.of(self.vertices);
        let of_q = [vertex.q(), next.q(), last.q()];
        let q = moved_by(of_q, shares);
        let in_space = [shares[0] * (of_q[1] / q), shares[1] * (of_q[2] / q)];
        let components = V::map_by_mode(&self.words(), &|mode, [a, b, c, _]: [u32; 4]| {
            let words = turn.of([a, b, c]);
            match mode {
                Mode::Hyperbolic => moved_by(map3(words, f32::from_bits), in_space).to_bits(),
                Mode::Linear => moved_by(map3(words, f32::from_bits), shares).to_bits(),
                Mode::Flat => words[0],
            }
        });
        let zs = moved_by([vertex.zs(), next.zs(), last.zs()], shares);
        vertex.with_numbers([zs, q], components)
    }
}

/// The vertex with which the round of three begins.
#[derive(Clone, Copy)]
enum Turn {
    First,
    Second,
    Third,
}

impl Turn {
    #[inline(always)]
    fn of<T>(self, [a, b, c]: [T; 3]) -> [T; 3] {
        match self {
            Self::First => [a, b, c],
            Self::Second => [b, c, a],
            Self::Third => [c, a, b],
        }
    }
}

/// The value at the subpixel of the first of three vertices.
#[inline(always)]
fn moved_by([own, next, last]: [f32; 3], [of_next, of_last]: Shares) -> f32 {
    own + (of_next * (next - own) + of_last * (last - own))
}

/// [`HEIGHT`] in 256ths of subpixels.
const HEIGHT_IN_PARTS: i64 = (HEIGHT as i64) << Fixed::PARTS;

/// The doubled area that two vectors span, to the lowest 64 bits: all there are if one of them has 30.
#[inline(always)]
fn cross([ux, uy]: [i64; 2], [vx, vy]: [i64; 2]) -> i64 {
    ux.wrapping_mul(vy).wrapping_sub(uy.wrapping_mul(vx))
}

/// The nearest number.
#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "a rounding, which the bound has")]
fn number(integer: i64) -> f32 {
    integer as f32
}
