//! Triangles under a budget: each is drawn in the cheapest way that keeps it, found from its corners alone. So no bit
//! depends on lanes, bands, scissors, or on which of the vertices comes first.
//!
//! With D the greatest difference of a hyperbolic component between two vertices, and q from l to h:
//!
//! | way | miss | where |
//! |---|---|---|
//! | a plane and a parabola | D ((h − l)/(h + l))² / 5 | up to h = 9/8 l |
//! | straight lines along 64 columns | 1024 max\|g\| \|∂q/∂x\| / l², see [`along_rows`] | in boxes of 64 columns |
//! | [`Planes`](crate::Planes) | its rounding, (15 h/l + 5)ε max\|u\| | in boxes of more than 32 columns |
//! | [`Exact`](crate::Exact) | 0 | everywhere |
//!
//! The first, with d = (h − l)/(h + l): perspective adds most to a plane if all weight is where q is l or h. Where q
//! is l + λ (h − l) that is D λ (1 − λ)(h − l)/q. The mean of l and h instead of q is off by a share of d |1 − 2 λ|.
//!
//! ```text
//! 2 D d² λ (1 − λ) |1 − 2 λ| / (1 − d (1 − 2 λ)) <= 0.1993 D d²     for d = 1/17
//! ```
//!
//! In narrow boxes rows are so short that nothing is cheaper than [`Exact`](crate::Exact).

use super::fixed_point::{LIMIT, ROUNDED_ENDS, relative};
use super::linear::{Slant, scaled_q};
use super::lines::Lines;
use crate::interpolation::{Chosen, Oriented, Values, words};
use crate::setup::{NARROW, Waiting};
use crate::triangle::{Bounds, Corner};
use alberti_math::{Mode, Varying, hull3, map3, scaled};
use core::cell::Cell;

/// Rounding may favour lines by a few ε.
const ROUNDED: f32 = 1.0 - 16.0 * f32::EPSILON;

/// The greatest ratio of q for a parabola.
///
/// # Precision
/// With M = max|u| and ε = 2^-24, differences of u are at most 2 M, and those of q over the mean at most 2/17. So the
/// plane with the first sum of `Bends` is of values up to 1.24 M, within 12ε of these, and their rounding adds 1.3ε M.
/// The second sum, up to 0.24 M, has ten roundings: 2.4ε M. Those of its increments add as much, the last sums 2ε M:
/// 19ε M.
const RATIO: f32 = 1.125;

impl Lines {
    /// The way of a triangle on a grid with so many bits, where numbers are floats.
    #[inline(always)]
    pub(super) fn of_corners<V: Varying>(self, triangle: &Waiting<'_, V>, bits: u32) -> Chosen {
        let Some(budget) = self.kept() else { return Chosen::Lines(self) };
        let bounds = Bounds::of(&map3(triangle.0, |corner| corner.place(false)));
        if bounds.width() <= NARROW.cast_signed() << bits {
            Chosen::Exact
        } else {
            of_wide(budget, triangle, &bounds, bits)
        }
    }
}

/// The same for a box that is not narrow. Not inlined, as most triangles do not come here.
#[inline(never)]
fn of_wide<V: Varying>(budget: f32, (corners, area): &Waiting<'_, V>, bounds: &Bounds, bits: u32) -> Chosen {
    // Large ones carry other numbers than their vertices.
    let mut oriented = Oriented::new(*corners, *area, bits, false);
    let unsnapped = oriented.unsnapped(bounds.is_large(bits));
    oriented.replace(&unsnapped);
    if over_all(budget, &oriented.vertices) {
        Chosen::Lines(Lines::PARABOLA)
    } else if bounds.width() >= Lines::LONGEST << bits && along_rows(budget, &oriented) {
        Chosen::Lines(Lines::LONG)
    } else if in_planes(budget, &oriented) {
        Chosen::Planes
    } else {
        Chosen::Exact
    }
}

/// Whether the rounding of [`Planes`](crate::Planes) keeps the budget, with the ratio of q over the whole triangle
/// instead of that along a run.
#[inline(always)]
fn in_planes<V: Varying>(budget: f32, triangle: &Oriented<'_, V>) -> bool {
    const EPS: f32 = 0.5 * f32::EPSILON;
    let [low, high] = hull3(map3(triangle.vertices, Corner::q));
    let largest = Cell::new(0.0_f32);
    let _ = V::map_by_mode(&triangle.values(), &|mode, values: Values| {
        if mode == Mode::Hyperbolic {
            let [a, b, c] = map3(values.corners, f32::abs);
            largest.set(largest.get().max(a).max(b).max(c));
        }
    });
    let share = largest.get() * EPS;
    15.0 * share * (high / low) + 5.0 * share <= budget * ROUNDED
}

/// Whether a plane and a parabola keep the budget over the triangle with these corners.
#[inline(always)]
fn over_all<V: Varying>(budget: f32, corners: &[&Corner<V>; 3]) -> bool {
    let [low, high] = hull3(map3(*corners, Corner::q));
    let widest = Cell::new(0.0_f32);
    let [a, b, c] = map3(*corners, |corner| &corner.components);
    let _ = V::map_by_mode(&words::<V>([a, b, c, a]), &|mode, [a, b, c, _]: [u32; 4]| {
        if mode == Mode::Hyperbolic {
            let [least, most] = hull3(map3([a, b, c], f32::from_bits));
            widest.set(widest.get().max(most - least));
        }
    });
    // Halves, so that no sum overflows.
    let ratio = (0.5 * high - 0.5 * low) / (0.5 * high + 0.5 * low);
    high <= RATIO * low && widest.get() * (ratio * ratio) * 0.2 <= budget * ROUNDED
}

/// Whether straight lines along the longest runs keep the budget. With U the plane through the q u of the vertices, and
/// along a row g(p) = ∂U/∂x − u(p) ∂q/∂x,
///
/// ```text
/// ∂u/∂x = g/q,   and q g is linear, constant along a row.
/// ```
///
/// So along N columns from q0 to q1 u changes by N q g/(q0 q1), and q by N·|∂q/∂x|. Of what a line misses by that, see
/// [`Lines::bounded`], each q is at least the least one. As a quotient of linear functions g is greatest at a vertex.
#[inline(always)]
fn along_rows<V: Varying>(budget: f32, triangle: &Oriented<'_, V>) -> bool {
    // Each term has less than four roundings.
    const ROUNDING: f32 = 4.0 * f32::EPSILON;
    const { assert!(Lines::LONGEST == 64) };
    let (slant, q) = (Slant::new(triangle), scaled_q(triangle));
    let [low, _] = hull3(q);
    let slope = |terms: [f32; 2]| {
        let [x, y] = terms;
        ((x + y).abs() + ROUNDING * (x.abs() + y.abs())) * slant.per_area
    };
    let [sa, sb, sc] = slant.steps;
    let [qa, qb, qc] = q;
    let of_q = slope([sb * (qb - qa), sc * (qc - qa)]);
    let steepest = Cell::new(0.0_f32);
    let _ = V::map_by_mode(&triangle.values(), &|mode, values: Values| {
        if mode == Mode::Hyperbolic {
            let [u, v, w] = values.corners;
            let (ta, tb, tc) = (sa * qa, sb * qb, sc * qc);
            let g = [
                slope([tb * (v - u), tc * (w - u)]),
                slope([tc * (w - v), ta * (u - v)]),
                slope([ta * (u - w), tb * (v - w)]),
            ];
            steepest.set(steepest.get().max(hull3(g)[1]));
        }
    });
    // A quarter of the square of the columns.
    1024.0 * (steepest.get() / low) * (of_q / low) <= budget * ROUNDED
}

/// A budget in units.
#[inline(always)]
pub(super) fn units(budget: f32) -> i32 {
    scaled(budget, 16).clamp(0, LIMIT / 2)
}

/// The runs along which components that are linear on the screen keep a budget of so many units: the longest for which
/// it has room, or half as long. With D the greatest difference, and q from l to h, a plane misses at most
/// D (h − l)/(h + 3 l).
#[inline(always)]
pub(super) fn on_screen<V: Varying>(budget: i32, triangle: &Oriented<'_, V>) -> Option<Lines> {
    let words = triangle.vertices.map(|corner| corner.q);
    let greatest = words[0].max(words[1]).max(words[2]) >> 23;
    let [a, b, c] = words.map(|q| i64::from(relative(q, greatest)));
    // Each is off by half.
    let (low, high) = (a.min(b).min(c) - 1, a.max(b).max(c) + 1);
    let widest = Cell::new(0);
    let _ = V::map_by_mode(&triangle.words(), &|mode, [a, b, c, _]: [u32; 4]| {
        let [a, b, c] = map3([a, b, c], u32::cast_signed);
        if mode == Mode::Hyperbolic {
            widest.set(widest.get().max(a.max(b).max(c) - a.min(b).min(c)));
        }
    });
    let missed = i64::from(widest.get()) * (high - low);
    let room = |length: i32| i64::from(budget - length - ROUNDED_ENDS);
    let mut length = Lines::LONGEST;
    while length > SHORTEST && room(length) < 0 {
        length >>= 1;
    }
    [length, length >> 1]
        .into_iter()
        .find(|&length| length >= SHORTEST && missed <= room(length) * (high + 3 * low))
        .map(Lines::on_screen)
}

/// The columns of the shortest runs that are drawn so.
const SHORTEST: i32 = 8;

#[cfg(test)]
mod tests;
