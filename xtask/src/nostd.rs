//! Checks of the libraries for microcontrollers: the proof that they need neither std nor an allocator.
//!
//! Types are the proof, so no machine code is made of the libraries, and `core` is compiled without optimisation.
//! `cargo xtask firmware` makes machine code for the same cores, of programs that use the libraries.

use std::iter;

use crate::command::{self, Outcome};
use crate::embedded::{Target, Toolchain};
use crate::workspace::{LIBRARIES, NEEDS_STD};

/// The smallest core that is supported, and one with hardware for `f32`: between them both float ABIs, and both
/// with and without atomic compare-and-swap. Optional features are checked for the first, which has less.
const TARGETS: &[Target] = &[Target::of("thumbv6m-none-eabi"), Target::of("thumbv7em-none-eabihf")];

/// Checks every library for every target.
pub(crate) fn run() -> Outcome {
    for (number, &target) in TARGETS.iter().enumerate() {
        let (toolchain, name) = (Toolchain::find(target)?, target.triple);
        match &toolchain {
            Toolchain::Installed => println!("{name}: the installed target"),
            Toolchain::BuildStd { .. } => println!("{name}: not installed, core from Debian's source"),
        }
        for library in LIBRARIES {
            // One crate a check: in one check for all, a feature that one crate forgets to pass on would be switched
            // on by another, and hide the mistake.
            let terms: Vec<&str> =
                library.terms.iter().copied().filter(|feature| *feature != NEEDS_STD).collect();
            let all = (number == 0).then(|| format!("libm,{}", terms.join(",")));
            for features in iter::once("libm".to_string()).chain(all) {
                let mut check = toolchain.cargo("check", target);
                check.args(["--no-default-features", "--features", &features]);
                command::run(check.args(["--package", library.package]))?;
            }
        }
    }
    Ok(())
}
