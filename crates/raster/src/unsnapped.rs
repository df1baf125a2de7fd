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
//! shares of u are Di qi/q(P).
//!
//! Small triangles keep what their vertices have: that is off by less than the change along half a subpixel, and would
//! take as long as the rest of their setup.

use crate::interpolation::Oriented;
use crate::triangle::{Corner, Corners};
use alberti_math::{Fixed, Mode, Varying, map2, map3};

/// Pixels of the box, one way or the other, from which on a triangle is large.
pub(crate) const LARGE: i32 = 65;

/// The greatest Di and Di qi/q(P). With a greater one a triangle keeps what its vertices have. It is some ten subpixels
/// wide, or a subpixel changes q at a vertex by as much as that.
///
/// # Precision
/// The Di carry at most 8ε each (ε = 2^-24), those of q four more. With M = max|u| that adds 12ε·2M/16 twice to what a
/// vertex has, and ε·M for the sum: 4ε·M. That of zs is the same.
const GREATEST: f32 = 1.0 / 16.0;

type Vector = [f32; 2];

#[inline(always)]
fn cross([ux, uy]: Vector, [vx, vy]: Vector) -> f32 {
    ux * vy - uy * vx
}

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
        let moved = map3(self.vertices, |vertex| map2(vertex.unsnapped(), Fixed::moved));
        if moved == [[0; 2]; 3] {
            return None;
        }
        let shares = shares(&self.corners, &moved, self.area());
        let [a, b, c] = self.vertices;
        Some([
            self.at_subpixel(a, Turn::First, shares[0])?,
            self.at_subpixel(b, Turn::Second, shares[1])?,
            self.at_subpixel(c, Turn::Third, shares[2])?,
        ])
    }

    /// A corner with the values at its subpixel. None if that is next to the plane's horizon.
    #[inline(never)]
    fn at_subpixel(&self, vertex: &Corner<V>, turn: Turn, shares: Vector) -> Option<Corner<V>> {
        let of_q = turn.of(map3(self.vertices, Corner::q));
        let q = moved_by(of_q, shares);
        let in_space = [shares[0] * (of_q[1] / q), shares[1] * (of_q[2] / q)];
        if !(q > 0.0 && is_small(shares) && is_small(in_space)) {
            return None;
        }
        let components = V::map_by_mode(&self.words(), &|mode, [a, b, c, _]: [u32; 4]| {
            let words = turn.of([a, b, c]);
            match mode {
                Mode::Hyperbolic => moved_by(map3(words, f32::from_bits), in_space).to_bits(),
                Mode::Linear => moved_by(map3(words, f32::from_bits), shares).to_bits(),
                Mode::Flat => words[0],
            }
        });
        let zs = moved_by(turn.of(map3(self.vertices, Corner::zs)), shares);
        Some(vertex.with_numbers([zs, q], components))
    }
}

/// Whether shares are small enough for the bounds.
#[inline(always)]
fn is_small([x, y]: Vector) -> bool {
    x.abs() <= GREATEST && y.abs() <= GREATEST
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
fn moved_by([own, next, last]: [f32; 3], [of_next, of_last]: Vector) -> f32 {
    own + (of_next * (next - own) + of_last * (last - own))
}

/// Of each vertex, the Di of the next one and of the last.
#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "at most 2^24, and 2^8 for what was moved")]
fn shares([a, b, c]: &Corners, moved: &[[i32; 2]; 3], area: f32) -> [Vector; 3] {
    let number = |v: [i32; 2]| map2(v, |x| x as f32);
    let between = |from: &[i32; 2], to: &[i32; 2]| number([to[0] - from[0], to[1] - from[1]]);
    let [sa, sb, sc] = map3(*moved, |v| map2(number(v), |x| x * (1.0 / 256.0)));
    let less = |[ux, uy]: Vector, [vx, vy]: Vector| [ux - vx, uy - vy];
    let plus = |[ux, uy]: Vector, [vx, vy]: Vector| [ux + vx, uy + vy];
    // Edges of the snapped triangle, and how snapping has changed them.
    let (edge_b, edge_c) = (between(c, a), between(a, b));
    let (change_b, change_c) = (less(sa, sc), less(sb, sa));
    let ea = plus(between(b, c), less(sc, sb));
    let (eb, ec) = (plus(edge_b, change_b), plus(edge_c, change_c));
    // Twice the area before: the area after is an integer, and the change is small beside it, unless it is a sliver.
    let area = area + (cross(edge_b, change_c) + cross(change_b, ec));
    let per_area = 1.0 / area;
    let of = |s: Vector, next: Vector, last: Vector| [cross(s, next) * per_area, cross(s, last) * per_area];
    [of(sa, eb, ec), of(sb, ec, ea), of(sc, ea, eb)]
}
