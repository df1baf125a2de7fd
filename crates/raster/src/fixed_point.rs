//! Lines in fixed point: integers only, from the vertices' numbers to the pixel.

use crate::depth::DepthFormat;
use crate::edge::EdgeInt;
use crate::interpolation::{Interpolation, Oriented, Row};
use crate::lines::{LONGEST, LineTriangle, Lines, Numbers, Run, Subdivision};
use alberti_math::lanes::{Floating, OneFixed};
use alberti_math::{Mode, Q16, Subpixel, Varying, reciprocal, scaled};
use core::cell::Cell;
use core::fmt;

/// The policy `P`, which is one of straight lines, in fixed point: for machines without floating point. One sample at a
/// time, with as many additions as there are numbers; the same bits on every machine.
///
/// # Precision
/// For components in ±16384, and r the greatest ratio of q in the triangle up to 2^20: the bound of `P`, and
/// (N + 3)·2^-16 + |Δu|·(2^-17 + r·2^-28) with N the columns of a run and Δu the greatest difference between two
/// vertices; of [`Bounded`](crate::Bounded), whose budget includes the first term, only the second. Where the budget is
/// below four steps, all runs are of one column. What vertices carry is rounded to 2^-16, and what is beyond ±16384
/// counts as that. Depth has 31 bits, of which 8 units and one for each column of the row may be
/// wrong, and is rounded to the buffer's format.
///
/// # Cost
/// A fragment: an addition for the depth and one for each component. A run: seven products of 32 bits to 64 with
/// perspective, two without, and three for each component. A triangle: about fifteen instructions for each number of
/// each vertex, which comes as `f32`, and a table instead of divisions. `docs/kernel.md` has counts for three kinds of
/// core.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedPoint<P>(
    /// How rows are divided.
    pub P,
);

impl<P: Subdivision> Interpolation for FixedPoint<P> {
    type Lanes<L: Floating> = OneFixed;
    type Triangle<L: Floating, V: Varying> = LineTriangle<P, FixedLines<V>>;
    const RUN: i32 = P::RUN;

    #[inline(always)]
    fn lanes<L: Floating>(_: L) -> OneFixed {
        OneFixed
    }

    #[inline(always)]
    fn prepare<L: Floating, S: Subpixel, D: DepthFormat, V: Varying>(
        self,
        _: L,
        triangle: &Oriented<'_, S, V>,
    ) -> LineTriangle<P, FixedLines<V>> {
        LineTriangle { policy: self.0, numbers: FixedLines::new::<S, D>(triangle) }
    }
}

/// Bits of the fraction of weights.
const WEIGHT: u32 = 30;

/// What does not get near the ends of `i32` when two of it are subtracted.
const LIMIT: i32 = (1 << 30) - 1;

/// A number of the three vertices: at the first, and what the others have more.
#[derive(Clone, Copy)]
struct Corner {
    first: i32,
    more: [i32; 2],
}

impl Corner {
    /// Numbers whose differences fit.
    #[inline(always)]
    fn new([a, b, c]: [i32; 3]) -> Self {
        Self { first: a, more: [b - a, c - a] }
    }

    /// What is added where so much is added to the weights.
    #[inline(always)]
    fn along(&self, [b, c]: [i32; 2]) -> i64 {
        i64::from(self.more[0]) * i64::from(b) + i64::from(self.more[1]) * i64::from(c)
    }

    /// Where the others have these weights, to the nearest. Weights are never too large, together not above 1, and so
    /// this is within the range of the three.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "not greater than the differences")]
    fn at(&self, weights: [i32; 2]) -> i32 {
        self.first.wrapping_sub(((self.along(weights) + (1 << (WEIGHT - 1))) >> WEIGHT) as i32)
    }
}

/// What is interpolated over a triangle, in integers.
#[derive(Clone, Copy)]
pub struct FixedLines<V: Varying> {
    /// Edge functions without their last bits, of which this is the number, are below 2^32.
    dropped: u32,
    /// The area without those bits.
    area: Reciprocal,
    /// The three q, the greatest from 2^30 to 2^31.
    q: [u32; 3],
    zs: Corner,
    /// What a column adds to the depth.
    deeper: i32,
    components: V::Of<Corner>,
}

/// The depth along a row: where it begins, and in which column.
#[derive(Clone, Copy, Debug)]
pub struct DepthRow {
    first: i32,
    zs: i32,
}

impl<V: Varying> FixedLines<V> {
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive and below 2^32")]
    fn new<S: Subpixel, D: DepthFormat>(triangle: &Oriented<'_, S, V>) -> Self {
        let bits = 64 - triangle.doubled_area.leading_zeros();
        let dropped = bits.saturating_sub(32);
        let area = (triangle.doubled_area >> dropped) as u32;
        let area = Reciprocal::new(area);

        let [a, b, c] = triangle.vertices;
        let zs = [depth::<D>(a.zs), depth::<D>(b.zs), depth::<D>(c.zs)];
        let zs = Corner::new(zs);
        // What a column adds to the edge functions of the two edges that end at the first corner, opposite the others.
        let [pa, pb, pc] = triangle.corners;
        let across = [pc[1] - pa[1], pa[1] - pb[1]];
        // Positive floats are ordered as their words are. The greatest comes to lie from 2^30 to 2^31.
        let greatest = a.q.to_bits().max(b.q.to_bits()).max(c.q.to_bits()) >> 23;
        let q = |q: f32| scaled(q, 127 + 30 - greatest.cast_signed()).max(1).unsigned_abs();
        Self {
            dropped,
            area,
            q: [q(a.q), q(b.q), q(c.q)],
            zs,
            deeper: slope(zs.along(across), area, S::BITS, dropped),
            components: V::map_by_mode(&triangle.values(), &|mode, [a, b, c, first]: [f32; 4]| {
                let q16 = |x: f32| scaled(x, 16).clamp(-LIMIT, LIMIT);
                if mode == Mode::Flat {
                    Corner::new([q16(first); 3])
                } else {
                    Corner::new([q16(a), q16(b), q16(c)])
                }
            }),
        }
    }
}

/// One over a word that is not 0.
#[derive(Clone, Copy)]
struct Reciprocal {
    /// So many bits bring the word to 2^31 or more, and `quotient` is 2^63 over that.
    normalizing: u32,
    quotient: u32,
}

impl Reciprocal {
    #[inline(always)]
    fn new(x: u32) -> Self {
        let normalizing = x.leading_zeros();
        Self { normalizing, quotient: reciprocal::<2>(x << normalizing) }
    }
}

/// `more` times 2^`bits` over the area, of which so many bits were dropped; towards 0, within the range of `i32`.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the highest 32 bits of 64, and what was found to fit")]
fn slope(more: i64, area: Reciprocal, bits: u32, dropped: u32) -> i32 {
    let normalizing = more.unsigned_abs().leading_zeros() & 63;
    let high = ((more.unsigned_abs() << normalizing) >> 32) as u32;
    let product = u64::from(high) * u64::from(area.quotient);
    let shift = (31 + normalizing + dropped).saturating_sub(bits + area.normalizing);
    let magnitude = if shift < 64 { (product >> shift).min(i32::MAX as u64) as i32 } else { 0 };
    if more < 0 { -magnitude } else { magnitude }
}

/// `zs` in the unit in which it is interpolated: the last of a format's bits is worth 2^(31 - bits), and half of that
/// is added for rounding.
#[inline(always)]
fn depth<D: DepthFormat>(zs: f32) -> i32 {
    let fraction = scaled(zs, 31).max(0);
    if D::BITS < 31 { fraction - (fraction >> D::BITS) + (1 << (30 - D::BITS)) } else { fraction }
}

/// What is known at both ends of a run.
#[derive(Clone, Copy)]
pub struct FixedEnds<V: Varying> {
    /// Proportional to q.
    q: [u32; 2],
    components: V::Of<[i32; 2]>,
}

/// The highest 32 bits of a product.
#[inline(always)]
fn high(a: u32, b: u32) -> u32 {
    ((u64::from(a) * u64::from(b)) >> 32) as u32
}

/// A part of a whole, over which 2^63 is `per_whole`, as a weight. Weights are negative: compilers see that, and then
/// have the one instruction that multiplies signed numbers.
#[inline(always)]
fn weight(part: u32, per_whole: u32) -> i32 {
    -(((u64::from(part) * u64::from(per_whole)) >> (63 - WEIGHT)) as i32)
}

impl<V: Varying> FixedLines<V> {
    /// Edge functions, in such units that the area has 32 bits.
    #[inline(always)]
    fn words<I: EdgeInt>(&self, [a, b, c]: [I; 3]) -> [u32; 3] {
        let word = |e: I| e.without_last(self.dropped) << self.area.normalizing;
        [word(a), word(b), word(c)]
    }

    /// The weights of the second and the third vertex for what is linear on the screen.
    #[inline(always)]
    fn screen(&self, [_, b, c]: [u32; 3]) -> [i32; 2] {
        [weight(b, self.area.quotient), weight(c, self.area.quotient)]
    }

    /// The same for what is linear in space, and what is proportional to q.
    #[inline(always)]
    fn space(&self, [a, b, c]: [u32; 3]) -> ([i32; 2], u32) {
        // All three together are not more than the greatest q.
        let [a, b, c] = [high(a, self.q[0]), high(b, self.q[1]), high(c, self.q[2])];
        let q = (a + b + c).max(1);
        let normalizing = q.leading_zeros();
        let per_q = reciprocal::<1>(q << normalizing);
        ([weight(b << normalizing, per_q), weight(c << normalizing, per_q)], q)
    }

    /// [`Numbers::extend`].
    #[inline(always)]
    fn extended<const HYPERBOLIC: bool>(&self, ends: &FixedEnds<V>, edges: [u32; 3]) -> FixedEnds<V> {
        // Where nothing takes these, compilers leave them out.
        let screen = self.screen(edges);
        let (space, q) = if HYPERBOLIC { self.space(edges) } else { (screen, 1) };
        FixedEnds {
            q: [ends.q[1], q],
            components: V::map_by_mode(&V::zip(&self.components, &ends.components), &|mode,
                                                                                      (
                corner,
                [_, start],
            ): (
                Corner,
                [i32; 2],
            )| match mode
            {
                Mode::Hyperbolic => [start, corner.at(space)],
                Mode::Linear => [start, corner.at(screen)],
                Mode::Flat => [corner.first; 2],
            }),
        }
    }
}

impl<V: Varying> Numbers for FixedLines<V> {
    type Row = DepthRow;
    type Ends = FixedEnds<V>;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, row: &Row<'_, I>) -> DepthRow {
        let first = row.covered.start;
        // The slope is rounded towards 0, so that no step leads beyond the range of the three.
        DepthRow { first, zs: self.zs.at(self.screen(self.words(row.at(first)))) }
    }

    #[inline(always)]
    fn begin<I: EdgeInt, const HYPERBOLIC: bool>(&self, edges: [I; 3]) -> FixedEnds<V> {
        let components = V::map(&self.components, &|_: Corner| [0; 2]);
        self.extended::<HYPERBOLIC>(&FixedEnds { q: [0; 2], components }, self.words(edges))
    }

    #[inline(always)]
    fn extend<I: EdgeInt, const HYPERBOLIC: bool>(&self, ends: &FixedEnds<V>, edges: [I; 3]) -> FixedEnds<V> {
        self.extended::<HYPERBOLIC>(ends, self.words(edges))
    }

    #[inline(always)]
    fn within(&self, ends: &FixedEnds<V>, columns: i32, budget: f32) -> bool {
        // Each may be five too small.
        let [q0, q1] = ends.q.map(u64::from);
        let apart = q0.abs_diff(q1) + 5;
        // What rounding takes is not there for perspective.
        let left = scaled(budget, 16).clamp(0, LIMIT / 2) - columns - ROUNDED;
        let Ok(left) = u64::try_from(left) else { return false };
        let limit = left * (q0.max(q1) + 3 * q0.min(q1));
        let within = Cell::new(true);
        let _ = V::map_by_mode(&ends.components, &|mode, [start, end]: [i32; 2]| {
            let missed = u64::from(end.abs_diff(start)) * apart;
            within.set(within.get() & (mode != Mode::Hyperbolic || missed <= limit));
        });
        within.get()
    }
}

/// What the rounding of the ends of a run takes of a budget, beside a unit for each of its columns.
const ROUNDED: i32 = 3;

/// Numbers at a sample, and what the next has more.
#[derive(Clone, Copy)]
pub struct FixedCursor<V: Varying> {
    zs: [i32; 2],
    components: V::Of<[i32; 2]>,
}

/// 2^32 / k, rounded down, and for 1 the greatest.
#[expect(clippy::cast_possible_truncation, reason = "from 2 on, quotients fit")]
static PER_COLUMN: [u32; LONGEST as usize + 1] = {
    let mut table = [u32::MAX; LONGEST as usize + 1];
    let mut k = 2;
    while k < table.len() {
        table[k] = ((1_u64 << 32) / k as u64) as u32;
        k += 1;
    }
    table
};

impl<V: Varying> Lines<OneFixed, V> for FixedLines<V> {
    type Cursor = FixedCursor<V>;

    #[inline(always)]
    fn line(&self, row: &DepthRow, run: &Run<FixedEnds<V>>, column: i32, _: i32) -> FixedCursor<V> {
        let [first, last] = run.columns;
        let per_column = PER_COLUMN.get((last - first).unsigned_abs() as usize).copied().unwrap_or(0);
        let along = column - first;
        let number = |[start, end]: [i32; 2]| {
            let more = i64::from(end.wrapping_sub(start));
            // Towards zero, so that no step leads beyond the end.
            let step = ((more * i64::from(per_column)) >> 32) as i32 + i32::from(more < 0);
            [start.wrapping_add(step.wrapping_mul(along)), step]
        };
        // What is interpolated has 31 bits, as differences have a sign; what comes of it has 32.
        let zs = row.zs.wrapping_add(self.deeper.wrapping_mul(column - row.first));
        FixedCursor {
            zs: [zs << 1, self.deeper << 1],
            components: V::map_by_mode(&run.ends.components, &|mode, ends: [i32; 2]| match mode {
                Mode::Hyperbolic | Mode::Linear => number(ends),
                Mode::Flat => [ends[0], 0],
            }),
        }
    }

    #[inline(always)]
    fn advance(&self, FixedCursor { zs, components }: FixedCursor<V>) -> FixedCursor<V> {
        let next = |[value, step]: [i32; 2]| [value.wrapping_add(step), step];
        FixedCursor {
            zs: next(zs),
            components: V::map_by_mode(&components, &|mode, number: [i32; 2]| {
                if mode == Mode::Flat { number } else { next(number) }
            }),
        }
    }

    #[inline(always)]
    fn depth(&self, cursor: &FixedCursor<V>) -> u32 {
        cursor.zs[0].cast_unsigned()
    }

    #[inline(always)]
    fn attributes(&self, cursor: &FixedCursor<V>) -> V::Of<Q16> {
        V::map(&cursor.components, &|[value, _]: [i32; 2]| Q16::from_bits(value))
    }
}

impl<V: Varying> fmt::Debug for FixedLines<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FixedLines").finish_non_exhaustive()
    }
}

impl<V: Varying> fmt::Debug for FixedCursor<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FixedCursor").finish_non_exhaustive()
    }
}

impl<V: Varying> fmt::Debug for FixedEnds<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FixedEnds").finish_non_exhaustive()
    }
}
