//! Policies without values, in terms of other crates.

/// Gives types without values, and ones around a single other, what the features `serde`, `arbitrary` and `defmt` of
/// the calling crate ask for. In files they are their names, `"D16"` or `{ "OrEqual": "D16" }`, and no other is read.
///
/// ```text
/// named!(D16, OrEqual(D: format));
/// ```
#[doc(hidden)]
#[macro_export]
macro_rules! named {
    ($($name:ident $(($of:ident: $inner:ident))?),+ $(,)?) => {$(
        #[cfg(any(feature = "serde", feature = "arbitrary", feature = "defmt"))]
        const _: () = {
            /// An enum's variant, as that is what has a name in all three.
            #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
            #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
            #[cfg_attr(feature = "defmt", derive(defmt::Format))]
            enum Named $(<$of>)? {
                $name $(($of))?,
            }

            #[cfg(feature = "serde")]
            impl $(<$of: serde::Serialize>)? serde::Serialize for $name $(<$of>)? {
                fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                    let $name $(($inner))? = self;
                    Named::$name $(($inner))?.serialize(serializer)
                }
            }

            #[cfg(feature = "serde")]
            impl<'de $(, $of: serde::Deserialize<'de>)?> serde::Deserialize<'de> for $name $(<$of>)? {
                fn deserialize<S: serde::Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
                    let Named::$name $(($inner))? = serde::Deserialize::deserialize(deserializer)?;
                    Ok($name $(($inner))?)
                }
            }

            #[cfg(feature = "arbitrary")]
            impl<'a $(, $of: arbitrary::Arbitrary<'a>)?> arbitrary::Arbitrary<'a> for $name $(<$of>)? {
                fn arbitrary(bytes: &mut arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
                    let Named::$name $(($inner))? = arbitrary::Arbitrary::arbitrary(bytes)?;
                    Ok($name $(($inner))?)
                }
            }

            #[cfg(feature = "defmt")]
            impl $(<$of: defmt::Format>)? defmt::Format for $name $(<$of>)? {
                fn format(&self, formatter: defmt::Formatter<'_>) {
                    let $name $(($inner))? = self;
                    defmt::write!(formatter, "{}", Named::$name $(($inner))?);
                }
            }
        };
    )+};
}
