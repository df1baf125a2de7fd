//! What a vertex carries beside its position, and how such values are combined.

use core::cell::Cell;
use glam::{Vec2, Vec3, Vec4};

/// A value that is interpolated over a triangle: a bundle of `f32` components.
///
/// The one method says how to reach the components, so that the clipper, the rasterizer and whoever needs it can
/// combine values with any arithmetic. `()`, `f32`, arrays, glam's vectors and tuples are varyings; a struct of
/// varyings becomes one by zipping each field:
///
/// ```
/// use alberti_math::{Varying, glam::{Vec2, Vec3}};
///
/// #[derive(Clone, Copy)]
/// struct Lit {
///     uv: Vec2,
///     normal: Vec3,
/// }
///
/// impl Varying for Lit {
///     fn zip<const N: usize>(v: [Self; N], f: &impl Fn([f32; N]) -> f32) -> Self {
///         Self { uv: Vec2::zip(v.map(|v| v.uv), f), normal: Vec3::zip(v.map(|v| v.normal), f) }
///     }
/// }
/// ```
pub trait Varying: Copy {
    /// Combines `N` values component by component.
    #[must_use]
    fn zip<const N: usize>(values: [Self; N], f: &impl Fn([f32; N]) -> f32) -> Self;
}

impl Varying for () {
    #[inline]
    fn zip<const N: usize>(_: [Self; N], _: &impl Fn([f32; N]) -> f32) -> Self {}
}

impl Varying for f32 {
    #[inline]
    fn zip<const N: usize>(values: [Self; N], f: &impl Fn([f32; N]) -> f32) -> Self {
        f(values)
    }
}

impl<T: Varying, const K: usize> Varying for [T; K] {
    #[inline]
    fn zip<const N: usize>(values: [Self; N], f: &impl Fn([f32; N]) -> f32) -> Self {
        core::array::from_fn(|k| T::zip(values.map(|v| v[k]), f))
    }
}

macro_rules! vectors {
    ($($vector:ident),*) => {$(
        impl Varying for $vector {
            #[inline]
            fn zip<const N: usize>(values: [Self; N], f: &impl Fn([f32; N]) -> f32) -> Self {
                Self::from_array(Varying::zip(values.map(|v| v.to_array()), f))
            }
        }
    )*};
}
vectors!(Vec2, Vec3, Vec4);

macro_rules! tuples {
    ($($($name:ident $index:tt),+);+) => {$(
        impl<$($name: Varying),+> Varying for ($($name,)+) {
            #[inline]
            fn zip<const N: usize>(values: [Self; N], f: &impl Fn([f32; N]) -> f32) -> Self {
                ($($name::zip(values.map(|v| v.$index), f),)+)
            }
        }
    )+};
}
tuples!(A 0, B 1; A 0, B 1, C 2; A 0, B 1, C 2, D 3);

/// `wa a + wb b` component by component, kept within the two values.
///
/// # Precision
/// For non-negative weights whose exact sum is 1, within 2ε·max(|a|, |b|) of the exact combination, and never outside
/// the values' range: equal values give that value, bit for bit. Exchanging the two pairs changes no bit.
#[must_use]
#[inline]
pub fn blend2<V: Varying>([wa, wb]: [f32; 2], values: [V; 2]) -> V {
    V::zip(values, &|[a, b]| clamp(wa * a + wb * b, min(a, b), max(a, b)))
}

/// `(wa a + wb b + wc c) scale` component by component, kept within `lo` and `hi` (see [`hull3`]).
///
/// # Precision
/// For non-negative weights, within 4ε·max(|a|, |b|, |c|)·(wa + wb + wc)·scale of the exact result.
///
/// # Cost
/// A component: four multiplications, two additions, a minimum and a maximum.
#[must_use]
#[inline]
pub fn blend3<V: Varying>([wa, wb, wc]: [f32; 3], scale: f32, [a, b, c]: [V; 3], [lo, hi]: [V; 2]) -> V {
    V::zip([a, b, c, lo, hi], &|[a, b, c, lo, hi]| clamp((wa * a + wb * b + wc * c) * scale, lo, hi))
}

/// The least and the greatest of three values, component by component.
#[must_use]
#[inline]
pub fn hull3<V: Varying>(values: [V; 3]) -> [V; 2] {
    [V::zip(values, &|[a, b, c]| min(min(a, b), c)), V::zip(values, &|[a, b, c]| max(max(a, b), c))]
}

/// Whether no component is infinite or NaN.
#[must_use]
#[inline]
pub fn is_finite<V: Varying>(value: V) -> bool {
    let finite = Cell::new(true);
    let _ = V::zip([value], &|[x]| {
        finite.set(finite.get() & x.is_finite());
        x
    });
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
        let doubled = Varying::zip([value, value], &|[a, b]| a + b);
        assert_eq!(
            doubled,
            ((), 2.0, [Vec2::new(4.0, 6.0); 2], (Vec3::new(8.0, 10.0, 12.0), Vec4::splat(14.0)))
        );
    }

    #[test]
    fn a_blend_of_equal_values_is_the_value() {
        for (bits, tenths) in (0..0x7f80_0000u32).step_by(99_991).zip((0..=10u8).cycle()) {
            let u = f32::from_bits(bits);
            let t = f32::from(tenths) / 10.0;
            assert_eq!(blend2([t, 1.0 - t], [u, u]).to_bits(), u.to_bits());
            assert_eq!(blend3([t, 1.0 - t, 0.25], 0.8, [u; 3], hull3([u; 3])).to_bits(), u.to_bits());
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
