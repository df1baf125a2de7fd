//! Values with vectors of glam in the logs of defmt, which glam does not know: as arrays.

/// Gives types what the feature `defmt` of the calling crate asks for: a text, and what is put into it.
///
/// ```text
/// logged! {
///     [S: Space] Point3<S>: "Point3({})", |point| point.coords.to_array();
/// }
/// ```
#[doc(hidden)]
#[macro_export]
macro_rules! logged {
    ($([$($generics:tt)*] $type:ty: $text:literal, |$value:ident| $($shown:expr),+;)+) => {$(
        #[cfg(feature = "defmt")]
        impl<$($generics)*> defmt::Format for $type {
            fn format(&self, formatter: defmt::Formatter<'_>) {
                let $value = self;
                defmt::write!(formatter, $text, $($shown),+);
            }
        }
    )+};
}
