//! A policy of differentiation that is chosen at run time.

use super::{
    Differentiate, Differentiation, NoDerivatives, PerPixel, PerRun, PerTriangle, Quotients, Samples,
    of_pairs,
};
use crate::edge::EdgeInt;
use crate::interpolation::{Oriented, Row};
use crate::spans::Span;
use alberti_math::lanes::Lanes;
use alberti_math::{Gradient, Varying};
use core::fmt::Debug;

/// One of three policies as a value, for a stage that returns it from
/// [`derivatives`](crate::FragmentStage::derivatives). The derivatives are those of the policy itself, bit for bit.
///
/// # Cost
/// A branch for a triangle, for a run, and for the samples that are worked on together; the code of all three.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum AnyDerivatives {
    /// [`PerPixel`].
    #[default]
    PerPixel,
    /// [`PerRun`].
    PerRun,
    /// [`PerTriangle`].
    PerTriangle,
}

/// The state of one of the policies.
#[derive(Clone, Copy, Debug)]
pub enum OneOf<P, R, T> {
    /// [`PerPixel`]'s.
    Pixel(P),
    /// [`PerRun`]'s.
    Run(R),
    /// [`PerTriangle`]'s.
    Triangle(T),
}

impl Differentiation for AnyDerivatives {
    type With<D: Differentiation> = Self;
}

type OfTriangle<D, L, V, Q> = <D as Differentiate>::Triangle<L, V, Q>;
type OfRun<D, L, V, Q> = <D as Differentiate>::Run<L, V, Q>;

impl Differentiate for AnyDerivatives {
    type Triangle<L: Lanes, V: Varying, Q: Quotients<L, V>> =
        OneOf<OfTriangle<PerPixel, L, V, Q>, OfTriangle<PerRun, L, V, Q>, OfTriangle<PerTriangle, L, V, Q>>;
    type Run<L: Lanes, V: Varying, Q: Quotients<L, V>> =
        OneOf<OfRun<PerPixel, L, V, Q>, OfRun<PerRun, L, V, Q>, OfRun<PerTriangle, L, V, Q>>;

    #[inline(always)]
    fn prepare<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        lanes: L,
        triangle: &Oriented<'_, V>,
        area: Q::Area,
    ) -> Self::Triangle<L, V, Q> {
        match self {
            Self::PerPixel => OneOf::Pixel(PerPixel.prepare(lanes, triangle, area)),
            Self::PerRun => OneOf::Run(PerRun.prepare(lanes, triangle, area)),
            Self::PerTriangle => OneOf::Triangle(PerTriangle.prepare::<L, V, Q>(lanes, triangle, area)),
        }
    }

    #[inline(always)]
    fn run<L: Lanes, V: Varying, Q: Quotients<L, V>, I: EdgeInt>(
        self,
        lanes: L,
        triangle: &Self::Triangle<L, V, Q>,
        row: &Row<'_, I>,
        run: Span,
    ) -> Self::Run<L, V, Q> {
        match triangle {
            OneOf::Pixel(of) => OneOf::Pixel(PerPixel.run::<L, V, Q, I>(lanes, of, row, run)),
            OneOf::Run(of) => OneOf::Run(PerRun.run::<L, V, Q, I>(lanes, of, row, run)),
            OneOf::Triangle(_) => OneOf::Triangle(()),
        }
    }

    #[inline(always)]
    fn at<L: Lanes, V: Varying, Q: Quotients<L, V>>(
        self,
        lanes: L,
        triangle: &Self::Triangle<L, V, Q>,
        run: &Self::Run<L, V, Q>,
        at: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>> {
        match (triangle, run) {
            (OneOf::Pixel(of), OneOf::Pixel(run)) => PerPixel.at::<L, V, Q>(lanes, of, run, at),
            (OneOf::Triangle(of), OneOf::Triangle(())) => of_pairs::<V, _>(of),
            // The same along the run, whatever the triangle has.
            (_, OneOf::Run(run)) => of_pairs::<V, _>(run),
            // No state of a run is that of another policy's triangle.
            _ => NoDerivatives.at::<L, V, Q>(lanes, &(), &(), at),
        }
    }
}
