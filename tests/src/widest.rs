//! Lanes of tests to which it does not matter how many there are.

/// Runs an expression over the widest lanes of the machine. Which kinds give the same bits is what `lanes.rs` is about.
#[macro_export]
macro_rules! for_widest {
    ($lanes:ident => $body:expr) => {{
        use alberti_math::lanes::Machine;
        let machine = Machine::all().next().expect("every machine has lanes");
        alberti_math::for_lanes!(machine, $lanes => $body)
    }};
}
