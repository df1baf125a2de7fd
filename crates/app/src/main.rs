//! The `alberti` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(alberti_app::cli::run::run(std::env::args_os()))
}
