//! From a span of covered samples to pixels: depth, attributes, colour, as many samples at a time as there are lanes.
//! This is the loop in which the time goes.

use crate::color::ColorFormat;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::differentiation::{Differentiate, Samples};
use crate::edge::{Edge, EdgeInt};
use crate::fragment::{FragmentStage, Fragments};
use crate::interpolation::{Interpolate, Row};
use crate::mask::RowMask;
use crate::pixels::Pixels;
use crate::spans::Span;
use crate::target::Target;
use crate::weights::Weights;
use alberti_math::lanes::Lanes;
use alberti_math::{LOW_WORDS_ONLY, Varying};
use core::hint::black_box;
use core::marker::PhantomData;
use core::ops::Range;
use core::slice::from_mut;

/// A prepared triangle: its depth and attributes, their derivatives, and the stage that makes colours of them.
pub(crate) struct Painter<L: Lanes, V: Varying, T: Interpolate<L, V>, F: FragmentStage<V>> {
    pub(crate) lanes: L,
    pub(crate) triangle: T,
    pub(crate) derivatives: <F::Derivatives as Differentiate>::Triangle<L, V, T::Quotients>,
    pub(crate) stage: F,
    pub(crate) varying: PhantomData<V>,
}

/// A run of samples: its attributes, and their derivatives.
type RunState<T, D, L, V> = (<T as Interpolate<L, V>>::Cursor, RunDerivatives<T, D, L, V>);
type RunDerivatives<T, D, L, V> = <D as Differentiate>::Run<L, V, <T as Interpolate<L, V>>::Quotients>;

impl<L, V, T, F> Painter<L, V, T, F>
where
    L: Lanes,
    V: Varying,
    T: Interpolate<L, V>,
    F: FragmentStage<V>,
{
    /// Whether no sample asks which others a row covers, as rows and runs have no state.
    pub(crate) const EVERYWHERE: bool = size_of::<(T::Row, RunState<T, F::Derivatives, L, V>)>() == 0;

    /// Fills the columns in `limits` that a row of the triangle covers.
    #[inline(always)]
    pub(crate) fn row<I, C, D, K>(
        &self,
        target: &mut Target<'_, C, D>,
        row: &Row<'_, I>,
        limits: &Range<i32>,
        weights: &Weights<L>,
        counters: &mut K,
    ) where
        I: EdgeInt,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let end = row.covered.end.min(limits.end);
        let mut column = row.covered.start.max(limits.start);
        if const { L::COUNT == 1 } {
            let formats = (target.color_format(), target.depth_format());
            let pixels = target.pixels_from(row.row, column);
            self.row_alone::<I, C, D, K>(row, self.triangle.row(row), formats, pixels, column..end, counters);
            return;
        }
        if column >= end {
            return;
        }
        let (formats, left) = ((target.color_format(), target.depth_format()), aligned::<L>(column));
        let (colors, depths) = target.pixels_from(row.row, left);
        let ((colors, last_colors), (depths, last_depths)) = (L::groups(colors), L::groups(depths));
        let last = (last_colors, last_depths);
        let (covered, mut written, mut known) = (end.abs_diff(column), 0, self.triangle.row(row));
        while column < end {
            let aligned = aligned::<L>(column);
            let (cursor, run) = self.start(row, &mut known, column, aligned);
            let stop = run.end.min(end);
            // Groups before the run, and with it.
            let [before, with] = [aligned - left, stop - left + L::STEP - 1];
            let [before, with] = [before, with].map(|samples| samples.unsigned_abs() as usize / L::COUNT);
            let end = with.min(colors.len());
            let groups = (
                colors.get_mut(before..end).unwrap_or_default(),
                depths.get_mut(before..end).unwrap_or_default(),
            );
            let last = (&mut *last.0, &mut *last.1);
            written += self.run(formats, groups, last, (row, weights), column..stop, cursor);
            column = stop;
        }
        counters.span(covered, written);
    }

    /// [`row`](Self::row) for one lane, into the pixels from the first of `columns` on. Not inlined, so that the values
    /// which the loops need are in registers.
    #[inline(never)]
    fn row_alone<I, C, D, K>(
        &self,
        row: &Row<'_, I>,
        mut known: T::Row,
        formats: (C, D),
        mut pixels: Pixels<'_, C::Pixel, D::Stored>,
        columns: Range<i32>,
        counters: &mut K,
    ) where
        I: EdgeInt,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let (mut covered, mut written, mut column) = (0, 0, columns.start);
        while column < columns.end {
            let (cursor, run) = self.start(row, &mut known, column, column);
            let stop = run.end.min(columns.end);
            let count = (stop - column).cast_unsigned();
            let here;
            (here, pixels) = split(pixels, count as usize);
            covered += count;
            written += self.alone(row, formats, here, column, &cursor);
            column = stop;
        }
        counters.span(covered, written);
    }

    /// The run that a column is in, and its state at the samples from `aligned` on.
    #[inline(always)]
    fn start<I: EdgeInt>(
        &self,
        row: &Row<'_, I>,
        known: &mut T::Row,
        column: i32,
        aligned: i32,
    ) -> (RunState<T, F::Derivatives, L, V>, Span) {
        let (cursor, run) = self.triangle.start(row, known, column, aligned);
        ((cursor, self.stage.derivatives().run(self.lanes, &self.derivatives, row, run)), run)
    }

    /// Fills pixels one by one, from `column` on. Not inlined, for the same reason.
    #[inline(never)]
    fn alone<I, C, D>(
        &self,
        row: &Row<'_, I>,
        formats: (C, D),
        (colors, depths): Pixels<'_, C::Pixel, D::Stored>,
        column: i32,
        (first, derivatives): &RunState<T, F::Derivatives, L, V>,
    ) -> u32
    where
        I: EdgeInt,
        C: ColorFormat,
        D: DepthFormat,
    {
        let lanes = self.lanes;
        let ([a, b, c], at) = (row.edges, row.at(column));
        let ramp = |at: I, e: &Edge<I>| I::ramp(lanes, at, e.step_x);
        let mut next = Next {
            cursor: *first,
            edges: [ramp(at[0], a), ramp(at[1], b), ramp(at[2], c)],
            steps: [a.step_x, b.step_x, c.step_x],
            place: [column, row.row],
            written: 0,
        };
        let (mut colors, mut depths) = (L::groups(colors).0, L::groups(depths).0);
        if const { pairs::<L, V>() } {
            let (pairs, last_color) = colors.as_chunks_mut();
            let (pairs_of_depths, last_depth) = depths.as_chunks_mut();
            for ([color, second_color], [depth, second_depth]) in pairs.iter_mut().zip(pairs_of_depths) {
                self.next(formats, (color, depth), derivatives, &mut next);
                self.next(formats, (second_color, second_depth), derivatives, &mut next);
            }
            (colors, depths) = (last_color, last_depth);
        }
        for pixel in colors.iter_mut().zip(depths) {
            self.next(formats, pixel, derivatives, &mut next);
        }
        next.written
    }

    /// Fills a pixel, and goes to the next.
    #[inline(always)]
    fn next<I, C, D>(
        &self,
        formats: (C, D),
        pixel: Group<'_, L, C::Pixel, D::Stored>,
        derivatives: &RunDerivatives<T, F::Derivatives, L, V>,
        next: &mut Next<T::Cursor, I::Of<L>, I>,
    ) where
        I: EdgeInt,
        C: ColorFormat,
        D: DepthFormat,
    {
        as_it_stands();
        let (lanes, [ea, eb, ec]) = (self.lanes, next.edges);
        let weights = [I::weights(lanes, ea), I::weights(lanes, eb), I::weights(lanes, ec)];
        let known = (&next.cursor, derivatives);
        next.written += self.group(formats, pixel, lanes.mask(1), known, (next.place, &weights));
        next.cursor = self.triangle.advance(next.cursor);
        let advance = |edge, k: usize| I::advance(lanes, edge, next.steps[k]);
        next.edges = [advance(ea, 0), advance(eb, 1), advance(ec, 2)];
        next.place[0] += 1;
    }

    /// Fills those samples of a row whose bits are set, counted from column `left`, where the pixels begin; all of them
    /// lie in one run.
    #[inline(always)]
    pub(crate) fn masked<C, D>(
        &self,
        formats: (C, D),
        (colors, depths): Pixels<'_, C::Pixel, D::Stored>,
        [left, row]: [i32; 2],
        mut bits: u32,
        mask: &RowMask<L>,
        counters: &mut impl Counters,
    ) where
        C: ColorFormat,
        D: DepthFormat,
    {
        let covered = Span {
            start: left + bits.trailing_zeros().cast_signed(),
            end: left + 32 - bits.leading_zeros().cast_signed(),
        };
        let edges = mask.edges([left, row]);
        let whole = Row { row, covered, origin: left, edges: &edges };
        let mut known = self.triangle.row(&whole);
        let ((mut cursor, derivatives), _) = self.start(&whole, &mut known, covered.start, left);
        let ((mut colors, last_colors), (mut depths, last_depths)) = (L::groups(colors), L::groups(depths));
        let (mut values, mut written, mut column, mut copy) = (mask.first(), 0, left, None);
        let mut covered_samples = 0;
        loop {
            for (color, depth) in colors.iter_mut().zip(depths) {
                let (group, some) = if const { Self::EVERYWHERE } {
                    let group = mask.covered(values);
                    let bits = self.lanes.bits(group);
                    covered_samples += bits.count_ones();
                    (group, bits != 0)
                } else {
                    let bits = bits & all::<L>();
                    covered_samples += bits.count_ones();
                    (self.lanes.mask(bits), bits != 0)
                };
                if some {
                    let weights = mask.weights(values);
                    let known = (&cursor, &derivatives);
                    written += self.group(formats, (color, depth), group, known, ([column, row], &weights));
                }
                bits >>= L::COUNT;
                if bits == 0 {
                    break;
                }
                column += L::STEP;
                cursor = self.triangle.advance(cursor);
                values = mask.right(values);
            }
            if bits == 0 || copy.is_some() {
                break;
            }
            let Some(group) = copied(self.lanes, last_colors, last_depths) else { break };
            let (color, depth) = copy.insert(group);
            (colors, depths) = (from_mut(color), from_mut(depth));
        }
        if let Some(copy) = &copy {
            put_back::<L, _, _>(copy, last_colors, last_depths);
        }
        if covered_samples > 0 {
            counters.span(covered_samples, written);
        }
    }

    /// Fills a run of samples in whole groups of pixels and, if these do not suffice, in the band's last ones. The last
    /// lanes may look at pixels beyond it, which they leave alone.
    #[inline(always)]
    fn run<I, C, D>(
        &self,
        formats: (C, D),
        (mut colors, mut depths): Pixels<'_, L::Each<C::Pixel>, L::Each<D::Stored>>,
        (last_colors, last_depths): Pixels<'_, C::Pixel, D::Stored>,
        (row, weights): (&Row<'_, I>, &Weights<L>),
        columns: Range<i32>,
        (mut cursor, derivatives): RunState<T, F::Derivatives, L, V>,
    ) -> u32
    where
        I: EdgeInt,
        C: ColorFormat,
        D: DepthFormat,
    {
        let lanes = self.lanes;
        let left = aligned::<L>(columns.start);
        let (mut edges, mut groups) = (weights.parts(row.at(left)), weights.groups());

        let mut mask = lanes.mask(all::<L>() << (columns.start - left));
        let (mut column, mut written, mut copy) = (left, 0, None);
        loop {
            for (color, depth) in colors.iter_mut().zip(depths) {
                let remaining = columns.end - column;
                if remaining < L::STEP {
                    mask = mask & lanes.mask((1 << remaining) - 1);
                }
                let (known, place) = ((&cursor, &derivatives), [column, row.row]);
                written += self.group(formats, (color, depth), mask, known, (place, &weights.at(&edges)));
                mask = lanes.mask(all::<L>());
                column += L::STEP;
                cursor = self.triangle.advance(cursor);
                groups -= 1;
                edges = if groups > 0 {
                    weights.next(&edges)
                } else {
                    groups = weights.groups();
                    weights.parts(row.at(column))
                };
            }
            if column >= columns.end || copy.is_some() {
                break;
            }
            let Some(group) = copied(lanes, last_colors, last_depths) else { break };
            let (color, depth) = copy.insert(group);
            (colors, depths) = (from_mut(color), from_mut(depth));
        }
        if let Some(copy) = &copy {
            put_back::<L, _, _>(copy, last_colors, last_depths);
        }
        written
    }

    /// Fills those samples of a group that the mask has, and counts those written.
    #[inline(always)]
    fn group<C, D>(
        &self,
        (color_format, depth_format): (C, D),
        (color, depth): Group<'_, L, C::Pixel, D::Stored>,
        mask: L::Mask,
        (cursor, derivatives): (&T::Cursor, &RunDerivatives<T, F::Derivatives, L, V>),
        (place, weights): ([i32; 2], &[L::Number; 3]),
    ) -> u32
    where
        C: ColorFormat,
        D: DepthFormat,
    {
        let lanes = self.lanes;
        let zs = depth_format.encode_lanes(lanes, self.triangle.depth(cursor, weights));
        let seen = depth_format.seen(lanes, &zs, depth, mask);
        if lanes.bits(seen) == 0 {
            return 0;
        }
        let varying = self.triangle.attributes(cursor, weights);
        let reciprocal = self.triangle.reciprocal(weights);
        let at = Samples { column: place[0], weights, values: &varying, reciprocal };
        let gradient = self.stage.derivatives().at(lanes, &self.derivatives, derivatives, &at);
        let (words, kept) = self.stage.shade(&Fragments { lanes, varying, gradient, mask: seen, place });
        // A stage may answer for samples that it was not asked for.
        let kept = kept & seen;
        // One sample in a hole is done with; where there are no holes, nobody asks.
        if const { L::COUNT == 1 } && lanes.bits(kept) == 0 {
            return 0;
        }
        let depth_first = const { C::DEPTH_FIRST || F::DEPTH_FIRST };
        if depth_first {
            depth_format.keep(lanes, &zs, kept, depth);
        }
        color_format.store::<L, F::Color>(lanes, words, kept, place, color);
        if !depth_first {
            depth_format.keep(lanes, &zs, kept, depth);
        }
        lanes.bits(kept).count_ones()
    }
}

/// The state of a loop over samples: at the next one.
struct Next<C, R, I> {
    cursor: C,
    edges: [R; 3],
    steps: [I; 3],
    place: [i32; 2],
    /// The number of those that were written.
    written: u32,
}

/// Whether a loop over samples takes two at a time: so counters and pointers cost half, if there are registers for it.
const fn pairs<L: Lanes, V: Varying>() -> bool {
    L::FIXED && (!LOW_WORDS_ONLY || size_of::<V::Of<u32>>() == 0)
}

/// Keeps a loop from being unrolled, at no cost. Cores of Arm without wide registers have none for four pixels at once,
/// and compilers, who think otherwise, would take a quarter more time for a textured one.
#[inline(always)]
pub(crate) fn as_it_stands() {
    if cfg!(target_arch = "arm") {
        black_box(());
    }
}

/// A copy of the last pixels of a band, fewer than there are lanes, as a whole group.
#[cold]
fn copied<L: Lanes, C: Copy, D: Copy>(
    lanes: L,
    colors: &[C],
    depths: &[D],
) -> Option<(L::Each<C>, L::Each<D>)> {
    let (&color, &depth) = (colors.first()?, depths.first()?);
    let colors = lanes.each(|k| colors.get(k).copied().unwrap_or(color));
    Some((colors, lanes.each(|k| depths.get(k).copied().unwrap_or(depth))))
}

/// Puts the copy's pixels in their places.
#[cold]
fn put_back<L: Lanes, C: Copy, D: Copy>(copy: &(L::Each<C>, L::Each<D>), colors: &mut [C], depths: &mut [D]) {
    colors.iter_mut().zip(copy.0.as_ref()).for_each(|(pixel, copy)| *pixel = *copy);
    depths.iter_mut().zip(copy.1.as_ref()).for_each(|(stored, copy)| *stored = *copy);
}

/// The column at which the lanes of a sample begin: a multiple of their number. So all triangles read and write the
/// same words of memory, which a machine can then pass on from one to the next before they have reached it.
#[inline(always)]
pub(crate) fn aligned<L: Lanes>(column: i32) -> i32 {
    column & !(L::STEP - 1)
}

/// The colours and depths of a group of samples.
type Group<'a, L, C, D> = (&'a mut <L as Lanes>::Each<C>, &'a mut <L as Lanes>::Each<D>);

/// The first `count` pixels, and the others.
#[inline(always)]
fn split<'a, C, D>((colors, depths): Pixels<'a, C, D>, count: usize) -> (Pixels<'a, C, D>, Pixels<'a, C, D>) {
    let (color, colors) = colors.split_at_mut_checked(count).unwrap_or_default();
    let (depth, depths) = depths.split_at_mut_checked(count).unwrap_or_default();
    ((color, depth), (colors, depths))
}

/// A bit for each lane.
#[inline(always)]
fn all<L: Lanes>() -> u32 {
    (1 << L::COUNT) - 1
}
