//! The `alberti` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(alberti_app::run::run(std::env::args_os()))
}
