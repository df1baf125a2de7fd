//! Lines in fixed point: integers only, from the vertices' numbers to the pixel.
#![expect(missing_debug_implementations, reason = "states of drawing, which have no name outside")]

use super::budget::{on_screen, units};
use super::fixed_plane::{Area, FixedPlane, Shape};
use super::floating::one_run;
use super::lines::{Course, LineNumbers, LineTriangle, Lines, Run, Runs};
use crate::differentiation::FixedQuotients;
use crate::edge::EdgeInt;
use crate::fragment::FragmentStage;
use crate::interpolation::{Interpolation, Oriented, Prepare, Row};
use crate::small::{self, Grid};
use crate::target::Target;
use crate::triangle::{Corner, Numbers};
use crate::{ColorFormat, Counters, DepthFormat, Paint};
use alberti_math::lanes::{Floating, OneFixed};
use alberti_math::{Mode, Q16, Sub8, Varying, map2, map3, reciprocal};
use core::cell::Cell;

/// The policy `R` of straight lines ([`Spans16`](crate::Spans16), [`Affine`](crate::Affine) or [`Lines`]) in fixed
/// point: for machines without floating point. One sample at a time, with as many additions as there are numbers; the
/// same bits on every machine.
///
/// # Precision
/// The error is at most the bound of `R` plus (N + 3)·2^-16 + |Δu|·(2^-17 + r·(C + 4)·3·2^-29). N are the columns of a
/// run, C those of the row, Δu is the greatest difference between two vertices, and r the greatest ratio of q in the
/// triangle. The bound holds for components in ±4096 and r up to 2^20. For [`Lines::bounded`], whose budget includes
/// the first term, only the second is added. A budget below four steps is not kept: all runs are of one column then,
/// and the first term is 4·2^-16.
///
/// The reason for the last term: slopes by column are short of right by up to a unit. Along C columns that moves q by
/// up to C·2^-30 of the greatest one, and the excess of q·u over a vertex by as much of 2^-29. Where q is the least,
/// the quotient is off by r·C·(2^-30 + 2^-28)·|Δu|, and a sixth of that more as the divisor is off too. Where the term
/// is above |Δu|, values stay within their range.
///
/// Varyings are rounded to 2^-16, and beyond ±4096 they count as that. A closure gets them as `f32`, which rounds by
/// up to ε·max|ui| beyond 256, ε = 2^-24. Depth has 31 bits, of which 8 units and one for
/// each column of the row may be wrong, and is rounded to the buffer's format.
///
/// Triangles whose corners are less than 16 pixels apart on both axes, or 32 on the grid of `Sub4`, are drawn as one
/// run. There the error is the miss of a straight line over the triangle and 1.5·2^-16; of depths in 16 bits, 2^-20
/// more. With n the pixels of the box's longer side, the line misses at most |Δu|/(4n), or the budget if there is one.
/// So without a budget the ratio of q is at most about 1 + 1/n; it is never above 2, and q are normal numbers.
/// Steeper ones are drawn in runs, and all under a policy of runs below 16 columns. So are those that carry more than
/// 16, or differ in depth by more than 2^-10 (of depths in 16 bits, 1/4).
///
/// `Sub4` is the cheapest. On the grid of `Sub8` components may differ by less than 1, and depths by a quarter of that.
///
/// # Cost
/// A fragment: an addition for the depth and one for each component. A run: a product for each component, and with
/// perspective one of 32 bits to 64 more and two for the reciprocal. A row: two of 32 bits to 64 for each number. A
/// triangle: some sixty instructions for the plane through each three. A vertex: about fifteen instructions for each
/// number. A small triangle: ten products of 32 bits for each number, and two a row; twelve divisions on the grid of
/// `Sub8`. `docs/kernel.md` has counts for three kinds of core.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedPoint<R>(
    /// The division of rows.
    pub R,
);

impl<R: Runs> Interpolation for FixedPoint<R> {}

impl<R: Runs> Prepare for FixedPoint<R> {
    type Lanes<L: Floating> = OneFixed;
    type Triangle<L: Floating, V: Varying> = LineTriangle<R, FixedLines<V>>;
    const HAS_SMALL: bool = true;

    #[inline(always)]
    fn run(self) -> i32 {
        one_run(self.0)
    }

    #[inline(always)]
    fn numbers(self, depth: impl DepthFormat) -> Numbers {
        Numbers::Fixed { depth_bits: depth.bits() }
    }

    #[inline(always)]
    fn lanes<L: Floating>(self, _: L) -> OneFixed {
        OneFixed
    }

    #[inline(always)]
    fn draw_small<G, V, F, C, D, K>(
        self,
        grid: G,
        paint: &Paint<F, Self>,
        target: &mut Target<'_, C, D>,
        corners: [&Corner<V>; 3],
        counters: &mut K,
    ) -> bool
    where
        G: Grid,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let Paint { stage, subpixel, .. } = *paint;
        self.0.length() >= small::RUN
            && grid.is_fine() == (subpixel == Sub8)
            && small::draw(grid, self.0, stage, target, corners, counters)
    }

    #[inline(always)]
    fn prepare<L: Floating, V: Varying>(
        self,
        _: L,
        triangle: &Oriented<'_, V>,
        area: Area,
    ) -> LineTriangle<R, FixedLines<V>> {
        let runs = self.0.of_triangle(|budget| on_screen(units(budget), triangle));
        LineTriangle { runs, numbers: FixedLines::new(runs, triangle, area) }
    }
}

/// The greatest component; the least is one less than its negative. So two of them differ by less than 2^29.
pub(crate) const LIMIT: i32 = (1 << 28) - 1;

/// One component over a triangle.
#[derive(Clone, Copy)]
struct FixedComponent {
    /// The value at the first vertex; and the least and the greatest of the three.
    first: i32,
    least: i32,
    greatest: i32,
    /// The excess over the first vertex, times a power of two, and times q where that is divided again.
    plane: FixedPlane,
    /// The number of bits that are too many after that.
    shift: u32,
}

impl FixedComponent {
    /// A component of these values. `q` is proportional to that of the three vertices, for hyperbolic components.
    #[inline(always)]
    fn new(shape: &Shape, values: [u32; 3], q: Option<[i32; 3]>) -> Self {
        let [a, b, c] = map3(values, u32::cast_signed);
        let more = [b - a, c - a];
        // The greatest comes to lie from 2^29 to 2^30, and so this is at least 1.
        let shift = (more[0].unsigned_abs() | more[1].unsigned_abs() | 1).leading_zeros() - 2;
        let more = [more[0] << shift, more[1] << shift];
        let (more, shift) = match q {
            Some([_, qb, qc]) => ([times(more[0], qb), times(more[1], qc)], shift - 1),
            None => (more, shift),
        };
        Self {
            first: a,
            least: a.min(b).min(c),
            greatest: a.max(b).max(c),
            plane: shape.plane([0, more[0], more[1]]),
            shift,
        }
    }

    /// The component where its excess over the first vertex is `more`, in the plane's unit.
    #[inline(always)]
    fn value(&self, more: i32) -> i32 {
        self.first.wrapping_add(more >> self.shift).max(self.least).min(self.greatest)
    }
}

/// The interpolated numbers of a triangle, in integers.
#[derive(Clone, Copy)]
pub struct FixedLines<V: Varying> {
    shape: Shape,
    /// The value at the first vertex, and the plane.
    zs: (i32, FixedPlane),
    /// The same for a multiple of q, the greatest of the three from 2^30 to 2^31.
    q: (i32, FixedPlane),
    components: V::Of<FixedComponent>,
    /// The units of the budget, if there is one.
    budget: i32,
}

impl<V: Varying> FixedLines<V> {
    /// Not inlined, as it is long.
    #[inline(never)]
    fn new(runs: impl Runs, triangle: &Oriented<'_, V>, area: Area) -> Self {
        let (shape, perspective) = (Shape::new(triangle, area), runs.perspective());
        let [a, b, c] = triangle.vertices;
        let zs = [a.zs.cast_signed(), b.zs.cast_signed(), c.zs.cast_signed()];
        // Positive floats are ordered as their words are.
        let greatest = a.q.max(b.q).max(c.q) >> 23;
        let q = if perspective { [a.q, b.q, c.q].map(|q| relative(q, greatest)) } else { [1; 3] };
        Self {
            shape,
            zs: (zs[0], shape.plane(zs)),
            q: (q[0], if perspective { shape.plane(q) } else { FixedPlane { more: [0; 2], slope: 0 } }),
            components: V::map_by_mode(&triangle.words(), &|mode, [a, b, c, first]: [u32; 4]| match mode {
                Mode::Hyperbolic if perspective => FixedComponent::new(&shape, [a, b, c], Some(q)),
                Mode::Hyperbolic | Mode::Linear => FixedComponent::new(&shape, [a, b, c], None),
                Mode::Flat => FixedComponent::new(&shape, [first; 3], None),
            }),
            budget: runs.budget().map_or(0, units),
        }
    }
}

/// A positive `f32` in units of 2^(e - 157), to the nearest and at least 1. e is the biased exponent of the greatest,
/// which comes to lie from 2^30 to 2^31 unless it is subnormal.
#[inline(always)]
pub(crate) fn relative(word: u32, e: u32) -> i32 {
    let exponent = word >> 23;
    let mantissa = (word << 9 >> 2) | u32::from(exponent != 0) << 30;
    let shift = e.max(1) - exponent.max(1);
    let halves = mantissa.checked_shl(1).unwrap_or(0).checked_shr(shift).unwrap_or(0);
    (halves.wrapping_add(1) >> 1).max(1).cast_signed()
}

/// The product of a number and a positive one over 2^31, rounded down.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "smaller than the first")]
fn times(more: i32, q: i32) -> i32 {
    ((i64::from(more) * i64::from(q)) >> 31) as i32
}

/// The state of a row: the numbers at its first covered sample.
#[derive(Clone, Copy)]
pub struct FixedRow<V: Varying> {
    first: i32,
    zs: i32,
    q: i32,
    components: V::Of<i32>,
}

/// The state at both ends of a run.
#[derive(Clone, Copy)]
pub struct FixedEnds<V: Varying> {
    /// Proportional to q.
    q: [u32; 2],
    components: V::Of<[i32; 2]>,
}

/// Half of `more` divided by q, where `more` is the excess over the first vertex times q. At the sample q has
/// `normalizing` leading zeros, and `per_q` is 2^62 over q without those.
#[inline(always)]
fn divided(more: i32, normalizing: u32, per_q: i32) -> i32 {
    let shifted = more << normalizing;
    // Where q is as small as what was rounded, quotients may be anything.
    let fits = shifted >> normalizing == more;
    let shifted = if fits { shifted } else { (more >> 31) ^ i32::MAX };
    ((i64::from(shifted) * i64::from(per_q)) >> 32) as i32
}

/// The units of a budget for the rounding of the ends of a run, beside one for each of its columns.
pub(super) const ROUNDED_ENDS: i32 = 3;

/// Numbers at a sample, and their increments to the next.
#[derive(Clone, Copy)]
pub struct FixedCursor<V: Varying> {
    zs: u32,
    deeper: u32,
    components: V::Of<i32>,
    steps: V::Of<i32>,
}

/// 2^32 / k, rounded down, and for 1 the greatest.
#[expect(clippy::cast_possible_truncation, reason = "from 2 on, quotients fit")]
static PER_COLUMN: [u32; Lines::LONGEST as usize + 1] = {
    let mut table = [u32::MAX; Lines::LONGEST as usize + 1];
    let mut k = 2;
    while k < table.len() {
        table[k] = ((1_u64 << 32) / k as u64) as u32;
        k += 1;
    }
    table
};

impl<V: Varying> LineNumbers<OneFixed, V> for FixedLines<V> {
    type Row = FixedRow<V>;
    type Ends = FixedEnds<V>;
    type Cursor = FixedCursor<V>;
    type Quotients = FixedQuotients<V>;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, perspective: bool, row: &Row<'_, I>) -> FixedRow<V> {
        let first = row.covered.start;
        let weights = self.shape.weights(row.at(first));
        FixedRow {
            first,
            // Slopes are rounded towards 0, so that no step leads beyond the range of the three.
            zs: self.zs.0.wrapping_add(self.zs.1.at(weights)),
            q: if perspective { self.q.0.wrapping_add(self.q.1.at(weights)) } else { 1 },
            components: V::map(&self.components, &|component: FixedComponent| component.plane.at(weights)),
        }
    }

    #[inline(always)]
    fn begin<I: EdgeInt>(
        &self,
        perspective: bool,
        row: &Row<'_, I>,
        known: &FixedRow<V>,
        column: i32,
    ) -> FixedEnds<V> {
        let components = V::map(&self.components, &|_: FixedComponent| [0; 2]);
        let FixedEnds { q: [_, q], components } =
            self.extend(perspective, row, known, &FixedEnds { q: [0; 2], components }, column);
        FixedEnds { q: [q; 2], components: V::map(&components, &|[_, value]: [i32; 2]| [value; 2]) }
    }

    #[inline(always)]
    fn extend<I: EdgeInt>(
        &self,
        perspective: bool,
        _: &Row<'_, I>,
        known: &FixedRow<V>,
        ends: &FixedEnds<V>,
        column: i32,
    ) -> FixedEnds<V> {
        let columns = column - known.first;
        let along = |first: i32, plane: &FixedPlane| first.wrapping_add(plane.slope.wrapping_mul(columns));
        let q = if perspective { along(known.q, &self.q.1).max(1).cast_unsigned() } else { 1 };
        let normalizing = q.leading_zeros();
        let per_q = if perspective { (reciprocal::<1>(q << normalizing) >> 1).cast_signed() } else { 0 };
        let components = V::zip(&V::zip(&self.components, &known.components), &ends.components);
        FixedEnds {
            q: [ends.q[1], q],
            components: V::map_by_mode(&components, &|mode, parts| {
                let ((component, known), [_, start]): ((FixedComponent, i32), [i32; 2]) = parts;
                let more = along(known, &component.plane);
                match mode {
                    Mode::Hyperbolic if perspective => {
                        [start, component.value(divided(more, normalizing, per_q))]
                    }
                    Mode::Hyperbolic | Mode::Linear => [start, component.value(more)],
                    Mode::Flat => [component.first; 2],
                }
            }),
        }
    }

    const SEARCHES: bool = true;

    #[inline(always)]
    fn has_room(&self, columns: i32) -> bool {
        self.budget >= columns + ROUNDED_ENDS
    }

    #[inline(always)]
    fn within(&self, known: &FixedRow<V>, ends: &FixedEnds<V>, [first, last]: [i32; 2]) -> bool {
        // Each may be off by a unit for each column of the row, and a few at its first.
        let off = u64::from((last - known.first).cast_unsigned()) + 5;
        let [q0, q1] = map2(ends.q, u64::from);
        let apart = q0.abs_diff(q1) + 2 * off;
        // The units for rounding are not there for perspective.
        let left = self.budget - (last - first) - ROUNDED_ENDS;
        let Ok(left) = u64::try_from(left) else { return false };
        let limit = left * (q0.max(q1) + 3 * q0.min(q1)).saturating_sub(4 * off);
        let within = Cell::new(true);
        let _ = V::map_by_mode(&ends.components, &|mode, [start, end]: [i32; 2]| {
            let missed = u64::from(end.abs_diff(start)) * apart;
            within.set(within.get() & (mode != Mode::Hyperbolic || missed <= limit));
        });
        within.get()
    }

    #[inline(always)]
    fn line<I: EdgeInt>(
        &self,
        _: Course,
        _: &Row<'_, I>,
        row: &FixedRow<V>,
        run: &Run<FixedEnds<V>>,
        [column, _]: [i32; 2],
    ) -> FixedCursor<V> {
        let [first, last] = run.columns;
        let (columns, along) = (last - first, column - first);
        let whole = columns == run.length;
        let per_column = || PER_COLUMN.get(columns.cast_unsigned() as usize).copied().unwrap_or(0);
        let per_column = if whole { 0 } else { per_column() };
        let number = |[start, end]: [i32; 2]| {
            let more = end.wrapping_sub(start);
            // Towards zero, so that no step leads beyond the end.
            let step = if whole {
                more.wrapping_add((more >> 31) & (run.length - 1)) >> run.length.trailing_zeros()
            } else {
                ((i64::from(more) * i64::from(per_column)) >> 32) as i32 + i32::from(more < 0)
            };
            [start.wrapping_add(step.wrapping_mul(along)), step]
        };
        // Interpolated depths have 31 bits, as differences have a sign; the result has 32.
        let slope = self.zs.1.slope;
        let zs = row.zs.wrapping_add(slope.wrapping_mul(column - row.first));
        let lines = V::map_by_mode(&run.ends.components, &|mode, ends: [i32; 2]| match mode {
            Mode::Hyperbolic | Mode::Linear => number(ends),
            Mode::Flat => [ends[0], 0],
        });
        FixedCursor {
            zs: (zs << 1).cast_unsigned(),
            deeper: (slope << 1).cast_unsigned(),
            components: V::map(&lines, &|[start, _]: [i32; 2]| start),
            steps: V::map(&lines, &|[_, step]: [i32; 2]| step),
        }
    }

    #[inline(always)]
    fn advance(&self, cursor: FixedCursor<V>) -> FixedCursor<V> {
        let numbers = V::zip(&cursor.components, &cursor.steps);
        FixedCursor {
            zs: cursor.zs.wrapping_add(cursor.deeper),
            components: V::map_by_mode(&numbers, &|mode, (value, step): (i32, i32)| {
                if mode == Mode::Flat { value } else { value.wrapping_add(step) }
            }),
            ..cursor
        }
    }

    #[inline(always)]
    fn depth(&self, cursor: &FixedCursor<V>) -> u32 {
        cursor.zs
    }

    #[inline(always)]
    fn attributes(&self, cursor: &FixedCursor<V>) -> V::Of<Q16> {
        V::map(&cursor.components, &Q16::from_bits)
    }
}
