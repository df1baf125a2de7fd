//! Programs for libFuzzer, one for each target of `alberti-hostile`. `cargo xtask fuzz` builds and runs them; so
//! does `cargo fuzz run NAME -s none` in this folder.

pub use alberti_hostile as bodies;
pub use cap::Cap;
pub use libfuzzer_sys;

/// The most memory that a target may have at once, in bytes: that of the largest texture, and as much again.
pub const BUDGET: usize = 1 << 30;

/// The program of a target's body. Where it asks for more memory than the budget, it ends as if it had crashed.
///
/// It names one body alone, so that the linker leaves out the others: libFuzzer looks at all counters after each
/// execution.
#[macro_export]
macro_rules! program {
    ($body:ident) => {
        #[global_allocator]
        static ALLOCATOR: $crate::Cap<std::alloc::System> =
            $crate::Cap::new(std::alloc::System, $crate::BUDGET);

        $crate::libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
            $crate::bodies::$body(bytes);
        });
    };
}
