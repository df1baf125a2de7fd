//! Structs as varyings.

/// Makes a struct of up to four varyings a [`Varying`](crate::Varying): its bundles are tuples, in the order in which
/// the fields are listed.
///
/// ```
/// use alberti_math::{Varying, glam::{Vec2, Vec3}, varying};
///
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// struct Lit {
///     uv: Vec2,
///     normal: Vec3,
/// }
///
/// varying!(Lit { uv: Vec2, normal: Vec3 });
///
/// let (uv, _) = Lit::gather([Lit { uv: Vec2::X, normal: Vec3::Y }]);
/// assert_eq!(uv, [[1.0], [0.0]]);
/// ```
#[macro_export]
macro_rules! varying {
    ($name:ident { $($field:ident: $of:ty),+ $(,)? }) => {
        impl $crate::Varying for $name {
            type Of<T: Copy> = <($($of,)+) as $crate::Varying>::Of<T>;

            #[inline(always)]
            fn gather<const N: usize>(values: [Self; N]) -> Self::Of<[f32; N]> {
                $crate::Varying::gather(values.map(|value| ($(value.$field,)+)))
            }

            #[inline(always)]
            fn map_by_mode<T: Copy, U: Copy>(
                bundle: &Self::Of<T>,
                f: &impl Fn($crate::Mode, T) -> U,
            ) -> Self::Of<U> {
                <($($of,)+) as $crate::Varying>::map_by_mode(bundle, f)
            }

            #[inline(always)]
            fn zip<T: Copy, U: Copy>(first: &Self::Of<T>, second: &Self::Of<U>) -> Self::Of<(T, U)> {
                <($($of,)+) as $crate::Varying>::zip(first, second)
            }

            #[inline(always)]
            fn from_components(bundle: &Self::Of<f32>) -> Self {
                let ($($field,)+) = <($($of,)+) as $crate::Varying>::from_components(bundle);
                Self { $($field),+ }
            }
        }
    };
}
