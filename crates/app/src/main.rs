//! The `alberti` command.

use std::process::ExitCode;

/// Bytes of a drawing thread's stack, as many as a main thread has: unoptimized kernels take more than 2 MB.
const STACK: usize = 8 << 20;

fn main() -> ExitCode {
    alberti_app::output::file::clean_up_on_signals();
    // A pool that cannot be made is told by the first who asks for its threads.
    _ = rayon_core::ThreadPoolBuilder::new().stack_size(STACK).build_global();
    ExitCode::from(alberti_app::cli::run::run(std::env::args_os()))
}
