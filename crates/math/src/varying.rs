//! Varyings: the attributes that a vertex carries beside its position, and their combination.

use core::array::from_fn;
use core::cell::Cell;
use glam::{Vec2, Vec3, Vec4};

/// The interpolation of a component from the vertices to the samples between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Mode {
    /// Linear in space, as everything is that has not been told otherwise.
    Hyperbolic,
    /// Linear on the screen.
    Linear,
    /// The value of the first vertex everywhere.
    Flat,
}

/// A value that is linear on the screen, without correction for perspective: one that is already measured there, or
/// that may be wrong for a lower cost.
///
/// # Cost
/// No division for its sake; where all values are linear or flat, none at all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable, bytemuck::TransparentWrapper))]
#[cfg_attr(feature = "bytemuck", transparent(V))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Linear<V>(
    /// The value.
    pub V,
);

/// A value that is not interpolated: the whole triangle has that of its first vertex.
///
/// # Precision
/// Bit for bit, also where the triangle is clipped.
///
/// # Cost
/// None.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable, bytemuck::TransparentWrapper))]
#[cfg_attr(feature = "bytemuck", transparent(V))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Flat<V>(
    /// The value.
    pub V,
);

/// A value that is interpolated over a triangle: a bundle of `f32` components.
///
/// The methods reach the components, so that the clipper, the rasterizer and whoever needs it can combine values with
/// any arithmetic, for one sample or for several at a time. `()`, `f32`, arrays, glam's vectors and tuples are
/// varyings; [`varying!`](crate::varying) makes one of a struct.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no bundle of `f32` that vertices can carry",
    note = "`varying!` makes one of a struct"
)]
pub trait Varying: Copy {
    /// The same bundle with components of type `T` instead of `f32`.
    type Of<T: Copy>: Copy;

    /// A bundle of zeros: room for components.
    const ZEROS: Self::Of<u32>;

    /// The components of `N` values, those that belong together side by side.
    #[must_use]
    fn gather<const N: usize>(values: [Self; N]) -> Self::Of<[f32; N]>;

    /// The bundle with every component mapped, by a function that is told how each is interpolated.
    #[must_use]
    fn map_by_mode<T: Copy, U: Copy>(bundle: &Self::Of<T>, f: &impl Fn(Mode, T) -> U) -> Self::Of<U>;

    /// Two bundles as one of pairs.
    #[must_use]
    fn zip<T: Copy, U: Copy>(first: &Self::Of<T>, second: &Self::Of<U>) -> Self::Of<(T, U)>;

    /// The bundle with every component mapped.
    #[must_use]
    #[inline(always)]
    fn map<T: Copy, U: Copy>(bundle: &Self::Of<T>, f: &impl Fn(T) -> U) -> Self::Of<U> {
        Self::map_by_mode(bundle, &|_, component| f(component))
    }

    /// The value with these components.
    #[must_use]
    fn from_components(bundle: &Self::Of<f32>) -> Self;
}

impl Varying for () {
    type Of<T: Copy> = ();
    const ZEROS: () = ();

    #[inline(always)]
    fn gather<const N: usize>(_: [Self; N]) {}

    #[inline(always)]
    fn map_by_mode<T: Copy, U: Copy>((): &(), _: &impl Fn(Mode, T) -> U) {}

    #[inline(always)]
    fn zip<T: Copy, U: Copy>((): &(), (): &()) {}

    #[inline(always)]
    fn from_components((): &()) {}
}

impl Varying for f32 {
    type Of<T: Copy> = T;
    const ZEROS: u32 = 0;

    #[inline(always)]
    fn gather<const N: usize>(values: [Self; N]) -> [f32; N] {
        values
    }

    #[inline(always)]
    fn map_by_mode<T: Copy, U: Copy>(bundle: &T, f: &impl Fn(Mode, T) -> U) -> U {
        f(Mode::Hyperbolic, *bundle)
    }

    #[inline(always)]
    fn zip<T: Copy, U: Copy>(first: &T, second: &U) -> (T, U) {
        (*first, *second)
    }

    #[inline(always)]
    fn from_components(bundle: &f32) -> Self {
        *bundle
    }
}

impl<V: Varying, const K: usize> Varying for [V; K] {
    type Of<T: Copy> = [V::Of<T>; K];
    const ZEROS: [V::Of<u32>; K] = [V::ZEROS; K];

    #[inline(always)]
    fn gather<const N: usize>(values: [Self; N]) -> Self::Of<[f32; N]> {
        from_fn(|k| V::gather(values.map(|v| v[k])))
    }

    // With from_fn, compilers do not inline `f` where it has vector instructions that the standard library has not.
    #[inline(always)]
    fn map_by_mode<T: Copy, U: Copy>(bundle: &Self::Of<T>, f: &impl Fn(Mode, T) -> U) -> Self::Of<U> {
        let Some(first) = bundle.first() else { return from_fn(|k| V::map_by_mode(&bundle[k], f)) };
        let mut mapped = [V::map_by_mode(first, f); K];
        for k in 1..K {
            mapped[k] = V::map_by_mode(&bundle[k], f);
        }
        mapped
    }

    #[inline(always)]
    fn zip<T: Copy, U: Copy>(first: &Self::Of<T>, second: &Self::Of<U>) -> Self::Of<(T, U)> {
        from_fn(|k| V::zip(&first[k], &second[k]))
    }

    #[inline(always)]
    fn from_components(bundle: &Self::Of<f32>) -> Self {
        from_fn(|k| V::from_components(&bundle[k]))
    }
}

macro_rules! modes {
    ($($name:ident: $mode:ident => $inner:expr;)*) => {$(
        impl<V: Varying> Varying for $name<V> {
            type Of<T: Copy> = V::Of<T>;
            const ZEROS: V::Of<u32> = V::ZEROS;

            #[inline(always)]
            fn gather<const N: usize>(values: [Self; N]) -> V::Of<[f32; N]> {
                V::gather(values.map(|v| v.0))
            }

            #[inline(always)]
            fn map_by_mode<T: Copy, U: Copy>(bundle: &V::Of<T>, f: &impl Fn(Mode, T) -> U) -> V::Of<U> {
                V::map_by_mode(bundle, &|$mode, component| f($inner, component))
            }

            #[inline(always)]
            fn zip<T: Copy, U: Copy>(first: &V::Of<T>, second: &V::Of<U>) -> V::Of<(T, U)> {
                V::zip(first, second)
            }

            #[inline(always)]
            fn from_components(bundle: &V::Of<f32>) -> Self {
                Self(V::from_components(bundle))
            }
        }
    )*};
}
modes! {
    Linear: mode => if mode == Mode::Flat { Mode::Flat } else { Mode::Linear };
    Flat: _mode => Mode::Flat;
}

macro_rules! vectors {
    ($($vector:ident $size:literal: $($k:literal)+),*) => {$(
        impl Varying for $vector {
            type Of<T: Copy> = [T; $size];
            const ZEROS: [u32; $size] = [0; $size];

            #[inline(always)]
            fn gather<const N: usize>(values: [Self; N]) -> [[f32; N]; $size] {
                [$(values.map(|v| v.to_array()[$k])),+]
            }

            #[inline(always)]
            fn map_by_mode<T: Copy, U: Copy>(bundle: &[T; $size], f: &impl Fn(Mode, T) -> U) -> [U; $size] {
                [$(f(Mode::Hyperbolic, bundle[$k])),+]
            }

            #[inline(always)]
            fn zip<T: Copy, U: Copy>(first: &[T; $size], second: &[U; $size]) -> [(T, U); $size] {
                [$((first[$k], second[$k])),+]
            }

            #[inline(always)]
            fn from_components(bundle: &[f32; $size]) -> Self {
                Self::from_array(*bundle)
            }
        }
    )*};
}
vectors!(Vec2 2: 0 1, Vec3 3: 0 1 2, Vec4 4: 0 1 2 3);

macro_rules! tuples {
    ($($($name:ident $index:tt),+);+) => {$(
        impl<$($name: Varying),+> Varying for ($($name,)+) {
            type Of<Component: Copy> = ($($name::Of<Component>,)+);
            const ZEROS: Self::Of<u32> = ($($name::ZEROS,)+);

            #[inline(always)]
            fn gather<const N: usize>(values: [Self; N]) -> Self::Of<[f32; N]> {
                ($($name::gather(values.map(|v| v.$index)),)+)
            }

            #[inline(always)]
            fn map_by_mode<T: Copy, U: Copy>(bundle: &Self::Of<T>, f: &impl Fn(Mode, T) -> U) -> Self::Of<U> {
                ($($name::map_by_mode(&bundle.$index, f),)+)
            }

            #[inline(always)]
            fn zip<Left: Copy, Right: Copy>(
                first: &Self::Of<Left>,
                second: &Self::Of<Right>,
            ) -> Self::Of<(Left, Right)> {
                ($($name::zip(&first.$index, &second.$index),)+)
            }

            #[inline(always)]
            fn from_components(bundle: &Self::Of<f32>) -> Self {
                ($($name::from_components(&bundle.$index),)+)
            }
        }
    )+};
}
tuples!(A 0, B 1; A 0, B 1, C 2; A 0, B 1, C 2, D 3);

/// Combines `N` values component by component into one.
#[must_use]
#[inline]
pub fn combine<V: Varying, const N: usize>(values: [V; N], f: &impl Fn([f32; N]) -> f32) -> V {
    V::from_components(&V::map(&V::gather(values), f))
}

/// `wa a + wb b` component by component, kept within the two values.
///
/// # Precision
/// For non-negative weights whose exact sum is 1, within 2ε·max(|a|, |b|, `f32::MIN_POSITIVE`) of the exact
/// combination, and never outside the values' range: equal values give that value, bit for bit. Exchanging the two
/// pairs changes no bit.
#[must_use]
#[inline]
pub fn blend2<V: Varying>(weights: [f32; 2], values: [V; 2]) -> V {
    blend2_by_mode(|_| weights, values)
}

/// [`blend2`] of components whose weights are those of their modes.
#[must_use]
#[inline]
pub fn blend2_by_mode<V: Varying>(weights: impl Fn(Mode) -> [f32; 2], values: [V; 2]) -> V {
    let blend = |mode, [a, b]: [f32; 2]| {
        let [wa, wb] = weights(mode);
        blended(wa, wb, a, b)
    };
    V::from_components(&V::map_by_mode(&V::gather(values), &blend))
}

/// Not inlined, as vertices have many components, and few vertices are made.
#[inline(never)]
fn blended(wa: f32, wb: f32, a: f32, b: f32) -> f32 {
    clamp(wa * a + wb * b, min(a, b), max(a, b))
}

/// The least and the greatest of three values, component by component.
#[must_use]
#[inline]
pub fn hull3<V: Varying>(values: [V; 3]) -> [V; 2] {
    [combine(values, &|[a, b, c]| min(min(a, b), c)), combine(values, &|[a, b, c]| max(max(a, b), c))]
}

/// The value, with its [`Flat`] components taken from `first`.
#[must_use]
#[inline]
pub fn flatten<V: Varying>(first: V, value: V) -> V {
    let pick = |mode, [first, own]: [f32; 2]| if mode == Mode::Flat { first } else { own };
    V::from_components(&V::map_by_mode(&V::gather([first, value]), &pick))
}

/// Whether no component is infinite or NaN.
#[must_use]
#[inline]
pub fn is_finite<V: Varying>(value: V) -> bool {
    let finite = Cell::new(true);
    let _ = V::map(&V::gather([value]), &|[x]: [f32; 1]| finite.set(finite.get() & x.is_finite()));
    finite.get()
}

// For finite values these are the single machine instructions that f32::min, max and clamp, which must also decide
// about NaN, are not.

#[inline]
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline]
fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline]
fn clamp(x: f32, lo: f32, hi: f32) -> f32 {
    min(max(x, lo), hi)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_are_reached_in_every_kind_of_varying() {
        let value = ((), 1.0f32, [Vec2::new(2.0, 3.0); 2], (Vec3::new(4.0, 5.0, 6.0), Vec4::splat(7.0)));
        let doubled = combine([value, value], &|[a, b]| a + b);
        assert_eq!(
            doubled,
            ((), 2.0, [Vec2::new(4.0, 6.0); 2], (Vec3::new(8.0, 10.0, 12.0), Vec4::splat(14.0)))
        );
    }

    #[test]
    fn flat_values_come_from_the_first_vertex_wherever_they_are() {
        let value = |x: f32| (x, Linear([Flat(x), Flat(-x)]), Flat((x, Linear(Vec2::splat(x)))));
        let expected = (2.0, Linear([Flat(1.0), Flat(-1.0)]), Flat((1.0, Linear(Vec2::ONE))));
        assert_eq!(flatten(value(1.0), value(2.0)), expected);
    }

    #[test]
    fn modes_reach_the_components() {
        let value = (0.0, Linear(Vec2::ZERO), Linear((Flat(0.0), 0.0)), Flat(Linear(0.0)));
        fn modes_of<V: Varying>(value: V) -> V::Of<Mode> {
            V::map_by_mode(&V::gather([value]), &|mode, _: [f32; 1]| mode)
        }
        let expected = (Mode::Hyperbolic, [Mode::Linear; 2], (Mode::Flat, Mode::Linear), Mode::Flat);
        assert_eq!(modes_of(value), expected);
    }

    #[test]
    fn a_blend_of_equal_values_is_the_value() {
        for (bits, tenths) in (0..0x7f80_0000u32).step_by(99_991).zip((0..=10u8).cycle()) {
            let u = f32::from_bits(bits);
            let t = f32::from(tenths) / 10.0;
            assert_eq!(blend2([t, 1.0 - t], [u, u]).to_bits(), u.to_bits());
        }
    }

    #[test]
    fn finiteness_looks_at_every_component() {
        assert!(is_finite((Vec2::ONE, [0.0f32; 3])));
        assert!(!is_finite((Vec2::ONE, [0.0, 0.0, f32::NAN])));
        assert!(!is_finite((Vec2::new(f32::NEG_INFINITY, 0.0), 1.0f32)));
        assert!(is_finite(()));
    }
}
