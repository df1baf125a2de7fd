//! Small triangles in fixed point: most of a mesh has corners within a few pixels of each other.
//!
//! Rows are followed by two sums, an edge each. Depth and attributes are planes, of which a column and a row add so
//! much: no weight, no division and no correction for perspective is left in a row.
//!
//! ```text
//!        a            a to c is the long edge
//!       /|            between a and b, and between b and c, the other side is the short edge there
//!      / |            the planes begin at a, the highest vertex
//!    b   |
//!     `  |
//!        c
//! ```
//!
//! There are two kinds. Coarse ones are on the grid of `Sub4`, with sides below 32 pixels. Fine ones are on that of
//! `Sub8`, with sides below 16 pixels, and a little dearer.
//!
//! # Coverage
//! An edge that is at most 2^h subpixels of 2^-b pixel high crosses a row's centre at a sample, or at least 2^-(h + b)
//! column from it. A little is taken off crossings, so that those at samples lie before them.
//!
//! * Coarse: 2^-13 are 256 units of 2^-21, of which 128 are taken off. Rounding moves crossings by less: two units for
//!   each of 32 rows, on the way to the first one or after it, and one for the shift.
//! * Fine: 2^-20 are 32 units of 2^-25, of which one is taken off. Rounding takes off less than one on the way to the
//!   first row, and less than one for each of 16 rows.
//!
//! # Values
//! In units of 2^-24 a column or a row adds its slope within 1.4, for up to 33 of each, in fine ones for 17. The way
//! from the first vertex to the next sample, less than a pixel on both axes, is within 33, and in fine ones within 5.
//! So the error stays below 126 of 128, which are half a step of 2^-16. The three vertices are whole steps. So the
//! nearest step is within their range, and a constant stays one. Depths are followed in 2^-12 of a step. There 66
//! columns and rows times 6, and 42, are at most 438 of 2048.

mod grid;
mod shape;

pub(crate) use grid::{Coarse, Either, Fine, Grid};

use crate::color::ColorFormat;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::differentiation::Differentiate;
use crate::fragment::{FragmentStage, Fragments};
use crate::interpolation::{LIMIT, Runs, words};
use crate::paint::as_it_stands;
use crate::target::Target;
use crate::triangle::{Corner, Outcome};
use alberti_math::lanes::OneFixed;
use alberti_math::{Mode, Q16, Varying, map2, map3, map4, scaled};
use core::array;
use core::cell::Cell;
use shape::{Crossing, Ramp, SLOPE, Shape, magnitude};

/// The least length of runs for which a small triangle may be one.
pub(crate) const RUN: i32 = 16;
/// Bits of an attribute's fraction, beyond those of [`Q16`].
const MORE: u32 = 8;
/// Components from here on, and differences from twice as much on, might overflow.
const LARGE: u32 = 1 << 20;
/// Differences of depth from here on might too.
const DEEP: u32 = 1 << 18;
/// The greatest difference of the words of two q, which are normal numbers: their ratio is at most 2.
const STEEP: u32 = 1 << 23;

/// A bundle with every component mapped, by a function that stands in line.
#[inline(always)]
fn inlined<V: Varying, T: Copy, U: Copy>(bundle: &V::Of<T>, f: impl Fn(Mode, T) -> U) -> V::Of<U> {
    V::map_by_mode(bundle, &f)
}

/// The first row whose centre is not above `y`, or the first column whose centre is not to the left of it.
#[inline(always)]
fn row(grid: impl Grid, y: i32) -> i32 {
    let bits = grid.bits();
    (y + (1 << (bits - 1)) - 1) >> bits
}

/// The centre of a sample.
#[inline(always)]
fn center(grid: impl Grid, sample: [i32; 2]) -> [i32; 2] {
    let bits = grid.bits();
    map2(sample, |c| (c << bits) + (1 << (bits - 1)))
}

/// The planes over a triangle: of its depth and of its components.
struct Planes<V: Varying> {
    zs: Ramp,
    /// The first vertex's depth, where that is not in the plane.
    base: i32,
    shallow: bool,
    values: V::Of<Ramp>,
}

impl<V: Varying> Planes<V> {
    /// The depth as a word, whose highest bits count.
    #[inline(always)]
    fn depth(&self, at: i32) -> u32 {
        if self.shallow { at.cast_unsigned() } else { (self.base + (at >> SLOPE)).cast_unsigned() << 4 }
    }
}

/// The planes over three corners; the fourth has the flat components. None if numbers are out of range, or if a
/// straight line misses more than the policy allows.
#[inline(always)]
fn planes<G: Grid, V: Varying>(
    grid: G,
    runs: impl Runs,
    (shape, longer): (&Shape<G>, u32),
    [a, b, c, first]: [&Corner<V>; 4],
    depth_bits: u32,
) -> Option<Planes<V>> {
    let apart = if runs.perspective() { a.q.max(b.q).max(c.q) - a.q.min(b.q).min(c.q) } else { 0 };
    // A line misses at most |Δu| (r - 1) / 4, and r - 1 is at most `apart` over 2^23. Without a budget that is to be at
    // most a quarter of what a pixel changes. The bits cut off are less than what (√r + 1)^2 is above 4.
    let steep = || (apart >> 8) * longer > STEEP >> 8 << grid.bits();
    if apart > STEEP || (runs.budget().is_none() && steep()) {
        return None;
    }
    let budget = runs.budget().map(|budget| scaled(budget, 16).clamp(0, LIMIT / 2) - 2);
    let (large, differences) = (Cell::new(0), Cell::new(0));
    let values = inlined::<V, _, _>(
        &words::<V>([&a.components, &b.components, &c.components, &first.components]),
        #[inline(always)]
        |mode, words| {
            let [a, b, c, first] = map4(words, u32::cast_signed);
            let half = 1 << (MORE - 1);
            if mode == Mode::Flat {
                large.set(large.get() | magnitude(first));
                return Ramp { at: (first << MORE).wrapping_add(half), across: 0, down: 0 };
            }
            let more = [b.wrapping_sub(a), c.wrapping_sub(a)];
            large.set(large.get() | magnitude(a));
            differences.set(differences.get() | magnitude(more[0]) | magnitude(more[1]));
            if let (Some(budget), Mode::Hyperbolic) = (budget, mode) {
                let widest = magnitude(more[0]).max(magnitude(more[1])).max(magnitude(b.wrapping_sub(c)));
                // In units of 2^-16: the ratio of q is at most 1 more than the difference of words over 2^23.
                let missed = (((widest.min(1 << 21) >> 4) + 1) * ((apart >> 9) + 1)) >> 12;
                if missed.cast_signed() > budget {
                    large.set(u32::MAX);
                }
            }
            shape.ramp((a << MORE).wrapping_add(half), more, MORE)
        },
    );
    // Depths of 16 bits are followed with four more, others with 28, from the first vertex's on.
    let shallow = depth_bits <= 16;
    let finer = if shallow { 31 - 20 } else { 31 - 28 };
    let [base, b, c] = map3([a.zs, b.zs, c.zs], |zs| (zs >> finer).cast_signed());
    let (more, half) = ([b - base, c - base], 1 << (SLOPE - 1));
    let deep = magnitude(more[0]) | magnitude(more[1]);
    let zs = shape.ramp(if shallow { (base << SLOPE).wrapping_add(half) } else { half }, more, SLOPE);
    let beyond = ((large.get() | differences.get() >> 1) / LARGE) | (deep / DEEP);
    let planes = Planes { zs, base, shallow, values };
    (beyond == 0 && shape.holds(differences.get() | deep)).then_some(planes)
}

/// Draws a triangle that faces the right way. Its corners have to be near each other, no number may be out of range,
/// and one run has to do for it: returns whether it was so. Coarse ones are on the grid of `Sub4`, fine ones on that of
/// `Sub8`.
#[inline(always)]
pub(crate) fn draw<G, R, V, F, C, D, K>(
    grid: G,
    runs: R,
    stage: F,
    target: &mut Target<'_, C, D>,
    [first, second, third]: [&Corner<V>; 3],
    counters: &mut K,
) -> bool
where
    G: Grid,
    R: Runs,
    V: Varying,
    F: FragmentStage<V>,
    C: ColorFormat,
    D: DepthFormat,
    K: Counters,
{
    let place = |corner: &Corner<V>| corner.place(true);
    let [u, v] = map2([place(second), place(third)], |[x, y]| {
        let [from_x, from_y] = place(first);
        [x - from_x, y - from_y]
    });
    let area = u[0].wrapping_mul(v[1]).wrapping_sub(u[1].wrapping_mul(v[0]));
    // By rows, and within a row by columns; of corners that are near each other.
    let key = |[x, y]: [i32; 2]| (y << if grid.is_fine() { 13 } else { 10 }).wrapping_add(x);
    // From top to bottom, and from left to right: no bit depends on the order that was given.
    let (mut a, mut b, mut c, mut clockwise) = ((first, 0), (second, key(u)), (third, key(v)), area > 0);
    if b.1 < a.1 {
        (a, b, clockwise) = (b, a, !clockwise);
    }
    if c.1 < b.1 {
        (b, c, clockwise) = (c, b, !clockwise);
        if b.1 < a.1 {
            (a, b, clockwise) = (b, a, !clockwise);
        }
    }
    let (a, b, c) = (a.0, b.0, c.0);
    let [[ax, ay], [bx, by], [cx, cy]] = map3([a, b, c], place);

    let (west, east) = (ax.min(bx).min(cx), ax.max(bx).max(cx));
    let reach = if grid.is_fine() { 1 << 12 } else { 1 << 9 };
    let below = [by - ay, cy - ay].map(i32::cast_unsigned);
    if east - west >= reach || (below[0] | below[1]) >= reach.cast_unsigned() {
        return false;
    }
    let [columns, rows] = target.limits();
    let row = |y: i32| row(grid, y);
    // The first sample that is neither above nor to the left of the highest vertex.
    let origin = [row(ax), row(ay)];
    let (top, end) = (origin[1].max(rows.start), row(cy).min(rows.end));
    if top >= end || row(west) >= row(east + 1) {
        counters.rasterized(Outcome::Missed);
        return true;
    }
    let [from, to] = [columns.start - origin[0], columns.end - origin[0]];
    let middle = row(by).max(top).min(end);
    let center = |row: i32| center(grid, [origin[0], row]);
    let shape = Shape::new(
        grid,
        [[ax, ay], [bx, by], [cx, cy]],
        center(origin[1]),
        area.unsigned_abs(),
        clockwise,
        ((east - west) | (cy - ay)).cast_unsigned(),
    );
    let longer = (east - west).max(cy - ay).cast_unsigned();
    let Some(planes) = planes(grid, runs, (&shape, longer), [a, b, c, first], target.depth_format().bits())
    else {
        return false;
    };

    let lanes = OneFixed;
    let gradient =
        <F::Derivatives as Differentiate>::of_slopes::<V>(&V::map(&planes.values, &|ramp: Ramp| {
            [Q16::from_bits(ramp.across >> MORE), Q16::from_bits(ramp.down >> MORE)]
        }));
    let stage = if const { F::SETTLES } { stage.settled(lanes, &gradient) } else { stage };
    let formats = (target.color_format(), target.depth_format());
    let mut lines = target.lines(top, origin[0]);
    let long = Crossing::new(grid, [ax, ay], [cx, cy], center(top));
    let (mut start, mut stop) = (long, long);
    let (mut outcome, mut row, mut below) = (Outcome::Missed, top, middle);
    let mut ends = [[ax, ay], [bx, by]];
    loop {
        // The short edge of these rows.
        if row < below {
            let short = Crossing::new(grid, ends[0], ends[1], center(row));
            *(if clockwise { &mut stop } else { &mut start }) = short;
        }
        while row < below {
            let columns = start.column().max(from)..stop.column().min(to);
            let count = columns.end - columns.start;
            if count > 0 {
                outcome = Outcome::Drawn;
                let first = [columns.start, row - origin[1]];
                if let Some((colors, depths)) = lines.run(columns.start, count) {
                    // By reference, as a copy of a large one for each row would be dear.
                    let in_row = const { F::BY_ROWS }.then(|| stage.in_row(row));
                    let stage = in_row.as_ref().unwrap_or(&stage);
                    let mut depth = planes.zs.at(first);
                    let mut cursor = V::map(&planes.values, &|ramp: Ramp| ramp.at(first));
                    let (mut written, mut column) = (0, origin[0] + columns.start);
                    for (stored, color) in depths.iter_mut().zip(colors) {
                        let new = formats.1.encode_lanes(lanes, planes.depth(depth));
                        if formats.1.seen(lanes, &new, array::from_mut(stored), true) {
                            let varying = V::map(&cursor, &|at: i32| Q16::from_bits(at >> MORE));
                            let place = [column, row];
                            let (word, kept) =
                                stage.shade(&Fragments { lanes, varying, gradient, mask: true, place });
                            if kept {
                                let color = array::from_mut(color);
                                formats.0.store::<OneFixed, F::Color>(lanes, word, true, place, color);
                                formats.1.keep(lanes, &new, true, array::from_mut(stored));
                                written += 1;
                            }
                        }
                        depth = depth.wrapping_add(planes.zs.across);
                        cursor = V::map_by_mode(
                            &V::zip(&cursor, &planes.values),
                            &|mode, (at, ramp): (i32, Ramp)| match mode {
                                Mode::Flat => at,
                                _ => at.wrapping_add(ramp.across),
                            },
                        );
                        column += 1;
                        as_it_stands();
                    }
                    counters.span(count.cast_unsigned(), written);
                }
            }
            start.next_row();
            stop.next_row();
            lines.next_row();
            row += 1;
        }
        if row >= end {
            counters.touched(outcome, || {
                let own = |y: i32| self::row(grid, y);
                [own(west).max(columns.start)..own(east + 1).min(columns.end), top..end]
            });
            counters.rasterized(outcome);
            return true;
        }
        (below, ends) = (end, [[bx, by], [cx, cy]]);
    }
}
