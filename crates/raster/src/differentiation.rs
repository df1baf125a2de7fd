//! Derivatives of attributes: their changes from a pixel to the next, from which a texture's level of detail comes.

mod any;

pub use any::AnyDerivatives;

use crate::edge::EdgeInt;
use crate::interpolation::{Oriented, Row, scaled_q};
use crate::spans::Span;
use crate::triangle::Corners;
use alberti_math::lanes::Lanes;
use alberti_math::{Gradient, Mode, Q16, Varying};
use core::fmt::{self, Debug};

/// A policy of differentiation, which a [`FragmentStage`](crate::FragmentStage) chooses.
///
/// | policy | where it is right | divisions |
/// |---|---|---|
/// | [`NoDerivatives`] | | none |
/// | [`PerPixel`] | at each sample | one a fragment, which [`Exact`](crate::Exact) shares |
/// | [`PerRun`] | in the middle of each run of samples | one a run |
/// | [`PerTriangle`] | at the triangle's centroid | one a triangle |
/// | [`AnyDerivatives`] | as one of the last three, chosen at run time | as that |
///
/// An attribute u = U/T is the quotient of two functions that are linear on the screen, U = Σ Ei qi ui and T = Σ Ei qi.
/// In the numerators of its derivatives all products of edge functions cancel but for distances on one axis:
///
/// ```text
/// ∂u/∂x = (Ux T − U Tx)/T² =  2 area Σ (y − yi) gi / T²        ga = qb qc (ub − uc),  gb and gc likewise
/// ∂u/∂y = (Uy T − U Ty)/T² = −2 area Σ (x − xi) gi / T²        x, y: the sample;  xi, yi: the vertices
/// ```
///
/// Distances are integers, and only the sums cancel, as all do where u is constant along a thin triangle. So beside a
/// relative error there is one of a few ε M (ε = 2^-24). M is the most that the derivative could be if nothing
/// cancelled. With s the longer side of the triangle's box and Δu the greatest difference of u,
///
/// ```text
/// M = 2 area s Δu (qa qb + qb qc + qc qa)/T²
/// ```
///
/// That is as if distances were off by a few ε s. Up to s of 3,000 pixels it is less than what snapping to 8 bits does
/// to them. Components that are linear on the screen are within 4ε relatively and 2ε s Δu/area.
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
    /// Whether all of a triangle has the same.
    const EVERYWHERE: bool = false;

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

    /// The derivatives, if all of a triangle has the same.
    #[inline(always)]
    fn everywhere<L: Lanes, V: Varying>(
        self,
        lanes: L,
        triangle: &Self::Triangle<V>,
    ) -> Option<Gradient<V::Of<L::Number>>> {
        let _ = (lanes, triangle);
        None
    }

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
    /// 1/T, if the policy of interpolation has it.
    pub reciprocal: Option<L::Number>,
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
/// ∂u/∂x is within 13ε·|∂u/∂x| + 7ε M, and ∂u/∂y within 14ε·|∂u/∂y| + 10ε M, with ε = 2^-24 and M that of
/// [`Differentiation`], barring over- and underflow. In fixed point the precision is that of [`PerRun`].
///
/// The reason: T is a sum of positive numbers, within 4ε with the rounding of the Ei. Its reciprocal squared is within
/// 11ε; the area, and the product with the numerator, add 2ε. Each 2 area gi carries four roundings more, which may
/// cancel: of qb qc, the product with the area, ub − uc, and a product. By column a product with a distance and two
/// sums follow. By row the numerator is that at the start of a run, less Σ 2 area gi times the columns: both have two
/// sums and a product. Their difference is the last rounding.
///
/// # Cost
/// All of it is `f32`. A triangle: some ten operations, and nine for each component; a row, 13 a component. A fragment:
/// three products, two sums, a division and a product, which [`Exact`](crate::Exact) has in common with it but for the
/// last, and three products and a difference a component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerPixel;

/// Derivatives in the middle of each run of samples: as many columns as the policy of interpolation says, or a whole
/// row of the triangle.
///
/// # Precision
/// There, within 12ε relatively and 7ε M, with ε = 2^-24 and M that of [`Differentiation`]; in fixed point rounded to
/// the nearest step of 2^-16. With r >= 1 the ratio of q in the middle and at an end, ∂u/∂x is off by a factor of r².
/// So the level of detail is off by 2 log2 r.
///
/// The reason: that of [`PerPixel`], without the second product of the reciprocal.
///
/// # Cost
/// A run: some fifteen operations and a division, and twelve a component. All of it is `f32`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerRun;

/// Derivatives at the centroid of each triangle.
///
/// # Precision
/// There, within 12ε relatively and 8ε M: that of [`PerRun`], and a rounding of the distances. With r >= 1 the ratio of
/// q there and at a vertex, ∂u/∂x is off by up to a factor of r². A triangle that was clipped counts as the pieces that
/// are drawn.
///
/// # Cost
/// A triangle: some 20 operations and a division, and 21 for each component. All of it is `f32`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerTriangle;

/// The quotients of a triangle.
#[derive(Clone, Copy)]
pub struct Quotients<V: Varying> {
    corners: Corners,
    /// Bits of the subpixels.
    bits: u32,
    q: [f32; 3],
    /// Of hyperbolic components twice the area times ga, gb and gc, for distances in subpixels and derivatives by
    /// pixels; of others the derivatives themselves.
    numerators: V::Of<[f32; 3]>,
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
        let [qa, qb, qc] = q;
        let [a, b, c] = triangle.corners;
        let one = number(triangle.one());
        let common = triangle.area() * one;
        let factors = [qb * qc * common, qc * qa * common, qa * qb * common];
        // Increments of the edge functions of the second and the third vertex: for a pixel to the right, and for one
        // down.
        let of_b = [number(c[1] - a[1]), number(a[0] - c[0])];
        let of_c = [number(a[1] - b[1]), number(b[0] - a[0])];
        let per_area = one / triangle.area();
        let fixed = triangle.fixed;
        let numerators = V::map_by_mode(&triangle.words(), &|mode, [u, v, w, _]: [u32; 4]| {
            let less = |u: u32, v: u32| difference(fixed, u, v);
            match mode {
                Mode::Hyperbolic => {
                    [factors[0] * less(v, w), factors[1] * less(w, u), factors[2] * less(u, v)]
                }
                Mode::Linear => {
                    let [v, w] = [less(v, u), less(w, u)];
                    let per = |k: usize| (of_b[k] * v + of_c[k] * w) * per_area;
                    [per(0), per(1), 0.0]
                }
                Mode::Flat => [0.0; 3],
            }
        });
        Self { corners: triangle.corners, bits: triangle.bits, q, numerators }
    }

    /// The derivatives by column and row at a place with these [distances](Self::distances), where `per` is 1/T².
    #[inline(always)]
    fn at(&self, distances: [[f32; 3]; 2], per: f32) -> V::Of<[f32; 2]> {
        V::map_by_mode(&self.numerators, &|mode, g: [f32; 3]| {
            if mode == Mode::Hyperbolic { distances.map(|along| sum(along, g) * per) } else { [g[0], g[1]] }
        })
    }

    /// The distances of a place from the corners by rows, and of the corners from it by columns, times a factor. The
    /// place and the distances are in subpixels, and times that factor.
    #[inline(always)]
    fn distances(&self, [x, y]: [i32; 2], factor: i32) -> [[f32; 3]; 2] {
        [self.corners.map(|[_, k]| number(y - factor * k)), self.corners.map(|[k, _]| number(factor * k - x))]
    }

    /// A sample's place in subpixels.
    #[inline(always)]
    fn sample(&self, place: [i32; 2]) -> [i32; 2] {
        place.map(|k| (k << self.bits) + (1 << self.bits >> 1))
    }

    /// The three q.
    #[inline(always)]
    fn q_lanes<L: Lanes>(&self, lanes: L) -> [L::Number; 3] {
        self.q.map(|q| lanes.splat(q))
    }

    /// The derivatives in the middle of a run of a row.
    #[inline(always)]
    fn in_middle<I: EdgeInt>(&self, row: &Row<'_, I>, run: Span) -> V::Of<[f32; 2]> {
        let column = run.start + ((run.end - run.start) >> 1);
        let t = sum(row.at(column).map(I::to_f32), self.q);
        self.at(self.distances(self.sample([column, row.row]), 1), 1.0 / (t * t))
    }

    /// The derivatives at the centroid.
    #[inline(always)]
    fn in_centroid(&self, area: f32) -> V::Of<[f32; 2]> {
        let [a, b, c] = self.corners;
        let [qa, qb, qc] = self.q;
        // Three times the distances, and three times T.
        let t = area * (qa + qb + qc);
        self.at(self.distances([a[0] + b[0] + c[0], a[1] + b[1] + c[1]], 3), 3.0 / (t * t))
    }
}

/// A distance as a number: exactly, but for three times one.
#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "at most 2^24, and three times that is rounded")]
fn number(distance: i32) -> f32 {
    distance as f32
}

/// The difference of two components.
#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "rounding to nearest is within the bounds")]
fn difference(fixed: bool, u: u32, v: u32) -> f32 {
    if fixed {
        (u.cast_signed() - v.cast_signed()) as f32 * (1.0 / 65536.0)
    } else {
        f32::from_bits(u) - f32::from_bits(v)
    }
}

#[inline(always)]
fn sum([a, b, c]: [f32; 3], [x, y, z]: [f32; 3]) -> f32 {
    a * x + b * y + c * z
}

/// A run, to differentiate at its samples.
#[derive(Clone, Copy)]
pub struct RunQuotients<L: Lanes, V: Varying> {
    /// The column from which x is counted.
    start: i32,
    /// The numerators by column and by row at `start`, and what the second loses by column, of hyperbolic components;
    /// of others, and in fixed point of all, the derivatives themselves.
    numerators: V::Of<[L::Number; 3]>,
}

impl<L: Lanes, V: Varying> Debug for RunQuotients<L, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RunQuotients").finish_non_exhaustive()
    }
}

impl<L: Lanes, V: Varying> RunQuotients<L, V> {
    #[inline(always)]
    fn new<I: EdgeInt>(lanes: L, of: &Quotients<V>, row: &Row<'_, I>, run: Span) -> Self {
        let splat = |x: f32| lanes.splat(x);
        if L::FIXED {
            let derivatives = of.in_middle(row, run);
            let numerators = V::map(&derivatives, &|[dx, dy]: [f32; 2]| [splat(dx), splat(dy), splat(0.0)]);
            return Self { start: 0, numerators };
        }
        let [rows, columns] = of.distances(of.sample([run.start, row.row]), 1);
        let one = number(1 << of.bits);
        Self {
            start: run.start,
            numerators: V::map_by_mode(&of.numerators, &|mode, g: [f32; 3]| match mode {
                Mode::Hyperbolic => [sum(rows, g), sum(columns, g), (g[0] + g[1] + g[2]) * one].map(splat),
                _ => g.map(splat),
            }),
        }
    }

    /// The derivatives at samples.
    #[inline(always)]
    fn at(&self, lanes: L, of: &Quotients<V>, at: &Samples<'_, L, V>) -> Gradient<V::Of<L::Number>> {
        let derivatives = if L::FIXED {
            V::map(&self.numerators, &|[dx, dy, _]: [L::Number; 3]| [dx, dy])
        } else {
            let per = at.reciprocal.unwrap_or_else(
                #[inline(always)]
                || {
                    let [ea, eb, ec] = *at.weights;
                    let [qa, qb, qc] = of.q_lanes(lanes);
                    lanes.splat(1.0) / (ea * qa + eb * qb + ec * qc)
                },
            );
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
    ($(
        $policy:ident: $Triangle:ty, |$of:ident| $prepare:expr, |$triangle:ident, $row:ident, $run:ident| $at:expr
        $(, $more:item)*;
    )*) => {$(
        impl Differentiation for $policy {
            type With<D: Differentiation> = Self;
        }

        impl Differentiate for $policy {
            type Triangle<V: Varying> = $Triangle;
            type Run<L: Lanes, V: Varying> = V::Of<[L::Number; 2]>;
            $($more)*

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
    PerTriangle: V::Of<[f32; 2]>, |of| Quotients::new(of).in_centroid(of.area()), |triangle, _row, _run| *triangle,
        const EVERYWHERE: bool = true;,
        #[inline(always)]
        fn everywhere<L: Lanes, V: Varying>(
            self,
            lanes: L,
            triangle: &Self::Triangle<V>,
        ) -> Option<Gradient<V::Of<L::Number>>> {
            let splat = V::map(triangle, &|[dx, dy]: [f32; 2]| [lanes.splat(dx), lanes.splat(dy)]);
            Some(of_pairs::<V, _>(&splat))
        };
}
