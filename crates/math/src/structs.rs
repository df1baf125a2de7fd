//! Structs as varyings.

/// Makes a struct of varyings a [`Varying`](crate::Varying). Its bundles are structs with the same fields, each of
/// which is the bundle of the field's type; that of `Flat<V>` and of `Linear<V>` is that of `V`.
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
/// let bundle = Lit::gather([Lit { uv: Vec2::X, normal: Vec3::Y }]);
/// assert_eq!((bundle.uv, bundle.normal[1]), ([[1.0], [0.0]], [1.0]));
/// ```
///
/// So in a fragment stage, over lanes `L`, `fragments.varying.uv` is a `[L::Number; 2]`, and `fragments.varying.normal`
/// a `[L::Number; 3]`.
#[macro_export]
macro_rules! varying {
    ($name:ident { $($field:ident: $of:ty),+ $(,)? }) => {
        const _: () = {
            #[doc = concat!("The fields of a [`", stringify!($name), "`] as bundles.")]
            #[allow(missing_debug_implementations, reason = "components of any type")]
            pub struct Bundle<T: Copy> {
                $(
                    #[doc = concat!("The components of `", stringify!($field), "`.")]
                    pub $field: <$of as $crate::Varying>::Of<T>,
                )+
            }

            impl<T: Copy> Clone for Bundle<T> {
                #[inline(always)]
                fn clone(&self) -> Self {
                    *self
                }
            }

            impl<T: Copy> Copy for Bundle<T> {}

            impl $crate::Varying for $name {
                type Of<T: Copy> = Bundle<T>;
                const ZEROS: Bundle<u32> = Bundle { $($field: <$of as $crate::Varying>::ZEROS),+ };

                #[inline(always)]
                fn gather<const N: usize>(values: [Self; N]) -> Bundle<[f32; N]> {
                    Bundle { $($field: $crate::Varying::gather(values.map(|value| value.$field))),+ }
                }

                #[inline(always)]
                fn map_by_mode<T: Copy, U: Copy>(
                    bundle: &Bundle<T>,
                    f: &impl Fn($crate::Mode, T) -> U,
                ) -> Bundle<U> {
                    Bundle { $($field: <$of as $crate::Varying>::map_by_mode(&bundle.$field, f)),+ }
                }

                #[inline(always)]
                fn zip<T: Copy, U: Copy>(first: &Bundle<T>, second: &Bundle<U>) -> Bundle<(T, U)> {
                    Bundle { $($field: <$of as $crate::Varying>::zip(&first.$field, &second.$field)),+ }
                }

                #[inline(always)]
                fn from_components(bundle: &Bundle<f32>) -> Self {
                    Self { $($field: <$of as $crate::Varying>::from_components(&bundle.$field)),+ }
                }
            }
        };
    };
}
