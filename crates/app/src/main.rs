//! The `alberti` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    alberti_app::output::file::clean_up_on_signals();
    ExitCode::from(alberti_app::cli::run::run(std::env::args_os()))
}
