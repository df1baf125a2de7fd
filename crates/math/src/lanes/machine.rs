//! The lanes that the machine has, asked at run time.
//!
//! The cases are those of the module `here`, one for each kind of machine.

#[cfg(all(feature = "simd", target_arch = "x86_64"))]
mod here {
    use crate::lanes::{Eight, One};
    #[cfg(feature = "avx512")]
    use fearless_simd::Avx512;
    #[cfg(feature = "sse2")]
    use fearless_simd::Sse2;
    use fearless_simd::{Avx2, Level};

    /// The lanes of a machine, which [`for_lanes!`](crate::for_lanes) turns into a [`Lanes`](super::super::Lanes) type.
    #[derive(Clone, Copy, Debug)]
    pub enum Machine {
        /// Eight in a register of 256 bits, and sixteen in one of 512: behind the feature `avx512`.
        #[cfg(feature = "avx512")]
        Avx512(Eight<Avx512>),
        /// Eight in a register of 256 bits.
        Avx2(Eight<Avx2>),
        /// Eight in two registers of 128 bits, which every x86-64 machine has: behind the feature `sse2`.
        #[cfg(feature = "sse2")]
        Sse2(Eight<Sse2>),
        /// One sample at a time.
        One(One),
    }

    impl Machine {
        /// All that this machine turns out to have (with the feature `std`) or is known to have, the widest first.
        pub fn all() -> impl Iterator<Item = Self> {
            let level = Level::try_detect().unwrap_or(Level::baseline());
            let avx2 = level.as_avx2().map(|proof| Self::Avx2(Eight(proof)));
            #[cfg(feature = "avx512")]
            let avx512 = level.as_avx512().map(|proof| Self::Avx512(Eight(proof)));
            #[cfg(not(feature = "avx512"))]
            let avx512 = None;
            #[cfg(feature = "sse2")]
            let sse2 = Level::baseline().as_sse2().map(|proof| Self::Sse2(Eight(proof)));
            #[cfg(not(feature = "sse2"))]
            let sse2 = None;
            [avx512, avx2, sse2, Some(Self::One(One))].into_iter().flatten()
        }
    }

    /// The expansion of [`for_lanes!`](crate::for_lanes): the kinds that there always are, then those of features.
    #[doc(hidden)]
    #[macro_export]
    macro_rules! __for_lanes {
        ($machine:expr, $lanes:ident => $body:expr) => {
            $crate::__for_avx512!($machine, $lanes => $body, [Avx2 One])
        };
    }

    #[cfg(feature = "avx512")]
    #[doc(hidden)]
    #[macro_export]
    macro_rules! __for_avx512 {
        ($machine:expr, $lanes:ident => $body:expr, [$($kind:ident)*]) => {
            $crate::__for_sse2!($machine, $lanes => $body, [$($kind)* Avx512])
        };
    }

    #[cfg(not(feature = "avx512"))]
    #[doc(hidden)]
    #[macro_export]
    macro_rules! __for_avx512 {
        ($machine:expr, $lanes:ident => $body:expr, [$($kind:ident)*]) => {
            $crate::__for_sse2!($machine, $lanes => $body, [$($kind)*])
        };
    }

    #[cfg(feature = "sse2")]
    #[doc(hidden)]
    #[macro_export]
    macro_rules! __for_sse2 {
        ($machine:expr, $lanes:ident => $body:expr, [$($kind:ident)*]) => {
            $crate::__for_kinds!($machine, $lanes => $body, [$($kind)* Sse2])
        };
    }

    #[cfg(not(feature = "sse2"))]
    #[doc(hidden)]
    #[macro_export]
    macro_rules! __for_sse2 {
        ($machine:expr, $lanes:ident => $body:expr, [$($kind:ident)*]) => {
            $crate::__for_kinds!($machine, $lanes => $body, [$($kind)*])
        };
    }

    #[doc(hidden)]
    #[macro_export]
    macro_rules! __for_kinds {
        ($machine:expr, $lanes:ident => $body:expr, [$($kind:ident)*]) => {
            match $machine {
                $($crate::lanes::Machine::$kind($lanes) => $body,)*
            }
        };
    }
}

#[cfg(all(feature = "simd", target_arch = "aarch64"))]
mod here {
    use crate::lanes::Eight;
    use fearless_simd::{Level, Neon};

    /// The lanes of a machine, which [`for_lanes!`](crate::for_lanes) turns into a [`Lanes`](super::super::Lanes) type.
    #[derive(Clone, Copy, Debug)]
    pub enum Machine {
        /// Eight in two registers of 128 bits.
        Neon(Eight<Neon>),
    }

    impl Machine {
        /// The lanes that every aarch64 machine has.
        pub fn all() -> impl Iterator<Item = Self> {
            Level::baseline().as_neon().map(|proof| Self::Neon(Eight(proof))).into_iter()
        }
    }

    /// The expansion of [`for_lanes!`](crate::for_lanes).
    #[doc(hidden)]
    #[macro_export]
    macro_rules! __for_lanes {
        ($machine:expr, $lanes:ident => $body:expr) => {
            match $machine {
                $crate::lanes::Machine::Neon($lanes) => $body,
            }
        };
    }
}

#[cfg(all(feature = "simd", target_arch = "wasm32", target_feature = "simd128"))]
mod here {
    use crate::lanes::Four;
    use fearless_simd::{Level, WasmSimd128};

    /// The lanes of a machine, which [`for_lanes!`](crate::for_lanes) turns into a [`Lanes`](super::super::Lanes) type.
    #[derive(Clone, Copy, Debug)]
    pub enum Machine {
        /// Four in a vector of 128 bits.
        Simd128(Four<WasmSimd128>),
    }

    impl Machine {
        /// The lanes that every machine has on which such a program starts.
        pub fn all() -> impl Iterator<Item = Self> {
            Level::baseline().as_wasm_simd128().map(|proof| Self::Simd128(Four(proof))).into_iter()
        }
    }

    /// The expansion of [`for_lanes!`](crate::for_lanes).
    #[doc(hidden)]
    #[macro_export]
    macro_rules! __for_lanes {
        ($machine:expr, $lanes:ident => $body:expr) => {
            match $machine {
                $crate::lanes::Machine::Simd128($lanes) => $body,
            }
        };
    }
}

#[cfg(not(all(
    feature = "simd",
    any(
        target_arch = "x86_64",
        target_arch = "aarch64",
        all(target_arch = "wasm32", target_feature = "simd128")
    )
)))]
mod here {
    use crate::lanes::One;

    /// The lanes of a machine, which [`for_lanes!`](crate::for_lanes) turns into a [`Lanes`](super::super::Lanes) type.
    #[derive(Clone, Copy, Debug)]
    pub enum Machine {
        /// One sample at a time.
        One(One),
    }

    impl Machine {
        /// One sample at a time.
        pub fn all() -> impl Iterator<Item = Self> {
            core::iter::once(Self::One(One))
        }
    }

    /// The expansion of [`for_lanes!`](crate::for_lanes).
    #[doc(hidden)]
    #[macro_export]
    macro_rules! __for_lanes {
        ($machine:expr, $lanes:ident => $body:expr) => {
            match $machine {
                $crate::lanes::Machine::One($lanes) => $body,
            }
        };
    }
}

pub use here::Machine;

/// Runs an expression over the lanes of a [`Machine`](crate::lanes::Machine), compiled once for each kind.
///
/// ```
/// use alberti_math::for_lanes;
/// use alberti_math::lanes::{Lanes, Machine};
///
/// fn count<L: Lanes>(_: L) -> usize {
///     L::COUNT
/// }
/// for machine in Machine::all() {
///     let lanes = for_lanes!(machine, lanes => count(lanes));
///     assert!(matches!(lanes, 1 | 4 | 8));
/// }
/// ```
#[macro_export]
macro_rules! for_lanes {
    ($machine:expr, $lanes:ident => $body:expr) => {
        $crate::__for_lanes!($machine, $lanes => $body)
    };
}
