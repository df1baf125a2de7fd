//! Lanes of tests to which it does not matter how many there are.

/// Runs an expression over the lanes of AVX2, or over one where the machine is without it: compiled twice, not for each
/// kind of [`Machine`](alberti_math::lanes::Machine). Which kinds give the same bits is what `lanes.rs` is about.
#[cfg(target_arch = "x86_64")]
#[macro_export]
macro_rules! for_widest {
    ($lanes:ident => $body:expr) => {{
        use alberti_math::lanes::{Machine, One};
        match Machine::all().find(|machine| matches!(machine, Machine::Avx2(_))) {
            Some(Machine::Avx2($lanes)) => $body,
            _ => {
                let $lanes = One;
                $body
            }
        }
    }};
}

/// Runs an expression over the lanes of the machine.
#[cfg(not(target_arch = "x86_64"))]
#[macro_export]
macro_rules! for_widest {
    ($lanes:ident => $body:expr) => {{
        use alberti_math::lanes::Machine;
        let machine = Machine::all().next().expect("every machine has lanes");
        alberti_math::for_lanes!(machine, $lanes => $body)
    }};
}
