//! Derivatives of attributes: their changes from a pixel to the next, from which a texture's level of detail comes.

use crate::edge::EdgeInt;
use crate::interpolation::{Oriented, Row, scaled_q};
use crate::spans::Span;
use alberti_math::lanes::Lanes;
use alberti_math::{Gradient, Mode, Q16, Varying, map2, map3};
use core::fmt::{self, Debug};

/// A policy of differentiation, which a [`FragmentStage`](crate::FragmentStage) chooses.
///
/// | policy | where it is right | divisions |
/// |---|---|---|
/// | [`NoDerivatives`] | | none |
/// | [`PerPixel`] | at each sample | one a fragment, which [`Exact`](crate::Exact) shares |
/// | [`PerRun`] | in the middle of each run of samples | one a run |
/// | [`PerTriangle`] | at the triangle's centroid | one a triangle |
///
/// An attribute u = U/T is the quotient of two functions that are linear on the screen, U = Σ Ei qi ui and T = Σ Ei qi.
/// Its derivatives are quotients of something simple as well, as in the numerators x, or y, cancels:
///
/// ```text
/// ∂u/∂x = (Ux T − U Tx)/T² = (A + J y)/T²        A = Ux T − U Tx,  B = Uy T − U Ty  at the origin
/// ∂u/∂y = (Uy T − U Ty)/T² = (B − J x)/T²        J = Ux Ty − Uy Tx
/// ```
///
/// The origin is the first corner, and u is counted from the value there, so that U is 0 at the origin.
///
/// A, B and J are found in `f64`, as sums of products of a distance, the area, two q and a difference of two u. These
/// may cancel, as all do where u is constant along a thin triangle. Then the error of `f64` counts as well: 2^-48 M,
/// with M the most that the derivative could be if nothing cancelled. With s the longer side of the triangle's box and
/// Δu the greatest difference of u,
///
/// ```text
/// M = 2 area s Δu (qa qb + qb qc + qc qa)/T²
/// ```
///
/// That is part of the precision of all policies. Where the q are equal and a triangle is a quarter of a pixel thick,
/// it is 2^-44 Δu.
///
/// In fixed point, where weights are not at hand as numbers, [`PerPixel`] is [`PerRun`]. Derivatives are those of the
/// components as they are interpolated, rounded to 2^-16 at the vertices. A small triangle that is one run has its
/// slopes everywhere, see [`FixedPoint`](crate::FixedPoint).
pub trait Differentiation: Differentiate + Debug + Default + 'static {
    /// The policy of a stage whose parts take this and `D`: the first of the two that is not [`NoDerivatives`].
    type With<D: Differentiation>: Differentiation;
}

/// The way of a policy from a triangle to derivatives at its samples.
pub trait Differentiate: Copy {
    /// The state of a triangle.
    type Triangle<V: Varying>: Copy;
    /// The state of a run of samples.
    type Run<L: Lanes, V: Varying>: Copy;

    /// The derivatives where attributes are linear, with these slopes by column and by row.
    #[inline(always)]
    fn of_slopes<V: Varying>(slopes: &V::Of<[Q16; 2]>) -> Gradient<V::Of<Q16>> {
        of_pairs::<V, _>(slopes)
    }

    /// Prepares a triangle.
    fn prepare<V: Varying>(self, triangle: &Oriented<'_, V>) -> Self::Triangle<V>;

    /// Begins a run of a row's samples.
    fn run<L: Lanes, V: Varying, I: EdgeInt>(
        self,
        lanes: L,
        triangle: &Self::Triangle<V>,
        row: &Row<'_, I>,
        run: Span,
    ) -> Self::Run<L, V>;

    /// The derivatives at the samples `at`.
    fn at<L: Lanes, V: Varying>(
        self,
        lanes: L,
        triangle: &Self::Triangle<V>,
        run: &Self::Run<L, V>,
        at: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>>;
}

/// Samples side by side.
#[derive(Clone, Copy)]
pub struct Samples<'a, L: Lanes, V: Varying> {
    /// The column of the first.
    pub column: i32,
    /// The edge functions, rounded.
    pub weights: &'a [L::Number; 3],
    /// The attributes.
    pub values: &'a V::Of<L::Number>,
}

impl<L: Lanes, V: Varying> Debug for Samples<'_, L, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Samples").field("column", &self.column).finish_non_exhaustive()
    }
}

/// No derivatives: none are asked for, and all are 0.
///
/// # Cost
/// None.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct NoDerivatives;

impl Differentiation for NoDerivatives {
    type With<D: Differentiation> = D;
}

impl Differentiate for NoDerivatives {
    type Triangle<V: Varying> = ();
    type Run<L: Lanes, V: Varying> = ();

    #[inline(always)]
    fn of_slopes<V: Varying>(slopes: &V::Of<[Q16; 2]>) -> Gradient<V::Of<Q16>> {
        let zeros = V::map(slopes, &|_: [Q16; 2]| Q16::ZERO);
        Gradient { dx: zeros, dy: zeros }
    }

    #[inline(always)]
    fn prepare<V: Varying>(self, _: &Oriented<'_, V>) {}

    #[inline(always)]
    fn run<L: Lanes, V: Varying, I: EdgeInt>(self, _: L, (): &(), _: &Row<'_, I>, _: Span) {}

    #[inline(always)]
    fn at<L: Lanes, V: Varying>(
        self,
        lanes: L,
        (): &(),
        (): &(),
        at: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>> {
        let zeros = V::map(at.values, &|_| lanes.splat(0.0));
        Gradient { dx: zeros, dy: zeros }
    }
}

/// Derivatives at each sample.
///
/// # Precision
/// ∂u/∂x is within 13ε, relatively, with ε = 2^-24, and ∂u/∂y within 14ε·|∂u/∂y| + 3ε·|J x|/T², barring over- and
/// underflow. Here J is that of the module, and x the columns from the start of the run. 7.1ε is the most that was
/// measured of both where x is small.
///
/// The reason: T is a sum of positive numbers, within 4ε with the rounding of the Ei. Its reciprocal squared is within
/// 11ε, and the numerator's rounding and the product add 2ε. For ∂u/∂y the numerator is a difference: ε for it,
/// ε·(|∂u/∂y| + |J x|/T²) for its first part, and 2ε·|J x|/T² for the product.
///
/// In fixed point the precision is that of [`PerRun`].
///
/// # Cost
/// A triangle: some 30 operations in `f64`, and 12 for each component; a row, two in `f64` a component. A fragment:
/// three products, two sums, a division and a product, which [`Exact`](crate::Exact) has in common with it but for the
/// last, and three products and a difference a component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerPixel;

/// Derivatives in the middle of each run of samples: as many columns as the policy of interpolation says, or a whole
/// row of the triangle.
///
/// # Precision
/// There, rounded once: within 1.001ε (ε = 2^-24), in fixed point to the nearest step of 2^-16. With r >= 1 the ratio
/// of q in the middle and at an end, ∂u/∂x is off by a factor of r². So the level of detail is off by 2 log2 r.
///
/// # Cost
/// A run: some ten operations and a division in `f64`, and four a component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerRun;

/// Derivatives at the centroid of each triangle.
///
/// # Precision
/// Like [`PerRun`] there. With r >= 1 the ratio of q there and at a vertex, ∂u/∂x is off by up to a factor of r². A
/// triangle that was clipped counts as the pieces that are drawn.
///
/// # Cost
/// A triangle: some 30 operations in `f64`, and 12 for each component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerTriangle;

/// The quotients of a triangle.
#[derive(Clone, Copy)]
pub struct Quotients<V: Varying> {
    q: [f64; 3],
    /// T at the centroid.
    t: f64,
    /// The first corner and the centroid, in pixels.
    origin: [f64; 2],
    centroid: [f64; 2],
    /// A, B and J of hyperbolic components; of others the derivatives themselves.
    numerators: V::Of<[f64; 3]>,
}

impl<V: Varying> Debug for Quotients<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Quotients").finish_non_exhaustive()
    }
}

impl<V: Varying> Quotients<V> {
    #[inline(always)]
    fn new(triangle: &Oriented<'_, V>) -> Self {
        let q = scaled_q(triangle);
        let corners = map3(triangle.corners, |corner| map2(corner, f64::from));
        let [a, b, c] = corners;
        let one = f64::from(triangle.one());
        // Increments of the edge functions of the second and the third vertex: for a pixel to the right, and for one
        // down.
        let of_b = [(c[1] - a[1]) * one, (a[0] - c[0]) * one];
        let of_c = [(a[1] - b[1]) * one, (b[0] - a[0]) * one];
        #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
        let area = triangle.doubled_area as f64;
        let t = area * q[0];
        // The common factor of the areas by columns and rows: nothing cancels in thin triangles.
        let common = area * one * one;
        let numerators = V::map_by_mode(&triangle.numbers(), &|mode, [u, v, w, _]: [f64; 4]| {
            let [v, w] = [v - u, w - u];
            match mode {
                Mode::Hyperbolic => {
                    let [v, w] = [v * q[1], w * q[2]];
                    let [x, y] = [of_b[0] * v + of_c[0] * w, of_b[1] * v + of_c[1] * w];
                    [x * t, y * t, common * (v * (q[2] - q[0]) - w * (q[1] - q[0]))]
                }
                Mode::Linear => {
                    let per = |k: usize| (of_b[k] * v + of_c[k] * w) / area;
                    [per(0), per(1), 0.0]
                }
                Mode::Flat => [0.0; 3],
            }
        });
        let middle = |k: usize| (a[k] + b[k] + c[k]) / (3.0 * one);
        let t = area * (q[0] + q[1] + q[2]) / 3.0;
        Self { q, t, origin: [a[0] / one, a[1] / one], centroid: [middle(0), middle(1)], numerators }
    }

    /// The derivatives by column and row at a place in pixels, where T is given.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
    fn at(&self, [x, y]: [f64; 2], t: f64) -> V::Of<[f32; 2]> {
        let [x, y] = [x - self.origin[0], y - self.origin[1]];
        let per = 1.0 / (t * t);
        V::map_by_mode(&self.numerators, &|mode, [a, b, j]: [f64; 3]| {
            let [dx, dy] =
                if mode == Mode::Hyperbolic { [(a + j * y) * per, (b - j * x) * per] } else { [a, b] };
            [dx as f32, dy as f32]
        })
    }

    /// The three q.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "they were f32")]
    fn q_lanes<L: Lanes>(&self, lanes: L) -> [L::Number; 3] {
        let [a, b, c] = self.q;
        [lanes.splat(a as f32), lanes.splat(b as f32), lanes.splat(c as f32)]
    }

    /// The derivatives in the middle of a run of a row.
    #[inline(always)]
    fn in_middle<I: EdgeInt>(&self, row: &Row<'_, I>, run: Span) -> V::Of<[f32; 2]> {
        let column = run.start + ((run.end - run.start) >> 1);
        let [ea, eb, ec] = row.at(column);
        let [qa, qb, qc] = self.q;
        let t = ea.to_f64() * qa + eb.to_f64() * qb + ec.to_f64() * qc;
        self.at([f64::from(column) + 0.5, f64::from(row.row) + 0.5], t)
    }

    /// The derivatives at the centroid.
    #[inline(always)]
    fn in_centroid(&self) -> V::Of<[f32; 2]> {
        self.at(self.centroid, self.t)
    }
}

/// A run, to differentiate at its samples.
#[derive(Clone, Copy)]
pub struct RunQuotients<L: Lanes, V: Varying> {
    /// The column from which x is counted.
    start: i32,
    /// A + J y, B counted from `start`, and J, of hyperbolic components; of others, and in fixed point of all, the
    /// derivatives themselves.
    numerators: V::Of<[L::Number; 3]>,
}

impl<L: Lanes, V: Varying> Debug for RunQuotients<L, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RunQuotients").finish_non_exhaustive()
    }
}

impl<L: Lanes, V: Varying> RunQuotients<L, V> {
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
    fn new<I: EdgeInt>(lanes: L, of: &Quotients<V>, row: &Row<'_, I>, run: Span) -> Self {
        let splat = |x: f64| lanes.splat(x as f32);
        if L::FIXED {
            let derivatives = of.in_middle(row, run);
            let numerators = V::map(&derivatives, &|[dx, dy]: [f32; 2]| {
                [lanes.splat(dx), lanes.splat(dy), lanes.splat(0.0)]
            });
            return Self { start: 0, numerators };
        }
        let x = f64::from(run.start) + 0.5 - of.origin[0];
        let y = f64::from(row.row) + 0.5 - of.origin[1];
        Self {
            start: run.start,
            numerators: V::map_by_mode(&of.numerators, &|mode, [a, b, j]: [f64; 3]| match mode {
                Mode::Hyperbolic => [splat(a + j * y), splat(b - j * x), splat(j)],
                _ => [splat(a), splat(b), splat(j)],
            }),
        }
    }

    /// The derivatives at samples.
    #[inline(always)]
    fn at(&self, lanes: L, of: &Quotients<V>, at: &Samples<'_, L, V>) -> Gradient<V::Of<L::Number>> {
        let derivatives = if L::FIXED {
            V::map(&self.numerators, &|[dx, dy, _]: [L::Number; 3]| [dx, dy])
        } else {
            let [ea, eb, ec] = *at.weights;
            let [qa, qb, qc] = of.q_lanes(lanes);
            let t = ea * qa + eb * qb + ec * qc;
            let per = lanes.splat(1.0) / t;
            let per = per * per;
            #[expect(clippy::cast_precision_loss, reason = "columns are below 2^24")]
            let x = lanes.ramp() + lanes.splat((at.column - self.start) as f32);
            V::map_by_mode(&self.numerators, &|mode, [a, b, j]: [L::Number; 3]| match mode {
                Mode::Hyperbolic => [a * per, (b - j * x) * per],
                _ => [a, b],
            })
        };
        of_pairs::<V, _>(&derivatives)
    }
}

/// A pair for each component as a pair of bundles.
#[inline(always)]
fn of_pairs<V: Varying, N: Copy>(pairs: &V::Of<[N; 2]>) -> Gradient<V::Of<N>> {
    Gradient { dx: V::map(pairs, &|[dx, _]: [N; 2]| dx), dy: V::map(pairs, &|[_, dy]: [N; 2]| dy) }
}

impl Differentiation for PerPixel {
    type With<D: Differentiation> = Self;
}

impl Differentiate for PerPixel {
    type Triangle<V: Varying> = Quotients<V>;
    type Run<L: Lanes, V: Varying> = RunQuotients<L, V>;

    #[inline(always)]
    fn prepare<V: Varying>(self, triangle: &Oriented<'_, V>) -> Quotients<V> {
        Quotients::new(triangle)
    }

    #[inline(always)]
    fn run<L: Lanes, V: Varying, I: EdgeInt>(
        self,
        lanes: L,
        triangle: &Quotients<V>,
        row: &Row<'_, I>,
        run: Span,
    ) -> RunQuotients<L, V> {
        RunQuotients::new(lanes, triangle, row, run)
    }

    #[inline(always)]
    fn at<L: Lanes, V: Varying>(
        self,
        lanes: L,
        triangle: &Quotients<V>,
        run: &RunQuotients<L, V>,
        at: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>> {
        run.at(lanes, triangle, at)
    }
}

/// Policies whose derivatives are the same along a whole run.
macro_rules! along_runs {
    ($($policy:ident: $Triangle:ty, |$of:ident| $prepare:expr, |$triangle:ident, $row:ident, $run:ident| $at:expr;)*) => {$(
        impl Differentiation for $policy {
            type With<D: Differentiation> = Self;
        }

        impl Differentiate for $policy {
            type Triangle<V: Varying> = $Triangle;
            type Run<L: Lanes, V: Varying> = V::Of<[L::Number; 2]>;

            #[inline(always)]
            fn prepare<V: Varying>(self, $of: &Oriented<'_, V>) -> Self::Triangle<V> {
                $prepare
            }

            #[inline(always)]
            fn run<L: Lanes, V: Varying, I: EdgeInt>(
                self,
                lanes: L,
                $triangle: &Self::Triangle<V>,
                $row: &Row<'_, I>,
                $run: Span,
            ) -> Self::Run<L, V> {
                V::map(&$at, &|[dx, dy]: [f32; 2]| [lanes.splat(dx), lanes.splat(dy)])
            }

            #[inline(always)]
            fn at<L: Lanes, V: Varying>(
                self,
                _: L,
                _: &Self::Triangle<V>,
                run: &Self::Run<L, V>,
                _: &Samples<'_, L, V>,
            ) -> Gradient<V::Of<L::Number>> {
                of_pairs::<V, _>(run)
            }
        }
    )*};
}
along_runs! {
    PerRun: Quotients<V>, |of| Quotients::new(of), |triangle, row, run| triangle.in_middle(row, run);
    PerTriangle: V::Of<[f32; 2]>, |of| Quotients::new(of).in_centroid(), |triangle, _row, _run| *triangle;
}
