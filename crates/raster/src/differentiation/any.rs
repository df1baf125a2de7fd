//! A policy of differentiation that is chosen at run time.

use super::{
    Differentiate, Differentiation, NoDerivatives, PerPixel, PerRun, PerTriangle, Samples, of_pairs,
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

type OfTriangle<D, V> = <D as Differentiate>::Triangle<V>;
type OfRun<D, L, V> = <D as Differentiate>::Run<L, V>;

impl Differentiate for AnyDerivatives {
    type Triangle<V: Varying> =
        OneOf<OfTriangle<PerPixel, V>, OfTriangle<PerRun, V>, OfTriangle<PerTriangle, V>>;
    type Run<L: Lanes, V: Varying> =
        OneOf<OfRun<PerPixel, L, V>, OfRun<PerRun, L, V>, OfRun<PerTriangle, L, V>>;

    #[inline(always)]
    fn prepare<V: Varying>(self, triangle: &Oriented<'_, V>) -> Self::Triangle<V> {
        match self {
            Self::PerPixel => OneOf::Pixel(PerPixel.prepare(triangle)),
            Self::PerRun => OneOf::Run(PerRun.prepare(triangle)),
            Self::PerTriangle => OneOf::Triangle(PerTriangle.prepare(triangle)),
        }
    }

    #[inline(always)]
    fn run<L: Lanes, V: Varying, I: EdgeInt>(
        self,
        lanes: L,
        triangle: &Self::Triangle<V>,
        row: &Row<'_, I>,
        run: Span,
    ) -> Self::Run<L, V> {
        match triangle {
            OneOf::Pixel(of) => OneOf::Pixel(PerPixel.run::<L, V, I>(lanes, of, row, run)),
            OneOf::Run(of) => OneOf::Run(PerRun.run::<L, V, I>(lanes, of, row, run)),
            OneOf::Triangle(_) => OneOf::Triangle(()),
        }
    }

    #[inline(always)]
    fn at<L: Lanes, V: Varying>(
        self,
        lanes: L,
        triangle: &Self::Triangle<V>,
        run: &Self::Run<L, V>,
        at: &Samples<'_, L, V>,
    ) -> Gradient<V::Of<L::Number>> {
        match (triangle, run) {
            (OneOf::Pixel(of), OneOf::Pixel(run)) => PerPixel.at(lanes, of, run, at),
            (OneOf::Triangle(of), OneOf::Triangle(())) => PerTriangle.at(lanes, of, &(), at),
            // The same along the run, whatever the triangle has.
            (_, OneOf::Run(run)) => of_pairs::<V, _>(run),
            // No state of a run is that of another policy's triangle.
            _ => NoDerivatives.at(lanes, &(), &(), at),
        }
    }
}
