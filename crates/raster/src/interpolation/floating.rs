//! Lines in `f32`: of components that are linear on the screen by their slopes, of others between two ends.
#![expect(missing_debug_implementations, reason = "states of drawing, which have no name outside")]

use super::bends::Bends;
use super::linear::{FloatComponent, FloatPlane, Ramp, Slant, along, count, middle, scaled_q};
use super::lines::{Affine, Course, LineNumbers, LineTriangle, Lines, Run, Runs, Spans16};
use crate::differentiation::FloatQuotients;
use crate::edge::EdgeInt;
use crate::interpolation::{Chosen, Interpolation, Oriented, Prepare, Row, Values};
use crate::setup::Waiting;
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Mode, Varying};

/// A triangle's depth, q and components, and their parabolas where `BENT` is 1 and not 0.
#[derive(Clone, Copy)]
pub struct FloatingLines<L: Lanes, V: Varying, const BENT: usize> {
    lanes: L,
    q: [f32; 3],
    zs: FloatComponent,
    /// With perspective the factors of hyperbolic ones are their values.
    components: V::Of<FloatComponent>,
    bends: [Bends<V>; BENT],
}

impl<L: Floating, V: Varying, const BENT: usize> FloatingLines<L, V, BENT> {
    #[inline(always)]
    pub(crate) fn new(lanes: L, runs: impl Runs, triangle: &Oriented<'_, V>) -> Self {
        let (slant, perspective) = (Slant::new(triangle), runs.perspective());
        let (bends, values) = if BENT > 0 && runs.course() == Course::Parabola {
            Bends::new(&slant, triangle)
        } else {
            (Bends::none(triangle), triangle.values())
        };
        Self {
            lanes,
            q: if perspective { scaled_q(triangle) } else { [1.0; 3] },
            zs: slant.linear(triangle.depths()),
            components: V::map_by_mode(&values, &|mode, values: Values| match mode {
                Mode::Hyperbolic if perspective => {
                    FloatComponent::new(values, FloatPlane::new(values.corners, [0.0; 3]))
                }
                Mode::Hyperbolic | Mode::Linear => slant.linear(values),
                Mode::Flat => FloatComponent::flat(values),
            }),
            bends: [bends; BENT],
        }
    }
}

/// The values at both ends of a run, of what is hyperbolic.
#[derive(Clone, Copy)]
pub struct FloatingEnds<V: Varying>(V::Of<[f32; 2]>);

/// The place of samples in a run, and the numbers that are linear along it.
#[derive(Clone, Copy)]
pub struct FloatingCursor<L: Lanes, V: Varying, const BENT: usize> {
    along: L::Number,
    zs: Ramp<L>,
    /// With the factors of the square of the columns.
    components: V::Of<(Ramp<L>, [L::Number; BENT])>,
}

impl<L: Floating, V: Varying, const BENT: usize> LineNumbers<L, V> for FloatingLines<L, V, BENT> {
    type Row = ();
    type Ends = FloatingEnds<V>;
    type Cursor = FloatingCursor<L, V, BENT>;
    type Quotients = FloatQuotients<V>;

    #[inline(always)]
    fn row<I: EdgeInt>(&self, _: bool, _: &Row<'_, I>) {}

    #[inline(always)]
    fn begin<I: EdgeInt>(
        &self,
        perspective: bool,
        row: &Row<'_, I>,
        (): &(),
        column: i32,
    ) -> FloatingEnds<V> {
        let nothing = FloatingEnds(V::map(&self.components, &|_: FloatComponent| [0.0; 2]));
        let FloatingEnds(components) = self.extend(perspective, row, &(), &nothing, column);
        FloatingEnds(V::map(&components, &|[_, value]: [f32; 2]| [value; 2]))
    }

    #[inline(always)]
    fn extend<I: EdgeInt>(
        &self,
        perspective: bool,
        row: &Row<'_, I>,
        (): &(),
        ends: &FloatingEnds<V>,
        column: i32,
    ) -> FloatingEnds<V> {
        if !perspective {
            return *ends;
        }
        let [ea, eb, ec] = row.at(column).map(I::to_f32);
        let [qa, qb, qc] = self.q;
        let [ta, tb, tc] = [ea * qa, eb * qb, ec * qc];
        let per_q = 1.0 / (ta + tb + tc);
        let weights = [ta * per_q, tb * per_q, tc * per_q];
        FloatingEnds(V::map_by_mode(&V::zip(&self.components, &ends.0), &|mode, pair| {
            let (component, [_, start]): (FloatComponent, [f32; 2]) = pair;
            if mode == Mode::Hyperbolic { [start, component.plane.at(weights)] } else { [0.0; 2] }
        }))
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "at most 64 columns")]
    fn line<I: EdgeInt>(
        &self,
        course: Course,
        row: &Row<'_, I>,
        (): &(),
        run: &Run<FloatingEnds<V>>,
        [_, aligned]: [i32; 2],
    ) -> FloatingCursor<L, V, BENT> {
        let [first, last] = run.columns;
        let (lanes, edges) = (self.lanes, middle(row, run.columns));
        // A run of a single sample has no step.
        let per_column = 1.0 / (last - first).max(1) as f32;
        let lines = V::map_by_mode(&V::zip(&self.components, &run.ends.0), &|mode, pair| {
            let (component, [start, end]): (FloatComponent, [f32; 2]) = pair;
            if course == Course::Perspective && mode == Mode::Hyperbolic {
                [0.5 * (start + end), (end - start) * per_column]
            } else {
                [component.plane.at(edges), component.plane.across]
            }
        });
        let straight = |[middle, step]: [f32; 2]| (Ramp::new(lanes, middle, step), [lanes.splat(0.0); BENT]);
        FloatingCursor {
            along: along(lanes, run.columns, aligned),
            zs: Ramp::of(lanes, &self.zs.plane, edges),
            components: if let ([bends, ..], Course::Parabola) = (&self.bends[..], course) {
                let pairs = V::zip(&lines, &bends.at(edges));
                V::map(&pairs, &|([middle, step], [less, flatter, bend]): ([f32; 2], [f32; 3])| {
                    (Ramp::new(lanes, middle - less, step - flatter), [lanes.splat(bend); BENT])
                })
            } else {
                V::map(&lines, &straight)
            },
        }
    }

    #[inline(always)]
    fn advance(&self, cursor: FloatingCursor<L, V, BENT>) -> FloatingCursor<L, V, BENT> {
        FloatingCursor { along: cursor.along + count(self.lanes), ..cursor }
    }

    #[inline(always)]
    fn depth(&self, cursor: &FloatingCursor<L, V, BENT>) -> L::Number {
        self.zs.bounded(self.lanes, cursor.zs.at(cursor.along))
    }

    #[inline(always)]
    fn attributes(&self, cursor: &FloatingCursor<L, V, BENT>) -> V::Of<L::Number> {
        V::map_by_mode(&V::zip(&self.components, &cursor.components), &|mode, pair| {
            let (component, (ramp, bend)): (FloatComponent, (Ramp<L>, [L::Number; BENT])) = pair;
            match (mode, bend.first()) {
                (Mode::Flat, _) => component.constant(self.lanes),
                (Mode::Hyperbolic, Some(&bend)) => {
                    component.bounded(self.lanes, ramp.bent(bend, cursor.along))
                }
                _ => component.bounded(self.lanes, ramp.at(cursor.along)),
            }
        })
    }
}

macro_rules! interpolations {
    ($($runs:ty, $bent:literal)*) => {$(
        impl Interpolation for $runs {}

        impl Prepare for $runs {
            type Lanes<L: Floating> = L;
            type Triangle<L: Floating, V: Varying> = LineTriangle<Self, FloatingLines<L, V, $bent>>;
            const WIDE: bool = false;

            #[inline(always)]
            fn run(self) -> i32 {
                one_run(self)
            }

            #[inline(always)]
            fn lanes<L: Floating>(self, lanes: L) -> L {
                lanes
            }

            // Only lines whose length is a number may have a budget.
            const CHOOSES: bool = $bent > 0;

            #[inline(always)]
            fn choose<V: Varying>(self, triangle: &Waiting<'_, V>, bits: u32) -> Chosen {
                self.lines().map_or(Chosen::Exact, |lines| lines.of_corners(triangle, bits))
            }

            #[inline(always)]
            fn prepare<L: Floating, V: Varying>(
                self,
                lanes: L,
                triangle: &Oriented<'_, V>,
                (): (),
            ) -> LineTriangle<Self, FloatingLines<L, V, $bent>> {
                LineTriangle { runs: self, numbers: FloatingLines::new(lanes, self, triangle) }
            }
        }
    )*};
}
interpolations!(Spans16, 0 Affine, 0 Lines, 1);

/// The length of all runs, or 1 if there is none such, see [`Interpolation::run`].
#[inline(always)]
pub(super) fn one_run(runs: impl Runs) -> i32 {
    if runs.budget().is_some() { 1 } else { runs.length() }
}
