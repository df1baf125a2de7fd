//! Derivatives of attributes: their changes from a pixel to the next, from which a texture's level of detail comes.

mod any;
mod fixed;
mod floating;

pub use any::AnyDerivatives;

use crate::edge::EdgeInt;
use crate::interpolation::{Oriented, Row};
use crate::spans::Span;
use alberti_math::lanes::Lanes;
use alberti_math::{Gradient, Q16, Varying};
use core::fmt::{self, Debug};
pub(crate) use fixed::FixedQuotients;
pub(crate) use floating::FloatQuotients;

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
/// In fixed point, where weights are not at hand as numbers, [`PerPixel`] is [`PerRun`]. Components are those that are
/// rounded to 2^-16 at the vertices. Integers of 32 bits have derivatives within N (2^-8 + r 2^-24), and half a step of
/// 2^-16, where they are below 2^15. That holds for all q > 0, up to r of 2^25, as multiples of q are taken whose
/// greatest has 30 bits. With r the ratio of the greatest q of the three to that of the place,
///
/// ```text
/// N = r s Δu / (2 area)
/// ```
///
/// is the most that the derivative could be in a triangle of this size. Where it is that, the level of detail is off by
/// 0.006. It is as if corners were off by s/256, which matters in thin ones. A small triangle that is one run has its
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
    type Triangle<L: Lanes, V: Varying, Q: Quotients<L, V>>: Copy;
    /// The state of a run of samples.
    type Run<L: Lanes, V: Varying, Q: Quotients<L, V>>: Copy;

    /// The derivatives where attributes are linear, with these slopes by column and by row.
    #[inline(always)]
    fn of_slopes<V: Varying>(slopes: &V::Of<[Q16; 2]>) -> Gradient<V::Of<Q16>> {
        of_pairs::<V, _>(slopes)
    }

    /// Prepares a triangle, of which the quotients take the `area`.
    fn prepare<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        lanes: L,
        triangle: &Oriented<'_, V>,
        area: Q::Area,
    ) -> Self::Triangle<L, V, Q>;

    /// The derivatives, if all of a triangle has the same.
    #[inline(always)]
    fn everywhere<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        triangle: &Self::Triangle<L, V, Q>,
    ) -> Option<Gradient<V::Of<L::Number>>> {
        let _ = triangle;
        None
    }

    /// Begins a run of a row's samples.
    fn run<L: Lanes, V: Varying, Q: Quotients<L, V>, I: EdgeInt>(
        self,
        lanes: L,
        triangle: &Self::Triangle<L, V, Q>,
        row: &Row<'_, I>,
        run: Span,
    ) -> Self::Run<L, V, Q>;

    /// The derivatives at the samples `at`.
    fn at<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        lanes: L,
        triangle: &Self::Triangle<L, V, Q>,
        run: &Self::Run<L, V, Q>,
        at: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>>;
}

/// The quotients that a triangle's attributes are, in numbers of a kind. A policy of interpolation has them in its own.
pub trait Quotients<L: Lanes, V: Varying>: Copy {
    /// A number that comes from a triangle's area, for these and for interpolation.
    type Area: Copy;
    /// The state of a run, for derivatives at each of its samples.
    type Run: Copy;

    /// That number of an area, twice which is given.
    fn area(doubled: i64) -> Self::Area;

    /// The quotients of a triangle.
    fn new(triangle: &Oriented<'_, V>, area: Self::Area) -> Self;

    /// The derivatives at its centroid, by column and by row.
    fn in_centroid(lanes: L, triangle: &Oriented<'_, V>, area: Self::Area) -> V::Of<[L::Number; 2]>;

    /// The derivatives in the middle of a run of a row, by column and by row.
    fn in_middle<I: EdgeInt>(&self, lanes: L, row: &Row<'_, I>, run: Span) -> V::Of<[L::Number; 2]>;

    /// Begins a run of a row's samples.
    fn run<I: EdgeInt>(&self, lanes: L, row: &Row<'_, I>, run: Span) -> Self::Run;

    /// The derivatives at samples of that run.
    fn at(&self, lanes: L, run: &Self::Run, at: &Samples<'_, L, V>) -> Gradient<V::Of<L::Number>>;
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
    type Triangle<L: Lanes, V: Varying, Q: Quotients<L, V>> = ();
    type Run<L: Lanes, V: Varying, Q: Quotients<L, V>> = ();

    #[inline(always)]
    fn of_slopes<V: Varying>(slopes: &V::Of<[Q16; 2]>) -> Gradient<V::Of<Q16>> {
        let zeros = V::map(slopes, &|_: [Q16; 2]| Q16::ZERO);
        Gradient { dx: zeros, dy: zeros }
    }

    #[inline(always)]
    fn prepare<L: Lanes, V: Varying, Q: Quotients<L, V>>(self, _: L, _: &Oriented<'_, V>, _: Q::Area) {}

    #[inline(always)]
    fn run<L: Lanes, V: Varying, Q: Quotients<L, V>, I: EdgeInt>(
        self,
        _: L,
        (): &(),
        _: &Row<'_, I>,
        _: Span,
    ) {
    }

    #[inline(always)]
    fn at<L: Lanes, V: Varying, Q: Quotients<L, V>>(
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
/// There, within 12ε relatively and 7ε M, with ε = 2^-24 and M that of [`Differentiation`]. That has the bound in fixed
/// point as well. With r >= 1 the ratio of q in the middle and at an end, ∂u/∂x is off by a factor of r². So the level
/// of detail is off by 2 log2 r.
///
/// The reason: that of [`PerPixel`], without the second product of the reciprocal.
///
/// # Cost
/// A run: some fifteen operations and a division, and twelve a component, of `f32`. In fixed point some 110 of
/// integers, of which five are products of 32 bits to 64, and twenty a component, all products of which fit a word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerRun;

/// Derivatives at the centroid of each triangle.
///
/// # Precision
/// There, within 12ε relatively and 8ε M: that of [`PerRun`], and a rounding of the distances. With r >= 1 the ratio of
/// q there and at a vertex, ∂u/∂x is off by up to a factor of r². A triangle that was clipped counts as the pieces that
/// are drawn. [`Differentiation`] has the bound in fixed point.
///
/// # Cost
/// A triangle: some 20 operations and a division, and 21 for each component, of `f32`. In fixed point some 150 of
/// integers, and 35 a component, all products of which fit a word. `docs/texture.md` has counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PerTriangle;

/// A pair for each component as a pair of bundles.
#[inline(always)]
fn of_pairs<V: Varying, N: Copy>(pairs: &V::Of<[N; 2]>) -> Gradient<V::Of<N>> {
    Gradient { dx: V::map(pairs, &|[dx, _]: [N; 2]| dx), dy: V::map(pairs, &|[_, dy]: [N; 2]| dy) }
}

impl Differentiation for PerPixel {
    type With<D: Differentiation> = Self;
}

impl Differentiate for PerPixel {
    type Triangle<L: Lanes, V: Varying, Q: Quotients<L, V>> = Q;
    type Run<L: Lanes, V: Varying, Q: Quotients<L, V>> = Q::Run;

    #[inline(always)]
    fn prepare<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        _: L,
        triangle: &Oriented<'_, V>,
        area: Q::Area,
    ) -> Q {
        Q::new(triangle, area)
    }

    #[inline(always)]
    fn run<L: Lanes, V: Varying, Q: Quotients<L, V>, I: EdgeInt>(
        self,
        lanes: L,
        triangle: &Q,
        row: &Row<'_, I>,
        run: Span,
    ) -> Q::Run {
        triangle.run(lanes, row, run)
    }

    #[inline(always)]
    fn at<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        lanes: L,
        triangle: &Q,
        run: &Q::Run,
        at: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>> {
        triangle.at(lanes, run, at)
    }
}

impl Differentiation for PerRun {
    type With<D: Differentiation> = Self;
}

impl Differentiate for PerRun {
    type Triangle<L: Lanes, V: Varying, Q: Quotients<L, V>> = Q;
    type Run<L: Lanes, V: Varying, Q: Quotients<L, V>> = V::Of<[L::Number; 2]>;

    #[inline(always)]
    fn prepare<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        _: L,
        triangle: &Oriented<'_, V>,
        area: Q::Area,
    ) -> Q {
        Q::new(triangle, area)
    }

    #[inline(always)]
    fn run<L: Lanes, V: Varying, Q: Quotients<L, V>, I: EdgeInt>(
        self,
        lanes: L,
        triangle: &Q,
        row: &Row<'_, I>,
        run: Span,
    ) -> V::Of<[L::Number; 2]> {
        triangle.in_middle(lanes, row, run)
    }

    #[inline(always)]
    fn at<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        _: L,
        _: &Q,
        run: &V::Of<[L::Number; 2]>,
        _: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>> {
        of_pairs::<V, _>(run)
    }
}

impl Differentiation for PerTriangle {
    type With<D: Differentiation> = Self;
}

impl Differentiate for PerTriangle {
    const EVERYWHERE: bool = true;

    type Triangle<L: Lanes, V: Varying, Q: Quotients<L, V>> = V::Of<[L::Number; 2]>;
    type Run<L: Lanes, V: Varying, Q: Quotients<L, V>> = ();

    #[inline(always)]
    fn prepare<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        lanes: L,
        triangle: &Oriented<'_, V>,
        area: Q::Area,
    ) -> V::Of<[L::Number; 2]> {
        Q::in_centroid(lanes, triangle, area)
    }

    #[inline(always)]
    fn everywhere<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        triangle: &V::Of<[L::Number; 2]>,
    ) -> Option<Gradient<V::Of<L::Number>>> {
        Some(of_pairs::<V, _>(triangle))
    }

    #[inline(always)]
    fn run<L: Lanes, V: Varying, Q: Quotients<L, V>, I: EdgeInt>(
        self,
        _: L,
        _: &V::Of<[L::Number; 2]>,
        _: &Row<'_, I>,
        _: Span,
    ) {
    }

    #[inline(always)]
    fn at<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        _: L,
        triangle: &V::Of<[L::Number; 2]>,
        (): &(),
        _: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>> {
        of_pairs::<V, _>(triangle)
    }
}
