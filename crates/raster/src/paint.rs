//! From a span of covered samples to pixels: depth, attributes, colour, as many samples at a time as there are lanes.
//! This is the loop in which the time goes.

use crate::band::Band;
use crate::color::Store;
use crate::depth::DepthFormat;
use crate::edge::{Edge, EdgeInt};
use crate::fragment::FragmentStage;
use crate::interpolation::{Interpolate, Interpolation};
use crate::mask::RowMask;
use crate::spans::Span;
use alberti_math::Varying;
use alberti_math::lanes::Lanes;
use core::marker::PhantomData;
use core::ops::Range;

/// What a triangle looks like: what is interpolated over it, and the stage that makes colours of that.
pub(crate) struct Painter<'a, P, L, V, T, F> {
    pub(crate) lanes: L,
    pub(crate) triangle: T,
    pub(crate) fragment: &'a F,
    pub(crate) types: PhantomData<(P, V)>,
}

/// A row of a triangle: the covered columns, and the edge functions at one of them.
pub(crate) struct Row<'a, I> {
    pub(crate) row: i32,
    pub(crate) covered: Span,
    /// Column 0 of the edges.
    pub(crate) origin: i32,
    pub(crate) edges: &'a [Edge<I>; 3],
}

impl<P, L, V, T, F> Painter<'_, P, L, V, T, F>
where
    P: Interpolation,
    L: Lanes,
    V: Varying,
    T: Interpolate<P, L, V>,
    F: FragmentStage<V>,
{
    /// Fills what a row of the triangle covers of the columns in `limits`, and counts the pixels covered and written.
    #[inline(always)]
    pub(crate) fn row<I, C, D>(
        &self,
        band: &mut Band<'_, C, D>,
        row: &Row<'_, I>,
        limits: &Range<i32>,
    ) -> [u32; 2]
    where
        I: EdgeInt,
        C: Store<F::Color>,
        D: DepthFormat,
    {
        const {
            assert!(T::RUN > 0 && T::RUN.count_ones() == 1, "a run's length must be a power of two");
        }
        let mut counts = [0; 2];
        // From the run that the limits begin in.
        let mut first = row.covered.start.max(limits.start & !(T::RUN - 1));
        while first < row.covered.end.min(limits.end) {
            let end = row.covered.end.min((first | (T::RUN - 1)) + 1);
            let columns = first.max(limits.start)..end.min(limits.end);
            if columns.start < columns.end {
                let run = Span { start: first, end: end.min(row.covered.end - 1) };
                let cursor = self.triangle.start(row.row, run, aligned::<L>(columns.start));
                counts[0] += columns.end.abs_diff(columns.start);
                counts[1] += self.run(band, row, columns, cursor);
            }
            first = end;
        }
        counts
    }

    /// Fills those samples of a row whose bits are set, counted from column `left`; all of them lie in one run.
    #[inline(always)]
    pub(crate) fn masked<C, D>(
        &self,
        band: &mut Band<'_, C, D>,
        row: i32,
        left: i32,
        mut bits: u32,
        mask: &RowMask<L>,
    ) -> u32
    where
        C: Store<F::Color>,
        D: DepthFormat,
    {
        let first = left + bits.trailing_zeros().cast_signed();
        let last = left + 31 - bits.leading_zeros().cast_signed();
        let mut cursor = self.triangle.start(row, Span { start: first, end: last }, left);
        let (mut colors, mut depths) = band.pixels_from(row, left);
        let (mut values, mut written, mut column) = (mask.first(), 0, left);
        loop {
            let group = bits & all::<L>();
            if colors.len() < L::COUNT || depths.len() < L::COUNT {
                let edges = mask.edges([column, row]);
                return written + self.end::<i64, C, D>(colors, depths, group, cursor, &edges);
            }
            let (Some((color, next_colors)), Some((depth, next_depths))) =
                (L::split(colors), L::split(depths))
            else {
                return written;
            };
            if group != 0 {
                written += self.group::<C, D>(color, depth, group, &cursor, &mask.weights(values));
            }
            bits >>= L::COUNT;
            if bits == 0 {
                return written;
            }
            (colors, depths) = (next_colors, next_depths);
            column += L::STEP;
            cursor = self.triangle.advance(cursor);
            values = mask.right(values);
        }
    }

    /// Fills a run of samples. The last lanes may look at pixels beyond it, which they leave alone.
    #[inline(always)]
    fn run<I, C, D>(
        &self,
        band: &mut Band<'_, C, D>,
        row: &Row<'_, I>,
        columns: Range<i32>,
        mut cursor: T::Cursor,
    ) -> u32
    where
        I: EdgeInt,
        C: Store<F::Color>,
        D: DepthFormat,
    {
        let lanes = self.lanes;
        let mut column = aligned::<L>(columns.start);
        let offset = I::from(column - row.origin);
        let [a, b, c] = row.edges;
        let ramp = |e: &Edge<I>| I::ramp(lanes, e.value + e.step_x * offset, e.step_x);
        let mut edges = [ramp(a), ramp(b), ramp(c)];
        let (mut colors, mut depths) = band.pixels_from(row.row, column);
        let (mut bits, mut written) = (all::<L>() << (columns.start - column), 0);
        loop {
            let left = columns.end - column;
            if left < L::STEP {
                bits &= (1 << left) - 1;
            }
            if colors.len() < L::COUNT || depths.len() < L::COUNT {
                let offset = I::from(column - row.origin);
                let at = |e: &Edge<I>| Edge { value: e.value + e.step_x * offset, ..*e };
                let edges = [at(a), at(b), at(c)];
                return written + self.end::<I, C, D>(colors, depths, bits & all::<L>(), cursor, &edges);
            }
            let (Some((color, next_colors)), Some((depth, next_depths))) =
                (L::split(colors), L::split(depths))
            else {
                return written;
            };
            let [ea, eb, ec] = edges;
            let weights = [I::weights(lanes, ea), I::weights(lanes, eb), I::weights(lanes, ec)];
            written += self.group::<C, D>(color, depth, bits & all::<L>(), &cursor, &weights);
            if left <= L::STEP {
                return written;
            }
            (colors, depths) = (next_colors, next_depths);
            column += L::STEP;
            bits = all::<L>();
            cursor = self.triangle.advance(cursor);
            let advance = |at, e: &Edge<I>| I::advance(lanes, at, e.step_x * I::from(L::STEP));
            edges = [advance(ea, a), advance(eb, b), advance(ec, c)];
        }
    }

    /// Fills the last samples of a band, fewer than there are lanes, by way of a copy. `edges` are those at the first.
    #[cold]
    #[inline(never)]
    fn end<I, C, D>(
        &self,
        colors: &mut [C::Pixel],
        depths: &mut [D::Stored],
        bits: u32,
        cursor: T::Cursor,
        [a, b, c]: &[Edge<I>; 3],
    ) -> u32
    where
        I: EdgeInt,
        C: Store<F::Color>,
        D: DepthFormat,
    {
        let lanes = self.lanes;
        let (Some(&pixel), Some(&stored)) = (colors.first(), depths.first()) else { return 0 };
        let mut color = lanes.each(|k| colors.get(k).copied().unwrap_or(pixel));
        let mut depth = lanes.each(|k| depths.get(k).copied().unwrap_or(stored));
        let written = lanes.vectorize(
            #[inline(always)]
            || {
                let weight = |e: &Edge<I>| I::weights(lanes, I::ramp(lanes, e.value, e.step_x));
                self.group::<C, D>(&mut color, &mut depth, bits, &cursor, &[weight(a), weight(b), weight(c)])
            },
        );
        colors.iter_mut().zip(color.as_ref()).for_each(|(pixel, copy)| *pixel = *copy);
        depths.iter_mut().zip(depth.as_ref()).for_each(|(stored, copy)| *stored = *copy);
        written
    }

    /// Fills those samples of a group whose bits are set, and counts those written.
    #[inline(always)]
    fn group<C, D>(
        &self,
        color: &mut L::Each<C::Pixel>,
        depth: &mut L::Each<D::Stored>,
        bits: u32,
        cursor: &T::Cursor,
        weights: &[L::F32; 3],
    ) -> u32
    where
        C: Store<F::Color>,
        D: DepthFormat,
    {
        let lanes = self.lanes;
        let zs = D::encode_lanes(lanes, self.triangle.depth(cursor, weights));
        let seen = D::seen(lanes, &zs, depth, lanes.mask(bits));
        if lanes.bits(seen) == 0 {
            return 0;
        }
        let varyings = self.triangle.attributes(cursor, weights);
        let (words, kept) = self.fragment.shade_lanes(lanes, &varyings, seen);
        C::store(lanes, words, kept, color);
        D::keep(lanes, &zs, kept, depth);
        lanes.bits(kept).count_ones()
    }
}

/// The column at which the lanes of a sample begin: a multiple of their number, so that all triangles read and write the
/// same words of memory, which a machine can then pass on from one to the next before they have reached it.
#[inline(always)]
pub(crate) fn aligned<L: Lanes>(column: i32) -> i32 {
    column & !(L::STEP - 1)
}

/// A bit for each lane.
#[inline(always)]
fn all<L: Lanes>() -> u32 {
    (1 << L::COUNT) - 1
}
